#include "studies/lockstep/identify.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "cases/flow.hpp"
#include "law/law_options.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/lockstep/closest_term.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"
#include "studies/lockstep/terms.hpp"
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

/// Fits alike: worse than the best by less than this part of it.
constexpr double alike = 0.01;

/// A constant is put down as another one from here on: what rounding and what an engine's own way
/// with springs do is less.
constexpr double leastConstant = 1e-5;  // of the constant

template <int D>
class Search {
 public:
  Search(Engine& engine, const EngineEntry& entry, const Case& setup,
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
    goTo(0);
  }

  /// Goes by what is seen at identifyTimes[when] from here on.
  void goTo(std::size_t when) {
    when_ = when;
    best_ = *distanceWith({});
  }

  const EffectiveParameters& effective() const { return effective_; }

  double distance() const { return best_; }
  double time() const { return static_cast<double>(until_[when_]) * step_; }
  const std::vector<AppliedChangeOf<D>>& applied() const { return applied_; }

  /// The closest mirror's scene from the first state.
  SceneOf<D> closest() const {
    SceneOf<D> scene = scenes_.front();
    for (const AppliedChangeOf<D>& one : applied_) one.change.apply(scene, one.by);
    return scene;
  }

  std::vector<MirrorChangeOf<D>> candidates() const {
    return changesOf(closest(), mirror_->capabilities());
  }

  /// Root of the summed squares of all components [d]; absent where it cannot run like that, or
  /// where it exceeds `limit`: the sum grows start by start, and what exceeds it after some need
  /// not run from the others.
  std::optional<double> distanceWith(const std::vector<AppliedChangeOf<D>>& further,
                                     double limit = std::numeric_limits<double>::infinity()) {
    const std::vector<AppliedChangeOf<D>> all = appliedAnd(further);
    double sum = 0.0;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      const auto run = runsWith<D>(*mirror_, {scenes_[s]}, all, {time()});
      if (!run) return std::nullopt;
      for (const double apart : separationVector(engine_[s][when_], run->front()[0], diameter_))
        sum += apart * apart;
      if (std::sqrt(sum) > limit) return std::nullopt;
    }
    return std::sqrt(sum);
  }

  /// The largest separation of a disk from the closest mirror [d].
  double largest() {
    double most = 0.0;
    const RunsFromStartsOf<D> runs = *runsWithAlso({});
    for (std::size_t s = 0; s < runs.size(); ++s)
      most = std::max(most, farthest(engine_[s][when_], runs[s][0], diameter_).distance);
    return most;
  }

  /// Takes the convention or the missing effect that brings the mirror nearest. @returns whether
  /// one brought it nearer
  bool takeBestConvention() {
    std::optional<MirrorChangeOf<D>> best;
    double distance = best_ * (1.0 - alike);
    for (const MirrorChangeOf<D>& change : candidates()) {
      if (change.isConstant) continue;
      const auto with = distanceWith({{change}}, distance);
      if (!with || !(*with < distance)) continue;
      distance = *with;
      best = change;
    }
    if (best) take({*best}, distance);
    return best.has_value();
  }

  /// Two at once, where neither alone brings the mirror nearer: arms of f_t and of v_t are such,
  /// which agree with each other in most laws. @returns whether two brought it nearer
  bool takeBestPair() {
    std::vector<MirrorChangeOf<D>> changes = candidates();
    std::erase_if(changes, &MirrorChangeOf<D>::isConstant);
    const MirrorChangeOf<D>*first = nullptr, *second = nullptr;
    double distance = best_ * (1.0 - alike);
    for (std::size_t b = 1; b < changes.size(); ++b)
      for (std::size_t a = 0; a < b; ++a) {
        if (optionNamed(changes[a]) == optionNamed(changes[b])) continue;
        const auto with = distanceWith({{changes[a]}, {changes[b]}}, distance);
        if (!with || !(*with < distance)) continue;
        distance = *with;
        first = &changes[a];
        second = &changes[b];
      }
    if (!first) return false;
    take({*first}, distance);
    take({*second}, distance);
    return true;
  }

  /// Undoes every convention and missing effect without which the mirror is as near: it was taken
  /// while something else was still amiss.
  void undoNeedless() {
    for (std::size_t k = applied_.size(); k-- > 0;) {
      if (applied_[k].change.isConstant) continue;
      const AppliedChangeOf<D> one = applied_[k];
      const auto place = applied_.begin() + static_cast<std::ptrdiff_t>(k);
      applied_.erase(place);
      const auto without = distanceWith({});
      if (without && *without <= best_ * (1.0 + alike) + lockstepRounding)
        best_ = *without;
      else
        applied_.insert(applied_.begin() + static_cast<std::ptrdiff_t>(k), one);
    }
  }

  /// Takes that constant, and as much of it, as leaves least, if that is half or less of what there
  /// is. @returns whether there is one
  bool takeBestConstant() {
    const RunsFromStartsOf<D> now = *runsWithAlso({});
    const std::vector<double> separation = separationFrom(now);
    std::optional<AppliedChangeOf<D>> best;
    double unexplained = termWorthTrying;
    for (const MirrorChangeOf<D>& change : candidates()) {
      if (!change.isConstant) continue;
      const auto moved = runsWithAlso({{change, termChange}});
      if (!moved) continue;
      const NamedTerm term =
          asTerm(change, separation, separationOfAll(*moved, 0, now, 0, diameter_));
      if (!(term.unexplained < unexplained)) continue;
      unexplained = term.unexplained;
      best = {change, *term.amount};
    }
    const auto with = best ? distanceWith({*best}) : std::nullopt;
    if (!with || !(*with < best_)) return false;
    take(*best, *with);
    return true;
  }

 private:
  /// The part before " = " of a convention; all of an effect's name.
  static std::string optionNamed(const MirrorChangeOf<D>& change) {
    return change.name.substr(0, change.name.find(" = "));
  }

  void take(const AppliedChangeOf<D>& change, double distance) {
    applied_.push_back(change);
    best_ = distance;
  }

  std::vector<AppliedChangeOf<D>> appliedAnd(const std::vector<AppliedChangeOf<D>>& further) const {
    std::vector<AppliedChangeOf<D>> all = applied_;
    all.insert(all.end(), further.begin(), further.end());
    return all;
  }
  std::optional<RunsFromStartsOf<D>> runsWithAlso(const std::vector<AppliedChangeOf<D>>& further) {
    return runsWith<D>(*mirror_, scenes_, appliedAnd(further), {time()});
  }

  std::vector<double> separationFrom(const RunsFromStartsOf<D>& runs) const {
    return separationOfAll(engine_, when_, runs, 0, diameter_);
  }

  double diameter_;
  std::unique_ptr<Engine> mirror_;
  double step_ = 0.0;
  std::vector<std::uint64_t> until_;
  std::size_t when_ = 0;        ///< index into identifyTimes
  RunsFromStartsOf<D> engine_;  ///< at identifyTimes
  EffectiveParameters effective_;
  std::vector<SceneOf<D>> scenes_;
  std::vector<AppliedChangeOf<D>> applied_;
  double best_ = std::numeric_limits<double>::infinity();
};

/// Values of an option that bring the mirror as near as the one it has.
template <int D>
FoundOption optionOf(Search<D>& search, const LawOption& option, const Capabilities& can) {
  const std::string name(option.name);
  FoundOption found{name, {lawOptionValue(search.closest().law, name)}, {}};
  const double limit = (1.0 + alike) * search.distance() + lockstepRounding;
  for (const MirrorChangeOf<D>& change : search.candidates()) {
    const std::string prefix = name + " = ";
    if (change.isConstant || !change.name.starts_with(prefix)) continue;
    const auto with = search.distanceWith({{change}}, limit);
    if (with && *with <= limit) found.values.push_back(change.name.substr(prefix.size()));
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
  Search<D> search(engine, entry, setup, states, dt);
  Identification found;
  found.starts = states.size();
  const SceneOf<D> whole = flowScene<D>(setup, states.front().packing, dt);
  search.goTo(identifyTimes.size() - 1);
  found.time = search.time();
  found.before = search.largest();
  // One change hides behind another, and a constant behind a convention: until nothing helps.
  for (std::size_t when = 0; when < identifyTimes.size(); ++when) {
    search.goTo(when);
    const double enough = std::max(lockstepRounding, leftOfNoMirror * search.largest());
    for (bool nearer = true; nearer && search.largest() > lockstepRounding;) {
      nearer = search.takeBestConvention() || search.takeBestConstant() ||
               (search.largest() > enough && search.takeBestPair());
      progress(1.0 - 1.0 / static_cast<double>(search.applied().size() + 2));
    }
  }
  search.undoNeedless();
  found.left = search.largest();

  std::map<std::string, double> constants;
  for (const AppliedChangeOf<D>& one : search.applied())
    if (one.change.isConstant) {
      double& by = constants[one.change.name];
      by = (1.0 + by) * (1.0 + one.by) - 1.0;
    }
  for (const auto& [name, change] : constants)
    if (std::abs(change) >= leastConstant) found.constants.push_back({name, change});

  const Capabilities can = engine.capabilities();
  const SceneOf<D> closest = search.closest();
  for (const LawOption& option : lawOptions()) {
    const std::string_view name = option.name;
    const bool bears =
        name == "velocity_arm" ? mattersTo(closest.law, name) : bearsOnMirror(closest.law, name);
    if (bears && name != "normal" && name != "damper")
      found.options.push_back(optionOf(search, option, can));
  }
  found.missing = missingFrom(effectsOf(whole), effectsOf(closest));
  found.declaredMissing = missingFrom(effectsOf(whole), search.effective().effects);
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
