#include "runs/thesis/leg_run.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "cases/couette.hpp"
#include "runs/couette/frame.hpp"
#include "runs/thesis/history.hpp"

namespace crossgrain::inline runs {

namespace {

struct FinerRings {
  Rings rings;
  ProfileAccumulator profiles;
};

}  // namespace

ThesisRun runLeg(const CouetteTask& task, const LegLooks& looks,
                 const std::function<void(double)>& progress) {
  const Case& setup = *task.setup;
  const Scene scene = couetteScene(setup, *task.packing, task.dt);
  const double settle = setup.averaging.settleRotations;
  CouetteWatch watch;
  if (settle > 0.0)
    watch.settlingSnapshots =
        std::max(1, static_cast<int>(std::lround(settle * looks.settlingSnapshots)));
  ThesisHistory history(setup, scene, watch.settlingSnapshots);
  std::deque<FinerRings> finer;
  for (const int count : looks.finerRings) {
    const Rings rings = ringsOf(setup, count);
    finer.push_back(
        {rings, ProfileAccumulator(rings, weightsOf(setup, setup.averaging.methods), scene)});
  }
  watch.settling = [&](const Snapshot& snapshot) { history.add(snapshot); };
  watch.averaged = [&](const Snapshot& snapshot) {
    history.add(snapshot);
    for (FinerRings& own : finer) own.profiles.add(snapshot);
  };
  watch.state = [&] { return history.state(); };
  watch.restore = [&](const nlohmann::json& state) { history.restore(state); };

  ThesisRun result;
  result.run = runCouette(task, progress, watch);
  result.run.picture.reset();
  result.engine = task.entry.name;
  result.packing = task.packingIndex;
  result.seed = setup.preparation.seed;
  result.history = history.spans();
  for (const FinerRings& own : finer) {
    result.finer.push_back({own.rings.count(), placesOf(own.rings), own.profiles.profiles()});
    for (Profile& profile : result.finer.back().profiles) {  // half of a run's file
      profile.nEff.clear();
      profile.dof.clear();
    }
  }
  return result;
}

}  // namespace crossgrain::inline runs
