#include "runs/couette/averages.hpp"

#include "runs/common/records.hpp"
#include "runs/couette/run.hpp"
#include "runs/couette/state.hpp"
#include "runs/couette/summary.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

CouetteAverages::CouetteAverages(const Case& setup, const Scene& scene)
    : setup_(setup),
      scene_(scene),
      profiles_(ringsOf(setup), weightsOf(setup, setup.averaging.methods), scene),
      series_(setup, scene),
      distributions_(ringsOf(setup), scene, distributionScales(setup)),
      spin_(ringsOf(setup), scene) {}

void CouetteAverages::add(const Snapshot& snapshot) {
  profiles_.add(snapshot);
  series_.add(snapshot);
  distributions_.add(snapshot);
  spin_.add(snapshot);
  // As the pressure on the ring: only of snapshots that hold the walls.
  if (snapshot.wallPosition.empty()) return;
  if (const auto wall = outerWallBalance(ringsOf(setup_), scene_, snapshot)) wall_.push_back(*wall);
}

void CouetteAverages::describe(const Realised& realised, json& run) const {
  const std::vector<Profile> profiles = profiles_.profiles();
  const json& series = series_.rows();
  run["profiles"] = json::array();
  for (const Profile& profile : profiles) run["profiles"].push_back(toJson(profile));
  run["series"] = series;
  run["head"] = headNumbers(setup_, profiles, series, realised);
  run["regime"] = couetteRegime(setup_, profiles, series);
  run["steadiness"] = couetteSteadiness(setup_, series);
  run["fits"] = couetteFits(setup_, profiles);
  for (const json& fit : spinFits(setup_, spin_)) run["fits"].push_back(fit);
  run["checks"] = couetteChecks(setup_, profiles, series, wall_);
  run["distributions"] = toJson(distributions_.distributions());
}

}  // namespace crossgrain::inline runs
