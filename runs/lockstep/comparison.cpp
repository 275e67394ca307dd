#include "runs/lockstep/comparison.hpp"

#include <chrono>
#include <memory>
#include <optional>

#include "adapters/registry.hpp"
#include "cases/flow.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/lockstep/account.hpp"
#include "runs/lockstep/closest_term.hpp"
#include "runs/lockstep/precision.hpp"
#include "runs/lockstep/responses.hpp"
#include "runs/lockstep/rules.hpp"
#include "runs/lockstep/separation.hpp"
#include "runs/lockstep/terms.hpp"
#include "runs/lockstep/window.hpp"

namespace crossgrain::inline runs {
namespace {

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
  void follow(std::size_t start, const FlowState& state) {
    const Scene scene = flowScene(setup_, state.packing, dt_);
    Realised realised = loadScene(engine_, entry_, setup_, scene);
    if (realised_) requireSameStep(*realised_, realised);
    step_ = realised.dt;
    steps_ = lockstepSteps(step_);
    const Scene mirrored = sceneOfMirror(can_, entry_, setup_, scene, step_);
    mirror_->load(mirrored, {});
    const LockstepWindow window =
        followBoth(engine_, *mirror_, step_, steps_, can_.instantContacts);
    if (!account_) account_.emplace(flowDiameter(setup_), timesOf(steps_, step_), told());
    account_->add(start, window, responses(mirrored, window), mirrored.disks.size(),
                  precisionLimits(realised.precision, *mirror_, mirrored, window.mirror, steps_,
                                  flowDiameter(setup_)));
    engineFrames_.push_back(chosen(window.engine, framesForTerms(told())));
    mirrorFrames_.push_back(chosen(window.mirror, framesForTerms(told())));
    scenes_.push_back(mirrored);
    if (!realised_) realised_ = std::move(realised);
  }

  LockstepRow result() {
    LockstepRow row;
    if (account_) {
      row = account_->row();
      const bool off =
          row.verdict == LockstepVerdict::sameLaw || row.verdict == LockstepVerdict::differs;
      if (off) row.term = termOf(row);
      // Of rigid disks: impulses of one step, most of them of nothing but rounding.
      if (!setup_.law.soft()) row.forces.reset();
      row.realised = realised_;
    }
    row.engine = entry_.name;
    return row;
  }

 private:
  /// Frames nearest to lockstepTimes.
  std::vector<std::size_t> told() const {
    std::vector<std::size_t> frames;
    for (const double time : lockstepTimes) frames.push_back(frameAt(steps_, step_, time));
    return frames;
  }

  /// What changes of the yardstick do to the mirror from here.
  Responses responses(const Scene& mirrored, const LockstepWindow& window) {
    return yardstickResponses(*mirror_, chosen(window.mirror, told()), flowDiameter(setup_),
                              [&](double change) {
                                Scene changed = mirrored;
                                changeYardstick(changed.law, change);
                                mirror_->load(changed, {});
                                return step_;
                              });
  }

  std::optional<NamedTerm> termOf(const LockstepRow& row) {
    const std::vector<std::size_t> frames = framesForTerms(told());
    TermSearch search;
    search.scenes = scenes_;
    search.diameter = flowDiameter(setup_);
    for (const std::size_t when : looksForTerms(told(), row.trackTime, row.first)) {
      TermLook& look = search.looks.emplace_back();
      look.time = row.trackTime[frames[when]];
      for (const auto& mirror : mirrorFrames_) look.unchanged.push_back(mirror[when]);
      look.separation = separationOfAll(engineFrames_, mirrorFrames_, when, search.diameter);
    }
    return closestTerm(*mirror_, search);
  }

  Engine& engine_;
  const EngineEntry& entry_;
  const Case& setup_;
  double dt_;  ///< the case's [s]
  Capabilities can_;
  std::unique_ptr<Engine> mirror_;
  double step_ = 0.0;  ///< the engine's [s]
  std::vector<std::uint64_t> steps_;
  std::optional<SeparationAccount> account_;
  std::vector<std::vector<LockstepFrame>> engineFrames_,
      mirrorFrames_;           ///< by start and framesForTerms()
  std::vector<Scene> scenes_;  ///< the mirror's, by start
  std::optional<Realised> realised_;
};

}  // namespace

Scene sceneOfMirror(const Capabilities& can, const EngineEntry& entry, const Case& setup,
                    const Scene& scene, double dt) {
  Scene theirs = sceneFor(can, entry, setup, scene).scene;
  theirs.precision = Precision::float64;
  theirs.dt = dt;
  return theirs;
}

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
