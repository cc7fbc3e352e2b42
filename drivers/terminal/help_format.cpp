#include "terminal/help_format.hpp"

#include <set>
#include <sstream>

namespace clathra {
namespace {

/// "with --a" or "not with --a, --b", behind a semicolon; nothing where there are none.
std::string together(char const* how, std::set<CLI::Option*> const& options) {
  std::set<std::string> names;
  for (CLI::Option const* option : options) names.insert(option->get_name());
  names.erase("");  // of hidden ones
  std::string text;
  for (std::string const& name : names) text += (text.empty() ? std::string("; ") + how + " " : ", ") + name;
  return text;
}

}  // namespace

std::string HelpFormat::make_option(CLI::Option const* option, bool positional) const {
  std::string name = make_option_name(option, positional) + make_option_opts(option);
  if (name.size() + 3 == get_column_width()) name += ' ';  // its meaning begins on the next line
  std::stringstream text;
  CLI::detail::format_help(text, name, make_option_desc(option), get_column_width());
  return text.str();
}

std::string HelpFormat::make_option_opts(CLI::Option const* option) const {
  if (!option->get_option_text().empty()) return " " + option->get_option_text();
  if (option->get_type_size() == 0) return {};
  std::string text = " " + get_label(option->get_type_name());
  if (!option->get_default_str().empty()) text += "=" + option->get_default_str();
  if (option->get_expected_max() == CLI::detail::expected_max_vector_size) text += " ...";
  if (option->get_required()) text += " " + get_label("REQUIRED");
  return text;
}

std::string HelpFormat::make_option_desc(CLI::Option const* option) const {
  return option->get_description() + together("with", option->get_needs()) + together("not with", option->get_excludes());
}

}  // namespace clathra
