#pragma once
/// Ctrl-C.

namespace clathra {

/// From now on the first SIGINT or SIGTERM only sets a flag; a second one ends the program at once.
void watch_for_interrupt();
bool interrupted();

}  // namespace clathra
