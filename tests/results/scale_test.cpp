// What follows from timings of growing cells, by hand.
#include "results/scale.hpp"

#include <gtest/gtest.h>

#include "results/json_fields.hpp"

namespace crossgrain::inline results {
namespace {

ScalePoint timed(const char* engine, std::size_t disks, int workers, std::vector<double> seconds) {
  ScalePoint point;
  point.engine = engine;
  point.disks = disks;
  point.workers = workers;
  point.steps = 100;
  point.seconds = std::move(seconds);
  return point;
}

ScaleResults scaleStudy() {
  ScaleResults results;
  results.head.kind = "scale";
  results.repetitions = 3;
  results.engines = {{"grain", "", "1", "", Status::finished, ""},
                     {"other", "", "1", "", Status::finished, ""}};
  results.sharing = {{"grain", "threads"}, {"other", ""}};
  results.cells = {{1000, 300, 0.2, 0.8, ""}, {2000, 400, 0.3, 0.81, ""}};
  results.points = {timed("grain", 1000, 1, {12e-6, 10e-6, 15e-6}),
                    timed("grain", 1000, 2, {8e-6}),
                    timed("other", 1000, 1, {40e-6}),
                    timed("grain", 2000, 1, {24e-6}),
                    timed("grain", 2000, 2, {16e-6}),
                    timed("grain", 2000, 4, {10e-6})};
  results.points[0].memory = 5e5;
  return results;
}

TEST(ScaleFigures, OfOneWorker) {
  const ScaleResults results = scaleStudy();
  const ScaleFigures one = scaleFigures(results, results.points[0]);
  EXPECT_EQ(one.step, 10e-6);             // the fastest of 10, 12 and 15 µs
  EXPECT_DOUBLE_EQ(*one.spread, 0.5);     // 15/10 − 1
  EXPECT_DOUBLE_EQ(*one.perDisk, 10e-9);  // 10 µs for 1000 disks
  EXPECT_DOUBLE_EQ(*one.bytes, 500.0);    // 5·10⁵ for 1000
  EXPECT_DOUBLE_EQ(*one.ratio, 1.0);
  EXPECT_FALSE(one.strong);
  EXPECT_FALSE(one.weak);
}

TEST(ScaleFigures, StrongIsOnTheSameCellAndWeakOnOneOfAsManyDisksAWorker) {
  const ScaleResults results = scaleStudy();
  const ScaleFigures two = scaleFigures(results, results.points[4]);
  EXPECT_DOUBLE_EQ(*two.strong, 24.0 / (2 * 16.0));
  EXPECT_DOUBLE_EQ(*two.weak, 10.0 / 16.0);  // 1000 disks on one against 2000 on two
  EXPECT_FALSE(two.spread);                  // of one repetition
  const ScaleFigures four = scaleFigures(results, results.points[5]);
  EXPECT_DOUBLE_EQ(*four.strong, 24.0 / (4 * 10.0));
  EXPECT_FALSE(four.weak);  // nobody ran 500 disks
}

TEST(ScaleFigures, AnotherEngineIsHeldAgainstTheFirst) {
  const ScaleResults results = scaleStudy();
  EXPECT_DOUBLE_EQ(*scaleFigures(results, results.points[2]).ratio, 4.0);
}

TEST(ScaleFigures, WhatDidNotRunHasNoneAndLendsNone) {
  ScaleResults results = scaleStudy();
  results.points[0].status = Status::failed;
  const ScaleFigures failed = scaleFigures(results, results.points[0]);
  EXPECT_FALSE(failed.step || failed.spread || failed.perDisk || failed.bytes || failed.ratio);
  const ScaleFigures two = scaleFigures(results, results.points[4]);
  EXPECT_TRUE(two.strong);
  EXPECT_FALSE(two.weak);
  EXPECT_FALSE(scaleFigures(results, results.points[2]).ratio);
}

TEST(ScaleFigures, WorkersInWords) {
  EXPECT_EQ(describeWorkers({"grain", "threads"}, 1), "1 thread");
  EXPECT_EQ(describeWorkers({"lammps", "ranks"}, 4), "4 ranks");
  EXPECT_EQ(describeWorkers({"yade", ""}, 1), "one process");
}

TEST(ScaleResults, RoundTrip) {
  ScaleResults results = scaleStudy();
  results.elapsed = 1.5;
  results.points[1].status = Status::refused;
  results.points[1].reason = "no memory";
  results.points[2].differs = {"bottom_friction"};
  const Json there = Json::parse(toJson(results).dump());
  EXPECT_EQ(Json::parse(toJson(scaleFromJson(there)).dump()), there);
  EXPECT_TRUE(there["points"][1]["memory_bytes"].is_null());
}

}  // namespace
}  // namespace crossgrain::inline results
