#pragma once
/// What a run tells the study that started it, apart from what it prints: lines of JSON in a file, {"stage": "shear", "fraction":
/// 0.35} as it goes on and {"failed": "..."} at its end. The hidden option --status names the file; without it nothing is
/// written.
#include <filesystem>
#include <string>

namespace clathra {

/// From now on this process writes its status there; of several ranks the first one. A file that cannot be written is ignored.
void open_status(std::filesystem::path const& file);

/// @param fraction  of the stage, 0 to 1; written where it has grown by a hundredth
void say_status(std::string const& stage, double fraction);
void say_failure(std::string const& reason);

struct RunStatus {
  std::string stage;
  double fraction = 0;
  std::string failed;  ///< why, in words; empty where it did not say so
};

/// What was said last. Nothing where there is no file, or none that can be understood.
RunStatus read_status(std::filesystem::path const& file);

}  // namespace clathra
