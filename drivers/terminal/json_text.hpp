#pragma once
/// What `--json` prints: one object, indented by two.
#include <nlohmann/json.hpp>
#include <string>

namespace clathra {

/// Bytes that are no UTF-8, of a file's name, are replaced.
inline std::string json_text(nlohmann::ordered_json const& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace clathra
