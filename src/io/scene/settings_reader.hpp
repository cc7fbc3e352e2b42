#pragma once
/// What files that list tests have in common: keys of a scene with their values, and named groups of them.
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/errors/problems.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/study_file.hpp"
#include "io/scene/toml_tree.hpp"

namespace clathra {

/// Collects what is wrong in `problems` and reads on.
class SettingsReader {
 public:
  explicit SettingsReader(std::filesystem::path path) : path_(std::move(path)), file_(path_.string()) {}

  /// Calls found(key, node) for the values of a section in the order of the file; keys may be written "a.b" = or a.b =.
  /// @param what  the section as a message names it
  using Found = std::function<void(std::string const&, TomlNode const&)>;
  void for_each_key(TomlNode const& section, char const* what, Found const& found);

  /// The key of a scene, where it may stand in such a file.
  Key const* known(std::string const& name, TomlNode const& node);

  /// One value as text, checked against its key: a list where the key takes one. Paths become relative to the current folder.
  std::optional<std::string> value_of(Key const& key, TomlNode const& node);

  /// The groups of [groups.NAME], each with a material: groups that do not state it and differ in nothing but the confining
  /// stress are tests of one. @param own  takes a key that is none of a scene, true where it does
  using Own = std::function<bool(std::string const&, TomlNode const&, StudyGroup const&)>;
  std::vector<StudyGroup> read_groups(TomlNode const& section, Own const& own);

  /// The entries of a table in the order of the file.
  static std::vector<TomlEntry> in_order(TomlTable const& table);

  void report(TomlNode const& node, std::string text) { problems.push_back({file_, node.line, node.column, std::move(text)}); }
  std::string const& file() const { return file_; }
  std::vector<Problem> problems;

 private:
  void read_material(TomlNode const& node, StudyGroup& group);

  std::filesystem::path path_;
  std::string file_;
};

}  // namespace clathra
