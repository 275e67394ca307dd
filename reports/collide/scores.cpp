#include "reports/collide/scores.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reports/collide/tally.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {

namespace {

std::string orderOf(const CollideResults& results, const CollisionVariant& variant,
                    const std::string& engine, QuantityId quantity) {
  for (const ConvergenceOrder& order : results.orders) {
    const bool own =
        order.variant == variant.variant && order.name == variant.name && order.engine == engine;
    if (!own) continue;
    const auto& fit = order.of[quantity];
    if (!fit) break;
    // Errors of orders below a hundredth say nothing: the scheme's next term is larger.
    const double hundredths = std::round(fit->order * 100.0) / 100.0 + 0.0;  // no −0.00
    return fmt::format("{}{:.2f}{}", hundredths < 0.0 ? "−" : "", std::abs(hundredths),
                       fit->standardError
                           ? fmt::format("\u00a0±\u00a0{:.2f}", std::max(*fit->standardError, 0.01))
                           : "");
  }
  return absentText;
}

Json variantCell(const CollideResults& results, const CollisionVariant& variant,
                 const std::string& engine) {
  const Tally tally = tallyOf({&variant}, engine);
  Json lines = Json::array();
  const CollisionCurve* curve = coarsestCurve(variant, engine);
  for (const QuantityId quantity : {QuantityId::psiF, QuantityId::en}) {
    if (!curve || !curve->score.of[quantity]) continue;
    const std::string order = orderOf(results, variant, engine, quantity);
    lines.push_back(mathHtml(std::string(collisionQuantity(quantity).label) + " ") +
                    shortly(curve->score.of[quantity]->max) +
                    (order == absentText ? "" : ", order " + order));
  }
  if (tally.ownDeviation) lines.push_back("own scheme " + shortly(tally.ownDeviation));
  if (!tally.refusal.empty()) lines.push_back(mathHtml(tally.refusal));
  if (!tally.reason.empty()) lines.push_back(mathHtml(tally.reason));
  return {{"text", headline(tally)}, {"class", tally.cssClass()}, {"lines", std::move(lines)}};
}

/// The law's members that variants of the case differ in, or that only some have.
std::vector<std::string> changing(const CaseGroup& group) {
  std::vector<std::string> names;
  for (const CollisionVariant* variant : group.variants)
    for (const auto& [name, value] : variant->law) {
      const auto differs = [&, &name = name, &value = value](const CollisionVariant* other) {
        const auto found = other->law.find(name);
        return found == other->law.end() || found->second != value;
      };
      if (std::ranges::find(names, name) == names.end() &&
          std::ranges::any_of(group.variants, differs))
        names.push_back(name);
    }
  return names;
}

std::string ownLaw(const CollisionVariant& variant, const std::vector<std::string>& names) {
  std::vector<std::string> words;
  for (const std::string& name : names)
    if (const auto found = variant.law.find(name); found != variant.law.end())
      words.push_back(lawWords(name, found->second).value_or(spaced(name) + " " + absentText));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Largest distance of two curves at the same places.
std::optional<double> distance(const CollisionCurve* a, const CollisionCurve* b,
                               QuantityId quantity) {
  if (!a || !b) return std::nullopt;
  std::optional<double> largest;
  for (std::size_t k = 0; k < std::min(a->points.size(), b->points.size()); ++k) {
    const auto x = a->points.at(quantity, k), y = b->points.at(quantity, k);
    if (x && y) largest = std::max(largest.value_or(0.0), std::abs(*x - *y));
  }
  return largest;
}

std::string deviationWords(const CollisionCurve& curve) {
  std::vector<std::string> words;
  if (curve.realised)
    for (const Deviation& deviation : curve.realised->deviations)
      if (std::string name = spaced(deviation.name); std::ranges::find(words, name) == words.end())
        words.push_back(std::move(name));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string dtOf(const CollisionCurve* curve) {
  return readableSetting(curve ? finite(curve->dt) : std::nullopt);
}

/// The quantities that any curve of the case has a score in.
std::vector<const CollisionQuantity*> scoredIn(const CaseGroup& group) {
  std::vector<const CollisionQuantity*> scored;
  for (const CollisionQuantity& quantity : scoredQuantities())
    if (std::ranges::any_of(group.variants, [&](const CollisionVariant* variant) {
          return std::ranges::any_of(variant->curves, [&](const CollisionCurve& curve) {
            return curve.score.of[quantity.id].has_value();
          });
        }))
      scored.push_back(&quantity);
  return scored;
}

Json scoreCell(const std::optional<QuantityScore>& score) {
  if (!score) return {{"class", ""}, {"text", absentText}, {"rms", ""}};
  const bool judged = score->held.has_value(), held = score->held.value_or(false);
  return {{"class", !judged ? ""
                    : held  ? "agree"
                            : "disagree"},
          {"text", (!judged ? ""
                    : held  ? "✓ "
                            : "✗ ") +
                       shortly(score->max)},
          {"rms", shortly(score->rms)}};
}

/// Held to the own scheme, by how much.
Json schemeCell(const std::optional<SchemeScore>& own) {
  if (!own) return {{"class", ""}, {"text", ""}};
  if (!own->position) return {{"class", ""}, {"text", absentText}};
  const bool held = own->held.value_or(false);
  return {{"class", !own->held ? ""
                    : held     ? "agree"
                               : "disagree"},
          {"text", (!own->held ? ""
                    : held     ? "✓ "
                               : "✗ ") +
                       shortly(std::max(*own->position, own->velocity.value_or(0.0)))}};
}

/// Class and mark.
std::pair<const char*, const char*> styleOf(SweepOutcome outcome) {
  switch (outcome) {
    case SweepOutcome::held:
      return {"agree", "✓"};
    case SweepOutcome::modelDifference:
      return {"degraded", "≠"};
    case SweepOutcome::fellShort:
      return {"disagree", "✗"};
    default:
      return {"undecided", "–"};
  }
}

/// Whether a sweep held at a time step between the largest and the smallest of its engine: it says
/// nothing that those do not.
bool heldBetween(const CollisionVariant& variant, const CollisionCurve& curve) {
  const auto dt = finite(curve.dt);
  if (!dt || outcomeOf(curve) != SweepOutcome::held) return false;
  bool larger = false, smaller = false;
  for (const CollisionCurve* other : curvesOf(variant, curve.engine)) {
    larger = larger || finite(other->dt).value_or(*dt) > *dt;
    smaller = smaller || finite(other->dt).value_or(*dt) < *dt;
  }
  return larger && smaller;
}

/// By which of both laws a curve is scored, and what that one is known by.
struct ScoredBy {
  const CurveScore& score;
  const char* words;
};
std::vector<ScoredBy> lawsOf(const CollisionCurve& curve) {
  if (!curve.declared) return {{curve.score, "both"}};
  const bool mirror = curve.declared->reference == DeclaredReference::mirror;
  return {{curve.score, "scene's"}, {curve.declared->score, mirror ? "declared*" : "declared"}};
}

}  // namespace

Json matrixRows(const std::vector<CaseGroup>& groups, const std::vector<EngineRow>& engines) {
  Json rows = Json::array();
  for (const CaseGroup& group : groups) {
    Json cells = Json::array();
    for (const EngineRow& engine : engines) {
      const Tally tally = tallyOf(group.variants, engine.name);
      Json lines = Json::array();
      for (const std::string& line : shortfalls(tally)) lines.push_back(mathHtml(line));
      if (tally.refused > 0)
        lines.push_back(mathHtml(tally.judged() > 0 ? fmt::format("{} refused", tally.refused)
                                                    : tally.refusal));
      if (!tally.reason.empty()) lines.push_back(mathHtml(tally.reason));
      cells.push_back(
          {{"text", headline(tally)}, {"class", tally.cssClass()}, {"lines", std::move(lines)}});
    }
    rows.push_back({{"id", fmt::format("case_{}", rows.size() + 1)},
                    {"name", group.name},
                    {"variants", counted(group.variants.size(), "variant")},
                    {"cells", std::move(cells)}});
  }
  return rows;
}

Json variantRows(const CollideResults& results, const CaseGroup& group) {
  const std::vector<std::string> names = changing(group);
  Json rows = Json::array();
  for (const CollisionVariant* variant : group.variants) {
    Json cells = Json::array();
    for (const EngineRow& engine : results.engines)
      cells.push_back(variantCell(results, *variant, engine.name));
    rows.push_back({{"name", variant->variant},
                    {"law", ownLaw(*variant, names)},
                    {"cells", std::move(cells)}});
  }
  return rows;
}

Json mirrorRows(const CaseGroup& group, const std::vector<EngineRow>& engines) {
  using enum QuantityId;
  Json rows = Json::array();
  for (const EngineRow& mirror : engines) {
    if (mirror.mirrors.empty()) continue;
    const std::string& first = engines.front().name;
    for (const CollisionVariant* variant : group.variants) {
      const CollisionCurve *ours =
                               first == mirror.mirrors ? nullptr : coarsestCurve(*variant, first),
                           *mirrored = coarsestCurve(*variant, mirror.name),
                           *peer = coarsestCurve(*variant, mirror.mirrors);
      if (!mirrored || !peer) continue;
      rows.push_back(
          {{"variant", variant->variant},
           {"mirror", mirror.name},
           {"peer", mirror.mirrors},
           {"differs", deviationWords(*peer)},
           {"cells",
            {shortly(distance(ours, mirrored, psiF)), shortly(distance(ours, mirrored, en)),
             shortly(distance(mirrored, peer, psiF)), shortly(distance(mirrored, peer, en)),
             (!ours || dtOf(ours) == dtOf(mirrored)) && dtOf(mirrored) == dtOf(peer)
                 ? dtOf(peer)
                 : fmt::format("{} | {} | {}", dtOf(ours), dtOf(mirrored), dtOf(peer))}}});
    }
  }
  return rows;
}

Json scoreHeads(const CaseGroup& group) {
  Json heads = Json::array();
  for (const CollisionQuantity* quantity : scoredIn(group))
    heads.push_back(mathHtml(std::string(quantity->label)));
  return heads;
}

Json scoreRows(const CaseGroup& group) {
  const auto scored = scoredIn(group);
  Json rows = Json::array();
  for (const CollisionVariant* variant : group.variants)
    for (const CollisionCurve& curve : variant->curves) {
      if (heldBetween(*variant, curve)) continue;
      for (const ScoredBy& law : lawsOf(curve)) {
        const bool first = &law.score == &curve.score;
        Json cells = Json::array();
        if (curve.points.size() > 0)
          for (const CollisionQuantity* quantity : scored)
            cells.push_back(scoreCell(law.score.of[quantity->id]));
        const SweepOutcome outcome = outcomeOf(curve);
        const auto [cssClass, mark] = styleOf(outcome);
        rows.push_back({{"variant", first ? variant->variant : ""},
                        {"engine", first ? curve.engine : ""},
                        {"dt", first ? dtOf(&curve) : ""},
                        {"law", curve.points.size() > 0 ? law.words : ""},
                        {"verdict", first ? fmt::format("{} {}", mark, nameOf(outcome)) : ""},
                        {"class", first ? cssClass : ""},
                        {"own", first ? schemeCell(curve.ownScheme) : schemeCell({})},
                        {"reason", first ? curve.reason : ""},
                        {"cells", std::move(cells)}});
      }
    }
  return rows;
}

}  // namespace crossgrain::reports
