#include "domain/simulation/neighbour_search.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "domain/scene/stage.hpp"
#include "kernels/spatial_order.hpp"

namespace clathra {

namespace {

/// Mixed precision knows differences of places modulo 2^32 ticks.
void require_places_told_apart(Assembly const& a, Real reach) {
  if (a.particles.precision == Precision::full || a.particles.mirror.reaches(reach)) return;
  throw Refused(
      "neighbours are searched for up to " + std::to_string(1e3 * reach) +
      " mm away, further than mixed precision tells places apart: " +
      (a.upkeep.skin() > a.facts.largest_radius ? "give a smaller run.verlet_skin" : "take run.precision = \"double\""));
}

void find_rows_and_boundaries(Assembly& a, SearchReach const& reach, OldRows& old, Field<int> const& old_row,
                              std::vector<BoundaryHistory> const& histories) {
  std::size_t const boundaries = a.boundaries.size();
  Field<std::int64_t> const sizes = a.scratch.take<std::int64_t>("sizes_of_search", 1 + boundaries);
  for (std::size_t b = 0; b < boundaries; ++b)
    a.boundaries[b]->list_near(a.particles, a.now, Kokkos::subview(sizes, std::pair(1 + b, 2 + b)), a.scratch);
  auto const read = find_neighbours(a.particles, reach, old, old_row, a.rows, a.faults, sizes, a.scratch);
  for (std::size_t b = 0; b < boundaries; ++b)
    a.boundaries[b]->make_contacts(static_cast<int>(read[1 + b]), a.laws, histories[b], a.scratch);
}

}  // namespace

RebuildInputs rebuild_inputs_of_all(Assembly const& a) {
  if (a.rows.features.bonds) a.refresh_ghosts();  // gaps to ghosts are those of now
  return rebuild_inputs_of_all(a, rebuild_inputs(a.particles, a.rows, a.frame(), a.faults, a.sums.unit));
}

RebuildInputs rebuild_inputs_of_all(Assembly const& a, RebuildInputs all) {
  a.ranks().sum(all.sums, RebuildInputs::sum_count);
  a.ranks().max(all.largest, RebuildInputs::largest_count);
  a.throw_of(all.largest + RebuildInputs::faults);
  all.mean_speed = a.in_range([&] { return all.mean_of_speeds(a.sums.unit); });
  return all;
}

std::vector<BoundaryHistory> boundary_histories(Assembly& a) {
  std::vector<BoundaryHistory> histories;
  for (auto const& boundary : a.boundaries) histories.push_back(boundary->history_of_discs(a.particles, a.scratch));
  return histories;
}

AuxiliaryFields auxiliary_fields(Assembly& a, std::vector<BoundaryHistory>& histories) {
  AuxiliaryFields with_discs;
  for_each_dissipation(a.dissipation, {}, [&](char const* name, Field<Accum>& account, bool) {
    if (account.extent(0) > 0) with_discs.push_back({name, &account});
  });
  if (a.start_x.extent(0) > 0) with_discs.insert(with_discs.end(), {{"start_x", &a.start_x}, {"start_y", &a.start_y}});
  for (BoundaryHistory& history : histories)
    for (auto& [name, field] : history) with_discs.push_back({name, &field});
  return with_discs;
}

AuxiliaryFields force_fields(Assembly& a) {
  AuxiliaryFields all;
  for_each_force(a.particles, [&](DiscField const& about, auto& field) { all.push_back({about.name, &field}); });
  return all;
}

void search_neighbours(Assembly& a, RebuildInputs const& all, bool skin_by_speed, AuxiliaryFields const& also) {
  Kokkos::Timer const clock;
  if (!a.log_lasts()) a.broken.collect();
  ParticleSoA& particles = a.particles;
  SkinRange const range = a.skins(skin_by_speed);
  Real const largest_radius = a.facts.largest_radius,
             largest_skin = std::max(range.skin(all.largest[RebuildInputs::speed], all.mean_speed), range.least);
  std::vector<BoundaryHistory> histories = boundary_histories(a);
  AuxiliaryFields const with_discs = with(auxiliary_fields(a, histories), also);
  for (auto const& boundary : a.boundaries) boundary->drop_contacts();
  OldRows old = take_as_old(particles, a.rows);
  Field<int> old_row = old_rows_of_discs(particles, old, a.scratch);
  a.ghosts.migrate_discs(a.frame(), a.upkeep.seconds_of_a_search(), particles, with_discs, old, old_row, a.scratch);
  Bounds const bounds = a.ghosts.own_bounds(all.bounds(), a.now.box());
  std::optional<CellsOfOrder> cells;
  if (a.upkeep.sorting_is_due(a.ranks().alone())) cells = {2 * largest_radius + a.upkeep.skin(), bounds};
  Field<int> const order = sort_in_space(particles, old, old_row, cells, a.scratch);
  for_each_auxiliary_field(with_discs, [&](auto& field) { field = permuted(field, order, particles.x.extent(0), a.scratch); });
  SearchReach search{largest_radius, largest_skin, all.largest[RebuildInputs::bonded_gap], bounds};
  Real const reach =
      2 * largest_radius + std::max(2 * largest_skin + rounding_slack(particles, largest_radius), search.bonded_gap);
  require_places_told_apart(a, reach);
  a.ghosts.rebuild(particles, a.now.box(), reach);
  assign_verlet_skins(particles, a.frame(), range, all.mean_speed);
  a.refresh_ghosts(particles.verlet_skin);
  if (particles.ghosts > 0) search.bounds = bounds.grown(reach);
  find_rows_and_boundaries(a, search, old, old_row, histories);
  prepare_rows(particles, a.rows, a.laws.contact.bond);
  update_mirror(particles, 0, particles.all());
  a.make_room_for_breaks();
  a.now.at_search = {a.now.box(), 0};
  a.scratch.tidy();
  a.upkeep.after_search(a.steps(), reach, clock.seconds());
}

}  // namespace clathra
