#pragma once
/// What rows keep of a history, shear force or moment, and what it comes to in a step.
///
/// Double precision keeps the force itself, a sum of what steps add. Mixed precision keeps the force at the reference
/// (reference_configuration.hpp), and a mark where a pair has none: it does not touch.
#include "kernels/particles.hpp"
#include "kernels/reference_configuration.hpp"

namespace clathra {

template <class P>
struct HistoryOf {
  using R = typename P::Real;
  using V = LanesOf<R>;
  using VMask = MaskOf<V>;
  static constexpr bool mixed = P::precision == Precision::mixed;

  /// Of a pair that remembers nothing.
  static constexpr R none = mixed ? R(no_bond_single) : R(0);
  KOKKOS_FORCEINLINE_FUNCTION static VMask is_none(V const& kept) { return kept == V(none); }

  /// One history of a block of entries in the step under way.
  struct Force {
    V trial;      ///< if nothing slips
    V now;        ///< in fact
    V stiffness;  ///< of what carries it now
  };

  KOKKOS_FORCEINLINE_FUNCTION static V read(RealField const& field, std::size_t e) { return load(field.data<R>() + e); }

  /// The force if nothing slips.
  /// @param way  during the step; in mixed precision since the reference;  @param none  pairs that remember nothing, where there
  /// may be
  template <class Stiffness, class... None>
  KOKKOS_FORCEINLINE_FUNCTION static V trial(V const& kept, Stiffness const& stiffness, V const& way, None const&... none) {
    if constexpr (!mixed)
      return kept + stiffness * way;
    else if constexpr (sizeof...(None) == 0)
      return multiply_add(V(stiffness), way, kept);
    else
      return multiply_add_where(!(none, ...), V(stiffness), way, kept);
  }

  /// What is kept after the step: in mixed precision less by what has slipped.
  KOKKOS_FORCEINLINE_FUNCTION static V after(V const& kept, Force const& force) {
    if constexpr (mixed)
      return kept - (force.trial - force.now);
    else
      return force.now;
  }
};

}  // namespace clathra
