#include "results/thesis_kept.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace crossgrain::inline results {

namespace {

bool isOneOf(std::string_view name, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, name) != names.end();
}

bool keptOnRingsOfCase(std::string_view field) {
  return isOneOf(field, {"volume_fraction",
                         "azimuthal_velocity",
                         "radial_velocity",
                         "spin",
                         "density",
                         "coordination",
                         "shear_rate",
                         "continuum_rotation",
                         "excess_rotation",
                         "fabric_trace",
                         "fabric_deviator",
                         "fabric_angle",
                         "stress_rr",
                         "stress_pp",
                         "stress_rp",
                         "stress_pr",
                         "stress_trace",
                         "stress_deviator",
                         "stress_angle",
                         "dynamic_stress_rr",
                         "dynamic_stress_pp",
                         "dynamic_stress_rp",
                         "fluctuation_stress_rr",
                         "fluctuation_stress_pp",
                         "strain_trace",
                         "strain_deviator",
                         "strain_angle",
                         "bulk_modulus",
                         "shear_modulus",
                         "mean_field_modulus",
                         "couple_stress_zr",
                         "curvature_zr",
                         "torque_resistance"});
}

/// The expansion of the contacts' directions.
bool keptOfDirections(std::string_view field) {
  return field.starts_with("contact_cos_") || field.starts_with("contact_sin_");
}

bool keptOnFinerRings(std::string_view field) {
  return isOneOf(field, {"volume_fraction", "spin", "excess_rotation", "fabric_trace",
                         "bulk_modulus", "shear_modulus"});
}

/// Those that are compared between methods.
bool keptOfEveryMethod(std::string_view field) {
  return isOneOf(field, {"volume_fraction", "spin"});
}

/// Whose claims are judged by themselves, so that all that a figure shows is wanted.
bool isLadder(const ThesisLeg& leg) {
  return std::ranges::any_of(leg.families, [](const std::string& family) {
    return isOneOf(family, {"packings", "spacing", "mass", "radius"});
  });
}

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

template <typename Wanted>
void keep(std::vector<Profile>& profiles, const Wanted& wanted) {
  if (profiles.empty()) return;
  const std::string first = profiles.front().method;
  std::erase_if(profiles, [&](const Profile& profile) {
    return !wanted(profile.field) || (profile.method != first && !keptOfEveryMethod(profile.field));
  });
  for (Profile& profile : profiles) {
    round(profile.mean, keptDigits);
    round(profile.standardError, keptDigitsOfErrors);
    profile.nEff.clear();
    profile.dof.clear();
  }
}

/// Where distributions are looked at: figures 6.6, 6.10 and 7.9.
bool isLookedAt(const Distribution& of, const ThesisLeg& leg, std::size_t rings) {
  if (!of.ring) return of.quantity == "azimuthal_velocity_and_spin";
  const double width = (leg.cell.outerRadius - leg.cell.innerRadius) / static_cast<double>(rings);
  const auto isAtOneOf = [&](std::initializer_list<double> places) {
    return std::ranges::any_of(places, [&](double rTilde) {
      return *of.ring == static_cast<int>(rTilde * leg.cell.diameter / width);
    });
  };
  if (of.quantity == "contact_direction")
    return *of.ring + 1 == static_cast<int>(rings) || isAtOneOf({0.5, 2.0, 2.5, 4.0, 8.0, 12.0});
  return isAtOneOf({0.5}) || (of.quantity == "radial_velocity" && isAtOneOf({12.5}));
}

void keep(std::vector<Distribution>& distributions, const ThesisLeg& leg, std::size_t rings) {
  std::erase_if(distributions,
                [&](const Distribution& each) { return !isLookedAt(each, leg, rings); });
  for (Distribution& each : distributions) {
    for (double& density : each.density) density = rounded(density, keptDigitsOfDensities);
    each.standardError.clear();
  }
}

void keep(ThesisSpan& span) {
  for (auto* const number :
       {&span.outerPressure, &span.wheelTorque, &span.wheelContacts, &span.wheelTouched,
        &span.coordination, &span.volumeFractionAtWheel, &span.volumeFractionOutside,
        &span.velocityAtWheel, &span.kineticEnergy, &span.maxOverlap, &span.meanOverlap})
    round(*number, keptDigits);
}

void keep(ThesisRun& run, const ThesisLeg& leg) {
  const std::size_t rings = run.run.profiles.empty() ? 0 : run.run.profiles.front().mean.size();
  const bool whole = isLadder(leg) && rings > 0;
  keep(run.run.profiles, [&](std::string_view field) {
    return keptOnRingsOfCase(field) || (whole && keptOfDirections(field));
  });
  if (whole) {
    keep(run.run.distributions, leg, rings);
  } else {
    run.run.distributions.clear();
    run.finer.clear();
  }
  for (RingAverages& finer : run.finer) {
    keep(finer.profiles, keptOnFinerRings);
    finer.places = {};  // equally wide, from wheel to ring
  }
  for (ThesisSpan& span : run.history) keep(span);
  run.run.checks.clear();
  if (run.run.series) run.run.series->clear();  // there, as distributions are
  run.run.picture.reset();
}

/// Restitution and Ψ_f alone: what figure 4.3 has.
void keep(CollisionTable& table) {
  for (std::size_t q = 0; q < quantityCount; ++q) {
    const auto id = static_cast<QuantityId>(q);
    auto& column = table.columns[id];
    if (id != QuantityId::en && id != QuantityId::psiF) column.reset();
    if (column) round(*column, keptDigits);
  }
}

void keep(CollideResults& collisions) {
  for (CollisionVariant& variant : collisions.variants) {
    keep(variant.oracle);
    variant.reference = {};
    for (CollisionCurve& curve : variant.curves) keep(curve.points);
  }
}

}  // namespace

ThesisResults kept(ThesisResults results) {
  if (results.collisions) keep(*results.collisions);
  for (ThesisRun& run : results.runs) {
    const auto leg = std::ranges::find(results.legs, run.leg, &ThesisLeg::name);
    if (leg != results.legs.end()) keep(run, *leg);
  }
  return results;
}

}  // namespace crossgrain::inline results
