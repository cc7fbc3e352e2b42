#pragma once
/// Logarithm, exponential and power from + - * / only, so that every CPU and GPU gives the same bits (libm differs between them).
#include <Kokkos_Core.hpp>
#include <cstdint>

#include "kernels/real.hpp"

namespace clathra {

namespace detail {
inline constexpr Real ln2_high = 6.93147180369123816490e-01;
inline constexpr Real ln2_low = 1.90821492927058770002e-10;

KOKKOS_FORCEINLINE_FUNCTION std::uint64_t bits_of(Real value) {
  std::uint64_t bits;
  __builtin_memcpy(&bits, &value, sizeof bits);
  return bits;
}
KOKKOS_FORCEINLINE_FUNCTION Real from_bits(std::uint64_t bits) {
  Real value;
  __builtin_memcpy(&value, &bits, sizeof value);
  return value;
}
}  // namespace detail

/// Natural logarithm of a positive normal number; relative error below 1e-15.
/// ln x = e ln 2 + 2 atanh(s), s = (m-1)/(m+1), with the mantissa m in [1/sqrt 2, sqrt 2).
KOKKOS_INLINE_FUNCTION Real natural_log(Real x) {
  std::uint64_t const bits = detail::bits_of(x);
  int exponent = static_cast<int>(bits >> 52) - 1023;
  Real mantissa = detail::from_bits((bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL);
  if (mantissa > 1.41421356237309515) {
    mantissa *= 0.5;
    ++exponent;
  }
  Real const s = (mantissa - 1) / (mantissa + 1);
  Real const z = s * s;
  Real sum = 0;
  for (int k = 23; k >= 3; k -= 2) sum = sum * z + Real(1) / k;
  Real const atanh2 = 2 * s + 2 * s * z * sum;
  return exponent * detail::ln2_high + (atanh2 + exponent * detail::ln2_low);
}

/// e^x for |x| < 700; relative error below 1e-15. x = k ln 2 + r, |r| <= ln 2 / 2, e^r by its Taylor series.
KOKKOS_INLINE_FUNCTION Real exponential(Real x) {
  if (x < -700) return 0;
  Real const scaled = x * 1.4426950408889634;
  int const k = static_cast<int>(scaled + (scaled < 0 ? -0.5 : 0.5));
  Real const r = (x - k * detail::ln2_high) - k * detail::ln2_low;
  Real sum = 1;
  for (int n = 14; n >= 1; --n) sum = 1 + sum * r / n;
  return sum * detail::from_bits(static_cast<std::uint64_t>(k + 1023) << 52);
}

/// base^exponent for base > 0; relative error below 4e-16 max(1, |exponent ln base|).
KOKKOS_INLINE_FUNCTION Real power(Real base, Real exponent) { return exponential(exponent * natural_log(base)); }

}  // namespace clathra
