#include "domain/scene/units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "domain/scene/short_number.hpp"
#include "domain/scene/utf8.hpp"

namespace clathra {
namespace {

/// Powers of metre, kilogram, second and kelvin.
struct Powers {
  int length = 0, mass = 0, time = 0, temperature = 0;
  bool operator==(Powers const&) const = default;
};

/// value in SI = value in the unit * 10^decimals * factor / divisor + offset.
struct Unit {
  std::string_view name;
  int decimals;
  double factor;
  Powers powers;
  double offset = 0, divisor = 1;
};

constexpr Powers plain{}, metre{1, 0, 0, 0}, kilogram{0, 1, 0, 0}, second{0, 0, 1, 0}, newton{1, 1, -2, 0}, pascal{-1, 1, -2, 0},
    kelvin{0, 0, 0, 1};

constexpr std::array units = {
    Unit{"m", 0, 1, metre},     Unit{"km", 3, 1, metre},          Unit{"cm", -2, 1, metre},
    Unit{"mm", -3, 1, metre},   Unit{"um", -6, 1, metre},         Unit{"nm", -9, 1, metre},
    Unit{"kg", 0, 1, kilogram}, Unit{"g", -3, 1, kilogram},       Unit{"mg", -6, 1, kilogram},
    Unit{"t", 3, 1, kilogram},  Unit{"s", 0, 1, second},          Unit{"ms", -3, 1, second},
    Unit{"us", -6, 1, second},  Unit{"ns", -9, 1, second},        Unit{"min", 0, 60, second},
    Unit{"h", 2, 36, second},   Unit{"d", 2, 864, second},        Unit{"N", 0, 1, newton},
    Unit{"mN", -3, 1, newton},  Unit{"kN", 3, 1, newton},         Unit{"MN", 6, 1, newton},
    Unit{"GN", 9, 1, newton},   Unit{"Pa", 0, 1, pascal},         Unit{"hPa", 2, 1, pascal},
    Unit{"kPa", 3, 1, pascal},  Unit{"MPa", 6, 1, pascal},        Unit{"GPa", 9, 1, pascal},
    Unit{"bar", 5, 1, pascal},  Unit{"atm", 0, 101325, pascal},   Unit{"psi", 0, 6894.757293168361, pascal},
    Unit{"%", -2, 1, plain},    Unit{"1", 0, 1, plain},           Unit{"degC", 0, 1, kelvin},
    Unit{"C", 0, 1, kelvin},    Unit{"K", 0, 1, kelvin, -273.15}, Unit{"Hz", 0, 1, {0, 0, -1, 0}},
    Unit{"TPa", 12, 1, pascal}, Unit{"in", -4, 254, metre},
};

struct DimensionEntry {
  std::string_view name, bare_unit, example;
  Powers powers;
  std::array<std::string_view, 5> shown;  ///< units that format_quantity() tries in turn
};

constexpr std::array<DimensionEntry, 9> dimensions = {{
    {"a plain number or a percentage", "", "0.26", plain, {}},
    {"a length", "m", "\"0.1694 mm\"", metre, {"m", "mm", "um", "nm"}},
    {"a pressure", "Pa", "\"1 MPa\"", pascal, {"GPa", "MPa", "kPa", "Pa"}},
    {"a density", "kg/m^3", "\"0.9 g/cm^3\"", {-3, 1, 0, 0}, {"kg/m^3"}},
    {"a temperature", "degC", "\"5 degC\"", kelvin, {"degC"}},
    {"a rate", "1/s", "\"5 %/min\"", {0, 0, -1, 0}, {"1/s"}},
    {"a stiffness", "N/m", "\"300 MPa\"", pascal, {"GPa", "MPa", "kPa", "Pa", "TPa"}},
    {"a force per metre", "N/m", "\"200 N/m\"", {0, 1, -2, 0}, {"MN/m", "kN/m", "N/m"}},
    {"a time", "s", "\"3 h\"", second, {"s"}},
}};

DimensionEntry const& entry(Dimension dimension) { return dimensions[static_cast<std::size_t>(dimension)]; }

std::string_view trimmed(std::string_view text) {
  auto const first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Length of the decimal number at the start of the text, 0 if there is none: sign, digits, fraction, exponent.
std::size_t number_length(std::string_view text) {
  auto const digits = [&](std::size_t at) {
    while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
    return at;
  };
  std::size_t const start = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  std::size_t end = digits(start);
  std::size_t count = end - start;
  if (end < text.size() && text[end] == '.') {
    std::size_t const fraction = digits(end + 1);
    count += fraction - end - 1;
    end = fraction;
  }
  if (count == 0) return 0;
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t const sign = end + 1 < text.size() && (text[end + 1] == '-' || text[end + 1] == '+') ? 2 : 1;
    if (std::size_t const exponent = digits(end + sign); exponent > end + sign) end = exponent;
  }
  return end;
}

/// The number whose text has the form that number_length() accepts, its decimal point moved `decimals` places to the right.
double shifted_number(std::string_view text, int decimals) {
  auto const split = text.find_first_of("eE");
  std::string digits(text.substr(0, split));
  if (digits[0] == '+') digits.erase(0, 1);
  long exponent = 0;
  if (split != std::string_view::npos) {
    std::string_view part = text.substr(split + 1);
    if (part[0] == '+') part.remove_prefix(1);
    if (std::from_chars(part.data(), part.data() + part.size(), exponent).ec != std::errc{})
      throw std::invalid_argument("is out of range: " + quote_of(text));
  }
  digits += 'e';
  digits += std::to_string(exponent + decimals);
  double value = 0;
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
    throw std::invalid_argument("is out of range: " + quote_of(text));
  return value;
}

Unit const* find_unit(std::string_view name) {
  for (Unit const& unit : units)
    if (unit.name == name) return &unit;
  return nullptr;
}

bool same_but_for_case(std::string_view a, std::string_view b) {
  auto const small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return small(x) == small(y); });
}

/// What people write, and what it is here.
constexpr std::pair<std::string_view, std::string_view> other_names[] = {
    {"micron", "um"}, {"microns", "um"}, {"micrometre", "um"}, {"micrometer", "um"}, {"cc", "cm^3"},      {"percent", "%"},
    {"pct", "%"},     {"per cent", "%"}, {"deg C", "degC"},    {"deg", "degC"},      {"celsius", "degC"}, {"kelvin", "K"},
    {"sec", "s"},     {"second", "s"},   {"seconds", "s"},     {"minute", "min"},    {"minutes", "min"},  {"hr", "h"},
    {"hour", "h"},    {"hours", "h"},    {"day", "d"},         {"days", "d"},        {"inch", "in"},      {"metre", "m"},
    {"meter", "m"},   {"pascal", "Pa"},  {"newton", "N"}};

/// "; did you mean 'MPa'?" for "Mpa", or nothing; of units that differ in their case alone (mN, MN) it names all.
std::string unit_suggestion(std::string_view name) {
  std::string hint;
  if (name.empty()) return "; a rate is written 1/s";
  for (auto const& [theirs, ours] : other_names)
    if (same_but_for_case(theirs, name)) return "; did you mean '" + std::string(ours) + "'?";
  if (std::string_view const letters = name.substr(0, name.find_last_not_of("0123456789") + 1);
      letters.size() < name.size() && find_unit(letters))
    return "; did you mean '" + std::string(letters) + "^" + std::string(name.substr(letters.size())) + "'?";
  for (Unit const& unit : units) {
    if (!same_but_for_case(unit.name, name)) continue;
    hint += hint.empty() ? "; did you mean '" : " or '";
    hint += unit.name;
    hint += '\'';
  }
  if (!hint.empty()) hint += '?';
  return hint;
}

/// Multiplies one factor of a unit expression ("cm^3", "min") into the product, or divides by it.
void multiply(Unit& product, std::string_view factor, int sign, std::string_view whole) {
  int power = 1;
  if (auto const hat = factor.find('^'); hat != std::string_view::npos) {
    std::string_view const text = factor.substr(hat + 1);
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), power);
    if (error != std::errc{} || end != text.data() + text.size() || power < -4 || power > 4 || power == 0)
      throw std::invalid_argument("has a unit with a strange power: " + quote_of(whole));
    factor = factor.substr(0, hat);
  }
  Unit const* const unit = find_unit(factor);
  if (!unit)
    throw std::invalid_argument("has an unknown unit " + quote_of(factor) + " in " + quote_of(whole) + unit_suggestion(factor));
  power *= sign;
  product.decimals += unit->decimals * power;
  for (int i = 0; i < power; ++i) product.factor *= unit->factor;
  for (int i = 0; i > power; --i) product.divisor *= unit->factor;
  product.powers.length += unit->powers.length * power;
  product.powers.mass += unit->powers.mass * power;
  product.powers.time += unit->powers.time * power;
  product.powers.temperature += unit->powers.temperature * power;
  product.offset = unit->offset;  // cleared below where the unit is not alone
}

/// "N/m", "g/cm^3", "%/min", "kg*m/s^2": factors joined by * or /, read from left to right.
Unit parse_unit(std::string_view text, std::string_view whole) {
  Unit product{text, 0, 1, {}};
  int sign = 1, factors = 0;
  for (std::size_t at = 0;; ++factors) {
    if (factors == 8) throw std::invalid_argument("has a unit with too many parts: " + quote_of(whole));
    auto const end = text.find_first_of("*/", at);
    multiply(product, trimmed(text.substr(at, end == std::string_view::npos ? end : end - at)), sign, whole);
    if (end == std::string_view::npos) break;
    sign = text[end] == '/' ? -1 : 1;
    at = end + 1;
  }
  if (factors > 0 || sign < 0 || text.find('^') != std::string_view::npos) product.offset = 0;
  return product;
}

/// The name of a dimension that a mistaken unit has, or nothing.
std::string_view name_of(Powers powers) {
  for (DimensionEntry const& candidate : dimensions)
    if (candidate.powers == powers) return candidate.name;
  if (powers == kilogram) return "a mass";
  if (powers == newton) return "a force";
  return "something else";
}

bool fits(Powers powers, Dimension dimension) {
  if (dimension == Dimension::stiffness && powers == entry(Dimension::line_force).powers) return true;
  return powers == entry(dimension).powers;
}

/// Radians in a unit of angles, which no key has; 0 for other units.
double radians_in(std::string_view unit) {
  for (std::string_view const degrees : {"deg", "degree", "degrees"})
    if (same_but_for_case(unit, degrees)) return 3.14159265358979323846 / 180;
  return unit == "rad" ? 1 : 0;
}

/// "write 55.0 %" for a number with a decimal comma, which may be one that sets apart thousands; nothing for others.
std::string comma_hint(std::string_view number, std::string_view rest) {
  if (rest.size() < 2 || rest[0] != ',' || rest[1] < '0' || rest[1] > '9') return {};
  auto const digits = std::min(rest.find_first_not_of("0123456789", 1), rest.size()) - 1;
  if (digits == 3 && number != "0" && number != "-0")
    return "has a comma, which may be a decimal one or set apart thousands; write " + std::string(number) + "." +
           std::string(rest.substr(1)) + " or " + std::string(number) + std::string(rest.substr(1));
  return "has a decimal comma; write a point: " + std::string(number) + "." + std::string(rest.substr(1));
}

}  // namespace

std::string quote_of(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown;
  std::size_t at = 0;
  for (std::size_t bytes = 1; at < text.size() && at + bytes <= longest; at += bytes) {
    std::size_t const length = utf8_length(text, at);
    bool const printable = length > 1 || (text[at] >= ' ' && text[at] <= '~');
    bytes = length > 0 ? length : 1;
    if (at + bytes > longest) break;
    shown += printable ? text.substr(at, bytes) : "?";
  }
  return "'" + shown + (at < text.size() ? "...'" : "'");
}

std::string in_ascii(std::string_view text) {
  constexpr std::pair<std::string_view, std::string_view> signs[] = {
      {"\xc2\xb5", "u"},  {"\xce\xbc", "u"}, {"\xc2\xb0", "deg"},   {"\xc2\xb2", "^2"},
      {"\xc2\xb3", "^3"}, {"\xc2\xa0", " "}, {"\xe2\x80\xaf", " "}, {"\xe2\x88\x92", "-"}};
  std::string plain(text);
  for (auto const& [sign, letters] : signs)
    for (std::size_t at = 0; (at = plain.find(sign, at)) != std::string::npos; at += letters.size())
      plain.replace(at, sign.size(), letters);
  return plain;
}

double parse_quantity(std::string_view text, Dimension dimension) {
  std::string const plain = in_ascii(text);
  std::string_view const whole = trimmed(plain);
  DimensionEntry const& wanted = entry(dimension);
  auto const refuse = [&](std::string const& got) {
    throw std::invalid_argument("needs " + std::string(wanted.name) + ", got " + got +
                                "; example: " + std::string(wanted.example));
  };
  std::size_t const length = number_length(whole);
  if (length == 0) refuse(quote_of(whole));
  std::string_view const number = whole.substr(0, length), unit_text = trimmed(whole.substr(length));
  if (std::string hint = comma_hint(number, unit_text); !hint.empty()) throw std::invalid_argument(std::move(hint));
  if (unit_text.empty()) {
    if (dimension == Dimension::temperature) refuse("a bare number (" + quote_of(whole) + "), which could be degC or K");
    return shifted_number(number, 0);
  }
  if (double const turn = dimension == Dimension::ratio ? radians_in(unit_text) : 0; turn > 0)
    throw std::invalid_argument("is an angle, " + quote_of(whole) +
                                ", where a coefficient is needed: the tangent of the angle, " +
                                short_number(std::tan(shifted_number(number, 0) * turn)));
  Unit const unit = parse_unit(unit_text, whole);
  if (!fits(unit.powers, dimension)) refuse(std::string(name_of(unit.powers)) + " (" + quote_of(whole) + ")");
  double value = shifted_number(number, unit.decimals) * unit.factor / unit.divisor;
  if (unit.offset != 0) value += unit.offset;
  if (!std::isfinite(value)) throw std::invalid_argument("is out of range: " + quote_of(whole));
  return value;
}

double parse_number(std::string_view text) {
  std::string_view const whole = trimmed(text);
  if (whole.empty() || number_length(whole) != whole.size())
    throw std::invalid_argument("needs a number, got " + quote_of(whole));
  return shifted_number(whole, 0);
}

double parse_written_number(std::string_view text) {
  double value = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : parse_number(text);
}

std::string format_number(double value) {
  std::array<char, 32> buffer;
  auto const [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return error == std::errc{} ? std::string(buffer.data(), end) : std::string("nan");
}

std::string format_quantity(double value, Dimension dimension) {
  std::string const bare = format_number(value);
  for (std::string_view const unit : entry(dimension).shown) {
    if (unit.empty() || value == 0) break;
    Unit const parsed = parse_unit(unit, unit);
    double const size = std::fabs(value) * std::pow(10.0, -parsed.decimals);
    if (!(size > 0.0999 && size < 1e4)) continue;
    // The shortest digits of the value itself, their point moved: exact in decimal, so nothing is lost by the unit.
    std::string const text = format_number(shifted_number(bare, -parsed.decimals)) + " " + std::string(unit);
    if (parse_quantity(text, dimension) == value) return text;
  }
  std::string const unit(bare_unit(dimension));
  bool const says_itself = unit.empty() || (value == 0 && dimension != Dimension::temperature);
  return says_itself ? bare : bare + " " + unit;
}

std::string_view dimension_name(Dimension dimension) { return entry(dimension).name; }
std::string_view bare_unit(Dimension dimension) { return entry(dimension).bare_unit; }
std::string_view quantity_example(Dimension dimension) { return entry(dimension).example; }

}  // namespace clathra
