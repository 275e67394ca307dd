#pragma once

#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/common/json_view.hpp"
#include "results/engine_row.hpp"

namespace crossgrain::reports {

/// What results.json says of one engine. The results must outlive it.
struct EngineResults {
  std::string name;
  std::string
      mirrors;         ///< the peer whose conventions it has; empty for an engine named by the user
  std::string status;  ///< "ran" | "refused" | "failed"
  LineStyle style;     ///< a mirror has its peer's colour, dashed and open
  const Json* entry = nullptr;
  std::vector<const Json*> finished;  ///< runs, in the order of the results
};

/// In the results' order: the reference first.
std::vector<EngineResults> engineResults(const Json& results);

/// Colours by Okabe and Ito (2008), told apart with any colour vision; marks differ too.
LineStyle engineStyle(std::size_t index);

/// The styles of the results' engines by their place in results["engines"].
std::vector<LineStyle> engineStyles(const Json& results);

/// Of engines in the order of the report.
std::vector<LineStyle> engineStyles(const std::vector<EngineRow>& engines);

}  // namespace crossgrain::reports
