#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/common/report.hpp"
#include "results/thesis_runs.hpp"

/// What is written of a campaign about the thesis' claims.
namespace crossgrain::reports {

/// id,engine,carrier,reading,figure,value,stderr,low,high,unit,verdict,why,figure_verdict,reasons
/// One row per figure, in the claims' order; a claim without any figure has one row. Verdict, why
/// and reasons are the claim's; a figure that is reported only has no verdict of its own.
std::string claimsCsv(const ThesisResults& results);

/// leg,engine,packing,from_rotation,to_rotation,outer_pressure,wheel_torque,wheel_contacts,
/// wheel_touched,coordination,volume_fraction_at_wheel,volume_fraction_outside,velocity_at_wheel,
/// kinetic_energy,max_overlap,mean_overlap
std::string historyCsv(const ThesisResults& results);

/// engine,group,nu,after_rotations,packings,carry,wheel_contacts,wheel_contacts_stderr,
/// outer_pressure,outer_pressure_stderr,critical_nu,critical_nu_stderr
/// A row without ν̄ is of all packings of its group, and has the critical one.
std::string regimeMapCsv(const ThesisResults& results);

/// engine,family,reading,nu,rotations,number,unit,default,change,stderr,pairs
/// Rows of all ν̄ together have none; stderr is over pairs.
std::string interpretationsCsv(const ThesisResults& results);

/// The thesis' figures from this project's data, with the thesis' axes and numbers: all that the
/// results have data for, in the thesis' order. "figure 7.14" is named figure_7_14. A curve's
/// colour is its volume fraction where there are several, its mark is its engine. Means are over
/// packings.
std::vector<Figure> thesisFigures(const ThesisResults& results);

Report reportOf(const ThesisResults& results);

/// Engines × claims: how each claim came out under its first interpretation, with the figure that
/// this rests on.
Overview thesisOverview(const ThesisResults& results);

/// The claims table for a terminal, a line each: id, verdict, engine, first figure, interpretation;
/// then the notes.
std::string claimsText(const ThesisResults& results);

/// What is read off a run's profiles: ν, v_φ, spin, stresses, fabric and contacts, at the wheel and
/// outside of the band. Stresses as lg, since they change by factors.
struct ProfileNumber {
  const char *label, *unit;  ///< "v_φ/(ΩR_i), ring 1"; unit empty: a number
  const char* formula;
};
inline constexpr ProfileNumber profileNumbers[] = {
    {"ν, ring 1", "", "ring(volume_fraction, 0)"},
    {"ν, bulk", "", "mean(volume_fraction, 8, 16)"},
    {"v_φ/(ΩR_i), ring 1", "", "ring(azimuthal_velocity, 0) * (1 / (omega * R_i))"},
    {"B of v_φ", "d", "fit(velocity_decay)"},
    {"S d/(ΩD), ring 1", "", "ring(spin, 0) * (d / (omega * 2 * R_i))"},
    {"lg σ_rr [N/m²], bulk", "", "lg(mean(stress_rr, 8, 16))"},
    {"lg σ_rφ [N/m²], ring 1", "", "lg(ring(stress_rp, 0))"},
    {"tr F, bulk", "", "mean(fabric_trace, 8, 16)"},
    {"wheel contacts", "", "wheel_contacts"}};

struct InterpretationChange {
  std::optional<double> standard;  ///< without the change, mean over the pairs
  std::optional<double> change;    ///< interpretation less default, mean over the pairs
  std::optional<double> error;     ///< of it, sd/√pairs; absent of one pair
  int pairs = 0;
};

/// One engine's runs of cases that differ from the default in one thing, compared with runs of the
/// default: of the same ν̄, the same packing's index and the same rotations. Packings of another
/// interpretation are others, so that a pair differs as packings do, too.
struct InterpretationRow {
  std::string family;  ///< "spacing"
  std::string label;   ///< "wall spacing 7 mm"
  std::string engine;
  std::vector<double> labels;  ///< ν̄ of the pairs, rising
  std::string rotations;       ///< "5 to 8"
  int pairs = 0;
  std::vector<InterpretationChange> changes;  ///< of profileNumbers; absent where runs are missing
};

/// A row for each interpretation and constant that there are cases of, also where nothing was run
/// of it, by the first engine; of other engines where they have pairs.
/// @param eachDensity  a row for each ν̄ instead of one for all
std::vector<InterpretationRow> interpretationRows(const ThesisResults& results,
                                                  bool eachDensity = false);

}  // namespace crossgrain::reports
