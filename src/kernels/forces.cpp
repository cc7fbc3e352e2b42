#include "kernels/forces.hpp"

#include <variant>

#include "kernels/contact_kernel.hpp"

namespace clathra {

namespace {

template <BondKind Bond>
using BondAxis = std::integral_constant<BondKind, Bond>;
using AnyBond = std::variant<BondAxis<BondKind::none>, BondAxis<BondKind::replace>, BondAxis<BondKind::parallel>>;
using AnySwitch = std::variant<std::false_type, std::true_type>;
static_assert(std::variant_size_v<AnyBond> * 2 * 2 * 2 * 2 <= 48,
              "the contact kernel is specialised on few axes; add a term to a law, not an axis to the kernel");

AnyBond bond_axis(BondKind kind) {
  switch (kind) {
    case BondKind::replace:
      return BondAxis<BondKind::replace>{};
    case BondKind::parallel:
      return BondAxis<BondKind::parallel>{};
    default:
      return BondAxis<BondKind::none>{};
  }
}

AnySwitch on(bool yes) {
  if (yes) return std::true_type{};
  return std::false_type{};
}

struct SetBondWidths {
  ParticleSoA p;
  ContactRows rows;
  BondLaw law;
  KOKKOS_FUNCTION void operator()(int slot) const {
    int const slice = slot / slice_width, used = slot < p.owned ? rows.length(slot) : 0;
    for (int k = 0; k < rows.slice_start(slice + 1) - rows.slice_start(slice); ++k) {
      std::size_t const e = rows.entry(slot, k);
      bool const bonded = k < used && is_bonded(rows.formation_overlap(e));
      rows.width(e) =
          bonded ? law.width_formed_at(common_radius(p.radius(slot), p.radius(rows.neighbour(e))), rows.formation_overlap(e)) : 0;
    }
  }
};

}  // namespace

void prepare_rows(ParticleSoA const& particles, ContactRows& rows, BondLaw const& law) {
  auto const groups = static_cast<std::size_t>(group_count(particles.owned));
  if (rows.active.extent(0) != groups) rows.active = uninitialised<std::uint64_t>("active", groups);
  Kokkos::deep_copy(rows.active, ~std::uint64_t(0));
  if (!rows.features.bonds) {
    rows.width = Field<Real>();
    return;
  }
  if (rows.width.extent(0) != rows.formation_overlap.extent(0)) {
    rows.width = Field<Real>();
    rows.width = uninitialised<Real>("width", rows.formation_overlap.extent(0));
  }
  int const slots = slice_count(particles.owned) * slice_width;
  Kokkos::parallel_for("set_bond_widths", Kokkos::RangePolicy<ExecutionSpace>(0, slots), SetBondWidths{particles, rows, law});
}

void compute_forces(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, Real dt, std::int64_t step,
                    BreakLog const& breaks, EnergyLosses const& losses, Faults const& faults) {
  Kokkos::RangePolicy<ExecutionSpace> const groups(0, group_count(particles.owned));
  std::visit(
      [&](auto bond, auto friction, auto rolling, auto dashpot, auto ledger) {
        constexpr bool shears = friction() || bond() == BondKind::replace;  // one kernel where the bond needs the history
        ContactKernel<bond(), shears, rolling(), dashpot(), ledger()> const kernel{
            particles, rows, {laws.grain, laws.bond, least_strength(laws.bond), dt}, step, breaks, losses, faults};
        Kokkos::parallel_for(kernel.bonded_code ? "contact_forces_bonded" : "contact_forces", groups, kernel);
      },
      bond_axis(laws.bond_kind), on(rows.features.shear), on(rows.features.rolling), on(laws.grain.damping_ratio > 0),
      on(laws.ledger));
}

}  // namespace clathra
