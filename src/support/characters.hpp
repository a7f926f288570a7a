/// Characters that look like others or like nothing at all: a minus sign that is no '-', a blank that is
/// none, a line end that only some programs see. They come with text that is copied from a page or was saved
/// by another system. Pure.
#pragma once

#include <string>
#include <string_view>

namespace tribogel
{

/// The first character of the UTF-8 text that is no printable ASCII, in words: "a minus sign (U+2212)", "a
/// byte 0xE9, which is no UTF-8". Empty: there is none.
std::string foreign_character(std::string_view text);

/// The first one that nobody can read: blanks other than blank and tab, marks without width, line ends, bytes
/// that are no UTF-8. Empty: none.
std::string unreadable_character(std::string_view text);

/// The first one that ends a line for some programs and not for others; LF and CR are not among them. Empty:
/// none.
std::string disputed_line_end(std::string_view text);

/// The first control character other than a tab, LF and CR. Empty: none.
std::string control_character(std::string_view text);

/// The text with what nobody can read written out, as "<U+00A0>".
std::string shown(std::string_view text);

} // namespace tribogel
