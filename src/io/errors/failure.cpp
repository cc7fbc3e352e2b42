#include "io/errors/failure.hpp"

#include <new>

#include "domain/scene/stage.hpp"
#include "kernels/countable.hpp"

namespace clathra {

namespace {

Severity severity_of(ExitCode code) {
  return code == ExitCode::file_missing ? Severity::missing_file
         : code == ExitCode::refused    ? Severity::refusal
                                        : Severity::error;
}

Failure failure_of(ExitCode code, std::string const& text, bool everywhere) {
  return {code, text, everywhere, {{"", 0, 0, text, severity_of(code)}}};
}

}  // namespace

Failure failure_in_flight() {
  try {
    throw;
  } catch (SceneProblems const& problems) {
    return {problems.code(), problems.what(), true, problems.problems};
  } catch (FileProblem const& problem) {
    return {problem.code, problem.what(), true, {{problem.file, 0, 0, problem.reason, severity_of(problem.code)}}};
  } catch (Diverged const& problem) {
    return failure_of(ExitCode::diverged, std::string("diverged: ") + problem.what(), true);
  } catch (Refused const& problem) {
    return failure_of(ExitCode::refused, std::string("refused: ") + problem.what(), true);
  } catch (Stopped const& problem) {
    return failure_of(ExitCode::interrupted, problem.what(), true);
  } catch (OutOfMemory const& problem) {
    return failure_of(ExitCode::out_of_memory, std::string("not enough memory: ") + problem.what(), true);
  } catch (TooManyToNumber const& problem) {
    return failure_of(ExitCode::out_of_memory, std::string("too large: ") + problem.what(), false);
  } catch (std::bad_alloc const&) {
    return failure_of(ExitCode::out_of_memory, "not enough memory", false);
  } catch (std::exception const& problem) {
    return failure_of(ExitCode::internal, std::string("internal fault, please report it: ") + problem.what(), false);
  }
}

}  // namespace clathra
