// The table of claims: of each claim the numbers that its rule has beside the common ones, and of
// each figure by which runs and what it is. cases/couette/thesis/claims.toml has texts and bands.
#include "studies/thesis/claims.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "averaging/transition_density.hpp"
#include "studies/thesis/claim_numbers.hpp"

namespace crossgrain::inline studies {
namespace {

// ---- What many runs say together.

using FigureRule = std::function<Evidence(const ClaimScope& scope)>;

FormulaContext contextOf(const CaseRun& at, const ClaimScope& scope) {
  return {at, at.run->run.profiles, "",
          [&](std::string_view name) { return namedNumber(name, at, scope); }};
}

std::optional<Measured> numberOf(const Formula& formula, const CaseRun& at,
                                 const ClaimScope& scope) {
  return formula.number(contextOf(at, scope));
}

/// The runs that have a number, and theirs.
struct Collected {
  RunSet asked;
  std::vector<CaseRun> runs;
  std::vector<Measured> values;

  /// @param missing  why there is none although runs have the number
  Evidence evidence(std::optional<Estimate> estimate, const std::string& missing) const {
    return {std::move(estimate),
            values.empty() ? asked.missing() : fmt::format("{}: {}", asked.label, missing), runs,
            asked.runs.size()};
  }
};

Collected collect(RunChoice choice, const Formula& formula, const ClaimScope& scope) {
  Collected found{choice(scope), {}, {}};
  for (const CaseRun& at : found.asked.runs)
    if (const auto value = numberOf(formula, at, scope)) {
      found.values.push_back(*value);
      found.runs.push_back(at);
    }
  return found;
}

/// Mean over the runs that have the number.
FigureRule mean(RunChoice runs, Formula of) {
  return [=](const ClaimScope& scope) {
    const Collected found = collect(runs, of, scope);
    return found.evidence(meanOver(found.values), "");
  };
}

/// Kendall's τ with ν̄ over the runs that have the number.
FigureRule trend(RunChoice runs, Formula of) {
  return [=](const ClaimScope& scope) {
    const Collected found = collect(runs, of, scope);
    std::vector<TrendPoint> points;
    for (std::size_t k = 0; k < found.runs.size(); ++k)
      points.push_back({found.runs[k].setup->label, found.values[k].value});
    return found.evidence(
        rankTrend(points, static_cast<int>(scope.common("fewest_for_trend"))),
        fmt::format("{} with the data, of different ν̄, are too few for a trend", points.size()));
  };
}

/// Slope in lg Ω with a level for each ν̄.
FigureRule slopeInRate(RunChoice runs, Formula of) {
  return [=](const ClaimScope& scope) {
    const Collected found = collect(runs, of, scope);
    std::vector<GroupedPoint> points;
    for (std::size_t k = 0; k < found.runs.size(); ++k) {
      const ThesisCase& setup = *found.runs[k].setup;
      const auto level =
          static_cast<std::size_t>(std::lround(setup.label / scope.common("same_label")));
      points.push_back({std::log10(std::abs(setup.cell.omega)), found.values[k].value, level});
    }
    Evidence evidence = found.evidence(
        commonSlope(points),
        fmt::format("{} with the data, no two rates at one ν̄ or none left for the error",
                    points.size()));
    evidence.of = 0;
    return evidence;
  };
}

/// Slope in ν̄; times the rule's change_to − change_from where `change` is wanted.
FigureRule slopeInDensity(RunChoice runs, Formula of, bool change) {
  return [=](const ClaimScope& scope) {
    const Collected found = collect(runs, of, scope);
    std::vector<GroupedPoint> points;
    for (std::size_t k = 0; k < found.runs.size(); ++k)
      points.push_back({found.runs[k].setup->label, found.values[k].value, 0});
    auto slope = commonSlope(points);
    if (slope && change) {
      const double span = scope.number("change_to") - scope.number("change_from");
      slope->value *= span;
      *slope->standardError *= span;
    }
    return found.evidence(slope, "too few, or of one ν̄");
  };
}

/// Who carries after so many rotations.
struct CarryingSet {
  RunSet set;
  std::vector<LoadState> packings;
};

CarryingSet carryingAfter(const ClaimScope& scope, double rotation) {
  CarryingSet after{scope.timed(), {}};
  std::erase_if(after.set.runs, [&](const CaseRun& at) {
    const ThesisSpan* const span = spanAt(*at.run, rotation);
    if (!span || !span->wheelContacts) return true;
    after.packings.push_back(
        {at.setup->label, *span->wheelContacts >= scope.common("wheel_contacts")});
    return false;
  });
  after.set.label += fmt::format(" followed for {:g} rotations", rotation);
  return after;
}

/// The critical ν̄ after so many rotations; absent: after the rule's.
FigureRule criticalAfter(std::optional<double> rotation) {
  return [=](const ClaimScope& scope) {
    const CarryingSet after =
        carryingAfter(scope, rotation ? *rotation : scope.number("thesis_rotation"));
    Evidence evidence{{}, after.set.missing(), after.set.runs};
    if (const auto half = transitionDensity(after.packings, scope.number("label_spread")))
      evidence.estimate = Estimate{.value = half->nu,
                                   .standardError = half->standardError,
                                   .runs = static_cast<int>(after.packings.size())};
    if (!after.packings.empty())
      evidence.missing = fmt::format("{} of {} {} carry, from which no critical ν̄ follows",
                                     std::ranges::count_if(after.packings, &LoadState::carries),
                                     after.packings.size(), after.set.label);
    return evidence;
  };
}

FigureRule shareCarrying(double rotation) {
  return [=](const ClaimScope& scope) -> Evidence {
    const CarryingSet after = carryingAfter(scope, rotation);
    std::vector<Measured> share;
    for (const LoadState& each : after.packings) share.emplace_back(each.carries ? 1.0 : 0.0);
    return {meanOver(share), after.set.missing()};
  };
}

/// E over the mean field's, in rings that hold enough contacts.
const Formula bulkRatio = "where(bulk_modulus / mean_field_modulus, fabric_trace, least_trace)";
const Formula bulkExcess =
    "mean(where(bulk_modulus / mean_field_modulus, fabric_trace, least_trace), off_walls) - 1";

/// Scatter of a run's bulk ratios about the mean over the rings of all runs.
Evidence collapse(const ClaimScope& scope) {
  const RunSet set = carrying<upward>(scope);
  std::vector<std::vector<double>> ratios;
  double sum = 0.0, count = 0.0;
  for (const CaseRun& at : set.runs) {
    const Numbers all = bulkRatio.rings(contextOf(at, scope)).values;
    std::vector<double>& own = ratios.emplace_back();
    for (std::size_t k = 1; k + 1 < all.size(); ++k)  // off the walls
      if (all[k]) own.push_back(*all[k]);
    for (const double ratio : own) sum += ratio;
    count += static_cast<double>(own.size());
  }
  std::vector<Measured> scatters;
  std::vector<CaseRun> used;
  for (std::size_t k = 0; k < ratios.size(); ++k) {
    if (ratios[k].empty()) continue;
    double squares = 0.0;
    for (const double ratio : ratios[k]) squares += std::pow(ratio - sum / count, 2);
    scatters.emplace_back(std::sqrt(squares / static_cast<double>(ratios[k].size())));
    used.push_back(set.runs[k]);
  }
  return {meanOver(scatters), set.missing(), used, set.runs.size()};
}

/// Mean of what a run has more of the bulk's excess than the judged run of the same packing; where
/// there is none, than the judged runs of that label on average.
template <RunSet (*from)(const ClaimScope&)>
Evidence excessBeyondJudged(const ClaimScope& scope) {
  const RunSet set = carrying<from>(scope), judged = carrying<upward>(scope);
  std::vector<Measured> differences;
  std::vector<CaseRun> used;
  for (const CaseRun& at : set.runs) {
    const auto own = numberOf(bulkExcess, at, scope);
    std::optional<double> reference;
    double sum = 0.0, count = 0.0;
    for (const CaseRun& other : judged.runs) {
      if (std::abs(other.setup->label - at.setup->label) > scope.common("same_label")) continue;
      const auto value = numberOf(bulkExcess, other, scope);
      if (!value) continue;
      const bool samePacking = other.setup->cell.small == at.setup->cell.small &&
                               other.setup->cell.large == at.setup->cell.large &&
                               other.run->seed == at.run->seed &&
                               other.run->packing == at.run->packing;
      if (samePacking && !reference) reference = value->value;
      sum += value->value;
      count += 1.0;
    }
    if (!reference && count > 0.0) reference = sum / count;
    if (!own || !reference) continue;
    differences.emplace_back(own->value - *reference);
    used.push_back(at);
  }
  return {meanOver(differences), set.missing(), used, set.runs.size()};
}

/// Exponent of G in tr F over the rings of the band of all runs.
Evidence shearExponent(const ClaimScope& scope) {
  const RunSet set = carrying<flow>(scope);
  std::vector<std::vector<TrendPoint>> runs;
  for (const CaseRun& at : set.runs) {
    std::vector<TrendPoint> points;
    for (const RingValue& ratio :
         ratiosOf(at, "shear_modulus", "fabric_trace", {0.0, scope.common("band_to")})) {
      if (!(ratio.value > 0.0)) continue;
      const double trace = *profileOf(at.run->run.profiles, "fabric_trace")->mean[ratio.ring];
      points.push_back({std::log(trace), std::log(ratio.value * trace)});
    }
    if (!points.empty()) runs.push_back(std::move(points));
  }
  return {slopeOverRuns(runs),
          runs.empty()
              ? set.missing()
              : fmt::format("{}: fewer than three with the data, or of one tr F", set.label),
          set.runs};
}

Evidence modelCouple(const ClaimScope&) {
  return {exactly(modelCoupleGrowth())};
}

// ---- The table.

struct FigureEntry {
  const char* name;
  FigureRule rule;
};

struct ClaimEntry {
  const char* id;
  std::vector<std::string> numbers;  ///< of its own rule
  std::vector<FigureEntry> figures;  ///< in the order of reports
};

const std::vector<ClaimEntry>& claimTable() {
  constexpr auto up = carrying<upward>, inFlow = carrying<flow>;
  const Formula lnPressure = "ln(averaged(outer_pressure)) / ln(10)";
  const Formula strainInBand = "mean(strain_trace, band) / mean(strain_trace, bulk)";
  // clang-format off
  static const std::vector<ClaimEntry> table = {
      // Of the law, without runs: claim_collisions.cpp.
      {"C1", {"sliding_from"},
       {{"spring", {}}, {"coulomb", {}}, {"viscous", {}}, {"spring_dashpot", {}},
        {"sliding_coulomb", {}}, {"sliding_viscous", {}}, {"sliding_spring", {}}}},
      {"C2", {"steps_per_contact"}, {{"restitution", {}}, {"duration", {}}}},

      {"C3", {"label", "fewest_fine"},
       {{"meeting", mean(atLabel, "rms(by(centre, volume_fraction) - by(slicing, volume_fraction))")},
        {"centre_peak", mean(atLabel, "fine(max(by(centre, volume_fraction)))")},
        {"slicing_peak", mean(atLabel, "fine(max(by(slicing, volume_fraction)))")},
        {"noise", mean(atLabel, "fine(rms(by(centre, volume_fraction) - by(slicing, volume_fraction)))"
                                " / rms(by(centre, volume_fraction) - by(slicing, volume_fraction))")}}},
      {"C4", {"label", "steady_from", "steady_to", "late"},
       {{"inner_change", mean(timedAtLabel, "nu_wheel_end - nu_wheel_begin")},
        {"early_less_late", mean(timedAtLabel, "abs(nu_wheel_begin - nu_wheel_first) - abs(nu_wheel_end - nu_wheel_begin)")},
        {"outer_change", mean(timedAtLabel, "nu_outside_end - nu_outside_first")},
        {"inner_late", mean(timedAtLabel, "nu_wheel_late - nu_wheel_begin")},
        {"pressure_late", mean(timedAtLabel, "ln(pressure_late / pressure_begin)")}}},
      {"C5", {},
       {{"width", mean(flow, "1 / positive(fit(dilation_decay))")},
        {"dilation", mean(flow, "fit(dilation) * exp(0 - 0.5 * fit(dilation_decay))")},
        {"nu0", mean(flow, "fit(volume_fraction_outside)")},
        {"b", mean(flow, "fit(dilation)")},
        {"reach", mean(flow, "3 / positive(fit(dilation_decay))")}}},
      {"C6", {"thesis_rotation", "label_spread"},
       {{"critical", criticalAfter({})},
        {"blocked_above", mean(blocked, "blocked_share")},
        {"blocked_below", mean(flow, "blocked_share")},
        {"critical_1", criticalAfter(1.0)}, {"critical_2", criticalAfter(2.0)}, {"critical_5", criticalAfter(5.0)},
        {"critical_10", criticalAfter(10.0)}, {"critical_20", criticalAfter(20.0)},
        {"carry_1", shareCarrying(1.0)}, {"carry_2", shareCarrying(2.0)}, {"carry_5", shareCarrying(5.0)},
        {"carry_10", shareCarrying(10.0)}, {"carry_20", shareCarrying(20.0)}}},
      {"C7", {"fit_to"},
       {{"length", mean(flow, "fit(velocity_decay)")},
        {"roughness", mean(flow, "roughness")},
        {"slip", mean(flow, "fit(velocity_amplitude)")},
        {"with_density", trend(upward, "fit(velocity_amplitude)")}}},
      {"C8", {"label", "period_within", "fewest_fine"},
       {{"first_layer", mean(flow, "ring(spin, 0) * (d / (omega * 2 * R_i))")},
        {"second_layer", mean(flow, "ring(spin, 1) * (d / (omega * 2 * R_i))")},
        {"period", mean(flow, "spin_period")},
        {"amplitude", mean(atLabel, "fit(spin_amplitude)")},
        {"decay", mean(atLabel, "fit(spin_decay)")},
        {"phase", mean(atLabel, "fit(spin_phase)")}}},
      {"C9", {"independent_to"},
       {{"exponent", slopeInRate(slowRates, lnPressure)},
        {"velocity", slopeInRate(slowRates, "ring(azimuthal_velocity, 0) / (omega * R_i)")},
        {"length", slopeInRate(slowRates, "ln(fit(velocity_decay))")},
        {"exponent_fast", slopeInRate(fastRates, lnPressure)}}},
      {"C10", {"inner", "outer"},
       {{"widths", mean(flow, "sqrt(near(fluctuation_stress_rr / density, inner)) / sqrt(near(fluctuation_stress_rr / density, outer))")},
        {"inner_mean", mean(flow, "near(radial_velocity, inner) / sqrt(near(fluctuation_stress_rr / density, inner))")},
        {"outer_mean", mean(flow, "near(radial_velocity, outer) / sqrt(near(fluctuation_stress_rr / density, outer))")},
        {"width_with_density", trend(upward, "sqrt(near(fluctuation_stress_rr / density, inner))")}}},
      {"C11", {"rest_velocity", "rest_spin", "ridge_half_width", "ridge_off"},
       {{"ridge", mean(upward, "density_ridge / density_beside_ridge")},
        {"rest", mean(upward, "density_rest / density_beside_rest")},
        {"rest_with_density", trend(upward, "density_rest")},  // one window for all: as its share
        {"second_peak", mean(upward, "velocity_half / velocity_before_half")},
        {"peak_at_one", mean(upward, "velocity_one / velocity_before_one")}}},
      {"C12", {},
       {{"band", mean(up, "mean(fabric_trace, band) / mean(fabric_trace, bulk)")},
        {"outermost", mean(up, "last(fabric_trace) / mean(fabric_trace, bulk)")},
        {"with_density", trend(up, "mean(fabric_trace, bulk)")},
        {"identity", mean(up, "max(abs(fabric_trace / coordination / positive(volume_fraction) - 1), off_walls)")}}},
      {"C13", {},
       {{"axis", mean(up, "axis(fabric_angle, inside_band) / (pi / 180)")},
        {"with_density", trend(up, "mean(fabric_deviator / fabric_trace, band)")},
        {"with_distance", mean(up, "mean(fabric_deviator / fabric_trace, bulk) / mean(fabric_deviator / fabric_trace, band)")}}},
      {"C14", {"label", "window"},
       {{"tangential", mean(atLabel, "directions_tangential")},
        {"shear_side", mean(atLabel, "directions_shear_side")},
        {"other_side", mean(atLabel, "directions_other_side")},
        {"homogeneous", mean(atLabel, "anisotropy_outside / anisotropy_inside")},
        {"outer_lattice", mean(atLabel, "directions_least")},
        {"outer_symmetry", mean(atLabel, "directions_left / directions_right")}}},
      {"C15", {},
       {{"exponent_rp", mean(up, "exponent_rp")},
        {"exponent_pr", mean(up, "exponent_pr")},
        {"diagonal", mean(up, "mean(stress_pp, off_walls) / mean(stress_rr, off_walls)")},
        {"constant", mean(up, "scatter(stress_rr, off_walls)")},
        {"symmetry", mean(up, "mean(stress_pr, off_walls) / mean(stress_rp, off_walls)")},
        {"balance", mean(withoutPlate, "scatter(r * (r * stress_pr + couple_stress_zr), off_walls)")}}},
      {"C16", {},
       {{"orders", mean(inFlow, "lg((ring(stress_rr, 0) + ring(stress_pp, 0)) / (ring(dynamic_stress_rr, 0) + ring(dynamic_stress_pp, 0)))")},
        {"pp_over_rr", mean(inFlow, "mean(ln(abs(dynamic_stress_pp / dynamic_stress_rr)), band)")},
        {"rr_over_rp", mean(inFlow, "mean(ln(abs(dynamic_stress_rr / dynamic_stress_rp)), band)")}}},
      {"C17", {"label"},
       {{"rr_with_density", trend(upward, "mean(stress_rr, off_walls)")},
        {"rp_with_density", trend(upward, "mean(stress_rp, off_walls)")},
        {"dev_with_density", trend(up, "mean(stress_deviator / stress_trace, band)")},
        {"dev_with_distance", mean(up, "mean(stress_deviator / stress_trace, bulk) / mean(stress_deviator / stress_trace, band)")},
        {"rr", mean(atLabel, "lg(mean(stress_rr, off_walls))")}}},
      {"C18", {"low_to", "change_from", "change_to"},
       {{"band", mean(carrying<lowDensities>, strainInBand)},
        {"flatter", trend(up, strainInBand)},
        {"deviator", slopeInDensity(carrying<figureDensities>, "ln(mean(strain_deviator / strain_trace, band))", true)},
        {"fabric", slopeInDensity(carrying<figureDensities>, "ln(mean(fabric_deviator / fabric_trace, band))", true)}}},
      {"C19", {},
       {{"fabric_stress", mean(up, "axis(fabric_angle - stress_angle, inside_band) / (pi / 180)")},
        {"stress_strain", mean(up, "axis(stress_angle - strain_angle, inside_band) / (pi / 180)")}}},
      {"C20", {"least_trace"},
       {{"mean_field", mean(up, bulkExcess)},
        {"collapse", collapse},
        {"stiffness", excessBeyondJudged<ofAnotherStiffness>},
        {"frictionless", excessBeyondJudged<withoutFriction>},
        {"identity", mean(up, "max(abs(where(bulk_modulus / mean_field_modulus, fabric_trace, least_trace) - 1"
                              " - fabric_deviator / fabric_trace * strain_deviator / strain_trace"
                              " * cos(2 * (strain_angle - fabric_angle))), off_walls)")}}},
      {"C21", {},
       {{"exponent", shearExponent},
        {"divergence", mean(inFlow, "median(positive(shear_modulus / fabric_trace), bulk) / median(positive(shear_modulus / fabric_trace), band)")}}},
      {"C22", {"layers_to"},
       {{"follows", mean(flow, "mean(spin, 0, layers_to) / mean(continuum_rotation, 0, layers_to)")},
        {"oscillates", mean(flow, "(2 * ring(excess_rotation, 1) - ring(excess_rotation, 0) - ring(excess_rotation, 2)) / (4 * omega)")}}},
      {"C23", {},
       {{"wheel", mean(up, "abs(ring(couple_stress_zr, 0)) / rms(couple_stress_zr, bulk)")},
        {"with_distance", mean(up, "median(torque_resistance, bulk) / median(torque_resistance, band)")},
        {"with_density", trend(up, "median(torque_resistance, bulk)")},
        {"identity", mean(up, "median(torque_resistance / fabric_trace, bulk) * 2 * pi * height / kt")}}},
      {"C24", {"fit_to", "particle_diameter", "length_ratio", "shape"},
       {{"velocity", mean(inFlow, "model_velocity")},
        {"spin", mean(inFlow, "model_spin")},
        {"asymmetry", mean(inFlow, "2 * (ring(stress_pr, 0) - ring(stress_rp, 0)) / (ring(stress_pr, 0) + ring(stress_rp, 0))")},
        {"model_couple", modelCouple},
        {"couple", mean(inFlow, "rms(couple_stress_zr, bulk) / abs(ring(couple_stress_zr, 0))")},
        {"couple_size", mean(inFlow, "abs(ring(couple_stress_zr, 0)) / (particle_diameter * length_ratio * sqrt(2 * (shape + 1)))"
                                     " / mean(stress_rr, off_walls)")}}},
      {"C25", {"days", "omega"},  // CPU seconds a step times the steps of a rotation at the rule's omega
       {{"speed_up", mean(flow, "days * 86400 / (cpu_s / steps * (2 * pi / omega / dt))")},
        {"hours", mean(flow, "cpu_s / steps * (2 * pi / omega / dt) / 3600")}}},
      {"C26", {"label"},
       {{"overlap", mean(flow, "lg(head(max_overlap_over_d) * d)")},
        {"trace", mean(flow, "lg(mean(stress_trace, off_walls))")},
        {"mean_overlap", mean(flow, "lg(head(mean_overlap_over_d) * d)")},
        {"overlap_804", mean(atLabel, "lg(head(max_overlap_over_d) * d)")}}},
      {"C27", {"factor"},
       {{"with_density", trend(up, "divergence_trace")},
        {"slope", slopeInDensity(up, "divergence_trace", false)},
        {"trace", mean(inFlow, "divergence_trace")}}},
  };
  // clang-format on
  return table;
}

/// An engine, and the mirror whose runs stand for it, too.
struct Subject {
  std::string engine, mirror;
};

/// Engines that have runs, in their order; a mirror that stands for its peer has no rows of its
/// own. "-" where there are no runs, so that every claim has a row.
std::vector<Subject> subjectsOf(const ThesisResults& results) {
  std::vector<Subject> subjects;
  for (const ThesisRun& run : results.runs) {
    const auto known = std::ranges::find_if(results.surrogates, [&](const ThesisSurrogate& each) {
      return each.accepted && (each.engine == run.engine || each.mirror == run.engine);
    });
    const Subject subject = known == results.surrogates.end()
                                ? Subject{run.engine, ""}
                                : Subject{known->engine, known->mirror};
    if (std::ranges::find(subjects, subject.engine, &Subject::engine) == subjects.end())
      subjects.push_back(subject);
  }
  if (subjects.empty()) subjects.push_back({"-", ""});
  return subjects;
}

}  // namespace

const ClaimSchema& claimSchema() {
  static const ClaimSchema schema = [] {
    ClaimSchema all;
    all.common = {"confidence",   "fewest_for_trend", "flow_from",      "flow_to",
                  "blocked_from", "same_label",       "wheel_contacts", "first_layer_to",
                  "band_to",      "bulk_from",        "bulk_to"};
    for (const ClaimEntry& claim : claimTable()) {
      ClaimNeeds& needs = all.claims.emplace_back(ClaimNeeds{claim.id, claim.numbers, {}});
      for (const FigureEntry& figure : claim.figures) needs.figures.emplace_back(figure.name);
    }
    return all;
  }();
  return schema;
}

std::optional<ClaimRow> judgeClaim(const ThesisResults& results, const ClaimRules& rules,
                                   const std::string& id, const std::string& engine,
                                   const std::string& mirror,
                                   const Interpretation& interpretation) {
  const auto claim = std::ranges::find(claimTable(), id, &ClaimEntry::id);
  if (claim == claimTable().end() || !claim->figures.front().rule) return std::nullopt;
  const ClaimScope scope{results, rules, rules.of(id), engine, interpretation, mirror};
  std::map<std::string, Evidence> found;
  for (const FigureEntry& figure : claim->figures) found[figure.name] = figure.rule(scope);
  return claimRow(scope, found);
}

std::vector<ClaimRow> judgeClaims(const ThesisResults& results, const ClaimRules& rules) {
  std::vector<ClaimRow> rows = judgeLaw(results, rules);
  if (results.collisions) {
    // Those of each engine's own collisions follow those of the law.
    const std::vector<ClaimRow> own = judgeCollisions(*results.collisions, rules);
    const auto other =
        std::ranges::find_if(rows, [](const ClaimRow& row) { return row.id != "C1"; });
    rows.insert(other, own.begin(), own.end());
  }
  const std::vector<Interpretation> interpretations = interpretationsOf(results);
  for (const ClaimEntry& claim : claimTable())
    for (const auto& [engine, mirror] : subjectsOf(results))
      for (const Interpretation& each : interpretations) {
        const ClaimScope scope{results, rules, rules.of(claim.id), engine, each, mirror};
        if (!each.key.empty() &&
            (!scope.rule.judgedUnder(each.key) || scope.runsOf(each.judged, "").runs.empty()))
          continue;
        if (auto row = judgeClaim(results, rules, claim.id, engine, mirror, each))
          rows.push_back(std::move(*row));
      }
  return rows;
}

}  // namespace crossgrain::inline studies
