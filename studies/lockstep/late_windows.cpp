#include "studies/lockstep/late_windows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "adapters/grain.hpp"
#include "averaging/agreement.hpp"
#include "averaging/statistics.hpp"
#include "cases/flow.hpp"
#include "law/law_options.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/lockstep/account.hpp"
#include "studies/lockstep/lockstep.hpp"
#include "studies/lockstep/responses.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"
#include "studies/lockstep/starts.hpp"
#include "studies/lockstep/terms.hpp"
#include "studies/lockstep/window.hpp"

namespace crossgrain::inline studies {
namespace {

/// Positions, velocities and, if asked for, contacts of one instant, whatever an engine staggers.
/// It may be a step further afterwards. @throws EngineFailure
template <int D>
SnapshotOf<D> stateOf(Engine& engine, double dt, bool springs) {
  const ContactReport report = springs ? ContactReport::instant : ContactReport::none;
  SnapshotOf<D> now = snapshotOf<D>(engine, report);
  const double t = now.positionTime;
  const auto isNow = [&](double time) { return std::abs(time - t) < 0.01 * dt; };
  if (isNow(now.velocityTime) && (!springs || isNow(now.contactTime))) return now;
  engine.advance(t + dt);
  SnapshotOf<D> next = snapshotOf<D>(engine, report);
  if (!isNow(now.velocityTime)) {
    const double part = (t - now.velocityTime) / (next.velocityTime - now.velocityTime);
    for (std::size_t i = 0; i < now.velocity.size(); ++i)
      now.velocity[i] += part * (next.velocity[i] - now.velocity[i]);
    for (std::size_t i = 0; now.spin && next.spin && i < now.spin->size(); ++i)
      (*now.spin)[i] += part * ((*next.spin)[i] - (*now.spin)[i]);
  }
  if (springs && !isNow(now.contactTime)) {
    if (!isNow(next.contactTime))
      throw EngineFailure("its contact forces belong to none of its positions");
    now.contacts = std::move(next.contacts);
  }
  return now;
}

template <int D>
class LateComparison {
 public:
  LateComparison(Engine& engine, const EngineEntry& entry, const Case& setup,
                 const Packing& packing, double dt)
      : engine_(engine),
        entry_(entry),
        setup_(setup),
        packing_(packing),
        scene_(flowScene<D>(setup, packing, dt)),
        can_(engine.capabilities()),
        effective_(loadScene(engine, entry, setup, scene_)),
        mirror_(mirrorOf(can_, entry, setup, scene_, effective_)) {
    const ContactLaw law = sceneOfMirror(can_, entry, setup, scene_, effective_).law;
    const bool slips = law.mu > 0.0 && law.tangential != TangentialLaw::none;
    springs_ = law.soft() && ((slips && law.springs()) || law.rolling == RollingLaw::spring ||
                              law.cohesion == CohesionLaw::jkr);
    if (law.cohesion == CohesionLaw::elastoPlastic)
      throw UnsupportedScene(
          "no mirror begins in the middle of a run where contacts remember their largest overlap, "
          "which no engine reports");
    std::vector<std::size_t> all;
    for (const double time : lockstepTimes) {
      all.push_back(steps_.size());
      steps_.push_back(stepsUntil(time, effective_.dt));
    }
    for (const ChangedCase& changed : changedCases(setup)) {
      if (changed.constant == "mu" && !slips) continue;  // the engine has none of it
      constants_.push_back(changed.constant);
      accounts_.emplace_back(flowDiameter(setup), timesOf(steps_, effective_.dt), all);
    }
  }

  double length() const { return static_cast<double>(steps_.back()) * effective_.dt; }
  double reached() const { return reached_; }

  /// @param measured  whether reference perturbations are applied even where both are the same to
  /// rounding
  /// @return when it began [s] @throws EngineFailure, UnsupportedScene
  double window(double t, bool measured) {
    if (springs_ && !can_.instantContacts)
      throw EngineFailure("it has no contact forces of an instant, from which springs could go on");
    engine_.advance(t);
    const SnapshotOf<D> now = stateOf<D>(engine_, effective_.dt, springs_);
    SceneOf<D> mirrored = sceneOfMirror(
        can_, entry_, setup_, flowScene<D>(setup_, packingAt(packing_, scene_, now), scene_.dt),
        effective_);
    mirrored.energyLedger = false;
    const auto begin = [&](const SceneOf<D>& scene) {
      loadOn(*mirror_, scene, {});
      // As the case begins, no spring is stretched and no step is under way.
      if (scene.law.soft() && now.positionTime > 0.0)
        beginUnderWay(*mirror_, springs_ ? *now.contacts : ContactsOf<D>());
      return effective_.dt;
    };
    begin(mirrored);
    const LockstepWindowOf<D> window =
        followBoth<D>(engine_, *mirror_, effective_.dt, steps_, can_.instantContacts,
                      now.positionTime, scene_.box);
    reached_ = now.positionTime + length();
    bool same = true;
    for (std::size_t k = 0; k < steps_.size(); ++k)
      same = same && farthest(window.engine[k], window.mirror[k], flowDiameter(setup_)).distance <=
                         lockstepRounding;
    if (same && !measured) {
      ++unmeasured_;
      return now.positionTime;
    }
    for (std::size_t c = 0; c < constants_.size(); ++c)
      accounts_[c].add(alike_.size(), window,
                       referenceResponses(*mirror_, window.mirror, flowDiameter(setup_),
                                          [&](double change) {
                                            SceneOf<D> changed = mirrored;
                                            changeLaws(changed, [&](ContactLaw& law) {
                                              changeConstant(law, constants_[c], change);
                                            });
                                            return begin(changed);
                                          }),
                       mirrored.disks.size());
    alike_.push_back(same);
    return now.positionTime;
  }

  /// Changes that constants which move anything would need; or why that says nothing:
  /// engine and mirror part in a window in which the reference constant moves nothing, or it moves
  /// nothing in any.
  void conclude(LateWindows& found) const {
    if (accounts_.empty()) return;
    const LockstepRow row = accounts_.front().row();  // any of them: `beyond` is of the reference's
    found.read = row.read + unmeasured_;
    found.beyond = row.beyond;
    found.differs = exceedsStrayShare(found.beyond, found.read);
    found.severalAtOnce = row.severalAtOnce;
    for (std::size_t c = 0; c < constants_.size(); ++c) {
      const std::vector<StartReading> readings = (c == 0 ? row : accounts_[c].row()).readings;
      const auto mean = meanOf(readings);
      const bool parts = std::ranges::any_of(readings, [](const StartReading& reading) {
        return reading.beyond && !reading.equivalent;
      });
      if (c == 0 && parts)
        found.failure = "it parts from its mirror where no change of a constant moves anything";
      else if (c == 0 && !mean)
        found.failure = fmt::format(
            "in its {} windows no change of a constant moves anything, so they say nothing of its "
            "law: a longer run would",
            found.times.size());
      if (!found.failure.empty()) return;
      if (mean) found.equivalents.push_back({constants_[c], *mean});
    }
  }

 private:
  /// Over all windows, the upper end of its interval. One that cannot be read counts as the largest
  /// that can, one alike and not measured as the largest that is alike and was.
  std::optional<double> meanOf(const std::vector<StartReading>& readings) const {
    double largest = -1.0, largestAlike = 0.0;
    for (std::size_t k = 0; k < readings.size(); ++k)
      if (const auto& read = readings[k].equivalent) {
        largest = std::max(largest, *read);
        if (alike_[k]) largestAlike = std::max(largestAlike, *read);
      }
    if (largest < 0.0) return std::nullopt;
    Numbers all(unmeasured_, largestAlike);
    for (const StartReading& reading : readings)
      all.push_back(reading.equivalent.value_or(largest));
    const EnsembleMean found = *ensembleMean(all);
    if (!found.standardError) return found.mean;
    return found.mean + studentQuantile(shareConfidence, found.packings - 1) * *found.standardError;
  }

  Engine& engine_;
  const EngineEntry& entry_;
  const Case& setup_;
  const Packing& packing_;
  SceneOf<D> scene_;  ///< the case's, as the run begins
  Capabilities can_;
  EffectiveParameters effective_;
  std::unique_ptr<Engine> mirror_;
  bool springs_ = false;              ///< contacts remember a force, a torque or a bond
  double reached_ = 0.0;              ///< of the engine's run [s]
  std::vector<std::uint64_t> steps_;  ///< of lockstepTimes
  std::vector<std::string> constants_;
  std::vector<SeparationAccount> accounts_;  ///< by constant, of the windows measured
  std::vector<bool> alike_;                  ///< to rounding, by window measured
  std::size_t unmeasured_ = 0;               ///< windows that are not, as they are alike
};

template <int D>
LateWindows followIn(Engine& engine, const EngineEntry& entry, const Case& setup,
                     const Packing& packing, int index, double dt, std::size_t measured,
                     const std::function<void(double)>& progress) {
  LateWindows found;
  found.packing = index;
  try {
    LateComparison<D> comparison(engine, entry, setup, packing, dt);
    found.length = comparison.length();
    const auto room = static_cast<std::size_t>(
        std::max(1.0, std::floor(flowDuration(setup) / found.length + 1e-6)));
    const std::size_t stride = std::max<std::size_t>(1, room / measured);
    for (std::size_t k = 0; k < room; ++k) {
      const double t = flowRestart(setup, static_cast<double>(k) * found.length);
      if (t < comparison.reached() - 0.5 * found.length)
        continue;  // swinging walls begin again later
      found.times.push_back(comparison.window(t, k % stride == 0));
      progress(static_cast<double>(k + 1) / static_cast<double>(room));
    }
    comparison.conclude(found);
  } catch (const UnsupportedScene& refusal) {
    found.failure = refusal.what();
  }
  return found;
}

}  // namespace

LateWindows followLate(Engine& engine, const EngineEntry& entry, const Case& setup,
                       const Packing& packing, int index, double dt, std::size_t measured,
                       const std::function<void(double)>& progress) {
  return inDimensionOf(setup, [&]<int D>() {
    return followIn<D>(engine, entry, setup, packing, index, dt, measured, progress);
  });
}

}  // namespace crossgrain::inline studies
