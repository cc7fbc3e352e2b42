#pragma once
/// Plain files with every call checked: read at once, written row by row, or replaced as a whole.
#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/formats/digest.hpp"

namespace clathra {

/// Reads a whole file, or a pipe to its end (`<(command)`, /dev/stdin), at most `limit` bytes of it.
/// @param patience  how long a pipe may keep silent
/// @throws FileProblem file_missing if it cannot be opened, is no file, or a pipe without a word; io_error if it cannot be read
std::string read_text_file(std::filesystem::path const& path, std::size_t limit,
                           std::chrono::milliseconds patience = std::chrono::seconds(10));

/// What becomes of a file that has the name of one that is written.
enum class Existing { replaced, kept };

/// Gives a finished file its final name. @throws FileProblem io_error; cannot_create where there is a file of that name that is
/// to be kept: also one that was not there when the work began
void give_name(std::filesystem::path const& temporary, std::filesystem::path const& path, Existing existing);

/// Puts a file with this text in place of whatever has that name: written under a temporary name, flushed to the disk, renamed. A
/// reader sees the old file or the new one, never a part. @throws FileProblem cannot_create or io_error, as give_name()
void replace_text_file(std::filesystem::path const& path, std::string_view text, Existing existing = Existing::replaced);

/// @throws FileProblem cannot_create where there is something of that name. @param instead  what the user may do then
void require_no_file(std::filesystem::path const& path, std::string_view instead);
/// The same, but a file that begins with our mark, within 4 KiB, may be there: it is to be replaced.
void require_own_file(std::filesystem::path const& path, std::string_view mark, std::string_view instead);

/// Whether a file of this name could be put there, without doing it: for work that takes long before it writes.
/// @throws FileProblem cannot_create where the name is that of a folder, or nothing can be made beside it
void require_creatable(std::filesystem::path const& path);

/// Makes renamed files of a folder survive a power cut. @throws FileProblem io_error
void flush_folder(std::filesystem::path const& folder);

/// How far a file of rows had been written at some moment.
struct RowsWritten {
  std::uintmax_t bytes = 0;
  std::string digest;  ///< of these bytes; empty where there is no file
};

/// A new file that grows by whole rows. What has its name before is removed (a link is never followed).
class RowFile {
 public:
  explicit RowFile(std::filesystem::path path);  ///< @throws FileProblem cannot_create
  /// Goes on with a file behind its first `bytes`; what comes after them is cut off. @throws FileProblem
  RowFile(std::filesystem::path path, std::uintmax_t bytes);
  ~RowFile();
  RowFile(RowFile const&) = delete;
  RowFile& operator=(RowFile const&) = delete;

  /// One write. @throws FileProblem io_error
  void write(std::string_view rows);
  /// Everything has reached the disk then. @throws FileProblem io_error
  void close();
  /// What has reached the disk, which is all of it. @throws FileProblem io_error
  RowsWritten flushed() const;

 private:
  std::filesystem::path path_;
  std::uintmax_t bytes_ = 0;
  RunningDigest digest_;
  int descriptor_ = -1;
};

}  // namespace clathra
