#include "reports/couette/state_view.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/packings.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineRuns>;

/// The run's regime with the figures that it was read from.
Json regimeCell(const CouetteRun* run) {
  if (!run || !run->regime) return {{"word", absentText}, {"figures", ""}, {"why", ""}};
  const RegimeRow& regime = *run->regime;
  std::string figures = fmt::format("contacts {}, slip {}, shear {}, I {}",
                                    readable(regime.wheelContacts), readable(regime.wheelSlip),
                                    readable(regime.shearShare), readable(regime.inertialNumber));
  // A run that is blocked throughout, or never, is told by its name.
  if (const auto blocked = finite(regime.blockedFraction);
      blocked && *blocked > 0.0 && *blocked < 1.0)
    figures += fmt::format("; stood still {} % of the time", readablePercent(*blocked));
  return {{"word", regime.regime ? toString(*regime.regime) : "cannot be told"},
          {"figures", figures},
          {"why", regime.reason}};
}

Json regimeRows(const Engines& engines) {
  std::set<int> packings;
  for (const EngineRuns& engine : engines)
    for (const CouetteRun* run : engine.finished)
      if (run->regime) packings.insert(run->packing);
  Json rows = Json::array();
  for (const int packing : packings) {
    Json cells = Json::array();
    for (const EngineRuns& engine : engines) {
      const auto run = std::ranges::find(engine.finished, packing, &CouetteRun::packing);
      cells.push_back(regimeCell(run == engine.finished.end() ? nullptr : *run));
    }
    rows.push_back({{"packing", packing}, {"cells", std::move(cells)}});
  }
  return rows;
}

/// Pairs by whether they were in the same regime on all packings.
Json pairRows(const std::vector<RegimesOfPair>& pairs) {
  Json rows = Json::array();
  for (const RegimesOfPair& pair : pairs)
    rows.push_back(
        {{"pair", pair.a + " – " + pair.b},
         {"same", fmt::format("{} of {}", pair.packings - static_cast<int>(pair.differ.size()),
                              pair.packings)},
         {"differ", pair.differ.empty() ? std::string(absentText) : indicesInWords(pair.differ)}});
  return rows;
}

/// "−40 ± 8 % of the mean"
std::string changeInWords(const RelativeDrift& drift) {
  const auto change = finite(drift.change), half = finite(drift.half);
  if (!change || !half) return absentText;
  return fmt::format("{}{} ± {} %", *change < 0.0 ? "−" : "+", readablePercent(std::abs(*change)),
                     readablePercent(*half));
}

Json steadinessCell(const EngineDrift* row) {
  if (!row) return {{"word", absentText}, {"figures", ""}};
  std::string word(toString(row->drift.verdict));
  if (row->drift.verdict == Drift::notSeen)
    word += fmt::format(" down to {} %", readablePercent(row->drift.excluded.value_or(0.0)));
  std::string figures = changeInWords(row->drift);
  if (!row->drifting.empty())
    figures += fmt::format("; by themselves drift: {}", indicesInWords(row->drifting));
  return {{"word", word}, {"figures", figures}};
}

Json steadinessRows(const std::vector<EngineDrift>& all, const Engines& engines) {
  std::vector<std::string> quantities;
  for (const EngineDrift& row : all)
    if (std::ranges::find(quantities, row.quantity) == quantities.end())
      quantities.push_back(row.quantity);
  Json rows = Json::array();
  for (const std::string& quantity : quantities) {
    Json cells = Json::array();
    for (const EngineRuns& engine : engines) {
      const auto found = std::ranges::find_if(all, [&](const EngineDrift& row) {
        return row.engine == engine.name && row.quantity == quantity;
      });
      cells.push_back(steadinessCell(found == all.end() ? nullptr : &*found));
    }
    rows.push_back({{"quantity", spaced(quantity)}, {"cells", std::move(cells)}});
  }
  return rows;
}

}  // namespace

void addStates(Json& view, const CompareResults& results, const Engines& engines) {
  view["regimes"] = regimeRows(engines);
  view["hasRegimes"] = !view["regimes"].empty();
  view["regimePairs"] = pairRows(results.regimes);
  view["hasRegimePairs"] = !view["regimePairs"].empty();
  view["steadiness"] = steadinessRows(results.steadiness, engines);
  view["hasSteadiness"] = !view["steadiness"].empty();
  const std::string when = averagedRotations(results.averaging);
  view["averagedOver"] = when.empty() ? std::string() : "Averaged: " + when + ".";
}

}  // namespace crossgrain::reports
