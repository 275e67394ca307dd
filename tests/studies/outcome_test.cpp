// Exit status of every study, from results made by hand.
#include <gtest/gtest.h>

#include "results/lockstep_text.hpp"
#include "studies/collide/collide.hpp"
#include "studies/conformance/conformance.hpp"
#include "studies/effects/effects.hpp"
#include "studies/flow/compare.hpp"
#include "studies/flow/lockstep_job.hpp"
#include "studies/regression/diff.hpp"
#include "studies/stability/stability.hpp"

namespace {

using namespace crossgrain;

Case judging() {
  Case setup;
  setup.averaging.endpoints["spin_at_wheel"] = {1.0, false, "because", ""};
  return setup;
}

EndpointRow row(PairKind kind, int packings, Verdict answer = Verdict::undecided) {
  return EndpointRow{.kind = kind, .verdict = answer, .packings = packings};
}

using Rows = std::vector<EndpointRow>;

TEST(NothingJudged, OneEngine_IsByRequest) {
  const auto found = nothingJudged(judging(), {}, 1);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->byRequest);
}

TEST(NothingJudged, MissingMarginsPackingsOrRuns_SaysWhich) {
  const auto reason = [](const Case& setup, const Rows& rows) {
    const auto found = nothingJudged(setup, rows, 2);
    EXPECT_FALSE(found && found->byRequest);
    return found ? found->reason : "";
  };
  EXPECT_EQ(reason({}, Rows({row(PairKind::peer, 4)})), "the case has no [averaging.endpoints]");
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::peer, 2), row(PairKind::peer, 1)})),
            "2 packings of each engine, and a verdict needs at least 4");
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::peer, 1)})),
            "1 packing of each engine, and a verdict needs at least 4");
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::mirrorModel, 8)})),
            "no two engines finished a run that shows an endpoint with a margin");
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::peer, 0)})),
            "no endpoint has a value on two engines");
  // Tested and left open is judged.
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::peer, 4)})), "");
}

ExitStatus compared(const CompareResults& results, bool strict = false, bool quick = false) {
  CommandLine line;
  line.run.engines = {"a", "b"};
  line.quick = quick;
  CompareOptions own;
  own.strict = strict;
  return compareStudy.outcome(results, line, own).status;
}

/// Without --strict and with it.
std::pair<ExitStatus, ExitStatus> both(const CompareResults& results) {
  return {compared(results), compared(results, true)};
}

TEST(CompareOutcome, VerdictsOfNamedEngines_Decide) {
  CompareResults results;
  EXPECT_EQ(compared(results), exitPassed);
  const auto with = [&](PairKind kind, Verdict answer) {
    results.endpoints.rows = {row(kind, 8, Verdict::pass), row(kind, 8, answer)};
    return both(results);
  };
  EXPECT_EQ(with(PairKind::peer, Verdict::pass), std::pair(exitPassed, exitPassed));
  EXPECT_EQ(with(PairKind::peer, Verdict::undecided), std::pair(exitPassed, exitFailed));
  EXPECT_EQ(with(PairKind::peer, Verdict::borderline), std::pair(exitPassed, exitFailed));
  EXPECT_EQ(with(PairKind::peer, Verdict::fail), std::pair(exitFailed, exitFailed));
  EXPECT_EQ(with(PairKind::closedForm, Verdict::fail), std::pair(exitFailed, exitFailed));
  EXPECT_EQ(with(PairKind::mirrorModel, Verdict::fail), std::pair(exitPassed, exitPassed));
}

TEST(CompareOutcome, LockstepAlarmsRefusalsAndFailures_Decide) {
  CompareResults results;
  LockstepRow found;
  found.verdict = Equivalence::undecided;
  results.lockstep.emplace().rows = {found};
  EXPECT_EQ(both(results), std::pair(exitPassed, exitFailed));
  results.lockstep->rows.front().verdict = Equivalence::differs;
  EXPECT_EQ(compared(results), exitFailed);
  results.lockstep.reset();
  results.engines = {{"b", "", "", "", Status::refused, "cannot"},
                     {"c", "", "", "", Status::refused, "was not named"}};
  EXPECT_EQ(both(results), std::pair(exitPassed, exitFailed));
  AlarmRow alarm;
  alarm.kind = PairKind::mirrorImplementation;
  results.endpoints.alarms = {alarm};
  EXPECT_EQ(compared(results), exitPassed);
  results.endpoints.alarms.front().kind = PairKind::peer;
  EXPECT_EQ(compared(results), exitFailed);
  FlowRun run{.status = Status::failed, .reason = "broke"};
  results.runs = {run};
  EXPECT_EQ(compared(results), exitEngineFailed);
  CommandLine line;
  line.run.engines = {"a", "b"};
  EXPECT_EQ(compareStudy.outcome(results, line, {}).failures,
            (std::vector<std::string>{"broke", "cannot"}));
}

TEST(CompareOutcome, FaultLateInAnEnginesOwnRun_IsOneOfItsLaw) {
  CompareResults results;
  SurrogateEngine own;
  own.engine = "b";
  own.alarm = "one of both has no pressure";  // something is missing, nothing was seen
  results.endpoints.surrogates = {own};
  EXPECT_EQ(both(results), std::pair(exitPassed, exitPassed));
  results.endpoints.surrogates.front().observed = true;
  EXPECT_EQ(both(results), std::pair(exitPassed, exitFailed));
  results.endpoints.surrogates.front().late.differs = true;
  EXPECT_EQ(both(results), std::pair(exitFailed, exitFailed));
}

/// A law that is only borderline, or not judged at all, and a status 1: the line names the rule.
TEST(CompareOutcome, StatusOne_SaysWhichRuleMadeIt) {
  CompareResults results;
  const auto why = [&](bool strict) {
    CommandLine line;
    line.run.engines = {"a", "b"};
    CompareOptions own;
    own.strict = strict;
    return compareStudy.outcome(results, line, own).fails;
  };
  using Lines = std::vector<std::string>;
  for (const auto& [endpoint, verdict] : {std::pair("pressure", Verdict::fail),
                                          {"spin", Verdict::fail},
                                          {"slip", Verdict::borderline}}) {
    results.endpoints.rows.push_back(row(PairKind::peer, 8, verdict));
    results.endpoints.rows.back().a = "a";
    results.endpoints.rows.back().b = "b";
    results.endpoints.rows.back().endpoint = endpoint;
  }
  EXPECT_EQ(why(false), Lines{"engines disagree (a and b: pressure, spin)"});
  EXPECT_EQ(why(true), (Lines{"engines disagree (a and b: pressure, spin)",
                              "--strict: borderline (a and b: slip)"}));
  results.endpoints.rows.erase(results.endpoints.rows.begin(), results.endpoints.rows.end() - 1);
  EXPECT_EQ(why(false), Lines{});
  results.endpoints.alarms = {{"a", "b", PairKind::peer, "pressure is 12 margins away"}};
  LockstepRow law{.engine = "b", .verdict = Equivalence::differs};
  results.lockstep.emplace().rows = {law};
  EXPECT_EQ(why(false), (Lines{"an alarm: engines differ in what no margin excuses (a and b)",
                               "an engine differs from the law that it declares (b)"}));
  results.lockstep.reset();
  for (const char* const peer : {"c", "d", "e", "f"})
    results.endpoints.alarms.push_back({"a", peer, PairKind::peer, "spin is 12 margins away"});
  EXPECT_EQ(why(false), Lines{"an alarm: engines differ in what no margin excuses (a and b; a and "
                              "c; a and d and 2 more)"});
}

TEST(CompareOutcome, NothingJudged_IsFailureUnlessAskedFor) {
  CompareResults results;
  results.nothingJudged = NothingJudged{"too few"};
  EXPECT_EQ(compared(results), exitFailed);
  EXPECT_EQ(compared(results, false, true), exitPassed);
  EXPECT_EQ(compared(results, true, true), exitFailed);
  results.nothingJudged->byRequest = true;
  EXPECT_EQ(both(results), std::pair(exitPassed, exitFailed));
}

TEST(StabilityOutcome, UnstableOrNothingJudged_Fails) {
  const auto status = [](const std::vector<Verdict>& verdicts) {
    StabilityResults results;
    for (const Verdict verdict : verdicts) results.runs.emplace_back().verdict = verdict;
    return stabilityStudy.outcome(results, {}, {}).status;
  };
  using enum Verdict;
  EXPECT_EQ(status({pass, borderline, notApplicable, notMeasured}), exitPassed);
  EXPECT_EQ(status({pass, fail}), exitFailed);
  EXPECT_EQ(status({notApplicable, notApplicable}), exitFailed);
  EXPECT_EQ(status({notApplicable, notMeasured}), exitFailed);
}

CollisionCurve curve(const std::string& engine, Verdict verdict, Status status = Status::finished) {
  CollisionCurve one{.engine = engine, .status = status};
  one.score.verdict = verdict;
  one.reason = engine + " broke";
  return one;
}

TEST(CollideOutcome, FailedAndFellShortSweeps_Decide) {
  const auto outcome = [](const std::vector<CollisionCurve>& curves, bool strict = false) {
    CollideResults results;
    results.variants.emplace_back().curves = curves;
    return collideStudy.outcome(results, {}, {strict});
  };
  const CollisionCurve good = curve("a", Verdict::pass);
  EXPECT_EQ(outcome({good}).status, exitPassed);
  EXPECT_EQ(outcome({good, curve("b", Verdict::fail)}).status, exitFailed);
  EXPECT_TRUE(outcome({curve("a", Verdict::notMeasured)}).nothingJudged);
  EXPECT_EQ(outcome({curve("a", Verdict::notMeasured)}).status, exitFailed);
  // True to the law that it declares, short of the scene's: only --strict asks for that.
  CollisionCurve model = curve("b", Verdict::fail);
  model.declared.emplace().score.verdict = Verdict::pass;
  EXPECT_EQ(outcome({good, model}).status, exitPassed);
  EXPECT_EQ(outcome({good, model}, true).status, exitFailed);
  const CollisionCurve broken = curve("b", Verdict::notMeasured, Status::failed);
  EXPECT_EQ(outcome({good, broken, broken}).status, exitEngineFailed);
  EXPECT_EQ(outcome({good, broken, broken}).failures, std::vector<std::string>{"b broke"});
}

TEST(LockstepOutcome, DiffersFailureAndNoMirror_Decide) {
  const auto status = [](Equivalence verdict, const char* failure = "", bool strict = false) {
    LockstepResults results;
    results.lockstep.rows.push_back({.verdict = verdict, .failure = failure});
    LockstepOptions own;
    own.strict = strict;
    return lockstepStudy.outcome(results, {}, own).status;
  };
  EXPECT_EQ(status(Equivalence::sameLaw), exitPassed);
  EXPECT_EQ(status(Equivalence::differs), exitFailed);
  EXPECT_EQ(status(Equivalence::undecided), exitPassed);
  EXPECT_EQ(status(Equivalence::undecided, "", true), exitFailed);
  EXPECT_EQ(status(Equivalence::notMeasured), exitFailed);
  EXPECT_EQ(status(Equivalence::notMeasured, "broke"), exitEngineFailed);
}

/// Which of several collisions of rigid disks comes first their law leaves open: borderline, as the
/// reports have it.
TEST(LockstepOutcome, DifferenceThatTheLawLeavesOpen_IsNoOtherLaw) {
  LockstepFindings findings;
  findings.rules.referencePerturbation = "en";
  LockstepRow& row = findings.rows.emplace_back();
  row.engine = "b";
  row.verdict = Equivalence::differs;
  const auto outcomes = [&](bool strict) {
    LockstepResults alone;
    alone.lockstep = findings;
    LockstepOptions own;
    own.strict = strict;
    CompareResults compared;
    compared.lockstep = findings;
    CompareOptions options;
    options.strict = strict;
    return std::pair(lockstepStudy.outcome(alone, {}, own),
                     compareStudy.outcome(compared, {}, options));
  };
  const auto statuses = [&](bool strict) {
    const auto [alone, compared] = outcomes(strict);
    return std::pair(alone.status, compared.status);
  };
  EXPECT_EQ(statuses(false), std::pair(exitFailed, exitFailed));
  row.severalAtOnce = true;
  EXPECT_EQ(statuses(false), std::pair(exitPassed, exitPassed));
  EXPECT_EQ(statuses(true), std::pair(exitFailed, exitFailed));
  using Lines = std::vector<std::string>;
  EXPECT_EQ(outcomes(true).first.fails, Lines{"--strict: b is borderline"});
  EXPECT_EQ(
      outcomes(true).second.fails,
      Lines{"--strict: an engine's law is borderline: the law of rigid disks leaves open what "
            "parts it from its mirror (b)"});
  EXPECT_NE(results::describe(row, findings.rules).find("; borderline: "), std::string::npos);
  findings.rules.referencePerturbation = "kn";  // of soft disks nothing is open
  EXPECT_EQ(statuses(false), std::pair(exitFailed, exitFailed));
}

TEST(EffectsAndConformanceOutcome, Failures_AreEngineFailures) {
  EffectsResults effects;
  effects.variants.emplace_back().status = Status::refused;
  EXPECT_EQ(effectsStudy.outcome(effects, {}, {}).status, exitPassed);
  effects.variants.front().status = Status::failed;
  EXPECT_EQ(effectsStudy.outcome(effects, {}, {}).status, exitEngineFailed);
  ConformanceResults conformance;
  for (const auto& [outcome, status] :
       {std::pair(checkSkipped, exitFailed), std::pair(checkPassed, exitPassed),
        std::pair(checkFailed, exitFailed), std::pair(checkBrokeDown, exitEngineFailed)}) {
    conformance.rows.emplace_back().outcome = outcome;
    EXPECT_EQ(outcomeOf(conformance).status, status);
  }
  conformance.rows.resize(2);  // one skipped and one passed
  conformance.declared = 10;
  conformance.notExamined.assign(2, "checkpoints");
  EXPECT_EQ(outcomeOf(conformance).status, exitPassed);
  conformance.notExamined.assign(3, "checkpoints");
  EXPECT_EQ(outcomeOf(conformance).status, exitFailed);
  EXPECT_EQ(outcomeOf(conformance, true).status, exitPassed);
}

TEST(DiffOutcome, DifferencesFailuresAndNothingMeasured_Decide) {
  const auto status = [](Equivalence verdict, const char* failure = "") {
    DiffResults results;
    results.rows.push_back({.verdict = verdict, .reason = "why", .failure = failure});
    return outcomeOf(results).status;
  };
  EXPECT_EQ(status(Equivalence::sameBits), exitPassed);
  EXPECT_EQ(status(Equivalence::differs), exitFailed);
  EXPECT_EQ(status(Equivalence::undecided), exitFailed);
  EXPECT_EQ(status(Equivalence::notMeasured), exitFailed);
  EXPECT_EQ(status(Equivalence::differs, "broke"), exitEngineFailed);
}

}  // namespace
