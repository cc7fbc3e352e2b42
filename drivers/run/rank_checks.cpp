#include "run/rank_checks.hpp"

#include <fmt/format.h>

#include "clathra_version.hpp"
#include "domain/scene/stage.hpp"
#include "io/errors/failure.hpp"
#include "io/errors/rank_errors.hpp"
#include "io/formats/digest.hpp"
#include "io/results/run_record.hpp"

namespace clathra {
namespace {

constexpr std::int64_t fewest_discs = 50;  // a rank; below, its ghosts outnumber them

void require_same(Ranks const& ranks, std::string const& own, std::string const& what) {
  bool const other = ranks.from_root(own) != own;
  std::int64_t const others = ranks.sum(std::int64_t{other});
  if (others > 0)
    throw Refused(
        fmt::format("{} of the {} ranks have another {} than rank 0 ({})", others, ranks.count(), what, ranks.from_root(own)));
}

}  // namespace

void share_refusals(Ranks const& ranks, std::vector<std::string>& refusals) {
  if (ranks.any(!refusals.empty()) && refusals.empty()) refusals.push_back("another rank cannot take its part");
}

ExitCode guarded_on_all_ranks(Ranks const& ranks, std::function<ExitCode()> const& work) {
  if (ranks.alone()) return work();
  try {
    return work();
  } catch (...) {
    Failure const failure = failure_in_flight();
    if (failure.everywhere) throw;
    end_all_ranks(ranks, FileProblem(failure.code, failure.text));
  }
}

void require_same_everywhere(Ranks const& ranks, LoadedScene const& input) {
  require_same(ranks, fmt::format("clathra {} {}, {}", CLATHRA_VERSION, CLATHRA_GIT_HASH, compiler_name()), "program");
  require_same(ranks, "digest " + text_digest(resolved_scene(input.scene, ".")), "scene");
}

void require_enough_discs(int ranks, std::int64_t discs) {
  if (ranks == 1 || discs >= fewest_discs * ranks) return;
  throw Refused(fmt::format("{} particles cannot be cut among {} ranks: each needs {}, so at most {} can share them", discs,
                            ranks, fewest_discs, std::max<std::int64_t>(1, discs / fewest_discs)));
}

}  // namespace clathra
