#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/couette.hpp"
#include "results/snapshot_layout.hpp"
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

}  // namespace crossgrain::inline studies
