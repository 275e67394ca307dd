#include "studies/stability/transforms.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include "adapters/worker/json.hpp"
#include "results/scene_picture.hpp"
#include "results/stability.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/lockstep/separation.hpp"
#include "studies/lockstep/window.hpp"
#include "studies/stability/run.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace {

double secondsSince(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

}  // namespace

void TimeShare::require(double seconds) const {
  if (const double left = all_ - secondsSince(began_); !(seconds <= left))
    throw OutOfTime(fmt::format("its part of the budget, {:.3g} s, leaves no time for it", all_));
}

TimeShare TimeBudget::next() {
  const std::scoped_lock lock(mutex_);
  const double left = std::max(0.0, all_ - secondsSince(began_));
  const double parts = static_cast<double>(std::max(pieces_, std::size_t{1}));
  if (pieces_ > 0) --pieces_;
  return TimeShare(left * std::min(1.0, static_cast<double>(jobs_) / parts));
}

namespace {

/// A unit of SI and its powers of length, mass and time.
struct Dimension {
  std::string_view unit;
  int length, mass, time;
};
constexpr std::array dimensions = {
    Dimension{"", 0, 0, 0},       Dimension{"-", 0, 0, 0},
    Dimension{"rad", 0, 0, 0},    Dimension{"m", 1, 0, 0},
    Dimension{"s", 0, 0, 1},      Dimension{"kg", 0, 1, 0},
    Dimension{"m/s", 1, 0, -1},   Dimension{"m/s²", 1, 0, -2},
    Dimension{"1/s", 0, 0, -1},   Dimension{"/s", 0, 0, -1},
    Dimension{"Hz", 0, 0, -1},    Dimension{"rad/s", 0, 0, -1},
    Dimension{"N", 1, 1, -2},     Dimension{"N/m", 0, 1, -2},
    Dimension{"kg/s", 0, 1, -1},  Dimension{"Pa", -1, 1, -2},
    Dimension{"J", 2, 1, -2},     Dimension{"1/m", -1, 0, 0},
    Dimension{"kg/m³", -3, 1, 0}, Dimension{"smallest radius", 0, 0, 0}};

}  // namespace

std::optional<double> factorOf(const std::string& unit, const Units& units) {
  const auto found = std::ranges::find(dimensions, unit, &Dimension::unit);
  if (found == dimensions.end()) return std::nullopt;
  return units.of(found->length, found->mass, found->time);
}

Settings inUnits(Settings settings, const std::vector<SettingSpec>& specs, const Units& units) {
  if (units == Units{}) return settings;
  for (const SettingSpec& spec : specs) {
    const auto said = settings.find(spec.name);
    const SettingValue value = said == settings.end() ? spec.defaultValue : said->second;
    const auto* number = std::get_if<double>(&value);
    if (!number || *number == 0.0) continue;
    const auto factor = factorOf(spec.unit, units);
    if (!factor)
      throw UnsupportedScene(fmt::format("how its setting {} scales is not known: its unit is '{}'",
                                         spec.name, spec.unit));
    if (*factor != 1.0) settings[spec.name] = *number * *factor;
  }
  return settings;
}

std::vector<CaseTransform> caseTransforms(std::size_t disks, int dimension) {
  const int degrees = dimension == 2 ? 90 : 120;
  const auto turned = [](double angle) { return Transform{.placement = {.turn = angle}}; };
  const auto inUnitsOf = [](Units units) { return Transform{.units = units}; };
  const std::string rescaled = "In other units the same happens: nothing has a unit of its own.";
  return {{"turned", fmt::format("turned by {}°", degrees), "A turned scene does the same, turned.",
           turned(degrees / 180.0 * std::numbers::pi)},
          {"turned", "turned by 1 rad", "A turned scene does the same, turned.", turned(1.0)},
          {"mirrored",
           "mirrored",
           "A mirrored scene does the same, mirrored.",
           {.placement = {.mirror = true}}},
          {"rescaled", "lengths by 2⁻¹⁰", rescaled, inUnitsOf({.length = transformSmaller})},
          {"rescaled", "masses by 2⁻¹⁰", rescaled, inUnitsOf({.mass = transformSmaller})},
          {"rescaled", "times by 2¹⁰", rescaled, inUnitsOf({.time = transformSlower})},
          {"renumbered",
           "renumbered",
           "No body is another for its number.",
           {.order = shuffledOrder(disks, transformSeed)}},
          {"restarted",
           "restarted",
           "Restarted from a checkpoint in its middle a run goes on as if uninterrupted.",
           {},
           TransformRun::restart},
          {"split", "in one go", "A snapshot changes nothing.", {}, TransformRun::oneGo}};
}

namespace {

double epsilonOf(const EffectiveParameters& effective) {
  return effective.precision == toString(Precision::float32)
             ? static_cast<double>(std::numeric_limits<float>::epsilon())
             : std::numeric_limits<double>::epsilon();
}

/// How far two frames of one scene are apart: disks by places, and by as far as a rim has turned
/// with the difference of spins [d].
double sizeOf(double value) {
  return std::abs(value);
}
double sizeOf(const Vec3& value) {
  return value.norm();
}

template <int D>
Farthest apart(const LockstepFrameOf<D>& one, const LockstepFrameOf<D>& other, double diameter) {
  Farthest worst = farthest(one, other, diameter);
  for (std::size_t i = 0; i < std::min(one.spin.size(), other.spin.size()); ++i) {
    const SpinOf<D> off = one.spin[i] - other.spin[i];
    const double turn = 0.5 * one.time * sizeOf(off);
    if (turn > worst.distance) worst = {i, turn};
  }
  return worst;
}

/// One engine and one scene: the run as it is, what rounding may do to it, and runs that must go
/// the same way.
template <int D>
class Trial {
 public:
  Trial(const StabilityTask& task, const HardSceneOf<D>& hard, const TimeShare& time)
      : task_(task), hard_(hard), time_(time), diameter_(smallestDiameter(hard.scene)) {
    const EffectiveParameters effective = load(hard.scene, {});
    dt_ = effective.dt;
    const double all = std::round(hard.duration / dt_);
    last_ = static_cast<std::uint64_t>(std::clamp(all, 1.0, static_cast<double>(transformSteps)));
    steps_ = stepsUpTo(last_);
    original_ = followInTime();
    rounding(epsilonOf(effective));
  }

  /// Runs it and fills the row.
  /// @throws UnsupportedScene, EngineFailure, BadInput, OutOfTime, Interrupted
  void judge(StabilityRun& row, const CaseTransform& transform) {
    if (blind_ == 0) {
      const double limit = limits_.front();
      throw UnsupportedScene(
          fmt::format("its own rounding may separate two runs by {:.2g} d within {} steps: no "
                      "difference can be seen",
                      limit, steps_.front()));
    }
    time_.require(took_);
    switch (transform.run) {
      case TransformRun::another:
        return compare(row, another(transform.change), 0);
      case TransformRun::restart:
        return compare(row, restarted(), original_.size() / 2);
      case TransformRun::oneGo:
        return compare(row, inOneGo(), original_.size() - 1);
    }
  }

 private:
  ContactReport contacts() const {
    return can_.instantContacts ? ContactReport::instant : ContactReport::none;
  }

  /// As the case lets the engine run it, its settings in the same units.
  EffectiveParameters loadInto(Engine& engine, const SceneOf<D>& scene, const Units& units) {
    can_ = engine.capabilities();
    const AdaptedOf<D> adapted = sceneFor(can_, task_.entry, *task_.setup, scene);
    const Settings settings = settingsFor(*task_.setup, task_.entry.name, can_);
    return loadOn<D>(engine, adapted.scene, inUnits(settings, can_.settings, units));
  }

  /// A worker that failed before is not asked again.
  EffectiveParameters load(const SceneOf<D>& scene, const Units& units) {
    if (!engine_)
      engine_ = startAudited(task_.entry, task_.scratch / "worker", task_.setup->run.timeout);
    return loadInto(*engine_, scene, units);
  }

  template <typename Work>
  auto work(Work&& with) {
    try {
      return with();
    } catch (const EngineFailure&) {
      engine_.reset();
      throw;
    }
  }

  /// The run as it is, given up where the next frame would come too late, as the speed of the
  /// engine is not known yet. @throws OutOfTime
  std::vector<LockstepFrameOf<D>> followInTime() {
    using Clock = std::chrono::steady_clock;
    const auto began = Clock::now();
    auto soFar = [&] { return std::chrono::duration<double>(Clock::now() - began).count(); };
    std::vector<LockstepFrameOf<D>> frames =
        follow<D>(*engine_, dt_, steps_, contacts(), [&](std::uint64_t done, std::uint64_t step) {
          const auto more = static_cast<double>(step - done);
          time_.require(done == 0 ? 0.0 : soFar() * more / static_cast<double>(done));
        });
    took_ = soFar();
    return frames;
  }

  std::vector<LockstepFrameOf<D>> nudgedRun(double epsilon, std::uint64_t seed) {
    SceneOf<D> scene = hard_.scene;
    scene.disks = nudged(scene.disks, epsilon, seed);
    time_.require(took_);
    load(scene, {});
    return near(follow<D>(*engine_, dt_, steps_), 0);
  }

  /// limits_: what rounding may do, frame by frame [d].
  void rounding(double epsilon) {
    const double nudge = epsilon * extentOf(hard_.scene) / diameter_;
    std::vector<double> once(steps_.size(), nudge);
    for (int n = 0; n < transformNudges; ++n) {
      const auto moved = nudgedRun(epsilon, transformSeed + static_cast<std::uint64_t>(n));
      double most = 0.0;
      for (std::size_t k = 0; k < steps_.size(); ++k) {
        most = std::max(most, apart(moved[k], original_[k], diameter_).distance);
        once[k] = std::max(once[k], most);
      }
    }
    for (std::size_t k = 0; k < steps_.size(); ++k)
      limits_.push_back((1.0 + static_cast<double>(steps_[k])) * once[k]);
    // All roundings at once, to either side: a force that jumps where two bodies touch begins a
    // step earlier or later, which no smaller nudge shows.
    for (const double side : {1.0, -1.0}) {
      const double all = side * epsilon * (1.0 + static_cast<double>(steps_.back()));
      const auto moved = nudgedRun(all, transformSeed);
      double most = 0.0;
      for (std::size_t k = 0; k < steps_.size(); ++k) {
        most = std::max(most, apart(moved[k], original_[k], diameter_).distance);
        limits_[k] = std::max(limits_[k], most);
      }
    }
    blind_ = static_cast<std::size_t>(
        std::ranges::find_if(limits_, [](double limit) { return !(limit <= transformBlind); }) -
        limits_.begin());
  }

  std::vector<LockstepFrameOf<D>> another(const Transform& change) {
    return work([&] {
      if (!change.order.empty() && change.order.size() < 2)
        throw UnsupportedScene("a single disk has one number only");
      if (hard_.scene.box && !turnsBox<D>(change.placement))
        throw UnsupportedScene("a periodic box lies along the axes: it cannot be turned so");
      if (!hard_.scene.shapes.empty() && (change.placement.mirror || change.placement.turn != 0.0))
        throw UnsupportedScene("convex bodies are neither turned nor mirrored");
      const EffectiveParameters effective = load(transformed(hard_.scene, change), change.units);
      const double dt = dt_ * change.units.time;
      if (std::abs(effective.dt - dt) > 1e-12 * dt)
        throw UnsupportedScene(fmt::format(
            "takes time steps of its own, {:g} s where {:g} s are the same", effective.dt, dt));
      std::vector<LockstepFrameOf<D>> frames =
          follow<D>(*engine_, effective.dt, steps_, contacts());
      for (LockstepFrameOf<D>& frame : frames) {
        frame.position = placesBack(change, frame.position);
        frame.spin = spinsBack<D>(change, frame.spin);
      }
      return frames;
    });
  }

  /// From the frame in the middle on.
  std::vector<LockstepFrameOf<D>> restarted() {
    if (!can_.checkpoints) throw UnsupportedScene("has no checkpoints");
    if (steps_.size() < 3) throw UnsupportedScene("the case is too short to have a middle");
    return work([&] {
      const std::size_t middle = steps_.size() / 2;
      const auto file = task_.scratch / "middle";
      load(hard_.scene, {});
      engine_->advance(static_cast<double>(steps_[middle]) * dt_);
      engine_->checkpoint(file);
      const auto second = audited(task_.entry.name, startNew(task_.entry, task_.scratch / "second",
                                                             task_.setup->run.timeout));
      loadInto(*second, hard_.scene, {});
      second->restore(file);
      return follow<D>(*second, dt_, {steps_.begin() + static_cast<long>(middle), steps_.end()},
                       contacts());
    });
  }

  std::vector<LockstepFrameOf<D>> inOneGo() {
    return work([&] {
      load(hard_.scene, {});
      return follow<D>(*engine_, dt_, {last_}, contacts());
    });
  }

  /// The frames with the images of all places that are nearest to the run's.
  /// @param from  index of the first of the frames
  std::vector<LockstepFrameOf<D>> near(std::vector<LockstepFrameOf<D>> frames,
                                       std::size_t from) const {
    if (const auto& box = hard_.scene.box)
      for (std::size_t k = 0; k < frames.size(); ++k)
        for (std::size_t i = 0; i < frames[k].position.size(); ++i) {
          const VecOf<D>& place = original_[from + k].position[i];
          frames[k].position[i] = place + box->nearest(frames[k].position[i] - place);
        }
    return frames;
  }

  void compare(StabilityRun& row, std::vector<LockstepFrameOf<D>> seen, std::size_t from) {
    const std::vector<LockstepFrameOf<D>> frames = near(std::move(seen), from);
    if (from >= blind_)
      throw UnsupportedScene(
          fmt::format("its own rounding may separate two runs by more than {:g} d from step {} on: "
                      "nothing is compared",
                      transformBlind, steps_[blind_]));
    double worst = -1.0;
    std::size_t disk = 0;
    bool bits = true;
    for (std::size_t k = from; k < std::min(blind_, from + frames.size()); ++k) {
      const Farthest off = apart(frames[k - from], original_[k], diameter_);
      const double time = static_cast<double>(steps_[k]) * dt_;
      row.curve.time.push_back(time);
      row.curve.value.push_back(off.distance);
      bits = bits && off.distance == 0.0;
      if (off.distance > limits_[k] && !row.step) {
        row.step = static_cast<long long>(steps_[k]);
        row.time = time;
      }
      if (off.distance / limits_[k] <= worst) continue;
      worst = off.distance / limits_[k];
      row.value = off.distance;
      row.limit = limits_[k];
      row.worstTime = time;
      disk = off.disk;
    }
    row.verdict = worst > 1.0 ? Verdict::fail : Verdict::pass;
    row.reason = worst > 1.0 ? fmt::format("body {} is where it should not be", disk)
                 : bits      ? "the same to the bit"
                             : "";
    if (blind_ < steps_.size())
      row.reason += fmt::format("{}compared up to step {}", row.reason.empty() ? "" : "; ",
                                steps_[blind_ - 1]);
  }

  const StabilityTask& task_;
  const HardSceneOf<D>& hard_;
  const TimeShare& time_;
  double took_ = 0.0;  ///< the run as it is [s]
  double diameter_;    ///< d [m]
  double dt_ = 0.0;    ///< the engine's [s]
  std::uint64_t last_ = 0;
  std::unique_ptr<Engine> engine_;
  Capabilities can_;
  std::vector<std::uint64_t> steps_;  ///< of the frames
  std::vector<LockstepFrameOf<D>> original_;
  std::vector<double> limits_;
  std::size_t blind_ = 0;  ///< the first snapshot at which nothing can be compared any more
};

StabilityRun rowOf(const StabilityTask& task, const CaseTransform& transform) {
  StabilityRun row;
  row.engine = task.entry.name;
  row.name = task.setup->name;
  row.variant = variantOf(*task.setup, transform);
  row.measure = transform.measure;
  row.unit = "d";
  row.limit = row.degradedLimit = std::numeric_limits<double>::quiet_NaN();
  return row;
}

}  // namespace

std::string variantOf(const Case& setup, const CaseTransform& transform) {
  return setup.variant.empty() ? transform.name
                               : fmt::format("{}, {}", setup.variant, transform.name);
}

std::vector<HardCase> transformRows(const Case& setup) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<HardCase> rows;
  for (const CaseTransform& transform : caseTransforms(0, setup.dimension))
    rows.push_back({setup.name, variantOf(setup, transform), setup.file.string(), transform.must,
                    transform.measure, "farthest a body is from where the case itself has it", "d",
                    none, none,
                    fmt::format("a run's limit is what rounding may do to it: 1 + n times the "
                                "farthest of {} runs whose start is nudged by a rounding, after "
                                "n steps, or the farther of two that are nudged by all at once",
                                transformNudges),
                    setup.resolvedToml});
  return rows;
}

namespace {

template <int D>
std::vector<StabilityRun> transformsIn(const StabilityTask& task, const TimeShare& time,
                                       const std::function<void(double)>& progress) {
  std::optional<HardSceneOf<D>> hard;
  std::optional<Trial<D>> trial;
  StabilityRun before;
  judged(before, [&] {
    if (!task.unprepared.empty()) throw BadInput(task.unprepared);
    hard = plainScene<D>(*task.setup, *task.packing);
    trial.emplace(task, *hard, time);
  });
  std::vector<StabilityRun> rows;
  const auto all = caseTransforms(hard ? hard->scene.disks.size() : 0, D);
  for (const CaseTransform& transform : all) {
    StabilityRun row = rowOf(task, transform);
    if (trial) {
      judged(row, [&] { trial->judge(row, transform); });
    } else {
      row.status = before.status;
      row.verdict = before.verdict;
      row.reason = before.reason;
    }
    rows.push_back(std::move(row));
    progress(static_cast<double>(rows.size()) / static_cast<double>(all.size()));
  }
  return rows;
}

}  // namespace

std::vector<StabilityRun> runTransforms(const StabilityTask& task, const TimeShare& time,
                                        const std::function<void(double)>& progress) {
  return inDimensionOf(*task.setup, [&]<int D>() { return transformsIn<D>(task, time, progress); });
}

void judgeInvariances(StabilityRun& row, const StabilityTask& task,
                      const std::function<void(double)>& progress) {
  std::vector<std::string> broken;
  std::optional<double> worst;
  for (const StabilityRun& one : runTransforms(task, TimeShare(), progress)) {
    if (one.status == Status::failed) throw EngineFailure(one.reason);
    if (!one.value) continue;
    worst = std::max(worst.value_or(0.0), *one.value / one.limit);
    if (one.verdict == Verdict::fail) broken.push_back(one.variant);
  }
  if (!worst) throw UnsupportedScene("none of its changes could be compared");
  row.value = worst;
  row.verdict = broken.empty() ? Verdict::pass : Verdict::fail;
  row.reason = fmt::format("{}", fmt::join(broken, "; "));
}

}  // namespace crossgrain::inline studies
