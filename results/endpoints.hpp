#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "averaging/agreement.hpp"
#include "results/flow_numbers.hpp"
#include "results/schema.hpp"

/// Verdicts on endpoints (cases/endpoints.hpp), and what they rest on.
namespace crossgrain::inline results {

/// Names in files of the verdict on an endpoint: an agreement has two names, see
/// EndpointRow::answer().
inline constexpr support::EnumNames<Verdict, 6> answerNames{{{Verdict::pass, "no_difference_seen"},
                                                             {Verdict::pass, "small_difference"},
                                                             {Verdict::borderline, "borderline"},
                                                             {Verdict::fail, "disagree"},
                                                             {Verdict::undecided, "undecided"},
                                                             {Verdict::notMeasured, "absent"}}};

/// Names in files of the basis of a verdict.
inline constexpr support::EnumNames<Basis, 4> basisNames{{{Basis::paired, "paired"},
                                                          {Basis::independent, "independent"},
                                                          {Basis::oneScatter, "one_scatter"},
                                                          {Basis::oneRunEach, "one_run_each"}}};

/// Of two engines whose runs are not paired, as those of files.
struct UnpairedRuns {
  Basis basis = Basis::independent;
  int a = 0, b = 0;  ///< runs with a value, of each
  /// Share of the runs of a in the variance of the difference of means, 0 … 1: more than a half,
  /// and more runs of a narrow the interval most. Absent of a single run each.
  std::optional<double> shareOfA = {};

  void fields(auto& io) {
    io("basis", basis, basisNames);
    FIELDS(io, a, b);
    io.present("share_of_a", shareOfA);
  }
};

/// One endpoint of two engines.
struct EndpointRow {
  std::string a, b;  ///< the reference first
  PairKind kind = PairKind::peer;
  std::string endpoint, unit;
  double margin = 0.0;          ///< of the reference where marginRelative, else in the unit
  bool marginRelative = false;  ///< then engines are compared by their ratio
  std::string marginWhy;
  Verdict verdict = Verdict::undecided;  ///< notMeasured: the files of one have no such number
  std::optional<double> reference;  ///< mean over the packings of a, or the expected value [unit]
  /// Halves of the intervals of both means, over packings or within one run each, at the confidence
  /// of the averaging [unit]; absent of a single value.
  std::optional<double> referenceHalf, valueHalf;
  std::optional<double> difference, low, high;  ///< b − a, with the interval of the verdict [unit]
  /// The difference in margins, with its interval: engines rank by it. With a bound the interval is
  /// wider by it.
  std::optional<double> distance, distanceLow, distanceHigh;
  std::optional<int> look;               ///< that gave the answer, or the last, from 1
  int packings = 0;                      ///< that both have
  int lost = 0;                          ///< that one of both has no value on, of those looked at
  std::optional<UnpairedRuns> unpaired;  ///< absent: the same packings of both, one by one
  /// Why a run has none, the margin does not apply or files decide nothing; empty: as it should be.
  std::string reason;
  std::optional<int> needs;            ///< undecided: packings that decide with 90 % chance,
  std::optional<int> needsAtMost;      ///< and at most so many; absent: no telling
  std::string surrogateA, surrogateB;  ///< the mirror whose runs stand for a, for b; empty: its own
  std::optional<double> bound;         ///< B of those mirrors, in margins
  std::optional<double> reach;         ///< part of B: what the followed runs could have missed

  /// Value of b [unit]: what the difference makes of the reference.
  std::optional<double> value() const {
    return reference && difference ? std::optional(*reference + *difference) : std::nullopt;
  }
  /// Whether a difference is shown, within the margin or not: 0 is outside its interval, that
  /// without B.
  bool differenceSeen() const {
    if (!distanceLow || !distanceHigh) return distance.value_or(0.0) != 0.0;
    return *distanceLow + bound.value_or(0.0) > 0.0 || *distanceHigh - bound.value_or(0.0) < 0.0;
  }
  /// The verdict as files call it.
  std::string answer() const {
    const bool small = verdict == Verdict::pass && differenceSeen();
    return std::string(small ? "small_difference" : nameOf(verdict, answerNames));
  }

  void fields(auto& io) {
    io("a", a, aName);
    io("b", b, aName);
    io("kind", kind);
    io("endpoint", endpoint, aName);
    io("unit", unit, aUnit);
    FIELDS(io, margin, marginRelative, marginWhy);
    std::string word = answer();
    if (io.reading)
      io("answer", verdict, answerNames);
    else
      io("answer", word);
    io("reference", reference);
    PRESENT_FIELDS(io, referenceHalf, valueHalf);
    FIELDS(io, difference, low, high, distance, distanceLow, distanceHigh, look, packings, lost);
    io.present("unpaired", unpaired);
    io.when(!reason.empty(), "reason", reason);
    PRESENT_FIELDS(io, needs, needsAtMost);
    io.when(!surrogateA.empty(), "carrier_a", surrogateA, aName);
    io.when(!surrogateB.empty(), "carrier_b", surrogateB, aName);
    PRESENT_FIELDS(io, bound, reach);
  }
};

/// One look as planned.
struct InterimRow {
  int packings = 0;
  double alpha = 0.0;  ///< its part of 1 − confidence, for *disagree*

  void fields(auto& io) { FIELDS(io, packings, alpha); }
};

struct InterimFindings {
  std::vector<InterimRow> planned;
  std::optional<double> agreeAlpha;  ///< the level of *agree* at each look
  std::size_t taken = 0;
  double budget = 0.0;  ///< [s]
  std::string ended;    ///< why no further look was taken

  void fields(auto& io) {
    FIELDS(io, planned, taken, ended);
    io.present("agree_alpha", agreeAlpha);
    io("budget_s", budget);
  }
};

/// Response to a changed constant of an endpoint of the in-house engine, paired over packings.
struct EndpointResponse {
  std::string endpoint, constant;
  double change = 0.0;               ///< relative, of the constant
  std::optional<double> difference;  ///< in margins
  std::optional<double> bound;       ///< largest that its 95 % interval allows, in margins
  std::optional<double> scatter;     ///< of one packing's difference, in margins: chaos
  int packings = 0;

  void fields(auto& io) {
    io("endpoint", endpoint, aName);
    io("constant", constant, aName);
    FIELDS(io, change, difference, bound, scatter, packings);
  }
};

/// One endpoint of the averaged run of a spot check, in margins.
struct SpotCheckNumber {
  std::string endpoint;
  std::optional<double> difference;  ///< the engine's run less its mirror's
  std::optional<double> floor;       ///< scatter of two runs of one packing: chaos
  std::optional<double> chance;      ///< of one as large by chaos alone, times the endpoints tested
  std::optional<double> reach;       ///< the smallest difference that would be an alarm

  void fields(auto& io) {
    io("endpoint", endpoint, aName);
    FIELDS(io, difference, floor, chance, reach);
  }
};

/// A change of a constant, relative, that separates the mirror from itself as far as the engine is
/// from its mirror.
struct EquivalentChange {
  std::string constant;  ///< "kn"
  double change = 0.0;

  void fields(auto& io) { FIELDS(io, constant, change); }
};

/// The followed run of a spot check: windows one after the other within one run of the engine,
/// each compared with the mirror that begins from the state and forces found there.
struct LateWindows {
  int packing = 0;            ///< index
  std::vector<double> times;  ///< at which they begin, since the hand-over [s]
  double length = 0.0;        ///< of each [s]
  /// Of each constant that endpoints' responses are known to: the mean over all windows, upper end
  /// of its interval (95 %). A constant that moves nothing has none.
  std::vector<EquivalentChange> equivalents;
  std::string failure;  ///< why there are none; empty: there are
  std::size_t read = 0,
              beyond = 0;  ///< windows that can be read, and of those beyond lockstep's rule
  bool differs = false;    ///< by that rule, from more windows than chance may part
  /// Of differs: all but a share within chance first part where a disk touches several at once.
  bool severalAtOnce = false;

  void fields(auto& io) {
    FIELDS(io, packing, equivalents, failure, read, beyond, differs, severalAtOnce);
    io("times_s", times);
    io("length_s", length);
  }
};

/// An engine that lockstep found to be its mirror, which then runs the packings. The engine's
/// own runs are a spot check, for what begins after lockstep's windows: one is averaged and
/// compared with the mirror's, one is followed by late windows.
struct SurrogateEngine {
  std::string engine, mirror;
  double equivalent = 0.0;   ///< ε_eq, the upper end of its interval
  std::size_t starts = 0;    ///< that lockstep followed
  int spotCheckPacking = 0;  ///< index
  std::vector<SpotCheckNumber> spotCheck;
  std::string alarm;   ///< why the mirror does not stand for it after all; empty: it does
  bool inUse = false;  ///< both runs of the spot check ended without an alarm
  LateWindows late = {};
  bool observed = false;  ///< the alarm is a difference that was seen, not something missing

  void fields(auto& io) {
    io("engine", engine, aName);
    io("mirror", mirror, aName);
    FIELDS(io, equivalent, starts, alarm, late, observed);
    io("canary_packing", spotCheckPacking);
    io("canary", spotCheck);
    io("carried", inUse);
  }
};

/// Test by its own runs of the law of an engine that passed lockstep's windows. A difference is
/// one where windows show it by lockstep's own rule, and endpoints feel it; what was seen and shows
/// less than that is undecided.
inline Verdict verdictOf(const SurrogateEngine& own) {
  if (!own.alarm.empty() && own.late.differs) {
    const auto& changes = own.late.equivalents;
    const bool rigid = !changes.empty() && changes.front().constant == "en";
    return rigid && own.late.severalAtOnce ? Verdict::borderline : Verdict::fail;
  }
  return own.observed ? Verdict::undecided : Verdict::pass;
}

/// Of an engine; null: it has no spot check.
inline const SurrogateEngine* spotCheckedEngine(const std::vector<SurrogateEngine>& surrogates,
                                                const std::string& engine) {
  const auto found = std::ranges::find(surrogates, engine, &SurrogateEngine::engine);
  return found == surrogates.end() ? nullptr : &*found;
}

/// The finding by which the engine's packings are run by its mirror; null: it runs them itself.
inline const SurrogateEngine* surrogateOf(const std::vector<SurrogateEngine>& surrogates,
                                          const std::string& engine) {
  const auto found = std::ranges::find_if(
      surrogates, [&](const SurrogateEngine& one) { return one.inUse && one.engine == engine; });
  return found == surrogates.end() ? nullptr : &*found;
}

/// The same by the mirror that runs them; null: it runs no engine's.
inline const SurrogateEngine* surrogateBy(const std::vector<SurrogateEngine>& surrogates,
                                          const std::string& mirror) {
  const auto found = std::ranges::find_if(
      surrogates, [&](const SurrogateEngine& one) { return one.inUse && one.mirror == mirror; });
  return found == surrogates.end() ? nullptr : &*found;
}

/// Alarms, which need no test.
struct AlarmRow {
  std::string a, b;
  PairKind kind = PairKind::peer;
  std::string what;  ///< a sentence

  void fields(auto& io) {
    io("a", a, aName);
    io("b", b, aName);
    FIELDS(io, kind, what);
  }
};

struct EndpointFindings {
  std::string reference;  ///< medianName where no engine is it; empty: the first engine
  InterimFindings looks;
  std::vector<EndpointRow> rows;
  std::vector<AlarmRow> alarms;
  std::vector<SurrogateEngine> surrogates;
  std::vector<EndpointResponse> responses;

  void fields(auto& io) {
    io.when(!reference.empty(), "reference", reference, aName);
    FIELDS(io, looks, rows, alarms, responses);
    io("carried", surrogates);
  }
};

}  // namespace crossgrain::inline results
