// A small version of what README.md reports: twelve hastily prepared packings, seconds each.
#include <gtest/gtest.h>

#include "cases/loader.hpp"
#include "tests/coverage/legs.hpp"
#include "tests/coverage/studies.hpp"

namespace {

using namespace crossgrain;

class SmallCoverage : public testing::Test {
 protected:
  static constexpr int packings = 12;

  static void SetUpTestSuite() {
    setup_ = loadCase(CROSSGRAIN_CASES "/couette/quick.toml",
                      {"preparation.rotations=0", "averaging.settle_rotations=0.05",
                       "averaging.rotations=0.15"})
                 .front();
    sample_ = {&setup_, {}, packings};
    for (int index = 0; index < packings; ++index) {
      const Packing packing = coverage::prepared(setup_, index);
      for (const char* name : {"", "stiff"})
        for (auto& entry : coverage::run(setup_, packing, index, legNamed(name), 1, false))
          sample_.runs.push_back(std::move(entry));
    }
  }

  /// A fault that is easily seen, beside the case itself.
  static coverage::Leg legNamed(const std::string& name) {
    if (name.empty()) return coverage::leg("");
    return {name, [](Case& c) { c.law.kn *= 3.0; }};
  }

  static double rateOf(const std::vector<coverage::Rate>& rates, const std::string& study) {
    for (const auto& rate : rates)
      if (rate.study == study && rate.field == "any") return rate.value;
    ADD_FAILURE() << study << " is not there";
    return 0.0;
  }

  static Case setup_;
  static coverage::Sample sample_;
};

Case SmallCoverage::setup_;
coverage::Sample SmallCoverage::sample_;

TEST_F(SmallCoverage, IntervalsOfGroupsCoverTheMeanOfAll) {
  // Groups of four out of twelve, all rings and fields: the group is a third of what it is held
  // against, which shrinks distances by √(2/3). 95 % of bars that wide cover about 98 %.
  double sum = 0.0;
  const auto rates = coverage::ensembles(sample_, 4);
  for (const auto& rate : rates) sum += rate.value;
  const double covered = sum / static_cast<double>(rates.size());
  EXPECT_GT(covered, 0.93);
  EXPECT_LT(covered, 0.999);
}

TEST_F(SmallCoverage, AFaultIsFoundAndItsAbsenceIsNot) {
  // Among 20 shuffles of one family of six against six: at 5 % no more than four (99.7 %).
  EXPECT_LE(rateOf(coverage::disagreements(sample_, "", 6), "disagree_0"), 0.2);
  // Threefold stiffness multiplies pressures.
  EXPECT_EQ(rateOf(coverage::disagreements(sample_, "stiff", packings), "disagree_0"), 1.0);
}

}  // namespace
