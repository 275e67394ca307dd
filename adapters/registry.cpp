#include "adapters/registry.hpp"

#include <algorithm>

#include "adapters/box2d.hpp"
#include "adapters/grain.hpp"
#include "adapters/yade.hpp"

namespace crossgrain {

namespace {

/// Law2_ScGeom_ViscElPhys_Basic or Law2_ScGeom_MindlinPhys_Mindlin, which share them, and
/// NewtonIntegrator (engines/yade/README.md).
LawConventionSets yadeConventions() {
  return {{"tension", {"cut"}},
          {"coulomb_bound", {"compression"}},
          {"dashpot", {"outside"}},
          {"spring_reset", {"total"}},
          {"spring_update", {"before"}},
          {"lever_arm", {"overlap_middle"}},
          {"velocity_arm", {"lever_arm"}},
          {"plane_arm", {"surface"}},
          {"history", {"force"}},
          {"damping_velocity", {"lagged"}},
          {"integrator", {"position_verlet"}}};
}

}  // namespace

const std::vector<EngineEntry>& engineRegistry() {
  static const std::vector<EngineEntry> entries = {
      {"grain", "in-house: soft disks, every convention an option", makeGrain, {}, {}, ""},
      {"yade",
       "YADE, its viscoelastic and Hertz-Mindlin laws on spheres held in a plane",
       {},
       yadeCommand,
       yadeMissing,
       ""},
      {"box2d-impulse",
       "Box2D's impulse solver, with tangential restitution",
       makeBox2dImpulse,
       {},
       {},
       ""},
      {"box2d-penalty",
       "the scene's soft law on Box2D's collision detection",
       makeBox2dPenalty,
       {},
       {},
       ""},
      {"grain-as-yade",
       "the in-house engine held to YADE's conventions",
       [] { return makeGrainMirror(yadeConventions()); },
       {},
       {},
       "yade",
       {"linear", "hertz"}},
      {"grain-as-box2d-penalty",
       "the in-house engine held to the penalty engine's conventions",
       [] {
         return makeGrainMirror({{"integrator", {"semi_implicit_euler"}},
                                 {"damping_velocity", {"lagged"}},
                                 {"spring_update", {"after", "before"}},
                                 {"lever_arm", {"radius", "contact_point"}},
                                 {"velocity_arm", {"lever_arm"}},
                                 {"plane_arm", {"surface"}}});
       },
       {},
       {},
       "box2d-penalty",
       {"linear"}},
      {"grain-as-box2d-impulse",
       "the in-house engine with impulses, as Box2D's solver has them for two disks",
       [] {
         return makeGrainMirror({{"normal", {"rigid"}},
                                 {"integrator", {"semi_implicit_euler"}},
                                 {"damping_velocity", {"lagged"}},
                                 {"lever_arm", {"overlap_middle"}},
                                 {"velocity_arm", {"lever_arm"}},
                                 {"plane_arm", {"middle"}}});
       },
       {},
       {},
       "box2d-impulse",
       {"rigid"}},
      // In the quick cell Box2D's solver holds about 16 times the pressure of the soft law.
      {"grain-stiff",
       "the in-house engine with contacts 25 times as stiff, towards rigid ones",
       [] { return makeStiffGrain(25.0); },
       {},
       {},
       "box2d-impulse",
       {"linear"}},
  };
  return entries;
}

const EngineEntry* findEngine(const std::string& name) {
  const auto& entries = engineRegistry();
  const auto found = std::ranges::find(entries, name, &EngineEntry::name);
  return found == entries.end() ? nullptr : &*found;
}

}  // namespace crossgrain
