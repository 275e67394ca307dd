#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "adapters/files/file_snapshots.hpp"

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

}  // namespace crossgrain::files
