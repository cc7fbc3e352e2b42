#include <fmt/format.h>

#include "io/errors/problems.hpp"
#include "io/errors/rank_errors.hpp"
#include "io/formats/text_file.hpp"
#include "io/results/snapshot_file.hpp"

namespace clathra {
namespace {

constexpr char float4[] = "NumberType=\"Float\" Precision=\"4\"", uchar1[] = "NumberType=\"UChar\" Precision=\"1\"",
               int4[] = "NumberType=\"Int\" Precision=\"4\"", uint4[] = "NumberType=\"UInt\" Precision=\"4\"",
               float8[] = "NumberType=\"Float\" Precision=\"8\"";

/// XDMF's NumberType and Precision.
template <class Value>
constexpr char const* number_type() {
  return std::is_same_v<Value, std::uint8_t> ? uchar1 : std::is_same_v<Value, float> ? float4 : float8;
}

std::string data_item(std::string const& file, std::string const& dataset, std::size_t rows, int width, char const* number) {
  std::string const shape = width == 1 ? fmt::format("{}", rows) : fmt::format("{} {}", rows, width);
  return fmt::format("<DataItem Dimensions=\"{}\" {} Format=\"HDF\">{}:/{}</DataItem>", shape, number, file, dataset);
}

std::string attribute(char const* name, char const* centre, std::string const& item, int width) {
  return fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", name,
                     width == 1 ? "Scalar" : "Vector", centre, item);
}

template <class Value, std::size_t Parts>
std::string attribute(SnapshotColumn<Value, Parts> const& column, char const* centre, std::string const& file,
                      std::string const& dataset, std::size_t rows, char const* number) {
  auto const width = static_cast<int>(column.width);
  return attribute(column.viewer_name ? column.viewer_name : column.name, centre,
                   data_item(file, dataset + column.name, rows, width, number), width);
}

std::string disc_attributes(SnapshotEntry const& e) {
  std::string text = attribute("id", "Node", data_item(e.file, "particles/id", e.discs, 1, int4), 1);
  for_each_disc_column([&]<class Value, std::size_t Parts>(SnapshotColumn<Value, Parts> const& column) {
    if (std::is_same_v<Value, double>) return;  // the position, which is the geometry
    text += attribute(column, "Node", e.file, "particles/", e.discs, number_type<Value>());
  });
  return text;
}

std::string pair_attributes(SnapshotEntry const& e, SnapshotNumbers numbers) {
  std::string text = attribute("state", "Cell", data_item(e.file, "contacts/state", e.pairs, 1, uchar1), 1);
  for_each_pair_column([&](auto const& column) {
    text += attribute(column, "Cell", e.file, "contacts/", e.pairs, numbers == SnapshotNumbers::full ? float8 : float4);
  });
  return text;
}

std::string grid(std::string const& name, double path, std::string const& topology, std::string const& geometry,
                 std::string const& columns) {
  return fmt::format(
      "      <Grid Name=\"{}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n        {}\n        <Geometry "
      "GeometryType=\"XY\">{}</Geometry>\n{}      </Grid>\n",
      name, path, topology, geometry, columns);
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
  entries_.push_back({name, snapshot.step, snapshot.path, total(snapshot.id.size()), total(snapshot.a.size())});
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
    grids += grid("particles", e.path, topology, data_item(e.file, "particles/position", e.discs, 2, float8), disc_attributes(e));
  }
  return collection("particles", grids);
}

std::string SnapshotSeries::contacts_index() const {
  std::string grids;
  for (SnapshotEntry const& e : entries_) {
    std::string const topology =
        fmt::format("<Topology TopologyType=\"Polyline\" NumberOfElements=\"{}\" NodesPerElement=\"2\">{}</Topology>", e.pairs,
                    data_item(e.file, "contacts/pair", e.pairs, 2, uint4));
    grids += grid("contacts", e.path, topology, data_item(e.file, "particles/position", e.discs, 2, float8),
                  pair_attributes(e, numbers_));
  }
  return collection("contacts", grids);
}

}  // namespace clathra
