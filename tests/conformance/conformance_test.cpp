// Every engine of the registry passes every check of studies/conformance, each through its real
// worker; what it skips is what is listed here, no more and no less, so that coverage does not
// shrink unseen. The program itself lists the ctest entries, since engines are the registry's
// business, and it is the worker that it tests.
#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <string_view>

#include "adapters/registry.hpp"
#include "adapters/worker/serve.hpp"
#include "results/json_fields.hpp"
#include "studies/conformance/conformance.hpp"
#include "support/scratch_folder.hpp"

namespace crossgrain::test {
namespace {

using conformance::allChecks;
using conformance::Check;

/// A check that an engine cannot run, and part of the reason that it gives. An engine that is not
/// listed skips nothing.
struct ExpectedSkip {
  std::string_view engine, check, reason;
};

constexpr std::array expectedSkips = {
    ExpectedSkip{"yade", "BottomPlateBrakesADisk", "has no bottom_friction"},
    ExpectedSkip{"yade", "BottomPlateHoldsASlowDisk", "has no bottom_friction"},
    ExpectedSkip{"yade", "SlantingPlaneDoesNotYield", "has planes along an axis only"},
    ExpectedSkip{"yade", "TurningPlanePushes", "oscillating, not rotating as those of plane are"},
    ExpectedSkip{"lammps", "BottomPlateBrakesADisk", "has no bottom_friction"},
    ExpectedSkip{"lammps", "BottomPlateHoldsASlowDisk", "has no bottom_friction"},
    ExpectedSkip{"lammps", "SlantingPlaneDoesNotYield", "has planes along an axis only"},
    ExpectedSkip{"lammps", "TurningPlanePushes", "fixed, not rotating as those of plane are"},
    ExpectedSkip{"lammps", "PlaneComesFromAfar", "fixed, not translating as those of plane are"},
    ExpectedSkip{"lammps", "ShrinkingWallPushes", "oscillating, not radial as wall is"},
    ExpectedSkip{"box2d-impulse", "BottomPlateBrakesADisk", "has no bottom_friction"},
    ExpectedSkip{"box2d-impulse", "BottomPlateHoldsASlowDisk", "has no bottom_friction"},
    ExpectedSkip{"box2d-impulse", "ShrinkingWallPushes", "oscillating, not radial as wall is"},
    ExpectedSkip{"box2d-impulse", "SlidingFlagsMarkTheBound", "has no sliding flags"},
    ExpectedSkip{"box2d-impulse", "SpringsHoldWhileAnotherFalls", "has no linear law"},
    ExpectedSkip{"grain-as-box2d-impulse", "SpringsHoldWhileAnotherFalls", "has no linear law"},
    ExpectedSkip{"box2d-impulse", "CornersHaveNoFirstPlane", "one after the other"},
    ExpectedSkip{"box2d-impulse", "FastIsAsSlow", "has no stiffness"},
    ExpectedSkip{"box2d-impulse", "FastDisksAreNotMissed", "rigid disks that overlap"},
    ExpectedSkip{"grain-as-box2d-impulse", "CornersHaveNoFirstPlane", "one after the other"},
    ExpectedSkip{"grain-as-box2d-impulse", "FastIsAsSlow", "has no stiffness"},
    ExpectedSkip{"grain-as-box2d-impulse", "FastDisksAreNotMissed", "rigid disks that overlap"},
    ExpectedSkip{"box2d-penalty", "ShrinkingWallPushes", "oscillating, not radial as wall is"},
    ExpectedSkip{"grain-stiff", "RollingHoldsASlope", "contacts are stiffer"},
    ExpectedSkip{"grain-as-yade", "InertiaIsTheScenes", "there is no reference"},
    ExpectedSkip{"yade", "RollingHoldsASlope", "has no rolling dashpot"},
    ExpectedSkip{"yade", "MaterialsHaveTheirOwnLaws",
                 "its materials combine like springs in series"},
    ExpectedSkip{"grain-as-box2d-impulse", "SpringsOfMovedPairs",
                 "no linear law with a tangential spring"},
    ExpectedSkip{"grain-as-box2d-impulse", "RollingSpringsOfMovedPairs",
                 "no linear law with a rolling spring"},
    ExpectedSkip{"grain-as-box2d-impulse", "TorqueTurnsSpheres", "in space"},
    ExpectedSkip{"grain-as-box2d-impulse", "TurnedImpactsAreTurnedAlike", "in space"},
    ExpectedSkip{"grain-as-box2d-impulse", "CylinderIsMetAsAPlane", "in space"},
    ExpectedSkip{"grain-as-box2d-impulse", "TurningCylinderDrivesSpheres", "in space"},
    ExpectedSkip{"grain-as-box2d-impulse", "FallsFreelyInSpace", "no rigid contacts"},
    ExpectedSkip{"grain-as-box2d-impulse", "PairsAcrossBorders", "no rigid contacts"},
    ExpectedSkip{"grain-as-box2d-impulse", "PairsAcrossBordersInSpace", "no rigid contacts"},
    ExpectedSkip{"grain-as-box2d-impulse", "ForcesAreThoseOfTheLawInSpace", "no rigid contacts"},
    ExpectedSkip{"grain-as-box2d-impulse", "ContactForcesAreThoseThatActInSpace",
                 "no rigid contacts"},
    ExpectedSkip{"grain-as-box2d-impulse", "RotatingWallPushesInSpace", "no rigid contacts"},
    ExpectedSkip{"grain-as-box2d-impulse", "WallLoadsAreThoseOfTheirContactsInSpace",
                 "no rigid contacts"},
    ExpectedSkip{"grain-as-box2d-impulse", "PlaneLoadsAreThoseOfTheirContactsInSpace",
                 "no rigid contacts"},
    ExpectedSkip{"grain-as-box2d-impulse", "SpinsAboutTheLineChangeNothing", "in space"},
    ExpectedSkip{"grain-as-box2d-impulse", "WallsAcrossBorders", "no rigid contacts"},
    ExpectedSkip{"grain-as-box2d-impulse", "WallsAcrossBordersInSpace", "no rigid contacts"},
    ExpectedSkip{"grain-as-box2d-impulse", "PairsThatCrossBorders", "no rigid contacts"},
    ExpectedSkip{"grain-as-box2d-impulse", "PairsThatCrossBordersInSpace", "no rigid contacts"},
    ExpectedSkip{"box2d-impulse", "ConventionsAreThoseDeclared", "no convention of a soft law"},
    ExpectedSkip{"yade", "PlateBrakesEachByItself", "has no bottom_friction"},
    ExpectedSkip{"lammps", "PlateBrakesEachByItself", "has no bottom_friction"},
    ExpectedSkip{"box2d-impulse", "PlateBrakesEachByItself", "has no bottom_friction"},
    ExpectedSkip{"box2d-impulse", "SeveralActAtOnce", "does not have its law"},
    ExpectedSkip{"box2d-impulse", "SlowIsNotAtRest", "own slop"},
    ExpectedSkip{"grain-as-box2d-impulse", "SlowIsNotAtRest", "own slop"},
    ExpectedSkip{"box2d-impulse", "MemoriesHoldWhileAnotherFliesBy", "no contacts that remember"},
    ExpectedSkip{"grain-as-box2d-impulse", "MemoriesHoldWhileAnotherFliesBy",
                 "no contacts that remember"},
    ExpectedSkip{"box2d-impulse", "WallsUnderWayAct", "not radial as ring is"},
};

/// What an engine of others does wrong: it is found, and named by the same cause, as long as it is.
struct KnownFault {
  std::string_view engine, check;
  const char* cause;  ///< part of it
};

constexpr KnownFault knownFaults[] = {
    {"lammps", "PairsThatCrossBorders", "the spring of rolling resistance is reversed"},
    {"lammps", "PairsThatCrossBordersInSpace", "the spring of rolling resistance is reversed"},
};

/// An engine's name as googletest can have it: letters, digits and underscores.
std::string testName(std::string engine) {
  std::ranges::replace(engine, '-', '_');
  return engine;
}

std::vector<std::string> allEngines() {
  std::vector<std::string> names;
  for (const EngineEntry& entry : engineRegistry()) names.push_back(entry.name);
  return names;
}

class Conformance : public testing::TestWithParam<std::string> {};

TEST_P(Conformance, Engine_AllChecks_PassOrSkipAsExpected) {
  const EngineEntry& entry = *findEngine(GetParam());
  if (entry.missing && !entry.missing().empty()) GTEST_SKIP() << entry.missing();
  std::map<std::string, std::string> expected;
  for (const ExpectedSkip& skip : expectedSkips)
    if (skip.engine == entry.name) expected[std::string(skip.check)] = skip.reason;
  if (&entry == &engineRegistry().front() || !entry.mirrors.empty())
    for (const char* check : {"ConventionsAreThoseDeclared", "SeveralActAtOnce", "WallsUnderWayAct",
                              "PlateBrakesEachByItself"})
      expected[check] = "is the in-house engine";

  const ScratchFolder scratch;
  const std::vector<Check> checks = allChecks();
  const conformance::CheckReport done =
      conformance::runChecks(entry, checks, scratch.path, [](const std::string&, double) {});
  for (const ConformanceRow& row : done.rows) {
    // What it does not declare is not required.
    constexpr std::string_view undeclared = "declares no ";
    if (row.outcome == checkSkipped && row.detail.starts_with(undeclared) &&
        std::ranges::count(done.declared, row.detail.substr(undeclared.size())) == 0)
      continue;
    const auto fault = std::ranges::find_if(knownFaults, [&](const KnownFault& one) {
      return one.engine == entry.name && one.check == row.name;
    });
    if (fault != std::end(knownFaults)) {
      EXPECT_EQ(row.outcome, checkFailed) << row.name << ": " << row.detail;
      EXPECT_NE(row.cause.find(fault->cause), std::string::npos) << row.cause;
      continue;
    }
    const auto known = expected.find(row.name);
    if (known != expected.end()) {
      EXPECT_EQ(row.outcome, checkSkipped) << row.name << ": " << row.detail;
      EXPECT_NE(row.detail.find(known->second), std::string::npos)
          << row.name << " is expected to be skipped because the engine " << known->second
          << ", not: " << row.detail;
    } else {
      EXPECT_EQ(row.outcome, checkPassed)
          << row.name << " (" << nameOf(row.outcome, checkNames) << "): " << row.detail
          << fmt::format(" ({} faults)", row.faults);
    }
  }
  // Names that checks mark as examined are names of declared capabilities.
  if (entry.name == engineRegistry().front().name) {
    for (const std::string& one : done.examined)
      EXPECT_EQ(std::ranges::count(done.declared, one), 1) << one;
  }
  for (const auto& [name, reason] : expected)
    EXPECT_TRUE(std::ranges::any_of(checks, [&](const Check& check) { return check.name == name; }))
        << "there is no check " << name << " to skip";
}

INSTANTIATE_TEST_SUITE_P(Engines, Conformance, testing::ValuesIn(allEngines()),
                         [](const auto& one) { return testName(one.param); });

TEST(ExpectedSkips, Engines_AreInTheRegistry) {
  for (const ExpectedSkip& skip : expectedSkips)
    EXPECT_TRUE(findEngine(std::string(skip.engine))) << skip.engine;
}

/// Writes one ctest entry for each engine, since a worker takes seconds to start, and one for what
/// concerns none.
int writeTests(const std::string& program, const std::string& file) {
  std::ofstream out(file);
  const auto write = [&](const std::string& name, const std::string& filter) {
    out << fmt::format("add_test([[conformance.{}]] [[{}]] [[--gtest_filter={}]])\n", name, program,
                       filter)
        << fmt::format("set_tests_properties([[conformance.{}]] PROPERTIES TIMEOUT 1800 COST 20)\n",
                       name);
  };
  for (const EngineEntry& entry : engineRegistry()) write(entry.name, "*/" + testName(entry.name));
  write("expected-skips", "ExpectedSkips.*");
  write("planted-faults", "OfEachCheck*:FaultMatrix*:RightEngine.*:Unexplained*:OneCause*");
  out.close();
  return out ? 0 : 1;
}

/// What `crossgrain __serve NAME` does: this program is also the worker that it tests.
int serveEngine(const std::string& name) {
  const EngineEntry* entry = findEngine(name);
  return entry && entry->make ? serve(*entry->make()) : 2;
}

}  // namespace
}  // namespace crossgrain::test

int main(int argc, char** argv) {
  using namespace crossgrain::test;
  gsl_set_error_handler_off();  // as in cli/program.cpp
  if (argc == 3 && std::string_view(argv[1]) == "__serve") return serveEngine(argv[2]);
  if (argc == 3 && std::string_view(argv[1]) == "--write-tests")
    return writeTests(argv[0], argv[2]);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
