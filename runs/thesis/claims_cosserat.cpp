#include "runs/thesis/claims_cosserat.hpp"

#include "continuum/cosserat.hpp"

namespace crossgrain::inline runs {
namespace {

/// Finer than any ring: u falls by a tenth between points.
constexpr int modelPoints = 400;

std::optional<CosseratFields> solvedAsPrinted() {
  const CosseratOutcome outcome = solveCosserat({});
  if (!outcome.solution) return std::nullopt;
  CosseratFields fields;
  for (int k = 0; k <= modelPoints; ++k) {
    const CosseratPoint at = outcome.solution->at(static_cast<double>(k) / modelPoints);
    fields.xi.push_back(at.xi);
    fields.s.push_back(at.s);
    fields.q.push_back(at.q);
    fields.m.push_back(at.m);
    fields.u.push_back(at.u);
    fields.omega.push_back(at.omega);
  }
  return fields;
}

}  // namespace

const std::optional<CosseratFields>& cosseratAsPrinted() {
  static const std::optional<CosseratFields> fields = solvedAsPrinted();
  return fields;
}

}  // namespace crossgrain::inline runs
