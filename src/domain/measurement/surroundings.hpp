#pragma once
/// The part of a snapshot around a place.
#include "domain/measurement/snapshot.hpp"
#include "domain/parallel/ranks.hpp"

namespace clathra {

/// Discs whose centres lie within a distance of a place, and the pairs between two of them (of several ranks: between two of the
/// same one). Discs that are nowhere are left out. Collective. @param snapshot  this rank's part
Snapshot surroundings(Snapshot const& snapshot, double x, double y, double distance, Ranks const& ranks = {});

}  // namespace clathra
