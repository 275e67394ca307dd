#include "runs/common/engine_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/registry.hpp"

namespace crossgrain::inline runs {
namespace {

const double* stepIn(const Settings& settings) {
  const auto found = settings.find("dt");
  return found == settings.end() ? nullptr : std::get_if<double>(&found->second);
}

}  // namespace

Settings settingsSaid(const Case& setup, const std::string& engine) {
  Settings settings;
  if (const auto section = setup.engines.find(engine); section != setup.engines.end())
    settings = section->second;
  if (const EngineEntry* const entry = findEngine(engine))
    settings.insert(entry->settings.begin(), entry->settings.end());
  return settings;
}

Settings withStep(Settings settings, const Case& setup, const Capabilities& can) {
  const bool has = std::ranges::find(can.settings, "dt", &SettingSpec::name) != can.settings.end();
  if (setup.run.dt && has) settings.try_emplace("dt", 0.0);
  return settings;
}

std::optional<double> stepOfItsOwn(const Case& setup, const std::string& engine,
                                   const Capabilities& can) {
  Settings used;
  for (const SettingSpec& spec : can.settings) used[spec.name] = spec.defaultValue;
  Settings given = withStep(settingsSaid(setup, engine), setup, can);
  given.merge(used);
  const double* step = stepIn(given);
  return step && *step > 0.0 ? std::optional(*step) : std::nullopt;
}

std::optional<Deviation> stepDeviation(double engineStep, double sceneStep) {
  constexpr double roundings = 1e-12;
  if (!(std::abs(engineStep - sceneStep) > roundings * sceneStep)) return std::nullopt;
  return Deviation{
      "dt", engineStep, "s",
      fmt::format("takes steps of {:.4g} s, the case's are {:.4g} s", engineStep, sceneStep)};
}

}  // namespace crossgrain::inline runs
