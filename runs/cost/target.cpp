#include "runs/cost/target.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace crossgrain::inline runs {

Standing standingOf(const CostPoint& point, double target) {
  const MeasuredError error = *measuredError(point);
  if (error.high() <= target) return Standing::meets;
  return error.low() <= target ? Standing::may : Standing::cannot;
}

double timeOf(const CostPoint& point) {
  return point.wallSeconds.value_or(std::numeric_limits<double>::infinity());
}

std::string whatDecides(const CostPoint& point, double target) {
  if (!point.error) return "smaller steps: this one is bounded and not measured";
  if (measuredError(point)->saysNothing()) return "more packings: one shows no statistical error";
  const double distance = std::abs(target - *point.error);
  const double statistical = point.statistical.value_or(0.0);
  const double reference = point.referenceError.value_or(0.0);
  const double room = distance - reference;
  if (statistical > 0.0 && room > 0.0) {
    const double times = (statistical / room) * (statistical / room);
    return times < 1000.0 ? fmt::format("{:.1f} times as much simulated time", times)
                          : "more than 1000 times as much simulated time";
  }
  if (reference > 0.0 && distance > statistical)
    return fmt::format("a reference known to {:.1e}", distance - statistical);
  if (reference > 0.0 && distance > 0.0)
    return fmt::format("a reference known to better than {:.1e} and more simulated time", distance);
  return "nothing: the error is the target";
}

std::optional<double> lengthFor(const CostPoint& point, double target) {
  if (!point.statistical || *point.statistical <= 0.0) return std::nullopt;
  return (*point.statistical / target) * (*point.statistical / target);
}

std::optional<std::size_t> mayYetReach(const std::vector<CostPoint>& points,
                                       const PointIndices& notRun, const CostPoint& best) {
  PointIndices open = notRun;
  std::erase_if(open, [&](std::size_t k) {
    return points[k].knob == "time_step" && points[k].dt >= best.dt;
  });
  return least(open, [&](std::size_t k) { return -points[k].dt.value_or(0.0); });
}

std::string notRunInWords(const CostPoint& point, std::size_t count) {
  const std::string more =
      count > 1 ? fmt::format(" and {} more, which were", count - 1) : ", which was";
  return fmt::format("{}{} not run: {}", point.setting, more, point.reason);
}

}  // namespace crossgrain::inline runs
