// Averages over a region of an assembly, and endpoints that a case makes up, against sums by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "averaging/fields.hpp"
#include "cases/assembly_scene.hpp"
#include "runs/couette/endpoint_values.hpp"
#include "runs/couette/region_averages.hpp"

namespace crossgrain {
namespace {

/// Three disks of radius 1 m and mass 2 kg in a box of 6 m × 4 m × ½ m = 12 m³: two touch side by
/// side, the third stands on a plane.
Case threeDisks() {
  Case setup;
  setup.kind = CaseKind::assembly;
  setup.law.normal = NormalLaw::linear;
  setup.law.kn = 100.0;
  DiskGroup group;
  group.radius = 1.0;
  group.mass = 2.0;
  group.position = {0.0, 2.0};
  group.places = {{0.0, 0.0}, {0.95, 0.0}, {1.5, -0.5}};  // in diameters
  setup.assembly.disks = {group};
  WallGroup floor;
  floor.planes = {{Vec2::Zero(), Vec2::UnitY()}};
  setup.assembly.walls = {floor};
  setup.assembly.duration = 1.0;
  setup.run.dt = 1e-3;
  Average& average = setup.average.emplace();
  average.region.low = {-2.0, 0.0};
  average.region.high = {4.0, 4.0};
  average.region.height = 0.5;
  return setup;
}

/// f_n = 3 N and f_t = 0.4 N between the pair, f_n = 2 N on the plane (id 3).
Snapshot touching(const Scene& scene) {
  Snapshot now;
  now.positionTime = 0.1;
  now.position = scene.disks.position;
  now.velocity = {{1.0, 0.0}, {-1.0, 0.0}, {0.0, 2.0}};
  now.spin = std::vector<double>(3, 0.0);
  Contacts contacts;
  contacts.i = {0, 2};
  contacts.j = {1, 3};
  contacts.normal = {{-1.0, 0.0}, {0.0, 1.0}};
  contacts.overlap = {0.1, 0.02};
  contacts.normalForce = {3.0, 2.0};
  contacts.tangentialForce = {0.4, 0.0};
  now.contacts = contacts;
  return now;
}

CouetteRun averaged(const Case& setup) {
  const Scene scene = assemblyScene(setup, assemblyDisks(setup, 0), 0.0, 1e-3);
  RegionAverages averages(setup, scene);
  averages.add(touching(scene));
  CouetteRun run;
  averages.describe(Realised{}, run);
  return run;
}

double valueOf(const CouetteRun& run, const char* field, std::size_t bin = 0) {
  const Profile* const profile = profileOf(run.profiles, "slicing", field);
  return profile ? profile->mean.at(bin).value_or(NAN) : NAN;
}

TEST(Region, HasTheVirialStressOfAWholeBox) {
  const CouetteRun run = averaged(threeDisks());
  // σ_αβ = −(1/V) Σ f_α l_β, f on the disk, l = 1 m from its centre to the contact: both disks of
  // the pair have f_x l_x = −3 N m and, of f_t along z × n = (0, −1) on the first, f_y l_x = −0.4.
  EXPECT_NEAR(valueOf(run, "stress_xx"), 2.0 * 3.0 / 12.0, 1e-14);
  EXPECT_NEAR(valueOf(run, "stress_yx"), 2.0 * 0.4 / 12.0, 1e-14);
  EXPECT_NEAR(valueOf(run, "stress_xy"), 0.0, 1e-14);
  EXPECT_NEAR(valueOf(run, "stress_yy"), 2.0 / 12.0, 1e-14);
  EXPECT_NEAR(valueOf(run, "dynamic_stress_yy"), 2.0 * 4.0 / 12.0, 1e-14);  // m v_y²/V
  EXPECT_NEAR(valueOf(run, "velocity_y"), 2.0 / 3.0, 1e-14);
  EXPECT_NEAR(valueOf(run, "coordination"), 1.0, 1e-14);
  EXPECT_NEAR(valueOf(run, "volume_fraction"), 3.0 * std::acos(-1.0) * 0.5 / 12.0, 1e-14);
  EXPECT_TRUE(std::isnan(valueOf(run, "stress_rr")));  // a name of rings
}

TEST(Region, HasNoLargestOverlapWherePairsShowNone) {
  Case setup = threeDisks();
  const Scene scene = assemblyScene(setup, assemblyDisks(setup, 0), 0.0, 1e-3);
  const auto largest = [&](const Snapshot& now) {
    RegionAverages averages(setup, scene);
    averages.add(now);
    CouetteRun run;
    averages.describe(Realised{}, run);
    return std::ranges::find(run.head, "max_overlap_over_d", &HeadNumber::name)->value;
  };
  Snapshot now = touching(scene);
  EXPECT_NEAR(largest(now).value(), 0.1 / 2.0, 1e-14);
  now.contacts = Contacts{};
  EXPECT_FALSE(largest(now));
}

TEST(Region, HasMomentsOfItsDisks) {
  const CouetteRun run = averaged(threeDisks());
  const auto last = [&](const char* name) { return *valuesOf(*run.series, name).back(); };
  // Centres (0, 2), (1.9, 2), (3, 1) m.
  EXPECT_EQ(last("disks"), 3.0);
  EXPECT_NEAR(last("top"), 3.0, 1e-14);
  EXPECT_NEAR(last("mean_x"), 4.9 / 3.0, 1e-14);
  EXPECT_NEAR(last("mean_y"), 5.0 / 3.0, 1e-14);
  const double square = (1.9 * 1.9 + 9.0) / 3.0 - (4.9 / 3.0) * (4.9 / 3.0);
  EXPECT_NEAR(last("rms_x"), std::sqrt(square), 1e-14);
  EXPECT_NEAR(last("heap_slope"), 3.0 * (5.0 / 3.0) / std::sqrt(6.0 * square), 1e-14);
  EXPECT_NEAR(last("kinetic_energy"), 0.5 * 2.0 * (1.0 + 1.0 + 4.0), 1e-14);
}

TEST(Region, IsCutIntoSlabsAlongTheAxis) {
  Case setup = threeDisks();
  setup.average->region.bins = BinKind::slabs;
  setup.average->region.axis = 0;
  setup.average->region.count = 3;  // 2 m each
  const CouetteRun run = averaged(setup);
  // Half of the disk at x = 0 lies in the first slab; it carries half of −f_x l_x of that disk.
  EXPECT_NEAR(valueOf(run, "stress_xx", 0), 0.5 * 3.0 / 4.0, 1e-14);
  EXPECT_NEAR(valueOf(run, "velocity_x", 0), 1.0, 1e-14);
  double whole = 0.0;
  for (std::size_t k = 0; k < 3; ++k) whole += 4.0 * valueOf(run, "stress_xx", k);
  EXPECT_NEAR(whole, 6.0, 1e-13);
}

TEST(OwnEndpoints, AreMeansBinsSlopesAndRates) {
  Case setup = threeDisks();
  setup.average->region.bins = BinKind::slabs;
  setup.average->region.axis = 1;
  setup.average->region.count = 4;  // centres at 0.5, 1.5, 2.5, 3.5 m
  CouetteRun run;
  run.profiles = {{"slicing", "velocity_x", "m/s", {1.0, 3.0, std::nullopt, 7.0}, {}, {}, {}},
                  {"slicing", "stress_xy", "N/m²", {-1.0, -1.0, -2.0, -4.0}, {}, {}, {}},
                  {"slicing", "stress_yy", "N/m²", {8.0, 8.0, 8.0, 8.0}, {}, {}, {}}};
  run.series = RunSeries{{"t_s", {1.0, 2.0, 3.0}}, {"disks", {9.0, 6.0, 3.0}}};
  const auto value = [&](const char* quantity, Reduction reduction, int bin = 0,
                         const char* per = "") {
    OwnEndpoint endpoint;
    endpoint.name = "one";
    endpoint.quantity = quantity;
    endpoint.per = per;
    endpoint.reduction = reduction;
    endpoint.bin = bin;
    setup.average->endpoints = {endpoint};
    return endpointOf(endpointSpec(setup, "one"), setup, run);
  };
  EXPECT_NEAR(*value("velocity_x", Reduction::mean), 11.0 / 3.0, 1e-14);
  EXPECT_EQ(value("velocity_x", Reduction::bin, 3), 7.0);
  EXPECT_FALSE(value("velocity_x", Reduction::bin, 2));
  EXPECT_NEAR(*value("velocity_x", Reduction::slope), 2.0, 1e-14);
  EXPECT_NEAR(*value("stress_xy", Reduction::mean, 0, "stress_yy"), -0.25, 1e-14);
  EXPECT_EQ(value("disks", Reduction::mean), 6.0);
  EXPECT_EQ(value("disks", Reduction::end), 3.0);
  EXPECT_NEAR(*value("disks", Reduction::rate), -3.0, 1e-14);
}

}  // namespace
}  // namespace crossgrain
