#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>

namespace clathra {

/// Half a unit of the last digit of a number as a table prints it: "1.4589e8" gives 500.
inline double half_unit_of(std::string const& printed) {
  auto const mantissa_end = printed.find_first_of("eE");
  auto const point = printed.find('.');
  int exponent = mantissa_end == std::string::npos ? 0 : std::stoi(printed.substr(mantissa_end + 1));
  if (point != std::string::npos) exponent -= static_cast<int>(std::min(mantissa_end, printed.size()) - point - 1);
  return 0.5 * std::pow(10.0, exponent);
}

/// The number that follows a phrase in a text; not a number where it is not there.
inline double number_after(std::string const& text, std::string const& phrase) {
  auto const at = text.find(phrase);
  return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + phrase.size()));
}

/// Agreement with a printed number to its last digit; "0" means exactly zero.
inline testing::AssertionResult agrees(double value, std::string const& printed) {
  double const expected = std::stod(printed);
  bool const same = printed == "0" ? value == 0 : std::fabs(value - expected) <= half_unit_of(printed) * (1 + 1e-9);
  if (same) return testing::AssertionSuccess();
  return testing::AssertionFailure() << testing::PrintToString(value) << " is not " << printed << " to its printed digits";
}

/// |value / expected - 1| <= tolerance, against a value of higher precision.
inline testing::AssertionResult within(long double tolerance, double value, long double expected) {
  long double const error = std::fabs(static_cast<long double>(value) - expected);
  if (error <= tolerance * std::fabs(expected)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << testing::PrintToString(value) << " differs from " << static_cast<double>(expected)
                                     << " by a share of " << static_cast<double>(error / std::fabs(expected));
}

inline testing::AssertionResult same_bits(double a, double b) {
  if (std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << std::hexfloat << a << " and " << b << " have different bits";
}

/// a = -b to the bit; the sign of zero, which no sum can see, is left out.
inline testing::AssertionResult exact_opposites(double a, double b) {
  if (a == 0 && b == 0) return testing::AssertionSuccess();
  return same_bits(a, -b);
}

}  // namespace clathra
