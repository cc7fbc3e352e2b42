#pragma once
/// How `--help` describes the options of a command.
#include <CLI/CLI.hpp>
#include <string>

namespace clathra {

/// As CLI11 does, but what an option needs and excludes stands behind its meaning, by names in their order, and two blanks stand
/// between its name and its meaning.
class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat() { label("SUBCOMMAND", "COMMAND"); }
  std::string make_option(CLI::Option const* option, bool positional) const override;
  std::string make_option_opts(CLI::Option const* option) const override;
  std::string make_option_desc(CLI::Option const* option) const override;
};

}  // namespace clathra
