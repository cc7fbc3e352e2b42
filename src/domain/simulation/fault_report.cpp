#include "domain/simulation/fault_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "domain/simulation/printed_text.hpp"

namespace clathra {
namespace {

constexpr double nowhere = -std::numeric_limits<double>::infinity();

/// Positions of this rank's discs and its ghosts, on the host.
struct Discs {
  std::vector<int> id;
  std::vector<double> x, y, vx, vy, omega, radius, reference_x, reference_y;
  int owned;

  explicit Discs(ParticleSoA const& p)
      : id(on_host(p.id, p.all())),
        x(on_host(p.x, p.all())),
        y(on_host(p.y, p.all())),
        vx(on_host(p.vx, static_cast<std::size_t>(p.owned))),
        vy(on_host(p.vy, static_cast<std::size_t>(p.owned))),
        omega(on_host(p.omega, static_cast<std::size_t>(p.owned))),
        radius(on_host(p.radius, p.all())),
        reference_x(on_host(p.reference_x, p.owned)),
        reference_y(on_host(p.reference_y, p.owned)),
        owned(p.owned) {}

  bool finite(int i) const {
    auto const k = static_cast<std::size_t>(i);
    return std::isfinite(x[k]) && std::isfinite(y[k]) && std::isfinite(vx[k]) && std::isfinite(vy[k]) && std::isfinite(omega[k]);
  }
  bool placed(int i) const {
    return std::isfinite(x[static_cast<std::size_t>(i)]) && std::isfinite(y[static_cast<std::size_t>(i)]);
  }
};

/// The deepest contact of a disc: overlap over the smaller radius, and with whom (-1: a wall).
struct Deepest {
  double share = 0;
  int other = -2;  ///< none
};

Deepest deepest_contact(Assembly const& assembly, Discs const& discs, int i) {
  Deepest deepest;
  auto const take = [&](double overlap, double smaller, int other) {
    if (overlap / smaller > deepest.share) deepest = {overlap / smaller, other};
  };
  ContactRows const& rows = assembly.rows;
  auto const start = host_copy(rows.slice_start);
  auto const length = host_copy(rows.length);
  auto const neighbour = host_copy(rows.neighbour);
  auto const a = static_cast<std::size_t>(i);
  for (int k = 0; k < length(a); ++k) {
    auto const b = static_cast<std::size_t>(neighbour(entry_in(start, rows.features.format, i, k)));
    if (b >= discs.x.size()) continue;
    double const distance = std::hypot(discs.x[b] - discs.x[a], discs.y[b] - discs.y[a]);
    take(discs.radius[a] + discs.radius[b] - distance, std::min(discs.radius[a], discs.radius[b]), discs.id[b]);
  }
  if (assembly.periodic()) return deepest;
  for (int wall = 0; wall < wall_count; ++wall)
    take(discs.radius[a] - wall_face(assembly.walls(), wall, discs.x[a], discs.y[a]).distance, discs.radius[a], -1);
  return deepest;
}

/// Of discs with too many neighbours: a skin that lists far more than touch, or discs of too different sizes.
std::string advice_on_rows(double skin, double d50) {
  constexpr double wide = 2 * chosen_skin;
  if (d50 > 0 && skin > wide * d50)
    return printed_text("give a smaller run.verlet_skin, or none: %.3g mm are %.3g of d50, where %g are usual", skin * 1e3,
                        skin / d50, chosen_skin);
  return printed_text("a particle can have %d: make the grading's largest particle smaller, or its smallest larger", longest_row);
}

std::string advice(Fault what, double share) {
  if (share > 1) return "shorten the step (run.time_step_safety)";
  if (what == Fault::not_finite) return "the step is not why: look at what was read or set before";
  return "the step is not why: the grains are too soft for this stress (grains.normal_stiffness), or it is loaded too fast "
         "(test.inertial_number)";
}

}  // namespace

std::string fault_text(Assembly const& assembly, ReportedFault const& fault, double (&place)[2]) {
  static constexpr char const* cause[fault_count] = {"has a position or velocity that is not finite",
                                                     "overlaps a neighbour or a wall by more than the smaller radius",
                                                     "has more neighbours than a row holds"};
  Ranks const& ranks = assembly.ranks();
  Discs const discs(assembly.particles);
  double found[4] = {nowhere, nowhere, nowhere, nowhere};  // where, overlap, with whom: of the rank that owns the disc
  std::int64_t lost = 0;
  for (int i = 0; i < discs.owned; ++i) {
    lost += discs.finite(i) ? 0 : 1;
    if (discs.id[static_cast<std::size_t>(i)] != fault.id) continue;
    auto const k = static_cast<std::size_t>(i);
    bool const placed = discs.placed(i);
    found[0] = placed ? discs.x[k] : discs.reference_x[k];
    found[1] = placed ? discs.y[k] : discs.reference_y[k];
    Deepest const deepest = placed ? deepest_contact(assembly, discs, i) : Deepest{};
    found[2] = deepest.share;
    found[3] = deepest.other;
  }
  ranks.max(found, 4);
  lost = ranks.sum(lost);
  place[0] = found[0];
  place[1] = found[1];
  double const share = assembly.now.orders.dt / assembly.stable_limit();
  std::string text = printed_text("step %lld, time %g s: particle %d %s", static_cast<long long>(assembly.steps()),
                                  assembly.time(), fault.id, cause[static_cast<int>(fault.what)]);
  if (fault.last_good < assembly.steps())
    text += printed_text(", since a step after %lld", static_cast<long long>(fault.last_good));
  text += printed_text("; it is at (%.6g, %.6g) mm", place[0] * 1e3, place[1] * 1e3);
  if (lost > 1) text += printed_text(", %lld particles are like it", static_cast<long long>(lost));
  if (found[3] >= 0)
    text += printed_text("; its deepest contact, with particle %d, overlaps by %.3g of the smaller radius",
                         static_cast<int>(found[3]), found[2]);
  if (found[3] == -1) text += printed_text("; it is %.3g of its radius deep in a wall", found[2]);
  if (std::isfinite(share) && share > 1e-6)
    text += printed_text("; the time step is %.3g of the stable limit of the present contacts", share);
  return text + ": " +
         (fault.what == Fault::row_overflow ? advice_on_rows(assembly.upkeep.skin(), assembly.facts.d50)
                                            : advice(fault.what, share));
}

}  // namespace clathra
