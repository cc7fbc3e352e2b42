/// What a simulation does when its rows are outdated: discs get their owners, their order and their neighbours anew.
#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "domain/simulation/simulation.hpp"
#include "kernels/spatial_order.hpp"

namespace clathra {

/// @param all  of the present discs, by rebuild_inputs_of_all() or enqueued before, which finds those that are nowhere and have
/// no cell
/// @param also  what goes with the discs beside auxiliary_fields()
void Simulation::rebuild(RebuildInputs const& all, bool skin_by_speed, AuxiliaryFields const& also) {
  Kokkos::Timer const clock;
  graph_.drop();
  if (!log_lasts()) broken_bonds_.collect();
  SkinRange const range = skins(skin_by_speed);
  Real const largest_radius = facts_.largest_radius,
             largest_skin = std::max(range.skin(all.largest[RebuildInputs::speed], all.mean_speed), range.least);
  WallShear wall_shear = wall_shear_of_discs(particles_, wall_contacts_, scratch_);
  AuxiliaryFields const with_discs = with(auxiliary_fields(wall_shear), also);
  wall_contacts_ = WallContacts();
  OldRows old = take_as_old(particles_, rows_);
  Field<int> slot = slots_of_discs(particles_, old, scratch_);
  ghosts_.migrate_discs(frame(), upkeep_.seconds_of_a_search(), particles_, with_discs, old, slot, scratch_);
  Bounds const bounds = ghosts_.own_bounds(all.bounds(), now_.box);
  std::optional<CellsOfOrder> cells;
  if (upkeep_.sorting_is_due(ranks().alone())) cells = {2 * largest_radius + upkeep_.skin(), bounds};
  Field<int> const order = sort_in_space(particles_, old, slot, cells, scratch_);
  for_each_auxiliary_field(with_discs, [&](auto& field) { field = permuted(field, order, particles_.x.extent(0), scratch_); });
  SearchReach search{largest_radius, largest_skin, all.largest[RebuildInputs::bonded_gap], bounds};
  Real const reach =
      2 * largest_radius + std::max(2 * largest_skin + rounding_slack(particles_, largest_radius), search.bonded_gap);
  require_places_told_apart(reach);
  ghosts_.rebuild(particles_, now_.box, reach);
  assign_verlet_skins(particles_, frame(), range, all.mean_speed);
  refresh_ghosts(particles_.verlet_skin);
  if (particles_.ghosts > 0) search.bounds = bounds.grown(reach);
  find_rows_and_walls(search, old, slot, wall_shear);
  prepare_rows(particles_, rows_, laws_.contact.bond);
  update_mirror(particles_, 0, particles_.all());
  make_room_for_breaks();
  now_.at_search = {now_.box, 0};
  time_steps_.after_search();
  scratch_.tidy();
  upkeep_.after_search(now_.step, reach, clock.seconds());
}

/// Mixed precision knows differences of places modulo 2^32 ticks.
void Simulation::require_places_told_apart(Real reach) const {
  if (particles_.precision == Precision::full || particles_.mirror.reaches(reach)) return;
  throw Refused("neighbours are searched for up to " + std::to_string(1e3 * reach) +
                " mm away, further than mixed precision tells places apart: " +
                (upkeep_.skin() > facts_.largest_radius ? "give a smaller run.skin" : "take run.precision = \"double\""));
}

void Simulation::find_rows_and_walls(SearchReach const& reach, OldRows& old, Field<int> const& slot,
                                     WallShear const& wall_shear) {
  Field<std::int64_t> const sizes = scratch_.take<std::int64_t>("sizes_of_search", sizes_of_search);
  Field<int> near_walls;
  if (!periodic()) near_walls = list_near_walls(particles_, now_.box.walls, Kokkos::subview(sizes, std::pair(1, 2)), scratch_);
  SearchSizes const found = find_neighbours(particles_, reach, old, slot, rows_, faults_, sizes, scratch_);
  if (!periodic())
    wall_contacts_ = make_wall_contacts(near_walls, found.near_walls, laws_.wall.friction > 0, wall_shear, scratch_);
}

AuxiliaryFields Simulation::auxiliary_fields(WallShear& wall_shear) {
  AuxiliaryFields with_discs;
  for_each_dissipation(losses_, {}, [&](char const* name, Field<Accum>& account, bool) {
    if (account.extent(0) > 0) with_discs.push_back({name, &account});
  });
  if (start_x_.extent(0) > 0) with_discs.insert(with_discs.end(), {{"start_x", &start_x_}, {"start_y", &start_y_}});
  static constexpr char const* shear_names[] = {"shear_left", "shear_right", "shear_bottom", "shear_top"};
  if (wall_contacts_.rough) {
    for (std::size_t wall = 0; wall < wall_count; ++wall) with_discs.push_back({shear_names[wall], &wall_shear.of[wall]});
  }
  return with_discs;
}

/// Where no rank sends or gets discs, intact bonds only become fewer after restore_history().
bool Simulation::log_lasts() const {
  return laws_.contact.bond_kind == BondKind::none || (ranks().alone() && broken_bonds_.has_log());
}

void Simulation::make_room_for_breaks() {
  if (log_lasts()) return;
  broken_bonds_.make_room(broken_bonds_.keeps_events ? static_cast<std::size_t>(count_own_bonds(particles_, rows_)) : 0);
}

}  // namespace clathra
