#include "run/resumption.hpp"

#include <fmt/format.h>

#include "io/errors/problems.hpp"
#include "io/errors/rank_errors.hpp"
#include "io/results/run_record.hpp"

namespace clathra {
namespace {

/// @throws FileProblem where this checkpoint does not serve
Resumption resume_from(FoundCheckpoint const& checkpoint, std::filesystem::path const& folder, Scene const& scene,
                       Ranks const& ranks) {
  Resumption resumed;
  resumed.checkpoint = checkpoint;
  on_root(ranks, [&] { require_rows(folder, checkpoint.progress); });
  on_each(ranks, [&] { resumed.history = read_history(folder / "history.csv", checkpoint.progress.history.bytes); });
  resumed.test = std::make_unique<BiaxialTest>(scene, read_checkpoint(checkpoint, scene, ranks), ranks);
  double const wanted = resumed.test->stage().until.axial_strain;
  if (double const strain = resumed.test->axial_strain();
      !resumed.test->consolidates() && is_given(wanted) && wanted > 0 && wanted < strain * (1 - 1e-3))
    throw FileProblem(ExitCode::cannot_create, folder,
                      fmt::format("the test is at an axial strain of {:.4g} % already, test.axial_strain is {:.4g} %",
                                  strain * 100, scene.test.axial_strain * 100));
  std::string const hash = hash_text(resumed.test->state_hash());
  on_each(ranks, [&] {
    if (hash != checkpoint_state_hash(checkpoint.file))
      throw FileProblem(ExitCode::bad_input, checkpoint.file, "does not give the state that it was written with");
  });
  return resumed;
}

}  // namespace

Resumption resume_run(FoundCheckpoints const& found, std::filesystem::path const& folder, Scene const& scene,
                      Ranks const& ranks) {
  std::vector<FileProblem> problems;  // the same on all ranks
  for (FoundCheckpoint const& checkpoint : found.usable) {
    try {
      Resumption resumed = resume_from(checkpoint, folder, scene, ranks);
      for (FileProblem const& problem : found.damaged) resumed.passed_over.emplace_back(problem.what());
      for (FileProblem const& problem : problems) resumed.passed_over.emplace_back(problem.what());
      return resumed;
    } catch (FileProblem const& problem) {
      if (problem.code == ExitCode::refused || problem.code == ExitCode::cannot_create) throw;  // so would the other generation
      problems.push_back(problem);
    }
  }
  ExitCode const code = problems.front().code;
  problems.insert(problems.end(), found.damaged.begin(), found.damaged.end());
  throw FileProblem(code, folder / "ckpt", no_checkpoint_text(problems));
}

}  // namespace clathra
