#include "adapters/files/plane_snapshots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "adapters/audit_geometry.hpp"
#include "adapters/files/wall_particles.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::files {
namespace {

/// What moves along the third axis, or lies beside the others there, in units of what is largest.
constexpr double outOfPlane = 1e-6;

constexpr std::array<std::string_view, 3> planeNames = {"xy", "xz", "yz"};
constexpr std::string_view axisNames = "xyz";

/// YADE works its contacts out at the beginning of a step, and then moves on; all of these formats
/// are its exports.
bool isYades(std::string_view format) {
  return format == "yade-text" || format == "vtk" || format == "ondem";
}

}  // namespace

std::vector<SettingSpec> planeSettings(std::string_view format) {
  const double behind = isYades(format) ? 1.0 : 0.0;
  return {{"length", 1.0, "m", "unit of length of the files: 0.001 where they are in mm", {}},
          {"time", 1.0, "s", "unit of time of the files", {}},
          {"mass", 1.0, "kg", "unit of mass of the files", {}},
          {"dt",
           0.0,
           "file's time",
           "time step of files that count steps and have no times; 0: not said",
           {}},
          {"start", 0.0, "file's time", "when the case's t = 0 is", {}, -INFINITY},
          {"contacts_behind", behind, "steps", "by which contacts are older than positions", {}},
          {"plane",
           std::string("xy"),
           "",
           "axes of the files that are x and y of the case",
           {planeNames.begin(), planeNames.end()}},
          {"columns",
           std::string(),
           "",
           "what columns mean whose names are the user's own (docs/file-formats.md)",
           {}}};
}

PlaneUnits planeUnits(std::string_view format, const Settings& settings) {
  Settings all;
  for (const SettingSpec& spec : planeSettings(format)) all[spec.name] = spec.defaultValue;
  for (const auto& [name, value] : settings) all[name] = value;
  const auto number = [&](const char* name) { return std::get<double>(all.at(name)); };
  PlaneUnits units;
  units.length = number("length");
  units.time = number("time");
  units.mass = number("mass");
  for (const auto& [name, value] :
       {std::pair("length", units.length), {"time", units.time}, {"mass", units.mass}})
    if (!(value > 0.0)) throw BadInput(fmt::format("{} = {:g}: a unit must be > 0", name, value));
  units.dt = number("dt");
  units.start = number("start");
  units.contactsBehind = number("contacts_behind");
  // The third axis, seen so that the second is a quarter turn counter-clockwise from the first:
  // z × x = y, y × z = x, but x × z = −y.
  const std::string& plane = std::get<std::string>(all.at("plane"));
  units.axes[0] = plane == "yz" ? 1 : 0;
  units.axes[1] = plane == "xy" ? 1 : 2;
  units.turn = plane == "xz" ? -1.0 : 1.0;
  return units;
}

ParticleIds::ParticleIds(const std::vector<std::int64_t>& idOfRow,
                         const std::vector<std::size_t>& walls)
    : sorted_(idOfRow), ours_(idOfRow.size()), disks_(idOfRow.size() - walls.size()) {
  std::ranges::sort(sorted_);
  const auto placeOf = [&](std::size_t row) {
    return static_cast<std::size_t>(std::ranges::lower_bound(sorted_, idOfRow[row]) -
                                    sorted_.begin());
  };
  std::vector<bool> isWall(sorted_.size(), false);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    isWall[placeOf(walls[w])] = true;
    ours_[placeOf(walls[w])] = disks_ + w;
  }
  std::size_t next = 0;
  theirs_.resize(sorted_.size());
  for (std::size_t k = 0; k < sorted_.size(); ++k) {
    if (!isWall[k]) ours_[k] = next++;
    theirs_[ours_[k]] = sorted_[k];
  }
}

std::optional<std::size_t> ParticleIds::ourOf(std::int64_t id) const {
  if (sorted_.empty() || id < sorted_.front() || id > sorted_.back()) return std::nullopt;
  // Ids without gaps are where they are counted.
  auto k = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(sorted_.front());
  if (k >= sorted_.size() || sorted_[k] != id) {
    const auto found = std::ranges::lower_bound(sorted_, id);
    if (*found != id) return std::nullopt;
    k = static_cast<std::uint64_t>(found - sorted_.begin());
  }
  return ours_[k];
}

namespace {

[[noreturn]] void fail(const FileFrame& frame, const std::string& what) {
  throw BadInput(fmt::format("{}: {}", frame.where, what));
}

/// @throws BadInput  where something lies beside the others, or moves out of the plane
void checkPlane(const FileFrame& frame, const PlaneUnits& units) {
  const FileParticles& all = frame.particles;
  const int third = units.third();
  const Vec3& first = all.position.front();
  Vec3 low = first, high = first;
  for (const Vec3& x : all.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double extent = (high - low).maxCoeff();
  if (high[third] - low[third] > outOfPlane * extent) {
    std::string hint;
    for (std::size_t k = 0; k < planeNames.size(); ++k)  // the plane without axis 2, 1, 0
      if (const int other = 2 - static_cast<int>(k); (high - low)[other] <= outOfPlane * extent)
        hint = fmt::format("; nothing differs in {}: say plane = \"{}\"",
                           axisNames[static_cast<std::size_t>(other)], planeNames[k]);
    fail(frame,
         fmt::format("particles lie from {} = {:.6g} to {:.6g}: cases are plane{}",
                     axisNames[static_cast<std::size_t>(third)], low[third], high[third], hint));
  }
  double speed = 0.0, spin = 0.0;
  for (const Vec3& v : all.velocity) speed = std::max(speed, v.norm());
  for (const Vec3& w : all.spin) spin = std::max(spin, w.norm());
  for (std::size_t k = 0; k < all.velocity.size(); ++k)
    if (std::abs(all.velocity[k][third]) > outOfPlane * speed)
      fail(frame, fmt::format("particle {} moves along {}: cases are plane", all.id[k],
                              axisNames[static_cast<std::size_t>(third)]));
  for (std::size_t k = 0; k < all.spin.size(); ++k)
    if (Vec3 w = all.spin[k]; w[third] = 0.0, w.norm() > outOfPlane * spin)
      fail(frame, fmt::format("particle {} spins about an axis that lies in the plane", all.id[k]));
}

/// Whatever crosses a periodic edge has an image: cases know none.
void checkEdges(const FileFrame& frame, const PlaneUnits& units) {
  if (!frame.box) return;
  const FileParticles& all = frame.particles;
  for (const int axis : units.axes) {
    if (!frame.box->periodic[axis]) continue;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const double x = all.position[k][axis], a = all.radius.empty() ? 0.0 : all.radius[k];
      if (x - a < frame.box->low[axis] || x + a > frame.box->high[axis])
        fail(frame,
             fmt::format(
                 "particle {} reaches over the periodic edge at {} = {:.6g}: cases have no "
                 "periodic edges",
                 all.id[k], axisNames[static_cast<std::size_t>(axis)],
                 x - a < frame.box->low[axis] ? frame.box->low[axis] : frame.box->high[axis]));
    }
  }
}

/// Decimal digits that a number gets by with.
int digitsOf(double x) {
  const std::string text = fmt::format("{}", std::abs(x)),
                    mantissa = text.substr(0, text.find('e'));
  int digits = 0, zeros = 0;
  for (const char c : mantissa) {
    if (c == '.') continue;
    if (c == '0') {
      zeros += digits > 0;  // those in front do not count, those behind are not known yet
      continue;
    }
    digits += zeros + 1;
    zeros = 0;
  }
  return digits;
}

/// Relative rounding of coordinates: twice the last digit of files that write five to eight of
/// them, as half of all coordinates then use the last two; else single precision's. Round numbers
/// of a lattice are no sign of it.
double roundingOf(const std::vector<Vec3>& position, const PlaneUnits& units) {
  constexpr std::size_t most = 1000;
  const std::size_t stride = std::max<std::size_t>(1, position.size() / most);
  std::array<std::size_t, 20> count{};
  std::size_t all = 0;
  for (std::size_t k = 0; k < position.size(); k += stride)
    for (const int axis : units.axes)
      if (const double x = position[k][axis]; x != 0.0) {
        ++count[static_cast<std::size_t>(std::min(digitsOf(x), 19))];
        ++all;
      }
  std::size_t digits = count.size() - 1;
  while (digits > 0 && count[digits] == 0) --digits;
  if (digits < 5 || digits > 8 || 2 * (count[digits] + count[digits - 1]) < all) return 1e-6;
  return 2.0 * std::pow(10.0, 1.0 - static_cast<double>(digits));
}

}  // namespace

PlaneSnapshots::PlaneSnapshots(std::unique_ptr<FrameReader> reader, PlaneUnits units,
                               PlaneScene target)
    : reader_(std::move(reader)),
      units_(units),
      target_(std::move(target)),
      displacements_(target_.gravity, driveOf(target_.bodies)),
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

double PlaneSnapshots::timeOf(const FileFrame& frame) const {
  if (frame.time) return units_.time * (*frame.time - units_.start);
  if (!frame.step) fail(frame, "it has neither a time nor a step");
  if (units_.dt == 0.0)
    fail(frame,
         fmt::format("it has a step and no time: say dt, the time step, in {}", target_.where));
  return units_.time * (static_cast<double>(*frame.step) * units_.dt - units_.start);
}

/// The next frame of the averaged time, which ends with a whole step.
std::optional<FileFrame> PlaneSnapshots::readWithin() {
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
void PlaneSnapshots::requireContacts(const FileFrame& frame) const {
  if (frame.contacts || frame.contactsOfOtherTimes.empty()) return;
  fail(frame,
       fmt::format("there are no contacts of this time, {}: average a time that has them (now "
                   "{:.6g} to {:.6g} s), or leave the files of contacts out to average without",
                   frame.contactsOfOtherTimes, target_.from, target_.to));
}

void PlaneSnapshots::recognise(const FileFrame& frame) {
  const FileParticles& all = frame.particles;
  if (all.size() == 0) fail(frame, "it has no particles");
  if (all.velocity.empty())
    fail(frame, "there are no velocities in the files: nothing can be averaged without them");
  checkPlane(frame, units_);
  const std::vector<std::size_t> walls = wallRows(frame, units_, target_, timeOf(frame));
  ids_.emplace(all.id, walls);
  Disks disks;
  const std::size_t count = ids_->disks();
  disks.position.resize(count);
  disks.velocity.resize(count);
  disks.spin.assign(count, 0.0);
  if (!all.radius.empty()) disks.radius.resize(count);
  if (!all.mass.empty()) disks.mass.resize(count);
  for (std::size_t row = 0; row < all.size(); ++row) {
    const std::size_t k = *ids_->ourOf(all.id[row]);
    if (k >= count) continue;
    disks.position[k] = units_.length * units_.inPlane(all.position[row]);
    disks.velocity[k] = units_.length / units_.time * units_.inPlane(all.velocity[row]);
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

void PlaneSnapshots::allowForRounding(const FileFrame& frame) {
  const double rounding = roundingOf(frame.particles.position, units_);
  if (rounding <= basis_.rounding) return;
  basis_.rounding = bareBasis_.rounding = rounding;
  remarks_.insert(fmt::format(
      "positions have few digits in the files: overlaps that follow from them are known to {:.2g} "
      "m",
      rounding * basis_.farthest));
}

Snapshot PlaneSnapshots::convert(const FileFrame& frame) {
  const FileParticles& all = frame.particles;
  if (all.size() != ids_->size())
    fail(frame, fmt::format("{} particles, {} in the first snapshot", all.size(), ids_->size()));
  checkPlane(frame, units_);
  checkEdges(frame, units_);
  requireContacts(frame);
  allowForRounding(frame);
  Snapshot now;
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
    now.position[*k] = units_.length * units_.inPlane(all.position[row]);
    now.velocity[*k] = speed * units_.inPlane(all.velocity[row]);
    if (now.spin) (*now.spin)[*k] = units_.aboutNormal(all.spin[row]) / units_.time;
  }
  placeWallsAsPrescribed(scene_, now.positionTime, now);
  now.contacts = planeContacts(frame, units_, *ids_, now, basis_, remarks_);
  return now;
}

namespace {

/// Sums over contacts with each body: what the disks do to it, about its centre.
void addWallForces(const Scene& scene, Snapshot& now) {
  const std::size_t disks = scene.disks.size(), round = disks + scene.wallDiskCount();
  std::vector<std::size_t> bodyOf(round + scene.planeCount());
  std::size_t disk = disks, plane = round;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    for (std::size_t k = 0; k < scene.bodies[b].diskRadius.size(); ++k) bodyOf[disk++] = b;
    for (std::size_t k = 0; k < scene.bodies[b].planes.size(); ++k) bodyOf[plane++] = b;
    now.bodies[b].force = Vec2::Zero();
    now.bodies[b].torque = 0.0;
  }
  const Contacts& contacts = *now.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const auto j = static_cast<std::size_t>(contacts.j[c]);
    if (j < disks) continue;
    BodySnapshot& body = now.bodies[bodyOf[j]];
    const Vec2 point =
        now.position[i] - (scene.disks.radius[i] - 0.5 * contacts.overlap[c]) * contacts.normal[c];
    const Vec2 force = -contacts.force(c);
    *body.force += force;
    *body.torque += cross(point - body.centre, force);
    if (!contacts.rollingTorque.empty()) *body.torque -= contacts.rollingTorque[c];
  }
}

/// Whether the forces have the signs of a law without attraction.
std::string signFault(const Contacts& contacts, const Scene& scene) {
  double sum = 0.0;
  for (const double f : contacts.normalForce) sum += f;
  if (!(sum < 0.0) || scene.law.coheres()) return {};
  return fmt::format(
      "normal forces attract, {:.4g} N over {} contacts, although the law has no cohesion; has "
      "normal_force the other sign?",
      sum, contacts.size());
}

}  // namespace

void PlaneSnapshots::audit(const FileFrame& frame, Snapshot& snapshot) {
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
  AuditBasis basis = basis_;
  basis.dt = step();
  const std::string differs = lawFault(snapshot, basis, scene_.law);
  lawDiffers_ = !differs.empty();
  if (lawDiffers_)
    remarks_.insert(
        fmt::format("{}: the forces are not those of the case's law: {}", frame.where, differs));
}

std::string PlaneSnapshots::remedyOfMotion(const FileFrame& frame) const {
  if (frame.time) return "velocities should be in the files' length per the files' time";
  return fmt::format(
      "is dt = {:g} in {} the time step, and are velocities in the files' length per the files' "
      "time?",
      units_.dt, target_.where);
}

void PlaneSnapshots::refuseMotion(const FileFrame& frame,
                                  const Displacements::Finding& found) const {
  fail(frame,
       fmt::format("{} disks that move have gone {:.4g} times as far since the snapshot before as "
                   "their velocities say: {}",
                   found.of, *found.factor, remedyOfMotion(frame)));
}

/// Positions and velocities that do not belong together are of a wrong time step or unit.
void PlaneSnapshots::checkMotion(const FileFrame& frame, const Snapshot& now) {
  const Displacements::Finding found =
      displacements_.compare(now, basis_.rounding * basis_.farthest);
  if (found.factor) refuseMotion(frame, found);
  if (found.rms && std::exchange(moves_, false))
    remarks_.insert(
        fmt::format("{}: disks have gone {:.3g} times as far since the snapshot before as their "
                    "velocities say (root mean square): {}",
                    frame.where, *found.rms, remedyOfMotion(frame)));
}

/// What is averaged is often at rest; what comes before shows whether times are right. Particles
/// that are walls count as well.
void PlaneSnapshots::checkEarlyMotion(const FileFrame& frame, double t) {
  const FileParticles& all = frame.particles;
  if (t < 0.0 || all.velocity.size() != all.size() || all.size() == 0) return;
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (!std::ranges::is_sorted(all.id))
    std::ranges::sort(order, {}, [&](std::size_t row) { return all.id[row]; });
  Snapshot now;
  now.positionTime = t;
  std::vector<std::int64_t> ids;
  double farthest = 0.0;
  for (const std::size_t row : order) {
    ids.push_back(all.id[row]);
    now.position.push_back(units_.length * units_.inPlane(all.position[row]));
    now.velocity.push_back(units_.length / units_.time * units_.inPlane(all.velocity[row]));
    farthest = std::max(farthest, now.position.back().cwiseAbs().maxCoeff());
  }
  if (ids != earlyIds_) earlyDisplacements_ = displacements_;  // nothing to compare with
  earlyIds_ = std::move(ids);
  const Displacements::Finding found =
      earlyDisplacements_.compare(now, roundingOf(all.position, units_) * farthest);
  if (found.factor) refuseMotion(frame, found);
}

std::optional<Snapshot> PlaneSnapshots::next() {
  std::optional<FileFrame> frame = pending_ ? std::exchange(pending_, std::nullopt) : readWithin();
  if (!frame) return std::nullopt;
  Snapshot snapshot = convert(*frame);
  checkMotion(*frame, snapshot);
  audit(*frame, snapshot);
  return snapshot;
}

std::vector<std::string> PlaneSnapshots::remarks() const {
  std::vector<std::string> all(remarks_.begin(), remarks_.end());
  if (early_ + late_ > 0)
    all.push_back(
        fmt::format("{} snapshots before {:.6g} s and {} after {:.6g} s are left out: the case "
                    "averages what is "
                    "between",
                    early_, target_.from, late_, target_.to));
  return all;
}

}  // namespace crossgrain::files
