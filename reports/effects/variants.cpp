#include "reports/effects/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "reports/common/engines.hpp"

namespace crossgrain::reports {

namespace {

/// The largest value of the profile with everything on.
double scaleOf(const ChangedField& field) {
  double scale = 0.0;
  for (const RingChange& ring : field.rings)
    scale = std::max(scale, std::abs(finite(ring.reference).value_or(0.0)));
  return scale;
}

double sizeOf(const RingChange& ring) {
  return std::abs(finite(ring.change).value_or(0.0));
}

double inErrors(const RingChange& ring) {
  const double error = finite(ring.standardError).value_or(0.0);
  return error > 0.0 ? sizeOf(ring) / error : 0.0;
}

/// Whether `a` is to be shown rather than `b`.
bool showFirst(const RingChange& a, const RingChange& b) {
  const bool detected = a.resolved == true;
  if (detected != (b.resolved == true)) return detected;
  return detected ? sizeOf(a) > sizeOf(b) : inErrors(a) > inErrors(b);
}

std::optional<FieldChange> changeOf(const ChangedField& field, const char* bin) {
  const double scale = scaleOf(field);
  const RingChange* best = nullptr;
  std::optional<double> smallest;
  for (const RingChange& ring : field.rings) {
    if (!finite(ring.change)) continue;
    if (!best || showFirst(ring, *best)) best = &ring;
    if (const auto here = finite(ring.smallest))
      smallest = std::min(*here, smallest.value_or(*here));
  }
  if (!best || scale == 0.0) return std::nullopt;
  const auto scaled = [scale](const std::optional<double>& value) {
    return finite(value) ? std::optional(*value / scale) : std::nullopt;
  };
  FieldChange change;
  change.field = field.field;
  change.verdict = field.verdict;
  change.verdictHere = best->verdict;
  change.ring = best->ring;
  change.bin = fmt::format("{} {}", bin, best->ring + 1);
  change.change = *best->change / scale;
  change.error = scaled(best->standardError);
  if (change.error && *change.error > 0.0) change.inErrors = inErrors(*best);
  if (finite(best->low) && finite(best->high)) {
    change.low = scaled(best->low);
    change.high = scaled(best->high);
  }
  change.detected = best->resolved;
  change.detectable = scaled(smallest);
  change.detectableHere = scaled(best->smallest);
  return change;
}

VariantSummary summaryOf(const EffectVariant& variant, const EffectVariant* whole, const char* bin,
                         bool oneStart) {
  VariantSummary summary{variant, {}, {}, {}, oneStart};
  for (auto* number :
       {&summary.timeRatio, &summary.timeRatioError, &summary.step, &summary.contacts})
    *number = finite(*number);
  if (summary.timeRatio) summary.saved = 1.0 - *summary.timeRatio;
  if (whole) summary.wholeContacts = finite(whole->contacts);
  for (const ChangedField& field : variant.changes.fields)
    if (field.judged)
      if (const auto change = changeOf(field, bin)) summary.judged.push_back(*change);
  if (oneStart)
    for (FieldChange& change : summary.judged) change.error.reset();
  return summary;
}

struct Name {
  std::string_view effect, label, variant;
};
/// Switches to a simpler law, whose names say what is switched on.
constexpr std::array simplerLaws = {
    Name{"tension_cut", "tension", "tension cut off"},
    Name{"double_precision", "double precision", "single precision"}};

const Name* simplerLaw(const std::string& effect) {
  return findBy(simplerLaws, effect, &Name::effect);
}

std::string percentOf(double fraction) {
  const double percent = 100.0 * fraction;
  return fmt::format("{}{} %", percent < 0.0 ? "−" : "", readable(std::abs(percent)));
}

const VariantSummary* variantOf(const std::vector<VariantSummary>& variants,
                                const std::string& engine, const std::string& effect) {
  return findIf(variants, [&](const VariantSummary& variant) {
    return variant.engine == engine && variant.effect == effect;
  });
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
  cell.words = variant->changesTime() ? "of a step" : "of a step, within its error";
  return cell;
}

/// By significance, then by size; what is not significant by its errors.
std::pair<bool, double> rankOf(const FieldChange& change) {
  const bool detected = change.detected.value_or(false);
  return {detected, detected ? std::abs(change.change) : change.inErrors.value_or(0.0)};
}

/// The largest significant change; else the one with the most errors.
const FieldChange* mostChanged(const VariantSummary& variant) {
  const FieldChange* most = nullptr;
  for (const FieldChange& change : variant.judged)
    if (!most || rankOf(change) > rankOf(*most)) most = &change;
  return most;
}

const EndpointRow* worstEndpoint(const VariantSummary& variant) {
  std::vector<const EndpointRow*> rows;
  for (const EndpointRow& row : variant.changes.endpoints) rows.push_back(&row);
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
    cell.words += fmt::format(", {}", variant->untested());
  else if (!variant->changesSomething())
    cell.words += variant->withinMargins() ? ", all within the margins" : "";
  cell.verdict = variant->changesSomething() ? Verdict::modelDifference
                 : variant->withinMargins()  ? Verdict::pass
                                             : Verdict::undecided;
  return cell;
}

/// The one that costs most time; null: none is shown to.
const VariantSummary* costliestOf(const std::vector<VariantSummary>& variants) {
  const VariantSummary* most = nullptr;
  for (const VariantSummary& variant : variants)
    if (variant.ran() && variant.costsTime() && (!most || *variant.saved > *most->saved))
      most = &variant;
  return most;
}

/// A clause on what an engine's effects do.
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
    parts.emplace_back(
        decidable     ? "no effect changes anything significantly"
        : all.empty() ? "nothing was switched off"
        : all.front().oneStart
            ? "no endpoint changes beyond its margin; one start shows no scatter that "
              "profiles could be tested against"
            : "too few packings to know what changes");
  parts.push_back(costliest
                      ? fmt::format("{} costs most, {} % of a step", effectLabel(costliest->effect),
                                    readable(100.0 * *costliest->saved,
                                             times(costliest->timeRatioError, 100.0)))
                      : "none is shown to cost time");
  return fmt::format("{}", fmt::join(parts, ", and "));
}

std::string effectsNextStep(const EffectsResults& results, const std::vector<VariantSummary>& all) {
  const bool decidable = std::ranges::any_of(all, &VariantSummary::decidable);
  if (results.hasOneStart()) return {};
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

const FieldChange* VariantSummary::of(const std::string& field) const {
  return findBy(judged, field, &FieldChange::field);
}

bool VariantSummary::decidable() const {
  return std::ranges::any_of(judged, [](const FieldChange& c) { return c.detected.has_value(); });
}

const char* VariantSummary::untested() const {
  return oneStart ? "one start" : "too few packings";
}

bool VariantSummary::changesSomething() const {
  return std::ranges::any_of(judged,
                             [](const FieldChange& c) { return c.detected.value_or(false); }) ||
         findBy(changes.endpoints, Verdict::fail, &EndpointRow::verdict);
}

bool VariantSummary::withinMargins() const {
  const auto passes = [](const auto& one) { return one.verdict == Verdict::pass; };
  return (!judged.empty() || !changes.endpoints.empty()) && std::ranges::all_of(judged, passes) &&
         std::ranges::all_of(changes.endpoints, passes);
}

bool VariantSummary::changesTime() const {
  return saved && (!timeRatioError || std::abs(*saved) > 2.0 * *timeRatioError);
}

bool VariantSummary::costsTime() const {
  return changesTime() && *saved > 0.0;
}

std::vector<VariantSummary> variantSummaries(const EffectsResults& results,
                                             const std::string& engine) {
  std::vector<VariantSummary> summaries;
  for (const EffectVariant& variant : results.variants)
    if (variant.isSwitched() && (engine.empty() || variant.engine == engine))
      summaries.push_back(summaryOf(variant, wholeVariant(results, variant.engine),
                                    binWord(results), results.hasOneStart()));
  return summaries;
}

const EffectVariant* wholeVariant(const EffectsResults& results, const std::string& engine) {
  return findIf(results.variants, [&](const EffectVariant& variant) {
    return variant.engine == engine && !variant.isSwitched();
  });
}

Names judgedFields(const std::vector<VariantSummary>& variants) {
  Names fields;
  for (const VariantSummary& variant : variants)
    for (const FieldChange& change : variant.judged) addOnce(fields, change.field);
  return fields;
}

Engines variantRuns(const EffectsResults& results, const std::string& engine) {
  std::vector<VariantSummary> shown = variantSummaries(results, engine);
  std::erase_if(shown, [](const VariantSummary& variant) { return !variant.ran(); });
  std::ranges::stable_sort(shown, std::greater(), [](const VariantSummary& variant) {
    const FieldChange* const most = mostChanged(variant);
    return most ? rankOf(*most) : std::pair(false, 0.0);
  });
  shown.resize(std::min(shown.size(), mostVariants), VariantSummary{});
  Engines runs;
  for (const EffectVariant& variant : results.variants) {
    if (variant.engine != engine) continue;
    if (variant.isSwitched() && !findBy(shown, variant.effect, &VariantSummary::effect)) continue;
    EngineRuns of;
    of.name = variant.isSwitched() ? variantLabel(variant.effect) : "everything on";
    of.style = engineStyle(runs.size());
    of.status = variant.status;
    of.reason = variant.reason;
    of.takeRuns(results.runs, results.ensemble, engine, variant.effect);
    runs.push_back(std::move(of));
  }
  return runs;
}

std::string effectLabel(const std::string& effect) {
  const Name* name = simplerLaw(effect);
  return name ? std::string(name->label) : spaced(effect);
}

std::string variantLabel(const std::string& effect) {
  const Name* name = simplerLaw(effect);
  return name ? std::string(name->variant) : "without " + spaced(effect);
}

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
  for (const VariantSummary& variant : all) addOnce(effects, variant.effect);
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
  if (const std::string sentence = said.joined("on {}: {}"); !sentence.empty())
    overview.conclusion.push_back(capitalised(sentence) + ".");
  if (std::string next = effectsNextStep(results, all); !next.empty())
    overview.conclusion.push_back(std::move(next));
  return overview;
}

}  // namespace crossgrain::reports
