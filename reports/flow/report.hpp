#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/common/report.hpp"
#include "reports/flow/engine_runs.hpp"
#include "results/rev.hpp"

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
/// distribution_velocities, distribution_joint, distribution_directions, distribution_contacts.
std::vector<Figure> compareFigures(const CompareResults& results);

/// Two per engine, of its first run that has a picture: where disks started (originsDrawing) and
/// forces. All are on one scale, of lengths and, of the first engine that has any, of forces
/// (widestForce).
std::vector<Picture> comparePictures(const CompareResults& results);

/// Verdicts against the reference, of all pairs, and model against implementation.
void addAgreement(Report& report, const CompareResults& results,
                  const std::vector<EngineRuns>& engines);
/// Profiles, fits, balance checks and distributions.
void addProfiles(Report& report, const CompareResults& results,
                 const std::vector<EngineRuns>& engines);
/// Regimes, drifts and series.
void addSeries(Report& report, const CompareResults& results,
               const std::vector<EngineRuns>& engines);

/// profiles.csv, series.csv, regimes.csv, steadiness.csv and distributions.csv.
std::vector<std::pair<std::string, std::string>> averageTables(const CompareResults& results);
/// The verdicts.
std::string endpointsCsv(const CompareResults& results);
/// Ring by ring where differences are, without a verdict.
std::string agreementCsv(const CompareResults& results);

}  // namespace crossgrain::reports
