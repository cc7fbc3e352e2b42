#include "io/scene/scene_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "domain/scene/short_number.hpp"
#include "io/scene/rolling_lever_text.hpp"

namespace clathra {
namespace {

[[noreturn]] void refuse(std::string const& text) { throw std::invalid_argument(text); }

std::string shown(std::string_view text) {
  std::string safe(text.substr(0, 40));
  std::replace_if(
      safe.begin(), safe.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + safe + (text.size() > 40 ? "...'" : "'");
}

bool is_quantity(Key const& key) { return key.kind == Kind::quantity || key.kind == Kind::quantities; }

std::string limit_text(Key const& key, double value) {
  return is_quantity(key) ? format_quantity(value, key.dimension) : fmt::format("{:.0f}", value);
}

/// @param bare  the number came without unit, which may be why it is out of range
void check_range(Key const& key, double value, bool bare) {
  if (value == 0 && !key.zero.empty()) return;
  if (value >= key.least && value <= key.most) return;
  std::string text = fmt::format("must lie between {} and {}{}, got {}", limit_text(key, key.least), limit_text(key, key.most),
                                 key.takes_zero && key.least > 0 ? fmt::format(", or be 0 ({})", key.zero) : "",
                                 is_quantity(key) ? format_quantity(value, key.dimension) : format_number(value));
  if (is_quantity(key) && key.dimension == Dimension::ratio) {
    if (!bare) text += fmt::format(", which is {} %; {} % is the most", short_number(100 * value), short_number(100 * key.most));
    bool const is_share = key.most <= 1 && (key.least == 0 || key.least >= 1e-6);
    if (bare && is_share && value >= 2) text += percent_hint(value);
  } else if (is_quantity(key) && bare) {
    text +=
        fmt::format("; a number without unit is in {}; example: {}", bare_unit(key.dimension), quantity_example(key.dimension));
  }
  refuse(text);
}

void set_quantity(Key const& key, Scene& scene, double value, bool bare) {
  if (!std::isfinite(value)) refuse("must be finite");
  check_range(key, value, bare);
  std::get<double& (*)(Scene&)>(key.field)(scene) = value + 0.0;  // "-0" is written back as "0"
}

void set_quantities(Key const& key, Scene& scene, std::vector<double> values, bool bare) {
  for (double const value : values) {
    if (!std::isfinite(value)) refuse("must be finite");
    check_range(key, value, bare);
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::get<std::vector<double>& (*)(Scene&)>(key.field)(scene) = std::move(values);
}

/// The items of `["2 %", "3 %"]`, also without brackets and quotes, as they come from --set.
std::vector<double> quantities_in(Key const& key, std::string_view text) {
  std::vector<double> values;
  if (text.starts_with('[') && text.ends_with(']')) text = text.substr(1, text.size() - 2);
  while (!text.empty()) {
    std::string_view item = text.substr(0, text.find(','));
    text.remove_prefix(std::min(text.size(), item.size() + 1));
    while (item.starts_with(' ')) item.remove_prefix(1);
    while (item.ends_with(' ')) item.remove_suffix(1);
    if (item.empty() && text.empty()) break;  // nothing, or a comma at the end
    values.push_back(parse_quantity(unquoted(item), key.dimension));
  }
  return values;
}

void store_integer(Key const& key, Scene& scene, std::int64_t value) {
  // A number just above the largest may be rounded to it.
  bool const above = value > static_cast<std::int64_t>(key.most);
  check_range(key, above ? std::max(static_cast<double>(value), std::nextafter(key.most, HUGE_VAL)) : static_cast<double>(value),
              true);
  if (auto* const at = std::get_if<int& (*)(Scene&)>(&key.field))
    (*at)(scene) = static_cast<int>(value);
  else if (auto* const wide = std::get_if<std::int64_t& (*)(Scene&)>(&key.field))
    (*wide)(scene) = value;
  else
    std::get<std::uint64_t& (*)(Scene&)>(key.field)(scene) = static_cast<std::uint64_t>(value);
}

void set_integer_text(Key const& key, Scene& scene, std::string_view text) {
  std::int64_t value = 0;
  auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc{} && end == text.data() + text.size()) return store_integer(key, scene, value);
  set_from_number(key, scene, parse_number(text));  // "2e4"
}

void set_choice(Key const& key, Scene& scene, std::string_view text) {
  auto const found = std::find(key.choices.begin(), key.choices.end(), text);
  if (found == key.choices.end()) {
    std::string names;
    for (std::string_view const name : key.choices) names += fmt::format("{}'{}'", names.empty() ? "" : ", ", name);
    refuse(fmt::format("must be one of {}, got {}{}", names, shown(text), name_suggestion(text, key.choices)));
  }
  if (auto* const choice = std::get_if<ChoiceField>(&key.field))
    choice->set(scene, static_cast<int>(found - key.choices.begin()));
  else
    std::get<std::string& (*)(Scene&)>(key.field)(scene) = std::string(text);
}

void set_text(Key const& key, Scene& scene, std::string_view text) {
  if (std::any_of(text.begin(), text.end(), [](char c) { return (c >= 0 && c < ' ') || c == 127; }))
    refuse("has control characters");
  std::get<std::string& (*)(Scene&)>(key.field)(scene) = std::string(text);
}

std::string kind_name(Key const& key) {
  switch (key.kind) {
    case Kind::quantity:
      return std::string(dimension_name(key.dimension));
    case Kind::quantities:
      return "a list, each item " + std::string(dimension_name(key.dimension));
    case Kind::lever:
      return "a length or a part of the bond width, in quotes";
    case Kind::integer:
      return "a whole number";
    case Kind::boolean:
      return "true or false";
    case Kind::choice:
      return "one of its names, in quotes";
    case Kind::text:
    case Kind::path:
      return "text in quotes";
  }
  return "";
}

/// TOML's basic string.
std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (char const c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

/// The fields of a scene are reached by functions of a Scene&; here they are only read.
template <class T>
T const& read(T& (*at)(Scene&), Scene const& scene) {
  return at(const_cast<Scene&>(scene));
}

}  // namespace

bool is_bare(std::string_view text) { return text.find_first_not_of("0123456789+-.eE \t") == std::string_view::npos; }

std::string percent_hint(double value) {
  if (!(value >= 1 && value <= 100)) return {};
  return fmt::format("; this looks like percent: write {} or \"{} %\"", short_number(value / 100), format_number(value));
}

double parse_share(std::string_view text) {
  double const share = parse_quantity(text, Dimension::ratio);
  if (share >= 0 && share <= 1) return share;
  refuse(fmt::format("must lie between 0 and 1, got {}{}", text, is_bare(text) ? percent_hint(share) : ""));
}

void set_from_text(Key const& key, Scene& scene, std::string_view text) {
  switch (key.kind) {
    case Kind::quantity: {
      double const value = parse_quantity(text, key.dimension);
      return set_quantity(key, scene, value, is_bare(text));
    }
    case Kind::quantities:
      return set_quantities(key, scene, quantities_in(key, text), text.find('%') == std::string_view::npos);
    case Kind::lever:
      std::get<RollingLever& (*)(Scene&)>(key.field)(scene) = parse_rolling_lever(text);
      return;
    case Kind::integer:
      return set_integer_text(key, scene, text);
    case Kind::boolean:
      if (text != "true" && text != "false") refuse("must be true or false, got " + shown(text));
      return set_from_boolean(key, scene, text == "true");
    case Kind::choice:
      return set_choice(key, scene, text);
    case Kind::text:
    case Kind::path:
      return set_text(key, scene, text);
  }
}

void set_from_number(Key const& key, Scene& scene, double value) {
  if (key.kind == Kind::integer) {
    if (value != std::floor(value)) refuse("needs a whole number, got " + format_number(value));
    check_range(key, value, true);
    return store_integer(key, scene, static_cast<std::int64_t>(value));
  }
  if (key.kind == Kind::quantities) return set_quantities(key, scene, {value}, true);
  if (key.kind != Kind::quantity) refuse(fmt::format("needs {}, got a number ({})", kind_name(key), format_number(value)));
  if (key.dimension == Dimension::temperature) parse_quantity(format_number(value), key.dimension);  // refuses: deg C or K?
  set_quantity(key, scene, value, true);
}

void set_from_integer(Key const& key, Scene& scene, std::int64_t value) {
  if (key.kind == Kind::integer) return store_integer(key, scene, value);
  set_from_number(key, scene, static_cast<double>(value));
}

void set_from_boolean(Key const& key, Scene& scene, bool value) {
  if (key.kind != Kind::boolean) refuse(fmt::format("needs {}, got {}", kind_name(key), value ? "true" : "false"));
  std::get<bool& (*)(Scene&)>(key.field)(scene) = value;
}

void set_stated(Key const& key, Scene& scene, std::string_view text) {
  if (takes_back(key, text)) {
    auto* const number = std::get_if<double& (*)(Scene&)>(&key.field);
    if (number && std::isnan(read(*number, Scene{}))) return static_cast<void>((*number)(scene) = read(*number, Scene{}));
    return set_from_text(key, scene, unquoted(value_text(key, Scene{})));
  }
  set_from_text(key, scene, text);
  if (is_not_given(key, scene)) refuse(zero_problem(key));
}

bool takes_back(Key const& key, std::string_view text) {
  return text.empty() && key.kind != Kind::text && key.kind != Kind::path;
}

bool is_zero(Key const& key, Scene const& scene) {
  struct Visitor {
    Scene const& scene;
    bool operator()(double& (*at)(Scene&)) const { return read(at, scene) == 0; }
    bool operator()(int& (*at)(Scene&)) const { return read(at, scene) == 0; }
    bool operator()(std::int64_t& (*at)(Scene&)) const { return read(at, scene) == 0; }
    bool operator()(std::uint64_t& (*at)(Scene&)) const { return read(at, scene) == 0; }
    bool operator()(bool& (*)(Scene&)) const { return false; }
    bool operator()(std::string& (*at)(Scene&)) const { return read(at, scene).empty(); }
    bool operator()(std::vector<double>& (*at)(Scene&)) const { return read(at, scene).empty(); }
    bool operator()(RollingLever& (*)(Scene&)) const { return false; }
    bool operator()(ChoiceField const&) const { return false; }
  };
  return std::visit(Visitor{scene}, key.field);
}

/// A number that may be 0 as well as missing is missing where it is no number.
bool is_not_given(Key const& key, Scene const& scene) {
  if (auto* const at = std::get_if<double& (*)(Scene&)>(&key.field); at && std::isnan(read(*at, Scene{})))
    return std::isnan(read(*at, scene));
  return !key.zero.empty() && !key.takes_zero && is_zero(key, scene);
}

std::string zero_problem(Key const& key) {
  bool const has_default = !is_zero(key, Scene{});
  return fmt::format("must lie between {} and {}, got 0; where the key is left out: {}", limit_text(key, key.least),
                     limit_text(key, key.most), has_default ? value_text(key, Scene{}) : std::string(key.zero));
}

std::string value_text(Key const& key, Scene const& scene) {
  struct Visitor {
    Key const& key;
    Scene const& scene;
    std::string operator()(double& (*at)(Scene&)) const {
      std::string const text = format_quantity(read(at, scene), key.dimension);
      return text.find(' ') == std::string::npos ? text : toml_string(text);
    }
    std::string operator()(int& (*at)(Scene&)) const { return fmt::format("{}", read(at, scene)); }
    std::string operator()(std::int64_t& (*at)(Scene&)) const { return fmt::format("{}", read(at, scene)); }
    std::string operator()(std::uint64_t& (*at)(Scene&)) const { return fmt::format("{}", read(at, scene)); }
    std::string operator()(bool& (*at)(Scene&)) const { return read(at, scene) ? "true" : "false"; }
    std::string operator()(std::string& (*at)(Scene&)) const { return toml_string(read(at, scene)); }
    std::string operator()(std::vector<double>& (*at)(Scene&)) const {
      std::string list;
      for (double const value : read(at, scene)) {
        std::string const text = format_quantity(value, key.dimension);
        list += (list.empty() ? "" : ", ") + (text.find(' ') == std::string::npos ? text : toml_string(text));
      }
      return "[" + list + "]";
    }
    std::string operator()(RollingLever& (*at)(Scene&)) const { return toml_string(format_rolling_lever(read(at, scene))); }
    std::string operator()(ChoiceField const& field) const {
      return toml_string(key.choices[static_cast<std::size_t>(field.get(scene))]);
    }
  };
  return std::visit(Visitor{key, scene}, key.field);
}

std::string unquoted(std::string_view text) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"') return std::string(text);
  std::string result;
  for (std::size_t k = 1; k + 1 < text.size(); ++k) {
    if (text[k] == '\\' && k + 2 < text.size()) ++k;
    result += text[k];
  }
  return result;
}

}  // namespace clathra
