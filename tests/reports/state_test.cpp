#include "reports/flow/report.hpp"

#include <gtest/gtest.h>

#include "tests/reports/report_text.hpp"

namespace crossgrain::reports {
namespace {

using Json = nlohmann::json;

Json run(const char* engine, int packing, const char* regime) {
  return {{"engine", engine},
          {"packing", packing},
          {"status", "finished"},
          {"regime",
           {{"name", regime ? Json(regime) : Json(nullptr)},
            {"reason", "layers take up 0.002, less than 0.1"},
            {"wheel_contacts", 15.5},
            {"wheel_slip", 0.998},
            {"shear_share", 0.002},
            {"inertial_number", 1.4e-4},
            {"blocked_share", 0.25}}}};
}

/// Three engines on so many packings, all flowing.
Json flowing(int packings) {
  Json results = {
      {"averaging", {{"from_rotation", 0.25}, {"to_rotation", 1.25}, {"prepared_rotations", 2.0}}}};
  for (const char* engine : {"ours", "soft", "hard"}) {
    results["engines"].push_back({{"name", engine}, {"mirrors", ""}, {"status", "ran"}});
    for (int k = 0; k < packings; ++k) results["runs"].push_back(run(engine, k, "flowing"));
  }
  return results;
}

void set(Json& results, const char* engine, int packing, const char* regime) {
  for (Json& entry : results["runs"])
    if (entry["engine"] == engine && entry["packing"] == packing)
      entry["regime"]["name"] = regime ? Json(regime) : Json(nullptr);
}

std::vector<std::string> sentencesOf(const Json& results) {
  const CompareResults compared = fromJson<CompareResults>(results);
  return stateSentences(compared, engineRuns(compared));
}

TEST(StateSentences, AllAlike_IsOneSentence) {
  EXPECT_EQ(sentencesOf(flowing(4)),
            std::vector<std::string>{"All 4 packings flow on every engine."});
  EXPECT_EQ(sentencesOf(flowing(1)), std::vector<std::string>{"Packing 0 flows on every engine."});
}

TEST(StateSentences, CollisionalAndUndecided_AreNamed) {
  Json results = flowing(2);
  for (const char* engine : {"ours", "soft", "hard"}) set(results, engine, 0, "collisional");
  set(results, "hard", 1, nullptr);
  const auto sentences = sentencesOf(results);
  ASSERT_EQ(sentences.size(), 3u);
  EXPECT_EQ(sentences[0], "Packing 1 flows on ours, soft; is undecided on hard.");
  EXPECT_EQ(sentences[1], "Packing 0 is collisional on every engine.");
  // A run that failed is in no regime, and results of before say nothing.
  for (Json& entry : results["runs"]) entry.erase("regime");
  EXPECT_TRUE(sentencesOf(results).empty());
}

Json drift(const char* engine, const char* quantity, const char* verdict, double change,
           double half) {
  return {{"engine", engine},          {"quantity", quantity},
          {"verdict", verdict},        {"change", change},
          {"half_width", half},        {"excluded", std::abs(change) + half},
          {"drifting", Json::array()}, {"packings", 4}};
}

TEST(StateSentences, Steadiness_HasOneOfThreeAnswers) {
  Json results = flowing(4);
  results["steadiness"] = {drift("ours", "outer_pressure", "drifts", -0.4, 0.08),
                           drift("ours", "wheel_torque", "no drift seen", 0.0, 0.2),
                           drift("soft", "outer_pressure", "no drift seen", 0.05, 0.1),
                           drift("soft", "wheel_torque", "no drift seen", 0.02, 0.18),
                           drift("hard", "outer_pressure", "cannot tell", 0.1, 0.5),
                           drift("hard", "wheel_torque", "no drift seen", 0.02, 0.18)};
  const auto sentences = sentencesOf(results);
  ASSERT_EQ(sentences.size(), 4u);
  EXPECT_EQ(sentences[1],
            "Not steady: on ours outer pressure falls by 40 ± 8 %, of the mean, over the averaged "
            "time.");
  EXPECT_EQ(sentences[2], "No drift seen over the averaged time: soft (down to 20 %).");
  EXPECT_EQ(sentences[3],
            "Steady or not is undecided for hard: changes of outer pressure by up to 60 % are not "
            "excluded.");
}

TEST(AveragedRotations, Count_FromTheHandOverAndThePreparation) {
  FlowAveraging averaging = fromJson<CompareResults>(flowing(1)).averaging;
  EXPECT_EQ(averagedRotations(averaging),
            "rotations 0.25 to 1.25 since the hand-over, 2.25 to 3.25 since the ring had closed");
  averaging.preparedRotations.reset();  // a packing of the user's own
  EXPECT_EQ(averagedRotations(averaging), "rotations 0.25 to 1.25 since the hand-over");
  averaging.fromRotation.reset();  // a file of snapshots
  EXPECT_EQ(averagedRotations(averaging), "");
}

}  // namespace
}  // namespace crossgrain::reports
