// A worker of crossgrain that runs scenes on Chipmunk; README.md of this folder says what Chipmunk
// makes of a scene.

#include <cmath>

#include "crossgrain_impulse_engine.hpp"
#include "space.hpp"

using namespace crossgrain_worker;

int main() {
  const ImpulseAbout about{
      "chipmunk",
      cpVersionString,
      "explicit positions, then sequential impulses",
      -0.5,
      {{"lever_arm", {"radius"}}, {"velocity_arm", {"lever_arm"}}},
      {setting("dt", 5e-4, "s", "time step; 0: the case's"), iterations(10.0, "of the solver"),
       setting("slop", 0.0, "m",
               "overlaps up to this are left standing; 0: a thousandth of the smallest radius"),
       within(setting("bias", std::pow(0.9, 60.0), "-",
                      "what is left after a second of an overlap beyond the slop"),
              0.0, 1.0, false)},
      {"polygon", "capsule"},
      1000,
      true};
  return serve(ImpulseEngine(
      about, [](const ImpulseScene& scene) { return std::make_unique<chipmunk::Space>(scene); }));
}
