#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "reports/labels.hpp"
#include "reports/numbers.hpp"
#include "reports/page.hpp"

namespace crossgrain::reports {

namespace {

using Columns = std::map<std::string, Json>;  ///< engine → {colour, dashed}

Columns columnsByName(const std::vector<EngineResults>& engines) {
  Columns columns;
  for (const Json& column : columnsView(engines)) columns[text(column, "name")] = column;
  return columns;
}

std::optional<double> meanRestitution(const Json& curve) {
  double sum = 0.0;
  int count = 0;
  for (const Json& point : list(curve, "points"))
    if (const auto value = number(point, "e_n")) {
      sum += *value;
      ++count;
    }
  if (count == 0) return std::nullopt;
  return sum / count;
}

std::string verdictOf(const Json& curve) {
  const std::string status = text(curve, "status");
  const std::string verdict = text(member(curve, "score"), "verdict");
  return verdict.empty() ? status : verdict;
}

Json scoreRow(const Json& curve, const Columns& columns) {
  const Json& score = member(curve, "score");
  const std::string verdict = verdictOf(curve);
  const bool held = verdict == "held", judged = held || verdict == "fell short";
  const auto style = columns.find(text(curve, "engine"));
  Json cells = {readableSetting(number(curve, "dt")),
                readableSetting(number(curve, "steps_per_contact")),
                std::to_string(list(curve, "points").size()),
                readable(meanRestitution(curve)),
                readable(number(score, "max_error")),
                readable(number(score, "rms_error")),
                readable(number(score, "e_n_error")),
                readableSetting(number(score, "limit"))};
  return {{"engine", text(curve, "engine")},
          {"colour", style == columns.end() ? "#999999" : text(style->second, "colour")},
          {"dashed", style != columns.end() && member(style->second, "dashed") == Json(true)},
          {"cells", std::move(cells)},
          {"verdict", (held     ? "✓ "
                       : judged ? "✗ "
                                : "– ") +
                          verdict},
          {"class", held     ? "agree"
                    : judged ? "disagree"
                             : "undecided"},
          {"reason", text(curve, "reason")}};
}

/// HTML: "normal linear, tangential spring dashpot; e_n = 0.341 closed form; …"
std::string factsOf(const Json& variant) {
  std::vector<std::string> law;
  for (const auto& [option, value] : member(variant, "law").items())
    if (value.is_string())
      law.push_back(spaced(option) + " " + spaced(value.get<std::string>()));
    else if (const auto constant = number(value))
      law.push_back(spaced(option) + " " + readableSetting(constant));
  std::string facts = fmt::format("Law: {}.", fmt::join(law, ", "));
  if (const auto e = number(variant, "e_n_closed"))
    facts += " Closed form of the normal restitution: " + readable(e) + ".";
  if (const auto e = number(member(variant, "sticking"), "e_t0"))
    facts += " Sticking: Ψ_f = −" + readable(e) + " Ψ_i.";
  if (const auto constant = number(variant, "sliding_constant"))
    facts += " Sliding: Ψ_f = Ψ_i − " + readable(constant) + ".";
  std::vector<double> limitless;
  for (const Json& row : list(variant, "oracle"))
    if (member(row, "limitless") == Json(true))
      limitless.push_back(number(row, "psi_i").value_or(0));
  if (!limitless.empty())
    facts += " Between Ψ_i = " + readable(limitless.front()) + " and " +
             readable(limitless.back()) +
             " the law's outcome goes on varying with the time step, however small: the oracle "
             "gives one "
             "of a narrow family.";
  return mathHtml(facts);
}

/// "case: variant" where the results hold several cases.
std::string variantName(const Json& results, const Json& variant) {
  std::string name = text(variant, "variant");
  if (name.empty()) name = "the case itself";
  const std::string own = text(variant, "case");
  const bool several = !own.empty() && own != text(member(results, "case"), "name");
  return !several || own == name ? name : own + ": " + name;
}

Json variantViews(const Json& results, const Illustrations& shown, const Columns& columns) {
  Json views = Json::array();
  for (const Json& variant : list(results, "variants")) {
    const std::string id = fmt::format("collision_{}", views.size() + 1);
    Json scores = Json::array();
    for (const Json& curve : list(variant, "curves")) scores.push_back(scoreRow(curve, columns));
    Json figures = Json::array();
    for (Json& figure : figureViews(shown, "collision_"))
      if (text(figure, "file") == id || text(figure, "file") == id + "_quantities")
        figures.push_back(std::move(figure));
    views.push_back({{"id", id},
                     {"name", variantName(results, variant)},
                     {"facts", factsOf(variant)},
                     {"figures", std::move(figures)},
                     {"scores", std::move(scores)}});
  }
  return views;
}

Json orderRows(const Json& results) {
  Json rows = Json::array();
  for (const Json& order : list(results, "orders")) {
    std::map<double, std::string> errors;  // by time step, coarse last
    for (const auto& [dt, error] : member(order, "error_at").items()) {
      const double step = std::strtod(dt.c_str(), nullptr);
      errors[step] = readable(number(error)) + " at " + readableSetting(step) + " s";
    }
    std::vector<std::string> words;
    for (const auto& [step, error] : errors) words.push_back(error);
    rows.push_back({{"variant", variantName(results, order)},
                    {"engine", text(order, "engine")},
                    {"order", readable(number(order, "order"), number(order, "stderr"))},
                    {"errors", fmt::format("{}", fmt::join(words, ", "))}});
  }
  return rows;
}

/// One row per variant: its place on the page and, engine by engine, how many of its sweeps held.
Json indexRows(const Json& results, const std::vector<EngineResults>& engines) {
  Json rows = Json::array();
  for (const Json& variant : list(results, "variants")) {
    std::map<std::string, std::pair<int, int>> counts;  // held, judged
    for (const Json& curve : list(variant, "curves")) {
      const std::string verdict = verdictOf(curve);
      auto& [held, judged] = counts[text(curve, "engine")];
      held += verdict == "held";
      judged += verdict == "held" || verdict == "fell short";
    }
    Json cells = Json::array();
    for (const EngineResults& engine : engines) {
      const auto [held, judged] = counts[engine.name];
      const bool all = held == judged;
      cells.push_back(
          {{"text", judged == 0 ? "–" : fmt::format("{} {}/{}", all ? "✓" : "✗", held, judged)},
           {"class", judged == 0 ? "undecided"
                     : all       ? "agree"
                                 : "disagree"}});
    }
    rows.push_back({{"id", fmt::format("collision_{}", rows.size() + 1)},
                    {"name", variantName(results, variant)},
                    {"cells", std::move(cells)}});
  }
  return rows;
}

Json engineRows(const std::vector<EngineResults>& engines) {
  Json rows = columnsView(engines);
  for (std::size_t k = 0; k < engines.size(); ++k)
    for (const char* key : {"version", "status", "mirrors", "summary", "reason"})
      rows[k][key] = text(*engines[k].entry, key);
  return rows;
}

void addSummary(Json& view, const Json& results, const std::vector<EngineResults>& engines) {
  std::map<std::string, std::map<std::string, std::size_t>> counts;
  std::size_t held = 0, short_ = 0;
  for (const Json& variant : list(results, "variants"))
    for (const Json& curve : list(variant, "curves")) {
      const std::string verdict = verdictOf(curve);
      ++counts[text(curve, "engine")][verdict];
      held += verdict == "held";
      short_ += verdict == "fell short";
    }
  view["lead"] = held + short_ == 0 ? "No sweep could be judged."
                                    : fmt::format("{} of {} held to the oracle within {} limit.",
                                                  held, counted(held + short_, "judged sweep"),
                                                  held + short_ == 1 ? "its" : "their");
  view["sentences"] = Json::array();
  for (const EngineResults& engine : engines) {
    std::vector<std::string> words;
    for (const auto& [verdict, count] : counts[engine.name])
      words.push_back(fmt::format("{} {}", count, verdict));
    const std::string reason = text(*engine.entry, "reason");
    view["sentences"].push_back(
        fmt::format("{}: {}{}", engine.name,
                    words.empty() ? engine.status : fmt::format("{}", fmt::join(words, ", ")),
                    reason.empty() ? "." : ": " + reason));
  }
}

}  // namespace

std::string collidePage(const Json& results, const Illustrations& shown) {
  const std::vector<EngineResults> engines = engineResults(results);
  std::vector<RealisedOf> realised;
  for (const Json& variant : list(results, "variants"))
    for (const Json& curve : list(variant, "curves"))
      if (member(curve, "realised").is_object())
        realised.push_back({text(curve, "engine"), &member(curve, "realised")});

  Json view = commonView(results, shown);
  addSummary(view, results, engines);
  view["engines"] = engineRows(engines);
  view["variants"] = variantViews(results, shown, columnsByName(engines));
  view["index"] = indexRows(results, engines);
  view["orders"] = orderRows(results);
  view["hasOrders"] = !view["orders"].empty();
  addDetails(view, results, realised);
  view["files"] = "Beside this page: results.json (everything) and collisions.csv.";
  return render("report_collide.html", view);
}

}  // namespace crossgrain::reports
