#include "adapters/files/write_snapshots.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>

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

WrittenParticles::WrittenParticles(const Scene& scene) : scene_(scene), radius_(scene.radii()) {
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    body_.insert(body_.end(), scene.bodies[b].diskRadius.size(), static_cast<std::int32_t>(b));
}

WrittenParticle WrittenParticles::at(const Snapshot& now, std::size_t id) const {
  const std::size_t disks = scene_.disks.size();
  WrittenParticle particle;
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
  particle.velocity = Vec2::Zero();
  if (b < now.bodies.size()) {
    const BodySnapshot& body = now.bodies[b];
    particle.spin = body.angularVelocity;
    particle.velocity =
        body.velocity + body.angularVelocity * perpendicular(particle.position - body.centre);
  }
  if (scene_.materials) particle.material = scene_.materials->ofBody[b];
  return particle;
}

WrittenContact contactAt(const WrittenParticles& particles, const Snapshot& now, std::size_t k) {
  const Contacts& contacts = *now.contacts;
  WrittenContact contact;
  contact.first = static_cast<std::size_t>(contacts.i[k]);
  contact.second = static_cast<std::size_t>(contacts.j[k]);
  contact.normal = contacts.normal[k];
  contact.overlap = contacts.overlap[k];
  contact.normalForce = contacts.normalForce[k];
  contact.tangentialForce = contacts.tangentialForce[k];
  if (!contacts.rollingTorque.empty()) contact.rollingTorque = contacts.rollingTorque[k];
  contact.point = now.position[contact.first] -
                  (particles.radii()[contact.first] - 0.5 * contact.overlap) * contact.normal;
  return contact;
}

std::vector<std::string> notInFormats(const Snapshot& now, bool rolling) {
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

std::unique_ptr<SnapshotWriter> openWriter(std::string_view format,
                                           const std::filesystem::path& out, const Scene& scene,
                                           const WrittenBox& box) {
  if (format == "mercurydpm") return openMercuryDpm(out, scene, box);
  if (format == "lammps") return openLammps(out, scene, box);
  if (format == "ondem") return openOnDem(out, scene, box);
  throw BadInput(fmt::format("there is no format \"{}\" to write; there are {}", format,
                             fmt::join(writtenFormats(), ", ")));
}

}  // namespace crossgrain::files
