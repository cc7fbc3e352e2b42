#pragma once
/// A section of a file, its keys asked for one by one.
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "domain/scene/units.hpp"
#include "io/scene/settings_reader.hpp"

namespace clathra {

/// Reports what is missing or of the wrong kind to the reader, and at its end all keys that nobody asked for.
class TomlSection {
 public:
  /// @param what  the section as messages name it: "a claim"
  TomlSection(SettingsReader& reader, TomlNode const& node, std::string what);
  ~TomlSection();
  TomlSection(TomlSection const&) = delete;
  TomlSection& operator=(TomlSection const&) = delete;

  /// The value of a key, nullptr where it is not there.
  TomlNode const* find(std::string_view name);
  bool has(std::string_view name) const { return table_ && table_->find(name); }
  /// Says where the section begins. @param name  of the key at fault, empty for all of it
  void report(std::string_view name, std::string text);

  std::string text(std::string_view name, bool needed = false);
  std::vector<std::string> texts(std::string_view name);
  std::optional<double> number(std::string_view name);
  std::optional<double> quantity(std::string_view name, Dimension dimension);
  bool flag(std::string_view name);
  /// The place of a text among those that are allowed, which the message lists; nothing where it is none of them.
  std::optional<std::size_t> choice(std::string_view name, std::vector<std::string_view> const& allowed);
  /// The items of a list, none where there is no list.
  TomlList items(std::string_view name);

 private:
  template <class T>
  T const* value(std::string_view name, char const* kind);

  SettingsReader& reader_;
  TomlNode const& node_;
  std::string what_;
  TomlTable const* table_;
  std::vector<std::string_view> asked_;
};

}  // namespace clathra
