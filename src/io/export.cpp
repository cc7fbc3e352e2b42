#include "io/export.hpp"

#include <fmt/format.h>

#include <iterator>

#include "io/problems.hpp"
#include "io/text_file.hpp"

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

std::vector<float> vectors(std::vector<float> const& x, std::vector<float> const& y) {
  std::vector<float> v;
  v.reserve(3 * x.size());
  for (std::size_t i = 0; i < x.size(); ++i) v.insert(v.end(), {x[i], y[i], 0.0F});
  return v;
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
  constexpr std::string_view names[contact_state_count] = {
      "contact", "bonded", "broken_tension", "broken_compression", "broken_shear", "broken_rolling"};
  return state < contact_state_count ? names[state] : "unknown";
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

std::string discs_vtu(Snapshot const& s) {
  VtuFile file;
  file.xml("<PointData>\n");
  file.add("id", "Int32", s.id);
  file.add("radius", "Float32", s.radius);
  file.add("angle", "Float32", s.angle);
  file.add("displacement", "Float32", vectors(s.ux, s.uy), 3);
  file.add("velocity", "Float32", vectors(s.vx, s.vy), 3);
  file.add("angular_velocity", "Float32", s.omega);
  file.add("stress_xx", "Float32", s.stress_xx);
  file.add("stress_yy", "Float32", s.stress_yy);
  file.add("stress_xy", "Float32", s.stress_xy);
  file.add("coordination", "UInt8", s.coordination);
  file.add("bonds_intact", "UInt8", s.bonds_intact);
  file.add("bonds_initial", "UInt8", s.bonds_initial);
  file.xml("</PointData>\n");
  add_points(file, s);
  std::vector<std::int32_t> index(s.id.size());
  for (std::size_t i = 0; i < index.size(); ++i) index[i] = static_cast<std::int32_t>(i);
  add_cells(file, index, 1, 1);  // VTK_VERTEX
  return file.text(s.id.size(), s.id.size());
}

std::string pairs_vtu(Snapshot const& s) {
  VtuFile file;
  file.xml("<CellData>\n");
  file.add("state", "UInt8", s.state);
  file.add("normal_force", "Float64", s.normal_force);
  file.add("shear_force", "Float64", s.shear_force);
  file.add("moment", "Float64", s.moment);
  file.add("gap", "Float64", s.gap);
  file.add("width", "Float64", s.width);
  file.xml("</CellData>\n");
  add_points(file, s);
  std::vector<std::int32_t> ends;
  ends.reserve(2 * s.a.size());
  for (std::size_t k = 0; k < s.a.size(); ++k) ends.insert(ends.end(), {s.a[k], s.b[k]});
  add_cells(file, ends, 2, 3);  // VTK_LINE
  return file.text(s.id.size(), s.a.size());
}

std::string discs_csv(Snapshot const& s) {
  std::string text =
      "id,x_m,y_m,radius_m,angle_rad,ux_m,uy_m,vx_m_per_s,vy_m_per_s,omega_rad_per_s,stress_xx_Pa,stress_yy_Pa,stress_xy_Pa,"
      "coordination,bonds_intact,bonds_initial\n";
  for (std::size_t i = 0; i < s.id.size(); ++i)
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", s.id[i], s.x[i], s.y[i],
                   s.radius[i], s.angle[i], s.ux[i], s.uy[i], s.vx[i], s.vy[i], s.omega[i], s.stress_xx[i], s.stress_yy[i],
                   s.stress_xy[i], s.coordination[i], s.bonds_intact[i], s.bonds_initial[i]);
  return text;
}

std::string pairs_csv(Snapshot const& s) {
  std::string text = "id_a,id_b,state,normal_force_N_per_m,shear_force_N_per_m,moment_Nm_per_m,gap_m,width_m\n";
  for (std::size_t k = 0; k < s.a.size(); ++k)
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}\n", s.id[static_cast<std::size_t>(s.a[k])],
                   s.id[static_cast<std::size_t>(s.b[k])], contact_state_name(s.state[k]), shortest(s.normal_force[k]),
                   shortest(s.shear_force[k]), shortest(s.moment[k]), shortest(s.gap[k]), shortest(s.width[k]));
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
      write("discs", "lammpstrj", lammps_dump(snapshot));
      break;
    case ExportFormat::vtu:
      write("discs", "vtu", discs_vtu(snapshot));
      write("contacts", "vtu", pairs_vtu(snapshot));
      break;
    case ExportFormat::csv:
      write("discs", "csv", discs_csv(snapshot));
      write("contacts", "csv", pairs_csv(snapshot));
      break;
  }
  return written;
}

}  // namespace clathra
