#include <algorithm>

#include "cases/cost.hpp"
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

void readKinds(Reader& in, std::vector<CostKind>& wanted) {
  std::vector<std::string> all, names;
  for (const CostKind kind : costKinds) all.push_back(toString(kind));
  for (const CostKind kind : wanted) names.push_back(toString(kind));
  in.read("kinds", names, all);
  wanted.clear();
  for (const std::string& name : names)
    wanted.push_back(
        costKinds[static_cast<std::size_t>(std::ranges::find(all, name) - all.begin())]);
}

/// Keys of earlier versions, which would otherwise be taken for misspelt ones.
void refuseRemoved(const Reader& in) {
  for (const char* const key : {"omega", "stiffness", "methods", "snapshots", "bound_steps",
                                "bound_reference", "perturbation", "separation", "growth_time"})
    if (in.has(key))
      in.fail(key,
              "is a key no more: cost no longer varies the wheel's speed, stiffness or averaging, "
              "bounds averages or measures chaos");
}

}  // namespace

void readCost(Reader& in, Cost& cost) {
  static const std::vector<std::string> knobs(costKnobs.begin(), costKnobs.end());
  static const std::vector<std::string> laws = {"none", "coulomb", "viscous", "spring",
                                                "spring_dashpot"};
  const Range steps = above(0.5);
  refuseRemoved(in);
  readKinds(in, cost.kinds);
  in.read("knobs", cost.knobs, knobs);
  in.read("timed", cost.timed, positive("s"));
  in.read("repeats", cost.repeats, between(1, 1000));
  in.read("collision_steps", cost.collisionSteps, steps);
  in.read("speed", cost.speed, positive("m/s"));
  in.read("psi_max", cost.psiMax, positive());
  in.read("psi_count", cost.psiCount, between(2, 10'000));
  in.read("collision_reference", cost.collisionReference, steps);
  in.read("trajectory_steps", cost.trajectorySteps, steps);
  in.read("trajectory_reference", cost.trajectoryReference, steps);
  in.read("window_most", cost.windowMost, positive("t_c"));
  in.read("average_steps", cost.averageSteps, steps);
  in.read("average_reference", cost.averageReference, steps);
  in.read("tangential", cost.tangential, laws);
  readSettings(in.section("settings"), cost);
  in.finish();
}

}  // namespace crossgrain::inline cases
