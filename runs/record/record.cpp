#include "runs/record/record.hpp"

#include <fmt/format.h>

#include "adapters/registry.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/collision_scene.hpp"
#include "cases/couette.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "runs/collide/sweep.hpp"
#include "runs/common/engine_access.hpp"
#include "runs/common/engine_running.hpp"
#include "runs/common/run_store.hpp"
#include "support/bad_input.hpp"
#include "support/interrupt.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::inline runs {
namespace {

/// As long as lockstep looks on [s].
constexpr double timeOfCell = 0.1;

Scene sceneOf(const Case& setup) {
  if (setup.kind == CaseKind::collision)
    return collisionScene(setup, collisionStarts(setup), collisionTimeSteps(setup).front());
  if (setup.kind == CaseKind::assembly) return assemblyScene(setup);
  const double dt = timeStep(setup);
  const auto engine = engineRegistry().front().make();
  return couetteScene(setup, packingOf(setup, 0, dt, *engine, [](double) { throwIfInterrupted(); }),
                      dt);
}

double timeOf(const Case& setup, const Scene& scene, const Realised& realised) {
  if (setup.kind == CaseKind::collision) return sweepEnd(setup, scene.dt, realised.dt);
  return setup.kind == CaseKind::assembly ? assemblyDuration(setup) : timeOfCell;
}

ContactReport contactsOf(const Capabilities& can) {
  if (can.instantContacts) return ContactReport::instant;
  return can.accumulatedContacts ? ContactReport::accumulated : ContactReport::none;
}

}  // namespace

Recorded recordRun(const EngineEntry& entry, const Case& setup, const std::filesystem::path& file,
                   const RecordOptions& options) {
  checkEngineSections(setup);
  const Scene scene = sceneOf(setup);
  const ScratchFolder scratch;
  ExchangeWriter writer(file, {{"engine", entry.name},
                               {"stamp", entry.command ? entry.command().stamp : ""},
                               {"case", setup.name},
                               {"harness", programVersion},
                               {"timeout", setup.run.timeout}});
  // Of what did not run no file is to stand in the way of the next try.
  const auto forget = [&] {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
  };
  Recorded recorded;
  try {
    const auto engine =
        startNew(entry, scratch.path, setup.run.timeout, [&](const Exchange& exchange) {
          writer.write(exchange);
          ++recorded.exchanges;
        });
    const Capabilities can = engine->capabilities();
    recorded.version = can.version;
    const Realised realised = loadScene(*engine, entry, setup, scene);
    const double end = options.time.value_or(timeOf(setup, scene, realised));
    engine->snapshot(contactsOf(can));
    for (std::size_t k = 1; k <= options.looks; ++k) {
      const double next = end * static_cast<double>(k) / static_cast<double>(options.looks);
      advanceInPieces(*engine, realised, recorded.time, next);
      engine->snapshot(contactsOf(can));
      recorded.time = next;
    }
    engine->stats();
  } catch (const EngineFailure& failure) {
    recorded.failure = failure.what();
  } catch (const UnsupportedScene&) {
    forget();
    throw;
  } catch (const BadInput&) {
    forget();
    throw;
  }
  return recorded;
}

}  // namespace crossgrain::inline runs
