#pragma once

#include <string>
#include <vector>

#include "reports/common/pages.hpp"
#include "results/cost.hpp"

/// What a study of cost is written as.
namespace crossgrain::reports {

/// engine,setting,dt_s,error,error_kind,wall_s,cpu_s,steps,contact_evaluations,status,reason, then
/// knob,measure,statistical,systematic,reference_error,steps_per_contact,on_front,low,high,equivalent,bound
/// One row per point, those that did not run too; on_front is of the front over all engines.
std::string costCsv(const CostResults& results);

/// cost_KIND, error against time, and cost_orders_KIND, against the step, for each kind of error;
/// cost_parts, of averages; cost_falls; cost_contacts; cost_growth.
std::vector<Figure> costFigures(const CostResults& results);

/// For a terminal: per engine, kind of error and basis which setting reaches 10 %, 1 % and 0.1 %
/// for the least time, with the measured figure; last how much of it is decided.
std::string costAccuracyText(const CostResults& results);

/// HTML with everything inside: no scripts and nothing to fetch.
std::string costPage(const CostResults& results, const Illustrations& shown);

}  // namespace crossgrain::reports
