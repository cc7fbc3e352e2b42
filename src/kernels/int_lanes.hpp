#pragma once
/// Whole numbers of 32 bits side by side with FloatLanes, and one beside one float.
#include "kernels/lane.hpp"

namespace clathra {

KOKKOS_FORCEINLINE_FUNCTION std::int32_t bits_of(float value) {
  std::int32_t bits;
  __builtin_memcpy(&bits, &value, sizeof bits);
  return bits;
}
KOKKOS_FORCEINLINE_FUNCTION float from_bits(std::int32_t bits) {
  float value;
  __builtin_memcpy(&value, &bits, sizeof value);
  return value;
}
/// The difference modulo 2^32.
KOKKOS_FORCEINLINE_FUNCTION std::int32_t difference(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}
KOKKOS_FORCEINLINE_FUNCTION std::int32_t shifted_up(std::int32_t a, int bits) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) << bits);
}
KOKKOS_FORCEINLINE_FUNCTION float to_float(std::int32_t value) { return static_cast<float>(value); }
/// To the nearest whole number, of two the even one; below 2^31.
KOKKOS_FORCEINLINE_FUNCTION std::int32_t rounded(float value) { return static_cast<std::int32_t>(::lrintf(value)); }
KOKKOS_FORCEINLINE_FUNCTION std::int32_t select_ints(bool mask, std::int32_t yes, std::int32_t no) { return mask ? yes : no; }
/// The sum of the squares of both halves, numbers of 16 bits.
KOKKOS_FORCEINLINE_FUNCTION std::int32_t squares_of_halves(std::int32_t a) {
  std::int32_t const low = shifted_up(a, 16) >> 16, high = a >> 16;
  return low * low + high * high;
}

#ifdef CLATHRA_SIMD
struct PlainInts {
  using Type [[gnu::vector_size(sizeof(FloatLanes))]] = std::int32_t;
  using Unsigned [[gnu::vector_size(sizeof(FloatLanes))]] = std::uint32_t;
};
using IntLanes = PlainInts::Type;
KOKKOS_FORCEINLINE_FUNCTION IntLanes bits_of(FloatLanes const& value) {
  return (IntLanes) static_cast<PlainVector<float>>(value);
}
KOKKOS_FORCEINLINE_FUNCTION FloatLanes from_bits(IntLanes const& bits) { return FloatLanes((PlainVector<float>)bits); }
KOKKOS_FORCEINLINE_FUNCTION IntLanes difference(IntLanes const& a, IntLanes const& b) {
  return (IntLanes)((PlainInts::Unsigned)a - (PlainInts::Unsigned)b);
}
KOKKOS_FORCEINLINE_FUNCTION IntLanes shifted_up(IntLanes const& a, int bits) {
  return (IntLanes)((PlainInts::Unsigned)a << bits);
}
KOKKOS_FORCEINLINE_FUNCTION FloatLanes to_float(IntLanes const& value) {
  return FloatLanes(__builtin_convertvector(value, PlainVector<float>));
}
KOKKOS_FORCEINLINE_FUNCTION IntLanes rounded(FloatLanes const& value) {
  auto const v = static_cast<PlainVector<float>>(value);
#if defined(__AVX512F__)
  return reinterpret_cast<IntLanes>(_mm512_cvtps_epi32(v));
#elif defined(__AVX2__)
  return reinterpret_cast<IntLanes>(_mm256_cvtps_epi32(v));
#else
  IntLanes whole;
  for (int l = 0; l < lane_count_of<float>; ++l) whole[l] = rounded(float(v[l]));
  return whole;
#endif
}
KOKKOS_FORCEINLINE_FUNCTION IntLanes squares_of_halves(IntLanes const& a) {
#if defined(__AVX512BW__)
  return reinterpret_cast<IntLanes>(_mm512_madd_epi16(reinterpret_cast<__m512i>(a), reinterpret_cast<__m512i>(a)));
#elif defined(__AVX2__) && !defined(__AVX512F__)
  return reinterpret_cast<IntLanes>(_mm256_madd_epi16(reinterpret_cast<__m256i>(a), reinterpret_cast<__m256i>(a)));
#else
  IntLanes const low = shifted_up(a, 16) >> 16, high = a >> 16;
  return low * low + high * high;
#endif
}
KOKKOS_FORCEINLINE_FUNCTION IntLanes select_ints(MaskOf<FloatLanes> const& mask, IntLanes const& yes, IntLanes const& no) {
  return bits_of(select(mask, from_bits(yes), from_bits(no)));
}
#else
using IntLanes = std::int32_t;
#endif

KOKKOS_FORCEINLINE_FUNCTION IntLanes load_ints(std::int32_t const* from) {
  IntLanes value;
  __builtin_memcpy(&value, from, sizeof value);
  return value;
}
KOKKOS_FORCEINLINE_FUNCTION void store_ints(std::int32_t* to, IntLanes const& value) {
  __builtin_memcpy(to, &value, sizeof value);
}

}  // namespace clathra
