#include "results/thesis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

#include "results/collision.hpp"

namespace crossgrain::inline results {

void fields(auto& io, ThesisResults& results) {
  results.head.fields(io);
  io.present("elapsed_s", results.elapsed);
  io("engines", results.engines);
  io("carriers", results.surrogates);
  io("rules", results.rules);
  io("reasons", results.reasons);
  io.present("collisions", results.collisions);
  io("legs", results.cases);
  io("runs", results.runs);
  io("claims", results.claims);
  io("notes", results.notes);
}

Json toJson(const ThesisResults& results) {
  return jsonOf(results);
}

ThesisResults thesisFromJson(const Json& json) {
  return readAs<ThesisResults>(json);
}

namespace {

/// Significant digits: a thousandth of any scatter between packings and less.
constexpr int keptDigits = 6, keptDigitsOfErrors = 3, keptDigitsOfDensities = 4;

using Names = std::span<const std::string_view>;

bool isOneOf(std::string_view name, Names names) {
  return std::ranges::find(names, name) != names.end();
}

// clang-format off
constexpr std::string_view keptOnCaseRings[] = {
    "volume_fraction", "azimuthal_velocity", "radial_velocity", "spin", "density", "coordination",
    "shear_rate", "continuum_rotation", "excess_rotation", "fabric_trace", "fabric_deviator",
    "fabric_angle", "stress_rr", "stress_pp", "stress_rp", "stress_pr", "stress_trace",
    "stress_deviator", "stress_angle", "dynamic_stress_rr", "dynamic_stress_pp",
    "dynamic_stress_rp", "fluctuation_stress_rr", "fluctuation_stress_pp", "strain_trace",
    "strain_deviator", "strain_angle", "bulk_modulus", "shear_modulus", "mean_field_modulus",
    "couple_stress_zr", "curvature_zr", "torque_resistance"};
constexpr std::string_view keptOnFinerRings[] = {
    "volume_fraction", "spin", "excess_rotation", "fabric_trace", "bulk_modulus", "shear_modulus"};
constexpr std::string_view comparedBetweenMethods[] = {"volume_fraction", "spin"};
/// Families whose claims are judged by themselves, so that all that a figure shows is kept.
constexpr std::string_view wholeFamilies[] = {"packings", "spacing", "mass", "radius"};
// clang-format on

double rounded(double value, int digits) {
  if (!std::isfinite(value)) return value;
  return std::strtod(fmt::format("{:.{}e}", value, digits - 1).c_str(), nullptr);
}

void round(std::optional<double>& value, int digits) {
  if (value) value = rounded(*value, digits);
}

void round(Numbers& values, int digits) {
  for (auto& value : values) round(value, digits);
}

void compact(std::vector<Profile>& profiles, Names wanted, bool directions = false) {
  if (profiles.empty()) return;
  const std::string first = profiles.front().method;
  std::erase_if(profiles, [&](const Profile& profile) {
    const std::string& field = profile.field;
    const bool isDirection = field.starts_with("contact_cos_") || field.starts_with("contact_sin_");
    return (!isOneOf(field, wanted) && !(directions && isDirection)) ||
           (profile.method != first && !isOneOf(field, comparedBetweenMethods));
  });
  for (Profile& profile : profiles) {
    round(profile.mean, keptDigits);
    round(profile.standardError, keptDigitsOfErrors);
    profile.nEff.clear();
    profile.dof.clear();
  }
}

/// Whether a figure or claim reads it: figures 6.6, 6.10, 6.11 and 7.9.
bool isRead(const Distribution& of, const CouetteCell& cell, std::size_t rings) {
  if (!of.ring) return of.quantity == "azimuthal_velocity_and_spin";
  const double width = (cell.outerRadius - cell.innerRadius) / static_cast<double>(rings);
  const auto isAtOneOf = [&](std::initializer_list<double> places) {
    return std::ranges::any_of(places, [&](double rTilde) {
      return *of.ring == static_cast<int>(rTilde * cell.diameter / width);
    });
  };
  if (of.quantity == "contact_direction")
    return *of.ring + 1 == static_cast<int>(rings) || isAtOneOf({0.5, 2.0, 2.5, 4.0, 8.0, 12.0});
  return isAtOneOf({0.5}) || (of.quantity == "radial_velocity" && isAtOneOf({12.5}));
}

void compact(ThesisRun& run, const ThesisCase& setup) {
  FlowRun& own = run.run;
  const std::size_t rings = own.profiles.empty() ? 0 : own.profiles.front().mean.size();
  const bool whole = rings > 0 && std::ranges::any_of(setup.families, [](const auto& family) {
                       return isOneOf(family, wholeFamilies);
                     });
  compact(own.profiles, keptOnCaseRings, whole);
  if (!whole) run.finer.clear();
  std::erase_if(own.distributions, [&](const Distribution& each) {
    return !whole || !isRead(each, setup.cell, rings);
  });
  for (Distribution& each : own.distributions) {
    for (double& density : each.density) density = rounded(density, keptDigitsOfDensities);
    each.standardError.clear();
  }
  for (RingAverages& finer : run.finer) {
    compact(finer.profiles, keptOnFinerRings);
    finer.places = {};  // equally wide, from wheel to ring
  }
  for (ThesisSpan& span : run.history)
    for (const SpanNumber& number : spanNumbers) round(span.*number.of, keptDigits);
  own.checks.clear();
  if (own.series) own.series->clear();  // there, as distributions are
  own.picture.reset();
}

/// Restitution and Ψ_f alone: what figure 4.3 has.
void compact(CollisionTable& table) {
  for (std::size_t q = 0; q < quantityCount; ++q) {
    const auto id = static_cast<QuantityId>(q);
    auto& column = table.columns[id];
    if (id != QuantityId::en && id != QuantityId::psiF) column.reset();
    if (column) round(*column, keptDigits);
  }
}

}  // namespace

bool isReadByFormulas(std::string_view field) {
  return isOneOf(field, keptOnCaseRings);
}

ThesisResults compacted(ThesisResults results) {
  if (results.collisions)
    for (CollisionVariant& variant : results.collisions->variants) {
      compact(variant.oracle);
      variant.reference = {};
      for (CollisionCurve& curve : variant.curves) compact(curve.points);
    }
  for (ThesisRun& run : results.runs) {
    const auto setup = std::ranges::find(results.cases, run.setup, &ThesisCase::name);
    if (setup != results.cases.end()) compact(run, *setup);
  }
  return results;
}

}  // namespace crossgrain::inline results
