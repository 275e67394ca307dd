#pragma once

#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "reports/common/view.hpp"

namespace crossgrain::reports {

/// What an engine made of a scene. Both must outlive it.
struct RealisedScene {
  std::string engine;
  const Realised* realised;
  const std::vector<std::string>* calledFor;  ///< effects of this scene; null: not known
};
/// Rows of the tables of deviations, pairs and effects, set in view.
void addDetails(Json& view, const std::vector<RealisedScene>& realised);

}  // namespace crossgrain::reports
