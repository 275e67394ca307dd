#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "adapters/engine.hpp"
#include "adapters/worker/arrays.hpp"
#include "law/law_options.hpp"
#include "support/json_fields.hpp"

/// JSON of each shared type in the worker protocol: README.md of this folder is the reference.
/// Names and values are those of the case files; numbers are printed so that they read back to the
/// same bits. Reading throws std::exception with one line on whatever is missing or malformed.
namespace crossgrain {

/// Lists go to the array writer; the JSON holds the rest.
template <int D>
nlohmann::json toJson(const SceneOf<D>& scene, ArrayWriter& arrays);
template <int D = 2>
SceneOf<D> sceneFromJson(const nlohmann::json& json, const ArrayReader& arrays);

/// Of a scene: 2, or 3 where it says so. @throws FieldError for another
int dimensionOf(const nlohmann::json& scene);

template <int D>
nlohmann::json toJson(const SnapshotOf<D>& snapshot, ArrayWriter& arrays);

/// Also checks the lists' lengths and the contacts' ids against the scene that was loaded.
template <int D>
SnapshotOf<D> snapshotFromJson(const nlohmann::json& json, const ArrayReader& arrays,
                               const SceneOf<D>& scene);

nlohmann::json toJson(const Stats& stats);
Stats statsFromJson(const nlohmann::json& json);

// All else is written by jsonOf() and read by readAs().

/// @name Enumerators by name, in enum order
/// @{
constexpr auto namesOf(Precision) {
  return precisionNames;
}
constexpr auto namesOf(Motion::Kind) {
  return motionNames;
}
constexpr auto namesOf(ShapeKind) {
  return shapeKindNames;
}
constexpr auto namesOf(Effect) {
  return effectNames;
}
constexpr auto namesOf(Support) {
  return std::array<std::string_view, 3>{"optional", "always", "never"};
}
constexpr auto namesOf(ContactReport) {
  return std::array<std::string_view, 3>{"none", "instant", "accumulated"};
}
enum class PlaneNormals { any, axis };
constexpr auto namesOf(PlaneNormals) {
  return std::array<std::string_view, 2>{"any", "axis"};
}
constexpr auto namesOf(SettingRole) {
  return std::array<std::string_view, 2>{"none", "iterations"};
}
enum class RestitutionOf { pair, body };
constexpr auto namesOf(RestitutionOf) {
  return std::array<std::string_view, 2>{"pair", "body"};
}
/// @}

/// @name Members of what results hold, too (support/json_fields.hpp)
/// @{
/// @throws FieldError naming an option or a value that no law has
void checkLawOptions(const Capabilities& can);

void fields(auto& io, SettingSpec& spec) {
  std::optional<double> most;
  if (std::isfinite(spec.most)) most = spec.most;
  io.required("name", spec.name);
  io.required("default", spec.defaultValue);
  REQUIRED_FIELDS(io, spec.unit, spec.doc, spec.choices);
  io("least", spec.least);
  io.present("most", most);
  io("whole", spec.whole);
  io.when(spec.role != SettingRole::none, "role", spec.role);
  if (!io.reading) return;
  spec.most = most.value_or(std::numeric_limits<double>::infinity());
  if (spec.role == SettingRole::iterations &&
      !(spec.whole && std::get_if<double>(&spec.defaultValue)))
    throw FieldError("settings: " + spec.name + ": iterations are a whole number");
}

void fields(auto& io, SceneLimits& limits) {
  std::optional<PlaneNormals> normals;
  if (limits.planesAlongAxes) normals = PlaneNormals::axis;
  std::optional<RestitutionOf> restitution;
  if (limits.restitutionPerBody) restitution = RestitutionOf::body;
  PRESENT_FIELDS(io, limits.inertia, limits.wallMotions, limits.planeMotions);
  io.present("plane_normals", normals);
  io.when(limits.cylinders, "cylinders", limits.cylinders);
  io.when(!limits.shapes.empty(), "shapes", limits.shapes);
  io.when(!limits.shapes.empty(), "most_vertices", limits.mostVertices);
  io.when(limits.rounded, "rounded", limits.rounded);
  io.present("restitution", restitution);
  if (io.reading) {
    limits.planesAlongAxes = normals == PlaneNormals::axis;
    limits.restitutionPerBody = restitution == RestitutionOf::body;
    if (const auto& inertia = limits.inertia)
      if (inertia->empty() || !std::ranges::all_of(*inertia, [](double q) { return q >= 0.0; }))
        throw FieldError("inertia: is no list of numbers ≥ 0");
  }
}

void fields(auto& io, Capabilities& can) {
  std::map<std::string, Support> effects;
  for (const auto& [effect, support] : can.effects) effects[toString(effect)] = support;
  REQUIRED_FIELDS(io, can.version, effects, can.lawOptions);
  io.when(can.dimensions != std::vector<int>{2}, "dimensions", can.dimensions);
  io.when(can.periodic, "periodic", can.periodic);
  REQUIRED_FIELDS(io, can.precisions, can.instantContacts, can.accumulatedContacts,
                  can.warmHandover);
  io("checkpoints", can.checkpoints);
  io.required("sliding_flags", can.slidingFlags);
  FIELDS(io, can.energyLedger, can.tangentialRestitution);
  io.required("settings", can.settings);
  fields(io, can.limits);
  if (io.reading) {
    for (const Effect effect : allEffects) can.effects[effect] = Support::never;  // if missing
    for (const auto& [name, support] : effects) can.effects[readAs<Effect>(name)] = support;
    checkLawOptions(can);
  }
}

void fields(auto& io, Deviation& deviation) {
  REQUIRED_FIELDS(io, deviation.name, deviation.value, deviation.unit, deviation.note);
}

/// A spring, dashpot or friction of strength 0 is none, which is null; a restitution of 0 is one.
/// Contacts have springs, or they rebound with restitutions.
void fields(auto& io, PairCoefficients& pair) {
  const auto constant = [&](const char* key, double& value, bool there) {
    std::optional<double> shown;
    if (there) shown = value;
    io(key, shown);
    if (io.reading) value = shown.value_or(0.0);
  };
  const bool springs = pair.kn > 0.0;
  io.required("pair", pair.pair);
  constant("kn", pair.kn, pair.kn != 0.0);
  constant("gn", pair.gn, pair.gn != 0.0);
  constant("kt", pair.kt, pair.kt != 0.0);
  constant("gt", pair.gt, pair.gt != 0.0);
  constant("mu", pair.mu, pair.mu != 0.0);
  constant("en", pair.en, !springs);
  constant("et0", pair.et0, !springs && pair.mu != 0.0);
  for (const auto& [key, value] : {std::pair{"kr", &pair.kr},
                                   {"gr", &pair.gr},
                                   {"mu_r", &pair.muR},
                                   {"kc", &pair.kc},
                                   {"w", &pair.w}})
    io.when(*value != 0.0, key, *value);
}

void fields(auto& io, EffectiveParameters& effective) {
  std::optional<double> lag = effective.velocityLag;
  REQUIRED_FIELDS(io, effective.engine, effective.version, effective.dt, effective.precision,
                  effective.integrator);
  io("velocity_lag", lag);
  REQUIRED_FIELDS(io, effective.effects, effective.pairs, effective.deviations);
  if (io.reading) effective.velocityLag = lag.value_or(0.0);
}
/// @}

}  // namespace crossgrain
