#pragma once
/// What becomes of bonds when their hydrate changes between steps: they get narrower, stronger or weaker, or leave. Nothing of
/// it is in the step.
///
/// Material that leaves takes its stress along: F_n = k_bn (u_n - u_0) with the k_bn of the new width B, and F_s and M fall as
/// k_bs and k_bm do. A bond leaves, in the mode `dissolved`, where the hydrate no longer spans its gap (h_max <= h_cr) or has no
/// strength left (R_t <= 0 or R_c <= 0).
#include "kernels/exact_sum.hpp"
#include "kernels/forces.hpp"
#include "kernels/measures.hpp"

namespace clathra {

/// Half the sum of |F_n| times the length of the branch over the bonds that a law would let leave [N]: over the area what they
/// carry of p. @param laws  that the bonds have followed so far;  @param next  of the hydrate as it would be
Real force_of_leaving_bonds(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, BondLaw const& next,
                            Summation const& sums);

/// Brings the histories of bonds from one law to the next and takes away those that leave. Widths are set by prepare_rows().
/// @param rows  whose fields hold the forces and moments themselves (with_forces());  @param step  number of the last one
void change_bonds(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, BondLaw const& next,
                  BreakLog const& breaks, std::int64_t step);

}  // namespace clathra
