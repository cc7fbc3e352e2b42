#pragma once
/// What kinds of bonds there are, and the mark of none: for scenes, specimens and files as well as for kernels.
#include <cstdint>

namespace clathra {

/// What becomes of a bonded contact's grains (docs/explanation/model.md). `replaces`: the bond carries all. `parallel`: bond and
/// grain contact carry beside each other. `replaces_keeping_force`: the bond carries all and goes on from the grain contact's
/// force.
enum class ContactCoupling : std::int8_t { replaces, parallel, replaces_keeping_force };

/// Stands for the overlap at bond formation u_0 [m] where there is no bond; overlaps above half of it mean none.
inline constexpr double no_bond = 1e300;
inline constexpr float no_bond_single = 1e20F;  ///< the same mark where the overlap is kept in single precision

}  // namespace clathra
