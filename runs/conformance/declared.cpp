#include "runs/conformance/declared.hpp"

#include <algorithm>
#include <array>

#include "adapters/law_options.hpp"

namespace crossgrain::conformance {

std::string planeMotion(Motion::Kind kind) {
  return "planes: " + toString(kind);
}

std::string wallMotion(Motion::Kind kind) {
  return "walls: " + toString(kind);
}

std::string settingNamed(const std::string& name) {
  return "setting " + name + ", other than its default";
}

std::string precisionNamed(Precision precision) {
  return "precision " + toString(precision);
}

std::string undeclared(const std::string& capability) {
  return "declares no " + capability;
}

namespace {

/// Whether the option, at that value, has a bearing on any law that the engine declares.
bool hasBearing(const Capabilities& can, const std::string& option, const std::string& value) {
  const auto valuesOf = [&](const std::string& name) -> std::vector<std::string> {
    if (name == option) return {value};
    const auto listed = can.lawOptions.find(name);
    return listed == can.lawOptions.end() ? std::vector{lawOptionValue(ContactLaw{}, name)}
                                          : listed->second;
  };
  ContactLaw law;
  law.gn = law.gt = law.mu = 1.0;
  // An arm of v_t that is that of f_t could be another one wherever there are arms.
  const std::string asked = option == "velocity_arm" ? "lever_arm" : option;
  for (const std::string& normal : valuesOf("normal"))
    for (const std::string& tangential : valuesOf("tangential"))
      for (const std::string& tension : valuesOf("tension"))
        for (const std::string& arm : valuesOf("lever_arm")) {
          setLawOption(law, "normal", normal);
          setLawOption(law, "tangential", tangential);
          setLawOption(law, "tension", tension);
          setLawOption(law, "lever_arm", arm);
          setLawOption(law, option, value);
          if (mattersTo(law, asked)) return true;
        }
  return false;
}

}  // namespace

std::vector<std::string> declaredBy(const Capabilities& can) {
  using Kind = Motion::Kind;
  const auto has = [](const auto& values, const auto& value) {
    return std::ranges::find(values, value) != values.end();
  };
  std::vector<std::string> all;
  for (const auto& [effect, support] : can.effects)
    if (support != Support::never) all.push_back(toString(effect));
  for (const auto& [option, values] : can.lawOptions)
    for (const std::string& value : values)
      if (hasBearing(can, option, value)) all.push_back(option + " = " + value);
  const auto moving = can.effects.find(Effect::movingWalls);
  const bool moves = moving != can.effects.end() && moving->second != Support::never;
  constexpr std::array kinds = {Kind::fixed, Kind::rotating, Kind::translating, Kind::oscillating,
                                Kind::radial};
  const auto can_ = [&](const std::optional<std::vector<Kind>>& allowed, Kind kind) {
    return (moves || kind == Kind::fixed) && (!allowed || has(*allowed, kind));
  };
  const SceneLimits& limits = can.limits;
  if (!limits.planeMotions || !limits.planeMotions->empty()) {
    all.push_back(planes);
    if (!limits.planesAlongAxes) all.push_back(slantingPlanes);
    for (const Kind kind : kinds) {
      if (kind == Kind::radial) continue;  // planes of radial bodies stay
      if (kind == Kind::rotating && limits.planesAlongAxes) continue;
      if (can_(limits.planeMotions, kind)) all.push_back(planeMotion(kind));
    }
    if (can_(limits.planeMotions, Kind::translating)) all.push_back(planesAlongThemselves);
  }
  for (const Kind kind : kinds)
    if (can_(limits.wallMotions, kind)) all.push_back(wallMotion(kind));
  const std::pair<bool, const std::string&> more[] = {
      {can.checkpoints, checkpoints},
      {can.slidingFlags, slidingFlags},
      {can.instantContacts, instantContacts},
      {can.accumulatedContacts, accumulatedContacts},
      {can.warmHandover, warmHandover},
      {can.energyLedger, energyLedger},
      {true, severalSizes},
      {true, manyDisks},
      {true, farPlaces},
      {true, lateTimes}};
  for (const auto& [declared, name] : more)
    if (declared) all.push_back(name);
  const auto normal = can.lawOptions.find("normal");
  if (can.tangentialRestitution && normal != can.lawOptions.end() && has(normal->second, "rigid"))
    all.push_back(tangentialRestitution);
  for (const Precision precision : can.precisions) all.push_back(precisionNamed(precision));
  for (const SettingSpec& setting : can.settings) all.push_back(settingNamed(setting.name));
  return all;
}

}  // namespace crossgrain::conformance
