#include "support/stop_signals.hpp"

#include <csignal>
#include <initializer_list>

namespace tribogel
{

namespace
{

volatile std::sig_atomic_t caught = 0; // a handler can reach nothing but a global

extern "C" void remember(int signal)
{
  caught = signal;
}

} // namespace

void catch_stop_signals()
{
  struct sigaction action = {};
  action.sa_handler = remember;
  action.sa_flags = SA_RESTART; // reading and writing go on
  sigemptyset(&action.sa_mask);
  for (int signal : {SIGUSR1, SIGTERM, SIGINT}) sigaction(signal, &action, nullptr);
  action.sa_handler = SIG_IGN;
  for (int signal : {SIGXFSZ, SIGPIPE}) sigaction(signal, &action, nullptr);
}

int caught_stop_signal()
{
  return caught;
}

const char *stop_signal_name(int signal)
{
  return signal == SIGUSR1 ? "SIGUSR1" : signal == SIGTERM ? "SIGTERM" : "SIGINT";
}

} // namespace tribogel
