#include "reports/collide/overview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reports/collide/table.hpp"
#include "reports/collide/tally.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"

namespace crossgrain::reports {

namespace {

/// Quantities that say much the same, as one question.
struct QuantityGroup {
  const char *name, *asks;
  std::vector<QuantityId> quantities;
};

const std::vector<QuantityGroup>& quantityGroups() {
  using enum QuantityId;
  static const std::vector<QuantityGroup> groups = {
      {"bounce", "Normal restitution e_n.", {en}},
      {"slide",
       "Tangential velocity of the contact point after the collision, and what follows "
       "from it.",
       {psiF, beta, et, centrePsiF}},
      {"angle", "Angle of the rebound.", {reboundAngle}},
      {"spin", "Spins after the collision.", {spinI, spinJ}},
      {"duration", "How long the disks touch.", {duration}},
      {"overlap", "Largest overlap.", {maxOverlap}},
      {"energy",
       "Energy lost, and where to.",
       {energyLost, lostNormalDamping, lostTangential, lostTangentialDamping, lostStiffening,
        lostSliding, lostStored}}};
  return groups;
}

/// The largest share of a limit, and where.
struct Extreme {
  double share = -1.0;
  std::string words, anchor;

  void look(double candidate, const std::string& what, const std::string& where) {
    if (candidate <= share) return;
    share = candidate;
    words = what;
    anchor = where;
  }
};

/// In a word, for a cell has no room for more: the case, or of the only one the variant.
std::string placeOf(const std::vector<CaseGroup>& groups, const CaseGroup& group,
                    const CollisionVariant& variant) {
  return groups.size() > 1 || variant.variant.empty() ? group.name : variant.variant;
}

/// Errors of some quantities over all sweeps of an engine: beyond the law that it declares, beyond
/// the scene's alone, and all.
struct Errors {
  Extreme own, scene, any;
};

bool isTheLaw(const CollisionCurve& curve) {
  return curve.declared && curve.declared->reference == DeclaredReference::itself;
}

void look(Errors& errors, const CollisionCurve& curve, const CollisionQuantity& quantity,
          const std::string& words, const std::string& anchor) {
  const auto shareOf = [](const std::optional<QuantityScore>& score) -> std::optional<double> {
    if (!score || !score->limit || !score->held || *score->limit <= 0.0) return std::nullopt;
    return score->max / *score->limit;
  };
  const auto scene = shareOf(curve.score.of[quantity.id]),
             own = isTheLaw(curve) ? std::nullopt : shareOf(declaredScore(curve).of[quantity.id]);
  if (own && *own > 1.0) errors.own.look(*own, words, anchor);
  if (scene && *scene > 1.0) errors.scene.look(*scene, words, anchor);
  if (scene) errors.any.look(*scene, words, anchor);
}

/// @param besidePeer  of a mirror that runs beside its peer: it shows what the peer's conventions
/// do
OverviewCell cellOf(const Errors& errors, bool besidePeer) {
  const CellState state = errors.own.share > 1.0 && !besidePeer ? CellState::bad
                          : std::max(errors.own.share, errors.scene.share) > 1.0
                              ? CellState::modelDifference
                          : errors.any.share >= 0.0 ? CellState::good
                                                    : CellState::notMeasured;
  if (state == CellState::notMeasured) return {state, {}, "of its limit", {}, {}, {}};
  const Extreme& told = state == CellState::bad ? errors.own
                        : state == CellState::modelDifference
                            ? (errors.scene.share > 1.0 ? errors.scene : errors.own)
                            : errors.any;
  return {state,      told.share, "of its limit", shortly(told.share) + " × limit",
          told.words, told.anchor};
}

/// Visits the curves of an engine that have an outcome.
void forCurves(const std::vector<CaseGroup>& groups, const std::string& engine, const auto& visit) {
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const CollisionVariant* variant : groups[g].variants)
      for (const CollisionCurve* curve : curvesOf(*variant, engine))
        visit(*curve, placeOf(groups, groups[g], *variant), fmt::format("case_{}", g + 1));
}

OverviewCell schemeCell(const std::vector<CaseGroup>& groups, const std::string& engine) {
  OverviewCell cell{CellState::notMeasured, {}, "d or v_n", {}, {}, {}};
  forCurves(groups, engine,
            [&](const CollisionCurve& curve, const std::string& place, const std::string& anchor) {
              const auto deviation = ownDeviation(curve);
              if (!deviation || (cell.value && *deviation <= *cell.value)) return;
              cell.value = deviation;
              cell.shown = shortly(deviation);
              cell.words = place;
              cell.anchor = anchor;
              cell.state = !curve.ownScheme->held   ? CellState::figure
                           : *curve.ownScheme->held ? CellState::good
                                                    : CellState::bad;
            });
  return cell;
}

/// How many sweeps came out as they should: refused ones need a law that the engine lacks.
OverviewCell sweepsCell(const std::vector<CaseGroup>& groups, const EngineRow& engine,
                        bool besidePeer) {
  Tally all;
  std::ptrdiff_t unknown = 0;
  forCurves(groups, engine.name,
            [&](const CollisionCurve& curve, const std::string&, const std::string&) {
              unknown += std::ranges::count(curve.points.status, PairStatus::noLimit);
              const SweepOutcome outcome = outcomeOf(curve);
              all.held += outcome == SweepOutcome::held;
              all.model += outcome == SweepOutcome::modelDifference;
              all.fellShort += outcome == SweepOutcome::fellShort;
              all.refused += outcome == SweepOutcome::refused;
              all.failed += outcome == SweepOutcome::failed;
            });
  OverviewCell cell{CellState::notMeasured, {}, "sweeps", {}, {}, "matrix"};
  if (all.refused > 0) cell.words = fmt::format("{} refused", all.refused);
  if (all.failed > 0)
    cell.words += fmt::format("{}{} failed", cell.words.empty() ? "" : ", ", all.failed);
  if (all.judged() == 0) {
    if (all.failed > 0)
      cell.state = CellState::bad;
    else if (all.refused > 0)
      cell.state = CellState::notApplicable;
    return cell;
  }
  cell.value = all.held;
  cell.shown = fmt::format("{} of {}", all.held, all.judged());
  if (unknown > 0) cell.shown += fmt::format(", {} points not judged", unknown);
  const int faults = (besidePeer ? 0 : all.fellShort) + all.failed;
  cell.state = faults > 0                      ? CellState::bad
               : all.model + all.fellShort > 0 ? CellState::modelDifference
                                               : CellState::good;
  return cell;
}

bool anyShown(const Overview& overview, std::size_t column) {
  return std::ranges::any_of(overview.rows, [&](const OverviewRow& row) {
    return row.cells[column].state != CellState::notMeasured;
  });
}

/// Takes questions away that no engine has an answer to.
void dropEmptyColumns(Overview& overview) {
  for (std::size_t k = overview.columns.size(); k-- > 0;) {
    if (anyShown(overview, k)) continue;
    const auto place = static_cast<std::ptrdiff_t>(k);
    overview.columns.erase(overview.columns.begin() + place);
    for (OverviewRow& row : overview.rows) row.cells.erase(row.cells.begin() + place);
  }
}

}  // namespace

Overview collideOverview(const CollideResults& results) {
  const std::vector<CaseGroup> groups = casesOf(results);
  Overview overview;
  overview.columns.push_back(
      {"sweeps held", "Sweeps within the limits of the scene's law, of those judged.", "matrix"});
  for (const QuantityGroup& group : quantityGroups())
    overview.columns.push_back({group.name, group.asks, ""});
  overview.columns.push_back(
      {"own scheme",
       "One impact against what the engine's integrator makes of it, as a share of "
       "the diameter or the speed of approach.",
       ""});
  for (const EngineRow& engine : results.engines) {
    const bool besidePeer = runsBesideItsPeer(results, engine.name);
    OverviewRow row{engine.name, true, {sweepsCell(groups, engine, besidePeer)}};
    for (const QuantityGroup& group : quantityGroups()) {
      Errors errors;
      forCurves(
          groups, engine.name,
          [&](const CollisionCurve& curve, const std::string& place, const std::string& anchor) {
            for (const QuantityId id : group.quantities) {
              const CollisionQuantity& quantity = collisionQuantity(id);
              const bool alone = group.quantities.size() == 1;  // the question names it
              look(errors, curve, quantity,
                   alone ? place : fmt::format("{}, {}", quantity.label, place), anchor);
            }
          });
      row.cells.push_back(cellOf(errors, besidePeer));
    }
    row.cells.push_back(schemeCell(groups, engine.name));
    overview.rows.push_back(std::move(row));
  }
  dropEmptyColumns(overview);
  overview.conclusion = collideConclusion(results);
  return overview;
}

}  // namespace crossgrain::reports
