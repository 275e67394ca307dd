#include "adapters/files/file_snapshots.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "adapters/audit_geometry.hpp"
#include "adapters/files/wall_particles.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::files {
namespace {

template <int D>
constexpr const char* movers = D == 3 ? "spheres" : "disks";

}  // namespace

template <int D>
FileSnapshotsOf<D>::FileSnapshotsOf(std::unique_ptr<FrameReader> reader, FileUnits units,
                                    FileSceneOf<D> target)
    : reader_(std::move(reader)),
      units_(units),
      target_(std::move(target)),
      displacements_(target_.gravity, driveOf<D>(target_.bodies), target_.box),
      earlyDisplacements_(displacements_),
      remarks_(target_.remarks.begin(), target_.remarks.end()) {
  pending_ = readWithin();
  if (!pending_) {
    const std::string when =
        last_ ? fmt::format(
                    ": the last, {}, is of t = {:.6g} s (is time, dt or start missing in {}?)",
                    lastWhere_, *last_, target_.where)
              : std::string();
    throw BadInput(fmt::format("{}: no snapshot lies between {:.6g} and {:.6g} s{}", target_.name,
                               target_.from, target_.to, when));
  }
  recognise(*pending_);
}

template <int D>
double FileSnapshotsOf<D>::timeOf(const FileFrame& frame) const {
  if (frame.time) return units_.time * (*frame.time - units_.start);
  if (!frame.step) fail(frame, "it has neither a time nor a step");
  if (units_.dt == 0.0)
    fail(frame,
         fmt::format("it has a step and no time: say dt, the time step, in {}", target_.where));
  return units_.time * (static_cast<double>(*frame.step) * units_.dt - units_.start);
}

/// The next frame of the averaged time, which ends with a whole step.
template <int D>
std::optional<FileFrame> FileSnapshotsOf<D>::readWithin() {
  const double slack = 1e-6 * std::max(std::abs(target_.from), step());
  while (auto frame = reader_->next()) {
    const double t = timeOf(*frame);
    if (last_ && !(t > *last_))
      fail(*frame,
           fmt::format("it is of t = {:.9g} s, not after the one before of {:.9g} s", t, *last_));
    last_ = t;
    lastWhere_ = frame->where;
    if (t < target_.from - slack) {
      ++early_;
      checkEarlyMotion(*frame, t);
    } else if (t > target_.to + 0.5 * step()) {
      ++late_;
    } else {
      return frame;
    }
  }
  return std::nullopt;
}

/// Some snapshots with contacts and some without make no average of either.
template <int D>
void FileSnapshotsOf<D>::requireContacts(const FileFrame& frame) const {
  if (frame.contacts || frame.contactsOfOtherTimes.empty()) return;
  fail(frame,
       fmt::format("there are no contacts of this time, {}: average a time that has them (now "
                   "{:.6g} to {:.6g} s), or leave the files of contacts out to average without",
                   frame.contactsOfOtherTimes, target_.from, target_.to));
}

template <int D>
void FileSnapshotsOf<D>::recognise(const FileFrame& frame) {
  const FileParticles& all = frame.particles;
  if (all.size() == 0) fail(frame, "it has no particles");
  if (all.velocity.empty())
    fail(frame, "there are no velocities in the files: nothing can be averaged without them");
  checkParticles(frame, units_, target_.box);
  const std::vector<std::size_t> walls = wallRows(frame, units_, target_, timeOf(frame));
  ids_.emplace(all.id, walls);
  DisksOf<D> disks;
  const std::size_t count = ids_->disks();
  disks.position.resize(count);
  disks.velocity.resize(count);
  disks.spin.assign(count, noSpin<D>());
  if (!all.radius.empty()) disks.radius.resize(count);
  if (!all.mass.empty()) disks.mass.resize(count);
  for (std::size_t row = 0; row < all.size(); ++row) {
    const std::size_t k = *ids_->ourOf(all.id[row]);
    if (k >= count) continue;
    disks.position[k] = units_.length * units_.template along<D>(all.position[row]);
    disks.velocity[k] = units_.length / units_.time * units_.template along<D>(all.velocity[row]);
    if (!all.radius.empty()) disks.radius[k] = units_.length * all.radius[row];
    if (!all.mass.empty()) disks.mass[k] = units_.mass * all.mass[row];
  }
  if (all.radius.empty()) remarks_.insert("no radii in the files: they are the case's");
  if (all.mass.empty()) remarks_.insert("no masses in the files: they are the case's");
  scene_ = target_.around(std::move(disks));
  scene_.bodies = target_.bodies;
  bare_ = scene_;
  bare_.bodies.clear();
  for (auto [basis, scene] : {std::pair(&basis_, &scene_), {&bareBasis_, &bare_}}) {
    *basis = auditBasis(*scene);
    basis->byOverlap = scene->law.soft();
    basis->prescribed = true;
  }
}

template <int D>
void FileSnapshotsOf<D>::allowForRounding(const FileFrame& frame) {
  const double rounding = roundingOf<D>(frame.particles.position, units_);
  if (rounding <= basis_.rounding) return;
  basis_.rounding = bareBasis_.rounding = rounding;
  remarks_.insert(fmt::format(
      "positions have few digits in the files: overlaps that follow from them are known to {:.2g} "
      "m",
      rounding * basis_.farthest));
}

template <int D>
SnapshotOf<D> FileSnapshotsOf<D>::convert(const FileFrame& frame) {
  const FileParticles& all = frame.particles;
  if (all.size() != ids_->size())
    fail(frame, fmt::format("{} particles, {} in the first snapshot", all.size(), ids_->size()));
  checkParticles(frame, units_, target_.box);
  requireContacts(frame);
  allowForRounding(frame);
  SnapshotOf<D> now;
  now.positionTime = now.velocityTime = now.contactTime = timeOf(frame);
  if (frame.contacts) now.contactTime -= units_.contactsBehind * step();
  const std::size_t count = ids_->disks();
  now.position.resize(count);
  now.velocity.resize(count);
  if (scene_.rotation && !all.spin.empty()) now.spin.emplace(count);
  if (scene_.rotation && all.spin.empty())
    remarks_.insert("no spins in the files: spin and what follows from it are not available");
  std::vector<bool> seen(ids_->size(), false);
  const double speed = units_.length / units_.time;
  for (std::size_t row = 0; row < all.size(); ++row) {
    const auto k = ids_->ourOf(all.id[row]);
    if (!k) fail(frame, fmt::format("particle {} is not in the first snapshot", all.id[row]));
    if (seen[*k]) fail(frame, describeTwice(all, all.id[row]));
    seen[*k] = true;
    if (*k >= count) continue;
    now.position[*k] = units_.length * units_.template along<D>(all.position[row]);
    now.velocity[*k] = speed * units_.template along<D>(all.velocity[row]);
    if (now.spin) (*now.spin)[*k] = units_.template about<D>(all.spin[row]) / units_.time;
  }
  placeWallsAsPrescribed(scene_, now.positionTime, now);
  now.contacts = frameContacts(frame, units_, *ids_, now, basis_, remarks_);
  return now;
}

namespace {

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
          "no contacts with walls in the files: stress, fabric and coordination lack them, and "
          "forces on walls are not available");
  }
  if (!why.empty()) fail(frame, why);
  if (!snapshot.contacts) return;
  if (wallContacts_) addWallForces(scene_, snapshot);
  if (lawDiffers_ || !scene_.law.soft()) return;
  AuditBasisOf<D> basis = basis_;
  basis.dt = step();
  const std::string differs = lawFault(snapshot, basis, scene_.law);
  lawDiffers_ = !differs.empty();
  if (lawDiffers_)
    remarks_.insert(
        fmt::format("{}: the forces are not those of the case's law: {}", frame.where, differs));
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

/// What is averaged is often at rest; what comes before shows whether times are right. Particles
/// that are walls count as well.
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
      earlyDisplacements_.compare(now, roundingOf<D>(all.position, units_) * farthest);
  if (found.factor) refuseMotion(frame, found);
}

template <int D>
std::optional<SnapshotOf<D>> FileSnapshotsOf<D>::next() {
  std::optional<FileFrame> frame = pending_ ? std::exchange(pending_, std::nullopt) : readWithin();
  if (!frame) return std::nullopt;
  SnapshotOf<D> snapshot = convert(*frame);
  checkMotion(*frame, snapshot);
  audit(*frame, snapshot);
  return snapshot;
}

template <int D>
std::vector<std::string> FileSnapshotsOf<D>::remarks() const {
  std::vector<std::string> all(remarks_.begin(), remarks_.end());
  if (early_ + late_ > 0)
    all.push_back(
        fmt::format("{} snapshots before {:.6g} s and {} after {:.6g} s are left out: the case "
                    "averages what is "
                    "between",
                    early_, target_.from, late_, target_.to));
  return all;
}

template class FileSnapshotsOf<2>;
template class FileSnapshotsOf<3>;

}  // namespace crossgrain::files
