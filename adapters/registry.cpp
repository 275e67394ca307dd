#include "adapters/registry.hpp"

#include <algorithm>

namespace crossgrain {

// Each in the file of its engine; a further engine is such a function and its two lines here.
EngineEntry grainEngine();
EngineEntry yadeEngine();
EngineEntry yadeMirror();
EngineEntry box2dImpulseEngine();
EngineEntry box2dImpulseMirror();
EngineEntry stiffGrainEngine();
EngineEntry box2dPenaltyEngine();
EngineEntry box2dPenaltyMirror();

const std::vector<EngineEntry>& engineRegistry() {
  static const std::vector<EngineEntry> entries = {
      grainEngine(), yadeEngine(),         box2dImpulseEngine(), box2dPenaltyEngine(),
      yadeMirror(),  box2dPenaltyMirror(), box2dImpulseMirror(), stiffGrainEngine()};
  return entries;
}

const EngineEntry* findEngine(const std::string& name) {
  const auto& entries = engineRegistry();
  const auto found = std::ranges::find(entries, name, &EngineEntry::name);
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace crossgrain
