/// Standard output and error, which a caller may have closed, filled up or left.
#pragma once

#include <string>

namespace tribogel
{

/// Where standard input, output or error is closed, the next file opened would take its place, and be written
/// to by all that prints: the null device takes it. Before anything is opened.
void occupy_standard_streams();

/// Prints on standard output. Returns the system's reason if not all of it arrived, empty if it did.
std::string print_whole(const std::string &text);

/// Whether something printed on standard output so far did not arrive. If so what is printed later goes
/// nowhere, without errors.
bool output_was_lost();

} // namespace tribogel
