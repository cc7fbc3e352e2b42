#pragma once
/// Quantities as people write them ("1 MPa", "0.1694 mm", "5 %/min") against SI numbers.
#include <string>
#include <string_view>

namespace clathra {

/// What a number measures. SI units, except temperatures, which are in deg C everywhere in Clathra.
enum class Dimension {
  ratio,        ///< a plain number or a percentage: "26 %" = 0.26
  length,       ///< [m]
  pressure,     ///< [Pa]
  density,      ///< [kg/m^3]
  temperature,  ///< [deg C]; "278.15 K" is taken as well
  rate,         ///< [1/s]: "5 %/min"
  stiffness,    ///< [N/m per metre thickness = Pa]: "300 MPa" and "3e8 N/m" mean the same
  line_force,   ///< force per metre thickness [N/m]
  duration,     ///< [s]: "3 h"
};

/// Reads a number with a unit, or a bare number, which is in SI units. A bare temperature is refused: 5 could be deg C or K.
/// Decimal prefixes shift the decimal point before the number is rounded, so "0.1694 mm" and "1.694e-4 m" give the same bits.
/// @throws std::invalid_argument with a text that follows the name of a key: "needs a pressure, got a length ('1 mm'); example:
/// "1 MPa""
double parse_quantity(std::string_view text, Dimension dimension);

/// Reads a number without unit; the whole text must be a finite number. No locale, no sign of infinity.
/// @throws std::invalid_argument "needs a number, got 'x'"
double parse_number(std::string_view text);

/// Reads a number as a program wrote it: the same without blanks, and nan or inf where a test has no value.
/// @throws std::invalid_argument, as parse_number()
double parse_written_number(std::string_view text);

/// The shortest text that parse_quantity() reads back to the same bits, with a unit fit to be read where one does ("1 MPa").
std::string format_quantity(double value, Dimension dimension);

/// The shortest text of a number that reads back to the same bits.
std::string format_number(double value);

/// A text in quotes for a message: no more than 40 of its bytes, question marks for those that a terminal may not show.
std::string quote_of(std::string_view text);

/// The signs that people copy from elsewhere, in the letters of our units: two kinds of mu, degrees, powers, the space that does
/// not break.
std::string in_ascii(std::string_view text);

/// "a pressure", with its article.
std::string_view dimension_name(Dimension dimension);
/// The unit of a bare number: "Pa"; empty for a ratio.
std::string_view bare_unit(Dimension dimension);
/// A quantity to copy, with quotes where it has a unit: "\"1 MPa\"".
std::string_view quantity_example(Dimension dimension);

}  // namespace clathra
