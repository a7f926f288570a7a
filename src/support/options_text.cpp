#include "support/options_text.hpp"

#include "support/characters.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace tribogel
{

namespace
{

[[noreturn]] void refuse_file(const std::string &named, const std::string &why)
{
  throw UserError{named + ": " + why + "; allowed: a readable text file of options"};
}

std::string content_of(const std::string &path, const std::string &named)
{
  std::error_code ignored;
  const auto kind = std::filesystem::status(path, ignored).type();
  if (kind == std::filesystem::file_type::directory) refuse_file(named, "is a directory");
  if (std::filesystem::exists(path, ignored) && kind != std::filesystem::file_type::regular)
    refuse_file(named, "is a device or a pipe, which may never end");
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse_file(named, std::strerror(errno));
  std::string content;
  for (char part[4096]; file.read(part, sizeof part) || file.gcount() > 0;)
    content.append(part, static_cast<std::size_t>(file.gcount()));
  if (file.bad()) refuse_file(named, std::strerror(errno));
  return content;
}

/// The program that saved the file put a mark before its text.
void pass_mark(std::string &content, const std::string &named)
{
  for (const std::string mark : {"\xFF\xFE", "\xFE\xFF"})
    if (content.starts_with(mark))
      throw UserError{named + ": is UTF-16; allowed: a text file of options, saved as UTF-8"};
  const std::string utf8 = "\xEF\xBB\xBF";
  if (content.starts_with(utf8)) content.erase(0, utf8.size());
}

void check_line(const TextLine &line, const std::string &named)
{
  const std::string number = "line " + std::to_string(line.number);
  if (const std::string odd = control_character(line.text); !odd.empty())
    throw UserError{named + ": " + number + " is no text, it holds " + odd +
                    "; allowed: a text file of options, saved as UTF-8"};
  if (const std::string odd = disputed_line_end(line.text); !odd.empty())
    throw UserError{named + ": " + number + " holds " + odd +
                    ", which ends a line for some programs and not for others; allowed: the usual line ends"};
}

} // namespace

std::vector<TextLine> lines_of_file(const std::string &path, const std::string &named)
{
  std::string content = content_of(path, named);
  pass_mark(content, named);
  std::vector<TextLine> lines;
  for (std::size_t begin = 0, next = 0; begin < content.size(); begin = next) {
    const std::size_t end = std::min(content.find_first_of("\r\n", begin), content.size());
    next = end + (content.compare(end, 2, "\r\n") == 0 ? 2 : 1);
    lines.push_back({static_cast<int>(lines.size()) + 1, content.substr(begin, end - begin)});
    check_line(lines.back(), named);
    std::string &text = lines.back().text;
    text.resize(std::min(text.find('#'), text.size()));
  }
  return lines;
}

std::vector<std::string> words_of_line(const std::string &text, const std::string &place)
{
  constexpr const char *blanks = " \t\r\n";
  std::vector<std::string> words;
  for (std::size_t begin = text.find_first_not_of(blanks); begin < text.size();) {
    const bool quoted = text[begin] == '"';
    const std::size_t end =
        quoted ? text.find('"', begin + 1) : std::min(text.find_first_of(blanks, begin), text.size());
    if (end == std::string::npos)
      throw UserError{shown(text.substr(begin)) + ": a quotation mark without its other one, " + place +
                      "; allowed: words without marks, or between two"};
    words.push_back(quoted ? text.substr(begin + 1, end - begin - 1) : text.substr(begin, end - begin));
    begin = text.find_first_not_of(blanks, quoted ? end + 1 : end);
  }
  return words;
}

} // namespace tribogel
