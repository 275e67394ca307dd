#include <fmt/format.h>

#include <algorithm>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/agreement_entries.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/couette/state_view.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineResults>;

/// The fields of one pair by verdict, with their symbols.
struct Tally {
  std::vector<std::string> agree, disagree, undecided;
  std::optional<double> fewest;  ///< more packings that any undecided field asks for
};

Tally tally(const Json& results, const std::string& a, const std::string& b) {
  Tally counts;
  for (const std::string& field : fieldsOf(results)) {
    const Json& entry = entryOf(results, a, b, field);
    const std::string verdict = text(entry, "verdict"), name = spaced(field);
    if (verdict == "agree") counts.agree.push_back(name);
    if (verdict == "disagree") counts.disagree.push_back(name);
    if (verdict != "undecided") continue;
    counts.undecided.push_back(name);
    if (const auto more = number(entry, "more_packings"))
      counts.fewest = std::min(*more, counts.fewest.value_or(*more));
  }
  return counts;
}

/// ", 2 disagree (spin, stress rr)"; names are left out where it is all of them.
std::string share(const std::vector<std::string>& fields, std::size_t all, const char* verdict) {
  if (fields.empty()) return {};
  const std::string names =
      fields.size() == all ? std::string() : fmt::format(" ({})", fmt::join(fields, ", "));
  return fmt::format(", {} {}{}", fields.size(), verdict, names);
}

std::string inWords(const Tally& counts) {
  const std::size_t all = counts.agree.size() + counts.disagree.size() + counts.undecided.size();
  std::string words = fmt::format("{} of {} agree", counts.agree.size(), counted(all, "field")) +
                      share(counts.disagree, all, "disagree") +
                      share(counts.undecided, all, "undecided");
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

std::string basisInWords(const Json& results, const std::string& reference) {
  const std::string when = averagedRotations(results);
  return fmt::format("Reference: {}. {}{}.", reference,
                     counted(list(results, "packings").size(), "packing"),
                     when.empty() ? std::string() : "; averaged: " + when);
}

/// Of a mirror: how its peer's difference splits. Empty for others.
std::string splitInWords(const Json& results, const EngineResults& mirror,
                         const std::string& reference) {
  if (mirror.mirrors.empty() || !compared(results, mirror.name, mirror.mirrors)) return {};
  return fmt::format("{} mirrors {}. Model, against {}: {}. Implementation, against {}: {}.",
                     mirror.name, mirror.mirrors, reference,
                     inWords(tally(results, reference, mirror.name)), mirror.mirrors,
                     inWords(tally(results, mirror.name, mirror.mirrors)));
}

std::string troubleInWords(const EngineResults& engine) {
  if (engine.status != "ran") {
    const std::string reason = text(*engine.entry, "reason");
    return engine.name + " " + (engine.status == "refused" ? "refused the scene" : engine.status) +
           (reason.empty() ? "." : ": " + reason);
  }
  const std::size_t lost = engine.runs.size() - engine.finished.size();
  return lost == 0 ? std::string()
                   : fmt::format("{}: {} of {} did not finish.", engine.name, lost,
                                 counted(engine.runs.size(), "run"));
}

}  // namespace

void addSummary(Json& view, const Json& results, const Engines& engines) {
  Json sentences = Json::array();
  std::size_t agree = 0, disagree = 0, undecided = 0;
  if (!engines.empty()) sentences.push_back(basisInWords(results, engines.front().name));
  for (std::string& state : stateSentences(results, engines)) sentences.push_back(std::move(state));
  for (const std::string& peer : peersOf(results, engines)) {
    const Tally counts = tally(results, engines.front().name, peer);
    agree += counts.agree.size();
    disagree += counts.disagree.size();
    undecided += counts.undecided.size();
    sentences.push_back(
        fmt::format("{} against {}: {}.", peer, engines.front().name, inWords(counts)));
  }
  for (const EngineResults& engine : engines)
    if (const std::string split = splitInWords(results, engine, engines.front().name);
        !split.empty())
      sentences.push_back(split);
  for (const EngineResults& engine : engines)
    if (const std::string trouble = troubleInWords(engine); !trouble.empty())
      sentences.push_back(trouble);
  if (const auto packings = list(results, "packings").size(); packings < 4 && undecided > 0)
    sentences.push_back(
        "Fewer than 4 packings: what differs between packings cannot be told from what differs "
        "between engines, so no general verdict is given.");
  view["lead"] = leadOf(engines.empty() ? "" : engines.front().name, agree, disagree, undecided);
  view["sentences"] = std::move(sentences);
}

}  // namespace crossgrain::reports
