#include "continuum/cell_scale.hpp"

#include <cmath>

namespace crossgrain::inline continuum {
namespace {

/// M_rz of m = 1 and σ_c = 1 N/m² (Eq. 9.18) [m].
double coupleScale(const CellScale& cell, const CosseratParameters& p) {
  return cell.grainDiameter * p.lengthScale * std::sqrt(2.0 * (p.asymmetry + 1.0));
}

}  // namespace

CosseratParameters parametersOf(const CellScale& cell, CosseratParameters rest) {
  rest.innerRadius = cell.innerRadius / cell.gap;
  rest.grainSize = cell.grainDiameter / cell.gap;
  return rest;
}

std::optional<FittedFriction> frictionOf(const RingStress& ring, const CellScale& cell,
                                         const CosseratParameters& rest) {
  const CosseratParameters p = parametersOf(cell, rest);
  const double A = p.asymmetry;
  const double sigmaC = 0.5 * (ring.rr + ring.pp);  // which the model has equal
  if (!(sigmaC > 0.0 && ring.pr > 0.0)) return std::nullopt;
  const double s = ring.pr / sigmaC, q = ring.rp / sigmaC;
  const double m = -ring.coupleZr / (coupleScale(cell, p) * sigmaC);
  const double couple = 2.0 * (A + 1.0) * m;
  const double squared = (s * s + q * q + 2.0 * A * s * q + couple * couple) / (2.0 * (A + 1.0));
  if (!(squared <= 1.0)) return std::nullopt;
  const double torque = ring.radius * (ring.radius * ring.pr + ring.coupleZr);
  const double wheelStress = (torque / cell.innerRadius - ring.coupleZr) / cell.innerRadius;
  if (!(wheelStress > 0.0)) return std::nullopt;
  return FittedFriction{std::atan(wheelStress / sigmaC), std::asin(std::sqrt(squared))};
}

}  // namespace crossgrain::inline continuum
