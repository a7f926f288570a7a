#include "support/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

namespace tribogel
{

namespace
{

std::string reason_at(const std::string &path)
{
  return path + ": " + std::strerror(errno);
}

/// A write may take a part only, at a full device or a limit: the next one then says why.
bool write_all(int file, std::string_view content)
{
  while (!content.empty()) {
    const ssize_t written = write(file, content.data(), content.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Some file systems have nothing to do for it and say EINVAL.
bool synchronise(int file)
{
  return fsync(file) == 0 || errno == EINVAL;
}

/// A renamed file's new name is on the disk when its directory is; not everybody who may write there may read
/// it.
std::string bring_directory_to_disk(const std::filesystem::path &of_file)
{
  const std::string path = of_file.has_parent_path() ? of_file.parent_path().string() : ".";
  const int directory = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return {};
  const std::string complaint = synchronise(directory) ? "" : reason_at(path);
  close(directory);
  return complaint;
}

std::string write_whole(const std::string &path, std::string_view content)
{
  constexpr mode_t as_others = 0666; // the user's umask has the last word
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, as_others);
  if (file < 0) return reason_at(path);
  std::string complaint = write_all(file, content) && synchronise(file) ? "" : reason_at(path);
  if (close(file) != 0 && complaint.empty()) complaint = reason_at(path);
  return complaint;
}

} // namespace

std::string GrowingFile::open(const std::string &path, int flags)
{
  constexpr mode_t as_others = 0666;
  close();
  where = path;
  length = 0;
  file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | flags, as_others);
  return file < 0 ? reason_at(path) : "";
}

void GrowingFile::close()
{
  if (file >= 0) ::close(file);
  file = -1;
}

std::string GrowingFile::create(const std::string &path)
{
  return open(path, O_CREAT | O_TRUNC);
}

std::string GrowingFile::resume(const std::string &path, std::uintmax_t bytes)
{
  struct stat status = {};
  if (std::string complaint = open(path, 0); !complaint.empty()) return complaint;
  if (fstat(file, &status) != 0) return reason_at(path);
  if (static_cast<std::uintmax_t>(status.st_size) < bytes) return path + ": shorter than it was";
  if (ftruncate(file, static_cast<off_t>(bytes)) != 0) return reason_at(path);
  length = bytes;
  return {};
}

std::string GrowingFile::append(std::string_view piece)
{
  struct stat status = {};
  if (stat(where.c_str(), &status) != 0) return reason_at(where);
  if (static_cast<std::uintmax_t>(status.st_size) != length) return where + ": changed by another program";
  if (!write_all(file, piece)) {
    std::string complaint = reason_at(where);
    if (ftruncate(file, static_cast<off_t>(length)) != 0) complaint += "; its last row is cut short";
    return complaint;
  }
  length += piece.size();
  return {};
}

std::string GrowingFile::bring_to_disk()
{
  return synchronise(file) ? "" : reason_at(where);
}

std::string replace_file(const std::string &path, std::string_view content)
{
  const std::string part = path + ".part";
  std::string complaint = write_whole(part, content);
  if (complaint.empty() && std::rename(part.c_str(), path.c_str()) != 0) complaint = reason_at(path);
  if (complaint.empty()) return bring_directory_to_disk(path);
  unlink(part.c_str()); // it would take room where there may be none
  return complaint;
}

} // namespace tribogel
