#include "runs/cost/averages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "averaging/agreement.hpp"
#include "averaging/profiles.hpp"
#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "runs/common/advance.hpp"
#include "runs/common/records.hpp"
#include "runs/cost/limits.hpp"
#include "runs/couette/run.hpp"
#include "runs/couette/summary.hpp"

namespace crossgrain::inline runs {

using nlohmann::json;

namespace {

constexpr const char* profileMeasures[] = {"azimuthal_velocity", "stress_rr", "volume_fraction"};

int snapshotsOf(const Case& setup) {
  const Averaging& averaging = setup.averaging;
  return std::max(
      1, static_cast<int>(std::lround(averaging.snapshotsPerRotation * averaging.rotations)));
}

}  // namespace

const std::vector<std::string>& averageMeasures() {
  static const std::vector<std::string> names = {"azimuthal_velocity", "stress_rr",
                                                 "volume_fraction",    "shear_band_width",
                                                 "wall_slip",          "stress_level"};
  return names;
}

std::string nameOf(const View& view) {
  std::string name = view.method;
  if (view.every > 1) name += fmt::format("/{}", view.every);
  if (view.share < 1.0) name += fmt::format("@{:g}", view.share);
  return name;
}

View viewOf(const Case& setup, const CostSetting& setting) {
  const Averaging& averaging = setting.setup.averaging;
  return {averaging.methods.front(),
          std::max(1, setup.averaging.snapshotsPerRotation / averaging.snapshotsPerRotation)};
}

std::vector<View> allViews(const Case& setup) {
  const std::string first = setup.averaging.methods.front();
  std::vector<View> views = {{first}};
  for (const std::string& method : setup.cost.methods)
    if (method != first) views.push_back({method});
  const int all = setup.averaging.snapshotsPerRotation;
  for (const double every : setup.cost.snapshots)
    if (every > 1.0) views.push_back({first, all / snapshotsPerRotation(setup, every)});
  for (const double share : {0.25, 0.5}) views.push_back({first, 1, share});
  return views;
}

namespace {

/// One view's sums.
class ViewAverages {
 public:
  ViewAverages(const View& view, const Case& setup, const Scene& scene)
      : view_(view),
        setup_(setup),
        most_(static_cast<int>(std::lround(view.share * snapshotsOf(setup)))),
        profiles_(ringsOf(setup), weightsOf(setup, std::vector<std::string>{view.method}), scene) {}

  /// @param count  of snapshots, this one included
  void add(const Snapshot& snapshot, int count) {
    if (count % view_.every == 0 && (count <= most_ || profiles_.snapshots() == 0))
      profiles_.add(snapshot);
  }

  json numbers() const {
    json numbers = json::object();
    const std::vector<Profile> profiles = profiles_.profiles();
    const double rim = setup_.cell.omega * setup_.cell.innerRadius;
    for (const Profile& profile : profiles) {
      if (std::ranges::find(profileMeasures, profile.field) == std::end(profileMeasures)) continue;
      json& list = numbers[profile.field] = json::array();
      const double unit = profile.field == profileMeasures[0] ? rim : 1.0;
      for (const auto& mean : profile.mean) list.push_back(mean ? json(*mean / unit) : json());
    }
    for (const FitRow& fit : couetteFits(setup_, profiles)) {
      if (!fit.value) continue;
      if (fit.name == "velocity_decay") numbers["shear_band_width"] = json::array({*fit.value});
      if (fit.name == "velocity_amplitude") numbers["wall_slip"] = json::array({1.0 - *fit.value});
    }
    if (numbers.contains("stress_rr")) {
      const auto level = ensembleMean(optionalNumbers(numbers["stress_rr"]));
      if (level) numbers["stress_level"] = {level->mean};
    }
    return numbers;
  }

 private:
  View view_;
  const Case& setup_;
  int most_;
  ProfileAccumulator profiles_;
};

}  // namespace

json averagePacking(Engine& engine, const EngineEntry& entry, const Case& setup,
                    const Packing& packing, const std::vector<View>& views,
                    const std::function<void(double)>& progress) {
  const Scene scene = couetteScene(setup, packing, timeStep(setup));
  const Realised realised = loadScene(engine, entry, setup, scene);
  const ContactReport report =
      engine.capabilities().instantContacts ? ContactReport::instant : ContactReport::accumulated;
  const double settled = setup.averaging.settleRotations * rotationTime(setup);
  const int samples = snapshotsOf(setup);
  const double interval = setup.averaging.rotations * rotationTime(setup) / samples;
  const double end = settled + samples * interval;
  double now = 0.0;
  const auto advanceTo = [&](double time) {
    advanceInPieces(engine, realised, now, time);
    now = time;
    progress(time / end);
  };
  const auto look = [&] {
    Snapshot seen = engine.snapshot(report);
    if (const std::string wild = blowUp(setup, seen); !wild.empty()) throw EngineFailure(wild);
    return seen;
  };

  // What blows up does so soon: it need not settle for long to be seen.
  for (int k = 1; k <= 16; ++k) {
    advanceTo(settled * k / 16);
    look();
  }
  const Stats before = engine.stats();
  std::vector<ViewAverages> averages;
  averages.reserve(views.size());
  for (const View& view : views) averages.emplace_back(view, setup, scene);
  for (int taken = 1; taken <= samples; ++taken) {
    advanceTo(settled + taken * interval);
    const Snapshot seen = look();
    for (ViewAverages& view : averages) view.add(seen, taken);
  }
  const Stats after = engine.stats();

  const double rotations = setup.averaging.rotations;
  const auto perRotation = [&](std::uint64_t count) {
    return static_cast<std::uint64_t>(std::llround(static_cast<double>(count) / rotations));
  };
  json run = {
      {"dt_s", realised.dt},
      {"wall_s", (after.wallSeconds - before.wallSeconds) / rotations},
      {"cpu_s", (after.cpuSeconds - before.cpuSeconds) / rotations},
      {"steps", perRotation(after.steps - before.steps)},
      {"contact_evaluations", perRotation(after.contactEvaluations - before.contactEvaluations)},
      {"views", json::object()}};
  for (std::size_t k = 0; k < views.size(); ++k)
    run["views"][nameOf(views[k])] = averages[k].numbers();
  return run;
}

namespace {

/// One ring of a measure over packings; absent where a run has none.
std::optional<double> numberOf(const json& run, const std::string& view, const std::string& measure,
                               std::size_t ring) {
  if (run.is_null() || !run["views"].contains(view)) return std::nullopt;
  const json& numbers = run["views"][view];
  if (!numbers.contains(measure) || ring >= numbers[measure].size()) return std::nullopt;
  return optionalNumber(numbers[measure][ring]);
}

std::size_t ringsIn(const std::vector<json>& runs, const std::string& view,
                    const std::string& measure) {
  std::size_t rings = 0;
  for (const json& run : runs)
    if (!run.is_null() && run["views"].contains(view) && run["views"][view].contains(measure))
      rings = std::max(rings, run["views"][view][measure].size());
  return rings;
}

}  // namespace

std::optional<WeakError> weakError(const std::vector<json>& runs, const std::string& view,
                                   const std::vector<json>& reference,
                                   const std::string& referenceView, const std::string& measure) {
  double differences = 0.0, variances = 0.0, scale = 0.0;
  std::size_t rings = 0, withError = 0;
  for (std::size_t ring = 0; ring < ringsIn(reference, referenceView, measure); ++ring) {
    std::vector<std::optional<double>> paired, level;
    for (std::size_t k = 0; k < std::min(runs.size(), reference.size()); ++k) {
      const auto one = numberOf(runs[k], view, measure, ring);
      const auto other = numberOf(reference[k], referenceView, measure, ring);
      level.push_back(other);
      paired.push_back(one && other ? std::optional(*one - *other) : std::nullopt);
    }
    if (const auto mean = ensembleMean(level)) scale = std::max(scale, std::abs(mean->mean));
    const auto difference = ensembleMean(paired);
    if (!difference) continue;
    ++rings;
    differences += difference->mean * difference->mean;
    if (!difference->standardError) continue;
    ++withError;
    variances += *difference->standardError * *difference->standardError;
  }
  if (measure == "wall_slip") scale = 1.0;  // it is a share of the rim's speed already
  if (rings == 0 || !(scale > 0.0)) return std::nullopt;
  const auto count = static_cast<double>(rings);
  WeakError found{std::sqrt(differences / count) / scale, {}, {}};
  if (withError < rings) return found;
  found.statistical = std::sqrt(variances / count) / scale;
  found.systematic = std::sqrt(std::max(0.0, differences - variances) / count) / scale;
  return found;
}

}  // namespace crossgrain::inline runs
