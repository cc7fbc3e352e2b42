#pragma once
/// HDF5 with every call checked: a failure becomes a FileProblem with the file's path and HDF5's own reason.
#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "domain/parallel/ranks.hpp"
#include "io/errors/problems.hpp"
#include "io/formats/text_file.hpp"

namespace clathra {

/// The rows [begin, end) of a table of `size` rows.
struct RowRange {
  std::size_t size, begin, end;
};
/// The part of this rank where all ranks share the rows of a table evenly, in their order.
RowRange rows_of_rank(std::int64_t size, Ranks const& ranks);

/// An open HDF5 file. Groups are made as paths are written ("particles/radius").
class Hdf5File {
 public:
  /// A file that all ranks write together: every call is then collective, columns are this rank's rows and follow one another in
  /// the order of the ranks, texts and attributes are the same on all. Where writing fails half way, several ranks end at once.
  static Hdf5File create(std::filesystem::path const& path, Ranks const& ranks = {});  ///< @throws FileProblem cannot_create
  static Hdf5File open(std::filesystem::path const& path);  ///< to read; @throws FileProblem file_missing or bad_input
  Hdf5File(Hdf5File&& other) noexcept;
  ~Hdf5File();

  /// A column of T = double, float, int32, uint32 or uint8, in chunks of 65,536 rows of one column (columns apart
  /// compress better), shuffled, compressed (gzip 4) and with a checksum (fletcher32). @param values  rows x width, row by row;
  /// @param unit  goes into the attribute `unit` of the column
  template <class T>
  void write(std::string const& name, std::vector<T> const& values, std::string const& unit, std::size_t width = 1);
  void write_text(std::string const& name, std::string const& text);
  void set_attribute(std::string const& name, double value, std::string const& unit);
  void set_attribute(std::string const& name, std::int64_t value);
  void set_attribute(std::string const& name, std::string const& text);
  void set_column_attribute(std::string const& column, std::string const& name, double value);

  /// Reads a column that must have `size` rows of `width` values; `any_size` takes it as it is, up to a limit.
  /// @throws FileProblem bad_input
  static constexpr std::size_t any_size = static_cast<std::size_t>(-1);
  template <class T>
  std::vector<T> read(std::string const& name, std::size_t size, std::size_t width = 1) const;
  bool has(std::string const& name) const;            ///< whether there is a column of this name, in a group that there is
  bool has_attribute(std::string const& name) const;  ///< of the file
  /// The unit that a column or a number of the file states, if it states one.
  std::optional<std::string> unit_of_column(std::string const& name) const;
  std::optional<std::string> unit_of_attribute(std::string const& name) const;
  std::size_t rows_of(std::string const& name) const;  ///< of a column; @throws FileProblem bad_input
  /// Some rows of a column.
  template <class T>
  std::vector<T> read(std::string const& name, RowRange const& rows) const;
  /// A text: one string, of fixed or variable length, or a column of characters, as write_text() makes it.
  std::string read_text(std::string const& name) const;
  double double_attribute(std::string const& name) const;
  std::int64_t integer_attribute(std::string const& name) const;
  std::string text_attribute(std::string const& name) const;

  /// Flushes to the disk and closes. @throws FileProblem io_error
  void close();

  /// Ends with a FileProblem that says what failed and why (the innermost entry of HDF5's error stack, or errno).
  [[noreturn]] void fail(ExitCode code, std::string const& what) const;

 private:
  void require_number(std::string const& attribute) const;
  Hdf5File(std::filesystem::path path, hid_t file, bool writing, Ranks ranks = {})
      : path_(std::move(path)), file_(file), writing_(writing), ranks_(std::move(ranks)) {}
  void make_group(std::string const& name);
  struct OpenColumn;
  OpenColumn open_column(std::string const& name, std::size_t size, std::size_t width) const;
  void write_column(std::string const& name, void const* values, std::size_t rows, std::size_t width, hid_t type,
                    std::string const& unit);

  std::filesystem::path path_;
  hid_t file_;
  bool writing_;
  Ranks ranks_;
};

/// Puts an HDF5 file in place of whatever has that name: written under a temporary name, flushed to the disk, renamed. A reader
/// sees the old file or the new one, never a part. @throws FileProblem cannot_create or io_error, as give_name()
void replace_hdf5_file(std::filesystem::path const& path, std::function<void(Hdf5File&)> const& write_content,
                       Ranks const& ranks = {}, Existing existing = Existing::replaced);

}  // namespace clathra
