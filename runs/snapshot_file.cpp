#include "runs/snapshot_file.hpp"

#include <fmt/format.h>

#include "cases/hdf5_file.hpp"

namespace crossgrain {
namespace {

void writeVectors(Hdf5File& out, const std::string& path, const std::vector<Vec2>& values) {
  out.write(path, values.empty() ? nullptr : values.front().data(), values.size(), 2);
}

void writeContacts(Hdf5File& out, const std::string& path, const Contacts& contacts) {
  out.write(path + "/i", contacts.i);
  out.write(path + "/j", contacts.j);
  writeVectors(out, path + "/normal", contacts.normal);
  out.write(path + "/overlap", contacts.overlap);
  out.write(path + "/normal_force", contacts.normalForce);
  out.write(path + "/tangential_force", contacts.tangentialForce);
}

}  // namespace

SnapshotFile::SnapshotFile(std::filesystem::path file, const Scene& scene, int samples, int keep)
    : file_(std::move(file)), scene_(scene), samples_(samples), keep_(keep) {}

void SnapshotFile::offer(const Snapshot& snapshot, int k) {
  // Kept are those with which ⌊k·keep/samples⌋ grows: evenly spaced, the last one among them.
  const auto count = [&](long long n) { return n * keep_ / samples_; };
  if (count(k) > count(k - 1)) kept_.push_back(snapshot);
}

void SnapshotFile::close() {
  if (kept_.empty()) return;
  Hdf5File out = Hdf5File::create(file_);
  out.write("/disks/radius", scene_.disks.radius);
  out.write("/disks/mass", scene_.disks.mass);
  out.write("/disks/inertia", scene_.disks.inertia);
  std::vector<double> wallRadius;
  for (const WallBody& body : scene_.bodies)
    wallRadius.insert(wallRadius.end(), body.diskRadius.begin(), body.diskRadius.end());
  out.write("/walls/radius", wallRadius);
  for (std::size_t k = 0; k < kept_.size(); ++k) {
    const Snapshot& now = kept_[k];
    const std::string group = fmt::format("/snapshot-{:03d}", k);
    out.write(group + "/time", std::vector{now.positionTime, now.velocityTime, now.contactTime,
                                           now.contactInterval});
    writeVectors(out, group + "/position", now.position);
    writeVectors(out, group + "/velocity", now.velocity);
    if (now.spin) out.write(group + "/spin", *now.spin);
    writeVectors(out, group + "/wall_position", now.wallPosition);
    if (now.contacts) writeContacts(out, group + "/contacts", *now.contacts);
  }
  out.save();
}

}  // namespace crossgrain
