#include "io/scene/toml_section.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace clathra {

TomlSection::TomlSection(SettingsReader& reader, TomlNode const& node, std::string what)
    : reader_(reader), node_(node), what_(std::move(what)), table_(node.as<TomlTable>()) {
  if (!table_) reader_.report(node, fmt::format("{} is a section with keys and values", what_));
}

TomlSection::~TomlSection() {
  if (!table_) return;
  for (TomlEntry const& entry : SettingsReader::in_order(*table_))
    if (std::find(asked_.begin(), asked_.end(), entry.name) == asked_.end())
      reader_.report(entry.node, fmt::format("unknown key '{}'{}; {} has {}", entry.name.substr(0, 60),
                                             name_suggestion(entry.name, asked_), what_, fmt::join(asked_, ", ")));
}

TomlNode const* TomlSection::find(std::string_view name) {
  if (std::find(asked_.begin(), asked_.end(), name) == asked_.end()) asked_.push_back(name);
  return table_ ? table_->find(name) : nullptr;
}

void TomlSection::report(std::string_view name, std::string text) {
  TomlNode const* const at = table_ ? table_->find(name) : nullptr;
  reader_.report(at ? *at : node_, std::move(text));
}

template <class T>
T const* TomlSection::value(std::string_view name, char const* kind) {
  TomlNode const* const node = find(name);
  T const* const found = node ? node->as<T>() : nullptr;
  if (node && !found) report(name, fmt::format("'{}' of {} needs {}", name, what_, kind));
  return found;
}

std::string TomlSection::text(std::string_view name, bool needed) {
  auto const* const found = value<std::string>(name, "a text in quotes");
  if (needed && table_ && !has(name)) report("", fmt::format("{} needs '{}'", what_, name));
  return found ? *found : "";
}

TomlList TomlSection::items(std::string_view name) {
  auto const* const list = value<TomlList>(name, "a list: [ ... ]");
  return list ? *list : TomlList();
}

std::vector<std::string> TomlSection::texts(std::string_view name) {
  std::vector<std::string> texts;
  for (TomlNode const& item : items(name))
    if (auto const* const one = item.as<std::string>())
      texts.push_back(*one);
    else
      reader_.report(item, fmt::format("'{}' of {} needs texts in quotes", name, what_));
  return texts;
}

std::optional<double> TomlSection::number(std::string_view name) {
  TomlNode const* const node = find(name);
  if (!node) return {};
  if (auto const* const whole = node->as<std::int64_t>()) return static_cast<double>(*whole);
  auto const* const number = value<double>(name, "a number");
  return number ? std::optional(*number) : std::nullopt;
}

std::optional<double> TomlSection::quantity(std::string_view name, Dimension dimension) {
  TomlNode const* const node = find(name);
  if (!node || !node->as<std::string>()) return number(name);
  try {
    return parse_quantity(*node->as<std::string>(), dimension);
  } catch (std::invalid_argument const& problem) {
    report(name, fmt::format("'{}' {}", name, problem.what()));
    return {};
  }
}

bool TomlSection::flag(std::string_view name) {
  auto const* const truth = value<bool>(name, "true or false");
  return truth && *truth;
}

std::optional<std::size_t> TomlSection::choice(std::string_view name, std::vector<std::string_view> const& allowed) {
  std::string const chosen = text(name, true);
  auto const found = std::find(allowed.begin(), allowed.end(), chosen);
  if (found != allowed.end()) return static_cast<std::size_t>(found - allowed.begin());
  if (!chosen.empty())
    report(name, fmt::format("unknown {} '{}'{}; there are {}", name, chosen.substr(0, 60), name_suggestion(chosen, allowed),
                             fmt::join(allowed, ", ")));
  return {};
}

}  // namespace clathra
