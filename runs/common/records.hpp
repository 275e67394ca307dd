#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/engine.hpp"
#include "cases/case.hpp"
#include "results/head.hpp"

/// Pieces of results.json (reports/README.md has its layout).
namespace crossgrain::inline runs {

/// null where absent
nlohmann::json toJson(const std::optional<double>& value);
nlohmann::json toJson(const std::vector<std::optional<double>>& values);
nlohmann::json statsJson(const Stats& stats);
/// A number or null back, and a list of them.
std::optional<double> optionalNumber(const nlohmann::json& value);
std::vector<std::optional<double>> optionalNumbers(const nlohmann::json& list);
/// What all results begin with.
ResultsHead headOf(std::string_view kind, const Case& setup, const std::string& command);
nlohmann::json resultsHead(const std::string& kind, const Case& setup, const std::string& command);

}  // namespace crossgrain::inline runs
