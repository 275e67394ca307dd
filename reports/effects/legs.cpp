#include "reports/effects/legs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/common/labels.hpp"

namespace crossgrain::reports {

namespace {

/// The largest value of the profile with everything on.
double scaleOf(const Json& field) {
  double scale = 0.0;
  for (const Json& ring : list(field, "rings"))
    scale = std::max(scale, std::abs(number(ring, "reference").value_or(0.0)));
  return scale;
}

double inErrors(const Json& ring) {
  const double change = std::abs(number(ring, "change").value_or(0.0));
  const double error = number(ring, "stderr").value_or(0.0);
  return error > 0.0 ? change / error : 0.0;
}

bool detected(const Json& ring) {
  return member(ring, "resolved") == Json(true);
}

/// Whether `a` says more than `b`.
bool saysMore(const Json& a, const Json& b) {
  if (detected(a) != detected(b)) return detected(a);
  if (detected(a))
    return std::abs(number(a, "change").value_or(0.0)) >
           std::abs(number(b, "change").value_or(0.0));
  return inErrors(a) > inErrors(b);
}

std::optional<FieldChange> changeOf(const Json& field) {
  const double scale = scaleOf(field);
  const Json* best = nullptr;
  std::optional<double> smallest;
  for (const Json& ring : list(field, "rings")) {
    if (!number(ring, "change")) continue;
    if (!best || saysMore(ring, *best)) best = &ring;
    if (const auto here = number(ring, "smallest"))
      smallest = std::min(*here, smallest.value_or(*here));
  }
  if (!best || scale == 0.0) return std::nullopt;
  FieldChange change;
  change.field = text(field, "field");
  change.verdict = text(field, "verdict");
  change.verdictHere = text(*best, "verdict");
  change.ring = static_cast<std::size_t>(number(*best, "ring").value_or(0.0));
  change.change = *number(*best, "change") / scale;
  if (const auto error = number(*best, "stderr")) {
    change.error = *error / scale;
    if (*error > 0.0) change.inErrors = inErrors(*best);
  }
  const auto low = number(*best, "low"), high = number(*best, "high");
  if (low && high) {
    change.low = *low / scale;
    change.high = *high / scale;
  }
  if (member(*best, "resolved").is_boolean()) change.detected = detected(*best);
  if (smallest) change.detectable = *smallest / scale;
  if (const auto here = number(*best, "smallest")) change.detectableHere = *here / scale;
  return change;
}

EffectLeg legOf(const Json& row, const Json& whole) {
  EffectLeg leg;
  leg.engine = text(row, "engine");
  leg.effect = text(row, "effect");
  leg.status = text(row, "status");
  leg.reason = text(row, "reason");
  if (const auto ratio = number(row, "time_ratio")) leg.saved = 1.0 - *ratio;
  leg.savedError = number(row, "time_ratio_stderr");
  leg.step = number(row, "step_s");
  leg.contacts = number(row, "contacts_per_step");
  leg.wholeContacts = number(whole, "contacts_per_step");
  leg.packings = static_cast<std::size_t>(number(row, "packings").value_or(0.0));
  for (const Json& field : list(row, "fields"))
    if (member(field, "judged") == Json(true))
      if (const auto change = changeOf(field)) leg.changes.push_back(*change);
  return leg;
}

struct Name {
  std::string_view effect, label, leg;
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

const FieldChange* EffectLeg::of(const std::string& field) const {
  const auto found = std::ranges::find(changes, field, &FieldChange::field);
  return found == changes.end() ? nullptr : &*found;
}

bool EffectLeg::decidable() const {
  return std::ranges::any_of(changes, [](const FieldChange& c) { return c.detected.has_value(); });
}

bool EffectLeg::changesSomething() const {
  return std::ranges::any_of(changes,
                             [](const FieldChange& c) { return c.detected.value_or(false); });
}

bool EffectLeg::withinMargins() const {
  return !changes.empty() &&
         std::ranges::all_of(changes, [](const FieldChange& c) { return c.verdict == "agree"; });
}

std::vector<EffectLeg> effectLegs(const Json& results) {
  std::vector<EffectLeg> legs;
  for (const Json& row : list(results, "legs"))
    if (!text(row, "effect").empty())
      legs.push_back(legOf(row, wholeLeg(results, text(row, "engine"))));
  return legs;
}

const Json& wholeLeg(const Json& results, const std::string& engine) {
  static const Json none;
  for (const Json& row : list(results, "legs"))
    if (text(row, "engine") == engine && text(row, "effect").empty()) return row;
  return none;
}

std::vector<std::string> judgedFields(const std::vector<EffectLeg>& legs) {
  std::vector<std::string> fields;
  for (const EffectLeg& leg : legs)
    for (const FieldChange& change : leg.changes)
      if (std::ranges::find(fields, change.field) == fields.end()) fields.push_back(change.field);
  return fields;
}

std::vector<EngineResults> legResults(const Json& results, const std::string& engine) {
  std::vector<EngineResults> legs;
  for (const Json& row : list(results, "legs")) {
    if (text(row, "engine") != engine) continue;
    EngineResults leg;
    const std::string effect = text(row, "effect");
    leg.name = effect.empty() ? "everything on" : legLabel(effect);
    leg.style = engineStyle(legs.size());
    leg.status = text(row, "status");
    leg.entry = &row;
    leg.takeRuns(results, engine, effect);
    legs.push_back(std::move(leg));
  }
  return legs;
}

std::string effectLabel(const std::string& effect) {
  const Name* name = simplerLaw(effect);
  return name ? std::string(name->label) : spaced(effect);
}

std::string legLabel(const std::string& effect) {
  const Name* name = simplerLaw(effect);
  return name ? std::string(name->leg) : "without " + spaced(effect);
}

}  // namespace crossgrain::reports
