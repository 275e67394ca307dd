#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/agreement_entries.hpp"
#include "reports/couette/compare_views.hpp"

namespace crossgrain::reports {

namespace {

using Engines = std::vector<EngineRuns>;

const char* symbolOf(Verdict verdict) {
  static constexpr const char* symbols[] = {"✓", "✗", "?"};  // agree, disagree, undecided
  return symbols[static_cast<std::size_t>(verdict)];
}

std::string ringName(const AgreementRing& ring) {
  return fmt::format("ring {}", ring.ring + 1);
}

/// The ring whose difference is largest against its margin, or null.
const AgreementRing* worstRing(const AgreementRow& row) {
  const AgreementRing* worst = row.rings.empty() ? nullptr : &row.rings.front();
  double most = -1.0;
  for (const AgreementRing& ring : row.rings) {
    const auto difference = finite(ring.difference), margin = finite(ring.margin);
    if (!difference) continue;
    const double here = margin && *margin > 0.0 ? std::abs(*difference) / *margin : 0.0;
    if (here <= most) continue;
    most = here;
    worst = &ring;
  }
  return worst;
}

/// low and high are the ring's own interval. That it lies outside the margin alone is no verdict:
/// among so many rings some do by chance.
std::string aloneBeyond(const AgreementRing& ring) {
  const auto low = finite(ring.low), high = finite(ring.high), margin = finite(ring.margin);
  if (ring.verdict != Verdict::undecided || !low || !high || !margin) return {};
  if (!(*low > *margin || *high < -*margin)) return {};
  return "; alone it would be beyond, among all rings and fields (Holm) that is not shown";
}

std::string ringInWords(const AgreementRing* ring) {
  if (!ring || !finite(ring->difference)) return {};
  return fmt::format("{}: {}, margin {}{}", ringName(*ring),
                     readableDifference(ring->difference, ring->standardError),
                     readable(ring->margin), aloneBeyond(*ring));
}

/// More packings, or longer runs of the same ones; where those cannot decide, packings differ.
std::string moreInWords(const AgreementRow& row) {
  const auto packings = row.morePackings;
  const auto rotations = finite(row.moreRotations);
  if (row.verdict != Verdict::undecided || (!packings && !rotations)) return {};
  if (!rotations) return "needs " + morePackings(*packings) + "; longer runs would not do";
  const std::string longer =
      fmt::format("about {} more rotations of each run", readable(rotations));
  return "needs " + (packings ? morePackings(*packings) + ", or " + longer : longer);
}

/// The smallest difference that is found 9 times out of 10, in the best ring and in the worst.
std::string detectsInWords(const AgreementRow& row) {
  const AgreementRing *best = nullptr, *worst = nullptr;
  for (const AgreementRing& ring : row.rings) {
    if (!finite(ring.detects)) continue;
    if (!best || *ring.detects < *best->detects) best = &ring;
    if (!worst || *ring.detects > *worst->detects) worst = &ring;
  }
  if (!best) return absentText;
  const auto says = [](const AgreementRing& ring) {
    return fmt::format("{} in {}", readable(ring.detects), ringName(ring));
  };
  return best == worst ? says(*best) : says(*best) + ", " + says(*worst);
}

Json strip(const AgreementRow& row) {
  Json rings = Json::array();
  for (const AgreementRing& ring : row.rings)
    rings.push_back({{"verdict", toString(ring.verdict)},
                     {"symbol", symbolOf(ring.verdict)},
                     {"title", ringInWords(&ring)}});
  return rings;
}

Json verdictCell(const AgreementRow* row) {
  if (!row)
    return {{"verdict", ""},          {"symbol", ""},     {"word", absentText},
            {"detail", ""},           {"more", ""},       {"detects", absentText},
            {"strip", Json::array()}, {"hasStrip", false}};
  return {{"verdict", toString(row->verdict)},
          {"symbol", symbolOf(row->verdict)},
          {"word", toString(row->verdict)},
          {"detail", ringInWords(worstRing(*row))},
          {"more", moreInWords(*row)},
          {"detects", detectsInWords(*row)},
          {"strip", strip(*row)},
          {"hasStrip", !row->rings.empty()}};
}

Json fieldCells(const Agreement& agreement, const std::vector<std::string>& fields,
                const std::string& a, const std::string& b) {
  Json cells = Json::array();
  for (const std::string& field : fields)
    cells.push_back(verdictCell(rowOf(agreement, a, b, field)));
  return cells;
}

std::string unitOf(const CompareResults& results, const std::string& field) {
  if (results.runs.empty()) return {};
  const Profile* profile = profileOf(results.runs.front().profiles, field);
  return profile && profile->unit != "-" && profile->unit != "1" ? profile->unit : std::string();
}

std::string marginInWords(const CompareResults& results, const std::string& field) {
  const auto row = std::ranges::find(results.agreement, field, &AgreementRow::field);
  if (row == results.agreement.end() || !finite(row->margin)) return {};
  const std::string unit = unitOf(results, field);
  const std::string size =
      row->marginRelative ? fmt::format("± {:.3g} % of the reference", *row->margin * 100.0)
                          : "± " + readableSetting(row->margin) + (unit.empty() ? "" : " " + unit);
  return row->marginWhy.empty() ? size : size + ": " + row->marginWhy;
}

Json agreementRows(const CompareResults& results, const std::vector<std::string>& fields,
                   const std::string& reference, const std::vector<std::string>& peers) {
  Json rows = Json::array();
  for (const std::string& field : fields) {
    Json cells = Json::array();
    for (const std::string& peer : peers)
      cells.push_back(verdictCell(rowOf(results.agreement, reference, peer, field)));
    rows.push_back({{"label", fieldLabel(field)},
                    {"margin", marginInWords(results, field)},
                    {"cells", std::move(cells)}});
  }
  return rows;
}

Json pairRows(const Agreement& agreement, const std::vector<std::string>& fields,
              const Engines& engines) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < engines.size(); ++i)
    for (std::size_t j = i + 1; j < engines.size(); ++j)
      if (engines[i].mirrors.empty() && engines[j].mirrors.empty() &&
          compared(agreement, engines[i].name, engines[j].name))
        rows.push_back(
            {{"pair", engines[i].name + " – " + engines[j].name},
             {"cells", fieldCells(agreement, fields, engines[i].name, engines[j].name)}});
  return rows;
}

Json mirrorRows(const Agreement& agreement, const std::vector<std::string>& fields,
                const Engines& engines) {
  Json rows = Json::array();
  for (const EngineRuns& mirror : engines) {
    if (mirror.mirrors.empty()) continue;
    const std::pair<const char*, std::string> sides[] = {{"model", engines.front().name},
                                                         {"implementation", mirror.mirrors}};
    for (const auto& [what, other] : sides)
      if (compared(agreement, mirror.name, other))
        rows.push_back({{"peer", mirror.mirrors},
                        {"what", what},
                        {"pair", mirror.name + " – " + other},
                        {"cells", fieldCells(agreement, fields, mirror.name, other)}});
  }
  return rows;
}

}  // namespace

void addAgreement(Json& view, const CompareResults& results, const Engines& engines) {
  const Agreement& agreement = results.agreement;
  const std::vector<std::string> fields = fieldsOf(agreement);
  const std::string reference = engines.empty() ? std::string() : engines.front().name;
  const auto peers = peersOf(agreement, engines);
  view["reference"] = reference;
  view["peerColumns"] = peers;
  view["agreement"] = agreementRows(results, fields, reference, peers);
  view["hasAgreement"] = !peers.empty();
  view["fieldColumns"] = Json::array();
  for (const std::string& field : fields) view["fieldColumns"].push_back(fieldSymbol(field));
  view["pairwise"] = pairRows(agreement, fields, engines);
  view["hasPairwise"] = view["pairwise"].size() > peers.size();
  view["mirrors"] = engines.empty() ? Json::array() : mirrorRows(agreement, fields, engines);
  view["hasMirrors"] = !view["mirrors"].empty();
  const double confidence = results.averaging.confidence;
  view["confidence"] = fmt::format("{:.3g} %", confidence * 100.0);
  view["falseAlarm"] = fmt::format("{:.3g} %", (1.0 - confidence) * 100.0);
}

}  // namespace crossgrain::reports
