#include "studies/cost/sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <thread>
#include <tuple>

#include "cases/flow.hpp"
#include "cases/larger_scene.hpp"
#include "cases/preparation.hpp"
#include "studies/core/engine_access.hpp"
#include "studies/core/engine_running.hpp"
#include "studies/core/study.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"
#include "support/numbers.hpp"

namespace crossgrain::inline studies {

std::vector<PlannedTiming> plannedTimings(const std::vector<std::size_t>& bodies,
                                          const std::vector<int>& workers,
                                          const std::vector<bool>& shares) {
  const std::size_t largest = std::ranges::max(bodies);
  std::vector<PlannedTiming> timings;
  for (std::size_t engine = 0; engine < shares.size(); ++engine)
    for (const std::size_t size : bodies) {
      timings.push_back({size, engine, 1});
      if (!shares[engine]) continue;
      for (const int count : workers) {
        timings.push_back({size, engine, count});
        const std::size_t more = size * static_cast<std::size_t>(count);
        if (more <= largest) timings.push_back({more, engine, count});
      }
    }
  std::ranges::sort(timings, {}, [](const PlannedTiming& one) {
    return std::tuple(one.bodies, one.engine, one.workers);
  });
  const auto repeated = std::ranges::unique(timings);
  timings.erase(repeated.begin(), repeated.end());
  return timings;
}

std::vector<int> usualWorkers(unsigned cores) {
  std::vector<int> workers;
  const int most = static_cast<int>(std::max(cores, 1u));
  for (int count = 1; count < most; count *= 2) workers.push_back(count);
  workers.push_back(most);
  return workers;
}

std::vector<std::size_t> sizesOf(const Case& setup, std::size_t own) {
  if (!setup.cost.has("disks")) return {own};
  if (setup.cost.disks.empty()) return {own, 4 * own};
  std::vector<std::size_t> sizes;
  for (const double wanted : setup.cost.disks)
    sizes.push_back(std::max(own, static_cast<std::size_t>(wanted)));
  std::ranges::sort(sizes);
  sizes.erase(std::unique(sizes.begin(), sizes.end()), sizes.end());
  return sizes;
}

namespace {

/// The setting that shares a step among workers: "threads", "ranks"; empty: the engine has neither.
std::string sharingOf(const Case& setup, const std::string& engine, const Capabilities& can) {
  for (const char* name : {"threads", "ranks"}) {
    if (std::ranges::find(can.settings, name, &SettingSpec::name) == can.settings.end()) continue;
    const auto own = setup.engines.find(engine);
    if (!setup.cost.threads.empty() && own != setup.engines.end() && own->second.contains(name))
      throw BadInput(fmt::format("{}: engines.{}.{}: cost.threads says how many there are",
                                 setup.file.string(), engine, name));
    return name;
  }
  return {};
}

/// Of a step that takes so long, so many that a round is timed for some tenths of a second [-].
std::uint64_t stepsFor(double secondsPerStep, double timed) {
  constexpr double rounds = 10.0, least = 50.0, most = 20'000.0;
  return static_cast<std::uint64_t>(
      std::clamp(rounds * timed / std::max(secondsPerStep, 1e-9), least, most));
}

class SizeTimings {
 public:
  SizeTimings(CostStudy& study, double left) : study_(study), left_(left) {}

  std::vector<StepTime> run() {
    const Case& setup = study_.setup;
    own_ = inDimensionOf(setup, [&]<int D>() { return sceneOf<D>(0).disks.size(); });
    plan();
    rounds_.resize(times_.size());
    for (int round = 0; round < setup.cost.repeats; ++round)
      for (std::size_t from = 0, to = 0; from < times_.size(); from = to) {
        while (to < times_.size() && wanted_[to] == wanted_[from]) ++to;
        inDimensionOf(setup, [&]<int D>() { roundOf<D>(from, to, round); });
      }
    for (std::size_t k = 0; k < times_.size(); ++k) summarise(times_[k], rounds_[k]);
    for (StepTime& time : times_)
      if (time.status == Status::notRun) time.reason += forecastText(time);
    return times_;
  }

 private:
  void plan() {
    const Case& setup = study_.setup;
    std::vector<bool> shares;
    std::vector<std::size_t> engines;
    std::vector<std::string> sharing;
    for (std::size_t e = 0; e < study_.engines.size(); ++e) {
      if (!study_.engines[e].takesPart) continue;
      engines.push_back(e);
      sharing.push_back(setup.cost.has("threads")
                            ? sharingOf(setup, study_.entryOf(e).name, study_.canOf(e))
                            : "");
      shares.push_back(!sharing.back().empty());
    }
    if (engines.empty()) return;
    std::vector<int> workers = usualWorkers(std::thread::hardware_concurrency());
    if (!setup.cost.threads.empty())
      workers.assign(setup.cost.threads.begin(), setup.cost.threads.end());
    for (const PlannedTiming& one : plannedTimings(sizesOf(setup, own_), workers, shares)) {
      StepTime time;
      const std::size_t e = engines[one.engine];
      time.engine = study_.entryOf(e).name;
      time.bodies = one.bodies;
      time.workers = one.workers;
      time.workersAre = sharing[one.engine];
      time.steps = stepsFor(study_.engines[e].scene.step * static_cast<double>(one.bodies) /
                                static_cast<double>(own_),
                            setup.cost.timed);
      engines_.push_back(e);
      wanted_.push_back(one.bodies);
      times_.push_back(std::move(time));
    }
  }

  /// From a state along the flow, where contacts are as they are in it.
  template <int D>
  SceneOf<D> sceneOf(std::size_t bodies) {
    return largerFlow<D>(study_.setup, study_.trajectoryStarts().front(), study_.campaign.dt(),
                         bodies, packingCache(), [](double) { throwIfInterrupted(); });
  }

  std::string nameOf(std::size_t k, int round) const {
    return fmt::format("steps-{}-{}-bodies-{}-r{}", times_[k].engine, wanted_[k], times_[k].workers,
                       round);
  }
  /// Without the number of steps, which follows a timing and differs in every call.
  CaseKeys keyOf(std::size_t k) const {
    return study_.campaign.keyOf(engines_[k], 0, "cost: time of a step");
  }

  /// One round of all timings of one size, which share a scene.
  template <int D>
  void roundOf(std::size_t from, std::size_t to, int round) {
    std::optional<SceneOf<D>> scene;
    for (std::size_t k = from; k < to; ++k) {
      if (times_[k].status != Status::finished) continue;
      if (const auto kept = study_.campaign.store().findAs<StepTime>(nameOf(k, round), keyOf(k))) {
        rounds_[k].push_back(*kept);
        times_[k].bodies = kept->bodies;  // further rounds repeat it
        times_[k].steps = kept->steps;
        continue;
      }
      throwIfInterrupted();
      try {
        if (const std::string why = whyNotRun(k); !why.empty()) {
          if (rounds_[k].size() < 2) end(k, Status::notRun, why);
          continue;
        }
        if (!scene) {
          scene = sceneOf<D>(wanted_[k]);
          for (std::size_t same = from; same < to; ++same)
            times_[same].bodies = scene->disks.size();
        }
        const double before = study_.campaign.elapsed();
        rounds_[k].push_back(timed<D>(k, *scene));
        left_ -= study_.campaign.elapsed() - before;
        study_.campaign.store().keep(nameOf(k, round), keyOf(k), jsonOf(rounds_[k].back()));
      } catch (const UnsupportedScene& refusal) {
        if (!scene)  // of every engine alike
          for (std::size_t same = from; same < to; ++same)
            end(same, Status::refused, refusal.what());
        else
          end(k, Status::refused, refusal.what());
      } catch (const EngineFailure& failure) {
        end(k, Status::failed, failure.what());
        study_.engineFailures.push_back(failure.what());
      }
    }
  }

  void end(std::size_t k, Status status, const std::string& reason) {
    times_[k].status = status;
    times_[k].reason = BadInput(reason).what();  // in one line
  }

  /// What it would take, by smaller sizes.
  std::string forecastText(const StepTime& time) const {
    const auto forecast = stepForecast(times_, time);
    if (!forecast) return "; two smaller sizes beside it (--disks) would tell what it takes";
    std::string text = fmt::format(
        "; by {} and {} bodies {} would take at least {:.2g} s a step, more where caches hold the "
        "smaller scenes alone",
        forecast->smaller, forecast->larger, describeWorkers(time), forecast->least);
    if (forecast->memory) text += fmt::format("; {:.2g} GB of memory", 1e-9 * *forecast->memory);
    return text;
  }

  /// A round that there is neither time nor memory for; empty: there is.
  std::string whyNotRun(std::size_t k) const {
    const StepTime& time = times_[k];
    const TimedEngine& engine = study_.engines[engines_[k]];
    const double larger = static_cast<double>(time.bodies) / static_cast<double>(own_);
    const double takes =
        engine.start +
        larger * (engine.scene.load + engine.scene.step * 1.1 * static_cast<double>(time.steps));
    if (takes > left_)
      return fmt::format("would take about {:.3g} s, {:.3g} s are left of the budget", takes,
                         std::max(left_, 0.0));
    const auto available = availableMemory();
    for (std::size_t smaller = k; smaller-- > 0 && available;) {
      const StepTime& other = times_[smaller];
      if (other.engine != time.engine || other.workers != time.workers || rounds_[smaller].empty())
        continue;
      // Of a small scene most is the program itself, which does not grow.
      constexpr std::size_t large = 100'000;
      const double expected = rounds_[smaller].front().memory.value_or(0.0) *
                              static_cast<double>(time.bodies) / static_cast<double>(other.bodies);
      if (other.bodies < large || expected < static_cast<double>(*available)) break;
      return fmt::format("would take {:.3g} GB of memory, {:.3g} GB are available", 1e-9 * expected,
                         1e-9 * static_cast<double>(*available));
    }
    return {};
  }

  /// @throws UnsupportedScene, EngineFailure, Interrupted
  template <int D>
  StepTime timed(std::size_t k, const SceneOf<D>& scene) {
    StepTime time = times_[k];
    const EngineEntry& entry = study_.entryOf(engines_[k]);
    study_.campaign.progress().say(fmt::format("timing steps: {}, {}, {}", time.engine,
                                               counted(time.bodies, "body"),
                                               describeWorkers(time)));
    time.measured = timeStamp();
    Case setup = study_.setup;
    // Loading, or a tenth of the steps, a hundred times slower than the in-house engine.
    const auto bodies = static_cast<double>(time.bodies);
    setup.run.timeout =
        std::max(setup.run.timeout,
                 60.0 + 1e-3 * bodies + 2.5e-7 * bodies * static_cast<double>(time.steps));
    if (!time.workersAre.empty())
      setup.engines[entry.name][time.workersAre] = static_cast<double>(time.workers);
    const auto engine =
        startNew(entry, study_.campaign.store().scratch(entry.name + "-steps"), setup.run.timeout);
    const EffectiveParameters effective = loadScene(*engine, entry, setup, scene);
    const double warmUp = std::max(5.0, static_cast<double>(time.steps) / 10.0) * effective.dt;
    advanceInPieces(*engine, effective, 0.0, warmUp);
    const Stats before = engine->stats();
    advanceInPieces(*engine, effective, warmUp,
                    warmUp + static_cast<double>(time.steps) * effective.dt);
    const StepCost cost = costBetween(before, engine->stats());
    time.seconds = {cost.wall};
    time.contacts = cost.contacts;
    if (const auto memory = mostMemoryOf(*engine)) time.memory = static_cast<double>(*memory);
    time.dt = effective.dt;
    time.precision = effective.precision;
    for (const Deviation& deviation : effective.deviations) time.differs.push_back(deviation.name);
    return time;
  }

  static void summarise(StepTime& time, const std::vector<StepTime>& rounds) {
    if (rounds.empty() || time.status != Status::finished) return;
    time = rounds.front();
    time.seconds.clear();
    for (const StepTime& round : rounds) {
      time.seconds.push_back(round.seconds.front());
      if (round.memory) time.memory = std::max(time.memory.value_or(0.0), *round.memory);
    }
    const GeometricMean mean = geometricMean(time.seconds);
    time.step = mean.mean;
    time.low = mean.low;
    time.high = mean.high;
  }

  CostStudy& study_;
  double left_;          ///< [s]
  std::size_t own_ = 0;  ///< bodies of the scene as it is
  std::vector<StepTime> times_;
  std::vector<std::size_t> wanted_;            ///< of times_: bodies; a scene may have some more
  std::vector<std::size_t> engines_;           ///< of times_: their places
  std::vector<std::vector<StepTime>> rounds_;  ///< likewise
};

}  // namespace

std::vector<StepTime> timeSizes(CostStudy& study, double left) {
  return SizeTimings(study, left).run();
}

}  // namespace crossgrain::inline studies
