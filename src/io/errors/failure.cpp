#include "io/errors/failure.hpp"

#include <new>

#include "domain/scene/stage.hpp"
#include "kernels/countable.hpp"

namespace clathra {

Failure failure_in_flight() {
  try {
    throw;
  } catch (SceneProblems const& problems) {
    return {problems.code(), problems.what(), true};
  } catch (FileProblem const& problem) {
    return {problem.code, problem.what(), true};
  } catch (Diverged const& problem) {
    return {ExitCode::diverged, std::string("diverged: ") + problem.what(), true};
  } catch (Refused const& problem) {
    return {ExitCode::refused, std::string("refused: ") + problem.what(), true};
  } catch (Stopped const& problem) {
    return {ExitCode::interrupted, problem.what(), true};
  } catch (OutOfMemory const& problem) {
    return {ExitCode::out_of_memory, std::string("not enough memory: ") + problem.what(), true};
  } catch (TooManyToNumber const& problem) {
    return {ExitCode::out_of_memory, std::string("too large: ") + problem.what(), false};
  } catch (std::bad_alloc const&) {
    return {ExitCode::out_of_memory, "not enough memory", false};
  } catch (std::exception const& problem) {
    return {ExitCode::internal, std::string("internal fault, please report it: ") + problem.what(), false};
  }
}

}  // namespace clathra
