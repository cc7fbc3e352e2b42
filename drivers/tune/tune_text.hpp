#pragma once
/// What `clathra tune` says and writes.
#include <string>
#include <vector>

#include "tune/tune_plan.hpp"

namespace clathra {

/// A line for each setting that was run: its error with the 95 % interval and its cost, cheapest last.
/// @param failures  why settings cannot be run, by their place; empty where they can
std::string tune_table(TunePlan const& plan, SettingSearch const& search, std::vector<std::string> const& failures);

/// "peak_q_Pa +0.31 ± 0.52 % (95 %, 7 seeds of 1000 discs)"
std::string measured_text(TunePlan const& plan, SettingError const& error);

/// The scene file with the keys of a setting, each under what was measured of it. @param folder  where it will be kept
std::string tuned_scene(TunePlan const& plan, SettingSearch const& search, std::size_t setting,
                        std::filesystem::path const& folder);

}  // namespace clathra
