#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/agreement_entries.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/couette/endpoint_words.hpp"
#include "reports/couette/state_view.hpp"
#include "reports/lockstep/words.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineRuns>;

std::string leadOf(const CompareResults& results, const std::vector<const EndpointRow*>& rows) {
  if (const auto& nothing = results.nothingJudged)
    return fmt::format("Nothing was judged: {}.", nothing->reason);
  if (rows.empty()) return "No two engines could be compared.";
  std::string lead =
      fmt::format("Against {}: {}.", results.engines.front().name, countsInWords(rows));
  if (const std::size_t alarms = results.endpoints.alarms.size(); alarms > 0)
    lead = fmt::format("{}. ", counted(alarms, "alarm")) + lead;
  return lead;
}

std::string basisInWords(const CompareResults& results, const std::string& reference) {
  const std::string when = averagedRotations(results.averaging);
  return fmt::format("Reference: {}. {}{}.", reference, counted(results.packings.size(), "packing"),
                     when.empty() ? std::string() : "; averaged: " + when);
}

/// What the words stand for, of how many pairs of engines that the user named.
std::string promiseInWords(const CompareResults& results) {
  std::set<std::pair<std::string, std::string>> pairs;
  for (const EndpointRow& row : results.endpoints.rows)
    if (row.kind == PairKind::peer) pairs.emplace(row.a, row.b);
  if (pairs.empty()) return {};
  return fmt::format(
      "{}; agree is held endpoint by endpoint, disagree over the endpoints of each pair, at {:.3g} "
      "% "
      "each.",
      counted(pairs.size(), "pair"), 100.0 * (1.0 - results.averaging.confidence));
}

/// Of a mirror that stands beside its peer: how the peer's difference splits. Empty for others.
std::string splitInWords(const Endpoints& endpoints, const EngineRuns& mirror,
                         const std::string& reference) {
  const auto model = rowsOf(endpoints, reference, mirror.name);
  const auto implementation = rowsOf(endpoints, mirror.name, mirror.mirrors);
  if (mirror.mirrors.empty() || implementation.empty()) return {};
  return fmt::format("{} mirrors {}. Model, against {}: {}. Implementation, against {}: {}.",
                     mirror.name, mirror.mirrors, reference, countsInWords(model), mirror.mirrors,
                     countsInWords(implementation));
}

std::string troubleInWords(const EngineRuns& engine) {
  if (engine.status != EngineStatus::ran)
    return fmt::format(
        "{} {}{}", engine.name,
        engine.status == EngineStatus::refused ? "refused the scene" : nameOf(engine.status),
        engine.reason.empty() ? "." : ": " + engine.reason);
  const std::size_t lost = engine.runs.size() - engine.finished.size();
  return lost == 0 ? std::string()
                   : fmt::format("{}: {} of {} did not finish.", engine.name, lost,
                                 counted(engine.runs.size(), "run"));
}

}  // namespace

void addSummary(Json& view, const CompareResults& results, const Engines& engines) {
  const Endpoints& endpoints = results.endpoints.rows;
  const std::string reference = engines.empty() ? std::string() : engines.front().name;
  Json sentences = Json::array();
  std::vector<const EndpointRow*> all;
  for (const AlarmRow& alarm : results.endpoints.alarms)
    sentences.push_back("Alarm. " + sentenceOf(alarm));
  if (!engines.empty()) sentences.push_back(basisInWords(results, reference));
  if (results.endpoints.looks.taken > 0) sentences.push_back(sentenceOf(results.endpoints.looks));
  if (const std::string promise = promiseInWords(results); !promise.empty())
    sentences.push_back(promise);
  if (results.lockstep) sentences.push_back("Lockstep: " + leadOf(*results.lockstep));
  for (std::string& state : stateSentences(results, engines)) sentences.push_back(std::move(state));
  for (const std::string& peer : peersOf(endpoints, engines)) {
    const auto rows = rowsOf(endpoints, reference, peer);
    std::ranges::copy(rows, std::back_inserter(all));
    if (!results.nothingJudged)
      sentences.push_back(fmt::format("{} against {}: {}.", peer, reference, countsInWords(rows)));
  }
  for (const EngineRuns& engine : engines)
    if (const std::string split = splitInWords(endpoints, engine, reference);
        !split.empty() && !results.nothingJudged)
      sentences.push_back(split);
  for (const EngineRuns& engine : engines)
    if (const std::string trouble = troubleInWords(engine); !trouble.empty())
      sentences.push_back(trouble);
  if (const auto packings = results.packings.size(); packings < 4 && !all.empty())
    sentences.push_back(
        "Fewer than 4 packings: what differs between packings cannot be told from what differs "
        "between engines, so no general verdict is given.");
  view["lead"] = leadOf(results, all);
  view["sentences"] = std::move(sentences);
}

}  // namespace crossgrain::reports
