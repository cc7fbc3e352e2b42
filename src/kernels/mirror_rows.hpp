#pragma once
/// How rows of the mirror become vectors, each of one number of all discs, and the way back.
#include "kernels/disc_mirror.hpp"

namespace clathra {

#if defined(CLATHRA_SIMD) && defined(__AVX2__)

namespace mirror_rows {

#if defined(__AVX512F__)
using Vector = __m512;
KOKKOS_FORCEINLINE_FUNCTION Vector low_of_pairs(Vector a, Vector b) { return _mm512_unpacklo_ps(a, b); }
KOKKOS_FORCEINLINE_FUNCTION Vector high_of_pairs(Vector a, Vector b) { return _mm512_unpackhi_ps(a, b); }
template <int Which>
KOKKOS_FORCEINLINE_FUNCTION Vector pairs(Vector a, Vector b) {
  return _mm512_shuffle_ps(a, b, Which);
}
KOKKOS_FORCEINLINE_FUNCTION Vector load_vector(float const* from) { return _mm512_loadu_ps(from); }
KOKKOS_FORCEINLINE_FUNCTION void store_vector(float* to, Vector v) { _mm512_storeu_ps(to, v); }
/// The numbers of the discs 0, 4, 8, 12, 1 ... in the order of the discs, or the other way round.
KOKKOS_FORCEINLINE_FUNCTION Vector in_order(Vector v) {
  return _mm512_permutexvar_ps(_mm512_setr_epi32(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15), v);
}
KOKKOS_FORCEINLINE_FUNCTION Vector as_transposed(Vector v) { return in_order(v); }
#else
using Vector = __m256;
KOKKOS_FORCEINLINE_FUNCTION Vector low_of_pairs(Vector a, Vector b) { return _mm256_unpacklo_ps(a, b); }
KOKKOS_FORCEINLINE_FUNCTION Vector high_of_pairs(Vector a, Vector b) { return _mm256_unpackhi_ps(a, b); }
template <int Which>
KOKKOS_FORCEINLINE_FUNCTION Vector pairs(Vector a, Vector b) {
  return _mm256_shuffle_ps(a, b, Which);
}
KOKKOS_FORCEINLINE_FUNCTION Vector load_vector(float const* from) { return _mm256_loadu_ps(from); }
KOKKOS_FORCEINLINE_FUNCTION void store_vector(float* to, Vector v) { _mm256_storeu_ps(to, v); }
/// The numbers of the discs 0, 2, 4, 6, 1 ... in the order of the discs, and the other way round.
KOKKOS_FORCEINLINE_FUNCTION Vector in_order(Vector v) {
  return _mm256_permutevar8x32_ps(v, _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7));
}
KOKKOS_FORCEINLINE_FUNCTION Vector as_transposed(Vector v) {
  return _mm256_permutevar8x32_ps(v, _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7));
}
#endif
struct Four {
  Vector a, b, c, d;
};

/// Four by four numbers within each 128 bits.
KOKKOS_FORCEINLINE_FUNCTION Four transposed(Four const& v) {
  Vector const ab_low = low_of_pairs(v.a, v.b), cd_low = low_of_pairs(v.c, v.d), ab_high = high_of_pairs(v.a, v.b),
               cd_high = high_of_pairs(v.c, v.d);
  return {pairs<0x44>(ab_low, cd_low), pairs<0xee>(ab_low, cd_low), pairs<0x44>(ab_high, cd_high), pairs<0xee>(ab_high, cd_high)};
}
template <class Row>
KOKKOS_FORCEINLINE_FUNCTION Row as_row(Four const& v) {
  return {FloatLanes(v.a), FloatLanes(v.b), FloatLanes(v.c), FloatLanes(v.d)};
}
KOKKOS_FORCEINLINE_FUNCTION Vector plain(FloatLanes const& v) { return static_cast<PlainVector<float>>(v); }

KOKKOS_FORCEINLINE_FUNCTION __m128 row_at(float const* from, int disc) {
  return _mm_load_ps(from + DiscMirror::row * static_cast<std::uint32_t>(disc));
}
/// The rows of the discs j[0], j[4] and so on.
KOKKOS_FORCEINLINE_FUNCTION Vector rows_at(float const* from, int const* j) {
#if defined(__AVX512F__)
  __m512 const two = _mm512_insertf32x4(_mm512_castps128_ps512(row_at(from, j[0])), row_at(from, j[4]), 1);
  return _mm512_insertf32x4(_mm512_insertf32x4(two, row_at(from, j[8]), 2), row_at(from, j[12]), 3);
#else
  return _mm256_insertf128_ps(_mm256_castps128_ps256(row_at(from, j[0])), row_at(from, j[4]), 1);
#endif
}

template <class Row>
KOKKOS_FORCEINLINE_FUNCTION Row gather(float const* from, int const* j) {
  return as_row<Row>(transposed({rows_at(from, j), rows_at(from, j + 1), rows_at(from, j + 2), rows_at(from, j + 3)}));
}
template <class Row>
KOKKOS_FORCEINLINE_FUNCTION Row load(float const* from) {
  constexpr int next = lane_count_of<float>;
  Four const v =
      transposed({load_vector(from), load_vector(from + next), load_vector(from + 2 * next), load_vector(from + 3 * next)});
  return as_row<Row>({in_order(v.a), in_order(v.b), in_order(v.c), in_order(v.d)});
}
KOKKOS_FORCEINLINE_FUNCTION void store(float* to, FloatLanes const& a, FloatLanes const& b, FloatLanes const& c,
                                       FloatLanes const& d) {
  constexpr int next = lane_count_of<float>;
  Four const v = transposed({as_transposed(plain(a)), as_transposed(plain(b)), as_transposed(plain(c)), as_transposed(plain(d))});
  store_vector(to, v.a);
  store_vector(to + next, v.b);
  store_vector(to + 2 * next, v.c);
  store_vector(to + 3 * next, v.d);
}

}  // namespace mirror_rows

#else

namespace mirror_rows {
/// One number after the other. @param disc  the l-th disc
template <class Row, class Disc>
KOKKOS_FORCEINLINE_FUNCTION Row rows_of(float const* from, Disc const& disc) {
  FloatLanes of[DiscMirror::row];
  for (std::size_t n = 0; n < DiscMirror::row; ++n) {
    for (int l = 0; l < lane_count_of<float>; ++l) set_lane(of[n], l, from[DiscMirror::row * disc(l) + n]);
  }
  return {of[0], of[1], of[2], of[3]};
}
template <class Row>
KOKKOS_FORCEINLINE_FUNCTION Row gather(float const* from, int const* j) {
  return rows_of<Row>(from, [j](int l) { return static_cast<std::size_t>(j[l]); });
}
template <class Row>
KOKKOS_FORCEINLINE_FUNCTION Row load(float const* from) {
  return rows_of<Row>(from, [](int l) { return static_cast<std::size_t>(l); });
}
KOKKOS_FORCEINLINE_FUNCTION void store(float* to, FloatLanes const& a, FloatLanes const& b, FloatLanes const& c,
                                       FloatLanes const& d) {
  FloatLanes const of[DiscMirror::row] = {a, b, c, d};
  for (std::size_t n = 0; n < DiscMirror::row; ++n) {
    for (int l = 0; l < lane_count_of<float>; ++l) to[DiscMirror::row * static_cast<std::size_t>(l) + n] = lane(of[n], l);
  }
}
}  // namespace mirror_rows

#endif

KOKKOS_FORCEINLINE_FUNCTION PlacesOfDiscs DiscMirror::gather_places(int const* j) const {
  return mirror_rows::gather<PlacesOfDiscs>(numbers(places), j);
}
KOKKOS_FORCEINLINE_FUNCTION MotionOfDiscs DiscMirror::gather_motion(int const* j) const {
  return mirror_rows::gather<MotionOfDiscs>(numbers(motion), j);
}
KOKKOS_FORCEINLINE_FUNCTION PlacesOfDiscs DiscMirror::load_places(std::size_t first) const {
  return mirror_rows::load<PlacesOfDiscs>(numbers(places) + row * first);
}
KOKKOS_FORCEINLINE_FUNCTION MotionOfDiscs DiscMirror::load_motion(std::size_t first) const {
  return mirror_rows::load<MotionOfDiscs>(numbers(motion) + row * first);
}
KOKKOS_FORCEINLINE_FUNCTION void DiscMirror::store(std::size_t first, PlacesOfDiscs const& p) const {
  mirror_rows::store(numbers(places) + row * first, p.x, p.y, p.radius, p.rotation_increment);
}
KOKKOS_FORCEINLINE_FUNCTION void DiscMirror::store(std::size_t first, MotionOfDiscs const& m) const {
  mirror_rows::store(numbers(motion) + row * first, m.vx, m.vy, m.omega, m.inverse_mass);
}

}  // namespace clathra
