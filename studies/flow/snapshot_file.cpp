#include "studies/flow/snapshot_file.hpp"

#include <fmt/format.h>

#include <numeric>
#include <utility>

#include "support/files.hpp"

namespace crossgrain::inline studies {
namespace {

template <int D>
void writeVectors(Hdf5File& out, const std::string& path, const std::vector<VecOf<D>>& values) {
  out.write(path, values.empty() ? nullptr : values.front().data(), values.size(), D);
}

/// Writes what is about the normal of the plane, a number each, or a vector each.
template <int D>
void writeSpins(Hdf5File& out, const std::string& path, const std::vector<SpinOf<D>>& values) {
  if constexpr (D == 2)
    out.write(path, values);
  else
    writeVectors<D>(out, path, values);
}

template <int D>
void writeContacts(Hdf5File& out, const std::string& path, const ContactsOf<D>& contacts) {
  out.write(path + "/i", contacts.i);
  out.write(path + "/j", contacts.j);
  writeVectors<D>(out, path + "/normal", contacts.normal);
  out.write(path + "/overlap", contacts.overlap);
  out.write(path + "/normal_force", contacts.normalForce);
  writeSpins<D>(out, path + "/tangential_force", contacts.tangentialForce);
  if (!contacts.sliding.empty())
    out.write(path + "/sliding",
              std::vector<std::int32_t>(contacts.sliding.begin(), contacts.sliding.end()));
  if (!contacts.rollingTorque.empty())
    writeSpins<D>(out, path + "/rolling_torque", contacts.rollingTorque);
  if (!contacts.dissipation.empty()) out.write(path + "/dissipation", contacts.dissipation);
  if (!contacts.point.empty()) writeVectors<D>(out, path + "/point", contacts.point);
}

/// Angles, or quaternions w, x, y, z.
template <int D>
void writeTurns(Hdf5File& out, const std::string& path, const std::vector<TurnOf<D>>& turns) {
  if constexpr (D == 2)
    out.write(path, turns);
  else
    out.write(path, turns.front().data(), turns.size(), 4);
}

/// One row per body; force and torque where every body has them.
template <int D>
void writeBodies(Hdf5File& out, const std::string& path,
                 const std::vector<BodySnapshotOf<D>>& bodies) {
  std::vector<VecOf<D>> centre, velocity, force;
  std::vector<SpinOf<D>> angle, spin, torque;
  for (const auto& body : bodies) {
    centre.push_back(body.centre);
    velocity.push_back(body.velocity);
    angle.push_back(body.angle);
    spin.push_back(body.angularVelocity);
    if (body.force) force.push_back(*body.force);
    if (body.torque) torque.push_back(*body.torque);
  }
  writeVectors<D>(out, path + "/centre", centre);
  writeSpins<D>(out, path + "/angle", angle);
  writeVectors<D>(out, path + "/velocity", velocity);
  writeSpins<D>(out, path + "/angular_velocity", spin);
  if (force.size() == bodies.size()) writeVectors<D>(out, path + "/force", force);
  if (torque.size() == bodies.size()) writeSpins<D>(out, path + "/torque", torque);
}

template <int D>
void writeSnapshot(Hdf5File& out, const std::string& group, const SnapshotOf<D>& now) {
  out.write(group + "/time",
            std::vector{now.positionTime, now.velocityTime, now.contactTime, now.contactInterval});
  writeVectors<D>(out, group + "/position", now.position);
  writeVectors<D>(out, group + "/velocity", now.velocity);
  if (now.spin) writeSpins<D>(out, group + "/spin", *now.spin);
  if (now.turn) writeTurns<D>(out, group + "/turn", *now.turn);
  writeVectors<D>(out, group + "/wall_position", now.wallPosition);
  if (!now.bodies.empty()) writeBodies(out, group + "/bodies", now.bodies);
  if (now.energies)
    out.write(group + "/energies", std::vector{now.energies->kinetic, now.energies->elastic});
  if (now.contacts) writeContacts(out, group + "/contacts", *now.contacts);
}

std::vector<std::int32_t> countedUp(std::size_t count) {
  std::vector<std::int32_t> result(count);
  std::iota(result.begin(), result.end(), 0);
  return result;
}

/// References into one HDF5 file.
class Items {
 public:
  Items(const std::string& file, int dimension) : file_(file), dimension_(dimension) {}

  std::string vectors(std::size_t count) const { return fmt::format("{} {}", count, dimension_); }

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
        R"(          <Geometry GeometryType="{4}">{3}</Geometry>)"
        "\n",
        count, file_, group, numbers(path, vectors(count)), dimension_ == 3 ? "XYZ" : "XY");
  }
  std::string attribute(const char* name, const char* type, const std::string& path,
                        const std::string& size) const {
    return fmt::format(
        R"(          <Attribute Name="{}" AttributeType="{}" Center="Node">{}</Attribute>)"
        "\n",
        name, type, numbers(path, size));
  }

  /// ParaView has vectors of three numbers alone.
  std::string vectorAttribute(const char* name, const std::string& path, std::size_t count) const {
    return attribute(name, dimension_ == 3 ? "Vector" : "Matrix", path, vectors(count));
  }

 private:
  const std::string& file_;
  int dimension_;
};

std::string grid(const char* name, const std::string& body) {
  return fmt::format("        <Grid Name=\"{}\" GridType=\"Uniform\">\n{}        </Grid>\n", name,
                     body);
}

template <int D>
std::string disksOf(const Items& items, const std::string& group, std::size_t count, bool spins) {
  const std::string scalars = fmt::format("{}", count);
  std::string text = items.points("/disks", group + "/position", count);
  text += items.attribute("radius", "Scalar", "/disks/radius", scalars);
  text += items.vectorAttribute("velocity", group + "/velocity", count);
  if (spins)
    text += D == 3 ? items.vectorAttribute("spin", group + "/spin", count)
                   : items.attribute("spin", "Scalar", group + "/spin", scalars);
  return grid("disks", text);
}

std::string wallsOf(const Items& items, const std::string& group, std::size_t count) {
  return grid("walls",
              items.points("/walls", group + "/wall_position", count) +
                  items.attribute("radius", "Scalar", "/walls/radius", fmt::format("{}", count)));
}

}  // namespace

template <int D>
SnapshotFileOf<D>::SnapshotFileOf(std::filesystem::path file, std::string engine,
                                  const SceneOf<D>& scene, int samples, int keep)
    : file_(std::move(file)),
      part_(file_.string() + ".part"),
      engine_(std::move(engine)),
      scene_(scene),
      samples_(samples),
      keep_(keep) {}

template <int D>
void SnapshotFileOf<D>::offer(const SnapshotOf<D>& snapshot, int k) {
  // Kept are those with which ⌊k·keep/samples⌋ grows: evenly spaced, the last one among them.
  const auto count = [&](long long n) { return n * keep_ / samples_; };
  if (count(k) == count(k - 1)) return;
  try {
    if (kept_.empty()) begin();
    Hdf5File out = Hdf5File::append(part_);
    writeSnapshot(out, snapshotGroup(kept_.size()), snapshot);
    out.save();
  } catch (const OutputError&) {
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    throw;
  }
  kept_.push_back({snapshot.positionTime, snapshot.spin.has_value()});
}

template <int D>
void SnapshotFileOf<D>::begin() {
  makeDirectory(part_.parent_path());
  std::filesystem::remove(part_);  // of a run that was broken off
  Hdf5File out = Hdf5File::append(part_);
  out.writeAttribute("engine", engine_);
  if (D == 3) out.writeAttribute("dimension", 3.0);
  out.write("/disks/index", countedUp(scene_.disks.size()));
  out.write("/disks/radius", scene_.disks.radius);
  out.write("/disks/mass", scene_.disks.mass);
  out.write("/disks/inertia", scene_.disks.inertia);
  if (!scene_.shapes.empty()) {
    out.write("/disks/shape", scene_.disks.shape);
    writeTurns<D>(out, "/disks/turn", scene_.disks.turn);
    if (D == 3) writeVectors<3>(out, "/disks/moments", scene_.disks.moments);
    std::vector<std::int32_t> kinds;
    for (const ShapeOf<D>& shape : scene_.shapes)
      kinds.push_back(static_cast<std::int32_t>(shape.kind));
    out.write("/shapes/kind", kinds);
  }
  for (std::size_t k = 0; k < scene_.shapes.size(); ++k) {
    const std::string path = fmt::format("/shapes/{}/", k);
    writeVectors<D>(out, path + "vertices", scene_.shapes[k].vertices);
    out.write(path + "rounding", std::vector{scene_.shapes[k].rounding});
  }
  std::vector<double> wallRadius;
  std::vector<std::int32_t> wallBody;
  for (std::size_t b = 0; b < scene_.bodies.size(); ++b) {
    const std::vector<double>& radii = scene_.bodies[b].diskRadius;
    wallRadius.insert(wallRadius.end(), radii.begin(), radii.end());
    wallBody.insert(wallBody.end(), radii.size(), static_cast<std::int32_t>(b));
  }
  out.write("/walls/index", countedUp(wallRadius.size()));
  out.write("/walls/radius", wallRadius);
  out.write("/walls/body", wallBody);
  out.save();
}

/// The XDMF 3 text that describes an HDF5 file of snapshots to ParaView: over time, points with
/// radius, velocity and spin ("disks") and those of the wall disks ("walls").
template <int D>
std::string SnapshotFileOf<D>::xdmf() const {
  const std::string file = file_.filename().string();
  const Items items(file, D);
  std::string text =
      "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n"
      "    <Grid Name=\"snapshots\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const std::string group = snapshotGroup(k);
    text += fmt::format(
        "      <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
        "        <Time Value=\"{}\"/>\n",
        group.substr(1), kept_[k].time);
    text += disksOf<D>(items, group, scene_.disks.size(), kept_[k].spins);
    if (scene_.wallDiskCount() > 0) text += wallsOf(items, group, scene_.wallDiskCount());
    text += "      </Grid>\n";
  }
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

template <int D>
void SnapshotFileOf<D>::close() {
  if (kept_.empty()) return;
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) throw OutputError(file_, error.value());
  std::filesystem::path beside = file_;
  writeFile(beside.replace_extension(".xdmf"), xdmf());
}

template class SnapshotFileOf<2>;
template class SnapshotFileOf<3>;

}  // namespace crossgrain::inline studies
