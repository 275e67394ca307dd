#pragma once

#include <string>
#include <vector>

#include "reports/common/figure.hpp"
#include "reports/common/json_view.hpp"
#include "results/engine_row.hpp"

namespace crossgrain::reports {

/// What a comparison's results hold about one engine. The results must outlive it.
struct EngineResults {
  std::string name;
  std::string
      mirrors;         ///< the peer whose conventions it has; empty for an engine named by the user
  std::string status;  ///< "ran" | "refused" | "failed"
  LineStyle style;     ///< a mirror has its peer's colour, dashed and open
  const Json* entry = nullptr;
  std::vector<const Json*> runs;      ///< in the order of the results
  std::vector<const Json*> finished;  ///< those of them that finished
  const Json* ensemble = nullptr;     ///< over packings; null with fewer than two finished runs

  /// Where averages are taken from: the ensemble, else the only finished run, else null.
  const Json& averages() const;
  /// Of the first run that got as far as loading the scene, or null.
  const Json& realised() const;

  /// Sets runs, finished and ensemble: of that engine, with that effect switched off (empty: none).
  void takeRuns(const Json& results, const std::string& engine, const std::string& without);
};

/// In the results' order: the reference first. Runs with an effect switched off are left out.
std::vector<EngineResults> engineResults(const Json& results);

/// Colours by Okabe and Ito (2008), told apart with any colour vision; marks differ too.
LineStyle engineStyle(std::size_t index);

/// The styles of the results' engines by their place in results["engines"].
std::vector<LineStyle> engineStyles(const Json& results);

/// Of engines in the order of the report.
std::vector<LineStyle> engineStyles(const std::vector<EngineRow>& engines);

}  // namespace crossgrain::reports
