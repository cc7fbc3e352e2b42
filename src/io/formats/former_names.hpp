#pragma once
/// Columns, datasets and numbers that had another name once. Files keep theirs; readers take both.
#include <string>
#include <string_view>

namespace clathra {

struct FormerName {
  std::string_view now, before;
};
inline constexpr FormerName former_names[] = {{"formation_overlap", "equilibrium"},
                                              {"verlet_skin", "leeway"},
                                              {"intact_interacting_pct", "intact_mechanical_pct"},
                                              {"checks", "looks"},
                                              {"checks_unbalanced", "looks_unbalanced"}};

/// The name that a column has today.
inline std::string present_name(std::string_view name) {
  for (FormerName const& former : former_names)
    if (name == former.before) return std::string(former.now);
  return std::string(name);
}

/// The name that a column had before; its own where it had no other.
inline std::string former_name(std::string_view name) {
  for (FormerName const& former : former_names)
    if (name == former.now) return std::string(former.before);
  return std::string(name);
}

}  // namespace clathra
