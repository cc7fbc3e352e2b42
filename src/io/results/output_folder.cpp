#include "io/results/output_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "io/errors/problems.hpp"
#include "io/results/checkpoint.hpp"

namespace clathra {
namespace {

constexpr char lock_name[] = ".lock";
constexpr std::string_view results[] = {"run.json",    "input.toml",     "resolved.toml", "history.csv", "events.csv",
                                        "specimen.h5", "particles.xdmf", "contacts.xdmf", "report.html", "final.h5"};

/// Removes the snapshots of an earlier run, and only these.
void clear_snapshots(std::filesystem::path const& folder) {
  std::error_code error;
  if (std::filesystem::is_symlink(folder, error)) return;
  for (auto const& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".h5") std::filesystem::remove(entry.path(), error);
  std::filesystem::remove(folder, error);  // only if it is empty now
}

void make_folder(std::filesystem::path const& folder) {
  std::error_code error;
  if (std::filesystem::is_symlink(folder, error))
    throw FileProblem(ExitCode::refused, folder, "is a link; name the folder itself");
  bool const exists = std::filesystem::exists(folder, error);
  if (exists && !std::filesystem::is_directory(folder, error))
    throw FileProblem(ExitCode::cannot_create, folder, "is not a folder");
  if (!exists && !std::filesystem::create_directories(folder, error))
    throw FileProblem(ExitCode::cannot_create, folder, "cannot be created: " + error.message());
  if (!exists || std::filesystem::exists(folder / lock_name, error)) return;
  auto const first = std::filesystem::directory_iterator(folder, error);
  if (error) throw FileProblem(ExitCode::cannot_create, folder, "cannot be read: " + error.message());
  if (first != std::filesystem::directory_iterator())
    throw FileProblem(ExitCode::refused, folder, "is not empty and not of an earlier run; choose another (--output)");
}

/// Tries to hold a file. @return 0, or the error: EWOULDBLOCK where another process holds it
int hold(int descriptor) {
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return 0;
  if (errno == EWOULDBLOCK) return errno;
#ifdef F_OFD_SETLK
  struct flock whole = {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (::fcntl(descriptor, F_OFD_SETLK, &whole) == 0) return 0;
  if (errno == EAGAIN || errno == EACCES) return EWOULDBLOCK;
#endif
  return errno;
}

}  // namespace

std::span<std::string_view const> result_files() { return results; }

OutputFolder::OutputFolder(std::filesystem::path folder) : folder_(std::move(folder)) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // "out/": a link would not be seen behind the slash
  make_folder(folder_);
  lock_ = ::open((folder_ / lock_name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (lock_ < 0)
    throw FileProblem(ExitCode::cannot_create, folder_, "cannot be written: " + std::generic_category().message(errno));
  int const error = hold(lock_);
  if (error == EWOULDBLOCK) {
    ::close(lock_);
    throw FileProblem(ExitCode::cannot_create, folder_, "another run is writing into this folder; choose another (--output)");
  }
  held_ = error == 0;
}

bool folder_in_use(std::filesystem::path const& folder) {
  int const descriptor = ::open((folder / lock_name).c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return false;
  bool const in_use = hold(descriptor) == EWOULDBLOCK;
  ::close(descriptor);
  return in_use;
}

void OutputFolder::clear(std::filesystem::path const& keep) const {
  std::error_code error;
  for (std::string_view const name : results)
    if (keep.empty() || !std::filesystem::equivalent(folder_ / name, keep, error)) std::filesystem::remove(folder_ / name, error);
  clear_snapshots(folder_ / "snap");
  clear_snapshots(folder_ / "diverged" / "snap");
  for (char const* const index : {"particles.xdmf", "contacts.xdmf", ""})
    std::filesystem::remove(folder_ / "diverged" / index, error);
  remove_checkpoints(folder_);
}

OutputFolder::~OutputFolder() { ::close(lock_); }

}  // namespace clathra
