// Extreme numbers, generated over the table of keys: each is refused in one line, or what comes of
// it is a scene that the in-house engine steps through with finite numbers.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "adapters/registry.hpp"
#include "cases/collision_scene.hpp"
#include "cases/couette.hpp"
#include "cases/flow.hpp"
#include "cases/keys.hpp"
#include "cases/time_step.hpp"
#include "files.hpp"

namespace crossgrain::test {
namespace {

const char* const extremeNumbers[] = {"1e300", "-1e300", "1e-309", "1e18", "0", "nan", "inf"};

/// Of two disks on a plane; and the same in space, in a box, with a wall of spheres.
const std::string flat = R"([case]
kind = "assembly"
[law]
kn = 100.0
gn = 0.1
kt = 30.0
gt = 0.1
mu = 0.3
tangential = "spring_dashpot"
[assembly]
steps = 20
gravity = [0.0, -1.0]
[[assembly.disks]]
position = [0.0, 0.5]
radius = 0.5
density = 2.0
velocity = [0.1, 0.0]
spin = 1.0
line = { count = 2, step = [1.1, 0.0] }
[[assembly.walls]]
point = [0.0, 0.0]
normal = [0.0, 1.0]
[average]
bins = "whole"
low = [-5.0, 0.0]
high = [5.0, 5.0]
from = 0.0
snapshots = 2
[[endpoints]]
name = "e"
quantity = "kinetic_energy"
absolute = 1.0
why = "w"
)";
const std::string deep = R"([case]
kind = "assembly"
dimension = 3
[law]
normal = "hertz"
young = 1e6
poisson = 0.3
gn = 0.1
gt = 0.1
mu = 0.3
damper = "critical"
tangential = "spring_dashpot"
[run]
dt = 1e-5
[assembly]
duration = 1e-4
gravity = [0.0, 0.0, -1.0]
[assembly.box]
low = [0.0, 0.0, 0.0]
high = [9.0, 9.0, 9.0]
periodic = ["x", "y"]
[[assembly.disks]]
position = [1.0, 1.0, 1.0]
radius = 0.5
density = 2.0
velocity = [0.1, 0.0, 0.0]
spin = [1.0, 0.0, 0.0]
grid = { columns = 2, rows = 1, spacing = [1.1, 1.0, 1.0] }
[[assembly.walls]]
position = [1.0, 1.0, 0.0]
radius = 0.5
velocity = [0.1, 0.0, 0.0]
[average]
bins = "slabs"
along = "z"
count = 2
low = [0.0, 0.0, 0.0]
high = [9.0, 9.0, 9.0]
from = 0.0
snapshots = 2
)";
/// The text with `key = value` in its first section of that name, in place of what is there.
std::string withKey(const std::string& text, const std::string& section, const std::string& key,
                    const std::string& value) {
  std::istringstream in(text);
  std::string made, line;
  bool inside = false, done = false;
  const auto add = [&] {
    if (inside && !done) made += key + " = " + value + "\n";
    done |= inside;
  };
  while (std::getline(in, line)) {
    if (line.starts_with("[")) {
      add();
      inside = !done && (line == "[" + section + "]" || line == "[[" + section + "]]");
    }
    const bool old = inside && !done && line.starts_with(key + " =");
    if (!old) made += line + "\n";
  }
  add();
  if (!done) made += "[" + section + "]\n" + key + " = " + value + "\n";
  return made;
}

template <int D>
bool isFinite(const SnapshotOf<D>& now) {
  const auto all = [](const auto& vectors) {
    return std::ranges::all_of(vectors, [](const auto& v) { return v.allFinite(); });
  };
  return all(now.position) && all(now.velocity) &&
         (!now.energies || std::isfinite(now.energies->kinetic));
}

/// Fault of two steps of the in-house engine; empty: all numbers are finite.
template <int D>
std::string stepped(Engine& engine, const SceneOf<D>& scene) {
  loadOn<D>(engine, scene, {});
  for (int k = 1; k <= 2; ++k) {
    engine.advance(k * scene.dt);
    if (!isFinite<D>(snapshotOf<D>(engine, ContactReport::none))) return "not finite";
  }
  return {};
}

template <int D>
std::string stepped(Engine& engine, const Case& setup) {
  const double dt = timeStep(setup);
  if (!(std::isnormal(dt) && dt > 0.0)) return "dt";
  if (isCollision(setup)) {
    const auto starts = collisionStarts(setup);
    if constexpr (D == 2)
      return stepped<D>(engine, collisionScene(setup, starts, dt));
    else
      return stepped<D>(engine, spaceCollisionScene(setup, starts, dt));
  }
  if (cellOf(setup)) {
    checkPackings(setup, 1, dt);  // preparing it takes too long
    return {};
  }
  if (hasFlow(setup) && flowTimes(setup).samples > 1'000'000) return "snapshots";
  const Packing packing = flowPacking(setup, 0, dt, engine, [](double) {});
  return stepped<D>(engine, flowScene<D>(setup, packing, dt));
}

/// Empty: refused in one line, or sound.
std::string faultOf(Engine& engine, const std::string& text) {
  std::ofstream("case.toml") << text;
  try {
    for (const Case& setup : loadCase("case.toml")) {
      if (!unstableStepFault(setup, timeStep(setup), "dt").empty()) continue;  // refused by studies
      const std::string fault =
          setup.dimension == 3 ? stepped<3>(engine, setup) : stepped<2>(engine, setup);
      if (!fault.empty()) return fault;
    }
  } catch (const BadInput& error) {
    const std::string what = error.what();
    constexpr std::size_t longestLine = 600, longestNumber = 60;
    std::size_t digits = 0;
    for (const char c : what) {
      digits = std::isdigit(static_cast<unsigned char>(c)) ? digits + 1 : 0;
      if (digits > longestNumber) return "long number: " + what;
    }
    return what.size() > longestLine || what.find('\n') != std::string::npos ? what : "";
  } catch (const UnsupportedScene&) {
    return {};
  } catch (const std::invalid_argument&) {
    return {};  // a law that no impact overcomes: each study says so
  } catch (const std::exception& error) {
    return error.what();
  }
  return {};
}

/// A number, a list of one, the first component of a vector, and in space its last.
std::vector<std::string> formsOf(const std::string& number, bool space) {
  if (!space) return {number, "[" + number + "]", "[" + number + ", 0.5]"};
  return {number, "[" + number + "]", "[" + number + ", 0.5, 0.5]", "[0.5, 0.5, " + number + "]"};
}

class EveryNumericKey : public InFolder {
 protected:
  void check(const std::string& kind, const std::string& base) {
    const auto engine = engineRegistry().front().make();
    const bool space = base.find("dimension = 3") != std::string::npos;
    int tried = 0;
    for (const SectionInfo& section : caseSections()) {
      if (!section.kinds.empty() && section.kinds.find(kind) == std::string::npos) continue;
      if (section.name.find("NAME") != std::string::npos) continue;
      for (const KeyInfo& key : section.keys) {
        if (key.unit.empty() || key.name.find_first_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ") == 0) continue;
        if (key.name.find("NAME") != std::string::npos) continue;
        for (const char* const number : extremeNumbers)
          for (const std::string& form : formsOf(number, space)) {
            const std::string fault = faultOf(*engine, withKey(base, section.name, key.name, form));
            EXPECT_EQ(fault, "") << section.name << '.' << key.name << " = " << form;
            ++tried;
          }
      }
    }
    EXPECT_GT(tried, 1000);
  }
};

TEST_F(EveryNumericKey, OfCells_IsRefusedOrHasAStart) {
  check("couette", soundCase);
}
TEST_F(EveryNumericKey, OfFlatAssemblies_IsRefusedOrSteps) {
  check("assembly", flat);
}
TEST_F(EveryNumericKey, OfSpheres_IsRefusedOrSteps) {
  check("assembly", deep);
}
TEST_F(EveryNumericKey, OfFlatCollisions_IsRefusedOrSteps) {
  check("collision", soundCollision);
}
TEST_F(EveryNumericKey, OfCollisionsInSpace_IsRefusedOrSteps) {
  const std::string turned = withKey(soundCollision, "collision", "turn", "[0.0, 0.0, 10.0]");
  check("collision", withKey(turned, "case", "dimension", "3"));
}

}  // namespace
}  // namespace crossgrain::test
