/// The text of an options file, down to its words.
#pragma once

#include "support/user_error.hpp"

#include <string>
#include <vector>

namespace tribogel
{

struct TextLine {
  int number; ///< from 1
  std::string text;
};

/// Lines end with LF, CR LF or CR and come without their comments, from '#' on; a byte-order mark of UTF-8 is
/// passed over. Throws UserError, which begins with `named`, for a file that cannot be read, is UTF-16 or
/// binary, or has characters that end a line for some programs only.
std::vector<TextLine> lines_of_file(const std::string &path, const std::string &named);

/// Blanks, tabs and line ends separate words; a word in double quotation marks may hold
/// blanks. Throws UserError for a mark without its other one.
std::vector<std::string> words_of_line(const std::string &text, const std::string &place);

} // namespace tribogel
