/// Files that hold either what they are said to hold or what they held before: each write is checked and
/// whole, and what fails is told with the system's reason. All functions return what went wrong, "<path>:
/// <reason>", empty if nothing did.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tribogel
{

/// A file that grows by whole pieces: of one that cannot be written nothing stays. It notices that it was
/// removed, or changed by somebody else.
class GrowingFile
{
public:
  GrowingFile() = default;
  ~GrowingFile() { close(); }
  GrowingFile(const GrowingFile &) = delete;
  GrowingFile &operator=(const GrowingFile &) = delete;

  std::string create(const std::string &path); ///< empty; one that is there is replaced
  std::string resume(const std::string &path,
                     std::uintmax_t bytes); ///< what is there behind these is cut off
  std::string append(std::string_view piece);
  std::string bring_to_disk(); ///< what has been written survives the machine's end
  std::uintmax_t size() const { return length; }

private:
  std::string open(const std::string &path, int flags);
  void close();

  std::string where;
  int file = -1;
  std::uintmax_t length = 0; ///< of the pieces written [bytes]
};

/// To `path`.part first, brought to the disk, then renamed: a crash or a full device leaves the old file.
std::string replace_file(const std::string &path, std::string_view content);

} // namespace tribogel
