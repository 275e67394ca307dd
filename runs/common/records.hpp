#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "adapters/engine.hpp"
#include "averaging/distributions.hpp"
#include "averaging/fits.hpp"
#include "averaging/profiles.hpp"
#include "cases/case.hpp"

/// Pieces of results.json (reports/README.md has its layout).
namespace crossgrain::inline runs {

/// null where absent
nlohmann::json toJson(const std::optional<double>& value);
nlohmann::json toJson(const std::vector<std::optional<double>>& values);
nlohmann::json toJson(const Profile& profile);
nlohmann::json toJson(const std::vector<Distribution>& distributions);
nlohmann::json statsJson(const Stats& stats);
nlohmann::json profileJson(const std::string& method, const std::string& field,
                           const std::string& unit, const std::vector<std::optional<double>>& mean,
                           const std::vector<std::optional<double>>& standardError,
                           const std::vector<std::optional<double>>& nEff);
/// A number or null back, and a list of them.
std::optional<double> optionalNumber(const nlohmann::json& value);
std::vector<std::optional<double>> optionalNumbers(const nlohmann::json& list);
/// The numbers of a list, nulls left out.
std::vector<double> presentNumbers(const nlohmann::json& list);

/// One row of a run's fits: a parameter, or why there is none; χ²/dof where the points have errors.
nlohmann::json fitJson(const Fit& fit, const std::string& parameter, const std::string& name,
                       const std::string& label, const std::string& unit,
                       std::optional<double> expected);

/// What every results.json begins with: schema, kind, version, command, time, machine, case.
nlohmann::json resultsHead(const std::string& kind, const Case& setup, const std::string& command);

}  // namespace crossgrain::inline runs
