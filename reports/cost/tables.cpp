#include "reports/cost/tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"

namespace crossgrain::reports {

namespace {

using Rows = std::vector<CostRow>;
using Engines = std::vector<EngineResults>;

/// Of a verdict of results["cheapest"] or ["advice"].
struct Look {
  const char *symbol, *style;
};
Look lookOf(const std::string& verdict) {
  if (verdict == "reached") return {"✓", "agree"};
  if (verdict == "undecided") return {"○", "undecided"};
  if (verdict == "not reached") return {"✗", "disagree"};
  if (verdict == "not measured") return {"…", ""};
  return {"", ""};
}

std::string costText(std::optional<double> wall, const std::string& kind) {
  return wall ? fmt::format("{} for {}", readableDuration(wall), timeUnit(kind))
              : std::string("time not known");
}

/// What makes the statistical part as small as the want.
std::string lengthText(std::optional<double> length) {
  if (!length) return {};
  return fmt::format("long enough: {:.2g} × these runs", *length);
}

std::string settingOf(const CostRow& row) {
  return settingWords({row.knob, row.setting});
}
std::string settingOf(const Json& one) {
  return settingWords({text(one, "knob"), text(one, "setting")});
}

/// What a point's status is called where people read: "undecided" is a verdict, a point that the
/// budget did not allow was not measured.
std::string statusText(const CostRow& row) {
  return row.status == "undecided" ? "not measured" : row.status;
}

std::string errorText(const CostRow& row) {
  if (!row.ran()) return statusText(row);
  if (row.error && row.measured().saysNothing())
    return shareText(row.error) + ", of one packing: no statistical error";
  return shareText(row.error) + (row.statistical ? " ± " + shareText(row.statistical) : "");
}

/// "averages, radial stress: 0.31 % ± 3 %"
std::string obstacleText(const CostRow* row) {
  if (!row) return {};
  return fmt::format("{}, {}: {}", row->kind, measureWords(row->measure), errorText(*row));
}

std::string decidesText(const Json& entry) {
  const std::string words = text(entry, "decides");
  return words.empty() ? "" : "would tell: " + words;
}

Json cell(const std::string& verdict, const std::string& text, std::vector<std::string> lines) {
  std::erase(lines, std::string());
  const Look look = lookOf(verdict);
  return {{"symbol", look.symbol}, {"class", look.style}, {"text", text}, {"lines", lines}};
}

const Json& adviceOn(const Json& results, const std::string& engine, double want) {
  static const Json none;
  for (const Json& one : list(results, "advice"))
    if (text(one, "engine") == engine && number(one, "want") == want) return one;
  return none;
}

std::string kindsInWords(const Json& one) {
  std::vector<std::string> kinds;
  for (const Json& kind : list(one, "kinds"))
    if (kind.is_string()) kinds.push_back(kind.get<std::string>());
  return fmt::format("{}", fmt::join(kinds, " and "));
}

Json adviceCell(const Rows& rows, const Json& one) {
  const std::string verdict = text(one, "verdict");
  if (text(one, "setting").empty()) return cell(verdict, verdict, {decidesText(one)});
  const bool reached = verdict == "reached";
  return cell(verdict, reached ? settingOf(one) : verdict,
              {reached                     ? ""
               : verdict == "not measured" ? "best so far: " + settingOf(one)
                                           : "best: " + settingOf(one),
               costText(number(one, "wall_s"), text(one, "cost_kind")),
               member(one, "cheapest") == Json(true) ? "the cheapest engine" : "",
               reached ? lengthText(number(one, "length")) : "",
               obstacleText(rowAt(rows, member(one, "obstacle"))), decidesText(one),
               list(one, "kinds").size() < 2 ? "in " + kindsInWords(one) + " only" : ""});
}

Json headOf(const EngineResults& engine) {
  return {
      {"engine", engine.name}, {"colour", engine.style.colour}, {"dashed", engine.style.dashed}};
}

}  // namespace

std::vector<double> costWants(const Json& results) {
  std::vector<double> wants;
  for (const char* key : {"advice", "cheapest"})
    for (const Json& entry : list(results, key))
      if (const auto want = number(entry, "want");
          want && std::ranges::find(wants, *want) == wants.end())
        wants.push_back(*want);
  std::ranges::sort(wants, std::ranges::greater());
  return wants;
}

std::string wantInWords(const Json& results, double want) {
  const Json* cheapest = nullptr;
  std::map<std::string, std::size_t> count;
  std::size_t all = 0;
  for (const Json& one : list(results, "advice")) {
    if (number(one, "want") != want) continue;
    ++all;
    ++count[text(one, "verdict")];
    if (member(one, "cheapest") == Json(true)) cheapest = &one;
  }
  std::vector<std::string> others;
  if (count["undecided"] > 0)
    others.push_back(fmt::format("of {} it is undecided", count["undecided"]));
  if (count["not measured"] > 0)
    others.push_back(fmt::format("of {} not measured far enough to tell", count["not measured"]));
  if (count["not reached"] > 0)
    others.push_back(fmt::format("{} {} not reach it with any setting measured",
                                 count["not reached"], count["not reached"] == 1 ? "does" : "do"));
  const std::string open = others.empty() ? "" : fmt::format("; {}", fmt::join(others, ", "));
  if (all == 0) return fmt::format("{}: nothing was measured.", wantText(want));
  if (count["not reached"] == all)
    return fmt::format("{}: no engine reaches it with any setting measured.", wantText(want));
  if (!cheapest)
    return fmt::format("{}: of {}, none is shown to reach it{}.", wantText(want),
                       counted(all, "engine"), open);
  return fmt::format(
      "{}: cheapest with {} at {}, {} (measured in {}); {} of {} engines reach it{}.",
      wantText(want), text(*cheapest, "engine"), settingOf(*cheapest),
      costText(number(*cheapest, "wall_s"), text(*cheapest, "cost_kind")), kindsInWords(*cheapest),
      count["reached"], all, open);
}

namespace {

std::string orderText(const Json& order) {
  const auto value = number(order, "order"), half = number(order, "half_width");
  return value ? fmt::format("{:.2f} ± {:.2f}", *value, half.value_or(0.0)) : absentText;
}

/// An engine with its integrator, unless that is its own.
std::string schemeOf(const Json& order) {
  const std::string integrator = text(order, "integrator");
  return text(order, "engine") + (integrator.empty() ? "" : ", " + spaced(integrator));
}

}  // namespace

std::vector<std::string> unmetOrders(const Json& results) {
  std::vector<std::pair<std::string, std::vector<std::string>>> findings;
  for (const Json& order : list(results, "orders")) {
    if (text(order, "verdict") != "not met") continue;
    const std::string claim =
        fmt::format("Finding: {}: order {} is claimed and not met", schemeOf(order),
                    readableSetting(number(order, "theory")));
    auto found = std::ranges::find(findings, claim, [](const auto& one) { return one.first; });
    if (found == findings.end()) found = findings.insert(found, {claim, {}});
    found->second.push_back(fmt::format("{} {} {}", text(order, "error_kind"),
                                        measureWords(text(order, "measure")), orderText(order)));
  }
  std::vector<std::string> sentences;
  for (const auto& [claim, fitted] : findings)
    sentences.push_back(fmt::format("{}: {}.", claim, fmt::join(fitted, ", ")));
  return sentences;
}

Json adviceRows(const Json& results, const Engines& engines) {
  const Rows points = costRows(results);
  Json rows = Json::array();
  for (const EngineResults& engine : engines) {
    Json row = headOf(engine);
    row["cells"] = Json::array();
    for (const double want : costWants(results))
      row["cells"].push_back(adviceCell(points, adviceOn(results, engine.name, want)));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json fragmentViews(const Json& results, const Engines& engines) {
  Json views = Json::array();
  for (const EngineResults& engine : engines) {
    std::vector<std::pair<const Json*, std::vector<std::string>>> settings;
    for (const double want : costWants(results)) {
      const Json& one = adviceOn(results, engine.name, want);
      if (text(one, "verdict") != "reached") continue;
      if (settings.empty() || text(*settings.back().first, "setting") != text(one, "setting"))
        settings.push_back({&one, {}});
      settings.back().second.push_back(wantText(want));
    }
    for (const auto& [one, wants] : settings) {
      const std::string fragment = text(*one, "fragment");
      views.push_back({{"engine", engine.name},
                       {"wants", fmt::format("{}", fmt::join(wants, ", "))},
                       {"setting", settingOf(*one)},
                       {"fragment", fragment.empty() ? "# the case as it is" : fragment}});
    }
  }
  return views;
}

namespace {

Json cheapestCell(const Rows& rows, const Json& entry) {
  const std::string verdict = text(entry, "verdict");
  const CostRow* row = rowAt(rows, member(entry, "point"));
  if (!row) return cell(verdict, verdict, {});
  const std::string what = fmt::format("{}, {}", readableDuration(row->wall), errorText(*row));
  if (verdict != "reached")
    return cell(verdict, verdict,
                {fmt::format("{}: {}", settingOf(*row), what), decidesText(entry)});
  const CostRow* cheaper = rowAt(rows, member(entry, "cheaper"));
  return cell(verdict, settingOf(*row),
              {what, lengthText(number(entry, "length")),
               cheaper ? "perhaps " + settingOf(*cheaper) : "", decidesText(entry)});
}

}  // namespace

Json cheapestGroups(const Json& results, const Engines& engines) {
  const Rows rows = costRows(results);
  const auto wants = costWants(results);
  Json groups = Json::array();
  for (const CostMeasure& measure : costMeasures(rows)) {
    Json lines = Json::array();
    for (const EngineResults& engine : engines) {
      Json line = headOf(engine);
      line["cells"] = Json::array();
      for (const double want : wants)
        for (const Json& entry : list(results, "cheapest"))
          if (text(entry, "engine") == engine.name && text(entry, "error_kind") == measure.kind &&
              text(entry, "measure") == measure.name && number(entry, "want") == want)
            line["cells"].push_back(cheapestCell(rows, entry));
      if (!line["cells"].empty()) lines.push_back(std::move(line));
    }
    groups.push_back({{"title", fmt::format("{}: {}", measure.kind, measureHtml(measure.name))},
                      {"span", std::to_string(wants.size() + 1)},
                      {"rows", std::move(lines)}});
  }
  return groups;
}

namespace {

/// "failed 2, below 3 times … 1"
std::string leftOutText(const Json& order) {
  std::map<std::string, int> counts;
  for (const Json& left : list(order, "left_out")) {
    const std::string why = text(left, "why");
    ++counts[why.substr(0, why.find(':'))];
  }
  std::vector<std::string> words;
  for (const auto& [why, count] : counts) words.push_back(fmt::format("{} {}", count, why));
  return words.empty() ? "" : fmt::format("left out: {}", fmt::join(words, "; "));
}

}  // namespace

Json orderRows(const Json& results) {
  static const std::map<std::string, std::string> styles = {
      {"met", "agree"}, {"exceeded", "agree"}, {"not met", "disagree"}, {"undecided", "undecided"}};
  Json rows = Json::array();
  for (const Json& order : list(results, "orders")) {
    const std::string verdict = text(order, "verdict");
    const auto style = styles.find(verdict);
    const auto low = number(order, "dt_low_s"), high = number(order, "dt_high_s");
    const std::size_t used = list(order, "used").size();
    const std::string range =
        low ? fmt::format(", {} to {} s", readable(low), readable(high)) : std::string();
    rows.push_back(
        {{"scheme", schemeOf(order)},
         {"what", text(order, "error_kind") + ": " + measureHtml(text(order, "measure"))},
         {"order", orderText(order)},
         {"theory", readableSetting(number(order, "theory"))},
         {"verdict", verdict},
         {"class", style == styles.end() ? "" : style->second},
         {"reason", text(order, "reason")},
         {"used", fmt::format("{} of {}{}", used, used + list(order, "left_out").size(), range)},
         {"leftOut", leftOutText(order)}});
  }
  return rows;
}

namespace {

std::string ratioText(const CostRow& row, const CostRow* base) {
  if (!row.wall || !base || !base->wall || *base->wall == 0.0) return absentText;
  return fmt::format("{:.2f}", *row.wall / *base->wall);
}

/// One line of the table of a kind: what a setting changes in every measure. Null without a point.
Json knobRow(const Rows& rows, const std::string& kind, const EngineResults& engine,
             const OtherSetting& setting, std::size_t index) {
  Json line = headOf(engine);
  line["number"] = std::to_string(index + 1);
  line["setting"] = settingWords(setting);
  line["cells"] = Json::array();
  bool any = false;
  for (const CostMeasure& measure : costMeasures(rows)) {
    if (measure.kind != kind) continue;
    Json shown = {{"text", absentText}, {"was", ""}};
    for (const CostRow& row : rows) {
      if (!measure.has(row) || row.engine != engine.name || row.knob != setting.knob ||
          row.setting != setting.setting)
        continue;
      const CostRow* base = baseOf(rows, row);
      shown = {{"text", errorText(row)}, {"was", base ? "was " + errorText(*base) : ""}};
      if (!any) {
        line["base"] = base ? base->setting : absentText;
        line["ratio"] = ratioText(row, base);
        line["wall"] = readableDuration(row.wall);
      }
      any = true;
    }
    line["cells"].push_back(shown);
  }
  return any ? line : Json();
}

}  // namespace

Json knobGroups(const Json& results, const Engines& engines) {
  const Rows rows = costRows(results);
  const auto settings = otherSettings(rows);
  Json groups = Json::array();
  for (const std::string& kind : costKinds(rows)) {
    Json measures = Json::array(), lines = Json::array();
    for (const CostMeasure& measure : costMeasures(rows))
      if (measure.kind == kind) measures.push_back(measureHtml(measure.name));
    for (const EngineResults& engine : engines)
      for (std::size_t k = 0; k < settings.size(); ++k)
        if (Json line = knobRow(rows, kind, engine, settings[k], k); !line.is_null())
          lines.push_back(std::move(line));
    if (!lines.empty())
      groups.push_back({{"kind", kind},
                        {"unit", timeUnit(kind)},
                        {"measures", std::move(measures)},
                        {"rows", std::move(lines)}});
  }
  return groups;
}

Json notRunRows(const Json& results) {
  struct Trouble {
    const CostRow* first;
    std::vector<std::string> measures;
  };
  const Rows rows = costRows(results);
  std::vector<Trouble> troubles;
  for (const CostRow& row : rows) {
    if (row.ran()) continue;
    const auto alike = std::ranges::find_if(troubles, [&](const Trouble& one) {
      return one.first->engine == row.engine && one.first->kind == row.kind &&
             one.first->knob == row.knob && one.first->setting == row.setting &&
             one.first->status == row.status && one.first->reason == row.reason;
    });
    const bool isNew = alike == troubles.end();
    Trouble& trouble = isNew ? troubles.emplace_back(Trouble{&row, {}}) : *alike;
    trouble.measures.push_back(measureWords(row.measure));
  }
  Json lines = Json::array();
  for (const Trouble& trouble : troubles)
    lines.push_back({{"engine", trouble.first->engine},
                     {"kind", trouble.first->kind},
                     {"measures", fmt::format("{}", fmt::join(trouble.measures, ", "))},
                     {"setting", settingOf(*trouble.first)},
                     {"status", statusText(*trouble.first)},
                     {"reason", trouble.first->reason}});
  return lines;
}

Json startupRows(const Json& results) {
  Json rows = Json::array();
  for (const Json& entry : list(results, "startup"))
    rows.push_back({{"engine", text(entry, "engine")},
                    {"start", readableDuration(number(entry, "start_s"))},
                    {"load", readableDuration(number(entry, "load_s"))}});
  return rows;
}

Json referenceRows(const Json& results) {
  Json rows = Json::array();
  for (const Json& entry : list(results, "references"))
    rows.push_back({{"kind", text(entry, "error_kind")},
                    {"engine", text(entry, "engine")},
                    {"setting", text(entry, "setting")},
                    {"error", shareText(number(entry, "error"))},
                    {"note", text(entry, "note")}});
  return rows;
}

}  // namespace crossgrain::reports
