#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/common/csv_row.hpp"
#include "reports/common/numbers.hpp"
#include "reports/thesis/report.hpp"

namespace crossgrain::reports {

std::string claimsCsv(const ThesisResults& results) {
  std::string table =
      "id,engine,carrier,reading,figure,value,stderr,low,high,unit,verdict,why,figure_verdict,"
      "reasons\n";
  for (const ClaimRow& claim : results.claims) {
    const auto line = [&](const ClaimFigure& figure) {
      table += row(claim.id, claim.engine, claim.carrier, claim.reading, figure.name, figure.value,
                   figure.standardError, figure.low, figure.high, figure.unit,
                   std::string(nameOf(claim.verdict)), claim.why,
                   figure.verdict ? std::string(nameOf(*figure.verdict)) : std::string(),
                   fmt::format("{}", fmt::join(claim.reasons, " ")));
    };
    for (const ClaimFigure& figure : claim.figures) line(figure);
    if (claim.figures.empty()) line({});
  }
  return table;
}

std::string historyCsv(const ThesisResults& results) {
  std::string table =
      "leg,engine,packing,from_rotation,to_rotation,outer_pressure,wheel_torque,wheel_contacts,"
      "wheel_touched,coordination,volume_fraction_at_wheel,volume_fraction_outside,"
      "velocity_at_wheel,kinetic_energy,max_overlap,mean_overlap\n";
  for (const ThesisRun& run : results.runs)
    for (const ThesisSpan& span : run.history)
      table += row(run.leg, run.engine, static_cast<std::size_t>(run.packing), finite(span.from),
                   finite(span.to), span.outerPressure, span.wheelTorque, span.wheelContacts,
                   span.wheelTouched, span.coordination, span.volumeFractionAtWheel,
                   span.volumeFractionOutside, span.velocityAtWheel, span.kineticEnergy,
                   span.maxOverlap, span.meanOverlap);
  return table;
}

}  // namespace crossgrain::reports
