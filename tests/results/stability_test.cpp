// The results of hard cases as they are kept in files.
#include "results/stability.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapters/worker/json.hpp"
#include "results/scene_picture.hpp"

namespace crossgrain::inline results {
namespace {

StabilityRun passedItsLimit() {
  StabilityRun run;
  run.engine = "grain";
  run.name = "pile";
  run.verdict = Verdict::borderline;
  run.value = 0.1;
  run.step = 120;
  run.time = 0.12;
  run.worstTime = 0.2;
  run.curve = {{0.0, 0.2}, {1e-300, INFINITY}};
  run.picture.emplace();
  run.picture->x = {-0.0};
  run.picture->planes = {{0.0, -1.0, 0.0, 1.0}};
  run.stats.emplace();
  run.stats->steps = 200;
  return run;
}

TEST(StabilityResults, RoundTrip) {
  StabilityResults results;
  results.head.kind = "stability";
  results.elapsed = 1.5;
  results.engines = {{"grain", "in-house", "1", "", Status::finished, ""}};
  results.cases.resize(1);
  results.runs = {passedItsLimit(), {}};
  const Json there = Json::parse(toJson(results).dump());
  EXPECT_EQ(Json::parse(toJson(stabilityFromJson(there)).dump()), there);
}

TEST(StabilityResults, WhatIsNotKnownIsNullAndTheWorstTimeLeftOut) {
  const Json run = jsonOf(StabilityRun{});
  for (const char* key : {"value", "step", "time_s", "picture", "realised", "stats"})
    EXPECT_TRUE(run.at(key).is_null()) << key;
  EXPECT_FALSE(run.contains("worst_time_s"));
  EXPECT_EQ(run["verdict"], "refused");
  const Json passed = jsonOf(passedItsLimit());
  EXPECT_EQ(passed["worst_time_s"], 0.2);
  EXPECT_TRUE(passed["picture"].contains("planes"));
  EXPECT_FALSE(passed["picture"].contains("contact_i"));
}

TEST(StabilityResults, AFileThatHoldsSomethingElseSaysWhere) {
  Json run = jsonOf(passedItsLimit());
  run["verdict"] = "fine";
  try {
    stabilityFromJson({{"runs", Json::array({run})}});
    FAIL() << "read";
  } catch (const FieldError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("runs.0.verdict: is \"fine\", not one of"))
        << error.what();
  }
}

}  // namespace
}  // namespace crossgrain::inline results
