// Engines that are right but for one thing that they declare: which check fails, and the cause that
// it names.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "studies/conformance/conformance.hpp"
#include "support/scratch_folder.hpp"
#include "tests/misbehaving/entries.hpp"

namespace crossgrain::test {
namespace {

struct Planted {
  const char* name;
  EngineEntry entry;
  const char* check;  ///< that has to fail
  const char* cause;  ///< regular expression of the first that is named; empty: none is
};

/// tests/faults/engine with one of its numbers changed.
EngineEntry plantedEntry(const std::string& name, const std::string& fault) {
  EngineEntry entry;
  entry.name = name;
  entry.summary = "has a planted fault";
  entry.command = [=] {
    std::vector<std::string> call = {CROSSGRAIN_PLANTED};
    if (!fault.empty()) call.push_back(fault);
    return call;
  };
  return entry;
}

EngineEntry mischiefOf(const std::string& mischief) {
  return misbehavingEntry(mischief, 0);
}

std::vector<ConformanceRow> rowsOf(const EngineEntry& entry) {
  const ScratchFolder scratch;
  return conformance::runChecks(entry, conformance::checksOf(false), scratch.path,
                                [](const std::string&, double) {})
      .rows;
}

std::string faultsOf(const std::vector<ConformanceRow>& rows) {
  std::string text;
  for (const ConformanceRow& row : rows)
    if (row.outcome == checkFailed || row.outcome == checkBrokeDown)
      text += row.name + ": " + row.detail + " [" + row.cause + "]\n";
  return text;
}

TEST(PlantedFaults, RightEngine_AllChecks_FindNoFault) {
  EXPECT_EQ("", faultsOf(rowsOf(plantedEntry("right", ""))));
  EXPECT_EQ("", faultsOf(rowsOf(mischiefOf("none"))));
}

class PlantedFault : public testing::TestWithParam<Planted> {};

TEST_P(PlantedFault, PlantedEngine_Check_FailsAndNamesCause) {
  const std::vector<ConformanceRow> rows = rowsOf(GetParam().entry);
  const auto failed = std::ranges::find(rows, GetParam().check, &ConformanceRow::name);
  ASSERT_NE(failed, rows.end());
  EXPECT_EQ(failed->outcome, checkFailed) << failed->detail << faultsOf(rows);
  if (std::string_view(GetParam().cause).empty()) return;
  const auto named =
      std::ranges::find_if(rows, [](const ConformanceRow& row) { return !row.cause.empty(); });
  ASSERT_NE(named, rows.end()) << faultsOf(rows);
  EXPECT_TRUE(std::regex_search(named->cause, std::regex(GetParam().cause))) << faultsOf(rows);
}

INSTANTIATE_TEST_SUITE_P(
    One, PlantedFault,
    testing::Values(Planted{"spin_at_planes", plantedEntry("wallspin", "plane_spin=-1"),
                            "PlanesFollowTheOracle", "spin .*wrong sign, at planes"},
                    Planted{"torque_at_planes", plantedEntry("walltorque", "plane_torque=0.5"),
                            "PlanesFollowTheOracle", "^torque -(4[89]|5[012]|50) %, at planes"},
                    Planted{"belt", plantedEntry("beltless", "plane_belt=0"),
                            "MovingPlanesFollowTheOracle", "motion along itself"},
                    Planted{"spring_outlives", plantedEntry("outlives", "keep_open_spring=1"),
                            "FreeFlightRemembersNothing", "outlives"},
                    Planted{"late_friction", plantedEntry("late", "mu_late=0.7"), "LateIsAsEarly",
                            "^µ -(2[89]|3[012]) %.*2 s after load"},
                    Planted{"far_friction", plantedEntry("far", "mu_far=0.7"), "FarIsAsNear",
                            "^µ -(2[89]|3[012]) %.*from the origin"},
                    Planted{"lost_springs", plantedEntry("forgets", "history_lost_every=10"),
                            "SpringsHoldWhileAnotherFalls", ""},
                    Planted{"healed_velocity", plantedEntry("heals", "heal_every=1000"),
                            "SpringsHoldWhileAnotherFalls", ""},
                    Planted{"hertz_radius", mischiefOf("hertz-radius"), "FrictionFollowsTheOracle",
                            "Hertz.*without √R₁₂"},
                    Planted{"no_checkpoints", mischiefOf("no-checkpoints"),
                            "CheckpointsGoOnToTheBit", "declared, and there are none"},
                    Planted{"forgetful_checkpoints", mischiefOf("forgetful"),
                            "CheckpointsGoOnToTheBit", "lose the springs"},
                    Planted{"impulses_at_planes", mischiefOf("impulse-planes"),
                            "PlanesFollowTheOracle", "^e_n -(19|2[01]) %, at planes"},
                    Planted{"impulses_of_sizes", mischiefOf("impulse-sizes"),
                            "UnequalDisksFollowTheOracle", "^e_n -(19|2[01]) %, of unequal disks"}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace crossgrain::test
