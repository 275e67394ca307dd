#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <span>

#include "reports/common/csv_row.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/sentences.hpp"
#include "reports/flow/overview.hpp"
#include "reports/flow/report.hpp"

namespace crossgrain::reports {

namespace {

/// Fields that are drawn; the CSV file has all.
constexpr std::array drawnFields = {"volume_fraction", "azimuthal_velocity", "spin",
                                    "fabric_trace",    "stress_rr",          "stress_pr"};

using Names = std::vector<std::string>;

/// Below it two weights agree on a field: packings of one cell differ as much at best.
constexpr double hardlyApart = 0.05;

struct Weighing {
  std::string method, words;
  LineStyle style;  ///< Okabe and Ito 2008
};
/// What the others are compared with first.
const std::array<Weighing, 5> revWeights = {
    {{"slicing", "slicing", {"#000000", 7, false}},
     {"straight_cut", "straight cut", {"#56b4e9", 5, true}},
     {"centre", "centre", {"#d55e00", 9, false}},
     {"line_gaussian", "line, Gaussian", {"#009e73", 11, false}},
     {"line_heaviside", "line, Heaviside", {"#cc79a7", 13, true}}}};
const std::span comparedWeights = std::span(revWeights).subspan(1);
const std::span kernelWeights = std::span(revWeights).subspan(2);

/// From which width on a weight stays near slicing, and how far apart they are at the widest one.
struct Nearness {
  std::optional<double> from;    ///< [d]; absent: too far from it at the widest ring
  std::optional<double> widest;  ///< difference there, in units of slicing's; absent: no data
};

Nearness nearnessOf(const RevResults& results, std::string_view field, std::string_view method) {
  std::set<double> widths;
  for (const RevCurve& curve : results.curves)
    widths.insert(curve.width.begin(), curve.width.end());
  Nearness near;
  for (auto width = widths.rbegin(); width != widths.rend(); ++width) {
    const auto apart = differenceFromSlicing(results.curves, field, method, *width);
    if (!apart) continue;
    if (!near.widest) near.widest = apart;
    if (*apart > hardlyApart) break;
    near.from = *width;
  }
  return near;
}

OverviewCell nearnessCell(const Nearness& near) {
  OverviewCell cell{Verdict::notMeasured, near.from, "d", {}, {}, "figures"};
  if (!near.widest) return cell;
  cell.verdict.reset();
  cell.shown = near.from ? fmt::format("≥ {} d", readableSetting(near.from))
                         : readablePercent(*near.widest) + " % apart";
  if (!near.from) {
    cell.verdict = Verdict::borderline;
    cell.words = "in the widest ring";
  }
  return cell;
}

/// All fields under one weight.
struct WeightSummary {
  Names apart;        ///< fields that differ from slicing at any width
  double from = 0.0;  ///< [d]: all others are slicing's from there on
  bool any = false;   ///< it has data
};

WeightSummary weightSummaryOf(const RevResults& results, std::string_view method) {
  WeightSummary summary;
  for (const char* const field : drawnFields) {
    const Nearness near = nearnessOf(results, field, method);
    if (!near.widest) continue;
    summary.any = true;
    summary.from = std::max(summary.from, near.from.value_or(0.0));
    if (!near.from) summary.apart.push_back(fieldWords(field));
  }
  return summary;
}

/// "400 snapshots of grain: 12 fields under 5 weights, in rings of widths from 0.1 to 4 d."
std::string revLead(const RevResults& results) {
  std::set<std::string> fields, methods;
  std::set<double> widths;
  for (const RevCurve& curve : results.curves) {
    fields.insert(curve.field);
    methods.insert(curve.method);
    widths.insert(curve.width.begin(), curve.width.end());
  }
  if (widths.empty()) return "No ring fits into the cell: nothing was averaged.";
  return fmt::format("{} of {}: {} under {}, in rings of widths from {} to {} d.",
                     counted(static_cast<std::size_t>(results.averaging.snapshots), "snapshot"),
                     results.engine, counted(fields.size(), "field"),
                     counted(methods.size(), "weight"), readableSetting(*widths.begin()),
                     readableSetting(*widths.rbegin()));
}

/// Which weights are as good as slicing from which width on, and which are not.
std::vector<std::string> revConclusion(const RevResults& results) {
  Names near, far;
  double from = 0.0;
  for (const Weighing& weight : comparedWeights) {
    const WeightSummary summary = weightSummaryOf(results, weight.method);
    if (!summary.any) continue;
    if (summary.apart.empty()) {
      near.push_back(fmt::format("{} from {} d", weight.words, readableSetting(summary.from)));
      from = std::max(from, summary.from);
    } else {
      far.push_back(fmt::format("{} ({})", weight.words, listedShortly(summary.apart, 3)));
    }
  }
  std::vector<std::string> sentences = {revLead(results)};
  if (!near.empty())
    sentences.push_back(
        fmt::format("Within 5 % of slicing in every field: {}.", fmt::join(near, "; ")));
  if (!far.empty())
    sentences.push_back(
        fmt::format("Further from slicing at any width: {}; compare engines under one weight "
                    "only.",
                    fmt::join(far, "; ")));
  else if (!near.empty())
    sentences.push_back(fmt::format(
        "Next: take rings of {} d or more where figures under different weights are compared.",
        readableSetting(from)));
  return sentences;
}

Curve drawnCurve(const RevCurve& curve, const Weighing& weight) {
  Curve drawn{spaced(weight.method), weight.style, Draw::linesAndPoints, {}, 1.2};
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
    for (const Weighing& weight : revWeights)
      for (const RevCurve& curve : results.curves)
        if (curve.field == field && curve.method == weight.method && curve.r == r)
          panel.curves.push_back(drawnCurve(curve, weight));
    panel.key = figure.panels.empty() ? Key::outside : Key::none;
    if (hasPoints(panel)) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

/// Where the method meets slicing next to that width; a dash where no radius has room for it.
std::string meetingOf(const RevResults& results, const char* field, const std::string& method,
                      double near) {
  for (const RevMeeting& row : results.meetings)
    if (row.field == field && row.method == method && row.near == near)
      return fmt::format(
          "{:.2f} ({} %)", row.width,
          finite(row.difference) ? fmt::format("{:.2g}", 100.0 * row.difference) : absentText);
  return absentText;
}

/// A row per field: where centre and line averages come closest to slicing near d and 2 d.
Table meetingTable(const RevResults& results) {
  Table table{{"field"}, {}};
  for (const Weighing& weight : kernelWeights)
    for (const char* near : {"d", "2 d"})
      table.columns.emplace_back(fmt::format("{}, near {}", weight.words, near),
                                 Column::Kind::number);
  for (const char* const field : drawnFields) {
    TableRow row{{fieldLabel(field)}};
    for (const Weighing& weight : kernelWeights)
      for (const double near : {1.0, 2.0})
        row.cells.emplace_back(meetingOf(results, field, weight.method, near));
    const bool any = std::ranges::any_of(row.cells.begin() + 1, row.cells.end(),
                                         [](const Cell& cell) { return cell.text != absentText; });
    if (any) table.rows.push_back(std::move(row));
  }
  return table;
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

}  // namespace

Overview revOverview(const RevResults& results) {
  Overview overview;
  overview.rowsAre = "field";
  overview.states = {{std::nullopt, "from that ring width on within 5 % of slicing"},
                     {Verdict::borderline, "further from slicing at any width"}};
  for (const Weighing& weight : comparedWeights)
    overview.columns.push_back(
        {weight.words,
         "From which ring width on does this weight give what slicing gives, within 5 %?", "meet"});
  for (const char* const field : drawnFields) {
    OverviewRow row{fieldWords(field), false, {}};
    for (const Weighing& weight : comparedWeights)
      row.cells.push_back(nearnessCell(nearnessOf(results, field, weight.method)));
    const bool any = std::ranges::any_of(
        row.cells, [](const OverviewCell& cell) { return cell.verdict != Verdict::notMeasured; });
    if (any) overview.rows.push_back(std::move(row));
  }
  overview.conclusion = revConclusion(results);
  return overview;
}

Report reportOf(const RevResults& results) {
  Report report{{results.head,
                 {{results.engine, "", "", "", Status::finished, ""}},  // whose snapshots
                 revOverview(results)}};
  report.engineColours = false;  // colours are weights
  report.caseHeading = "The case: its cell, rings and weights";
  report.notes = {
      "Nothing was run and nothing compared but ways of averaging the same snapshots: what depends "
      "on the ring's width or on the weight comes from averaging there, not from the field."};
  if (const auto width = results.averaging.lineWidth)
    report.notes.push_back(fmt::format("Kernels of the line methods have the width w = {} d.",
                                       readableSetting(width)));
  std::ranges::copy(results.notes, std::back_inserter(report.notes));
  for (const char* const field : drawnFields)
    if (Figure figure = fieldFigure(results, field); !figure.panels.empty())
      report.figures.push_back(std::move(figure));
  report.section("figures", "Fields against ring width").blocks = {
      Paragraph{
          "A ring of width Δr about each of a few radii, under every weight. Narrow rings show "
          "the disks themselves, each weight in its own way; what does not depend on the "
          "weight can be taken as a field."},
      drawingsOf(report.figures, "rev_")};
  report.section("meet", "Where weights meet").blocks = {
      Paragraph{
          "The ring width Δr/d at which a weight comes closest to slicing, next to d and next "
          "to 2 d, and the difference of the two then: root mean square over the radii, as a "
          "part of slicing's."},
      meetingTable(results)};
  report.tables = {{"rev.csv", revCsv(results)}, {"rev_meetings.csv", revMeetingsCsv(results)}};
  return report;
}

}  // namespace crossgrain::reports
