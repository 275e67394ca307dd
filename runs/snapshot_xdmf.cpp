#include "runs/snapshot_xdmf.hpp"

#include <fmt/format.h>

#include "runs/snapshot_layout.hpp"

namespace crossgrain {
namespace {

/// A reference to one array of doubles.
std::string item(const std::string& file, const std::string& path, const std::string& size) {
  return fmt::format(
      "<DataItem Dimensions=\"{}\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">{}:{}"
      "</DataItem>",
      size, file, path);
}

std::string points(const std::string& file, const std::string& path, std::size_t count) {
  return fmt::format(
      "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\"/>\n"
      "        <Geometry GeometryType=\"XY\">{}</Geometry>\n",
      count, item(file, path, fmt::format("{} 2", count)));
}

std::string attribute(const char* name, const char* type, const std::string& data) {
  return fmt::format(
      "        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n", name,
      type, data);
}

std::string disksOf(const std::string& file, const std::string& group, const Snapshot& now) {
  const std::size_t count = now.position.size();
  const std::string scalars = fmt::format("{}", count);
  std::string text = points(file, group + "/position", count);
  text += attribute("radius", "Scalar", item(file, "/disks/radius", scalars));
  text +=
      attribute("velocity", "Matrix", item(file, group + "/velocity", fmt::format("{} 2", count)));
  if (now.spin) text += attribute("spin", "Scalar", item(file, group + "/spin", scalars));
  return text;
}

template <class Body>
std::string collection(const char* name, const std::vector<Snapshot>& snapshots, Body&& body) {
  std::string text = fmt::format(
      "    <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", name);
  for (std::size_t k = 0; k < snapshots.size(); ++k)
    text += fmt::format(
        "      <Grid Name=\"{} {}\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n{}"
        "      </Grid>\n",
        name, k, snapshots[k].positionTime, body(snapshotGroup(k), snapshots[k]));
  return text + "    </Grid>\n";
}

}  // namespace

std::string snapshotXdmf(const std::string& file, std::size_t wallDisks,
                         const std::vector<Snapshot>& snapshots) {
  std::string text = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n";
  text += collection("disks", snapshots, [&](const std::string& group, const Snapshot& now) {
    return disksOf(file, group, now);
  });
  if (wallDisks > 0)
    text += collection("walls", snapshots, [&](const std::string& group, const Snapshot&) {
      return points(file, group + "/wall_position", wallDisks) +
             attribute("radius", "Scalar",
                       item(file, "/walls/radius", fmt::format("{}", wallDisks)));
    });
  return text + "  </Domain>\n</Xdmf>\n";
}

}  // namespace crossgrain
