#include "runs/collide/engine_sweeps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "results/collision_fields.hpp"
#include "runs/collide/own_scheme.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"

namespace crossgrain::inline runs {

bool CollisionCase::wants(const EngineEntry& entry, const std::vector<std::string>& named) const {
  if (entry.mirrors.empty() || isNamed(named, entry)) return true;
  return setup->run.mirrors && standsForItsPeer(entry, setup->law);
}

void EngineSweeps::start(double timeout) {
  throwIfInterrupted();
  try {
    worker_ = startAudited(entry_, store_.scratch(entry_.name), timeout);
    version_ = worker_->capabilities().version;
  } catch (const EngineFailure&) {
    worker_.reset();
  }
}

void EngineSweeps::takeUp(const std::vector<CollisionCase>& cases) {
  for (const CollisionCase& each : cases) {
    if (!each.wants(entry_, named_)) {
      curves_.emplace_back(std::vector<CollisionCurve>());
      continue;
    }
    curves_.push_back(store_.findAs<std::vector<CollisionCurve>>(
        nameOf(*each.setup), runKey(*each.setup, entry_.name, version_)));
    if (curves_.back()) ++takenUp_;
  }
}

void EngineSweeps::runRest(const std::vector<CollisionCase>& cases,
                           const std::function<void(double)>& progress) {
  std::size_t total = 0, done = 0;
  for (std::size_t k = 0; k < cases.size(); ++k)
    if (!curves_[k]) total += cases[k].steps.size();
  for (std::size_t k = 0; k < cases.size(); ++k) {
    if (curves_[k]) continue;
    std::vector<CollisionCurve> list =
        run(cases[k], [&] { progress(static_cast<double>(++done) / static_cast<double>(total)); });
    const Case& setup = *cases[k].setup;
    if (std::ranges::find(list, SweepStatus::failed, &CollisionCurve::status) == list.end())
      store_.keep(nameOf(setup), runKey(setup, entry_.name, version_), jsonOf(list));
    curves_[k] = std::move(list);
  }
  worker_.reset();
}

std::vector<CollisionCurve> EngineSweeps::run(const CollisionCase& each,
                                              const std::function<void()>& oneIsDone) {
  std::vector<CollisionCurve> list;
  DeclaredOracles declared;
  for (const double dt : each.steps) {
    throwIfInterrupted();
    try {
      if (!worker_)
        worker_ = startAudited(entry_, store_.scratch(entry_.name), each.setup->run.timeout);
      const bool largest = dt == std::ranges::max(each.steps);
      CollisionCurve curve =
          runSweep(*worker_, entry_, *each.setup, dt, each.starts, each.oracle, largest, &declared);
      if (largest) curve.ownScheme = schemeScore(*worker_, entry_, *each.setup, dt);
      // An engine that keeps its own step has nothing new to say at another of the case's.
      if (std::ranges::find(list, curve.dt, &CollisionCurve::dt) == list.end())
        list.push_back(std::move(curve));
    } catch (const Interrupted&) {
      throw;
    } catch (const BadInput&) {
      throw;
    } catch (const std::exception& error) {
      const bool refused = dynamic_cast<const UnsupportedScene*>(&error) != nullptr;
      CollisionCurve& none = list.emplace_back();
      none.engine = entry_.name;
      none.dt = dt;
      none.status = refused ? SweepStatus::refused : SweepStatus::failed;
      none.reason = error.what();
      if (!refused) worker_.reset();
      // What a law lacks, it lacks at every time step.
      if (refused) break;
    }
    oneIsDone();
  }
  return list;
}

std::string EngineSweeps::nameOf(const Case& setup) const {
  std::string name = fmt::format("{} {} {}", entry_.name, setup.name, setup.variant);
  std::ranges::replace(name, ' ', '-');
  return name;
}

}  // namespace crossgrain::inline runs
