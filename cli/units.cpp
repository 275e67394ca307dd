#include "cli/units.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "support/bad_input.hpp"

namespace crossgrain::inline cli {
namespace {

/// A positive number and one of some units. @throws BadInput
double numberWithUnit(const std::string& option, const std::string& text,
                      const std::map<std::string, double>& units, const char* example) {
  std::size_t end = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = 0;
  }
  const auto unit = units.find(text.substr(end));
  if (end == 0 || unit == units.end() || !(value > 0.0) || !std::isfinite(value))
    throw BadInput(fmt::format("{} {}: must be like {}", option, text, example));
  return value * unit->second;
}

}  // namespace

double secondsOf(const std::string& budget) {
  return numberWithUnit("--budget", budget, {{"", 1.0}, {"s", 1.0}, {"m", 60.0}, {"h", 3600.0}},
                        "90s, 10m or 1h");
}

double fractionOf(const std::string& target) {
  return numberWithUnit("--want", target, {{"", 1.0}, {"%", 0.01}}, "1% or 1e-3");
}

}  // namespace crossgrain::inline cli
