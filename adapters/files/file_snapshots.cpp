#include "adapters/files/file_snapshots.hpp"

#include <fmt/format.h>
#include <numeric>

#include <algorithm>
#include <cmath>
#include <utility>

#include "adapters/audit_geometry.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::files {

namespace {

/// A wall disk is found within this share of its radius, and what six digits leave of its place.
constexpr double ofWallRadius = 1e-3, ofPlace = 1e-5;

/// Rows of the particles that are a body's wall disks.
template <int D>
class WallFinder {
 public:
  WallFinder(const FileFrame& frame, const FileUnits& units, const std::optional<BoxOf<D>>& box)
      : box_(box) {
    const FileParticles& all = frame.particles;
    for (const Vec3& x : all.position) place_.push_back(inBox(units.length * units.along<D>(x)));
    for (const double a : all.radius) radius_.push_back(units.length * a);
    order_.resize(place_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::sort(order_, {}, [&](std::size_t row) { return place_[row].x(); });
  }

  /// At these places. @returns in their order; rows that were not found are `none`
  std::vector<std::size_t> at(const std::vector<VecOf<D>>& places,
                              const std::vector<double>& radii) const {
    std::vector<std::size_t> rows;
    for (std::size_t w = 0; w < places.size(); ++w) rows.push_back(nearest(places[w], radii[w]));
    return rows;
  }

  /// On the circle about the body's centre, by their angle.
  std::vector<std::size_t> onCircle(const WallBody& body) const requires(D == 2) {
    std::vector<std::size_t> rows;
    if (body.diskPosition.empty()) return rows;
    const double wanted = (body.diskPosition.front() - body.centre).norm();
    const double a = body.diskRadius.front();
    for (std::size_t row = 0; row < place_.size(); ++row)
      if (hasRadius(row, a) && std::abs((place_[row] - body.centre).norm() - wanted) <=
                                   ofWallRadius * a + ofPlace * wanted)
        rows.push_back(row);
    std::ranges::sort(rows, {}, [&](std::size_t row) {
      const Vec2 from = place_[row] - body.centre;
      return std::atan2(from.y(), from.x());
    });
    return rows;
  }

  const VecOf<D>& place(std::size_t row) const { return place_[row]; }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

 private:
  bool hasRadius(std::size_t row, double a) const {
    return radius_.empty() || std::abs(radius_[row] - a) <= ofWallRadius * a;
  }
  VecOf<D> inBox(const VecOf<D>& place) const { return box_ ? box_->wrapped(place) : place; }
  std::size_t nearest(const VecOf<D>& whole, double a) const {
    const double within = ofWallRadius * a + ofPlace * whole.cwiseAbs().maxCoeff();
    const VecOf<D> place = inBox(whole);
    const auto xOf = [&](std::size_t row) { return place_[row].x(); };
    const auto search = [&](double x) {
      for (auto k = std::ranges::lower_bound(order_, x - within, {}, xOf);
           k != order_.end() && xOf(*k) <= x + within; ++k) {
        VecOf<D> apart = place_[*k] - place;
        if (box_) apart = box_->nearest(apart);
        if (hasRadius(*k, a) && apart.norm() <= within) return *k;
      }
      return none;
    };
    std::size_t found = search(place.x());
    if (!box_ || !box_->periodic[0]) return found;
    const double period = box_->high.x() - box_->low.x();
    for (const double image : {place.x() - period, place.x() + period})
      if (found == none) found = search(image);
    return found;
  }

  const std::optional<BoxOf<D>>& box_;
  std::vector<VecOf<D>> place_;  ///< in the box [m]
  std::vector<double> radius_;   ///< [m]
  std::vector<std::size_t> order_;
};

/// The reference places of wall disks that lie on a circle, from where they are.
void turnBack(WallBody& body, const std::vector<std::size_t>& rows, const WallFinder<2>& walls,
              double t) {
  const BodyState now = stateAt(body.motion, body.centre, t);
  const Eigen::Rotation2Dd back(-now.angle);
  for (std::size_t k = 0; k < rows.size(); ++k)
    body.diskPosition[k] = body.centre + back * (walls.place(rows[k]) - now.centre);
}

}  // namespace

template <int D>
std::vector<std::size_t> wallRows(const FileFrame& frame, const FileUnits& units,
                                  FileSceneOf<D>& target, double t) {
  std::vector<std::size_t> all;
  std::size_t wanted = 0;
  if (std::ranges::all_of(target.bodies,
                          [](const WallBodyOf<D>& b) { return b.diskRadius.empty(); }))
    return all;
  const WallFinder<D> walls(frame, units, target.box);
  for (WallBodyOf<D>& body : target.bodies) {
    const std::size_t count = body.diskRadius.size();
    wanted += count;
    std::vector<std::size_t> rows;
    if constexpr (D == 2)
      if (target.anyAngle) {
        rows = walls.onCircle(body);
        if (rows.size() == count) turnBack(body, rows, walls, t);
      }
    if (!target.anyAngle) {
      const BodyStateOf<D> now = stateAt(body.motion, body.centre, t);
      std::vector<VecOf<D>> places;
      for (const VecOf<D>& start : body.diskPosition)
        places.push_back(memberPosition<D>(now, body.centre, start));
      rows = walls.at(places, body.diskRadius);
      std::erase(rows, WallFinder<D>::none);
    }
    if (!rows.empty() && rows.size() != count)
      fail(frame, fmt::format("{} of the {} wall disks of {} are where the case has them at t = "
                              "{:.6g} s",
                              rows.size(), count, body.name, t));
    all.insert(all.end(), rows.begin(), rows.end());
  }
  if (!all.empty() && all.size() != wanted)
    fail(frame, fmt::format("{} of the case's {} wall disks are particles of the file, and the "
                            "others are not",
                            all.size(), wanted));
  return all;
}
template std::vector<std::size_t> wallRows(const FileFrame&, const FileUnits&, FileSceneOf<2>&,
                                           double);
template std::vector<std::size_t> wallRows(const FileFrame&, const FileUnits&, FileSceneOf<3>&,
                                           double);

template <int D>
FileSnapshotsOf<D>::FileSnapshotsOf(std::unique_ptr<FrameReader> reader, FileUnits units,
                                    FileSceneOf<D> target)
    : reader_(std::move(reader)),
      units_(units),
      target_(std::move(target)),
      displacements_(target_.gravity, driveOf<D>(target_.bodies), target_.box),
      earlyDisplacements_(displacements_),
      remarks_(target_.remarks.begin(), target_.remarks.end()) {
  units_.dimension = D;
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
  begin();
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
    if (!last_ && t <= target_.from + slack) {
      first_.emplace();
      first_->where = frame->where;
      first_->time = frame->time;
      first_->step = frame->step;
      first_->box = frame->box;
      first_->particles = frame->particles;
    }
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

/// Refuses snapshots some of which lack data that others have: their means would be of no time.
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
  settleBasis();
  learn(frame);
}

/// Sets what the audit compares snapshots with, from the present scene, with and without walls.
template <int D>
void FileSnapshotsOf<D>::settleBasis() {
  const double rounding = basis_.rounding;
  bare_ = scene_;
  bare_.bodies.clear();
  for (auto [basis, scene] : {std::pair(&basis_, &scene_), {&bareBasis_, &bare_}}) {
    *basis = auditBasis(*scene);
    basis->byOverlap = scene->law.soft();
    basis->prescribed = true;
    basis->rounding = std::max(basis->rounding, rounding);
  }
}

template <int D>
void FileSnapshotsOf<D>::allowForRounding(const FileFrame& frame) {
  const double rounding = roundingOf(frame.particles.position, units_);
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
  disksChanged_ = false;
  if (all.size() != ids_->size() ||
      std::ranges::any_of(all.id, [&](std::int64_t id) { return !ids_->ourOf(id); }))
    changeDisks(frame);
  if (all.size() > 0 && all.velocity.empty())
    fail(frame,
         "it has no velocities, the first snapshot has: nothing can be averaged without them");
  if (all.size() > 0) checkParticles(frame, units_, target_.box);
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
  const MissingComponent* const lack = neededComponent(all.missing, units_, true);
  const bool hasSpins = all.size() == 0 ? spins_.value_or(false) : !all.spin.empty();
  if (scene_.rotation && hasSpins && !lack) now.spin.emplace(count);
  if (scene_.rotation && !now.spin)
    remarks_.insert(
        fmt::format("no {} in the files: spin and what follows from it are not available",
                    lack ? lack->column : "spins"));
  std::vector<bool> seen(ids_->size(), false);
  const double speed = units_.length / units_.time;
  for (std::size_t row = 0; row < all.size(); ++row) {
    const auto k = ids_->ourOf(all.id[row]);
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
  if (fewest_ < most_ || cameAndWent_)
    all.push_back(fmt::format(
        "particles come and go: each snapshot counts those that are there, {} to {} of them",
        fewest_, most_));
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
