#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <span>

#include "reports/flow/report.hpp"

namespace crossgrain::reports {

namespace {

/// Fields that are drawn, those that bins of their kind have; the CSV file has all.
constexpr std::array drawnFields = {
    "volume_fraction", "azimuthal_velocity", "velocity_x", "velocity_y", "velocity_z", "spin",
    "fabric_trace",    "stress_rr",          "stress_xx",  "stress_yy",  "stress_zz",  "stress_pr",
    "stress_yx",       "stress_zx"};

/// A field in words; where these leave out a component along x, y or z, by its name.
std::string drawnName(const std::string& field) {
  const bool components =
      field == "velocity_z" || (field.starts_with("stress_") && field.back() >= 'x');
  return components ? spaced(field) : fieldWords(field);
}

/// Name of a bin, symbol of its place, and symbol of its width.
struct BinWords {
  std::string bin, place, width;
};
BinWords wordsOf(const RevResults& results) {
  if (!results.region || results.region->bins == "rings") return {"ring", "r", "Δr"};
  const RegionRow& region = *results.region;
  const std::string along = region.along.empty() ? region.z.empty() ? "y" : "z" : region.along;
  if (!region.along.empty()) return {"slab", along, "Δ" + along};
  return {region.z.empty() ? "square" : "cube", along, "Δ" + along};
}

/// Below it two weights agree on a field: packings of one cell differ as much at best.
constexpr double hardlyApart = 0.05;

struct Weighing {
  std::string method, words;
  LineStyle style;  ///< Okabe and Ito 2008
};
/// Weighing that the others are compared with first.
const Weighing bySlicing = {"slicing", "slicing", {"#000000", 7, false}};
const Weighing byCentre = {"centre", "centre", {"#d55e00", 9, false}};
const std::vector<Weighing> planeWeights = {
    bySlicing,
    {"straight_cut", "straight cut", {"#56b4e9", 5, true}},
    byCentre,
    {"line_gaussian", "line, Gaussian", {"#009e73", 11, false}},
    {"line_heaviside", "line, Heaviside", {"#cc79a7", 13, true}}};
/// The last three are of slabs alone.
const std::vector<Weighing> spaceWeights = {bySlicing,
                                            byCentre,
                                            {"heaviside", "Heaviside", {"#cc79a7", 13, true}},
                                            {"lucy", "Lucy", {"#e69f00", 4, true}},
                                            {"gauss", "Gauss", {"#009e73", 11, false}}};

std::span<const Weighing> weightsOf(const RevResults& results) {
  if (!results.region || results.region->z.empty()) return planeWeights;
  return std::span(spaceWeights).first(results.region->bins == "slabs" ? 5 : 2);
}
std::span<const Weighing> comparedWeights(const RevResults& results) {
  return weightsOf(results).subspan(1);
}
/// Without straight cuts, which are areas as slicing is.
std::span<const Weighing> kernelWeights(const RevResults& results) {
  return results.averaging.lineWidth ? weightsOf(results).subspan(2) : comparedWeights(results);
}

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

OverviewCell nearnessCell(const Nearness& near, const BinWords& words) {
  OverviewCell cell{Verdict::notMeasured, near.from, "d", {}, {}, "figures"};
  if (!near.widest) return cell;
  cell.verdict.reset();
  cell.shown = near.from ? fmt::format("≥ {} d", readableSetting(near.from))
                         : readablePercent(*near.widest) + " % apart";
  if (!near.from) {
    cell.verdict = Verdict::borderline;
    cell.words = "in the widest " + words.bin;
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
    if (!near.from) summary.apart.push_back(drawnName(field));
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
  if (widths.empty()) return "No average over any width.";
  return fmt::format("{} of {}: {} under {}, in {}s of widths from {} to {} d.",
                     counted(static_cast<std::size_t>(results.averaging.snapshots), "snapshot"),
                     results.engine, counted(fields.size(), "field"),
                     counted(methods.size(), "weight"), wordsOf(results).bin,
                     readableSetting(*widths.begin()), readableSetting(*widths.rbegin()));
}

/// Which weights are as good as slicing from which width on, and which are not.
Names revConclusion(const RevResults& results) {
  Names near, far;
  double from = 0.0;
  for (const Weighing& weight : comparedWeights(results)) {
    const WeightSummary summary = weightSummaryOf(results, weight.method);
    if (!summary.any) continue;
    if (summary.apart.empty()) {
      near.push_back(fmt::format("{} from {} d", weight.words, readableSetting(summary.from)));
      from = std::max(from, summary.from);
    } else {
      far.push_back(fmt::format("{} ({})", weight.words, listedShortly(summary.apart, 3)));
    }
  }
  Names sentences = {revLead(results)};
  if (!near.empty())
    sentences.push_back(
        fmt::format("Within 5 % of slicing in every field: {}.", fmt::join(near, "; ")));
  if (!far.empty())
    sentences.push_back(
        fmt::format("Further from slicing at any width: {}; compare engines under one weight only.",
                    fmt::join(far, "; ")));
  else if (!near.empty())
    sentences.push_back(fmt::format(
        "Next: take {}s of {} d or more where figures under different weights are compared.",
        wordsOf(results).bin, readableSetting(from)));
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
  const BinWords words = wordsOf(results);
  std::set<double> radii;
  for (const RevCurve& curve : results.curves) radii.insert(curve.r);
  Figure figure{fmt::format("rev_{}", field),
                fmt::format("{} against {} width", drawnName(field), words.bin),
                fmt::format("{}: {}s of width {} about each {}.", drawnName(field), words.bin,
                            words.width, words.bin == "ring" ? "radius" : "place"),
                {},
                2};
  for (const double r : radii) {
    Panel panel;
    panel.title = fmt::format("{} = {:.4g} m", words.place, r);
    panel.xLabel = words.width + " / d";
    panel.yLabel = fieldAxis(field);
    panel.logX = true;
    for (const Weighing& weight : weightsOf(results))
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
  Table table{{"field"}};
  for (const Weighing& weight : kernelWeights(results))
    for (const char* near : {"d", "2 d"})
      table.columns.push_back(numbers(fmt::format("{}, near {}", weight.words, near)));
  for (const char* const field : drawnFields) {
    TableRow row{{fieldLabel(field)}};
    for (const Weighing& weight : kernelWeights(results))
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

/// A field per row, a weight per column: from which ring width on the weight hardly matters.
Overview revOverview(const RevResults& results) {
  Overview overview;
  overview.rowsAre = "field";
  const BinWords words = wordsOf(results);
  overview.states = {
      {std::nullopt, fmt::format("from that {} width on within 5 % of slicing", words.bin)},
      {Verdict::borderline, "further from slicing at any width"}};
  for (const Weighing& weight : comparedWeights(results))
    overview.columns.push_back(
        {weight.words,
         fmt::format("From which {} width on does this weight give what slicing gives, within 5 %?",
                     words.bin),
         "meet"});
  for (const char* const field : drawnFields) {
    OverviewRow row{drawnName(field), false, {}};
    for (const Weighing& weight : comparedWeights(results))
      row.cells.push_back(nearnessCell(nearnessOf(results, field, weight.method), words));
    const bool any = std::ranges::any_of(
        row.cells, [](const OverviewCell& cell) { return cell.verdict != Verdict::notMeasured; });
    if (any) overview.rows.push_back(std::move(row));
  }
  overview.conclusion = revConclusion(results);
  return overview;
}

}  // namespace

Report reportOf(const RevResults& results) {
  Report report{{results.head,
                 {{results.engine, "", "", "", Status::finished, ""}},  // whose snapshots
                 revOverview(results)}};
  report.engineColours = false;  // colours are weights
  const BinWords words = wordsOf(results);
  const bool rings = words.bin == "ring";
  report.caseHeading = results.region ? "The case: its averaged part and weights"
                                      : "The case: its cell, rings and weights";
  report.notes = {fmt::format(
      "Nothing was run and nothing compared but ways of averaging the same snapshots: what depends "
      "on the {}'s width or on the weight comes from averaging there, not from the field.",
      words.bin)};
  if (const auto width = results.averaging.lineWidth)
    report.notes.push_back(fmt::format("Kernels of the line methods have the width w = {} d.",
                                       readableSetting(width)));
  else if (weightsOf(results).size() > 2)
    report.notes.push_back(
        fmt::format("Of Heaviside, Lucy and Gauss {} is the length over which the function "
                    "reaches, 2 c or 6 w, in slabs of d/10.",
                    words.width));
  std::ranges::copy(results.notes, std::back_inserter(report.notes));
  for (const char* const field : drawnFields)
    if (Figure figure = fieldFigure(results, field); !figure.panels.empty())
      report.figures.push_back(std::move(figure));
  report.section("figures", fmt::format("Fields against {} width", words.bin)).blocks = {
      Paragraph{
          fmt::format("A {0} of width {1} about each of a few {2}, under every weight. "
                      "Narrow {0}s show the particles themselves, each weight in its own way; what "
                      "does not depend on the weight can be taken as a field.",
                      words.bin, words.width, rings ? "radii" : "places")},
      drawingsOf(report.figures, "rev_")};
  report.section("meet", "Where weights meet").blocks = {
      Paragraph{fmt::format("The {} width {}/d at which a weight comes closest to slicing, next to "
                            "d and next to 2 d, and the difference of the two then: root mean "
                            "square over the {}, as a part of slicing's.",
                            words.bin, words.width, rings ? "radii" : "places")},
      meetingTable(results)};
  report.tables = {{"rev.csv", revCsv(results)}, {"rev_meetings.csv", revMeetingsCsv(results)}};
  return report;
}

}  // namespace crossgrain::reports
