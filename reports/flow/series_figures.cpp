#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <numeric>

#include "reports/flow/report.hpp"

namespace crossgrain::reports {

namespace {

struct SeriesPlot {
  std::string name, title, label;
};
const SeriesPlot seriesPlots[] = {
    {"wheel_torque", "Torque of the wheel on the disks", "torque [N m]"},
    {"outer_pressure", "Pressure on the outer wall", "pressure [N/m^{2}]"},
    {"shear_share", "Shear among the disks, share of the wheel's rotation (below 0.1: blocked)",
     "shear among the disks / Ω"},
    {"coordination", "Contacts per particle", "contacts per particle"},
    {"kinetic_energy", "Kinetic energy", "kinetic energy [J]"},
    {"disks", "Particles in the averaged part", "particles"},
    {"top", "Highest point of the particles", "height [m]"},
    {"heap_slope", "Slope of the triangle with the particles' moments", "slope"},
};

constexpr std::size_t shownPoints = 80;

/// Means of so many equal parts of a series, each at its mean time.
std::vector<Point> blockMeans(const Numbers& times, const Numbers& values, double timeScale) {
  const std::size_t size = std::min(times.size(), values.size());
  const std::size_t block = std::max<std::size_t>(1, (size + shownPoints - 1) / shownPoints);
  std::vector<Point> means;
  for (std::size_t begin = 0; begin < size; begin += block) {
    double x = 0.0, y = 0.0;
    int count = 0;
    for (std::size_t k = begin; k < std::min(size, begin + block); ++k) {
      const auto time = at(times, k), value = at(values, k);
      if (!time || !value) continue;
      x += *time;
      y += *value;
      ++count;
    }
    if (count > 0) means.push_back({x / count * timeScale, y / count, {}});
  }
  return means;
}

/// Rotations of the wheel per second; absent if it stands.
std::optional<double> rotationRate(const CouetteCell& cell) {
  if (cell.omega == 0.0) return std::nullopt;
  return std::abs(cell.omega) / (2.0 * std::numbers::pi);
}

Panel seriesPanel(const FlowFrame& frame, const Engines& engines, const SeriesPlot& plot) {
  const auto rate = rotationRate(frame.cell);
  Panel panel;
  panel.xLabel = rate ? "rotations since hand-over" : "time since hand-over [s]";
  panel.yLabel = plot.label;
  const auto settle = frame.averaging.settleRotations;
  if (rate && settle && *settle > 0.0) panel.shaded = Range{0.0, *settle};
  for (const EngineRuns& engine : engines) {
    std::string name = engine.name;
    for (const FlowRun* run : engine.runs) {
      if (!run->series) continue;
      const RunSeries& series = *run->series;
      Curve curve{
          name, engine.style, Draw::lines,
          blockMeans(valuesOf(series, "t_s"), valuesOf(series, plot.name), rate.value_or(1.0)),
          1.0};
      if (curve.points.empty()) continue;
      panel.curves.push_back(std::move(curve));
      name.clear();
    }
  }
  chooseLogY(panel);
  double first = INFINITY, last = 0.0;
  for (const Curve& curve : panel.curves) {
    first = std::min(first, curve.points.front().x);
    last = std::max(last, curve.points.back().x);
  }
  // From 0 only where settling is shown: the axis has no empty part.
  if (last > 0.0) panel.xRange = Range{panel.shaded || first == last ? 0.0 : first, last};
  return panel;
}

/// value/reference per ring; 1 is balance.
std::vector<Point> balancePoints(const RingPlaces& rings, const CheckRow& check) {
  std::vector<Point> points;
  for (std::size_t ring = 0; ring < check.value.size(); ++ring) {
    const auto x = at(rings.rTilde, ring), value = at(check.value, ring);
    const auto reference = at(check.reference, ring), error = at(check.standardError, ring);
    if (!x || !value || !reference || *reference == 0.0) continue;
    Point point{*x, *value / *reference, {}};
    if (error) point.error = *error / std::abs(*reference);
    points.push_back(point);
  }
  return points;
}

std::vector<Figure> seriesFigures(const FlowFrame& frame, const Engines& engines) {
  std::vector<Figure> figures;
  for (const SeriesPlot& plot : seriesPlots) {
    Panel panel = seriesPanel(frame, engines, plot);
    if (!hasPoints(panel)) continue;
    figures.push_back(
        {"series_" + plot.name, plot.title + " against time", plot.title + ".", {panel}});
  }
  return figures;
}

std::vector<Figure> checkFigures(const FlowFrame& frame, const Engines& engines) {
  std::vector<Figure> figures;
  std::vector<std::pair<std::string, std::string>> checks;  // name, label
  for (const EngineRuns& engine : engines)
    if (!engine.finished.empty())
      for (const CheckRow& check : engine.finished.front()->checks) {
        if (check.value.size() < 2) continue;
        const std::pair entry(check.name, check.label);
        addOnce(checks, entry);
      }
  for (const auto& [name, label] : checks) {
    Panel panel;
    panel.xLabel = "(r − R_{i}) / d";
    panel.yLabel = "found / expected";
    panel.xRange = rTildeRange(frame);
    panel.level = 1.0;
    for (const EngineRuns& engine : engines) {
      if (engine.finished.empty()) continue;
      const CheckRow* const check = findBy(engine.finished.front()->checks, name, &CheckRow::name);
      if (!check) continue;
      Curve curve{engine.name, engine.style, Draw::linesAndPoints,
                  balancePoints(frame.rings, *check), 1.5};
      if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
    }
    if (!hasPoints(panel)) continue;
    figures.push_back({fmt::format("check_{}", figures.size() + 1),
                       label,
                       label + ". Bars: ± one standard error within the run.",
                       {panel}});
  }
  return figures;
}

constexpr const char* speedAxis = "v_{φ} / (Ω R_{i})";
constexpr const char* spinAxis = "S d / (Ω D)";

/// That of an engine's averages, or null. @param ring  from 0; absent: the whole cell's
const Distribution* distributionOf(const EngineRuns& engine, const std::string& quantity,
                                   std::optional<int> ring) {
  return findIf(engine.distributions(), [&](const Distribution& one) {
    return one.quantity == quantity && one.ring == ring;
  });
}

double centre(const Bins& axis, std::size_t index) {
  return axis.low + (static_cast<double>(index) + 0.5) * axis.width;
}

/// @param empty  also bins that hold nothing, which a logarithmic axis cannot show
std::vector<Point> pointsOf(const Distribution* distribution, bool empty) {
  std::vector<Point> points;
  if (!distribution || distribution->axes.empty()) return points;
  for (std::size_t k = 0; k < distribution->density.size(); ++k)
    if (const auto value = at(distribution->density, k); value && (empty || *value > 0.0))
      points.push_back(
          {centre(distribution->axes[0], k), *value, at(distribution->standardError, k)});
  return points;
}

Panel densityPanel(const Engines& engines, const std::string& quantity, std::optional<int> ring,
                   const std::string& xLabel, bool logarithmic) {
  Panel panel;
  panel.xLabel = xLabel;
  panel.yLabel = "probability density";
  panel.logY = logarithmic;
  panel.key = Key::none;
  for (const EngineRuns& engine : engines) {
    Curve curve =
        curveOf(engine, pointsOf(distributionOf(engine, quantity, ring), !logarithmic), 1.0);
    if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
  }
  return panel;
}

Figure figureOf(const std::string& name, const std::string& title, const std::string& caption,
                std::vector<Panel> panels) {
  Figure figure;
  figure.name = "distribution_" + name;
  figure.title = title;
  figure.caption = caption;
  for (Panel& panel : panels) {
    if (!hasPoints(panel)) continue;
    figure.panels.push_back(std::move(panel));
  }
  figure.columns = std::min(3, static_cast<int>(figure.panels.size()));
  figure.panelWidth = 380;
  figure.panelHeight = 300;
  return figure;
}

/// Centres of the densest cells that together hold this fraction of what lies inside the bins.
std::vector<Point> densest(const Distribution& joint, double fraction) {
  const Bins &across = joint.axes.at(0), &up = joint.axes.at(1);
  const auto columns = static_cast<std::size_t>(across.count);
  std::vector<std::size_t> order(joint.density.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto densityAt = [&](std::size_t cell) { return at(joint.density, cell).value_or(0.0); };
  std::ranges::stable_sort(order, std::greater(), densityAt);
  double all = 0.0;
  for (const std::size_t cell : order) all += densityAt(cell);
  std::vector<Point> points;
  double held = 0.0;
  for (const std::size_t cell : order) {
    if (held >= fraction * all) break;
    held += densityAt(cell);
    points.push_back({centre(across, cell % columns), centre(up, cell / columns), {}});
  }
  return points;
}

Panel jointPanel(const EngineRuns& engine) {
  const Distribution* joint = distributionOf(engine, "azimuthal_velocity_and_spin", {});
  Panel panel;
  panel.name = engine.name;
  panel.xLabel = speedAxis;
  panel.yLabel = spinAxis;
  panel.xRange = Range{-0.3, 1.3};
  panel.yRange = Range{-1.3, 0.7};
  panel.key = Key::none;
  if (!joint) return panel;
  LineStyle outer = engine.style, inner = engine.style;
  outer.pointType = 6;  // open circles
  inner.pointType = 7;  // filled
  panel.curves.push_back({"", outer, Draw::points, densest(*joint, 0.9), 1.0});
  panel.curves.push_back({"", inner, Draw::points, densest(*joint, 0.5), 1.0});
  panel.curves.push_back({"", {}, Draw::lines, {{0.0, -1.0, {}}, {1.3, 0.3, {}}}, 1.0});
  return panel;
}

/// Rings at the wheel, about 2, 4, 8 and 12 d from it, and at the outer ring (Lätzel 2003,
/// Fig. 6.6).
std::vector<std::size_t> directionRings(const std::vector<double>& places) {
  std::vector<std::size_t> rings;
  if (places.empty()) return rings;
  const auto add = [&](std::size_t ring) {
    if (rings.empty() || ring > rings.back()) rings.push_back(ring);
  };
  add(0);
  for (const double target : {2.0, 4.0, 8.0, 12.0}) {
    std::size_t best = 0;
    const auto away = [&](std::size_t ring) {
      return std::abs(at(places, ring).value_or(1e300) - target);
    };
    for (std::size_t ring = 0; ring < places.size(); ++ring)
      if (away(ring) < away(best)) best = ring;
    if (away(best) < 1.0) add(best);
  }
  add(places.size() - 1);
  return rings;
}

/// The distribution's expansion to order 6, from the Fourier fields of the same averages.
std::vector<Point> harmonics(const EngineRuns& engine, std::size_t ring) {
  const auto coefficient = [&](const char* kind, int order) -> std::optional<double> {
    const std::string field = fmt::format("contact_{}_{}", kind, order);
    const Profile* profile = profileOf(engine.profiles(), field);
    return profile ? at(profile->mean, ring) : std::nullopt;
  };
  std::vector<std::array<double, 3>> terms;  // order, a, b
  for (const int order : {2, 4, 6}) {
    const auto a = coefficient("cos", order), b = coefficient("sin", order);
    if (!a || !b) return {};
    terms.push_back({static_cast<double>(order), *a, *b});
  }
  std::vector<Point> points;
  for (int degrees = -180; degrees <= 180; degrees += 4) {
    const double angle = degrees * std::numbers::pi / 180.0;
    double density = 1.0;
    for (const auto& [order, a, b] : terms)
      density += a * std::cos(order * angle) + b * std::sin(order * angle);
    points.push_back({angle, density / (2.0 * std::numbers::pi), {}});
  }
  return points;
}

std::vector<Panel> directionPanels(const RingPlaces& rings, const Engines& engines) {
  std::vector<Panel> panels;
  for (const std::size_t ring : directionRings(rings.rTilde)) {
    Panel panel = densityPanel(engines, "contact_direction", static_cast<int>(ring),
                               "angle of contacts from r towards φ [rad]", false);
    panel.title = fmt::format("(r − R_{{i}})/d = {:.2g}", at(rings.rTilde, ring).value_or(0.0));
    panel.xRange = Range{-std::numbers::pi, std::numbers::pi};
    panel.level = 0.5 / std::numbers::pi;
    if (!panel.curves.empty()) {
      const auto reference = std::ranges::find_if(engines, [&](const EngineRuns& engine) {
        return curveOf(engine).name == panel.curves.front().name;
      });
      panel.curves.push_back({"", {}, Draw::lines, harmonics(*reference, ring), 1.0});
    }
    panels.push_back(std::move(panel));
  }
  return panels;
}

/// "Flowing, I = 0.0041, k_n/p = 4200, largest overlap 0.003 d.": what is known of the state.
std::string stateWords(const EngineRuns& engine) {
  Names words;
  if (const auto* const run = findIf(
          engine.finished, [](const FlowRun* one) { return one->regime && one->regime->regime; }))
    words.emplace_back(toString(*(*run)->regime->regime));
  if (engine.isSingle) words.emplace_back("one run");
  for (const auto& [name, form] :
       {std::pair("inertial_number", "I = {}"), std::pair("kn_over_p", "k_n/p = {}"),
        std::pair("max_overlap_over_d", "largest overlap {} d")})
    if (const auto* const number = findBy(engine.head(), std::string(name), &HeadNumber::name);
        number && finite(number->value))
      words.push_back(fmt::format(fmt::runtime(form), readable(number->value)));
  return words.empty() ? ""
                       : fmt::format("{}.", capitalised(fmt::format("{}", fmt::join(words, ", "))));
}

/// Letters, digits and dashes only: names of engines become names of files.
std::string fileWord(const std::string& name) {
  std::string word = name;
  for (char& c : word)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-') c = '_';
  return word;
}

/// "Mean 0.0123 N; 4 of 412 contacts carry 0.05 N or more, the widest line."
std::string forceWords(const ForceCount& count, double widest) {
  return fmt::format("Mean {} N; {} of {} {} {} N or more, the widest line.", readable(count.mean),
                     count.above, counted(count.contacts, "contact"),
                     verb(count.above, "carries", "carry"), readable(widest));
}

std::vector<Figure> distributionFigures(const FlowFrame& frame, const Engines& engines) {
  std::vector<Panel> joint;
  for (const EngineRuns& engine : engines)
    if (engine.isResult()) joint.push_back(jointPanel(engine));
  std::vector<Figure> figures = {
      figureOf("velocities", "Distributions of velocities and spin at the wheel",
               "Radial and azimuthal velocity and spin of single disks in ring 1, next to the "
               "wheel (Lätzel 2003, section 6.4).",
               {densityPanel(engines, "radial_velocity", 0, "v_{r} / |Ω R_{i}|", true),
                densityPanel(engines, "azimuthal_velocity", 0, speedAxis, true),
                densityPanel(engines, "spin", 0, spinAxis, true)}),
      figureOf("joint", "Joint distribution of velocity and spin at the wheel",
               "Velocity and spin of the same disk, centres within one d of the wheel: the densest "
               "cells that hold half of the samples (filled) and nine tenths (open). On the line "
               "v_φ/(ΩR_i) = 1 + S d/(ΩD) a disk rolls on the wheel.",
               std::move(joint)),
      figureOf("directions", "Directions of contacts",
               "Outward normals of the contacts of disks in some rings, from the wheel to the "
               "outer ring (Lätzel 2003, Fig. 6.6). Thin line: no preferred direction; black "
               "curve: a constant and sines of 2α, 4α, 6α fitted to the first engine's.",
               directionPanels(frame.rings, engines)),
      figureOf("contacts", "Distributions of contact forces and numbers",
               "Normal and tangential forces of all contacts over their means, and contacts per "
               "particle.",
               {densityPanel(engines, "normal_force", {}, "f_{n} / ⟨f_{n}⟩", true),
                densityPanel(engines, "tangential_force", {}, "|f_{t}| / ⟨|f_{t}|⟩", true),
                densityPanel(engines, "coordination", {}, "contacts per particle", false)})};
  std::erase_if(figures, [](const Figure& figure) { return figure.panels.empty(); });
  return figures;
}

}  // namespace

const ScenePicture* firstPicture(const EngineRuns& engine) {
  for (const FlowRun* run : engine.runs)
    if (run->picture) return &*run->picture;
  return nullptr;
}

double fastestOf(const Engines& engines) {
  double fastest = 0.0;
  for (const EngineRuns& engine : engines)
    if (const ScenePicture* picture = firstPicture(engine))
      fastest = std::max(fastest, fastestOf(*picture));
  return fastest;
}

std::vector<Figure> compareFigures(const CompareResults& results) {
  const Engines engines = engineRuns(results);
  std::vector<Figure> figures = profileFigures(results, engines);
  for (auto more : {differenceFigures(results, engines), checkFigures(results, engines),
                    seriesFigures(results, engines),
                    distributionFigures(
                        results, only(engines, std::not_fn(std::mem_fn(&EngineRuns::isSingle)))),
                    profileCausesFigures(results)})
    std::ranges::move(more, std::back_inserter(figures));
  return figures;
}

/// How the reference's first packing moves, where results have that.
std::optional<Picture> stripOf(const Engines& engines, double fastest) {
  for (const EngineRuns& engine : engines)
    for (const FlowRun* run : engine.runs) {
      if (run->strip.size() < 2) continue;
      Names times;
      for (const ScenePicture& picture : run->strip) times.push_back(readable(picture.time));
      return Picture{"strip_1_" + fileWord(engine.name),
                     engine.name,
                     engine.name + ": as it moves",
                     fmt::format("From left to right at t = {} s.", listed(times)),
                     Picture::Shows::strip,
                     stripDrawing(run->strip, fastest)};
    }
  return std::nullopt;
}

std::vector<Picture> comparePictures(const CompareResults& results) {
  std::vector<Picture> scenes, origins, forces;
  const Engines engines = engineRuns(results);
  const double fastest = fastestOf(engines);
  std::optional<double> widest;  // of the first that has forces, for all
  for (const EngineRuns& engine : engines) {
    const ScenePicture* picture = firstPicture(engine);
    if (!picture || picture->x.empty()) continue;
    const std::string word = fmt::format("{}_{}", scenes.size() + 1, fileWord(engine.name));
    scenes.push_back({"scene_" + word, engine.name,
                      engine.name + (picture->depth ? ": particles behind a cut" : ": particles"),
                      stateWords(engine), Picture::Shows::scene, sceneDrawing(*picture, fastest)});
    if (!results.region)
      origins.push_back(
          {"origins_" + word, engine.name, engine.name + ": disks coloured by where they started",
           "", Picture::Shows::origins,
           originsDrawing(*picture, results.cell.innerRadius, results.cell.diameter)});
    const auto own = widestForce(*picture);
    if (!own) continue;
    if (!widest) widest = own;
    forces.push_back({"forces_" + word, engine.name, engine.name + ": forces between particles",
                      forceWords(countForces(*picture, *widest), *widest), Picture::Shows::forces,
                      forcesDrawing(*picture, *widest, 0.75)});
  }
  for (auto* more : {&origins, &forces}) std::ranges::move(*more, std::back_inserter(scenes));
  Window all;
  const auto isAlike = [&](const Picture& picture) {
    return picture.drawing.window.larger() <= 2.0 * scenes.front().drawing.window.larger();
  };
  std::vector<Picture*> alike;
  for (Picture& picture : scenes)
    if (isAlike(picture)) alike.push_back(&picture);
  for (const Picture* picture : alike) all.add(picture->drawing.window);
  for (Picture* picture : alike) picture->drawing.window = all;
  if (auto strip = stripOf(engines, fastest)) scenes.push_back(std::move(*strip));
  return scenes;
}

}  // namespace crossgrain::reports
