// LAMMPS' text dumps, as DumpCustom and DumpLocal write them (29 Sep 2021) for
//   dump d all custom … id type x y z radius mass vx vy vz omegax omegay omegaz f_w0[1] … f_w0[8] …
//   compute p all property/local patom1 patom2
//   compute q all pair/local force p1 p2 p3 p4 p5 p6 p7 p8 p9 p10 p11 p12   (pair_style granular)
//   dump c all local … index c_p[1] c_p[2] c_q[1] … c_q[13]
// and dump_modify units yes time yes: f_wK is a `fix wall/gran … contacts`, one for each plane.
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <vector>

#include "adapters/audit_geometry.hpp"
#include "adapters/files/write_parts.hpp"

namespace crossgrain::files {
namespace {

/// Components along x, y and z, 0 for −0; the plane of motion is z = 0.
template <int D>
Vec3 inSpace(const VecOf<D>& v) {
  Vec3 three = Vec3::Zero();
  three.head<D>() += v;
  return three;
}

Vec3 tangentialForce(const WrittenContact& contact) {
  return inSpace<2>(contact.tangentialForce * contact.tangent());
}
Vec3 tangentialForce(const WrittenContactOf<3>& contact) {
  return inSpace<3>(contact.tangentialForce);
}

/// The rolling pseudo-force f, of which R* n × f is the torque M: f = M × n/R*.
/// @param rolling  M/R*
Vec3 pseudoForce(const WrittenContact& contact, double rolling) {
  return inSpace<2>(rolling * contact.tangent());
}
Vec3 pseudoForce(const WrittenContactOf<3>& contact, const Vec3& rolling) {
  return inSpace<3>(rolling.cross(contact.normal));
}

template <int D>
class LammpsWriter : public SnapshotWriterOf<D> {
 public:
  LammpsWriter(const std::filesystem::path& out, const SceneOf<D>& scene, const FileBox& box)
      : scene_(scene),
        particles_(scene),
        box_(box),
        atoms_(out.string() + ".dump"),
        local_(out.string() + ".contacts") {}

  void write(const SnapshotOf<D>& now) override {
    if (count_ == 0) notWritten_ = notInFormats(now, /*rolling=*/true);
    // Contacts of pairs, and those with planes by plane and disk.
    std::vector<WrittenContactOf<D>> pairs, walls;
    for (std::size_t k = 0; now.contacts && k < now.contacts->size(); ++k) {
      const WrittenContactOf<D> contact = contactAt(particles_, now, k);
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
  void writeHead(TextOutput& out, const SnapshotOf<D>& now, const char* what,
                 std::size_t count) const {
    if (count_ == 0) out.print("ITEM: UNITS\nsi\n");
    out.print("ITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF {}\n{}\n", now.positionTime,
              count_, what, count);
    out.print("ITEM: BOX BOUNDS");
    for (const bool periodic : box_.periodic) out.print(" {}", periodic ? "pp" : "ff");
    out.print("\n");
    for (int k = 0; k < 3; ++k) out.print("{} {}\n", box_.low[k], box_.high[k]);
  }

  /// Ids count from 1. Type 1 (of several materials: 1, 2, …) are disks, the next ones the wall
  /// disks of one body each.
  void writeAtoms(const SnapshotOf<D>& now, const std::vector<WrittenContactOf<D>>& walls) {
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
      const WrittenParticleOf<D> p = particles_.at(now, id);
      const std::size_t type = 1 + (p.mass ? static_cast<std::size_t>(p.material)
                                           : materials + static_cast<std::size_t>(p.body));
      if constexpr (D == 2)
        atoms_.print("{} {} {} {} 0 {} {} {} {} 0 0 0 {}", id + 1, type, p.position.x(),
                     p.position.y(), p.radius, p.mass.value_or(0.0), p.velocity.x(), p.velocity.y(),
                     p.spin);
      else
        atoms_.print("{} {} {} {} {} {} {}", id + 1, type, fmt::join(p.position, " "), p.radius,
                     p.mass.value_or(0.0), fmt::join(p.velocity, " "), fmt::join(p.spin, " "));
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
  void writePlane(const WrittenContactOf<D>& contact, double radius) {
    const Vec3 normal = inSpace<D>(contact.normal);
    const Vec3 force = inSpace<3>(contact.normalForce * normal + tangentialForce(contact));
    const Vec3 point = inSpace<D>(contact.point + 0.5 * contact.overlap * contact.normal);
    atoms_.print(" 1 {} {} {}", fmt::join(force, " "), fmt::join(point, " "), radius);
  }

  /// force > 0 repels; p1 to p3 the tangential force on patom1, p4 its size; p5 to p7 the rolling
  /// pseudo-force f, of which R* n × f is the torque on patom1, 1/R* = 1/R_i + 1/R_j, p8 its size;
  /// p9 the twisting torque; p10 to p12 from patom2 to patom1.
  void writePairs(const SnapshotOf<D>& now, const std::vector<WrittenContactOf<D>>& pairs) {
    writeHead(local_, now, "ENTRIES", pairs.size());
    local_.print("ITEM: ENTRIES index c_p[1] c_p[2]");
    for (int column = 1; column <= 13; ++column) local_.print(" c_q[{}]", column);
    local_.print("\n");
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      const WrittenContactOf<D>& contact = pairs[c];
      const double ri = particles_.radii()[contact.first], rj = particles_.radii()[contact.second];
      const SpinOf<D> rolling = contact.rollingTorque * (ri + rj) / (ri * rj);
      VecOf<D> branch =
          particles_.at(now, contact.first).position - particles_.at(now, contact.second).position;
      if (scene_.box) branch = scene_.box->nearest(branch);
      local_.print("{} {} {} {} {} {} {} {} 0 {}\n", c + 1, contact.first + 1, contact.second + 1,
                   contact.normalForce, fmt::join(tangentialForce(contact), " "),
                   sizeOf(contact.tangentialForce), fmt::join(pseudoForce(contact, rolling), " "),
                   sizeOf(rolling), fmt::join(inSpace<D>(branch), " "));
    }
  }

  const SceneOf<D>& scene_;
  WrittenParticlesOf<D> particles_;
  FileBox box_;
  TextOutput atoms_, local_;
  std::size_t count_ = 0;
  std::vector<std::string> notWritten_;
};

}  // namespace

template <int D>
std::unique_ptr<SnapshotWriterOf<D>> openLammps(const std::filesystem::path& out,
                                                const SceneOf<D>& scene, const FileBox& box) {
  return std::make_unique<LammpsWriter<D>>(out, scene, box);
}
template std::unique_ptr<SnapshotWriter> openLammps(const std::filesystem::path&, const Scene&,
                                                    const FileBox&);
template std::unique_ptr<SnapshotWriterOf<3>> openLammps(const std::filesystem::path&,
                                                         const SpaceScene&, const FileBox&);

}  // namespace crossgrain::files
