#include "studies/cost/collision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/declared_law.hpp"
#include "cases/time_step.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline studies {

Case collisionOf(const Case& setup) {
  Case pair = setup;
  pair.kind = CaseKind::collision;
  pair.bottom.reset();
  Collision& collision = pair.collision;
  const Cost& cost = setup.cost;
  for (int k = 0; k < cost.psiCount; ++k)
    collision.psi.push_back(cost.psiMax * k / (cost.psiCount - 1));
  collision.vn = {cost.speed};
  for (const int side : {0, 1}) {
    collision.radius[side] = setup.particles.smallRadius;
    collision.mass[side] = setup.particles.smallMass;
  }
  collision.inertiaFactor = setup.particles.inertiaFactor;
  return pair;
}

CollisionReference collisionReference(const Case& setup) {
  const Case pair = collisionOf(setup);
  const auto starts = collisionStarts(pair);
  return {starts, oracleCurve(pair, starts)};
}

namespace {

/// Of the pairs of a sweep.
std::vector<std::optional<double>> numbersOf(const CollisionTable& table, QuantityId quantity) {
  std::vector<std::optional<double>> numbers;
  for (std::size_t k = 0; k < table.size(); ++k) numbers.push_back(table.at(quantity, k));
  return numbers;
}

/// What errors of that quantity are in units of, as those of `collide` [its unit].
double unitOf(const CollisionReference& reference, QuantityId quantity) {
  std::vector<double> known;
  for (const auto& number :
       numbersOf(tableOf(reference.starts, referenceOf(reference.oracle)), quantity))
    if (number) known.push_back(*number);
  return errorUnit(known).value;
}

/// The law that the engine declares for the collision; absent where its constants are not known.
std::optional<ContactLaw> lawDeclared(Engine& engine, const EngineEntry& entry, const Case& pair,
                                      double dt, const std::vector<CollisionStart>& starts) {
  const Scene scene = collisionScene(pair, starts, dt);
  const EffectiveParameters effective = loadScene(engine, entry, pair, scene);
  const Capabilities can = engine.capabilities();
  return declaredLaw(can, sceneFor(can, entry, pair, scene).scene, effective,
                     collidingPair(pair).reducedMass());
}

CollisionNumbers endsOf(const CollisionTable& table) {
  CollisionNumbers numbers;
  for (const QuantityId quantity : collisionMeasures)
    numbers[std::string(collisionQuantity(quantity).name)] = numbersOf(table, quantity);
  return numbers;
}

}  // namespace

std::optional<double> rmsDifference(const std::vector<std::optional<double>>& numbers,
                                    const std::vector<std::optional<double>>& from, double unit) {
  double squares = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < std::min(numbers.size(), from.size()); ++k) {
    if (!from[k]) continue;
    if (!numbers[k]) return std::nullopt;
    squares += (*numbers[k] - *from[k]) * (*numbers[k] - *from[k]);
    ++count;
  }
  return count > 0 ? std::optional(std::sqrt(squares / count) / unit) : std::nullopt;
}

CollisionLimit collisionLimit(Engine& engine, const EngineEntry& entry, const Case& fine,
                              const Case& coarse, const CollisionReference& reference) {
  const Case pair = collisionOf(fine);
  CollisionLimit limit;
  CollisionNumbers half;
  OracleCurve declared;
  if (const auto law = lawDeclared(engine, entry, pair, timeStep(fine), reference.starts)) {
    Case own = pair;
    own.law = *law;
    declared = oracleCurve(own, reference.starts);
  }
  const bool known = std::ranges::any_of(declared.ends, [](const auto& end) { return bool(end); });
  if (known) {
    limit.setting = "oracle of the law that it declares";
    limit.ends = half = endsOf(tableOf(reference.starts, referenceOf(declared)));
  } else {
    for (const auto& [setup, numbers] :
         {std::pair(&coarse, &half), std::pair(&fine, &limit.ends)}) {
      const CollisionCurve sweep = runSweep(engine, entry, collisionOf(*setup), timeStep(*setup),
                                            reference.starts, reference.oracle, /*watch=*/false);
      limit.setting = fmt::format("t_c/{:g}", std::round(costContactTime(*setup) / sweep.dt));
      if (!sweep.complete())
        return {limit.setting, {}, {}, {}, fmt::format("at {} {}", limit.setting, sweep.reason)};
      *numbers = endsOf(sweep.points);
    }
  }
  const CollisionNumbers scene = endsOf(tableOf(reference.starts, referenceOf(reference.oracle)));
  for (const QuantityId quantity : collisionMeasures) {
    const std::string name(collisionQuantity(quantity).name);
    const double unit = unitOf(reference, quantity);
    if (const auto error = rmsDifference(limit.ends[name], half[name], unit))
      limit.error[name] = *error;
    if (const auto model = rmsDifference(limit.ends[name], scene.at(name), unit))
      limit.model[name] = *model;
  }
  return limit;
}

namespace {

/// Sweeps whose pairs touch at different fractions of a step: the dashpot's jump at touch errs by
/// how far it is from a step, so that one phase alone says little of a setting.
constexpr int collisionPhases = 8;

struct SweepTime {
  double wall, cpu;
};

/// Of one sweep among `copies` that run side by side.
SweepTime timeSweeps(Engine& engine, const EngineEntry& entry, const Case& pair, double dt,
                     const std::vector<CollisionStart>& starts, int copies) {
  std::vector<CollisionStart> many;
  for (int k = 0; k < copies; ++k) many.insert(many.end(), starts.begin(), starts.end());
  const EffectiveParameters effective =
      loadScene(engine, entry, pair, collisionScene(pair, many, dt));
  engine.advance(sweepEnd(pair, dt, effective.dt));
  const Stats stats = engine.stats();
  return {stats.wallSeconds / copies, stats.cpuSeconds / copies};
}

/// The shortest of some repeats, each long enough to be measured.
SweepTime shortestSweep(Engine& engine, const EngineEntry& entry, const Case& pair, double dt,
                        const std::vector<CollisionStart>& starts, double single) {
  constexpr int mostCopies = 50;
  const int copies =
      std::clamp(static_cast<int>(std::ceil(pair.cost.timed / single)), 1, mostCopies);
  SweepTime best{INFINITY, INFINITY};
  for (int repeat = 0; repeat < pair.cost.repeats; ++repeat) {
    throwIfInterrupted();
    const SweepTime time = timeSweeps(engine, entry, pair, dt, starts, copies);
    best.wall = std::min(best.wall, time.wall);
    best.cpu = std::min(best.cpu, time.cpu);
  }
  return best;
}

/// Why a sweep says nothing about the case, empty if it does.
std::string failureOf(const CollisionCurve& sweep, const Case& pair, double dt) {
  const double ofLimit = dt / pairLimit(pair);
  const std::string limit =
      ofLimit > 1.0 ? fmt::format("{} (dt = {:.3g} · 2/ω): ", beyondLimit, ofLimit) : "";
  if (!sweep.complete()) return limit + sweep.reason;
  double largest = 0.0;
  for (std::size_t k = 0; k < sweep.points.size(); ++k)
    if (const auto en = sweep.points.at(QuantityId::en, k))
      largest = std::max(largest, std::abs(*en));
  if (largest > 1.0)
    return fmt::format("{}pairs part {:.3g} times as fast as they met",
                       limit.empty() ? fmt::format("{}: ", beyondLimit) : limit, largest);
  return {};
}

/// √(mean of squares) of what `errorOf` says of each sweep; absent where it says nothing of one.
template <class ErrorOf>
std::optional<double> rmsOver(const std::vector<CollisionCurve>& sweeps, ErrorOf errorOf) {
  double squares = 0.0;
  for (const CollisionCurve& sweep : sweeps) {
    const std::optional<double> error = errorOf(sweep);
    if (!error) return std::nullopt;
    squares += *error * *error;
  }
  return std::sqrt(squares / static_cast<double>(sweeps.size()));
}

/// Against the engine's own limit, beside the point against the case's law.
CostPoint ownPoint(CostPoint point, const std::vector<CollisionCurve>& sweeps, QuantityId measure,
                   const CollisionReference& reference, const CollisionLimit& own) {
  const std::string name = point.measure;
  point.measure = ownOf(name);
  point.error.reset();
  if (!point.ran()) return point;
  const auto ends = own.ends.find(name);
  if (ends == own.ends.end()) {
    point.status = Status::refused;
    point.reason = fmt::format("its own limit of small steps was not found: {}", own.reason);
    return point;
  }
  const double unit = unitOf(reference, measure);
  point.error = rmsOver(sweeps, [&](const CollisionCurve& sweep) {
    return rmsDifference(numbersOf(sweep.points, measure), ends->second, unit);
  });
  if (const auto error = own.error.find(name); error != own.error.end() && error->second > 0.0)
    point.referenceError = error->second;
  return point;
}

}  // namespace

std::vector<CostPoint> measureCollision(Engine& engine, const EngineEntry& entry,
                                        const CostSetting& setting,
                                        const CollisionReference& reference,
                                        const CollisionLimit& own) {
  Case pair = collisionOf(setting.setup);
  const double dt = timeStep(setting.setup);
  std::vector<CollisionCurve> sweeps;
  for (int k = 0; k < collisionPhases; ++k) {
    pair.collision.startPhase = (k + 0.5) / collisionPhases;
    sweeps.push_back(
        runSweep(engine, entry, pair, dt, reference.starts, reference.oracle, /*watch=*/false));
  }
  const CollisionCurve& first = sweeps.front();
  CostPoint point = pointOf(entry.name, setting, CostKind::collision, first.dt);
  countWork(point, first.stats->steps, first.stats->contactEvaluations);
  for (const CollisionCurve& each : sweeps)
    if (point.reason.empty()) point.reason = failureOf(each, pair, first.dt);
  if (!point.reason.empty()) point.status = Status::failed;
  const SweepTime time = shortestSweep(engine, entry, pair, dt, reference.starts,
                                       std::max(first.stats->wallSeconds, 1e-6));
  point.wallSeconds = time.wall;
  point.cpuSeconds = time.cpu;

  std::vector<CostPoint> points;
  for (const QuantityId measure : collisionMeasures) {
    point.measure = collisionQuantity(measure).name;
    point.error.reset();
    if (point.ran())
      point.error = rmsOver(sweeps, [&](const CollisionCurve& sweep) {
        const auto& score = sweep.score.of[measure];
        return score ? std::optional(score->rms) : std::nullopt;
      });
    points.push_back(point);
    points.push_back(ownPoint(point, sweeps, measure, reference, own));
  }
  return points;
}

namespace {

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

  double predicted(std::size_t engine, const CostSetting& setting) const override {
    const TimedEngine& timed = study_.engines[engine];
    const Cost& cost = study_.setup.cost;
    const double dt = study_.stepOf(engine, setting.setup);
    // 2.5 t_c and some steps, of fewer disks than the packing has: an upper bound.
    const double once = (2.5 * costContactTime(setting.setup) / dt + 21.0) * timed.step;
    return collisionPhases * once + cost.repeats * std::max(1.3 * cost.timed, once) +
           (collisionPhases + cost.repeats) * timed.load;
  }

  double ownTime(std::size_t engine) const override {
    // 2.5 t_c at the reference's step and at twice that: what it takes where there is no oracle.
    return 1.5 * 2.5 * study_.setup.cost.collisionReference * study_.engines[engine].step;
  }

  void makeReferences() override { reference_ = collisionReference(study_.setup); }

  std::vector<CostPoint> measure(const PlannedPoint& point) override {
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
    return measureCollision(study_.workerOf(point.engine), entry, study_.settingOf(point),
                            reference_, limit);
  }

  void addTo(CostResults& results) const override {
    results.references.push_back(
        {.kind = kind(),
         .engine = "oracle",
         .setting = "the case's law",
         .note = reference_.oracle.reason.empty()
                     ? "planar two-body problem in continuous time, to 1e-9"
                     : reference_.oracle.reason});
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
