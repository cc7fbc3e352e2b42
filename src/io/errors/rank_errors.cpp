#include "io/errors/rank_errors.hpp"

#include <cstdio>
#include <optional>

#include "io/errors/failure.hpp"
#include "io/errors/printable.hpp"

namespace clathra {

void on_root(Ranks const& ranks, std::function<void()> const& action) {
  on_each(ranks, [&] {
    if (ranks.root()) action();
  });
}

void on_each(Ranks const& ranks, std::function<void()> const& action) {
  if (ranks.alone()) return action();
  std::optional<FileProblem> problem;
  try {
    action();
  } catch (...) {
    Failure const failure = failure_in_flight();
    problem.emplace(failure.code, failure.text);
  }
  // The problem of the first rank that has one.
  int const teller = static_cast<int>(ranks.min(problem ? ranks.rank() : ranks.count()));
  if (teller == ranks.count()) return;
  int code = problem ? static_cast<int>(problem->code) : 0;
  std::string text = problem ? problem->what() : "";
  std::size_t size = text.size();
  ranks.broadcast(&code, sizeof code, teller);
  ranks.broadcast(&size, sizeof size, teller);
  text.resize(size);
  ranks.broadcast(text.data(), size, teller);
  throw FileProblem(static_cast<ExitCode>(code), text);
}

void end_all_ranks(Ranks const& ranks, FileProblem const& problem) {
  std::fprintf(stderr, "clathra: rank %d: %s\n", ranks.rank(), printable(problem.what()).c_str());
  ranks.abort(static_cast<int>(problem.code));
}

}  // namespace clathra
