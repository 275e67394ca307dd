#pragma once

#include <string>

#include "reports/common/json_view.hpp"

/// The tables that a results folder offers to other programs. Columns and their order are a
/// contract: new ones go to the end. Numbers are the shortest text that reads back as the same
/// double; what is absent is an empty cell. Rings count from 1, at the wheel.
namespace crossgrain::reports {

/// engine,case,variant,psi_i,v_n,e_n,psi_f,e_n_reference,psi_f_reference,dt_s,status
/// then further quantities, reason (reports/README.md). One row per collision; a sweep without any
/// is one row with its status, its reason and no numbers.
std::string collisionsCsv(const Json& results);

/// engine,case,verdict,measure,value,limit,unit,step,reason, then degraded_limit,variant,time_s
/// One row per engine, case and variant; step and time are those at which the limit was passed
/// first, or an engine that failed was seen last.
std::string stabilityCsv(const Json& results);
/// engine,setting,dt_s,error,error_kind,wall_s,cpu_s,steps,contact_evaluations,status,reason, then
/// knob,measure,statistical,systematic,reference_error,steps_per_contact,on_front
/// One row per point, those that did not run too; on_front is of the front over all engines.
std::string costCsv(const Json& results);

}  // namespace crossgrain::reports
