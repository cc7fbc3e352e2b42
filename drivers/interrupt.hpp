#pragma once
/// Ctrl-C, and what batch systems send before they end a run.

namespace clathra {

/// From now on the first SIGINT, SIGTERM or SIGUSR1 only sets a flag; a second one ends the program at once.
void watch_for_interrupt();
bool interrupted();

}  // namespace clathra
