#pragma once
/// Watches what a program does with the memory of the device-like space (space.hpp) outside of kernels and deep copies.
#include <map>
#include <string>

namespace clathra::device_like {

/// From its making on the memory of the space is shut but for kernels, deep copies and the library itself. One at a time. What
/// reads or writes it all the same is noted and let go on until the next kernel.
class HostAccessWatch {
 public:
  HostAccessWatch();
  ~HostAccessWatch();
  HostAccessWatch(HostAccessWatch const&) = delete;
  HostAccessWatch& operator=(HostAccessWatch const&) = delete;
  /// One line for each field and place of the program that reached it so far: the functions that were being called.
  std::string report() const;
};

/// Counts from its making on what a device would be asked to do. One at a time, and not beside a HostAccessWatch.
class LaunchCount {
 public:
  LaunchCount();
  ~LaunchCount();
  LaunchCount(LaunchCount const&) = delete;
  LaunchCount& operator=(LaunchCount const&) = delete;
  using Counts = std::map<std::string, int>;
  Counts launches() const;     ///< kernels by name, each "for", "reduce" or "scan" and its label
  Counts round_trips() const;  ///< what the host waits for: sums and scans by label, copies to the host by the name of the field
  int allocations() const;     ///< in the space
};

}  // namespace clathra::device_like
