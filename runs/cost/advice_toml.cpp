#include <fmt/format.h>

#include "cases/cost_knobs.hpp"
#include "runs/cost/advice.hpp"

namespace crossgrain::inline runs {

namespace {

std::string costInWords(const Advice& one) {
  if (!one.wallSeconds) return {};
  return fmt::format(", {:.3g} s per {}", *one.wallSeconds,
                     one.costKind() == CostKind::averages ? "rotation" : "sweep of collisions");
}

std::string settingInWords(const Advice& one) {
  return speaksForItself(one.knob) ? one.setting : one.knob + " " + one.setting;
}

std::string obstacleInWords(const CostPoint& point) {
  const MeasuredError error = *measuredError(point);
  return fmt::format("# {}, {}: {:.2g} to {:.2g} of its scale\n", toString(point.kind),
                     point.measure, error.low(), error.high());
}

std::string asToml(const Advice& one, const std::vector<CostPoint>& points) {
  std::string text =
      fmt::format("# {}, wanted {:g} %: {}", one.engine, 100.0 * one.target, toString(one.verdict));
  const bool reached = one.verdict == CostVerdict::reached;
  if (!one.setting.empty())
    text +=
        fmt::format("{}{}{} (measured in {}){}",
                    reached                                   ? " by "
                    : one.verdict == CostVerdict::notMeasured ? " far enough; the best so far is "
                                                              : "; the best is ",
                    settingInWords(one), costInWords(one), inWords(one.kinds),
                    one.cheapest ? "; the cheapest engine" : "");
  text += "\n";
  if (one.obstacle) text += obstacleInWords(points[*one.obstacle]);
  if (!one.decides.empty()) text += "# what would decide: " + one.decides + "\n";
  if (!reached) return text;
  text += one.fragment.empty() ? "# the case as it is: nothing to change\n" : one.fragment;
  return text.ends_with('\n') ? text : text + "\n";
}

}  // namespace

std::string adviceAsToml(const std::vector<Advice>& advice, const std::vector<CostPoint>& points) {
  std::string text;
  for (const Advice& one : advice) text += (text.empty() ? "" : "\n") + asToml(one, points);
  return text;
}

}  // namespace crossgrain::inline runs
