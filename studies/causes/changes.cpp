#include "studies/causes/changes.hpp"

#include <fmt/format.h>

#include "adapters/suitability.hpp"
#include "cases/materials.hpp"
#include "law/law_options.hpp"

namespace crossgrain::inline studies {
namespace {

template <int D>
void addConstants(std::vector<MirrorChangeOf<D>>& changes, const SceneOf<D>& scene) {
  const auto add = [&](std::string name, std::function<void(SceneOf<D>&, double)> apply) {
    changes.push_back({std::move(name), true, std::move(apply)});
  };
  for (const LawConstant& constant : lawConstants())
    if (scene.law.*constant.value != 0.0 && hasPart(scene.law, constant.part))
      add(std::string(constant.name), [value = constant.value](SceneOf<D>& changed, double by) {
        changeLaws(changed, [&](ContactLaw& law) { law.*value *= 1.0 + by; });
      });
  if (scene.bottom)
    for (const auto& [name, value] : plateConstants)
      if ((*scene.bottom).*value != 0.0)
        add(name, [value = value](SceneOf<D>& changed, double by) {
          (*changed.bottom).*value *= 1.0 + by;
        });
  add("mass", [](SceneOf<D>& changed, double by) {
    for (double& mass : changed.disks.mass) mass *= 1.0 + by;
  });
  if (scene.rotation)
    add("inertia", [](SceneOf<D>& changed, double by) {
      for (double& inertia : changed.disks.inertia) inertia *= 1.0 + by;
    });
  add("velocity of walls", [](SceneOf<D>& changed, double by) {
    for (WallBodyOf<D>& body : changed.bodies) {
      body.motion.angularVelocity *= 1.0 + by;
      body.motion.velocity *= 1.0 + by;
      body.motion.frequency *= 1.0 + by;
    }
  });
}

template <int D>
void addConventions(std::vector<MirrorChangeOf<D>>& changes, const SceneOf<D>& scene,
                    const Capabilities& can) {
  for (const LawOption& option : lawOptions()) {
    const std::string name(option.name);
    if (!bearsOnMirror(scene.law, name)) continue;
    const auto values = can.lawOptions.find(name);
    if (values == can.lawOptions.end()) continue;
    for (const std::string& value : values->second)
      if (value != lawOptionValue(scene.law, name) && constantsServe(scene.law, name, value))
        changes.push_back({fmt::format("{} = {}", name, value), false,
                           [name, value](SceneOf<D>& changed, double) {
                             changeLaws(changed,
                                        [&](ContactLaw& law) { setLawOption(law, name, value); });
                           }});
  }
}

template <int D>
void addMissingEffects(std::vector<MirrorChangeOf<D>>& changes, const SceneOf<D>& scene,
                       Capabilities can) {
  for (const Effect effect : effectsOf(scene)) {
    const std::string name = toString(effect);
    can.effects[effect] = Support::never;
    changes.push_back({"without " + name, false, [can, name](SceneOf<D>& changed, double) {
                         changed = adaptScene(can, changed, {name}).scene;
                       }});
    can.effects[effect] = Support::optional;
  }
}

}  // namespace

bool bearsOnMirror(const ContactLaw& law, std::string_view option) {
  if (option == "velocity_arm") return mattersTo(law, "lever_arm");
  if (option == "damping_velocity" && law.soft() && (law.friction() || law.rolls())) return true;
  return mattersTo(law, option);
}

bool constantsServe(const ContactLaw& law, std::string_view option, std::string_view value) {
  if (option == "normal" || option == "damper" || option == "rolling_damper") return false;
  const bool perRadian = law.conventions.rollingStiffness == RollingStiffness::constant;
  if (option == "rolling_stiffness") return (value == "constant") == perRadian;
  if (option == "rolling") {
    if (value == "none") return false;
    if (value == "spring" && !(law.kr > 0.0)) return false;
    if (value == "viscous")
      return law.gr > 0.0 && law.conventions.rollingDamper == RollingDamper::constant;
    return law.muR > 0.0 &&
           (value == "viscous_by_load") == (law.rolling == RollingLaw::viscousByLoad);
  }
  if (option == "cohesion")
    return law.w > 0.0 && (value == "dmt" || (value == "jkr" && law.normal == NormalLaw::hertz));
  return true;
}

template <int D>
std::vector<MirrorChangeOf<D>> changesOf(const SceneOf<D>& scene, const Capabilities& can) {
  std::vector<MirrorChangeOf<D>> changes;
  addConstants(changes, scene);
  addConventions(changes, scene, can);
  addMissingEffects(changes, scene, can);
  return changes;
}

template std::vector<MirrorChangeOf<2>> changesOf(const SceneOf<2>&, const Capabilities&);
template std::vector<MirrorChangeOf<3>> changesOf(const SceneOf<3>&, const Capabilities&);

}  // namespace crossgrain::inline studies
