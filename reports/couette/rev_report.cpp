#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "reports/common/csv_row.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/overview.hpp"
#include "reports/common/page.hpp"
#include "reports/couette/overview.hpp"
#include "reports/couette/report.hpp"
#include "reports/couette/rev_fields.hpp"

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

Curve drawnCurve(const RevCurve& curve, const MethodStyle& method) {
  Curve drawn{spaced(method.name), method.style, Draw::linesAndPoints, {}, 1.2};
  for (std::size_t k = 0; k < curve.width.size(); ++k) {
    const auto width = at(curve.width, k), mean = at(curve.mean, k);
    if (width && mean) drawn.points.push_back({*width, *mean, {}});
  }
  return drawn;
}

Figure fieldFigure(const RevResults& results, const std::string& field) {
  std::set<double> radii;
  for (const RevCurve& curve : results.curves) radii.insert(curve.r);
  Figure figure{fmt::format("rev_{}", field),
                fmt::format("{} against ring width", fieldWords(field)),
                fmt::format("{}: rings of width Δr about each radius.", fieldWords(field)),
                {},
                2};
  for (const double r : radii) {
    Panel panel;
    panel.title = fmt::format("r = {:.4g} m", r);
    panel.xLabel = "Δr / d";
    panel.yLabel = fieldAxis(field);
    panel.logX = true;
    for (const MethodStyle& method : methodStyles())
      for (const RevCurve& curve : results.curves)
        if (curve.field == field && curve.method == method.name && curve.r == r)
          panel.curves.push_back(drawnCurve(curve, method));
    panel.key = figure.panels.empty() ? Key::outside : Key::none;
    if (hasPoints(panel)) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

std::string percent(std::optional<double> fraction) {
  return finite(fraction) ? fmt::format("{:.2g}", 100.0 * *fraction) : absentText;
}

/// Where the method meets slicing next to that width; a dash where no radius has room for it.
std::string meetingOf(const RevResults& results, const char* field, const char* method,
                      double near) {
  for (const RevMeeting& row : results.meetings)
    if (row.field == field && row.method == method && row.near == near)
      return fmt::format("{:.2f} ({} %)", row.width, percent(row.difference));
  return absentText;
}

/// A row per field: where centre and line averages come closest to slicing near d and 2 d.
Json meetingRows(const RevResults& results) {
  Json rows = Json::array();
  for (const char* const field : drawnRevFields) {
    Json cells = Json::array();
    for (const char* method : {"centre", "line_gaussian", "line_heaviside"})
      for (const double near : {1.0, 2.0}) cells.push_back(meetingOf(results, field, method, near));
    if (std::ranges::any_of(cells, [](const Json& cell) { return cell != absentText; }))
      rows.push_back({{"field", fieldLabel(field)}, {"cells", cells}});
  }
  return rows;
}

}  // namespace

std::vector<Figure> revFigures(const RevResults& results) {
  std::vector<Figure> figures;
  for (const char* const field : drawnRevFields)
    if (Figure figure = fieldFigure(results, field); !figure.panels.empty())
      figures.push_back(std::move(figure));
  return figures;
}

std::string revPage(const RevResults& results, const Illustrations& shown) {
  Json view = commonView(results.head, std::nullopt, results.notes, shown);
  view["lead"] = revLead(results);
  view["sentences"] = {
      "Nothing was run and nothing compared but ways of averaging the same "
      "snapshots: what depends on the ring's width or on the weight is a matter "
      "of averaging there, not of the field."};
  if (const auto width = results.averaging.lineWidth)
    view["sentences"].push_back(fmt::format("Kernels of the line methods have the width w = {} d.",
                                            readableSetting(width)));
  addOverview(view, revOverview(results), {});
  view["figures"] = figureViews(shown, "rev_");
  view["meetings"] = meetingRows(results);
  view["files"] =
      "Beside this page: results.json (everything), rev.csv (every field, weight and width) and "
      "rev_meetings.csv.";
  return render("report_rev.html", view);
}

std::string revCsv(const RevResults& results) {
  std::string table = "engine,method,field,r_m,width_over_d,mean,stderr,unit\n";
  for (const RevCurve& curve : results.curves)
    for (std::size_t k = 0; k < curve.width.size(); ++k)
      table += row(results.engine, curve.method, curve.field, std::optional(curve.r),
                   at(curve.width, k), at(curve.mean, k), at(curve.standardError, k), curve.unit);
  return table;
}

std::string revMeetingsCsv(const RevResults& results) {
  std::string table = "method,field,near_d,width_over_d,difference\n";
  for (const RevMeeting& meeting : results.meetings)
    table += row(meeting.method, meeting.field, std::optional(meeting.near),
                 std::optional(meeting.width), std::optional(meeting.difference));
  return table;
}

}  // namespace crossgrain::reports
