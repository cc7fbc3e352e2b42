#include "terminal/command_table.hpp"

namespace clathra {
namespace {

/// The names in "TEXT:{printed,thm}" or "FORMAT:value in {vtu->0,csv->1} OR {0,1}".
std::vector<std::string> choices_of(std::string const& type) {
  auto const open = type.find('{'), close = type.find('}');
  if (open == std::string::npos || close == std::string::npos) return {};
  std::vector<std::string> choices = CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
  for (std::string& choice : choices) choice = choice.substr(0, choice.find("->"));
  return choices;
}

OptionEntry entry_of(CLI::Option const& option) {
  OptionEntry entry;
  for (std::string const& name : option.get_snames()) entry.names.push_back("-" + name);
  for (std::string const& name : option.get_lnames()) entry.names.push_back("--" + name);
  entry.positional = entry.names.empty();
  if (entry.positional) entry.names.push_back(option.get_name());
  std::string const type = option.get_type_name();
  if (option.get_items_expected_max() > 0) entry.value = type.substr(0, type.find(':'));
  entry.choices = choices_of(type);
  entry.help = option.get_description();
  entry.default_value = option.get_default_str();
  entry.required = option.get_required();
  return entry;
}

}  // namespace

std::vector<VerbEntry> command_table(CLI::App const& program) {
  std::vector<VerbEntry> table;
  for (CLI::App const* const verb : program.get_subcommands([](CLI::App const* app) { return !app->get_group().empty(); })) {
    VerbEntry entry{verb->get_name(), verb->get_description(), verb->get_footer(), {}};
    for (CLI::Option const* const option : verb->get_options([](CLI::Option const* o) { return !o->get_group().empty(); }))
      entry.options.push_back(entry_of(*option));
    table.push_back(std::move(entry));
  }
  return table;
}

}  // namespace clathra
