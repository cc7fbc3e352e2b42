#include "kernels/contact_dispatch.hpp"

namespace clathra {

template void compute_forces_in<MixedPrecision>(ParticleSoA const&, ContactRows const&, ContactLaws const&, Real, std::int64_t,
                                                BreakLog const&, Dissipation const&, Faults const&, Field<StepState> const&,
                                                StepLaunches const&);

}  // namespace clathra
