#pragma once
/// Values of options that are more than CLI11 checks.
#include <stdexcept>

#include "io/errors/problems.hpp"

namespace clathra {

/// What `read` makes of the value of an option. @throws SceneProblems (usage), named after the option, where `read` throws
/// std::invalid_argument
template <class Read>
auto option_value(char const* option, Read&& read) {
  try {
    return read();
  } catch (std::invalid_argument const& problem) {
    throw SceneProblems({{option, 0, 0, problem.what()}});
  }
}

}  // namespace clathra
