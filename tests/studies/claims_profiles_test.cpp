// Each claim against a world made by hand in which it holds, one in which it does not, and one that
// has no runs.
#include "claims_world.hpp"

namespace crossgrain::test {
namespace {

/// How a claim comes to be false.
struct Falsehood {
  const char* id;
  Change change;
  const char* part;  ///< the figure that the reason must name
};

void PrintTo(const Falsehood& of, std::ostream* out) {
  *out << of.id;
}

Change scaled(const std::string& field, double factor) {
  return [=](ThesisRun& run, const ThesisCase&) { scaleField(run, field, factor); };
}

Change shaped(const std::string& field, const Shape& shape) {
  return [=](ThesisRun& run, const ThesisCase& setup) { setField(run, setup, field, shape); };
}

Change fitted(const std::string& name, double value) {
  return [=](ThesisRun& run, const ThesisCase&) { setFit(run, name, value); };
}

Change inHistory(const std::function<void(ThesisSpan&)>& change) {
  return [=](ThesisRun& run, const ThesisCase&) {
    for (ThesisSpan& span : run.history) change(span);
  };
}

void noRidge(ThesisRun& run, const ThesisCase&) {
  setDistribution(run, "azimuthal_velocity_and_spin", {}, jointAxes,
                  [](double v, double s) { return 0.5 + std::exp(-40.0 * (v * v + s * s)); });
}

void isotropicContacts(ThesisRun& run, const ThesisCase&) {
  for (int ring = 0; ring < worldRings; ++ring)
    setDistribution(run, "contact_direction", ring, directionAxis, [](double angle, double) {
      return (1.0 - 0.35 * std::cos(2.0 * (angle - pi / 3.0))) / 2.0 / pi;
    });
}

void fasterWheelPressesMore(ThesisRun& run, const ThesisCase& setup) {
  for (ThesisSpan& span : run.history) *span.outerPressure *= std::pow(setup.cell.omega / 0.1, 2.0);
}

void bandPressedMore(ThesisRun& run, const ThesisCase&) {
  for (std::size_t ring = 0; ring < 5; ++ring) *fieldAt(run, "fabric_trace", ring) = 4.0;
}

void torqueGrowsOutward(ThesisRun& run, const ThesisCase&) {
  *fieldAt(run, "couple_stress_zr", 0) = 1e-9;
}

void carriesNowhere(ThesisRun& run, const ThesisCase& setup) {
  for (ThesisSpan& span : run.history)
    if (setup.label < 0.8055) span.wheelContacts = 0.0;
}

const std::vector<Falsehood>& falsehoods() {
  static const std::vector<Falsehood> all{
      {"C3",
       [](ThesisRun& run, const ThesisCase&) {
         for (auto& rings : run.finer)
           for (auto& value : rings.profiles[0].mean) *value += 0.5;
       },
       "largest ν by slicing"},
      {"C4", inHistory([](ThesisSpan& span) { *span.volumeFractionAtWheel -= 0.03 * span.to; }),
       "change of ν in ring 1"},
      {"C5", fitted("dilation_decay", 1.0), "C⁻¹"},
      {"C6", carriesNowhere, "critical ν̄"},
      {"C7", fitted("velocity_decay", 9.0), "B is"},
      {"C8", fitted("spin_amplitude", 0.5), "A at 0.796"},
      {"C9", fasterWheelPressesMore, "exponent of the outer pressure"},
      {"C10", shaped("fluctuation_stress_rr", [](double) { return 1e-3; }), "width at r̃ = 0.5"},
      {"C11", noRidge, "ridge"},
      {"C12", bandPressedMore, "tr F of the band"},
      {"C13", shaped("fabric_angle", [](double) { return 0.2; }), "axis of F"},
      {"C14", isotropicContacts, "density at π/2"},
      {"C15", scaled("stress_pp", 2.0), "σ_φφ/σ_rr"},
      {"C16", scaled("dynamic_stress_rr", 10.0), "dynamic σ_φφ over σ_rr"},
      {"C17",
       [](ThesisRun& run, const ThesisCase& setup) {
         scaleField(run, "stress_rr", std::exp(-500.0 * (setup.label - 0.789)));
       },
       "τ of σ_rr"},
      {"C18",
       [](ThesisRun& run, const ThesisCase& setup) {
         setField(run, setup, "strain_trace", [](double x) { return x < 5.0 ? 0.5e-4 : 1e-4; });
       },
       "tr ε of the band"},
      {"C19", shaped("stress_angle", [](double) { return 1.3; }), "angle of F"},
      {"C20", scaled("bulk_modulus", 1.5), "mean of 2πhE"},
      {"C21", shaped("shear_modulus", [](double) { return 9000.0; }), "exponent of G"},
      {"C22", scaled("spin", -1.0), "mean spin over"},
      {"C23", torqueGrowsOutward, "|M_zr|"},
      {"C26", [](ThesisRun& run, const ThesisCase&) { setHead(run, "max_overlap_over_d", 1e-3); },
       "largest overlap"},
      {"C27",
       [](ThesisRun& run, const ThesisCase& setup) {
         for (std::size_t ring = 5; ring < worldRings; ++ring)
           *fieldAt(run, "fabric_trace", ring) = 3.0 - 20.0 * (setup.label - 0.789);
       },
       "τ of tr F_div"},
  };
  return all;
}

class Claims : public ::testing::TestWithParam<Falsehood> {};

TEST_P(Claims, WorldWithoutIt_IsRefutedByItsFigure) {
  ThesisResults results = world();
  changeAll(results, GetParam().change);
  const ClaimRow row = rowOf(judgeClaims(results, shippedRules()), GetParam().id);
  EXPECT_EQ(row.verdict, Verdict::fail) << row.why;
  const std::string refuted = row.why.substr(0, row.why.find(". "));
  EXPECT_TRUE(refuted.starts_with("refuted")) << row.why;
  EXPECT_NE(refuted.find(GetParam().part), std::string::npos) << row.why;
}

TEST(ClaimsOfProfiles, AllAsTheThesisSays_AreReproduced) {
  const std::vector<ClaimRow> rows = judgeClaims(world(), shippedRules());
  for (const Falsehood& claim : falsehoods()) {
    const ClaimRow row = rowOf(rows, claim.id);
    EXPECT_EQ(row.verdict, Verdict::pass) << row.why;
    EXPECT_FALSE(row.cases.empty());
    EXPECT_NE(row.why.find("Averaged over rotations 5 to 8"), std::string::npos) << row.why;
  }
}

TEST(ClaimsOfProfiles, WithoutRuns_AreUndecidedAndNameTheCases) {
  ThesisResults results = world();
  results.runs.clear();
  const std::vector<ClaimRow> rows = judgeClaims(results, shippedRules());
  for (const Falsehood& claim : falsehoods()) {
    const ClaimRow row = rowOf(rows, claim.id);
    EXPECT_EQ(row.verdict, Verdict::undecided);
    EXPECT_TRUE(row.why.find("none of nu-0") != std::string::npos ||
                row.why.find("none of omega-0.01") != std::string::npos)
        << row.why;
  }
}

INSTANTIATE_TEST_SUITE_P(OfTheThesis, Claims, ::testing::ValuesIn(falsehoods()),
                         [](const auto& claim) { return std::string(claim.param.id); });

}  // namespace
}  // namespace crossgrain::test
