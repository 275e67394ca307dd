#include "runs/check_lines.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "adapters/start_check.hpp"
#include "runs/engine_access.hpp"

namespace crossgrain {

std::vector<std::string> checkLines(Engine& engine, const EngineEntry& entry, const Case& setup,
                                    const Scene& scene) {
  const Capabilities can = engine.capabilities();
  settingsFor(setup, entry.name, can);
  const Adapted adapted = sceneFor(can, entry, setup, scene);
  std::vector<Deviation> deviations = adapted.deviations;
  Effects effects = simulatedEffects(can, adapted.scene);
  std::vector<std::string> lines = {"can run it"};
  if (scene.disks.size() > 0 && whyNoStart(scene).empty()) {
    const Realised realised = loadAdapted(engine, entry, setup, scene);
    deviations = realised.deviations;
    effects = realised.effects;
    lines.front() += fmt::format(", dt {:.3g} s", realised.dt);
  }
  for (const Deviation& deviation : deviations)
    lines.push_back(fmt::format("differs: {}", deviation.note));
  std::vector<std::string> absent;
  for (const Effect effect : effectsOf(scene))
    if (!effects.contains(effect)) absent.push_back(toString(effect));
  if (!absent.empty())
    lines.push_back(fmt::format("does not simulate: {}", fmt::join(absent, ", ")));
  return lines;
}

}  // namespace crossgrain
