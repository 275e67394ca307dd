// Loads a case, steps an engine and asks the oracle, with what is installed alone.
#include <cstdio>

#include "adapters/registry.hpp"
#include "cases/assembly_scene.hpp"
#include "cases/loader.hpp"
#include "oracle/collision_oracle.hpp"

int main(int, char** arguments) {
  using namespace crossgrain;
  const Case setup = loadCase(arguments[1]).front();
  const Scene scene = assemblyScene(setup);
  const auto engine = engineRegistry().front().make();
  engine->load(scene, {});
  engine->advance(10.0 * scene.dt);
  const Snapshot snapshot = engine->snapshot(ContactReport::none);
  ContactLaw law{.normal = NormalLaw::linear, .tangential = TangentialLaw::none, .kn = 100.0};
  std::printf("%zu disks, e_n %.6f\n", snapshot.position.size(),
              oracleOutcome(law, diskOnWall(1.0, 1.0, 0.5), {0.0, 0.01}).en);
}
