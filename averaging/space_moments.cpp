#include "averaging/space_moments.hpp"

#include <numbers>
#include <utility>

#include "averaging/contact_rule.hpp"
#include "averaging/patience.hpp"

namespace crossgrain::inline averaging {

namespace {

void add(SpaceMoments& moments, Moment which, const Vec3& vector, double weight) {
  for (int k = 0; k < 3; ++k) at(moments, which, k) += weight * vector[k];
}

/// Weight · f⊗l, turned into the directions at its place.
void addStress(SpaceMoments& moments, const Vec3& force, const Vec3& branch, double weight) {
  for (int q = 0; q < 9; ++q) {
    const auto [row, column] = tensorIn<3>[static_cast<std::size_t>(q)];
    at(moments, Moment::stress, q) += weight * force[row] * branch[column];
  }
}

/// Σ_c of a symmetric tensor, turned.
void addSymmetric(SpaceMoments& moments, Moment which, double weight,
                  const std::array<double, 6>& sums, const Eigen::Matrix3d& turn) {
  Eigen::Matrix3d tensor;
  for (std::size_t q = 0; q < 6; ++q) {
    const auto [row, column] = symmetricIn<3>[q];
    tensor(row, column) = tensor(column, row) = sums[q];
  }
  tensor = turn * tensor * turn.transpose();
  for (int q = 0; q < 6; ++q) {
    const auto [row, column] = symmetricIn<3>[static_cast<std::size_t>(q)];
    at(moments, which, q) = weight * tensor(row, column);
  }
}

}  // namespace

SpaceMomentSums::SpaceMomentSums(std::shared_ptr<const SpaceBins> bins,
                                 const std::vector<Weight>& weights, const SpaceScene& scene)
    : bins_(std::move(bins)), weights_(weights), counts_(scene) {
  setBodies(scene);
  for (const Weight& weight : weights_) bins_->require(weight);
}

void SpaceMomentSums::setBodies(const SpaceScene& scene) {
  radius_ = scene.radii();
  mass_ = scene.disks.mass;
  shape_ = scene.disks.shape;
  box_ = scene.box;
  points_.clear();
  for (const ShapeOf<3>& shape : scene.shapes) points_.push_back(pointsIn(shape));
  volume_.clear();
  for (std::size_t p = 0; p < mass_.size(); ++p) {
    const double a = radius_[p];
    volume_.push_back(scene.isConvex(p) ? massOf(scene.shapeOf(p)).measure
                                        : 4.0 / 3.0 * std::numbers::pi * a * a * a);
  }
}

void SpaceMomentSums::changeDisks(const SpaceScene& scene) {
  setBodies(scene);
  counts_ = SceneCounts(scene);
}

void SpaceMomentSums::compute(const SpaceSnapshot& snapshot,
                              std::vector<std::vector<SpaceMoments>>& sums) {
  counts_.require(snapshot, false);
  sums.resize(weights_.size());
  for (std::vector<SpaceMoments>& slots : sums) slots.assign(bins_->slots(), SpaceMoments{});
  contactSums_.assign(mass_.size(), ContactSums{});
  if (snapshot.contacts) sumContacts(*snapshot.contacts);

  for (std::size_t p = 0; p < mass_.size(); ++p) {
    throwIfLongInterrupted();  // a sphere may reach over as many bins as there are
    const SpaceMoments moments = momentsOf(snapshot, p);
    std::vector<Vec3> filling;
    if (!shape_.empty() && shape_[p] >= 0) {
      const Eigen::Matrix3d axes = matrixOf<3>((*snapshot.turn)[p]);
      for (const Vec3& point : points_[static_cast<std::size_t>(shape_[p])])
        filling.emplace_back(snapshot.position[p] + axes * point);
    }
    for (std::size_t k = 0; k < weights_.size(); ++k) {
      if (filling.empty())
        bins_->sphereFractions(snapshot.position[p], radius_[p], weights_[k], fractions_);
      else
        bins_->bodyFractions(snapshot.position[p], radius_[p], filling, weights_[k], fractions_);
      distribute(moments, fractions_, sums[k]);
    }
  }
  if (snapshot.contacts)
    for (std::size_t k = 0; k < weights_.size(); ++k) addBranches(snapshot, weights_[k], sums[k]);
}

void SpaceMomentSums::sumContacts(const ContactsOf<3>& contacts) {
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!transmits(contacts, c)) continue;
    const Vec3& n = contacts.normal[c];
    const bool pair = static_cast<std::size_t>(contacts.j[c]) < mass_.size();
    for (const auto id : {contacts.i[c], contacts.j[c]}) {
      const auto p = static_cast<std::size_t>(id);
      if (p >= mass_.size()) continue;
      ContactSums& sums = contactSums_[p];
      for (std::size_t q = 0; q < 6; ++q) {
        const auto [row, column] = symmetricIn<3>[q];
        sums.fabric[q] += n[row] * n[column];
        sums.overlap[q] += contacts.overlap[c] / radius_[p] * n[row] * n[column];
      }
      sums.count += 1.0;
      if (!contacts.dissipation.empty()) sums.heat += (pair ? 0.5 : 1.0) * contacts.dissipation[c];
    }
  }
}

SpaceMoments SpaceMomentSums::momentsOf(const SpaceSnapshot& snapshot, std::size_t p) const {
  const double m = mass_[p], V = volume_[p];
  const Eigen::Matrix3d turn = bins_->directions(snapshot.position[p]).transpose();
  const ContactSums& sums = contactSums_[p];

  SpaceMoments moments{};
  addMotion<3>(moments, V, m, turn * snapshot.velocity[p]);
  if (snapshot.spin) add(moments, Moment::spin, turn * (*snapshot.spin)[p], V);
  if (sums.count == 0.0) return moments;
  addSymmetric(moments, Moment::fabric, V, sums.fabric, turn);
  addSymmetric(moments, Moment::overlap, V, sums.overlap, turn);
  addContactCounts<3>(moments, V, sums.count);
  at(moments, Moment::heat) = sums.heat;
  return moments;
}

void SpaceMomentSums::addBranches(const SpaceSnapshot& snapshot, const Weight& weight,
                                  std::vector<SpaceMoments>& sums) {
  const ContactsOf<3>& pairs = *snapshot.contacts;
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    throwIfLongInterrupted();
    if (!transmits(pairs, c)) continue;
    const auto i = static_cast<std::size_t>(pairs.i[c]), j = static_cast<std::size_t>(pairs.j[c]);
    const bool wall = j >= mass_.size();
    const double beyond = !wall ? radius_[j] : j < radius_.size() ? 0.5 * pairs.overlap[c] : 0.0;
    const double length = radius_[i] - pairs.overlap[c] + beyond;
    const Vec3& x = snapshot.position[i];
    Vec3 branch = length * pairs.normal[c];
    if (!shape_.empty()) {
      branch = x - (wall ? pairs.point[c] : snapshot.position[j]);
      if (box_) branch = box_->nearest(branch);
    }
    const Vec3 force = pairs.force(c);
    bins_->lineFractions(x, -branch, weight, along_);
    for (const auto& [slot, w, place] : along_) {
      const Eigen::Matrix3d turn = bins_->directions(place).transpose();
      addStress(sums[slot], turn * force, turn * branch, w);
      at(sums[slot], Moment::branches) += w;
    }
    if (!wall) continue;
    const Vec3 end = x - branch;
    bins_->sphereFractions(end, 0.0, weight, fractions_);
    const Vec3 turned = bins_->directions(end).transpose() * force;
    for (const auto& [slot, w] : fractions_) add(sums[slot], Moment::wallForce, turned, w);
  }
}

}  // namespace crossgrain::inline averaging
