// MercuryDPM's .data and .fstat, as its DPMBase::outputXBallsData() and
// BaseInteraction::writeToFStat() write them and its tool MercuryCG reads them: of three
// dimensions, since that tool knows no others. Rows count from 0: disks, then wall disks.
#include <algorithm>
#include <cmath>

#include "adapters/files/write_parts.hpp"

namespace crossgrain::files {
namespace {

class MercuryDpmWriter : public SnapshotWriter {
 public:
  MercuryDpmWriter(const std::filesystem::path& out, const Scene& scene, const WrittenBox& box)
      : scene_(scene),
        particles_(scene),
        box_(box),
        data_(out.string() + ".data"),
        fstat_(out.string() + ".fstat") {}

  void write(const Snapshot& now) override {
    if (count_++ == 0) notWritten_ = notInFormats(now);
    writeData(now);
    writeForces(now);
  }

  void close() override {
    data_.close();
    fstat_.close();
  }

  std::vector<std::string> notWritten() const override {
    std::vector<std::string> lines = notWritten_;
    lines.emplace_back("lengths of tangential springs: the snapshots have none; files have 0");
    lines.emplace_back(
        "masses, and which particles are fixed: MercuryDPM has them in NAME.restart; MercuryCG "
        "without one takes a density of 1 and every particle for a free sphere");
    return lines;
  }

 private:
  /// One row: place, velocity, radius, three angles (the snapshots have none), angular velocity,
  /// species.
  void writeData(const Snapshot& now) {
    const double z = 0.5 * box_.height;
    data_.print("{} {} {} {} {} {} {} {}\n", particles_.size(), now.positionTime, box_.low.x(),
                box_.low.y(), -z, box_.high.x(), box_.high.y(), z);
    for (std::size_t id = 0; id < particles_.size(); ++id) {
      const WrittenParticle p = particles_.at(now, id);
      data_.print("{} {} 0 {} {} 0 {} 0 0 0 0 0 {} {}\n", p.position.x(), p.position.y(),
                  p.velocity.x(), p.velocity.y(), p.radius, p.spin, p.material);
    }
  }

  void writeForces(const Snapshot& now) {
    const double z = 0.5 * box_.height;
    const std::vector<double>& radii = particles_.radii();
    const double least = radii.empty() ? 0.0 : std::ranges::min(radii);
    const double most = radii.empty() ? 0.0 : std::ranges::max(radii);
    // The 1 says that points are where bodies touch; they were centres once.
    fstat_.print("# {} 1\n# {} {} {} {} {} {}\n# {} {} 0 0 0 0\n", now.positionTime, box_.low.x(),
                 box_.low.y(), -z, box_.high.x(), box_.high.y(), z, least, most);
    if (!now.contacts) return;
    for (std::size_t k = 0; k < now.contacts->size(); ++k) {
      const WrittenContact contact = contactAt(particles_, now, k);
      const auto first = static_cast<std::ptrdiff_t>(contact.first);
      const auto second = static_cast<std::ptrdiff_t>(contact.second);
      const auto particles = static_cast<std::ptrdiff_t>(particles_.size());
      if (second >= particles) {
        // Of walls the normal and the tangent are flipped: the force on the particle is
        // −(F_n n + F_t t).
        writeForce(now.positionTime, first, particles - second - 1, contact, -1.0);
        continue;
      }
      writeForce(now.positionTime, first, second, contact, 1.0);
      // Of two free bodies once more, from the other's side; a fixed partner has no line.
      if (contact.second < scene_.disks.size())
        writeForce(now.positionTime, second, first, contact, -1.0);
    }
  }

  /// t i j, point, δ, δ_t, F_n F_t, n, t.
  void writeForce(double time, std::ptrdiff_t i, std::ptrdiff_t j, const WrittenContact& contact,
                  double side) {
    const double size = std::abs(contact.tangentialForce);
    const Vec2 n = unsignedZeros(side * contact.normal);
    const double sense = size > 0.0 ? std::copysign(side, side * contact.tangentialForce) : 0.0;
    const Vec2 t = unsignedZeros(sense * contact.tangent());
    fstat_.print("{} {} {} {} {} 0 {} 0 {} {} {} {} 0 {} {} 0\n", time, i, j, contact.point.x(),
                 contact.point.y(), contact.overlap, contact.normalForce, size, n.x(), n.y(), t.x(),
                 t.y());
  }

  const Scene& scene_;
  WrittenParticles particles_;
  WrittenBox box_;
  TextOutput data_, fstat_;
  std::size_t count_ = 0;
  std::vector<std::string> notWritten_;
};

}  // namespace

std::unique_ptr<SnapshotWriter> openMercuryDpm(const std::filesystem::path& out, const Scene& scene,
                                               const WrittenBox& box) {
  return std::make_unique<MercuryDpmWriter>(out, scene, box);
}

}  // namespace crossgrain::files
