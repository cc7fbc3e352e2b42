#pragma once
/// What an exception means to whoever called the program: the one place that says so.
#include <string>

#include "io/errors/problems.hpp"

namespace clathra {

struct Failure {
  ExitCode code;
  std::string text;               ///< for the user
  bool everywhere;                ///< thrown on all ranks alike; the others know nothing of what is not
  std::vector<Problem> problems;  ///< the same, one by one, for scripts
};

/// Of the exception that is being handled. To be called in a catch block.
Failure failure_in_flight();

}  // namespace clathra
