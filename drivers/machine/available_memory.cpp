#include "machine/available_memory.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>

namespace clathra {
namespace {

namespace fs = std::filesystem;

/// The number in a file; nothing where there is none ("max").
std::optional<double> number_in(fs::path const& file) {
  double value = 0;
  std::ifstream in(file);
  return in >> value ? std::optional(value) : std::nullopt;
}

/// The number behind a name in a file of lines "name number".
std::optional<double> number_in(fs::path const& file, std::string const& wanted) {
  std::ifstream in(file);
  std::string name, rest;
  for (double value = 0; in >> name >> value; std::getline(in, rest))
    if (name == wanted) return value;
  return {};
}

/// What is left of the limit of one group.
double left_in(fs::path const& group, char const* limit_name, char const* used_name, char const* files_name) {
  std::optional<double> const limit = number_in(group / limit_name), used = number_in(group / used_name);
  if (!limit || !used) return std::numeric_limits<double>::infinity();
  return *limit - std::max(0.0, *used - number_in(group / "memory.stat", files_name).value_or(0));
}

/// The least that is left in a group and those above it.
double left_above(fs::path const& mounted, std::string path, bool unified) {
  double least = std::numeric_limits<double>::infinity();
  while (true) {
    fs::path const group = mounted / fs::path(path).relative_path();
    least = std::min(least, unified ? left_in(group, "memory.max", "memory.current", "inactive_file")
                                    : left_in(group, "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"));
    if (path.empty() || path == "/") return least;
    path = fs::path(path).parent_path().string();
  }
}

/// By /proc/self/cgroup: "0::/a/b" of version 2, "5:memory:/a/b" of version 1. A container may see its own group as the root.
double left_in_groups(fs::path const& root) {
  double least = std::numeric_limits<double>::infinity();
  std::ifstream file(root / "proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    std::size_t const first = line.find(':'), second = line.find(':', first + 1);
    if (first == line.npos || second == line.npos) continue;
    std::string const controllers = line.substr(first, second - first), path = line.substr(second + 1);
    if (controllers == ":") least = std::min(least, left_above(root / "sys/fs/cgroup", path, true));
    if (controllers == ":memory" || controllers.find(",memory") != controllers.npos || controllers.find(":memory,") == 0)
      least = std::min(least, left_above(root / "sys/fs/cgroup/memory", path, false));
  }
  return least;
}

}  // namespace

double available_memory(fs::path const& root) {
  // The kernel's own estimate, else the pages that nobody uses.
  std::optional<double> const kilobytes = number_in(root / "proc/meminfo", "MemAvailable:");
  double const of_machine = kilobytes
                                ? *kilobytes * 1024
                                : static_cast<double>(::sysconf(_SC_AVPHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGESIZE));
  return std::max(0.0, std::min(of_machine, left_in_groups(root)));
}

}  // namespace clathra
