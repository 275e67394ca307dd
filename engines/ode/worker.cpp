// A worker of crossgrain that runs scenes on ODE; README.md of this folder says what ODE makes of
// a scene.

#include <cstdio>

#include "crossgrain_impulse_engine.hpp"
#include "space.hpp"

using namespace crossgrain_worker;

int main() {
  dInitODE2(0);
  if (!dCheckConfiguration("ODE_double_precision")) {  // as on Debian's armel
    std::fputs("libode has single precision, its headers double\n", stderr);
    return 1;
  }
  const ImpulseAbout about{
      "ode",
      dODE_VERSION,
      "semi_implicit_euler with sequential impulses",
      0.5,
      {{"lever_arm", {"overlap_middle"}},
       {"velocity_arm", {"lever_arm"}},
       {"plane_arm", {"radius"}},
       {"rolling", {"none", "constant_torque"}},
       {"rolling_load", {"compression"}}},
      {setting("dt", 5e-4, "s", "time step; 0: the case's"),
       iterations(20.0,
                  "of QuickStep; 0: dWorldStep, which solves directly, in a time that grows with "
                  "the cube of the contacts",
                  0.0),
       // It converges between 0 and 2 (Kahan 1958); at 0 no contact would act.
       within(setting("relaxation", 1.3, "-", "of QuickStep's successive over-relaxation"), 0.01,
              1.99, false),
       within(setting("erp", 0.2, "-", "share of an overlap that a step pushes apart"), 0.0, 1.0,
              false),
       within(setting("friction_along_slip", 1.0, "-",
                      "in space, of the first of two directions that are bounded each by itself; "
                      "0: ODE's choice, by the normal alone"),
              0.0, 1.0, true),
       setting("correcting_speed", 0.0, "m/s",
               "the fastest that overlaps are pushed apart, a speed that stays; 0: no limit"),
       setting("restitution_threshold", 0.0, "m/s",
               "approaches slower than this give nothing back")},
      {"polygon", "capsule", "box", "polyhedron", "cylinder"}};
  const auto make = [](const auto& scene) { return spaceFor<ode::Space>(scene); };
  return serve(ImpulseEngine(about, make, make));
}
