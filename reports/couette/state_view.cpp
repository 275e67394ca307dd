#include "reports/couette/state_view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineResults>;

/// The run's regime with the figures that it was read from.
Json regimeCell(const Json& run) {
  const Json& regime = member(run, "regime");
  if (!regime.is_object()) return {{"word", absentText}, {"figures", ""}, {"why", ""}};
  const std::string name = text(regime, "name");
  std::string figures = fmt::format(
      "contacts {}, slip {}, shear {}, I {}", readable(number(regime, "wheel_contacts")),
      readable(number(regime, "wheel_slip")), readable(number(regime, "shear_share")),
      readable(number(regime, "inertial_number")));
  // A run that is blocked throughout, or never, is told by its name.
  if (const auto share = number(regime, "blocked_share"); share && *share > 0.0 && *share < 1.0)
    figures += fmt::format("; stood still {} % of the time", readablePercent(*share));
  return {{"word", name.empty() ? std::string("cannot be told") : name},
          {"figures", figures},
          {"why", text(regime, "reason")}};
}

Json regimeRows(const Engines& engines) {
  std::set<long> packings;
  for (const EngineResults& engine : engines)
    for (const Json* run : engine.finished)
      if (const auto packing = number(*run, "packing");
          packing && member(*run, "regime").is_object())
        packings.insert(static_cast<long>(*packing));
  Json rows = Json::array();
  for (const long packing : packings) {
    Json cells = Json::array();
    for (const EngineResults& engine : engines) {
      const auto run = std::ranges::find_if(engine.finished, [&](const Json* candidate) {
        return number(*candidate, "packing") == static_cast<double>(packing);
      });
      cells.push_back(regimeCell(run == engine.finished.end() ? Json() : **run));
    }
    rows.push_back({{"packing", packing}, {"cells", std::move(cells)}});
  }
  return rows;
}

/// Pairs by whether they were in the same regime on all packings.
Json pairRows(const Json& results) {
  Json rows = Json::array();
  for (const Json& pair : list(results, "regimes")) {
    std::vector<std::string> differ;
    for (const Json& index : list(pair, "differ")) differ.push_back(index.dump());
    const auto packings = number(pair, "packings").value_or(0.0);
    rows.push_back({{"pair", text(pair, "a") + " – " + text(pair, "b")},
                    {"same", fmt::format("{:.0f} of {:.0f}",
                                         packings - static_cast<double>(differ.size()), packings)},
                    {"differ", differ.empty() ? std::string(absentText)
                                              : fmt::format("{}", fmt::join(differ, ", "))}});
  }
  return rows;
}

/// "−40 ± 8 % of the mean"
std::string changeInWords(const Json& row) {
  const auto change = number(row, "change"), half = number(row, "half_width");
  if (!change || !half) return absentText;
  return fmt::format("{}{} ± {} %", *change < 0.0 ? "−" : "+", readablePercent(std::abs(*change)),
                     readablePercent(*half));
}

Json steadinessCell(const Json& row) {
  if (!row.is_object()) return {{"word", absentText}, {"figures", ""}};
  std::string word = text(row, "verdict");
  if (word == "no drift seen")
    word += fmt::format(" down to {} %", readablePercent(number(row, "excluded").value_or(0.0)));
  std::vector<std::string> runs;
  for (const Json& index : list(row, "drifting")) runs.push_back(index.dump());
  std::string figures = changeInWords(row);
  if (!runs.empty()) figures += fmt::format("; by themselves drift: {}", fmt::join(runs, ", "));
  return {{"word", word}, {"figures", figures}};
}

Json steadinessRows(const Json& results, const Engines& engines) {
  std::vector<std::string> quantities;
  for (const Json& row : list(results, "steadiness"))
    if (const std::string name = text(row, "quantity");
        std::ranges::find(quantities, name) == quantities.end())
      quantities.push_back(name);
  Json rows = Json::array();
  for (const std::string& quantity : quantities) {
    Json cells = Json::array();
    for (const EngineResults& engine : engines) {
      const auto& all = list(results, "steadiness");
      const auto found = std::ranges::find_if(all, [&](const Json& row) {
        return text(row, "engine") == engine.name && text(row, "quantity") == quantity;
      });
      cells.push_back(steadinessCell(found == all.end() ? Json() : *found));
    }
    rows.push_back({{"quantity", spaced(quantity)}, {"cells", std::move(cells)}});
  }
  return rows;
}

}  // namespace

void addStates(Json& view, const Json& results, const Engines& engines) {
  view["regimes"] = regimeRows(engines);
  view["hasRegimes"] = !view["regimes"].empty();
  view["regimePairs"] = pairRows(results);
  view["hasRegimePairs"] = !view["regimePairs"].empty();
  view["steadiness"] = steadinessRows(results, engines);
  view["hasSteadiness"] = !view["steadiness"].empty();
  const std::string when = averagedRotations(results);
  view["averagedOver"] = when.empty() ? std::string() : "Averaged: " + when + ".";
}

}  // namespace crossgrain::reports
