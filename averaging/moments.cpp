#include "averaging/moments.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "averaging/contact_rule.hpp"
#include "averaging/patience.hpp"

namespace crossgrain::inline averaging {

namespace {

/// Adds weight · (stress tensor turned into (r, φ)).
void addStress(const Eigen::Matrix2d& stress, const Vec2& er, double weight, Moment into,
               Moments& moments) {
  const Vec2 ep = perpendicular(er);
  at(moments, into, 0) += weight * er.dot(stress * er);
  at(moments, into, 1) += weight * ep.dot(stress * ep);
  at(moments, into, 2) += weight * er.dot(stress * ep);
  at(moments, into, 3) += weight * ep.dot(stress * er);
}

/// Product of complex numbers: (cos, sin) of the sum of two angles.
Vec2 turned(const Vec2& a, const Vec2& b) {
  return {a.x() * b.x() - a.y() * b.y(), a.x() * b.y() + a.y() * b.x()};
}

/// The same of the difference.
Vec2 turnedBack(const Vec2& a, const Vec2& b) {
  return turned(a, Vec2(b.x(), -b.y()));
}

void requireLength(const char* what, std::size_t got, std::size_t wanted) {
  if (got != wanted)
    throw std::invalid_argument(
        fmt::format("averaging: the snapshot has {} {}, the scene has {}", got, what, wanted));
}

}  // namespace

template <int D>
void SceneCounts::require(const SnapshotOf<D>& snapshot, bool walls) const {
  requireLength("positions", snapshot.position.size(), disks);
  requireLength("velocities", snapshot.velocity.size(), disks);
  if (snapshot.spin) requireLength("spins", snapshot.spin->size(), disks);
  if (walls) requireLength("wall positions", snapshot.wallPosition.size(), wallDisks);
  if (!snapshot.contacts) return;
  const ContactsOf<D>& contacts = *snapshot.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = contacts.i[c];
    const auto j = contacts.j[c];
    if (i < 0 || static_cast<std::size_t>(i) >= disks || j <= i ||
        static_cast<std::size_t>(j) >= ids)
      throw std::invalid_argument(
          fmt::format("averaging: contact {} joins ids {} and {}; wanted is i < j, i a disk below "
                      "{}, j below {}",
                      c, i, j, disks, ids));
  }
}
template void SceneCounts::require(const Snapshot&, bool) const;
template void SceneCounts::require(const SpaceSnapshot&, bool) const;

MomentSums::MomentSums(std::shared_ptr<const Coordinates> coordinates,
                       const std::vector<Weight>& weights, const Scene& scene, bool countWallDisks)
    : coordinates_(std::move(coordinates)), counts_(scene), countWallDisks_(countWallDisks) {
  setBodies(scene);
  for (const Weight& weight : weights) sharings_.emplace_back(*coordinates_, weight);
}

void MomentSums::setBodies(const Scene& scene) {
  radius_ = scene.radii();
  mass_ = scene.disks.mass;
  inertia_ = scene.disks.inertia;
  shape_ = scene.disks.shape;
  box_ = scene.box;
  outlines_.clear();
  for (const ShapeOf<2>& shape : scene.shapes) outlines_.push_back(outlineOf(shape));
  area_.clear();
  for (std::size_t p = 0; p < mass_.size(); ++p)
    area_.push_back(scene.isConvex(p) ? massOf(scene.shapeOf(p)).measure
                                      : std::numbers::pi * radius_[p] * radius_[p]);
}

void MomentSums::changeDisks(const Scene& scene) {
  setBodies(scene);
  counts_ = SceneCounts(scene);
}

Vec2 MomentSums::arm(const Snapshot& snapshot, std::size_t c, std::size_t p) const {
  const Vec2 arm = snapshot.contacts->point[c] - snapshot.position[p];
  return box_ ? box_->nearest(arm) : arm;
}

void MomentSums::compute(const Snapshot& snapshot, std::vector<std::vector<Moments>>& sums) {
  counts_.require(snapshot, countWallDisks_ || snapshot.contacts);
  sums.resize(sharings_.size());
  for (std::vector<Moments>& bins : sums) bins.assign(coordinates_->slots(), Moments{});
  contactSums_.resize(radius_.size());
  for (ContactSums& zero : contactSums_) zero = ContactSums{};  // assign() copies a zero to each
  if (snapshot.contacts) sumContacts(snapshot);

  std::vector<Vec2> outline;
  for (std::size_t p = 0; p < mass_.size(); ++p) {
    throwIfLongInterrupted();  // a disk may reach over as many bins as there are
    const Vec2& x = snapshot.position[p];
    const bool convex = !shape_.empty() && shape_[p] >= 0;
    if (convex) {
      outline = outlines_[static_cast<std::size_t>(shape_[p])];
      const Eigen::Matrix2d axes = matrixOf<2>((*snapshot.turn)[p]);
      for (Vec2& vertex : outline) vertex = x + axes * vertex;
    }
    const Vec2 er = coordinates_->firstDirection(x);
    Moments moments = momentsOf(snapshot, p, er);
    for (const bool alongBranch : {true, false}) {  // those have their stress from addBranches()
      if (!alongBranch) addStress(contactSums_[p].stress, er, 1.0, Moment::stress, moments);
      for (std::size_t k = 0; k < sharings_.size(); ++k)
        if (sharings_[k].weight().alongBranch() == alongBranch)
          distribute(moments,
                     convex ? sharings_[k].ofBody(x, outline) : sharings_[k].ofDisk(x, radius_[p]),
                     sums[k]);
    }
  }
  for (std::size_t k = 0; k < sharings_.size(); ++k) {
    addWalls(snapshot, sharings_[k], sums[k]);
    if (snapshot.contacts && sharings_[k].weight().alongBranch())
      addBranches(snapshot, sharings_[k], sums[k]);
  }
}

void MomentSums::addWalls(const Snapshot& snapshot, Partition& partition,
                          std::vector<Moments>& sums) const {
  if (!countWallDisks_ && !snapshot.contacts) return;
  const auto add = [&](const Vec2& couple, const Eigen::Matrix2d& stress, const Vec2& er,
                       const BinFractions& fractions) {
    for (const auto& [slot, fraction] : fractions) {
      at(sums[slot], Moment::wallCouple, 0) += fraction * couple.dot(er);
      at(sums[slot], Moment::wallCouple, 1) += fraction * couple.dot(perpendicular(er));
      if (!partition.weight().alongBranch())
        addStress(stress, er, fraction, Moment::wallStress, sums[slot]);
    }
  };
  for (std::size_t w = 0; w < snapshot.wallPosition.size(); ++w) {
    const Vec2& x = snapshot.wallPosition[w];
    const double a = radius_[mass_.size() + w];
    if (countWallDisks_)
      for (const auto& [slot, fraction] : partition.ofDisk(x, a))
        at(sums[slot], Moment::wallVolume) +=
            fraction * std::numbers::pi * a * a * coordinates_->height();
    const ContactSums& contacts = contactSums_[mass_.size() + w];
    if (contacts.count > 0.0 && !coordinates_->isCartesian())
      add(contacts.couple, contacts.stress, coordinates_->firstDirection(x),
          partition.ofWallDisk(x, a));
  }
  if (!snapshot.contacts || !coordinates_->isCartesian()) return;
  const Contacts& contacts = *snapshot.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const auto j = static_cast<std::size_t>(contacts.j[c]);
    if (j < mass_.size() || j >= radius_.size() || !transmits(contacts, c)) continue;
    const Vec2& n = contacts.normal[c];
    const double a = radius_[j];
    add(a * a * contacts.tangentialForce[c] * n, a * contacts.force(c) * n.transpose(),
        Vec2::UnitX(), partition.ofDisk(snapshot.position[i], radius_[i]));
  }
}

void MomentSums::addBranches(const Snapshot& snapshot, Partition& partition,
                             std::vector<Moments>& sums) const {
  const Contacts& contacts = *snapshot.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    throwIfLongInterrupted();
    const Vec2& n = contacts.normal[c];
    const Eigen::Matrix2d forceNormal = contacts.force(c) * n.transpose();
    for (const bool first : {true, false}) {
      const auto p = static_cast<std::size_t>(first ? contacts.i[c] : contacts.j[c]);
      if (p >= radius_.size()) continue;  // a plane
      const bool wall = p >= mass_.size();
      double a = radius_[p];
      const Vec2& x = wall ? snapshot.wallPosition[p - mass_.size()] : snapshot.position[p];
      Vec2 branch = (first ? -a : a) * n;
      Eigen::Matrix2d forceAlong = forceNormal;
      if (!shape_.empty() && !wall) {
        branch = arm(snapshot, c, p);
        a = branch.norm();
        forceAlong = (first ? -1.0 : 1.0) / a * contacts.force(c) * branch.transpose();
      }
      for (const auto& [place, part] : branchPoints(a, partition.weight().width)) {
        const Vec2 point = x + place * branch;
        const Vec2 er = coordinates_->firstDirection(point);
        for (const auto& [slot, fraction] : wall && !coordinates_->isCartesian()
                                                ? partition.ofWallPoint(point, x, a)
                                                : partition.ofPoint(point))
          addStress(forceAlong, er, a * part * fraction, wall ? Moment::wallStress : Moment::stress,
                    sums[slot]);
      }
    }
  }
}

/// Neighbours in space are seldom neighbours in memory: from 10⁵ disks on a partner's sums are in
/// no cache, and waiting for them would be most of the time.
void MomentSums::fetch(std::int32_t disk) const {
  const auto p = static_cast<std::size_t>(disk);
  if (p >= radius_.size()) return;
  const char* sums = reinterpret_cast<const char*>(&contactSums_[p]);
  for (std::size_t line = 0; line < sizeof(ContactSums); line += 64)
    __builtin_prefetch(sums + line, 1);
}

void MomentSums::sumContacts(const Snapshot& snapshot) {
  const Contacts& contacts = *snapshot.contacts;
  constexpr std::size_t ahead = 16;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (c + ahead < contacts.size()) fetch(contacts.j[c + ahead]);
    if (!transmits(contacts, c)) continue;
    const Vec2& n = contacts.normal[c];
    // Disk i has f and l = −a n, disk j has −f and l = +a n: the same −f⊗l but for the radius.
    const Eigen::Matrix2d forceNormal = contacts.force(c) * n.transpose();
    const Vec2 two = turned(n, n), four = turned(two, two), six = turned(four, two);
    const double overlap = contacts.overlap[c];
    double side = -1.0;  // l = side · a n; (l × f)_z = −a f_t on both sides
    for (const auto id : {contacts.i[c], contacts.j[c]}) {
      const auto p = static_cast<std::size_t>(id);
      if (p < radius_.size()) {
        const double a = radius_[p];
        ContactSums& sums = contactSums_[p];
        if (!shape_.empty() && p < mass_.size()) {
          const Vec2 force = -side * contacts.force(c), l = arm(snapshot, c, p);
          sums.stress -= force * l.transpose();
          sums.couple -= cross(l, force) * l;
        } else {
          sums.stress += a * forceNormal;
          sums.couple += side * a * a * contacts.tangentialForce[c] * n;
        }
        sums.harmonic2 += two;
        sums.harmonic4 += four;
        sums.harmonic6 += six;
        sums.overlapHarmonic += a * overlap * two;
        sums.overlap += a * overlap;
        sums.count += 1.0;
      }
      side = 1.0;
    }
    if (!contacts.dissipation.empty()) addHeat(contacts, c);
  }
}

void MomentSums::addHeat(const Contacts& contacts, std::size_t c) {
  const auto i = static_cast<std::size_t>(contacts.i[c]);
  const auto j = static_cast<std::size_t>(contacts.j[c]);
  const bool pair = j < mass_.size();
  contactSums_[i].heat += (pair ? 0.5 : 1.0) * contacts.dissipation[c];
  if (pair) contactSums_[j].heat += 0.5 * contacts.dissipation[c];
}

Moments MomentSums::momentsOf(const Snapshot& snapshot, std::size_t p, const Vec2& er) const {
  const Vec2 ep = perpendicular(er);
  const double volume = area_[p] * coordinates_->height();
  const ContactSums& sums = contactSums_[p];

  Moments moments{};
  addMotion<2>(moments, volume, mass_[p],
               {snapshot.velocity[p].dot(er), snapshot.velocity[p].dot(ep)});
  if (snapshot.spin) {
    const double spin = (*snapshot.spin)[p];
    at(moments, Moment::spin) = volume * spin;
    at(moments, Moment::spinEnergy) = 0.5 * inertia_[p] * spin * spin;
  }
  if (sums.count == 0.0) return moments;

  const Vec2 two = turned(er, er), four = turned(two, two), six = turned(four, two);
  const Vec2 harmonic2 = turnedBack(sums.harmonic2, two);
  const Vec2 harmonic4 = turnedBack(sums.harmonic4, four);
  const Vec2 harmonic6 = turnedBack(sums.harmonic6, six);
  const Vec2 overlap = turnedBack(sums.overlapHarmonic, two);
  // Σ_c of a symmetric tensor from its trace and (cos 2α, sin 2α): n⊗n = ½(1 + cos 2α), ½(1 − cos
  // 2α), ½ sin 2α
  const auto addSymmetric = [&](Moment which, double weight, double trace, const Vec2& twice) {
    at(moments, which, 0) = 0.5 * weight * (trace + twice.x());
    at(moments, which, 1) = 0.5 * weight * (trace - twice.x());
    at(moments, which, 2) = 0.5 * weight * twice.y();
  };
  addSymmetric(Moment::fabric, volume, sums.count, harmonic2);
  // V δ/a = πh a δ
  addSymmetric(Moment::overlap, std::numbers::pi * coordinates_->height(), sums.overlap, overlap);
  addContactCounts<2>(moments, volume, sums.count);
  at(moments, Moment::heat) = sums.heat;
  const std::array<double, 4> harmonics = {harmonic4.x(), harmonic4.y(), harmonic6.x(),
                                           harmonic6.y()};
  for (int k = 0; k < 2; ++k) at(moments, Moment::couple, k) = sums.couple.dot(k == 0 ? er : ep);
  for (int k = 0; k < 4; ++k)
    at(moments, Moment::harmonics, k) = volume * harmonics[static_cast<std::size_t>(k)];
  return moments;
}

}  // namespace crossgrain::inline averaging
