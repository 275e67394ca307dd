// Figure 4.3, from the collisions of the ladder.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "reports/common/numbers.hpp"
#include "reports/thesis/figures.hpp"
#include "reports/thesis/findings.hpp"
#include "reports/thesis/law_sweeps.hpp"

namespace crossgrain::reports {

namespace {

constexpr double thesisSteps = 50.0;  ///< per contact
constexpr Range psiAxis{0.0, 4.0};

struct FigureLaw {
  const char *name, *words;
};
/// The three of the figure, and the thesis' own.
constexpr FigureLaw figureLaws[] = {{"coulomb", "Coulomb"},
                                    {"viscous", "viscous"},
                                    {"spring", "spring"},
                                    {"spring_dashpot", "spring, dashpot"}};

/// Ψ_i − 3(1 + e_n)µ from where it is 0 on.
Curve slidingLine(double en, double mu) {
  const double constant = 3.0 * (1.0 + en) * mu;
  return {"sliding",
          {"#888888", 0, true},
          Draw::lines,
          {{constant, 0.0, {}}, {psiAxis.high, psiAxis.high - constant, {}}},
          2.0};
}

std::vector<std::string> collidingEngines(const CollideResults& collisions) {
  std::vector<std::string> engines;
  for (const CollisionVariant& variant : collisions.variants)
    for (const CollisionCurve& curve : variant.curves)
      if (std::ranges::find(engines, curve.engine) == engines.end())
        engines.push_back(curve.engine);
  return engines;
}

Panel sweepsPanel(const CollideResults& collisions, const char* tension, const char* title,
                  std::vector<std::string>& clauses) {
  Panel panel;
  panel.title = title;
  panel.xLabel = "Ψ_{i}";
  panel.yLabel = "Ψ_{f}";
  panel.xRange = psiAxis;
  panel.level = 0.0;
  const auto engines = collidingEngines(collisions);
  bool line = false;
  for (std::size_t e = 0; e < engines.size(); ++e) {
    const LawSweeps sweeps = lawSweeps(collisions, engines[e], tension, thesisSteps);
    for (std::size_t l = 0; l < std::size(figureLaws); ++l) {
      const auto found = sweeps.find(figureLaws[l].name);
      if (found == sweeps.end()) continue;
      const std::vector<Point>& points = found->second.points;
      const bool first = e == 0;
      panel.curves.push_back({first    ? figureLaws[l].words
                              : l == 0 ? engines[e]
                                       : "",
                              thesisStyle(l, e), Draw::points, points, 1.0});
      clauses.push_back(fmt::format(
          "{}, {}, {}: lowest Ψ_f {}, e_n {}", title, engines[e], figureLaws[l].words,
          readable(std::ranges::min(points, {}, &Point::y).y), readable(found->second.en)));
      if (line) continue;
      panel.curves.push_back(slidingLine(found->second.en, lawFriction(collisions)));
      line = true;
    }
  }
  bool widened = false;
  if (!panel.curves.empty()) panel.yRange = holding({-1.0, 3.0}, panel.curves, false, widened);
  return panel;
}

}  // namespace

std::vector<Figure> collisionFigures(const ThesisResults& results) {
  if (!results.collisions) return {};
  std::vector<std::string> clauses;
  std::vector<Panel> panels = {
      sweepsPanel(*results.collisions, "allow", "tension allowed", clauses),
      sweepsPanel(*results.collisions, "cut", "tension cut", clauses)};
  std::erase_if(panels, [](const Panel& panel) { return panel.curves.empty(); });
  if (panels.empty()) return {};
  Figure figure = thesisFigureOf(
      "4.3", "Tangential velocities after and before a collision",
      thesisAndFound("only a spring reverses the tangential velocity; sliding follows Ψ_f = Ψ_i − "
                     "3(1 + e_n)µ",
                     clauses) +
          " Head-on collisions of two small disks with spin, table 4.1's constants (those of the "
          "thesis' figure are not stated), at 50 steps per contact; dashed: sliding.");
  figure.panels = std::move(panels);
  figure.columns = 2;
  return {std::move(figure)};
}

}  // namespace crossgrain::reports
