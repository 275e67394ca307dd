// Engines that are right but for one thing that they declare: which check fails, and the cause that
// it names.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "studies/conformance/conformance.hpp"
#include "support/scratch_folder.hpp"
#include "tests/misbehaving/entries.hpp"

namespace crossgrain::test {
namespace {

struct Planted {
  const char* name;
  EngineEntry entry;
  const char* check;     ///< that has to fail
  const char* cause;     ///< regular expression of the first that is named; empty: none is
  bool alone = false;    ///< whether no other check is run
  bool ofSpace = false;  ///< whether no checks of scenes of the plane are run
};

/// tests/faults/engine with some of its numbers changed.
EngineEntry plantedEntry(const std::string& name, const std::string& fault,
                         const char* program = CROSSGRAIN_PLANTED) {
  EngineEntry entry;
  entry.name = name;
  entry.summary = "has a planted fault";
  entry.command = [=] {
    std::vector<std::string> call = {program};
    std::istringstream words(fault);
    for (std::string word; words >> word;) call.push_back(word);
    return call;
  };
  return entry;
}

EngineEntry mischiefOf(const std::string& mischief) {
  return misbehavingEntry(mischief, 0);
}

/// @param only  the checks that are run; empty: all
std::vector<ConformanceRow> rowsOf(const EngineEntry& entry,
                                   const std::vector<std::string>& only = {}) {
  const ScratchFolder scratch;
  std::vector<conformance::Check> checks = conformance::checksOf(false);
  std::erase_if(checks, [&](const conformance::Check& check) {
    return !only.empty() && std::ranges::count(only, check.name) == 0;
  });
  return conformance::runChecks(entry, checks, scratch.path, [](const std::string&, double) {})
      .rows;
}

std::string faultsOf(const std::vector<ConformanceRow>& rows) {
  std::string text;
  for (const ConformanceRow& row : rows)
    if (row.outcome == checkFailed || row.outcome == checkBrokeDown)
      text += row.name + ": " + row.detail + " [" + row.cause + "]\n";
  return text;
}

/// A fault of spheres in space; the right engine without one.
Planted inSpace(const char* name, const char* fault, const char* check, const char* cause) {
  return {name, plantedEntry("spheres", fault, CROSSGRAIN_PLANTED_SPHERES), check, cause, false,
          true};
}

std::vector<std::string> checksOfSpace() {
  std::vector<std::string> names;
  for (const conformance::Check& check : conformance::checksOf(false))
    if (check.dimension == 3) names.emplace_back(check.name);
  return names;
}

TEST(PlantedFaults, RightEngine_AllChecks_FindNoFault) {
  EXPECT_EQ("", faultsOf(rowsOf(plantedEntry("right", ""))));
  EXPECT_EQ("", faultsOf(rowsOf(mischiefOf("none"))));
  // Of spheres alone in the checks of space: it declares more than it has of what the others ask
  // for. The example in C++ passes all (system.engine_files).
  for (const char* right : {"", "step_setting=1", "float_state=1"})
    EXPECT_EQ("", faultsOf(rowsOf(inSpace("", right, "", "").entry, checksOfSpace()))) << right;
}

/// Of an engine of spheres alone no check is skipped for its scenes' dimension.
TEST(PlantedFaults, SpheresAlone_Checks_AreRunInSpace) {
  for (const ConformanceRow& row : rowsOf(inSpace("", "", "", "").entry))
    EXPECT_EQ(row.detail.find("disks in a plane"), std::string::npos) << row.name;
}

/// Places that are shown wrongly, a speed that is cut off and a velocity that is lost are nobody's
/// gravity.
TEST(PlantedFaults, FallThatIsNotEven_IsNotNamedGravity) {
  for (const char* fault : {"show_swapped_places=1", "show_earlier=4e-5", "show_float=1",
                            "float_state=1", "most_speed=0.5", "heal_every=1000"}) {
    const std::vector<ConformanceRow> rows = rowsOf(plantedEntry("falls", fault), {"FallsFreely"});
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows.front().outcome, checkFailed) << fault;
    EXPECT_EQ(rows.front().cause, "") << fault;
  }
}

std::string firstCause(const std::vector<ConformanceRow>& rows) {
  const auto named = std::ranges::find_if_not(rows, &std::string::empty, &ConformanceRow::cause);
  return named == rows.end() ? "" : named->cause;
}

TEST(OneCause, Amounts_WithinAFifthOfOneName_AreOne) {
  using conformance::oneCause;
  EXPECT_TRUE(oneCause({}));
  EXPECT_TRUE(oneCause({{"µ", -0.10}, {"µ", -0.11}}));
  EXPECT_FALSE(oneCause({{"µ", -0.10}, {"µ", -0.14}}));
  EXPECT_FALSE(oneCause({{"µ", -0.10}, {"µ", 0.10}}));
  EXPECT_FALSE(oneCause({{"µ", -0.10}, {"k_t", -0.10}}));
}

/// What no constant explains, though some come close: each of the rules by which a cause is taken
/// back or not given.
TEST(PlantedFaults, WhatNoConstantExplains_HasNoCause) {
  struct Unnamed {
    const char* fault;
    std::vector<std::string> checks;
    const char* program = CROSSGRAIN_PLANTED;
  };
  const std::string two = "FrictionFollowsTheOracle", sizes = "UnequalDisksFollowTheOracle";
  for (const auto& [fault, checks, program] : std::vector<Unnamed>{
           // Order of evidence.
           {"look_forgets=1", {"LookingChangesNothing", "CohesionFollowsItsClosedForms"}},
           {"load_remembers=1", {"LoadingStartsAfresh", "MemoriesHoldWhileAnotherFliesBy"}},
           {"show_renumbered=1", {"StartIsTheScene", "MemoriesHoldWhileAnotherFliesBy"}},
           {"stride=2", {"FliesStraight", "FreeFlightRemembersNothing"}},
           {"radius_small=0.99", {two, "ConventionsAreThoseDeclared"}},
           // One amount, of all laws and of all partners.
           {"gt=-1", {two}},
           {"torque_of_second=0", {two, sizes}},
           {"least_overlap=1e-6", {two, sizes, "CohesionFollowsItsClosedForms"}},
           // Another period is no wrong image.
           {"box_from_origin=1", {"PairsAcrossBordersInSpace"}, CROSSGRAIN_PLANTED_SPHERES}}) {
    const std::vector<ConformanceRow> rows =
        rowsOf(plantedEntry("unnamed", fault, program), checks);
    EXPECT_NE("", faultsOf(rows)) << fault;
    EXPECT_EQ("", firstCause(rows)) << fault;
  }
}

/// Rounding of single precision is no fault, and hides none.
TEST(PlantedFaults, SinglePrecision_Declared_IsRightAndItsFaultsAreFound) {
  for (const std::string how : {"", " integrator=2 spring_only=1", " lagged=1 spring_before=1",
                                " dashpot_outside=1 lever_middle=1 cut_tension=1"}) {
    const std::string single = "declares=1 float_state=2" + how;
    EXPECT_EQ("", faultsOf(rowsOf(plantedEntry("single", single)))) << single;
    for (const char* fault : {" kn=1.05", " mu=0.9", " gn=1.1"})
      EXPECT_NE("", faultsOf(rowsOf(plantedEntry("single", single + fault),
                                    {"ConventionsAreThoseDeclared"})))
          << single << fault;
  }
}

class PlantedFault : public testing::TestWithParam<Planted> {};

TEST_P(PlantedFault, PlantedEngine_Check_FailsAndNamesCause) {
  const std::vector<ConformanceRow> rows =
      GetParam().alone     ? rowsOf(GetParam().entry, {GetParam().check})
      : GetParam().ofSpace ? rowsOf(GetParam().entry, checksOfSpace())
                           : rowsOf(GetParam().entry);
  const auto failed = std::ranges::find(rows, GetParam().check, &ConformanceRow::name);
  ASSERT_NE(failed, rows.end());
  EXPECT_EQ(failed->outcome, checkFailed) << failed->detail << faultsOf(rows);
  if (std::string_view(GetParam().cause).empty()) return;
  const auto named =
      std::ranges::find_if(rows, [](const ConformanceRow& row) { return !row.cause.empty(); });
  ASSERT_NE(named, rows.end()) << faultsOf(rows);
  EXPECT_TRUE(std::regex_search(named->cause, std::regex(GetParam().cause))) << faultsOf(rows);
}

/// One with the check that is for it, which is run alone.
Planted resisting(const char* name, const char* fault, const char* check, const char* cause) {
  return {name, plantedEntry(name, fault), check, cause, true};
}

INSTANTIATE_TEST_SUITE_P(
    Resisting, PlantedFault,
    testing::Values(
        resisting("rolling_bound", "mu_r=1.05", "ConventionsAreThoseDeclared", "^µ_r \\+(4\\.|5)"),
        resisting("rolling_stiffness", "kr=0.5", "ConventionsAreThoseDeclared", "^k_r -(49|50)"),
        resisting("rolling_length", "roll_length=2", "ConventionsAreThoseDeclared",
                  "^it has rolling_length = twice_effective, and declares effective"),
        resisting("rolling_dashpot", "roll_dashpot_outside=1", "ConventionsAreThoseDeclared",
                  "^it has rolling_dashpot = outside, and declares inside"),
        resisting("rolling_undamped", "gr=0", "ConventionsAreThoseDeclared", "^γ_r -100 %"),
        resisting("rolling_missing", "mu_r=0", "ConventionsAreThoseDeclared", "^µ_r -100 %"),
        resisting("cohesion_missing", "pull=0", "ConventionsAreThoseDeclared",
                  "^it has cohesion = none"),
        resisting("rolling_of_one", "roll_on_second=0", "RollingFollowsItsClosedForms",
                  "^the torque against rolling acts on the first of two disks alone"),
        resisting("rolling_at_walls", "roll_at_walls=0", "RollingFollowsItsClosedForms",
                  "^nothing resists rolling at planes"),
        resisting("rolling_turned", "roll_turned_by_list=1", "MemoriesHoldWhileAnotherFliesBy",
                  "lost or turned round where lists of neighbours"),
        resisting("rolling_outlives", "keep_open_angle=1", "FreeFlightRemembersNothing",
                  "outlives"),
        resisting("weak_pull", "pull=0.98", "ConventionsAreThoseDeclared", "^(k_c|w) -(1\\.9|2)"),
        resisting("bond_let_go", "lets_go=1", "CohesionFollowsItsClosedForms",
                  "^contacts of JKR's law let go where surfaces just touch"),
        resisting("unloading_stiffness", "lag_deepest=1", "ConventionsAreThoseDeclared",
                  "^it has unloading_stiffness = lagged, and declares current"),
        resisting("deepest_forgotten", "forget_deepest=1", "CohesionFollowsItsClosedForms", ""),
        resisting("no_pull_at_walls", "pull_at_walls=0", "ForcesAreThoseOfTheLaw", "")),
    [](const auto& one) { return std::string(one.param.name); });

// Faults of what several bodies do at once, of walls under way and of the plate:
// tests/faults/audit.toml.
INSTANTIATE_TEST_SUITE_P(
    Together, PlantedFault,
    testing::Values(
        resisting("walls_unlisted", "list_of_disks=1", "WallDiskComesFromAfar", ""),
        resisting("stopped_wall_moves", "stopped_wall_moves=1", "WallsUnderWayAct", ""),
        resisting("plane_at_centre", "plane_at_centre=1", "WallsUnderWayAct", ""),
        resisting("one_plane", "one_plane=1", "SeveralActAtOnce", ""),
        resisting("one_spring", "one_spring=1", "SeveralActAtOnce", ""),
        resisting("mass_scaled", "mass_scaled=0.05", "SeveralActAtOnce", ""),
        resisting("starts_box", "starts_box=1", "SeveralActAtOnce", ""),
        resisting("mean_cells", "mean_cells=1.5", "SeveralActAtOnce", ""),
        resisting("plate_mean_mass", "plate_mean_mass=1", "PlateBrakesEachByItself", ""),
        resisting("plate_winds", "plate_winds=1", "PlateBrakesEachByItself", ""),
        resisting("plate_forgets", "plate_forgets=1", "PlateBrakesEachByItself", ""),
        resisting("plate_torque_bounded", "plate_torque_bounded=1", "PlateBrakesEachByItself", ""),
        resisting("asleep", "asleep=1e-6", "SlowIsNotAtRest", ""),
        resisting("slight_dropped", "least_overlap=1e-9", "SlowIsNotAtRest", ""),
        resisting("most_springs", "most_springs=1000", "ManyAreAsFew", ""),
        resisting("restored_list", "restore_list=1", "CheckpointsGoOnToTheBit", "")),
    [](const auto& one) { return std::string(one.param.name); });

// Faults of kinds that a second audit planted.
INSTANTIATE_TEST_SUITE_P(
    SecondAudit, PlantedFault,
    testing::Values(resisting("eight_contacts", "most_contacts=8", "SeveralActAtOnce", ""),
                    resisting("wall_radius", "wall_radius_of_first=1", "SeveralActAtOnce", ""),
                    resisting("inertia", "inertia_of_first=1", "SeveralActAtOnce", ""),
                    resisting("planes_first", "show_planes_first=1", "SeveralActAtOnce", ""),
                    resisting("wall_spin", "wall_spin_size=1", "WallsUnderWayAct", ""),
                    resisting("plate_skips", "plate_skips=1", "PlateBrakesEachByItself", ""),
                    resisting("plate_gravity", "plate_knows_gravity=1", "BottomPlateBrakesADisk",
                              "^the bottom plate has another gravity"),
                    resisting("spring_age", "spring_age=65536", "SpringsHoldWhileAnotherFalls", ""),
                    resisting("flags_stay", "flags_stay=1", "SlidingFlagsMarkTheBound", ""),
                    resisting("load_keeps", "load_keeps=1", "LoadingStartsAfresh", ""),
                    resisting("most_steps", "most_steps=1000", "AdvancesByWholeSteps", ""),
                    resisting("lists_lose", "history_lost_every=1",
                              "MemoriesHoldWhileAnotherFliesBy",
                              "^springs are lost or turned round where lists")),
    [](const auto& one) { return std::string(one.param.name); });

// The same, of a third.
INSTANTIATE_TEST_SUITE_P(
    ThirdAudit, PlantedFault,
    testing::Values(resisting("wall_clock_wraps", "wall_clock_wraps=1", "OscillatingWallPushes",
                              ""),
                    resisting("one_wall_spring", "one_wall_spring=1", "SeveralActAtOnce", ""),
                    resisting("plane_point_stays", "plane_point_stays=1", "WallsUnderWayAct", "")),
    [](const auto& one) { return std::string(one.param.name); });

// Faults that act late, far, fast, in corners or in second loads: tests/faults/elsewhere.toml.
INSTANTIATE_TEST_SUITE_P(
    Elsewhere, PlantedFault,
    testing::Values(
        resisting("gravity_x", "gravity_x=0.98", "FallsFreely", "^gravity has another direction$"),
        resisting("late_gravity", "gravity_late=0.95", "FallsFreely",
                  "^gravity -(4\\.|5).*2 s after load"),
        resisting("far_grid", "far_grid=50", "FarIsAsNear", ""),
        resisting("late_plate", "plate_mu_late=0", "BottomPlateBrakesADisk",
                  "^the bottom plate brakes otherwise late"),
        resisting("late_rolling", "roll_late=0.5", "RollingHoldsASlope",
                  "^the torque against rolling is another one late"),
        resisting("gravity_of_large", "gravity_large=2", "FallsFreely",
                  "^gravity \\+100 %, of large disks"),
        resisting("late_walls", "wall_velocity_late=0", "RollersGoOn", ""),
        resisting("late_lists", "history_lost_late=1", "SpringsHoldWhileAnotherFalls", ""),
        resisting("plane_ends", "plane_ends=1", "PlaneDoesNotYield",
                  "^planes end within 30 m of their point"),
        resisting("wheel_about_origin", "wheel_about_origin=1", "TurningWheelDragsADisk",
                  "^the velocity of walls is about the origin"),
        resisting("corner", "corner_mu=0", "CornersHaveNoFirstPlane", ""),
        resisting("fast_disks", "list_look_every=20", "FastDisksAreNotMissed", ""),
        resisting("glancing_disks", "list_look_every=8", "FastDisksAreNotMissed", ""),
        resisting("saturated_dashpot", "most_damped=1", "FastIsAsSlow", ""),
        resisting("restart_without_plate", "restore_without_plate=1", "CheckpointsGoOnToTheBit",
                  ""),
        resisting("inertia_assumed", "inertia_assumed=1", "InertiaIsTheScenes",
                  "^the moment of inertia is ½ m a²"),
        resisting("plate_column", "plate_column=1", "BottomPlateHoldsASlowDisk", "")),
    [](const auto& one) { return std::string(one.param.name); });

INSTANTIATE_TEST_SUITE_P(
    InSpace, PlantedFault,
    testing::Values(
        inSpace("spring_not_turned", "spring_turn=0", "SpringsOfMovedPairs",
                "^its spring does not follow n .*along n$"),
        inSpace("spring_projected", "spring_shrinks=1", "SpringsOfMovedPairs",
                "^it has spring_turn = projected, and declares rotated$"),
        inSpace("spring_not_twisted", "spring_twist=0", "SpringsOfMovedPairs",
                "^it has spring_twist = none, and declares mean_spin$"),
        inSpace("spring_twisted_twice", "spring_twist=2", "SpringsOfMovedPairs",
                "^its spring turns about n by 2 times"),
        inSpace("spring_twisted_back", "spring_twist=-1", "SpringsOfMovedPairs",
                "^its spring turns about n against"),
        inSpace("no_images", "images=0", "PairsAcrossBordersInSpace",
                "do not meet each other's images"),
        inSpace("wrong_image", "wrong_image=1", "PairsAcrossBordersInSpace", "wrong image"),
        inSpace("box_from_origin", "box_from_origin=1", "PairsAcrossBordersInSpace", ""),
        inSpace("images_of_first", "images_of_first=1", "PairsAcrossBordersInSpace",
                "do not meet each other's images"),
        inSpace("rolling_not_turned", "roll_turn=0", "RollingSpringsOfMovedPairs",
                "^rolling: its spring does not follow n .*along n$"),
        inSpace("rolling_reversed", "roll_reversed=1", "PairsThatCrossBordersInSpace",
                "^the spring of rolling resistance is reversed"),
        inSpace("rolling_lost", "roll_reversed=0.5", "PairsThatCrossBordersInSpace",
                "^the spring of rolling resistance is lost"),
        inSpace("pyramid", "pyramid=1", "TurnedImpactsAreTurnedAlike",
                "a pyramid in place of Coulomb's cone"),
        inSpace("cylinder_inside_out", "cylinder_normal=-1", "CylinderIsMetAsAPlane",
                "^n of a cylinder points away from its axis"),
        inSpace("cylinder_by_plane", "cylinder_plane=1", "CylinderIsMetAsAPlane",
                "^a cylinder meets . of 6 spheres .* δ is not a − \\(R − s\\)"),
        inSpace("cylinder_stands", "cylinder_turns=0", "TurningCylinderDrivesSpheres",
                "^a cylinder's turning is left out of the relative velocity"),
        inSpace("cylinder_backwards", "cylinder_turns=-1", "TurningCylinderDrivesSpheres",
                "drags spheres the other way round"),
        inSpace("torque_axis", "torque_axis=1", "TorqueTurnsSpheres",
                "^the torque is about the wrong axis"),
        inSpace("inertia_of_disks", "inertia=1.25", "TorqueTurnsSpheres",
                "^J is 0\\.5 m a², .*that of a disk")),
    [](const auto& one) { return std::string(one.param.name); });

/// Of an engine that has spheres alone, by a check of scenes that lie in a plane of space for it.
Planted alone(const char* name, const char* fault, const char* check, const char* cause) {
  Planted planted = inSpace(name, fault, check, cause);
  planted.alone = true;
  return planted;
}

INSTANTIATE_TEST_SUITE_P(
    SpheresAlone, PlantedFault,
    testing::Values(alone("gravity_x", "gravity_x=0.98", "FallsFreely", ""),
                    alone("gravity_y", "gravity_y=0", "FallsFreely", ""),
                    alone("friction", "mu=0.9", "FrictionFollowsTheOracle", ""),
                    alone("spins_without_radii", "slip_spin=0", "FrictionFollowsTheOracle",
                          "^spins enter the slip without their radii"),
                    alone("torque_at_planes", "plane_torque=-1", "PlanesFollowTheOracle", ""),
                    alone("walls_undamped", "wall_gt=0", "PlanesFollowTheOracle",
                          "^γ_t -(99|100) %, at planes"),
                    alone("walls_friction", "wall_mu=0.9", "WallDisksFollowTheOracle", ""),
                    alone("rolling_at_walls", "roll_at_walls=0", "RollingFollowsItsClosedForms",
                          "^nothing resists rolling at planes"),
                    alone("images_along_z", "images_z=0", "PairsAcrossBordersInSpace",
                          "^bodies do not meet each other's images across the border along z"),
                    alone("images_of_walls", "wall_images=0", "WallsAcrossBordersInSpace",
                          "^bodies do not meet images of walls' disks"),
                    alone("omega_cross_torque", "gyroscopic=1", "SpinsAboutTheLineChangeNothing",
                          ""),
                    alone("unused_step", "step_setting=-1", "SettingDtIsUsed", "")),
    [](const auto& one) { return std::string(one.param.name); });

// From the 60 000th step on: more than the others of a scene take.
INSTANTIATE_TEST_SUITE_P(
    Later, PlantedFault,
    testing::Values(Planted{"friction", plantedEntry("later", "mu_late=0.7 late_steps=60000"),
                            "LateIsAsEarly", "^µ -(2[89]|3[012]) %, at planes, 70000 steps", true},
                    Planted{"friction_of_disks",
                            plantedEntry("later", "mu_late=0.7 late_steps=60000"),
                            "SpringsHoldWhileAnotherFalls", "^two disks meet otherwise late", true},
                    Planted{"gravity", plantedEntry("later", "gravity_late=0.95 late_steps=60000"),
                            "SpringsHoldWhileAnotherFalls", "", true}),
    [](const auto& one) { return std::string(one.param.name); });

INSTANTIATE_TEST_SUITE_P(
    One, PlantedFault,
    testing::Values(Planted{"spin_at_planes", plantedEntry("wallspin", "plane_spin=-1"),
                            "PlanesFollowTheOracle", "spin .*wrong sign, at planes", true},
                    Planted{"torque_at_planes", plantedEntry("walltorque", "plane_torque=0.5"),
                            "PlanesFollowTheOracle", "^torque -(4[89]|5[012]|50) %, at planes",
                            true},
                    Planted{"belt", plantedEntry("beltless", "plane_belt=0"),
                            "MovingPlanesFollowTheOracle", "motion along itself", true},
                    Planted{"spring_outlives", plantedEntry("outlives", "keep_open_spring=1"),
                            "FreeFlightRemembersNothing", "outlives", true},
                    resisting("lists_lose_springs", "history_lost_every=1",
                              "MemoriesHoldWhileAnotherFliesBy", "^springs are lost"),
                    resisting("walls_without_friction", "wall_mu=0", "WallDisksFollowTheOracle",
                              "^µ -100 %, at wall disks"),
                    resisting("walls_without_dashpots", "wall_gn=0", "PlanesFollowTheOracle",
                              "^γ_n -100 %, at planes"),
                    resisting("part_of_belt", "wall_velocity_y=0.9", "MovingPlanesFollowTheOracle",
                              "^the plane's motion along itself in the slip -(9|10|11)"),
                    Planted{"late_friction", plantedEntry("late", "mu_late=0.7"), "LateIsAsEarly",
                            "^µ -(2[89]|3[012]) %.*2 s after load", true},
                    Planted{"far_friction", plantedEntry("far", "mu_far=0.7"), "FarIsAsNear",
                            "^µ -(2[89]|3[012]) %.*from the origin", true},
                    Planted{"lost_springs", plantedEntry("forgets", "history_lost_every=10"),
                            "SpringsHoldWhileAnotherFalls", "", true},
                    Planted{"healed_velocity", plantedEntry("heals", "heal_every=1000"),
                            "SpringsHoldWhileAnotherFalls", "", true},
                    Planted{"hertz_radius", mischiefOf("hertz-radius"), "FrictionFollowsTheOracle",
                            "Hertz.*without √R₁₂", true},
                    Planted{"no_checkpoints", mischiefOf("no-checkpoints"),
                            "CheckpointsGoOnToTheBit", "declared, and there are none", true},
                    Planted{"forgetful_checkpoints", mischiefOf("forgetful"),
                            "CheckpointsGoOnToTheBit", "lose the springs", true},
                    Planted{"impulses_at_planes", mischiefOf("impulse-planes"),
                            "PlanesFollowTheOracle", "^e_n -(19|2[01]) %, at planes", true},
                    Planted{"impulses_of_sizes", mischiefOf("impulse-sizes"),
                            "UnequalDisksFollowTheOracle", "^e_n -(19|2[01]) %, of unequal disks",
                            true}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace crossgrain::test
