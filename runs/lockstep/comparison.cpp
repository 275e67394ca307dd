#include "runs/lockstep/comparison.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>

#include "adapters/registry.hpp"
#include "cases/couette.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/separation.hpp"
#include "runs/lockstep/terms.hpp"
#include "runs/lockstep/window.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {
namespace {

double diameterOf(const Case& setup) {
  return 2.0 * setup.particles.smallRadius;
}

/// The scene that an engine runs from a state, for its mirror: with the engine's conventions, its
/// effects and its step, in double precision.
Scene sceneOfMirror(const Capabilities& can, const EngineEntry& entry, const Case& setup,
                    const Scene& scene, double dt) {
  Scene theirs = sceneFor(can, entry, setup, scene).scene;
  theirs.precision = Precision::float64;
  theirs.dt = dt;
  return theirs;
}

/// One engine against its mirror from one state after the other.
class Comparison {
 public:
  Comparison(Engine& engine, const EngineEntry& entry, const Case& setup, double dt)
      : engine_(engine),
        entry_(entry),
        setup_(setup),
        dt_(dt),
        can_(engine.capabilities()),
        mirror_(engineRegistry().front().make()) {}

  /// @throws EngineFailure, UnsupportedScene
  void follow(std::size_t index, const FlowState& state) {
    const Scene scene = couetteScene(setup_, state.packing, dt_);
    Realised realised = loadScene(engine_, entry_, setup_, scene);
    step_ = realised.dt;
    steps_ = lockstepSteps(step_);
    const Scene mirrored = sceneOfMirror(can_, entry_, setup_, scene, step_);
    mirror_->load(mirrored, {});
    const LockstepWindow window =
        followBoth(engine_, *mirror_, step_, steps_, can_.instantContacts);
    addTrack(window);
    addYardstick(mirrored, window);
    addKinds(window, mirrored.disks.size());
    addFirst(index, window, mirrored.disks.size());
    if (const auto forces = forcesOfFirstStep(window))
      row_.forces = row_.forces ? together(*row_.forces, *forces) : *forces;
    engineFrames_.push_back(framesAtTimes(window.engine));
    mirrorFrames_.push_back(framesAtTimes(window.mirror));
    scenes_.push_back(mirrored);
    if (!row_.realised) row_.realised = std::move(realised);
    ++row_.starts;
  }

  LockstepRow result() {
    row_.engine = entry_.name;
    if (row_.starts == 0) return row_;
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      row_.trackTime.push_back(static_cast<double>(steps_[k]) * step_);
      row_.track.push_back(largest_[k]);
    }
    for (std::size_t k = 0; k < lockstepTimes.size(); ++k) addSeparation(k);
    judge();
    if (row_.verdict != LockstepVerdict::sameToRounding) row_.term = closestTerm();
    return row_;
  }

 private:
  using Responses =
      std::vector<std::vector<double>>;  ///< by lockstepTimes and yardstickChanges [d]

  void addTrack(const LockstepWindow& window) {
    largest_.resize(steps_.size(), 0.0);
    std::vector<double> now;
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      now.push_back(farthest(window.engine[k], window.mirror[k], diameterOf(setup_)).distance);
      largest_[k] = std::max(largest_[k], now.back());
    }
    tracks_.push_back(std::move(now));
  }

  /// What changes of the yardstick do from here, at lockstepTimes: the larger of both signs.
  void addYardstick(const Scene& mirrored, const LockstepWindow& window) {
    std::vector<std::size_t> frames;
    std::vector<std::uint64_t> steps;
    for (const double time : lockstepTimes) {
      frames.push_back(frameAt(steps_, step_, time));
      steps.push_back(steps_[frames.back()]);
    }
    Responses now(frames.size(), std::vector<double>(yardstickChanges.size(), 0.0));
    for (std::size_t c = 0; c < yardstickChanges.size(); ++c)
      for (const double sign : {1.0, -1.0}) {
        Scene changed = mirrored;
        changeYardstick(changed.law, sign * yardstickChanges[c]);
        mirror_->load(changed, {});
        const auto moved = followMirror(*mirror_, step_, steps);
        for (std::size_t k = 0; k < frames.size(); ++k)
          now[k][c] = std::max(
              now[k][c], farthest(moved[k], window.mirror[frames[k]], diameterOf(setup_)).distance);
      }
    yardsticks_.push_back(std::move(now));
  }

  void addKinds(const LockstepWindow& window, std::size_t disks) {
    const ContactKinds now = kindsVisited(window.mirror, disks);
    row_.kinds.sticking += now.sticking;
    row_.kinds.sliding += now.sliding;
    row_.kinds.made += now.made;
    row_.kinds.opened += now.opened;
    row_.kinds.wall += now.wall;
  }

  void addFirst(std::size_t index, const LockstepWindow& window, std::size_t disks) {
    auto first = firstExceedance(window, diameterOf(setup_), lockstepRounding, disks);
    if (!first) return;
    first->start = index;
    if (!row_.first || first->until < row_.first->until) row_.first = std::move(first);
  }

  /// Each start speaks for itself; one where the yardstick moves nothing says nothing.
  void addSeparation(std::size_t which) {
    const std::size_t frame = frameAt(steps_, step_, lockstepTimes[which]);
    LockstepSeparation separation;
    separation.time = static_cast<double>(steps_[frame]) * step_;
    std::vector<double> own, moved;
    for (std::size_t s = 0; s < tracks_.size(); ++s) {
      own.push_back(tracks_[s][frame]);
      moved.push_back(yardsticks_[s][which].back());
      if (const auto equivalent = equivalentChange(own.back(), yardsticks_[s][which]))
        separation.equivalent = std::max(separation.equivalent.value_or(0.0), *equivalent);
    }
    separation.median = medianOf(own);
    separation.largest = std::ranges::max(own);
    separation.yardstick = medianOf(moved);
    row_.separations.push_back(separation);
  }

  static double medianOf(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
  }

  void judge() {
    for (const LockstepSeparation& separation : row_.separations)
      if (separation.equivalent)
        row_.equivalent = std::max(row_.equivalent.value_or(0.0), *separation.equivalent);
    if (std::ranges::max(largest_) < lockstepRounding)
      row_.verdict = LockstepVerdict::sameToRounding;
    else if (row_.equivalent)
      row_.verdict =
          *row_.equivalent < lockstepSameLaw ? LockstepVerdict::sameLaw : LockstepVerdict::differs;
    else
      row_.reason = "the yardstick moves nothing here";
  }

  /// At lockstepTimes, without contacts.
  std::vector<LockstepFrame> framesAtTimes(const std::vector<LockstepFrame>& frames) const {
    std::vector<LockstepFrame> chosen;
    for (const double time : lockstepTimes) {
      chosen.push_back(frames[frameAt(steps_, step_, time)]);
      chosen.back().contacts.reset();
    }
    return chosen;
  }

  /// Every change of the mirror, from every start, up to the first of lockstepTimes at which more
  /// than rounding is seen.
  std::optional<NamedTerm> closestTerm() {
    std::size_t when = 0;
    while (when + 1 < lockstepTimes.size() && !(row_.separations[when].largest > lockstepRounding))
      ++when;
    std::vector<double> separation;
    for (std::size_t s = 0; s < scenes_.size(); ++s)
      append(separation,
             separationVector(engineFrames_[s][when], mirrorFrames_[s][when], diameterOf(setup_)));
    std::vector<NamedTerm> terms;
    for (const MirrorChange& change : changesOf(scenes_.front(), mirror_->capabilities()))
      if (const auto response = responseTo(change, when);
          response && response->size() == separation.size())
        terms.push_back(asTerm(change, separation, *response));
    return bestTerm(terms);
  }

  static void append(std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
  }

  /// What a change of the mirror does, from all starts. Absent where it cannot run like that.
  std::optional<std::vector<double>> responseTo(const MirrorChange& change, std::size_t when) {
    const std::vector<std::uint64_t> until = {steps_[frameAt(steps_, step_, lockstepTimes[when])]};
    std::vector<double> response;
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      throwIfInterrupted();
      Scene changed = scenes_[s];
      change.apply(changed, termChange);
      std::vector<LockstepFrame> moved;
      try {
        mirror_->load(changed, {});
        moved = followMirror(*mirror_, step_, until);
      } catch (const Interrupted&) {
        throw;
      } catch (const std::exception&) {
        return std::nullopt;
      }
      append(response, separationVector(moved.front(), mirrorFrames_[s][when], diameterOf(setup_)));
    }
    return response;
  }

  Engine& engine_;
  const EngineEntry& entry_;
  const Case& setup_;
  double dt_;  ///< the case's [s]
  Capabilities can_;
  std::unique_ptr<Engine> mirror_;
  double step_ = 0.0;  ///< the engine's [s]
  std::vector<std::uint64_t> steps_;
  std::vector<double> largest_;              ///< by frame, over starts [d]
  std::vector<std::vector<double>> tracks_;  ///< by start and frame [d]
  std::vector<Responses> yardsticks_;        ///< by start and lockstepTimes [d]
  std::vector<std::vector<LockstepFrame>> engineFrames_,
      mirrorFrames_;           ///< by start and lockstepTimes
  std::vector<Scene> scenes_;  ///< the mirror's, by start
  LockstepRow row_;
};

}  // namespace

LockstepRow holdAgainstMirror(Engine& engine, const EngineEntry& entry, const Case& setup,
                              const std::vector<FlowState>& states, double dt,
                              const std::function<void(double)>& progress) {
  const auto began = std::chrono::steady_clock::now();
  Comparison comparison(engine, entry, setup, dt);
  std::string failure;
  try {
    for (std::size_t s = 0; s < states.size(); ++s) {
      comparison.follow(s, states[s]);
      progress(static_cast<double>(s + 1) / static_cast<double>(states.size()));
    }
  } catch (const EngineFailure& error) {
    failure = error.what();
  }
  LockstepRow row = comparison.result();
  row.failure = failure;
  if (row.starts == 0) row.reason = failure;
  row.wallSeconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return row;
}

}  // namespace crossgrain::inline runs
