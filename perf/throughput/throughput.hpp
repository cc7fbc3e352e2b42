#pragma once
/// How fast whole time steps run on a fixed packing, and how near to the machine's limits.
#include <cstdint>

#include "domain/simulation/simulation.hpp"

namespace clathra {

/// What is timed. `rolling`: grains with rolling resistance, no hydrate. `bonded`: 55 % hydrate, bonds in parallel to the
/// contacts. `breaking`: the same sheared to some 5 % strain, where bonds break all the time.
enum class ThroughputCase { rolling, bonded, breaking };
inline constexpr char const* throughput_case_names[] = {"rolling", "bonded", "breaking"};

struct ThroughputSetup {
  ThroughputCase what = ThroughputCase::bonded;
  std::int64_t discs = 20000;
  double skin = chosen_skin;  ///< in d50
  Precision precision = Precision::full;
  int relaxation_steps = 3000;  ///< in which the walls find the cut packing
};

/// A periodic cell of 2,000 discs packed under 1 MPa, repeated, cut by walls, bonded, and sheared at the inertial number 1e-4
/// (`breaking`: 1e-3): ready to be timed.
Simulation throughput_simulation(ThroughputSetup const& setup, Ranks const& ranks = {});

struct Throughput {
  std::int64_t steps = 0, rebuilds = 0;
  double seconds = 0;
  double disc_steps_per_second = 0;
  double contact_steps_per_s = 0;    ///< pairs that touch or are bonded
  double bytes_per_disc = 0;         ///< held: fields, rows and buffers
  double search_bytes_per_disc = 0;  ///< of these what only neighbour searches need
  double moved_per_step = 0;         ///< [bytes a disc] that one step reads and writes at the least, each field once
  double flops_per_s = 0;            ///< double precision operations of the laws; empty lanes and neighbour searches not counted
  std::int64_t broken = 0;           ///< bonds broken while it was timed
  double rebuild_share = 0;          ///< of the time, spent in neighbour searches
};

/// Steps for about so many seconds; of several ranks the rates are those of all together. @throws Diverged
Throughput measure_throughput(Simulation& simulation, double seconds);

/// Bandwidth of reading and writing so many bytes over and over with all threads [bytes/s, both counted], the best of five: the
/// limit of what a specimen of that size could move, from a cache if it fits in one.
double update_bandwidth(std::size_t bytes);

/// Products and sums in double precision that all threads make at most [1/s], in equal parts and not fused (the laws are built
/// without fused operations); the best of five.
double arithmetic_rate();

}  // namespace clathra
