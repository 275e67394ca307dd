#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "reports/render/gnuplot.hpp"
#include "reports/thesis/report.hpp"
#include "results/thesis.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::reports {
namespace {

const std::vector<Figure>& sampleFigures() {
  static const std::vector<Figure> figures = thesisFigures(sample::thesisResults());
  return figures;
}

std::string nameOf(std::string number) {
  std::ranges::replace(number, '.', '_');
  return "figure_" + number;
}

const Figure& thesisFigureNumbered(const std::string& number) {
  const auto found = std::ranges::find(sampleFigures(), nameOf(number), &Figure::name);
  if (found == sampleFigures().end()) throw std::runtime_error("no figure " + number);
  return *found;
}

const Curve& curveNamed(const Panel& panel, const std::string& name) {
  const auto found = std::ranges::find(panel.curves, name, &Curve::name);
  if (found == panel.curves.end()) throw std::runtime_error("no curve " + name);
  return *found;
}

/// What a results file keeps is all that figures are drawn from.
TEST(ThesisFigures, CompactedResults_GiveTheSame) {
  const std::vector<Figure> figures = thesisFigures(compacted(sample::thesisResults()));
  ASSERT_EQ(figures.size(), sampleFigures().size());
  for (std::size_t f = 0; f < figures.size(); ++f) {
    SCOPED_TRACE(figures[f].name);
    const Figure& whole = sampleFigures()[f];
    ASSERT_EQ(figures[f].panels.size(), whole.panels.size());
    for (std::size_t p = 0; p < whole.panels.size(); ++p) {
      ASSERT_EQ(figures[f].panels[p].curves.size(), whole.panels[p].curves.size());
      for (std::size_t c = 0; c < whole.panels[p].curves.size(); ++c) {
        const Curve &now = figures[f].panels[p].curves[c], &then = whole.panels[p].curves[c];
        ASSERT_EQ(now.points.size(), then.points.size());
        for (std::size_t k = 0; k < then.points.size(); ++k) {
          EXPECT_NEAR(now.points[k].y, then.points[k].y, 1e-3 * std::abs(then.points[k].y));
          EXPECT_EQ(now.points[k].error.has_value(), then.points[k].error.has_value());
        }
      }
    }
  }
}

TEST(ThesisFigures, NoResults_HaveNone) {
  EXPECT_TRUE(thesisFigures({}).empty());
  ThesisResults unfinished = sample::thesisResults();
  for (ThesisRun& run : unfinished.runs) run.run.status = Status::failed;
  EXPECT_TRUE(thesisFigures(unfinished).empty());
}

/// ν̄ has the colours, engines have the marks; both are named once.
TEST(ThesisFigures, Densities_HaveColoursAndEnginesMarks) {
  const Panel& panel = thesisFigureNumbered("7.5").panels.at(0);
  // 0.789, 0.800 and 0.804 of both engines, four more of the first.
  ASSERT_EQ(3u * 2u + 4u, panel.curves.size());
  const Curve &low = curveNamed(panel, "0.789"), &high = curveNamed(panel, "0.819");
  const Curve& other = curveNamed(panel, "beta");
  EXPECT_NE(low.style.colour, high.style.colour);
  EXPECT_EQ(low.style.pointType, high.style.pointType);
  EXPECT_NE(low.style.pointType, other.style.pointType);
  EXPECT_EQ(low.points.size(), 20u);
}

/// Two packings of 1 and 1.1 times the same profile: mean 1.05, error 0.1/√2/√2.
TEST(ThesisFigures, Means_AreOverPackings) {
  const Panel& panel = thesisFigureNumbered("6.7").panels.at(0);
  const Point& first = curveNamed(panel, "0.804").points.front();
  const double x = 0.5 * 0.1492 / 20.0 / 0.0074;
  EXPECT_NEAR(x, first.x, 1e-12);
  EXPECT_NEAR(1.05 * 0.6 * std::exp(-x / 1.9), first.y, 1e-12);
  EXPECT_NEAR(0.05 * 0.6 * std::exp(-x / 1.9), first.error.value(), 1e-12);
  // One packing has its own error: 1 % in the sample.
  const Point& single = curveNamed(panel, "beta").points.front();
  EXPECT_NEAR(0.01 * single.y, single.error.value(), 1e-12);
}

TEST(ThesisFigures, Axes_AreTheThesisOnesUnlessDataLieBeyond) {
  const Figure& inside = thesisFigureNumbered("7.7");
  EXPECT_DOUBLE_EQ(0.0, inside.panels[0].yRange->low);
  EXPECT_DOUBLE_EQ(std::numbers::pi / 2.0, inside.panels[0].yRange->high);
  EXPECT_EQ(std::string::npos, inside.caption.find("wider"));
  // 1.05·1000 (0.804 − 0.78) = 25 N/m² is beyond 0.1 … 10.
  const Figure& beyond = thesisFigureNumbered("7.12");
  EXPECT_DOUBLE_EQ(0.1, beyond.panels[0].yRange->low);
  EXPECT_DOUBLE_EQ(100.0, beyond.panels[0].yRange->high);
  EXPECT_NE(std::string::npos, beyond.caption.find("wider"));
}

/// G/tr F is nine times as large from r̃ = 8 on; the ring that holds it is at r̃ = 8.57.
TEST(ThesisFigures, ShearResistance_Diverges) {
  const Panel& panel = thesisFigureNumbered("7.24").panels.at(0);
  const Curve& curve = curveNamed(panel, "beta");
  const double x = 8.5 * 0.1492 / 20.0 / 0.0074;
  const double nu = curve.points.front().x;
  EXPECT_NEAR(1.05 * (3.5 - std::exp(-x)) * (nu - 0.2 * std::exp(-x)), curve.points.front().y,
              1e-9);
}

/// u(0) is chosen for that: the thesis' section 9.2.
TEST(ThesisFigures, Model_HasTheVelocityNextToTheWheel) {
  const Figure& velocity = thesisFigureNumbered("9.1");
  const Curve& model = curveNamed(velocity.panels.at(0), "model as printed");
  const Curve& averages = curveNamed(velocity.panels.at(0), "alpha");
  // The innermost ring's centre lies at ξ = 1/40.
  const auto& drawn = model.points;
  EXPECT_NEAR(averages.points.front().y, drawn[5].y, 1e-9);
  EXPECT_NEAR(0.0, model.points.back().y, 1e-9);
  // The model's couple stress of the thesis' Fig. 9.4a; M_zr > 0 is m < 0.
  const Figure& couple = thesisFigureNumbered("9.4");
  EXPECT_NEAR(0.2136, curveNamed(couple.panels.at(0), "model as printed").points.front().y, 2e-4);
  EXPECT_LT(curveNamed(couple.panels.at(1), "alpha").points.front().y, 0.0);
}

TEST(ThesisFigures, All_CanBeDrawn) {
  const TemporaryFolder folder;
  std::vector<std::string> scripts;
  for (const Figure& figure : sampleFigures())
    scripts.push_back(writeFigure(figure, folder.path()));
  EXPECT_NO_THROW(runGnuplot(scripts, folder.path()));
  for (const Figure& figure : sampleFigures())
    EXPECT_TRUE(std::filesystem::exists(folder.path() / (figure.name + ".svg"))) << figure.name;
}

}  // namespace
}  // namespace crossgrain::reports
