#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/common/page.hpp"
#include "reports/common/sentences.hpp"
#include "reports/couette/overview.hpp"
#include "reports/couette/rev_fields.hpp"
#include "reports/couette/state_view.hpp"

namespace crossgrain::reports {

namespace {

using Names = std::vector<std::string>;

constexpr const char* plainWeight = "slicing";  ///< what the others are held against
/// Below it two weights say the same of a field: as much as packings of one cell differ at best.
constexpr double hardlyApart = 0.05;

struct Weighing {
  const char *method, *words;
};
constexpr std::array weights = {
    Weighing{"straight_cut", "straight cut"}, Weighing{"centre", "centre"},
    Weighing{"line_gaussian", "line, Gaussian"}, Weighing{"line_heaviside", "line, Heaviside"}};

const RevCurve* curveOf(const RevResults& results, std::string_view field, std::string_view method,
                        double r) {
  for (const RevCurve& curve : results.curves)
    if (curve.field == field && curve.method == method && curve.r == r) return &curve;
  return nullptr;
}

std::optional<double> meanAt(const RevCurve& curve, double width) {
  const auto found = std::ranges::find(curve.width, width);
  if (found == curve.width.end()) return std::nullopt;
  return at(curve.mean, static_cast<std::size_t>(found - curve.width.begin()));
}

/// √⟨(m − slicing)²⟩/√⟨slicing²⟩ over the radii that have room for a ring of that width.
std::optional<double> apartAt(const RevResults& results, std::string_view field,
                              std::string_view method, double width) {
  double difference = 0.0, scale = 0.0;
  for (const RevCurve& plain : results.curves) {
    if (plain.field != field || plain.method != plainWeight) continue;
    const RevCurve* other = curveOf(results, field, method, plain.r);
    const auto a = meanAt(plain, width), b = other ? meanAt(*other, width) : std::nullopt;
    if (!a || !b) continue;
    difference += (*b - *a) * (*b - *a);
    scale += *a * *a;
  }
  if (scale == 0.0) return std::nullopt;
  return std::sqrt(difference / scale);
}

/// From which width on a weight stays near slicing, and how far apart they are at the widest one.
struct Nearness {
  std::optional<double> from;    ///< [d]; absent: it is too far off at the widest ring
  std::optional<double> widest;  ///< difference there, in units of slicing's; absent: no data
};

Nearness nearnessOf(const RevResults& results, std::string_view field, std::string_view method) {
  std::set<double> widths;
  for (const RevCurve& curve : results.curves)
    widths.insert(curve.width.begin(), curve.width.end());
  Nearness near;
  for (auto width = widths.rbegin(); width != widths.rend(); ++width) {
    const auto apart = apartAt(results, field, method, *width);
    if (!apart) continue;
    if (!near.widest) near.widest = apart;
    if (*apart > hardlyApart) break;
    near.from = *width;
  }
  return near;
}

OverviewCell cellOf(const Nearness& near) {
  OverviewCell cell{CellState::notMeasured, near.from, "d", {}, {}, "figures"};
  if (!near.widest) return cell;
  cell.state = near.from ? CellState::figure : CellState::borderline;
  cell.shown = near.from ? fmt::format("≥ {} d", readableSetting(near.from))
                         : readablePercent(*near.widest) + " % apart";
  if (!near.from) cell.words = "in the widest ring";
  return cell;
}

/// What the fields under one weight come to.
struct WeightTold {
  Names apart;        ///< fields that it has otherwise at any width
  double from = 0.0;  ///< [d]: all others are slicing's from there on
  bool any = false;   ///< it has data
};

WeightTold toldOf(const RevResults& results, std::string_view method) {
  WeightTold told;
  for (const char* const field : drawnRevFields) {
    const Nearness near = nearnessOf(results, field, method);
    if (!near.widest) continue;
    told.any = true;
    told.from = std::max(told.from, near.from.value_or(0.0));
    if (!near.from) told.apart.push_back(fieldWords(field));
  }
  return told;
}

/// Which weights are as good as slicing from which width on, and which are not.
std::vector<std::string> revConclusion(const RevResults& results) {
  Names near, far;
  double from = 0.0;
  for (const Weighing& weight : weights) {
    const WeightTold told = toldOf(results, weight.method);
    if (!told.any) continue;
    if (told.apart.empty()) {
      near.push_back(fmt::format("{} from {} d", weight.words, readableSetting(told.from)));
      from = std::max(from, told.from);
    } else {
      far.push_back(fmt::format("{} ({})", weight.words, listedShortly(told.apart, 3)));
    }
  }
  std::vector<std::string> sentences = {revLead(results)};
  if (!near.empty())
    sentences.push_back(
        fmt::format("Within 5 % of slicing in every field: {}.", fmt::join(near, "; ")));
  if (!far.empty())
    sentences.push_back(
        fmt::format("Further off at any width: {}; hold engines against each other under one "
                    "weight only.",
                    fmt::join(far, "; ")));
  else if (!near.empty())
    sentences.push_back(fmt::format(
        "Next: take rings of {} d or more where figures under different weights are compared.",
        readableSetting(from)));
  return sentences;
}

}  // namespace

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

Overview revOverview(const RevResults& results) {
  Overview overview;
  overview.rowsAre = "field";
  overview.states = {{CellState::figure, "from that ring width on within 5 % of slicing"},
                     {CellState::borderline, "further from slicing at any width"}};
  for (const Weighing& weight : weights)
    overview.columns.push_back(
        {weight.words,
         "From which ring width on does this weight give what slicing gives, within 5 %?", "meet"});
  for (const char* const field : drawnRevFields) {
    OverviewRow row{fieldWords(field), false, {}};
    for (const Weighing& weight : weights)
      row.cells.push_back(cellOf(nearnessOf(results, field, weight.method)));
    const bool any = std::ranges::any_of(
        row.cells, [](const OverviewCell& cell) { return cell.state != CellState::notMeasured; });
    if (any) overview.rows.push_back(std::move(row));
  }
  overview.conclusion = revConclusion(results);
  return overview;
}

}  // namespace crossgrain::reports
