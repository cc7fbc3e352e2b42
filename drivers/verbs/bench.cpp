/// `clathra bench`: how fast this machine runs whole time steps.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "io/results/run_record.hpp"
#include "machine/threads.hpp"
#include "terminal/json_text.hpp"
#include "terminal/print.hpp"
#include "throughput/throughput_card.hpp"
#include "verbs/verbs.hpp"

namespace clathra {
namespace {

struct BenchOptions {
  std::string what = "bonded";
  std::string precision = precision_names[0];
  ThroughputSetup setup;
  double seconds = 3;
  int threads = 0;
  bool json = false;
  bool card = false;
};

nlohmann::ordered_json json_of(ThroughputRow const& row) {
  Throughput const& t = row.measured;
  return {{"precision", precision_names[static_cast<int>(row.precision)]},
          {"particles", row.discs},
          {"particle_steps_per_second", t.disc_steps_per_second},
          {"contact_steps_per_s", t.contact_steps_per_s},
          {"seconds_per_step", 1e-6 * row.microseconds_per_step()},
          {"bytes_per_particle", t.bytes_per_disc},
          {"search_bytes_per_particle", t.search_bytes_per_disc},
          {"bytes_moved_per_particle_and_step", t.moved_per_step},
          {"bandwidth_bytes_per_s", row.bandwidth},
          {"bandwidth_share", row.bandwidth_share()},
          {"flops_per_s", t.flops_per_s},
          {"launches_per_step", row.launches_per_step},
          {"rebuild_share", t.rebuild_share},
          {"steps", t.steps},
          {"rebuilds", t.rebuilds},
          {"seconds", t.seconds}};
}

/// What is measured, and by what.
nlohmann::ordered_json json_of(BenchOptions const& options) {
  return {{"case", options.what},
          {"threads", ExecutionSpace().concurrency()},
          {"compiler", compiler_name()},
          {"kokkos", kokkos_version()},
          {"backend", backend_name()}};
}

std::string text_of(nlohmann::ordered_json const& c) {
  auto const number = [&](char const* key) { return c.at(key).get<double>(); };
  return fmt::format(
      "{} particles, {}, {} precision, {} threads, {} lanes, {}\n"
      "particle-steps    {:.4g} million a second\n"
      "contact steps     {:.4g} million a second (pairs that touch or are bonded)\n"
      "memory            {:.0f} bytes a particle\n"
      "bandwidth         {:.3g} % of the {:.3g} GB/s that updating as much memory reaches ({:.0f} bytes a particle and step at "
      "the "
      "least)\n"
      "arithmetic        {:.3g} % of the {:.3g} GFLOP/s that products and sums reach\n"
      "neighbour search  {:.3g} % of the time, every {:.0f} steps\n",
      c.at("particles").dump(), c.at("case").get<std::string>(), c.at("precision").get<std::string>(), c.at("threads").dump(),
      c.at("lanes").dump(), c.at("backend").get<std::string>(), number("particle_steps_per_second") * 1e-6,
      number("contact_steps_per_s") * 1e-6, number("bytes_per_particle"), number("bandwidth_share") * 100,
      number("bandwidth_bytes_per_s") * 1e-9, number("bytes_moved_per_particle_and_step"), number("flop_share") * 100,
      number("arithmetic_limit_flops_per_s") * 1e-9, number("rebuild_share") * 100,
      number("steps") / std::max(1.0, number("rebuilds")));
}

/// All sizes in both precisions: a line as each is there, or at the end one JSON object.
ExitCode card(BenchOptions const& options) {
  KokkosSession const kokkos;
  std::string const title =
      fmt::format("{}, {} threads, {}, {}\n", options.what, ExecutionSpace().concurrency(), backend_name(), compiler_name());
  ExitCode code = options.json ? ExitCode::done : print_result(title + card_head());
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  throughput_card(options.setup, options.setup.discs, options.seconds, [&](ThroughputRow const& row) {
    if (options.json) {
      rows.push_back(json_of(row));
    } else if (code == ExitCode::done) {
      code = print_result(card_line(row));
    }
  });
  if (!options.json) return code;
  nlohmann::ordered_json result = json_of(options);
  result["rows"] = rows;
  return print_json(json_text(result));
}

ExitCode bench(BenchOptions options) {
  set_up_threads(options.threads);
  auto const named = std::find(std::begin(throughput_case_names), std::end(throughput_case_names), options.what);
  options.setup.precision = options.precision == precision_names[0] ? Precision::full : Precision::mixed;
  options.setup.what = static_cast<ThroughputCase>(named - std::begin(throughput_case_names));
  if (options.card) return card(options);
  KokkosSession const kokkos;
  nlohmann::ordered_json result = json_of(options);
  result.update(json_of(throughput_row(options.setup, options.seconds)));
  double const arithmetic = arithmetic_rate();
  result["lanes"] = options.setup.precision == Precision::full ? lane_count : lane_count_of<float>;
  result["arithmetic_limit_flops_per_s"] = arithmetic;
  result["flop_share"] = arithmetic > 0 ? result.at("flops_per_s").get<double>() / arithmetic : 0;
  return options.json ? print_json(json_text(result)) : print_result(text_of(result));
}

}  // namespace

void add_bench(CLI::App& program, Verb& chosen) {
  auto const options = std::make_shared<BenchOptions>();
  CLI::App* const verb = program.add_subcommand("bench", "Measure how fast this machine runs whole time steps");
  verb->add_option("--case", options->what,
                   "grains with rolling resistance, bonded with 55 % hydrate, or sheared until bonds break")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(throughput_case_names), std::end(throughput_case_names))))
      ->capture_default_str();
  CLI::Option* const precision =
      verb->add_option("--precision", options->precision, "numbers of the steps, as run.precision")
          ->check(CLI::IsMember(std::vector<std::string>(std::begin(precision_names), std::end(precision_names))))
          ->capture_default_str();
  CLI::Option const* const discs =
      verb->add_option("--particles", options->setup.discs, "number of particles, about; the largest of a card")
          ->check(CLI::Range(std::int64_t{100}, std::int64_t{100000000}))
          ->capture_default_str();
  verb->add_option("--threads", options->threads, "threads")->check(CLI::Range(1, 4096))->type_name("N");
  verb->add_option("--seconds", options->seconds, "time to measure")->check(CLI::Range(0.01, 3600.0))->capture_default_str();
  verb->add_flag("--json", options->json, "one JSON object, SI units");
  verb->add_flag(
          "--card", options->card,
          "a table instead: 2000 particles, ten times as many each time, and --particles (1000000), in both precisions, with "
          "the share of the bandwidth that updating as much memory reaches")
      ->excludes(precision);
  verb->footer("Example: clathra bench --case bonded --particles 20000 --threads 1 --json");
  verb->callback([options, discs, &chosen] {
    if (options->card && discs->count() == 0) options->setup.discs = 1'000'000;
    if (options->card && options->setup.discs < 2000)
      throw CLI::ValidationError("--particles", "a card begins with 2000 particles");
    chosen = [options] { return bench(*options); };
  });
}

}  // namespace clathra
