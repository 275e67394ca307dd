#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "results/diff.hpp"

namespace crossgrain::inline runs {

/// What an engine declares of itself.
struct Declaration {
  std::string engine;
  const Capabilities& can;
  const std::optional<Realised>& ran;  ///< absent: it did not come to that
};

/// What is declared that was not declared before: of what was realised of a scene the step,
/// precision, integrator, effects, constants and deviations; and where it is the same engine, its
/// version and its options of the law.
std::vector<DeclaredChange> declaredChanges(const Declaration& before, const Declaration& now);

}  // namespace crossgrain::inline runs
