#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "reports/common/csv.hpp"
#include "reports/common/figures.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"

namespace crossgrain::reports {

namespace {

struct MethodStyle {
  std::string_view name;
  LineStyle style;
};

/// Okabe and Ito 2008
const std::array<MethodStyle, 5>& methodStyles() {
  static const std::array<MethodStyle, 5> styles = {{{"slicing", {"#000000", 7, false}},
                                                     {"straight_cut", {"#56b4e9", 5, true}},
                                                     {"centre", {"#d55e00", 9, false}},
                                                     {"line_gaussian", {"#009e73", 11, false}},
                                                     {"line_heaviside", {"#cc79a7", 13, true}}}};
  return styles;
}

/// The fields that are drawn; the table and the CSV file have all.
constexpr std::array<std::pair<const char*, const char*>, 6> drawnFields = {
    {{"volume_fraction", "ν"},
     {"azimuthal_velocity", "v_{φ} [m/s]"},
     {"spin", "S [rad/s]"},
     {"fabric_trace", "tr F"},
     {"stress_rr", "σ_{rr} [N/m^{2}]"},
     {"stress_pr", "σ_{φr} [N/m^{2}]"}}};

Curve drawnCurve(const Json& curve, const MethodStyle& method) {
  Curve drawn{spaced(method.name), method.style, Draw::linesAndPoints, {}, 1.2};
  for (std::size_t k = 0; k < list(curve, "width").size(); ++k) {
    const auto width = number(list(curve, "width")[k]);
    const auto mean = number(element(list(curve, "mean"), k));
    if (width && mean) drawn.points.push_back({*width, *mean, {}});
  }
  return drawn;
}

Figure fieldFigure(const Json& results, const std::string& field, const std::string& label) {
  std::set<double> radii;
  for (const Json& curve : list(results, "curves"))
    if (const auto r = number(curve, "r")) radii.insert(*r);
  Figure figure{fmt::format("rev_{}", field),
                fmt::format("{} against ring width", spaced(field)),
                fmt::format("{}: rings of width Δr about each radius.", spaced(field)),
                {},
                2};
  for (const double r : radii) {
    Panel panel;
    panel.title = fmt::format("r = {:.4g} m", r);
    panel.xLabel = "Δr / d";
    panel.yLabel = label;
    panel.logX = true;
    for (const MethodStyle& method : methodStyles())
      for (const Json& curve : list(results, "curves"))
        if (text(curve, "field") == field && text(curve, "method") == method.name &&
            number(curve, "r") == r)
          panel.curves.push_back(drawnCurve(curve, method));
    panel.key = figure.panels.empty() ? Key::outside : Key::none;
    if (hasPoints(panel)) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

std::string percent(std::optional<double> fraction) {
  return fraction ? fmt::format("{:.2g}", 100.0 * *fraction) : absentText;
}

/// Where the method meets slicing next to that width; a dash where no radius has room for it.
std::string meetingOf(const Json& results, const char* field, const char* method, double near) {
  for (const Json& row : list(results, "meetings"))
    if (text(row, "field") == field && text(row, "method") == method && number(row, "near") == near)
      return fmt::format("{:.2f} ({} %)", number(row, "width").value_or(0.0),
                         percent(number(row, "difference")));
  return absentText;
}

/// A row per field: where centre and line averages come closest to slicing near d and 2 d.
Json meetingRows(const Json& results) {
  Json rows = Json::array();
  for (const auto& [field, label] : drawnFields) {
    Json cells = Json::array();
    for (const char* method : {"centre", "line_gaussian", "line_heaviside"})
      for (const double near : {1.0, 2.0}) cells.push_back(meetingOf(results, field, method, near));
    if (std::ranges::any_of(cells, [](const Json& cell) { return cell != absentText; }))
      rows.push_back({{"field", fieldLabel(field)}, {"cells", cells}});
  }
  return rows;
}

}  // namespace

std::vector<Figure> revFigures(const Json& results) {
  std::vector<Figure> figures;
  for (const auto& [field, label] : drawnFields)
    if (Figure figure = fieldFigure(results, field, label); !figure.panels.empty())
      figures.push_back(std::move(figure));
  return figures;
}

namespace {

/// "400 snapshots of grain: 12 fields under 5 weights, in rings of widths from 0.1 to 4 d."
std::string leadOf(const Json& results) {
  std::set<std::string> fields, methods;
  std::set<double> widths;
  for (const Json& curve : list(results, "curves")) {
    fields.insert(text(curve, "field"));
    methods.insert(text(curve, "method"));
    for (const Json& width : list(curve, "width"))
      if (const auto d = number(width)) widths.insert(*d);
  }
  if (widths.empty()) return "No ring fits into the cell: nothing was averaged.";
  const auto snapshots = number(member(results, "averaging"), "snapshots").value_or(0.0);
  return fmt::format("{} of {}: {} under {}, in rings of widths from {} to {} d.",
                     counted(static_cast<std::size_t>(snapshots), "snapshot"),
                     text(results, "engine"), counted(fields.size(), "field"),
                     counted(methods.size(), "weight"), readableSetting(*widths.begin()),
                     readableSetting(*widths.rbegin()));
}

}  // namespace

std::string revPage(const Json& results, const Illustrations& shown) {
  Json view = commonView(results, shown);
  const Json& averaging = member(results, "averaging");
  view["lead"] = leadOf(results);
  view["sentences"] = {
      "Nothing was run and nothing compared but ways of averaging the same "
      "snapshots: what depends on the ring's width or on the weight is a matter "
      "of averaging there, not of the field."};
  if (const auto width = number(averaging, "line_width"))
    view["sentences"].push_back(fmt::format("Kernels of the line methods have the width w = {} d.",
                                            readableSetting(width)));
  view["figures"] = figureViews(shown, "rev_");
  view["meetings"] = meetingRows(results);
  view["files"] =
      "Beside this page: results.json (everything), rev.csv (every field, weight and width) and "
      "rev_meetings.csv.";
  return render("report_rev.html", view);
}

}  // namespace crossgrain::reports
