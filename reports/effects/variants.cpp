#include "reports/effects/variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/common/engines.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/flow/figures.hpp"

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

VariantSummary summaryOf(const EffectVariant& variant, const EffectVariant* whole,
                         const char* bin) {
  VariantSummary summary;
  summary.engine = variant.engine;
  summary.effect = variant.effect;
  summary.status = variant.status;
  summary.reason = variant.reason;
  if (finite(variant.timeRatio)) summary.saved = 1.0 - *variant.timeRatio;
  summary.savedError = finite(variant.timeRatioError);
  summary.step = finite(variant.step);
  summary.contacts = finite(variant.contacts);
  if (whole) summary.wholeContacts = finite(whole->contacts);
  summary.packings = variant.changes.packings;
  for (const ChangedField& field : variant.changes.fields)
    if (field.judged)
      if (const auto change = changeOf(field, bin)) summary.changes.push_back(*change);
  summary.endpoints = variant.changes.endpoints;
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
  const auto found = std::ranges::find(simplerLaws, effect, &Name::effect);
  return found == simplerLaws.end() ? nullptr : &*found;
}

}  // namespace

const FieldChange* VariantSummary::of(const std::string& field) const {
  const auto found = std::ranges::find(changes, field, &FieldChange::field);
  return found == changes.end() ? nullptr : &*found;
}

bool VariantSummary::decidable() const {
  return std::ranges::any_of(changes, [](const FieldChange& c) { return c.detected.has_value(); });
}

bool VariantSummary::changesSomething() const {
  return std::ranges::any_of(changes,
                             [](const FieldChange& c) { return c.detected.value_or(false); }) ||
         std::ranges::find(endpoints, Verdict::fail, &EndpointRow::verdict) != endpoints.end();
}

bool VariantSummary::withinMargins() const {
  const auto passes = [](const auto& one) { return one.verdict == Verdict::pass; };
  return (!changes.empty() || !endpoints.empty()) && std::ranges::all_of(changes, passes) &&
         std::ranges::all_of(endpoints, passes);
}

bool VariantSummary::costsTime() const {
  return saved && *saved > 0.0 && (!savedError || *saved > 2.0 * *savedError);
}

const VariantSummary* costliestOf(const std::vector<VariantSummary>& variants) {
  const VariantSummary* most = nullptr;
  for (const VariantSummary& variant : variants)
    if (variant.ran() && variant.costsTime() && (!most || *variant.saved > *most->saved))
      most = &variant;
  return most;
}

std::vector<VariantSummary> variantSummaries(const EffectsResults& results,
                                             const std::string& engine) {
  std::vector<VariantSummary> summaries;
  for (const EffectVariant& variant : results.variants)
    if (variant.isSwitched() && (engine.empty() || variant.engine == engine))
      summaries.push_back(
          summaryOf(variant, wholeVariant(results, variant.engine), binWord(results)));
  return summaries;
}

const EffectVariant* wholeVariant(const EffectsResults& results, const std::string& engine) {
  const auto found = std::ranges::find_if(results.variants, [&](const EffectVariant& variant) {
    return variant.engine == engine && !variant.isSwitched();
  });
  return found == results.variants.end() ? nullptr : &*found;
}

std::vector<std::string> judgedFields(const std::vector<VariantSummary>& variants) {
  std::vector<std::string> fields;
  for (const VariantSummary& variant : variants)
    for (const FieldChange& change : variant.changes)
      if (std::ranges::find(fields, change.field) == fields.end()) fields.push_back(change.field);
  return fields;
}

std::vector<EngineRuns> variantRuns(const EffectsResults& results, const std::string& engine) {
  std::vector<EngineRuns> runs;
  for (const EffectVariant& variant : results.variants) {
    if (variant.engine != engine) continue;
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

}  // namespace crossgrain::reports
