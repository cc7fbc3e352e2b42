#include "io/results/export.hpp"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <type_traits>

#include "domain/measurement/strain_field.hpp"
#include "io/errors/problems.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {
namespace {

/// A VTK unstructured grid under construction: the XML of its arrays, and their bytes behind it.
class VtuFile {
 public:
  template <class T>
  void add(char const* name, char const* type, std::vector<T> const& values, std::size_t width = 1) {
    fmt::format_to(std::back_inserter(xml_),
                   "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
                   name, width, bytes_.size());
    std::uint64_t const size = values.size() * sizeof(T);
    bytes_.append(reinterpret_cast<char const*>(&size), sizeof size);
    bytes_.append(reinterpret_cast<char const*>(values.data()), size);
  }
  void xml(std::string const& text) { xml_ += text; }

  std::string text(std::size_t points, std::size_t cells) const {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<UnstructuredGrid><Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n{}</Piece>"
        "</UnstructuredGrid>\n<AppendedData encoding=\"raw\">_{}\n</AppendedData>\n</VTKFile>\n",
        points, cells, xml_, bytes_);
  }

 private:
  std::string xml_, bytes_;
};

/// x, y, 0 of each disc.
std::vector<double> points(Snapshot const& s) {
  std::vector<double> p;
  p.reserve(3 * s.id.size());
  for (std::size_t i = 0; i < s.id.size(); ++i) p.insert(p.end(), {s.x[i], s.y[i], 0.0});
  return p;
}

/// The shortest digits from which the number is read back: fewer where it was rounded to what single precision holds.
std::string shortest(double value) {
  auto const single = static_cast<float>(value);
  return static_cast<double>(single) == value ? fmt::format("{}", single) : fmt::format("{}", value);
}

/// The cells of a grid whose cell k has `width` points.
void add_cells(VtuFile& file, std::vector<std::int32_t> const& connectivity, std::size_t width, std::uint8_t type) {
  std::vector<std::int32_t> offsets(connectivity.size() / width);
  for (std::size_t k = 0; k < offsets.size(); ++k) offsets[k] = static_cast<std::int32_t>((k + 1) * width);
  file.xml("<Cells>\n");
  file.add("connectivity", "Int32", connectivity);
  file.add("offsets", "Int32", offsets);
  file.add("types", "UInt8", std::vector<std::uint8_t>(offsets.size(), type));
  file.xml("</Cells>\n");
}

void add_points(VtuFile& file, Snapshot const& s) {
  file.xml("<Points>\n");
  file.add("position", "Float64", points(s), 3);
  file.xml("</Points>\n");
}

}  // namespace

std::string_view contact_state_name(std::uint8_t state) {
  for (BreakModeNames const& m : break_modes)
    if (static_cast<ContactState>(state) == broken_in(m.mode)) return m.broken;
  return state == 0 ? "contact" : state == 1 ? "bonded" : "unknown";
}

std::string lammps_dump(Snapshot const& s) {
  std::string text = fmt::format(
      "ITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff pp\n{} {}\n{} {}\n{} {}\nITEM: ATOMS id type x y z "
      "radius "
      "vx vy vz omegaz sxx syy sxy coordination\n",
      s.step, s.id.size(), s.left, s.right, s.bottom, s.top, -0.5 * s.d50, 0.5 * s.d50);
  for (std::size_t i = 0; i < s.id.size(); ++i)  // ids of LAMMPS count from 1
    fmt::format_to(std::back_inserter(text), "{} 1 {} {} 0 {} {} {} 0 {} {} {} {} {}\n", s.id[i] + 1, s.x[i], s.y[i], s.radius[i],
                   s.vx[i], s.vy[i], s.omega[i], s.stress_xx[i], s.stress_yy[i], s.stress_xy[i], s.coordination[i]);
  return text;
}

namespace {

template <class Value>
constexpr char const* vtk_type() {
  return std::is_same_v<Value, std::uint8_t> ? "UInt8" : std::is_same_v<Value, float> ? "Float32" : "Float64";
}

/// A vector as such, with its third component, other columns part by part.
template <class Value, std::size_t Parts>
void add_column(VtuFile& file, Snapshot const& s, SnapshotColumn<Value, Parts> const& column) {
  if constexpr (Parts == 2) {
    std::vector<Value> const &x = s.*column.parts[0], &y = s.*column.parts[1];
    std::vector<Value> vectors;
    vectors.reserve(3 * x.size());
    for (std::size_t i = 0; i < x.size(); ++i) vectors.insert(vectors.end(), {x[i], y[i], Value(0)});
    file.add(column.name, vtk_type<Value>(), vectors, 3);
  } else {
    char const* const alone = Parts == 1 ? column.name : nullptr;
    for (std::size_t k = 0; k < Parts; ++k) file.add(alone ? alone : column.part[k], vtk_type<Value>(), s.*column.parts[k]);
  }
}

}  // namespace

std::string particles_vtu(Snapshot const& s) {
  VtuFile file;
  file.xml("<PointData>\n");
  file.add("id", "Int32", s.id);
  for_each_disc_column([&]<class Value, std::size_t Parts>(SnapshotColumn<Value, Parts> const& column) {
    if constexpr (!std::is_same_v<Value, double>) add_column(file, s, column);  // the position is that of the points
  });
  file.add("shear_strain", "Float32", shear_strain(s));
  file.xml("</PointData>\n");
  add_points(file, s);
  std::vector<std::int32_t> index(s.id.size());
  for (std::size_t i = 0; i < index.size(); ++i) index[i] = static_cast<std::int32_t>(i);
  add_cells(file, index, 1, 1);  // VTK_VERTEX
  return file.text(s.id.size(), s.id.size());
}

std::string contacts_vtu(Snapshot const& s) {
  VtuFile file;
  file.xml("<CellData>\n");
  file.add("state", "UInt8", s.state);
  for_each_pair_column([&](auto const& column) { add_column(file, s, column); });
  file.xml("</CellData>\n");
  add_points(file, s);
  std::vector<std::int32_t> ends;
  ends.reserve(2 * s.a.size());
  for (std::size_t k = 0; k < s.a.size(); ++k) ends.insert(ends.end(), {s.a[k], s.b[k]});
  add_cells(file, ends, 2, 3);  // VTK_LINE
  return file.text(s.id.size(), s.a.size());
}

namespace {

/// Appends ",name_unit" for each part of a column, and their numbers in row `i`.
template <class Column>
void append_header(std::string& text, Column const& column) {
  for (char const* const part : column.part) text += fmt::format(",{}{}", part, column.suffix);
}
template <class Column, class Text>
void append_cells(std::string& text, Snapshot const& s, Column const& column, std::size_t i, Text const& text_of) {
  for (auto const list : column.parts) text += ',', text += text_of((s.*list)[i]);
}

}  // namespace

std::string particles_csv(Snapshot const& s) {
  std::string text = "id";
  std::vector<float> const shear = shear_strain(s);
  for_each_disc_column([&](auto const& column) { append_header(text, column); });
  text += ",shear_strain\n";
  auto const cell = [](auto value) { return fmt::format("{}", value); };
  for (std::size_t i = 0; i < s.id.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{}", s.id[i]);
    for_each_disc_column([&](auto const& column) { append_cells(text, s, column, i, cell); });
    fmt::format_to(std::back_inserter(text), ",{}\n", shear[i]);
  }
  return text;
}

std::string contacts_csv(Snapshot const& s) {
  std::string text = "id_a,id_b,state";
  for_each_pair_column([&](auto const& column) { append_header(text, column); });
  text += "\n";
  for (std::size_t k = 0; k < s.a.size(); ++k) {
    fmt::format_to(std::back_inserter(text), "{},{},{}", s.id[static_cast<std::size_t>(s.a[k])],
                   s.id[static_cast<std::size_t>(s.b[k])], contact_state_name(s.state[k]));
    for_each_pair_column([&](auto const& column) { append_cells(text, s, column, k, shortest); });
    text += "\n";
  }
  return text;
}

std::vector<std::filesystem::path> export_snapshot(Snapshot const& snapshot, ExportFormat format,
                                                   std::filesystem::path const& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw FileProblem(ExitCode::cannot_create, folder, error.message());
  std::vector<std::filesystem::path> written;
  auto const write = [&](char const* what, char const* extension, std::string const& text) {
    written.push_back(folder / fmt::format("{}_{:012d}.{}", what, snapshot.step, extension));
    replace_text_file(written.back(), text);
  };
  switch (format) {
    case ExportFormat::lammpsdump:
      write("particles", "lammpstrj", lammps_dump(snapshot));
      break;
    case ExportFormat::vtu:
      write("particles", "vtu", particles_vtu(snapshot));
      write("contacts", "vtu", contacts_vtu(snapshot));
      break;
    case ExportFormat::csv:
      write("particles", "csv", particles_csv(snapshot));
      write("contacts", "csv", contacts_csv(snapshot));
      break;
  }
  return written;
}

std::vector<std::filesystem::path> export_series(std::vector<std::filesystem::path> const& snapshots, ExportFormat format,
                                                 std::filesystem::path const& folder) {
  std::vector<std::filesystem::path> written;
  std::map<std::string, std::string> entries;  // of an index, by what it lists: "particles"
  for (std::filesystem::path const& file : snapshots) {
    Snapshot const snapshot = read_snapshot(file);
    for (std::filesystem::path const& one : export_snapshot(snapshot, format, folder)) {
      std::string const name = one.filename().string();
      entries[name.substr(0, name.find('_'))] += fmt::format("<DataSet timestep=\"{}\" file=\"{}\"/>\n", snapshot.eps1, name);
      written.push_back(one);
    }
  }
  if (format != ExportFormat::vtu) return written;
  for (auto const& [what, list] : entries) {
    written.push_back(folder / (what + ".pvd"));
    replace_text_file(written.back(),
                      fmt::format("<?xml version=\"1.0\"?>\n<!-- The time of a step is its axial strain. -->\n<VTKFile "
                                  "type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n{}"
                                  "</Collection>\n</VTKFile>\n",
                                  list));
  }
  return written;
}

}  // namespace clathra
