#include "runs/lockstep/late_windows.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "adapters/grain.hpp"
#include "adapters/law_options.hpp"
#include "adapters/registry.hpp"
#include "cases/flow.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/lockstep/account.hpp"
#include "runs/lockstep/changed_cases.hpp"
#include "runs/lockstep/comparison.hpp"
#include "runs/lockstep/responses.hpp"
#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/separation.hpp"
#include "runs/lockstep/starts.hpp"
#include "runs/lockstep/window.hpp"

namespace crossgrain::inline runs {
namespace {

/// An engine in the middle of its run; times count from there.
class GoingOn final : public Engine {
 public:
  GoingOn(Engine& engine, double since) : engine_(engine), since_(since) {}

  Capabilities capabilities() const override { return engine_.capabilities(); }
  Realised load(const Scene& scene, const Settings& settings) override {
    return engine_.load(scene, settings);
  }
  double advance(double t) override { return engine_.advance(since_ + t) - since_; }
  Snapshot snapshot(ContactReport contacts) override {
    Snapshot seen = engine_.snapshot(contacts);
    for (double* const time : {&seen.positionTime, &seen.velocityTime, &seen.contactTime})
      *time -= since_;
    return seen;
  }
  Stats stats() const override { return engine_.stats(); }

 private:
  Engine& engine_;
  double since_;
};

/// Positions, velocities and, if asked for, contacts of one instant, whatever an engine staggers.
/// It may be a step further afterwards. @throws EngineFailure
Snapshot stateOf(Engine& engine, double dt, bool springs) {
  const ContactReport report = springs ? ContactReport::instant : ContactReport::none;
  Snapshot now = engine.snapshot(report);
  const double t = now.positionTime;
  const auto isNow = [&](double time) { return std::abs(time - t) < 0.01 * dt; };
  if (isNow(now.velocityTime) && (!springs || isNow(now.contactTime))) return now;
  engine.advance(t + dt);
  Snapshot next = engine.snapshot(report);
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

class LateComparison {
 public:
  LateComparison(Engine& engine, const EngineEntry& entry, const Case& setup,
                 const Packing& packing, double dt)
      : engine_(engine),
        entry_(entry),
        setup_(setup),
        packing_(packing),
        scene_(flowScene(setup, packing, dt)),
        can_(engine.capabilities()),
        mirror_(engineRegistry().front().make()) {
    step_ = loadScene(engine, entry, setup, scene_).dt;
    const ContactLaw law = sceneOfMirror(can_, entry, setup, scene_, step_).law;
    const bool slips = law.mu > 0.0 && law.tangential != TangentialLaw::none;
    springs_ =
        law.soft() && slips &&
        (law.tangential == TangentialLaw::spring || law.tangential == TangentialLaw::springDashpot);
    for (const double time : lockstepTimes) steps_.push_back(stepsUntil(time, step_));
    for (const ChangedCase& changed : changedCases(setup)) {
      if (changed.constant == "mu" && !slips) continue;  // the engine has none of it
      constants_.push_back(changed.constant);
      accounts_.emplace_back(flowDiameter(setup), timesOf(steps_, step_),
                             std::vector<std::size_t>{0, 1, 2, 3});
    }
  }

  double length() const { return static_cast<double>(steps_.back()) * step_; }
  double reached() const { return reached_; }

  /// @param measured  whether the yardstick is applied even where both are the same to rounding
  /// @throws EngineFailure
  void window(double t, bool measured, LateWindows& found) {
    if (springs_ && !can_.instantContacts)
      throw EngineFailure("it has no contact forces of an instant, from which springs could go on");
    engine_.advance(t);
    const Snapshot now = stateOf(engine_, step_, springs_);
    Scene mirrored =
        sceneOfMirror(can_, entry_, setup_,
                      flowScene(setup_, packingAt(packing_, scene_, now), scene_.dt), step_);
    mirrored.energyLedger = false;
    const auto begin = [&](const Scene& scene) {
      mirror_->load(scene, {});
      if (springs_) stretchSprings(*mirror_, *now.contacts);
    };
    begin(mirrored);
    GoingOn own(engine_, now.positionTime);
    const LockstepWindow window = followBoth(own, *mirror_, step_, steps_, can_.instantContacts);
    reached_ = now.positionTime + length();
    const std::size_t start = found.times.size();
    found.times.push_back(now.positionTime);
    const LockstepWindow early = {{window.engine.front()}, {window.mirror.front()}};
    if (const auto forces = forcesOfFirstStep(early))
      found.forces =
          std::max(found.forces.value_or(0.0), std::max(forces->normal, forces->tangential));
    for (std::size_t k = 0; k < steps_.size(); ++k)
      measured =
          measured || farthest(window.engine[k], window.mirror[k], flowDiameter(setup_)).distance >
                          lockstepRounding;
    for (std::size_t c = 0; measured && c < constants_.size(); ++c)
      accounts_[c].add(start, window,
                       yardstickResponses(*mirror_, window.mirror, flowDiameter(setup_),
                                          [&](double change) {
                                            Scene changed = mirrored;
                                            changeConstant(changed.law, constants_[c], change);
                                            begin(changed);
                                            return step_;
                                          }),
                       mirrored.disks.size());
  }

  std::vector<EquivalentChange> equivalents() const {
    std::vector<EquivalentChange> found;
    for (std::size_t c = 0; c < constants_.size(); ++c) {
      const auto equivalent = accounts_[c].row().equivalent;
      if (!equivalent) return {};
      found.push_back({constants_[c], *equivalent});
    }
    return found;
  }

 private:
  Engine& engine_;
  const EngineEntry& entry_;
  const Case& setup_;
  const Packing& packing_;
  Scene scene_;  ///< the case's, as the run begins
  Capabilities can_;
  bool springs_ = false;  ///< contacts remember a tangential force
  std::unique_ptr<Engine> mirror_;
  double step_ = 0.0;                 ///< the engine's [s]
  double reached_ = 0.0;              ///< of its run [s]
  std::vector<std::uint64_t> steps_;  ///< of lockstepTimes
  std::vector<std::string> constants_;
  std::vector<SeparationAccount> accounts_;  ///< by constant
};

}  // namespace

LateWindows followLate(Engine& engine, const EngineEntry& entry, const Case& setup,
                       const Packing& packing, int index, double dt, std::size_t measured,
                       const std::function<void(double)>& progress) {
  LateWindows found;
  found.packing = index;
  try {
    LateComparison comparison(engine, entry, setup, packing, dt);
    found.length = comparison.length();
    const auto room = static_cast<std::size_t>(
        std::max(1.0, std::floor(flowDuration(setup) / found.length + 1e-6)));
    const std::size_t stride = std::max<std::size_t>(1, room / measured);
    for (std::size_t k = 0; k < room; ++k) {
      const double t = flowRestart(setup, static_cast<double>(k) * found.length);
      if (t < comparison.reached() - 0.5 * found.length)
        continue;  // swinging walls begin again later
      comparison.window(t, k % stride == 0, found);
      progress(static_cast<double>(k + 1) / static_cast<double>(room));
    }
    found.equivalents = comparison.equivalents();
    if (found.equivalents.empty()) found.failure = "no change of a constant moves anything in them";
  } catch (const EngineFailure& failure) {
    found.failure = failure.what();
  } catch (const UnsupportedScene& refusal) {
    found.failure = refusal.what();
  }
  return found;
}

}  // namespace crossgrain::inline runs
