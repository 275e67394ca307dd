#include <fmt/format.h>

#include <algorithm>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/agreement_entries.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/couette/state_view.hpp"
#include "reports/lockstep/words.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineRuns>;

/// The fields of one pair by verdict.
struct Tally {
  std::vector<std::string> agree, disagree, undecided;
  std::optional<int> fewest;  ///< more packings that any undecided field asks for
};

Tally tally(const Agreement& agreement, const std::string& a, const std::string& b) {
  Tally counts;
  for (const std::string& field : fieldsOf(agreement)) {
    const AgreementRow* row = rowOf(agreement, a, b, field);
    if (!row) continue;
    const std::string name = spaced(field);
    if (row->verdict == Verdict::agree) counts.agree.push_back(name);
    if (row->verdict == Verdict::disagree) counts.disagree.push_back(name);
    if (row->verdict != Verdict::undecided) continue;
    counts.undecided.push_back(name);
    if (row->morePackings)
      counts.fewest = std::min(*row->morePackings, counts.fewest.value_or(*row->morePackings));
  }
  return counts;
}

/// ", 2 disagree (spin, stress rr)"; names are left out where it is all of them.
std::string partOf(const std::vector<std::string>& fields, std::size_t all, const char* verdict) {
  if (fields.empty()) return {};
  const std::string names =
      fields.size() == all ? std::string() : fmt::format(" ({})", fmt::join(fields, ", "));
  return fmt::format(", {} {}{}", fields.size(), verdict, names);
}

std::string countsInWords(const Tally& counts) {
  const std::size_t all = counts.agree.size() + counts.disagree.size() + counts.undecided.size();
  std::string words = fmt::format("{} of {} agree", counts.agree.size(), counted(all, "field")) +
                      partOf(counts.disagree, all, "disagree") +
                      partOf(counts.undecided, all, "undecided");
  if (counts.fewest)
    words += fmt::format("; the nearest to a verdict needs {}", morePackings(*counts.fewest));
  return words;
}

std::string leadOf(const std::string& reference, std::size_t agree, std::size_t disagree,
                   std::size_t undecided) {
  if (agree + disagree + undecided == 0) return "No two engines could be compared.";
  return fmt::format("Of {} with {}, field by field: {} agree, {} disagree, {} undecided.",
                     counted(agree + disagree + undecided, "comparison"), reference, agree,
                     disagree, undecided);
}

std::string basisInWords(const CompareResults& results, const std::string& reference) {
  const std::string when = averagedRotations(results.averaging);
  return fmt::format("Reference: {}. {}{}.", reference, counted(results.packings.size(), "packing"),
                     when.empty() ? std::string() : "; averaged: " + when);
}

/// Of a mirror: how its peer's difference splits. Empty for others.
std::string splitInWords(const Agreement& agreement, const EngineRuns& mirror,
                         const std::string& reference) {
  if (mirror.mirrors.empty() || !compared(agreement, mirror.name, mirror.mirrors)) return {};
  return fmt::format("{} mirrors {}. Model, against {}: {}. Implementation, against {}: {}.",
                     mirror.name, mirror.mirrors, reference,
                     countsInWords(tally(agreement, reference, mirror.name)), mirror.mirrors,
                     countsInWords(tally(agreement, mirror.name, mirror.mirrors)));
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
  const Agreement& agreement = results.agreement;
  Json sentences = Json::array();
  std::size_t agree = 0, disagree = 0, undecided = 0;
  if (!engines.empty()) sentences.push_back(basisInWords(results, engines.front().name));
  if (results.lockstep) sentences.push_back("Lockstep: " + leadOf(*results.lockstep));
  for (std::string& state : stateSentences(results, engines)) sentences.push_back(std::move(state));
  for (const std::string& peer : peersOf(agreement, engines)) {
    const Tally counts = tally(agreement, engines.front().name, peer);
    agree += counts.agree.size();
    disagree += counts.disagree.size();
    undecided += counts.undecided.size();
    sentences.push_back(
        fmt::format("{} against {}: {}.", peer, engines.front().name, countsInWords(counts)));
  }
  for (const EngineRuns& engine : engines)
    if (const std::string split = splitInWords(agreement, engine, engines.front().name);
        !split.empty())
      sentences.push_back(split);
  for (const EngineRuns& engine : engines)
    if (const std::string trouble = troubleInWords(engine); !trouble.empty())
      sentences.push_back(trouble);
  if (const auto packings = results.packings.size(); packings < 4 && undecided > 0)
    sentences.push_back(
        "Fewer than 4 packings: what differs between packings cannot be told from what differs "
        "between engines, so no general verdict is given.");
  view["lead"] = leadOf(engines.empty() ? "" : engines.front().name, agree, disagree, undecided);
  view["sentences"] = std::move(sentences);
}

}  // namespace crossgrain::reports
