#include "results/conformance.hpp"

#include <algorithm>

#include "adapters/worker/json.hpp"
#include "results/head.hpp"

namespace crossgrain::inline results {

void fields(auto& io, ConformanceRow& row) {
  io("part", row.part);
  io("check", row.name);
  io("what", row.what);
  io("outcome", row.outcome, checkNames);
  io("detail", row.detail);
  io("faults", row.faults);
  io("cause", row.cause);
  io("wall_s", row.seconds);
  io("about", row.about);
}

void fields(auto& io, ConformanceResults& results) {
  results.head.fields(io);
  io.present("elapsed_s", results.elapsed);
  io("engine", results.engine);
  io("checks", results.rows);
  io("cause", results.cause);
  io.present("declared", results.declared);
  io("not_examined", results.notExamined);
  io("at_defaults", results.atDefaults);
}

std::size_t ConformanceResults::count(CheckOutcome outcome) const {
  return static_cast<std::size_t>(std::ranges::count(rows, outcome, &ConformanceRow::outcome));
}

std::optional<double> ConformanceResults::partExamined() const {
  if (declared.value_or(0) == 0) return std::nullopt;
  return 1.0 - static_cast<double>(notExamined.size()) / static_cast<double>(*declared);
}

Json toJson(const ConformanceResults& results) {
  return jsonOf(results);
}

ConformanceResults conformanceFromJson(const Json& json) {
  return readAs<ConformanceResults>(json);
}

}  // namespace crossgrain::inline results
