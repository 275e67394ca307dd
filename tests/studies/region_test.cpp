// Averages over a region of an assembly, and endpoints that a case makes up, against sums by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "averaging/fields.hpp"
#include "averaging/statistics.hpp"
#include "cases/assembly_scene.hpp"
#include "studies/flow/averages.hpp"
#include "studies/flow/endpoint_values.hpp"
#include "tests/studies/flow_runs.hpp"

namespace crossgrain {
namespace {

/// Three disks of radius 1 m and mass 2 kg in a box of 6 m × 4 m × ½ m = 12 m³: two touch side by
/// side, the third stands on a plane.
Case threeDisks() {
  Case setup;
  setup.source = Assembly();
  setup.law.normal = NormalLaw::linear;
  setup.law.kn = 100.0;
  DiskGroup group{.position = {0.0, 2.0}, .radius = 1.0, .mass = 2.0};
  group.places = {{0.0, 0.0}, {0.95, 0.0}, {1.5, -0.5}};  // in diameters
  assemblyIn<2>(setup).disks = {group};
  WallGroup floor;
  floor.planes = {{Vec2::Zero(), Vec2::UnitY()}};
  assemblyIn<2>(setup).walls = {floor};
  assemblyIn<2>(setup).duration = 1.0;
  setup.run.dt = 1e-3;
  Region& region = setup.region.emplace();
  region.low = {-2.0, 0.0, 0.0};
  region.high = {4.0, 4.0, 0.0};
  region.height = 0.5;
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

/// The averages of that snapshot, changed if need be.
FlowRun averaged(const Case& setup, const std::function<void(Snapshot&)>& change = {},
                 const EffectiveParameters& effective = {}) {
  const Scene scene = assemblyScene(setup, assemblyDisks(setup, 0), 0.0, 1e-3);
  FlowAverages averages(setup, scene);
  Snapshot now = touching(scene);
  if (change) change(now);
  averages.add(now);
  FlowRun run;
  averages.describe(effective, run);
  return run;
}

double valueOf(const FlowRun& run, const char* field, std::size_t bin = 0) {
  const Profile* const profile = profileOf(run.profiles, "slicing", field);
  return profile ? profile->mean.at(bin).value_or(NAN) : NAN;
}

TEST(Region, WholeBox_HasTheVirialStress) {
  const FlowRun run = averaged(threeDisks());
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

TEST(Region, WithoutContacts_HasNoLargestOverlap) {
  const auto largest = [](const FlowRun& run) {
    return std::ranges::find(run.head, "max_overlap_over_d", &HeadNumber::name)->value;
  };
  EXPECT_NEAR(largest(averaged(threeDisks())).value(), 0.1 / 2.0, 1e-14);
  EXPECT_FALSE(largest(averaged(threeDisks(), [](Snapshot& now) { now.contacts = Contacts{}; })));
}

TEST(Region, Disks_HaveMomentsInTheSeries) {
  const FlowRun run = averaged(threeDisks());
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

/// Else an endpoint of it would be undecided, however many runs there are.
TEST(Region, EveryNumberOfARegion_HasASeries) {
  Case setup = threeDisks();
  for (const RegionNumber& number : regionNumbers(2))
    setup.endpoints.emplace_back().quantity = number.name;
  const FlowRun run = averaged(setup);
  for (const RegionNumber& number : regionNumbers(2)) {
    if (number.name.starts_with("wall_")) continue;  // of a periodic box (space_region_test.cpp)
    EXPECT_TRUE(run.series->contains(std::string(number.name))) << number.name;
  }
}

TEST(Region, Heap_HasTheSlopeOfItsFlanks) {
  // A box from -1 to 3 m, whose strips are 0.1 m wide and begin 0.2 m from the middle, 1 m. Its
  // left flank falls by 0.3 a metre, its right one by 0.5; what lies deeper, nearer or farther is
  // left out.
  Case setup = threeDisks();
  setup.region->low = {-1.0, 0.0, 0.0};
  setup.region->high = {3.0, 4.0, 0.0};
  setup.endpoints.emplace_back().quantity = "flank_slope";
  std::vector<Vec2> heap = {{1.0, 3.0}, {2.05, 3.0}};
  for (int k = 0; k < 8; ++k) {
    const double away = 0.25 + 0.1 * k;
    heap.emplace_back(1.0 - away, 1.0 - 0.3 * away);
    heap.emplace_back(1.0 - away, 0.8 - 0.3 * away);
    heap.emplace_back(1.0 + away, 1.0 - 0.5 * away);
  }
  assemblyIn<2>(setup).disks[0].places.resize(heap.size(), Vec2::Zero());
  const auto slope = [&] {
    const FlowRun run = averaged(setup, [&](Snapshot& now) {
      now.position = heap;
      now.velocity.assign(heap.size(), Vec2::Zero());
      now.spin = std::vector<double>(heap.size(), 0.0);
      now.contacts = Contacts{};
    });
    return valuesOf(*run.series, "flank_slope").back();
  };
  EXPECT_NEAR(slope().value(), 0.4, 1e-14);
  heap.back() = heap.front();  // the outermost strip of the right flank is empty
  EXPECT_FALSE(slope());
  EXPECT_FALSE(averaged(threeDisks()).series->contains("flank_slope"));
}

TEST(Region, Slabs_ShareDisksAndContacts) {
  Case setup = threeDisks();
  setup.region->bins = BinKind::slabs;
  setup.region->axis = 0;
  setup.region->count = 3;  // 2 m each
  const FlowRun run = averaged(setup);
  // Half of the disk at x = 0 lies in the first slab; it carries half of −f_x l_x of that disk.
  EXPECT_NEAR(valueOf(run, "stress_xx", 0), 0.5 * 3.0 / 4.0, 1e-14);
  EXPECT_NEAR(valueOf(run, "velocity_x", 0), 1.0, 1e-14);
  double whole = 0.0;
  for (std::size_t k = 0; k < 3; ++k) whole += 4.0 * valueOf(run, "stress_xx", k);
  EXPECT_NEAR(whole, 6.0, 1e-13);
}

TEST(OwnEndpoints, Reductions_AreMeansBinsSlopesAndRates) {
  Case setup = threeDisks();
  setup.region->bins = BinKind::slabs;
  setup.region->axis = 1;
  setup.region->count = 4;  // centres at 0.5, 1.5, 2.5, 3.5 m
  FlowRun run;
  run.profiles = {test::sliced("velocity_x", {1.0, 3.0, std::nullopt, 7.0}),
                  test::sliced("stress_xy", {-1.0, -1.0, std::nullopt, -6.0}),
                  test::sliced("stress_yy", {8.0, 8.0, 8.0, 8.0}),
                  test::sliced("volume_fraction", {0.2, 0.2, 0.0, 0.6})};
  run.series = RunSeries{{"t_s", {1.0, 2.0, 3.0}}, {"disks", {9.0, 6.0, 3.0}}};
  const auto value = [&](const char* quantity, Reduction reduction, int bin = 0,
                         const char* per = "") {
    Endpoint endpoint;
    endpoint.name = "one";
    endpoint.quantity = quantity;
    endpoint.per = per;
    endpoint.reduction = reduction;
    endpoint.bin = bin;
    setup.endpoints = {endpoint};
    return endpointOf(endpointNamed(setup, "one"), setup, run);
  };
  // Weighted with what the bins hold: 0.2, 0.2 and 0.6.
  EXPECT_NEAR(*value("velocity_x", Reduction::mean), 5.0, 1e-14);
  EXPECT_EQ(value("velocity_x", Reduction::bin, 3), 7.0);
  EXPECT_FALSE(value("velocity_x", Reduction::bin, 2));
  EXPECT_NEAR(*value("velocity_x", Reduction::slope), 2.0, 1e-14);
  // Per volume: the empty bin has no stress, and its volume counts.
  EXPECT_NEAR(*value("stress_xy", Reduction::mean, 0, "stress_yy"), -2.0 / 8.0, 1e-14);
  EXPECT_EQ(value("disks", Reduction::mean), 6.0);
  EXPECT_EQ(value("disks", Reduction::end), 3.0);
  EXPECT_NEAR(*value("disks", Reduction::rate), -3.0, 1e-14);
}

/// A run of four slabs of 1 m, of which the third holds so much.
FlowRun withThirdSlab(double held) {
  FlowRun run;
  const auto of = [&](double value) { return held > 0.0 ? std::optional(value) : std::nullopt; };
  run.profiles = {test::sliced("coordination", {3.0, 2.0, of(9.0), 1.0}),
                  test::sliced("stress_yy", {4.0, 2.0, of(held), 2.0}),
                  test::sliced("spin", {1.0, 2.0, of(50.0), 4.0}),
                  test::sliced("volume_fraction", {0.8, 0.4, held, 0.2})};
  return run;
}

TEST(OwnEndpoints, BinEmptyOrAlmost_GivesTheSameValue) {
  Case setup = threeDisks();
  setup.region->bins = BinKind::slabs;
  setup.region->count = 4;
  for (const char* field : {"coordination", "stress_yy", "spin"})
    for (const Reduction reduction : {Reduction::mean, Reduction::slope}) {
      Endpoint endpoint{.quantity = field, .reduction = reduction};
      const auto valueWith = [&](double held) {
        return endpointValue(endpoint, setup, withThirdSlab(held)).value.value();
      };
      EXPECT_NEAR(valueWith(1e-20), valueWith(0.0), 1e-12) << field;
    }
  Endpoint contacts;
  contacts.quantity = "coordination";  // Σ w V C / Σ w V of the whole
  EXPECT_NEAR(*endpointValue(contacts, setup, withThirdSlab(0.0)).value,
              (0.8 * 3.0 + 0.4 * 2.0 + 0.2 * 1.0) / 1.4, 1e-14);
}

TEST(OwnEndpoints, SeriesWithGaps_IsAbsentWithItsReason) {
  Case setup = threeDisks();
  const auto found = [&](const char* quantity, std::size_t there, Reduction reduction) {
    Endpoint endpoint{.quantity = quantity, .reduction = reduction};
    FlowRun run;
    Numbers times, values, disks;
    for (std::size_t k = 0; k < 100; ++k) {
      times.emplace_back(0.01 * static_cast<double>(k));
      values.push_back(k < there ? std::optional(2.0) : std::nullopt);
      disks.emplace_back(k < there ? 1.0 : 0.0);
    }
    run.series =
        RunSeries{{"t_s", times}, {"mean_x", values}, {"max_overlap", values}, {"disks", disks}};
    run.profiles = {test::sliced("velocity_x", {2.0}), test::sliced("volume_fraction", {0.5})};
    return endpointValue(endpoint, setup, run);
  };
  for (const char* quantity : {"mean_x", "velocity_x"}) {
    EXPECT_EQ(found(quantity, 95, Reduction::mean).value, 2.0) << quantity;
    const EndpointValue gone = found(quantity, 40, Reduction::mean);
    EXPECT_FALSE(gone.value) << quantity;
    EXPECT_NE(gone.why.find("60 of 100 snapshots"), std::string::npos) << gone.why;
  }
  EXPECT_FALSE(found("mean_x", 40, Reduction::end).value);
  // Without a contact there is no overlap: nothing is missing of the largest.
  EXPECT_EQ(found("max_overlap", 40, Reduction::maximum).value, 2.0);
  EXPECT_FALSE(found("mean_x", 40, Reduction::maximum).value);
}

/// y = 3 + 2 t − 5 t² at ten instants, and the velocity of half a step later.
FlowRun thrown() {
  FlowRun run;
  Numbers times, heights, later, speeds;
  for (int k = 1; k <= 10; ++k) {
    const double t = 0.07 * k;
    times.emplace_back(t);
    heights.emplace_back(3.0 + 2.0 * t - 5.0 * t * t);
    later.emplace_back(t + 0.01);
    speeds.emplace_back(2.0 - 10.0 * (t + 0.01));
  }
  run.series = RunSeries{{"t_s", times},
                         {"disk_2_y", heights},
                         {"velocity_t_s", later},
                         {"disk_2_velocity_y", speeds}};
  return run;
}

TEST(OwnEndpoints, WhatJumpsHasNoParabola) {
  const Case setup = threeDisks();
  Endpoint endpoint{.quantity = "spin", .disk = 2};
  const auto value = [&](Reduction reduction, const std::vector<double>& spins) {
    FlowRun run;
    Numbers times;
    for (std::size_t k = 0; k < spins.size(); ++k)
      times.emplace_back(0.1 * static_cast<double>(k + 1));
    run.series = RunSeries{{"t_s", times},
                           {"velocity_t_s", times},
                           {"disk_2_spin", Numbers(spins.begin(), spins.end())}};
    endpoint.reduction = reduction;
    return *endpointValue(endpoint, setup, run).value;
  };
  // An impact: through (1, 8, 8) a parabola has 8.875.
  EXPECT_EQ(value(Reduction::maximum, {0, 1, 8, 8, 8}), 8.0);
  EXPECT_EQ(value(Reduction::maximum, {0, 1, 8, 7.5, 7}), 8.0);
  EXPECT_EQ(value(Reduction::maximum, {7, 7.5, 8, 0, 0}), 8.0);
  EXPECT_EQ(value(Reduction::minimum, {0, -1, -8, -8, -8}), -8.0);
  EXPECT_EQ(value(Reduction::maximum, {0, 0, 8, 0, 0}), 8.0);
  // A swing of 13 snapshots a period, its peak of 1 between two of them.
  std::vector<double> swing;
  for (int k = 0; k < 7; ++k) swing.push_back(std::cos(0.5 * k - 1.3));
  EXPECT_NEAR(value(Reduction::maximum, swing), 1.0, 2e-3);
  EXPECT_GT(value(Reduction::maximum, swing), std::ranges::max(swing));
  // Free flight of four snapshots between two bounces: its parabola is known.
  EXPECT_NEAR(value(Reduction::maximum, {1, 0, 1.75, 2.25, 2, 1, 0}), 2.25 + 1.0 / 96.0, 1e-12);
}

TEST(OwnEndpoints, OneDisk_HasApexesTimesAndEvents) {
  const Case setup = threeDisks();
  Endpoint endpoint{.quantity = "y", .disk = 2};
  const auto value = [&](Reduction reduction, double level = 0.0) {
    endpoint.reduction = reduction;
    endpoint.level = level;
    return endpointValue(endpoint, setup, thrown()).value;
  };
  EXPECT_NEAR(*value(Reduction::maximum), 3.2, 1e-12);  // at 0.2 s, between two snapshots
  EXPECT_NEAR(*value(Reduction::minimum), 3.0 + 1.4 - 5.0 * 0.49, 1e-12);  // the last one
  EXPECT_NEAR(*value(Reduction::time, 0.5), 3.0 + 1.0 - 1.25, 1e-12);
  // Between two snapshots a straight line: off by g τ²/8 over the speed.
  EXPECT_NEAR(*value(Reduction::reaches, 2.75), 0.5, 10.0 * 0.07 * 0.07 / 8.0 / 3.0);
  EXPECT_FALSE(value(Reduction::reaches, 4.0));
  // Snapshots end at 0.7 s, and the case at 1 s: no other time stands in for it.
  EXPECT_FALSE(value(Reduction::time, 0.9));
  EXPECT_FALSE(value(Reduction::end));
  EXPECT_EQ(endpointValue(endpoint, setup, thrown()).why, "no snapshot near t = 1 s");
  EXPECT_TRUE(endpointValue(endpoint, setup, thrown()).notCovered);
  endpoint.between = {0.8, 0.9};
  EXPECT_FALSE(value(Reduction::maximum));
  EXPECT_EQ(endpointValue(endpoint, setup, thrown()).why, "no snapshot from 0.8 to 0.9 s");
  endpoint.between = {0.3, 0.7};
  EXPECT_NEAR(*value(Reduction::maximum), 3.0 + 2.0 * 0.35 - 5.0 * 0.35 * 0.35, 1e-12);
  EXPECT_NEAR(*value(Reduction::end), 3.0 + 1.4 - 5.0 * 0.49, 1e-12);
  endpoint.between.reset();
  endpoint.quantity = "velocity_y";
  EXPECT_NEAR(*value(Reduction::time, 0.3), -1.0, 1e-12);  // at its own instants
  EXPECT_NEAR(*value(Reduction::reaches, 0.0), 0.2, 1e-12);
}

TEST(Region, EndpointsOfDisks_AreKeptWithTheLedger) {
  Case setup = threeDisks();
  Endpoint height, fall;
  height.disk = fall.disk = 2;
  height.quantity = "y";
  fall.quantity = "velocity_y";
  setup.endpoints = {height, fall, height};
  EffectiveParameters effective;
  effective.velocityLag = 0.25;
  const FlowRun run = averaged(
      setup,
      [](Snapshot& now) {
        now.velocityTime = 0.1;
        now.ledger.emplace().kinetic = 6.0;
      },
      effective);
  EXPECT_EQ(valuesOf(*run.series, "energy_kinetic"), Numbers{6.0});
  EXPECT_TRUE(run.series->contains("energy_residual"));
  EXPECT_EQ(valuesOf(*run.series, "disk_2_y"), Numbers{1.0});
  EXPECT_EQ(valuesOf(*run.series, "disk_2_velocity_y"), Numbers{2.0});
  EXPECT_NEAR(*valuesOf(*run.series, "velocity_t_s").front(), -0.15, 1e-14);
}

/// Velocities of one disk alone, the mean over the box is their mean.
TEST(Region, EndpointErrors_AreThoseOfTheSeriesOfAPlainMean) {
  Case setup = threeDisks();
  Endpoint mean, last;
  mean.name = "vy";
  mean.quantity = "velocity_y";
  last.name = "end";
  last.quantity = "kinetic_energy";
  last.reduction = Reduction::end;
  setup.endpoints = {mean, last};
  setup.averaging.endpoints["vy"] = setup.averaging.endpoints["end"] = {0.1, false, "", ""};
  const Scene scene = assemblyScene(setup, assemblyDisks(setup, 0), 0.0, 1e-3);
  FlowAverages averages(setup, scene);
  Snapshot now = touching(scene);
  std::vector<double> series;
  double x = 0.0;
  for (int t = 0; t < 192; ++t) {  // 64 parts of 3, correlated over some ten snapshots
    x = 0.9 * x + std::sin(1.7 * t * t);
    now.velocity = {{0.0, x}, {0.0, 0.0}, {0.0, 0.0}};
    series.push_back(x / 3.0);
    averages.add(now);
  }
  FlowRun run;
  averages.describe({}, run);
  const auto errors = endpointErrors(setup, averages, run);
  ASSERT_EQ(errors.size(), 1u);  // the last value has no error of this kind
  EXPECT_EQ(errors[0].endpoint, "vy");
  std::vector<double> parts;
  for (std::size_t k = 0; k < 64; ++k)
    parts.push_back((series[3 * k] + series[3 * k + 1] + series[3 * k + 2]) / 3.0);
  const MeanEstimate expected = estimateMean(parts);
  EXPECT_NEAR(errors[0].standardError, *expected.standardError, 1e-12);
  EXPECT_NEAR(errors[0].dof, expected.dof, 1e-12);
  // One snapshot says nothing of its error.
  FlowAverages one(setup, scene);
  one.add(now);
  FlowRun brief;
  one.describe({}, brief);
  EXPECT_TRUE(endpointErrors(setup, one, brief).empty());
}

}  // namespace
}  // namespace crossgrain
