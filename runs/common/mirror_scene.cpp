#include "runs/common/mirror_scene.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <mutex>

#include "runs/common/engine_access.hpp"
#include "runs/common/engine_step.hpp"
#include "support/interrupt.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline runs {
namespace {

std::optional<Capabilities> ask(const EngineEntry& entry, double timeout) {
  if (entry.make) return entry.make()->capabilities();
  const ScratchFolder scratch;
  try {
    return startEngine(entry, scratch.path, timeout)->capabilities();
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception&) {
    return std::nullopt;  // a mirror says so where it matters
  }
}

}  // namespace

std::optional<Capabilities> capabilitiesOf(const EngineEntry& entry, double timeout) {
  static std::mutex mutex;
  static std::map<std::string, std::optional<Capabilities>> known;
  const std::lock_guard lock(mutex);
  const auto [found, isNew] = known.try_emplace(entry.name);
  if (isNew) found->second = ask(entry, timeout);
  return found->second;
}

Adapted sceneOfPeer(const EngineEntry& mirror, const Case& setup, const Scene& scene) {
  const EngineEntry* peer = findEngine(mirror.mirrors);
  const auto can = peer ? capabilitiesOf(*peer, setup.run.timeout) : std::nullopt;
  if (!can)
    return {
        scene,
        {{"peer", 0.0, "",
          fmt::format("{} cannot be asked here: what it lacks is not left out", mirror.mirrors)}}};
  const bool sameLaw = hasNormalLaw(*can, scene.law);
  Adapted adapted;
  try {
    adapted = adaptScene(*can, scene, setup.run.mayDiffer);
  } catch (const UnsupportedScene& refusal) {
    throw UnsupportedScene(fmt::format("its peer {} {}", peer->name, refusal.what()));
  }
  adapted.scene.precision = scene.precision;
  if (!sameLaw) adapted.scene.law.conventions = scene.law.conventions;
  std::erase_if(adapted.deviations, [&](const Deviation& deviation) {
    return deviation.name == "precision" || (!sameLaw && deviation.name == "normal");
  });
  for (Deviation& deviation : adapted.deviations)
    deviation.note = fmt::format("as its peer {}: {}", peer->name, deviation.note);
  if (sameLaw) {
    if (const auto step = stepOfItsOwn(setup, peer->name, *can)) adapted.scene.dt = *step;
  }
  return adapted;
}

}  // namespace crossgrain::inline runs
