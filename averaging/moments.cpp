#include "averaging/moments.hpp"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

namespace crossgrain {

namespace {

/// Adds weight · (stress tensor turned into (r, φ)).
void addStress(const Eigen::Matrix2d& stress, const Vec2& er, double weight, Moments& moments) {
  const Vec2 ep = perpendicular(er);
  at(moments, Moment::stressRR) += weight * er.dot(stress * er);
  at(moments, Moment::stressPP) += weight * ep.dot(stress * ep);
  at(moments, Moment::stressRP) += weight * er.dot(stress * ep);
  at(moments, Moment::stressPR) += weight * ep.dot(stress * er);
}

void requireLength(const char* what, std::size_t got, std::size_t wanted) {
  if (got != wanted)
    throw std::invalid_argument(
        fmt::format("averaging: the snapshot has {} {}, the scene has {}", got, what, wanted));
}

}  // namespace

MomentSums::MomentSums(const Rings& rings, const Scene& scene, bool countWallDisks)
    : rings_(rings),
      radius_(scene.disks.radius),
      mass_(scene.disks.mass),
      planes_(scene.planeCount()),
      countWallDisks_(countWallDisks) {
  for (const WallBody& body : scene.bodies)
    radius_.insert(radius_.end(), body.diskRadius.begin(), body.diskRadius.end());
}

void MomentSums::compute(const Snapshot& snapshot, const std::vector<WeightMethod>& methods,
                         std::vector<std::vector<Moments>>& sums) {
  check(snapshot);
  sums.resize(methods.size());
  for (std::vector<Moments>& bins : sums) bins.assign(rings_.slots(), Moments{});

  contactSums_.assign(radius_.size(), ContactSums{});
  if (snapshot.contacts) sumContacts(*snapshot.contacts);
  for (std::size_t p = 0; p < mass_.size(); ++p)
    distribute(momentsOf(snapshot, p), snapshot.position[p].norm(), radius_[p], methods, sums);

  if (snapshot.contacts) addWallStress(snapshot, methods, sums);

  if (!countWallDisks_) return;
  for (std::size_t w = 0; w < snapshot.wallPosition.size(); ++w) {
    Moments moments{};
    const double a = radius_[mass_.size() + w];
    at(moments, Moment::wallVolume) = std::numbers::pi * a * a * rings_.height();
    distribute(moments, snapshot.wallPosition[w].norm(), a, methods, sums);
  }
}

namespace {

/// The weights of a wall disk's part in the cell: what reaches into the overflow bins is given to
/// the rings. A disk that reaches no ring stays where it is.
void keepInCell(const Rings& rings, double r, double a, BinWeights& weights) {
  const auto last = [&] { return weights.first + static_cast<int>(weights.fraction.size()) - 1; };
  const bool reachesRing =
      r + a > rings.innerRadius() && r - a < rings.outerRadius() && !weights.fraction.empty();
  if (!reachesRing) return;
  double kept = 0.0;
  for (int bin = weights.first; bin <= last(); ++bin) {
    double& fraction = weights.fraction[static_cast<std::size_t>(bin - weights.first)];
    if (bin < 0 || bin >= rings.count()) fraction = 0.0;
    kept += fraction;
  }
  if (kept > 0.0) {
    for (double& fraction : weights.fraction) fraction /= kept;
  } else {  // all or nothing by its centre, which lies on the wall
    weights.first = r < rings.centre(0) ? 0 : rings.count() - 1;
    weights.fraction.assign(1, 1.0);
  }
}

}  // namespace

void MomentSums::addWallStress(const Snapshot& snapshot, const std::vector<WeightMethod>& methods,
                               std::vector<std::vector<Moments>>& sums) {
  for (std::size_t w = 0; w < snapshot.wallPosition.size(); ++w) {
    const ContactSums& contacts = contactSums_[mass_.size() + w];
    const double r = snapshot.wallPosition[w].norm();
    if (contacts.count == 0.0 || r == 0.0) continue;
    const Vec2 er = snapshot.wallPosition[w] / r;
    const double a = radius_[mass_.size() + w];
    for (std::size_t k = 0; k < methods.size(); ++k) {
      binWeights(rings_, methods[k], r, a, weights_);
      keepInCell(rings_, r, a, weights_);
      for (std::size_t b = 0; b < weights_.fraction.size(); ++b)
        addStress(contacts.stress, er, weights_.fraction[b],
                  sums[k][rings_.slot(weights_.first + static_cast<int>(b))]);
    }
  }
}

void MomentSums::check(const Snapshot& snapshot) const {
  const std::size_t disks = mass_.size();
  requireLength("positions", snapshot.position.size(), disks);
  requireLength("velocities", snapshot.velocity.size(), disks);
  if (snapshot.spin) requireLength("spins", snapshot.spin->size(), disks);
  if (countWallDisks_ || snapshot.contacts)
    requireLength("wall positions", snapshot.wallPosition.size(), radius_.size() - disks);
  if (!snapshot.contacts) return;
  const Contacts& contacts = *snapshot.contacts;
  const std::size_t ids = radius_.size() + planes_;
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

void MomentSums::sumContacts(const Contacts& contacts) {
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const auto j = static_cast<std::size_t>(contacts.j[c]);
    const Vec2& n = contacts.normal[c];
    const Vec2 forceOnI =
        contacts.normalForce[c] * n + contacts.tangentialForce[c] * perpendicular(n);
    // Disk i has f and l = −a n, disk j has −f and l = +a n: the same −f⊗l but for the radius.
    const Eigen::Matrix2d forceNormal = forceOnI * n.transpose();
    const Eigen::Matrix2d normalNormal = n * n.transpose();
    for (const std::size_t p : {i, j}) {
      if (p >= radius_.size()) continue;
      contactSums_[p].stress += radius_[p] * forceNormal;
      contactSums_[p].fabric += normalNormal;
      contactSums_[p].count += 1.0;
    }
  }
}

Moments MomentSums::momentsOf(const Snapshot& snapshot, std::size_t p) const {
  const double distance = snapshot.position[p].norm();
  const Vec2 er = distance > 0.0 ? Vec2(snapshot.position[p] / distance) : Vec2(Vec2::UnitX());
  const Vec2 ep = perpendicular(er);
  const double m = mass_[p];
  const double volume = std::numbers::pi * radius_[p] * radius_[p] * rings_.height();
  const double vr = snapshot.velocity[p].dot(er);
  const double vp = snapshot.velocity[p].dot(ep);
  const auto& [stress, fabric, count] = contactSums_[p];

  Moments moments{};
  at(moments, Moment::volume) = volume;
  at(moments, Moment::mass) = m;
  at(moments, Moment::velocityR) = volume * vr;
  at(moments, Moment::velocityP) = volume * vp;
  if (snapshot.spin) at(moments, Moment::spin) = volume * (*snapshot.spin)[p];
  addStress(stress, er, 1.0, moments);
  at(moments, Moment::dynamicRR) = m * vr * vr;
  at(moments, Moment::dynamicPP) = m * vp * vp;
  at(moments, Moment::dynamicRP) = m * vr * vp;
  at(moments, Moment::fabricRR) = volume * er.dot(fabric * er);
  at(moments, Moment::fabricPP) = volume * ep.dot(fabric * ep);
  at(moments, Moment::fabricRP) = volume * er.dot(fabric * ep);
  at(moments, Moment::contacts) = volume * count;
  return moments;
}

void MomentSums::distribute(const Moments& moments, double r, double a,
                            const std::vector<WeightMethod>& methods,
                            std::vector<std::vector<Moments>>& sums) {
  for (std::size_t k = 0; k < methods.size(); ++k) {
    binWeights(rings_, methods[k], r, a, weights_);
    Moments* bin = &sums[k][rings_.slot(weights_.first)];
    for (const double w : weights_.fraction) {
      for (std::size_t q = 0; q < momentCount; ++q) (*bin)[q] += w * moments[q];
      ++bin;
    }
  }
}

}  // namespace crossgrain
