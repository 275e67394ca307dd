#include "studies/lockstep/declared_causes.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "studies/causes/differences.hpp"
#include "studies/lockstep/closest_term.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"
#include "studies/lockstep/window.hpp"

namespace crossgrain::inline studies {
namespace {

/// Of so many differences all mixtures run: of more, each alone and each taken back.
constexpr std::size_t mostMixed = 3;
/// That an engine is followed in from each start: its own, its mirror's and responses to changes.
constexpr std::size_t windowsOfStart = 2 + referencePerturbations.size();

/// Starts whose mixtures take a tenth of the windows of all.
std::size_t startsFor(std::size_t differences, std::size_t all) {
  const std::size_t mixtures = mixturesOf(differences, mostMixed).size();
  return std::clamp<std::size_t>(all * windowsOfStart / (10 * mixtures), 1, all);
}

template <int D>
class MixedRuns {
 public:
  MixedRuns(Engine& mirror, const std::vector<SceneOf<D>>& scenes,
            const std::vector<SceneOf<D>>& peers, const std::vector<DifferenceOf<D>>& differences,
            double diameter)
      : mirror_(mirror),
        scenes_(scenes),
        peers_(peers),
        differences_(differences),
        diameter_(diameter),
        dt_(scenes.front().dt),
        steps_(lockstepSteps(dt_)) {}

  /// Separations from the mixture of nothing, time by time; absent where it cannot run.
  std::optional<Numbers> separations(Mixture mixture) {
    if (!reference_) reference_ = run(0);
    const auto runs = reference_ && mixture != 0 ? run(mixture) : reference_;
    if (!runs) return std::nullopt;
    if (std::has_single_bit(mixture))
      firstSteps_[static_cast<std::size_t>(std::countr_zero(mixture))] = firstStep(mixture, *runs);
    Numbers all;
    for (const double time : lockstepTimes) {
      const std::size_t frame = frameAt(steps_, dt_, time);
      const auto apart = separationOfAll(*runs, frame, *reference_, frame, diameter_);
      all.insert(all.end(), apart.begin(), apart.end());
    }
    return all;
  }

  /// By difference, of those that have run alone: LockstepCauses::firstStep.
  const std::map<std::size_t, std::optional<std::size_t>>& firstSteps() const {
    return firstSteps_;
  }

  double time(std::size_t k) const {
    return timesOf(steps_, dt_)[frameAt(steps_, dt_, lockstepTimes[k])];
  }

 private:
  SceneOf<D> sceneOf(Mixture mixture, std::size_t s) const {
    return mixed(scenes_[s], peers_[s], differences_, mixture);
  }

  /// From all starts, at all steps.
  std::optional<RunsFromStartsOf<D>> run(Mixture mixture) {
    std::vector<SceneOf<D>> scenes;
    for (std::size_t s = 0; s < scenes_.size(); ++s) scenes.push_back(sceneOf(mixture, s));
    return runsWith<D>(mirror_, scenes, {}, timesOf(steps_, dt_));
  }

  bool shows(const LockstepFrameOf<D>& one, const LockstepFrameOf<D>& other) const {
    return farthest(one, other, diameter_).distance > lockstepRounding;
  }

  std::optional<std::size_t> firstStep(Mixture mixture, const RunsFromStartsOf<D>& runs) {
    std::optional<std::size_t> first;
    for (std::size_t frame = 0; frame < steps_.size() && !first; ++frame)
      for (std::size_t s = 0; s < runs.size(); ++s)
        if (shows(runs[s][frame], (*reference_)[s][frame])) {
          const std::size_t step = firstWithin(mixture, s, frame);
          first = std::min(first.value_or(step), step);
        }
    return first;
  }

  /// Step by step within the frame that shows it.
  std::size_t firstWithin(Mixture mixture, std::size_t s, std::size_t frame) {
    std::vector<std::uint64_t> steps;
    for (std::uint64_t step = frame == 0 ? 1 : steps_[frame - 1] + 1; step <= steps_[frame]; ++step)
      steps.push_back(step);
    const std::vector<double> times = timesOf(steps, dt_);
    const auto one = runsWith<D>(mirror_, {sceneOf(mixture, s)}, {}, times),
               reference = runsWith<D>(mirror_, {scenes_[s]}, {}, times);
    std::size_t k = 0;
    while (k + 1 < steps.size() && one && reference &&
           !shows(one->front()[k], reference->front()[k]))
      ++k;
    return steps[k];
  }

  Engine& mirror_;
  const std::vector<SceneOf<D>>&scenes_, &peers_;
  const std::vector<DifferenceOf<D>>& differences_;
  double diameter_, dt_;
  std::vector<std::uint64_t> steps_;
  std::optional<RunsFromStartsOf<D>> reference_;
  std::map<std::size_t, std::optional<std::size_t>> firstSteps_;
};

/// Projection of one part on the whole, of numbers [from, to); absent where the whole is rounding.
std::optional<double> partOf(const Numbers& part, const Numbers& whole, std::size_t from,
                             std::size_t to) {
  double along = 0.0, squares = 0.0;
  for (std::size_t k = from; k < to; ++k) {
    along += *part[k] * *whole[k];
    squares += *whole[k] * *whole[k];
  }
  return std::sqrt(squares) > lockstepRounding ? std::optional(along / squares) : std::nullopt;
}

template <int D>
std::optional<LockstepCauses> causesIn(Engine& mirror, const std::vector<SceneOf<D>>& scenes,
                                       const std::vector<SceneOf<D>>& mirrors,
                                       const NamedTerm* term, double diameter) {
  const auto changes = changesNamed<D>(term, mirrors.front(), mirror.capabilities());
  const BehaviourOf<D> behaviour = behaviourOf<D>(scenes.front(), mirrors.front(), changes);
  if (behaviour.differences.empty()) return std::nullopt;
  LockstepCauses causes;
  static_cast<Causes&>(causes) = behaviour.causes;
  causes.starts = startsFor(behaviour.differences.size(), scenes.size());
  const auto some = [&](const std::vector<SceneOf<D>>& all) {
    return std::vector<SceneOf<D>>(all.begin(),
                                   all.begin() + static_cast<std::ptrdiff_t>(causes.starts));
  };
  const std::vector<SceneOf<D>> from = some(scenes);
  std::vector<SceneOf<D>> peers = some(mirrors);
  for (SceneOf<D>& peer : peers) peer = withChanges(peer, changes);
  MixedRuns<D> mixtures(mirror, from, peers, behaviour.differences, diameter);
  const auto parts = attribute(causes, {.mostMixed = mostMixed, .searches = false},
                               [&](Mixture mixture) { return mixtures.separations(mixture); });
  if (!parts) {
    causes.reason = "the in-house engine cannot run a mixture of both laws from these starts";
    return causes;
  }
  Numbers whole = parts->interaction;  // to which all parts add up
  for (const Numbers& part : parts->parts)
    for (std::size_t k = 0; k < whole.size(); ++k) *whole[k] += *part[k];
  const std::size_t each = whole.size() / lockstepTimes.size();
  causes.parts.resize(parts->parts.size());
  for (std::size_t k = 0; k < lockstepTimes.size(); ++k) {
    const auto shareOf = [&](const Numbers& part) {
      return partOf(part, whole, k * each, (k + 1) * each);
    };
    causes.time.push_back(mixtures.time(k));
    for (std::size_t i = 0; i < causes.parts.size(); ++i)
      causes.parts[i].push_back(shareOf(parts->parts[i]));
    causes.interaction.push_back(shareOf(parts->interaction));
  }
  for (std::size_t i = 0; i < causes.parts.size(); ++i)
    causes.firstStep.push_back(mixtures.firstSteps().at(i));
  return causes;
}

}  // namespace

template <int D>
std::optional<LockstepCauses> causesInLockstep(Engine& mirror,
                                               const std::vector<SceneOf<D>>& scenes,
                                               const std::vector<SceneOf<D>>& mirrors,
                                               const NamedTerm* term, double diameter) {
  return causesIn<D>(mirror, scenes, mirrors, term, diameter);
}
template std::optional<LockstepCauses> causesInLockstep(Engine&, const std::vector<SceneOf<2>>&,
                                                        const std::vector<SceneOf<2>>&,
                                                        const NamedTerm*, double);
template std::optional<LockstepCauses> causesInLockstep(Engine&, const std::vector<SceneOf<3>>&,
                                                        const std::vector<SceneOf<3>>&,
                                                        const NamedTerm*, double);

}  // namespace crossgrain::inline studies
