#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview_marks.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/agreement_entries.hpp"
#include "reports/couette/compare_views.hpp"
#include "reports/couette/endpoint_words.hpp"
#include "reports/couette/figures.hpp"
#include "reports/couette/overview.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineRuns>;

/// Mark and class of style.css.
struct Mark {
  const char *symbol, *style;
};

/// Of a ring, which has no verdict: where its interval lies.
Mark markOf(Verdict ring) {
  static constexpr std::array<Mark, 3> marks = {
      {{"·", "agree"}, {"×", "disagree"}, {"", "undecided"}}};
  return marks[static_cast<std::size_t>(ring)];
}

/// The matrix' mark and colour of the same answer.
Json answerCell(const CompareResults& results, const EndpointRow* row) {
  if (!row)
    return {{"verdict", ""}, {"symbol", ""}, {"word", absentText}, {"detail", ""}, {"more", ""}};
  const OverviewCell cell = endpointCell(results, *row);
  const CellLook look = lookOf(cell.state);
  std::string more = carrierInWords(*row);
  if (const std::string needs = needsInWords(*row); !needs.empty())
    more += (more.empty() ? "" : "; ") + needs;
  if (row->lost > 0)
    more += fmt::format("{}{} lost", more.empty() ? "" : "; ",
                        counted(static_cast<std::size_t>(row->lost), "packing"));
  std::string word = wordOf(row->answer);
  if (cell.state == CellState::modelDifference) word += " by the declared law";
  if (cell.state == CellState::notMeasured) word = "not judged";
  return {{"verdict", look.cssClass},
          {"symbol", look.mark},
          {"word", std::move(word)},
          {"detail", distanceInWords(*row)},
          {"more", more}};
}

std::string endpointLabel(const std::string& name, bool ofCell) {
  const std::string symbol = endpointSymbol(name, ofCell);
  return mathHtml(symbol == spaced(name) ? symbol : endpointWords(name) + " " + symbol);
}

std::string marginInWords(const Endpoints& endpoints, const std::string& name) {
  const auto row = std::ranges::find(endpoints, name, &EndpointRow::endpoint);
  const std::string unit = row->unit == "-" ? "" : " " + row->unit;
  const std::string size = row->marginRelative
                               ? fmt::format("± {:.3g} % of the reference", row->margin * 100.0)
                               : "± " + readableSetting(row->margin) + unit;
  return row->marginWhy.empty() ? size : size + ": " + row->marginWhy;
}

Json endpointRows(const CompareResults& results, const std::string& reference,
                  const std::vector<std::string>& peers) {
  const Endpoints& endpoints = results.endpoints.rows;
  const bool ofCell = !results.region;
  Json rows = Json::array();
  for (const std::string& name : endpointsOf(endpoints)) {
    Json cells = Json::array();
    for (const std::string& peer : peers)
      cells.push_back(answerCell(results, rowOf(endpoints, reference, peer, name)));
    rows.push_back({{"label", endpointLabel(name, ofCell)},
                    {"margin", marginInWords(endpoints, name)},
                    {"cells", std::move(cells)}});
  }
  return rows;
}

Json cellsOf(const CompareResults& results, const std::string& a, const std::string& b) {
  const Endpoints& endpoints = results.endpoints.rows;
  Json cells = Json::array();
  for (const std::string& name : endpointsOf(endpoints))
    cells.push_back(answerCell(results, rowOf(endpoints, a, b, name)));
  return cells;
}

/// Pairs of a kind, in the order of the results.
Json pairRows(const CompareResults& results, bool peers) {
  Json rows = Json::array();
  std::vector<std::pair<std::string, std::string>> seen;
  for (const EndpointRow& row : results.endpoints.rows) {
    if ((row.kind == PairKind::peer) != peers) continue;
    const std::pair pair(row.a, row.b);
    if (std::ranges::find(seen, pair) != seen.end()) continue;
    seen.push_back(pair);
    rows.push_back({{"pair", row.a + " – " + row.b},
                    {"what", row.kind == PairKind::mirrorModel ? "model" : "implementation"},
                    {"cells", cellsOf(results, row.a, row.b)}});
  }
  return rows;
}

std::string ringInWords(const AgreementRing& ring, const char* bin) {
  const std::string name = fmt::format("{} {}", bin, ring.ring + 1);
  if (!finite(ring.difference)) return name + ": nothing to compare";
  return fmt::format("{}: {}, margin {}", name,
                     readableDifference(ring.difference, ring.standardError),
                     readable(ring.margin));
}

Json strip(const AgreementRow* row, const char* bin) {
  Json rings = Json::array();
  if (row)
    for (const AgreementRing& ring : row->rings) {
      const Mark mark = markOf(ring.verdict);
      rings.push_back(
          {{"verdict", mark.style}, {"symbol", mark.symbol}, {"title", ringInWords(ring, bin)}});
    }
  return rings;
}

Json ringRows(const Agreement& agreement, const std::string& reference,
              const std::vector<std::string>& peers, const char* bin) {
  Json rows = Json::array();
  for (const std::string& field : fieldsOf(agreement)) {
    Json cells = Json::array();
    for (const std::string& peer : peers)
      cells.push_back({{"strip", strip(rowOf(agreement, reference, peer, field), bin)}});
    rows.push_back({{"label", fieldLabel(field)}, {"cells", std::move(cells)}});
  }
  return rows;
}

Json sentencesOf(const auto& rows) {
  Json sentences = Json::array();
  for (const auto& row : rows) sentences.push_back(sentenceOf(row));
  return sentences;
}

}  // namespace

void addAgreement(Json& view, const CompareResults& results, const Engines& engines) {
  const Endpoints& endpoints = results.endpoints.rows;
  const std::string reference = engines.empty() ? std::string() : engines.front().name;
  const auto peers = peersOf(endpoints, engines);
  view["reference"] = reference;
  view["peerColumns"] = peers;
  view["endpoints"] = endpointRows(results, reference, peers);
  view["hasAgreement"] = !endpoints.empty();
  view["endpointColumns"] = Json::array();
  for (const std::string& name : endpointsOf(endpoints))
    view["endpointColumns"].push_back(mathHtml(endpointSymbol(name, !results.region)));
  view["pairwise"] = pairRows(results, true);
  view["hasPairwise"] = view["pairwise"].size() > peers.size();
  view["mirrors"] = pairRows(results, false);
  view["hasMirrors"] = !view["mirrors"].empty();
  view["carried"] = sentencesOf(results.endpoints.carried);
  view["hasCarried"] = !results.endpoints.carried.empty();
  view["looks"] = results.endpoints.looks.taken > 0 ? sentenceOf(results.endpoints.looks) : "";
  view["rings"] = ringRows(results.agreement, reference, peers, binWord(results));
  view["hasRings"] = !view["rings"].empty();
  view["bin"] = binWord(results);
  view["bins"] = results.region ? "Bins" : "Rings";
  view["binOrder"] = results.region ? "in the order of their numbers" : "from the wheel outwards";
  const double confidence = results.averaging.confidence;
  view["confidence"] = fmt::format("{:.3g} %", confidence * 100.0);
  view["falseAlarm"] = fmt::format("{:.3g} %", (1.0 - confidence) * 100.0);
}

}  // namespace crossgrain::reports
