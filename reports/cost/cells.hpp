#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/common/view.hpp"
#include "reports/cost/points.hpp"

/// What the tables of a study of cost are made of.
namespace crossgrain::reports {

/// The head of an engine's row.
Json headOf(const CostEngine& engine);

/// A cell with the verdict's mark; lines that are empty are left out.
Json verdictCell(CostVerdict verdict, const std::string& text, std::vector<std::string> lines);

/// "would tell: …"; empty where nothing would.
std::string decidesText(const std::string& decides);

/// What makes the statistical part as small as the target.
std::string lengthText(std::optional<double> length);

}  // namespace crossgrain::reports
