#pragma once
/// From what the laws ask for to the contact kernel that does it, in one precision. Included once a precision, by forces_full.cpp
/// and forces_mixed.cpp: each compiles all its kernels.
#include <variant>

#include "kernels/contact_kernel.hpp"

namespace clathra {

template <BondKind Bond>
using BondAxis = std::integral_constant<BondKind, Bond>;
using AnyBond = std::variant<BondAxis<BondKind::none>, BondAxis<BondKind::replace>, BondAxis<BondKind::parallel>>;
using AnySwitch = std::variant<std::false_type, std::true_type>;
static_assert(std::variant_size_v<AnyBond> * 2 * 2 * 2 <= 24,
              "the contact kernel is specialised on few axes; add a term to a law, not an axis to the kernel");

inline AnyBond bond_axis(BondKind kind) {
  switch (kind) {
    case BondKind::replace:
      return BondAxis<BondKind::replace>{};
    case BondKind::parallel:
      return BondAxis<BondKind::parallel>{};
    default:
      return BondAxis<BondKind::none>{};
  }
}

inline AnySwitch on(bool yes) {
  if (yes) return std::true_type{};
  return std::false_type{};
}

/// @tparam P  FullPrecision or MixedPrecision
template <class P>
void compute_forces_in(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, Real dt, std::int64_t step,
                       BreakLog const& breaks, Dissipation const& losses, Faults const& faults, Field<StepState> const& steps,
                       StepLaunches const& launches) {
  using R = typename P::Real;
  ContactConstants<R> const constants = constants_in<R>(laws, dt, particles.mirror.tick);
  int const groups = group_count(particles.owned, lane_count_of<R>);
  std::visit(
      [&](auto bond, auto friction, auto rolling, auto losing) {
        constexpr bool shears = friction() || bond() == BondKind::replace;  // one kernel where the bond needs the history
        using Kernel = ContactKernel<KernelVariant<P, bond(), shears, rolling(), losing()>>;
        launches.parallel_for(Kernel::bonded_code ? "contact_forces_bonded" : "contact_forces", groups, uncounted([&] {
                                return Kernel{particles, rows,   constants, laws.bond, step,
                                              steps,     breaks, losses,    faults,    discs_ahead(particles.owned)};
                              }));
      },
      bond_axis(laws.bond_kind), on(rows.features.shear), on(rows.features.rolling),
      on(laws.grain.damping_ratio > 0 || laws.ledger));
}

}  // namespace clathra
