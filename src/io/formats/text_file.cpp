#include "io/formats/text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "io/errors/problems.hpp"

namespace clathra {
namespace {

std::string reason(char const* what) { return fmt::format("{}: {}", what, std::generic_category().message(errno)); }

/// @param known  what the user knows the file as
int create(std::filesystem::path const& path, std::filesystem::path const& known) {
  ::unlink(path.c_str());
  int const descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) throw FileProblem(ExitCode::cannot_create, known, reason("cannot be created"));
  return descriptor;
}

/// A short write is followed by one for the rest: only then does the system say why.
void write_all(int descriptor, std::string_view text, std::filesystem::path const& path) {
  while (!text.empty()) {
    ssize_t const written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw FileProblem(ExitCode::io_error, path, reason("cannot be written"));
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

/// A file that is open for reading until the end of the scope.
struct OpenFile {
  /// Does not wait for a writer of a named pipe.
  explicit OpenFile(std::filesystem::path const& path) : descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  OpenFile(OpenFile const&) = delete;
  OpenFile& operator=(OpenFile const&) = delete;
  ~OpenFile() {
    if (descriptor >= 0) ::close(descriptor);
  }
  int descriptor;
};

/// Whether what is open is a pipe. @throws FileProblem where it is neither that nor a file
bool is_pipe(int descriptor, std::filesystem::path const& path) {
  struct stat kind {};
  if (::fstat(descriptor, &kind) != 0) throw FileProblem(ExitCode::io_error, path, reason("cannot be read"));
  if (S_ISDIR(kind.st_mode)) throw FileProblem(ExitCode::file_missing, path, "is a folder, not a file");
  if (!S_ISREG(kind.st_mode) && !S_ISFIFO(kind.st_mode))
    throw FileProblem(ExitCode::file_missing, path, "is a device, not a file");
  return S_ISFIFO(kind.st_mode);
}

/// Waits until a pipe has something to read or has ended. @throws FileProblem file_missing when it gave nothing for that long
void wait_for_text(int descriptor, std::filesystem::path const& path, std::chrono::milliseconds patience) {
  pollfd pipe{descriptor, POLLIN, 0};
  int ready = 0;
  while ((ready = ::poll(&pipe, 1, static_cast<int>(patience.count()))) < 0 && errno == EINTR) {
  }
  if (ready == 0)
    throw FileProblem(ExitCode::file_missing, path,
                      fmt::format("is a pipe that gave nothing for {:g} s", static_cast<double>(patience.count()) / 1000));
}

}  // namespace

std::string read_text_file(std::filesystem::path const& path, std::size_t limit, std::chrono::milliseconds patience) {
  OpenFile const file(path);
  if (file.descriptor < 0) throw FileProblem(ExitCode::file_missing, path, reason("cannot be opened"));
  bool const pipe = is_pipe(file.descriptor, path);
  std::string text;
  char buffer[65536];
  while (text.size() < limit) {
    if (pipe) wait_for_text(file.descriptor, path, patience);
    ssize_t const count = ::read(file.descriptor, buffer, std::min(sizeof buffer, limit - text.size()));
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count < 0) throw FileProblem(ExitCode::io_error, path, reason("cannot be read"));
    if (count == 0) break;
    text.append(buffer, static_cast<std::size_t>(count));
  }
  return text;
}

void require_no_file(std::filesystem::path const& path, std::string_view instead) {
  std::error_code ignored;
  if (std::filesystem::exists(std::filesystem::symlink_status(path, ignored)))
    throw FileProblem(ExitCode::cannot_create, path, fmt::format("exists already and is left as it is; {}", instead));
}

void require_own_file(std::filesystem::path const& path, std::string_view mark, std::string_view instead) {
  std::error_code ignored;
  if (!std::filesystem::exists(std::filesystem::symlink_status(path, ignored))) return;
  constexpr std::size_t beginning = 4096;
  std::string head(beginning, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head.find(mark) == std::string::npos) require_no_file(path, instead);
}

void give_name(std::filesystem::path const& temporary, std::filesystem::path const& path, Existing existing) {
  constexpr char another_name[] = "choose another name";
  if (existing == Existing::kept) {
    if (::link(temporary.c_str(), path.c_str()) == 0) {
      ::unlink(temporary.c_str());
      return;
    }
    require_no_file(path, another_name);  // a file system without hard links goes on to the rename
  }
  if (::rename(temporary.c_str(), path.c_str()) != 0) throw FileProblem(ExitCode::io_error, path, reason("cannot be written"));
}

void replace_text_file(std::filesystem::path const& path, std::string_view text, Existing existing) {
  std::filesystem::path const temporary = path.string() + fmt::format(".tmp-{}", ::getpid());
  int descriptor = create(temporary, path);
  try {
    write_all(descriptor, text, path);
    if (::fsync(descriptor) != 0) throw FileProblem(ExitCode::io_error, path, reason("cannot be written"));
    if (::close(std::exchange(descriptor, -1)) != 0) throw FileProblem(ExitCode::io_error, path, reason("cannot be written"));
    give_name(temporary, path, existing);
  } catch (...) {
    if (descriptor >= 0) ::close(descriptor);
    ::unlink(temporary.c_str());
    throw;
  }
}

void require_creatable(std::filesystem::path const& path) {
  std::error_code error;
  if (!path.has_filename() || std::filesystem::is_directory(path, error))
    throw FileProblem(ExitCode::cannot_create, path, "is a folder; name a file");
  std::filesystem::path const temporary = path.string() + fmt::format(".tmp-{}", ::getpid());
  ::unlink(temporary.c_str());
  int const descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) throw FileProblem(ExitCode::cannot_create, path, reason("cannot be created"));
  ::close(descriptor);
  ::unlink(temporary.c_str());
}

RowFile::RowFile(std::filesystem::path path) : path_(std::move(path)), descriptor_(create(path_, path_)) {}

RowFile::RowFile(std::filesystem::path path, std::uintmax_t bytes) : path_(std::move(path)), bytes_(bytes) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor_ < 0) throw FileProblem(ExitCode::file_missing, path_, reason("cannot be opened"));
  off_t const end = ::lseek(descriptor_, 0, SEEK_END);
  if (end < static_cast<off_t>(bytes))
    throw FileProblem(ExitCode::bad_input, path_, fmt::format("has {} bytes, the checkpoint knows of {}", end, bytes));
  if (::ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0 || ::lseek(descriptor_, 0, SEEK_END) < 0)
    throw FileProblem(ExitCode::io_error, path_, reason("cannot be cut"));
  add_first_bytes(path_, bytes, digest_);
}

RowFile::~RowFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void RowFile::write(std::string_view rows) {
  write_all(descriptor_, rows, path_);
  bytes_ += rows.size();
  digest_.add(rows);
}

RowsWritten RowFile::flushed() const {
  if (::fsync(descriptor_) != 0) throw FileProblem(ExitCode::io_error, path_, reason("cannot be written"));
  return {bytes_, digest_.text()};
}

void flush_folder(std::filesystem::path const& folder) {
  int const descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  bool const flushed = descriptor >= 0 && ::fsync(descriptor) == 0;
  if (descriptor >= 0) ::close(descriptor);
  if (!flushed) throw FileProblem(ExitCode::io_error, folder, reason("cannot be flushed"));
}

void RowFile::close() {
  if (descriptor_ >= 0) (void)flushed();
  int const descriptor = descriptor_;
  descriptor_ = -1;
  if (descriptor >= 0 && ::close(descriptor) != 0) throw FileProblem(ExitCode::io_error, path_, reason("cannot be written"));
}

}  // namespace clathra
