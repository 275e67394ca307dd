// A worker of crossgrain that runs scenes on Bullet; README.md of this folder says what Bullet
// makes of a scene.

#include "crossgrain_impulse_engine.hpp"
#include "space.hpp"

using namespace crossgrain_worker;

int main() {
  const int version = btGetVersion();  // 324 of 3.24
  const ImpulseAbout about{
      "bullet",
      std::to_string(version / 100) + "." + std::to_string(version % 100),
      "semi_implicit_euler with sequential impulses",
      0.5,
      {{"lever_arm", {"radius"}},
       {"velocity_arm", {"lever_arm"}},
       {"rolling", {"none", "constant_torque"}},
       {"rolling_load", {"compression"}}},
      {setting("dt", 5e-4, "s", "time step; 0: the case's"),
       within(
           setting("friction_directions", 2.0, "-",
                   "in space, of a contact: along its slip, or across it, too; Bullet's own is 1"),
           1.0, 2.0, true),
       iterations(10.0, "of the solver"),
       within(setting("erp", 0.2, "-", "share of an overlap that a step pushes apart"), 0.0, 1.0,
              false),
       setting("restitution_threshold", 0.0, "m/s",
               "approaches slower than this give nothing back; Bullet's own is 0.2")},
      {"polygon", "capsule", "box", "polyhedron", "cylinder"},
      1000,
      true};
  const auto make = [](const auto& scene) { return spaceFor<bullet::Space>(scene); };
  return serve(ImpulseEngine(about, make, make));
}
