#pragma once
/// How the contact kernel reads what rows keep of contacts and bonds.
#include "kernels/contacts.hpp"
#include "kernels/reference_configuration.hpp"

namespace clathra {

/// @tparam P  FullPrecision or MixedPrecision
/// @tparam Shears,Moments  which histories grain contacts, or bonds in their place, have;  @tparam Bonds,Separate  whether there
/// are bonds, and such with histories of their own
template <class P, bool Shears, bool Moments, bool Bonds, bool Separate>
struct RowHistory {
  using R = typename P::Real;
  using V = LanesOf<R>;
  static constexpr bool references = P::precision == Precision::mixed && (Shears || Separate);

  V shear, moment, formation_overlap, width, bond_shear, bond_moment;

  KOKKOS_FORCEINLINE_FUNCTION static RowHistory read(ContactRows const& rows, std::size_t e) {
    auto const kept = [e](RealField const& field) { return load(field.data<R>() + e); };
    RowHistory h{V(0), V(0), V(no_bond_of<R>), V(0), V(0), V(0)};
    if constexpr (Shears) h.shear = kept(rows.shear);
    if constexpr (Moments) h.moment = kept(rows.moment);
    if constexpr (Bonds) {
      h.formation_overlap = kept(rows.formation_overlap);
      h.width = kept(rows.width);
    }
    if constexpr (Separate) {
      h.bond_shear = kept(rows.bond_shear);
      h.bond_moment = kept(rows.bond_moment);
    }
    return h;
  }

  /// How many blocks of entries ahead they are fetched: some two groups of discs. Where rows do not fit into the caches, a
  /// processor that is left to find out by itself what is read next waits for it in a third of its time.
  static constexpr int blocks_ahead = 16;
  KOKKOS_FORCEINLINE_FUNCTION static std::size_t ahead_of(std::size_t e) {
    return e + static_cast<std::size_t>(blocks_ahead * slice_width_of<R>);
  }
  /// Only asks for memory: an address past the end does no harm.
  KOKKOS_FORCEINLINE_FUNCTION static void fetch_ahead(ContactRows const& rows, std::size_t e) {
    std::size_t const at = ahead_of(e);
    if constexpr (Shears) prefetch(rows.shear.data<R>() + at);
    if constexpr (Moments) prefetch(rows.moment.data<R>() + at);
    if constexpr (Bonds) {
      prefetch(rows.formation_overlap.data<R>() + at);
      prefetch(rows.width.data<R>() + at);
    }
    if constexpr (Separate) {
      prefetch(rows.bond_shear.data<R>() + at);
      prefetch(rows.bond_moment.data<R>() + at);
    }
    if constexpr (references) prefetch(rows.reference_branch.data<std::int32_t>() + at);
  }
  KOKKOS_FORCEINLINE_FUNCTION static int const* neighbours(ContactRows const& rows, std::size_t e) {
    int const* const j = rows.neighbour.data() + e;
    prefetch(rows.neighbour.data() + ahead_of(e));
    return j;
  }
};

}  // namespace clathra
