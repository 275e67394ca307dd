#include "reports/effects/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"
#include "reports/effects/variants.hpp"
#include "reports/flow/overview.hpp"

namespace crossgrain::reports {

namespace {

using Names = std::vector<std::string>;

std::string percentOf(double fraction) {
  const double percent = 100.0 * fraction;
  return fmt::format("{}{} %", percent < 0.0 ? "−" : "", readable(std::abs(percent)));
}

const VariantSummary* variantOf(const std::vector<VariantSummary>& variants,
                                const std::string& engine, const std::string& effect) {
  for (const VariantSummary& variant : variants)
    if (variant.engine == engine && variant.effect == effect) return &variant;
  return nullptr;
}

OverviewCell absentCell(const VariantSummary* variant, const std::string& anchor) {
  OverviewCell cell{Verdict::notMeasured, {}, "%", {}, {}, anchor};
  if (!variant || variant->ran()) return cell;
  cell.verdict = variant->status == Status::failed ? Verdict::fail : Verdict::notApplicable;
  cell.shown = variant->status == Status::failed ? "failed" : "refused";
  return cell;
}

OverviewCell savedCell(const VariantSummary* variant, const std::string& anchor) {
  OverviewCell cell = absentCell(variant, anchor);
  if (!variant || !variant->ran() || !variant->saved) return cell;
  cell.verdict = std::nullopt;
  cell.value = 100.0 * *variant->saved;
  cell.shown = percentOf(*variant->saved);
  cell.words = variant->costsTime() ? "of a step" : "of a step, within its error";
  return cell;
}

/// The largest significant change; else the one with the most errors.
const FieldChange* mostChanged(const VariantSummary& variant) {
  const auto rank = [](const FieldChange& change) {
    const bool detected = change.detected.value_or(false);
    return std::pair(detected, detected ? std::abs(change.change) : change.inErrors.value_or(0.0));
  };
  const FieldChange* most = nullptr;
  for (const FieldChange& change : variant.changes)
    if (!most || rank(change) > rank(*most)) most = &change;
  return most;
}

const EndpointRow* worstEndpoint(const VariantSummary& variant) {
  std::vector<const EndpointRow*> rows;
  for (const EndpointRow& row : variant.endpoints) rows.push_back(&row);
  return worstOf(rows);
}

OverviewCell changedCell(const VariantSummary* variant, const std::string& anchor) {
  OverviewCell cell = absentCell(variant, anchor);
  if (!variant || !variant->ran()) return cell;
  const FieldChange* most = mostChanged(*variant);
  if (const EndpointRow* worst = worstEndpoint(*variant);
      worst && worst->verdict == Verdict::fail && !(most && most->detected.value_or(false))) {
    OverviewCell shown = endpointCell(*worst, true);
    shown.anchor = anchor;
    return shown;
  }
  if (!most) return cell;
  cell.value = 100.0 * most->change;
  cell.shown = percentOf(most->change);
  cell.words = fieldWords(most->field);
  if (!variant->decidable())
    cell.words += ", too few packings";
  else if (!variant->changesSomething())
    cell.words += variant->withinMargins() ? ", all within the margins" : "";
  cell.verdict = variant->changesSomething() ? Verdict::modelDifference
                 : variant->withinMargins()  ? Verdict::pass
                                             : Verdict::undecided;
  return cell;
}

/// What an engine's effects do, in one clause.
std::string effectsOf(const std::vector<VariantSummary>& all) {
  Names changing, idle;
  for (const VariantSummary& variant : all) {
    if (!variant.ran()) continue;
    if (variant.changesSomething()) changing.push_back(effectLabel(variant.effect));
    if (variant.withinMargins() && !variant.changesSomething())
      idle.push_back(effectLabel(variant.effect));
  }
  const VariantSummary* const costliest = costliestOf(all);
  Names parts;
  if (!changing.empty())
    parts.push_back(fmt::format("{} {} a profile or an endpoint", listedShortly(changing, 4),
                                verb(changing.size(), "changes", "change")));
  if (!idle.empty())
    parts.push_back(fmt::format("{} {} nothing beyond the margins", listedShortly(idle, 4),
                                verb(idle.size(), "changes", "change")));
  const bool decidable = std::ranges::any_of(all, &VariantSummary::decidable);
  if (parts.empty())
    parts.emplace_back(decidable ? "no effect changes anything significantly"
                                 : "too few packings to know what changes");
  parts.push_back(
      costliest
          ? fmt::format("{} costs most, {} % of a step", effectLabel(costliest->effect),
                        readable(100.0 * *costliest->saved, times(costliest->savedError, 100.0)))
          : "none is shown to cost time");
  return listed(parts);
}

std::string effectsNextStep(const EffectsResults& results, const std::vector<VariantSummary>& all) {
  const bool decidable = std::ranges::any_of(all, &VariantSummary::decidable);
  if (!decidable && !all.empty())
    return fmt::format(
        "Next: at least 4 packings; with {} no change can be distinguished from scatter.",
        results.packings.size());
  for (const VariantSummary& variant : all)
    if (variant.decidable() && !variant.changesSomething() && !variant.withinMargins())
      return "Next: what is undecided takes more packings.";
  return {};
}

}  // namespace

Overview effectsOverview(const EffectsResults& results) {
  const std::vector<VariantSummary> all = variantSummaries(results);
  Overview overview;
  overview.rowsAre = "without";
  overview.states = {{Verdict::modelDifference, "changes a profile or an endpoint"},
                     {Verdict::pass, "changes nothing beyond the margins"},
                     {Verdict::undecided, "no significant change, and the margin is not excluded"},
                     {Verdict::notApplicable, "refused"},
                     {Verdict::fail, "failed"}};
  for (std::size_t k = 0; k < results.engines.size(); ++k) {
    const std::string& name = results.engines[k].name;
    const std::string anchor = fmt::format("effects-{}", k + 1);
    overview.columns.push_back(
        {name + " saves", "Time of a step that is saved without it.", anchor});
    overview.columns.push_back({name + " changes",
                                "The largest change of a profile without it, of its largest value.",
                                anchor});
  }
  Names effects;
  for (const VariantSummary& variant : all)
    if (std::ranges::find(effects, variant.effect) == effects.end())
      effects.push_back(variant.effect);
  for (const std::string& effect : effects) {
    OverviewRow row{effectLabel(effect), false, {}};
    for (std::size_t k = 0; k < results.engines.size(); ++k) {
      const VariantSummary* variant = variantOf(all, results.engines[k].name, effect);
      const std::string anchor = fmt::format("effects-{}", k + 1);
      row.cells.push_back(savedCell(variant, anchor));
      row.cells.push_back(changedCell(variant, anchor));
    }
    overview.rows.push_back(std::move(row));
  }
  SaidOf said;
  for (const EngineRow& engine : results.engines)
    if (engine.status == Status::finished)
      said.add(engine.name, effectsOf(variantSummaries(results, engine.name)));
  std::string sentence;
  for (const auto& [words, engines] : said.all())
    sentence += fmt::format("{}On {}: {}", sentence.empty() ? "" : "; ", listed(engines), words);
  if (!sentence.empty()) overview.conclusion.push_back(sentence + ".");
  if (std::string next = effectsNextStep(results, all); !next.empty())
    overview.conclusion.push_back(std::move(next));
  return overview;
}

}  // namespace crossgrain::reports
