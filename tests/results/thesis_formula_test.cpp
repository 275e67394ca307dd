// Formulas of a run's numbers, worked out by hand on four rings.
#include "results/thesis_formula.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace crossgrain::inline results {
namespace {

/// Rings 1 d wide from R_i = 0.1 m: r̃ = 0.5, 1.5, 2.5, 3.5.
class ThesisFormula : public testing::Test {
 protected:
  ThesisFormula() {
    setup_.cell.innerRadius = 0.1;
    setup_.cell.outerRadius = 0.14;
    setup_.cell.diameter = 0.01;
    setup_.cell.omega = 2.0;
    setup_.kn = 300.0;
    setup_.settleRotations = 1.0;
    run_.run.profiles = {{"slicing", "spin", "", {1.0, 2.0, {}, 8.0}, {0.1, 0.2, {}, 0.8}, {}, {}},
                         {"slicing", "fabric_trace", "", {1.0, 0.0, 2.0, 4.0}, {}, {}, {}},
                         {"centre", "spin", "", {3.0, 3.0, 3.0, 3.0}, {}, {}, {}}};
    run_.finer = {{8, {}, {{"slicing", "spin", "", Numbers(8, 5.0), {}, {}, {}}}}};
    run_.run.fits.emplace_back().name = "velocity_decay";
    run_.run.fits.back().value = 4.0;
    run_.run.fits.back().standardError = 0.8;
    for (const double pressure : {100.0, 1.0, 3.0}) {
      ThesisSpan& span = run_.history.emplace_back();
      span.from = static_cast<double>(run_.history.size()) - 1.0;
      span.to = span.from + 1.0;
      span.outerPressure = pressure;
    }
  }

  std::optional<Measured> measured(const char* text) const {
    return Formula(text).number({at_, run_.run.profiles, "", [](std::string_view name) {
                                   return name == "bulk_from"   ? std::optional(chosen(2.0))
                                          : name == "bulk_to"   ? std::optional(chosen(9.0))
                                          : name == "uncertain" ? std::optional(uncertain(2.0))
                                                                : std::nullopt;
                                 }});
  }
  double value(const char* text) const {
    const auto found = measured(text);
    return found ? found->value : NAN;
  }
  double error(const char* text) const { return measured(text).value().within.value_or(NAN); }

  ThesisCase setup_;
  ThesisRun run_;
  CaseRun at_{&setup_, &run_};
};

TEST_F(ThesisFormula, Arithmetic_GoesFromLeftToRightWithPrecedence) {
  EXPECT_DOUBLE_EQ(value("2 + 3 * 4 - 10 / 5 / 2"), 13.0);
  EXPECT_DOUBLE_EQ(value("-(1 + 2) * kn / omega"), -450.0);
  EXPECT_DOUBLE_EQ(value("lg(100) + ln(exp(2)) + sqrt(9) + abs(0 - 1) + cos(0)"), 9.0);
}

TEST_F(ThesisFormula, RingFunctions_UseTheRingsThatHaveTheNumber) {
  EXPECT_DOUBLE_EQ(value("mean(spin)"), 11.0 / 3.0);
  EXPECT_DOUBLE_EQ(value("mean(spin, bulk)"), 8.0);  // r̃ = 2.5 has none
  EXPECT_DOUBLE_EQ(value("mean(spin, 0, 2)"), 1.5);
  EXPECT_DOUBLE_EQ(value("mean(spin, off_walls)"), 2.0);
  EXPECT_DOUBLE_EQ(value("median(spin)"), 2.0);
  EXPECT_DOUBLE_EQ(value("rms(spin, 0, 2)"), std::sqrt(2.5));
  EXPECT_DOUBLE_EQ(value("scatter(spin, 0, 2)"), 0.5 / 1.5);
  EXPECT_DOUBLE_EQ(value("max(spin) - min(spin)"), 7.0);
  EXPECT_DOUBLE_EQ(value("mean(where(spin, fabric_trace, 1))"), 4.5);
  EXPECT_DOUBLE_EQ(value("ring(spin, 1) + last(spin) + near(spin, 0.7)"), 11.0);
  EXPECT_NEAR(value("ring(r, 1)"), 0.115, 1e-15);
  EXPECT_NEAR(value("axis(spin * 0 + pi)"), 0.0, 1e-12);  // an axis, no arrow
}

TEST_F(ThesisFormula, MissingNumbersAndDivisionByZero_AreAbsent) {
  EXPECT_DOUBLE_EQ(value("mean(spin / fabric_trace)"), 1.5);  // 1/1 and 8/4: 2/0 is none
  for (const char* none : {"ring(spin, 2)", "ring(spin, 9)", "fit(dilation)", "ln(0 - 1)", "1 / 0",
                           "head(x)", "dt", "mean(stress_rr)", "positive(0)"})
    EXPECT_FALSE(measured(none)) << none;
}

TEST_F(ThesisFormula, Errors_SurviveExactFactorsAlone) {
  EXPECT_DOUBLE_EQ(error("fit(velocity_decay)"), 0.8);
  EXPECT_DOUBLE_EQ(error("ring(spin, 1) * (0 - omega)"), 0.4);
  EXPECT_DOUBLE_EQ(error("3 / positive(fit(velocity_decay))"), 3.0 * 0.8 / 16.0);
  EXPECT_DOUBLE_EQ(error("abs(ring(spin, 0)) / 2"), 0.05);
  for (const char* unknown : {"mean(spin)", "ring(spin, 0) * uncertain", "ln(fit(velocity_decay))",
                              "ring(spin, 0) - ring(spin, 1)", "fit(velocity_decay) + 1"})
    EXPECT_TRUE(std::isnan(error(unknown))) << unknown;
}

TEST_F(ThesisFormula, OtherAverages_AreOfThatMethodThoseRingsAndTheAveragedTime) {
  EXPECT_DOUBLE_EQ(value("mean(by(centre, spin)) - mean(by(slicing, spin))"), 3.0 - 11.0 / 3.0);
  EXPECT_DOUBLE_EQ(value("fine(max(spin))"), 5.0);
  EXPECT_DOUBLE_EQ(value("averaged(outer_pressure)"), 2.0);  // from rotation 1 on
}

TEST_F(ThesisFormula, UnknownNamesAndBadSyntax_Throw) {
  for (const char* bad : {"1 +", "(1", "mean(spin", "shape(spin)", "1 2", "averaged(nothing)"})
    EXPECT_THROW(Formula{bad}, std::logic_error) << bad;
  EXPECT_THROW(value("stres_rr"), std::logic_error);
  EXPECT_THROW(value("mean(spin, band)"), std::logic_error);  // nobody says where the band ends
  EXPECT_THROW(value("spin"), std::logic_error);              // rings where a number is wanted
}

}  // namespace
}  // namespace crossgrain::inline results
