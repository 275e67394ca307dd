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

using Engines = std::vector<EngineResults>;

struct VerdictSign {
  const char *verdict, *symbol;
};
constexpr VerdictSign signs[] = {{"agree", "✓"}, {"disagree", "✗"}, {"undecided", "?"}};

std::string symbolOf(const std::string& verdict) {
  for (const VerdictSign& sign : signs)
    if (verdict == sign.verdict) return sign.symbol;
  return "";
}

std::string ringName(const Json& ring) {
  const auto index = number(ring, "ring");
  return index ? fmt::format("ring {:.0f}", *index + 1.0) : std::string("ring");
}

/// The ring whose difference is the largest share of its margin, or null.
const Json& worstRing(const Json& entry) {
  const Json* worst = &element(list(entry, "rings"), 0);
  double share = -1.0;
  for (const Json& ring : list(entry, "rings")) {
    const auto difference = number(ring, "difference"), margin = number(ring, "margin");
    if (!difference) continue;
    const double here = margin && *margin > 0.0 ? std::abs(*difference) / *margin : 0.0;
    if (here <= share) continue;
    share = here;
    worst = &ring;
  }
  return *worst;
}

/// low and high are the ring's own interval. That it lies outside the margin alone is no verdict:
/// among so many rings some do by chance.
std::string aloneBeyond(const Json& ring) {
  const auto low = number(ring, "low"), high = number(ring, "high"),
             margin = number(ring, "margin");
  if (text(ring, "verdict") != "undecided" || !low || !high || !margin) return {};
  if (!(*low > *margin || *high < -*margin)) return {};
  return "; alone it would be beyond, among all rings and fields (Holm) that is not shown";
}

std::string ringInWords(const Json& ring) {
  if (!number(ring, "difference")) return {};
  return fmt::format("{}: {}, margin {}{}", ringName(ring),
                     readableDifference(number(ring, "difference"), number(ring, "stderr")),
                     readable(number(ring, "margin")), aloneBeyond(ring));
}

/// More packings, or longer runs of the same ones; where those cannot decide, packings differ.
std::string moreInWords(const Json& entry) {
  const auto packings = number(entry, "more_packings"), rotations = number(entry, "more_rotations");
  if (text(entry, "verdict") != "undecided" || (!packings && !rotations)) return {};
  if (!rotations) return "needs " + morePackings(*packings) + "; longer runs would not do";
  const std::string longer =
      fmt::format("about {} more rotations of each run", readable(rotations));
  return "needs " + (packings ? morePackings(*packings) + ", or " + longer : longer);
}

/// The smallest difference that is found 9 times out of 10, in the best ring and in the worst.
std::string detectsInWords(const Json& entry) {
  const Json *best = nullptr, *worst = nullptr;
  for (const Json& ring : list(entry, "rings")) {
    const auto here = number(ring, "detects");
    if (!here) continue;
    if (!best || *here < *number(*best, "detects")) best = &ring;
    if (!worst || *here > *number(*worst, "detects")) worst = &ring;
  }
  if (!best) return absentText;
  const auto says = [](const Json& ring) {
    return fmt::format("{} in {}", readable(number(ring, "detects")), ringName(ring));
  };
  return best == worst ? says(*best) : says(*best) + ", " + says(*worst);
}

Json strip(const Json& entry) {
  Json rings = Json::array();
  for (const Json& ring : list(entry, "rings")) {
    const std::string verdict = text(ring, "verdict");
    rings.push_back(
        {{"verdict", verdict}, {"symbol", symbolOf(verdict)}, {"title", ringInWords(ring)}});
  }
  return rings;
}

Json verdictCell(const Json& entry) {
  if (!entry.is_object())
    return {{"verdict", ""},          {"symbol", ""},     {"word", absentText},
            {"detail", ""},           {"more", ""},       {"detects", absentText},
            {"strip", Json::array()}, {"hasStrip", false}};
  const std::string verdict = text(entry, "verdict");
  return {{"verdict", verdict},
          {"symbol", symbolOf(verdict)},
          {"word", verdict},
          {"detail", ringInWords(worstRing(entry))},
          {"more", moreInWords(entry)},
          {"detects", detectsInWords(entry)},
          {"strip", strip(entry)},
          {"hasStrip", !list(entry, "rings").empty()}};
}

Json fieldCells(const Json& results, const std::vector<std::string>& fields, const std::string& a,
                const std::string& b) {
  Json cells = Json::array();
  for (const std::string& field : fields)
    cells.push_back(verdictCell(entryOf(results, a, b, field)));
  return cells;
}

std::string marginInWords(const Json& results, const std::string& field) {
  const Json& entry = findByText(results, "agreement", "field", field);
  const auto margin = number(entry, "margin");
  if (!margin) return {};
  const std::string unit =
      text(findByText(element(list(results, "runs"), 0), "profiles", "field", field), "unit");
  const bool relative = member(entry, "margin_relative") == Json(true);
  const std::string size = relative
                               ? fmt::format("± {:.3g} % of the reference", *margin * 100.0)
                               : "± " + readableSetting(margin) +
                                     (unit.empty() || unit == "-" || unit == "1" ? "" : " " + unit);
  const std::string why = text(entry, "margin_why");
  return why.empty() ? size : size + ": " + why;
}

Json agreementRows(const Json& results, const std::vector<std::string>& fields,
                   const std::string& reference, const std::vector<std::string>& peers) {
  Json rows = Json::array();
  for (const std::string& field : fields) {
    Json cells = Json::array();
    for (const std::string& peer : peers)
      cells.push_back(verdictCell(entryOf(results, reference, peer, field)));
    rows.push_back({{"label", fieldLabel(field)},
                    {"margin", marginInWords(results, field)},
                    {"cells", std::move(cells)}});
  }
  return rows;
}

Json pairRows(const Json& results, const std::vector<std::string>& fields, const Engines& engines) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < engines.size(); ++i)
    for (std::size_t j = i + 1; j < engines.size(); ++j)
      if (engines[i].mirrors.empty() && engines[j].mirrors.empty() &&
          compared(results, engines[i].name, engines[j].name))
        rows.push_back({{"pair", engines[i].name + " – " + engines[j].name},
                        {"cells", fieldCells(results, fields, engines[i].name, engines[j].name)}});
  return rows;
}

Json mirrorRows(const Json& results, const std::vector<std::string>& fields,
                const Engines& engines) {
  Json rows = Json::array();
  for (const EngineResults& mirror : engines) {
    if (mirror.mirrors.empty()) continue;
    const std::pair<const char*, std::string> sides[] = {{"model", engines.front().name},
                                                         {"implementation", mirror.mirrors}};
    for (const auto& [what, other] : sides)
      if (compared(results, mirror.name, other))
        rows.push_back({{"peer", mirror.mirrors},
                        {"what", what},
                        {"pair", mirror.name + " – " + other},
                        {"cells", fieldCells(results, fields, mirror.name, other)}});
  }
  return rows;
}

}  // namespace

void addAgreement(Json& view, const Json& results, const Engines& engines) {
  const std::vector<std::string> fields = fieldsOf(results);
  const std::string reference = engines.empty() ? std::string() : engines.front().name;
  const auto peers = peersOf(results, engines);
  view["reference"] = reference;
  view["peerColumns"] = peers;
  view["agreement"] = agreementRows(results, fields, reference, peers);
  view["hasAgreement"] = !peers.empty();
  view["fieldColumns"] = Json::array();
  for (const std::string& field : fields) view["fieldColumns"].push_back(fieldSymbol(field));
  view["pairwise"] = pairRows(results, fields, engines);
  view["hasPairwise"] = view["pairwise"].size() > peers.size();
  view["mirrors"] = engines.empty() ? Json::array() : mirrorRows(results, fields, engines);
  view["hasMirrors"] = !view["mirrors"].empty();
  const double confidence = number(member(results, "averaging"), "confidence").value_or(0.95);
  view["confidence"] = fmt::format("{:.3g} %", confidence * 100.0);
  view["falseAlarm"] = fmt::format("{:.3g} %", (1.0 - confidence) * 100.0);
}

}  // namespace crossgrain::reports
