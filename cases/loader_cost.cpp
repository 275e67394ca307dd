#include <algorithm>

#include "cases/cost_knobs.hpp"
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

void readKnobs(Reader& in, Cost& cost) {
  for (const CostKnob& knob : costKnobs()) {
    const std::string name(knob.name);
    if (!knob.texts.empty()) in.read(knob.key, cost.texts[name], knob.choices);
    if (!knob.numbers.empty())
      in.read(knob.key, cost.numbers[name], knob.least > 0.0 ? atLeast(knob.least) : positive());
  }
}

}  // namespace

void readCost(Reader& in, Cost& cost) {
  static const std::vector<std::string> knobs = cost.knobs;
  const Range steps = above(0.5);
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
  in.read("perturbation", cost.perturbation, positive("d"));
  in.read("separation", cost.separation, positive("d"));
  in.read("window_most", cost.windowMost, positive("t_c"));
  in.read("growth_time", cost.growthTime, positive("s"));
  in.read("average_steps", cost.averageSteps, steps);
  in.read("average_reference", cost.averageReference, steps);
  in.read("bound_steps", cost.boundSteps, steps);
  in.read("bound_reference", cost.boundReference, steps);
  readKnobs(in, cost);
  readSettings(in.section("settings"), cost);
  in.finish();
}

}  // namespace crossgrain::inline cases
