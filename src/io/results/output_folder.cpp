#include "io/results/output_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "io/errors/problems.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/checkpoint.hpp"

namespace clathra {
namespace {

constexpr char lock_name[] = ".lock", next_lock[] = ".lock.tmp-";
constexpr std::size_t records = 3;  // come first: they say what is run and are no results of it
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

bool has_snapshots(std::filesystem::path const& folder) {
  std::error_code error;
  auto const entries = std::filesystem::directory_iterator(folder, error);
  return std::any_of(begin(entries), end(entries), [](auto const& entry) { return entry.path().extension() == ".h5"; });
}

/// What the marker of a folder says.
std::string marker_text(std::string_view verb) {
  return fmt::format("clathra {}\nThis folder holds results of `clathra {}`, which knows it by this file and locks it.\n", verb,
                     verb);
}

/// The first line of the marker of a folder, nothing where there is none or it is of somebody else.
std::string marked_as(std::filesystem::path const& folder) {
  std::error_code error;
  std::filesystem::path const marker = folder / lock_name;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(marker, error))) return {};
  std::string const text = read_text_file(marker, 1000);
  return text.starts_with("clathra ") ? text.substr(0, text.find('\n')) : "";
}

/// @throws FileProblem where a folder that is there is no folder of this verb's results
void require_own(std::filesystem::path const& folder, std::string_view verb) {
  std::string const marked = marked_as(folder);
  if (marked == fmt::format("clathra {}", verb)) return;
  if (!marked.empty())
    throw FileProblem(ExitCode::cannot_create, folder,
                      fmt::format("holds results of `{}`, not of `clathra {}`; choose another folder", marked, verb));
  std::error_code error;
  auto const entries = std::filesystem::directory_iterator(folder, error);
  if (error) throw FileProblem(ExitCode::cannot_create, folder, "cannot be read: " + error.message());
  // An empty marker alone, or one that is not in place yet, was left by a program that was killed at once.
  auto const is_other = [&](std::filesystem::directory_entry const& entry) {
    std::string const name = entry.path().filename().string();
    bool const ours = name == lock_name || name.starts_with(next_lock);
    return !ours || std::filesystem::is_symlink(entry.path()) || !entry.is_regular_file() ||
           (name == lock_name && entry.file_size() > 0);
  };
  if (std::any_of(begin(entries), end(entries), is_other))
    throw FileProblem(ExitCode::cannot_create, folder,
                      fmt::format("is not empty and not of an earlier `clathra {}`; choose another folder", verb));
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

void claim_folder(std::filesystem::path const& folder, std::string_view verb) {
  std::error_code error;
  if (std::filesystem::is_symlink(folder, error))
    throw FileProblem(ExitCode::cannot_create, folder, "is a link; name the folder itself");
  bool const exists = std::filesystem::exists(folder, error);
  if (exists && !std::filesystem::is_directory(folder, error))
    throw FileProblem(ExitCode::cannot_create, folder, "is not a folder");
  if (!exists && !std::filesystem::create_directories(folder, error))
    throw FileProblem(ExitCode::cannot_create, folder, "cannot be created: " + error.message());
  if (exists) require_own(folder, verb);
  if (!marked_as(folder).empty()) return;
  // Others may be at it: whole, and never in the place of another's.
  if (std::filesystem::is_regular_file(std::filesystem::symlink_status(folder / lock_name, error)) &&
      std::filesystem::file_size(folder / lock_name, error) == 0)
    std::filesystem::remove(folder / lock_name, error);
  try {
    replace_text_file(folder / lock_name, marker_text(verb), Existing::kept);
  } catch (FileProblem const&) {
    if (marked_as(folder).empty()) throw;
  }
  require_own(folder, verb);
}

OutputFolder::OutputFolder(std::filesystem::path folder, std::string_view verb) : folder_(std::move(folder)) {
  folder_ = folder_.lexically_normal();
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // "out/", "out/.": a link would not be seen behind the slash
  claim_folder(folder_, verb);
  lock_ = ::open((folder_ / lock_name).c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
  if (lock_ < 0)
    throw FileProblem(ExitCode::cannot_create, folder_, "cannot be written: " + std::generic_category().message(errno));
  int const error = hold(lock_);
  if (error == EWOULDBLOCK) {
    ::close(lock_);
    throw FileProblem(ExitCode::cannot_create, folder_, "another run is writing into this folder; choose another folder");
  }
  held_ = error == 0;
}

std::string OutputFolder::lock_warning() const {
  if (held_) return {};
  return fmt::format("{}: its file system knows no locks, nothing keeps a second program from writing into it", folder_.string());
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

bool holds_results(std::filesystem::path const& run_folder) {
  std::error_code error;
  for (std::string_view const name : result_files().subspan(records))
    if (std::filesystem::exists(std::filesystem::symlink_status(run_folder / name, error))) return true;
  return has_snapshots(run_folder / "snap") || has_snapshots(run_folder / "diverged" / "snap") || has_checkpoints(run_folder);
}

OutputFolder::~OutputFolder() { ::close(lock_); }

}  // namespace clathra
