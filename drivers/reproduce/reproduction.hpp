#pragma once
/// Jiang et al. (2017) as a study: which tests, at which size.
#include <filesystem>

#include "io/results/paper_claims.hpp"
#include "io/scene/study_file.hpp"

namespace clathra {

struct ReproductionSize {
  std::int64_t discs = 20000;
  int seeds = 5;
  std::uint64_t first_seed = 1;
};
inline constexpr ReproductionSize full_size{}, quick_size{2000, 2};

/// The tests of a design, each with `seeds` seeds from the first one on, as groups named by paper_cell(). Writes what they share
/// to `scene`. @param folder  of the results  @throws FileProblem where it cannot be written
Study reproduction_study(PaperDesign const& design, ReproductionSize const& size, std::filesystem::path const& folder,
                         std::filesystem::path const& scene);

}  // namespace clathra
