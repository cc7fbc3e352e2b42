#pragma once
/// What a TOML file says, without the library that reads it: nvcc does not take that one's headers.
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace clathra {

struct TomlEntry;
struct TomlNode;
using TomlList = std::vector<TomlNode>;

/// Entries in the order of their names.
struct TomlTable {
  std::vector<TomlEntry> entries;

  /// nullptr where there is none of this name.
  TomlNode const* find(std::string_view name) const;
};

/// Dates and times are Unused.
struct TomlNode {
  struct Unused {};

  int line = 0, column = 0;  ///< where it begins in the file, from 1
  std::variant<Unused, std::string, std::int64_t, double, bool, TomlList, TomlTable> value;

  /// nullptr where it is something else.
  template <class T>
  T const* as() const {
    return std::get_if<T>(&value);
  }
};

struct TomlEntry {
  std::string name;
  int line = 0, column = 0;  ///< of the name
  TomlNode node;
};

inline TomlNode const* TomlTable::find(std::string_view name) const {
  auto const found = std::find_if(entries.begin(), entries.end(), [name](TomlEntry const& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &found->node;
}

}  // namespace clathra
