#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reports/common/json_view.hpp"

/// Looking into the results of collisions.
namespace crossgrain::reports {

/// Rows of a table of columns {name: [one value per row]}.
std::size_t rowCount(const Json& table);

/// Absent where the column or the value is.
std::optional<double> at(const Json& table, std::string_view column, std::size_t row);

/// The variants of one case, in the results' order.
struct CaseGroup {
  std::string name;
  std::vector<const Json*> variants;
};
std::vector<CaseGroup> casesOf(const Json& results);

/// A variant's own case where the results hold several.
std::string caseOf(const Json& results, const Json& variant);

/// An engine's curve of the largest time step that has points; null without one.
const Json* coarsestCurve(const Json& variant, const std::string& engine);

/// An engine's curves of a variant, by descending time step.
std::vector<const Json*> curvesOf(const Json& variant, const std::string& engine);

/// "held" | "fell short" | "not judged", else the status.
std::string verdictOf(const Json& curve);

/// How the sweeps of all engines came out.
struct CollideCount {
  int held = 0, fellShort = 0, notJudged = 0, refused = 0, failed = 0;
  int judged() const { return held + fellShort; }
};
CollideCount countOf(const Json& results);

/// Why no sweep was judged, in a clause; empty if one was. Nothing judged is no success.
std::string nothingJudged(const Json& results);

/// What can be scored, in the order of the tables.
struct QuantityLabel {
  std::string_view name, symbol;  ///< as in "score"; for mathHtml()
};
const std::vector<QuantityLabel>& quantityLabels();

}  // namespace crossgrain::reports
