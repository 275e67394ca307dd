#include "reports/common/numbers.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace crossgrain::reports {

std::optional<double> finite(std::optional<double> value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> at(const std::vector<std::optional<double>>& list, std::size_t k) {
  return k < list.size() ? finite(list[k]) : std::nullopt;
}

std::optional<double> at(const std::vector<double>& list, std::size_t k) {
  return k < list.size() ? finite(list[k]) : std::nullopt;
}

std::string readableDifference(std::optional<double> value, std::optional<double> error) {
  const std::string both = readable(value, error);
  if (!value || *value <= 0.0) return both;
  return both.starts_with('(') ? "(+" + both.substr(1) : "+" + both;
}

std::string readablePercent(double fraction) {
  const double percent = 100.0 * fraction;
  return percent < 0.95 ? fmt::format("{:.1g}", percent) : fmt::format("{:.0f}", percent);
}

std::string shortly(std::optional<double> value) {
  if (!finite(value)) return absentText;
  return readableSetting(std::strtod(fmt::format("{:.2g}", *value).c_str(), nullptr));
}

std::optional<double> times(std::optional<double> value, double factor) {
  return value ? std::optional(*value * factor) : std::nullopt;
}

std::string readableDuration(std::optional<double> seconds) {
  if (!seconds) return absentText;
  if (*seconds < 59.95) return readable(seconds) + " s";
  const auto whole = std::llround(*seconds);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string shortDuration(std::optional<double> seconds) {
  if (!finite(seconds) || *seconds <= 0.0 || *seconds >= 0.9995) return readableDuration(seconds);
  if (*seconds >= 0.9995e-3) return readable(1e3 * *seconds) + " ms";
  return readable(1e6 * *seconds) + " µs";
}

}  // namespace crossgrain::reports
