#include "results/regression.hpp"

#include "adapters/worker/json.hpp"
#include "results/endpoints.hpp"
#include "results/head.hpp"
#include "results/lockstep_findings.hpp"

namespace crossgrain::inline results {

void fields(auto& io, DeclaredChange& change) {
  io("name", change.name);
  io("before", change.before);
  io("now", change.now);
}

void fields(auto& io, CollisionChange& change) {
  io("name", change.name);
  io("variant", change.variant);
  io("quantity", change.quantity, aName);
  io("changed", change.changed);
  io("points", change.points);
  io("largest", change.largest);
  io("relative", change.relative);
  io("psi_i", change.psi);
  io("v_n", change.vn);
}

void fields(auto& io, ForcesChange& change) {
  io("frames", change.frames);
  io("normal", change.normal);
  io("tangential", change.tangential);
  io("walls", change.walls);
}

void fields(auto& io, DiffRow& row) {
  io("engine", row.engine, aName);
  io("version", row.version);
  io("before", row.before);
  io("version_before", row.versionBefore);
  io("verdict", row.verdict);
  io("reason", row.reason);
  io("failure", row.failure);
  io("declared", row.declared);
  io("windows", row.windows);
  io("mirrored", row.mirrored);
  io("windows_verdict", row.windowsVerdict);
  io("forces", row.forces);
  io("forces_verdict", row.forcesVerdict);
  io("collisions", row.collisions);
  io("sweeps", row.sweeps);
  io("collisions_verdict", row.collisionsVerdict);
  io("endpoints", row.endpoints);
}

void fields(auto& io, DiffResults& results) {
  results.head.fields(io);
  io("baseline", results.baseline);
  io("baseline_version", results.baselineVersion);
  io("changed_keys", results.changedKeys);
  io("rules", results.rules);
  io("starts", results.starts);
  io("engines", results.rows);
}

/// The list writes place and field as one.
void fields(auto& io, AnswerDifference& difference) {
  std::string where = difference.field + difference.place;
  io("field", where);
  io("then", difference.then);
  io("now", difference.now);
  io("off", difference.off);
  io("differ", difference.differ);
  io("of", difference.of);
}

void fields(auto& io, ReplayResults& results) {
  io("engine", results.engine);
  io("version", results.version);
  io("recorded_engine", results.recordedEngine);
  io("recorded_version", results.recordedVersion);
  io("recorded_stamp", results.recordedStamp);
  io("case", results.caseName);
  io("asked", results.asked);
  io("declared", results.declared);
  io("request", results.request);
  io("differences", results.differences);
  io("failure", results.failure);
}

nlohmann::json toJson(const DiffResults& results) {
  return jsonOf(results);
}

nlohmann::json toJson(const ReplayResults& results) {
  return jsonOf(results);
}

}  // namespace crossgrain::inline results
