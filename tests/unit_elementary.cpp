#include <limits>

#include "draw.hpp"
#include "kernels/elementary.hpp"
#include "printed_number.hpp"

namespace clathra {
namespace {

constexpr double accuracy = 1e-15;

TEST(Elementary, LogarithmAgreesWithTheLibraryOverAllNormalNumbers) {
  Draw draw(1);
  for (int n = 0; n < 200000; ++n) {
    double const x = std::exp2(draw.between(-1022, 1023.999));
    ASSERT_TRUE(within(accuracy, natural_log(x), std::log(static_cast<long double>(x)))) << x;
  }
}

TEST(Elementary, LogarithmKeepsItsRelativeAccuracyAroundOne) {
  Draw draw(2);
  for (int n = 0; n < 200000; ++n) {
    double const x = 1 + draw.either_sign(draw.of_size(0x1p-52, 0.5));
    ASSERT_TRUE(within(accuracy, natural_log(x), std::log(static_cast<long double>(x)))) << x;
  }
}

TEST(Elementary, LogarithmIsRightAtTheEndsAndAtTheSeamsOfItsReduction) {
  double const sqrt2 = 1.4142135623730951;
  double const above = std::nextafter(sqrt2, 2.0), below = std::nextafter(sqrt2, 1.0);
  for (double x : {std::numeric_limits<double>::min(), std::numeric_limits<double>::max(), 0.5, 2.0, sqrt2, above, below,
                   0.5 * above, std::nextafter(1.0, 0.0), std::nextafter(1.0, 2.0), std::nextafter(2.0, 1.0)}) {
    EXPECT_TRUE(within(accuracy, natural_log(x), std::log(static_cast<long double>(x)))) << x;
  }
  EXPECT_EQ(natural_log(1.0), 0.0);
}

TEST(Elementary, ExponentialAgreesWithTheLibraryOverItsRange) {
  Draw draw(3);
  for (int n = 0; n < 200000; ++n) {
    double const x = n % 2 != 0 ? draw.between(-700, 700) : draw.either_sign(draw.of_size(1e-20, 700));
    ASSERT_TRUE(within(accuracy, exponential(x), std::exp(static_cast<long double>(x)))) << x;
  }
}

TEST(Elementary, ExponentialIsRightAtTheEndsAndAtTheSeamsOfItsReduction) {
  double const seam = 0.5 * 0.6931471805599453;
  for (double x : {-700.0, 700.0, 1.0, -1.0, seam, -seam, std::nextafter(seam, 1.0), std::nextafter(-seam, -1.0), 3 * seam}) {
    EXPECT_TRUE(within(accuracy, exponential(x), std::exp(static_cast<long double>(x)))) << x;
  }
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_EQ(exponential(-0.0), 1.0);
  EXPECT_EQ(exponential(std::nextafter(-700.0, -701.0)), 0.0);
  EXPECT_EQ(exponential(-1e300), 0.0);
  EXPECT_EQ(exponential(-std::numeric_limits<double>::infinity()), 0.0);
}

TEST(Elementary, PowerOfTheEnvelopeAgreesWithTheLibrary) {
  Draw draw(4);
  for (int n = 0; n < 200000; ++n) {
    double const base = draw.of_size(1e-3, 40);  // -ln x for 4e-18 < x < 0.999
    ASSERT_TRUE(within(2e-15, power(base, 0.59), std::pow(static_cast<long double>(base), 0.59L))) << base;
  }
}

TEST(Elementary, PowerLosesNoMoreDigitsThanItsExponentCosts) {
  Draw draw(5);
  for (int n = 0; n < 200000; ++n) {
    double const base = draw.of_size(1e-300, 1e300), exponent = draw.between(-1, 1);
    long double const exact = std::pow(static_cast<long double>(base), static_cast<long double>(exponent));
    double const size = std::fabs(exponent * std::log(base));
    ASSERT_TRUE(within(4e-16 * std::max(1.0, size), power(base, exponent), exact)) << base << "^" << exponent;
  }
}

TEST(Elementary, PowerKnowsTheExactCases) {
  EXPECT_EQ(power(1.0, 0.59), 1.0);
  EXPECT_EQ(power(7.3, 0.0), 1.0);
  EXPECT_TRUE(within(accuracy, power(2.0, 0.5), std::sqrt(2.0L)));
  EXPECT_TRUE(within(18 * 4e-16, power(0x1p-52, 0.5), 0x1p-26L));
}

}  // namespace
}  // namespace clathra
