#include "machine/machine_speed.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "clathra_version.hpp"
#include "domain/scene/hydrate.hpp"
#include "io/errors/problems.hpp"
#include "io/formats/text_file.hpp"
#include "machine/own_program.hpp"
#include "machine/threads.hpp"
#include "terminal/print.hpp"

namespace clathra {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double assumed_rate = 15e6;  // particle-steps a second and thread, the floor that the program is held to
constexpr std::size_t largest_cache = 1 << 20;

/// Empty where there is no place for it.
fs::path cache_file() {
  if (char const* const cache = std::getenv("XDG_CACHE_HOME"); cache && *cache)
    return fs::path(cache) / "clathra" / "throughput.json";
  if (char const* const home = std::getenv("HOME"); home && *home)
    return fs::path(home) / ".cache" / "clathra" / "throughput.json";
  return {};
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 1);
  return "unknown";
}

/// What was kept; an empty object where it cannot be read.
Json kept(fs::path const& file) {
  std::error_code ignored;
  if (file.empty() || !fs::is_regular_file(file, ignored)) return Json::object();
  Json json = Json::parse(read_text_file(file, largest_cache), nullptr, false);
  return json.is_object() ? json : Json::object();
}

void keep(fs::path const& file, std::string const& key, double rate) {
  if (file.empty()) return;
  try {
    fs::create_directories(file.parent_path());
    Json all = kept(file);
    all[key] = rate;
    replace_text_file(file, all.dump(2) + "\n");
  } catch (std::exception const&) {
    return;  // it is a cache: without it the speed is measured once more
  }
}

/// The size to measure for a specimen: what a step costs besides its particles shows in small ones, what memory costs in large.
int size_to_measure(double particles) {
  constexpr int sizes[] = {250, 500, 1000, 2000, 20'000, 200'000};
  int best = sizes[0];
  for (int const size : sizes)
    if (size <= particles) best = size;
  return best;
}

double measured(int threads, bool bonded, std::string const& precision, int particles) {
  if (!is_quiet())
    print_error("clathra: measuring the speed of this machine, once for each kind and size of test (some seconds)");
  std::string const json = output_of_own_program({"bench", "--json", "--case", bonded ? "bonded" : "rolling", "--particles",
                                                  fmt::format("{}", particles), "--seconds", "0.7", "--precision", precision,
                                                  "--threads", fmt::format("{}", threads)});
  return Json::parse(json).at("particle_steps_per_second").get<double>();
}

}  // namespace

MachineSpeed machine_speed(Scene const& scene, double particles, int ranks, bool may_measure) {
  int const threads = thread_count(scene.run.threads);
  bool const bonded = has_bonds(scene);
  fs::path const file = cache_file();
  std::string const precision = precision_names[static_cast<int>(scene.run.precision)];
  int const size = size_to_measure(particles);
  std::string const key = fmt::format("{} {},{}, {} threads, {}, {}, {} particles", CLATHRA_VERSION, CLATHRA_GIT_HASH,
                                      processor(), threads, bonded ? "bonded" : "rolling", precision, size);
  Json const all = kept(file);
  double rate = 0;
  if (auto const found = all.find(key); found != all.end() && found->is_number()) rate = found->get<double>();
  if (!(rate > 0) && may_measure) {
    rate = measured(threads, bonded, precision, size);
    keep(file, key, rate);
  }
  if (!(rate > 0)) return {assumed_rate * threads * ranks, "assumed"};
  return {rate * ranks, "measured on this machine"};
}

}  // namespace clathra
