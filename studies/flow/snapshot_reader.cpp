#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "adapters/audit.hpp"
#include "cases/couette.hpp"
#include "cases/materials.hpp"
#include "studies/flow/snapshot_file.hpp"
#include "support/bad_input.hpp"
#include "support/hdf5_file.hpp"

namespace crossgrain::inline studies {
namespace {

Hdf5File opened(const std::filesystem::path& file) {
  try {
    return Hdf5File::open(file);
  } catch (const std::runtime_error& error) {
    throw BadInput(error.what());
  }
}

}  // namespace

void requireReadable(const std::filesystem::path& file, const Case& setup) {
  tryReading(file, [&] {
    const SnapshotReader reader(file, setup);
    for (std::size_t k = 0; k < reader.count(); ++k) reader.read(k);
  });
}

SnapshotReader::SnapshotReader(const std::filesystem::path& file, const Case& setup)
    : name_(file), file_(opened(file)), engine_(file.stem().string()) {
  readScene(setup);
  try {
    if (const auto engine = file_.readTextAttribute("engine")) engine_ = *engine;
  } catch (const std::runtime_error& error) {
    throw BadInput(error.what());
  }
  while (file_.holds(snapshotGroup(count_) + "/position")) ++count_;
  if (count_ == 0) fail(fmt::format("there is no {}/position in it", snapshotGroup(0)));
}

void SnapshotReader::fail(const std::string& what) const {
  throw BadInput(fmt::format("{}: {}", name_.string(), what));
}

std::vector<double> SnapshotReader::numbers(const std::string& path, std::size_t length) const {
  std::optional<std::vector<double>> values;
  try {
    const auto held = file_.length(path);  // before room for it is taken
    if (held && *held != length)
      fail(fmt::format("{} holds {} numbers, wanted are {}", path, *held, length));
    values = file_.read(path);
  } catch (const std::runtime_error& error) {
    throw BadInput(error.what());
  }
  if (!values) fail(fmt::format("there is no {} in it", path));
  if (!std::ranges::all_of(*values, [](double x) { return std::isfinite(x); }))
    fail(fmt::format("{} holds a number that is not finite", path));
  return *values;
}

std::vector<Vec2> SnapshotReader::vectors(const std::string& path, std::size_t length) const {
  const std::vector<double> flat = numbers(path, 2 * length);
  std::vector<Vec2> result;
  for (std::size_t k = 0; k < length; ++k) result.emplace_back(flat[2 * k], flat[2 * k + 1]);
  return result;
}

void SnapshotReader::readScene(const Case& setup) {
  const auto count = file_.length("/disks/radius");
  if (!count) fail("there is no /disks/radius in it");
  if (*count > static_cast<std::size_t>(mostDisks))
    fail(fmt::format("it holds {} disks: a case may have at most {}", *count, mostDisks));
  const std::size_t disks = *count;
  scene_.name = setup.name;
  scene_.law = setup.law;
  scene_.bottom = setup.bottom;
  scene_.rotation = setup.particles.rotation;
  scene_.disks.radius = numbers("/disks/radius", disks);
  if (!std::ranges::all_of(scene_.disks.radius, [](double a) { return a > 0.0; }))
    fail("/disks/radius holds a radius that is not above 0");
  scene_.disks.mass = numbers("/disks/mass", disks);
  if (file_.holds("/disks/inertia"))
    scene_.disks.inertia = numbers("/disks/inertia", disks);
  else
    for (std::size_t p = 0; p < disks; ++p)
      scene_.disks.inertia.push_back(setup.particles.inertiaFactor * scene_.disks.mass[p] *
                                     scene_.disks.radius[p] * scene_.disks.radius[p]);
  for (const char* name : {wheelName, ringName}) scene_.bodies.emplace_back().name = name;
  addMaterials(scene_, setup);
  const auto walls = file_.read("/walls/radius");
  if (!walls || walls->empty()) return;
  const std::vector<double> wallRadius = numbers("/walls/radius", walls->size());
  const std::vector<double> wallBody = numbers("/walls/body", walls->size());
  for (std::size_t w = 0; w < wallRadius.size(); ++w) {
    const bool ring = wallBody[w] == 1.0;
    const bool rising = w == 0 || wallBody[w] >= wallBody[w - 1];
    if ((!ring && wallBody[w] != 0.0) || !rising)
      fail(
          fmt::format("/walls/body[{}] is {}; wanted is 0 for the wheel's disks, then 1 for the "
                      "ring's",
                      w, wallBody[w]));
    scene_.bodies[ring ? 1 : 0].diskRadius.push_back(wallRadius[w]);
  }
}

Contacts SnapshotReader::readContacts(const std::string& path) const {
  Contacts contacts;
  const auto first = file_.read(path + "/i");
  if (!first) fail(fmt::format("there is no {}/i in it", path));
  const std::size_t count = first->size();
  const auto ids = static_cast<double>(scene_.disks.size() + scene_.wallDiskCount());
  const auto readIds = [&](const char* name) {
    std::vector<std::int32_t> result;
    for (const double id : numbers(path + name, count)) {
      if (id < 0.0 || id >= ids || id != std::floor(id))
        fail(
            fmt::format("{}{} holds {}; wanted are whole numbers from 0 to {}, disks first, then "
                        "wall disks",
                        path, name, id, ids - 1.0));
      result.push_back(static_cast<std::int32_t>(id));
    }
    return result;
  };
  contacts.i = readIds("/i");
  contacts.j = readIds("/j");
  contacts.normal = vectors(path + "/normal", count);
  contacts.overlap = numbers(path + "/overlap", count);
  contacts.normalForce = numbers(path + "/normal_force", count);
  contacts.tangentialForce = numbers(path + "/tangential_force", count);
  if (file_.holds(path + "/sliding"))
    for (const double slides : numbers(path + "/sliding", count))
      contacts.sliding.push_back(slides != 0.0 ? 1 : 0);
  for (const auto& [name, list] : {std::pair{"/rolling_torque", &contacts.rollingTorque},
                                   {"/dissipation", &contacts.dissipation}})
    if (file_.holds(path + name)) *list = numbers(path + name, count);
  return contacts;
}

std::vector<BodySnapshot> SnapshotReader::readBodies(const std::string& path) const {
  const std::size_t count = scene_.bodies.size();
  std::vector<BodySnapshot> bodies(count);
  if (!file_.holds(path + "/centre")) return bodies;
  const auto centre = vectors(path + "/centre", count);
  const auto velocity = vectors(path + "/velocity", count);
  const auto angle = numbers(path + "/angle", count);
  const auto spin = numbers(path + "/angular_velocity", count);
  for (std::size_t b = 0; b < count; ++b)
    bodies[b] = {centre[b], angle[b], velocity[b], spin[b], std::nullopt, std::nullopt};
  if (file_.holds(path + "/force")) {
    const auto force = vectors(path + "/force", count);
    for (std::size_t b = 0; b < count; ++b) bodies[b].force = force[b];
  }
  if (file_.holds(path + "/torque")) {
    const auto torque = numbers(path + "/torque", count);
    for (std::size_t b = 0; b < count; ++b) bodies[b].torque = torque[b];
  }
  return bodies;
}

bool SnapshotReader::tellsMotion(std::size_t k) const {
  return file_.holds(snapshotGroup(k) + "/bodies/centre");
}

Snapshot SnapshotReader::read(std::size_t k) const {
  const std::string group = snapshotGroup(k);
  const std::size_t disks = scene_.disks.size();
  const std::size_t walls = scene_.wallDiskCount();
  Snapshot snapshot;
  const std::vector<double> time = numbers(group + "/time", 4);
  snapshot.positionTime = time[0];
  snapshot.velocityTime = time[1];
  snapshot.contactTime = time[2];
  snapshot.contactInterval = time[3];
  snapshot.position = vectors(group + "/position", disks);
  snapshot.velocity = vectors(group + "/velocity", disks);
  if (file_.holds(group + "/spin")) snapshot.spin = numbers(group + "/spin", disks);
  if (walls > 0) snapshot.wallPosition = vectors(group + "/wall_position", walls);
  snapshot.bodies = readBodies(group + "/bodies");
  if (file_.holds(group + "/energies")) {
    const auto energies = numbers(group + "/energies", 2);
    snapshot.energies = Energies{energies[0], energies[1]};
  }
  if (file_.holds(group + "/contacts/i")) snapshot.contacts = readContacts(group + "/contacts");
  return snapshot;
}

namespace {

/// Engines of floats round to 10⁻⁷; what differs by more differs.
constexpr double tolerance = 1e-5;

bool same(double a, double b) {
  return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b));
}

/// Everything that does not fit, each "what the file has, not what the case has".
class Misfits {
 public:
  void number(const char* what, std::size_t found, std::size_t target) {
    if (found != target) list_.push_back(fmt::format("{} {}, not {}", found, what, target));
  }
  void size(const std::string& what, double found, double target, const char* unit) {
    if (!same(found, target))
      list_.push_back(fmt::format("{} {:.4g} {}, not {:.4g} {}", what, found, unit, target, unit));
  }
  void add(std::string misfit) { list_.push_back(std::move(misfit)); }
  const std::vector<std::string>& list() const { return list_; }

 private:
  std::vector<std::string> list_;
};

/// @param radius, mass  of one kind in the case; @returns how many of the file are of it
std::size_t compareKind(const Disks& disks, double radius, double mass, const char* kind,
                        Misfits& misfits) {
  std::size_t count = 0;
  bool reported = false;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    if (!same(disks.radius[i], radius)) continue;
    ++count;
    if (reported || same(disks.mass[i], mass)) continue;
    misfits.size(fmt::format("a {} disk's mass", kind), disks.mass[i], mass, "kg");
    reported = true;
  }
  return count;
}

void compareDisks(const Disks& disks, const Particles& target, Misfits& misfits) {
  const auto isOf = [&](double radius) {
    return same(radius, target.smallRadius) || same(radius, target.largeRadius);
  };
  const auto other = std::ranges::find_if_not(disks.radius, isOf);
  if (other != disks.radius.end())
    misfits.add(fmt::format("disks of radius {:.4g} m, not {:.4g} and {:.4g} m", *other,
                            target.smallRadius, target.largeRadius));
  misfits.number("disks", disks.size(), static_cast<std::size_t>(target.small + target.large));
  if (other != disks.radius.end()) return;
  const std::size_t small =
      compareKind(disks, target.smallRadius, target.smallMass, "small", misfits);
  if (same(target.smallRadius, target.largeRadius)) return;
  const std::size_t large =
      compareKind(disks, target.largeRadius, target.largeMass, "large", misfits);
  misfits.number("small disks", small, static_cast<std::size_t>(target.small));
  misfits.number("large disks", large, static_cast<std::size_t>(target.large));
}

/// The wheel's and the ring's wall disks, in this order, against those of the case's cell.
void compareWalls(const Scene& scene, const Snapshot& first, const Case& setup, Misfits& misfits) {
  const double radii[] = {setup.cell.innerRadius, setup.cell.outerRadius};
  const char* const names[] = {wheelName, ringName};
  std::size_t at = 0;
  for (std::size_t b = 0; b < 2; ++b) {
    const std::vector<double>& disks = scene.bodies[b].diskRadius;
    if (disks.empty()) continue;
    const WallBody target = wallRing(names[b], setup.cell, radii[b], 0.0);
    misfits.number(b == 0 ? "wall disks of the wheel" : "wall disks of the ring", disks.size(),
                   target.diskRadius.size());
    misfits.size(fmt::format("the {}'s wall disks' radius", names[b]), disks.front(),
                 setup.cell.wallRadius, "m");
    misfits.size(fmt::format("the {}'s radius", names[b]), first.wallPosition[at].norm(), radii[b],
                 "m");
    at += disks.size();
  }
}

/// A disk or two may have got through a wall; a hundredth of them has not.
void comparePlaces(const Snapshot& first, const Cell& cell, Misfits& misfits) {
  const auto outside = std::ranges::count_if(first.position, [&](const Vec2& at) {
    return at.norm() < cell.innerRadius || at.norm() > cell.outerRadius;
  });
  if (outside > 2 && 100 * static_cast<std::size_t>(outside) > first.position.size())
    misfits.add(fmt::format("{} disks not between {:.4g} and {:.4g} m from the axis", outside,
                            cell.innerRadius, cell.outerRadius));
}

}  // namespace

void requireFit(const SnapshotReader& reader, const Case& setup) {
  const Scene& scene = reader.scene();
  const Snapshot first = reader.read(0);
  Misfits misfits;
  if (!setup.particles.file) compareDisks(scene.disks, setup.particles, misfits);
  compareWalls(scene, first, setup, misfits);
  if (reader.tellsMotion(0))
    misfits.size("a wheel that turns at", first.bodies.front().angularVelocity, setup.cell.omega,
                 "rad/s");
  comparePlaces(first, setup.cell, misfits);
  if (!misfits.list().empty())
    throw BadInput(fmt::format("{} does not fit {}: it has {}", reader.file().string(),
                               setup.file.string(), fmt::join(misfits.list(), "; ")));
}

void requireSound(const SnapshotReader& reader, const Case& setup) {
  // What the file says of places; the case says the rest.
  Scene scene = reader.scene();
  const Snapshot first = reader.read(0);
  scene.disks.position = first.position;
  scene.disks.velocity = first.velocity;
  auto place = first.wallPosition.begin();
  for (WallBody& body : scene.bodies)
    for (std::size_t k = 0; k < body.diskRadius.size(); ++k) body.diskPosition.push_back(*place++);
  AuditBasis basis = auditBasis(scene);
  basis.byOverlap = setup.law.soft();
  for (std::size_t k = 0; k < reader.count(); ++k) {
    Snapshot snapshot = reader.read(k);
    // Where walls were when the contacts were is not said.
    if (snapshot.contactTime != snapshot.positionTime && !reader.tellsMotion(k))
      snapshot.contacts.reset();
    if (const std::string why = auditFault(snapshot, basis); !why.empty())
      throw BadInput(fmt::format("{}, snapshot {}: {}", reader.file().string(), k, why));
  }
}

}  // namespace crossgrain::inline studies
