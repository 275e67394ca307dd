#include "studies/lockstep/identify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "cases/flow.hpp"
#include "law/law_options.hpp"
#include "studies/causes/closest_law.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/lockstep/closest_term.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"
#include "studies/lockstep/window.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace {

/// A mirror that leaves more of the first separation than this is none.
constexpr double leftOfNoMirror = 0.01;

}  // namespace

bool FoundOption::contradicts() const {
  if (declared.empty()) return false;
  return std::ranges::none_of(declared, [&](const std::string& value) {
    return std::ranges::find(values, value) != values.end();
  });
}

bool Identification::closeEnough() const {
  return left <= std::max(lockstepRounding, leftOfNoMirror * before);
}

Outcome outcomeOf(const Identification& found) {
  const bool contradicts = !found.closeEnough() || !found.constants.empty() ||
                           found.missing != found.declaredMissing ||
                           std::ranges::any_of(found.options, &FoundOption::contradicts);
  return {contradicts ? exitFailed : exitPassed};
}

namespace {

/// First what acts at once, while no contact is made or broken at another step; then what takes
/// contacts to open.
constexpr std::array identifyTimes = {1e-3, 10e-3};  // [s]

/// An engine's motion from each of some states, and mirrors from the same.
template <int D>
class Followed {
 public:
  Followed(Engine& engine, const EngineEntry& entry, const Case& setup,
           const std::vector<FlowState>& states, double dt)
      : diameter_(flowDiameter(setup)), mirror_(engineRegistry().front().make()) {
    for (const FlowState& state : states) {
      throwIfInterrupted();
      SceneOf<D> scene = flowScene<D>(setup, state.packing, dt);
      const EffectiveParameters effective = loadScene(engine, entry, setup, scene);
      if (!engine_.empty()) requireSameStep(effective_, effective);
      effective_ = effective;
      step_ = effective_.dt;
      until_.clear();
      for (const double time : identifyTimes) until_.push_back(stepsUntil(time, step_));
      engine_.push_back(follow<D>(engine, step_, until_));
      for (LockstepFrameOf<D>& frame : engine_.back())
        unwrap<D>(frame.position, scene.disks.position, scene.box);
      scene.precision = Precision::float64;
      scene.dt = step_;
      scenes_.push_back(std::move(scene));
    }
  }

  /// Goes by what is seen at identifyTimes[when] from here on.
  void goTo(std::size_t when) { when_ = when; }

  const EffectiveParameters& effective() const { return effective_; }
  double time() const { return static_cast<double>(until_[when_]) * step_; }

  /// Search for the law of what is followed, from the mirror of its first state.
  ClosestLaw<D> search() {
    return {scenes_.front(), mirror_->capabilities(),
            [this](const auto& changes, double limit) { return separations(changes, limit); },
            lockstepRounding};
  }

  /// The largest separation of a disk from the mirror with these changes [d].
  double largest(const std::vector<AppliedChangeOf<D>>& changes) {
    double most = 0.0;
    const RunsFromStartsOf<D> runs = *runsWith<D>(*mirror_, scenes_, changes, {time()});
    for (std::size_t s = 0; s < runs.size(); ++s)
      most = std::max(most, farthest(engine_[s][when_], runs[s][0], diameter_).distance);
    return most;
  }

 private:
  /// The sum grows start by start, and what exceeds the limit after some need not run from the
  /// others.
  std::optional<Separations> separations(const std::vector<AppliedChangeOf<D>>& changes,
                                         double limit) {
    std::vector<double> all;
    double sum = 0.0;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      const auto run = runsWith<D>(*mirror_, {scenes_[s]}, changes, {time()});
      if (!run) return std::nullopt;
      for (const double apart : separationVector(engine_[s][when_], run->front()[0], diameter_)) {
        all.push_back(apart);
        sum += apart * apart;
      }
      if (std::sqrt(sum) > limit) return std::nullopt;
    }
    return Separations{std::move(all)};
  }

  double diameter_;
  std::unique_ptr<Engine> mirror_;
  double step_ = 0.0;
  std::vector<std::uint64_t> until_;
  std::size_t when_ = 0;        ///< index into identifyTimes
  RunsFromStartsOf<D> engine_;  ///< at identifyTimes
  EffectiveParameters effective_;
  std::vector<SceneOf<D>> scenes_;
};

/// Values of an option that bring the mirror as near as the one it has.
template <int D>
FoundOption optionOf(const ClosestLaw<D>& search, const LawOption& option,
                     const Capabilities& can) {
  const std::string name(option.name);
  FoundOption found{name, {lawOptionValue(search.scene().law, name)}, {}};
  const double limit = (1.0 + fitsAlike) * search.distance() + lockstepRounding;
  for (const MirrorChangeOf<D>& change : search.candidates()) {
    const std::string prefix = name + " = ";
    if (change.isConstant || !change.name.starts_with(prefix)) continue;
    const auto with = search.distanceWith({{change}}, limit);
    if (with) found.values.push_back(change.name.substr(prefix.size()));
  }
  const auto declared = can.lawOptions.find(name);
  if (declared != can.lawOptions.end()) found.declared = declared->second;
  return found;
}

std::vector<std::string> missingFrom(const Effects& all, const Effects& there) {
  std::vector<std::string> missing;
  for (const Effect effect : all)
    if (!there.contains(effect)) missing.push_back(toString(effect));
  return missing;
}

template <int D>
Identification identifyIn(Engine& engine, const EngineEntry& entry, const Case& setup,
                          const std::vector<FlowState>& states, double dt,
                          const std::function<void(double)>& progress) {
  Followed<D> followed(engine, entry, setup, states, dt);
  ClosestLaw<D> search = followed.search();
  const auto largest = [&] { return followed.largest(search.changes()); };
  Identification found;
  found.starts = states.size();
  const SceneOf<D> whole = flowScene<D>(setup, states.front().packing, dt);
  followed.goTo(identifyTimes.size() - 1);
  found.time = followed.time();
  found.before = largest();
  // One change hides behind another, and a constant behind a convention: until nothing helps.
  for (std::size_t when = 0; when < identifyTimes.size(); ++when) {
    followed.goTo(when);
    search.restart();
    const double enough = std::max(lockstepRounding, leftOfNoMirror * largest());
    for (bool nearer = true; nearer && largest() > lockstepRounding;) {
      using enum ChangeKind;
      nearer = search.take(convention) || search.take(constant, termUnexplained) ||
               (largest() > enough && search.take(pair)) || search.take(constant, termWorthTrying);
      progress(1.0 - 1.0 / static_cast<double>(search.changes().size() + 2));
    }
  }
  search.undoNeedless();
  found.left = largest();
  for (const AppliedChangeOf<D>& one : search.changes())
    if (one.change.isConstant && std::abs(one.by) >= leastConstant)
      found.constants.push_back({one.change.name, one.by});

  const Capabilities can = engine.capabilities();
  const SceneOf<D> closest = search.scene();
  for (const LawOption& option : lawOptions()) {
    const std::string_view name = option.name;
    const bool bears =
        name == "velocity_arm" ? mattersTo(closest.law, name) : bearsOnMirror(closest.law, name);
    if (bears && name != "normal" && name != "damper")
      found.options.push_back(optionOf(search, option, can));
  }
  found.missing = missingFrom(effectsOf(whole), effectsOf(closest));
  found.declaredMissing = missingFrom(effectsOf(whole), followed.effective().effects);
  return found;
}

}  // namespace

Identification identify(Engine& engine, const EngineEntry& entry, const Case& setup,
                        const std::vector<FlowState>& states, double dt,
                        const std::function<void(double)>& progress) {
  return inDimensionOf(
      setup, [&]<int D>() { return identifyIn<D>(engine, entry, setup, states, dt, progress); });
}

}  // namespace crossgrain::inline studies
