#include "runs/cost/cost_cells.hpp"

#include <algorithm>

#include "runs/cost/candidates.hpp"

namespace crossgrain::inline runs {

namespace {

CostBasis basisOf(const CostPoint& point) {
  return isOwn(point.measure) ? CostBasis::own : CostBasis::scene;
}

/// The largest of an engine's model errors that are shown to lie above the target. Where a setting
/// comes nearer to the case's law than the limit of small steps does, coarse steps make up for some
/// of the model, and nothing follows for those that were not run.
std::optional<std::size_t> modelAbove(const std::vector<CostModel>& models, const CostCell& cell) {
  std::optional<std::size_t> largest;
  for (std::size_t k = 0; k < models.size(); ++k)
    if (models[k].engine == cell.engine && models[k].kind == cell.kind &&
        models[k].low > cell.target && (!largest || models[k].low > models[*largest].low))
      largest = k;
  return largest;
}

CostCell cellOf(CostCell cell, const std::vector<CostPoint>& points,
                const std::vector<CostModel>& models) {
  const auto belongs = [&](const CostPoint& point) {
    return point.engine == cell.engine && point.kind == cell.kind && basisOf(point) == cell.basis;
  };
  const Settled settled = settle(points, belongs, cell.target, cell.kind);
  cell.verdict = settled.verdict;
  cell.decides = settled.decides;
  if (settled.best) {
    cell.knob = settled.best->knob;
    cell.setting = settled.best->setting;
    cell.wallSeconds = settled.best->seconds();
    cell.point = settled.obstacle.value_or(settled.best->worst);
  }
  if (cell.verdict == CostVerdict::reached || cell.basis == CostBasis::own) return cell;
  cell.model = modelAbove(models, cell);
  if (cell.model && settled.best &&
      measuredError(points[settled.best->worst])->high() < models[*cell.model].low)
    cell.model.reset();
  if (cell.model) {
    cell.verdict = CostVerdict::notReached;
    cell.decides.clear();
  }
  return cell;
}

}  // namespace

std::vector<double> cellTargets() {
  return {0.1, 0.01, 1e-3};
}

std::vector<CostCell> costCells(const std::vector<CostPoint>& points,
                                const std::vector<CostModel>& models,
                                const std::vector<double>& targets) {
  std::vector<CostCell> cells;
  for (const std::string& engine : enginesIn(points))
    for (const CostKind kind : costKinds)
      for (const CostBasis basis : costBases) {
        const auto has = [&](const CostPoint& point) {
          return point.engine == engine && point.kind == kind && basisOf(point) == basis;
        };
        if (std::ranges::none_of(points, has)) continue;
        for (const double target : targets)
          cells.push_back(cellOf({.engine = engine, .kind = kind, .basis = basis, .target = target},
                                 points, models));
      }
  return cells;
}

}  // namespace crossgrain::inline runs
