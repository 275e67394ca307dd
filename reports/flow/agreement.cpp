#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "reports/flow/endpoint_text.hpp"
#include "reports/flow/report.hpp"

namespace crossgrain::reports {

namespace {

/// The matrix' mark and colour of the same answer.
std::optional<Verdict> verdictOf(const CompareResults& results, const EndpointRow& row) {
  return endpointCell(results, row).verdict;
}

/// "206 ± 12": a value with half of its interval, a dash where it has none.
std::string withHalf(const std::string& value, std::optional<double> number,
                     std::optional<double> half) {
  if (!finite(number)) return absentText;
  const std::string both = readable(number, half);
  return both == readable(number) ? value + "\u00a0±\u00a0" + absentText : both;
}

/// "± 51.5 (25 %)": of a share of the reference in its unit too.
std::string marginText(const EndpointRow& row) {
  if (!row.marginRelative) return "± " + readableSetting(row.margin);
  const std::string share = fmt::format("{:.3g} %", 100.0 * row.margin);
  const auto reference = finite(row.reference);
  return reference ? fmt::format("± {} ({})", readable(row.margin * std::abs(*reference)), share)
                   : "± " + share;
}

Cell verdictCell(const CompareResults& results, const EndpointRow& row) {
  const std::optional<Verdict> verdict = verdictOf(results, row);
  std::string word = wordOf(row);
  if (verdict == Verdict::modelDifference) word += " by the declared law";
  if (verdict == Verdict::notMeasured && row.verdict != verdict) word = "not judged";
  Names more;
  if (row.verdict == Verdict::undecided && row.needs)
    more.push_back(fmt::format("{}{} packings", *row.needs,
                               !row.needsAtMost ? " or many more"
                               : *row.needs == *row.needsAtMost
                                   ? ""
                                   : fmt::format(" to {}", *row.needsAtMost)));
  if (row.lost > 0)
    more.push_back(counted(static_cast<std::size_t>(row.lost), "packing") + " failed");
  more.push_back(row.reason);
  return {std::move(word),
          {fmt::format("{}", fmt::join(nonEmpty(std::move(more)), "; "))},
          verdict,
          true};
}

/// Its distance in margins, alone.
Cell distanceCell(const CompareResults& results, const EndpointRow* row) {
  if (!row) return absentText;
  return {row->verdict == Verdict::notMeasured ? absentText : describeDistance(*row),
          {},
          verdictOf(results, *row),
          true};
}

std::string endpointLabel(const std::string& name, bool ofCell) {
  const std::string symbol = endpointSymbol(name, ofCell);
  return symbol == spaced(name) ? symbol : endpointWords(name) + " " + symbol;
}

/// Where the axis of a table's bars ends: it holds all intervals, up to four margins.
double reachOf(const Table& table) {
  double most = 1.5;
  for (const TableRow& row : table.rows)
    for (const Cell& cell : row.cells)
      if (cell.bar)
        for (const double end :
             {cell.bar->middle, cell.bar->low.value_or(0.0), cell.bar->high.value_or(0.0)})
          most = std::max(most, 1.05 * std::abs(end));
  return std::min(most, 4.0);
}

/// A forest plot: every endpoint of each engine against a, as an interval in margins and, beside
/// it, both values, the difference, the margin and the verdict in the endpoint's own unit.
Table endpointVerdicts(const CompareResults& results, const std::string& a, const Names& engines) {
  const Endpoints& endpoints = results.endpoints.rows;
  const bool closed = a == closedFormName;
  Table table{{"endpoint",
               {"difference in margins", Column::Kind::margins},
               numbers(closed ? "expected" : called(a)),
               numbers("engine"),
               numbers("difference"),
               "unit",
               numbers("margin"),
               "verdict"}};
  for (const std::string& engine : engines) {
    std::string group = engine;
    for (const std::string& name : endpointsOf(endpoints)) {
      const EndpointRow* const found = rowOf(endpoints, a, engine, name);
      if (!found) continue;
      const EndpointRow& row = *found;
      const auto [value, reference] = readablePair(row.value(), row.reference);
      Cell bar({}, {}, verdictOf(results, row));
      if (const auto distance = finite(row.distance))
        bar.bar = MarginBar{*distance, finite(row.distanceLow), finite(row.distanceHigh),
                            describeAnswer(row)};
      table.rows.push_back(
          {{endpointLabel(name, !results.region), std::move(bar),
            closed ? reference : withHalf(reference, row.reference, row.referenceHalf),
            closed ? value : withHalf(value, row.value(), row.valueHalf),
            readableInterval(row.difference, row.low, row.high, "", Sign::ofAll),
            row.unit == "-" ? "" : row.unit, marginText(row), verdictCell(results, row)},
           std::exchange(group, "")});
    }
  }
  table.reach = reachOf(table);
  return table;
}

/// Reasons of the margins.
List marginReasons(const Endpoints& endpoints, bool ofCell) {
  List reasons;
  for (const std::string& name : endpointsOf(endpoints))
    if (const auto* const row = findBy(endpoints, name, &EndpointRow::endpoint);
        !row->marginWhy.empty())
      reasons.items.push_back({endpointLabel(name, ofCell), row->marginWhy});
  return reasons;
}

/// Pairs of peers, or of mirrors, in the order of the results; an endpoint per column.
Table endpointPairTable(const CompareResults& results, bool peers) {
  Table table{{"pair"}};
  if (!peers) table.columns.emplace_back("difference of");
  const Names endpoints = endpointsOf(results.endpoints.rows);
  for (const std::string& name : endpoints)
    table.columns.emplace_back(endpointSymbol(name, !results.region));
  std::vector<std::pair<std::string, std::string>> seen;
  for (const EndpointRow& row : results.endpoints.rows) {
    if ((row.kind == PairKind::peer) != peers || row.kind == PairKind::closedForm ||
        row.a == medianName)
      continue;
    const std::pair pair(row.a, row.b);
    if (std::ranges::find(seen, pair) != seen.end()) continue;
    seen.push_back(pair);
    TableRow line{{row.a + " – " + row.b}};
    if (!peers)
      line.cells.emplace_back(row.kind == PairKind::mirrorModel ? "model" : "implementation");
    for (const std::string& name : endpoints)
      line.cells.push_back(
          distanceCell(results, rowOf(results.endpoints.rows, row.a, row.b, name)));
    table.rows.push_back(std::move(line));
  }
  return table;
}

std::string ringInWords(const AgreementRing& ring, const char* bin) {
  const std::string name = fmt::format("{} {}", bin, ring.ring + 1);
  if (!finite(ring.difference)) return name + ": nothing to compare";
  return fmt::format("{}: {}, margin {}", name,
                     readableDifference(ring.difference, ring.standardError),
                     readable(ring.margin));
}

/// Each field ring by ring, an engine per column.
Table ringTable(const CompareResults& results, const std::string& reference, const Names& peers) {
  const char* const bin = binWord(results);
  Table table{{"field"}};
  for (const std::string& peer : peers) table.columns.emplace_back(peer, Column::Kind::engine);
  for (const std::string& field : fieldsOf(results.agreement)) {
    TableRow row{{fieldLabel(field)}};
    for (const std::string& peer : peers) {
      Cell cell;
      if (const AgreementRow* pair = rowOf(results.agreement, reference, peer, field))
        for (const AgreementRing& ring : pair->rings)
          cell.strip.push_back({ring.verdict, ringInWords(ring, bin)});
      row.cells.push_back(std::move(cell));
    }
    table.rows.push_back(std::move(row));
  }
  table.note = fmt::format(
      "Each square is a {0}, {1}: ✓ within the {0}'s margin, ✗ beyond it, ? undecided. {0}s show "
      "where a difference is; they have no verdict of their own.",
      bin, results.region ? "in the order of their numbers" : "from the wheel outwards");
  return table;
}

List verdictReading(const CompareResults& results) {
  const bool paired = std::ranges::none_of(
      results.endpoints.rows, [](const EndpointRow& row) { return row.unpaired.has_value(); });
  return {
      {{"✓ agree",
        fmt::format("the difference{} lies within the margin (two one-sided t tests, {:.3g} % "
                    "confidence over all interim analyses together). No difference seen: its "
                    "interval contains 0. Small difference: it does not.",
                    paired ? ", paired over the same packings," : "",
                    100.0 * results.averaging.confidence)},
       {"✗ disagree", "it exceeds the margin (Holm's procedure over the endpoints of the pair)."},
       {"≈ borderline",
        "a difference is shown, and that it is below twice the margin; the margin lies in between. "
        "More packings will hardly change that."},
       {"? undecided",
        "none of these is shown. The number of packings is what decides with 90 % chance, for the "
        "ends of an 80 % interval of the scatter of all pairs."},
       {"Interim analyses",
        "packings are added until all is decided. A further analysis is no new chance of error: "
        "agree is tested at one level in every analysis, so much lower that all together have the "
        "chance that the confidence leaves (Pocock); disagree in each at its part of that chance, "
        "and the parts add up to it. What was decided stays."}}};
}

void addSurrogates(Blocks& blocks, const CompareResults& results) {
  if (results.endpoints.surrogates.empty()) return;
  List engines;
  for (const SurrogateEngine& own : results.endpoints.surrogates)
    engines.items.push_back({"", describe(own)});
  blocks.push_back(Details{
      "Evaluated through mirrors",
      {std::move(engines),
       Paragraph{"An engine that the lockstep comparison finds equivalent to its mirror needs no "
                 "packings of its own: the mirror runs them, and the engine one of them, compared "
                 "with the mirror's for faults that begin late. If averages respond to so small a "
                 "change in proportion, the engine's lie within B of the mirror's: ε_eq times what "
                 "10 % of the law's constants do to them. B is subtracted from the margin.",
                 Paragraph::Style::small}}});
}

}  // namespace

void addAgreement(Report& report, const CompareResults& results, const Engines& engines) {
  const Endpoints& endpoints = results.endpoints.rows;
  if (engines.empty()) return;
  const std::string& reference = referenceOf(results);
  const std::string called = referenceWords(results);
  const Names peers = peersOf(results, engines), closed = closedFormEngines(endpoints);
  const double falseAlarm = 100.0 * (1.0 - results.averaging.confidence);
  Blocks& blocks = report.section("agreement", "Agreement with " + called, "Agreement").blocks;
  const std::string reading = fmt::format(
      "A value is the mean over packings with half of its {:.3g} % interval, – where it has none. "
      "A difference has the interval that its verdict rests on, by paired packings where there "
      "are any. Band: the margin; arrow: it goes on beyond the axis. Beside undecided: how many "
      "packings decide with 90 % chance.",
      100.0 * results.averaging.confidence);
  if (!endpoints.empty()) {
    if (std::string drift = driftSentence(results, engines); !drift.empty())
      blocks.push_back(Paragraph{std::move(drift)});
    Table table = endpointVerdicts(results, reference, peers);
    table.note = fmt::format(
        "{} Agree is tested endpoint by endpoint, disagree over all endpoints of a pair: the "
        "chance "
        "of any false one is at most {:.3g} % for each pair.",
        reading, falseAlarm);
    if (!closed.empty()) {
      report.sections.back().title = "Agreement with closed forms";
      Table judged = endpointVerdicts(results, closedFormName, closed);
      judged.note =
          "The case gives the right value by a closed form. One start is run twice by every "
          "engine; "
          "a value that comes back the same has no scatter: within the margin it agrees, else it "
          "disagrees.";
      blocks.push_back(std::move(judged));
      if (!table.rows.empty()) blocks.push_back(Details{"Between engines", {std::move(table)}});
    } else {
      blocks.push_back(std::move(table));
    }
    addSurrogates(blocks, results);
    Blocks how = {verdictReading(results)};
    if (results.endpoints.looks.taken > 0)
      how.push_back(Paragraph{describe(results.endpoints.looks)});
    if (List reasons = marginReasons(endpoints, !results.region); !reasons.items.empty()) {
      how.push_back(Heading{"Reasons of the margins"});
      how.push_back(std::move(reasons));
    }
    blocks.push_back(Details{"How to read a verdict, and why margins are what they are", how});
  }
  if (Table pairs = endpointPairTable(results, true);
      pairs.rows.size() > peers.size() || reference == medianName)
    blocks.push_back(Details{"All pairs", {std::move(pairs)}});
  if (Table mirrors = endpointPairTable(results, false); !mirrors.rows.empty())
    blocks.push_back(Details{
        "Model difference or implementation error?",
        {Paragraph{
             "A mirror is the in-house engine set to a peer's documented conventions. Against "
             "the reference it shows the difference of models; against its peer that of the "
             "implementation."},
         std::move(mirrors)}});
  if (Table rings = ringTable(results, reference, peers); !rings.rows.empty())
    blocks.push_back(
        Details{fmt::format("Where: {0} by {0}", binWord(results)), {std::move(rings)}});
  if (blocks.empty()) report.sections.pop_back();
}

}  // namespace crossgrain::reports
