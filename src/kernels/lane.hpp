#pragma once
/// The lane type: laws and kernels are written once on `Lanes` and become SIMD vectors on a CPU (one disc a lane) and plain
/// numbers on a GPU (one disc a thread). Every operation is exact IEEE arithmetic lane by lane: the width never changes a bit.
#include <Kokkos_Core.hpp>
#include <cmath>

#include "kernels/real.hpp"

// With Clang and AVX-512 a masked choice of libstdc++ takes all lanes from one side (so says a FIXME in its _S_blend_avx512).
#if !defined(CLATHRA_SCALAR_LANES) && !defined(KOKKOS_ENABLE_CUDA) && !defined(KOKKOS_ENABLE_HIP) && \
    !defined(KOKKOS_ENABLE_SYCL) && !(defined(__clang__) && defined(__AVX512F__)) && __has_include(<experimental/simd>)
#define CLATHRA_SIMD 1
#include <experimental/simd>
#endif

/// A function that is rarely called, kept out of the code around the call so that its arguments need no memory there.
#ifdef CLATHRA_SIMD
#define CLATHRA_COLD_FUNCTION [[gnu::noinline, gnu::cold]] KOKKOS_FUNCTION
#else
#define CLATHRA_COLD_FUNCTION KOKKOS_FUNCTION
#endif

namespace clathra {

// The scalar instance of the vocabulary: `double` is a lane of width one, `bool` its mask.
KOKKOS_FORCEINLINE_FUNCTION Real select(bool mask, Real yes, Real no) { return mask ? yes : no; }
KOKKOS_FORCEINLINE_FUNCTION bool any(bool mask) { return mask; }
/// Calls visit(l) for each lane l of the mask that is set, in order.
template <class Visit>
KOKKOS_FORCEINLINE_FUNCTION void for_each_set(bool mask, Visit const& visit) {
  if (mask) visit(0);
}
KOKKOS_FORCEINLINE_FUNCTION Real lane_sqrt(Real a) { return std::sqrt(a); }
KOKKOS_FORCEINLINE_FUNCTION Real lane_abs(Real a) { return std::fabs(a); }
// Of equal zeros, and beside a NaN, the second operand counts: written so, either is one instruction with the same bits in
// scalars and in vectors.
KOKKOS_FORCEINLINE_FUNCTION Real lane_max(Real a, Real b) { return a > b ? a : b; }
KOKKOS_FORCEINLINE_FUNCTION Real lane_min(Real a, Real b) { return a < b ? a : b; }

#ifdef CLATHRA_SIMD
namespace stdx = std::experimental;
using Lanes = stdx::native_simd<Real>;
using Mask = Lanes::mask_type;
inline constexpr int lane_count = static_cast<int>(Lanes::size());
/// The compiler's own vector, for what std::experimental::simd leaves open (and does differ on): min and max of zeros and NaN.
using PlainVector [[gnu::vector_size(sizeof(Lanes))]] = Real;

KOKKOS_FORCEINLINE_FUNCTION Lanes select(Mask const& mask, Lanes const& yes, Lanes const& no) {
  Lanes result = no;
  stdx::where(mask, result) = yes;
  return result;
}
KOKKOS_FORCEINLINE_FUNCTION bool any(Mask const& mask) { return stdx::any_of(mask); }
template <class Visit>
KOKKOS_FORCEINLINE_FUNCTION void for_each_set(Mask mask, Visit const& visit) {
  while (stdx::any_of(mask)) {
    int const l = stdx::find_first_set(mask) & (lane_count - 1);  // so that GCC sees it within the lanes
    visit(l);
    mask[static_cast<std::size_t>(l)] = false;
  }
}
KOKKOS_FORCEINLINE_FUNCTION Lanes lane_sqrt(Lanes const& a) { return stdx::sqrt(a); }
KOKKOS_FORCEINLINE_FUNCTION Lanes lane_abs(Lanes const& a) { return stdx::abs(a); }
#if defined(__AVX512F__)  // GCC makes a comparison and a choice of the general form where one side is a constant
KOKKOS_FORCEINLINE_FUNCTION Lanes lane_max(Lanes const& a, Lanes const& b) {
  auto const x = static_cast<PlainVector>(a), y = static_cast<PlainVector>(b);
  return Lanes(PlainVector(_mm512_mask_max_pd(x, 0xff, x, y)));
}
KOKKOS_FORCEINLINE_FUNCTION Lanes lane_min(Lanes const& a, Lanes const& b) {
  auto const x = static_cast<PlainVector>(a), y = static_cast<PlainVector>(b);
  return Lanes(PlainVector(_mm512_mask_min_pd(x, 0xff, x, y)));
}
#else
KOKKOS_FORCEINLINE_FUNCTION Lanes lane_max(Lanes const& a, Lanes const& b) {
  auto const x = static_cast<PlainVector>(a), y = static_cast<PlainVector>(b);
  return Lanes(x > y ? x : y);
}
KOKKOS_FORCEINLINE_FUNCTION Lanes lane_min(Lanes const& a, Lanes const& b) {
  auto const x = static_cast<PlainVector>(a), y = static_cast<PlainVector>(b);
  return Lanes(x < y ? x : y);
}
#endif
KOKKOS_FORCEINLINE_FUNCTION Lanes load(Real const* from) { return Lanes(from, stdx::element_aligned); }
KOKKOS_FORCEINLINE_FUNCTION void store(Real* to, Lanes const& value) { value.copy_to(to, stdx::element_aligned); }
/// From and to single precision.
KOKKOS_FORCEINLINE_FUNCTION Lanes load_float(float const* from) { return Lanes(from, stdx::element_aligned); }
KOKKOS_FORCEINLINE_FUNCTION void store_float(float* to, Lanes const& value) { value.copy_to(to, stdx::element_aligned); }
KOKKOS_FORCEINLINE_FUNCTION Real lane(Lanes const& value, int l) { return value[static_cast<std::size_t>(l)]; }
KOKKOS_FORCEINLINE_FUNCTION bool lane(Mask const& mask, int l) { return mask[static_cast<std::size_t>(l)]; }
KOKKOS_FORCEINLINE_FUNCTION void set_lane(Lanes& value, int l, Real to) { value[static_cast<std::size_t>(l)] = to; }
KOKKOS_FORCEINLINE_FUNCTION void set_lane(Mask& mask, int l, bool to) { mask[static_cast<std::size_t>(l)] = to; }
KOKKOS_FORCEINLINE_FUNCTION Real largest(Lanes const& value) { return stdx::hmax(value); }
/// The mask of the lanes 0 .. count - 1.
KOKKOS_FORCEINLINE_FUNCTION Mask first_lanes(int count) {
  return Lanes([](auto l) { return Real(l); }) < Lanes(count);
}
/// Writes from[l] of all lanes l that are set side by side to `to`, in order; what stands behind them, up to to[lane_count - 1],
/// may be overwritten.
/// @return how many are set
#if defined(__AVX512VL__)  // by one instruction instead of branches that nothing foresees
KOKKOS_FORCEINLINE_FUNCTION int pack_set(Mask const& mask, int const* from, int* to) {
  static_assert(lane_count == 8);
  auto const bits = static_cast<__mmask8>(stdx::__data(mask));
  _mm256_storeu_si256(reinterpret_cast<__m256i_u*>(to),
                      _mm256_maskz_compress_epi32(bits, _mm256_loadu_si256(reinterpret_cast<__m256i_u const*>(from))));
  return __builtin_popcount(bits);
}
#else
KOKKOS_FORCEINLINE_FUNCTION int pack_set(Mask const& mask, int const* from, int* to) {
  int count = 0;
  for_each_set(mask, [&](int l) { to[count++] = from[l]; });
  return count;
}
#endif
/// Asks for a value that will be loaded soon.
KOKKOS_FORCEINLINE_FUNCTION void prefetch(Real const* from) { __builtin_prefetch(from); }
/// The values of a field at the discs named by `index[0 .. lane_count)`.
KOKKOS_FORCEINLINE_FUNCTION Lanes gather(Real const* field, int const* index) {
  return Lanes([&](auto l) { return field[index[l]]; });
}
#else
using Lanes = Real;
using Mask = bool;
inline constexpr int lane_count = 1;

KOKKOS_FORCEINLINE_FUNCTION Real load(Real const* from) { return *from; }
KOKKOS_FORCEINLINE_FUNCTION void store(Real* to, Real value) { *to = value; }
KOKKOS_FORCEINLINE_FUNCTION Real load_float(float const* from) { return *from; }
KOKKOS_FORCEINLINE_FUNCTION void store_float(float* to, Real value) { *to = static_cast<float>(value); }
KOKKOS_FORCEINLINE_FUNCTION Real lane(Real value, int) { return value; }
KOKKOS_FORCEINLINE_FUNCTION bool lane(bool mask, int) { return mask; }
KOKKOS_FORCEINLINE_FUNCTION void set_lane(Real& value, int, Real to) { value = to; }
KOKKOS_FORCEINLINE_FUNCTION void set_lane(bool& mask, int, bool to) { mask = to; }
KOKKOS_FORCEINLINE_FUNCTION Real largest(Real value) { return value; }
KOKKOS_FORCEINLINE_FUNCTION bool first_lanes(int count) { return count > 0; }
KOKKOS_FORCEINLINE_FUNCTION int pack_set(bool mask, int const* from, int* to) {
  if (mask) *to = *from;
  return mask ? 1 : 0;
}
KOKKOS_FORCEINLINE_FUNCTION void prefetch(Real const*) {}
KOKKOS_FORCEINLINE_FUNCTION Real gather(Real const* field, int const* index) { return field[*index]; }
#endif

/// Discs whose rows lie side by side in memory (contacts.hpp): a multiple of `lane_count`. Nobody's bits know it.
#ifdef CLATHRA_SLICE_WIDTH
inline constexpr int slice_width = CLATHRA_SLICE_WIDTH;
#elif defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(KOKKOS_ENABLE_SYCL)
inline constexpr int slice_width = 32;  // the threads that load together
#else
inline constexpr int slice_width = lane_count;
#endif
static_assert(slice_width % lane_count == 0, "a slice holds whole groups of lanes");

/// `value` clamped to [-limit, limit]; limit >= 0. Odd in `value` even at limit 0, so both sides of a pair get exact
/// opposites. What comes of a NaN depends on the machine: integrate() finds the motion that made it.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L clamp_to(L const& value, L const& limit) {
  return lane_max(-limit, lane_min(limit, value));
}
#if defined(CLATHRA_SIMD) && defined(__AVX512DQ__)
/// The same bits by one instruction: the smaller magnitude with the sign of `value`.
KOKKOS_FORCEINLINE_FUNCTION Lanes clamp_to(Lanes const& value, Lanes const& limit) {
  return Lanes(PlainVector(_mm512_range_pd(static_cast<PlainVector>(value), static_cast<PlainVector>(limit), 2)));
}
#endif

}  // namespace clathra
