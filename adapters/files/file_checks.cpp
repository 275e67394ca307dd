#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "adapters/audit_geometry.hpp"
#include "adapters/files/file_snapshots.hpp"

/// Checks whether a file's data can be true of the case's scene.
namespace crossgrain::files {
namespace {

template <int D>
constexpr const char* movers = D == 3 ? "spheres" : "disks";

/// Sums over contacts with each body: what the disks do to it, about its centre.
template <int D>
void addWallForces(const SceneOf<D>& scene, SnapshotOf<D>& now) {
  const std::size_t disks = scene.disks.size(), round = disks + scene.wallDiskCount();
  std::vector<std::size_t> bodyOf(scene.idCount());
  std::size_t disk = disks, plane = round, cylinder = round + scene.planeCount();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    for (std::size_t k = 0; k < scene.bodies[b].diskRadius.size(); ++k) bodyOf[disk++] = b;
    for (std::size_t k = 0; k < scene.bodies[b].planes.size(); ++k) bodyOf[plane++] = b;
    for (std::size_t k = 0; k < scene.bodies[b].cylinders.size(); ++k) bodyOf[cylinder++] = b;
    now.bodies[b].force = VecOf<D>::Zero();
    now.bodies[b].torque = noSpin<D>();
  }
  const ContactsOf<D>& contacts = *now.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const auto j = static_cast<std::size_t>(contacts.j[c]);
    if (j < disks) continue;
    BodySnapshotOf<D>& body = now.bodies[bodyOf[j]];
    VecOf<D> point =
        now.position[i] - (scene.disks.radius[i] - 0.5 * contacts.overlap[c]) * contacts.normal[c];
    // Of the images, the one in which the wall disk turns with its body.
    if (scene.box && j < round)
      point = now.wallPosition[j - disks] + scene.box->nearest(point - now.wallPosition[j - disks]);
    const VecOf<D> force = -contacts.force(c);
    *body.force += force;
    if constexpr (D == 2)
      *body.torque += cross(point - body.centre, force);
    else
      *body.torque += (point - body.centre).cross(force);
    if (!contacts.rollingTorque.empty()) *body.torque -= contacts.rollingTorque[c];
  }
}

/// Whether the forces have the signs of a law without attraction. Dashpots that may pull do so at
/// the end of a contact, for a twentieth of it or so: a few contacts may all be there, of twenty or
/// more the half is not.
template <int D>
std::string signFault(const ContactsOf<D>& contacts, const SceneOf<D>& scene) {
  double sum = 0.0;
  for (const double f : contacts.normalForce) sum += f;
  if (!(sum < 0.0) || scene.law.coheres()) return {};
  constexpr std::size_t many = 20;
  const bool mayPull = scene.law.conventions.tension == Tension::allow && scene.law.gn != 0.0;
  const auto pulling = static_cast<std::size_t>(
      std::ranges::count_if(contacts.normalForce, [](double f) { return f < 0.0; }));
  if (mayPull && (contacts.size() < many || 2 * pulling <= contacts.size())) return {};
  return fmt::format(
      "normal forces attract, {:.4g} N over {} contacts, although the law has no cohesion; has "
      "normal_force the other sign?",
      sum, contacts.size());
}

}  // namespace

template <int D>
void FileSnapshotsOf<D>::audit(const FileFrame& frame, SnapshotOf<D>& snapshot) {
  if (snapshot.contacts) {
    if (const std::string why = signFault(*snapshot.contacts, scene_); !why.empty())
      fail(frame, why);
    wallContacts_ |= std::ranges::any_of(snapshot.contacts->j, [&](std::int32_t j) {
      return static_cast<std::size_t>(j) >= scene_.disks.size();
    });
  }
  for (AuditBasisOf<D>* basis : {&basis_, &bareBasis_}) {
    basis->shownPlaces = shownPlacesOf(frame.particles, units_);
    if (basis->shownPlaces) basis->shownPlaces->step = shortestStep();
  }
  std::string why = auditFault(snapshot, basis_);
  if (!why.empty() && snapshot.contacts && !wallContacts_) {
    // Of files without contacts of walls, all others are whole.
    auto walls = std::exchange(snapshot.wallPosition, {});
    auto bodies = std::exchange(snapshot.bodies, {});
    why = auditFault(snapshot, bareBasis_);
    snapshot.wallPosition = std::move(walls);
    snapshot.bodies = std::move(bodies);
    if (why.empty())
      remarks_.insert(
          std::string(noWallContacts) +
          ": stress, fabric and coordination lack them, and forces on walls are not available");
  }
  if (!why.empty()) fail(frame, why);
  if (!snapshot.contacts) return;
  if (wallContacts_) addWallForces(scene_, snapshot);
  checkLaw(frame, snapshot);
  checkSliding(frame, snapshot);
}

template <int D>
void FileSnapshotsOf<D>::checkLaw(const FileFrame& frame, const SnapshotOf<D>& snapshot) {
  if (lawDiffers_ || !scene_.law.soft()) return;
  AuditBasisOf<D> basis = basis_;
  basis.dt = step();
  if (!frame.contacts->overlap.empty()) {
    basis.shownOverlaps = lastDigitOf(frame.contacts->overlap);
    basis.shownOverlaps->place *= units_.length;
  }
  const std::string differs = lawFault(snapshot, basis, scene_.law);
  lawDiffers_ = !differs.empty();
  if (lawDiffers_)
    remarks_.insert(
        fmt::format("{}: the forces are not those of the case's law: {}", frame.where, differs));
}

/// Friction that pushes the way that disks slide. Of thirty contacts by chance as many as nine in
/// ten are along in four of a million right files even where half of the contacts are. Where the
/// law is another than the case's its bound is, too, and what is found is said alone.
template <int D>
void FileSnapshotsOf<D>::checkSliding(const FileFrame& frame, const SnapshotOf<D>& snapshot) {
  constexpr std::size_t fewest = 30, enough = 1000;
  constexpr double nearlyAll = 0.9;
  const std::size_t before = sliding_.along + sliding_.against;
  if (before > enough || saidSliding_) return;
  AuditBasisOf<D> basis = basis_;
  basis.dt = shortestStep();
  addSliding(snapshot, basis, scene_.law, sliding_);
  const std::size_t all = sliding_.along + sliding_.against;
  if (all == before || all < fewest ||
      static_cast<double>(sliding_.along) < nearlyAll * static_cast<double>(all))
    return;
  saidSliding_ = true;
  const std::string what = fmt::format(
      "in {} of {} contacts that slide the tangential force is along the sliding, which friction "
      "opposes: has the tangential force, or the spin, the other sign?",
      sliding_.along, all);
  if (!lawDiffers_) fail(frame, what);
  remarks_.insert(fmt::format("{}: {}", frame.where, what));
}

template <int D>
std::string FileSnapshotsOf<D>::remedyOfMotion(const FileFrame& frame) const {
  if (frame.time) return "velocities should be in the files' length per the files' time";
  return fmt::format(
      "is dt = {:g} in {} the time step, and are velocities in the files' length per the files' "
      "time?",
      units_.dt, target_.where);
}

template <int D>
void FileSnapshotsOf<D>::refuseMotion(const FileFrame& frame, const MotionFinding& found) const {
  fail(frame,
       fmt::format("{} {} that move have gone {:.4g} times as far since the snapshot before as "
                   "their velocities say: {}",
                   found.of, movers<D>, *found.factor, remedyOfMotion(frame)));
}

/// A velocity that would carry its particle through everything within a step is none; one that is
/// a hundred times that of all others, and of the particle's own way, is remarked on.
template <int D>
void FileSnapshotsOf<D>::checkSpeeds(const FileFrame& frame, const SnapshotOf<D>& now) {
  constexpr double outlier = 100.0;
  // Of walls; of disks the basis takes the files' word.
  double walls = 0.0;
  for (const WallBodyOf<D>& body : target_.bodies)
    walls = std::max({walls, body.motion.velocity.norm(),
                      body.motion.frequency * body.motion.amplitude.norm(),
                      sizeOf(body.motion.angularVelocity) * basis_.farthest,
                      std::abs(body.motion.radialVelocity)});
  double fastest = 0.0, next = walls;
  std::size_t at = 0;
  for (std::size_t k = 0; k < now.velocity.size(); ++k) {
    const double speed = now.velocity[k].stableNorm();
    if (speed > fastest) {
      next = std::max(next, std::exchange(fastest, speed));
      at = k;
    } else {
      next = std::max(next, speed);
    }
  }
  const std::int64_t id = now.velocity.empty() ? 0 : ids_->theirOf(at);
  const double brief = shortestStep();
  if (fastest * brief > std::max(basis_.extent, outlier * walls * brief))
    fail(frame, fmt::format("particle {} has a velocity of {:.3g} m/s, by which it crosses the "
                            "scene of {:.3g} m within a step of {:.3g} s",
                            id, fastest, basis_.extent, brief));
  if (!lastPlaces_.empty() && fastest > outlier * next) {
    VecOf<D> way = now.position[at] - lastPlaces_[at];
    if (scene_.box) way = scene_.box->nearest(way);
    const double lapse = now.positionTime - lastTime_;
    if (fastest * lapse > outlier * way.norm() && std::exchange(alike_, false))
      remarks_.insert(fmt::format(
          "{}: particle {} has a velocity of {:.3g} m/s, no other one of more than {:.3g} m/s, and "
          "it has gone {:.3g} m in the {:.3g} s since the snapshot before",
          frame.where, id, fastest, next, way.norm(), lapse));
  }
  lastPlaces_ = now.position;
  lastTime_ = now.positionTime;
}

/// Positions and velocities that do not belong together are of a wrong time step or unit.
template <int D>
void FileSnapshotsOf<D>::checkMotion(const FileFrame& frame, const SnapshotOf<D>& now) {
  const MotionFinding found = displacements_.compare(now, basis_.rounding * basis_.farthest);
  if (found.factor) refuseMotion(frame, found);
  if (found.rms && std::exchange(moves_, false))
    remarks_.insert(
        fmt::format("{}: {} have gone {:.3g} times as far since the snapshot before as their "
                    "velocities say (root mean square): {}",
                    frame.where, movers<D>, *found.rms, remedyOfMotion(frame)));
}

/// Compares displacements with velocities before the averaged time too: averaged particles are
/// often at rest, earlier ones show wrong times. Wall particles count as well.
template <int D>
void FileSnapshotsOf<D>::checkEarlyMotion(const FileFrame& frame, double t) {
  const FileParticles& all = frame.particles;
  if (t < 0.0 || all.velocity.size() != all.size() || all.size() == 0) return;
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!std::ranges::is_sorted(all.id))
    std::ranges::sort(order, {}, [&](std::size_t row) { return all.id[row]; });
  SnapshotOf<D> now;
  now.positionTime = t;
  std::vector<std::int64_t> ids;
  double farthest = 0.0;
  for (const std::size_t row : order) {
    ids.push_back(all.id[row]);
    now.position.push_back(units_.length * units_.template along<D>(all.position[row]));
    now.velocity.push_back(units_.length / units_.time *
                           units_.template along<D>(all.velocity[row]));
    farthest = std::max(farthest, now.position.back().cwiseAbs().maxCoeff());
  }
  if (ids != earlyIds_) earlyDisplacements_ = displacements_;  // nothing to compare with
  earlyIds_ = std::move(ids);
  const MotionFinding found =
      earlyDisplacements_.compare(now, roundingOf(all.position, units_) * farthest);
  if (found.factor) refuseMotion(frame, found);
}

template void FileSnapshotsOf<2>::audit(const FileFrame&, Snapshot&);
template void FileSnapshotsOf<3>::audit(const FileFrame&, SpaceSnapshot&);
template void FileSnapshotsOf<2>::checkSpeeds(const FileFrame&, const Snapshot&);
template void FileSnapshotsOf<3>::checkSpeeds(const FileFrame&, const SpaceSnapshot&);
template void FileSnapshotsOf<2>::checkMotion(const FileFrame&, const Snapshot&);
template void FileSnapshotsOf<3>::checkMotion(const FileFrame&, const SpaceSnapshot&);
template void FileSnapshotsOf<2>::checkEarlyMotion(const FileFrame&, double);
template void FileSnapshotsOf<3>::checkEarlyMotion(const FileFrame&, double);

}  // namespace crossgrain::files
