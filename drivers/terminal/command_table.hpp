#pragma once
/// The command line as a table, read from CLI11: what the manual page and the completion are made of.
#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace clathra {

struct OptionEntry {
  std::vector<std::string> names;    ///< "-o", "--output"; of an argument without name only what it is, "scene"
  std::string value;                 ///< what follows it, "DIR"; empty for a flag
  std::vector<std::string> choices;  ///< values that it may have, where they are few
  std::string help, default_value;
  bool positional = false, required = false;
};

struct VerbEntry {
  std::string name, help, example;
  std::vector<OptionEntry> options;
};

/// All verbs and their options but the hidden ones, in the order of the help.
std::vector<VerbEntry> command_table(CLI::App const& program);

}  // namespace clathra
