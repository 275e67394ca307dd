#include "reports/common/csv.hpp"
#include "reports/common/csv_row.hpp"
#include "reports/cost/points.hpp"

namespace crossgrain::reports {

std::string costCsv(const Json& results) {
  std::string table =
      "engine,setting,dt_s,error,error_kind,wall_s,cpu_s,steps,contact_evaluations,status,reason,"
      "knob,measure,statistical,systematic,reference_error,steps_per_contact,on_front\n";
  for (const CostRow& point : costRows(results)) {
    const std::string onFront = !point.ran() ? "" : point.onFront ? "yes" : "no";
    table +=
        row(point.engine, point.setting, point.dt, point.error, point.kind, point.wall, point.cpu,
            point.steps, point.contacts, point.status, point.reason, point.knob, point.measure,
            point.statistical, point.systematic, point.reference, point.stepsPerContact, onFront);
  }
  return table;
}

}  // namespace crossgrain::reports
