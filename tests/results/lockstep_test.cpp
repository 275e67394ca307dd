// Engines against their mirrors, as a document and back.
#include "results/compare.hpp"

#include <gtest/gtest.h>

#include "results/json_fields.hpp"

namespace crossgrain::inline results {
namespace {

LockstepResults measured() {
  LockstepResults results;
  results.head.schema = "crossgrain-results-1";
  results.head.kind = "lockstep";
  results.elapsed = 9.5;
  results.engines = {{"yade", "", "1", "", EngineStatus::ran, ""}};
  results.lockstep.rules = {1e-10, 1e-3, 1e-3, "kn", 0.05};
  results.lockstep.starts = {{1, 0.25, 3.5}};
  LockstepRow row;
  row.engine = "yade";
  row.verdict = Equivalence::sameLaw;
  row.equivalent = 1.2e-5;
  row.equivalentLow = 1e-5;
  row.readings = {{1.2e-5, 0.02, false}, {{}, 0.0, false}};
  row.read = 1;
  row.shareHigh = 0.95;
  row.starts = 16;
  row.separations = {{1e-3, 2.5e-10, 1e-9, 4e-5, {}, 1.8e-7}, {0.01, 2e-8, 1e-7, {}, 3e-7, {}}};
  row.trackTime = {4e-5};
  row.track = {0.0};
  row.kinds = {1, 2, 3, 4, 5};
  row.first = {2, 4.8e-4, 6e-4, 124, 251, "sticking, wall"};
  row.forces = {100, 1, 2, 1e-3, 1e-4};
  row.term = {"kn", 1e-4, 0.25};
  row.wallSeconds = 7.25;
  LockstepRow none;
  none.engine = "box2d-impulse";
  none.reason = "no mirror";
  none.failure = "gone";
  results.lockstep.rows = {row, none};
  return results;
}

TEST(LockstepDocument, ComesBackAsItWas) {
  const Json document = toJson(measured());
  EXPECT_EQ(toJson(lockstepFromJson(document)), document);
  EXPECT_EQ(document.at("lockstep").at("rows").at(0).at("verdict"), "same_law");
  EXPECT_EQ(document.at("lockstep").at("rows").at(0).at("first").at("partner"), 251);
  EXPECT_TRUE(document.at("lockstep").at("rows").at(1).at("term").is_null());
  EXPECT_TRUE(document.at("lockstep").at("rows").at(1).at("equivalent").is_null());
}

TEST(LockstepDocument, SaysWhereItIsWrong) {
  Json document = toJson(measured());
  document["lockstep"]["rows"][0]["kinds"]["new"] = "many";
  try {
    lockstepFromJson(document);
    FAIL() << "nothing was said";
  } catch (const FieldError& error) {
    EXPECT_EQ(std::string(error.what()).find("lockstep.rows.0.kinds.new: "), 0u) << error.what();
  }
}

}  // namespace
}  // namespace crossgrain::inline results
