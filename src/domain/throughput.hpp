#pragma once
/// How fast whole time steps run on a fixed packing, and how near to the machine's limits.
#include <cstdint>

#include "domain/simulation.hpp"

namespace clathra {

/// What is timed. `rolling`: grains with rolling resistance, no hydrate. `bonded`: 55 % hydrate, bonds in parallel to the
/// contacts.
enum class ThroughputCase { rolling, bonded };

struct ThroughputSetup {
  ThroughputCase what = ThroughputCase::bonded;
  std::int64_t discs = 20000;
  double skin = 0.1;  ///< in d50
};

/// A periodic cell of 2,000 discs packed under 1 MPa, repeated, cut by walls, bonded, and sheared at the inertial number 1e-4:
/// ready to be timed.
Simulation throughput_simulation(ThroughputSetup const& setup, Ranks const& ranks = {});

struct Throughput {
  std::int64_t steps = 0, rebuilds = 0;
  double seconds = 0;
  double particle_steps_per_s = 0;
  double contact_steps_per_s = 0;  ///< pairs that touch or are bonded
  double bytes_per_disc = 0;       ///< held: fields, rows and buffers
  double moved_per_step = 0;       ///< [bytes a disc] that one step reads and writes at the least, each field once
  double rebuild_share = 0;        ///< of the time, spent in neighbour searches
};

/// Steps for about so many seconds; of several ranks the rates are those of all together. @throws Diverged
Throughput measure_throughput(Simulation& simulation, double seconds);

/// Bandwidth of reading and writing so many bytes over and over with all threads [bytes/s, both counted], the best of five: the
/// limit of what a specimen of that size could move, from a cache if it fits in one.
double update_bandwidth(std::size_t bytes);

}  // namespace clathra
