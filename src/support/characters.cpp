#include "support/characters.hpp"

#include <cstdio>
#include <functional>
#include <iterator>

namespace tribogel
{

namespace
{

enum class Sort { seen, unseen, line_end, control };

struct Character {
  char32_t code = 0;
  bool valid = true; ///< UTF-8; otherwise the code is that of a lone byte
  std::size_t length = 1;
};

struct NamedRange {
  char32_t first, last;
  const char *name;
  Sort sort;
};

constexpr NamedRange named[] = {
    {0x0B, 0x0B, "a vertical tab", Sort::line_end},
    {0x0C, 0x0C, "a form feed", Sort::line_end},
    {0x85, 0x85, "a next-line character", Sort::line_end},
    {0x2028, 0x2028, "a line separator", Sort::line_end},
    {0x2029, 0x2029, "a paragraph separator", Sort::line_end},
    {0xA0, 0xA0, "a no-break space", Sort::unseen},
    {0xAD, 0xAD, "a soft hyphen", Sort::unseen},
    {0x2000, 0x200A, "a typographic space", Sort::unseen},
    {0x200B, 0x200D, "a character without width", Sort::unseen},
    {0x200E, 0x200F, "a mark of direction", Sort::unseen},
    {0x202A, 0x202E, "a mark of direction", Sort::unseen},
    {0x202F, 0x202F, "a narrow no-break space", Sort::unseen},
    {0x205F, 0x205F, "a typographic space", Sort::unseen},
    {0x2060, 0x2064, "a character without width", Sort::unseen},
    {0x2066, 0x2069, "a mark of direction", Sort::unseen},
    {0x3000, 0x3000, "an ideographic space", Sort::unseen},
    {0xFEFF, 0xFEFF, "a byte-order mark", Sort::unseen},
    {0x2010, 0x2011, "a hyphen", Sort::seen},
    {0x2012, 0x2012, "a figure dash", Sort::seen},
    {0x2013, 0x2013, "an en dash", Sort::seen},
    {0x2014, 0x2015, "an em dash", Sort::seen},
    {0x2018, 0x201F, "a typographic quotation mark", Sort::seen},
    {0x2212, 0x2212, "a minus sign", Sort::seen},
    {0xFF0C, 0xFF0C, "a fullwidth comma", Sort::seen},
    {0xFF0D, 0xFF0D, "a fullwidth minus sign", Sort::seen},
    {0, 0x1F, "a control character", Sort::control}, // after the line ends among them
    {0x7F, 0x9F, "a control character", Sort::control},
};

Character first_of(std::string_view text)
{
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char head = byte(0);
  if (head < 0x80) return {head};
  const std::size_t length = head >= 0xF0 && head < 0xF8   ? 4
                             : head >= 0xE0 && head < 0xF0 ? 3
                             : head >= 0xC2                ? 2
                                                           : 1;
  if (length == 1 || head >= 0xF8 || text.size() < length) return {head, false};
  char32_t code = head & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80) return {head, false};
    code = code << 6 | (byte(i) & 0x3Fu);
  }
  return {code, true, length};
}

const NamedRange *entry_of(const Character &c)
{
  for (const NamedRange &range : named)
    if (c.valid && range.first <= c.code && c.code <= range.last) return &range;
  return nullptr;
}

Sort sort_of(const Character &c)
{
  if (c.code == '\t' || c.code == '\n' || c.code == '\r') return Sort::seen; // have their meaning in a file
  const NamedRange *range = entry_of(c);
  return range ? range->sort : Sort::seen;
}

std::string number_of(const Character &c)
{
  char text[16];
  std::snprintf(text, sizeof text, "U+%04X", static_cast<unsigned>(c.code));
  return text;
}

std::string in_words(const Character &c)
{
  if (!c.valid) {
    char text[48];
    std::snprintf(text, sizeof text, "a byte 0x%02X, which is no UTF-8", static_cast<unsigned>(c.code));
    return text;
  }
  if (c.code == 0) return "a byte 0";
  const NamedRange *range = entry_of(c);
  return range ? std::string(range->name) + " (" + number_of(c) + ")" : "the character " + number_of(c);
}

bool is_unreadable(const Character &c)
{
  return !c.valid || sort_of(c) == Sort::unseen || sort_of(c) == Sort::line_end;
}

std::string first_that(std::string_view text, const std::function<bool(const Character &)> &is_meant)
{
  for (; !text.empty(); text.remove_prefix(first_of(text).length))
    if (const Character c = first_of(text); is_meant(c)) return in_words(c);
  return {};
}

} // namespace

std::string foreign_character(std::string_view text)
{
  return first_that(text, [](const Character &c) { return !c.valid || c.code < ' ' || c.code > '~'; });
}

std::string unreadable_character(std::string_view text)
{
  return first_that(text, is_unreadable);
}

std::string disputed_line_end(std::string_view text)
{
  return first_that(text, [](const Character &c) { return sort_of(c) == Sort::line_end; });
}

std::string control_character(std::string_view text)
{
  return first_that(text, [](const Character &c) { return sort_of(c) == Sort::control; });
}

std::string shown(std::string_view text)
{
  std::string result;
  for (; !text.empty(); text.remove_prefix(first_of(text).length)) {
    const Character c = first_of(text);
    if (!is_unreadable(c))
      result += text.substr(0, c.length);
    else
      result += c.valid ? "<" + number_of(c) + ">" : "?";
  }
  return result;
}

} // namespace tribogel
