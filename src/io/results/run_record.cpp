#include "io/results/run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "domain/parallel/ranks.hpp"
#include "io/formats/digest.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/stage_numbers.hpp"
#include "io/scene/rolling_lever_text.hpp"
#include "io/scene/schema.hpp"
#include "io/scene/stage_keys.hpp"
#include "kernels/real.hpp"

namespace clathra {
namespace {

using OrderedJson = nlohmann::ordered_json;

struct JsonValue {
  Key const& key;
  Scene& scene;
  template <class T>
  nlohmann::json operator()(T& (*at)(Scene&)) const {
    bool const given = !(at(scene) == T()) || key.takes_zero || (key.zero.empty() && key.kind != Kind::path);
    return given ? nlohmann::json(at(scene)) : nlohmann::json();
  }
  nlohmann::json operator()(RollingLever& (*at)(Scene&)) const { return format_rolling_lever(at(scene)); }
  nlohmann::json operator()(ChoiceField const& field) const {
    return std::string(key.choices[static_cast<std::size_t>(field.get(scene))]);
  }
};

struct SetFromJson {
  Key const& key;
  Scene& scene;
  nlohmann::json const& value;
  template <class T>
  void operator()(T& (*at)(Scene&)) const {
    if (value.is_null()) return static_cast<void>(at(scene) = T());
    bool fits = value.is_string();
    if constexpr (std::is_same_v<T, bool>)
      fits = value.is_boolean();
    else if constexpr (std::is_same_v<T, double>)
      fits = value.is_number();
    else if constexpr (std::is_unsigned_v<T>)
      fits = value.is_number_unsigned();
    else if constexpr (std::is_integral_v<T>)
      fits = value.is_number_integer() && std::in_range<T>(value.get<std::int64_t>());
    else if constexpr (!std::is_same_v<T, std::string>)
      fits = value.is_array();
    if (!fits) throw std::invalid_argument(fmt::format("{} is {}", key.name, value.dump().substr(0, 40)));
    value.get_to(at(scene));
  }
  void operator()(RollingLever& (*at)(Scene&)) const { at(scene) = parse_rolling_lever(value.get<std::string>()); }
  void operator()(ChoiceField const& field) const {
    auto const text = value.get<std::string>();
    auto const name = std::find(key.choices.begin(), key.choices.end(), text);
    if (name == key.choices.end()) throw std::invalid_argument(fmt::format("{} is '{}'", key.name, text.substr(0, 40)));
    field.set(scene, static_cast<int>(name - key.choices.begin()));
  }
};

OrderedJson program_json(RunRecord const& record) {
  return {{"version", record.version},
          {"git_hash", record.git_hash},
          {"compiler", compiler_name()},
          {"kokkos", kokkos_version()},
          {"backend", backend_name()},
          {"precision", precision_names[static_cast<int>(record.input.scene.run.precision)]},
          {"message_passing", message_passing_name()},
          {"ranks", record.ranks},
          {"threads", record.threads}};
}

/// What the numbers mean, by their path.
OrderedJson meaning_json(RunRecord const& record) {
  OrderedJson meaning = {
      {"scene", "null where a key was not given and has no default"},
      {"wall_seconds.generate", "making the specimen"},
      {"wall_seconds.prepare", "bonding, consolidation and writing specimen.h5; checkpoints read where it was resumed"},
      {"loading", "the stages after the consolidation in their order, and what each ended by; empty where it did not"},
      {"wall_seconds.shear", "steps, records and snapshots; neighbour_searches and checkpoints are parts of it"},
      {"wall_seconds", "of all sessions of a run that was resumed; one that was killed had not said how long it took"},
      {"particle_steps", "particles times time steps, of the whole loading"},
      {"particle_steps_per_second", "of the last session"}};
  for (auto const& [stage, numbers] : record.stages)
    for (auto const& [name, value] : numbers) meaning[fmt::format("stages.{}.{}", stage, name)] = meaning_of(stage, name);
  return meaning;
}

OrderedJson input_json(RunRecord const& record) {
  OrderedJson input = {{"digest_xxh3_128", text_digest(record.input.source)}, {"overrides", record.input.overrides}};
  if (!record.digests.specimen.empty()) input["specimen_digest_xxh3_128"] = record.digests.specimen;
  if (!record.digests.grading.empty()) input["grading_digest_xxh3_128"] = record.digests.grading;
  if (!record.checkpoint_digest.empty()) input["checkpoint_digest_xxh3_128"] = record.checkpoint_digest;
  return input;
}

}  // namespace

std::string version_text(std::string const& version, std::string const& git_hash) {
  return fmt::format("{} ({})", version, git_hash);
}

std::string hash_text(std::uint64_t hash) { return fmt::format("0x{:016x}", hash); }

std::string compiler_name() {
#if defined(__clang__)
  return "clang " __VERSION__;
#elif defined(__GNUC__)
  return "gcc " __VERSION__;
#else
  return "unknown";
#endif
}

std::string kokkos_version() {
  return fmt::format("{}.{}.{}", KOKKOS_VERSION / 10000, KOKKOS_VERSION / 100 % 100, KOKKOS_VERSION % 100);
}

std::string backend_name() { return ExecutionSpace::name(); }

nlohmann::json scene_json(Scene const& scene) {
  Scene copy = scene;  // the schema reaches fields through a Scene&
  nlohmann::json json;
  for (Key const& key : schema())
    json[std::string(key.section())][std::string(key.leaf())] = std::visit(JsonValue{key, copy}, key.field);
  for (LoadingStage const& stage : scene.stages) json["stage"].push_back(stage_texts(stage));
  return json;
}

Scene scene_of(nlohmann::json const& json) {
  Scene scene;
  if (!json.is_object()) throw std::invalid_argument("its scene has no sections");
  for (Key const& key : schema()) {
    auto const section = json.find(std::string(key.section()));
    if (section == json.end()) continue;
    if (!section->is_object()) throw std::invalid_argument(fmt::format("{} is no section", key.section()));
    if (!section->contains(std::string(key.leaf()))) continue;
    std::visit(SetFromJson{key, scene, section->at(std::string(key.leaf()))}, key.field);
  }
  if (auto const stages = json.find("stage"); stages != json.end())
    for (auto const& stage : *stages)
      scene.stages.push_back(stage_of_texts(stage.get<std::vector<std::pair<std::string, std::string>>>()));
  return scene;
}

void write_run_record(std::filesystem::path const& path, RunRecord const& record) {
  Scene scene = record.input.scene;
  for (std::string* const file : {&scene.specimen.file, &scene.grading.file})
    if (!file->empty()) *file = std::filesystem::proximate(*file, path.parent_path()).string();
  OrderedJson json;
  json["format"] = "clathra run";
  json["program"] = program_json(record);
  json["input"] = input_json(record);
  json["seed"] = scene.run.seed;
  json["scene"] = scene_json(scene);
  json["stages"] = record.stages;
  json["loading"] = OrderedJson::array();
  for (StageEnding const& end : record.stage_ends) json["loading"].push_back({{"stage", end.stage}, {"ended_by", end.ended_by}});
  if (!record.layer_void_ratios.empty()) json["layer_void_ratios"] = record.layer_void_ratios;
  json["wall_seconds"] = record.wall_seconds;
  json["meaning"] = meaning_json(record);
  json["particle_steps"] = record.disc_steps;
  json["particle_steps_per_second"] = record.disc_steps_per_second;
  json["warnings"] = record.warnings;
  if (record.state_hash) json["state_hash"] = hash_text(*record.state_hash);
  if (!record.result_digests.empty()) json["result_digests_xxh3_128"] = record.result_digests;
  json["exit"] = {{"code", record.exit_code}, {"reason", record.exit_reason}};
  // Bytes of a file name that are no UTF-8 are replaced instead of making the record impossible.
  replace_text_file(path, json.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n");
}

}  // namespace clathra
