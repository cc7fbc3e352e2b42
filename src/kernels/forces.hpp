#pragma once
/// Contact and bond forces of all discs: the hot kernel.
#include "kernels/bond_law.hpp"
#include "kernels/contacts.hpp"
#include "kernels/reports.hpp"
#include "kernels/step_graph.hpp"
#include "kernels/step_state.hpp"

namespace clathra {

/// Which bond code a specimen runs. `none` launches none.
enum class BondKind : std::int8_t { none, replace, parallel };

struct ContactLaws {
  GrainLaw grain;
  BondLaw bond;
  BondKind bond_kind = BondKind::none;
  bool ledger = false;
};

/// Derives what the rows keep beside the history. To be called after a neighbour search and whenever history or law changed.
void prepare_rows(ParticleSoA const& particles, ContactRows& rows, BondLaw const& law);

/// compute_forces() in one precision.
template <class P>
void compute_forces_in(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, Real dt, std::int64_t step,
                       BreakLog const& breaks, Dissipation const& losses, Faults const& faults, Field<StepState> const& steps,
                       StepLaunches const& launches);

/// Sets force and torque of every owned disc from its contacts and bonds, advances their history by one step of length `dt` [s],
/// and breaks bonds. Each disc sums its own row; both sides of a pair get exact opposites, so no atomics touch a force.
/// @param losses  written only with `laws.ledger`;  @param step  number noted with broken bonds, where there are no `steps`
/// @param steps  under way; nothing happens while they are stopped;  @param launches  where the kernel goes
void compute_forces(ParticleSoA const& particles, ContactRows const& rows, ContactLaws const& laws, Real dt, std::int64_t step,
                    BreakLog const& breaks, Dissipation const& losses, Faults const& faults, Field<StepState> const& steps = {},
                    StepLaunches const& launches = {});

}  // namespace clathra
