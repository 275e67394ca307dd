#include "studies/flow/endpoint_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "averaging/agreement.hpp"
#include "averaging/statistics.hpp"
#include "cases/endpoints.hpp"
#include "cases/flow.hpp"
#include "studies/flow/endpoint_values.hpp"

namespace crossgrain::inline studies {

namespace {

/// Engines whose values have a median.
constexpr std::size_t fewestOfMedian = 2;

/// An endpoint of two engines on its way to a verdict.
struct EndpointTest {
  EndpointRow row;
  PairedTest test;
  std::optional<InterimAnswer> found = {};
  bool ofFiles = false;  ///< of one of both: what they decide is all they will
  int notShown = 0;      ///< packings that a lack of one of both leaves without a value
};

/// Why some of the values cannot be tested by their ratio; empty: all can.
std::string whyNoRatio(const Endpoint& endpoint, const Numbers& reference, const Numbers& other) {
  if (!endpoint.byRatio) return {};
  const double sign = signOf(reference);
  const auto has = [](const auto& value) { return value.has_value(); };
  if (std::ranges::none_of(reference, has)) return {};
  const auto fails = [sign](const auto& value) { return value && !(sign * *value > 0.0); };
  if (sign == 0.0)
    return "a relative margin is a share of the reference's value, which is 0 or of both signs "
           "here: give absolute";
  if (std::ranges::any_of(reference, fails) || std::ranges::any_of(other, fails))
    return "values that are 0 or of another sign than the reference's have no ratio to it";
  return {};
}

/// All but what is found.
EndpointRow emptyRow(const ComparedPair& pair, const Endpoint& endpoint, const Margin& margin) {
  EndpointRow row;
  row.a = pair.a;
  row.b = pair.b;
  row.kind = pair.kind;
  row.endpoint = endpoint.name;
  row.unit = endpoint.unit;
  row.margin = margin.value;
  row.marginRelative = endpoint.byRatio;
  row.marginWhy = margin.why;
  return row;
}

/// Half of the interval of a mean over packings; absent with fewer than two of them.
std::optional<double> halfOf(const Numbers& values, double confidence) {
  const auto mean = ensembleMean(values);
  if (!mean || !mean->standardError) return std::nullopt;
  return studentQuantile(confidence, mean->packings - 1) * *mean->standardError;
}

/// The same within one run, by what its endpoints are known by.
std::optional<double> halfOf(const FlowRun& run, std::string_view endpoint, double confidence) {
  const auto own = std::ranges::find(run.endpointErrors, endpoint, &EndpointError::endpoint);
  if (own == run.endpointErrors.end() || own->dof < 1.0) return std::nullopt;
  return studentQuantile(confidence, own->dof) * own->standardError;
}

EndpointTest testOf(const Case& setup, const ComparedPair& pair, const Endpoint& endpoint,
                    const Numbers& reference, const Numbers& other) {
  const Margin& margin = setup.averaging.endpoints.at(std::string(endpoint.name));
  EndpointTest own{emptyRow(pair, endpoint, margin),
                   testedEndpoint(endpoint, margin, reference, other)};
  own.row.reason = whyNoRatio(endpoint, reference, other);
  own.row.referenceHalf = halfOf(reference, setup.averaging.confidence);
  own.row.valueHalf = halfOf(other, setup.averaging.confidence);
  return own;
}

/// B of a mirror, in margins, and its part `reach`.
struct MirrorBound {
  double all = 0.0, reach = 0.0;
};

/// Absent where a response or an equivalent change is not known.
std::optional<MirrorBound> boundOf(const std::string& endpoint, const SurrogateEngine& mirror,
                                   const std::vector<EndpointResponse>& responses) {
  const auto late = reachOf(endpoint, mirror.late, responses);
  if (!late) return std::nullopt;
  double start = 0.0;
  for (const EndpointResponse& response : responses)
    if (response.endpoint == endpoint && response.bound)
      start = std::max(start, mirror.equivalent / response.change * *response.bound);
  return MirrorBound{start + *late, *late};
}

/// Adds the bound of the mirrors that stand for an engine, or for those of a median, which differs
/// by no more than the largest of its engines'. @returns whether there is one
bool addBound(EndpointRow& row, std::string EndpointRow::*surrogate,
              const std::vector<std::string>& engines, const EndpointFindings& known) {
  MirrorBound largest;
  for (const std::string& engine : engines) {
    const SurrogateEngine* const by = surrogateOf(known.surrogates, engine);
    if (!by) continue;
    const auto bound = boundOf(row.endpoint, *by, known.responses);
    if (!bound) return false;
    (row.*surrogate) += ((row.*surrogate).empty() ? "" : " ") + by->mirror;
    if (bound->all >= largest.all) largest = *bound;
  }
  if ((row.*surrogate).empty()) return true;
  row.bound = row.bound.value_or(0.0) + largest.all;
  row.reach = row.reach.value_or(0.0) + largest.reach;
  return true;
}

/// Runs in which both of a pair can have an endpoint.
struct AblePair {
  std::vector<Runs> ours;  ///< of each reference that has any
  Runs theirs;
  std::vector<std::string> lacks;
  int notShown = 0;   ///< packings that a lack leaves without a value
  bool none = false;  ///< too few are left for a comparison
};

AblePair ablePair(const Endpoint& endpoint, const Case& setup, const ComparedPair& pair,
                  const std::vector<Runs>& ours, const Runs& theirs) {
  AblePair able;
  const auto add = [&](const Runs& all) {
    AbleRuns own = ableRuns(endpoint, setup, all);
    if (!own.lack.empty()) able.lacks.push_back(std::move(own.lack));
    return std::move(own.runs);
  };
  for (const Runs& all : ours)
    if (Runs own = add(all); !own.empty()) able.ours.push_back(std::move(own));
  able.theirs = add(theirs);
  const std::size_t fewest = pair.others.empty() ? 1 : fewestOfMedian;
  able.none = able.theirs.empty() || able.ours.size() < fewest;
  const auto has = [](const Runs& runs, int packing) {
    return std::ranges::find(runs, packing, &FlowRun::packing) != runs.end();
  };
  const auto enough = [&](const std::vector<Runs>& of, int k) {
    return static_cast<std::size_t>(
               std::ranges::count_if(of, [&](const Runs& runs) { return has(runs, k); })) >= fewest;
  };
  for (const FlowRun* run : theirs)
    able.notShown += enough(ours, run->packing) &&
                     (!has(able.theirs, run->packing) || !enough(able.ours, run->packing));
  return able;
}

std::vector<EndpointTest> familyOf(const Case& setup, std::span<const FlowRun> runs,
                                   const ComparedPair& pair, const EndpointFindings& known) {
  const std::size_t packings = packingsOf(runs);
  const std::vector<Runs> ours = referenceRuns(runs, pair, known.surrogates);
  const Runs theirs = runsFor(runs, pair.b, known.surrogates, pair.without);
  std::vector<EndpointTest> family;
  if (ours.empty() || theirs.empty()) return family;
  for (const Endpoint& endpoint : setup.endpoints) {
    const AblePair able = ablePair(endpoint, setup, pair, ours, theirs);
    if (able.none) {
      EndpointTest absent = testOf(setup, pair, endpoint, {}, {});
      absent.row.verdict = Verdict::notMeasured;
      absent.row.reason = fmt::format("{}", fmt::join(able.lacks, "; "));
      family.push_back(std::move(absent));
      continue;
    }
    const bool independent = independentRuns(pair, able.ours.front(), able.theirs);
    const auto valuesOf = [&](const Runs& of) {
      if (!independent) return endpointByPacking(endpoint, setup, of, packings);
      Numbers values;
      for (const FlowRun* run : of) values.push_back(endpointOf(endpoint, setup, *run));
      return values;
    };
    std::vector<Numbers> values;
    for (const Runs& of : able.ours) values.push_back(valuesOf(of));
    EndpointTest own =
        testOf(setup, pair, endpoint, medianByPacking(values), valuesOf(able.theirs));
    own.test.sample.independent = independent;
    own.ofFiles = pair.ofFiles;
    own.notShown = independent ? 0 : able.notShown;
    if (!able.lacks.empty()) own.row.reason = fmt::format("{}", fmt::join(able.lacks, "; "));
    const auto addReason = [&own](const std::string& reason) {
      if (own.row.reason.empty()) own.row.reason = reason;
    };
    if (independent && able.ours.front().size() == 1 && able.theirs.size() == 1) {
      const FlowRun &a = *able.ours.front().front(), &b = *able.theirs.front();
      own.row.referenceHalf = halfOf(a, endpoint.name, setup.averaging.confidence);
      own.row.valueHalf = halfOf(b, endpoint.name, setup.averaging.confidence);
      if (const FlowRun* const without = addOwnErrors(own.test, a, b, endpoint.name))
        addReason(missingErrorReason(endpoint, *without));
    }
    for (const Runs& engine : able.ours) addReason(missingValueReason(endpoint, setup, engine));
    addReason(missingValueReason(endpoint, setup, able.theirs));
    // Without a bound nothing is known of the true difference: no verdict can stand on these runs.
    if (!addBound(own.row, &EndpointRow::surrogateA, pair.references(), known) ||
        !addBound(own.row, &EndpointRow::surrogateB, {pair.b}, known))
      continue;
    own.test.sample.bias = own.row.bound.value_or(0.0) * own.test.sample.margin;
    family.push_back(std::move(own));
  }
  return family;
}

/// Why runs of files, to which none can be added here, decide nothing.
std::string whyUndecided(const EndpointTest& own) {
  constexpr double fewestDof = fewestPackings - 1;
  const InterimAnswer& found = *own.found;
  const EndpointRow& row = own.row;
  if (found.packings == 0) return {};
  if (found.basis == Basis::oneRunEach && own.test.sample.withinVariance.empty()) return {};
  if (found.basis == Basis::oneRunEach && own.test.sample.withinDof < fewestDof)
    return fmt::format(
        "each single run holds about {:.2g} independent values, and a verdict takes {}",
        own.test.sample.withinDof + 1.0, fewestPackings);
  if (found.basis == Basis::oneScatter &&
      found.referencePackings + found.otherPackings - 2 < fewestPackings - 1)
    return fmt::format("{} and {} runs, and a verdict takes {} together", found.otherPackings,
                       found.referencePackings, fewestPackings + 1);
  if (found.basis == Basis::paired && found.packings < fewestPackings)
    return fmt::format("{} runs of both, and a verdict takes {}", found.packings, fewestPackings);
  if (!row.distanceLow || !row.distanceHigh) return {};
  const bool beyond = *row.distanceLow > 1.0 || *row.distanceHigh < -1.0;
  return beyond ? "beyond the margin, but not for sure among all endpoints of the pair"
                : "the interval reaches past the margin";
}

/// Share of the reference's runs in the variance of the difference, by the basis that it has.
std::optional<double> shareOfReference(const PairedSample& sample, const InterimAnswer& found) {
  if (found.basis == Basis::oneScatter && found.referencePackings > 0 && found.otherPackings > 0)
    return static_cast<double>(found.otherPackings) /
           static_cast<double>(found.otherPackings + found.referencePackings);
  if (found.basis != Basis::independent) return std::nullopt;
  const auto a = ensembleMean(sample.reference), b = ensembleMean(sample.other);
  if (!a || !b || !a->standardError || !b->standardError) return std::nullopt;
  const double ofA = *a->standardError * *a->standardError,
               all = ofA + *b->standardError * *b->standardError;
  return all > 0.0 ? std::optional(ofA / all) : std::nullopt;
}

/// @param looked  packings
void answer(EndpointTest& own, int looked) {
  EndpointRow& row = own.row;
  if (row.verdict == Verdict::notMeasured) return;
  if (!own.found) {
    row.lost = looked;  // neither has anything
    return;
  }
  const InterimAnswer& found = *own.found;
  row.verdict = found.verdict;
  row.look = static_cast<int>(found.look) + 1;
  row.packings = found.packings;
  row.lost = std::max(found.lost - own.notShown, 0);
  if (found.basis != Basis::paired)
    row.unpaired = {found.basis, found.referencePackings, found.otherPackings,
                    shareOfReference(own.test.sample, found)};
  if (found.packings == 0) return;
  const double margin = own.test.sample.margin, bias = own.test.sample.bias;
  row.reference = own.test.reference;
  row.difference = inUnit(own.test, found.difference);
  row.distance = found.difference / margin;
  if (!found.low) return;
  row.low = inUnit(own.test, *found.low - bias);
  row.high = inUnit(own.test, *found.high + bias);
  row.distanceLow = (*found.low - bias) / margin;
  row.distanceHigh = (*found.high + bias) / margin;
}

void addWhyUndecided(EndpointTest& own) {
  if (!own.ofFiles || !own.found || own.row.verdict != Verdict::undecided) return;
  if (const std::string why = whyUndecided(own); !why.empty())
    own.row.reason += (own.row.reason.empty() ? "" : "; ") + why;
}

/// Scatter of one paired difference on the scale of the test, of all pairs of an endpoint together.
struct Pooled {
  double squares = 0.0;
  int dof = 0;
};

/// In margins, from what every response scatters by. All of them are differences from the same
/// runs, so that together they have no more degrees of freedom for sure than one.
Pooled chaosOf(const std::string& endpoint, const std::vector<EndpointResponse>& responses) {
  double squares = 0.0;
  int count = 0, fewest = 0;
  for (const EndpointResponse& response : responses)
    if (response.endpoint == endpoint && response.scatter) {
      squares += *response.scatter * *response.scatter;
      fewest = count++ == 0 ? response.packings : std::min(fewest, response.packings);
    }
  if (count == 0) return {};
  const int dof = fewest - 1;
  return {dof * squares / count, dof};
}

/// How many packings would decide what is undecided, by the scatter of all pairs.
void addNeeds(std::vector<EndpointTest>& tests, const InterimPlan& plan) {
  std::map<std::string, Pooled> scatter;
  for (const EndpointTest& one : tests)
    if (one.found && one.found->standardError && one.found->basis == Basis::paired) {
      Pooled& pooled = scatter[one.row.endpoint];
      const int dof = one.found->packings - 1;
      pooled.squares +=
          dof * *one.found->standardError * *one.found->standardError * one.found->packings;
      pooled.dof += dof;
    }
  for (EndpointTest& one : tests) {
    const Pooled& pooled = scatter[one.row.endpoint];
    if (one.row.verdict != Verdict::undecided || !one.found || pooled.dof == 0) continue;
    if (one.row.unpaired) continue;  // files are what they are
    const double margin = one.test.sample.margin, bias = one.test.sample.bias;
    const double distance = std::abs(one.found->difference);
    const bool toAgree = distance < margin - bias;
    if (!toAgree && distance < margin + bias) continue;  // what a mirror leaves open, none decide
    const auto range = packingsFor(one.found->difference, std::sqrt(pooled.squares / pooled.dof),
                                   pooled.dof, toAgree ? margin - bias : margin + bias,
                                   toAgree ? plan.agreeAlpha : plan.alpha.back());
    if (!range) continue;
    const int more = one.row.packings + 1;
    one.row.needs = std::max(range->low, more);
    if (range->high) one.row.needsAtMost = std::max(*range->high, more);
  }
}

/// Judges the family of one pair after the interim analyses that so many packings allow, and adds
/// it to the others.
void judge(std::vector<EndpointTest> family, const InterimPlan& plan, int available,
           std::vector<EndpointTest>& judged) {
  std::vector<PairedSample> samples;
  for (const EndpointTest& own : family) samples.push_back(own.test.sample);
  const auto found = answersAfterInterims(samples, plan, available);
  const std::size_t looks = interimsTaken(plan, available);
  const int looked = looks > 0 ? plan.packings[looks - 1] : 0;
  for (std::size_t k = 0; k < family.size(); ++k) {
    family[k].found = found[k];
    answer(family[k], looked);
    addWhyUndecided(family[k]);
    judged.push_back(std::move(family[k]));
  }
}

std::vector<EndpointRow> rowsOf(std::vector<EndpointTest> judged, const InterimPlan& plan) {
  addNeeds(judged, plan);
  std::vector<EndpointRow> rows;
  for (EndpointTest& one : judged) rows.push_back(std::move(one.row));
  return rows;
}

/// An endpoint of an engine whose start was run again.
struct RepeatedValue {
  std::optional<double> value;
  int without = 0;     ///< runs that have none
  std::string reason;  ///< why there is no value that can be judged
};

RepeatedValue repeatedValue(const Endpoint& endpoint, const Case& setup,
                            std::span<const FlowRun> runs, const std::string& engine,
                            const std::string& without = "") {
  const Runs own = finishedRuns(runs, engine, without);
  // Of files there are as many as there are; an engine runs its start that often.
  const bool ofFiles = !own.empty() && own.front()->ofFiles();
  const Numbers values =
      endpointByPacking(endpoint, setup, own, ofFiles ? own.size() : std::size_t{closedFormRuns});
  RepeatedValue found;
  for (const auto& value : values)
    if (!value)
      ++found.without;
    else if (found.value && *found.value != *value)
      found.reason =
          fmt::format("{} of one start run twice gives {} and {}", engine, *found.value, *value);
    else
      found.value = value;
  if (found.without > 0) found.reason = missingValueReason(endpoint, setup, own);
  if (found.without > 0 && found.reason.empty())
    found.reason =
        fmt::format("{} of {} runs of {} have no value", found.without, closedFormRuns, engine);
  if (!found.reason.empty()) found.value.reset();
  return found;
}

/// Of the first of a pair, or the median of those that stand for it, as many of them as have a
/// value.
RepeatedValue repeatedReference(const Endpoint& endpoint, const Case& setup,
                                std::span<const FlowRun> runs, const ComparedPair& pair) {
  if (pair.others.empty()) return repeatedValue(endpoint, setup, runs, pair.a);
  std::vector<Numbers> values;
  for (const std::string& engine : pair.others)
    if (const auto own = repeatedValue(endpoint, setup, runs, engine); own.value)
      values.push_back({own.value});
  if (values.size() < fewestOfMedian) return {{}, 0, "too few of the others have a value"};
  return {medianByPacking(values).front(), 0, {}};
}

void answerExactly(EndpointRow& row, const RepeatedValue& a, const RepeatedValue& b) {
  row.packings = closedFormRuns - std::max(a.without, b.without);
  row.lost = closedFormRuns - row.packings;
  row.reason = a.reason.empty() ? b.reason : a.reason;
  row.reference = a.value;
  if (!a.value || !b.value) return;
  row.difference = *b.value - *a.value;
  row.distance = *row.difference / row.margin;
  row.verdict = std::abs(*row.distance) <= 1.0 ? Verdict::pass : Verdict::fail;
}

}  // namespace

std::vector<EndpointRow> closedFormRows(const Case& setup, std::span<const FlowRun> runs,
                                        const std::vector<std::string>& engines,
                                        const std::vector<ComparedPair>& pairs) {
  std::vector<EndpointRow> rows;
  for (const Endpoint& endpoint : setup.endpoints) {
    const auto add = [&](const ComparedPair& pair, const RepeatedValue& first) {
      rows.push_back(emptyRow(pair, endpoint, setup.averaging.endpoints.at(endpoint.name)));
      std::vector<std::pair<std::string, std::string>> both = {{pair.b, pair.without}};
      if (pair.others.empty()) both.insert(both.begin(), {pair.a, ""});
      for (const auto& [engine, without] : both)
        if (const AbleRuns able = ableRuns(endpoint, setup, finishedRuns(runs, engine, without));
            able.runs.empty() && !able.lack.empty()) {
          rows.back().verdict = Verdict::notMeasured;
          rows.back().reason = able.lack;
          return;
        }
      answerExactly(rows.back(), first, repeatedValue(endpoint, setup, runs, pair.b, pair.without));
    };
    for (const std::string& engine : engines)
      add({closedFormName, engine, PairKind::closedForm}, {endpoint.expected, 0, {}});
    const auto ran = [&](const std::string& engine) { return !finishedRuns(runs, engine).empty(); };
    for (const ComparedPair& pair : pairs)
      if (std::ranges::any_of(pair.references(), ran) &&
          !finishedRuns(runs, pair.b, pair.without).empty())
        add(pair, repeatedReference(endpoint, setup, runs, pair));
  }
  return rows;
}

InterimPlan interimPlanOf(const Case& setup) {
  const int first = flowPackings(setup);
  // Files are all there are: a further look would see them again.
  const bool oneLook = first < fewestPackings || packingsAreFiles(setup);
  return interimPlanAt(first, oneLook ? 1 : setup.looks.count, 1.0 - setup.averaging.confidence);
}

std::vector<EndpointRow> endpointRows(const Case& setup, const std::vector<EndpointValues>& family,
                                      const std::pair<std::string, std::string>& names,
                                      const InterimPlan& plan) {
  std::vector<EndpointTest> tests, judged;
  for (const EndpointValues& values : family)
    tests.push_back(testOf(setup, {names.first, names.second},
                           endpointNamed(setup, values.endpoint), values.reference, values.other));
  judge(std::move(tests), plan, plan.packings.back(), judged);
  return rowsOf(std::move(judged), plan);
}

std::vector<EndpointRow> endpointRows(const Case& setup, std::span<const FlowRun> runs,
                                      const std::vector<ComparedPair>& pairs,
                                      const InterimPlan& plan, int available,
                                      const EndpointFindings& known,
                                      const std::map<std::string, int>& stopped) {
  std::vector<EndpointTest> judged;
  const auto availableOf = [&](const ComparedPair& pair) {
    std::vector<std::string> both = pair.references();
    both.push_back(pair.b);
    int least = available;
    for (const std::string& engine : both)
      if (const auto found = stopped.find(engine); found != stopped.end())
        least = std::min(least, found->second);
    return least;
  };
  for (const ComparedPair& pair : pairs)
    if (pair.ofFiles) {  // all there are, whatever engines run
      const int all = static_cast<int>(packingsOf(finishedRuns(runs, pair.b)));
      judge(familyOf(setup, runs, pair, known),
            interimPlanAt(all, 1, 1.0 - setup.averaging.confidence), all, judged);
    } else
      judge(familyOf(setup, runs, pair, known), plan, availableOf(pair), judged);
  return rowsOf(std::move(judged), plan);
}

std::optional<double> reachOf(std::string_view endpoint, const LateWindows& late,
                              const std::vector<EndpointResponse>& responses) {
  std::optional<double> reach;
  for (const EndpointResponse& response : responses)
    for (const EquivalentChange& found : late.equivalents)
      if (response.endpoint == endpoint && response.bound && response.constant == found.constant)
        reach = std::max(reach.value_or(0.0), found.change / response.change * *response.bound);
  return reach;
}

EndpointResponse responseTo(const Case& setup, const Runs& runs, const Runs& changed,
                            const std::string& name, const std::string& constant, double change,
                            std::size_t packings) {
  const Endpoint& endpoint = endpointNamed(setup, name);
  EndpointResponse response{name, constant, change, {}, {}, {}, 0};
  const PairedSample sample = testedEndpoint(endpoint, setup.averaging.endpoints.at(name),
                                             endpointByPacking(endpoint, setup, runs, packings),
                                             endpointByPacking(endpoint, setup, changed, packings))
                                  .sample;
  const double margin = sample.margin;
  const double bothTails = 1.0 - (1.0 - setup.averaging.confidence) / 2.0;
  const auto found = comparePaired({&sample, 1}, bothTails).front();
  if (!found || found->packings == 0) return response;
  response.packings = found->packings;
  response.difference = found->difference / margin;
  if (!found->low) return response;
  response.bound = std::max(std::abs(*found->low), std::abs(*found->high)) / margin;
  response.scatter = *found->standardError * std::sqrt(found->packings) / margin;
  return response;
}

std::vector<SpotCheckNumber> spotCheckOf(const Case& setup, const FlowRun& engine,
                                         const FlowRun& mirror,
                                         const std::vector<EndpointResponse>& responses) {
  std::vector<SpotCheckNumber> numbers;
  for (const auto& [name, allowed] : setup.averaging.endpoints) {
    const Endpoint& endpoint = endpointNamed(setup, name);
    SpotCheckNumber number{name, {}, {}, {}, {}};
    const PairedSample sample =
        testedEndpoint(endpoint, allowed, {endpointOf(endpoint, setup, mirror)},
                       {endpointOf(endpoint, setup, engine)})
            .sample;
    if (sample.reference[0] && sample.other[0])
      number.difference = (*sample.other[0] - *sample.reference[0]) / sample.margin;
    const Pooled chaos = chaosOf(name, responses);
    if (chaos.dof > 0) number.floor = std::sqrt(chaos.squares / chaos.dof);
    const std::size_t tests = setup.averaging.endpoints.size();
    if (number.floor && *number.floor > 0.0) {
      number.reach =
          *number.floor * farthestByChance(1.0 - setup.averaging.confidence, chaos.dof, tests);
      if (number.difference)
        number.chance = chanceOfOneAsFar(*number.difference, *number.floor, chaos.dof, tests);
    }
    numbers.push_back(std::move(number));
  }
  return numbers;
}

}  // namespace crossgrain::inline studies
