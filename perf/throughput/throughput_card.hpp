#pragma once
/// A table of throughputs by size and precision: what a machine makes of specimens from a cache's size to its memory's.
#include <functional>
#include <string>

#include "throughput/throughput.hpp"

namespace clathra {

/// One size in one precision.
struct ThroughputRow {
  Precision precision = Precision::full;
  std::int64_t discs = 0;
  Throughput measured;
  double bandwidth = 0;          ///< update_bandwidth() of as much memory, of the same minute [bytes/s]
  double launches_per_step = 0;  ///< of kernels, those of searches among them; a graph of steps is one

  double microseconds_per_step() const { return 1e6 * measured.seconds / static_cast<double>(measured.steps); }
  double bandwidth_share() const {
    return bandwidth > 0 ? measured.disc_steps_per_second * measured.moved_per_step / bandwidth : 0;
  }
};

/// @param seconds  to measure
ThroughputRow throughput_row(ThroughputSetup const& setup, double seconds);

/// Measures 2,000 discs, ten times as many each time, and then `most_discs`, in both precisions, and calls `visit` with each row
/// as it is there. Large packings settle for fewer steps than setups usually do, which would take most of the time.
/// @param setup  what is timed, and how; its size, precision and settling are the card's
/// @param most_discs  >= 2000;  @param seconds  to measure, a row
void throughput_card(ThroughputSetup setup, std::int64_t most_discs, double seconds,
                     std::function<void(ThroughputRow const&)> const& visit);

/// The table in words, as lines that end in a newline: its head, and a row.
std::string card_head();
std::string card_line(ThroughputRow const& row);

}  // namespace clathra
