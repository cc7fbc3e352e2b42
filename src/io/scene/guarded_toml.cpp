#include "io/scene/guarded_toml.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <string_view>

#include "io/scene/scene_guard.hpp"

namespace clathra {
namespace {

/// A line of a text, counted from 1, up to a comment sign and without blanks at its end.
std::string_view line_of(std::string_view text, int number) {
  for (; number > 1; --number) text.remove_prefix(std::min(text.size(), text.find('\n') + 1));
  text = text.substr(0, text.find_first_of("\n#"));
  return text.substr(0, text.find_last_not_of(" \t\r") + 1);
}

/// What the parser says of a line, in the words of somebody who writes scenes: most often quotes are missing.
std::string syntax_text(std::string_view description, std::string_view line) {
  if (std::count(line.begin(), line.end(), '"') % 2 != 0) return "a quotation mark (\") is missing in this line";
  std::string_view const value = line.substr(std::min(line.size(), line.find('=') + 1));
  std::string_view const from_number = value.substr(std::min(value.size(), value.find_first_not_of(" \t")));
  std::size_t const after = from_number.find_first_not_of("0123456789+-._eE \t");
  bool const number = !from_number.empty() && from_number.find_first_of("0123456789+-.") == 0;
  if (number && after != from_number.npos &&
      (std::isalpha(static_cast<unsigned char>(from_number[after])) || from_number[after] == '%'))
    return fmt::format("a number with its unit goes in quotes: \"{}\"", from_number.substr(0, 40));
  if (number && after != from_number.npos && from_number[after] == ',')
    return fmt::format("a number has a decimal point: {}.{}", from_number.substr(0, after), from_number.substr(after + 1, 20));
  if (!from_number.empty() && std::isalpha(static_cast<unsigned char>(from_number[0])))
    return fmt::format("a text goes in quotes (\"{}\"); what is or is not so is true or false", from_number.substr(0, 40));
  return "cannot be understood: " + std::string(description);
}

/// What a line states, without blanks and quotes: "[section]", or "section.key"; nothing where it is neither.
/// @param section  in which the line stands, "section." or empty; becomes that which it begins
std::string stated_in(std::string_view line, std::string& section) {
  std::string plain;
  std::copy_if(line.begin(), line.end(), std::back_inserter(plain),
               [](char c) { return std::string_view(" \t\r\"'").find(c) == std::string_view::npos; });
  if (plain.starts_with('[') && plain.ends_with(']')) {
    section = plain.substr(1, plain.size() - 2) + ".";
    return plain;
  }
  std::size_t const equals = plain.find('=');
  return equals == std::string::npos ? std::string() : section + plain.substr(0, equals);
}

/// What is wrong where a line states what one above has stated, or nothing.
std::string twice_text(std::string_view text, int last) {
  std::map<std::string, int> lines;
  std::string section;
  for (int number = 1; number <= last; ++number) {
    std::string const name = stated_in(text.substr(0, text.find('\n')), section);
    text.remove_prefix(std::min(text.size(), text.find('\n') + 1));
    auto const [first, is_new] = lines.emplace(name, number);
    if (number < last || is_new || name.empty()) continue;
    return name.starts_with('[')
               ? fmt::format("the section {} begins twice, in lines {} and {}: write the keys of both below one", name,
                             first->second, last)
               : fmt::format("'{}' is stated twice, in lines {} and {}: leave one of them out", name, first->second, last);
  }
  return {};
}

TomlNode tree_of(toml::node const& node);

TomlTable table_of(toml::table const& table) {
  TomlTable tree;
  for (auto const& [name, node] : table) {
    auto const at = name.source().begin;
    tree.entries.push_back({std::string(name.str()), static_cast<int>(at.line), static_cast<int>(at.column), tree_of(node)});
  }
  return tree;
}

TomlList list_of(toml::array const& list) {
  TomlList tree;
  for (toml::node const& item : list) tree.push_back(tree_of(item));
  return tree;
}

/// As deep as the guard lets a text be.
TomlNode tree_of(toml::node const& node) {
  auto const at = node.source().begin;
  TomlNode tree{static_cast<int>(at.line), static_cast<int>(at.column), {}};
  if (auto const* const text = node.as_string())
    tree.value = text->get();
  else if (auto const* const whole = node.as_integer())
    tree.value = whole->get();
  else if (auto const* const number = node.as_floating_point())
    tree.value = number->get();
  else if (auto const* const truth = node.as_boolean())
    tree.value = truth->get();
  else if (auto const* const list = node.as_array())
    tree.value = list_of(*list);
  else if (auto const* const table = node.as_table())
    tree.value = table_of(*table);
  return tree;
}

}  // namespace

std::optional<TomlTable> parse_guarded(std::string const& text, std::string const& file, std::vector<Problem>& problems) {
  GuardedText const guarded = guard_scene_text(text, file);
  problems.insert(problems.end(), guarded.problems.begin(), guarded.problems.end());
  if (!guarded.problems.empty()) return {};
  try {
    return table_of(toml::parse(guarded.text));
  } catch (toml::parse_error const& error) {
    auto const at = error.source().begin;
    int const line = static_cast<int>(at.line);
    std::string const twice =
        error.description().find("redefine") == std::string_view::npos ? "" : twice_text(guarded.text, line);
    problems.push_back({file, line, twice.empty() ? static_cast<int>(at.column) : 1,
                        twice.empty() ? syntax_text(error.description(), line_of(text, line)) : twice});
    return {};
  }
}

}  // namespace clathra
