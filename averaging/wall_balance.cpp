#include "averaging/wall_balance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace crossgrain::inline averaging {

namespace {

/// Gauss–Legendre, three points: places on [0, 1] and weights.
constexpr double offset = 0.38729833462074168852;  // √(3/5)/2
constexpr std::array<std::array<double, 2>, 3> gauss = {
    {{0.5 - offset, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + offset, 5.0 / 18.0}}};

/// A piece of a branch, in fractions of it.
struct Piece {
  double from, to;
};

/// Where |x + s b| ≥ R, 0 ≤ s ≤ 1: all but what lies between the two roots.
std::vector<Piece> beyond(double R, const Vec2& x, const Vec2& b) {
  const double bb = b.squaredNorm(), half = x.dot(b);
  const double root2 = half * half - bb * (x.squaredNorm() - R * R);
  if (!(root2 > 0.0) || bb == 0.0) return {{0.0, 1.0}};
  const double root = std::sqrt(root2);
  const double in = std::clamp((-half - root) / bb, 0.0, 1.0);
  const double out = std::clamp((-half + root) / bb, 0.0, 1.0);
  return {{0.0, in}, {out, 1.0}};
}

}  // namespace

std::optional<WallBalance> outerWallBalance(const Rings& rings, const Scene& scene,
                                            const Snapshot& snapshot) {
  if (!snapshot.contacts) return std::nullopt;
  const Contacts& contacts = *snapshot.contacts;
  const double low = rings.edge(rings.count() - 1);
  const double width = rings.outerRadius() - low;
  const double volume = rings.ringVolume(rings.count() - 1);
  const std::size_t disks = scene.disks.size();
  const std::vector<double> radius = scene.radii();

  double radial = 0.0, moment = 0.0;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Vec2& n = contacts.normal[c];
    const Vec2 onFirst = contacts.force(c);
    for (const bool first : {true, false}) {
      const auto p = static_cast<std::size_t>(first ? contacts.i[c] : contacts.j[c]);
      if (p >= radius.size()) continue;  // a plane
      const double a = radius[p];
      const Vec2 x = p < disks ? snapshot.position.at(p) : snapshot.wallPosition.at(p - disks);
      if (x.norm() + a < low) continue;
      // −f⊗l is the same on both sides: f and l change their signs together.
      // Both branches end in the middle of the overlap: where the force acts, the balance holds.
      const Vec2 branch = (a - 0.5 * contacts.overlap[c]) * n;
      for (const Piece& piece : beyond(low, x, first ? Vec2(-branch) : branch))
        for (const auto& [place, weight] : gauss) {
          const double s = piece.from + place * (piece.to - piece.from);
          const double part = weight * (piece.to - piece.from);
          const Vec2 point = x + (first ? -s : s) * branch;
          const double r = point.norm();
          const Vec2 er = point / r, ep = perpendicular(er);
          radial += part * onFirst.dot(er) * branch.dot(er);
          moment += part * (r - low) / r * onFirst.dot(ep) * branch.dot(ep);
        }
    }
  }
  const double mean = 0.5 * (low + rings.outerRadius());
  return WallBalance{radial / volume,
                     moment / (2.0 * std::numbers::pi * rings.height() * mean * width)};
}

}  // namespace crossgrain::inline averaging
