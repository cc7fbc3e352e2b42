#pragma once
/// What the contact kernel is specialised on, and the types and switches that follow from it: for the kernel and its histories.
#include "kernels/contact_constants.hpp"
#include "kernels/pair_motion.hpp"
#include "kernels/row_history.hpp"

namespace clathra {

/// @tparam P  FullPrecision or MixedPrecision;  @tparam GrainShear  false where grain contacts carry no shear
/// @tparam HasLosses  whether there are dashpots or an energy ledger; which of them a branch finds that goes one way in a whole
/// launch
template <class P, BondKind Kind, bool GrainShear, bool GrainRolling, bool HasLosses>
struct KernelVariant {
  using Numbers = P;
  using R = typename P::Real;
  using V = LanesOf<R>;
  using VMask = MaskOf<V>;
  static constexpr bool mixed = P::precision == Precision::mixed;
  static constexpr BondKind Bond = Kind;
  static constexpr bool Rolling = GrainRolling, Losses = HasLosses;
  static constexpr bool bonded_code = Bond != BondKind::none;
  static constexpr bool shears = GrainShear || Bond == BondKind::replace;  // has a history of `shear`
  static constexpr bool moments = Rolling || bonded_code;
  static constexpr bool separate = Bond == BondKind::parallel;
  static constexpr bool slips = shears || separate,
                        rolls = moments && (Rolling || !separate);  // of `shear` or `bond_shear`; of `moment`
  using Constants = ContactConstants<R>;
  using Discs = DiscReader<P, !mixed || Losses, Losses>;
  using History = RowHistory<P, shears, moments, bonded_code, separate>;
  using StepIncrement = IncrementOfStep<V>;

  /// One history of a block of entries in the step under way.
  struct Force {
    V trial;      ///< if nothing slips
    V now;        ///< in fact
    V stiffness;  ///< of what carries it now
  };
  /// What the histories of a block come to.
  struct Forces {
    Force shear, moment, bond_shear, bond_moment;
  };
  /// How the discs of a block of pairs stand.
  struct Pairs {
    V dx, dy, distance, reach;           ///< branches and distances in what DiscReader counts in, sums of radii [m]
    V nx, ny, arm, other_arm;            ///< unit normals [1], lever arms [m]
    V inverse_distance2, inverse_reach;  ///< mixed precision
  };
  /// The masks of ContactKernel::add_block() that the end of a step goes by.
  struct Outcome {
    VMask none, touching, intact, broken, carrying;
  };
};

}  // namespace clathra
