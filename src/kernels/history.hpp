#pragma once
/// How the contact kernel advances the shear forces and moments that contacts and bonds remember.
///
/// In mixed precision they are kept in fixed point. In a quasi-static test a step adds 1e-4 N/m to a force of 1e2 N/m and less:
/// 13 ulps of a float at an inertial number of 1e-4, one at 1e-5, none below, and a sum of floats stands still. Here the unit is
/// a power of two near 1e-4 N/m, and what a step adds is rounded up or down in turns, so that on the average over steps nothing
/// is lost at any rate: a part a becomes the whole number that is nearest to a + d, with d + 1/2 the fractional part of the
/// step's number times the golden section, and d has the sign of the motion. For a constant a the sum of n steps is off by about
/// a unit, whatever n. Moments are opposite on the two sides of a pair, so they need the sign; shear forces are equal there, but
/// with the same d in all contacts discs at rest answer the common push and their forces drift (docs/precision.md).
///
/// A total form (from the discs' angles when the bond formed) would do for bonds without an increment, but not for grain contacts
/// that slide, and reads three doubles more a pair; a compensated sum in two floats is as large as a double.
#include "kernels/particles.hpp"

namespace clathra {

/// How a step's part of a history comes about.
template <class R>
struct HistoryScale {
  R per_rate;  ///< dt / unit: in mixed precision contacts know their motion as rates, and the step's length comes in here
  R rounding;  ///< d: -1/2 <= d < 1/2
};

/// d of step number n: n times the golden section, to 24 bits, less its whole part and a half.
KOKKOS_INLINE_FUNCTION float rounding_of_step(std::int64_t n) {
  auto const fraction = static_cast<std::uint32_t>(static_cast<std::uint64_t>(n) * 2654435769u);
  return static_cast<float>(fraction >> 8) * 0x1p-24F - 0.5F;
}

template <class P>
struct HistoryOf;

/// In double precision a history is the number itself.
template <>
struct HistoryOf<FullPrecision> {
  using Value = Lanes;
  KOKKOS_FORCEINLINE_FUNCTION static Value none() { return Lanes(0); }
  KOKKOS_FORCEINLINE_FUNCTION static Value read(RealField const& field, std::size_t e) { return load(field.data<double>() + e); }
  KOKKOS_FORCEINLINE_FUNCTION static void write(RealField const& field, std::size_t e, Value const& value) {
    store(field.data<double>() + e, value);
  }
  /// A stiffness as advanced() takes it.
  template <class Stiffness>
  KOKKOS_FORCEINLINE_FUNCTION static Stiffness of_step(Stiffness const& stiffness, HistoryScale<double> const&) {
    return stiffness;
  }
  /// @param motion  during the step
  template <class Stiffness>
  KOKKOS_FORCEINLINE_FUNCTION static Value advanced(Value const& old, Stiffness const& stiffness, Lanes const& motion,
                                                    HistoryScale<double> const&) {
    return old + stiffness * motion;
  }
  /// In its own unit.
  KOKKOS_FORCEINLINE_FUNCTION static Lanes number(Value const& value) { return value; }
  /// @param limit  of the magnitude, >= 0, in the history's unit
  KOKKOS_FORCEINLINE_FUNCTION static Value limited(Value const& trial, Lanes const& limit) { return clamp_to(trial, limit); }
  /// @param free  where there is no limit
  KOKKOS_FORCEINLINE_FUNCTION static Value limited(Value const& trial, Lanes const& limit, Mask const& free) {
    return select(free, trial, clamp_to(trial, limit));
  }
  KOKKOS_FORCEINLINE_FUNCTION static Value choose(Mask const& mask, Value const& yes, Value const& no) {
    return select(mask, yes, no);
  }
};

#ifdef CLATHRA_SIMD
KOKKOS_FORCEINLINE_FUNCTION IntLanes load_ints(void const* from) {
  IntLanes value;
  __builtin_memcpy(&value, from, sizeof value);
  return value;
}
KOKKOS_FORCEINLINE_FUNCTION void store_ints(std::int32_t* to, IntLanes const& value) {
  __builtin_memcpy(to, &value, sizeof value);
}
/// The sum modulo 2^32.
KOKKOS_FORCEINLINE_FUNCTION IntLanes sum(IntLanes const& a, IntLanes const& b) {
  return (IntLanes)((PlainInts::Unsigned)a + (PlainInts::Unsigned)b);
}
KOKKOS_FORCEINLINE_FUNCTION FloatLanes to_float(IntLanes const& value) {
  return FloatLanes(__builtin_convertvector(value, PlainVector<float>));
}
/// Towards zero.
KOKKOS_FORCEINLINE_FUNCTION IntLanes truncated(FloatLanes const& value) {
  return __builtin_convertvector(static_cast<PlainVector<float>>(value), IntLanes);
}
/// To the nearest whole number, of two the even one; what 2^31 and more become differs between processors, and no increment of a
/// step is as large unless the run has become unstable.
KOKKOS_FORCEINLINE_FUNCTION IntLanes rounded(FloatLanes const& value) {
  auto const v = static_cast<PlainVector<float>>(value);
#if defined(__AVX512F__)
  return reinterpret_cast<IntLanes>(_mm512_cvtps_epi32(v));
#elif defined(__AVX2__)
  return reinterpret_cast<IntLanes>(_mm256_cvtps_epi32(v));
#else
  IntLanes whole;
  for (int l = 0; l < lane_count_of<float>; ++l) whole[l] = static_cast<std::int32_t>(::lrintf(v[l]));
  return whole;
#endif
}
/// `size` where `value` is positive, else -size.
KOKKOS_FORCEINLINE_FUNCTION FloatLanes turned_with(FloatLanes const& value, float size) {
#ifdef __AVX512F__  // in one instruction: (mask and value) xor size
  auto const bits = [](IntLanes const& of) { return reinterpret_cast<__m512i>(of); };
  return from_bits(reinterpret_cast<IntLanes>(
      _mm512_ternarylogic_epi32(bits(IntLanes{} + INT32_MIN), bits(bits_of(value)), bits(bits_of(FloatLanes(size))), 0x6a)));
#else
  return from_bits((bits_of(value) & (IntLanes{} + INT32_MIN)) ^ bits_of(FloatLanes(size)));
#endif
}
KOKKOS_FORCEINLINE_FUNCTION IntLanes select_ints(MaskOf<FloatLanes> const& mask, IntLanes const& yes, IntLanes const& no) {
  return bits_of(select(mask, from_bits(yes), from_bits(no)));
}
#else
KOKKOS_FORCEINLINE_FUNCTION IntLanes load_ints(void const* from) {
  IntLanes value;
  __builtin_memcpy(&value, from, sizeof value);
  return value;
}
KOKKOS_FORCEINLINE_FUNCTION void store_ints(std::int32_t* to, IntLanes value) { *to = value; }
KOKKOS_FORCEINLINE_FUNCTION IntLanes sum(IntLanes a, IntLanes b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
KOKKOS_FORCEINLINE_FUNCTION float to_float(IntLanes value) { return static_cast<float>(value); }
KOKKOS_FORCEINLINE_FUNCTION IntLanes truncated(float value) { return static_cast<std::int32_t>(value); }
KOKKOS_FORCEINLINE_FUNCTION IntLanes rounded(float value) { return static_cast<std::int32_t>(::lrintf(value)); }
KOKKOS_FORCEINLINE_FUNCTION float turned_with(float value, float size) { return std::signbit(value) ? -size : size; }
KOKKOS_FORCEINLINE_FUNCTION IntLanes select_ints(bool mask, IntLanes yes, IntLanes no) { return mask ? yes : no; }
#endif
/// `value` within [-limit, limit].
KOKKOS_FORCEINLINE_FUNCTION IntLanes clamped(IntLanes const& value, IntLanes const& limit) {
  IntLanes const below = value < limit ? value : limit;
  return below > -limit ? below : -limit;
}

template <>
struct HistoryOf<MixedPrecision> {
  using Value = IntLanes;
  using Scale = HistoryScale<float>;
  KOKKOS_FORCEINLINE_FUNCTION static Value none() { return Value{}; }
  KOKKOS_FORCEINLINE_FUNCTION static Value read(RealField const& field, std::size_t e) {
    return load_ints(field.data<std::int32_t>() + e);
  }
  KOKKOS_FORCEINLINE_FUNCTION static void write(RealField const& field, std::size_t e, Value const& value) {
    store_ints(field.data<std::int32_t>() + e, value);
  }
  /// A stiffness as advanced() takes it: units a step for a rate of one.
  template <class Stiffness>
  KOKKOS_FORCEINLINE_FUNCTION static Stiffness of_step(Stiffness const& stiffness, Scale const& scale) {
    return stiffness * scale.per_rate;
  }
  /// @param motion  its rate
  template <class Stiffness>
  KOKKOS_FORCEINLINE_FUNCTION static Value advanced(Value const& old, Stiffness const& stiffness, FloatLanes const& motion,
                                                    Scale const& scale) {
    return sum(old, rounded(times_plus(motion, FloatLanes(stiffness), turned_with(motion, scale.rounding))));
  }
  KOKKOS_FORCEINLINE_FUNCTION static FloatLanes number(Value const& value) { return to_float(value); }
  /// Limits as whole units, towards zero: what is kept is what acts.
  /// @param limit  below 2^31 units
  KOKKOS_FORCEINLINE_FUNCTION static Value limited(Value const& trial, FloatLanes const& limit) {
    return clamped(trial, truncated(limit));
  }
  KOKKOS_FORCEINLINE_FUNCTION static Value limited(Value const& trial, FloatLanes const& limit, MaskOf<FloatLanes> const& free) {
    return clamped(trial, select_ints(free, Value{} + INT32_MAX, truncated(limit)));
  }
  KOKKOS_FORCEINLINE_FUNCTION static Value choose(MaskOf<FloatLanes> const& mask, Value const& yes, Value const& no) {
    return select_ints(mask, yes, no);
  }
};

}  // namespace clathra
