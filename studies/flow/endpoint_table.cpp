#include "studies/flow/endpoint_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "averaging/agreement.hpp"
#include "cases/endpoints.hpp"
#include "cases/flow.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/flow/paired_rings.hpp"

namespace crossgrain::inline studies {

namespace {

constexpr int fewestPackings = 4;  // of any verdict

/// B and the part of it that is the spot check's, in margins.
struct Bound {
  double all = 0.0, late = 0.0;
};

/// One endpoint as it is put to the test: by difference, or by the logarithm of the ratio.
struct TestedEndpoint {
  EndpointSpec endpoint;
  const Margin* margin;
  PairedSample sample;
  double sign = 1.0;       ///< of the values whose ratio is tested
  double reference = 0.0;  ///< mean over packings of a [unit]
  std::optional<Bound> bound;
  std::string reason;  ///< EndpointRow::reason
};

double testMargin(const EndpointSpec& endpoint, const Margin& margin) {
  return endpoint.byRatio ? std::log1p(margin.value) : margin.value;
}

/// Of the values of a reference, for a margin that is a share of |reference|: +1 or −1; 0 where
/// both occur or none, as a share of what may be 0 is no margin.
double signOf(const Numbers& values) {
  double sign = 0.0;
  for (const auto& value : values) {
    if (!value || *value == 0.0 || !std::isfinite(*value)) continue;
    const double own = *value > 0.0 ? 1.0 : -1.0;
    if (sign == -own) return 0.0;
    sign = own;
  }
  return sign;
}

/// Those that can be tested: what is 0 or of another sign has no ratio, and its packing counts as
/// lost.
Numbers testable(const EndpointSpec& endpoint, Numbers values, double sign) {
  for (auto& value : values)
    if (value && (!std::isfinite(*value) || (endpoint.byRatio && !(sign * *value > 0.0))))
      value.reset();
  return values;
}

/// On the scale of the test, which rises with the value whatever its sign.
Numbers onScale(const EndpointSpec& endpoint, Numbers values, double sign) {
  values = testable(endpoint, std::move(values), sign);
  if (endpoint.byRatio)
    for (auto& value : values)
      if (value) value = sign * std::log(sign * *value);
  return values;
}

/// A difference on the scale of the test as the one that it makes in the endpoint's unit.
double inUnit(const TestedEndpoint& tested, double value) {
  return tested.endpoint.byRatio ? tested.reference * std::expm1(tested.sign * value) : value;
}

/// Why some of the values cannot be tested by their ratio; empty: all can.
std::string whyNoRatio(const EndpointSpec& endpoint, const Numbers& reference,
                       const Numbers& other) {
  if (!endpoint.byRatio) return {};
  const double sign = signOf(reference);
  const auto has = [](const auto& value) { return value.has_value(); };
  const auto fails = [sign](const auto& value) { return value && !(sign * *value > 0.0); };
  if (sign == 0.0 && std::ranges::any_of(reference, has))
    return "a relative margin is a share of the reference's value, which is 0 or of both signs "
           "here: give absolute";
  if (std::ranges::any_of(reference, fails) || std::ranges::any_of(other, fails))
    return "values that are 0 or of another sign than the reference's have no ratio to it";
  return {};
}

/// Of all mirrors together. Absent where a response or an equivalent change is not known.
std::optional<Bound> boundOf(std::string_view endpoint, const std::vector<SurrogateEngine>& mirrors,
                             const std::vector<EndpointResponse>& responses) {
  Bound bound;
  for (const SurrogateEngine& mirror : mirrors) {
    const auto late = reachOf(endpoint, mirror.late, responses);
    if (!late) return std::nullopt;
    double start = 0.0;
    for (const EndpointResponse& response : responses)
      if (response.endpoint == endpoint && response.bound)
        start = std::max(start, mirror.equivalent / response.change * *response.bound);
    bound.all += start + *late;
    bound.late += *late;
  }
  return bound;
}

bool isCarried(const EndpointPair& pair) {
  return pair.runsOfA != pair.a || pair.runsOfB != pair.b;
}

TestedEndpoint tested(const Case& setup, const EndpointSpec& endpoint, const Numbers& reference,
                      const Numbers& other) {
  const Margin& margin = setup.averaging.endpoints.at(std::string(endpoint.name));
  TestedEndpoint own{endpoint,
                     &margin,
                     endpointSample(endpoint, margin, reference, other),
                     signOf(reference),
                     0.0,
                     {},
                     whyNoRatio(endpoint, reference, other)};
  if (const auto mean = ensembleMean(testable(endpoint, reference, own.sign)))
    own.reference = mean->mean;
  return own;
}

std::vector<TestedEndpoint> familyOf(const Case& setup, std::span<const FlowRun> runs,
                                     const EndpointPair& pair,
                                     const std::vector<EndpointResponse>& responses) {
  const std::size_t packings = packingsOf(runs);
  const Runs ours = finishedRuns(runs, pair.runsOfA), theirs = finishedRuns(runs, pair.runsOfB);
  std::vector<TestedEndpoint> family;
  for (const EndpointSpec& endpoint : endpointsOf(setup)) {
    TestedEndpoint tested =
        studies::tested(setup, endpoint, endpointByPacking(endpoint, setup, ours, packings),
                        endpointByPacking(endpoint, setup, theirs, packings));
    for (const Runs& engine : {ours, theirs})
      if (tested.reason.empty()) tested.reason = missingValueReason(endpoint, setup, engine);
    if (isCarried(pair)) {
      tested.bound = boundOf(endpoint.name, pair.by, responses);
      // Nothing is known of the true difference: no verdict can stand on these runs.
      if (!tested.bound) continue;
      tested.sample.bias = tested.bound->all * tested.sample.margin;
    }
    family.push_back(std::move(tested));
  }
  return family;
}

/// All but what was found.
EndpointRow emptyRow(const std::string& a, const std::string& b, PairKind kind,
                     const EndpointSpec& endpoint, const Margin& margin) {
  EndpointRow row;
  row.a = a;
  row.b = b;
  row.kind = kind;
  row.endpoint = endpoint.name;
  row.unit = endpoint.unit;
  row.margin = margin.value;
  row.marginRelative = endpoint.byRatio;
  row.marginWhy = margin.why;
  return row;
}

/// @param looked  packings
EndpointRow rowOf(const EndpointPair& pair, const TestedEndpoint& tested,
                  const std::optional<InterimAnswer>& found, int looked) {
  EndpointRow row = emptyRow(pair.a, pair.b, pair.kind, tested.endpoint, *tested.margin);
  row.reason = tested.reason;
  if (pair.runsOfA != pair.a) row.surrogateA = pair.runsOfA;
  if (pair.runsOfB != pair.b) row.surrogateB = pair.runsOfB;
  if (tested.bound) {
    row.bound = tested.bound->all;
    row.reach = tested.bound->late;
  }
  if (!found) row.lost = looked;  // neither has anything
  if (!found) return row;
  row.verdict = found->verdict;
  row.look = static_cast<int>(found->look) + 1;
  row.packings = found->packings;
  row.lost = found->lost;
  if (found->packings == 0) return row;
  const double margin = tested.sample.margin, bias = tested.sample.bias;
  row.reference = tested.reference;
  row.difference = inUnit(tested, found->difference);
  row.distance = found->difference / margin;
  if (!found->low) return row;
  row.low = inUnit(tested, *found->low - bias);
  row.high = inUnit(tested, *found->high + bias);
  row.distanceLow = (*found->low - bias) / margin;
  row.distanceHigh = (*found->high + bias) / margin;
  return row;
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

/// A row and what it was made of.
struct JudgedEndpoint {
  EndpointRow row;
  TestedEndpoint tested;
  std::optional<InterimAnswer> found;
};

void addNeeds(std::vector<JudgedEndpoint>& judged, const InterimPlan& plan) {
  std::map<std::string_view, Pooled> scatter;
  for (const JudgedEndpoint& one : judged)
    if (one.found && one.found->standardError) {
      Pooled& pooled = scatter[one.tested.endpoint.name];
      const int dof = one.found->packings - 1;
      pooled.squares +=
          dof * *one.found->standardError * *one.found->standardError * one.found->packings;
      pooled.dof += dof;
    }
  for (JudgedEndpoint& one : judged) {
    const Pooled& pooled = scatter[one.tested.endpoint.name];
    if (one.row.verdict != Verdict::undecided || !one.found || pooled.dof == 0) continue;
    const double margin = one.tested.sample.margin, bias = one.tested.sample.bias;
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

/// The family of one pair after the looks that so many packings allow.
void judge(const EndpointPair& pair, const std::vector<TestedEndpoint>& family,
           const InterimPlan& plan, int available, std::vector<JudgedEndpoint>& judged) {
  std::vector<PairedSample> samples;
  for (const TestedEndpoint& tested : family) samples.push_back(tested.sample);
  const auto found = answersAfterInterims(samples, plan, available);
  const std::size_t looks = interimsTaken(plan, available);
  const int looked = looks > 0 ? plan.packings[looks - 1] : 0;
  for (std::size_t k = 0; k < family.size(); ++k)
    judged.push_back({rowOf(pair, family[k], found[k], looked), family[k], found[k]});
}

std::vector<EndpointRow> rowsOf(std::vector<JudgedEndpoint> judged, const InterimPlan& plan) {
  addNeeds(judged, plan);
  std::vector<EndpointRow> rows;
  for (JudgedEndpoint& one : judged) rows.push_back(std::move(one.row));
  return rows;
}

/// An endpoint of an engine whose start was run again.
struct RepeatedValue {
  std::optional<double> value;
  int without = 0;     ///< runs that have none
  std::string reason;  ///< why there is no value that can be judged
};

RepeatedValue repeatedValue(const EndpointSpec& endpoint, const Case& setup,
                            std::span<const FlowRun> runs, const std::string& engine) {
  const Runs own = finishedRuns(runs, engine);
  const Numbers values = endpointByPacking(endpoint, setup, own, closedFormRuns);
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
                                        const std::vector<EndpointPair>& pairs) {
  std::vector<EndpointRow> rows;
  for (const OwnEndpoint& own : setup.average->endpoints) {
    const EndpointSpec endpoint = endpointSpec(setup, own.name);
    const Margin& margin = setup.averaging.endpoints.at(own.name);
    const auto add = [&](const std::string& a, const std::string& b, PairKind kind,
                         const RepeatedValue& first) {
      rows.push_back(emptyRow(a, b, kind, endpoint, margin));
      answerExactly(rows.back(), first, repeatedValue(endpoint, setup, runs, b));
    };
    for (const std::string& engine : engines)
      add(closedFormName, engine, PairKind::closedForm, {own.expected, 0, {}});
    for (const EndpointPair& pair : pairs)
      if (!finishedRuns(runs, pair.a).empty() && !finishedRuns(runs, pair.b).empty())
        add(pair.a, pair.b, pair.kind, repeatedValue(endpoint, setup, runs, pair.a));
  }
  return rows;
}

InterimPlan interimPlanOf(const Case& setup) {
  const int first = flowPackings(setup);
  // Files are all there are: a further look would see them again.
  const bool oneLook = first < fewestPackings || packingsAreFiles(setup);
  return interimPlanAt(first, oneLook ? 1 : setup.looks.count, 1.0 - setup.averaging.confidence);
}

PairedSample endpointSample(const EndpointSpec& endpoint, const Margin& margin, Numbers reference,
                            Numbers other) {
  const double sign = signOf(reference);
  return {onScale(endpoint, std::move(reference), sign),
          onScale(endpoint, std::move(other), sign),
          testMargin(endpoint, margin),
          0.0,
          {}};
}

std::vector<EndpointRow> endpointRows(const Case& setup, const std::vector<EndpointValues>& family,
                                      const std::pair<std::string, std::string>& names,
                                      const InterimPlan& plan) {
  const EndpointPair pair{names.first, names.second, PairKind::peer, names.first, names.second};
  std::vector<TestedEndpoint> endpoints;
  for (const EndpointValues& values : family)
    endpoints.push_back(
        tested(setup, endpointSpec(setup, values.endpoint), values.reference, values.other));
  std::vector<JudgedEndpoint> judged;
  judge(pair, endpoints, plan, plan.packings.back(), judged);
  return rowsOf(std::move(judged), plan);
}

std::vector<EndpointRow> endpointRows(const Case& setup, std::span<const FlowRun> runs,
                                      const std::vector<EndpointPair>& pairs,
                                      const InterimPlan& plan, int available,
                                      const std::vector<EndpointResponse>& responses) {
  std::vector<JudgedEndpoint> judged;
  for (const EndpointPair& pair : pairs) {
    if (finishedRuns(runs, pair.runsOfA).empty() || finishedRuns(runs, pair.runsOfB).empty())
      continue;
    judge(pair, familyOf(setup, runs, pair, responses), plan, available, judged);
  }
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

EndpointResponse responseTo(const Case& setup, std::span<const FlowRun> runs,
                            std::span<const FlowRun> changed, const std::string& name,
                            const std::string& constant, double change, std::size_t packings) {
  const EndpointSpec endpoint = endpointSpec(setup, name);
  const auto valuesOf = [&](std::span<const FlowRun> all) {
    Runs finished;
    for (const FlowRun& run : all)
      if (run.finished()) finished.push_back(&run);
    return endpointByPacking(endpoint, setup, finished, packings);
  };
  EndpointResponse response{name, constant, change, {}, {}, {}, 0};
  const std::vector one = {endpointSample(endpoint, setup.averaging.endpoints.at(name),
                                          valuesOf(runs), valuesOf(changed))};
  const double margin = one.front().margin;
  const double bothTails = 1.0 - (1.0 - setup.averaging.confidence) / 2.0;
  const auto found = comparePaired(one, bothTails).front();
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
    const EndpointSpec endpoint = endpointSpec(setup, name);
    SpotCheckNumber number{name, {}, {}, {}, {}};
    const Numbers own = {endpointOf(endpoint, setup, mirror)};
    const Numbers pair =
        onScale(endpoint, {own.front(), endpointOf(endpoint, setup, engine)}, signOf(own));
    if (pair[0] && pair[1])
      number.difference = (*pair[1] - *pair[0]) / testMargin(endpoint, allowed);
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
