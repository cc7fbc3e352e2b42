#pragma once
/// What a run will cost before it is made.
#include "domain/scene/scene.hpp"
#include "domain/scene/specimen_design.hpp"
#include "domain/scene/stage.hpp"

namespace clathra {

/// What a scene will cost, without running it: particles, width, height, time step estimate, strain rate, steps, inertial_number,
/// platen_wave_stress, rate_share (RateNumbers::share), memory_bytes (of all ranks at their peak), disk_bytes, disc_steps.
/// @param design  of its specimen, where that is not the one that the scene asks for;  @param ranks  that will share it
StageRecord predict(Scene const& scene, SpecimenDesign const& design, int ranks = 1);
StageRecord predict(Scene const& scene, int ranks = 1);

}  // namespace clathra
