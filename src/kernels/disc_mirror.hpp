#pragma once
/// What the contact kernel reads of discs in mixed precision, gathered by whole rows: 16 bytes a disc of its place and, where
/// somebody asks how discs move, as many of its motion. Velocities, masses and rotations have their only place here; that of the
/// centre is derived from x and y in double precision.
///
/// Places are in ticks: multiples of a power of two near 2^-28 of the largest diameter, of which the low 32 bits are kept. The
/// difference of two of them, as a signed number, is that of their places to the tick, at any size of the box, as long as it is
/// below 2^31 ticks, 4 to 8 diameters (`reaches()`). Sixteen numbers of four bytes gathered one by one are as many loads and as
/// many shuffles; sixteen rows are sixteen loads for four numbers each, and eight shuffles.
#include "kernels/int_lanes.hpp"
#include "kernels/real_field.hpp"

namespace clathra {

/// The rows of as many discs as FloatLanes hold. Named, not arrays: GCC keeps those in memory.
struct PlacesOfDiscs {
  FloatLanes x, y;  ///< in ticks, their bits
  FloatLanes radius, rotation_increment;
};
struct MotionOfDiscs {
  FloatLanes vx, vy, omega, inverse_mass;
};

struct DiscMirror {
  static constexpr std::size_t row = 4;  ///< numbers a disc has in each table
  // Columns, in SI units but for the ticks, those of `motion` behind those of `places`.
  static constexpr int rotation_increment_at = 3, vx_at = 4, vy_at = 5, omega_at = 6, inverse_mass_at = 7;

  Real tick = 1;                        ///< [m]; 0.9 pm where the largest disc has 0.3 mm
  float padding_radius = 0;             ///< negative, so large that nothing touches a padding disc wherever it seems to be [m]
  Field<std::uint32_t> places, motion;  ///< [discs][row], the bits of floats

  static constexpr double shift = 6755399441055744.0;  // 1.5 2^52
  static Real tick_for(Real largest_diameter);

  /// The low 32 bits of a place in ticks, rounded to the nearest. Fused or not, the product is exact: a tick is a power of two.
  /// Behind the sum they are those of its own representation: 1.5 2^52 has the ulp 1. Exact below 2^51 ticks, 16 km where a tick
  /// has 7 pm, 2 km where it has 0.9.
  KOKKOS_FORCEINLINE_FUNCTION static std::int32_t ticks(Coord place, Real per_tick) {
    double const sum = place * per_tick + shift;
    std::uint64_t bits;
    __builtin_memcpy(&bits, &sum, sizeof bits);
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(bits));
  }

  /// Whether places so far apart [m] are told from each other, with a quarter of the ticks to spare for what moves until rows are
  /// listed anew.
  bool reaches(Real distance) const { return distance < 0x1.8p30 * tick; }

  KOKKOS_FORCEINLINE_FUNCTION static float* numbers(Field<std::uint32_t> const& table) {
    return reinterpret_cast<float*>(table.data());
  }

  /// The rows of the discs j[0 .. lanes).
  KOKKOS_FORCEINLINE_FUNCTION PlacesOfDiscs gather_places(int const* j) const;
  KOKKOS_FORCEINLINE_FUNCTION MotionOfDiscs gather_motion(int const* j) const;
  /// The rows of the discs first .. first + lanes, `first` a multiple of the lanes.
  KOKKOS_FORCEINLINE_FUNCTION PlacesOfDiscs load_places(std::size_t first) const;
  KOKKOS_FORCEINLINE_FUNCTION MotionOfDiscs load_motion(std::size_t first) const;
  KOKKOS_FORCEINLINE_FUNCTION void store(std::size_t first, PlacesOfDiscs const& places_of_discs) const;
  KOKKOS_FORCEINLINE_FUNCTION void store(std::size_t first, MotionOfDiscs const& motion_of_discs) const;
};

}  // namespace clathra

#include "kernels/mirror_rows.hpp"

namespace clathra {

/// As many numbers in double precision as FloatLanes hold.
inline constexpr int halves = lane_count_of<float> / lane_count;
struct LanesOfHalves {
  Lanes of[halves];
};
KOKKOS_FORCEINLINE_FUNCTION LanesOfHalves load_halves(double const* from) {
  LanesOfHalves value;
  for (int h = 0; h < halves; ++h) value.of[h] = load(from + h * lane_count);
  return value;
}
KOKKOS_FORCEINLINE_FUNCTION LanesOfHalves in_double(FloatLanes const& value) {
  LanesOfHalves wide;
#if defined(CLATHRA_SIMD) && defined(__AVX512F__)
  PlainVector<float> const v = static_cast<PlainVector<float>>(value);
  wide.of[0] = Lanes(_mm512_cvtps_pd(_mm512_castps512_ps256(v)));
  wide.of[1] = Lanes(_mm512_cvtps_pd(_mm512_extractf32x8_ps(v, 1)));
#else
  float each[lane_count_of<float>];
  store(&each[0], value);
  for (int h = 0; h < halves; ++h) wide.of[h] = load_float(&each[h * lane_count]);
#endif
  return wide;
}
KOKKOS_FORCEINLINE_FUNCTION FloatLanes in_single(LanesOfHalves const& wide) {
#if defined(CLATHRA_SIMD) && defined(__AVX512F__)
  auto const single = [&](int h) { return _mm512_cvtpd_ps(static_cast<PlainVector<double>>(wide.of[h])); };
  return FloatLanes(_mm512_insertf32x8(_mm512_castps256_ps512(single(0)), single(1), 1));
#elif defined(CLATHRA_SIMD) && defined(__AVX2__)
  auto const single = [&](int h) { return _mm256_cvtpd_ps(static_cast<PlainVector<double>>(wide.of[h])); };
  return FloatLanes(_mm256_set_m128(single(1), single(0)));
#else
  float each[lane_count_of<float>];
  for (int h = 0; h < halves; ++h) store_float(&each[h * lane_count], wide.of[h]);
  return load(&each[0]);
#endif
}
/// DiscMirror::ticks() of each, as the bits that a row holds.
KOKKOS_FORCEINLINE_FUNCTION FloatLanes ticks_of(LanesOfHalves const& place, Real per_tick) {
#if defined(CLATHRA_SIMD) && defined(__AVX512F__)
  auto const sum = [&](int h) {
    return _mm512_castpd_ps(
        static_cast<PlainVector<double>>(fused_multiply_add(place.of[h], Lanes(per_tick), Lanes(DiscMirror::shift))));
  };
  __m512i const low_of_each = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  return FloatLanes(_mm512_permutex2var_ps(sum(0), low_of_each, sum(1)));
#elif defined(CLATHRA_SIMD) && defined(__AVX2__)
  // The low halves of the numbers' bits, which are in order within 128 bits, and then the pairs.
  auto const sum = [&](int h) {
    return _mm256_castpd_ps(
        static_cast<PlainVector<double>>(fused_multiply_add(place.of[h], Lanes(per_tick), Lanes(DiscMirror::shift))));
  };
  __m256 const low = _mm256_shuffle_ps(sum(0), sum(1), 0x88);
  return FloatLanes(_mm256_castpd_ps(_mm256_permute4x64_pd(_mm256_castps_pd(low), 0xd8)));
#else
  FloatLanes bits(0);
  for (int l = 0; l < lane_count_of<float>; ++l)
    set_lane(bits, l, from_bits(DiscMirror::ticks(lane(place.of[l / lane_count], l % lane_count), per_tick)));
  return bits;
#endif
}

/// Adds losses to accounts, which are sums in double precision.
KOKKOS_FORCEINLINE_FUNCTION void add_dissipation(Field<Accum> const& account, std::size_t first, FloatLanes const& loss) {
  LanesOfHalves const wide = in_double(loss);
  for (int h = 0; h < halves; ++h) {
    Accum* const to = &account(first + static_cast<std::size_t>(h * lane_count));
    store(to, load(to) + wide.of[h]);
  }
}

}  // namespace clathra
