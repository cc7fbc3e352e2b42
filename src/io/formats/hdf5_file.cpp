#include "io/formats/hdf5_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <utility>

#include "io/errors/rank_errors.hpp"

namespace clathra {
/// An HDF5 identifier that is closed when it goes. Errors of closing a column show again when the file is flushed.
class Hdf5Id {
 public:
  Hdf5Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  Hdf5Id(Hdf5Id&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Id(Hdf5Id const&) = delete;
  Hdf5Id& operator=(Hdf5Id const&) = delete;
  ~Hdf5Id() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

namespace {

constexpr hsize_t chunk_rows = 65536;
constexpr unsigned compression = 4;  // of gzip; 1 gives 5 % more bytes in 3/4 of the time, 6 gives 1 % less in twice the time
constexpr hsize_t most_rows = 1'000'000'000;  // a column that claims more is taken for damage
constexpr hsize_t longest_text = 16 << 20;    // [bytes]

/// H5dont_atexit() first of all: 1.10.8 crashes in its exit handler after a full disk. HDF5's own error print is silenced.
void start_hdf5() {
  static bool const started = [] {
    H5dont_atexit();
    H5open();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return true;
  }();
  (void)started;
}

herr_t keep_innermost(unsigned, H5E_error2_t const* error, void* text) {
  if (error->desc) *static_cast<std::string*>(text) = error->desc;
  return 0;
}

/// What the system said where HDF5 tells it among addresses, sizes and the date ("..., errno = 28, error message = ...").
std::string hdf5_reason() {
  std::string text;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_DOWNWARD, keep_innermost, &text);
  constexpr std::string_view before = "errno = ";
  if (auto const at = text.find(before); at != text.npos)
    if (int const error = std::atoi(text.c_str() + at + before.size()); error > 0) return std::generic_category().message(error);
  return text.empty() ? "no reason given" : text.substr(0, text.find('\n'));
}

template <class T>
hid_t type_of() {
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, std::uint32_t>) return H5T_NATIVE_UINT32;
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<T, char>) return H5T_NATIVE_CHAR;
}

std::size_t slash(std::string const& name) { return name.find('/'); }

/// An attribute of one value. @return false where HDF5 refused
bool write_attribute(hid_t object, char const* name, hid_t type, void const* value) {
  Hdf5Id const scalar(H5Screate(H5S_SCALAR), H5Sclose);
  Hdf5Id const attribute(H5Acreate2(object, name, type, scalar, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return attribute >= 0 && H5Awrite(attribute, type, value) >= 0;
}

bool write_text_attribute(hid_t object, char const* name, std::string const& text) {
  Hdf5Id const type(H5Tcopy(H5T_C_S1), H5Tclose);
  return H5Tset_size(type, std::max<std::size_t>(1, text.size())) >= 0 && write_attribute(object, name, type, text.c_str());
}

bool read_attribute(hid_t object, char const* name, hid_t type, void* value) {
  Hdf5Id const attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  Hdf5Id const space(attribute >= 0 ? H5Aget_space(attribute) : -1, H5Sclose);
  return space >= 0 && H5Sget_simple_extent_npoints(space) == 1 && H5Aread(attribute, type, value) >= 0;
}

/// One string of fixed or variable length. @param read  fills a value of the type of the file;  @return nothing where it is no
/// such thing, is longer than `longest` [bytes] or cannot be read
std::optional<std::string> read_string(hid_t type, hid_t space, hsize_t longest, std::function<herr_t(void*)> const& read) {
  if (type < 0 || space < 0 || H5Tget_class(type) != H5T_STRING || H5Sget_simple_extent_npoints(space) != 1) return {};
  std::string text;
  if (H5Tis_variable_str(type) > 0) {
    char* value = nullptr;
    if (read(&value) < 0) return {};
    if (value) text = value;
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, &value);
  } else {
    if (H5Tget_size(type) > longest) return {};
    text.resize(H5Tget_size(type));
    if (read(text.data()) < 0) return {};
    text.resize(std::min(text.size(), text.find('\0')));
  }
  if (text.size() > longest) return {};
  return text;
}

std::optional<std::string> read_text_attribute(hid_t object, char const* name) {
  if (object < 0 || H5Aexists(object, name) <= 0) return {};
  Hdf5Id const attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  Hdf5Id const type(attribute >= 0 ? H5Aget_type(attribute) : -1, H5Tclose);
  Hdf5Id const space(attribute >= 0 ? H5Aget_space(attribute) : -1, H5Sclose);
  return read_string(type, space, 4096, [&](void* value) { return H5Aread(attribute, type, value); });
}

#ifdef H5_HAVE_PARALLEL
void share_among_ranks(hid_t access) {
  H5Pset_fapl_mpio(access, MPI_COMM_WORLD, MPI_INFO_NULL);
  H5Pset_all_coll_metadata_ops(access, true);
  H5Pset_coll_metadata_write(access, true);
}
void write_together(hid_t transfer) { H5Pset_dxpl_mpio(transfer, H5FD_MPIO_COLLECTIVE); }
#else
void share_among_ranks(hid_t) {}
void write_together(hid_t) {}
#endif

}  // namespace

RowRange rows_of_rank(std::int64_t size, Ranks const& ranks) {
  auto const first_of = [&](int rank) { return static_cast<std::size_t>(size * rank / ranks.count()); };
  return {static_cast<std::size_t>(size), first_of(ranks.rank()), first_of(ranks.rank() + 1)};
}

Hdf5File Hdf5File::create(std::filesystem::path const& path, Ranks const& ranks) {
  start_hdf5();
  errno = 0;
  Hdf5Id const access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  if (!ranks.alone()) share_among_ranks(access);
  hid_t const file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  if (ranks.any(file < 0))
    throw FileProblem(ExitCode::cannot_create, path,
                      "cannot be created: " + (errno ? std::generic_category().message(errno) : hdf5_reason()));
  return {path, file, true, ranks};
}

Hdf5File Hdf5File::open(std::filesystem::path const& path) {
  start_hdf5();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw FileProblem(ExitCode::file_missing, path, "no such file");
  if (!std::filesystem::is_regular_file(path, error)) throw FileProblem(ExitCode::file_missing, path, "not a file");
  hid_t const file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) throw FileProblem(ExitCode::bad_input, path, "not an HDF5 file, or damaged: " + hdf5_reason());
  return {path, file, false};
}

Hdf5File::Hdf5File(Hdf5File&& other) noexcept
    : path_(std::move(other.path_)), file_(std::exchange(other.file_, -1)), writing_(other.writing_), ranks_(other.ranks_) {}

Hdf5File::~Hdf5File() {
  // Only where something went wrong is it still open; closing is collective, and the other ranks may be elsewhere.
  if (file_ >= 0 && ranks_.alone()) H5Fclose(file_);
}

void Hdf5File::fail(ExitCode code, std::string const& what) const { throw FileProblem(code, path_, what); }

void Hdf5File::close() {
  hid_t const file = std::exchange(file_, -1);
  herr_t const flushed = writing_ ? H5Fflush(file, H5F_SCOPE_GLOBAL) : 0;
  std::string const reason = flushed < 0 ? hdf5_reason() : "";
  herr_t const closed = H5Fclose(file);
  if (flushed < 0) fail(ExitCode::io_error, "cannot be written: " + reason);
  if (closed < 0) fail(ExitCode::io_error, "cannot be closed: " + hdf5_reason());
}

void Hdf5File::make_group(std::string const& name) {
  std::string const group = name.substr(0, slash(name));
  if (group == name || H5Lexists(file_, group.c_str(), H5P_DEFAULT) > 0) return;
  Hdf5Id const made(H5Gcreate2(file_, group.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  if (made < 0) fail(ExitCode::io_error, fmt::format("cannot make group {}: {}", group, hdf5_reason()));
}

void Hdf5File::write_column(std::string const& name, void const* values, std::size_t rows, std::size_t width, hid_t type,
                            std::string const& unit) {
  make_group(name);
  hsize_t const own[] = {rows, width};
  hsize_t const first[] = {static_cast<hsize_t>(ranks_.sum_before(static_cast<std::int64_t>(rows))), 0};
  hsize_t const shape[] = {static_cast<hsize_t>(ranks_.sum(static_cast<std::int64_t>(rows))), width};
  hsize_t const chunk[] = {std::min<hsize_t>(shape[0], chunk_rows), 1};
  int const rank = width == 1 ? 1 : 2;
  Hdf5Id const space(H5Screate_simple(rank, shape, nullptr), H5Sclose);
  Hdf5Id const filters(H5Pcreate(H5P_DATASET_CREATE), H5Pclose), transfer(H5Pcreate(H5P_DATASET_XFER), H5Pclose);
  // Without the time of its making: the same content is the same file, whenever it was written.
  bool const ready = space >= 0 && filters >= 0 && H5Pset_obj_track_times(filters, false) >= 0 &&
                     (shape[0] == 0 || (H5Pset_chunk(filters, rank, chunk) >= 0 && H5Pset_shuffle(filters) >= 0 &&
                                        H5Pset_deflate(filters, compression) >= 0 && H5Pset_fletcher32(filters) >= 0));
  Hdf5Id const column(ready ? H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, filters, H5P_DEFAULT) : -1, H5Dclose);
  Hdf5Id const part(H5Screate_simple(rank, own, nullptr), H5Sclose);
  if (!ranks_.alone()) {
    write_together(transfer);
    if (rows == 0) {  // nothing to add, but all take part
      H5Sselect_none(space);
      H5Sselect_none(part);
    } else {
      H5Sselect_hyperslab(space, H5S_SELECT_SET, first, nullptr, own, nullptr);
    }
  }
  if (column < 0 || (shape[0] > 0 && H5Dwrite(column, type, part, space, transfer, values) < 0))
    fail(ExitCode::io_error, fmt::format("cannot write {}: {}", name, hdf5_reason()));
  if (!unit.empty() && !write_text_attribute(column, "unit", unit))
    fail(ExitCode::io_error, fmt::format("cannot write the unit of {}: {}", name, hdf5_reason()));
}

template <class T>
void Hdf5File::write(std::string const& name, std::vector<T> const& values, std::string const& unit, std::size_t width) {
  write_column(name, values.data(), values.size() / width, width, type_of<T>(), unit);
}
void Hdf5File::write_text(std::string const& name, std::string const& text) {
  write_column(name, text.data(), ranks_.root() ? text.size() : 0, 1, type_of<char>(), "");
}

void Hdf5File::set_attribute(std::string const& name, double value, std::string const& unit) {
  if (!write_attribute(file_, name.c_str(), H5T_NATIVE_DOUBLE, &value))
    fail(ExitCode::io_error, fmt::format("cannot write {}: {}", name, hdf5_reason()));
  if (!unit.empty()) set_attribute(name + "_unit", unit);
}
void Hdf5File::set_attribute(std::string const& name, std::int64_t value) {
  if (!write_attribute(file_, name.c_str(), H5T_NATIVE_INT64, &value))
    fail(ExitCode::io_error, fmt::format("cannot write {}: {}", name, hdf5_reason()));
}
void Hdf5File::set_attribute(std::string const& name, std::string const& text) {
  if (!write_text_attribute(file_, name.c_str(), text))
    fail(ExitCode::io_error, fmt::format("cannot write {}: {}", name, hdf5_reason()));
}

void Hdf5File::set_column_attribute(std::string const& column, std::string const& name, double value) {
  Hdf5Id const opened(H5Dopen2(file_, column.c_str(), H5P_DEFAULT), H5Dclose);
  if (opened < 0 || !write_attribute(opened, name.c_str(), H5T_NATIVE_DOUBLE, &value))
    fail(ExitCode::io_error, fmt::format("cannot write {} of {}: {}", name, column, hdf5_reason()));
}

/// A column that is there and has the shape that it should have.
struct Hdf5File::OpenColumn {
  Hdf5Id column, space;
  std::size_t rows;
};

Hdf5File::OpenColumn Hdf5File::open_column(std::string const& name, std::size_t size, std::size_t width) const {
  auto const damaged = [&](std::string const& what) { fail(ExitCode::bad_input, fmt::format("{} {}", name, what)); };
  if (auto const end = slash(name); end != std::string::npos)
    if (H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) damaged("is missing");
  if (H5Lexists(file_, name.c_str(), H5P_DEFAULT) <= 0) damaged("is missing");
  Hdf5Id column(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  Hdf5Id space(column >= 0 ? H5Dget_space(column) : -1, H5Sclose);
  if (space < 0) damaged("cannot be opened: " + hdf5_reason());
  hsize_t shape[2] = {0, 1};
  int const rank = width == 1 ? 1 : 2;
  if (H5Sget_simple_extent_ndims(space) != rank || H5Sget_simple_extent_dims(space, shape, nullptr) < 0 || shape[1] != width)
    damaged(width == 1 ? "is not one column of numbers" : fmt::format("is no table of {} columns", width));
  if (size == any_size && shape[0] > most_rows) damaged(fmt::format("claims {} rows", shape[0]));
  if (size != any_size && shape[0] != size) damaged(fmt::format("has {} rows instead of {}", shape[0], size));
  return {std::move(column), std::move(space), shape[0]};
}

bool Hdf5File::has(std::string const& name) const { return H5Lexists(file_, name.c_str(), H5P_DEFAULT) > 0; }

bool Hdf5File::has_attribute(std::string const& name) const { return H5Aexists(file_, name.c_str()) > 0; }

std::size_t Hdf5File::rows_of(std::string const& name) const { return open_column(name, any_size, 1).rows; }

template <class T>
std::vector<T> Hdf5File::read(std::string const& name, std::size_t size, std::size_t width) const {
  OpenColumn const open = open_column(name, size, width);
  std::vector<T> values(open.rows * width);
  if (!values.empty() && H5Dread(open.column, type_of<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail(ExitCode::bad_input, fmt::format("{} cannot be read: {}", name, hdf5_reason()));
  return values;
}

template <class T>
std::vector<T> Hdf5File::read(std::string const& name, RowRange const& rows) const {
  OpenColumn const open = open_column(name, rows.size, 1);
  hsize_t const first = rows.begin, count = rows.end - rows.begin;
  std::vector<T> values(count);
  if (values.empty()) return values;
  Hdf5Id const part(H5Screate_simple(1, &count, nullptr), H5Sclose);
  if (H5Sselect_hyperslab(open.space, H5S_SELECT_SET, &first, nullptr, &count, nullptr) < 0 ||
      H5Dread(open.column, type_of<T>(), part, open.space, H5P_DEFAULT, values.data()) < 0)
    fail(ExitCode::bad_input, fmt::format("{} cannot be read: {}", name, hdf5_reason()));
  return values;
}

#define CLATHRA_COLUMN(T)                                                                                    \
  template void Hdf5File::write(std::string const&, std::vector<T> const&, std::string const&, std::size_t); \
  template std::vector<T> Hdf5File::read(std::string const&, std::size_t, std::size_t) const;                \
  template std::vector<T> Hdf5File::read(std::string const&, RowRange const&) const;
CLATHRA_COLUMN(double)
CLATHRA_COLUMN(float)
CLATHRA_COLUMN(std::int32_t)
CLATHRA_COLUMN(std::uint32_t)
CLATHRA_COLUMN(std::uint8_t)
#undef CLATHRA_COLUMN

std::string Hdf5File::read_text(std::string const& name) const {
  Hdf5Id const set(has(name) ? H5Dopen2(file_, name.c_str(), H5P_DEFAULT) : -1, H5Dclose);
  Hdf5Id const type(set >= 0 ? H5Dget_type(set) : -1, H5Tclose), space(set >= 0 ? H5Dget_space(set) : -1, H5Sclose);
  if (auto text = read_string(type, space, longest_text,
                              [&](void* value) { return H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value); }))
    return *text;
  if (type >= 0 && H5Tget_class(type) == H5T_STRING) fail(ExitCode::bad_input, name + " is not one text, or too long");
  std::vector<char> const text = read<char>(name, any_size);
  if (text.size() > longest_text) fail(ExitCode::bad_input, name + " is too long");
  return {text.begin(), text.end()};
}

void Hdf5File::require_number(std::string const& name) const {
  Hdf5Id const attribute(has_attribute(name) ? H5Aopen(file_, name.c_str(), H5P_DEFAULT) : -1, H5Aclose);
  Hdf5Id const type(attribute >= 0 ? H5Aget_type(attribute) : -1, H5Tclose);
  if (type >= 0 && H5Tget_class(type) == H5T_STRING)
    fail(ExitCode::bad_input, fmt::format("attribute {} is a text, it must be a number without a unit", name));
}

double Hdf5File::double_attribute(std::string const& name) const {
  double value = 0;
  require_number(name);
  if (!read_attribute(file_, name.c_str(), H5T_NATIVE_DOUBLE, &value))
    fail(ExitCode::bad_input, fmt::format("attribute {} is missing or unreadable", name));
  return value;
}
std::int64_t Hdf5File::integer_attribute(std::string const& name) const {
  std::int64_t value = 0;
  require_number(name);
  if (!read_attribute(file_, name.c_str(), H5T_NATIVE_INT64, &value))
    fail(ExitCode::bad_input, fmt::format("attribute {} is missing or unreadable", name));
  // HDF5 cuts what stands behind the point.
  if (double const exact = double_attribute(name); static_cast<double>(value) != exact)
    fail(ExitCode::bad_input, fmt::format("attribute {} must be a whole number, got {}", name, exact));
  return value;
}
std::string Hdf5File::text_attribute(std::string const& name) const {
  std::optional<std::string> text = read_text_attribute(file_, name.c_str());
  if (!text) fail(ExitCode::bad_input, fmt::format("attribute {} is missing or unreadable", name));
  return *text;
}

std::optional<std::string> Hdf5File::unit_of_column(std::string const& name) const {
  if (!has(name)) return {};
  Hdf5Id const column(H5Dopen2(file_, name.c_str(), H5P_DEFAULT), H5Dclose);
  return read_text_attribute(column, "unit");
}
std::optional<std::string> Hdf5File::unit_of_attribute(std::string const& name) const {
  return read_text_attribute(file_, (name + "_unit").c_str());
}

namespace {

/// Flushes a finished file to the disk and gives it its final name.
void publish(std::filesystem::path const& temporary, std::filesystem::path const& path, Existing existing) {
  int const descriptor = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC);
  bool const flushed = descriptor >= 0 && ::fsync(descriptor) == 0;
  if (descriptor >= 0) ::close(descriptor);
  if (!flushed) throw FileProblem(ExitCode::io_error, path, "cannot be written: " + std::generic_category().message(errno));
  give_name(temporary, path, existing);
}

}  // namespace

void replace_hdf5_file(std::filesystem::path const& path, std::function<void(Hdf5File&)> const& write_content, Ranks const& ranks,
                       Existing existing) {
  std::filesystem::path const temporary = path.string() + ranks.from_root(fmt::format(".tmp-{}", ::getpid()));
  if (ranks.root()) ::unlink(temporary.c_str());
  try {
    Hdf5File file = Hdf5File::create(temporary, ranks);
    write_content(file);
    file.close();
    on_root(ranks, [&] { publish(temporary, path, existing); });
  } catch (FileProblem const& problem) {
    if (ranks.root()) ::unlink(temporary.c_str());
    std::string text = problem.what();  // named after the file that the user knows
    for (std::string const& name : {temporary.string(), path.string()})
      if (text.starts_with(name + ": ")) text = text.substr(name.size() + 2);
    FileProblem const named(problem.code, path, text);
    // Where one rank fails half way the others wait for it in the next collective call, and would wait for ever.
    if (!ranks.alone() && problem.code == ExitCode::io_error) end_all_ranks(ranks, named);
    throw named;
  }
}

}  // namespace clathra
