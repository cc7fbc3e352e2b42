#include "io/checkpoint.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/checkpoint_content.hpp"
#include "io/digest.hpp"
#include "io/problems.hpp"
#include "io/scene_file.hpp"
#include "io/text_file.hpp"
#include "io/together.hpp"

namespace clathra {
namespace {

using Json = nlohmann::json;

constexpr char manifest_format[] = "clathra checkpoint manifest";
constexpr std::size_t largest_manifest = 16 << 20;

std::filesystem::path file_of(std::filesystem::path const& run_folder, int generation, char const* extension) {
  return run_folder / "ckpt" / fmt::format("{}.{}", generation, extension);
}

Json content_json(FoundCheckpoint const& c) {
  Json snapshots = Json::array();
  for (SnapshotEntry const& e : c.progress.snapshots)
    snapshots.push_back({{"file", e.file}, {"step", e.step}, {"eps1", e.eps1}, {"discs", e.discs}, {"pairs", e.pairs}});
  return {{"version", checkpoint_version},
          {"sequence", c.sequence},
          {"step", c.step},
          {"bytes", std::filesystem::file_size(c.file)},
          {"digest_xxh3_128", c.digest},
          {"history_bytes", c.progress.history_bytes},
          {"events_bytes", c.progress.events_bytes},
          {"snapshots", snapshots}};
}

Json manifest_json(FoundCheckpoint const& c) {
  Json const content = content_json(c);
  return {{"format", manifest_format}, {"content", content}, {"content_digest_xxh3_128", text_digest(content.dump())}};
}

/// @throws Json::exception
FoundCheckpoint checkpoint_of(Json const& content, std::filesystem::path const& run_folder, int generation) {
  FoundCheckpoint c;
  c.file = file_of(run_folder, generation, "h5");
  c.generation = generation;
  c.sequence = content.at("sequence").get<std::int64_t>();
  c.step = content.at("step").get<std::int64_t>();
  c.digest = content.at("digest_xxh3_128").get<std::string>();
  c.progress.history_bytes = content.at("history_bytes").get<std::uintmax_t>();
  c.progress.events_bytes = content.at("events_bytes").get<std::uintmax_t>();
  for (Json const& e : content.at("snapshots"))
    c.progress.snapshots.push_back({e.at("file").get<std::string>(), e.at("step").get<std::int64_t>(), e.at("eps1").get<double>(),
                                    e.at("discs").get<std::size_t>(), e.at("pairs").get<std::size_t>()});
  return c;
}

/// The checkpoint of a manifest. @throws FileProblem with what is wrong with it
FoundCheckpoint read_manifest(std::filesystem::path const& run_folder, int generation) {
  std::filesystem::path const manifest = file_of(run_folder, generation, "json");
  auto const bad = [&](std::string const& what) -> FileProblem { return {ExitCode::bad_input, manifest, what}; };
  Json const whole = Json::parse(read_text_file(manifest, largest_manifest), nullptr, false);
  std::uintmax_t bytes = 0;
  FoundCheckpoint c;
  try {
    if (whole.at("format").get<std::string>() != manifest_format) throw bad("is no manifest of a checkpoint");
    Json const& content = whole.at("content");
    if (text_digest(content.dump()) != whole.at("content_digest_xxh3_128").get<std::string>()) throw bad("is damaged");
    if (auto const version = content.at("version").get<std::int64_t>(); version < 1 || version > checkpoint_version)
      throw bad(fmt::format("has version {}, this program reads 1 to {}", version, checkpoint_version));
    bytes = content.at("bytes").get<std::uintmax_t>();
    c = checkpoint_of(content, run_folder, generation);
  } catch (Json::exception const&) {
    throw bad("is damaged");
  }
  std::error_code error;
  std::uintmax_t const present = std::filesystem::file_size(c.file, error);
  if (error) throw FileProblem(ExitCode::file_missing, c.file, "is missing");
  if (present != bytes) throw bad(fmt::format("speaks of {} bytes, {} has {}", bytes, c.file.filename().string(), present));
  if (std::string const digest = file_digest(c.file); digest != c.digest)
    throw FileProblem(ExitCode::bad_input, c.file, fmt::format("has digest {} instead of {}", digest, c.digest));
  return c;
}

}  // namespace

CheckpointSeries::CheckpointSeries(std::filesystem::path run_folder, Ranks ranks, std::optional<FoundCheckpoint> const& last)
    : folder_(std::move(run_folder)), ranks_(std::move(ranks)) {
  if (!last) return;
  generation_ = 1 - last->generation;
  sequence_ = last->sequence + 1;
}

void CheckpointSeries::write(Scene const& scene, TestState const& state, std::int64_t step, RunProgress const& progress) {
  on_root(ranks_, [&] {
    std::error_code error;
    std::filesystem::create_directories(folder_ / "ckpt", error);
    if (error) throw FileProblem(ExitCode::cannot_create, folder_ / "ckpt", error.message());
    // A manifest never vouches for a file that is being replaced.
    std::filesystem::remove(file_of(folder_, generation_, "json"), error);
  });
  FoundCheckpoint c{file_of(folder_, generation_, "h5"), generation_, sequence_, step, "", progress};
  write_checkpoint_content(c.file, scene, state, ranks_);
  on_root(ranks_, [&] {
    c.digest = file_digest(c.file);
    replace_text_file(file_of(folder_, generation_, "json"), manifest_json(c).dump(1) + "\n");
    flush_folder(folder_ / "ckpt");
  });
  generation_ = 1 - generation_;
  ++sequence_;
  ++written_;
}

namespace {

std::optional<FoundCheckpoint> newest_checkpoint(std::filesystem::path const& run_folder) {
  std::optional<FoundCheckpoint> newest;
  std::string problems;
  for (int generation : {0, 1}) {
    std::error_code ignored;
    if (!std::filesystem::exists(file_of(run_folder, generation, "json"), ignored)) continue;
    try {
      FoundCheckpoint const found = read_manifest(run_folder, generation);
      if (!newest || found.sequence > newest->sequence) newest = found;
    } catch (FileProblem const& problem) {
      problems += (problems.empty() ? "" : "; ") + std::string(problem.what());
    }
  }
  if (!newest && !problems.empty())
    throw FileProblem(ExitCode::file_missing, run_folder / "ckpt", "holds no checkpoint that can be used: " + problems);
  return newest;
}

}  // namespace

std::optional<FoundCheckpoint> find_checkpoint(std::filesystem::path const& run_folder, Ranks const& ranks) {
  std::optional<FoundCheckpoint> found;
  on_root(ranks, [&] { found = newest_checkpoint(run_folder); });
  if (ranks.alone()) return found;
  std::string const text = ranks.from_root(found ? content_json(*found).dump() : "");
  if (text.empty()) return std::nullopt;
  int const generation = static_cast<int>(ranks.max(found ? found->generation : 0));
  return checkpoint_of(Json::parse(text), run_folder, generation);
}

bool is_finished_run(std::filesystem::path const& run_folder, std::string const& resolved) {
  std::error_code ignored;
  std::filesystem::path const record = run_folder / "run.json";
  if (!std::filesystem::exists(record, ignored)) return false;
  Json const json = Json::parse(read_text_file(record, largest_manifest), nullptr, false);
  if (!json.is_object() || !json.contains("exit") || json["exit"].value("reason", "") != "finished") return false;
  // Read and written again: what wrote it may not have known all keys.
  std::filesystem::path const file = run_folder / "resolved.toml";
  Scene const then = parse_scene(read_text_file(file, largest_manifest), file, run_folder).scene;
  if (resolved_scene(then, run_folder) != resolved)
    throw FileProblem(ExitCode::refused, run_folder,
                      "holds the finished run of another scene; --resume would destroy it, choose another folder");
  return true;
}

TestState read_checkpoint(FoundCheckpoint const& checkpoint, Scene const& scene, Ranks const& ranks) {
  TestState state;
  on_each(ranks, [&] { state = read_checkpoint_content(checkpoint.file, scene, ranks); });
  return state;
}

void remove_checkpoints(std::filesystem::path const& run_folder) {
  std::error_code ignored;
  for (int generation : {0, 1}) {
    for (char const* const extension : {"json", "h5"})
      std::filesystem::remove(file_of(run_folder, generation, extension), ignored);
  }
  // What a kill left half written goes too.
  for (auto entry = std::filesystem::directory_iterator(run_folder / "ckpt", ignored);
       entry != std::filesystem::directory_iterator(); entry.increment(ignored)) {
    if (entry->path().filename().string().find(".tmp-") != std::string::npos) std::filesystem::remove(entry->path(), ignored);
  }
  std::filesystem::remove(run_folder / "ckpt", ignored);  // only if it is empty now
}

}  // namespace clathra
