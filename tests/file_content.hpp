#pragma once
/// What files of a test hold, and which there are.
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace clathra {

inline std::string content(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline void put(std::filesystem::path const& path, std::string const& text) { std::ofstream(path, std::ios::binary) << text; }

/// The scenes of examples/, which has studies and papers, too.
inline std::set<std::filesystem::path> example_scenes() {
  std::set<std::filesystem::path> scenes;
  for (auto const& entry : std::filesystem::recursive_directory_iterator(CLATHRA_EXAMPLES)) {
    std::string const folder = entry.path().parent_path().filename();
    if (entry.path().extension() == ".toml" && folder != "studies" && folder != "papers") scenes.insert(entry.path());
  }
  return scenes;
}

/// Rows of a CSV file without quotes, the header among them.
inline std::vector<std::vector<std::string>> csv_rows(std::string const& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells(1);
    for (char const c : line)
      if (c == ',')
        cells.emplace_back();
      else
        cells.back() += c;
    rows.push_back(cells);
  }
  return rows;
}

}  // namespace clathra
