#pragma once
/// Ctrl-C, and what batch systems send before they end a run.

namespace clathra {

/// From now on SIGINT, SIGTERM, SIGUSR1 (which batch systems send before the end, and which mpirun passes on in peace) and SIGHUP
/// (unless it is ignored, by nohup) only set a flag. A second SIGINT ends the program at once.
void watch_for_interrupt();
bool interrupted();

}  // namespace clathra
