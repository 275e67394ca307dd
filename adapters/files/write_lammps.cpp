// LAMMPS' text dumps, as DumpCustom and DumpLocal write them (29 Sep 2021) for
//   dump d all custom … id type x y z radius mass vx vy vz omegax omegay omegaz f_w0[1] … f_w0[8] …
//   compute p all property/local patom1 patom2
//   compute q all pair/local force p1 p2 p3 p4 p5 p6 p7 p8 p9 p10 p11 p12   (pair_style granular)
//   dump c all local … index c_p[1] c_p[2] c_q[1] … c_q[13]
// and dump_modify units yes time yes: f_wK is a `fix wall/gran … contacts`, one for each plane.
#include <cmath>
#include <vector>

#include "adapters/files/write_parts.hpp"

namespace crossgrain::files {
namespace {

class LammpsWriter : public SnapshotWriter {
 public:
  LammpsWriter(const std::filesystem::path& out, const Scene& scene, const WrittenBox& box)
      : scene_(scene),
        particles_(scene),
        box_(box),
        atoms_(out.string() + ".dump"),
        local_(out.string() + ".contacts") {}

  void write(const Snapshot& now) override {
    if (count_ == 0) notWritten_ = notInFormats(now, /*rolling=*/true);
    // Contacts of pairs, and those with planes by plane and disk.
    std::vector<WrittenContact> pairs, walls;
    for (std::size_t k = 0; now.contacts && k < now.contacts->size(); ++k) {
      const WrittenContact contact = contactAt(particles_, now, k);
      (contact.second < particles_.size() ? pairs : walls).push_back(contact);
    }
    writeAtoms(now, walls);
    writePairs(now, pairs);
    ++count_;
  }

  void close() override {
    atoms_.close();
    local_.close();
  }

  std::vector<std::string> notWritten() const override {
    std::vector<std::string> lines = notWritten_;
    lines.emplace_back("numbers of steps: the snapshots have none; TIMESTEP counts snapshots");
    if (scene_.wallDiskCount() > 0)
      lines.emplace_back("masses of wall disks: there are none; files have 0");
    return lines;
  }

 private:
  void writeHead(TextOutput& out, const Snapshot& now, const char* what, std::size_t count) const {
    if (count_ == 0) out.print("ITEM: UNITS\nsi\n");
    out.print("ITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF {}\n{}\n", now.positionTime,
              count_, what, count);
    out.print("ITEM: BOX BOUNDS ff ff pp\n{} {}\n{} {}\n{} {}\n", box_.low.x(), box_.high.x(),
              box_.low.y(), box_.high.y(), -0.5 * box_.height, 0.5 * box_.height);
  }

  /// Ids count from 1. Type 1 (of several materials: 1, 2, …) are disks, the next ones the wall
  /// disks of one body each.
  void writeAtoms(const Snapshot& now, const std::vector<WrittenContact>& walls) {
    writeHead(atoms_, now, "ATOMS", particles_.size());
    atoms_.print("ITEM: ATOMS id type x y z radius mass vx vy vz omegax omegay omegaz");
    const std::size_t planes = scene_.planeCount();
    for (std::size_t w = 0; w < planes; ++w)
      for (int column = 1; column <= 8; ++column) atoms_.print(" f_w{}[{}]", w, column);
    atoms_.print("\n");
    const std::size_t materials = scene_.materials ? scene_.materials->names.size() : 1;
    // Where a disk's contact with a plane is among `walls`, + 1.
    std::vector<std::size_t> place(planes * scene_.disks.size(), 0);
    for (std::size_t c = 0; c < walls.size(); ++c)
      place[walls[c].first * planes + walls[c].second - particles_.size()] = c + 1;
    for (std::size_t id = 0; id < particles_.size(); ++id) {
      const WrittenParticle p = particles_.at(now, id);
      const std::size_t type = 1 + (p.mass ? static_cast<std::size_t>(p.material)
                                           : materials + static_cast<std::size_t>(p.body));
      atoms_.print("{} {} {} {} 0 {} {} {} {} 0 0 0 {}", id + 1, type, p.position.x(),
                   p.position.y(), p.radius, p.mass.value_or(0.0), p.velocity.x(), p.velocity.y(),
                   p.spin);
      for (std::size_t w = 0; w < planes; ++w) {
        const std::size_t c = p.mass ? place[id * planes + w] : 0;
        if (c == 0)
          atoms_.print(" 0 0 0 0 0 0 0 0");
        else
          writePlane(walls[c - 1], p.radius);
      }
      atoms_.print("\n");
    }
  }

  /// 1, force of the wall on the disk, where the plane is touched, radius.
  void writePlane(const WrittenContact& contact, double radius) {
    const Vec2 force = unsignedZeros(contact.normalForce * contact.normal +
                                     contact.tangentialForce * contact.tangent());
    const Vec2 point = contact.point + 0.5 * contact.overlap * contact.normal;
    atoms_.print(" 1 {} {} 0 {} {} 0 {}", force.x(), force.y(), point.x(), point.y(), radius);
  }

  /// force > 0 repels; p1 to p3 the tangential force on patom1, p4 its size; p5 to p7 the rolling
  /// pseudo-force f, of which R* n × f is the torque on patom1, 1/R* = 1/R_i + 1/R_j, p8 its size;
  /// p9 the twisting torque; p10 to p12 from patom2 to patom1.
  void writePairs(const Snapshot& now, const std::vector<WrittenContact>& pairs) {
    writeHead(local_, now, "ENTRIES", pairs.size());
    local_.print("ITEM: ENTRIES index c_p[1] c_p[2]");
    for (int column = 1; column <= 13; ++column) local_.print(" c_q[{}]", column);
    local_.print("\n");
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      const WrittenContact& contact = pairs[c];
      const double ri = particles_.radii()[contact.first], rj = particles_.radii()[contact.second];
      const double rolling = contact.rollingTorque * (ri + rj) / (ri * rj);
      const Vec2 force = unsignedZeros(contact.tangentialForce * contact.tangent()),
                 pseudo = unsignedZeros(rolling * contact.tangent());
      const Vec2 branch =
          particles_.at(now, contact.first).position - particles_.at(now, contact.second).position;
      local_.print("{} {} {} {} {} {} 0 {} {} {} 0 {} 0 {} {} 0\n", c + 1, contact.first + 1,
                   contact.second + 1, contact.normalForce, force.x(), force.y(),
                   std::abs(contact.tangentialForce), pseudo.x(), pseudo.y(), std::abs(rolling),
                   branch.x(), branch.y());
    }
  }

  const Scene& scene_;
  WrittenParticles particles_;
  WrittenBox box_;
  TextOutput atoms_, local_;
  std::size_t count_ = 0;
  std::vector<std::string> notWritten_;
};

}  // namespace

std::unique_ptr<SnapshotWriter> openLammps(const std::filesystem::path& out, const Scene& scene,
                                           const WrittenBox& box) {
  return std::make_unique<LammpsWriter>(out, scene, box);
}

}  // namespace crossgrain::files
