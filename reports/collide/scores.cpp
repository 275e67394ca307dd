#include "reports/collide/scores.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"

namespace crossgrain::reports {

namespace {

/// Two digits are enough of an error.
std::string shortly(std::optional<double> value) {
  if (!value) return absentText;
  return readableSetting(std::strtod(fmt::format("{:.2g}", *value).c_str(), nullptr));
}

/// How an engine did in some variants.
struct Tally {
  int held = 0, judged = 0, refused = 0, failed = 0;
  double worst = 0.0;           ///< error/limit of what fell short furthest
  std::string_view worstName;   ///< its symbol
  std::string refusal, reason;  ///< the first

  std::string cssClass() const {
    if (failed > 0) return "disagree";
    return judged == 0 ? "undecided" : held == judged ? "agree" : "disagree";
  }
};

/// The clause that says what is lacking, of "X cannot run FILE: CLAUSE; HINT".
std::string clauseOf(const std::string& refusal) {
  const auto colon = refusal.find(": ");
  const std::string rest = colon == std::string::npos ? refusal : refusal.substr(colon + 2);
  return rest.substr(0, rest.find("; "));
}

Tally tallyOf(const std::vector<const Json*>& variants, const std::string& engine) {
  Tally tally;
  for (const Json* variant : variants)
    for (const Json* curve : curvesOf(*variant, engine)) {
      const std::string verdict = verdictOf(*curve);
      tally.held += verdict == "held";
      tally.judged += verdict == "held" || verdict == "fell short";
      tally.refused += verdict == "refused";
      tally.failed += verdict == "failed";
      const std::string reason = text(*curve, "reason");
      if (verdict == "refused" && tally.refusal.empty()) tally.refusal = clauseOf(reason);
      if (verdict != "refused" && tally.reason.empty()) tally.reason = reason;
      for (const QuantityLabel& quantity : quantityLabels()) {
        const Json& score = member(member(*curve, "score"), quantity.name);
        const auto error = number(score, "max"), limit = number(score, "limit");
        if (!error || !limit || *error <= *limit * std::max(tally.worst, 1.0)) continue;
        tally.worst = *error / *limit;
        tally.worstName = quantity.symbol;
      }
    }
  return tally;
}

/// "✓ 24 of 24", "✗ 5 of 7", "– refused".
std::string headline(const Tally& tally) {
  if (tally.judged > 0)
    return fmt::format("{} {} of {}", tally.held == tally.judged ? "✓" : "✗", tally.held,
                       tally.judged);
  if (tally.failed > 0) return "✗ failed";
  return tally.refused > 0 ? "– refused" : absentText;
}

std::string orderOf(const Json& results, const Json& variant, const std::string& engine,
                    const char* quantity) {
  for (const Json& order : list(results, "orders")) {
    const bool own = text(order, "variant") == text(variant, "variant") &&
                     text(order, "case") == text(variant, "case") &&
                     text(order, "engine") == engine;
    if (!own) continue;
    const Json& fit = member(member(order, "quantities"), quantity);
    const auto slope = number(fit, "order"), error = number(fit, "stderr");
    if (!slope) break;
    // Errors of orders below a hundredth say nothing: the scheme's next term is larger.
    const double hundredths = std::round(*slope * 100.0) / 100.0 + 0.0;  // no −0.00
    return fmt::format("{}{:.2f}{}", hundredths < 0.0 ? "−" : "", std::abs(hundredths),
                       error ? fmt::format("\u00a0±\u00a0{:.2f}", std::max(*error, 0.01)) : "");
  }
  return absentText;
}

Json variantCell(const Json& results, const Json& variant, const std::string& engine) {
  const Tally tally = tallyOf({&variant}, engine);
  Json lines = Json::array();
  const Json* curve = coarsestCurve(variant, engine);
  for (const char* quantity : {"psi_f", "e_n"}) {
    if (!curve) break;
    const auto error = number(member(member(*curve, "score"), quantity), "max");
    if (!error) continue;
    const std::string order = orderOf(results, variant, engine, quantity);
    lines.push_back(mathHtml(quantity == std::string("psi_f") ? "Ψ_f " : "e_n ") + shortly(error) +
                    (order == absentText ? "" : ", order " + order));
  }
  if (!tally.refusal.empty()) lines.push_back(mathHtml(tally.refusal));
  if (!tally.reason.empty()) lines.push_back(mathHtml(tally.reason));
  return {{"text", headline(tally)}, {"class", tally.cssClass()}, {"lines", std::move(lines)}};
}

/// The law's members that variants of the case differ in, or that only some have.
std::vector<std::string> changing(const CaseGroup& group) {
  std::vector<std::string> names;
  for (const Json* variant : group.variants)
    for (const auto& [name, value] : member(*variant, "law").items())
      if (std::ranges::find(names, name) == names.end() &&
          std::ranges::any_of(group.variants, [&, &name = name, &value = value](const Json* v) {
            return member(member(*v, "law"), name) != value;
          }))
        names.push_back(name);
  return names;
}

std::string lawWords(const Json& law, const std::vector<std::string>& names) {
  std::vector<std::string> words;
  for (const std::string& name : names) {
    const Json& value = member(law, name);
    if (value.is_null()) continue;
    words.push_back(
        spaced(name) + " " +
        (value.is_string() ? spaced(value.get<std::string>()) : readableSetting(number(value))));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Largest distance of two curves at the same places.
std::optional<double> distance(const Json* a, const Json* b, const char* column) {
  if (!a || !b) return std::nullopt;
  const Json &first = member(*a, "points"), &second = member(*b, "points");
  std::optional<double> largest;
  for (std::size_t k = 0; k < std::min(rowCount(first), rowCount(second)); ++k) {
    const auto x = at(first, column, k), y = at(second, column, k);
    if (x && y) largest = std::max(largest.value_or(0.0), std::abs(*x - *y));
  }
  return largest;
}

std::string deviationWords(const Json& curve) {
  std::vector<std::string> words;
  for (const Json& deviation : list(member(curve, "realised"), "deviations"))
    if (std::string name = spaced(text(deviation, "name"));
        std::ranges::find(words, name) == words.end())
      words.push_back(std::move(name));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::string dtOf(const Json* curve) {
  return readableSetting(curve ? number(*curve, "dt") : std::nullopt);
}

bool scored(const CaseGroup& group, std::string_view quantity) {
  return std::ranges::any_of(group.variants, [&](const Json* variant) {
    return std::ranges::any_of(list(*variant, "curves"), [&](const Json& curve) {
      return member(member(curve, "score"), quantity).is_object();
    });
  });
}

Json scoreCell(const Json& score) {
  const Json& held = member(score, "held");
  const std::string mark = held == Json(true) ? "✓ " : held == Json(false) ? "✗ " : "";
  return {{"class", held == Json(true)    ? "agree"
                    : held == Json(false) ? "disagree"
                                          : ""},
          {"text", mark + shortly(number(score, "max"))},
          {"rms", score.is_null() ? "" : shortly(number(score, "rms"))}};
}

}  // namespace

Json matrixRows(const std::vector<CaseGroup>& groups, const std::vector<EngineResults>& engines) {
  Json rows = Json::array();
  for (const CaseGroup& group : groups) {
    Json cells = Json::array();
    for (const EngineResults& engine : engines) {
      const Tally tally = tallyOf(group.variants, engine.name);
      Json lines = Json::array();
      if (tally.worst > 1.0)
        lines.push_back(
            mathHtml(fmt::format("{} {} × its limit", tally.worstName, shortly(tally.worst))));
      if (tally.refused > 0)
        lines.push_back(
            mathHtml(tally.judged > 0 ? fmt::format("{} refused", tally.refused) : tally.refusal));
      if (!tally.reason.empty()) lines.push_back(mathHtml(tally.reason));
      cells.push_back(
          {{"text", headline(tally)}, {"class", tally.cssClass()}, {"lines", std::move(lines)}});
    }
    rows.push_back({{"id", fmt::format("case_{}", rows.size() + 1)},
                    {"name", group.name},
                    {"variants", counted(group.variants.size(), "variant")},
                    {"cells", std::move(cells)}});
  }
  return rows;
}

Json variantRows(const Json& results, const CaseGroup& group,
                 const std::vector<EngineResults>& engines) {
  const std::vector<std::string> names = changing(group);
  Json rows = Json::array();
  for (const Json* variant : group.variants) {
    Json cells = Json::array();
    for (const EngineResults& engine : engines)
      cells.push_back(variantCell(results, *variant, engine.name));
    rows.push_back({{"name", text(*variant, "variant")},
                    {"law", lawWords(member(*variant, "law"), names)},
                    {"cells", std::move(cells)}});
  }
  return rows;
}

Json mirrorRows(const CaseGroup& group, const std::vector<EngineResults>& engines) {
  Json rows = Json::array();
  for (const EngineResults& mirror : engines) {
    if (mirror.mirrors.empty()) continue;
    const std::string& first = engines.front().name;
    for (const Json* variant : group.variants) {
      const Json *ours = first == mirror.mirrors ? nullptr : coarsestCurve(*variant, first),
                 *mirrored = coarsestCurve(*variant, mirror.name),
                 *peer = coarsestCurve(*variant, mirror.mirrors);
      if (!mirrored || !peer) continue;
      rows.push_back(
          {{"variant", text(*variant, "variant")},
           {"mirror", mirror.name},
           {"peer", mirror.mirrors},
           {"differs", deviationWords(*peer)},
           {"cells",
            {shortly(distance(ours, mirrored, "psi_f")), shortly(distance(ours, mirrored, "e_n")),
             shortly(distance(mirrored, peer, "psi_f")), shortly(distance(mirrored, peer, "e_n")),
             (!ours || dtOf(ours) == dtOf(mirrored)) && dtOf(mirrored) == dtOf(peer)
                 ? dtOf(peer)
                 : fmt::format("{} | {} | {}", dtOf(ours), dtOf(mirrored), dtOf(peer))}}});
    }
  }
  return rows;
}

Json scoreHeads(const CaseGroup& group) {
  Json heads = Json::array();
  for (const QuantityLabel& quantity : quantityLabels())
    if (scored(group, quantity.name)) heads.push_back(mathHtml(quantity.symbol));
  return heads;
}

Json scoreRows(const CaseGroup& group) {
  Json rows = Json::array();
  for (const Json* variant : group.variants)
    for (const Json& curve : list(*variant, "curves")) {
      const std::string verdict = verdictOf(curve);
      Json cells = Json::array();
      if (rowCount(member(curve, "points")) > 0)
        for (const QuantityLabel& quantity : quantityLabels())
          if (scored(group, quantity.name))
            cells.push_back(scoreCell(member(member(curve, "score"), quantity.name)));
      rows.push_back({{"variant", text(*variant, "variant")},
                      {"engine", text(curve, "engine")},
                      {"dt", readableSetting(number(curve, "dt"))},
                      {"verdict", (verdict == "held"         ? "✓ "
                                   : verdict == "fell short" ? "✗ "
                                                             : "– ") +
                                      verdict},
                      {"class", verdict == "held"         ? "agree"
                                : verdict == "fell short" ? "disagree"
                                                          : "undecided"},
                      {"reason", cells.empty() ? text(curve, "reason") : ""},
                      {"cells", std::move(cells)}});
    }
  return rows;
}

}  // namespace crossgrain::reports
