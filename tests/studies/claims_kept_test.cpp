// What a results file keeps of its runs is what claims are judged by.
#include <gtest/gtest.h>

#include "claims_world.hpp"
#include "results/thesis.hpp"

namespace crossgrain::test {
namespace {

TEST(KeptResults, Compacted_IsJudgedAlike) {
  const ThesisResults whole = world(2);
  const auto before = judgeClaims(whole, shippedRules());
  const auto after = judgeClaims(compacted(whole), shippedRules());
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    SCOPED_TRACE(before[k].id + " " + before[k].interpretation);
    EXPECT_EQ(after[k].verdict, before[k].verdict);
    EXPECT_EQ(after[k].cases, before[k].cases);
    ASSERT_EQ(after[k].figures.size(), before[k].figures.size());
    for (std::size_t f = 0; f < before[k].figures.size(); ++f) {
      const auto then = before[k].figures[f].value, now = after[k].figures[f].value;
      ASSERT_EQ(now.has_value(), then.has_value()) << before[k].figures[f].name;
      if (then) {
        // Runs of this world that are equal but for rounding tie, or do not.
        const bool ranks = before[k].figures[f].name.starts_with("τ");
        EXPECT_NEAR(*now, *then, ranks ? 0.05 : 1e-3 * (1.0 + std::abs(*then)));
      }
    }
  }
}

TEST(KeptResults, CompactedAgain_IsTheSame) {
  const ThesisResults once = compacted(world(1));
  EXPECT_EQ(toJson(compacted(once)), toJson(once));
  // In a file, too.
  const ThesisResults back = thesisFromJson(Json::parse(toJson(once).dump()));
  EXPECT_EQ(toJson(compacted(back)), toJson(once));
}

TEST(KeptResults, Compacted_LacksWhatNoClaimReads) {
  ThesisResults results = world(1);
  changeAll(results, [](ThesisRun& run, const ThesisCase& setup) {
    setField(run, setup, "nobody_asks_for_it", [](double) { return 1.0; });
    run.run.series.emplace()["t_s"] = {0.0, 1.0};
    run.run.checks.emplace_back();
    setDistribution(run, "normal_force", {}, velocityAxis, [](double, double) { return 1.0; });
    setDistribution(run, "spin", 7, velocityAxis, [](double, double) { return 1.0; });
  });
  const ThesisResults few = compacted(results);
  for (const ThesisRun& run : few.runs) {
    EXPECT_TRUE(run.run.series->empty());
    EXPECT_TRUE(run.run.checks.empty());
    EXPECT_EQ(profileOf(run.run.profiles, "nobody_asks_for_it"), nullptr);
    for (const Distribution& each : run.run.distributions) {
      EXPECT_NE(each.quantity, "normal_force");
      EXPECT_FALSE(each.quantity == "spin" && each.ring == 7);
    }
  }
  // Finer rings and distributions are of the table's cases and interpretations.
  EXPECT_FALSE(few.runs.front().finer.empty());
  EXPECT_FALSE(few.runs.front().run.distributions.empty());
  const auto rate = std::ranges::find_if(
      few.runs, [](const ThesisRun& run) { return run.setup.starts_with("omega-"); });
  EXPECT_TRUE(rate->finer.empty());
  EXPECT_TRUE(rate->run.distributions.empty());
}

TEST(KeptResults, Compacted_HasSixDigits) {
  ThesisResults results = world(1);
  *fieldAt(results.runs.front(), "spin", 3) = 1.23456789e-7;
  const ThesisRun run = compacted(results).runs.front();
  EXPECT_EQ(profileOf(run.run.profiles, "spin")->mean[3], 1.23457e-7);
}

}  // namespace
}  // namespace crossgrain::test
