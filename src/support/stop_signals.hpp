/// The wish to stop, from a queue, mpirun or the keyboard.
#pragma once

namespace tribogel
{

/// From here on SIGUSR1, SIGTERM and SIGINT do no more than to be remembered, and a write that meets a limit
/// of file sizes or a pipe without reader fails instead of ending the program. After PetscInitialize, whose
/// handlers they replace.
void catch_stop_signals();

/// The last one that this process got, 0 if none.
int caught_stop_signal();

/// "SIGUSR1" and so on.
const char *stop_signal_name(int signal);

} // namespace tribogel
