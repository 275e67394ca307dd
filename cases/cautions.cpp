#include "cases/cautions.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

#include "cases/couette.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"

namespace crossgrain::inline cases {

namespace {

using Lines = std::vector<std::string>;

void cautionsOfStep(const Case& setup, Lines& lines) {
  const double dt = timeStep(setup);
  const char* const key = setup.run.dt ? "run.dt" : "run.steps_per_contact";
  if (const std::string why = unstableStepFault(setup, dt, key); !why.empty())
    return lines.push_back(why);
  if (const std::string why = riskyStepFault(setup, dt); !why.empty()) return lines.push_back(why);
  constexpr double fewSteps = 20.0;  // t_c/50 is usual
  const auto time = pairContactTime(setup);
  if (time && *time / dt < fewSteps)
    lines.push_back(
        fmt::format("only {:.3g} steps in the shortest contact; 50 are usual", *time / dt));
}

void cautionsOfFilling(const Case& setup, double volumeFraction, Lines& lines) {
  const double bulk = bulkVolumeFraction(setup, volumeFraction);
  if (bulk < dilutedBelow)
    lines.push_back(fmt::format(
        "dilute: between the walls' layers the volume fraction is about {:.3f}, and below {} disks "
        "lose contact: expect a gas, whose stresses scale with Ω² (inertial number above 0.1)",
        bulk, dilutedBelow));
  if (bulk > squeezedAbove)
    lines.push_back(fmt::format(
        "over-dense: between the walls' layers the volume fraction is about {:.3f}, and above {} "
        "disks are squeezed or blocked: stresses scale with k_n, and rigid disks cannot follow",
        bulk, squeezedAbove));
  constexpr double rateIndependent = 0.1;
  const auto inertial = expectedInertialNumber(setup, bulk);
  if (inertial && *inertial > rateIndependent)
    lines.push_back(
        fmt::format("the inertial number at the wheel may be about {:.2g}: above {} stresses "
                    "depend on the rate",
                    *inertial, rateIndependent));
}

void cautionsOfVerdicts(const Case& setup, Lines& lines) {
  constexpr int fewest = 4;
  const int packings = flowPackings(setup);
  if (setup.averaging.endpoints.empty())
    lines.push_back(fmt::format("no {}: compare will judge nothing",
                                cellOf(setup) ? "[averaging.endpoints]" : "[[endpoints]]"));
  if (packings < fewest && !hasClosedForms(setup))
    lines.push_back(fmt::format("{} packing{}{}: compare judges nothing with fewer than {}",
                                packings, packings == 1 ? "" : "s",
                                packingsAreFiles(setup) ? " (a file is one)" : "", fewest));
}

/// Grains are not as large as people; numbers in mm are. A diameter of just 1 is a scene's unit.
void cautionsOfLengths(const Case& setup, Lines& lines) {
  constexpr double large = 1.0, tiny = 1e-9;  // of a disk's diameter [m]
  if (packingFile(setup)) return;             // its radii are in a file that is not read yet
  const double d = flowDiameter(setup);
  const char* const what = anyConvex(setup) ? "bodies" : "disks";
  if (d > large)
    lines.push_back(fmt::format("the smallest {} are {:g} m across: are lengths in mm?", what, d));
  if (d < tiny)
    lines.push_back(fmt::format("the smallest {} are {:g} m across, as molecules are", what, d));
}

/// Contacts of engines begin and end within a skin of about a thousandth of a body.
template <int D>
void cautionOfShape(const ShapeOf<D>& shape, const std::string& where, Lines& lines) {
  constexpr double thin = 1e-3;
  const Eigen::Matrix<double, D, 1> spread =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, D, D>>(massOf(shape).second)
          .eigenvalues();
  const double ratio = std::sqrt(std::max(spread[0], 0.0) / spread[D - 1]);
  if (ratio < thin)
    lines.push_back(
        fmt::format("{} is {} times as thin as long: engines resolve a body to about {} of it",
                    where, ratio > 0.0 ? fmt::format("{:.2g}", 1.0 / ratio) : "1e16", thin));
}

template <int D>
void cautionsOfShapes(const AssemblyOf<D>& assembly, Lines& lines) {
  for (std::size_t k = 0; k < assembly.disks.size(); ++k)
    if (const auto& shape = assembly.disks[k].shape)
      cautionOfShape(*shape, fmt::format("assembly.disks[{}].shape", k), lines);
  for (std::size_t k = 0; k < assembly.starts.shapes.size(); ++k)
    cautionOfShape(assembly.starts.shapes[k], fmt::format("shape {} of assembly.start", k), lines);
}

template <int D>
void cautionsOfShapes(const ConvexPairOf<D>& pair, Lines& lines) {
  for (const auto& body : pair.body)
    if (body.shape)
      cautionOfShape(*body.shape, &body == pair.body ? "collision.shape" : "collision.second_shape",
                     lines);
}

void cautionsOfShapes(const Case& setup, Lines& lines) {
  const auto of = [&](const auto* bodies) {
    if (bodies) cautionsOfShapes(*bodies, lines);
  };
  of(std::get_if<AssemblyOf<2>>(&setup.source));
  of(std::get_if<AssemblyOf<3>>(&setup.source));
  if (!isCollision(setup)) return;
  of(std::get_if<ConvexPairOf<2>>(&collisionIn(setup).convex));
  of(std::get_if<ConvexPairOf<3>>(&collisionIn(setup).convex));
}

/// Impulses need no resolved contact, but disks must not jump.
void cautionsOfEngineSteps(const Case& setup, Lines& lines) {
  constexpr double far = 0.1;  // of d
  const double speed = couetteIn(setup).cell.rimSpeed();
  for (const auto& [engine, settings] : setup.engines) {
    const auto step = settings.find("dt");
    if (step == settings.end() || !std::holds_alternative<double>(step->second)) continue;
    const double fraction =
        std::get<double>(step->second) * speed / couetteIn(setup).particles.smallRadius / 2.0;
    if (fraction > far)
      lines.push_back(
          fmt::format("[engines.{}] dt = {:g} s: the wheel's rim moves {:.2g} d in a step of it",
                      engine, std::get<double>(step->second), fraction));
  }
}

}  // namespace

Lines cautions(const Case& setup, double volumeFraction) {
  Lines lines = setup.warnings;
  cautionsOfShapes(setup, lines);
  if (isCollision(setup)) {
    if (collisionIn(setup).margins.empty())
      lines.emplace_back("no [collision.margins]: collide will judge nothing");
    return lines;
  }
  cautionsOfStep(setup, lines);
  cautionsOfLengths(setup, lines);
  if (cellOf(setup)) cautionsOfFilling(setup, volumeFraction, lines);
  if (setup.region) cautionsOfVerdicts(setup, lines);
  if (cellOf(setup)) cautionsOfEngineSteps(setup, lines);
  return lines;
}

namespace {

/// How far wall disks at that spacing keep a small disk's surface off the circle of their centres,
/// averaged along the wall [m].
double wallDepth(const Case& setup) {
  const Cell& cell = couetteIn(setup).cell;
  const double small = couetteIn(setup).particles.smallRadius;
  const double reach = cell.wallRadius + small;
  const double half = std::min(0.5 * cell.wallSpacing, reach);
  // mean of √(reach² − x²) over |x| <= half
  const double area = 0.5 * (half * std::sqrt(reach * reach - half * half) +
                             reach * reach * std::asin(half / reach));
  return area / half - small;
}

/// Sites of a square lattice between two circles.
std::vector<Vec2> squareSites(double constant, double inner, double outer) {
  std::vector<Vec2> sites;
  const auto half = static_cast<int>(outer / constant) + 1;
  for (int row = -half; row <= half; ++row)
    for (int column = -half; column <= half; ++column) {
      const Vec2 site(column * constant, row * constant);
      if (site.norm() >= inner && site.norm() <= outer) sites.push_back(site);
    }
  return sites;
}

}  // namespace

double bulkVolumeFraction(const Case& setup, double volumeFraction) {
  constexpr double layering = 0.17;  // of d, fitted to both cells
  const Cell& cell = couetteIn(setup).cell;
  const double width = cell.outerRadius - cell.innerRadius;
  const double lost = wallDepth(setup) + layering * flowDiameter(setup);
  return volumeFraction * width / (width - 2.0 * lost);
}

std::optional<double> expectedPressure(const Case& setup, double bulk) {
  if (setup.law.normal != NormalLaw::linear || bulk <= dilutedBelow) return std::nullopt;
  const double fabric = 4.0 * bulk;
  return setup.law.kn * fabric / (2.0 * std::numbers::pi * couetteIn(setup).cell.height) *
         (bulk / dilutedBelow - 1.0);
}

std::optional<double> expectedInertialNumber(const Case& setup, double bulk) {
  const auto pressure = expectedPressure(setup, bulk);
  if (!pressure) return std::nullopt;
  const double density = std::ranges::find(scales(), "disk_density", &Scale::name)->of(setup);
  const double speed = couetteIn(setup).cell.rimSpeed();
  return 0.5 * speed * std::sqrt(density / *pressure);
}

Packing madeUpPacking(const Case& setup) {
  Packing packing;
  packing.disks = diskKinds(couetteIn(setup).particles);
  Disks& disks = packing.disks;
  const Cell& cell = couetteIn(setup).cell;
  double narrow = 0.0, wide = cell.outerRadius - cell.innerRadius;
  std::vector<Vec2> sites;
  for (int halving = 0; halving < 40; ++halving) {
    const double constant = 0.5 * (narrow + wide);
    const double clearance = cell.wallRadius + 0.5 * constant;
    const double inner = cell.innerRadius + clearance, outer = cell.outerRadius - clearance;
    const bool tooMany =
        4.0 * outer * outer > 100.0 * constant * constant * static_cast<double>(disks.size() + 100);
    auto found = tooMany ? std::vector<Vec2>() : squareSites(constant, inner, outer);
    const bool enough = tooMany || found.size() >= disks.size();
    (enough ? narrow : wide) = constant;
    if (enough && !tooMany) sites = std::move(found);
  }
  const double radius = 0.5 * narrow * (1.0 + 1e-6);
  sites.resize(disks.size(), Vec2(cell.innerRadius, cell.outerRadius));
  disks.position = sites;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    disks.radius[i] = radius;
    disks.inertia[i] = couetteIn(setup).particles.inertiaFactor * disks.mass[i] * radius * radius;
  }
  return packing;
}

}  // namespace crossgrain::inline cases
