#include "reports/common/csv_row.hpp"
#include "reports/cost/points.hpp"
#include "reports/cost/report.hpp"

namespace crossgrain::reports {

std::string costCsv(const CostResults& results) {
  std::string table =
      "engine,setting,dt_s,error,error_kind,wall_s,cpu_s,steps,contact_evaluations,status,reason,"
      "knob,measure,statistical,systematic,reference_error,steps_per_contact,on_front,"
      "low,high,equivalent,bound\n";
  const std::vector<bool> front = onFront(results);
  for (std::size_t k = 0; k < results.points.size(); ++k) {
    const CostPoint& point = results.points[k];
    const std::string isOnFront = !point.ran() ? "" : front[k] ? "yes" : "no";
    table += row(point.engine, point.setting, point.dt, point.error, toString(point.kind),
                 point.wallSeconds, point.cpuSeconds, point.steps, point.contactEvaluations,
                 toString(point.status), point.reason, point.knob, point.measure, point.statistical,
                 point.systematic, point.referenceError, point.stepsPerContact, isOnFront,
                 point.low, point.high, point.equivalent, point.bound);
  }
  return table;
}

}  // namespace crossgrain::reports
