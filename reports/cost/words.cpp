#include "reports/cost/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "cases/cost_knobs.hpp"
#include "reports/common/labels.hpp"
#include "reports/common/numbers.hpp"
#include "reports/effects/variants.hpp"

namespace crossgrain::reports {

namespace {

/// Of a collision; "Ψ_f" as labels.hpp writes symbols. Empty: not one of its measures.
std::string collisionSymbol(const std::string& measure) {
  return measure == "psi_f" ? "Ψ_f" : measure == "e_n" ? "e_n" : "";
}

/// Whether a measure is a field that people write with a symbol of its own.
bool isField(const std::string& measure) {
  return fieldPlotSymbol(measure) != spaced(measure);
}

/// Whose reference positions are held against; empty of other measures.
std::string againstWhom(const std::string& measure) {
  constexpr std::string_view positions = "position_rms_";
  if (!measure.starts_with(positions)) return {};
  const std::string whom = measure.substr(positions.size());
  return whom == "own" ? "itself" : whom;
}

constexpr const char* ofOwn = ", against its own limit";

/// What all three ways of telling an unknown measure share.
std::string plainWords(const std::string& measure) {
  const std::string whom = againstWhom(measure);
  return whom.empty() ? spaced(measure) : "positions, against " + spaced(whom);
}

}  // namespace

std::string settingWords(const std::string& knob, const std::string& setting) {
  constexpr std::string_view effect = "effect:";
  if (speaksForItself(knob)) return setting;
  if (knob.starts_with(effect)) return effectLabel(knob.substr(effect.size())) + " " + setting;
  return setting.starts_with(knob) ? spaced(knob) + setting.substr(knob.size())
                                   : spaced(knob) + " " + setting;
}

std::string plainSetting(const std::string& knob, const std::string& setting) {
  std::string words = settingWords(knob, setting);
  const auto isLetter = [&](std::size_t k) {
    return k < words.size() && std::isalpha(static_cast<unsigned char>(words[k])) != 0;
  };
  for (std::size_t k = 2; k < words.size(); ++k)
    if (words[k] == '_' && isLetter(k - 1) && isLetter(k - 2)) words[k] = ' ';
  return words;
}

std::string settingWords(const CostPoint& point) {
  return settingWords(point.knob, point.setting);
}

std::string settingWords(const Advice& advice) {
  return settingWords(advice.knob, advice.setting);
}

std::string measureHtml(const std::string& measure) {
  if (const std::string scene = sceneOf(measure); scene != measure)
    return measureHtml(scene) + ofOwn;
  if (const std::string symbol = collisionSymbol(measure); !symbol.empty()) return mathHtml(symbol);
  return againstWhom(measure).empty() ? mathHtml(fieldLabel(measure)) : mathHtml(plainWords(measure));
}

std::string measureEnhanced(const std::string& measure) {
  if (const std::string scene = sceneOf(measure); scene != measure)
    return measureEnhanced(scene) + ofOwn;
  if (const std::string symbol = collisionSymbol(measure); !symbol.empty())
    return mathGnuplot(symbol);
  return isField(measure) ? fieldWords(measure) + " " + fieldPlotSymbol(measure)
                          : plainWords(measure);
}

std::string measureWords(const std::string& measure) {
  if (const std::string scene = sceneOf(measure); scene != measure)
    return measureWords(scene) + ofOwn;
  if (std::string symbol = collisionSymbol(measure); !symbol.empty()) return symbol;
  return isField(measure) ? fieldWords(measure) : plainWords(measure);
}

std::string kindWords(CostKind kind) {
  return kind == CostKind::collision ? "collisions" : toString(kind);
}

std::string timeUnit(CostKind kind) {
  constexpr std::array units = {"one sweep of collisions", "the window", "one rotation"};
  return units[static_cast<std::size_t>(kind)];
}

std::string statusText(CostStatus status) {
  return status == CostStatus::notMeasured ? "not measured" : toString(status);
}

std::string percentText(std::optional<double> fraction) {
  if (!fraction) return absentText;
  if (*fraction == 0.0) return "0";
  constexpr double least = 1e-5;  // as a percentage
  if (*fraction < least) return readableSetting(std::stod(fmt::format("{:.1e}", *fraction)));
  const double percent = 100.0 * *fraction;
  return (percent < 99.5 ? fmt::format("{:.2g}", percent) : readable(percent)) + " %";
}

std::string errorText(const CostPoint& point) {
  if (!point.ran()) return statusText(point.status);
  if (!point.error && point.bound) return "at most " + percentText(point.bound);
  const std::string error = percentText(point.error);
  if (point.error && measuredError(point)->saysNothing())
    return error + ", of one packing: no statistical error";
  return error + (point.statistical ? " ± " + percentText(point.statistical) : "");
}

std::string intervalText(const CostPoint& point) {
  const auto error = measuredError(point);
  if (!point.ran() || !error || error->saysNothing()) return errorText(point);
  if (error->boundCounts()) return fmt::format("at most {} (bound)", percentText(error->high()));
  const std::string low = percentText(error->low()), high = percentText(error->high());
  if (low == high) return percentText(error->value);
  return fmt::format("{} ({} to {})", percentText(error->value), low, high);
}

std::string targetText(double target) {
  if (target >= 1e-4) return fmt::format("{:g} %", 100.0 * target);
  const std::string power = readableSetting(target);
  return power.starts_with("1×") ? power.substr(std::string("1×").size()) : power;
}

std::string costText(const Advice& advice) {
  if (!advice.wallSeconds) return "time not known";
  const auto kind = advice.costKind();
  return fmt::format("{} for {}", readableDuration(advice.wallSeconds),
                     kind ? timeUnit(*kind) : "one run");
}

}  // namespace crossgrain::reports
