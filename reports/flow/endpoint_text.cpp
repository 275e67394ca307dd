#include "reports/flow/endpoint_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "cases/endpoints.hpp"
#include "reports/common/text.hpp"
#include "results/lockstep_text.hpp"

namespace crossgrain::reports {

namespace {

const Endpoint* shippedEndpoint(const std::string& name) {
  return findBy(endpointTable(), name, &Endpoint::name);
}

/// Which endpoint of a spot-check run differs by most margins.
const SpotCheckNumber* farthest(const std::vector<SpotCheckNumber>& spotCheck) {
  const SpotCheckNumber* worst = nullptr;
  for (const SpotCheckNumber& number : spotCheck)
    if (finite(number.difference) &&
        (!worst || std::abs(*number.difference) > std::abs(*worst->difference)))
      worst = &number;
  return worst;
}

bool isOf(const auto& row, const std::string& a, const std::string& b) {
  return (row.a == a && row.b == b) || (row.a == b && row.b == a);
}

/// The different values of a member, in the order of the rows.
Names differentOnes(const auto& rows, auto member) {
  Names values;
  for (const auto& row : rows) addOnce(values, row.*member);
  return values;
}

template <typename Row>
const Row* find(const std::vector<Row>& rows, const std::string& a, const std::string& b,
                std::string Row::*member, const std::string& value) {
  return findIf(rows, [&](const Row& row) { return row.*member == value && isOf(row, a, b); });
}

}  // namespace

std::string endpointWords(const std::string& name) {
  const Endpoint* const endpoint = shippedEndpoint(name);
  return endpoint ? std::string(endpoint->words) : spaced(name);
}

std::string endpointSymbol(const std::string& name, bool ofCell) {
  const Endpoint* const endpoint = ofCell ? shippedEndpoint(name) : nullptr;
  return endpoint ? std::string(endpoint->symbol) : spaced(name);
}

std::string wordOf(const EndpointRow& row) {
  if (row.verdict == Verdict::notMeasured) return absentText;
  return (row.verdict == Verdict::pass ? "agree, " : "") + spaced(row.answer());
}

std::string describeDistance(const EndpointRow& row) {
  if (!finite(row.distance)) return {};
  return readableInterval(row.distance, row.distanceLow, row.distanceHigh, " margins");
}

std::string describeNeeds(const EndpointRow& row) {
  if (row.verdict != Verdict::undecided || !row.needs) return {};
  if (!row.needsAtMost)
    return fmt::format("{} packings or many more decide with 90 % chance", *row.needs);
  if (*row.needs == *row.needsAtMost)
    return fmt::format("about {} packings decide with 90 % chance", *row.needs);
  return fmt::format("{} to {} packings decide with 90 % chance", *row.needs, *row.needsAtMost);
}

std::string describeValue(const EndpointRow& row) {
  const std::string unit = row.unit == "-" ? "" : " " + row.unit;
  const auto [value, expected] = readablePair(row.value(), row.reference);
  return fmt::format("{} for {}{}", value, expected, unit);
}

std::string describeSurrogate(const EndpointRow& row) {
  Names mirrors;
  for (const std::string& mirror : {row.surrogateA, row.surrogateB})
    if (!mirror.empty()) mirrors.push_back(mirror);
  if (mirrors.empty()) return {};
  std::string words =
      fmt::format("through {}, B = {} margins", fmt::join(mirrors, " and "), readable(row.bound));
  if (row.reach)
    words +=
        fmt::format(", {} of it could have been missed by the followed run", readable(row.reach));
  return words;
}

std::string describeAnswer(const EndpointRow& row) {
  std::string words = wordOf(row);
  if (row.kind == PairKind::closedForm)
    words += fmt::format(" with the closed form ({})", describeValue(row));
  if (const std::string distance = describeDistance(row); !distance.empty())
    words += ": " + distance;
  if (row.unpaired) words += fmt::format(", {} against {} runs", row.unpaired->b, row.unpaired->a);
  if (row.lost > 0) words += fmt::format(", {} failed", counted(std::size_t(row.lost), "packing"));
  if (!row.reason.empty()) words += fmt::format(" ({})", row.reason);
  return fmt::format(
      "{}", fmt::join(nonEmpty({words, describeSurrogate(row), describeNeeds(row)}), "; "));
}

std::string describe(const SurrogateEngine& own) {
  if (!own.inUse)
    return fmt::format("{}: its mirror {} is no surrogate for it: {}.", own.engine, own.mirror,
                       own.alarm);
  // The rule of three: no event in n trials leaves at most 3/n, at 95 %.
  const double unseen = std::min(1.0, 3.0 / static_cast<double>(own.starts));
  std::string words = fmt::format(
      "{}: evaluated through its mirror {} (ε_eq {}; {} equal windows leave at most {:.0f} % of "
      "states different)",
      own.engine, own.mirror, readable(own.equivalent), own.starts, 100.0 * unseen);
  words += "; spot check: ";
  Names parts;
  if (!own.late.equivalents.empty()) {
    Names changes;
    for (const EquivalentChange& one : own.late.equivalents)
      changes.push_back(
          fmt::format("{} % of {}", readable(100.0 * one.change), constantSymbol(one.constant)));
    parts.push_back(
        fmt::format("{} windows of {} over its own run of packing {} differ from the mirror as at "
                    "most {} would",
                    own.late.times.size(), shortDuration(own.late.length), own.late.packing,
                    fmt::join(changes, " or ")));
  }
  if (const SpotCheckNumber* const worst = farthest(own.spotCheck))
    parts.push_back(
        fmt::format("its own run of packing {} differs from the mirror's by no more than chaos: {} "
                    "margins of {} at most, where less than {} cannot be seen",
                    own.spotCheckPacking, readable(worst->difference), spaced(worst->endpoint),
                    readable(worst->reach)));
  return words + fmt::format("{}.", fmt::join(parts, "; "));
}

std::string describe(const AlarmRow& alarm) {
  return fmt::format("{} against {}: {}.", alarm.b, called(alarm.a), alarm.what);
}

std::string describe(const InterimFindings& looks) {
  std::vector<int> packings;
  double spent = 0.0, all = 0.0;
  for (std::size_t k = 0; k < looks.planned.size(); ++k) {
    all += looks.planned[k].alpha;
    if (k >= looks.taken) continue;
    packings.push_back(looks.planned[k].packings);
    spent += looks.planned[k].alpha;
  }
  const std::string agree = looks.agreeAlpha ? fmt::format("agree tested at {:.3g} % in each; ",
                                                           100.0 * *looks.agreeAlpha)
                                             : "";
  return fmt::format(
      "Analysed after {} packings ({} of {} interim analyses), {}{:.3g} of {:.3g} % chance of a "
      "false disagree spent; {}.",
      fmt::join(packings, ", "), looks.taken, looks.planned.size(), agree, 100.0 * spent,
      100.0 * all, looks.ended);
}

Names fieldsOf(const Agreement& agreement) {
  return differentOnes(agreement, &AgreementRow::field);
}

Names endpointsOf(const Endpoints& endpoints) {
  return differentOnes(endpoints, &EndpointRow::endpoint);
}

const AgreementRow* rowOf(const Agreement& agreement, const std::string& a, const std::string& b,
                          const std::string& field) {
  return find(agreement, a, b, &AgreementRow::field, field);
}

const EndpointRow* rowOf(const Endpoints& endpoints, const std::string& a, const std::string& b,
                         const std::string& endpoint) {
  return find(endpoints, a, b, &EndpointRow::endpoint, endpoint);
}

std::vector<const EndpointRow*> rowsOf(const Endpoints& endpoints, const std::string& a,
                                       const std::string& b) {
  std::vector<const EndpointRow*> rows;
  for (const EndpointRow& row : endpoints)
    if (isOf(row, a, b)) rows.push_back(&row);
  return rows;
}

Names closedFormEngines(const Endpoints& endpoints) {
  Endpoints rows = endpoints;
  std::erase_if(rows, [](const EndpointRow& row) { return row.kind != PairKind::closedForm; });
  return differentOnes(rows, &EndpointRow::b);
}

std::string called(const std::string& engine) {
  return engine == medianName ? "the median of the others" : engine;
}

std::string referenceWords(const CompareResults& results) {
  return called(referenceOf(results));
}

Names peersOf(const CompareResults& results, const Engines& engines) {
  Names peers;
  for (const EngineRuns& engine : engines)
    if (engine.name != referenceOf(results) &&
        std::ranges::any_of(results.endpoints.rows, [&](const EndpointRow& row) {
          return row.kind == PairKind::peer && isOf(row, referenceOf(results), engine.name);
        }))
      peers.push_back(engine.name);
  return peers;
}

}  // namespace crossgrain::reports
