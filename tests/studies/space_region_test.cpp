// Averages over a region of a scene of spheres, against sums by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "averaging/statistics.hpp"
#include "studies/core/study.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "studies/flow/frame.hpp"
#include "tests/studies/flow_runs.hpp"

namespace crossgrain {
namespace {

/// Four slabs along z of a cell of 2 m × 3 m, periodic along x and y, between walls 4 m apart.
Case slabsOfACell() {
  Case setup{.dimension = 3, .source = AssemblyOf<3>()};
  DiskGroupOf<3> group;
  group.radius = 0.5;
  assemblyIn<3>(setup).disks = {group};
  assemblyIn<3>(setup).duration = 1.0;
  setup.run.dt = 1e-3;
  Region& region = setup.region.emplace();
  region.bins = BinKind::slabs;
  region.axis = 2;
  region.count = 4;
  region.high = {2.0, 3.0, 4.0};
  return setup;
}

/// A sphere on each of two planes; the box's low end is the lower one.
struct Cell3d {
  SpaceScene scene;
  SpaceSnapshot now;

  Cell3d() {
    scene.box = BoxOf<3>{Vec3::Zero(), Vec3(2.0, 3.0, 4.0), {true, true, false}};
    for (const double z : {4.0, 0.0}) {  // the higher one first
      auto& wall = scene.bodies.emplace_back();
      wall.planes.push_back({Vec3(0.0, 0.0, z), z > 0.0 ? Vec3(-Vec3::UnitZ()) : Vec3::UnitZ()});
    }
    scene.disks.radius = {0.5, 0.5};
    scene.disks.mass = {1.0, 3.0};
    scene.disks.inertia = {0.1, 0.1};
    now.position = {Vec3(0.1, 1.0, 0.5), Vec3(5.0, 1.0, 3.5)};
    now.velocity = {Vec3(-1.0, 0.0, 0.0), Vec3(1.0, 0.0, 0.0)};
    now.spin = std::vector<Vec3>{Vec3(0.0, 2.0, 0.0), Vec3::Zero()};
    auto& contacts = now.contacts.emplace();
    contacts.i = {0, 1};
    contacts.j = {3, 2};  // planes: 2 the high one, 3 the low one
    contacts.normal = {Vec3::UnitZ(), -Vec3::UnitZ()};
    contacts.overlap = {0.0, 0.0};
    contacts.normalForce = {6.0, 12.0};
    contacts.tangentialForce = {Vec3(-3.0, 0.0, 0.0), Vec3(3.0, 0.0, 0.0)};
  }
};

/// The run of one snapshot.
FlowRun runOfOne(const Case& setup, const auto& scene, const auto& now) {
  FlowAverages averages(setup, scene);
  averages.add(now);
  EXPECT_EQ(averages.snapshots(), 1U);
  FlowRun run;
  averages.describe({}, run);
  return run;
}

double seriesEnd(const FlowRun& run, const char* name) {
  return valuesOf(*run.series, name).back().value_or(NAN);
}

TEST(SpaceRegion, EveryNumberOfARegion_HasASeries) {
  Case setup = slabsOfACell();
  for (const RegionNumber& number : regionNumbers(3))
    setup.endpoints.emplace_back().quantity = number.name;
  const Cell3d cell;
  const FlowRun run = runOfOne(setup, cell.scene, cell.now);
  for (const RegionNumber& number : regionNumbers(3))
    EXPECT_TRUE(run.series->contains(std::string(number.name))) << number.name;
}

/// A body that began turned by a quarter about z, and has been turned on by half about x since: its
/// axis that was along y is along −y now.
TEST(SpaceRegion, OwnSpin_IsAboutAxesOfTheBodyAsTheyLayAtItsStart) {
  Case setup = slabsOfACell();
  for (const char* const axis : {"own_spin_x", "own_spin_y", "own_spin_z"}) {
    setup.endpoints.push_back({.quantity = axis, .disk = 0});
  }
  Cell3d cell;
  const double half = std::sqrt(0.5);
  const Eigen::Quaterniond start(half, 0.0, 0.0, half),
      now = Eigen::Quaterniond(0.0, 1.0, 0.0, 0.0) * start;
  cell.scene.shapes = {roundShape<3>(0.5)};
  cell.scene.disks.shape = {0, -1};
  cell.scene.disks.turn = {{start.w(), start.x(), start.y(), start.z()}, noTurn<3>()};
  cell.scene.disks.moments = {Vec3::Constant(0.1), Vec3::Constant(0.1)};
  cell.now.turn = {{now.w(), now.x(), now.y(), now.z()}, noTurn<3>()};
  (*cell.now.spin)[0] = {1.0, 2.0, 3.0};
  cell.now.contacts->point = {Vec3(0.1, 1.0, 0.0), Vec3(5.0, 1.0, 4.0)};
  const FlowRun run = runOfOne(setup, cell.scene, cell.now);
  EXPECT_NEAR(seriesEnd(run, "disk_0_own_spin_x"), 1.0, 1e-12);
  EXPECT_NEAR(seriesEnd(run, "disk_0_own_spin_y"), -2.0, 1e-12);
  EXPECT_NEAR(seriesEnd(run, "disk_0_own_spin_z"), -3.0, 1e-12);
}

TEST(SpaceRegion, HasProfilesOverSlabsAndTheStressesOfItsWalls) {
  const Case setup = slabsOfACell();
  const Cell3d cell;
  const FlowRun run = runOfOne(setup, cell.scene, cell.now);

  const auto profile = [&](const char* field, std::size_t bin) {
    const Profile* found = profileOf(run.profiles, "slicing", field);
    return found ? found->mean.at(bin).value_or(NAN) : NAN;
  };
  // Branches of half a metre in slabs of 6 m³; nothing in the middle.
  EXPECT_NEAR(profile("stress_zz", 0), 6.0 * 0.5 / 6.0, 1e-15);
  EXPECT_NEAR(profile("stress_zz", 3), 12.0 * 0.5 / 6.0, 1e-15);
  EXPECT_NEAR(profile("stress_xz", 3), -3.0 * 0.5 / 6.0, 1e-15);
  EXPECT_EQ(profile("stress_zz", 1), 0.0);
  EXPECT_NEAR(profile("velocity_x", 3), 1.0, 1e-15);
  EXPECT_TRUE(std::isnan(profile("velocity_x", 2)));
  EXPECT_NEAR(profile("volume_fraction", 0), std::acos(-1.0) / 6.0 / 6.0, 1e-15);

  // Over 6 m²: pushed apart by 6 and 12 N; the high wall drags its sphere along +x by 3 N, the low
  // one along −x.
  EXPECT_NEAR(seriesEnd(run, "wall_normal_stress"), (6.0 + 12.0) / 2.0 / 6.0, 1e-15);
  EXPECT_NEAR(seriesEnd(run, "wall_shear_stress"), 3.0 / 6.0, 1e-15);
  EXPECT_EQ(seriesEnd(run, "disks"), 2.0);
  EXPECT_NEAR(seriesEnd(run, "mean_z"), (0.5 + 3.0 * 3.5) / 4.0, 1e-15);
  EXPECT_NEAR(seriesEnd(run, "top"), 4.0, 1e-15);
  EXPECT_TRUE(std::isnan(seriesEnd(run, "mean_x"))) << "along a periodic direction";
  EXPECT_FALSE(run.series->contains("heap_slope"));
  EXPECT_NEAR(seriesEnd(run, "kinetic_energy"), 0.5 + 1.5 + 0.5 * 0.1 * 4.0, 1e-15);
  EXPECT_NEAR(seriesEnd(run, "coordination"), 1.0, 1e-15);

  Endpoint ratio{.quantity = "wall_shear_stress", .per = "wall_normal_stress"};
  EXPECT_NEAR(endpointValue(ratio, setup, run).value.value(), 1.0 / 3.0, 1e-15);
  Endpoint middle{.quantity = "stress_zz", .reduction = Reduction::mean};
  EXPECT_NEAR(endpointValue(middle, setup, run).value.value(), (0.5 + 0.0 + 0.0 + 1.0) / 4.0,
              1e-15);
}

TEST(SpaceRegion, ForcesThatTheEngineReportsCountForWalls) {
  const Case setup = slabsOfACell();
  Cell3d cell;
  cell.now.bodies.resize(2);
  cell.now.bodies[0].force = Vec3(-6.0, 0.0, 24.0);
  cell.now.bodies[1].force = Vec3(6.0, 0.0, -24.0);
  const FlowRun run = runOfOne(setup, cell.scene, cell.now);
  EXPECT_NEAR(seriesEnd(run, "wall_normal_stress"), 4.0, 1e-15);
  EXPECT_NEAR(seriesEnd(run, "wall_shear_stress"), 1.0, 1e-15);
}

TEST(SpaceRegion, PlacesAreAlongTheAxisOfSlabsAndOfRingsLayerByLayer) {
  Case setup = slabsOfACell();
  EXPECT_EQ(placesOf(setup).r, (std::vector<double>{0.5, 1.5, 2.5, 3.5}));
  EXPECT_EQ(placesOf(setup).rTilde.back(), 3.5);
  EXPECT_EQ(placesOf(setup).width, 1.0);
  const std::vector<double> radii(2, 0.5);
  const FlowFrame frame = flowFrame("compare", setup, "", radii);
  EXPECT_EQ(frame.region->along, "z");
  EXPECT_EQ(frame.region->z, (std::vector<double>{0.5, 1.5, 2.5, 3.5}));
  EXPECT_EQ(frame.region->disks, 2U);

  Region& region = *setup.region;
  region.bins = BinKind::rings;
  region.innerRadius = 1.0;
  region.outerRadius = 3.0;
  region.count = 2;
  region.layers = 2;
  EXPECT_EQ(placesOf(setup).r, (std::vector<double>{1.5, 2.5, 1.5, 2.5}));
  EXPECT_EQ(flowFrame("compare", setup, "", radii).region->z,
            (std::vector<double>{1.0, 1.0, 3.0, 3.0}));
}

TEST(SpaceRegion, PictureIsOfSpheresBehindTheMiddleOfTheBox) {
  // y = 1.5 m: a sphere in front of it, at y = 1, and behind it at 2 and, by another image, 1.8 m.
  Cell3d cell;
  cell.scene.disks.radius = {0.7, 0.5, 0.4};
  cell.scene.disks.position = {Vec3::Zero(), Vec3(0.0, 0.0, 3.0), Vec3::Zero()};
  cell.now.position = {Vec3(0.1, 1.0, 0.5), Vec3(5.0, -1.2, 3.5), Vec3(0.0, 2.0, 0.0)};
  cell.now.velocity = {Vec3::Zero(), Vec3(3.0, 4.0, 0.0), Vec3::Zero()};
  const ScenePicture picture = scenePicture(cell.scene, cell.now, 0.25);
  ASSERT_EQ(picture.x.size(), 2U);
  EXPECT_DOUBLE_EQ(*picture.cut, 1.5);
  EXPECT_EQ(picture.radius, (std::vector<double>{0.5, 0.4}));
  EXPECT_NEAR(picture.depth->at(0), 0.3, 1e-15);
  EXPECT_NEAR(picture.depth->at(1), 0.5, 1e-15);
  EXPECT_EQ(*picture.speed, (std::vector<double>{5.0, 0.0}));
  EXPECT_NEAR(picture.x[0], 1.0, 1e-15);
  EXPECT_NEAR(picture.y[0], 3.5, 1e-15);
  EXPECT_NEAR(picture.startR[0], 3.0, 1e-15);
  // The two walls are lines z = 4 and z = 0.
  ASSERT_EQ(picture.planes->size(), 2U);
  EXPECT_EQ(picture.planes->at(0), (std::array{0.0, 4.0, 0.0, -1.0}));
  EXPECT_FALSE(picture.contactI);
}

TEST(SpaceRegion, PeriodicPlaneHasStressesOfItsWallsToo) {
  Case setup = slabsOfACell();
  setup.dimension = 2;
  setup.source = Assembly();
  assemblyIn<2>(setup).disks.emplace_back().radius = 0.5;
  assemblyIn<2>(setup).duration = 1.0;
  setup.region->axis = 1;
  setup.region->high = {2.0, 3.0, 0.0};
  setup.region->height = 0.5;
  Scene scene;
  scene.box = BoxOf<2>{Vec2::Zero(), Vec2(2.0, 3.0), {true, false}};
  for (const double y : {0.0, 3.0}) {
    auto& wall = scene.bodies.emplace_back();
    wall.planes.push_back({Vec2(0.0, y), y > 0.0 ? Vec2(-Vec2::UnitY()) : Vec2::UnitY()});
  }
  Snapshot now;
  now.bodies.resize(2);
  now.bodies[0].force = Vec2(0.5, -2.0);
  now.bodies[1].force = Vec2(-0.5, 2.0);
  const FlowRun run = runOfOne(setup, scene, now);
  EXPECT_NEAR(seriesEnd(run, "wall_normal_stress"), 2.0 / (2.0 * 0.5), 1e-15);
  EXPECT_NEAR(seriesEnd(run, "wall_shear_stress"), 0.5 / (2.0 * 0.5), 1e-15);
  scene.box.reset();
  EXPECT_FALSE(runOfOne(setup, scene, now).series->contains("wall_normal_stress"))
      << "no cell between two walls";
}

}  // namespace
}  // namespace crossgrain
