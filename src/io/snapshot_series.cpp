#include <fmt/format.h>

#include "io/problems.hpp"
#include "io/snapshot_file.hpp"
#include "io/text_file.hpp"
#include "io/together.hpp"

namespace clathra {
namespace {

/// What ParaView shows of a column.
struct Attribute {
  char const* name;     ///< as the user sees it
  char const* dataset;  ///< in the snapshot
  char const* kind;     ///< XDMF's AttributeType
  int width;
  char const* number;  ///< XDMF's NumberType and Precision; `as_rounded`: 4 bytes, or 8 where nothing is rounded
};

constexpr char float4[] = "NumberType=\"Float\" Precision=\"4\"", uchar1[] = "NumberType=\"UChar\" Precision=\"1\"",
               int4[] = "NumberType=\"Int\" Precision=\"4\"", uint4[] = "NumberType=\"UInt\" Precision=\"4\"",
               float8[] = "NumberType=\"Float\" Precision=\"8\"";
constexpr char const* as_rounded = nullptr;

constexpr Attribute of_discs[] = {{"id", "particles/id", "Scalar", 1, int4},
                                  {"radius", "particles/radius", "Scalar", 1, float4},
                                  {"displacement", "particles/displacement", "Vector", 3, float4},
                                  {"velocity", "particles/velocity", "Vector", 3, float4},
                                  {"angular_velocity", "particles/angular_velocity", "Scalar", 1, float4},
                                  {"angle", "particles/angle", "Scalar", 1, float4},
                                  {"stress_xx_yy_xy", "particles/stress", "Vector", 3, float4},
                                  {"coordination", "particles/coordination", "Scalar", 1, uchar1},
                                  {"bonds_intact", "particles/bonds_intact", "Scalar", 1, uchar1},
                                  {"bonds_initial", "particles/bonds_initial", "Scalar", 1, uchar1}};
constexpr Attribute of_pairs[] = {{"state", "contacts/state", "Scalar", 1, uchar1},
                                  {"normal_force", "contacts/normal_force", "Scalar", 1, as_rounded},
                                  {"shear_force", "contacts/shear_force", "Scalar", 1, as_rounded},
                                  {"moment", "contacts/moment", "Scalar", 1, as_rounded},
                                  {"gap", "contacts/gap", "Scalar", 1, as_rounded},
                                  {"width", "contacts/width", "Scalar", 1, as_rounded}};

std::string data_item(std::string const& file, char const* dataset, std::size_t rows, int width, char const* number) {
  std::string const shape = width == 1 ? fmt::format("{}", rows) : fmt::format("{} {}", rows, width);
  return fmt::format("<DataItem Dimensions=\"{}\" {} Format=\"HDF\">{}:/{}</DataItem>", shape, number, file, dataset);
}

template <std::size_t Count>
std::string attributes(Attribute const (&list)[Count], char const* centre, std::string const& file, std::size_t rows,
                       SnapshotNumbers numbers) {
  char const* const real = numbers == SnapshotNumbers::full ? float8 : float4;
  std::string text;
  for (Attribute const& a : list)
    text += fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", a.name, a.kind,
                        centre, data_item(file, a.dataset, rows, a.width, a.number ? a.number : real));
  return text;
}

std::string grid(std::string const& name, double eps1, std::string const& topology, std::string const& geometry,
                 std::string const& columns) {
  return fmt::format(
      "      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n        {}\n        <Geometry "
      "GeometryType=\"XY\">{}</Geometry>\n{}      </Grid>\n",
      name, eps1, topology, geometry, columns);
}

std::string collection(std::string const& name, std::string const& grids) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<!-- The time of a step is its axial strain. -->\n<Xdmf Version=\"3.0\">\n  <Domain>\n    <Grid "
      "Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}    </Grid>\n  </Domain>\n</Xdmf>\n",
      name, grids);
}

}  // namespace

SnapshotSeries::SnapshotSeries(std::filesystem::path run_folder, Ranks ranks, std::vector<SnapshotEntry> before,
                               SnapshotNumbers numbers)
    : folder_(std::move(run_folder)), ranks_(std::move(ranks)), entries_(std::move(before)), numbers_(numbers) {
  on_root(ranks_, [this] {
    std::error_code error;
    std::filesystem::create_directories(folder_ / "snap", error);
    if (error) throw FileProblem(ExitCode::cannot_create, folder_ / "snap", error.message());
  });
}

void SnapshotSeries::write(Snapshot const& snapshot) {
  std::string const name = fmt::format("snap/{:012d}.h5", snapshot.step);
  write_snapshot(folder_ / name, snapshot, ranks_, numbers_);
  auto const total = [&](std::size_t count) { return static_cast<std::size_t>(ranks_.sum(static_cast<std::int64_t>(count))); };
  entries_.push_back({name, snapshot.step, snapshot.eps1, total(snapshot.id.size()), total(snapshot.a.size())});
  on_root(ranks_, [this] {
    replace_text_file(folder_ / "particles.xdmf", particles_index());
    replace_text_file(folder_ / "contacts.xdmf", contacts_index());
  });
}

std::string SnapshotSeries::particles_index() const {
  std::string grids;
  for (SnapshotEntry const& e : entries_) {
    // Without the indices in the topology ParaView's Threshold finds nothing.
    std::string const topology =
        fmt::format("<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" NodesPerElement=\"1\">{}</Topology>", e.discs,
                    data_item(e.file, "particles/index", e.discs, 1, int4));
    grids += grid("discs", e.eps1, topology, data_item(e.file, "particles/position", e.discs, 2, float8),
                  attributes(of_discs, "Node", e.file, e.discs, numbers_));
  }
  return collection("discs", grids);
}

std::string SnapshotSeries::contacts_index() const {
  std::string grids;
  for (SnapshotEntry const& e : entries_) {
    std::string const topology =
        fmt::format("<Topology TopologyType=\"Polyline\" NumberOfElements=\"{}\" NodesPerElement=\"2\">{}</Topology>", e.pairs,
                    data_item(e.file, "contacts/pair", e.pairs, 2, uint4));
    grids += grid("contacts", e.eps1, topology, data_item(e.file, "particles/position", e.discs, 2, float8),
                  attributes(of_pairs, "Cell", e.file, e.pairs, numbers_));
  }
  return collection("contacts", grids);
}

}  // namespace clathra
