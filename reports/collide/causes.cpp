#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/collide/report.hpp"
#include "reports/common/causes.hpp"
#include "reports/common/engines.hpp"

namespace crossgrain::reports {

namespace {

constexpr std::size_t mostPanels = 12;

const QuantityCauses* causesIn(const CollisionCurve& curve, QuantityId quantity) {
  return curve.causes && curve.causes->of[quantity] ? &*curve.causes->of[quantity] : nullptr;
}

/// Parts of the difference at one point; absent where one of them is not known.
std::optional<CauseAccount> accountAt(const CollisionCauses& causes, const QuantityCauses& own,
                                      std::size_t point) {
  const auto whole = at(own.whole, point), interaction = at(own.interaction, point),
             remainder = at(own.remainder, point);
  if (!whole || !interaction || !remainder) return std::nullopt;
  CauseAccount account{*whole, {}, *interaction, *remainder, causes.remainder};
  for (std::size_t k = 0; k < own.parts.size(); ++k) {
    const auto part = at(own.parts[k], point);
    if (!part) return std::nullopt;
    account.parts.push_back({causes.differences[k].name, *part, causes.differences[k].declared});
  }
  return account;
}

/// Shares in the whole sweep: Σ part · whole/Σ whole², which add up to 1.
CauseAccount accountOver(const CollisionCauses& causes, const QuantityCauses& own) {
  CauseAccount sum{0.0, {}, 0.0, 0.0, causes.remainder};
  for (const CauseName& one : causes.differences)
    sum.parts.push_back({one.name, 0.0, one.declared});
  for (std::size_t k = 0; k < own.whole.size(); ++k) {
    const auto one = accountAt(causes, own, k);
    if (!one) continue;
    sum.whole += one->whole * one->whole;
    sum.interaction += one->interaction * one->whole;
    sum.remainder += one->remainder * one->whole;
    for (std::size_t p = 0; p < sum.parts.size(); ++p)
      sum.parts[p].value += one->parts[p].value * one->whole;
  }
  if (!(sum.whole > 0.0)) return sum;
  for (auto* value : {&sum.interaction, &sum.remainder}) *value *= 100.0 / sum.whole;
  for (CauseAccount::Part& part : sum.parts) part.value *= 100.0 / sum.whole;
  sum.whole = 100.0;
  return sum;
}

/// Unit in which a quantity is compared.
std::string comparedUnit(const CollisionQuantity& quantity) {
  using enum CollisionQuantity::Scored;
  const bool own = quantity.scored == asItIs || quantity.scored == byLargest;
  return own ? std::string(quantity.unit) : std::string();
}

std::optional<CauseAccount> accountOf(const WorstDifference& worst) {
  return accountAt(*worst.curve->causes, *causesIn(*worst.curve, worst.quantity), worst.point);
}

}  // namespace

std::vector<WorstDifference> differencesIn(const std::vector<const CollisionVariant*>& variants) {
  std::vector<WorstDifference> found;
  for (const CollisionVariant* variant : variants)
    for (const CollisionCurve& curve : variant->curves)
      for (const CollisionQuantity& quantity : scoredQuantities())
        if (const auto worst = worstDifference(variant, curve, quantity.id))
          found.push_back(*worst);
  return found;
}

std::vector<WorstDifference> largestOfEngines(std::vector<WorstDifference> all) {
  std::ranges::stable_sort(all, std::greater(), &WorstDifference::limits);
  std::set<std::string> seen;
  std::erase_if(all,
                [&](const WorstDifference& one) { return !seen.insert(one.curve->engine).second; });
  return all;
}

std::optional<WorstDifference> worstDifference(const CollisionVariant* variant,
                                               const CollisionCurve& curve, QuantityId quantity) {
  const QuantityCauses* const own = causesIn(curve, quantity);
  if (!own) return std::nullopt;
  std::optional<WorstDifference> worst;
  for (std::size_t k = 0; k < own->whole.size(); ++k) {
    const auto account = accountAt(*curve.causes, *own, k);
    if (!account || account->whole == 0.0) continue;
    const auto& score = curve.score.of[quantity];
    const double size = std::abs(account->whole) / own->limit.value_or(score ? score->unit : 1.0);
    if (!worst || size > worst->limits) worst = {variant, &curve, quantity, k, size};
  }
  return worst;
}

std::string largestCause(const WorstDifference& worst) {
  return termWords(accountOf(worst)->largest());
}

std::string differenceSentence(const WorstDifference& worst, const std::string& place,
                               bool isFirst) {
  const CollisionQuantity& quantity = collisionQuantity(worst.quantity);
  const CollisionTable& points = worst.curve->points;
  return causeSentence(
      quantityWords(quantity), worst.curve->engine, inHouse(),
      fmt::format("{}at Ψ_i = {}{}", isFirst ? "(the in-house engine under the scene's law) " : "",
                  readableSetting(at(points.psi, worst.point)),
                  place.empty() ? "" : " of " + place),
      *accountOf(worst), comparedUnit(quantity), causesIn(*worst.curve, worst.quantity)->limit,
      "limit");
}

Table causesTable(const CaseGroup& group, bool all) {
  Table table{{"engine", "variant", "quantity", numbers("difference"), numbers("at Ψ_i"),
               numbers("in limits"), remarks("parts there"), remarks("over the sweep, in %")}};
  const std::vector<WorstDifference> every = differencesIn(group.variants);
  for (const WorstDifference& worst : all ? every : largestOfEngines(every)) {
    const CollisionCauses& causes = *worst.curve->causes;
    const QuantityCauses& own = *causesIn(*worst.curve, worst.quantity);
    const CauseAccount account = *accountOf(worst);
    const CollisionQuantity& quantity = collisionQuantity(worst.quantity);
    const std::string unit = comparedUnit(quantity);
    TableRow row{
        {{worst.curve->engine},
         {worst.variant->variant},
         {std::string(quantity.label)},
         {readableDifference(account.whole, std::nullopt) + (unit.empty() ? "" : " " + unit)},
         {readableSetting(at(worst.curve->points.psi, worst.point))},
         {own.limit ? shortly(worst.limits) : absentText},
         {accountWords(account)},
         {accountWords(accountOver(causes, own))}}};
    row.cells[6].link = termLink(account.largest());
    table.rows.push_back(std::move(row));
  }
  table.note =
      "Difference: the engine less the in-house one, both in the steps that the engine takes, the "
      "in-house one under the scene's law; where it is largest. Parts: measured by its runs under "
      "mixtures of that "
      "law and the one that the engine declares; with what is left, the implementation or solver, "
      "they add up to the difference. What works against it has a minus sign.";
  return table;
}

Names causesNotes(const CaseGroup& group, bool ofInteractions) {
  std::vector<std::pair<std::string, Names>> byNote;
  const auto add = [&](std::string note, const std::string& who) {
    if (note.empty()) return;
    const auto found = std::ranges::find(byNote, note, [](const auto& one) { return one.first; });
    Names& all = found == byNote.end() ? byNote.emplace_back(std::move(note), Names{}).second
                                       : found->second;
    all.push_back(who);
  };
  for (const CollisionVariant* variant : group.variants)
    for (const CollisionCurve& curve : variant->curves) {
      if (!curve.causes) continue;
      const std::string who = fmt::format("{}, {}", curve.engine, variant->variant);
      if (!ofInteractions)
        add(undeclaredSentence(curve.engine, *curve.causes, curve.effective), who);
      if (curve.causes->reason.empty() == ofInteractions) add(causesNote(*curve.causes), who);
    }
  Names notes;
  for (const auto& [note, who] : byNote)
    notes.push_back(fmt::format("{}: {}", listedShortly(who, 3), note));
  return notes;
}

std::string causesCsv(const CollideResults& results) {
  std::string csv =
      "case,variant,engine,dt_s,quantity,unit,psi_i,v_n,limit,part,from,to,declared,value\n";
  for (const CollisionVariant& variant : results.variants)
    for (const CollisionCurve& curve : variant.curves)
      for (const CollisionQuantity& quantity : scoredQuantities()) {
        const QuantityCauses* const own = causesIn(curve, quantity.id);
        if (!own) continue;
        const auto add = [&](const std::string& part, const CauseName& name,
                             const Numbers& values) {
          for (std::size_t k = 0; k < values.size(); ++k)
            csv += row(caseOf(results, variant), variant.variant, curve.engine,
                       std::optional(curve.dt), std::string(quantity.name), comparedUnit(quantity),
                       at(curve.points.psi, k), at(curve.points.vn, k), own->limit, part, name.from,
                       name.to, std::string(name.declared ? "yes" : "no"), at(values, k));
        };
        add("whole", {}, own->whole);
        forParts(*curve.causes, *own, add);
      }
  return csv;
}

Figure causesFigure(const CaseGroup& group, const std::string& name) {
  std::vector<StackedCauses> panels;
  for (const WorstDifference& worst : largestOfEngines(differencesIn(group.variants))) {
    const auto& points = worst.curve->points;
    if (points.psi.front() == points.psi.back() || panels.size() == mostPanels)
      continue;  // over speeds alone
    const QuantityCauses& own = *causesIn(*worst.curve, worst.quantity);
    const CollisionQuantity& quantity = collisionQuantity(worst.quantity);
    const std::string unit = comparedUnit(quantity);
    StackedCauses& panel = panels.emplace_back();
    panel.name = fmt::format("{}, {}", worst.curve->engine, worst.variant->variant);
    panel.xLabel = "slide before Ψ_{i}";
    panel.yLabel = mathGnuplot(fmt::format("{} less {}'s{}", quantity.label, inHouse(),
                                           unit.empty() ? "" : " [" + unit + "]"));
    for (std::size_t k = 0; k < own.whole.size(); ++k) panel.x.push_back(at(points.psi, k));
    panel.whole = own.whole;
    forParts(*worst.curve->causes, own,
             [&](const std::string& part, const CauseName&, const Numbers& values) {
               panel.parts.emplace_back(part, values);
             });
  }
  return stackedFigure(
      name, "Differences from the in-house engine over the sweep, and their causes",
      "Line: the engine less the in-house one under the scene's law, in the variant and quantity "
      "that differ most in limits. Bands: its parts, one on the other, by runs of the in-house "
      "engine under mixtures of both laws; grey: the rest, which no difference of the laws makes.",
      panels);
}

}  // namespace crossgrain::reports
