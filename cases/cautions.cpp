#include "cases/cautions.hpp"

#include <fmt/format.h>

#include <cmath>
#include <variant>

#include "cases/cell_estimates.hpp"
#include "cases/flow.hpp"
#include "cases/stable_step.hpp"
#include "cases/time_step.hpp"

namespace crossgrain::inline cases {

namespace {

using Lines = std::vector<std::string>;

void cautionsOfStep(const Case& setup, Lines& lines) {
  const double dt = timeStep(setup);
  const char* const key = setup.run.dt ? "run.dt" : "run.steps_per_contact";
  if (const std::string why = whyUnstableStep(setup, dt, key); !why.empty())
    return lines.push_back(why);
  const auto limit = pairStepLimit(setup);
  if (!limit) return;
  // Six contacts, as in a triangular lattice, are the most that disks of one size have.
  if (dt >= limit->dt / std::sqrt(6.0))
    return lines.push_back(fmt::format(
        "the time step of {:.3g} s is beyond what a disk with six contacts bears, 1/√6 of what one "
        "does = {:.3g} s",
        dt, limit->dt / std::sqrt(6.0)));
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
                                setup.average ? "[[endpoints]]" : "[averaging.endpoints]"));
  if (packings < fewest)
    lines.push_back(fmt::format("{} packing{}{}: compare judges nothing with fewer than {}",
                                packings, packings == 1 ? "" : "s",
                                packingsAreFiles(setup) ? " (a file is one)" : "", fewest));
}

/// Impulses need no resolved contact, but disks must not jump.
void cautionsOfEngineSteps(const Case& setup, Lines& lines) {
  constexpr double far = 0.1;  // of d
  const double speed = std::abs(setup.cell.omega) * setup.cell.innerRadius;
  for (const auto& [engine, settings] : setup.engines) {
    const auto step = settings.find("dt");
    if (step == settings.end() || !std::holds_alternative<double>(step->second)) continue;
    const double fraction =
        std::get<double>(step->second) * speed / setup.particles.smallRadius / 2.0;
    if (fraction > far)
      lines.push_back(
          fmt::format("[engines.{}] dt = {:g} s: the wheel's rim moves {:.2g} d in a step of it",
                      engine, std::get<double>(step->second), fraction));
  }
}

}  // namespace

Lines cautions(const Case& setup, double volumeFraction) {
  Lines lines = setup.warnings;
  if (setup.kind == CaseKind::collision) {
    if (setup.collision.margins.empty())
      lines.emplace_back("no [collision.margins]: collide will judge nothing");
    return lines;
  }
  cautionsOfStep(setup, lines);
  if (setup.average) cautionsOfVerdicts(setup, lines);
  if (setup.kind == CaseKind::assembly) return lines;
  cautionsOfFilling(setup, volumeFraction, lines);
  cautionsOfVerdicts(setup, lines);
  cautionsOfEngineSteps(setup, lines);
  return lines;
}

}  // namespace crossgrain::inline cases
