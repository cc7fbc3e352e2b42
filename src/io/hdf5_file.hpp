#pragma once
/// HDF5 with every call checked: a failure becomes a FileProblem with the file's path and HDF5's own reason.
#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/problems.hpp"

namespace clathra {

/// An open HDF5 file. Groups are made as paths are written ("particles/radius").
class Hdf5File {
 public:
  static Hdf5File create(std::filesystem::path const& path);  ///< @throws FileProblem cannot_create
  static Hdf5File open(std::filesystem::path const& path);    ///< to read; @throws FileProblem file_missing or bad_input
  Hdf5File(Hdf5File&& other) noexcept;
  ~Hdf5File();

  /// A column, in chunks of 65,536 rows, shuffled, compressed (gzip 1) and with a checksum (fletcher32).
  /// @param unit  goes into the attribute `unit` of the column
  void write(std::string const& name, std::vector<double> const& values, std::string const& unit);
  void write(std::string const& name, std::vector<std::int32_t> const& values, std::string const& unit);
  void write_text(std::string const& name, std::string const& text);
  void set_attribute(std::string const& name, double value, std::string const& unit);
  void set_attribute(std::string const& name, std::int64_t value);
  void set_attribute(std::string const& name, std::string const& text);

  /// Reads a column that must have `size` rows; `any_size` takes it as it is, up to a limit.
  static constexpr std::size_t any_size = static_cast<std::size_t>(-1);
  std::vector<double> read_doubles(std::string const& name, std::size_t size) const;
  std::vector<std::int32_t> read_integers(std::string const& name, std::size_t size) const;
  std::string read_text(std::string const& name) const;
  double double_attribute(std::string const& name) const;
  std::int64_t integer_attribute(std::string const& name) const;
  std::string text_attribute(std::string const& name) const;

  /// Flushes to the disk and closes. @throws FileProblem io_error
  void close();

  /// Ends with a FileProblem that says what failed and why (the innermost entry of HDF5's error stack, or errno).
  [[noreturn]] void fail(ExitCode code, std::string const& what) const;

 private:
  Hdf5File(std::filesystem::path path, hid_t file, bool writing) : path_(std::move(path)), file_(file), writing_(writing) {}
  void make_group(std::string const& name);
  void write_column(std::string const& name, void const* values, std::size_t size, hid_t type, std::string const& unit);
  template <class T>
  std::vector<T> read_column(std::string const& name, std::size_t size, hid_t type) const;

  std::filesystem::path path_;
  hid_t file_;
  bool writing_;
};

}  // namespace clathra
