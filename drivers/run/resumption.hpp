#pragma once
/// Going on with a run from one of its checkpoints.
#include <memory>

#include "io/results/checkpoint.hpp"
#include "io/results/history.hpp"

namespace clathra {

struct Resumption {
  FoundCheckpoint checkpoint;  ///< the one that the run goes on from
  std::unique_ptr<BiaxialTest> test;
  std::vector<HistoryEntry> history;     ///< the rows before the checkpoint
  std::vector<std::string> passed_over;  ///< on rank 0: what is wrong with the others
};

/// Takes the newest checkpoint that serves: its files are whole, it gives the state that it was written with, and the rows that
/// were written before it stand in the folder as they were. Nothing is changed. Collective.
/// @throws FileProblem cannot_create where they are of another scene, bad_input or file_missing where none serves
Resumption resume_run(FoundCheckpoints const& found, std::filesystem::path const& folder, Scene const& scene, Ranks const& ranks);

}  // namespace clathra
