/// `clathra completion bash`: completion of verbs, options, scene keys and their choices, from the tables that the program has.
#include <fmt/format.h>

#include <memory>

#include "io/scene/schema.hpp"
#include "study/examples.hpp"
#include "terminal/command_table.hpp"
#include "terminal/print.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

constexpr char const* bash_function = R"bash(
# Sets COMPREPLY to those of the words $1 that begin with $cur. Bash cuts words at "=" where COMP_WORDBREAKS says so; then only
# what follows it is to be put in.
_clathra_offer() {
  mapfile -t COMPREPLY < <(compgen "${@:2}" -W "$1" -- "$cur")
  _clathra_cut
}
_clathra_offer_files() {
  mapfile -t COMPREPLY < <(compgen "$@" -- "$cur")
  compopt -o filenames 2>/dev/null
  _clathra_cut
}
_clathra_cut() {
  [[ $cur == *=* && $COMP_WORDBREAKS == *=* ]] && COMPREPLY=("${COMPREPLY[@]#"${cur%=*}="}")
}

# key=value: the keys of a scene, then the choices of one.
_clathra_offer_setting() {
  local key=${cur%%=*} choice choices=""
  if [[ $cur != *=* ]]; then
    compopt -o nospace 2>/dev/null
    _clathra_offer "$_clathra_keys"
    return
  fi
  for choice in ${_clathra_choices[$key]-}; do choices+="$key=$choice "; done
  _clathra_offer "$choices"
}

_clathra() {
  local words=() cur previous="" verb i joined=0
  COMPREPLY=()
  for ((i = 1; i <= COMP_CWORD; ++i)); do # put together what was cut at "="
    if [[ ${COMP_WORDS[i]} == = && ${#words[@]} -gt 0 ]]; then
      words[-1]+="=" joined=1
    elif ((joined)) && [[ -n ${COMP_WORDS[i]} ]]; then
      words[-1]+=${COMP_WORDS[i]} joined=0
    else
      words+=("${COMP_WORDS[i]}") joined=0
    fi
  done
  cur=${words[-1]} verb=${words[0]}
  ((${#words[@]} == 1)) || previous=${words[-2]}
  if ((${#words[@]} == 1)); then
    _clathra_offer "$_clathra_verbs --help --version"
  elif [[ $previous == --set ]]; then
    _clathra_offer_setting
  elif [[ -n ${_clathra_values["$verb $previous"]+known} ]]; then
    case ${_clathra_values["$verb $previous"]} in
      FILE) _clathra_offer_files -f ;;
      DIR) _clathra_offer_files -d ;;
      *) _clathra_offer "${_clathra_values["$verb $previous"]}" ;;
    esac
  elif [[ $cur == -* ]]; then
    _clathra_offer "${_clathra_options[$verb]-}"
  elif [[ -n ${_clathra_arguments[$verb]-} ]]; then
    _clathra_offer "${_clathra_arguments[$verb]}"
  else
    _clathra_offer_files -f
  fi
}
complete -F _clathra clathra
)bash";

std::string joined(std::vector<std::string> const& words) { return fmt::format("{}", fmt::join(words, " ")); }

/// What may follow an option: its choices, FILE or DIR, or nothing that could be guessed.
std::string value_words(OptionEntry const& option) {
  if (!option.choices.empty()) return joined(option.choices);
  return option.value == "FILE" || option.value == "DIR" ? option.value : "";
}

std::string verb_tables(std::vector<VerbEntry> const& table) {
  std::string verbs, options = "declare -gA _clathra_options=(\n", values = "declare -gA _clathra_values=(\n";
  for (VerbEntry const& verb : table) {
    verbs += (verbs.empty() ? "" : " ") + verb.name;
    std::vector<std::string> names;
    for (OptionEntry const& option : verb.options) {
      if (option.positional) continue;
      for (std::string const& name : option.names) {
        names.push_back(name);
        if (!option.value.empty()) values += fmt::format("  [\"{} {}\"]=\"{}\"\n", verb.name, name, value_words(option));
      }
    }
    options += fmt::format("  [{}]=\"{}\"\n", verb.name, joined(names));
  }
  return fmt::format("declare -g _clathra_verbs=\"{}\"\n{})\n{})\n", verbs, options, values);
}

/// Verbs whose argument is no file.
std::string argument_tables() {
  std::vector<std::string_view> names;
  for (Example const& example : examples()) names.push_back(example.name);
  return fmt::format("declare -gA _clathra_arguments=(\n  [init]=\"{}\"\n)\n", fmt::join(names, " "));
}

std::string key_tables() {
  std::string keys, choices = "declare -gA _clathra_choices=(\n";
  for (Key const& key : schema()) {
    keys += fmt::format("{}{}=", keys.empty() ? "" : " ", key.name);
    if (key.kind == Kind::boolean) choices += fmt::format("  [{}]=\"true false\"\n", key.name);
    if (!key.choices.empty()) choices += fmt::format("  [{}]=\"{}\"\n", key.name, fmt::join(key.choices, " "));
  }
  return fmt::format("declare -g _clathra_keys=\"{}\"\n{})\n", keys, choices);
}

}  // namespace

void add_completion(CLI::App& program, Verb& chosen) {
  CLI::App* const verb = program.add_subcommand("completion", "Print the completion for a shell");
  verb->add_option("shell", "the shell")->required()->check(CLI::IsMember({"bash"}));
  verb->footer("Example: clathra completion bash > ~/.local/share/bash-completion/completions/clathra");
  verb->callback([&program, &chosen] {
    chosen = [&program] {
      return print_result("# Made by `clathra completion bash`.\n" + verb_tables(command_table(program)) + argument_tables() +
                          key_tables() + bash_function);
    };
  });
}

}  // namespace clathra
