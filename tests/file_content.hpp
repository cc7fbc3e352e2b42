#pragma once
/// Files of a test, to the byte.
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace clathra {

inline std::string content(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

inline void put(std::filesystem::path const& path, std::string const& text) { std::ofstream(path, std::ios::binary) << text; }

}  // namespace clathra
