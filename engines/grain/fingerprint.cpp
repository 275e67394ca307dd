#include "engines/grain/fingerprint.hpp"

#include <cstddef>

#include "engines/grain/spheres.hpp"
#include "law/law_options.hpp"

namespace grain {
namespace {

class Fnv1a {
 public:
  void add(std::uint64_t bits) {
    for (int byte = 0; byte < 8; ++byte) {
      hash_ = (hash_ ^ ((bits >> (8 * byte)) & 0xff)) * 0x100000001b3u;
    }
  }
  void add(double value) { add(__builtin_bit_cast(std::uint64_t, value)); }
  template <class... Values>
  void addAll(const Values&... values) {
    (add(static_cast<double>(values)), ...);
  }
  void add(const std::vector<double>& values) {
    add(static_cast<std::uint64_t>(values.size()));
    for (const double value : values) add(value);
  }
  void add(const std::vector<Vec3<double>>& values) {
    add(static_cast<std::uint64_t>(values.size()));
    for (const Vec3<double>& v : values) addAll(v.x, v.y, v.z);
  }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

/// Adds all of the law's table that bears on this law.
void add(Fnv1a& to, const ContactLaw& law) {
  for (const crossgrain::LawOption& option : crossgrain::lawOptions())
    if (crossgrain::hasPart(law, option.part) && crossgrain::mattersTo(law, option.name))
      to.addAll(option.get(law));
  for (const crossgrain::LawConstant& constant : crossgrain::lawConstants())
    if (crossgrain::hasPart(law, constant.part)) to.addAll(law.*constant.value);
}

void add(Fnv1a& to, const Wall& wall) {
  for (const auto* values : {&wall.diskX, &wall.diskY, &wall.diskRadius}) to.add(*values);
  to.add(static_cast<std::uint64_t>(wall.planes.size()));
  for (const Plane& plane : wall.planes) to.addAll(plane.x, plane.y, plane.nx, plane.ny);
  to.addAll(wall.moves);
}

void addLaws(Fnv1a& to, const ContactLaw& common, const std::optional<Materials>& materials) {
  add(to, common);
  if (!materials) return;
  for (const ContactLaw& law : materials->laws) add(to, law);
  for (const auto* list : {&materials->ofDisk, &materials->ofWall})
    for (const std::int32_t material : *list) to.addAll(material);
}

}  // namespace

std::uint64_t fingerprint(const Setup& setup) {
  Fnv1a to;
  const Disks& disks = setup.disks;
  for (const auto* values : {&disks.x, &disks.y, &disks.vx, &disks.vy, &disks.spin, &disks.radius,
                             &disks.mass, &disks.inertia})
    to.add(*values);
  to.add(static_cast<std::uint64_t>(setup.walls.size()));
  for (const Wall& wall : setup.walls) add(to, wall);
  addLaws(to, setup.law, setup.materials);
  to.addAll(setup.bottom.has_value());
  if (const auto& plate = setup.bottom)
    to.addAll(plate->mu, plate->kb, plate->gb, plate->tauM, plate->gravity, plate->spin);
  to.addAll(setup.gravityX, setup.gravityY, setup.dt, setup.rotation,
            static_cast<int>(setup.precision));
  return to.hash();
}

std::uint64_t fingerprint(const SpheresSetup& setup) {
  Fnv1a to;
  for (const auto* values : {&setup.position, &setup.velocity, &setup.spin}) to.add(*values);
  for (const auto* values : {&setup.radius, &setup.mass, &setup.inertia}) to.add(*values);
  for (const SpaceWall& wall : setup.walls) {
    to.add(wall.position);
    to.add(wall.radius);
    for (const SpaceWall::Plane& plane : wall.planes)
      for (const Vec3<double>& v : {plane.point, plane.normal}) to.addAll(v.x, v.y, v.z);
    for (const SpaceWall::Cylinder& each : wall.cylinders) {
      for (const Vec3<double>& v : {each.point, each.axis}) to.addAll(v.x, v.y, v.z);
      to.addAll(each.radius);
    }
  }
  addLaws(to, setup.law, setup.materials);
  const LawConventions& how = setup.law.conventions;
  to.addAll(static_cast<int>(how.springTurn), static_cast<int>(how.springTwist));
  if (const auto& box = setup.box)
    to.addAll(box->low.x, box->low.y, box->low.z, box->length.x, box->length.y, box->length.z,
              box->periodic[0], box->periodic[1], box->periodic[2]);
  to.addAll(setup.gravity.x, setup.gravity.y, setup.gravity.z, setup.dt, setup.rotation);
  return to.hash();
}

}  // namespace grain
