#pragma once
/// A paper as a study: which tests, at which size.
#include <filesystem>

#include "io/results/paper.hpp"
#include "io/scene/study_file.hpp"

namespace clathra {

struct ReproductionSize {
  PaperSize tests;
  std::uint64_t first_seed = 1;
};

/// The tests of a paper, each with its seeds from the first one on. Writes what they share to `scene`. @param folder  of the
/// results  @throws FileProblem where it cannot be written
Study reproduction_study(Paper const& paper, ReproductionSize const& size, std::filesystem::path const& folder,
                         std::filesystem::path const& scene);

}  // namespace clathra
