// Every engine of the registry passes every check of studies/conformance, each through its real
// worker; its skipped checks are those listed here, no more and no less, so that coverage does not
// shrink unseen. The program itself lists the ctest entries, since engines are the registry's
// business, and it is the worker that it tests.
#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <string_view>
#include <vector>

#include "adapters/registry.hpp"
#include "adapters/worker/serve.hpp"
#include "results/schema.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/conformance.hpp"
#include "support/scratch_folder.hpp"
#include "tests/support/refusal.hpp"

namespace crossgrain::test {
namespace {

using conformance::allChecks;
using conformance::Check;

constexpr std::string_view softContacts = "soft contacts";

/// Checks that engines cannot run, and part of the reason that they give: engines of these names,
/// and those that declare nothing of `lacks`. Any other skips nothing.
struct ExpectedSkip {
  std::vector<std::string_view> engines;
  std::string_view reason;
  std::vector<std::string_view> checks;
  std::vector<std::string_view> lacks = {};  ///< softContacts, or names as in declaredBy()

  bool isOf(std::string_view engine, const std::vector<std::string>& declared) const {
    const auto declares = [&](std::string_view one) {
      return std::ranges::any_of(declared, [&](std::string_view has) {
        return one == softContacts ? has.starts_with("normal = ") && has != "normal = rigid"
                                   : has == one;
      });
    };
    return std::ranges::count(engines, engine) > 0 ||
           (!lacks.empty() && std::ranges::none_of(lacks, declares));
  }
};

const std::vector<ExpectedSkip> expectedSkips = {
    {{},
     "has no bottom_friction",
     {"BottomPlateBrakesADisk", "BottomPlateHoldsASlowDisk", "PlateBrakesEachByItself"},
     {"bottom_friction"}},
    {{}, "has no sliding flags", {"SlidingFlagsMarkTheBound"}, {"sliding flags"}},
    {{}, "not radial as wall is", {"ShrinkingWallPushes"}, {"walls: radial"}},
    {{"yade", "lammps"}, "has planes along an axis only", {"SlantingPlaneDoesNotYield"}},
    {{"yade"}, "oscillating, not rotating as those of plane are", {"TurningPlanePushes"}},
    {{"lammps"}, "fixed, not rotating as those of plane are", {"TurningPlanePushes"}},
    {{"lammps"}, "fixed, not translating as those of plane are", {"PlaneComesFromAfar"}},
    {{}, "has no linear law", {"SpringsHoldWhileAnotherFalls"}, {softContacts}},
    {{}, "one after the other", {"CornersHaveNoFirstPlane"}, {softContacts}},
    {{}, "has no stiffness", {"FastIsAsSlow"}, {softContacts}},
    {{}, "rigid disks that overlap", {"FastDisksAreNotMissed"}, {softContacts}},
    {{}, "no linear law with a tangential spring", {"SpringsOfMovedPairs"}, {softContacts}},
    {{}, "no linear law with a rolling spring", {"RollingSpringsOfMovedPairs"}, {softContacts}},
    {{}, "no convention of a soft law", {"ConventionsAreThoseDeclared"}, {softContacts}},
    {{}, "does not have its law", {"SeveralActAtOnce", "WallsUnderWayAct"}, {softContacts}},
    {{}, "not radial as ring is", {"WallsUnderWayAct"}, {softContacts, "walls: radial"}},
    {{}, "own slop", {"SlowIsNotAtRest"}, {softContacts}},
    {{}, "no contacts that remember", {"MemoriesHoldWhileAnotherFliesBy"}, {softContacts}},
    {{"grain-stiff"}, "contacts are stiffer", {"RollingHoldsASlope"}},
    {{"grain-as-yade"}, "there is no reference", {"InertiaIsTheScenes"}},
    {{"yade"}, "has no rolling dashpot", {"RollingHoldsASlope"}},
    {{"yade"}, "its materials combine like springs in series", {"MaterialsHaveTheirOwnLaws"}},
    {{"grain-as-box2d-impulse"},
     "in space",
     {"TorqueTurnsSpheres", "TurnedImpactsAreTurnedAlike", "CylinderIsMetAsAPlane",
      "TurningCylinderDrivesSpheres", "SpinsAboutTheLineChangeNothing"}},
    {{"grain-as-box2d-impulse"},
     "no rigid contacts",
     {"FallsFreelyInSpace", "PairsAcrossBorders", "PairsAcrossBordersInSpace",
      "ForcesAreThoseOfTheLawInSpace", "ContactForcesAreThoseThatActInSpace",
      "RotatingWallPushesInSpace", "WallLoadsAreThoseOfTheirContactsInSpace",
      "PlaneLoadsAreThoseOfTheirContactsInSpace", "WallsAcrossBorders", "WallsAcrossBordersInSpace",
      "PairsThatCrossBorders", "PairsThatCrossBordersInSpace"}},
};

/// Fault of another project's engine, which the checks find, with the same cause, as long as it
/// exists.
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
  const ScratchFolder scratch;
  const std::vector<Check> checks = allChecks();
  const conformance::CheckReport done =
      conformance::runChecks(entry, checks, scratch.path, [](const std::string&, double) {});
  std::map<std::string, std::string> expected;
  for (const ExpectedSkip& skip : expectedSkips)
    if (skip.isOf(entry.name, done.declared))
      for (const std::string_view check : skip.checks) expected[std::string(check)] = skip.reason;
  if (&entry == &engineRegistry().front() || !entry.mirrors.empty())
    for (const char* check : {"ConventionsAreThoseDeclared", "SeveralActAtOnce", "WallsUnderWayAct",
                              "PlateBrakesEachByItself"})
      expected[check] = "is the in-house engine";
  for (const ConformanceRow& row : done.rows) {
    // Undeclared capabilities are not required, nor is another dimension.
    constexpr std::string_view undeclared = "declares no ";
    if (row.outcome == checkSkipped &&
        (row.detail.starts_with(undeclared)
             ? std::ranges::count(done.declared, row.detail.substr(undeclared.size())) == 0
             : row.detail == "has no scenes in space" &&
                   std::ranges::count(done.declared, conformance::spheresInSpace) == 0))
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
      test::expectSays(row.detail, {known->second});
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
    for (const std::string_view engine : skip.engines)
      EXPECT_TRUE(findEngine(std::string(engine))) << engine;
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
  // The in-house engine once more, in as many smaller steps: the target planted_checks runs it.
  constexpr std::string_view byNight = "grain-stiff";
  for (const EngineEntry& entry : engineRegistry())
    if (entry.name != byNight) write(entry.name, "*/" + testName(entry.name));
  write("expected-skips", "ExpectedSkips.*");
  write("planted-faults", "OfEachCheck*:FaultMatrix*:RightEngine.*:Unexplained*:OneCause*");
  out.close();
  return out ? 0 : 1;
}

/// Serves an engine as `crossgrain __serve NAME` does: this program is also the worker that it
/// tests.
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
