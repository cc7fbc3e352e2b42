#include "terminal/status.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "domain/parallel/ranks.hpp"

namespace clathra {
namespace {

using Json = nlohmann::json;

std::filesystem::path own_file;  // empty: nobody listens
RunStatus said;

void append(Json const& line) {
  if (own_file.empty()) return;
  std::ofstream(own_file, std::ios::app) << line.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

void open_status(std::filesystem::path const& file) {
  if (launched_rank() != 0) return;
  own_file = file;
  std::ofstream(own_file, std::ios::trunc).flush();
}

void say_status(std::string const& stage, double fraction) {
  if (stage == said.stage && fraction < said.fraction + 0.01) return;
  said.stage = stage, said.fraction = fraction;
  append({{"stage", stage}, {"fraction", fraction}});
}

void say_failure(std::string const& reason) {
  if (!said.failed.empty()) return;  // the first failure counts
  said.failed = reason;
  append({{"failed", reason}});
}

RunStatus read_status(std::filesystem::path const& file) {
  RunStatus status;
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    Json const json = Json::parse(line, nullptr, false);
    if (!json.is_object()) continue;  // a line that is being written
    status.stage = json.value("stage", status.stage);
    status.fraction = json.value("fraction", status.fraction);
    status.failed = json.value("failed", status.failed);
  }
  return status;
}

}  // namespace clathra
