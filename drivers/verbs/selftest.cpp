/// `clathra selftest`: does this program compute right on this machine?
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>

#include "io/results/run_record.hpp"
#include "machine/own_program.hpp"
#include "machine/threads.hpp"
#include "run/self_checks.hpp"
#include "terminal/print.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

struct SelftestOptions {
  std::string only;  ///< the one check that this process is to do, for the process that prints the verdicts
  int threads = 0;
};

/// What a check that computes prints. It gets a process of its own: the number of threads is decided when a program starts, and
/// an instruction that this machine does not have ends no more than that check.
std::string printed_by(std::string const& check, int threads) {
  std::string text = output_of_own_program({"selftest", "--only", check, "--threads", std::to_string(threads)});
  if (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

std::string check_threads(int many) {
  std::string const one_thread = printed_by("threads", 1), many_threads = printed_by("threads", many);
  if (one_thread != many_threads)
    throw CheckFailed(fmt::format("1 thread gives {}, {} threads give {}", one_thread, many, many_threads));
  return fmt::format("400 bonded particles, 1 and {} threads: the same bits, {}", many, one_thread);
}

/// Runs a check and prints its line. @return whether it held
template <class Check>
bool report(char const* name, Check&& check) {
  auto const start = std::chrono::steady_clock::now();
  std::string verdict = "ok", found;
  try {
    found = check();
  } catch (std::exception const& problem) {
    verdict = "FAILED", found = problem.what();
  }
  double const seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  print_result(fmt::format("{:<7} {:<14} {} ({:.1f} s)\n", verdict, name, found, seconds));
  return verdict == "ok";
}

ExitCode do_only(SelftestOptions const& options) {
  set_up_threads(options.threads);
  KokkosSession const kokkos;
  try {
    return print_result((options.only == "collision" ? check_collision() : hash_text(bonded_state_hash())) + "\n");
  } catch (CheckFailed const& problem) {
    print_error(problem.what());
    return ExitCode::internal;
  }
}

ExitCode selftest(SelftestOptions const& options) {
  // Threads that wait do not spin: on a machine that does other work, small specimens would else take a minute.
  ::setenv("OMP_WAIT_POLICY", "passive", 0);
  if (!options.only.empty()) return do_only(options);
  int failed = 0;
  failed += !report("bond law", check_bond_law);
  failed += !report("collision", [] { return printed_by("collision", 1); });
  failed += !report("threads", [&] { return check_threads(std::max(2, thread_count(options.threads))); });
  failed += !report("specimen file", check_specimen_file);
  if (failed == 0) return print_result("all is well\n");
  print_error(fmt::format("clathra selftest: {} of 4 checks failed", failed));
  return ExitCode::internal;
}

}  // namespace

void add_selftest(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<SelftestOptions>();
  CLI::App* const verb = program.add_subcommand("selftest", "Check that this program computes right on this machine");
  verb->add_option("--threads", options->threads, "threads to compare with one (default: all)")
      ->check(CLI::Range(1, 4096))
      ->type_name("N");
  verb->add_option("--only", options->only)->check(CLI::IsMember({"collision", "threads"}))->group("");
  verb->footer("Example: clathra selftest");
  verb->callback([options, &chosen] { chosen = [options] { return selftest(*options); }; });
}

}  // namespace clathra
