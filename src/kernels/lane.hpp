#pragma once
/// The lane type: laws and kernels are written once on `Lanes` and become SIMD vectors on a CPU (one disc a lane) and plain
/// numbers on a GPU (one disc a thread). Every operation is exact IEEE arithmetic lane by lane: the width never changes a bit.
/// Products and sums are fused where multiply_add() says so, and nowhere else. With CLATHRA_UNFUSED nothing asks for a fused
/// operation: the test no_fma compiles the kernels so, and whatever fused instruction is left is one that the compiler made up.
#include <Kokkos_Core.hpp>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "kernels/real.hpp"

// With Clang and AVX-512 a masked choice of libstdc++ takes all lanes from one side (so says a FIXME in its _S_blend_avx512).
#if !defined(CLATHRA_DEVICE_LIKE) && !defined(KOKKOS_ENABLE_CUDA) && !defined(KOKKOS_ENABLE_HIP) && \
    !defined(KOKKOS_ENABLE_SYCL) && !(defined(__clang__) && defined(__AVX512F__)) && __has_include(<experimental/simd>)
#define CLATHRA_SIMD 1
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wuninitialized"  // of GCC 12's own header of AVX-512, which has results that it leaves undefined
#include <experimental/simd>
#pragma GCC diagnostic pop
#endif

/// A function that is rarely called, kept out of the code around the call so that its arguments need no memory there.
#ifdef CLATHRA_SIMD
#define CLATHRA_COLD_FUNCTION [[gnu::noinline, gnu::cold]] KOKKOS_FUNCTION
#else
#define CLATHRA_COLD_FUNCTION KOKKOS_FUNCTION
#endif

namespace clathra {

#ifdef CLATHRA_UNFUSED
inline constexpr bool may_fuse = false;
#else
inline constexpr bool may_fuse = true;
#endif

/// The vector of numbers R that the machine works on side by side, or one number.
#ifdef CLATHRA_SIMD
namespace stdx = std::experimental;
template <class R>
using LanesOf = stdx::native_simd<R>;
template <class R>
inline constexpr int lane_count_of = static_cast<int>(LanesOf<R>::size());
#else
template <class R>
using LanesOf = R;
template <class R>
inline constexpr int lane_count_of = 1;
#endif
using Lanes = LanesOf<Real>;
using FloatLanes = LanesOf<float>;
template <class L>
using MaskOf = decltype(std::declval<L>() < std::declval<L>());
using Mask = MaskOf<Lanes>;
inline constexpr int lane_count = lane_count_of<Real>;

/// The number type of a lane type, one number being a lane of width one.
template <class L>
struct ScalarOf {
  using Type = L;
};
#ifdef CLATHRA_SIMD
template <class R, class Abi>
struct ScalarOf<stdx::simd<R, Abi>> {
  using Type = R;
};
#endif
template <class L>
using scalar_of = typename ScalarOf<L>::Type;

/// A number of the equations, in the precision of the lanes.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION constexpr L constant(double value) {
  return L(static_cast<scalar_of<L>>(value));
}
/// A divisor that stands for zero: above 0, far below whatever is measured in SI units, and its square is a number still.
template <class R>
inline constexpr R least_divisor = static_cast<R>(sizeof(R) == sizeof(double) ? 1e-300 : 1e-35);

// The scalar instance of the vocabulary: a number is a lane of width one, `bool` its mask.
KOKKOS_FORCEINLINE_FUNCTION double select(bool mask, double yes, double no) { return mask ? yes : no; }
KOKKOS_FORCEINLINE_FUNCTION float select(bool mask, float yes, float no) { return mask ? yes : no; }
KOKKOS_FORCEINLINE_FUNCTION bool any(bool mask) { return mask; }
/// Calls visit(l) for each lane l of the mask that is set, in order.
CLATHRA_OF_THE_CALLERS_SIDE
template <class Visit>
KOKKOS_FORCEINLINE_FUNCTION void for_each_set(bool mask, Visit const& visit) {
  if (mask) visit(0);
}
KOKKOS_FORCEINLINE_FUNCTION double lane_sqrt(double a) { return std::sqrt(a); }
KOKKOS_FORCEINLINE_FUNCTION float lane_sqrt(float a) { return std::sqrt(a); }
KOKKOS_FORCEINLINE_FUNCTION double lane_abs(double a) { return std::fabs(a); }
KOKKOS_FORCEINLINE_FUNCTION float lane_abs(float a) { return std::fabs(a); }
/// Towards zero to the next whole number.
KOKKOS_FORCEINLINE_FUNCTION double lane_truncate(double a) { return std::trunc(a); }
/// The sum of all lanes, in no particular order.
KOKKOS_FORCEINLINE_FUNCTION double sum_of_lanes(double a) { return a; }
KOKKOS_FORCEINLINE_FUNCTION int count_set(bool mask) { return mask ? 1 : 0; }
/// The size of `a` with the sign of `b`.
KOKKOS_FORCEINLINE_FUNCTION double lane_copysign(double a, double b) { return std::copysign(a, b); }
KOKKOS_FORCEINLINE_FUNCTION float lane_copysign(float a, float b) { return std::copysign(a, b); }
// Of equal zeros, and beside a NaN, the second operand counts: written so, either is one instruction with the same bits in
// scalars and in vectors.
KOKKOS_FORCEINLINE_FUNCTION double lane_max(double a, double b) { return a > b ? a : b; }
KOKKOS_FORCEINLINE_FUNCTION float lane_max(float a, float b) { return a > b ? a : b; }
KOKKOS_FORCEINLINE_FUNCTION double lane_min(double a, double b) { return a < b ? a : b; }
KOKKOS_FORCEINLINE_FUNCTION float lane_min(float a, float b) { return a < b ? a : b; }

/// a b + c: in double precision rounded twice, in single precision once, which is one operation instead of two where vectors are
/// all that a processor is busy with. A processor without it (x86 before 2013, cheap ones later) calls the library's, number by
/// number.
KOKKOS_FORCEINLINE_FUNCTION double multiply_add(double a, double b, double c) { return a * b + c; }
KOKKOS_FORCEINLINE_FUNCTION float multiply_add(float a, float b, float c) { return may_fuse ? ::fmaf(a, b, c) : a * b + c; }
/// multiply_add() where the mask is set, else 0.
KOKKOS_FORCEINLINE_FUNCTION float multiply_add_where(bool mask, float a, float b, float c) {
  return mask ? multiply_add(a, b, c) : 0;
}
/// a b + c rounded once, of double precision too: in what mixed precision alone computes.
KOKKOS_FORCEINLINE_FUNCTION double fused_multiply_add(double a, double b, double c) {
  return may_fuse ? ::fma(a, b, c) : a * b + c;
}
/// c - a b, as multiply_add().
KOKKOS_FORCEINLINE_FUNCTION double negative_multiply_add(double a, double b, double c) { return c - a * b; }
KOKKOS_FORCEINLINE_FUNCTION float negative_multiply_add(float a, float b, float c) {
  return may_fuse ? ::fmaf(-a, b, c) : c - a * b;
}

#ifdef CLATHRA_SIMD
template <class R, class Abi>
using Simd = stdx::simd<R, Abi>;
/// The compiler's own vector, for what std::experimental::simd leaves open (and does differ on): min and max of zeros and NaN.
template <class R>
struct PlainVectorOf {
  using Type [[gnu::vector_size(sizeof(LanesOf<R>))]] = R;
};
template <class R>
using PlainVector = typename PlainVectorOf<R>::Type;

template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION Simd<R, Abi> select(stdx::simd_mask<R, Abi> const& mask, Simd<R, Abi> const& yes,
                                                Simd<R, Abi> const& no) {
  Simd<R, Abi> result = no;
  stdx::where(mask, result) = yes;
  return result;
}
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION bool any(stdx::simd_mask<R, Abi> const& mask) {
  return stdx::any_of(mask);
}
template <class R, class Abi, class Visit>
KOKKOS_FORCEINLINE_FUNCTION void for_each_set(stdx::simd_mask<R, Abi> mask, Visit const& visit) {
  while (stdx::any_of(mask)) {
    int const l = stdx::find_first_set(mask) & (lane_count_of<R> - 1);  // so that GCC sees it within the lanes
    visit(l);
    mask[static_cast<std::size_t>(l)] = false;
  }
}
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION Simd<R, Abi> lane_sqrt(Simd<R, Abi> const& a) {
  return stdx::sqrt(a);
}
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION Simd<R, Abi> lane_abs(Simd<R, Abi> const& a) {
  return stdx::abs(a);
}
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION Simd<R, Abi> lane_truncate(Simd<R, Abi> const& a) {
  return stdx::trunc(a);
}
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION R sum_of_lanes(Simd<R, Abi> const& a) {
  return stdx::reduce(a);
}
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION int count_set(stdx::simd_mask<R, Abi> const& mask) {
  return stdx::popcount(mask);
}
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION Simd<R, Abi> lane_copysign(Simd<R, Abi> const& a, Simd<R, Abi> const& b) {
  return stdx::copysign(a, b);
}
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION Simd<R, Abi> lane_max(Simd<R, Abi> const& a, Simd<R, Abi> const& b) {
  auto const x = static_cast<PlainVector<R>>(a), y = static_cast<PlainVector<R>>(b);
#if defined(__AVX512F__)  // GCC makes a comparison and a choice of the general form where one side is a constant
  if constexpr (std::is_same_v<R, double>)
    return Simd<R, Abi>(PlainVector<R>(_mm512_mask_max_pd(x, 0xff, x, y)));
  else
    return Simd<R, Abi>(PlainVector<R>(_mm512_mask_max_ps(x, 0xffff, x, y)));
#else
  return Simd<R, Abi>(PlainVector<R>(x > y ? x : y));
#endif
}
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION Simd<R, Abi> lane_min(Simd<R, Abi> const& a, Simd<R, Abi> const& b) {
  auto const x = static_cast<PlainVector<R>>(a), y = static_cast<PlainVector<R>>(b);
#if defined(__AVX512F__)
  if constexpr (std::is_same_v<R, double>)
    return Simd<R, Abi>(PlainVector<R>(_mm512_mask_min_pd(x, 0xff, x, y)));
  else
    return Simd<R, Abi>(PlainVector<R>(_mm512_mask_min_ps(x, 0xffff, x, y)));
#else
  return Simd<R, Abi>(PlainVector<R>(x < y ? x : y));
#endif
}
/// a b + c rounded once, in lanes of either kind; with `Minus` c - a b.
template <bool Minus, class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION Simd<R, Abi> fused(Simd<R, Abi> const& a, Simd<R, Abi> const& b, Simd<R, Abi> const& c) {
  auto const x = static_cast<PlainVector<R>>(a), y = static_cast<PlainVector<R>>(b), z = static_cast<PlainVector<R>>(c);
  [[maybe_unused]] constexpr bool single = std::is_same_v<R, float>;
#if defined(CLATHRA_UNFUSED)
  return Simd<R, Abi>(PlainVector<R>(Minus ? z - x * y : x * y + z));
#elif defined(__AVX512F__)
  if constexpr (single)
    return Simd<R, Abi>(PlainVector<R>(Minus ? _mm512_fnmadd_ps(x, y, z) : _mm512_fmadd_ps(x, y, z)));
  else
    return Simd<R, Abi>(PlainVector<R>(Minus ? _mm512_fnmadd_pd(x, y, z) : _mm512_fmadd_pd(x, y, z)));
#elif defined(__AVX2__) && defined(__FMA__)
  if constexpr (single)
    return Simd<R, Abi>(PlainVector<R>(Minus ? _mm256_fnmadd_ps(x, y, z) : _mm256_fmadd_ps(x, y, z)));
  else
    return Simd<R, Abi>(PlainVector<R>(Minus ? _mm256_fnmadd_pd(x, y, z) : _mm256_fmadd_pd(x, y, z)));
#else
  PlainVector<R> sum;
  for (int l = 0; l < lane_count_of<R>; ++l) {
    R const factor = Minus ? -x[l] : x[l];
    if constexpr (single)
      sum[l] = ::fmaf(factor, y[l], z[l]);
    else
      sum[l] = ::fma(factor, y[l], z[l]);
  }
  return Simd<R, Abi>(sum);
#endif
}
KOKKOS_FORCEINLINE_FUNCTION Lanes multiply_add(Lanes const& a, Lanes const& b, Lanes const& c) { return a * b + c; }
KOKKOS_FORCEINLINE_FUNCTION Lanes negative_multiply_add(Lanes const& a, Lanes const& b, Lanes const& c) { return c - a * b; }
KOKKOS_FORCEINLINE_FUNCTION Lanes fused_multiply_add(Lanes const& a, Lanes const& b, Lanes const& c) {
  return fused<false>(a, b, c);
}
KOKKOS_FORCEINLINE_FUNCTION FloatLanes multiply_add(FloatLanes const& a, FloatLanes const& b, FloatLanes const& c) {
  return fused<false>(a, b, c);
}
KOKKOS_FORCEINLINE_FUNCTION FloatLanes negative_multiply_add(FloatLanes const& a, FloatLanes const& b, FloatLanes const& c) {
  return fused<true>(a, b, c);
}
/// multiply_add() where the mask is set, else 0.
KOKKOS_FORCEINLINE_FUNCTION FloatLanes multiply_add_where(MaskOf<FloatLanes> const& mask, FloatLanes const& a,
                                                          FloatLanes const& b, FloatLanes const& c) {
#if defined(__AVX512F__) && !defined(CLATHRA_UNFUSED)
  auto const x = static_cast<PlainVector<float>>(a), y = static_cast<PlainVector<float>>(b),
             z = static_cast<PlainVector<float>>(c);
  return FloatLanes(PlainVector<float>(_mm512_maskz_fmadd_ps(static_cast<__mmask16>(stdx::__data(mask)), x, y, z)));
#else
  return select(mask, multiply_add(a, b, c), FloatLanes(0));
#endif
}
KOKKOS_FORCEINLINE_FUNCTION Lanes load(double const* from) { return Lanes(from, stdx::element_aligned); }
KOKKOS_FORCEINLINE_FUNCTION FloatLanes load(float const* from) { return FloatLanes(from, stdx::element_aligned); }
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION void store(R* to, Simd<R, Abi> const& value) {
  value.copy_to(to, stdx::element_aligned);
}
/// From and to single precision.
KOKKOS_FORCEINLINE_FUNCTION Lanes load_float(float const* from) { return Lanes(from, stdx::element_aligned); }
KOKKOS_FORCEINLINE_FUNCTION void store_float(float* to, Lanes const& value) { value.copy_to(to, stdx::element_aligned); }
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION R lane(Simd<R, Abi> const& value, int l) {
  return value[static_cast<std::size_t>(l)];
}
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION bool lane(stdx::simd_mask<R, Abi> const& mask, int l) {
  return mask[static_cast<std::size_t>(l)];
}
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION void set_lane(Simd<R, Abi>& value, int l, R to) {
  value[static_cast<std::size_t>(l)] = to;
}
KOKKOS_FORCEINLINE_FUNCTION void set_lane(Lanes& value, int l, Real to) { value[static_cast<std::size_t>(l)] = to; }
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION void set_lane(stdx::simd_mask<R, Abi>& mask, int l, bool to) {
  mask[static_cast<std::size_t>(l)] = to;
}
template <class R, class Abi>
KOKKOS_FORCEINLINE_FUNCTION R largest(Simd<R, Abi> const& value) {
  return stdx::hmax(value);
}
/// The mask of the lanes 0 .. count - 1.
template <class R = Real>
KOKKOS_FORCEINLINE_FUNCTION MaskOf<LanesOf<R>> first_lanes(int count) {
  return LanesOf<R>([](auto l) { return R(l); }) < LanesOf<R>(static_cast<R>(count));
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
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void prefetch(T const* from) {
  __builtin_prefetch(from);
}
/// The values of a field at the discs named by `index[0 .. lane_count)`.
template <class R>
KOKKOS_FORCEINLINE_FUNCTION LanesOf<R> gather(R const* field, int const* index) {
  return LanesOf<R>([&](auto l) { return field[index[l]]; });
}
#else
KOKKOS_FORCEINLINE_FUNCTION double load(double const* from) { return *from; }
KOKKOS_FORCEINLINE_FUNCTION float load(float const* from) { return *from; }
KOKKOS_FORCEINLINE_FUNCTION void store(double* to, double value) { *to = value; }
KOKKOS_FORCEINLINE_FUNCTION void store(float* to, float value) { *to = value; }
KOKKOS_FORCEINLINE_FUNCTION Real load_float(float const* from) { return *from; }
KOKKOS_FORCEINLINE_FUNCTION void store_float(float* to, Real value) { *to = static_cast<float>(value); }
template <class R>
KOKKOS_FORCEINLINE_FUNCTION R lane(R value, int) {
  return value;
}
template <class R>
KOKKOS_FORCEINLINE_FUNCTION void set_lane(R& value, int, std::type_identity_t<R> to) {
  value = to;
}
template <class R>
KOKKOS_FORCEINLINE_FUNCTION R largest(R value) {
  return value;
}
template <class R = Real>
KOKKOS_FORCEINLINE_FUNCTION bool first_lanes(int count) {
  return count > 0;
}
KOKKOS_FORCEINLINE_FUNCTION int pack_set(bool mask, int const* from, int* to) {
  if (mask) *to = *from;
  return mask ? 1 : 0;
}
template <class T>
KOKKOS_FORCEINLINE_FUNCTION void prefetch(T const*) {}
template <class R>
KOKKOS_FORCEINLINE_FUNCTION R gather(R const* field, int const* index) {
  return field[*index];
}
#endif

/// Whether memory is laid out for a GPU.
#if defined(CLATHRA_DEVICE_LIKE) || defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(KOKKOS_ENABLE_SYCL)
inline constexpr bool for_gpu = true;
#else
inline constexpr bool for_gpu = false;
#endif
inline constexpr int threads_that_load_together = 32;

/// Discs whose rows lie side by side in memory (contacts.hpp): a multiple of the lanes of the contact kernel, whose numbers are
/// R. Nobody's bits know it.
template <class R>
inline constexpr int slice_width_of = for_gpu ? threads_that_load_together : lane_count_of<R>;
static_assert(slice_width_of<float> % lane_count_of<float> == 0 && slice_width_of<double> % lane_count_of<double> == 0,
              "a slice holds whole groups of lanes");
static_assert(slice_width_of<float> % lane_count == 0, "and whole groups of the kernels that work in double precision on it");
inline constexpr int widest_slice = slice_width_of<float>;

/// `value` clamped to [-limit, limit]; limit >= 0. Odd in `value` even at limit 0, so both sides of a pair get exact
/// opposites. What comes of a NaN depends on the machine: integrate() finds the motion that made it.
template <class L>
KOKKOS_FORCEINLINE_FUNCTION L clamp_to(L const& value, L const& limit) {
  return lane_max(-limit, lane_min(limit, value));
}
#if defined(CLATHRA_SIMD) && defined(__AVX512DQ__)
/// The same bits by one instruction: the smaller magnitude with the sign of `value`.
KOKKOS_FORCEINLINE_FUNCTION Lanes clamp_to(Lanes const& value, Lanes const& limit) {
  return Lanes(
      PlainVector<double>(_mm512_range_pd(static_cast<PlainVector<double>>(value), static_cast<PlainVector<double>>(limit), 2)));
}
KOKKOS_FORCEINLINE_FUNCTION FloatLanes clamp_to(FloatLanes const& value, FloatLanes const& limit) {
  return FloatLanes(
      PlainVector<float>(_mm512_range_ps(static_cast<PlainVector<float>>(value), static_cast<PlainVector<float>>(limit), 2)));
}
#endif

}  // namespace clathra
