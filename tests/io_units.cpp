#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "domain/scene/units.hpp"

namespace clathra {
namespace {

std::string refusal(std::string const& text, Dimension dimension) {
  try {
    parse_quantity(text, dimension);
  } catch (std::invalid_argument const& problem) {
    return problem.what();
  }
  return "taken";
}

TEST(Units, QuantitiesAreReadIntoSi) {
  EXPECT_EQ(parse_quantity("1 MPa", Dimension::pressure), 1e6);
  EXPECT_EQ(parse_quantity("0.1694 mm", Dimension::length), 0.1694e-3);
  EXPECT_EQ(parse_quantity("5 degC", Dimension::temperature), 5);
  EXPECT_EQ(parse_quantity("5 %/min", Dimension::rate), 0.05 / 60);
  EXPECT_EQ(parse_quantity("0.9 g/cm^3", Dimension::density), 900);
  EXPECT_EQ(parse_quantity("200 N/m", Dimension::line_force), 200);
  EXPECT_EQ(parse_quantity("2 um", Dimension::length), 2e-6);
  EXPECT_EQ(parse_quantity("26 %", Dimension::ratio), 0.26);
  EXPECT_EQ(parse_quantity("0.26", Dimension::ratio), 0.26);
  EXPECT_EQ(parse_quantity("1e6", Dimension::pressure), 1e6);
  EXPECT_EQ(parse_quantity("10 bar", Dimension::pressure), 1e6);
}

TEST(Units, SpacesSignsAndExponentsMayBeWrittenAsUsual) {
  EXPECT_EQ(parse_quantity("1MPa", Dimension::pressure), 1e6);
  EXPECT_EQ(parse_quantity("  1.5e+0 \t kPa ", Dimension::pressure), 1500);
  EXPECT_EQ(parse_quantity("+.5 mm", Dimension::length), 0.5e-3);
  EXPECT_EQ(parse_quantity("-2 um", Dimension::length), -2e-6);
  EXPECT_EQ(parse_quantity("3e8 N/m", Dimension::stiffness), parse_quantity("300 MPa", Dimension::stiffness));
  EXPECT_EQ(parse_quantity("1 kg*m/s^2/m", Dimension::line_force), 1);
}

TEST(Units, TheSameQuantityGivesTheSameBitsInEveryUnit) {
  EXPECT_EQ(parse_quantity("0.1694 mm", Dimension::length), parse_quantity("169.4 um", Dimension::length));
  EXPECT_EQ(parse_quantity("0.1694 mm", Dimension::length), parse_quantity("1.694e-4", Dimension::length));
  EXPECT_EQ(parse_quantity("0.9 g/cm^3", Dimension::density), parse_quantity("900 kg/m^3", Dimension::density));
}

TEST(Units, TemperaturesAreInCelsiusAndNeedTheirUnit) {
  EXPECT_DOUBLE_EQ(parse_quantity("278.15 K", Dimension::temperature), 5);
  EXPECT_NE(refusal("5", Dimension::temperature).find("degC or K"), std::string::npos);
}

TEST(Units, AWrongDimensionIsNamedWithAnExample) {
  EXPECT_EQ(refusal("1 mm", Dimension::pressure), "needs a pressure, got a length ('1 mm'); example: \"1 MPa\"");
  EXPECT_NE(refusal("5 min", Dimension::rate).find("got a time"), std::string::npos);
  EXPECT_NE(refusal("2 kN", Dimension::line_force).find("got a force ('2 kN')"), std::string::npos);
  EXPECT_NE(refusal("5 K/s", Dimension::temperature).find("something else"), std::string::npos);
}

TEST(Units, AUnitOfTheWrongCaseIsRefusedWithTheRightOne) {
  EXPECT_EQ(refusal("2 Mpa", Dimension::pressure), "has an unknown unit 'Mpa' in '2 Mpa'; did you mean 'MPa'?");
  EXPECT_EQ(refusal("2 mn/m", Dimension::line_force), "has an unknown unit 'mn' in '2 mn/m'; did you mean 'mN' or 'MN'?");
  EXPECT_EQ(refusal("2 x", Dimension::pressure), "has an unknown unit 'x' in '2 x'");
}

TEST(Units, SignsThatPeopleCopyAreRead) {
  for (char const* const text : {"169.4 \xc2\xb5m", "169.4 \xce\xbcm", "169.4\xc2\xa0um"})
    EXPECT_EQ(parse_quantity(text, Dimension::length), parse_quantity("169.4 um", Dimension::length)) << text;
  EXPECT_EQ(parse_quantity("5 \xc2\xb0"
                           "C",
                           Dimension::temperature),
            5);
  EXPECT_EQ(parse_quantity("\xe2\x88\x92"
                           "5 degC",
                           Dimension::temperature),
            -5);
  EXPECT_EQ(parse_quantity("2 N/mm\xc2\xb2", Dimension::pressure), 2e6);
  EXPECT_EQ(parse_quantity("2.6 g/cm\xc2\xb3", Dimension::density), 2600);
}

TEST(Units, AHintSaysHowToWriteWhatWasMeant) {
  auto const said = [](char const* text, Dimension dimension) {
    try {
      return "read as " + std::to_string(parse_quantity(text, dimension));
    } catch (std::invalid_argument const& problem) {
      return std::string(problem.what());
    }
  };
  EXPECT_EQ(said("55,0 %", Dimension::ratio), "has a decimal comma; write a point: 55.0 %");
  EXPECT_EQ(said("0,1694mm", Dimension::length), "has a decimal comma; write a point: 0.1694mm");
  EXPECT_EQ(said("1,000 kPa", Dimension::pressure),
            "has a comma, which may be a decimal one or set apart thousands; write 1.000 kPa or 1000 kPa");
  EXPECT_EQ(said("1e6 N/m2", Dimension::pressure), "has an unknown unit 'm2' in '1e6 N/m2'; did you mean 'm^2'?");
  EXPECT_EQ(said("170 microns", Dimension::length), "has an unknown unit 'microns' in '170 microns'; did you mean 'um'?");
  EXPECT_EQ(said("5 deg C", Dimension::temperature), "has an unknown unit 'deg C' in '5 deg C'; did you mean 'degC'?");
  EXPECT_EQ(said("3 /s", Dimension::rate), "has an unknown unit '' in '3 /s'; a rate is written 1/s");
  EXPECT_EQ(said("26 percent", Dimension::ratio), "has an unknown unit 'percent' in '26 percent'; did you mean '%'?");
  EXPECT_EQ(said("0.9 g/cc", Dimension::density), "has an unknown unit 'cc' in '0.9 g/cc'; did you mean 'cm^3'?");
  for (char const* const angle : {"30deg", "30 degrees", "30\xc2\xb0", "0.5235987755982988 rad"})
    EXPECT_NE(said(angle, Dimension::ratio).find(", where a coefficient is needed: the tangent of the angle, 0.577"),
              std::string::npos)
        << said(angle, Dimension::ratio);
  EXPECT_EQ(said("2 g/cm3", Dimension::density), "has an unknown unit 'cm3' in '2 g/cm3'; did you mean 'cm^3'?");
}

TEST(Units, NonsenseIsRefusedAndNeverGuessed) {
  for (char const* const text : {"",
                                 " ",
                                 "MPa",
                                 "one MPa",
                                 "1 Mpa",
                                 "1 MPA",
                                 "1,5 MPa",
                                 "0x10 Pa",
                                 "nan",
                                 "inf",
                                 "1e400 Pa",
                                 "1e99999999999999999999 Pa",
                                 "1 MPa MPa",
                                 "1 /",
                                 "1 m^",
                                 "1 m^99",
                                 "1 m^0",
                                 "1 m//s",
                                 "1 m*m*m*m*m*m*m*m*m*m",
                                 "--1 m",
                                 "1 \xc2\xb5m"})
    EXPECT_NE(refusal(text, Dimension::pressure), "taken") << text;
  EXPECT_LT(refusal(std::string(100000, 'x'), Dimension::length).size(), 200u);
}

TEST(Units, WhatIsWrittenReadsBackToTheSameBits) {
  double const values[] = {0,         1,         -1, 0.1, 1.0 / 3, 1e6, 0.1694e-3, 2e-6, 8e6, 900, 1e-300, 1.7976931348623157e308,
                           0.05 / 60, 123456.789};
  for (double const value : values)
    for (Dimension const dimension :
         {Dimension::ratio, Dimension::length, Dimension::pressure, Dimension::density, Dimension::temperature, Dimension::rate,
          Dimension::stiffness, Dimension::line_force, Dimension::duration})
      EXPECT_EQ(parse_quantity(format_quantity(value, dimension), dimension), value) << format_quantity(value, dimension);
  EXPECT_EQ(format_quantity(1e6, Dimension::pressure), "1 MPa");
  EXPECT_EQ(format_quantity(1e13, Dimension::stiffness), "10 TPa");
  EXPECT_EQ(format_quantity(0.1694e-3, Dimension::length), "0.1694 mm");
  EXPECT_EQ(format_quantity(5, Dimension::temperature), "5 degC");
  EXPECT_EQ(format_quantity(0.26, Dimension::ratio), "0.26");
  EXPECT_EQ(format_quantity(30000, Dimension::density), "30000 kg/m^3");
  EXPECT_EQ(format_quantity(1e-12, Dimension::rate), "1e-12 1/s");
  EXPECT_EQ(format_quantity(0, Dimension::pressure), "0");
}

}  // namespace
}  // namespace clathra
