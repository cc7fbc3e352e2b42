#include "io/checkpoint_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/checkpoint.hpp"
#include "io/hdf5_file.hpp"
#include "io/run_record.hpp"
#include "io/scene_value.hpp"
#include "io/schema.hpp"

namespace clathra {
namespace {

using Json = nlohmann::json;

constexpr char format_name[] = "clathra checkpoint";

/// Keys that do not change what is computed.
bool may_differ(Key const& key) {
  return key.section() == "output" ? key.leaf() == "folder" : key.name == "run.threads" || key.name == "sample.file";
}

/// The scene, key by key, as the user writes values.
Json scene_text(Scene const& scene) {
  Json text = Json::object();
  for (Key const& key : schema()) {
    if (!may_differ(key)) text[std::string(key.name)] = value_text(key, scene);
  }
  return text;
}

/// The discs' records as columns: one for each number of a disc, and one for each number of an entry of all their rows.
struct Columns {
  std::vector<std::int32_t> id, length, neighbour;
  std::vector<std::vector<double>> discs, history;
};

Columns columns_of(SimulationState const& s) {
  Columns c;
  c.discs.resize(s.disc_columns.size());
  c.history.resize(s.history_columns.size());
  for (std::size_t k = 0; k < s.discs.size(); ++k) {
    double const* n = &s.discs.numbers[s.discs.begin[k]];
    c.id.push_back(static_cast<std::int32_t>(*n++));
    for (auto& column : c.discs) column.push_back(*n++);
    c.length.push_back(static_cast<std::int32_t>(*n++));
    for (int entry = 0; entry < c.length.back(); ++entry) {
      c.neighbour.push_back(static_cast<std::int32_t>(*n++));
      for (auto& column : c.history) column.push_back(*n++);
    }
  }
  return c;
}

DiscRecords records_of(Columns const& c) {
  DiscRecords records;
  std::size_t entry = 0;
  for (std::size_t k = 0; k < c.id.size(); ++k) {
    records.numbers.push_back(c.id[k]);
    for (auto const& column : c.discs) records.numbers.push_back(column[k]);
    records.numbers.push_back(c.length[k]);
    for (int n = 0; n < c.length[k]; ++n, ++entry) {
      records.numbers.push_back(c.neighbour[entry]);
      for (auto const& column : c.history) records.numbers.push_back(column[entry]);
    }
    records.begin.push_back(records.numbers.size());
  }
  return records;
}

std::uint64_t total(Ranks const& ranks, std::size_t count) {
  return static_cast<std::uint64_t>(ranks.sum(static_cast<std::int64_t>(count)));
}

void write_events(Hdf5File& file, TestState const& state) {
  std::vector<double> step, position;
  std::vector<std::int32_t> id_a, id_b;
  std::vector<std::uint8_t> mode, taken;
  for (BreakEvent const& e : state.simulation.broken) {
    taken.push_back(step.size() < state.events_taken ? 1 : 0);
    step.push_back(static_cast<double>(e.step));
    id_a.push_back(e.id_a);
    id_b.push_back(e.id_b);
    mode.push_back(static_cast<std::uint8_t>(e.mode));
    position.insert(position.end(), {e.x, e.y});
  }
  file.write("events/step", step, "");
  file.write("events/id_a", id_a, "");
  file.write("events/id_b", id_b, "");
  file.write("events/mode", mode, "1 tension, 2 compression, 3 shear, 4 rolling");
  file.write("events/taken", taken, "1 = stands in events.csv");
  std::vector<double> x, y;
  for (std::size_t k = 0; k < position.size(); k += 2) x.push_back(position[k]), y.push_back(position[k + 1]);
  file.write("events/x", x, "m");
  file.write("events/y", y, "m");
}

/// A part of a table of so many rows.
struct Part {
  std::size_t size, begin, end;
  template <class T>
  std::vector<T> of(Hdf5File const& file, std::string const& name) const {
    return file.read_rows<T>(name, size, begin, end);
  }
};

Part share(std::int64_t size, Ranks const& ranks) {
  return {static_cast<std::size_t>(size), static_cast<std::size_t>(size * ranks.rank() / ranks.count()),
          static_cast<std::size_t>(size * (ranks.rank() + 1) / ranks.count())};
}

void read_events(Hdf5File const& file, TestState& state, Ranks const& ranks) {
  Part const part = share(file.integer_attribute("events"), ranks);
  auto const step = part.of<double>(file, "events/step"), x = part.of<double>(file, "events/x"),
             y = part.of<double>(file, "events/y");
  auto const id_a = part.of<std::int32_t>(file, "events/id_a"), id_b = part.of<std::int32_t>(file, "events/id_b");
  auto const mode = part.of<std::uint8_t>(file, "events/mode"), taken = part.of<std::uint8_t>(file, "events/taken");
  for (bool const wanted : {true, false}) {  // those that were taken come first
    for (std::size_t k = 0; k < step.size(); ++k) {
      if ((taken[k] != 0) != wanted) continue;
      if (mode[k] < 1 || mode[k] >= break_mode_count) file.fail(ExitCode::bad_input, "an event names no mode of breakage");
      state.simulation.broken.push_back({std::llround(step[k]), id_a[k], id_b[k], mode[k], x[k], y[k]});
    }
    if (wanted) state.events_taken = state.simulation.broken.size();
  }
}

/// Rows of the discs [begin, end): lengths must be read first, as rows follow one another.
Columns read_columns(Hdf5File const& file, SimulationState const& s, Ranks const& ranks) {
  std::int64_t const discs = file.integer_attribute("particles"), entries = file.integer_attribute("entries");
  if (discs < 1 || discs > 1'000'000'000 || entries < 0 || entries > discs * longest_row)
    file.fail(ExitCode::bad_input, fmt::format("claims {} discs and {} neighbours", discs, entries));
  Part const part = share(discs, ranks);
  std::int64_t before = 0, own = 0;
  std::size_t constexpr piece = 1 << 20;
  for (std::size_t at = 0; at < part.begin; at += piece) {
    for (int const n : file.read_rows<std::int32_t>("rows/length", part.size, at, std::min(at + piece, part.begin))) before += n;
  }
  Columns c;
  c.id = part.of<std::int32_t>(file, "particles/id");
  c.length = part.of<std::int32_t>(file, "rows/length");
  for (std::size_t k = 0; k < c.id.size(); ++k) {
    if (c.id[k] < 0 || c.id[k] >= discs)
      file.fail(ExitCode::bad_input, fmt::format("disc id {} is outside 0..{}", c.id[k], discs - 1));
    if (c.length[k] < 0 || c.length[k] > longest_row)
      file.fail(ExitCode::bad_input, fmt::format("a row of {} neighbours", c.length[k]));
    own += c.length[k];
  }
  if (before + own > entries) file.fail(ExitCode::bad_input, "rows are longer than all neighbours together");
  Part const rows{static_cast<std::size_t>(entries), static_cast<std::size_t>(before), static_cast<std::size_t>(before + own)};
  for (std::string const& name : s.disc_columns) {
    c.discs.push_back(part.of<double>(file, "particles/" + name));
    if (!std::all_of(c.discs.back().begin(), c.discs.back().end(), [](double v) { return std::isfinite(v); }))
      file.fail(ExitCode::bad_input, fmt::format("particles/{} holds a number that is not finite", name));
  }
  c.neighbour = rows.of<std::int32_t>(file, "rows/neighbour");
  for (std::string const& name : s.history_columns) c.history.push_back(rows.of<double>(file, "rows/" + name));
  return c;
}

void require_same_scene(Hdf5File const& file, Json const& then, Scene const& scene) {
  Json const now = scene_text(scene);
  std::string different;
  for (auto const& [name, value] : now.items()) {
    std::string const before = then.contains(name) ? then.at(name).get<std::string>() : "nothing";
    if (before != value.get<std::string>())
      different += fmt::format("; {} was {}, is {}", name, before, value.get<std::string>());
  }
  if (!different.empty()) file.fail(ExitCode::refused, "is a checkpoint of another scene" + different);
}

}  // namespace

void write_checkpoint_content(std::filesystem::path const& path, Scene const& scene, TestState const& state, Ranks const& ranks) {
  SimulationState const& s = state.simulation;
  Columns const c = columns_of(s);
  Json const about = {{"scene", scene_text(scene)},          {"test", state.numbers},   {"preparation", state.preparation},
                      {"warnings", state.warnings},          {"simulation", s.numbers}, {"disc_columns", s.disc_columns},
                      {"history_columns", s.history_columns}};
  auto const write_content = [&](Hdf5File& file) {
    file.set_attribute("format", std::string(format_name));
    file.set_attribute("version", checkpoint_version);
    file.set_attribute("precision", std::string("double"));
    file.set_attribute("particles", static_cast<std::int64_t>(total(ranks, c.id.size())));
    file.set_attribute("entries", static_cast<std::int64_t>(total(ranks, c.neighbour.size())));
    file.set_attribute("events", static_cast<std::int64_t>(total(ranks, s.broken.size())));
    file.set_attribute("state_hash", hash_text(state.hash));
    file.write_text("about", about.dump());
    file.write("particles/id", c.id, "");
    for (std::size_t k = 0; k < c.discs.size(); ++k) file.write("particles/" + s.disc_columns[k], c.discs[k], "");
    file.write("rows/length", c.length, "");
    file.write("rows/neighbour", c.neighbour, "id");
    for (std::size_t k = 0; k < c.history.size(); ++k) file.write("rows/" + s.history_columns[k], c.history[k], "");
    write_events(file, state);
  };
  replace_hdf5_file(path, write_content, ranks);
}

TestState read_checkpoint_content(std::filesystem::path const& path, Scene const& scene, Ranks const& ranks) {
  Hdf5File const file = Hdf5File::open(path);
  if (file.text_attribute("format") != format_name) file.fail(ExitCode::bad_input, "is not a checkpoint of Clathra");
  if (std::int64_t const version = file.integer_attribute("version"); version != checkpoint_version)
    file.fail(ExitCode::refused, fmt::format("has version {}, this program reads {}", version, checkpoint_version));
  if (std::string const precision = file.text_attribute("precision"); precision != "double")
    file.fail(ExitCode::refused, fmt::format("has precision {}, this program computes in double", precision));
  Json const about = Json::parse(file.read_text("about"), nullptr, false);
  TestState state;
  try {
    require_same_scene(file, about.at("scene"), scene);
    about.at("test").get_to(state.numbers);
    about.at("preparation").get_to(state.preparation);
    about.at("warnings").get_to(state.warnings);
    about.at("simulation").get_to(state.simulation.numbers);
    about.at("disc_columns").get_to(state.simulation.disc_columns);
    about.at("history_columns").get_to(state.simulation.history_columns);
  } catch (Json::exception const& problem) {
    file.fail(ExitCode::bad_input, fmt::format("about: {}", problem.what()));
  }
  state.simulation.discs = records_of(read_columns(file, state.simulation, ranks));
  read_events(file, state, ranks);
  return state;
}

std::string checkpoint_state_hash(std::filesystem::path const& path) { return Hdf5File::open(path).text_attribute("state_hash"); }

bool is_checkpoint(std::filesystem::path const& path) { return Hdf5File::open(path).text_attribute("format") == format_name; }

}  // namespace clathra
