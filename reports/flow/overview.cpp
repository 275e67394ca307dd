#include "reports/flow/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <tuple>
#include <utility>
#include <vector>

#include "reports/common/engines.hpp"
#include "reports/flow/endpoint_text.hpp"
#include "reports/lockstep/report.hpp"

namespace crossgrain::reports {

namespace {

/// Endpoints in which an engine and its own mirror disagree: these have one law.
Names disagreementsWithMirror(const CompareResults& results, const std::string& engine) {
  Names endpoints;
  for (const EndpointRow& row : results.endpoints.rows)
    if (row.kind == PairKind::mirrorImplementation && row.b == engine &&
        row.verdict == Verdict::fail)
      endpoints.push_back(row.endpoint);
  return endpoints;
}

/// Names in a sentence.
constexpr std::size_t mostNames = 3;

Names endpointsWith(const std::vector<const EndpointRow*>& rows, Verdict verdict) {
  Names names;
  for (const EndpointRow* row : rows)
    if (row->verdict == verdict) names.push_back(endpointWords(row->endpoint));
  return names;
}

/// "pressure (643 instead of 206 N/m²)": those that disagree, with their values.
Names disagreements(const std::vector<const EndpointRow*>& rows) {
  Names names;
  for (const EndpointRow* row : rows) {
    if (row->verdict != Verdict::fail) continue;
    names.push_back(endpointWords(row->endpoint));
    if (!finite(row->value())) continue;
    const auto [value, reference] = readablePair(row->value(), row->reference);
    names.back() += fmt::format(" ({} instead of {}{})", value, reference,
                                row->unit == "-" ? "" : " " + row->unit);
  }
  return names;
}

/// "disagreed on pressure (643 instead of 206 N/m²), agreed on 6 of 9 endpoints and left 2
/// undecided"; of one pair.
std::string relationOf(const std::vector<const EndpointRow*>& rows) {
  const Names disagree = disagreements(rows), borderline = endpointsWith(rows, Verdict::borderline),
              undecided = endpointsWith(rows, Verdict::undecided),
              absent = endpointsWith(rows, Verdict::notMeasured);
  const std::size_t agree =
      rows.size() - disagree.size() - borderline.size() - undecided.size() - absent.size();
  // The first count has the total.
  const auto some = [&](std::size_t count, bool first) {
    return count == rows.size() ? allOf(count, "endpoint")
           : first              ? fmt::format("{} of {} endpoints", count, rows.size())
                                : fmt::format("{}", count);
  };
  Names parts;
  if (!disagree.empty()) parts.push_back("disagreed on " + listedShortly(disagree, mostNames));
  if (!borderline.empty())
    parts.push_back("came out borderline on " + listedShortly(borderline, mostNames));
  if (agree > 0) parts.push_back("agreed on " + some(agree, true));
  if (!undecided.empty())
    parts.push_back(fmt::format("left {} undecided", some(undecided.size(), agree == 0)));
  if (!absent.empty())
    parts.push_back("could not be compared on " + listedShortly(absent, mostNames));
  return listed(parts);
}

std::string agreementWith(const CompareResults& results, const std::string& a, const char* called,
                          const Names& names) {
  SaidOf said;
  for (const std::string& name : names)
    said.add(name, relationOf(rowsOf(results.endpoints.rows, a, name)));
  return fmt::format("Against {}: {}.", called, said.joined("{} {}"));
}

/// The same in counts, with the names of those that disagreed on most.
std::string countsWith(const CompareResults& results, const std::string& a, const char* called,
                       const Names& names) {
  const std::size_t endpoints = endpointsOf(results.endpoints.rows).size();
  std::size_t agreed = 0;
  std::vector<std::pair<std::size_t, std::string>> disagreed;  // on how many
  for (const std::string& name : names) {
    const auto rows = rowsOf(results.endpoints.rows, a, name);
    agreed += endpointsWith(rows, Verdict::pass).size() == endpoints;
    if (const std::size_t count = endpointsWith(rows, Verdict::fail).size(); count > 0)
      disagreed.emplace_back(count, name);
  }
  std::ranges::stable_sort(disagreed, std::greater<>(), [](const auto& one) { return one.first; });
  Names worst;
  for (const auto& [count, name] : disagreed) worst.push_back(fmt::format("{} on {}", name, count));
  std::string text = fmt::format("Against {}: {} of {} engines agreed on {}", called, agreed,
                                 names.size(), allOf(endpoints, "endpoint"));
  if (const std::size_t open = names.size() - agreed - disagreed.size(); open > 0)
    text += fmt::format("; {} left some borderline, undecided or absent", open);
  if (!worst.empty())
    text +=
        fmt::format("; {} disagreed on some: {}", worst.size(), listedShortly(worst, mostNames));
  return text + ".";
}

/// Who agrees with the closed forms, where the case has them, else with the reference, on what.
std::string whoAgrees(const CompareResults& results, const Engines& engines, bool inCounts) {
  const auto agreement = inCounts ? countsWith : agreementWith;
  const Endpoints& rows = results.endpoints.rows;
  if (const Names judged = closedFormEngines(rows); !judged.empty())
    return agreement(results, closedFormName, "the closed forms", judged);
  const Names peers = peersOf(results, engines);
  if (peers.empty()) return "No two engines could be compared.";
  return agreement(results, referenceOf(results), referenceWords(results).c_str(), peers);
}

bool disagrees(const CompareResults& results, const EngineRuns& engine) {
  return std::ranges::any_of(rowsOf(results.endpoints.rows, referenceOf(results), engine.name),
                             [](const EndpointRow* row) { return row->verdict == Verdict::fail; });
}

const LockstepRow* differingRow(const CompareResults& results, const std::string& engine) {
  if (!results.lockstep) return nullptr;
  return findIf(results.lockstep->rows, [&](const LockstepRow& row) {
    return row.engine == engine && row.verdict == Equivalence::differs;
  });
}

/// Of how many of its runs, averaged from files, the forces are not those of the case's law.
std::ptrdiff_t runsOfOtherLaw(const EngineRuns& engine) {
  return std::ranges::count_if(engine.finished, &FlowRun::hasOtherLaw);
}

std::string whoseFilesHaveAnotherLaw(const Engines& engines) {
  Names parts;
  for (const EngineRuns& engine : engines)
    if (const auto others = runsOfOtherLaw(engine); others > 0)
      parts.push_back(
          fmt::format("{} of {} runs of {}", others, engine.finished.size(), engine.name));
  return parts.empty()
             ? ""
             : fmt::format("Forces in {} are not those of the case's law: the notes say where.",
                           listedShortly(parts, mostNames));
}

/// Engines that do not have their own law, and those whose differences nothing measures.
std::string causesOfDifferences(const CompareResults& results, const Engines& engines) {
  Names parts;
  for (const EngineRuns& engine : engines) {
    if (!engine.mirrors.empty()) continue;
    if (const LockstepRow* row = differingRow(results, engine.name)) {
      const bool open = !openInLaw(*row, results.lockstep->rules).empty();
      parts.push_back(
          open
              ? fmt::format("{} differs from its mirror where disks touch several at once, which "
                            "its law leaves open",
                            engine.name)
              : fmt::format(
                    "{} does not have the law that it declares{}", engine.name,
                    row->term ? " (deviation found: " + constantWords(row->term->name) + ")" : ""));
      continue;
    }
    if (const auto* const own = spotCheckedEngine(results.endpoints.surrogates, engine.name);
        own && verdictOf(*own) == Verdict::fail) {
      parts.push_back(fmt::format("{} does not have the law that it declares late in its own run",
                                  engine.name));
      continue;
    }
    if (const Names endpoints = disagreementsWithMirror(results, engine.name); !endpoints.empty()) {
      Names words;
      for (const std::string& endpoint : endpoints) words.push_back(endpointWords(endpoint));
      parts.push_back(fmt::format("{} disagrees with its own mirror in {}", engine.name,
                                  listedShortly(words, mostNames)));
      continue;
    }
    if (engine.name == referenceOf(results) || !disagrees(results, engine)) continue;
    // Measured causes say more.
    if (findBy(results.causes, engine.name, &PairCauses::b)) continue;
    parts.push_back(isModelDifference(results, engine)
                        ? engine.name + " differs by the law that it declares"
                        : fmt::format("no mirror shows whether the difference of {} comes from its "
                                      "law or its implementation",
                                      engine.name));
  }
  if (parts.empty()) return {};
  return fmt::format("Causes of differences: {}.", listedShortly(parts, mostNames));
}

/// Peers' undecided endpoint that takes the fewest packings, by the estimates of the rows: one
/// against the reference, whose pairs the matrix shows, if any of them is open.
const EndpointRow* nextToDecide(const CompareResults& results) {
  const std::string& reference = referenceOf(results);
  const auto rank = [&](const EndpointRow& row) {
    return std::tuple(row.a != reference && row.b != reference, !row.needs, row.needs.value_or(0));
  };
  const EndpointRow* next = nullptr;
  for (const EndpointRow& row : results.endpoints.rows)
    if (row.kind == PairKind::peer && row.verdict == Verdict::undecided &&
        (!next || rank(row) < rank(*next)))
      next = &row;
  return next;
}

/// Number of an engine's runs that are averaged from files; 0 of one that crossgrain runs.
std::size_t runsFromFiles(const Engines& engines, const std::string& name) {
  const EngineRuns* const engine = findBy(engines, name, &EngineRuns::name);
  const bool ofFiles = engine && !engine->finished.empty() && engine->finished.front()->ofFiles();
  return ofFiles ? engine->finished.size() : 0;
}

/// Advice where runs from files widen an interval most; empty where crossgrain's own do.
std::string moreRunsOfFiles(const EndpointRow& row, const Engines& engines) {
  const std::size_t a = runsFromFiles(engines, row.a), b = runsFromFiles(engines, row.b);
  if (a == 0 && b == 0) return {};
  const bool known = row.unpaired && row.unpaired->shareOfA;
  if (!known && a > 0 && b > 0)
    return fmt::format("Next: more runs of {} and of {}, whose files hold {} and {}.", row.b, row.a,
                       b, a);
  const double shareOfA = known ? row.unpaired->shareOfA.value_or(0.0) : a > 0 ? 1.0 : 0.0;
  const bool ofA = findBy(engines, row.a, &EngineRuns::name) && shareOfA > 0.5;
  if ((ofA ? a : b) == 0) return {};
  const std::string why =
      known ? fmt::format(": {:.0f} % of the variance of the difference in {} is theirs",
                          100.0 * (ofA ? shareOfA : 1.0 - shareOfA), endpointWords(row.endpoint))
            : "";
  return fmt::format("Next: more runs of {}, whose files hold {}{}.", ofA ? row.a : row.b,
                     ofA ? a : b, why);
}

/// Advice on values that are beyond margins. One law for both helps where causes do not show that
/// they have it; a closed form may be missed by the step or the iterations.
std::string afterDisagreement(const CompareResults& results) {
  const bool withClosedForms = !closedFormEngines(results.endpoints.rows).empty();
  const bool oneLaw =
      !results.causes.empty() && std::ranges::all_of(results.causes, [](const PairCauses& pair) {
        return pair.reason.empty() && pair.differences.empty();
      });
  return fmt::format(
      "Next: compare the margins with the accuracy that is needed{}.",
      withClosedForms ? ", or see by crossgrain cost what smaller steps or more iterations change"
      : oneLaw        ? ""
                      : ", or give both the same law");
}

std::string nextStep(const CompareResults& results, const Engines& engines) {
  if (results.nothingJudged)
    return fmt::format("Nothing was judged: {}.", results.nothingJudged->reason);
  for (const EngineRuns& engine : engines)
    if (engine.status == Status::failed || engine.finished.size() < engine.runs.size())
      return fmt::format("Next: see why {} did not finish, under “What did not run”.", engine.name);
  for (const AlarmRow& alarm : results.endpoints.alarms)
    return fmt::format("Next: see the alarm on {}: {}.", alarm.b, alarm.what);
  const auto has = [&](Verdict verdict) {
    return std::ranges::any_of(results.endpoints.rows, [&](const EndpointRow& row) {
      return (row.kind == PairKind::peer || row.kind == PairKind::closedForm) &&
             row.verdict == verdict;
    });
  };
  for (const EndpointRow& row : results.endpoints.rows)
    if (row.verdict == Verdict::undecided && !row.reason.empty() &&
        (row.packings == 0 || row.kind == PairKind::closedForm))
      return fmt::format("Next: {} has no value to judge: {}.", endpointWords(row.endpoint),
                         row.reason);
  if (closedFormEngines(results.endpoints.rows).empty() && peersOf(results, engines).empty())
    return "Next: name two engines that run this scene.";
  if (const EndpointRow* const next = nextToDecide(results)) {
    if (const std::string more = moreRunsOfFiles(*next, engines); !more.empty()) return more;
    const InterimFindings& looks = results.endpoints.looks;
    const bool planned = looks.taken < looks.planned.size();
    return fmt::format(
        "Next: more packings{}; {}.",
        next->needs ? fmt::format(", about {} for the {} of {} against {}", *next->needs,
                                  endpointWords(next->endpoint), next->b, called(next->a))
                    : "",
        planned ? "the same command with a larger --budget adds them"
                : "the case plans no further interim analysis ([looks] in its file)");
  }
  if (has(Verdict::fail)) return afterDisagreement(results);
  if (has(Verdict::borderline))
    return "More packings will hardly change what is borderline: its difference is about the "
           "margin.";
  return "Nothing is left to decide at these margins.";
}

OverviewCell lawOf(const CompareResults& results, const EngineRuns& engine) {
  if (const auto others = runsOfOtherLaw(engine); others > 0)
    return {Verdict::modelDifference,
            {},
            "",
            fmt::format("in {} of {} runs", others, engine.finished.size()),
            "forces are not those of the case's law",
            "notes"};
  static const LockstepFindings none;
  const LockstepFindings& findings = results.lockstep ? *results.lockstep : none;
  OverviewCell cell = lockstepCell(findBy(findings.rows, engine.name, &LockstepRow::engine),
                                   findings.rules, !engine.mirrors.empty());
  if (engine.name == inHouse() && cell.verdict == Verdict::notMeasured)
    cell.words = "its own mirror";
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
  return findIf(results.endpoints.alarms, [&](const AlarmRow& alarm) {
    return alarm.a == referenceOf(results) && alarm.b == engine;
  });
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
  if (const std::string cause = largestCause(results, *worst); !cause.empty())
    cell.words += ", most by " + cause;
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
  if (engine.isSingle && !engine.surrogate.empty())
    cell.words = "the packings are run by " + engine.surrogate;
  if (const std::size_t endpoints = endpointsWithoutValue(results, engine.name);
      failed == 0 && endpoints > 0) {
    cell.verdict = Verdict::borderline;
    cell.words = fmt::format("{} without a value somewhere", counted(endpoints, "endpoint"));
  }
  return cell;
}

}  // namespace

Names compareConclusion(const CompareResults& results, bool brief) {
  const Engines engines = engineRuns(results);
  if (engines.empty()) return {};
  constexpr std::size_t fewPeers = 4, mostCauses = 3;
  const bool cut = brief && peersOf(results, engines).size() > fewPeers;
  Names causes = {whoseFilesHaveAnotherLaw(engines), causesOfDifferences(results, engines)};
  std::ranges::move(causeSentences(results, 2), std::back_inserter(causes));
  causes = nonEmpty(std::move(causes));
  if (cut && causes.size() > mostCauses) {
    const std::size_t more = causes.size() - mostCauses;
    causes.resize(mostCauses);
    causes.push_back(
        fmt::format("… and {} on causes: in the report", counted(more, "more sentence")));
  }
  // Where nothing was judged, no engine is said to agree, or to be undecided.
  Names sentences = {results.nothingJudged ? std::string() : whoAgrees(results, engines, cut)};
  std::ranges::move(causes, std::back_inserter(sentences));
  sentences.push_back(nextStep(results, engines));
  return nonEmpty(std::move(sentences));
}

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
    const EngineRow* const engine = findBy(results.engines, name, &EngineRow::name);
    if (!engine) return name == medianName;
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
                             {lawOf(results, engine), averagesOf(results, engine),
                              costOfEngine(engine), failedRunsOf(results, engine)}});
  const Engines engines = engineRuns(results);
  if (std::ranges::any_of(engines, [](const auto& one) { return runsOfOtherLaw(one) > 0; })) {
    const bool declared = std::ranges::any_of(overview.rows, [](const OverviewRow& row) {
      return std::ranges::find(row.cells.begin() + 1, row.cells.end(), Verdict::modelDifference,
                               &OverviewCell::verdict) != row.cells.end();
    });
    overview.states.push_back(
        {Verdict::modelDifference,
         std::string("result files of another law than the case's, not checked by any "
                     "declaration") +
             (declared ? "; elsewhere: true to the law that it declares" : "")});
  }
  overview.conclusion = compareConclusion(results);
  return overview;
}

}  // namespace crossgrain::reports
