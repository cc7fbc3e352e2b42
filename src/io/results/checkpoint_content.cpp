#include "io/results/checkpoint_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numeric>

#include "io/results/checkpoint.hpp"
#include "io/results/event_columns.hpp"
#include "io/results/run_record.hpp"
#include "io/scene/scene_comparison.hpp"
#include "kernels/countable.hpp"

namespace clathra {
namespace {

using Json = nlohmann::json;

constexpr char checkpoint_format[] = "clathra checkpoint";

/// Of a checkpoint RUN/ckpt/0.h5.
std::filesystem::path run_folder_of(std::filesystem::path const& checkpoint) { return checkpoint.parent_path().parent_path(); }

void write_discs(Hdf5File& file, DiscColumns const& discs) {
  file.write("particles/id", discs.id(), "");
  for (DiscColumns::Column const& column : discs.discs) file.write("particles/" + column.name, column.numbers(), "");
  file.write("rows/length", discs.row_length(), "");
  file.write("rows/neighbour", discs.neighbour(), "id");
  for (DiscColumns::Column const& column : discs.history) file.write("rows/" + column.name, column.numbers(), "");
}

void write_test_events(Hdf5File& file, TestState const& state) {
  BreakEvents const& events = state.simulation.broken;
  write_event_columns(file, events);
  std::vector<std::uint8_t> taken;
  std::vector<double> x, y;
  for (BreakEvent const& e : events.rows) {
    taken.push_back(taken.size() < state.events_taken ? 1 : 0);
    x.push_back(e.x);
    y.push_back(e.y);
  }
  file.write("events/taken", taken, "1 = stands in events.csv");
  file.write("events/x", x, "m");
  file.write("events/y", y, "m");
}

void read_test_events(Hdf5File const& file, TestState& state, Ranks const& ranks) {
  std::int64_t const count = file.integer_attribute("events");
  if (count < 0) file.fail(ExitCode::bad_input, fmt::format("claims {} events", count));
  RowRange const rows = rows_of_rank(count, ranks);
  BreakEvents const events = read_event_columns(file, rows);
  auto const taken = file.read<std::uint8_t>("events/taken", rows);
  auto const x = file.read<double>("events/x", rows), y = file.read<double>("events/y", rows);
  BreakEvents& broken = state.simulation.broken;
  broken.detailed = events.detailed;
  for (bool const wanted : {true, false}) {  // those that were taken come first
    for (std::size_t k = 0; k < events.rows.size(); ++k) {
      if ((taken[k] != 0) != wanted) continue;
      broken.add(events, k);
      broken.rows.back().x = x[k];
      broken.rows.back().y = y[k];
    }
    if (wanted) state.events_taken = broken.rows.size();
  }
}

/// Lengths of this rank's rows, and which of all entries are theirs.
RowRange read_lengths(Hdf5File const& file, RowRange const& discs, std::int64_t entries, std::vector<std::int32_t>& lengths) {
  constexpr std::size_t piece = 1 << 20;
  std::int64_t before = 0, own = 0;
  for (std::size_t at = 0; at < discs.begin; at += piece) {
    for (int const n : file.read<std::int32_t>("rows/length", {discs.size, at, std::min(at + piece, discs.begin)})) before += n;
  }
  lengths = file.read<std::int32_t>("rows/length", discs);
  for (int const n : lengths) {
    if (n < 0 || n > longest_row) file.fail(ExitCode::bad_input, fmt::format("a row of {} neighbours", n));
    own += n;
  }
  if (before + own > entries) file.fail(ExitCode::bad_input, "rows are longer than all neighbours together");
  return {static_cast<std::size_t>(entries), static_cast<std::size_t>(before), static_cast<std::size_t>(before + own)};
}

std::vector<double> read_finite(Hdf5File const& file, std::string const& name, RowRange const& range) {
  auto column = file.read<double>(name, range);
  if (!std::all_of(column.begin(), column.end(), [](double v) { return std::isfinite(v); }))
    file.fail(ExitCode::bad_input, name + " holds a number that is not finite");
  return column;
}

/// A column that is there already, as one that is made when it is asked for.
template <class T>
std::function<std::vector<T>()> held(std::vector<T> column) {
  return [column = std::move(column)] { return column; };
}

/// This rank's part of the discs: all numbers are read, and looked at, before any is used.
DiscColumns read_discs(Hdf5File const& file, RecordColumns const& names, Ranks const& ranks) {
  std::int64_t const discs = file.integer_attribute("particles"), entries = file.integer_attribute("entries");
  if (discs < 1 || discs > 1'000'000'000 || entries < 0 || entries > discs * longest_row)
    file.fail(ExitCode::bad_input, fmt::format("claims {} particles and {} neighbours", discs, entries));
  RowRange const rows = rows_of_rank(discs, ranks);
  std::vector<std::int32_t> lengths;
  RowRange const row_entries = read_lengths(file, rows, entries, lengths);
  auto ids = file.read<std::int32_t>("particles/id", rows);
  for (int const id : ids)
    if (id < 0 || id >= discs) file.fail(ExitCode::bad_input, fmt::format("particle id {} is outside 0..{}", id, discs - 1));
  DiscColumns columns;
  columns.id = held(std::move(ids));
  columns.row_length = held(std::move(lengths));
  columns.neighbour = held(file.read<std::int32_t>("rows/neighbour", row_entries));
  for (std::string const& name : names.discs) columns.discs.push_back({name, held(read_finite(file, "particles/" + name, rows))});
  for (std::string const& name : names.history)
    columns.history.push_back({name, held(read_finite(file, "rows/" + name, row_entries))});
  return columns;
}

Json stages_json(std::vector<StageResult> const& done) {
  Json all = Json::array();
  for (StageResult const& stage : done)
    all.push_back({{"name", stage.name}, {"ended_by", stage.ended_by}, {"numbers", stage.numbers}, {"warnings", stage.warnings}});
  return all;
}

std::vector<StageResult> stages_in(Json const& all) {
  std::vector<StageResult> done;
  for (Json const& stage : all)
    done.push_back({stage.at("name").get<std::string>(), stage.at("ended_by").get<std::string>(),
                    stage.at("numbers").get<StageRecord>(), stage.at("warnings").get<std::vector<std::string>>()});
  return done;
}

}  // namespace

void write_checkpoint_content(std::filesystem::path const& path, Scene const& scene, TestState const& state, Ranks const& ranks) {
  SimulationState const& s = state.simulation;
  RecordColumns const names = s.discs.names();
  std::vector<std::int32_t> const lengths = s.discs.row_length();
  auto const total = [&](std::size_t count) { return ranks.sum(static_cast<std::int64_t>(count)); };
  Json const about = {{"scene", scene_texts(scene, run_folder_of(path))},
                      {"test", state.numbers},
                      {"stages_done", stages_json(state.done)},
                      {"preparation", state.preparation},
                      {"warnings", state.warnings},
                      {"simulation", s.numbers},
                      {"disc_columns", names.discs},
                      {"history_columns", names.history}};
  auto const write_content = [&](Hdf5File& file) {
    file.set_attribute("format", std::string(checkpoint_format));
    file.set_attribute("version", checkpoint_version);
    file.set_attribute("precision", std::string("double"));
    file.set_attribute("particles", total(lengths.size()));
    file.set_attribute("entries", total(std::accumulate(lengths.begin(), lengths.end(), std::size_t{0})));
    file.set_attribute("events", total(s.broken.rows.size()));
    file.set_attribute("state_hash", hash_text(state.hash));
    file.write_text("about", about.dump());
    write_discs(file, s.discs);
    write_test_events(file, state);
  };
  replace_hdf5_file(path, write_content, ranks);
}

TestState read_checkpoint_content(std::filesystem::path const& path, Scene const& scene, Ranks const& ranks) {
  Hdf5File const file = Hdf5File::open(path);
  if (file.text_attribute("format") != checkpoint_format) file.fail(ExitCode::bad_input, "is not a checkpoint of Clathra");
  if (std::int64_t const version = file.integer_attribute("version"); version != checkpoint_version)
    file.fail(ExitCode::refused, fmt::format("has version {}, this program reads {}", version, checkpoint_version));
  if (std::string const precision = file.text_attribute("precision"); precision != "double")
    file.fail(ExitCode::refused, fmt::format("has precision {}, this program computes in double", precision));
  Json const about = Json::parse(file.read_text("about"), nullptr, false);
  TestState state;
  RecordColumns names;
  try {
    std::string const different =
        scene_differences(about.at("scene").get<SceneTexts>(), scene, run_folder_of(path), Agreement::further);
    if (!different.empty()) file.fail(ExitCode::cannot_create, "is a checkpoint of another scene" + different);
    about.at("test").get_to(state.numbers);
    state.done = stages_in(about.at("stages_done"));
    about.at("preparation").get_to(state.preparation);
    about.at("warnings").get_to(state.warnings);
    about.at("simulation").get_to(state.simulation.numbers);
    about.at("disc_columns").get_to(names.discs);
    about.at("history_columns").get_to(names.history);
  } catch (Json::exception const& problem) {
    file.fail(ExitCode::bad_input, fmt::format("about: {}", problem.what()));
  }
  state.simulation.discs = read_discs(file, names, ranks);
  read_test_events(file, state, ranks);
  return state;
}

std::string checkpoint_state_hash(std::filesystem::path const& path) { return Hdf5File::open(path).text_attribute("state_hash"); }

bool is_checkpoint(std::filesystem::path const& path) {
  Hdf5File const file = Hdf5File::open(path);
  return file.has_attribute("format") && file.text_attribute("format") == checkpoint_format;
}

}  // namespace clathra
