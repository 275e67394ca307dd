#include "reports/couette/endpoint_words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cases/endpoints.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"

namespace crossgrain::reports {

namespace {

const EndpointSpec* shippedEndpoint(const std::string& name) {
  const auto found = std::ranges::find(endpointTable(), name, &EndpointSpec::name);
  return found == endpointTable().end() ? nullptr : &*found;
}

std::string signedNumber(double value) {
  return fmt::format("{}{}", value < 0.0 ? "−" : "", readable(std::abs(value)));
}

/// Which endpoint of a canary differs by most margins.
const CanaryNumber* farthest(const std::vector<CanaryNumber>& canary) {
  const CanaryNumber* worst = nullptr;
  for (const CanaryNumber& number : canary)
    if (finite(number.difference) &&
        (!worst || std::abs(*number.difference) > std::abs(*worst->difference)))
      worst = &number;
  return worst;
}

}  // namespace

std::string endpointWords(const std::string& name) {
  const EndpointSpec* const endpoint = shippedEndpoint(name);
  return endpoint ? std::string(endpoint->words) : spaced(name);
}

std::string endpointSymbol(const std::string& name, bool ofCell) {
  const EndpointSpec* const endpoint = ofCell ? shippedEndpoint(name) : nullptr;
  return endpoint ? std::string(endpoint->symbol) : spaced(name);
}

std::string wordOf(Answer answer) {
  static constexpr std::array<const char*, 5> words = {"agree, no difference seen",
                                                       "agree, small difference", "borderline",
                                                       "disagree", "undecided"};
  return words[static_cast<std::size_t>(answer)];
}

std::string distanceInWords(const EndpointRow& row) {
  const auto distance = finite(row.distance), low = finite(row.distanceLow),
             high = finite(row.distanceHigh);
  if (!distance) return {};
  const std::string size = signedNumber(*distance) + " margins";
  if (!low || !high) return size;
  return fmt::format("{} ({} to {})", size, signedNumber(*low), signedNumber(*high));
}

std::string needsInWords(const EndpointRow& row) {
  if (row.answer != Answer::undecided || !row.needs) return {};
  if (!row.needsAtMost)
    return fmt::format("{} packings or many more decide with 90 % chance", *row.needs);
  if (*row.needs == *row.needsAtMost)
    return fmt::format("about {} packings decide with 90 % chance", *row.needs);
  return fmt::format("{} to {} packings decide with 90 % chance", *row.needs, *row.needsAtMost);
}

std::string valueInWords(const EndpointRow& row) {
  const std::string unit = row.unit == "-" ? "" : " " + row.unit;
  const auto expected = finite(row.reference), difference = finite(row.difference);
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  return fmt::format("{} for {}{}",
                     expected && difference ? number(*expected + *difference) : absentText,
                     expected ? number(*expected) : absentText, unit);
}

std::string carrierInWords(const EndpointRow& row) {
  std::vector<std::string> mirrors;
  for (const std::string& mirror : {row.carrierA, row.carrierB})
    if (!mirror.empty()) mirrors.push_back(mirror);
  if (mirrors.empty()) return {};
  std::string words =
      fmt::format("by {}, B = {} margins", fmt::join(mirrors, " and "), readable(row.bound));
  if (row.reach)
    words += fmt::format(", {} of it what the followed run could have missed", readable(row.reach));
  return words;
}

std::string answerInWords(const EndpointRow& row) {
  std::string words = wordOf(row.answer);
  if (row.kind == PairKind::closedForm)
    words += fmt::format(" with the closed form ({})", valueInWords(row));
  if (const std::string distance = distanceInWords(row); !distance.empty())
    words += ": " + distance;
  if (row.lost > 0) words += fmt::format(", {} lost", counted(std::size_t(row.lost), "packing"));
  if (!row.reason.empty()) words += fmt::format(" ({})", row.reason);
  for (const std::string& more : {carrierInWords(row), needsInWords(row)})
    if (!more.empty()) words += "; " + more;
  return words;
}

std::string sentenceOf(const CarriedEngine& own) {
  if (!own.carried)
    return fmt::format("{}: its mirror {} does not stand for it: {}.", own.engine, own.mirror,
                       own.alarm);
  // The rule of three: no event in n trials leaves at most 3/n, at 95 %.
  const double unseen = std::min(1.0, 3.0 / static_cast<double>(own.starts));
  std::string words = fmt::format(
      "{}: by its mirror {} (ε_eq {}; {} windows alike leave at most {:.0f} % of states unlike)",
      own.engine, own.mirror, readable(own.equivalent), own.starts, 100.0 * unseen);
  words += "; spot check: ";
  std::vector<std::string> parts;
  if (!own.late.equivalents.empty()) {
    std::vector<std::string> changes;
    for (const EquivalentChange& one : own.late.equivalents)
      changes.push_back(fmt::format("{} % of {}", readable(100.0 * one.change), one.constant));
    parts.push_back(fmt::format(
        "{} windows of {} over its own run of packing {} differ from the mirror as at most {} "
        "would",
        own.late.times.size(), shortDuration(own.late.length), own.late.packing,
        fmt::join(changes, " or ")));
  }
  if (const CanaryNumber* const worst = farthest(own.canary))
    parts.push_back(fmt::format(
        "its own run of packing {} is within chaos of the mirror's: {} margins of {} at most, "
        "where less than {} cannot be seen",
        own.canaryPacking, signedNumber(worst->difference.value_or(0.0)), spaced(worst->endpoint),
        readable(worst->reach)));
  return words + fmt::format("{}.", fmt::join(parts, "; "));
}

std::string sentenceOf(const AlarmRow& alarm) {
  return fmt::format("{} against {}: {}.", alarm.b, alarm.a, alarm.what);
}

std::string sentenceOf(const LooksFindings& looks) {
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
      "Looked at {} packings ({} of {}), {}{:.3g} of {:.3g} % chance of a false disagree spent; "
      "{}.",
      fmt::join(packings, ", "), looks.taken, counted(looks.planned.size(), "look"), agree,
      100.0 * spent, 100.0 * all, looks.ended);
}

std::string countsInWords(const std::vector<const EndpointRow*>& rows) {
  std::vector<std::string> agree, borderline, disagree, undecided;
  for (const EndpointRow* row : rows) {
    auto& list = agrees(row->answer)                 ? agree
                 : row->answer == Answer::borderline ? borderline
                 : row->answer == Answer::disagree   ? disagree
                                                     : undecided;
    list.push_back(spaced(row->endpoint));
  }
  std::string words = fmt::format("{} of {} agree", agree.size(), counted(rows.size(), "endpoint"));
  const auto add = [&](const std::vector<std::string>& list, const char* what) {
    if (list.empty()) return;
    words += fmt::format(", {} {}", list.size(), what);
    if (list.size() < rows.size()) words += fmt::format(" ({})", fmt::join(list, ", "));
  };
  add(disagree, "disagree");
  add(borderline, "borderline");
  add(undecided, "undecided");
  return words;
}

}  // namespace crossgrain::reports
