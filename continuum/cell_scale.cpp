#include "continuum/cell_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

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

ModelFields fieldsIn(const CellScale& cell, const CosseratSolution& solution, double sigmaC,
                     std::span<const double> radii) {
  const double speed = cell.omega * cell.innerRadius;
  const double couple = coupleScale(cell, solution.parameters()) * sigmaC;
  ModelFields fields;
  for (const double r : radii) {
    const double xi = (r - cell.innerRadius) / cell.gap;
    constexpr double rounding = 1e-12;
    if (!(xi >= -rounding && xi <= 1.0 + rounding))
      throw std::invalid_argument(fmt::format("r = {} m lies outside the gap", r));
    const CosseratPoint point = solution.at(std::clamp(xi, 0.0, 1.0));
    fields.radius.push_back(r);
    fields.velocity.push_back(point.u);
    fields.spin.push_back(-point.omega * speed / cell.gap);
    fields.stressPr.push_back(point.s * sigmaC);
    fields.stressRp.push_back(point.q * sigmaC);
    fields.coupleZr.push_back(-point.m * couple);
  }
  return fields;
}

std::optional<FittedFriction> frictionOf(const RingStress& ring, const CellScale& cell,
                                         const CosseratParameters& rest) {
  const CosseratParameters p = parametersOf(cell, rest);
  const double A = p.asymmetry;
  FittedFriction fitted{};
  fitted.sigmaC = 0.5 * (ring.rr + ring.pp);
  if (!(fitted.sigmaC > 0.0 && ring.pr > 0.0)) return std::nullopt;
  fitted.s = ring.pr / fitted.sigmaC;
  fitted.q = ring.rp / fitted.sigmaC;
  fitted.m = -ring.coupleZr / (coupleScale(cell, p) * fitted.sigmaC);
  const double couple = 2.0 * (A + 1.0) * fitted.m;
  const double squared = (fitted.s * fitted.s + fitted.q * fitted.q +
                          2.0 * A * fitted.s * fitted.q + couple * couple) /
                         (2.0 * (A + 1.0));
  if (!(squared <= 1.0)) return std::nullopt;
  fitted.internalFriction = std::asin(std::sqrt(squared));
  const double torque = ring.radius * (ring.radius * ring.pr + ring.coupleZr);
  const double wheelStress = (torque / cell.innerRadius - ring.coupleZr) / cell.innerRadius;
  if (!(wheelStress > 0.0)) return std::nullopt;
  fitted.wallFriction = std::atan(wheelStress / fitted.sigmaC);
  return fitted;
}

}  // namespace crossgrain::inline continuum
