#include "reports/flow/engine_table.hpp"

#include <gtest/gtest.h>

#include "reports/flow/report.hpp"
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
  const CompareResults compared = compareFromJson(results);
  return stateSentences(compared, engineRuns(compared));
}

TEST(StateSentences, AllAlikeIsOneSentence) {
  EXPECT_EQ(sentencesOf(flowing(4)),
            std::vector<std::string>{"All 4 packings flow on every engine."});
  EXPECT_EQ(sentencesOf(flowing(1)), std::vector<std::string>{"Packing 0 flows on every engine."});
}

TEST(StateSentences, NameThePackingThatStandsStillAndWhere) {
  Json results = flowing(4);
  set(results, "ours", 1, "blocked");
  set(results, "soft", 1, "blocked");
  results["regimes"] = {{{"a", "ours"}, {"b", "soft"}, {"packings", 4}, {"differ", Json::array()}},
                        {{"a", "ours"}, {"b", "hard"}, {"packings", 4}, {"differ", {1}}},
                        {{"a", "soft"}, {"b", "hard"}, {"packings", 4}, {"differ", {1}}}};
  const auto sentences = sentencesOf(results);
  ASSERT_EQ(sentences.size(), 4u);
  EXPECT_EQ(sentences[0], "Packing 1 is blocked on ours, soft; flows on hard.");
  EXPECT_EQ(sentences[1], "Packings 0, 2, 3 flow on every engine.");
  EXPECT_EQ(sentences[2],
            "Means over packings mix regimes on ours, soft: they describe none of them.");
  EXPECT_EQ(sentences[3],
            "Not in the same regime as ours: hard on packing 1. These pairs are compared in "
            "different states.");
}

TEST(StateSentences, EveryEngineIsEveryOneThatFinishedThePacking) {
  Json results = flowing(2);
  for (Json& entry : results["runs"])
    if (entry["engine"] == "soft" && entry["packing"] == 1) entry["status"] = "failed";
  EXPECT_EQ(sentencesOf(results), (std::vector<std::string>{"Packing 0 flows on every engine.",
                                                            "Packing 1 flows on ours, hard."}));
  // One engine is not "every".
  Json alone = flowing(1);
  alone["engines"].erase(2);
  alone["engines"].erase(1);
  EXPECT_EQ(sentencesOf(alone), std::vector<std::string>{"Packing 0 flows on ours."});
}

TEST(StateSentences, TellCollisionsAndWhatCannotBeTold) {
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

TEST(StateSentences, GiveOneOfThreeAnswersOnSteadiness) {
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

TEST(AveragedRotations, CountFromTheHandOverAndFromThePreparation) {
  FlowAveraging averaging = compareFromJson(flowing(1)).averaging;
  EXPECT_EQ(averagedRotations(averaging),
            "rotations 0.25 to 1.25 since the hand-over, 2.25 to 3.25 since the ring had closed");
  averaging.preparedRotations.reset();  // a packing of the user's own
  EXPECT_EQ(averagedRotations(averaging), "rotations 0.25 to 1.25 since the hand-over");
  averaging.fromRotation.reset();  // a file of snapshots
  EXPECT_EQ(averagedRotations(averaging), "");
}

TEST(StateTables, HaveARunAPairAndASeriesALine) {
  Json results = flowing(2);
  set(results, "ours", 1, "blocked");
  results["regimes"] = {{{"a", "ours"}, {"b", "hard"}, {"packings", 2}, {"differ", {1}}}};
  results["steadiness"] = Json::array({drift("ours", "outer_pressure", "drifts", -0.4, 0.08)});
  const CompareResults compared = compareFromJson(results);
  Report report;
  addStates(report.section("series", "Series").blocks, compared, engineRuns(compared));
  const std::string text = textOf(report);
  EXPECT_TRUE(has(text, "| 1 | blocked // contacts 15.5, slip 0.998")) << text;
  EXPECT_TRUE(has(text, "blocked 25 % of the time"));
  EXPECT_TRUE(has(text, "| ours – hard | 1 of 2 | 1\n"));
  EXPECT_TRUE(has(text, "| outer pressure | drifts // −40 ± 8 %"));
}

TEST(StateTables, CsvNamesTheRotationsOfEveryRow) {
  Json results = flowing(1);
  results["runs"][0]["steadiness"] =
      Json::array({drift("ours", "outer_pressure", "drifts", -0.5, 0.25)});
  results["steadiness"] = Json::array({drift("ours", "outer_pressure", "drifts", -0.5, 0.25)});
  Report report;
  report.tables = averageTables(compareFromJson(results));
  const std::string& regimes = csvOf(report, "regimes.csv");
  EXPECT_EQ(regimes.substr(0, regimes.find('\n')),
            "engine,packing,regime,wheel_contacts,wheel_slip,shear_share,inertial_number,"
            "blocked_share,from_rotation,to_rotation,prepared_rotations,reason");
  EXPECT_NE(regimes.find("ours,0,flowing,15.5,0.998,0.002,0.00014,0.25,0.25,1.25,2,\"layers take "
                         "up 0.002, less than 0.1\"\n"),
            std::string::npos);
  EXPECT_EQ(csvOf(report, "steadiness.csv"),
            "engine,packing,quantity,verdict,change,half_width,excluded,from_rotation,to_rotation,"
            "prepared_rotations\n"
            "ours,0,outer_pressure,drifts,-0.5,0.25,0.75,0.25,1.25,2\n"
            "ours,all,outer_pressure,drifts,-0.5,0.25,0.75,0.25,1.25,2\n");
}

}  // namespace
}  // namespace crossgrain::reports
