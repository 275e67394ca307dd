#include "cases/couette.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "adapters/grain.hpp"
#include "cases/preparation.hpp"
#include "cases/time_step.hpp"
#include "support/bad_input.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace crossgrain;

Case quickCell() {
  Case setup{.name = "cell", .file = "cell.toml", .law = test::thesisLaw()};
  couetteIn(setup).cell = {0.03, 0.075, test::wallRadius, 2.5e-3, 6e-3, 1.0};
  couetteIn(setup).particles.small = 190;
  couetteIn(setup).particles.large = 30;
  couetteIn(setup).particles.smallRadius = test::smallRadius;
  couetteIn(setup).particles.largeRadius = test::largeRadius;
  couetteIn(setup).particles.smallMass = test::smallMass;
  couetteIn(setup).particles.largeMass = test::largeMass;
  couetteIn(setup).filling.shrinkTime = 0.1;
  couetteIn(setup).filling.rotations = 0.01;
  return setup;
}

TEST(Couette, Walls_NumberOfDisks_NearestToTheSpacing) {
  Cell cell = couetteIn(quickCell()).cell;
  cell.innerRadius = 0.1032;
  cell.outerRadius = 0.2524;
  const auto counts = [&] {
    return std::pair(wallRing("wheel", cell, cell.innerRadius, 0.0).diskRadius.size(),
                     wallRing("ring", cell, cell.outerRadius, 0.0).diskRadius.size());
  };
  EXPECT_EQ(counts(),
            std::pair(259ul, 634ul));  // 2π·0.1032/0.0025 = 259.4, 2π·0.2524/0.0025 = 634.3
  cell.wallSpacing = 7e-3;
  EXPECT_EQ(counts(), std::pair(93ul, 227ul));  // 92.6, 226.6
}

TEST(Couette, Holes_AreGapsBetweenWallDisks) {
  Cell cell = couetteIn(quickCell()).cell;
  cell.wallSpacing = 7e-3;
  for (const double radius : {cell.innerRadius, cell.outerRadius}) {
    const WallBody wall = wallRing("wall", cell, radius, 0.3);
    const double gap = (wall.diskPosition[1] - wall.diskPosition[0]).norm() - 2.0 * cell.wallRadius;
    EXPECT_NEAR(wallHole(cell, radius), gap, 1e-15);
    EXPECT_NEAR(wallHole(cell, radius, 1.25), 1.25 * gap + 0.5 * cell.wallRadius, 1e-15);
  }
}

TEST(Couette, Preparation_FillsTheCell_RepeatsAndDiffersByIndex) {
  const Case setup = quickCell();
  const auto engine = makeGrain();
  double last = 0.0;
  const auto prepared = [&](int index) {
    return preparePacking(setup, index, 4e-5, *engine, [&](double f) { last = f; });
  };
  const Packing packing = prepared(0);
  EXPECT_EQ(last, 1.0);
  ASSERT_EQ(packing.disks.size(), 220u);
  EXPECT_EQ(std::ranges::count(packing.disks.radius, test::largeRadius), 30);
  for (const Vec2& position : packing.disks.position) {
    EXPECT_GT(position.norm(), couetteIn(setup).cell.innerRadius);
    EXPECT_LT(position.norm(), couetteIn(setup).cell.outerRadius);
  }
  // Ω·(shrink time + 0.01 rotations), to the steps that make up that time.
  EXPECT_NEAR(packing.wheelAngle, 0.1 + 0.01 * 2.0 * std::numbers::pi, 4e-5);
  EXPECT_NO_THROW(
      checkStart(couetteScene(setup, packing, 4e-5), couetteIn(setup).particles, "here"));
  const Packing again = prepared(0), other = prepared(1);
  EXPECT_EQ(packing.disks.position, again.disks.position);
  EXPECT_EQ(packing.disks.spin, again.disks.spin);
  EXPECT_EQ(packing.hash, again.hash);
  EXPECT_NE(packing.disks.position, other.disks.position);
  EXPECT_NE(packing.hash, other.hash);
}

TEST(Couette, PreparationDt_MakesPackingsIndependentOfTheRun) {
  Case setup = quickCell();
  const std::string byTheRuns = packingHash(setup, 0, 8e-5);
  couetteIn(setup).filling.dt = 8e-5;
  EXPECT_EQ(packingHash(setup, 0, 4e-5), byTheRuns);
  EXPECT_EQ(packingHash(setup, 0, 1e-5), byTheRuns);
  couetteIn(setup).filling.rotations = 0.0;
  const auto prepared = [&](double dt) {
    return preparePacking(setup, 0, dt, *makeGrain(), [](double) {}).disks.position;
  };
  EXPECT_EQ(prepared(4e-5), prepared(1e-5));
  const auto withOwn = prepared(4e-5);
  couetteIn(setup).filling.dt.reset();
  EXPECT_EQ(prepared(8e-5), withOwn);
  EXPECT_NE(prepared(4e-5), withOwn);
}

TEST(Couette, PreparationTime) {
  Case setup = quickCell();  // 0.1 s and 2π/100 s
  EXPECT_NEAR(preparationTime(setup), 0.1 + 0.0628319, 1e-7);
  setup.run.dt = 4e-5;
  EXPECT_NEAR(preparationSteps(setup), 4070.8, 0.1);
  couetteIn(setup).filling.dt = 8e-5;
  EXPECT_NEAR(preparationSteps(setup), 2035.4, 0.1);
}

/// Another engine prepares what the case lets it, and a setting of it makes another packing.
TEST(Couette, PreparationEngine_IsPartOfTheHash) {
  Case setup = quickCell();
  couetteIn(setup).filling.engine = "box2d-penalty";
  EXPECT_EQ(ownPreparer(setup)->name, "box2d-penalty");
  EXPECT_NE(preparerKey(setup).find("box2d-penalty 2."), std::string::npos);
  const std::string hash = packingHash(setup, 0, 4e-5);
  setup.engines["box2d-penalty"] = {{"an option", 1.0}};
  EXPECT_NE(packingHash(setup, 0, 4e-5), hash);
}

TEST(Couette, PackingHash_ChangesWithEveryInput) {
  const Case setup = quickCell();
  const std::string hash = packingHash(setup, 0, 4e-5);
  const auto changed = [&](auto change) {
    Case other = setup;
    change(other);
    return packingHash(other, 0, 4e-5);
  };
  EXPECT_NE(hash, packingHash(setup, 0, 3e-5));
  EXPECT_NE(hash, changed([](Case& c) { c.law.kn += 1.0; }));
  EXPECT_NE(hash, changed([](Case& c) { c.law.conventions.leverArm = LeverArm::contactPoint; }));
  EXPECT_NE(hash, changed([](Case& c) { c.bottom = BottomPlate{}; }));
  EXPECT_NE(hash, changed([](Case& c) { couetteIn(c).cell.omega = 0.5; }));
  EXPECT_NE(hash, changed([](Case& c) { couetteIn(c).cell.omega = -1.0; }));
  EXPECT_NE(hash, changed([](Case& c) { couetteIn(c).cell.wallSpacing = 7e-3; }));
  EXPECT_NE(hash, changed([](Case& c) { c.law.en = 0.9; }));
  EXPECT_NE(hash, changed([](Case& c) { c.law.et0 = 0.5; }));
  EXPECT_NE(hash, changed([](Case& c) { c.preparation.seed = 9; }));
  EXPECT_NE(hash, changed([](Case& c) { couetteIn(c).filling.engine = "grain-as-yade"; }));
  EXPECT_EQ(hash,
            changed([](Case& c) { couetteIn(c).filling.engine = "grain"; }));  // as it is anyway
  // 75 and 188 wall disks, whether 75.4 and 188.5 are wanted or 75.1 and 187.7: the same packing.
  EXPECT_EQ(hash, changed([](Case& c) { couetteIn(c).cell.wallSpacing = 2.51e-3; }));
  // Times after the preparation do not change its hash.
  EXPECT_EQ(hash, changed([](Case& c) { couetteIn(c).times.rings = 40; }));
}

TEST(Couette, BadStart_NamesTheDisks) {
  const Case setup = quickCell();
  Packing packing;
  packing.disks = diskKinds(couetteIn(setup).particles);
  for (std::size_t i = 0; i < packing.disks.size(); ++i)
    packing.disks.position[i] = Vec2(0.05 + 0.01 * static_cast<double>(i), 0.0);
  packing.disks.position[7] = packing.disks.position[3] + Vec2(1e-3, 0.0);
  const auto message = [&] {
    return test::refusalOf([&] {
      checkStart(couetteScene(setup, packing, 4e-5), couetteIn(setup).particles, "my.h5");
    });
  };
  EXPECT_EQ(
      message(),
      "my.h5: disk 3 and disk 7 overlap by 0.0064 m at the start, more than particles.max_overlap "
      "= 0.2 of the small radius allows (0.00074 m)");
  packing.disks.position[7] = packing.disks.position[3];
  EXPECT_EQ(message(), "my.h5: disk 3 and disk 7 have the same centre");
  Case crowded = setup;  // the lattice that packings begin with has no room
  couetteIn(crowded).filling.dilation = 1.0;
  EXPECT_THROW(preparePacking(crowded, 0, 4e-5, *makeGrain(), [](double) {}), BadInput);
}

TEST(CheckStart, SphereOutsideACylinder_IsNamedWithItsDistance) {
  SpaceScene scene;
  scene.disks.radius = {0.002};
  scene.disks.mass = scene.disks.inertia = {1.0};
  scene.disks.position = {Vec3(0.0, 0.027, 0.036)};
  scene.disks.velocity = scene.disks.spin = {Vec3::Zero()};
  WallBodyOf<3>& drum = scene.bodies.emplace_back();
  drum.planes.push_back({{0.0, 0.0, -1.0}, {0.0, 0.0, 1.0}});
  drum.cylinders.push_back({Vec3::Zero(), {1.0, 0.0, 0.0}, 0.04});
  Particles particles;
  particles.smallRadius = 0.002;
  const auto message = [&] {
    return test::refusalOf([&] { checkStart(scene, particles, "my.toml"); });
  };
  const std::string outside = "my.toml: sphere 0 lies outside cylinder 0: ";
  EXPECT_EQ(message(), outside + "0.045 m from its axis, with a radius of 0.04 m");
  scene.disks.position[0] *= 1e3;
  EXPECT_EQ(message(), outside + "45 m from its axis, with a radius of 0.04 m; are lengths in mm?");
  scene.disks.position[0] = Vec3(0.0, 0.0, 0.0395);  // too near, and inside
  EXPECT_EQ(message().find("my.toml: sphere 0 and cylinder 0 overlap by 0.0015 m at the start"),
            0u);
}

}  // namespace
