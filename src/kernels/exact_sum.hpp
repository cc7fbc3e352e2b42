#pragma once
/// Sums that do not depend on their order: fixed-point integers in four words.
#include <Kokkos_Core.hpp>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "kernels/lane.hpp"
#include "kernels/sum_over_ranks.hpp"

// GCC unrolls short loops before it looks for vectors in them.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__CUDACC__) && !defined(__HIPCC__)
#define CLATHRA_KEEP_LOOP _Pragma("GCC unroll 1")
#else
#define CLATHRA_KEEP_LOOP
#endif

namespace clathra {

/// A number in units of its own, as four digits to the base 2^31: high + middle 2^-31 + low 2^-62 + lowest 2^-93. Each digit has
/// 32 bits of room, so up to 2^32 terms can be added in any order. A term must be below 2^31 units: then each of its digits is
/// one of 32 bits with a sign, which AVX2 converts in vectors, too; of 64 bits AVX-512 alone does.
struct FixedPoint {
  static constexpr int words = 4, bits = 31;  // of a digit
  std::int64_t word[words] = {0, 0, 0, 0};
  static constexpr Real base = 2147483648.0;        // 2^31
  static constexpr Real largest_term = base;        // in units
  static constexpr std::int64_t mask = 0x7fffffff;  // of a digit

  KOKKOS_INLINE_FUNCTION static bool holds(Real value) { return value < largest_term && value > -largest_term; }

  /// The leading digit of a value of which holds() is true, which keeps the others.
  KOKKOS_FORCEINLINE_FUNCTION static std::int32_t take_digit(Real& value) {
    auto const digit = static_cast<std::int32_t>(value);
    value = (value - static_cast<Real>(digit)) * base;
    return digit;
  }
  /// A sum from its digits. @param apart  numbers from one to the next
  KOKKOS_INLINE_FUNCTION static FixedPoint of(std::int64_t const* digits, int apart = 1) {
    FixedPoint sum;
    for (int k = 0; k < words; ++k) sum.word[k] = digits[apart * k];
    return sum;
  }
  /// Adds a term to the digits of a sum. @return whether it is in range: else nothing is added
  KOKKOS_INLINE_FUNCTION static bool add(Real value, std::int64_t* digits) {
    if (!holds(value)) return false;
    for (int k = 0; k < words; ++k) digits[k] += take_digit(value);
    return true;
  }
  KOKKOS_INLINE_FUNCTION Real value() const {
    FixedPoint number = *this;
    number.carry();
    bool const negative = number.word[0] < 0;
    if (negative) {  // so that a sum and its opposite round alike
      for (std::int64_t& digit : number.word) digit = -digit;
      number.carry();
    }
    Real sum = 0;
    for (int k = words - 1; k > 0; --k) sum = (sum + static_cast<Real>(number.word[k])) / base;
    sum += static_cast<Real>(number.word[0]);
    return negative ? -sum : sum;
  }

 private:
  KOKKOS_INLINE_FUNCTION void carry() {
    for (int k = words - 1; k > 0; --k) {
      word[k - 1] += word[k] >> bits;
      word[k] &= mask;
    }
  }
};

/// A term of a sum was not finite or too large for it.
struct SumOutOfRange : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Powers of two near the quantities of a specimen: the units of its sums. They follow its scale, so that a specimen that is 2^n
/// times as large or as stiff has the same digits in all its sums.
struct SumUnits {
  Real length = 1;   ///< [m]
  Real stress = 1;   ///< [Pa]
  Real density = 1;  ///< [kg/m^3]

  /// @param d50 [m];  @param stress  a stiffness per metre thickness will do: a wide range is left on either side [Pa]
  static SumUnits of(Real d50, Real stress, Real density) { return {near(d50), near(stress), near(density)}; }
  /// The largest power of two that is not above a positive number; 1 where there is none.
  static Real near(Real value) { return value > 0 ? std::ldexp(Real(1), std::ilogb(value)) : 1; }

  Real area() const { return length * length; }
  Real force() const { return stress * length; }   ///< [N/m]
  Real energy() const { return stress * area(); }  ///< [J/m]; also of stress times area
  Real mass() const { return density * area(); }   ///< [kg/m]
  Real speed() const { return near(std::sqrt(stress / density)); }
};

/// What exact sums are made of, and how many of them so many sums take.
using SumWord = std::int64_t;
constexpr int sum_words(int count) { return FixedPoint::words * count + 1; }

/// Words of sums that threads add to at any time, each with an atomic operation: whole numbers do not know their order.
struct SharedSums {
  SumWord* words;

  struct Word {
    SumWord* at;
    KOKKOS_FORCEINLINE_FUNCTION void operator+=(SumWord term) const {
      if (term != 0) Kokkos::atomic_fetch_add(at, term);
    }
  };
  KOKKOS_FORCEINLINE_FUNCTION Word operator[](int k) const { return {words + k}; }
};

/// A reduction to the sums of `Count` quantities: same bits for any order and thread count. The sums' words stand digit by digit,
/// word k of quantity c at Count k + c, so that loops over quantities become vector code; behind them one more counts the terms
/// that are out of range.
template <int Count>
struct ExactSums {
  static constexpr int words = sum_words(Count), padded = (Count + lane_count - 1) / lane_count * lane_count;
  using value_type = SumWord[];
  unsigned value_count = words;
  Real per_unit[padded] = {};

  /// @param units  of each quantity, a power of two near its terms
  explicit ExactSums(Real const (&units)[Count]) {
    for (int c = 0; c < Count; ++c) per_unit[c] = 1 / units[c];
  }

  /// Adds the terms of one quantity that stand side by side. Their digits are whole numbers below 2^31, of which the sum of all
  /// lanes is exact. @param sums  SumWord* or SharedSums
  template <class Sums>
  KOKKOS_FORCEINLINE_FUNCTION void add(int quantity, Lanes const& terms, Sums sums) const {
    Lanes value = terms * Lanes(per_unit[quantity]);
    auto const beyond = !(lane_abs(value) < Lanes(FixedPoint::largest_term));
    if (any(beyond)) {
      sums[words - 1] += count_set(beyond);
      return;
    }
    for (int k = 0; k < FixedPoint::words; ++k) {
      Lanes const digit = lane_truncate(value);
      sums[Count * k + quantity] += static_cast<SumWord>(sum_of_lanes(digit));
      value = (value - digit) * FixedPoint::base;
    }
  }

  KOKKOS_FUNCTION void init(SumWord* sums) const {
    for (unsigned c = 0; c < value_count; ++c) sums[c] = 0;
  }
  KOKKOS_FUNCTION void join(SumWord* into, SumWord const* from) const {
    for (unsigned c = 0; c < value_count; ++c) into[c] += from[c];
  }
  // Kokkos before 4 calls join with volatile pointers.
  KOKKOS_FUNCTION void join(SumWord volatile* into, SumWord const volatile* from) const {
    for (unsigned c = 0; c < value_count; ++c) into[c] = into[c] + from[c];
  }

  // Of all sums together:
  static void add_other_ranks(SumWord* sums, SumOverRanks const& over_ranks) {
    if (over_ranks) over_ranks(sums, words);
  }
  KOKKOS_INLINE_FUNCTION static std::int64_t out_of_range(SumWord const* sums) { return sums[words - 1]; }
  /// @param unit  of that quantity
  KOKKOS_INLINE_FUNCTION static Real total(SumWord const* sums, int quantity, Real unit) {
    return FixedPoint::of(sums + quantity, Count).value() * unit;
  }
};

/// Sums `Count` quantities over i in [0, n): the functor fills `out[0 .. Count)` for index i.
template <int Count, class Terms>
struct ExactSumKernel : ExactSums<Count> {
  using Sums = ExactSums<Count>;
  Terms terms;

  ExactSumKernel(Terms const& of, Real const (&units)[Count]) : Sums(units), terms(of) {}

  KOKKOS_FUNCTION void operator()(int i, SumWord* sums) const {
    Real out[Sums::padded] = {};
    terms(i, out);
    bool empty = true, beyond = false;
    for (int c = 0; c < Sums::padded; c += lane_count) {
      Lanes const value = load(&out[c]) * load(&this->per_unit[c]);
      empty = empty && !any(value != Lanes(0));
      beyond = beyond || any(!(lane_abs(value) < Lanes(FixedPoint::largest_term)));
      store(&out[c], value);
    }
    if (empty) return;
    if (beyond) {
      for (int c = 0; c < Count; ++c) sums[Sums::words - 1] += FixedPoint::holds(out[c]) ? 0 : 1;
      return;
    }
    for (int k = 0; k < FixedPoint::words; ++k) {
      CLATHRA_KEEP_LOOP
      for (int c = 0; c < Count; ++c) sums[Count * k + c] += FixedPoint::take_digit(out[c]);
    }
  }
};

/// How the quantities of a specimen are summed.
struct Summation {
  SumUnits unit;
  SumOverRanks over_ranks;
};

/// @throws SumOutOfRange where terms of a sum were
inline void require_in_range(std::string const& what, std::int64_t out_of_range) {
  if (out_of_range == 0) return;
  throw SumOutOfRange(what + ": " + std::to_string(out_of_range) +
                      " of the terms are not finite or above 2^31 times the scale of the specimen");
}

/// A sum of numbers on the host, in any order and over all ranks.
class ExactSum {
 public:
  /// @param unit  a power of two near the terms
  explicit ExactSum(Real unit) : unit_(unit) {}
  void add(Real value) {
    if (!FixedPoint::add(value / unit_, words_)) ++words_[FixedPoint::words];
  }
  /// @throws SumOutOfRange on all ranks
  Real over(SumOverRanks const& ranks) {
    if (ranks) ranks(words_, FixedPoint::words + 1);
    require_in_range("a sum", words_[FixedPoint::words]);
    return FixedPoint::of(words_).value() * unit_;
  }

 private:
  Real unit_;
  std::int64_t words_[FixedPoint::words + 1] = {};
};

/// @param unit  of each quantity, a power of two near its terms
/// @return the sums in `result[0 .. Count)`;  @throws SumOutOfRange, on all ranks
template <int Count, class Terms>
void exact_sums(char const* label, int n, Terms const& terms, Real const (&unit)[Count], Real* result,
                SumOverRanks const& over_ranks = {}) {
  using Kernel = ExactSumKernel<Count, Terms>;
  SumWord sums[Kernel::words];
  Kokkos::parallel_reduce(
      label, Kokkos::RangePolicy<ExecutionSpace>(0, n), Kernel(terms, unit),
      Kokkos::View<SumWord*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>(sums, Kernel::words));
  Kernel::add_other_ranks(sums, over_ranks);
  require_in_range(label, Kernel::out_of_range(sums));
  for (int c = 0; c < Count; ++c) result[c] = Kernel::total(sums, c, unit[c]);
}

}  // namespace clathra
