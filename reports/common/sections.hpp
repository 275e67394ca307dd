#pragma once

#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "reports/common/report.hpp"
#include "results/flow_frame.hpp"

/// Sections that several studies have.
namespace crossgrain::reports {

/// What an engine made of a scene. Both must outlive it.
struct EffectiveScene {
  std::string engine;
  const EffectiveParameters* effective;
  const std::vector<std::string>* calledFor;  ///< effects of this scene; null: not known
};
/// Deviations of engines from the scene, pair coefficients after their mixing rules, and effects
/// called for and simulated.
void addDetails(Report& report, const std::vector<EffectiveScene>& effective);

/// Seed and hash of each packing.
void addPackings(Report& report, const std::vector<PackingRow>& packings);

/// Version and description of each engine; why it did not run.
void addEngines(Report& report);

/// A column for each of these engines, after the first ones.
std::vector<Column> engineColumns(std::vector<Column> first, const auto& engines) {
  for (const EngineRow& engine : engines) first.emplace_back(engine.name, Column::Kind::engine);
  return first;
}

}  // namespace crossgrain::reports
