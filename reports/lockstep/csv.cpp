#include "reports/common/csv_row.hpp"
#include "reports/lockstep/report.hpp"
#include "results/json_fields.hpp"

namespace crossgrain::reports {
namespace {

std::optional<double> number(std::optional<std::size_t> count) {
  return count ? std::optional(static_cast<double>(*count)) : std::nullopt;
}

std::string lineOf(const LockstepRow& row, const LockstepSeparation* at) {
  using Number = std::optional<double>;
  const auto of = [](const auto& part, auto member) {
    return part ? Number(static_cast<double>((*part).*member)) : Number();
  };
  const bool measured = row.starts > 0;
  const auto count = [&](std::size_t value) {
    return measured ? Number(static_cast<double>(value)) : Number();
  };
  return reports::row(
      row.engine, std::string(nameOf(row.verdict)), row.equivalent,
      at ? Number(at->time) : Number(), at ? Number(at->median) : Number(),
      at ? Number(at->largest) : Number(), at ? at->yardstick : Number(),
      at ? at->equivalent : Number(), row.starts, count(row.kinds.sticking),
      count(row.kinds.sliding), count(row.kinds.made), count(row.kinds.opened),
      count(row.kinds.wall), of(row.first, &FirstExceedance::after),
      of(row.first, &FirstExceedance::until), of(row.first, &FirstExceedance::disk),
      row.first ? number(row.first->partner) : Number(), row.first ? row.first->contact : "",
      of(row.forces, &LockstepForces::missing), of(row.forces, &LockstepForces::extra),
      of(row.forces, &LockstepForces::normal), of(row.forces, &LockstepForces::tangential),
      row.term ? row.term->name : "", row.term ? row.term->amount : Number(),
      of(row.term, &NamedTerm::unexplained), row.failure.empty() ? row.reason : row.failure,
      measured ? Number(row.wallSeconds) : Number(), row.equivalentLow, row.equivalentHigh,
      count(row.read), count(row.beyond), row.shareHigh);
}

}  // namespace

std::string lockstepCsv(const LockstepResults& results) {
  std::string table =
      "engine,verdict,equivalent,time_s,median_d,largest_d,yardstick_d,equivalent_then,starts,"
      "sticking,sliding,new,opening,wall,first_after_s,first_until_s,first_disk,first_partner,"
      "first_contact,forces_missing,forces_extra,normal_force_difference,"
      "tangential_force_difference,term,term_amount,term_unexplained,reason,wall_s,"
      "equivalent_low,equivalent_high,read,beyond,share_high\n";
  for (const LockstepRow& row : results.lockstep.rows) {
    for (const LockstepSeparation& at : row.separations) table += lineOf(row, &at);
    if (row.separations.empty()) table += lineOf(row, nullptr);
  }
  return table;
}

}  // namespace crossgrain::reports
