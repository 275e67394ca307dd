#pragma once

#include <string>
#include <vector>

#include "reports/common/pages.hpp"
#include "reports/thesis/figures.hpp"
#include "results/thesis.hpp"

/// What is written of a climb through the thesis' claims.
namespace crossgrain::reports {

/// id,engine,carrier,reading,figure,value,stderr,low,high,unit,verdict,why,figure_verdict,reasons
/// One row per figure, in the claims' order; a claim without any figure has one row. Verdict, why
/// and reasons are the claim's; a figure that is told only has no verdict of its own.
std::string claimsCsv(const ThesisResults& results);

/// leg,engine,packing,from_rotation,to_rotation,outer_pressure,wheel_torque,wheel_contacts,
/// wheel_touched,coordination,volume_fraction_at_wheel,volume_fraction_outside,velocity_at_wheel,
/// kinetic_energy,max_overlap,mean_overlap
std::string historyCsv(const ThesisResults& results);

std::string thesisPage(const ThesisResults& results, const Illustrations& shown);

/// What a rule asks of a figure: "0.791 … 0.796", "≥ 0.5"; empty: nothing.
std::string boundsInWords(const ClaimFigure& figure);

/// The claims table for a terminal, a line each: id, verdict, engine, first figure, reading.
std::string claimsText(const ThesisResults& results);

/// "Claims on ENGINE: 18 reproduced, 5 refuted, 4 undecided", a line for each engine. A claim
/// counts as what it is under its first reading.
std::vector<std::string> claimCounts(const ThesisResults& results);

}  // namespace crossgrain::reports
