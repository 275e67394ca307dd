// MercuryDPM's .data and .fstat, as its DPMBase::outputXBallsData() and
// BaseInteraction::writeToFStat() write them and its tool MercuryCG reads them: of three
// dimensions, since that tool knows no others. Rows count from 0: disks, then wall disks.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapters/files/write_parts.hpp"

namespace crossgrain::files {
namespace {

class MercuryDpmWriter : public SnapshotWriter {
 public:
  MercuryDpmWriter(const std::filesystem::path& out, const Scene& scene, const WrittenBox& box)
      : scene_(scene),
        particles_(scene),
        box_(box),
        name_(out.filename().string()),
        data_(out.string() + ".data"),
        fstat_(out.string() + ".fstat"),
        restart_(out.string() + ".restart") {
    sortSpecies();
  }

  void write(const Snapshot& now) override {
    if (count_++ == 0) {
      notWritten_ = notInFormats(now);
      writeRestart(now);
    }
    writeData(now);
    writeForces(now);
  }

  void close() override {
    data_.close();
    fstat_.close();
    restart_.close();
  }

  std::vector<std::string> notWritten() const override {
    std::vector<std::string> lines = notWritten_;
    lines.emplace_back("lengths of tangential springs: the snapshots have none; files have 0");
    if (oneDensity_)
      lines.push_back(fmt::format(
          "masses: disks are of more than {} densities; files have the mean of them", mostSpecies));
    return lines;
  }

 private:
  /// A species has a density alone; MercuryDPM keeps no masses.
  static constexpr std::size_t mostSpecies = 50;  // every two of them have a line

  /// Density of a disk, of which MercuryDPM makes its mass: m/πR² [kg/m²].
  double densityOf(std::size_t disk) const {
    const double radius = scene_.disks.radius[disk];
    return scene_.disks.mass[disk] / (std::numbers::pi * radius * radius);
  }

  /// Disks of one density are of one species, and wall disks of the first.
  void sortSpecies() {
    species_.assign(particles_.size(), 0);
    constexpr double rounding = 1e-12;
    for (std::size_t i = 0; i < scene_.disks.size(); ++i) {
      const double density = densityOf(i);
      const auto found = std::ranges::find_if(
          density_, [&](double known) { return std::abs(known - density) <= rounding * density; });
      species_[i] = static_cast<std::size_t>(found - density_.begin());
      if (found != density_.end()) continue;
      density_.push_back(density);
      if (density_.size() <= mostSpecies) continue;
      oneDensity_ = true;
      break;
    }
    if (!oneDensity_) return;
    species_.assign(particles_.size(), 0);
    double mass = 0.0, area = 0.0;
    for (std::size_t i = 0; i < scene_.disks.size(); ++i) {
      mass += scene_.disks.mass[i];
      area += std::numbers::pi * scene_.disks.radius[i] * scene_.disks.radius[i];
    }
    density_ = {mass / area};
  }

  /// Writes all that MercuryCG reads from it: densities, and which particles are fixed (no inverse
  /// mass). The stiffnesses have no effect.
  void writeRestart(const Snapshot& now) {
    const double z = 0.5 * box_.height;
    restart_.print("MercuryDPM 1.0 name {}\n", name_);
    for (const char* file : {"dataFile", "fStatFile", "eneFile", "restartFile", "statFile"})
      restart_.print("{:<11} fileType ONE_FILE saveCount 1 counter 0\n", file);
    restart_.print("interactionFile fileType NO_FILE saveCount 0 counter 0\n");
    restart_.print("xMin {} xMax {} yMin {} yMax {} zMin {} zMax {}\n", box_.low.x(), box_.high.x(),
                   box_.low.y(), box_.high.y(), -z, z);
    restart_.print("timeStep 1 time {} ntimeSteps 0 timeMax {}\n", now.positionTime,
                   now.positionTime);
    restart_.print("systemDimensions 3 particleDimensions 2 gravity {} {} 0 backgroundDrag 0\n",
                   scene_.gravity.x(), scene_.gravity.y());
    restart_.print("Species {}\n", density_.size());
    for (std::size_t a = 0; a < density_.size(); ++a) {
      restart_.print("LinearViscoelasticSpecies id {} density {} stiffness 1 dissipation 0\n", a,
                     density_[a]);
      for (std::size_t b = 0; b < a; ++b)
        restart_.print("LinearViscoelasticMixedSpecies idA {} idB {} stiffness 1 dissipation 0\n",
                       a, b);
    }
    restart_.print("Walls 0\nBoundaries 0\nParticles {}\n", particles_.size());
    for (std::size_t id = 0; id < particles_.size(); ++id) {
      const WrittenParticle p = particles_.at(now, id);
      restart_.print(
          "SphericalParticle id {} indSpecies {} position {} {} 0 orientation 1 0 0 0 velocity {} "
          "{} "
          "0 angularVelocity 0 0 {} force 0 0 0 torque 0 0 0 radius {} invMass {} timeStamp 0\n",
          id, species_[id], p.position.x(), p.position.y(), p.velocity.x(), p.velocity.y(), p.spin,
          p.radius, p.mass ? 1.0 / *p.mass : 0.0);
    }
    restart_.print("Interactions 0\n");
  }

  /// One row: place, velocity, radius, three angles (the snapshots have none), angular velocity,
  /// species.
  void writeData(const Snapshot& now) {
    const double z = 0.5 * box_.height;
    data_.print("{} {} {} {} {} {} {} {}\n", particles_.size(), now.positionTime, box_.low.x(),
                box_.low.y(), -z, box_.high.x(), box_.high.y(), z);
    for (std::size_t id = 0; id < particles_.size(); ++id) {
      const WrittenParticle p = particles_.at(now, id);
      data_.print("{} {} 0 {} {} 0 {} 0 0 0 0 0 {} {}\n", p.position.x(), p.position.y(),
                  p.velocity.x(), p.velocity.y(), p.radius, p.spin, species_[id]);
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
  std::string name_;
  TextOutput data_, fstat_, restart_;
  std::vector<double> density_;       ///< of each species [kg/m²]
  std::vector<std::size_t> species_;  ///< of each particle
  bool oneDensity_ = false;           ///< where there are too many
  std::size_t count_ = 0;
  std::vector<std::string> notWritten_;
};

}  // namespace

std::unique_ptr<SnapshotWriter> openMercuryDpm(const std::filesystem::path& out, const Scene& scene,
                                               const WrittenBox& box) {
  return std::make_unique<MercuryDpmWriter>(out, scene, box);
}

}  // namespace crossgrain::files
