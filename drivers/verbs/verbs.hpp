#pragma once
/// The verbs of the command line. Each adds its options; `Verb` is what the chosen one then does.
#include <CLI/CLI.hpp>
#include <functional>

#include "io/errors/problems.hpp"

namespace clathra {

/// Set by the verb that the command line chose; run after all options are known.
using Verb = std::function<ExitCode()>;

/// What is wrong with the name of a file or folder that an option gives: that there is none. For CLI::Validator.
inline std::string name_problem(std::string const& name) { return name.empty() ? "the name is empty" : ""; }

void add_run(CLI::App& program, Verb& chosen);
void add_reproduce(CLI::App& program, Verb& chosen);
void add_study(CLI::App& program, Verb& chosen);
void add_tune(CLI::App& program, Verb& chosen);
void add_check(CLI::App& program, Verb& chosen);
void add_generate(CLI::App& program, Verb& chosen);
void add_bond(CLI::App& program, Verb& chosen);
void add_info(CLI::App& program, Verb& chosen);
void add_events(CLI::App& program, Verb& chosen);
void add_export(CLI::App& program, Verb& chosen);
void add_report(CLI::App& program, Verb& chosen);
void add_bench(CLI::App& program, Verb& chosen);
void add_verify(CLI::App& program, Verb& chosen);
void add_init(CLI::App& program, Verb& chosen);
void add_schema(CLI::App& program, Verb& chosen);
void add_selftest(CLI::App& program, Verb& chosen);
void add_completion(CLI::App& program, Verb& chosen);
void add_manual(CLI::App& program, Verb& chosen);

}  // namespace clathra
