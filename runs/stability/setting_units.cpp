#include "runs/stability/setting_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace crossgrain::inline runs {

namespace {

/// A unit of SI and its powers of length, mass and time.
struct Dimension {
  std::string_view unit;
  int length, mass, time;
};
constexpr std::array dimensions = {
    Dimension{"", 0, 0, 0},       Dimension{"-", 0, 0, 0},
    Dimension{"rad", 0, 0, 0},    Dimension{"m", 1, 0, 0},
    Dimension{"s", 0, 0, 1},      Dimension{"kg", 0, 1, 0},
    Dimension{"m/s", 1, 0, -1},   Dimension{"m/s²", 1, 0, -2},
    Dimension{"1/s", 0, 0, -1},   Dimension{"/s", 0, 0, -1},
    Dimension{"Hz", 0, 0, -1},    Dimension{"rad/s", 0, 0, -1},
    Dimension{"N", 1, 1, -2},     Dimension{"N/m", 0, 1, -2},
    Dimension{"kg/s", 0, 1, -1},  Dimension{"Pa", -1, 1, -2},
    Dimension{"J", 2, 1, -2},     Dimension{"1/m", -1, 0, 0},
    Dimension{"kg/m³", -3, 1, 0}, Dimension{"smallest radius", 0, 0, 0}};

}  // namespace

std::optional<double> factorOf(const std::string& unit, const Units& units) {
  const auto found = std::ranges::find(dimensions, unit, &Dimension::unit);
  if (found == dimensions.end()) return std::nullopt;
  return units.of(found->length, found->mass, found->time);
}

Settings inUnits(Settings settings, const std::vector<SettingSpec>& specs, const Units& units) {
  if (units == Units{}) return settings;
  for (const SettingSpec& spec : specs) {
    const auto said = settings.find(spec.name);
    const SettingValue value = said == settings.end() ? spec.defaultValue : said->second;
    const auto* number = std::get_if<double>(&value);
    if (!number || *number == 0.0) continue;
    const auto factor = factorOf(spec.unit, units);
    if (!factor)
      throw UnsupportedScene(fmt::format("how its setting {} scales is not known: its unit is '{}'",
                                         spec.name, spec.unit));
    if (*factor != 1.0) settings[spec.name] = *number * *factor;
  }
  return settings;
}

}  // namespace crossgrain::inline runs
