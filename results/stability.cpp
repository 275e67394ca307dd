#include "results/stability.hpp"

#include "adapters/worker/json.hpp"
#include "results/head.hpp"
#include "results/scene_picture.hpp"

namespace crossgrain::inline results {

void fields(auto& io, HardCase& setup) {
  io("case", setup.name, aName);
  io("variant", setup.variant);
  io("file", setup.file);
  io("tests", setup.tests);
  io("measure", setup.measure, aName);
  io("what", setup.what);
  io("unit", setup.unit, aUnit);
  io("limit", setup.limit);
  io("degraded_limit", setup.degradedLimit);
  io("why", setup.why);
  io("toml", setup.toml);
}

void fields(auto& io, StabilityResults& results) {
  results.head.fields(io);
  io.present("elapsed_s", results.elapsed);
  io("engines", results.engines);
  io("cases", results.cases);
  io("runs", results.runs);
}

Json toJson(const StabilityResults& results) {
  return jsonOf(results);
}

StabilityResults stabilityFromJson(const Json& json) {
  return readAs<StabilityResults>(json);
}

}  // namespace crossgrain::inline results
