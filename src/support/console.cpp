#include "support/console.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace tribogel
{

void occupy_standard_streams()
{
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", O_RDWR) < 0) return; // the lowest number that is free
}

std::string print_whole(const std::string &text)
{
  if (std::fputs(text.c_str(), stdout) >= 0 && std::fflush(stdout) == 0) return {};
  return std::strerror(errno);
}

bool output_was_lost()
{
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return false;
  [[maybe_unused]] const std::FILE *const nowhere = std::freopen("/dev/null", "w", stdout);
  return true;
}

} // namespace tribogel
