#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "adapters/registry.hpp"
#include "reports/collide/report.hpp"
#include "reports/common/causes.hpp"

namespace crossgrain::reports {

namespace {

/// Engine that ran the mixtures, whose sweep under the scene's law others are compared with.
const std::string& inHouse() {
  return engineRegistry().front().name;
}

const QuantityCauses* causesIn(const CollisionCurve& curve, QuantityId quantity) {
  return curve.causes && curve.causes->of[quantity] ? &*curve.causes->of[quantity] : nullptr;
}

Names undeclaredIn(const Causes& causes) {
  Names names;
  for (const CauseName& one : causes.differences)
    if (!one.declared) names.push_back(one.name);
  return names;
}

/// Parts of the difference at one point; absent where one of them is not known.
std::optional<CauseAccount> accountAt(const CollisionCauses& causes, const QuantityCauses& own,
                                      std::size_t point) {
  const auto whole = at(own.whole, point), interaction = at(own.interaction, point),
             remainder = at(own.remainder, point);
  if (!whole || !interaction || !remainder) return std::nullopt;
  CauseAccount account{
      *whole, {}, *interaction, *remainder, causes.remainder, undeclaredIn(causes)};
  for (std::size_t k = 0; k < own.parts.size(); ++k) {
    const auto part = at(own.parts[k], point);
    if (!part) return std::nullopt;
    account.parts.emplace_back(causes.differences[k].name, *part);
  }
  return account;
}

/// Shares in the whole sweep: Σ part · whole/Σ whole², which add up to 1.
CauseAccount accountOver(const CollisionCauses& causes, const QuantityCauses& own) {
  CauseAccount sum{0.0, {}, 0.0, 0.0, causes.remainder, undeclaredIn(causes)};
  for (const CauseName& one : causes.differences) sum.parts.emplace_back(one.name, 0.0);
  for (std::size_t k = 0; k < own.whole.size(); ++k) {
    const auto one = accountAt(causes, own, k);
    if (!one) continue;
    sum.whole += one->whole * one->whole;
    sum.interaction += one->interaction * one->whole;
    sum.remainder += one->remainder * one->whole;
    for (std::size_t p = 0; p < sum.parts.size(); ++p)
      sum.parts[p].second += one->parts[p].second * one->whole;
  }
  if (!(sum.whole > 0.0)) return sum;
  for (auto* value : {&sum.interaction, &sum.remainder}) *value *= 100.0 / sum.whole;
  for (auto& [name, value] : sum.parts) value *= 100.0 / sum.whole;
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

/// Of every engine the quantity and variant in which it differs most in limits, the largest first;
/// or all of them, sweep by sweep.
std::vector<WorstDifference> differencesIn(const CaseGroup& group, bool all) {
  std::vector<WorstDifference> found;
  for (const CollisionVariant* variant : group.variants)
    for (const CollisionCurve& curve : variant->curves)
      for (const CollisionQuantity& quantity : scoredQuantities())
        if (const auto worst = worstDifference(variant, curve, quantity.id))
          found.push_back(*worst);
  if (all) return found;
  std::ranges::stable_sort(found, std::greater(), &WorstDifference::limits);
  std::set<std::string> seen;
  std::erase_if(found,
                [&](const WorstDifference& one) { return !seen.insert(one.curve->engine).second; });
  return found;
}

}  // namespace

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
  return accountOf(worst)->largest();
}

std::string differenceSentence(const WorstDifference& worst, const std::string& place) {
  const CollisionQuantity& quantity = collisionQuantity(worst.quantity);
  const CollisionTable& points = worst.curve->points;
  return causeSentence(quantityWords(quantity), worst.curve->engine, inHouse(),
                       fmt::format("at Ψ_i = {}{}", readableSetting(at(points.psi, worst.point)),
                                   place.empty() ? "" : " of " + place),
                       *accountOf(worst), comparedUnit(quantity),
                       causesIn(*worst.curve, worst.quantity)->limit, "limit");
}

Table causesTable(const CaseGroup& group, bool all) {
  Table table{{"engine", "variant", "quantity", numbers("difference"), numbers("at Ψ_i"),
               numbers("in limits"), remarks("parts there"), remarks("over the sweep, in %")}};
  for (const WorstDifference& worst : differencesIn(group, all)) {
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
    if (const std::string cause = account.largest(); cause != causes.remainder)
      row.cells[6].link = "#" + termId(cause);
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

Names causesNotes(const CaseGroup& group) {
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
      add(undeclaredSentence(curve.engine, *curve.causes), who);
      add(causesNote(*curve.causes), who);
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

namespace {

/// Colours that tell eight parts apart (Okabe and Ito 2008), the remainder grey.
constexpr const char* bandColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                       "#e69f00", "#56b4e9", "#f0e442", "#7f3fbf"};
constexpr const char* restColour = "#b0b0b0";
constexpr std::size_t mostPanels = 12;

/// Parts of one kind at all points, as bands on those before it: what is above zero upward, what is
/// below downward.
class Stack {
 public:
  explicit Stack(std::size_t points) : above_(points, 0.0), below_(points, 0.0) {}

  Curve band(const std::string& name, const char* colour, const Numbers& psi,
             const Numbers& values) {
    Curve curve{name, {colour, 0, false}, Draw::bands, {}, 1.0};
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double value = values[k].value_or(0.0);
      double& base = value < 0.0 ? below_[k] : above_[k];
      if (psi[k]) curve.points.push_back({*psi[k], base + 0.5 * value, 0.5 * std::abs(value)});
      base += value;
    }
    std::ranges::sort(curve.points, {}, &Point::x);
    return curve;
  }

 private:
  std::vector<double> above_, below_;
};

bool anySeen(const Numbers& values, double least) {
  return std::ranges::any_of(
      values, [&](const auto& value) { return std::abs(value.value_or(0.0)) > least; });
}

/// @param colours  of parts by name, one for all panels
Panel causesPanel(const WorstDifference& worst, std::map<std::string, const char*>& colours) {
  const CollisionCauses& causes = *worst.curve->causes;
  const QuantityCauses& own = *causesIn(*worst.curve, worst.quantity);
  const CollisionQuantity& quantity = collisionQuantity(worst.quantity);
  const std::string unit = comparedUnit(quantity);
  Panel panel;
  panel.name = fmt::format("{}, {}", worst.curve->engine, worst.variant->variant);
  panel.xLabel = "slide before Ψ_{i}";
  panel.yLabel = mathGnuplot(fmt::format("{} less {}'s{}", quantity.label, inHouse(),
                                         unit.empty() ? "" : " [" + unit + "]"));
  panel.level = 0.0;
  panel.key = Key::none;
  Numbers psi;
  for (std::size_t k = 0; k < own.whole.size(); ++k) psi.push_back(at(worst.curve->points.psi, k));
  const double least = 1e-3 * std::abs(*own.whole[worst.point]);
  Stack stack(own.whole.size());
  const auto add = [&](const std::string& name, const Numbers& values) {
    if (!anySeen(values, least)) return;
    const char* const next = bandColours[colours.size() % std::size(bandColours)];
    panel.curves.push_back(
        stack.band(name, colours.try_emplace(name, next).first->second, psi, values));
  };
  for (std::size_t p = 0; p < own.parts.size(); ++p) add(causes.differences[p].name, own.parts[p]);
  add("interaction", own.interaction);
  if (anySeen(own.remainder, least))
    panel.curves.push_back(stack.band(causes.remainder, restColour, psi, own.remainder));
  Curve line{"difference", {"#000000", 0, false}, Draw::lines, {}, 2.0};
  for (std::size_t k = 0; k < own.whole.size(); ++k)
    if (psi[k] && own.whole[k]) line.points.push_back({*psi[k], *own.whole[k], {}});
  std::ranges::sort(line.points, {}, &Point::x);
  panel.curves.push_back(std::move(line));
  return panel;
}

}  // namespace

Figure causesFigure(const CaseGroup& group, const std::string& name) {
  Figure figure;
  figure.name = name;
  figure.title = "Differences from the in-house engine over the sweep, and their causes";
  std::vector<WorstDifference> shown = differencesIn(group, false);
  std::erase_if(shown, [](const WorstDifference& one) {
    return one.curve->points.psi.front() == one.curve->points.psi.back();  // over speeds alone
  });
  if (shown.size() > mostPanels) shown.resize(mostPanels);
  std::map<std::string, const char*> colours;
  for (const WorstDifference& one : shown) figure.panels.push_back(causesPanel(one, colours));
  figure.caption =
      "Line: the engine less the in-house one under the scene's law, in the variant and quantity "
      "that "
      "differ most in limits. Bands: its parts, one on the other, by runs of the in-house engine "
      "under "
      "mixtures of both laws; grey: the rest, which no difference of the laws makes.";
  figure.keyAbove = true;
  figure.columns = std::max(1, std::min(3, static_cast<int>(figure.panels.size())));
  figure.panelWidth = 1240 / std::max(figure.columns, 2);
  figure.panelHeight = 260;
  return figure;
}

}  // namespace crossgrain::reports
