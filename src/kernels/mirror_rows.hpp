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
#else
using Vector = __m256;
KOKKOS_FORCEINLINE_FUNCTION Vector low_of_pairs(Vector a, Vector b) { return _mm256_unpacklo_ps(a, b); }
KOKKOS_FORCEINLINE_FUNCTION Vector high_of_pairs(Vector a, Vector b) { return _mm256_unpackhi_ps(a, b); }
template <int Which>
KOKKOS_FORCEINLINE_FUNCTION Vector pairs(Vector a, Vector b) {
  return _mm256_shuffle_ps(a, b, Which);
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
template <class Half>
KOKKOS_FORCEINLINE_FUNCTION Half as_half(Four const& v) {
  return {FloatLanes(v.a), FloatLanes(v.b), FloatLanes(v.c), FloatLanes(v.d)};
}
KOKKOS_FORCEINLINE_FUNCTION Vector plain(FloatLanes const& v) { return static_cast<PlainVector<float>>(v); }

/// Half of a row.
KOKKOS_FORCEINLINE_FUNCTION __m128 half_at(float const* from, int disc) {
  return _mm_load_ps(from + DiscMirror::row * static_cast<std::uint32_t>(disc));
}
KOKKOS_FORCEINLINE_FUNCTION __m256 row_at(float const* from, int disc) {
  return _mm256_load_ps(from + DiscMirror::row * static_cast<std::uint32_t>(disc));
}
#if defined(__AVX512F__)
/// Halves of the discs j[0], j[4], j[8] and j[12].
KOKKOS_FORCEINLINE_FUNCTION Vector halves_at(float const* from, int const* j) {
  __m512 const two = _mm512_insertf32x4(_mm512_castps128_ps512(half_at(from, j[0])), half_at(from, j[4]), 1);
  return _mm512_insertf32x4(_mm512_insertf32x4(two, half_at(from, j[8]), 2), half_at(from, j[12]), 3);
}
/// The rows of the discs j[0] and j[4].
KOKKOS_FORCEINLINE_FUNCTION Vector rows_at(float const* from, int const* j) {
  return _mm512_castpd_ps(
      _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_castps_pd(row_at(from, j[0]))), _mm256_castps_pd(row_at(from, j[4])), 1));
}
#else
/// Halves of the discs j[0] and j[4].
KOKKOS_FORCEINLINE_FUNCTION Vector halves_at(float const* from, int const* j) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(half_at(from, j[0])), half_at(from, j[4]), 1);
}
KOKKOS_FORCEINLINE_FUNCTION Vector rows_at(float const* from, int const* j) { return row_at(from, j[0]); }
#endif

template <class Half>
KOKKOS_FORCEINLINE_FUNCTION Half gather_half(float const* from, int const* j) {
  return as_half<Half>(transposed({halves_at(from, j), halves_at(from, j + 1), halves_at(from, j + 2), halves_at(from, j + 3)}));
}

/// One number of all discs from vectors that hold it beside another one: of the first and of the second half of the discs.
#if defined(__AVX512F__)
KOKKOS_FORCEINLINE_FUNCTION Vector places_of(Vector a, Vector b) { return _mm512_shuffle_f32x4(a, b, 0x88); }
KOKKOS_FORCEINLINE_FUNCTION Vector motion_of(Vector a, Vector b) { return _mm512_shuffle_f32x4(a, b, 0xdd); }
#else
KOKKOS_FORCEINLINE_FUNCTION Vector places_of(Vector a, Vector b) { return _mm256_permute2f128_ps(a, b, 0x20); }
KOKKOS_FORCEINLINE_FUNCTION Vector motion_of(Vector a, Vector b) { return _mm256_permute2f128_ps(a, b, 0x31); }
#endif
KOKKOS_FORCEINLINE_FUNCTION RowsOfDiscs rows_from(Four const& a, Four const& b) {
  return {as_half<PlacesOfDiscs>({places_of(a.a, b.a), places_of(a.b, b.b), places_of(a.c, b.c), places_of(a.d, b.d)}),
          as_half<MotionOfDiscs>({motion_of(a.a, b.a), motion_of(a.b, b.b), motion_of(a.c, b.c), motion_of(a.d, b.d)})};
}

}  // namespace mirror_rows

KOKKOS_FORCEINLINE_FUNCTION RowsOfDiscs DiscMirror::gather(int const* j) const {
  using namespace mirror_rows;
  constexpr int next = lane_count_of<float> / 2;
  float const* const from = numbers();
  int const* const i = j + next;
  return rows_from(transposed({rows_at(from, j), rows_at(from, j + 1), rows_at(from, j + 2), rows_at(from, j + 3)}),
                   transposed({rows_at(from, i), rows_at(from, i + 1), rows_at(from, i + 2), rows_at(from, i + 3)}));
}
KOKKOS_FORCEINLINE_FUNCTION PlacesOfDiscs DiscMirror::gather_places(int const* j) const {
  return mirror_rows::gather_half<PlacesOfDiscs>(numbers(), j);
}
KOKKOS_FORCEINLINE_FUNCTION MotionOfDiscs DiscMirror::gather_motion(int const* j) const {
  return mirror_rows::gather_half<MotionOfDiscs>(numbers() + row / 2, j);
}

#if defined(__AVX512F__)

namespace mirror_rows {
// The discs 0, 2, 4, 6 and 1, 3, 5, 7 of eight, one number in the first and one in the third 128 bits: with another number in the
// other ones, the transposed vectors are pairs of rows as they stand in memory.
KOKKOS_FORCEINLINE_FUNCTION __m512i places_in_memory() {
  return _mm512_setr_epi32(0, 8, 1, 9, 2, 10, 3, 11, 16, 24, 17, 25, 18, 26, 19, 27);
}
KOKKOS_FORCEINLINE_FUNCTION __m512i motion_in_memory() {
  return _mm512_setr_epi32(4, 12, 5, 13, 6, 14, 7, 15, 20, 28, 21, 29, 22, 30, 23, 31);
}
KOKKOS_FORCEINLINE_FUNCTION __m512i first_to_memory() {
  return _mm512_setr_epi32(0, 2, 4, 6, 16, 18, 20, 22, 1, 3, 5, 7, 17, 19, 21, 23);
}
KOKKOS_FORCEINLINE_FUNCTION __m512i last_to_memory() {
  return _mm512_setr_epi32(8, 10, 12, 14, 24, 26, 28, 30, 9, 11, 13, 15, 25, 27, 29, 31);
}
KOKKOS_FORCEINLINE_FUNCTION Four picked(Four const& a, __m512i const& which, Four const& b) {
  return {_mm512_permutex2var_ps(a.a, which, b.a), _mm512_permutex2var_ps(a.b, which, b.b),
          _mm512_permutex2var_ps(a.c, which, b.c), _mm512_permutex2var_ps(a.d, which, b.d)};
}
KOKKOS_FORCEINLINE_FUNCTION Four load_four(float const* from) {
  return {_mm512_loadu_ps(from), _mm512_loadu_ps(from + 16), _mm512_loadu_ps(from + 32), _mm512_loadu_ps(from + 48)};
}
KOKKOS_FORCEINLINE_FUNCTION void store_four(float* to, Four const& v) {
  _mm512_storeu_ps(to, v.a);
  _mm512_storeu_ps(to + 16, v.b);
  _mm512_storeu_ps(to + 32, v.c);
  _mm512_storeu_ps(to + 48, v.d);
}
}  // namespace mirror_rows

KOKKOS_FORCEINLINE_FUNCTION RowsOfDiscs DiscMirror::load(std::size_t first) const {
  using namespace mirror_rows;
  float const* const from = numbers() + row * first;
  Four const a = transposed(load_four(from)), b = transposed(load_four(from + 64));
  return {as_half<PlacesOfDiscs>(picked(a, places_in_memory(), b)), as_half<MotionOfDiscs>(picked(a, motion_in_memory(), b))};
}
KOKKOS_FORCEINLINE_FUNCTION void DiscMirror::store(std::size_t first, RowsOfDiscs const& r) const {
  using namespace mirror_rows;
  float* const to = numbers() + row * first;
  Four const places{plain(r.places.x), plain(r.places.y), plain(r.places.radius), plain(r.places.omega)};
  Four const motion{plain(r.motion.vx), plain(r.motion.vy), plain(r.motion.inverse_mass), plain(r.motion.inverse_inertia)};
  store_four(to, transposed(picked(places, first_to_memory(), motion)));
  store_four(to + 64, transposed(picked(places, last_to_memory(), motion)));
}

#else

KOKKOS_FORCEINLINE_FUNCTION RowsOfDiscs DiscMirror::load(std::size_t first) const {
  constexpr int in_order[] = {0, 1, 2, 3, 4, 5, 6, 7};
  using namespace mirror_rows;
  float const* const from = numbers() + row * first;
  auto const four = [&](int k) {
    return transposed({rows_at(from, in_order + k), rows_at(from, in_order + k + 1), rows_at(from, in_order + k + 2),
                       rows_at(from, in_order + k + 3)});
  };
  return rows_from(four(0), four(4));
}
KOKKOS_FORCEINLINE_FUNCTION void DiscMirror::store(std::size_t first, RowsOfDiscs const& r) const {
  using namespace mirror_rows;
  float* const to = numbers() + row * first;
  PlacesOfDiscs const& p = r.places;
  MotionOfDiscs const& m = r.motion;
  Vector const x = plain(p.x), y = plain(p.y), radius = plain(p.radius), omega = plain(p.omega), vx = plain(m.vx),
               vy = plain(m.vy), mass = plain(m.inverse_mass), inertia = plain(m.inverse_inertia);
  auto const store_four = [](float* at, Four const& v) {
    _mm256_store_ps(at, v.a);
    _mm256_store_ps(at + row, v.b);
    _mm256_store_ps(at + 2 * row, v.c);
    _mm256_store_ps(at + 3 * row, v.d);
  };
  store_four(to, transposed({places_of(x, vx), places_of(y, vy), places_of(radius, mass), places_of(omega, inertia)}));
  store_four(to + 4 * row, transposed({motion_of(x, vx), motion_of(y, vy), motion_of(radius, mass), motion_of(omega, inertia)}));
}

#endif

#else

namespace mirror_rows {
/// One number after the other. @param disc  the l-th disc
template <class Half, class Disc>
KOKKOS_FORCEINLINE_FUNCTION Half half_of(float const* from, Disc const& disc) {
  FloatLanes of[4];
  for (std::size_t n = 0; n < 4; ++n) {
    for (int l = 0; l < lane_count_of<float>; ++l) set_lane(of[n], l, from[DiscMirror::row * disc(l) + n]);
  }
  return {of[0], of[1], of[2], of[3]};
}
}  // namespace mirror_rows

KOKKOS_FORCEINLINE_FUNCTION PlacesOfDiscs DiscMirror::gather_places(int const* j) const {
  return mirror_rows::half_of<PlacesOfDiscs>(numbers(), [j](int l) { return static_cast<std::size_t>(j[l]); });
}
KOKKOS_FORCEINLINE_FUNCTION MotionOfDiscs DiscMirror::gather_motion(int const* j) const {
  return mirror_rows::half_of<MotionOfDiscs>(numbers() + row / 2, [j](int l) { return static_cast<std::size_t>(j[l]); });
}
KOKKOS_FORCEINLINE_FUNCTION RowsOfDiscs DiscMirror::gather(int const* j) const { return {gather_places(j), gather_motion(j)}; }
KOKKOS_FORCEINLINE_FUNCTION RowsOfDiscs DiscMirror::load(std::size_t first) const {
  auto const disc = [first](int l) { return first + static_cast<std::size_t>(l); };
  return {mirror_rows::half_of<PlacesOfDiscs>(numbers(), disc), mirror_rows::half_of<MotionOfDiscs>(numbers() + row / 2, disc)};
}
KOKKOS_FORCEINLINE_FUNCTION void DiscMirror::store(std::size_t first, RowsOfDiscs const& r) const {
  FloatLanes const of[row] = {r.places.x,  r.places.y,  r.places.radius,       r.places.omega,
                              r.motion.vx, r.motion.vy, r.motion.inverse_mass, r.motion.inverse_inertia};
  for (std::size_t n = 0; n < row; ++n) {
    for (int l = 0; l < lane_count_of<float>; ++l) numbers()[row * (first + static_cast<std::size_t>(l)) + n] = lane(of[n], l);
  }
}

#endif

}  // namespace clathra
