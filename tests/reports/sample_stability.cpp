#include "tests/reports/sample_common.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::sample {

namespace {

HardCase hardCase(const char* name, const char* variant) {
  return {name,
          variant,
          "hard.toml",
          "What it tests.",
          "energy_gain",
          "energy above the start's",
          "of the energy",
          0.01,
          0.1,
          awkward,
          "[stability]"};
}

StabilityRun run(const char* engine, const char* name, const char* variant, Verdict verdict,
                 std::optional<double> value) {
  StabilityRun run;
  run.engine = engine;
  run.name = name;
  run.variant = variant;
  run.verdict = verdict;
  run.measure = "energy_gain";
  run.value = value;
  run.limit = 0.01;
  run.degradedLimit = 0.1;
  run.unit = "of the energy";
  return run;
}

ScenePicture picture() {
  ScenePicture picture;
  picture.radius = {1.0, 1.0};
  picture.x = {1000.0, 1002.0};
  picture.y = {0.0, 0.0};
  picture.wallX = {1001.0};
  picture.wallY = {-2.0};
  picture.wallRadius = {0.5};
  picture.planes = {{1000.0, -1.0, 0.0, 1.0}};
  picture.time = 0.3;
  return picture;
}

}  // namespace

StabilityResults stabilityResults() {
  StabilityResults results;
  results.head.schema = schemaVersion;
  results.head.kind = kindStability;
  results.head.version = "0.1.0";
  results.head.setup.name = "hard cases";
  results.engines = {engineRow("grain", "in-house"), engineRow("odd-one", awkward)};
  results.cases = {hardCase("pile", "slow"), hardCase("pile", "fast"), hardCase("gas", "")};
  StabilityRun bad = run("odd-one", "pile", "fast", Verdict::fail, 0.5);
  bad.step = 120;
  bad.time = 0.12;
  bad.curve = {{0.0, 0.1, 0.2}, {0.0, 0.005, 0.5}};
  bad.picture = picture();
  StabilityRun refusal = run("odd-one", "gas", "", Verdict::notApplicable, {});
  refusal.status = Status::refused;
  refusal.reason = awkward;
  results.runs = {run("grain", "pile", "slow", Verdict::pass, 0.001),
                  run("grain", "pile", "fast", Verdict::borderline, 0.05),
                  run("grain", "gas", "", Verdict::pass, 0.0),
                  run("odd-one", "pile", "slow", Verdict::pass, 0.0),
                  bad,
                  refusal};
  return results;
}

}  // namespace crossgrain::sample
