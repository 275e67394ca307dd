#pragma once

#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "cases/case.hpp"
#include "results/cost.hpp"

namespace crossgrain::inline studies {

/// A setting that `crossgrain cost` measures on one engine: the case with a fragment merged in.
struct CostSetting {
  std::string knob, setting;  ///< as in CostPoint
  std::string fragment;       ///< TOML; empty: the case as it is
  Case setup;                 ///< case and fragment as loaded
  std::string refusal = {};   ///< why the engine has no such setting; empty if it has

  /// Integrator of a setting of another one; empty: the engine's own.
  std::string integrator() const { return schemeOf(knob, setting).value_or(""); }
};

/// Every setting of [cost] that matters to that kind of error, the case as it is first. Settings
/// that the engine lacks are there, with the reason. @throws BadInput for an engine's setting that
/// does not exist
std::vector<CostSetting> costSettings(const Case& setup, CostKind kind, const std::string& engine,
                                      const Capabilities& can);

/// TOML that sets the time step of an engine: an engine with a step of its own does not follow the
/// case's. @param steps  in costStepUnit()
std::string stepFragment(const Case& setup, const std::string& engine, const Capabilities& can,
                         double steps);

/// The case with that step.
Case atSteps(const Case& setup, const std::string& engine, const Capabilities& can, double steps);

/// t_c of the lightest pair [s]. @throws BadInput for a law without one
double costContactTime(const Case& setup);

/// What steps are counted in [s]: t_c; of rigid bodies, which have none, the case's own step. A
/// time of the scene, √(h/g) or 1/ω, would be another one in each scene, and the step is what its
/// user has and asks about.
double costStepUnit(const Case& setup);

/// "t_c/50"; of rigid bodies "dt/2", "4 dt".
std::string stepName(const Case& setup, double steps);

/// The step that an engine will take [s].
double engineStep(const Case& setup, const std::string& engine, const Capabilities& can);

/// A point of that setting without any numbers but dt and the steps in t_c of the setting's case.
CostPoint pointOf(const std::string& engine, const CostSetting& setting, CostKind kind, double dt);

/// Sets the steps and contact evaluations that a point's time is for; 0: not known.
void countWork(CostPoint& point, std::uint64_t steps, std::uint64_t contactEvaluations);

}  // namespace crossgrain::inline studies
