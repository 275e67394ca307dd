#include "studies/regression/diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "adapters/audit_geometry.hpp"
#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "cases/case_keys.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "results/schema.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/executor.hpp"
#include "studies/core/study.hpp"
#include "studies/lockstep/closest_term.hpp"
#include "studies/lockstep/lockstep.hpp"
#include "studies/lockstep/rules.hpp"
#include "studies/lockstep/separation.hpp"
#include "studies/lockstep/terms.hpp"
#include "studies/regression/observe.hpp"
#include "support/bad_input.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline studies {
namespace {

/// Frames of a window whose times are whole steps of that size, and the steps.
struct CommonFrames {
  std::vector<std::size_t> frames;
  std::vector<std::uint64_t> steps;
  std::vector<std::size_t> reported;  ///< of `frames`, those nearest to lockstepTimes
  std::vector<std::size_t> which;     ///< of lockstepTimes, those that are reported
};

template <int D>
CommonFrames commonFrames(const std::vector<LockstepFrameOf<D>>& kept, double step) {
  constexpr double rounding = 1e-12;
  CommonFrames common;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const std::uint64_t steps = stepsUntil(kept[k].time, step);
    if (std::abs(static_cast<double>(steps) * step - kept[k].time) > rounding * kept[k].time)
      continue;
    common.frames.push_back(k);
    common.steps.push_back(steps);
  }
  for (std::size_t which = 0; which < lockstepTimes.size(); ++which) {
    const auto nearest = std::ranges::min_element(
        kept, {}, [&](const auto& frame) { return std::abs(frame.time - lockstepTimes[which]); });
    const auto found =
        std::ranges::find(common.frames, static_cast<std::size_t>(nearest - kept.begin()));
    if (found == common.frames.end()) continue;
    common.reported.push_back(static_cast<std::size_t>(found - common.frames.begin()));
    common.which.push_back(which);
  }
  return common;
}

template <int D>
bool sameMotion(const LockstepFrameOf<D>& one, const LockstepFrameOf<D>& other) {
  return one.position == other.position && one.spin == other.spin &&
         one.velocityTime == other.velocityTime;
}

template <int D>
bool sameForces(const LockstepFrameOf<D>& one, const LockstepFrameOf<D>& other) {
  const auto& a = one.contacts;
  const auto& b = other.contacts;
  if (a.has_value() != b.has_value() || one.contactTime != other.contactTime) return false;
  const auto alike = [](const BodySnapshotOf<D>& before, const BodySnapshotOf<D>& now) {
    return before.force == now.force && before.torque == now.torque;
  };
  return (!a ||
          (a->i == b->i && a->j == b->j && a->normalForce == b->normalForce &&
           a->tangentialForce == b->tangentialForce && a->rollingTorque == b->rollingTorque)) &&
         std::ranges::equal(one.bodies, other.bodies, alike);
}

/// Forces and torques on walls: the largest change, in the largest of before [-].
template <int D>
double wallChange(const LockstepFrameOf<D>& now, const LockstepFrameOf<D>& before) {
  double force = 0.0, torque = 0.0, forceUnit = 0.0, torqueUnit = 0.0;
  for (std::size_t b = 0; b < std::min(now.bodies.size(), before.bodies.size()); ++b) {
    const BodySnapshotOf<D>&one = now.bodies[b], &other = before.bodies[b];
    if (one.force && other.force) {
      force = std::max(force, (*one.force - *other.force).norm());
      forceUnit = std::max(forceUnit, other.force->norm());
    }
    if (one.torque && other.torque) {
      torque = std::max(torque, sizeOf(SpinOf<D>(*one.torque - *other.torque)));
      torqueUnit = std::max(torqueUnit, sizeOf(*other.torque));
    }
  }
  return std::max(forceUnit > 0.0 ? force / forceUnit : 0.0,
                  torqueUnit > 0.0 ? torque / torqueUnit : 0.0);
}

/// An engine compared with what was kept, from one start after the other.
template <int D>
class WindowsDiff {
 public:
  WindowsDiff(const Observed& now, const Case& caseBefore, const Baseline& baseline,
              const BaselineEngine& before)
      : now_(now),
        caseBefore_(caseBefore),
        baseline_(baseline),
        before_(before),
        instant_(now.engine.capabilities().instantContacts),
        diameter_(flowDiameter(caseBefore)) {}

  /// @throws EngineFailure, UnsupportedScene, BadInput
  void follow(std::size_t s) {
    const FlowState& state = baseline_.starts[s];
    const BaselineWindowOf<D>& kept = windowsIn<D>(before_)[s];
    EffectiveParameters effective = loadStart<D>(now_, state);
    if (effective_) requireSameStep(*effective_, effective);
    step_ = effective.dt;
    if (!effective_) effective_ = std::move(effective);
    common_ = commonFrames(kept.frames, step_);
    if (common_.reported.empty()) return;
    LockstepWindowOf<D> window;
    window.engine = studies::follow<D>(now_.engine, step_, common_.steps,
                                       instant_ ? ContactReport::instant : ContactReport::none);
    Responses responses;
    for (const std::size_t frame : common_.frames) window.mirror.push_back(kept.frames[frame]);
    const auto box = flowScene<D>(now_.setup, state.packing, now_.dt).box;
    for (std::size_t k = 0; k < window.engine.size(); ++k)
      unwrap<D>(window.engine[k].position, window.mirror[k].position, box);
    for (const std::size_t which : common_.which) responses.push_back(kept.responses[which]);
    sameBits_ &= common_.frames.size() == kept.frames.size() &&
                 std::ranges::equal(window.engine, window.mirror, sameMotion<D>) &&
                 (!instant_ || std::ranges::equal(window.engine, window.mirror, sameForces<D>));
    // Forces of another instant are no forces to compare.
    for (std::size_t k = 0; k < window.engine.size(); ++k)
      if (window.engine[k].contactTime != window.mirror[k].contactTime)
        window.engine[k].contacts.reset();
    compareForces(window);
    if (!account_) account_.emplace(diameter_, timesOf(common_.steps, step_), common_.reported);
    account_->add(s, window, responses, disksIn<D>(state.packing).size());
    frames_.add(window, common_.reported);
  }

  const std::optional<EffectiveParameters>& effective() const { return effective_; }

  void addTo(DiffRow& row) {
    if (!account_) {
      row.reason = fmt::format(
          "no step of {} s meets the times that were kept: give [run] dt or [engines.{}] dt", step_,
          now_.entry.name);
      return;
    }
    LockstepRow found = account_->row();
    found.engine = row.engine;
    found.effective = effective_;
    row.mirrored = hasNormalLaw(before_.can, caseBefore_.law);
    if (row.mirrored && hasTerm(found)) found.term = termOf(found);
    row.reason = found.reason;
    row.windowsVerdict = sameBits_ ? Equivalence::sameBits : found.verdict;
    row.forces = forces_;
    if (forces_ &&
        std::max({forces_->normal, forces_->tangential, forces_->walls}) >= lockstepSameLaw)
      row.forcesVerdict = Equivalence::differs;
    row.windows = std::move(found);
  }

 private:
  /// Forces that are reported of one and the same state: of soft disks also where it is the same
  /// but for rounding, 1e-10 d, which moves a force by 1e-7 of that of an overlap of 1e-3 d;
  /// impulses of rigid ones follow from no position alone.
  void compareForces(const LockstepWindowOf<D>& window) {
    if (!instant_) return;
    const double near = caseBefore_.law.soft() ? lockstepRounding : 0.0;
    for (std::size_t k = 0; k < window.engine.size(); ++k) {
      const LockstepFrameOf<D>&now = window.engine[k], &before = window.mirror[k];
      const bool alike =
          near > 0.0 ? farthest(now, before, diameter_).distance <= near : sameMotion(now, before);
      if (!alike || now.contactTime != before.contactTime) continue;
      if (!forces_) forces_.emplace();
      ++forces_->frames;
      if (const auto contacts = forcesOfFirstStep(LockstepWindowOf<D>{{now}, {before}})) {
        forces_->normal = std::max(forces_->normal, contacts->normal);
        forces_->tangential = std::max(forces_->tangential, contacts->tangential);
      }
      forces_->walls = std::max(forces_->walls, wallChange(now, before));
    }
  }

  /// Which change of the mirror of what was kept does what the engine now does; none where no
  /// mirror has its time stepping.
  std::optional<NamedTerm> termOf(const LockstepRow& row) {
    const EngineEntry* const known = findEngine(before_.name);
    const EngineEntry entry = known ? *known : EngineEntry{before_.name, "", {}, {}, {}, ""};
    std::unique_ptr<Engine> mirror;
    const double dt = before_.effective->dt;
    TermSearchOf<D> search{{}, frames_.instants(row.first, diameter_), diameter_};
    for (std::size_t s = 0; s < row.starts; ++s) {
      const SceneOf<D> scene =
          flowScene<D>(caseBefore_, baseline_.starts[s].packing, timeStep(caseBefore_));
      try {
        search.scenes.push_back(
            sceneOfMirror(before_.can, entry, caseBefore_, scene, *before_.effective));
        if (!mirror) mirror = mirrorOf(before_.can, entry, caseBefore_, scene, *before_.effective);
      } catch (const UnsupportedScene&) {
        return std::nullopt;
      }
    }
    // A kept record is no mirror's: its mirror is run again.
    for (TermInstantOf<D>& instant : search.instants) {
      auto unchanged = runsWith(*mirror, search.scenes, {}, {instant.time});
      if (!unchanged) return std::nullopt;
      instant.unchanged = std::move(*unchanged);
    }
    if (step_ != dt)
      search.more.push_back({fmt::format("dt = {} s", step_), false,
                             [step = step_](SceneOf<D>& scene, double) { scene.dt = step; }});
    if (effective_->precision != before_.effective->precision)
      search.more.push_back(
          {"precision = " + effective_->precision, false,
           [](SceneOf<D>& scene, double) { scene.precision = Precision::float32; }});
    return closestTerm(*mirror, search);
  }

  Observed now_;
  const Case& caseBefore_;
  const Baseline& baseline_;
  const BaselineEngine& before_;
  bool instant_;
  double diameter_;
  double step_ = 0.0;  ///< the engine's, now [s]
  CommonFrames common_;
  bool sameBits_ = true;
  std::optional<ForcesChange> forces_;
  std::optional<EffectiveParameters> effective_;
  std::optional<SeparationAccount> account_;
  TermFramesOf<D> frames_;
};

/// Whole runs again, where they were kept and the windows do not make them needless: a difference
/// beyond a margin is one even where windows and collisions are the same.
void diffEndpoints(DiffRow& row, const EngineEntry& entry, const Case& setup,
                   const Baseline& baseline, const BaselineEngine& before,
                   const std::function<void(double)>& progress) {
  if (before.endpoints.empty() || row.windowsVerdict == Equivalence::sameBits) return;
  const KeptEndpoints now = endpointsFrom(entry, setup, baseline.starts, timeStep(setup), progress);
  row.endpoints = endpointChanges(setup, before.endpoints, now, {before.name, row.engine});
  if (std::ranges::count(row.endpoints, Verdict::fail, &EndpointRow::verdict) > 0)
    row.verdict = Equivalence::differs;
}

/// Keys that differ now, "law.mu: 0.44 → 0.5", over all variants.
std::vector<std::string> changedKeys(const std::vector<Case>& before,
                                     const std::vector<Case>& now) {
  std::vector<std::string> all;
  for (std::size_t k = 0; k < now.size() && k < before.size(); ++k) {
    CaseKeys was = caseKeys(before[k].resolvedToml), is = caseKeys(now[k].resolvedToml);
    for (CaseKeys* keys : {&was, &is}) keys->erase("particles.file");
    for (const std::string& change : changes(was, is))
      if (std::ranges::find(all, change) == all.end()) all.push_back(change);
  }
  return all;
}

const BaselineEngine& keptOf(const Baseline& baseline, const std::string& name) {
  const auto own = std::ranges::find(baseline.engines, name, &BaselineEngine::name);
  return own == baseline.engines.end() ? baseline.engines.front() : *own;
}

template <int D>
DiffRow diffIn(Engine& engine, const EngineEntry& entry, const std::vector<Case>& cases,
               const Baseline& baseline, const BaselineEngine& before,
               const std::function<void(double)>& progress) {
  const Case& setup = cases.front();
  const bool flows = hasFlow(setup);
  const Case caseBefore = casesOf(baseline, baseline.setup.file, {}).front();
  const Capabilities can = engine.capabilities();
  DiffRow row;
  row.engine = entry.name;
  row.version = can.version;
  row.before = before.name;
  row.versionBefore = before.version;
  WindowsDiff<D> windows({engine, entry, setup, flows ? timeStep(setup) : 0.0}, caseBefore,
                         baseline, before);
  try {
    for (std::size_t s = 0; s < baseline.starts.size(); ++s) {
      windows.follow(s);
      progress(static_cast<double>(s + 1) / static_cast<double>(baseline.starts.size() + 1));
    }
    auto collisions = collisionChanges(before.collisions, collisionsOf(engine, entry, cases));
    row.sweeps = collisions.sweeps;
    row.collisions = std::move(collisions.changes);
    if (row.sweeps > 0) row.collisionsVerdict = equivalenceOf(row.collisions);
  } catch (const EngineFailure& failure) {
    row.failure = failure.what();
  }
  if (flows) windows.addTo(row);
  row.declared = declaredChanges({before.name, before.can, before.effective},
                                 {entry.name, can, windows.effective()});
  row.verdict = std::max({row.windowsVerdict, row.collisionsVerdict, row.forcesVerdict});
  // Collisions alone do not make a flow the same.
  const bool partly = flows && row.windowsVerdict == Equivalence::notMeasured;
  if (partly && row.verdict != Equivalence::differs) row.verdict = Equivalence::notMeasured;
  return row;
}

}  // namespace

DiffRow diffEngine(Engine& engine, const EngineEntry& entry, const std::vector<Case>& cases,
                   const Baseline& baseline, const BaselineEngine& before,
                   const std::function<void(double)>& progress) {
  return (baseline.dimension == 3 ? diffIn<3> : diffIn<2>)(engine, entry, cases, baseline, before,
                                                           progress);
}

DiffResults diffAgainst(const std::filesystem::path& file,
                        const std::vector<std::string>& overrides, const RunCommand& command) {
  const Baseline baseline = readBaseline(file);
  const std::vector<Case> cases = casesOf(baseline, file, overrides);
  for (const Case& setup : cases) checkEngineSections(setup);
  if (cases.front().dimension != baseline.dimension)
    throw BadInput(fmt::format("{}: case.dimension is {}, not {}: a baseline is of one dimension",
                               file.string(), cases.front().dimension, baseline.dimension));
  const std::vector<EngineEntry> engines = selectEngines(command.engines);
  DiffResults results;
  results.head = headOf(kindDiff, cases.front(), command.commandLine);
  results.head.setup.variant.clear();
  results.baseline = file.string();
  results.baselineVersion = baseline.version;
  results.changedKeys = changedKeys(casesOf(baseline, file, {}), cases);
  results.rules = lockstepRules(cases.front().law);
  for (const FlowState& state : baseline.starts) results.starts.push_back(state.start);
  if (command.dryRun) return results;
  Progress progress(command.quiet);
  progress.begin("running engines", std::vector<double>(engines.size(), 1.0));
  for (std::size_t e = 0; e < engines.size(); ++e) {
    const ScratchFolder scratch;
    const auto engine = startEngine(engines[e], scratch.path, cases.front().run.timeout);
    const auto report = [&](double fraction) { progress.update(e, engines[e].name, fraction); };
    const BaselineEngine& before = keptOf(baseline, engines[e].name);
    results.rows.push_back(diffEngine(*engine, engines[e], cases, baseline, before, report));
    try {
      diffEndpoints(results.rows.back(), engines[e], cases.front(), baseline, before, report);
    } catch (const EngineFailure& failure) {
      if (results.rows.back().failure.empty()) results.rows.back().failure = failure.what();
    }
    progress.finish(e, engines[e].name + ": compared");
  }
  return results;
}

Outcome outcomeOf(const DiffResults& results) {
  bool judged = false, differs = false;
  Outcome outcome;
  for (const DiffRow& row : results.rows) {
    judged |= row.verdict != Equivalence::notMeasured;
    // Passes only what was shown to be the same.
    differs |= row.verdict == Equivalence::differs || row.verdict == Equivalence::undecided;
    if (!row.failure.empty()) outcome.failures.push_back(row.failure);
  }
  if (!outcome.failures.empty())
    outcome.status = exitEngineFailed;
  else if (!judged)
    return notJudged(results.rows.front().reason);
  else if (differs)
    outcome.status = exitFailed;
  return outcome;
}

}  // namespace crossgrain::inline studies
