#include "averaging/weights.hpp"
#include "cases/loader_sections.hpp"

namespace crossgrain::inline cases {
namespace {

void readSettings(Reader in, Cost& cost) {
  for (const std::string& engine : in.keys()) {
    Reader settings = in.section(engine);
    for (const std::string& name : settings.keys())
      settings.read(name, cost.settings[engine][name], Range{});
    settings.finish();
  }
  in.finish();
}

}  // namespace

void readCost(Reader& in, Cost& cost) {
  static const std::vector<std::string> kinds = cost.kinds, knobs = cost.knobs;
  static const std::vector<std::string> laws = {"none", "coulomb", "viscous", "spring",
                                                "spring_dashpot"};
  static const std::vector<std::string> methods(weightNames.begin(), weightNames.end());
  const Range steps = above(0.5);
  in.read("kinds", cost.kinds, kinds);
  in.read("knobs", cost.knobs, knobs);
  in.read("timed", cost.timed, positive("s"));
  in.read("repeats", cost.repeats, between(1, 1000));
  in.read("collision_steps", cost.collisionSteps, steps);
  in.read("speed", cost.speed, positive("m/s"));
  in.read("psi_max", cost.psiMax, positive());
  in.read("psi_count", cost.psiCount, between(2, 10'000));
  in.read("trajectory_steps", cost.trajectorySteps, steps);
  in.read("trajectory_reference", cost.trajectoryReference, steps);
  in.read("perturbation", cost.perturbation, positive("d"));
  in.read("separation", cost.separation, positive("d"));
  in.read("window_most", cost.windowMost, positive("t_c"));
  in.read("growth_time", cost.growthTime, positive("s"));
  in.read("average_steps", cost.averageSteps, steps);
  in.read("average_reference", cost.averageReference, steps);
  in.read("tangential", cost.tangential, laws);
  in.read("methods", cost.methods, methods);
  in.read("snapshots", cost.snapshots, atLeast(1.0));
  in.read("omega", cost.omega, positive());
  in.read("stiffness", cost.stiffness, positive());
  readSettings(in.section("settings"), cost);
  in.finish();
}

}  // namespace crossgrain::inline cases
