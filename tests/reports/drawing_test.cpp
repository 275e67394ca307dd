#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "reports/common/engines.hpp"
#include "reports/common/pictures.hpp"
#include "reports/flow/report.hpp"
#include "reports/render/gnuplot.hpp"
#include "support/files.hpp"
#include "tests/reports/sample_results.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace crossgrain::reports {
namespace {

const Figure& figureNamed(const std::vector<Figure>& figures, const std::string& name) {
  for (const Figure& figure : figures)
    if (figure.name == name) return figure;
  throw std::runtime_error("no figure " + name);
}

EngineRow named(const char* name, const char* mirrors = "") {
  return {name, "", "", mirrors, Status::finished, ""};
}

TEST(EngineStyles, OneEngine_IsTheSameInEveryReport) {
  const auto two = engineStyles({named("grain"), named("box2d-penalty")});
  const auto three = engineStyles({named("my-own"), named("yade"), named("box2d-penalty")});
  EXPECT_EQ(two[1], three[2]);
  EXPECT_EQ(engineStyles({named("my-own")})[0], three[0]);
}

TEST(EngineStyles, Mirror_HasItsPeersColourDashed) {
  const LineStyle peer = engineStyles({named("yade")})[0];
  for (const LineStyle& mirror : {engineStyles({named("grain-as-yade")})[0],
                                  engineStyles({named("grain"), named("x", "yade")})[1]}) {
    EXPECT_EQ(mirror.colour, peer.colour);
    EXPECT_TRUE(mirror.dashed);
    EXPECT_NE(mirror.pointType, peer.pointType);
  }
}

TEST(EngineStyles, TwentyEngines_NoTwoLookAlike) {
  std::vector<EngineRow> engines;
  for (int k = 0; k < 20; ++k) engines.push_back(named(fmt::format("engine-{}", k).c_str()));
  const auto styles = engineStyles(engines);
  for (std::size_t a = 0; a < styles.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(styles[a] == styles[b]) << a << " " << b;
}

TEST(Profiles, RingsWithoutAWheel_AreOverTheRadius) {
  const CompareResults results = fromJson<CompareResults>(nlohmann::json::parse(R"({
    "engines": [{"name": "e", "mirrors": "", "status": "ran"}],
    "region": {"bins": "rings", "height": 1.0, "diameter": 0.01, "disks": 9, "x": [], "y": [],
               "from_s": 0, "to_s": 1},
    "rings": {"r": [0.105, 0.2], "r_tilde": []},
    "runs": [{"engine": "e", "packing": 0, "status": "finished", "profiles": [
      {"field": "stress_rp", "mean": [0.05, 0.02], "stderr": [0.001, null]}]}]})"));
  const Panel panel = figureNamed(compareFigures(results), "profile_stress_rp").panels[0];
  EXPECT_DOUBLE_EQ(panel.curves[0].points[0].x, 0.105);
  EXPECT_EQ(panel.xLabel, "r [m]");
}

/// v_φ/(ΩR_i) and S d/(ΩD), D = 2R_i: Lätzel (2003), chapter 6. With Ω = 1 /s, R_i = 0.1 m,
/// d = 0.01 m these are 10 v_φ and S/20.
TEST(Profiles, CellWithAWheel_AreDimensionlessAsInTheThesis) {
  const CompareResults results = fromJson<CompareResults>(nlohmann::json::parse(R"({
    "engines": [{"name": "e", "mirrors": "", "status": "ran"}],
    "cell": {"inner_radius": 0.1, "outer_radius": 0.2, "diameter": 0.01, "omega": 1.0},
    "rings": {"r": [0.105, 0.2], "r_tilde": [0.5, 10]},
    "runs": [{"engine": "e", "packing": 0, "status": "finished", "profiles": [
      {"field": "azimuthal_velocity", "mean": [0.05, -1e-9], "stderr": [0.001, null]},
      {"field": "spin", "mean": [-2, null], "stderr": [0.2, null]}]}]})"));
  const auto figures = compareFigures(results);
  const auto& velocity = figureNamed(figures, "profile_azimuthal_velocity").panels[0].curves[0];
  ASSERT_EQ(velocity.points.size(), 2u);
  EXPECT_DOUBLE_EQ(velocity.points[0].x, 0.5);
  EXPECT_DOUBLE_EQ(velocity.points[0].y, 0.5);
  EXPECT_DOUBLE_EQ(velocity.points[0].error.value(), 0.01);
  EXPECT_FALSE(velocity.points[1].error.has_value());
  const auto& spin = figureNamed(figures, "profile_spin").panels[0].curves[0];
  ASSERT_EQ(spin.points.size(), 1u);
  EXPECT_DOUBLE_EQ(spin.points[0].y, -0.1);
  EXPECT_DOUBLE_EQ(spin.points[0].error.value(), 0.01);
}

TEST(Figures, WideSpreadOfPositiveValues_TakesALogAxis) {
  Panel panel;
  panel.curves = {{"a", {}, Draw::lines, {{0, 4, {}}, {1, 5, {}}}, 1.0},
                  {"b", {}, Draw::lines, {{0, 39, {}}}, 1.0}};
  chooseLogY(panel);
  EXPECT_FALSE(panel.logY);
  panel.curves[1].points[0].y = 40;
  chooseLogY(panel);
  EXPECT_TRUE(panel.logY);
  panel.curves[0].points[0].y = -1;
  chooseLogY(panel);
  EXPECT_FALSE(panel.logY);
}

TEST(Scripts, LogAxis_DropsWhatIsNotPositiveAndClipsBars) {
  const TemporaryFolder folder;
  Figure figure;
  figure.name = "log";
  Panel panel;
  panel.logY = true;
  panel.curves.push_back(
      {"c", {}, Draw::linesAndPoints, {{1, 100, 200}, {2, -3, 1}, {3, 1, {}}}, 1.0});
  figure.panels.push_back(panel);
  EXPECT_EQ(writeFigure(figure, folder.path()), "log.gp");
  // The axis goes down to 1: 100 ± 200 is drawn from there.
  EXPECT_EQ(readFile(folder.path() / "log.dat").value(), "# x y low high\n1 100 1 300\n3 1 ? ?\n");
}

TEST(Scripts, NameOfACurve_RunsNothing) {
  const TemporaryFolder folder;
  Figure figure;
  figure.name = "odd";
  Panel panel;
  panel.curves.push_back({sample::awkward, {}, Draw::points, {{1, 1, {}}, {2, 2, {}}}, 1.0});
  figure.panels.push_back(panel);
  runGnuplot({writeFigure(figure, folder.path())}, folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "pwned"));
  const std::string svg = readFile(folder.path() / "odd.svg").value();
  EXPECT_NE(svg.find("`touch pwned` {x 'y' _z"), std::string::npos);
}

TEST(Gnuplot, Failure_IsOneLineWithItsLastWord) {
  const TemporaryFolder folder;
  writeFile(folder.path() / "bad.gp", "plot 'there_is_no_such_file.dat'\n");
  const std::string message =
      test::refusalOf<GnuplotError>([&] { runGnuplot({"bad.gp"}, folder.path()); });
  EXPECT_EQ(message.find('\n'), std::string::npos);
  EXPECT_TRUE(message.starts_with("gnuplot failed in " + folder.path().string())) << message;
  test::expectSays(message, {"\"bad.gp\" line 1: No data in plot"});
}

/// A window of ±1 on 100 px: (0.5, 0.5) lies at x = 75, and 25 from the top.
TEST(Strokes, Svg_PutsYUpward) {
  const Drawing drawing{{-1, 1, -1, 1}, {{"#ff0000", 0.2, {{0.5, 0.5, 0.5, 0.5}, {-1, -1, 1, 1}}}}};
  const std::string svg = toSvg(drawing, 100, "a < b");
  test::expectSays(svg,
                   {"<path stroke=\"#ff0000\" stroke-width=\"10\" d=\"M75 25h0M0 100L100 0\"/>",
                    "<title>a &lt; b</title>"});
}

/// The same window on 75 points (100 px at 96 per inch), y upward as PDF has it.
TEST(Strokes, Pdf_HasTheSameStrokesAndAValidTable) {
  const Drawing drawing{{-1, 1, -1, 1}, {{"#ff0000", 0.2, {{0.5, 0.5, 0.5, 0.5}}}}};
  const std::string pdf = toPdf(drawing, 100);
  test::expectSays(pdf, {"1.000 0.000 0.000 RG 7.5 w\n56.25 56.25 m 56.25 56.25 l\nS\n"});
  const std::size_t table = pdf.find("xref\n0 5\n");
  ASSERT_NE(table, std::string::npos);
  EXPECT_NE(pdf.find("startxref\n" + std::to_string(table) + "\n%%EOF"), std::string::npos);
  for (int object = 1; object <= 4; ++object) {
    const std::string line = pdf.substr(table + 9 + 20 * static_cast<std::size_t>(object), 20);
    const auto offset = static_cast<std::size_t>(std::strtoul(line.c_str(), nullptr, 10));
    EXPECT_TRUE(pdf.substr(offset).starts_with(std::to_string(object) + " 0 obj\n")) << line;
  }
}

TEST(Pictures, Forces_AreDrawnOnTheFirstEnginesScale) {
  CompareResults results = sample::compareResults(1, 200);
  const auto widest = widestForce(results.runs[0].picture.value());
  ASSERT_TRUE(widest.has_value());
  const auto pictures = comparePictures(results);
  ASSERT_EQ(pictures.size(), 12u);  // scene, origins and forces of four engines that ran
  EXPECT_EQ(pictures[0].name, "scene_1_grain");
  EXPECT_EQ(pictures[4].name, "origins_1_grain");
  EXPECT_EQ(pictures[11].name, "forces_4_grain_yade");
  for (const Picture& picture : pictures) {
    EXPECT_EQ(picture.drawing.window.left, pictures[0].drawing.window.left);
    EXPECT_EQ(picture.drawing.window.top, pictures[0].drawing.window.top);
  }
  const auto linesOf = [&](std::size_t place) {
    return toSvg(comparePictures(results)[place].drawing, 100, "");
  };
  // Twice the forces of all engines: the same lines.
  for (FlowRun& run : results.runs)
    for (double& force : run.picture->contactForce.value()) force *= 2.0;
  EXPECT_EQ(linesOf(8), toSvg(pictures[8].drawing, 100, ""));
  EXPECT_EQ(linesOf(9), toSvg(pictures[9].drawing, 100, ""));
  // Twice those of the second alone: its lines are wider, the first's are as they were.
  for (double& force : results.runs[1].picture->contactForce.value()) force *= 2.0;
  EXPECT_EQ(results.runs[1].engine, "yade");
  EXPECT_EQ(linesOf(8), toSvg(pictures[8].drawing, 100, ""));
  EXPECT_NE(linesOf(9), toSvg(pictures[9].drawing, 100, ""));
}

/// A scene beside the origin fills its frame; one of it in space is of balls, the nearest last.
TEST(Pictures, Scene_FillsItsFrameAndBallsCoverThoseBehind) {
  ScenePicture picture;
  picture.radius = {1.0, 1.0};
  picture.x = {10.0, 13.0};
  picture.y = {-20.0, -20.0};
  picture.speed = {0.0, 2.0};
  const Drawing flat = sceneDrawing(picture, fastestOf(picture));
  EXPECT_NEAR(flat.window.left, 8.9, 0.1);
  EXPECT_NEAR(flat.window.width() / flat.window.height(), 2.5, 0.1);
  EXPECT_EQ(flat.groups.size(), 2u);  // slow and fast differ
  picture.depth = {0.5, 3.0};
  picture.cut = 0.1;
  const Drawing deep = sceneDrawing(picture, 2.0);
  ASSERT_EQ(deep.balls.size(), 2u);
  EXPECT_EQ(deep.balls[0].x, 13.0);
  EXPECT_NE(toSvg(deep, 100, "").find("<radialGradient"), std::string::npos);
}

/// 0.01 · 2 m in 10 s: what is slower has not moved, and its speed has no colours of its own.
TEST(Pictures, BodiesAtRest_AreDark) {
  ScenePicture picture;
  picture.radius = {1.0, 1.0};
  picture.x = {0.0, 5.0};
  picture.y = {0.0, 0.0};
  picture.speed = {0.0, 1.9e-3};
  picture.time = 10.0;
  EXPECT_DOUBLE_EQ(restingSpeed(picture), 2e-3);
  EXPECT_DOUBLE_EQ(fastestOf(picture), 2e-3);
  const auto isBright = [&] {
    return toSvg(sceneDrawing(picture, fastestOf(picture)), 100, "").find("#fde725") !=
           std::string::npos;
  };
  EXPECT_FALSE(isBright());
  picture.speed = {0.0, 1.0};
  EXPECT_DOUBLE_EQ(fastestOf(picture), 1.0);
  EXPECT_TRUE(isBright());
  picture.speed.reset();
  EXPECT_EQ(fastestOf(picture), 0.0) << "of no known speed";
}

TEST(Pictures, Forces_AreCounted) {
  ScenePicture picture;
  EXPECT_EQ(countForces(picture, 1.0).contacts, 0u);
  picture.contactForce = {0.5, 1.0, 1.5, NAN};
  const ForceCount count = countForces(picture, 1.0);
  EXPECT_EQ(count.contacts, 3u);
  EXPECT_EQ(count.above, 2u);
  EXPECT_DOUBLE_EQ(count.mean, 1.0);
}

}  // namespace
}  // namespace crossgrain::reports
