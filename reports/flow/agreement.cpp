#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"
#include "reports/flow/endpoint_text.hpp"
#include "reports/flow/figures.hpp"
#include "reports/flow/overview.hpp"
#include "reports/flow/report.hpp"

namespace crossgrain::reports {

namespace {

using Names = std::vector<std::string>;

/// The matrix' mark and colour of the same answer. @param brief  the distance alone
Cell answerCell(const CompareResults& results, const EndpointRow* row, bool brief = false) {
  if (!row) return absentText;
  const std::optional<Verdict> verdict = endpointCell(results, *row).verdict;
  std::string word = wordOf(*row);
  if (verdict == Verdict::modelDifference) word += " by the declared law";
  if (verdict == Verdict::notMeasured && row->verdict != verdict) word = "not judged";
  const std::string distance = describeDistance(*row);
  if (brief)
    return {row->verdict == Verdict::notMeasured ? absentText : distance, {}, verdict, true};
  std::vector<std::string> more = {describeSurrogate(*row), describeNeeds(*row)};
  if (row->lost > 0)
    more.push_back(counted(static_cast<std::size_t>(row->lost), "packing") + " failed");
  more.push_back(row->reason);
  std::string detail =
      row->kind == PairKind::closedForm ? describeValue(*row) + ", " + distance : distance;
  return {std::move(word),
          {std::move(detail), fmt::format("{}", fmt::join(nonEmpty(std::move(more)), "; "))},
          verdict,
          true};
}

std::string endpointLabel(const std::string& name, bool ofCell) {
  const std::string symbol = endpointSymbol(name, ofCell);
  return symbol == spaced(name) ? symbol : endpointWords(name) + " " + symbol;
}

std::string marginInWords(const Endpoints& endpoints, const std::string& name) {
  const auto row = std::ranges::find(endpoints, name, &EndpointRow::endpoint);
  const std::string unit = row->unit == "-" ? "" : " " + row->unit;
  const std::string size = row->marginRelative
                               ? fmt::format("± {:.3g} % of the reference", row->margin * 100.0)
                               : "± " + readableSetting(row->margin) + unit;
  return row->marginWhy.empty() ? size : size + ": " + row->marginWhy;
}

/// Every endpoint with its margin; an engine per column, against a.
Table endpointVerdicts(const CompareResults& results, const std::string& a, const Names& engines) {
  const Endpoints& endpoints = results.endpoints.rows;
  Table table{{"endpoint and margin"}, {}};
  for (const std::string& engine : engines)
    table.columns.emplace_back(engine, Column::Kind::engine);
  for (const std::string& name : endpointsOf(endpoints)) {
    TableRow row{{{endpointLabel(name, !results.region), {marginInWords(endpoints, name)}}}};
    for (const std::string& engine : engines)
      row.cells.push_back(answerCell(results, rowOf(endpoints, a, engine, name)));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Pairs of peers, or of mirrors, in the order of the results; an endpoint per column.
Table endpointPairTable(const CompareResults& results, bool peers) {
  Table table{{"pair"}, {}};
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
          answerCell(results, rowOf(results.endpoints.rows, row.a, row.b, name), true));
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
  Table table{{"field"}, {}};
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
        fmt::format("the difference{} lies within the margin "
                    "(two one-sided t tests, {:.3g} % confidence over all interim analyses "
                    "together). No difference seen: its interval contains 0. Small difference: "
                    "it does not.",
                    paired ? ", paired over the same packings," : "",
                    100.0 * results.averaging.confidence)},
       {"✗ disagree", "it exceeds the margin (Holm's procedure over the endpoints of the pair)."},
       {"≈ borderline",
        "a difference is shown, and that it is below twice the margin; the margin lies in "
        "between. More packings will hardly change that."},
       {"? undecided",
        "none of these is shown. The number of packings is what decides with 90 % chance, for "
        "the ends of an 80 % interval of the scatter of all pairs."},
       {"Interim analyses",
        "packings are added until all is decided. A further analysis is no new chance of "
        "error: agree is tested at one level in every analysis, so much lower that all "
        "together have the chance that the confidence leaves (Pocock); disagree in each at its "
        "part of that chance, and the parts add up to it. What was decided stays."}}};
}

void addClosedForms(Blocks& blocks, const CompareResults& results) {
  const Names judged = closedFormEngines(results.endpoints.rows);
  if (judged.empty()) return;
  Table table = endpointVerdicts(results, closedFormName, judged);
  table.note =
      "The case gives the right value by a closed form. One start is run twice by every engine; a "
      "value that comes back the same has no scatter: within the margin it agrees, else it "
      "disagrees.";
  blocks.push_back(Heading{"Closed forms"});
  blocks.push_back(std::move(table));
  blocks.push_back(Heading{"Between engines"});
}

void addSurrogates(Blocks& blocks, const CompareResults& results) {
  if (results.endpoints.surrogates.empty()) return;
  List engines;
  for (const SurrogateEngine& own : results.endpoints.surrogates)
    engines.items.push_back({"", describe(own)});
  blocks.push_back(Heading{"Evaluated through mirrors"});
  blocks.push_back(std::move(engines));
  blocks.push_back(Paragraph{
      "An engine that the lockstep comparison finds equivalent to its mirror needs no packings of "
      "its own: the mirror runs them, and the engine one of them, compared with the mirror's for "
      "faults that begin late. If averages respond to so small a change in proportion, the "
      "engine's lie within B of the mirror's: ε_eq times what 10 % of the law's constants do to "
      "them. B is subtracted from the margin.",
      Paragraph::Style::small});
}

}  // namespace

void addAgreement(Report& report, const CompareResults& results,
                  const std::vector<EngineRuns>& engines) {
  const Endpoints& endpoints = results.endpoints.rows;
  if (engines.empty()) return;
  const std::string& reference = referenceOf(results);
  const std::string called = referenceWords(results);
  const Names peers = peersOf(results, engines);
  const double falseAlarm = 100.0 * (1.0 - results.averaging.confidence);
  Blocks& blocks = report.section("agreement", "Agreement with " + called, "Agreement").blocks;
  if (!endpoints.empty()) {
    addClosedForms(blocks, results);
    if (results.endpoints.looks.taken > 0)
      blocks.push_back(Paragraph{describe(results.endpoints.looks)});
    Table table = endpointVerdicts(results, reference, peers);
    table.note = fmt::format(
        "A distance is the engine's value minus that of {}, in margins, with the interval that the "
        "verdict rests on. Agree is tested endpoint by endpoint, disagree over all endpoints of a "
        "pair: the chance of any false one is at most {:.3g} % for each pair.",
        called, falseAlarm);
    blocks.push_back(std::move(table));
    addSurrogates(blocks, results);
    blocks.push_back(Details{"How to read a verdict", {verdictReading(results)}});
  }
  if (Table pairs = endpointPairTable(results, true);
      pairs.rows.size() > peers.size() || reference == medianName)
    blocks.push_back(Details{"All pairs", {std::move(pairs)}});
  if (Table mirrors = endpointPairTable(results, false); !mirrors.rows.empty()) {
    blocks.push_back(Heading{"Model difference or implementation error?"});
    blocks.push_back(Paragraph{
        "A mirror is the in-house engine set to a peer's documented conventions. Against the "
        "reference it shows the difference of models; against its peer that of the "
        "implementation."});
    blocks.push_back(std::move(mirrors));
  }
  if (Table rings = ringTable(results, reference, peers); !rings.rows.empty()) {
    blocks.push_back(Heading{fmt::format("Where: {0} by {0}", binWord(results))});
    blocks.push_back(std::move(rings));
  }
  if (blocks.empty()) report.sections.pop_back();
}

}  // namespace crossgrain::reports
