#include "studies/cost/collision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "averaging/agreement.hpp"
#include "averaging/statistics.hpp"
#include "cases/time_step.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

namespace {

/// Of the pairs of a sweep.
std::vector<std::optional<double>> numbersOf(const CollisionTable& table, QuantityId quantity) {
  std::vector<std::optional<double>> numbers;
  for (std::size_t k = 0; k < table.size(); ++k) numbers.push_back(table.at(quantity, k));
  return numbers;
}

/// Unit of that quantity's errors, as in `collide` [its unit].
double unitOf(const PairCurve& pair, QuantityId quantity) {
  std::vector<double> known;
  for (const auto& number :
       numbersOf(tableOf(pair.starts, referenceOf(pair.oracle), /*convex=*/false), quantity))
    if (number) known.push_back(*number);
  return errorUnit(known).value;
}

/// @param of  by pair
CollisionNumbers numbersOf(const CollisionReference& reference, const std::vector<Outcomes>& of) {
  CollisionNumbers numbers;
  for (std::size_t p = 0; p < reference.pairs.size(); ++p) {
    const CollisionTable table = tableOf(reference.pairs[p].starts, of[p], /*convex=*/false);
    for (const QuantityId quantity : collisionMeasures)
      std::ranges::copy(numbersOf(table, quantity),
                        std::back_inserter(numbers[std::string(collisionQuantity(quantity).name)]));
  }
  return numbers;
}

/// Of the case's law.
CollisionNumbers sceneNumbers(const CollisionReference& reference) {
  std::vector<Outcomes> of;
  for (const PairCurve& pair : reference.pairs) of.push_back(referenceOf(pair.oracle));
  return numbersOf(reference, of);
}

/// Of the pair for which it is largest, with the worst of all; absent where one lacks a number that
/// the other has, or no pair has any.
std::optional<CurveError> largestError(const CollisionReference& reference, QuantityId quantity,
                                       const CollisionNumbers& numbers,
                                       const CollisionNumbers& from) {
  const std::string name(collisionQuantity(quantity).name);
  std::optional<CurveError> largest;
  std::size_t first = 0;
  for (const PairCurve& pair : reference.pairs) {
    const auto of = [&](const CollisionNumbers& all) {
      const auto begin = all.at(name).begin() + static_cast<std::ptrdiff_t>(first);
      return std::vector(begin, begin + static_cast<std::ptrdiff_t>(pair.starts.size()));
    };
    const auto own = of(numbers), other = of(from);
    first += pair.starts.size();
    if (std::ranges::none_of(other, [](const auto& number) { return bool(number); })) continue;
    const auto error = curveError(own, other, unitOf(pair, quantity));
    if (!error) return std::nullopt;
    const double worst = std::max(error->worst, largest ? largest->worst : 0.0);
    if (!largest || error->rms > largest->rms) largest = error;
    largest->worst = worst;
  }
  return largest;
}

/// Why a sweep says nothing about the case, empty if it does.
std::string failureOf(const CollisionReference& reference, const std::vector<Outcomes>& found,
                      const Case& setting, double dt) {
  const double ofLimit = dt / pairLimit(setting);
  const std::string limit =
      ofLimit > 1.0 ? fmt::format("{} (dt = {:.3g} · 2/ω): ", beyondLimit, ofLimit) : "";
  int missing = 0;
  double largest = 0.0;
  for (std::size_t p = 0; p < found.size(); ++p)
    for (std::size_t k = 0; k < found[p].size(); ++k) {
      const auto& expected = reference.pairs[p].oracle.ends[k];
      missing += !found[p][k] && !(expected && !expected->parted);
      if (found[p][k]) largest = std::max(largest, std::abs(found[p][k]->end.en));
    }
  if (missing > 0) return fmt::format("{}{} pairs did not part", limit, missing);
  if (largest > 1.0)
    return fmt::format("{}pairs part {:.3g} times as fast as they met",
                       limit.empty() ? fmt::format("{}: ", beyondLimit) : limit, largest);
  return {};
}

/// The case with a step, of an engine that has its own and of all others [s].
Case inSteps(Case setup, const EngineEntry& entry, const Capabilities& can, double step) {
  if (stepOfItsOwn(setup, entry.name, can))
    setup.engines[entry.name]["dt"] = step;
  else
    setup.run.dt = step;
  return setup;
}

}  // namespace

std::optional<CurveError> curveError(const std::vector<std::optional<double>>& numbers,
                                     const std::vector<std::optional<double>>& from, double unit) {
  std::vector<std::optional<double>> squares;
  double largest = 0.0;
  for (std::size_t k = 0; k < std::min(numbers.size(), from.size()); ++k) {
    if (!from[k]) continue;
    if (!numbers[k]) return std::nullopt;
    const double error = (*numbers[k] - *from[k]) / unit;
    squares.emplace_back(error * error);
    largest = std::max(largest, std::abs(error));
  }
  const auto mean = ensembleMean(squares);
  if (!mean) return std::nullopt;
  constexpr double confidence = 0.95;
  const double half = mean->standardError
                          ? *mean->standardError * studentQuantile(confidence, mean->packings - 1)
                          : 0.0;
  return CurveError{std::sqrt(mean->mean), std::sqrt(std::max(0.0, mean->mean - half)),
                    std::sqrt(mean->mean + half), largest};
}

CollisionLimit collisionLimit(Engine& engine, const EngineEntry& entry, const Case& fine,
                              const Case& coarse, const CollisionReference& reference) {
  CollisionLimit limit;
  CollisionNumbers half;
  std::vector<Outcomes> declared;
  const std::vector<Case> collisions = collisionsOf(fine);
  for (std::size_t p = 0; p < collisions.size(); ++p) {
    const auto& starts = reference.pairs[p].starts;
    const auto law = lawDeclared(engine, entry, collisions[p], starts);
    if (!law) break;
    Case own = collisions[p];
    own.law = *law;
    const OracleCurve oracle = oracleCurve(own, starts);
    if (std::ranges::none_of(oracle.ends, [](const auto& end) { return bool(end); })) break;
    declared.push_back(referenceOf(oracle));
  }
  if (declared.size() == collisions.size()) {
    limit.setting = "oracle of the law that it declares";
    limit.ends = half = numbersOf(reference, declared);
  } else {
    const Capabilities can = engine.capabilities();
    for (const auto& [setup, numbers] :
         {std::pair(&coarse, &half), std::pair(&fine, &limit.ends)}) {
      const double step = engineStep(*setup, entry.name, can);
      const PairOutcomes found = runPairs(engine, entry, collisionsOf(*setup), reference, step, 0);
      limit.setting = fmt::format("t_c/{:g}", std::round(costContactTime(*setup) / found.dt));
      if (const std::string why = failureOf(reference, found.of, *setup, found.dt); !why.empty())
        return {limit.setting, {}, {}, {}, fmt::format("at {} {}", limit.setting, why)};
      *numbers = numbersOf(reference, found.of);
    }
  }
  const CollisionNumbers scene = sceneNumbers(reference);
  for (const QuantityId quantity : collisionMeasures) {
    const std::string name(collisionQuantity(quantity).name);
    if (const auto error = largestError(reference, quantity, limit.ends, half))
      limit.error[name] = error->rms;
    if (const auto model = largestError(reference, quantity, limit.ends, scene))
      limit.model[name] = model->rms;
  }
  return limit;
}

namespace {

/// Of one sweep of the first pair among `copies` that run side by side.
CostRun timeSweeps(Engine& engine, const EngineEntry& entry, const Case& pair,
                   const std::vector<CollisionStart>& starts, int copies) {
  const double dt = timeStep(pair);
  std::vector<CollisionStart> many;
  for (int k = 0; k < copies; ++k) many.insert(many.end(), starts.begin(), starts.end());
  const EffectiveParameters effective =
      pair.dimension == 3 ? loadScene(engine, entry, pair, spaceCollisionScene(pair, many, dt))
                          : loadScene(engine, entry, pair, collisionScene(pair, many, dt));
  engine.advance(sweepEnd(pair, dt, effective.dt));
  const Stats stats = engine.stats();
  return {effective.dt, stats.wallSeconds / copies, stats.cpuSeconds / copies, stats.steps,
          stats.contactEvaluations / static_cast<std::uint64_t>(copies)};
}

/// Long enough to be measured.
CostRun timedSweep(Engine& engine, const EngineEntry& entry, const Case& pair,
                   const std::vector<CollisionStart>& starts) {
  constexpr double mostCopies = 50.0;
  throwIfInterrupted();
  const CostRun single = timeSweeps(engine, entry, pair, starts, 1);
  const double took =
      std::max(single.cpuSeconds > 0.0 ? single.cpuSeconds : single.wallSeconds, 1e-6);
  const int copies = static_cast<int>(std::min(std::ceil(pair.cost.timed / took), mostCopies));
  return copies <= 1 ? single : timeSweeps(engine, entry, pair, starts, copies);
}

/// Keeps the largest rms over the steps of a cycle, and the worst of all.
void raise(std::vector<std::optional<double>>& kept, const std::optional<CurveError>& error) {
  if (!error) {
    kept.assign(4, std::nullopt);
    return;
  }
  const double worst = kept.empty() ? error->worst : std::max(*kept[3], error->worst);
  if (kept.empty() || error->rms > *kept[0]) kept = {error->rms, error->low, error->high, {}};
  kept[3] = worst;
}

/// Against the case's law and against the engine's own limit. @returns why there are none
std::string addErrors(CostRun& run, Engine& engine, const EngineEntry& entry,
                      const CostSetting& setting, const CollisionReference& reference,
                      const CollisionLimit& own) {
  const Capabilities can = engine.capabilities();
  const double step = engineStep(setting.setup, entry.name, can);
  const CollisionNumbers scene = sceneNumbers(reference);
  std::size_t collisions = 0;
  for (const PairCurve& pair : reference.pairs) collisions += pair.starts.size();
  for (int j = 0; j < cycleSteps; ++j) {
    throwIfInterrupted();
    const double shorter = cycleStep(step, costContactTime(setting.setup), j);
    const PairOutcomes found =
        runPairs(engine, entry, collisionsOf(inSteps(setting.setup, entry, can, shorter)),
                 reference, shorter, static_cast<std::size_t>(j) * collisions);
    if (std::string why = failureOf(reference, found.of, setting.setup, step); !why.empty())
      return why;
    const CollisionNumbers numbers = numbersOf(reference, found.of);
    for (const QuantityId quantity : collisionMeasures) {
      const std::string name(collisionQuantity(quantity).name);
      const auto add = [&](const std::string& measure, const CollisionNumbers& from) {
        auto& kept = run.numbers[measure];
        if (kept.empty() || kept[0]) raise(kept, largestError(reference, quantity, numbers, from));
      };
      add(name, scene);
      if (!own.ends.empty()) add(ownOf(name), own.ends);
    }
  }
  return {};
}

}  // namespace

CostRun runCollisions(Engine& engine, const EngineEntry& entry, const CostSetting& setting,
                      const CollisionReference& reference, const CollisionLimit& own,
                      std::size_t round) {
  CostRun errors;
  std::string why;
  if (round == 0) why = addErrors(errors, engine, entry, setting, reference, own);
  CostRun run = timedSweep(engine, entry, collisionsOf(setting.setup).front(),
                           reference.pairs.front().starts);
  run.numbers = std::move(errors.numbers);
  if (why.empty()) return run;
  run.status = Status::failed;
  run.reason = why;
  return run;
}

std::vector<CostPoint> collisionPoints(const EngineEntry& entry, const CostSetting& setting,
                                       const CollisionLimit& own,
                                       const std::vector<CostRun>& runs) {
  const CostPoint timed = timedPoint(entry.name, setting, CostKind::collision, runs);
  std::vector<CostPoint> points;
  const auto add = [&](const std::string& measure) -> CostPoint& {
    CostPoint& point = points.emplace_back(timed);
    point.measure = measure;
    const auto found = runs.front().numbers.find(measure);
    if (found == runs.front().numbers.end() || !found->second.at(0)) return point;
    point.error = found->second[0];
    point.intervalLow = found->second.at(1);
    point.intervalHigh = found->second.at(2);
    point.worst = found->second.at(3);
    return point;
  };
  for (const QuantityId measure : collisionMeasures) {
    const std::string name(collisionQuantity(measure).name);
    add(name);
    CostPoint& point = add(ownOf(name));
    if (own.ends.empty()) {
      point.status = Status::refused;
      point.reason = fmt::format("its own limit of small steps was not found: {}", own.reason);
      continue;
    }
    const auto error = own.error.find(name);
    if (!point.error || error == own.error.end() || !(error->second > 0.0)) continue;
    point.referenceError = error->second;
    point.intervalLow = std::max(0.0, *point.intervalLow - error->second);
    point.intervalHigh = *point.intervalHigh + error->second;
  }
  return points;
}

namespace {

std::string noteOf(const CollisionReference& reference) {
  std::string names;
  for (const PairCurve& pair : reference.pairs) {
    if (!pair.oracle.reason.empty()) return pair.oracle.reason;
    names += (names.empty() ? "" : ", ") + pair.collision.name;
  }
  return "planar two-body problem in continuous time, to 1e-9: " + names;
}

class CollisionErrors final : public ErrorKind {
 public:
  using ErrorKind::ErrorKind;

  CostKind kind() const override { return CostKind::collision; }

  std::vector<std::string> measures() const override {
    std::vector<std::string> names;
    for (const QuantityId measure : collisionMeasures) {
      names.emplace_back(collisionQuantity(measure).name);
      names.push_back(ownOf(names.back()));
    }
    return names;
  }

  std::size_t rounds() const override {
    return static_cast<std::size_t>(study_.setup.cost.repeats);
  }

  double predicted(std::size_t engine, const CostSetting& setting) const override {
    const SceneTimes& timed = study_.engines[engine].collisions;
    const Cost& cost = study_.setup.cost;
    const double dt = study_.stepOf(engine, setting.setup);
    double longest = 0.0;
    for (const Case& pair : collisionsOf(setting.setup))
      longest = std::max(longest, impactTimes(pair).longest);
    // 2.5 contacts and some steps.
    const auto lasts = [&](double contact) { return (2.5 * contact / dt + 21.0) * timed.step; };
    const double once = lasts(costContactTime(setting.setup));
    return cycleSteps * lasts(longest) + cost.repeats * (once + 1.3 * cost.timed) +
           (cycleSteps + 2 * cost.repeats) * timed.load;
  }

  double ownTime(std::size_t engine) const override {
    // 2.5 t_c at the reference's step and at twice that: what it takes where there is no oracle.
    return 1.5 * 2.5 * study_.setup.cost.collisionReference *
           study_.engines[engine].collisions.step;
  }

  void makeReferences(std::size_t) override { reference_ = collisionReference(study_.setup); }

  CostRun run(const PlannedPoint& point, std::size_t round, double) override {
    const EngineEntry& entry = study_.entryOf(point.engine);
    const auto at = [&](double steps) {
      return atSteps(study_.setup, entry.name, study_.canOf(point.engine), steps);
    };
    const auto [name, key] = limitOf(point.engine);
    const CollisionLimit limit = keptOr(study_.campaign.store(), name, key, [&] {
      const double steps = study_.setup.cost.collisionReference;
      return collisionLimit(study_.workerOf(point.engine), entry, at(steps), at(steps / 2.0),
                            reference_);
    });
    return runCollisions(study_.workerOf(point.engine), entry, study_.settingOf(point), reference_,
                         limit, round);
  }

  std::vector<CostPoint> points(const PlannedPoint& point,
                                const std::vector<CostRun>& runs) const override {
    const auto [name, key] = limitOf(point.engine);
    const auto limit = study_.campaign.store().findAs<CollisionLimit>(name, key);
    return collisionPoints(study_.entryOf(point.engine), study_.settingOf(point),
                           limit.value_or(CollisionLimit{}), runs);
  }

  void addTo(CostResults& results) const override {
    results.references.push_back({.kind = kind(),
                                  .engine = "oracle",
                                  .setting = "the case's law",
                                  .note = noteOf(reference_)});
    for (std::size_t e = 0; e < study_.engines.size(); ++e) {
      if (!study_.engines[e].takesPart) continue;
      const auto [file, key] = limitOf(e);
      const auto limit = study_.campaign.store().findAs<CollisionLimit>(file, key);
      if (!limit) continue;
      const std::string& name = study_.entryOf(e).name;
      for (const auto& [measure, error] : limit->error)
        results.references.push_back({kind(), name, limit->setting, error,
                                      fmt::format("its own limit of small steps: {}", measure)});
      for (const auto& [measure, model] : limit->model) {
        const double unsure = limit->error.contains(measure) ? limit->error.at(measure) : 0.0;
        results.models.push_back(
            {name, kind(), measure, model, std::max(0.0, model - unsure), model + unsure});
      }
    }
  }

 private:
  /// Name and key of an engine's own limit, which is kept.
  std::pair<std::string, CaseKeys> limitOf(std::size_t engine) const {
    return {"limit-collision-" + study_.entryOf(engine).name,
            study_.campaign.keyOf(engine, 0, "cost: collision limit")};
  }

  CollisionReference reference_;
};

}  // namespace

std::unique_ptr<ErrorKind> collisionErrors(CostStudy& study) {
  return std::make_unique<CollisionErrors>(study);
}

}  // namespace crossgrain::inline studies
