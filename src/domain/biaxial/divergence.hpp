#pragma once
/// What goes along with the message of a test that diverges.
#include <memory>
#include <utility>

#include "domain/measurement/surroundings.hpp"
#include "domain/scene/stage.hpp"
#include "domain/simulation/simulation.hpp"

namespace clathra {

/// Does a part of a test. Where it diverges the state around the disc, as far as 12 d50, is put into the exception. Collective.
/// @param simulation  the one that steps, or null before there is one
template <class Work>
auto with_snapshot_of_divergence(std::unique_ptr<Simulation> const& simulation, double d50, Work const& work) {
  constexpr double distance = 12;
  try {
    return work();
  } catch (Diverged& fault) {
    if (fault.placed && simulation)
      fault.around = std::make_shared<Snapshot>(
          surroundings(take_snapshot(*simulation), fault.x, fault.y, distance * d50, simulation->assembly().ranks()));
    throw;
  }
}

}  // namespace clathra
