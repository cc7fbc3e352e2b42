#pragma once
/// What files of a test hold.
#include <filesystem>
#include <fstream>
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
