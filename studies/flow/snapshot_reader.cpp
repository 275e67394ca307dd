#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "adapters/audit_geometry.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "studies/flow/snapshot_file.hpp"
#include "studies/flow/snapshot_fit.hpp"
#include "support/bad_input.hpp"
#include "support/hdf5_file.hpp"

namespace crossgrain::inline studies {
namespace {

/// A failure of HDF5 with a file of the user's is bad input.
auto described(const auto& read) {
  try {
    return read();
  } catch (const std::runtime_error& error) {
    throw BadInput(error.what());
  }
}

/// The file while it is open.
class SnapshotDatasets {
 public:
  explicit SnapshotDatasets(const std::filesystem::path& file)
      : name_(file), file_(described([&] { return Hdf5File::open(file); })) {}

  bool holds(const std::string& path) const { return file_.holds(path); }
  std::optional<std::size_t> length(const std::string& path) const {
    return described([&] { return file_.length(path); });
  }
  /// @throws BadInput  of snapshots of the plane for a case in space, and the other way round
  void requireDimension(int wanted) const {
    const auto held = described([&] { return file_.readAttribute("dimension"); }).value_or(2.0);
    if (held != wanted)
      fail(fmt::format("its snapshots have dimension {:g}, the case has {}", held, wanted));
  }
  std::optional<std::string> engine() const {
    return described([&] { return file_.readTextAttribute("engine"); });
  }

  /// @throws BadInput  where they are not there, not so many or not finite
  std::vector<double> numbers(const std::string& path, std::size_t wanted) const {
    const auto held = length(path);  // before room for it is taken
    if (held && *held != wanted)
      fail(fmt::format("{} holds {} numbers, wanted are {}", path, *held, wanted));
    auto values = described([&] { return file_.read(path); });
    if (!values) fail(fmt::format("there is no {} in it", path));
    if (!std::ranges::all_of(*values, [](double x) { return std::isfinite(x); }))
      fail(fmt::format("{} holds a number that is not finite", path));
    return *std::move(values);
  }

  template <int D>
  std::vector<VecOf<D>> vectors(const std::string& path, std::size_t wanted) const {
    const std::vector<double> flat = numbers(path, D * wanted);
    std::vector<VecOf<D>> result;
    result.reserve(wanted);
    for (std::size_t k = 0; k < wanted; ++k) result.emplace_back(flat.data() + D * k);
    return result;
  }

  /// Reads what is about the normal of the plane, or in space a vector.
  template <int D>
  std::vector<SpinOf<D>> spins(const std::string& path, std::size_t wanted) const {
    if constexpr (D == 2)
      return numbers(path, wanted);
    else
      return vectors<D>(path, wanted);
  }

  /// Angles, or quaternions w, x, y, z.
  template <int D>
  std::vector<TurnOf<D>> turns(const std::string& path, std::size_t wanted) const {
    std::vector<double> flat = numbers(path, (D == 2 ? 1 : 4) * wanted);
    if constexpr (D == 2) {
      return flat;
    } else {
      std::vector<TurnOf<3>> result;
      for (std::size_t k = 0; k < wanted; ++k) result.emplace_back(flat.data() + 4 * k);
      return result;
    }
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw BadInput(fmt::format("{}: {}", name_.string(), what));
  }

 private:
  std::filesystem::path name_;
  Hdf5File file_;
};

/// How many disks it holds. @throws BadInput
std::size_t diskCount(const SnapshotDatasets& in) {
  const auto count = in.length("/disks/radius");
  if (!count) in.fail("there is no /disks/radius in it");
  if (*count > static_cast<std::size_t>(mostDisks))
    in.fail(fmt::format("it holds {} disks: a case may have at most {}", *count, mostDisks));
  return *count;
}

/// What convex bodies have beside what is of the circles or spheres around them.
template <int D>
void readConvex(const SnapshotDatasets& in, DisksOf<D>& disks) {
  const std::size_t count = disks.size();
  const auto shapes = static_cast<double>(*in.length("/shapes/kind"));
  for (const double shape : in.numbers("/disks/shape", count)) {
    if (shape < -1.0 || shape >= shapes || shape != std::floor(shape))
      in.fail(fmt::format("/disks/shape holds {}; wanted are whole numbers from -1 to {}", shape,
                          shapes - 1.0));
    disks.shape.push_back(static_cast<std::int32_t>(shape));
  }
  disks.turn = in.turns<D>("/disks/turn", count);
  if constexpr (D == 3) {
    disks.moments = in.vectors<3>("/disks/moments", count);
    if (!std::ranges::all_of(disks.moments, [](const Vec3& j) { return j.minCoeff() > 0.0; }))
      in.fail("/disks/moments holds a moment of inertia that is not above 0");
  }
}

/// Shapes are the case's, and the file must have the same.
template <int D>
void compareShapes(const SnapshotDatasets& in, const SceneOf<D>& scene) {
  const std::size_t count = in.length("/shapes/kind").value_or(0);
  if (count != scene.shapes.size())
    in.fail(fmt::format("it holds {} shapes of convex bodies, the case has {}", count,
                        scene.shapes.size()));
  if (count == 0) return;
  const std::vector<double> kind = in.numbers("/shapes/kind", count);
  for (std::size_t k = 0; k < count; ++k) {
    const ShapeOf<D>& wanted = scene.shapes[k];
    const std::string at = fmt::format("/shapes/{}/", k);
    bool same = kind[k] == static_cast<double>(wanted.kind) &&
                in.length(at + "vertices") == D * wanted.vertices.size();
    const double small = 1e-5 * wanted.reach();
    if (same) {
      const auto vertices = in.vectors<D>(at + "vertices", wanted.vertices.size());
      for (std::size_t v = 0; v < vertices.size(); ++v)
        same = same && (vertices[v] - wanted.vertices[v]).norm() <= small;
      same = same && std::abs(in.numbers(at + "rounding", 1)[0] - wanted.rounding) <= small;
    }
    if (!same)
      in.fail(fmt::format("its shape {} is not that of the case, a {}", k, toString(wanted.kind)));
  }
}

template <int D>
DisksOf<D> readDisks(const SnapshotDatasets& in, const Case& setup) {
  const std::size_t count = diskCount(in);
  DisksOf<D> disks;
  disks.radius = in.numbers("/disks/radius", count);
  if (!std::ranges::all_of(disks.radius, [](double a) { return a > 0.0; }))
    in.fail("/disks/radius holds a radius that is not above 0");
  disks.mass = in.numbers("/disks/mass", count);
  const double factor = inertiaFactorOf(setup);
  if (in.holds("/disks/inertia") || in.holds("/shapes/kind"))
    disks.inertia = in.numbers("/disks/inertia", count);
  else
    for (std::size_t p = 0; p < count; ++p)
      disks.inertia.push_back(factor * disks.mass[p] * disks.radius[p] * disks.radius[p]);
  disks.position.assign(count, VecOf<D>::Zero());
  disks.velocity.assign(count, VecOf<D>::Zero());
  disks.spin.assign(count, noSpin<D>());
  if (in.holds("/shapes/kind")) readConvex<D>(in, disks);
  return disks;
}

/// The wall disks of a Couette cell are the file's own: it may have none.
void readCellWalls(const SnapshotDatasets& in, Scene& scene) {
  for (WallBody& body : scene.bodies) {
    body.diskPosition.clear();
    body.diskRadius.clear();
  }
  const std::size_t count = in.length("/walls/radius").value_or(0);
  if (count == 0) return;
  const std::vector<double> radius = in.numbers("/walls/radius", count);
  const std::vector<double> body = in.numbers("/walls/body", count);
  for (std::size_t w = 0; w < count; ++w) {
    const bool ring = body[w] == 1.0;
    const bool rising = w == 0 || body[w] >= body[w - 1];
    if ((!ring && body[w] != 0.0) || !rising)
      in.fail(
          fmt::format("/walls/body[{}] is {}; wanted is 0 for the wheel's disks, then 1 for the "
                      "ring's",
                      w, body[w]));
    scene.bodies[ring ? 1 : 0].diskRadius.push_back(radius[w]);
  }
}

/// Those of an assembly are the case's, and a file that has them must have the same.
template <int D>
void compareWalls(const SnapshotDatasets& in, const SceneOf<D>& scene) {
  const std::size_t count = in.length("/walls/radius").value_or(0);
  if (count == 0) return;
  const std::vector<double> radius = in.numbers("/walls/radius", scene.wallDiskCount());
  const std::vector<double> body = in.numbers("/walls/body", scene.wallDiskCount());
  std::size_t w = 0;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    for (const double wanted : scene.bodies[b].diskRadius) {
      if (body[w] != static_cast<double>(b) || std::abs(radius[w] - wanted) > 1e-5 * wanted)
        in.fail(
            fmt::format("wall disk {} is of body {} and radius {:.4g} m, in the case of body "
                        "{} and {:.4g} m",
                        w, body[w], radius[w], b, wanted));
      ++w;
    }
}

template <int D>
ContactsOf<D> readContacts(const SnapshotDatasets& in, const std::string& path,
                           const SceneOf<D>& scene) {
  ContactsOf<D> contacts;
  const auto length = in.length(path + "/i");
  if (!length) in.fail(fmt::format("there is no {}/i in it", path));
  const std::size_t count = *length;
  const auto ids = static_cast<double>(scene.idCount());
  const auto readIds = [&](const char* name) {
    std::vector<std::int32_t> result;
    result.reserve(count);
    for (const double id : in.numbers(path + name, count)) {
      if (id < 0.0 || id >= ids || id != std::floor(id))
        in.fail(
            fmt::format("{}{} holds {}; wanted are whole numbers from 0 to {}, disks first, then "
                        "wall disks{}{}",
                        path, name, id, ids - 1.0, scene.planeCount() > 0 ? ", then planes" : "",
                        scene.cylinderCount() > 0 ? ", then cylinders" : ""));
      result.push_back(static_cast<std::int32_t>(id));
    }
    return result;
  };
  contacts.i = readIds("/i");
  contacts.j = readIds("/j");
  contacts.normal = in.vectors<D>(path + "/normal", count);
  contacts.overlap = in.numbers(path + "/overlap", count);
  contacts.normalForce = in.numbers(path + "/normal_force", count);
  contacts.tangentialForce = in.spins<D>(path + "/tangential_force", count);
  if (in.holds(path + "/sliding"))
    for (const double slides : in.numbers(path + "/sliding", count))
      contacts.sliding.push_back(slides != 0.0 ? 1 : 0);
  if (in.holds(path + "/rolling_torque"))
    contacts.rollingTorque = in.spins<D>(path + "/rolling_torque", count);
  if (in.holds(path + "/dissipation"))
    contacts.dissipation = in.numbers(path + "/dissipation", count);
  if (!scene.shapes.empty() && count > 0) contacts.point = in.vectors<D>(path + "/point", count);
  return contacts;
}

template <int D>
std::vector<BodySnapshotOf<D>> readBodies(const SnapshotDatasets& in, const std::string& path,
                                          std::size_t count) {
  const auto centre = in.vectors<D>(path + "/centre", count);
  const auto velocity = in.vectors<D>(path + "/velocity", count);
  const auto angle = in.spins<D>(path + "/angle", count);
  const auto spin = in.spins<D>(path + "/angular_velocity", count);
  std::vector<BodySnapshotOf<D>> bodies(count);
  for (std::size_t b = 0; b < count; ++b)
    bodies[b] = {centre[b], angle[b], velocity[b], spin[b], std::nullopt, std::nullopt};
  if (in.holds(path + "/force")) {
    const auto force = in.vectors<D>(path + "/force", count);
    for (std::size_t b = 0; b < count; ++b) bodies[b].force = force[b];
  }
  if (in.holds(path + "/torque")) {
    const auto torque = in.spins<D>(path + "/torque", count);
    for (std::size_t b = 0; b < count; ++b) bodies[b].torque = torque[b];
  }
  return bodies;
}

/// Walls of which the file says nothing are as the case prescribes them.
template <int D>
SnapshotOf<D> readSnapshot(const SnapshotDatasets& in, std::size_t k, const SceneOf<D>& scene,
                           bool isAssembly) {
  const std::string group = snapshotGroup(k);
  const std::size_t disks = scene.disks.size(), walls = scene.wallDiskCount();
  SnapshotOf<D> snapshot;
  const std::vector<double> time = in.numbers(group + "/time", 4);
  snapshot.positionTime = time[0];
  snapshot.velocityTime = time[1];
  snapshot.contactTime = time[2];
  snapshot.contactInterval = time[3];
  snapshot.position = in.vectors<D>(group + "/position", disks);
  snapshot.velocity = in.vectors<D>(group + "/velocity", disks);
  if (in.holds(group + "/spin")) snapshot.spin = in.spins<D>(group + "/spin", disks);
  if (!scene.shapes.empty()) snapshot.turn = in.turns<D>(group + "/turn", disks);
  placeWallsAsPrescribed(scene, snapshot.positionTime, snapshot);
  if (walls > 0 && (!isAssembly || in.holds(group + "/wall_position")))
    snapshot.wallPosition = in.vectors<D>(group + "/wall_position", walls);
  if (!scene.bodies.empty() && in.holds(group + "/bodies/centre"))
    snapshot.bodies = readBodies<D>(in, group + "/bodies", scene.bodies.size());
  if (in.holds(group + "/energies")) {
    const auto energies = in.numbers(group + "/energies", 2);
    snapshot.energies = Energies{energies[0], energies[1]};
  }
  if (in.holds(group + "/contacts/i"))
    snapshot.contacts = readContacts(in, group + "/contacts", scene);
  return snapshot;
}

/// Places wall disks as at t = 0, from their later places in a file: only these show at which angle
/// a wheel began.
void placeCellWalls(const Snapshot& first, Scene& scene) {
  auto place = first.wallPosition.begin();
  for (WallBody& body : scene.bodies) {
    const BodyState now = stateAt(body.motion, body.centre, first.positionTime);
    const Eigen::Rotation2Dd back(-now.angle);
    for (std::size_t k = 0; k < body.diskRadius.size(); ++k)
      body.diskPosition.emplace_back(back * *place++);
  }
}

}  // namespace

template <int D>
SnapshotReaderOf<D>::SnapshotReaderOf(const std::filesystem::path& file, const Case& setup)
    : name_(file) {
  const bool isAssembly = !cellOf(setup);
  const SnapshotDatasets in(file);
  in.requireDimension(D);
  scene_ = sceneAround<D>(setup, readDisks<D>(in, setup), {file.string()});
  if (isAssembly) compareWalls(in, scene_);
  compareShapes(in, scene_);
  if constexpr (D == 2)
    if (!isAssembly) readCellWalls(in, scene_);
  engine_ = in.engine().value_or(file.stem().string());
  while (in.holds(snapshotGroup(count_) + "/position")) ++count_;
  if (count_ == 0) in.fail(fmt::format("there is no {}/position in it", snapshotGroup(0)));
  const SnapshotOf<D> first = readSnapshot<D>(in, 0, scene_, isAssembly);
  scene_.disks.position = first.position;
  scene_.disks.velocity = first.velocity;
  if constexpr (D == 2)
    if (!isAssembly) placeCellWalls(first, scene_);
  basis_ = auditBasis(scene_);
  basis_.byOverlap = setup.law.soft() && scene_.shapes.empty();  // those are rigid
  basis_.prescribed = isAssembly;
  if (cellOf(setup) || !setup.region) return;
  const FlowTimes times = flowTimes(setup);  // steps of an engine need not end with them
  to_ = times.end() + 0.5 * times.interval;
  // As engines are averaged: not at the instant that averaging begins at, unless nothing else is
  // there.
  const double slack = instantSlack(timeStep(setup), times.settled);
  from_ = times.settled + slack;
  bool begins = false, any = false;
  for (std::size_t k = 0; k < count_; ++k) {
    const double t = in.numbers(snapshotGroup(k) + "/time", 4).front();
    any |= t > from_ && t <= to_;
    begins |= std::abs(t - times.settled) <= slack;
  }
  if (begins && !any) from_ = std::nextafter(times.settled - slack, -INFINITY);
}

template <int D>
SnapshotOf<D> SnapshotReaderOf<D>::read(std::size_t k) const {
  return readSnapshot<D>(SnapshotDatasets(name_), k, scene_, basis_.prescribed);
}

template <int D>
void SnapshotReaderOf<D>::takeAll() {
  from_ = -INFINITY;
  to_ = INFINITY;
}

template <int D>
std::optional<SnapshotOf<D>> SnapshotReaderOf<D>::next() {
  while (next_ < count_) {
    const std::size_t k = next_++;
    SnapshotOf<D> snapshot = read(k);
    if (const std::string why = auditFault(snapshot, basis_); !why.empty())
      throw BadInput(fmt::format("{}, snapshot {}: {}", name_.string(), k, why));
    if (snapshot.positionTime > from_ && snapshot.positionTime <= to_) return snapshot;
    ++leftOut_;
  }
  return std::nullopt;
}

template <int D>
std::vector<std::string> SnapshotReaderOf<D>::remarks() const {
  if (leftOut_ == 0) return {};
  return {fmt::format("{}: {} of {} snapshots are not of the averaged time and are left out",
                      name_.string(), leftOut_, count_)};
}

template <int D>
std::unique_ptr<SnapshotReaderOf<D>> openSnapshotFile(const std::filesystem::path& file,
                                                      const Case& setup) {
  tryReading(file, [&] {
    const SnapshotReaderOf<D> reader(file, setup);
    for (std::size_t k = 0; k < reader.count(); ++k) reader.read(k);
  });
  auto reader = std::make_unique<SnapshotReaderOf<D>>(file, setup);
  requireFit<D>(reader->scene(), reader->read(0), setup, {file.string()});
  return reader;
}

template class SnapshotReaderOf<2>;
template class SnapshotReaderOf<3>;
template std::unique_ptr<SnapshotReaderOf<2>> openSnapshotFile(const std::filesystem::path&,
                                                               const Case&);
template std::unique_ptr<SnapshotReaderOf<3>> openSnapshotFile(const std::filesystem::path&,
                                                               const Case&);

}  // namespace crossgrain::inline studies
