#include "runs/common/case_suitability.hpp"

#include "adapters/start_check.hpp"
#include "runs/common/engine_access.hpp"

namespace crossgrain::inline runs {

Suitability suitabilityOf(Engine& engine, const EngineEntry& entry, const Case& setup,
                          const Scene& scene) {
  const Capabilities can = engine.capabilities();
  settingsFor(setup, entry.name, can);
  const Adapted adapted = sceneFor(can, entry, setup, scene);
  std::vector<Deviation> deviations = adapted.deviations;
  Effects effects = simulatedEffects(can, adapted.scene);
  Suitability found;
  if (scene.disks.size() > 0 && whyNoStart(scene).empty()) {
    const Realised realised = loadAdapted(engine, entry, setup, scene);
    deviations = realised.deviations;
    effects = realised.effects;
    found.dt = realised.dt;
  }
  for (const Deviation& deviation : deviations) found.deviations.push_back(deviation.note);
  for (const Effect effect : effectsOf(scene))
    if (!effects.contains(effect)) found.notSimulated.emplace_back(toString(effect));
  return found;
}

}  // namespace crossgrain::inline runs
