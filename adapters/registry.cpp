#include "adapters/registry.hpp"

#include <algorithm>
#include <utility>

namespace crossgrain {

// Each in the file of its engine; a further engine is such a function and its two lines here.
EngineEntry grainEngine();
EngineEntry yadeEngine();
EngineEntry yadeMirror();
EngineEntry lammpsEngine();
EngineEntry lammpsMirror();
EngineEntry box2dImpulseEngine();
EngineEntry box2dImpulseMirror();
EngineEntry stiffGrainEngine();
EngineEntry box2dPenaltyEngine();
EngineEntry box2dPenaltyMirror();

namespace {

std::deque<EngineEntry> builtIn() {
  return {grainEngine(),        yadeEngine(),      box2dImpulseEngine(), box2dPenaltyEngine(),
          lammpsEngine(),       yadeMirror(),      lammpsMirror(),       box2dPenaltyMirror(),
          box2dImpulseMirror(), stiffGrainEngine()};
}

/// A deque: what was found in it stays where it is while engines are added.
std::deque<EngineEntry>& entries() {
  static std::deque<EngineEntry> all = builtIn();
  return all;
}

}  // namespace

const std::deque<EngineEntry>& engineRegistry() {
  return entries();
}

std::size_t builtInEngines() {
  static const std::size_t count = builtIn().size();
  return count;
}

void addEngine(EngineEntry entry) {
  entries().push_back(std::move(entry));
}

const EngineEntry* findEngine(const std::string& name) {
  const auto& known = engineRegistry();
  const auto found = std::ranges::find(known, name, &EngineEntry::name);
  return found == known.end() ? nullptr : &*found;
}

}  // namespace crossgrain
