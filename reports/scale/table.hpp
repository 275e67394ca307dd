#pragma once

#include <string>
#include <vector>

#include "results/scale.hpp"

/// Points of a study of scaling as rows, for the terminal and the page alike.
namespace crossgrain::reports {

struct ScaleColumn {
  std::string name;     ///< "ns/disk"
  std::string meaning;  ///< a sentence
};

const std::vector<ScaleColumn>& scaleColumns();

/// A cell for each column; a dash where there is no number.
std::vector<std::string> scaleCells(const ScaleResults& results, const ScalePoint& point);

/// "2 threads"; "one process" of an engine that has no workers.
std::string workersInWords(const ScaleResults& results, const ScalePoint& point);

/// Names of what the engine did otherwise than the scene says, on any cell that it ran.
std::vector<std::string> scaleDifferences(const ScaleResults& results, const std::string& engine);

/// What workers are to the engine; empty: it has one.
std::string workersOf(const ScaleResults& results, const std::string& engine);

}  // namespace crossgrain::reports
