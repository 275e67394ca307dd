#include "reports/common/csv_row.hpp"
#include "reports/couette/report.hpp"

namespace crossgrain::reports {

namespace {

std::string steadinessRow(const SeriesDrift& drifts, const std::string& engine,
                          const std::string& packing, const CouetteAveraging& when) {
  const RelativeDrift& drift = drifts.drift;
  return row(engine, packing, drifts.quantity, std::string(toString(drift.verdict)), drift.change,
             drift.half, drift.excluded, when.fromRotation, when.toRotation,
             when.preparedRotations);
}

}  // namespace

std::string regimesCsv(const CompareResults& results) {
  std::string table =
      "engine,packing,regime,wheel_contacts,wheel_slip,shear_share,inertial_number,blocked_share,"
      "from_rotation,to_rotation,prepared_rotations,reason\n";
  const CouetteAveraging& when = results.averaging;
  for (const CouetteRun& run : results.runs) {
    if (!run.regime) continue;
    const RegimeRow& regime = *run.regime;
    table += row(run.engine, fmt::format("{}", run.packing),
                 std::string(regime.regime ? toString(*regime.regime) : ""), regime.wheelContacts,
                 regime.wheelSlip, regime.shearShare, regime.inertialNumber, regime.blockedFraction,
                 when.fromRotation, when.toRotation, when.preparedRotations, regime.reason);
  }
  return table;
}

std::string steadinessCsv(const CompareResults& results) {
  std::string table =
      "engine,packing,quantity,verdict,change,half_width,excluded,from_rotation,to_rotation,"
      "prepared_rotations\n";
  for (const CouetteRun& run : results.runs)
    for (const SeriesDrift& drift : run.steadiness)
      table += steadinessRow(drift, run.engine, fmt::format("{}", run.packing), results.averaging);
  for (const EngineDrift& drift : results.steadiness)
    table += steadinessRow(drift, drift.engine, "all", results.averaging);
  return table;
}

}  // namespace crossgrain::reports
