#include "studies/flow/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>

#include "averaging/fields.hpp"
#include "cases/flow.hpp"
#include "results/lockstep_text.hpp"
#include "results/schema.hpp"
#include "studies/core/study.hpp"
#include "studies/flow/agreement_table.hpp"
#include "studies/flow/campaign.hpp"
#include "studies/flow/causes.hpp"
#include "studies/flow/ensemble.hpp"
#include "studies/flow/interim_analyses.hpp"
#include "studies/flow/lockstep_job.hpp"
#include "studies/flow/notes.hpp"
#include "studies/lockstep/rules.hpp"
#include "support/numbers.hpp"

namespace crossgrain::inline studies {

namespace {

/// One alone has nothing to be compared with, and is not run where others are refused.
constexpr std::size_t fewestToCompare = 2;

/// Those whose implementation is in question: not what mirrors are made of, nor mirrors themselves.
bool hasMirror(const EngineEntry& entry) {
  return entry.mirrors.empty() && !entry.ofFiles() && entry.name != engineRegistry().front().name;
}

}  // namespace

std::optional<NothingJudged> nothingJudged(const Case& setup, std::span<const EndpointRow> rows,
                                           std::size_t named) {
  const auto judged = [](const EndpointRow& row) {
    return row.kind == PairKind::closedForm && row.verdict != Verdict::undecided;
  };
  if (std::ranges::any_of(rows, judged)) return std::nullopt;
  if (hasClosedForms(setup))
    return NothingJudged{"no engine has a value that comes back when its one start is run again"};
  if (named < 2) return NothingJudged{"one engine has nothing to be compared with", true};
  if (setup.averaging.endpoints.empty())
    return NothingJudged{!cellOf(setup) ? "the case has no [[endpoints]]"
                                        : "the case has no [averaging.endpoints]"};
  constexpr int fewest = 4;  // of packings, for any test
  int endpoints = 0, most = 0;
  for (const EndpointRow& row : rows) {
    if (row.kind != PairKind::peer) continue;
    ++endpoints;
    most = std::max(most, row.packings);
  }
  if (endpoints == 0)
    return NothingJudged{"no two engines finished a run that shows an endpoint with a margin"};
  if (most == 0) return NothingJudged{"no endpoint has a value on two engines"};
  if (most >= fewest) return std::nullopt;
  const auto hasInterval = [](const EndpointRow& row) { return row.unpaired && row.low; };
  if (std::ranges::any_of(rows, hasInterval)) return std::nullopt;
  const auto single = [](const EndpointRow& row) {
    return row.unpaired && row.unpaired->basis == Basis::oneRunEach;
  };
  if (std::ranges::any_of(rows, single))
    return NothingJudged{"a single run of each has no error of its own: too short, or at rest"};
  return NothingJudged{fmt::format("{} of each engine, and a verdict needs at least {}",
                                   counted(static_cast<std::size_t>(most), "packing"), fewest)};
}

namespace {

constexpr const char* noReference = "none";

/// The command with the reference first. @throws BadInput for one that is not among the engines
RunCommand commandOf(const StudyWork& work, const CompareOptions& own) {
  RunCommand command = work.line.run;
  if (!own.reference || *own.reference == noReference) return command;
  const auto found = std::ranges::find(command.engines, *own.reference);
  if (found == command.engines.end())
    throw BadInput(fmt::format("--reference {}: it is not among --engines {}; or none",
                               *own.reference, fmt::join(command.engines, ",")));
  std::rotate(command.engines.begin(), found, found + 1);
  return command;
}

/// Each against the median of the others takes three, of as many runs each.
void beNeutral(Campaign& campaign) {
  std::size_t able = 0;
  std::set<int> runs;
  for (std::size_t e = 0; e < campaign.engines().size(); ++e) {
    if (!campaign.refusal(e).empty()) continue;
    ++able;
    runs.insert(campaign.engines()[e].ofFiles() ? campaign.runsOf(e) : campaign.packingCount());
  }
  if (able < 3)
    throw BadInput(fmt::format(
        "--reference none: the median of the others takes three engines that can run the case, "
        "here {}",
        able == 1 ? "is one" : fmt::format("are {}", able)));
  if (runs.size() > 1)
    throw BadInput(fmt::format(
        "--reference none: all must have as many runs, here are {}: set preparation.packings, or "
        "name as many files of each",
        fmt::join(runs, " and ")));
  campaign.beNeutral();
}

/// Without a reference mirrors have no runs: they would give the in-house engine a say.
std::vector<EngineEntry> enginesOf(const Case& setup, const RunCommand& command,
                                   const CompareOptions& own) {
  if (own.reference != noReference) return enginesFor(setup, command.engines);
  checkEngineSections(setup);
  return selectEngines(command.engines);
}

std::string comparePlan(const StudyWork& work, const CompareOptions& own) {
  const RunCommand command = commandOf(work, own);
  Campaign campaign(work.setup(), command, enginesOf(work.setup(), command, own), work.store);
  campaign.askEngines(fewestToCompare);
  campaign.lookForPackings();
  const std::string causes =
      own.noCauses ? ""
      : own.causes || own.causesOf
          ? "then runs for the causes of all differences that are seen\n"
          : "then runs for causes of differences, in a fifth of the time at most\n";
  return describeDryRun(campaign.planHead() + causes, campaign.plan(campaign.wholeCase()),
                        work.store, command);
}

/// Files that no engine that takes part has made.
std::string neutralNote(const Case& setup, const Campaign& campaign, bool lockstep) {
  const std::string packings =
      campaign.packings().empty() || hasClosedForms(setup) ? ""
      : packingsAreFiles(setup)                            ? "; packings are files"
      : !cellOf(setup) ? "; packings are random, of the case's seeds"
                       : "; packings are made by " + (couetteIn(setup).filling.engine.empty()
                                                          ? engineRegistry().front().name
                                                          : couetteIn(setup).filling.engine);
  return fmt::format(
      "No engine is the reference: each is compared with the median of the others{}{}.", packings,
      lockstep ? "; laws are verified by the in-house engine under each one's conventions" : "");
}

/// Of all time, for causes.
constexpr double shareOfCauses = 0.2;

void addCauses(CompareResults& results, Campaign& campaign, const Case& setup,
               const RunCommand& command, const CompareOptions& own, double budget) {
  if (results.nothingJudged) return;
  if (own.noCauses) {
    results.notes.emplace_back("Causes of differences were not measured (--no-causes).");
    return;
  }
  const double until = own.causes || own.causesOf
                           ? std::numeric_limits<double>::infinity()
                           : std::min(budget, campaign.elapsed() / (1.0 - shareOfCauses));
  UndeclaredTerms undeclared;
  if (results.lockstep)
    for (const LockstepRow& row : results.lockstep->rows)
      if (row.verdict == Equivalence::differs && row.term) undeclared[row.engine] = *row.term;
  results.causes = causesOfPairs(campaign, setup, command, results.endpoints, until, undeclared,
                                 own.causesOf.value_or(""));
  if (results.causes.empty() && (own.causes || own.causesOf))
    results.notes.emplace_back(
        !campaign.isNeutral()
            ? "No causes were measured: no endpoint shows a difference between two engines."
        : std::ranges::any_of(results.endpoints.rows,
                              [](const EndpointRow& row) {
                                return row.a == medianName && row.distance.has_value();
                              })
            ? "No causes were measured: no engine shows a difference from the median of the others."
            : "No causes were measured: no median of the others has a value to differ from.");
  results.elapsed = campaign.elapsed();
}

CompareResults compare(const StudyWork& work, const CompareOptions& own) {
  const Case& setup = work.setup();
  const RunCommand command = commandOf(work, own);
  const std::size_t starts = work.line.quick ? quickLockstepStarts : lockstepStarts;
  // The case's own is of further analyses alone, as its verdicts do not depend on the machine.
  const double hard = own.budget ? secondsOf(*own.budget) : std::numeric_limits<double>::infinity();
  const double budget = own.budget ? hard : setup.looks.budget;
  Campaign campaign(setup, command, enginesOf(setup, command, own), work.store);
  campaign.askEngines(fewestToCompare);
  if (own.reference == noReference) beNeutral(campaign);
  campaign.preparePackings();
  LockstepFindings lockstep;
  if (setup.run.mirrors) lockstep = lockstepOf(campaign, setup, command, starts, hasMirror, hard);
  for (const LockstepRow& row : lockstep.rows) {  // the first verdicts; runs take longer
    const std::string all = describe(row, lockstep.rules);
    campaign.progress().say("lockstep: " + all.substr(0, all.find(';')));
  }
  campaign.timeEngines();
  EndpointFindings endpoints = runWithInterims(setup, campaign, command, lockstep, budget);
  CompareResults results{campaign.study(kindCompare), {}, {}, {}, {}, {}, {}, {}, {}};
  if (!lockstep.rows.empty()) results.lockstep = std::move(lockstep);
  std::vector<std::string> names;
  for (const EngineRow& engine : results.engines) names.push_back(engine.name);
  const auto pairs = pairsOf(campaign, command.engines, endpoints.surrogates);
  results.regimes = regimesOf(results.runs, pairs, endpoints.surrogates);
  results.agreement = agreementOf(setup, results.runs, pairs, endpoints.surrogates);
  results.steadiness = steadinessOf(results.runs, names, setup.averaging.confidence);
  results.ensemble = ensembleOf(results.runs, names);
  if (campaign.packings().size() > 1)  // the report shows means; runs/ has each packing's
    for (FlowRun& run : results.runs)
      if (!run.ofFiles()) run.distributions.clear();
  results.endpoints = std::move(endpoints);
  results.endpoints.alarms = alarmsOf(setup, results);
  const auto named = std::ranges::count_if(campaign.engines(), [&](const EngineEntry& entry) {
    return entry.mirrors.empty() || isNamed(command.engines, entry);
  });
  results.nothingJudged =
      nothingJudged(setup, results.endpoints.rows, static_cast<std::size_t>(named));
  if (const auto& nothing = results.nothingJudged)
    results.notes.push_back(fmt::format("Nothing was judged: {}.", nothing->reason));
  if (campaign.isNeutral()) {
    results.endpoints.reference = medianName;
    results.notes.push_back(neutralNote(setup, campaign, results.lockstep.has_value()));
  }
  std::ranges::move(fileNotes(results), std::back_inserter(results.notes));
  std::ranges::move(velocityNotes(results), std::back_inserter(results.notes));
  std::ranges::move(contactNotes(results), std::back_inserter(results.notes));
  addCauses(results, campaign, setup, command, own, hard);
  return results;
}

std::vector<Case> caseToCompare(const CommandLine& line, CompareOptions& own) {
  const Case setup = onlyFlow(line, {.command = "compare", .sharesConventions = true});
  printWarnings(setup);
  if (own.budget) secondsOf(*own.budget);  // throws for what is none
  if (own.causesOf && !findField(*own.causesOf))
    throw BadInput(fmt::format("--causes-of {}: there is no such field (crossgrain list fields)",
                               *own.causesOf));
  return {setup};
}

/// "ours and theirs: pressure, spin": endpoints of engines that the user named with that verdict.
std::vector<std::string> endpointsWith(const CompareResults& results, Verdict verdict) {
  std::vector<std::pair<std::string, std::vector<std::string>>> of;  // by pair
  for (const EndpointRow& row : results.endpoints.rows) {
    const bool expected = row.kind == PairKind::closedForm;
    if (row.verdict != verdict || (row.kind != PairKind::peer && !expected)) continue;
    const std::string pair =
        expected ? row.b + " and the expected value" : fmt::format("{} and {}", row.a, row.b);
    auto found = std::ranges::find(of, pair, [](const auto& entry) { return entry.first; });
    if (found == of.end()) found = of.insert(of.end(), {pair, {}});
    found->second.push_back(row.endpoint);
  }
  std::vector<std::string> clauses;
  for (const auto& [pair, endpoints] : of)
    clauses.push_back(fmt::format("{}: {}", pair, fmt::join(endpoints, ", ")));
  return clauses;
}

/// Findings that make engines disagree, and with --strict what is left open. Another law than it
/// declares is a disagreement, whatever averages make of it.
std::vector<std::string> failsOf(const CompareResults& results, std::size_t refused, bool strict) {
  std::vector<std::string> fails;
  const auto add = [&](const char* what, const std::vector<std::string>& who) {
    if (!who.empty()) fails.push_back(fmt::format("{} ({})", what, firstOf(who, "; ")));
  };
  // Where a law leaves open what parts an engine from its mirror, that is borderline.
  const auto lockstepWith = [&](Equivalence verdict, bool borderline) {
    std::vector<std::string> names;
    if (!results.lockstep) return names;
    for (const LockstepRow& row : results.lockstep->rows)
      if (row.verdict == verdict && openInLaw(row, results.lockstep->rules).empty() != borderline)
        names.push_back(row.engine);
    return names;
  };
  std::vector<std::string> alarms;
  for (const AlarmRow& alarm : results.endpoints.alarms)
    if (alarm.kind == PairKind::peer) alarms.push_back(fmt::format("{} and {}", alarm.a, alarm.b));
  add("engines disagree", endpointsWith(results, Verdict::fail));
  add("an alarm: engines differ in what no margin excuses", alarms);
  std::vector<std::string> differing = lockstepWith(Equivalence::differs, false), undecided;
  for (const SurrogateEngine& own : results.endpoints.surrogates) {
    if (verdictOf(own) == Verdict::fail) differing.push_back(own.engine + ", late in its own run");
    if (verdictOf(own) == Verdict::undecided) undecided.push_back(own.engine);
  }
  add("an engine differs from the law that it declares", differing);
  if (!strict) return fails;
  add("--strict: borderline", endpointsWith(results, Verdict::borderline));
  add("--strict: undecided", endpointsWith(results, Verdict::undecided));
  add("--strict: absent", endpointsWith(results, Verdict::notMeasured));
  std::ranges::move(lockstepWith(Equivalence::undecided, false), std::back_inserter(undecided));
  add("--strict: an engine's law is undecided", undecided);
  add("--strict: an engine's law is borderline: the law of rigid disks leaves open what parts it "
      "from its mirror",
      lockstepWith(Equivalence::differs, true));
  if (refused > 0) fails.push_back("--strict: an engine was refused");
  return fails;
}

/// Only the verdicts on engines that the user named decide.
Outcome outcomeOfCompare(const CompareResults& results, const CommandLine& line,
                         const CompareOptions& own) {
  Outcome outcome;
  if (const auto& nothing = results.nothingJudged)
    outcome = notJudged(nothing->reason, (nothing->byRequest || line.quick) && !own.strict);
  for (const FlowRun& run : results.runs)
    if (run.status == Status::failed) outcome.failures.push_back(run.reason);
  const bool failed = !outcome.failures.empty();
  const std::vector<std::string> refused = refusals(results.engines, line.run.engines);
  outcome.failures.insert(outcome.failures.end(), refused.begin(), refused.end());
  outcome.fails = failsOf(results, refused.size(), own.strict);
  if (failed)
    outcome.status = exitEngineFailed;
  else if (!outcome.fails.empty())
    outcome.status = exitFailed;
  return outcome;
}

}  // namespace

const Study<CompareOptions, CompareResults> compareStudy = {
    "compare",
    {.packings = true},
    Keeps::oneCase,
    [](CompareOptions& own, CommandLine&) {
      return std::vector<StudyOption>{
          {"--budget",
           "begin nothing after the first analysis that would end after this time, e.g. 90s, 10m, "
           "1h; lockstep before it ends in that time "
           "(default: looks.budget of the case)",
           &own.budget, "TIME"},
          {"--reference",
           "the engine that the others are compared with, or none: each with the median of the "
           "others (default: the first)",
           &own.reference, "NAME"},
          {"--causes",
           "measure the causes of every difference, however long it takes (default: in a fifth of "
           "the time at most)",
           &own.causes},
          {"--causes-of", "measure the causes of every difference, and of this field's bin by bin",
           &own.causesOf, "FIELD"},
          {"--no-causes", "measure no causes of differences", &own.noCauses},
          {"--strict",
           "status 1 also for undecided and borderline verdicts, for refused engines and where "
           "nothing was judged",
           &own.strict}};
    },
    caseToCompare,
    comparePlan,
    compare,
    outcomeOfCompare,
    {{"--causes", "--no-causes"}, {"--causes-of", "--no-causes"}}};

}  // namespace crossgrain::inline studies
