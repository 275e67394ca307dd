#include "adapters/files/write_snapshots.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>

#include "adapters/files/file_units.hpp"
#include "adapters/files/write_parts.hpp"
#include "support/bad_input.hpp"
#include "support/files.hpp"

namespace crossgrain::files {

TextOutput::TextOutput(std::filesystem::path file)
    : file_(std::move(file)), part_(file_.string() + ".part") {
  if (file_.has_parent_path()) makeDirectory(file_.parent_path());
  stream_ = std::fopen(part_.c_str(), "wb");
  if (!stream_) throw OutputError(part_, errno);
}

TextOutput::~TextOutput() {
  if (!stream_) return;
  std::fclose(stream_);
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void TextOutput::flush() {
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), stream_) != buffer_.size())
    throw OutputError(part_, errno);
  buffer_.clear();
}

void TextOutput::close() {
  flush();
  if (std::fclose(std::exchange(stream_, nullptr)) != 0) throw OutputError(part_, errno);
  std::error_code error;
  std::filesystem::rename(part_, file_, error);
  if (error) throw OutputError(file_, error.value());
}

template <int D>
WrittenParticlesOf<D>::WrittenParticlesOf(const SceneOf<D>& scene)
    : scene_(scene), radius_(scene.radii()) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    body_.insert(body_.end(), scene.bodies[b].diskRadius.size(), static_cast<std::int32_t>(b));
}

template <int D>
WrittenParticleOf<D> WrittenParticlesOf<D>::at(const SnapshotOf<D>& now, std::size_t id) const {
  const std::size_t disks = scene_.disks.size();
  WrittenParticleOf<D> particle;
  particle.radius = radius_[id];
  if (id < disks) {
    particle.position = now.position[id];
    particle.velocity = now.velocity[id];
    if (now.spin) particle.spin = (*now.spin)[id];
    particle.mass = scene_.disks.mass[id];
    if (scene_.materials) particle.material = scene_.materials->ofDisk[id];
    return particle;
  }
  particle.body = body_[id - disks];
  const auto b = static_cast<std::size_t>(particle.body);
  particle.position = now.wallPosition[id - disks];
  particle.velocity = VecOf<D>::Zero();
  if (b < now.bodies.size()) {
    particle.spin = now.bodies[b].angularVelocity;
    particle.velocity = memberVelocity<D>(stateOf(now.bodies[b]), particle.position);
  }
  if (scene_.materials) particle.material = scene_.materials->ofBody[b];
  return particle;
}
template class WrittenParticlesOf<2>;
template class WrittenParticlesOf<3>;

template <int D>
WrittenContactOf<D> contactAt(const WrittenParticlesOf<D>& particles, const SnapshotOf<D>& now,
                              std::size_t k) {
  const ContactsOf<D>& contacts = *now.contacts;
  WrittenContactOf<D> contact;
  contact.first = static_cast<std::size_t>(contacts.i[k]);
  contact.second = static_cast<std::size_t>(contacts.j[k]);
  contact.normal = contacts.normal[k];
  contact.overlap = contacts.overlap[k];
  contact.normalForce = contacts.normalForce[k];
  contact.tangentialForce = contacts.tangentialForce[k];
  if (!contacts.rollingTorque.empty()) contact.rollingTorque = contacts.rollingTorque[k];
  contact.point =
      particles.areRound()
          ? now.position[contact.first] -
                (particles.radii()[contact.first] - 0.5 * contact.overlap) * contact.normal
          : contacts.point[k];
  return contact;
}
template WrittenContactOf<2> contactAt(const WrittenParticles&, const Snapshot&, std::size_t);
template WrittenContactOf<3> contactAt(const WrittenParticlesOf<3>&, const SpaceSnapshot&,
                                       std::size_t);

template <int D>
std::vector<std::string> notInFormats(const SnapshotOf<D>& now, bool rolling) {
  std::vector<std::string> lines;
  if (now.velocityTime != now.positionTime || now.contactTime != now.positionTime)
    lines.push_back(
        fmt::format("times: files state that of positions; velocities are of {:+g} s, contacts of "
                    "{:+g} s from there",
                    now.velocityTime - now.positionTime, now.contactTime - now.positionTime));
  if (now.contactInterval > 0.0)
    lines.push_back(fmt::format("forces: they are means over the {:g} s before that time",
                                now.contactInterval));
  if (!now.spin) lines.emplace_back("spins: the snapshots have none; files have 0");
  if (!now.contacts) {
    lines.emplace_back("contacts: the snapshots have none");
    return lines;
  }
  if (!rolling && !now.contacts->rollingTorque.empty())
    lines.emplace_back("rolling torques: no place for them");
  if (!now.contacts->dissipation.empty())
    lines.emplace_back("dissipation of contacts: no place for it");
  return lines;
}
template std::vector<std::string> notInFormats(const Snapshot&, bool);
template std::vector<std::string> notInFormats(const SpaceSnapshot&, bool);

std::vector<std::string_view> writtenFormats() {
  return {"mercurydpm", "lammps", "ondem"};
}

std::vector<std::filesystem::path> writtenFiles(std::string_view format,
                                                const std::filesystem::path& out,
                                                std::size_t snapshots) {
  const std::string name = out.string();
  if (format == "mercurydpm") return {name + ".data", name + ".fstat", name + ".restart"};
  if (format == "lammps") return {name + ".dump", name + ".contacts"};
  std::vector<std::filesystem::path> files;
  for (std::size_t k = 0; k < snapshots; ++k)
    files.emplace_back(fmt::format("{}-{:03d}.vtkhdf", name, k));
  return files;
}

namespace {

/// Bodies that are neither disks nor spheres: of space boxes, in one format.
template <int D>
void requireShapes(std::string_view format, const SceneOf<D>& scene) {
  const bool boxes = D == 3 && format == "ondem";
  for (const ShapeOf<D>& shape : scene.shapes)
    if (!boxes || shape.kind != ShapeKind::box)
      throw BadInput(fmt::format(
          "format {}: has no {}, as {} has; the snapshots themselves are HDF5, docs/files.md",
          format, toString(shape.kind), scene.name));
}

/// Periodic along z, as LAMMPS' own boxes of two dimensions are.
FileBox dumpedBox(const Scene& scene, const WrittenBox& box) {
  FileBox made{{box.low.x(), box.low.y(), -0.5 * box.height},
               {box.high.x(), box.high.y(), 0.5 * box.height},
               {false, false, true}};
  for (int k = 0; scene.box && k < 2; ++k) {
    made.low[k] = scene.box->low[k];
    made.high[k] = scene.box->high[k];
    made.periodic[k] = scene.box->periodic[static_cast<std::size_t>(k)];
  }
  return made;
}

}  // namespace

std::unique_ptr<SnapshotWriter> openWriter(std::string_view format,
                                           const std::filesystem::path& out, const Scene& scene,
                                           const WrittenBox& box) {
  requireShapes(format, scene);
  if (format == "mercurydpm") return openMercuryDpm(out, scene, box);
  if (format == "lammps") return openLammps<2>(out, scene, dumpedBox(scene, box));
  if (format == "ondem") return openOnDem<2>(out, scene, box.height);
  throw BadInput(fmt::format("there is no format \"{}\" to write; there are {}", format,
                             fmt::join(writtenFormats(), ", ")));
}

std::unique_ptr<SnapshotWriterOf<3>> openWriter(std::string_view format,
                                                const std::filesystem::path& out,
                                                const SpaceScene& scene, const BoxOf<3>& box) {
  if (scene.cylinderCount() > 0)
    throw BadInput(
        fmt::format("format {}: has no cylinders, as the walls of {} are; the snapshots "
                    "themselves are HDF5, docs/files.md",
                    format, scene.name));
  requireShapes(format, scene);
  if (format == "ondem") return openOnDem<3>(out, scene, 0.0);
  if (format == "lammps") return openLammps<3>(out, scene, boxInFiles(box, {}));
  throw BadInput(fmt::format(
      "format {}: snapshots in space (case.dimension = 3) are written as lammps and ondem alone",
      format));
}

}  // namespace crossgrain::files
