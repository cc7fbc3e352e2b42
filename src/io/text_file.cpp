#include "io/text_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "io/problems.hpp"

namespace clathra {
namespace {

std::string reason(char const* what) { return fmt::format("{}: {}", what, std::generic_category().message(errno)); }

int create(std::filesystem::path const& path) {
  ::unlink(path.c_str());
  int const descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (descriptor < 0) throw FileProblem(ExitCode::cannot_create, path, reason("cannot be created"));
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

}  // namespace

std::string read_text_file(std::filesystem::path const& path, std::size_t limit) {
  int const descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw FileProblem(ExitCode::file_missing, path, reason("cannot be opened"));
  std::string text;
  char buffer[65536];
  while (text.size() < limit) {
    ssize_t const count = ::read(descriptor, buffer, std::min(sizeof buffer, limit - text.size()));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      FileProblem const problem(errno == EISDIR ? ExitCode::file_missing : ExitCode::io_error, path, reason("cannot be read"));
      ::close(descriptor);
      throw problem;
    }
    if (count == 0) break;
    text.append(buffer, static_cast<std::size_t>(count));
  }
  ::close(descriptor);
  return text;
}

void replace_text_file(std::filesystem::path const& path, std::string_view text) {
  std::filesystem::path const temporary = path.string() + fmt::format(".tmp-{}", ::getpid());
  int const descriptor = create(temporary);
  try {
    write_all(descriptor, text, path);
    if (::fsync(descriptor) != 0) throw FileProblem(ExitCode::io_error, path, reason("cannot be written"));
  } catch (...) {
    ::close(descriptor);
    ::unlink(temporary.c_str());
    throw;
  }
  if (::close(descriptor) != 0 || ::rename(temporary.c_str(), path.c_str()) != 0) {
    FileProblem const problem(ExitCode::io_error, path, reason("cannot be written"));
    ::unlink(temporary.c_str());
    throw problem;
  }
}

RowFile::RowFile(std::filesystem::path path) : path_(std::move(path)), descriptor_(create(path_)) {}

RowFile::RowFile(std::filesystem::path path, std::uintmax_t bytes) : path_(std::move(path)), bytes_(bytes) {
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor_ < 0) throw FileProblem(ExitCode::file_missing, path_, reason("cannot be opened"));
  off_t const end = ::lseek(descriptor_, 0, SEEK_END);
  if (end < static_cast<off_t>(bytes))
    throw FileProblem(ExitCode::bad_input, path_, fmt::format("has {} bytes, the checkpoint knows of {}", end, bytes));
  if (::ftruncate(descriptor_, static_cast<off_t>(bytes)) != 0 || ::lseek(descriptor_, 0, SEEK_END) < 0)
    throw FileProblem(ExitCode::io_error, path_, reason("cannot be cut"));
}

RowFile::~RowFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void RowFile::write(std::string_view rows) {
  write_all(descriptor_, rows, path_);
  bytes_ += rows.size();
}

std::uintmax_t RowFile::flushed_bytes() const {
  if (::fsync(descriptor_) != 0) throw FileProblem(ExitCode::io_error, path_, reason("cannot be written"));
  return bytes_;
}

void flush_folder(std::filesystem::path const& folder) {
  int const descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  bool const flushed = descriptor >= 0 && ::fsync(descriptor) == 0;
  if (descriptor >= 0) ::close(descriptor);
  if (!flushed) throw FileProblem(ExitCode::io_error, folder, reason("cannot be flushed"));
}

void RowFile::close() {
  int const descriptor = descriptor_;
  descriptor_ = -1;
  if (descriptor >= 0 && ::close(descriptor) != 0) throw FileProblem(ExitCode::io_error, path_, reason("cannot be written"));
}

}  // namespace clathra
