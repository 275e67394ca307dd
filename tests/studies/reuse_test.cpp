#include <gtest/gtest.h>

#include <filesystem>

#include "adapters/worker/json.hpp"
#include "adapters/worker/worker_pool.hpp"
#include "cases/couette.hpp"
#include "studies/core/engine_access.hpp"
#include "tests/studies/quick_cell.hpp"
#include "tests/support/temporary_folder.hpp"

// Every engine, in a worker that ran other scenes before: the same bits as in a new process.

namespace {

using namespace crossgrain;

/// All that the engine shows after some steps of a case.
std::string sightOf(Engine& engine, const EngineEntry& entry, const Case& setup,
                    const Packing& packing) {
  const Scene scene = couetteScene(setup, packing, timeStep(setup));
  const EffectiveParameters effective = loadScene(engine, entry, setup, scene);
  engine.advance(40 * effective.dt);
  const bool instant = engine.capabilities().instantContacts;
  ArrayWriter arrays;
  const auto words = toJson(
      engine.snapshot(instant ? ContactReport::instant : ContactReport::accumulated), arrays);
  const auto* const bytes = reinterpret_cast<const char*>(arrays.bytes().data());
  return words.dump() + std::string(bytes, arrays.bytes().size());
}

TEST(Reuse, WorkerThatRanOtherScenes_HasTheSameBits) {
  const TemporaryFolder scratch;
  const std::filesystem::path& folder = scratch.path();
  const Case plain = test::quickCell();
  // Without friction, and stiffer: what an engine may have kept.
  const Case other = test::quickCell(
      {"law.tangential=\"none\"", "law.mu=0", "law.kt=0", "law.gt=0", "law.kn=400.0"});
  const auto grain = makeGrain();
  const Packing packing = packingOf(plain, 0, timeStep(plain), *grain, [](double) {});
  for (const EngineEntry& entry : selectEngines({"all"})) {
    SCOPED_TRACE(entry.name);
    std::string alone;
    try {
      alone = sightOf(*startNew(entry, folder / "new", 120.0), entry, plain, packing);
    } catch (const UnsupportedScene&) {
      continue;
    }
    pid_t first = -1;
    for (const Case* setup : {&plain, &other, &plain}) {
      const auto engine = startEngine(entry, folder / setup->name, 120.0);
      const pid_t pid = dynamic_cast<const PooledEngine&>(*engine).pid();
      if (first < 0) first = pid;
      EXPECT_EQ(pid, first);
      try {
        const std::string seen = sightOf(*engine, entry, *setup, packing);
        EXPECT_TRUE(setup == &other || seen == alone);
      } catch (const UnsupportedScene&) {
        EXPECT_EQ(setup, &other);
      }
    }
  }
}

}  // namespace
