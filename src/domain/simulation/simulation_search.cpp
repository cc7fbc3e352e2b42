/// What a simulation does when its rows are outdated: discs get their owners, their order and their neighbours anew.
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "domain/parallel/migration.hpp"
#include "domain/simulation/simulation.hpp"
#include "kernels/spatial_order.hpp"

namespace clathra {

namespace {

constexpr int searches_a_sorting = 16;  // of discs that no rank sends or gets

}  // namespace

/// @param all  of the present discs, by survey_discs() or asked for before, which finds those that are nowhere and have no cell
/// @param also  what goes with the discs beside auxiliary_fields()
void Simulation::rebuild(Survey const& all, bool skin_by_speed, AuxiliaryFields const& also) {
  Kokkos::Timer const clock;
  graph_.drop();
  if (!log_lasts()) broken_bonds_.collect();
  SkinRange const skins = skin_range(skin_by_speed);
  Real const largest_skin = std::max(skins.skin(all.largest[Survey::speed], all.mean_speed), skins.least);
  WallShear wall_shear = wall_shear_of_discs(particles_, wall_contacts_, scratch_);
  AuxiliaryFields const with_discs = with(auxiliary_fields(wall_shear), also);
  wall_contacts_ = WallContacts();
  OldRows old = take_as_old(particles_, rows_);
  Field<int> slot = slots_of_discs(particles_, old, scratch_);
  if (!ranks_.alone()) {
    decomposition_.follow(frame());
    rebalance_if_it_pays();
    migrate(ranks_, decomposition_, particles_, with_discs, old, slot, scratch_);
  }
  Bounds const bounds = own_bounds(all.bounds());
  std::optional<CellsOfOrder> cells;
  if (sorting_is_due()) cells = {2 * largest_radius_ + skin_, bounds};
  Field<int> const order = sort_in_space(particles_, old, slot, cells, scratch_);
  for_each_auxiliary_field(with_discs, [&](auto& field) { field = permuted(field, order, particles_.x.extent(0), scratch_); });
  SearchReach reach{largest_radius_, largest_skin, all.largest[Survey::bonded_gap], bounds};
  reach_ = 2 * largest_radius_ + std::max(2 * largest_skin + rounding_slack(particles_, largest_radius_), reach.bonded_gap);
  require_places_told_apart();
  if (periodic()) images_.rebuild(particles_, now_.box.cell, reach_);
  if (!ranks_.alone()) halo_.rebuild(ranks_, decomposition_, particles_, reach_);
  assign_verlet_skins(particles_, frame(), skins, all.mean_speed);
  refresh_ghosts(particles_.verlet_skin);
  if (particles_.ghosts > 0) reach.bounds = bounds.grown(reach_);
  find_rows_and_walls(reach, old, slot, wall_shear);
  prepare_rows(particles_, rows_, laws_.contact.bond);
  update_mirror(particles_, 0, particles_.all());
  make_room_for_breaks();
  now_.search = {now_.box, 0};
  following_.due = following_.on;  // pairs that were not listed may touch from now on
  rebuild_pending_ = false;
  ++rebuilds_;
  searched_at_ = now_.step;
  scratch_.tidy();
  rebuild_seconds_ += clock.seconds();
}

/// Mixed precision knows differences of places modulo 2^32 ticks.
void Simulation::require_places_told_apart() const {
  if (particles_.precision == Precision::full || particles_.mirror.reaches(reach_)) return;
  throw Refused(
      "neighbours are searched for up to " + std::to_string(1e3 * reach_) +
      " mm away, further than mixed precision tells places apart: give a smaller run.skin, or take run.precision = \"double\"");
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

/// Where this rank's discs will be when each has its owner.
Bounds Simulation::own_bounds(Bounds const& all) const {
  if (periodic()) {
    PeriodicCell const& cell = now_.box.cell;
    return {cell.left, cell.left + cell.width, cell.bottom, cell.bottom + cell.height};
  }
  if (ranks_.alone()) return all;
  Rectangle const own = decomposition_.rectangle(ranks_.rank());
  return {std::max(all.left, own.left), std::min(all.right, own.right), std::max(all.bottom, own.bottom),
          std::min(all.top, own.top)};
}

/// Where no rank sends or gets discs their order in space holds for a while.
bool Simulation::sorting_is_due() {
  bool const due = !ranks_.alone() || searches_until_sorting_ == 0;
  searches_until_sorting_ = due ? searches_a_sorting - 1 : searches_until_sorting_ - 1;
  return due;
}

/// Cuts anew when the time that ranks have waited for the slowest, since the last check, is well above what cutting costs.
void Simulation::rebalance_if_it_pays() {
  constexpr double worth = 4, least_imbalance = 1.05;
  double slowest[2] = {busy_seconds_, rebuild_seconds_ / static_cast<double>(std::max<std::int64_t>(rebuilds_, 1))};
  ranks_.max(slowest, 2);
  double const mean = 1e-9 * static_cast<double>(ranks_.sum(std::llround(1e9 * busy_seconds_))) / ranks_.count();
  if (slowest[0] < least_imbalance * mean || slowest[0] - mean < worth * slowest[1]) return;
  double const seconds_a_disc = busy_seconds_ / std::max(particles_.owned, 1);
  double const weight = 1e6 * seconds_a_disc / std::max(ranks_.max(seconds_a_disc), 1e-300);
  decomposition_ = Decomposition::bisect(ranks_, particles_, std::max<std::int64_t>(1, std::llround(weight)));
  busy_seconds_ = 0;
}

AuxiliaryFields Simulation::auxiliary_fields(WallShear& wall_shear) {
  AuxiliaryFields with_discs;
  for_each_account(losses_, {}, [&](char const* name, Field<Accum>& account, bool) {
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
  return laws_.contact.bond_kind == BondKind::none || (ranks_.alone() && broken_bonds_.has_log());
}

void Simulation::make_room_for_breaks() {
  if (log_lasts()) return;
  broken_bonds_.make_room(broken_bonds_.keeps_events ? static_cast<std::size_t>(count_own_bonds(particles_, rows_)) : 0);
}

}  // namespace clathra
