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

/// Of a file without a time that is the only one: the number in its name is a step if that is
/// averaged.
template <int D>
std::optional<double> FileSnapshotsOf<D>::timeByName(const FileFrame& frame) const {
  if (!frame.alone || !frame.step || units_.dt == 0.0) return std::nullopt;
  const double t = units_.time * (static_cast<double>(*frame.step) * units_.dt - units_.start);
  if (t < target_.from - instantSlack(shortestStep(), target_.from) ||
      t > target_.to + instantSlack(shortestStep(), target_.to))
    return std::nullopt;
  return t;
}

template <int D>
double FileSnapshotsOf<D>::timeOf(const FileFrame& frame) const {
  if (frame.alone && std::isfinite(target_.to)) return timeByName(frame).value_or(target_.to);
  if (frame.time) return units_.time * (*frame.time - units_.start);
  if (!frame.step) fail(frame, "it has neither a time nor a step");
  if (units_.dt == 0.0)
    fail(frame,
         fmt::format("it has a step and no time: say dt, the time step, in {}", target_.where));
  return units_.time * (static_cast<double>(*frame.step) * units_.dt - units_.start);
}

/// The next frame of the averaged time.
template <int D>
std::optional<FileFrame> FileSnapshotsOf<D>::readWithin() {
  const double slack = instantSlack(shortestStep(), target_.from);
  std::optional<FileFrame> atBegin;
  while (auto frame = reader_->next()) {
    const double t = timeOf(*frame);
    if (last_ && !(t > *last_))
      fail(*frame,
           fmt::format("it is of t = {:.9g} s, not after the one before of {:.9g} s", t, *last_));
    last_ = t;
    lastWhere_ = frame->where;
    if (frame->alone) {
      const bool named = timeByName(*frame).has_value();
      remarks_.insert(fmt::format("{} says no time: its snapshot is taken as {} t = {:.6g} s",
                                  frame->where,
                                  named ? fmt::format("step {} by its name,", *frame->step)
                                        : "of the end of the averaged time,",
                                  t));
    }
    if (t > target_.to + instantSlack(shortestStep(), target_.to)) {
      ++late_;
      continue;
    }
    const bool isEarly = t <= target_.from + slack;
    early_ += isEarly;
    if (isEarly || !ids_) checkEarlyMotion(*frame, t);
    if (!isEarly) return frame;
    if (t >= target_.from - slack) atBegin = std::move(frame);
  }
  if (ids_ || !atBegin) return std::nullopt;
  --early_;
  return atBegin;
}

/// Means over snapshots some of which lack what others have are of no time.
template <int D>
void FileSnapshotsOf<D>::requireSame(const FileFrame& frame, SnapshotOf<D>& now) {
  const auto require = [&](std::optional<bool>& first, bool here, const char* what,
                           const char* remedy) {
    if (first.value_or(here) != here)
      fail(frame, fmt::format("it has {}{}, the first averaged snapshot has {}: all or none should "
                              "have them{}",
                              here ? "" : "no ", what, here ? "none" : "some", remedy));
    first = here;
  };
  require(spins_, now.spin.has_value(), "spins", "");
  // Of contacts that are left out for want of tangential forces nothing is missing where none rubs.
  if (contacts_ == false && now.contacts &&
      std::ranges::all_of(now.contacts->tangentialForce,
                          [](const SpinOf<D>& force) { return force == noSpin<D>(); }))
    now.contacts.reset();
  require(contacts_, now.contacts.has_value(), "contacts with forces and their directions",
          "; to average without, leave the files or columns of contacts out");
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
  for (int axis = 0; frame.box && axis < 3; ++axis)
    if (frame.box->saidFixed[axis] && frame.box->periodic[axis])
      remarks_.insert(
          fmt::format("the files' box is fixed along {}, the case's is periodic and as wide: "
                      "theirs is taken as "
                      "periodic, too",
                      std::string_view("xyz").substr(static_cast<std::size_t>(axis), 1)));
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

/// The scene has one radius of each.
template <int D>
void FileSnapshotsOf<D>::checkRadius(const FileFrame& frame, std::size_t row, std::size_t k) const {
  constexpr double sixDigits = 1e-5;
  const double first = scene_.disks.radius[k], now = units_.length * frame.particles.radius[row];
  if (std::abs(now - first) > sixDigits * first)
    fail(frame, fmt::format("particle {} has radius {:.6g} m, in the first snapshot {:.6g} m",
                            frame.particles.id[row], now, first));
}

template <int D>
SnapshotOf<D> FileSnapshotsOf<D>::convert(const FileFrame& frame) {
  const FileParticles& all = frame.particles;
  if (all.size() != ids_->size())
    fail(frame, fmt::format("{} particles, {} in the first snapshot", all.size(), ids_->size()));
  if (all.velocity.empty())
    fail(frame,
         "it has no velocities, the first snapshot has: nothing can be averaged without them");
  checkParticles(frame, units_, target_.box);
  requireContacts(frame);
  allowForRounding(frame);
  SnapshotOf<D> now;
  now.positionTime = now.velocityTime = now.contactTime = timeOf(frame);
  const auto inCase = [&](double time) { return units_.time * (time - units_.start); };
  if (frame.velocityTime) now.velocityTime = inCase(*frame.velocityTime);
  if (frame.contactTime)
    now.contactTime = inCase(*frame.contactTime);
  else if (frame.contacts)
    now.contactTime -= units_.contactsBehind * step();
  const std::size_t count = ids_->disks();
  now.position.resize(count);
  now.velocity.resize(count);
  const MissingComponent* const lack = neededComponent<D>(all.missing, units_, true);
  if (scene_.rotation && !all.spin.empty() && !lack) now.spin.emplace(count);
  if (scene_.rotation && !now.spin)
    remarks_.insert(
        fmt::format("no {} in the files: spin and what follows from it are not available",
                    lack ? lack->column : "spins"));
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
    if (!all.radius.empty()) checkRadius(frame, row, *k);
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
  requireSame(*frame, snapshot);
  if (snapshots_++ > 0 && frame->timesSkipped > 0) {
    if (skipped_ == 0) firstSkipped_ = frame->firstSkipped;
    skipped_ += frame->timesSkipped;
  }
  checkSpeeds(*frame, snapshot);
  checkMotion(*frame, snapshot);
  audit(*frame, snapshot);
  return snapshot;
}

template <int D>
std::vector<std::string> FileSnapshotsOf<D>::remarks() const {
  std::vector<std::string> all(remarks_.begin(), remarks_.end());
  if (skipped_ > 0)
    all.push_back(fmt::format(
        "{}: contacts of a time that the files of particles lack ({} such time{} within what is "
        "averaged): there is no snapshot of it",
        firstSkipped_, skipped_, skipped_ == 1 ? "" : "s"));
  if (early_ + late_ > 0)
    all.push_back(
        fmt::format("{} snapshots up to {:.6g} s and {} after {:.6g} s are left out: the case "
                    "averages what is "
                    "between",
                    early_, target_.from, late_, target_.to));
  return all;
}

template class FileSnapshotsOf<2>;
template class FileSnapshotsOf<3>;

}  // namespace crossgrain::files
