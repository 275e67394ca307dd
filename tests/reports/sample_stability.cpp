#include "tests/reports/sample_common.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::sample {

namespace {

Json hardCase(const char* name, const char* variant) {
  return {{"case", name},
          {"variant", variant},
          {"file", "hard.toml"},
          {"tests", "What it tests."},
          {"measure", "energy_gain"},
          {"what", "energy above the start's"},
          {"unit", "of the energy"},
          {"limit", 0.01},
          {"degraded_limit", 0.1},
          {"why", awkward},
          {"toml", "[stability]"}};
}

Json run(const char* engine, const char* name, const char* variant, const char* verdict,
         const Json& value) {
  return {{"engine", engine},
          {"case", name},
          {"variant", variant},
          {"verdict", verdict},
          {"measure", "energy_gain"},
          {"value", value},
          {"limit", 0.01},
          {"degraded_limit", 0.1},
          {"unit", "of the energy"},
          {"step", nullptr},
          {"time_s", nullptr},
          {"reason", ""},
          {"picture", nullptr},
          {"realised", nullptr}};
}

Json picture() {
  return {{"radius", {1.0, 1.0}},
          {"x", {1000.0, 1002.0}},
          {"y", {0.0, 0.0}},
          {"wall_x", {1001.0}},
          {"wall_y", {-2.0}},
          {"wall_radius", {0.5}},
          {"planes", {{1000.0, -1.0, 0.0, 1.0}}},
          {"time_s", 0.3}};
}

}  // namespace

Json stabilityResults() {
  Json results = {{"schema", "crossgrain-results-1"},
                  {"kind", "stability"},
                  {"version", "0.1.0"},
                  {"case", {{"name", "hard cases"}, {"variant", ""}, {"toml", ""}}},
                  {"engines", {engine("grain", "in-house"), engine("odd-one", awkward)}}};
  results["cases"] = {hardCase("pile", "slow"), hardCase("pile", "fast"), hardCase("gas", "")};
  Json bad = run("odd-one", "pile", "fast", "unstable", 0.5);
  bad["step"] = 120;
  bad["time_s"] = 0.12;
  bad["curve"] = {{"t_s", {0.0, 0.1, 0.2}}, {"value", {0.0, 0.005, 0.5}}};
  bad["picture"] = picture();
  Json refused = run("odd-one", "gas", "", "refused", nullptr);
  refused["reason"] = awkward;
  results["runs"] = {run("grain", "pile", "slow", "stable", 0.001),
                     run("grain", "pile", "fast", "degraded", 0.05),
                     run("grain", "gas", "", "stable", 0.0),
                     run("odd-one", "pile", "slow", "stable", 0.0),
                     bad,
                     refused};
  return results;
}

}  // namespace crossgrain::sample
