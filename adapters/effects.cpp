#include "adapters/effects.hpp"

#include <algorithm>

namespace crossgrain {

static_assert(effectNames.size() == allEffects.size() && !effectNames.back().empty());

std::string toString(Effect effect) {
  return std::string(effectNames[static_cast<std::size_t>(effect)]);
}

template <int D>
Effects effectsOf(const SceneOf<D>& scene) {
  const ContactLaw& law = scene.law;
  Effects effects;
  const auto call = [&](bool called, Effect effect) {
    if (called) effects.insert(effect);
  };

  if (law.normal == NormalLaw::rigid) {
    call(law.en < 1.0, Effect::normalDamping);
    call(law.mu > 0.0, Effect::friction);
  } else {
    const bool friction = law.tangential != TangentialLaw::none && law.mu > 0.0;
    call(law.gn > 0.0, Effect::normalDamping);
    call(friction, Effect::friction);
    call(friction && law.springs() && law.kt > 0.0, Effect::tangentialSpring);
    call(friction && law.dashpots() && law.gt > 0.0, Effect::tangentialDamping);
  }
  call(law.soft() && law.rolls(), Effect::rollingResistance);
  call(law.soft() && law.coheres(), Effect::cohesion);
  call(scene.materials.has_value(), Effect::pairMaterials);
  const bool turns =
      effects.contains(Effect::friction) || effects.contains(Effect::rollingResistance);
  call((turns || !scene.shapes.empty()) && scene.rotation, Effect::rotation);

  if (scene.bottom && scene.bottom->mu > 0.0) {
    effects.insert(Effect::bottomFriction);
    call(scene.bottom->spin && effects.contains(Effect::rotation), Effect::bottomSpinFriction);
  }
  call(!scene.gravity.isZero(0.0), Effect::gravity);
  call(std::ranges::any_of(scene.bodies,
                           [](const auto& body) { return body.motion.kind != MotionKind::fixed; }),
       Effect::movingWalls);
  return effects;
}
template Effects effectsOf<2>(const Scene&);
template Effects effectsOf<3>(const SpaceScene&);

}  // namespace crossgrain
