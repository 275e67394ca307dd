#include "studies/flow/surrogates.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "cases/endpoints.hpp"
#include "studies/flow/endpoint_table.hpp"
#include "studies/lockstep/rules.hpp"

namespace crossgrain::inline studies {

namespace {

constexpr int spotCheckPacking = 0;

/// Why a mirror cannot stand for its engine; empty: it can.
/// @param observed  set where it is a difference that was seen
std::string alarmOf(const Case& setup, const std::vector<SpotCheckNumber>& spotCheck, double alpha,
                    bool& observed) {
  std::string least;
  double chance = alpha;
  for (const SpotCheckNumber& number : spotCheck) {
    const std::string words(endpointNamed(setup, number.endpoint).words);
    if (!number.difference) return fmt::format("the engine, its mirror or both have no {}", words);
    if (!number.chance) return fmt::format("chaos of {} is not known: too few packings", words);
    if (*number.chance >= chance) continue;
    chance = *number.chance;
    least = fmt::format("{} differs by {:.2g} margins, where chaos scatters by {:.2g}", words,
                        std::abs(*number.difference), *number.floor);
  }
  observed = !least.empty();
  return least;
}

}  // namespace

std::vector<SurrogateEngine> surrogateEngines(const Campaign& campaign,
                                              const std::vector<std::string>& names,
                                              const LockstepFindings& found) {
  std::vector<SurrogateEngine> surrogates;
  for (const LockstepRow& row : found.rows) {
    const bool same =
        row.verdict == Equivalence::sameToRounding || row.verdict == Equivalence::sameLaw;
    if (!same || !row.failure.empty() || !row.equivalentHigh) continue;
    for (std::size_t e = 0; e < campaign.engines().size(); ++e)
      if (campaign.engines()[e].mirrors == row.engine && campaign.refusal(e).empty() &&
          !isNamed(names, campaign.engines()[e]))
        surrogates.push_back({row.engine,
                              campaign.engines()[e].name,
                              *row.equivalentHigh,
                              row.starts,
                              spotCheckPacking,
                              {},
                              {}});
  }
  return surrogates;
}

void judgeSpotChecks(const Case& setup, const Campaign& campaign,
                     const std::vector<EndpointResponse>& responses,
                     std::vector<SurrogateEngine>& engines) {
  for (SurrogateEngine& own : engines) {
    const auto first = [&](const std::string& engine) -> const FlowRun* {
      const Runs runs = finishedRuns(campaign.runs(), engine);
      return runs.empty() || runs.front()->packing != own.spotCheckPacking ? nullptr : runs.front();
    };
    const FlowRun *const run = first(own.engine), *const mirror = first(own.mirror);
    if (!run || !mirror) {
      own.alarm = fmt::format("{} run of packing {} did not finish",
                              run ? "the mirror's" : "its own", own.spotCheckPacking);
      continue;
    }
    own.spotCheck = spotCheckOf(setup, *run, *mirror, responses);
    own.alarm = alarmOf(setup, own.spotCheck, 1.0 - setup.averaging.confidence, own.observed);
    own.inUse = own.alarm.empty() && !own.spotCheck.empty();
  }
}

void judgeLateWindows(const Case& setup, const std::vector<EndpointResponse>& responses,
                      LateWindows late, SurrogateEngine& engine) {
  engine.late = std::move(late);
  const LateWindows& found = engine.late;
  if (!found.failure.empty())
    engine.alarm = fmt::format("its own run cannot be followed: {}", found.failure);
  double farthest = largestReach;
  for (const auto& [name, margin] : setup.averaging.endpoints)
    if (const auto reach = reachOf(name, found, responses); reach && !(*reach <= farthest)) {
      farthest = *reach;
      engine.observed = true;
      std::vector<std::string> changes;
      for (const EquivalentChange& one : found.equivalents)
        changes.push_back(fmt::format("{:.2g} % of {}", 100.0 * one.change, one.constant));
      engine.alarm = fmt::format(
          "{} windows of its own run of packing {} differ from the mirror as {} would, by which {} "
          "may differ by {:.2g} margins ({:g} is the most)",
          found.times.size(), found.packing, fmt::join(changes, " or "),
          endpointNamed(setup, name).words, *reach, largestReach);
    }
  engine.inUse = engine.inUse && engine.alarm.empty();
}

std::vector<EndpointResponse> endpointResponses(const Case& setup, const Campaign& campaign,
                                                const std::string& engine,
                                                const std::vector<ChangedCase>& changed,
                                                const RunsById& runs, int packings) {
  Runs own = finishedRuns(campaign.runs(), engine);
  std::erase_if(own, [&](const FlowRun* run) { return run->packing >= packings; });
  std::vector<EndpointResponse> responses;
  for (const ChangedCase& one : changed) {
    Runs with;
    for (int k = 0; k < packings; ++k)
      if (const auto run = runs.find({engine, one.name, k});
          run != runs.end() && run->second.finished())
        with.push_back(&run->second);
    for (const auto& [endpoint, margin] : setup.averaging.endpoints)
      responses.push_back(responseTo(setup, own, with, endpoint, one.constant, responseChange,
                                     static_cast<std::size_t>(packings)));
  }
  return responses;
}

}  // namespace crossgrain::inline studies
