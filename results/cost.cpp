#include "results/cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace crossgrain::inline results {

namespace {

constexpr std::string_view ownSuffix = "_own";

}  // namespace

bool isOwn(const std::string& measure) {
  return measure.ends_with(ownSuffix);
}

std::string ownOf(const std::string& measure) {
  return measure + std::string(ownSuffix);
}

std::string withoutOwn(const std::string& measure) {
  const bool hasOther = isOwn(measure) && !measure.starts_with("position_rms_");
  return hasOther ? measure.substr(0, measure.size() - ownSuffix.size()) : measure;
}

std::optional<std::string> schemeOf(const std::string& knob, const std::string& setting) {
  if (knob == "time_step") return std::string();
  const auto comma = setting.find(',');
  if (knob != "integrator" || comma == std::string::npos) return std::nullopt;
  return setting.substr(0, comma);
}

std::string withoutStep(const std::string& knob, const std::string& setting) {
  return knob == "time_step" ? "" : setting.substr(0, setting.find(','));
}

std::size_t CostResults::count(Status status) const {
  return static_cast<std::size_t>(std::ranges::count(points, status, &CostPoint::status));
}

namespace {

std::optional<double> quotient(std::optional<double> one, std::optional<double> other) {
  if (!one || !other || !(*other > 0.0)) return std::nullopt;
  return *one / *other;
}

/// Of one worker.
std::optional<double> stepAlone(const std::vector<StepTime>& times, const std::string& engine,
                                std::size_t bodies) {
  for (const StepTime& one : times)
    if (one.engine == engine && one.bodies == bodies && one.workers == 1 && one.ran())
      return one.step;
  return std::nullopt;
}

}  // namespace

StepFigures stepFigures(const std::vector<StepTime>& times, const StepTime& of) {
  StepFigures figures;
  if (!of.ran()) return figures;
  figures.step = of.step;
  if (of.seconds.size() > 1)
    figures.spread = std::ranges::max(of.seconds) / std::ranges::min(of.seconds) - 1.0;
  const auto bodies = static_cast<double>(of.bodies);
  figures.perBody = of.step / bodies;
  figures.bytes = quotient(of.memory, bodies);
  figures.ratio = quotient(of.step, stepAlone(times, times.front().engine, of.bodies));
  const auto workers = static_cast<std::size_t>(of.workers);
  if (workers < 2) return figures;
  figures.strong = quotient(stepAlone(times, of.engine, of.bodies), of.workers * of.step);
  if (of.bodies % workers == 0)
    figures.weak = quotient(stepAlone(times, of.engine, of.bodies / workers), of.step);
  return figures;
}

std::optional<StepForecast> stepForecast(const std::vector<StepTime>& times, const StepTime& of) {
  const StepTime *small = nullptr, *large = nullptr;
  for (const StepTime& one : times) {
    if (one.engine != of.engine || one.workers != of.workers || !one.ran()) continue;
    if (one.bodies >= of.bodies || (large && one.bodies == large->bodies)) continue;
    if (!large || one.bodies > large->bodies)
      small = std::exchange(large, &one);
    else if (!small || one.bodies > small->bodies)
      small = &one;
  }
  if (!small) return std::nullopt;
  const auto bodies = static_cast<double>(of.bodies), fewer = static_cast<double>(small->bodies),
             more = static_cast<double>(large->bodies);
  const double alike = large->step * bodies / more;  // per body as before
  const double power = std::log(large->step / small->step) / std::log(more / fewer);
  const double further = large->step * std::pow(bodies / more, power);
  StepForecast forecast{small->bodies, large->bodies, std::min(alike, further),
                        std::max(alike, further), std::nullopt};
  if (small->memory && large->memory) {
    const double perBody = (*large->memory - *small->memory) / (more - fewer);
    forecast.memory = *large->memory + std::max(perBody, 0.0) * (bodies - more);
  }
  return forecast;
}

std::string describeWorkers(const StepTime& of) {
  if (of.workersAre.empty()) return "one process";
  const std::string& many = of.workersAre;
  return fmt::format("{} {}", of.workers, of.workers == 1 ? many.substr(0, many.size() - 1) : many);
}

}  // namespace crossgrain::inline results
