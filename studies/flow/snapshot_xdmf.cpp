#include "studies/flow/snapshot_xdmf.hpp"

#include <fmt/format.h>

#include "results/snapshot_layout.hpp"

namespace crossgrain::inline studies {
namespace {

/// References into one HDF5 file.
class Items {
 public:
  explicit Items(const std::string& file) : file_(file) {}

  std::string numbers(const std::string& path, const std::string& size) const {
    return fmt::format(
        R"(<DataItem Dimensions="{}" NumberType="Float" Precision="8" Format="HDF">{}:{}</DataItem>)",
        size, file_, path);
  }
  /// Points that are cells of one point each. ParaView's XDMF 3 readers draw no points without the
  /// list of them.
  std::string points(const std::string& group, const std::string& path, std::size_t count) const {
    return fmt::format(
        R"(          <Topology TopologyType="Polyvertex" NumberOfElements="{0}" NodesPerElement="1">)"
        R"(<DataItem Dimensions="{0} 1" NumberType="Int" Precision="4" Format="HDF">{1}:{2}/index</DataItem></Topology>)"
        "\n"
        R"(          <Geometry GeometryType="XY">{3}</Geometry>)"
        "\n",
        count, file_, group, numbers(path, fmt::format("{} 2", count)));
  }
  std::string attribute(const char* name, const char* type, const std::string& path,
                        const std::string& size) const {
    return fmt::format(
        R"(          <Attribute Name="{}" AttributeType="{}" Center="Node">{}</Attribute>)"
        "\n",
        name, type, numbers(path, size));
  }

 private:
  const std::string& file_;
};

std::string grid(const char* name, const std::string& body) {
  return fmt::format("        <Grid Name=\"{}\" GridType=\"Uniform\">\n{}        </Grid>\n", name,
                     body);
}

std::string disksOf(const Items& items, const std::string& group, std::size_t count, bool spins) {
  const std::string scalars = fmt::format("{}", count), vectors = fmt::format("{} 2", count);
  std::string text = items.points("/disks", group + "/position", count);
  text += items.attribute("radius", "Scalar", "/disks/radius", scalars);
  text += items.attribute("velocity", "Matrix", group + "/velocity", vectors);
  if (spins) text += items.attribute("spin", "Scalar", group + "/spin", scalars);
  return grid("disks", text);
}

std::string wallsOf(const Items& items, const std::string& group, std::size_t count) {
  return grid("walls",
              items.points("/walls", group + "/wall_position", count) +
                  items.attribute("radius", "Scalar", "/walls/radius", fmt::format("{}", count)));
}

}  // namespace

std::string snapshotXdmf(const std::string& file, std::size_t disks, std::size_t wallDisks,
                         const std::vector<KeptSnapshot>& snapshots) {
  const Items items(file);
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"snapshots\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t k = 0; k < snapshots.size(); ++k) {
    const std::string group = snapshotGroup(k);
    text += fmt::format(
        "      <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
        "        <Time Value=\"{}\"/>\n",
        group.substr(1), snapshots[k].time);
    text += disksOf(items, group, disks, snapshots[k].spins);
    if (wallDisks > 0) text += wallsOf(items, group, wallDisks);
    text += "      </Grid>\n";
  }
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace crossgrain::inline studies
