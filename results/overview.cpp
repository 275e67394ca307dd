#include "results/overview.hpp"

#include "results/json_fields.hpp"

namespace crossgrain::inline results {

void fields(auto& io, OverviewCell& cell) {
  io("state", cell.state);
  io("value", cell.value);
  io("unit", cell.unit);
  io("shown", cell.shown);
  io("words", cell.words);
}

void fields(auto& io, OverviewColumn& column) {
  io("name", column.name);
  io("asks", column.asks);
}

void fields(auto& io, OverviewRow& row) {
  io("name", row.name);
  io("cells", row.cells);
}

void fields(auto& io, StateWords& words) {
  io("state", words.state);
  io("words", words.words);
}

void fields(auto& io, Overview& overview) {
  io("rows_are", overview.rowsAre);
  io("states", overview.states);
  io("columns", overview.columns);
  io("rows", overview.rows);
  io("conclusion", overview.conclusion);
}

nlohmann::json toJson(const Overview& overview) {
  return jsonOf(overview);
}

}  // namespace crossgrain::inline results
