#include "results/thesis_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "cases/thesis_claims.hpp"

namespace crossgrain::inline results {
namespace {

/// Labels have three digits.
constexpr double sameLabel = 5e-4;
/// What rounding leaves between times that were typed in [rotations].
constexpr double rotationRounding = 1e-6;

double ringWidth(const CouetteCell& cell, std::size_t rings) {
  return (cell.outerRadius - cell.innerRadius) / static_cast<double>(rings);
}

/// Rotations that a run's history reaches to, or its case's where it has none.
double reach(const CaseRun& at) {
  return at.run->history.empty() ? at.setup->endRotation() : at.run->history.back().to;
}

/// The engine's curve at the time step next to that many steps per contact; null: none finished.
const CollisionCurve* curveAt(const CollisionVariant& variant, const std::string& engine,
                              double steps) {
  const CollisionCurve* nearest = nullptr;
  const auto distance = [&](const CollisionCurve& curve) {
    return std::abs(std::log(curve.stepsPerContact.value_or(steps) / steps));
  };
  for (const CollisionCurve& curve : variant.curves)
    if (curve.engine == engine && curve.complete() &&
        (!nearest || distance(curve) < distance(*nearest)))
      nearest = &curve;
  return nearest;
}

std::string optionOf(const LawDescription& law, const char* option) {
  const auto found = law.find(option);
  const auto* const word = found == law.end() ? nullptr : std::get_if<std::string>(&found->second);
  return word ? *word : "";
}

}  // namespace

bool isOf(const ThesisCase& setup, std::string_view family) {
  return std::ranges::find(setup.families, family) != setup.families.end();
}

std::vector<const ThesisCase*> packingCases(const ThesisResults& results) {
  std::vector<const ThesisCase*> cases;
  for (const ThesisCase& setup : results.cases)
    if (isOf(setup, "packings")) cases.push_back(&setup);
  std::ranges::stable_sort(cases, {}, &ThesisCase::label);
  return cases;
}

const ThesisCase* packingCase(const ThesisResults& results, double label) {
  const auto cases = packingCases(results);
  const auto found = std::ranges::find_if(
      cases, [&](const ThesisCase* setup) { return std::abs(setup->label - label) < sameLabel; });
  return found == cases.end() ? nullptr : *found;
}

const ThesisCase* referenceCase(const ThesisResults& results) {
  if (results.cases.empty()) return nullptr;
  const auto first = std::ranges::find_if(
      results.cases, [](const ThesisCase& setup) { return isOf(setup, "packings"); });
  return first == results.cases.end() ? &results.cases.front() : &*first;
}

std::vector<std::string> enginesWithRuns(const ThesisResults& results) {
  std::vector<std::string> engines;
  for (const ThesisRun& run : results.runs)
    if (run.run.finished() && std::ranges::find(engines, run.engine) == engines.end())
      engines.push_back(run.engine);
  return engines;
}

std::vector<CaseRun> finishedRuns(const ThesisResults& results, const ThesisCase& setup,
                                  std::string_view engine) {
  std::vector<CaseRun> runs;
  for (const ThesisRun& run : results.runs)
    if (run.setup == setup.name && run.engine == engine && run.run.finished())
      runs.push_back({&setup, &run});
  return runs;
}

std::vector<CaseRun> longestOfEachPacking(const std::vector<CaseRun>& runs) {
  std::map<std::tuple<std::size_t, std::size_t, std::uint64_t, int>, CaseRun> longest;
  for (const CaseRun& at : runs) {
    const CouetteCell& cell = at.setup->cell;
    const auto [found, isNew] =
        longest.try_emplace({cell.small, cell.large, at.run->seed, at.run->packing}, at);
    if (!isNew && reach(at) > reach(found->second)) found->second = at;
  }
  std::vector<CaseRun> each;
  for (const auto& [key, at] : longest) each.push_back(at);
  return each;
}

CaseSettings settingsOf(const ThesisCase& setup) {
  const double mass = caseConstants(setup.caseToml).largeMass.value_or(0.0);
  return {
      setup.cell.wallSpacing, setup.cell.smallRadius, mass, setup.cell.omega, setup.kn, setup.mu,
      setup.bottomFriction};
}

bool sameSetting(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

bool sameLaw(const CaseSettings& a, const CaseSettings& b) {
  return sameSetting(a.kn, b.kn) && sameSetting(a.mu, b.mu) && a.bottomFriction == b.bottomFriction;
}

std::string describe(const OpenChoice& open, const CaseSettings& of) {
  return fmt::format("{} {:.4g} {}", open.label, of.*open.value / open.unit, open.unitName);
}

std::string describeRate(const CaseSettings& of) {
  return fmt::format("Ω = {:.4g} /s", of.omega);
}

bool sameBut(const OpenChoice* but, bool anyRate, const CaseSettings& a, const CaseSettings& b) {
  const bool open = std::ranges::all_of(openChoices, [&](const OpenChoice& each) {
    return &each == but || sameSetting(a.*each.value, b.*each.value);
  });
  return open && sameLaw(a, b) && (anyRate || sameSetting(a.omega, b.omega));
}

const ThesisSpan* spanAt(const ThesisRun& run, double rotation) {
  for (const ThesisSpan& span : run.history)
    if (span.from < rotation - rotationRounding && rotation <= span.to + rotationRounding)
      return &span;
  return nullptr;
}

const FitRow* fitOf(const ThesisRun& run, std::string_view name) {
  const auto found = std::ranges::find(run.run.fits, name, &FitRow::name);
  return found == run.run.fits.end() || !found->value ? nullptr : &*found;
}

std::optional<double> fittedIn(const ThesisRun& run, std::string_view name) {
  const FitRow* const fit = fitOf(run, name);
  return fit ? fit->value : std::nullopt;
}

std::size_t ringCount(const CaseRun& at) {
  const std::vector<Profile>& profiles = at.run->run.profiles;
  return profiles.empty() ? 0 : profiles.front().mean.size();
}

std::optional<std::size_t> ringNear(const CaseRun& at, double rTilde) {
  const std::size_t rings = ringCount(at);
  if (rings == 0) return std::nullopt;
  const CouetteCell& cell = at.setup->cell;
  const double place = rTilde * cell.diameter / ringWidth(cell, rings);
  return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(rings) - 0.5));
}

std::vector<RingValue> ringPlaces(const CouetteCell& cell, std::size_t count) {
  std::vector<RingValue> rings;
  const double width = ringWidth(cell, count);
  for (std::size_t k = 0; k < count; ++k) {
    const double depth = (static_cast<double>(k) + 0.5) * width;
    rings.push_back({k, cell.innerRadius + depth, depth / cell.diameter, 0.0});
  }
  return rings;
}

std::vector<RingValue> ringsOf(const CouetteCell& cell, const Profile* profile) {
  std::vector<RingValue> rings;
  if (!profile) return rings;
  for (RingValue each : ringPlaces(cell, profile->mean.size())) {
    const auto& value = profile->mean[each.ring];
    if (!value || !std::isfinite(*value)) continue;
    each.value = *value;
    rings.push_back(each);
  }
  return rings;
}

std::vector<RingValue> ringsOf(const CaseRun& at, std::string_view field, RingSpan span) {
  std::vector<RingValue> rings = ringsOf(at.setup->cell, profileOf(at.run->run.profiles, field));
  std::erase_if(rings, [&](const RingValue& each) {
    return each.rTilde < span.from || each.rTilde >= span.to;
  });
  return rings;
}

std::vector<RingValue> ratiosOf(const CaseRun& at, std::string_view field, std::string_view by,
                                RingSpan span) {
  std::vector<RingValue> ratios;
  const std::vector<RingValue> lower = ringsOf(at, by, span);
  for (RingValue each : ringsOf(at, field, span)) {
    const auto found = std::ranges::find(lower, each.ring, &RingValue::ring);
    if (found == lower.end() || found->value == 0.0) continue;
    each.value /= found->value;
    ratios.push_back(each);
  }
  return ratios;
}

std::optional<double> meanOf(const std::vector<RingValue>& rings) {
  if (rings.empty()) return std::nullopt;
  double sum = 0.0;
  for (const RingValue& each : rings) sum += each.value;
  return sum / static_cast<double>(rings.size());
}

std::optional<double> medianOf(const std::vector<RingValue>& rings) {
  if (rings.empty()) return std::nullopt;
  std::vector<double> values;
  for (const RingValue& each : rings) values.push_back(each.value);
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::optional<double> traceOfDivergence(const CaseRun& at, const DivergenceRule& rule) {
  std::vector<RingValue> ratios = ratiosOf(at, "shear_modulus", "fabric_trace");
  std::erase_if(ratios, [](const RingValue& each) { return !(each.value > 0.0); });
  std::vector<RingValue> band = ratios;
  std::erase_if(band, [&](const RingValue& each) { return !(each.rTilde < rule.bandTo); });
  const auto median = medianOf(band);
  if (!median) return std::nullopt;
  const double limit = rule.factor * *median;
  const Profile* const trace = profileOf(at.run->run.profiles, "fabric_trace");
  std::optional<double> found;
  for (std::size_t k = ratios.size(); k-- > 0;) {
    if (ratios[k].rTilde < rule.from || ratios[k].rTilde >= rule.to) continue;
    if (!(ratios[k].value > limit)) break;
    found = trace->mean[ratios[k].ring];
  }
  return found;
}

double LawSweep::lowest() const {
  return std::ranges::min(points, {}, &Point::after).after;
}

LawSweeps lawSweeps(const CollideResults& collisions, const std::string& engine,
                    const std::string& tension, double steps) {
  LawSweeps sweeps;
  for (const CollisionVariant& variant : collisions.variants) {
    const CollisionCurve* const curve = curveAt(variant, engine, steps);
    if (!curve || optionOf(variant.law, "tension") != tension) continue;
    LawSweep sweep;
    double count = 0.0;
    for (std::size_t row = 0; row < curve->points.size(); ++row) {
      const auto after = curve->points.at(QuantityId::psiF, row);
      const auto en = curve->points.at(QuantityId::en, row);
      if (!after || !en) continue;
      sweep.points.push_back({curve->points.psi[row], *after});
      sweep.en += *en;
      count += 1.0;
    }
    sweep.en /= count;
    if (!sweep.points.empty()) sweeps[optionOf(variant.law, "tangential")] = std::move(sweep);
  }
  return sweeps;
}

double lawFriction(const CollideResults& collisions) {
  double mu = 0.0;
  for (const CollisionVariant& variant : collisions.variants)
    if (const auto found = variant.law.find("mu"); found != variant.law.end())
      mu = std::get<double>(found->second);
  return mu;
}

}  // namespace crossgrain::inline results
