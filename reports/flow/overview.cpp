#include "reports/flow/overview.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"
#include "reports/flow/endpoint_text.hpp"
#include "reports/lockstep/report.hpp"

namespace crossgrain::reports {

namespace {

OverviewCell lockstepOf(const CompareResults& results, const EngineRow& engine) {
  static const LockstepFindings none;
  const LockstepFindings& findings = results.lockstep ? *results.lockstep : none;
  const auto row = std::ranges::find(findings.rows, engine.name, &LockstepRow::engine);
  OverviewCell cell = lockstepCell(row == findings.rows.end() ? nullptr : &*row, findings.rules,
                                   !engine.mirrors.empty());
  // The worst of all that was seen: a fault that begins after lockstep's windows shows in the
  // engine's own run.
  const SurrogateEngine* const own = spotCheckedEngine(results.endpoints.surrogates, engine.name);
  if (!own || cell.verdict == Verdict::fail || verdictOf(*own) == Verdict::pass) return cell;
  cell.verdict = verdictOf(*own);
  cell.words = (own->late.differs ? fmt::format("differs in {} of {} windows of its own run; ",
                                                own->late.beyond, own->late.read)
                                  : std::string()) +
               own->alarm;
  cell.anchor = "agreement";
  // Numbers of lockstep's windows are no part of this.
  cell.value.reset();
  cell.shown.clear();
  if (own->late.differs && !own->late.equivalents.empty()) {
    const EquivalentChange& change = own->late.equivalents.front();
    cell.value = 100.0 * change.change;
    cell.shown = fmt::format("{} of {}", percentText(change.change), plainSymbol(change.constant));
  }
  return cell;
}

/// The first alarm of an engine against the reference, or null.
const AlarmRow* alarmOf(const CompareResults& results, const std::string& engine) {
  const auto found = std::ranges::find_if(results.endpoints.alarms, [&](const AlarmRow& alarm) {
    return alarm.a == referenceOf(results) && alarm.b == engine;
  });
  return found == results.endpoints.alarms.end() ? nullptr : &*found;
}

/// On how many packings the two are in different regimes: means are of different states there.
std::size_t otherRegime(const CompareResults& results, const std::string& a, const std::string& b) {
  for (const RegimesOfPair& pair : results.regimes)
    if ((pair.a == a && pair.b == b) || (pair.a == b && pair.b == a)) return pair.differ.size();
  return 0;
}

OverviewCell averagesOf(const CompareResults& results, const EngineRow& engine) {
  const std::string& reference = referenceOf(results);
  const Endpoints& rows = results.endpoints.rows;
  if (const auto own = rowsOf(rows, closedFormName, engine.name); !own.empty()) {
    const EndpointRow* worst = worstOf(own);
    OverviewCell cell = endpointCell(*worst, isModelDifference(results, engine));
    cell.words += " by the closed form";
    return cell;
  }
  if (engine.name == reference)
    return {Verdict::notApplicable, {}, "margins", {}, "the reference", {}};
  if (const auto* own = surrogateBy(results.endpoints.surrogates, engine.name)) {
    const EndpointRow* worst = worstOf(rowsOf(rows, reference, own->engine));
    OverviewCell cell = worst ? endpointCell(results, *worst) : OverviewCell{};
    cell.words = "surrogate of " + own->engine;
    return cell;
  }
  const EndpointRow* worst = worstOf(rowsOf(rows, reference, engine.name));
  if (!worst) return {Verdict::notMeasured, {}, "margins", {}, "not compared with it", {}};
  OverviewCell cell = endpointCell(results, *worst);
  if (const AlarmRow* const alarm = alarmOf(results, engine.name)) {
    cell.verdict = Verdict::fail;
    cell.words = "ALARM: " + alarm->what;
  }
  if (const std::size_t packings = otherRegime(results, reference, engine.name); packings > 0)
    cell.words += fmt::format("; on {} in another regime", counted(packings, "packing"));
  return cell;
}

OverviewCell costOfEngine(const EngineRuns& engine) {
  OverviewCell cell{Verdict::notMeasured, costOf(engine).cpuPerSecond(), "s", {}, {}, "engines"};
  if (!cell.value) return cell;
  cell.verdict = std::nullopt;
  cell.shown = shortDuration(cell.value);
  return cell;
}

/// Endpoints that lack a packing, as one of both has no value on it.
std::size_t endpointsWithoutValue(const CompareResults& results, const std::string& engine) {
  return static_cast<std::size_t>(
      std::ranges::count_if(results.endpoints.rows, [&](const EndpointRow& row) {
        return row.lost > 0 && row.b == engine && row.a == referenceOf(results);
      }));
}

OverviewCell failedRunsOf(const CompareResults& results, const EngineRuns& engine) {
  OverviewCell cell{Verdict::notApplicable, {}, "runs", {}, {}, "packings"};
  if (engine.status != Status::finished && engine.runs.empty()) {
    if (engine.status == Status::failed) cell.verdict = Verdict::fail;
    cell.shown = engine.status == Status::refused ? "refused" : "failed";
    cell.words = engine.reason;
    return cell;
  }
  if (engine.runs.empty()) return cell;
  const std::size_t failed = engine.runs.size() - engine.finished.size();
  cell.value = static_cast<double>(failed);
  cell.shown = fmt::format("{} of {}", failed, engine.runs.size());
  cell.verdict = failed > 0 ? Verdict::fail : Verdict::pass;
  if (const std::size_t endpoints = endpointsWithoutValue(results, engine.name);
      failed == 0 && endpoints > 0) {
    cell.verdict = Verdict::borderline;
    cell.words = fmt::format("{} without a value somewhere", counted(endpoints, "endpoint"));
  }
  return cell;
}

}  // namespace

const EndpointRow* worstOf(const std::vector<const EndpointRow*>& rows) {
  const auto size = [](const EndpointRow& row) {
    return std::abs(finite(row.distance).value_or(0.0));
  };
  const EndpointRow* worst = nullptr;
  for (const EndpointRow* row : rows)
    if (!worst || std::pair(row->verdict, size(*row)) > std::pair(worst->verdict, size(*worst)))
      worst = row;
  return worst;
}

OverviewCell endpointCell(const EndpointRow& row, bool isModel) {
  OverviewCell cell{row.verdict, finite(row.distance),        "margins",
                    {},          endpointWords(row.endpoint), "agreement"};
  if (isModel && row.verdict == Verdict::fail) cell.verdict = Verdict::modelDifference;
  if (cell.value) cell.shown = readable(cell.value) + " margins";
  return cell;
}

OverviewCell endpointCell(const CompareResults& results, const EndpointRow& row) {
  // Both sides have to be true to their laws: a fault of one of them is no model difference.
  const auto isTrue = [&](const std::string& name) {
    const auto engine = std::ranges::find(results.engines, name, &EngineRow::name);
    if (engine == results.engines.end()) return name == medianName;
    return name == referenceOf(results) || isModelDifference(results, *engine);
  };
  const bool isModel = row.kind != PairKind::mirrorImplementation && isTrue(row.a) && isTrue(row.b);
  OverviewCell cell = endpointCell(row, isModel);
  const bool alarmed = std::ranges::any_of(results.endpoints.alarms, [&](const AlarmRow& alarm) {
    return alarm.a == row.a && alarm.b == row.b;
  });
  if (alarmed && row.verdict == Verdict::fail) cell.verdict = Verdict::fail;
  if (results.nothingJudged) {
    cell.verdict = Verdict::notMeasured;
    cell.words += ", not judged";
  }
  return cell;
}

std::vector<std::string> disagreementsWithMirror(const CompareResults& results,
                                                 const std::string& engine) {
  std::vector<std::string> endpoints;
  for (const EndpointRow& row : results.endpoints.rows)
    if (row.kind == PairKind::mirrorImplementation && row.b == engine &&
        row.verdict == Verdict::fail)
      endpoints.push_back(row.endpoint);
  return endpoints;
}

bool isModelDifference(const CompareResults& results, const EngineRow& engine) {
  if (!engine.mirrors.empty()) return true;
  if (!disagreementsWithMirror(results, engine.name).empty()) return false;
  if (const auto* const own = spotCheckedEngine(results.endpoints.surrogates, engine.name);
      own && verdictOf(*own) != Verdict::pass)
    return false;
  if (results.lockstep)
    for (const LockstepRow& row : results.lockstep->rows)
      if (row.engine == engine.name && row.verdict != Equivalence::notMeasured &&
          row.verdict != Equivalence::undecided)
        return row.verdict != Equivalence::differs;
  const Endpoints& endpoints = results.endpoints.rows;
  const std::string& reference = referenceOf(results);
  for (const EngineRow& mirror : results.engines) {
    if (mirror.mirrors != engine.name) continue;
    bool disagrees = false;
    for (const EndpointRow* row : rowsOf(endpoints, reference, engine.name)) {
      if (row->verdict != Verdict::fail) continue;
      disagrees = true;
      const EndpointRow* own = rowOf(endpoints, mirror.name, engine.name, row->endpoint);
      if (!own || own->verdict != Verdict::pass) return false;
    }
    return disagrees;
  }
  return false;
}

Overview compareOverview(const CompareResults& results) {
  Overview overview;
  if (results.engines.empty()) return overview;
  const bool closed = !closedFormEngines(results.endpoints.rows).empty();
  overview.columns = {
      {"law verified",
       "Does the engine have the law that it declares? Its difference from its mirror, step by "
       "step, in units of the limit.",
       results.lockstep ? "lockstep" : ""},
      {closed ? "closed forms" : "largest difference from " + referenceWords(results),
       closed ? "The endpoint farthest from its expected value, in margins."
              : "The worst endpoint, as its distance from the reference in margins.",
       results.endpoints.rows.empty() ? "" : "agreement"},
      {"CPU time per simulated second", "Of stepping alone.", "engines"},
      {"failed runs", "Packings that the engine did not finish.", "packings"}};
  overview.states = {{Verdict::fail, "disagrees, or failed"}};
  for (const EngineRuns& engine : engineRuns(results))
    overview.rows.push_back({engine.name,
                             true,
                             {lockstepOf(results, engine), averagesOf(results, engine),
                              costOfEngine(engine), failedRunsOf(results, engine)}});
  overview.conclusion = compareConclusion(results);
  return overview;
}

}  // namespace crossgrain::reports
