#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/common/blocks.hpp"
#include "reports/flow/engine_runs.hpp"
#include "results/compare.hpp"

/// Comparisons, averages of snapshots and studies of ring widths. Columns of all tables:
/// docs/results.md.
namespace crossgrain::reports {

Report compareReport(const CompareResults& results);
Report averageReport(const CompareResults& results);
/// Plots of fields against ring width: rev_FIELD.
Report reportOf(const RevResults& results);

// Parts of these.

/// Every plot of a comparison that there are data for. Names of figures: overview; profile_FIELD
/// (profile_azimuthal_velocity_log for its log axis); check_1, check_2, …; series_NAME;
/// single_runs; distribution_velocities, distribution_joint, distribution_directions,
/// distribution_contacts.
std::vector<Figure> compareFigures(const CompareResults& results);

/// Of each engine's first run that has a picture: the scene by speed, of cells where disks started
/// (originsDrawing), and forces. All are on one scale, of lengths unless an engine's are more than
/// twice the first's, of speeds, and of the first engine that has any, of forces (widestForce).
std::vector<Picture> comparePictures(const CompareResults& results);

/// Verdicts on endpoints: against the closed forms, where the case has them, else against the
/// reference; folded: all pairs, model against implementation, ring by ring.
void addAgreement(Report& report, const CompareResults& results, const Engines& engines);

/// The picture of an engine's first run that has one, or null.
const ScenePicture* firstPicture(const EngineRuns& engine);
/// The speed at which pictures are brightest: the largest of what 98 % of an engine's disks are
/// below [m/s].
double fastestOf(const Engines& engines);

/// Profiles, single runs, fits, balance checks and distributions.
void addProfiles(Report& report, const CompareResults& results, const Engines& engines);
/// Regimes, drifts and series.
void addSeries(Report& report, const CompareResults& results, const Engines& engines);

/// profiles.csv, series.csv, regimes.csv, steadiness.csv and distributions.csv.
std::vector<std::pair<std::string, std::string>> averageTables(const CompareResults& results);
/// The verdicts.
std::string endpointsCsv(const CompareResults& results);
/// Ring by ring where differences are, without a verdict.
std::string agreementCsv(const CompareResults& results);

// Figures.

/// Whose curve of a field has nothing to say: it is drawn grey, behind the others, without a name.
using IsFaint = std::function<bool(const EngineRuns&, const std::string& field)>;

/// The parts of compareFigures. A check of a single number is no plot.
std::vector<Figure> profileFigures(const FlowFrame& frame, const Engines& engines,
                                   const IsFaint& faint = {});
/// difference_FIELD: engines minus the reference, ring by ring, in margins, with the margin's band.
std::vector<Figure> differenceFigures(const CompareResults& results, const Engines& engines);

/// Words for the bars of the profiles: over packings, or within one run.
std::string describeBars(const Engines& engines);

/// Where the bins of profiles are, on the axis of that name: (r − R_i)/d, or a coordinate in m.
/// Those of a grid are nowhere (NaN).
const std::vector<double>& binPlaces(const FlowFrame& frame);
std::string binAxis(const FlowFrame& frame);

/// "ring", or "bin" of an assembly.
const char* binWord(const FlowFrame& frame);

/// The radial axis of a cell, from the wheel to the ring; absent without a cell.
std::optional<Range> rTildeRange(const FlowFrame& frame);

// The matrix and what follows from it.

/// An engine per row: its own law, averages against the reference, cost, failed runs.
Overview compareOverview(const CompareResults& results);

/// Of endpoints of one pair: the farthest of those with the most severe answer; null without one.
const EndpointRow* worstOf(const std::vector<const EndpointRow*>& rows);

/// That row as a cell. @param isModel  a disagreement is one of declared laws
OverviewCell endpointCell(const EndpointRow& row, bool isModel);

/// The same in a report: the difference of two engines that are both true to their laws is one of
/// models, and nothing has a verdict where nothing was judged.
OverviewCell endpointCell(const CompareResults& results, const EndpointRow& row);

/// Whether the difference of an engine from the reference is shown to come from its declared law:
/// lockstep verifies that law, or its mirror agrees with it wherever both it and the reference
/// disagree, and nowhere does it disagree with its mirror. Of a mirror always: it is the in-house
/// engine.
bool isModelDifference(const CompareResults& results, const EngineRow& engine);

/// A few sentences: who agrees with whom on what, the causes of the two largest differences, what
/// to do next.
/// @param brief  for a terminal: of many engines counts, and only the first few sentences on causes
Names compareConclusion(const CompareResults& results, bool brief = false);

// Causes of differences (results/causes.hpp). A part whose interval holds 0 is not named.

/// "Pressure of mine is 12 % higher than grain's on 8 packings: spring update 9.1, rest 2.9 (1
/// margin = 25 %).": of the largest differences from the reference, at most so many; then what was
/// not measured.
Names causeSentences(const CompareResults& results, std::size_t most);
/// Name of the largest part that is seen and makes the difference larger; empty: none does.
std::string largestCause(const CompareResults& results, const EndpointRow& row);
/// The section of all pairs. None: nothing was measured.
void addCauses(Report& report, const CompareResults& results);
/// Of the field that was asked for, a panel for each pair. None: none was.
std::vector<Figure> profileCausesFigures(const CompareResults& results);
/// All parts with their intervals.
std::string causesCsv(const CompareResults& results);

// Engines that ran, their cost, and in what state runs were while they were averaged.

/// The table of engines, and engines and runs that did not finish, with their reasons.
void addEngineTable(Blocks& blocks, const Engines& engines);

/// The state alone: of what was averaged and not run. No rows: nothing is known.
Table stateTable(const Engines& engines);

/// Rings, weights and snapshots that the profiles are means over.
/// @param engines  of which files may have others than the case says
std::string describeAverages(const FlowFrame& frame, const Engines& engines);

/// The case's scene as the engines took it.
std::vector<EffectiveScene> effectiveOf(const FlowFrame& frame, const Engines& engines);

/// "rotations 0.25 to 1.25 since the hand-over, 2.25 to 3.25 since the ring had closed"; what is
/// not known is left out.
std::string averagedRotations(const FlowAveraging& averaging);

/// Before any mean: which packings flow, are blocked or collisional, on which engines; where a
/// pair's regimes differ; which engines drift, on which no drift is seen and down to what size, and
/// where it is undecided.
Names stateSentences(const CompareResults& results, const Engines& engines);

/// "Not steady: on theirs outer pressure falls by 40 ± 8 %, …": of all engines; empty where none is
/// seen to drift.
std::string driftSentence(const CompareResults& results, const Engines& engines);

/// Tables: regimes by packing and engine; pairs whose regimes differ; drifts by series and engine.
void addStates(Blocks& blocks, const CompareResults& results, const Engines& engines);

}  // namespace crossgrain::reports
