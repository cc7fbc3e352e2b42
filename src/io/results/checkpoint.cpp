#include "io/results/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "io/errors/problems.hpp"
#include "io/errors/rank_errors.hpp"
#include "io/formats/digest.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/checkpoint_content.hpp"

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
    snapshots.push_back({{"file", e.file}, {"step", e.step}, {"path", e.path}, {"particles", e.discs}, {"pairs", e.pairs}});
  return {{"version", checkpoint_version},
          {"sequence", c.sequence},
          {"step", c.step},
          {"bytes", std::filesystem::file_size(c.file)},
          {"digest_xxh3_128", c.digest},
          {"history_bytes", c.progress.history.bytes},
          {"history_digest_xxh3_128", c.progress.history.digest},
          {"events_bytes", c.progress.events.bytes},
          {"events_digest_xxh3_128", c.progress.events.digest},
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
  auto const rows_of = [&](std::string const& table) {
    return RowsWritten{content.at(table + "_bytes").get<std::uintmax_t>(),
                       content.at(table + "_digest_xxh3_128").get<std::string>()};
  };
  c.progress.history = rows_of("history");
  c.progress.events = rows_of("events");
  for (Json const& e : content.at("snapshots"))
    c.progress.snapshots.push_back({e.at("file").get<std::string>(), e.at("step").get<std::int64_t>(), e.at("path").get<double>(),
                                    e.at("particles").get<std::size_t>(), e.at("pairs").get<std::size_t>()});
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
    if (auto const version = content.at("version").get<std::int64_t>(); version != checkpoint_version)
      throw bad(fmt::format("has version {}, this program reads {}", version, checkpoint_version));
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

/// Removes what a kill left half written: files under the names that they have until they are whole.
void remove_half_written(std::filesystem::path const& run_folder) {
  std::error_code ignored;
  for (char const* const folder : {"", "ckpt", "snap"}) {
    for (auto entry = std::filesystem::directory_iterator(run_folder / folder, ignored);
         entry != std::filesystem::directory_iterator(); entry.increment(ignored)) {
      std::string const name = entry->path().filename().string();
      bool const is_lock = name.starts_with(".lock");  // which another program may be waiting for
      if (!is_lock && name.find(".tmp-") != std::string::npos) std::filesystem::remove(entry->path(), ignored);
    }
  }
}

/// Removes these generations, the file of a manifest after it, and what a kill left half written.
void remove_generations(std::filesystem::path const& run_folder, std::initializer_list<int> generations) {
  std::error_code ignored;
  for (int const generation : generations) {
    for (char const* const extension : {"json", "h5"})
      std::filesystem::remove(file_of(run_folder, generation, extension), ignored);
  }
  remove_half_written(run_folder);
  std::filesystem::remove(run_folder / "ckpt", ignored);  // only if it is empty now
}

}  // namespace

CheckpointSeries::CheckpointSeries(std::filesystem::path run_folder, Ranks ranks, std::optional<FoundCheckpoint> const& last)
    : folder_(std::move(run_folder)), ranks_(std::move(ranks)) {
  if (!last) return;
  on_root(ranks_, [&] { remove_half_written(folder_); });
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

void CheckpointSeries::keep_newest() const { remove_generations(folder_, {generation_}); }

namespace {

FoundCheckpoints look_for_checkpoints(std::filesystem::path const& run_folder) {
  FoundCheckpoints found;
  std::vector<int> without_manifest;
  for (int generation : {0, 1}) {
    std::error_code ignored;
    if (!std::filesystem::exists(file_of(run_folder, generation, "json"), ignored)) {
      if (std::filesystem::exists(file_of(run_folder, generation, "h5"), ignored)) without_manifest.push_back(generation);
      continue;
    }
    try {
      found.usable.push_back(read_manifest(run_folder, generation));
    } catch (FileProblem const& problem) {
      found.damaged.push_back(problem);
    }
  }
  std::sort(found.usable.begin(), found.usable.end(), [](auto const& a, auto const& b) { return a.sequence > b.sequence; });
  for (int const generation : without_manifest)
    found.damaged.emplace_back(ExitCode::file_missing, file_of(run_folder, generation, "json"),
                               fmt::format("is missing, so {}.h5 is not used: the run was ended while it wrote that "
                                           "checkpoint, or the file is lost",
                                           generation));
  // Where there is no other, a kill may have come before the first manifest.
  bool const first = found.damaged.size() == 1 && without_manifest.size() == 1;
  if (found.usable.empty() && !found.damaged.empty() && !first)
    throw FileProblem(ExitCode::file_missing, run_folder / "ckpt", no_checkpoint_text(found.damaged));
  return found;
}

}  // namespace

std::string no_checkpoint_text(std::vector<FileProblem> const& problems) {
  std::string text;
  for (FileProblem const& problem : problems) {
    std::string const what = problem.what();
    if (text.find(what) == std::string::npos) text += (text.empty() ? "" : "; ") + what;  // rows are those of both
  }
  return "holds no checkpoint that can be used: " + text +
         "; nothing was changed: put back what was there, or begin again with --overwrite or in another folder";
}

FoundCheckpoints find_checkpoints(std::filesystem::path const& run_folder, Ranks const& ranks) {
  FoundCheckpoints found;
  on_root(ranks, [&] { found = look_for_checkpoints(run_folder); });
  if (ranks.alone()) return found;
  Json list = Json::array();
  for (FoundCheckpoint const& c : found.usable) list.push_back({{"generation", c.generation}, {"content", content_json(c)}});
  list = Json::parse(ranks.from_root(list.dump()));
  found.usable.clear();
  for (Json const& c : list) found.usable.push_back(checkpoint_of(c.at("content"), run_folder, c.at("generation").get<int>()));
  return found;
}

void require_rows(std::filesystem::path const& run_folder, RunProgress const& progress) {
  for (auto const& [name, rows] : {std::pair{"history.csv", progress.history}, std::pair{"events.csv", progress.events}}) {
    if (rows.digest.empty()) continue;  // there is no such table, as events.csv where nothing is bonded
    std::filesystem::path const file = run_folder / name;
    if (std::string const now = file_digest(file, rows.bytes); now != rows.digest)
      throw FileProblem(ExitCode::bad_input, file,
                        fmt::format("its first {} bytes are not those that the run wrote: digest {} instead of {}", rows.bytes,
                                    now, rows.digest));
  }
}

TestState read_checkpoint(FoundCheckpoint const& checkpoint, Scene const& scene, Ranks const& ranks) {
  TestState state;
  on_each(ranks, [&] { state = read_checkpoint_content(checkpoint.file, scene, ranks); });
  return state;
}

bool has_checkpoints(std::filesystem::path const& run_folder) {
  std::error_code ignored;
  return std::filesystem::exists(file_of(run_folder, 0, "json"), ignored) ||
         std::filesystem::exists(file_of(run_folder, 1, "json"), ignored);
}

void remove_checkpoints(std::filesystem::path const& run_folder) { remove_generations(run_folder, {0, 1}); }

}  // namespace clathra
