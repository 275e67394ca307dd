// Captions name what is drawn and nothing else, and lines that they name lie on the axis.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "reports/collide/report.hpp"
#include "reports/render/gnuplot.hpp"
#include "reports/stability/report.hpp"
#include "support/files.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::reports {
namespace {

/// The y axis that a figure's script asks for: "LOW:HIGH".
std::string yRangeOf(const Panel& panel) {
  Figure figure{.name = "one", .panels = {panel}};
  const TemporaryFolder folder;
  writeFigure(figure, folder.path());
  const std::string script = readFile(folder.path() / "one.gp").value();
  std::smatch found;
  std::regex_search(script, found, std::regex(R"(set yrange \[(.*)\])"));
  return found[1];
}

Panel panelWith(std::vector<double> values, double level, bool logarithmic) {
  Panel panel{.logY = logarithmic, .level = level};
  Curve curve;
  for (const double value : values) curve.points.push_back({1.0, value, {}});
  panel.curves = {curve};
  return panel;
}

TEST(Axes, PanelWithLine_IncludesIt) {
  // A limit of 0.01 beside values that never came near it, and one far below them.
  EXPECT_EQ(yRangeOf(panelWith({1e-6, 3e-6}, 0.01, true)), "1e-06:0.01");
  EXPECT_EQ(yRangeOf(panelWith({5.0, 2e4}, 0.01, true)), "0.01:100000");
  EXPECT_EQ(yRangeOf(panelWith({2.0, 3.0}, 2.5, true)), fmt::format("{}:{}", 2.0 / 1.3, 3.0 * 1.3));
  // Eight decades of data at most, whatever noise lies below, but the line in any case.
  EXPECT_EQ(yRangeOf(panelWith({1e-30, 1.0}, 0.1, true)), "1e-08:1");
  EXPECT_EQ(yRangeOf(panelWith({1e-30, 1.0}, 1e-12, true)), "1e-12:1");
  // A linear axis is gnuplot's choice, bounded so that the line is within.
  EXPECT_EQ(yRangeOf(panelWith({1.0, 2.0}, 3.5, false)), "*<3.5:3.5<*");
}

using NumberList = std::vector<std::optional<double>>;

/// Ψ_i = 0 and 2, of which half the energy is lost.
CollisionTable half() {
  CollisionTable table;
  table.psi = {0.0, 2.0};
  table.columns[QuantityId::energyBefore] = NumberList{1.0, 2.0};
  table.columns[QuantityId::energyAfter] = NumberList{0.5, 1.0};
  return table;
}

/// A variant whose energy is known part by part, and one of rigid disks.
CollideResults energies() {
  using enum QuantityId;
  CollisionVariant hertz, rigid;
  hertz.variant = "hertz";
  CollisionTable table = half();
  table.columns[lostNormalDamping] = NumberList{0.4, 0.5};
  table.columns[lostTangential] = NumberList{0.1, 0.5};
  CollisionCurve& curve = hertz.curves.emplace_back(CollisionCurve{.engine = "e", .dt = 1e-5});
  static_cast<CollisionTable&>(curve.points) = table;
  table.columns[psiF] = NumberList{0.0, 1.0};
  table.columns[lostTangentialDamping] = NumberList{0.05, 0.1};
  table.columns[lostStiffening] = NumberList{0.02, -0.1};
  table.columns[lostSliding] = NumberList{0.02, 0.4};
  table.columns[lostStored] = NumberList{0.01, 0.1};
  hertz.oracle = table;
  rigid.variant = "rigid";
  rigid.oracle = half();
  rigid.oracle.columns[psiF] = NumberList{0.0, 1.0};
  CollideResults results;
  results.head.setup.name = "c";
  results.engines.resize(1);
  results.engines.front().name = "e";
  results.variants = {hertz, rigid};
  return results;
}

TEST(EnergyFigure, Parts_AddUpToAllThatWasLost) {
  const auto figures = collideFigures(energies());
  const auto figure = std::ranges::find(figures, "collision_1_energy", &Figure::name);
  ASSERT_NE(figure, figures.end());
  const Panel& panel = figure->panels[0];
  std::vector<double> all(2), parts(2), ofEngine(2), engineAll(2);
  for (const Curve& curve : panel.curves)
    for (const Point& point : curve.points) {
      const auto k = static_cast<std::size_t>(point.x / 2.0);
      const bool total = curve.style.colour == "#222222";
      if (curve.draw == Draw::lines)
        (total ? all : parts)[k] += point.y;
      else
        (total ? engineAll : ofEngine)[k] += point.y;
    }
  for (const std::size_t k : {0u, 1u}) {
    EXPECT_NEAR(all[k], 0.5, 1e-12);
    // The oracle's own tangential part is drawn by its parts alone.
    EXPECT_NEAR(parts[k], all[k], 1e-12);
    EXPECT_NEAR(ofEngine[k], engineAll[k], 1e-12);
  }
  for (const char* named : {"stiffness, which follows the overlap", "all that was lost"})
    EXPECT_TRUE(has(figure->caption, named)) << named;
}

}  // namespace
}  // namespace crossgrain::reports
