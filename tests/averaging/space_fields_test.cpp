// Fields in space: sums that can be done by hand, and identities.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "averaging/fields.hpp"
#include "averaging/profiles.hpp"
#include "averaging/space_rings.hpp"
#include "tests/averaging/scenes.hpp"

namespace crossgrain {
namespace {

using std::numbers::pi;

/// A scene of spheres and one instant of it.
struct SpaceInstant {
  SpaceScene scene;
  SpaceSnapshot snapshot;

  SpaceInstant() { snapshot.contacts.emplace(); }

  std::int32_t addSphere(const Vec3& x, double a, double mass = 1.0, const Vec3& v = Vec3::Zero()) {
    scene.disks.radius.push_back(a);
    scene.disks.mass.push_back(mass);
    snapshot.position.push_back(x);
    snapshot.velocity.push_back(v);
    return static_cast<std::int32_t>(scene.disks.size()) - 1;
  }
  /// A body of one wall sphere, and one of a plane; their ids follow the spheres'.
  void addWallSphere(double a) {
    scene.bodies.push_back({.diskPosition = {Vec3::Zero()}, .diskRadius = {a}});
  }
  void addPlane() { scene.bodies.emplace_back().planes.emplace_back(); }
  void addContact(std::int32_t i, std::int32_t j, const Vec3& normal, double overlap,
                  double normalForce, const Vec3& tangential = Vec3::Zero()) {
    auto& contacts = *snapshot.contacts;
    contacts.i.push_back(i);
    contacts.j.push_back(j);
    contacts.normal.push_back(normal);
    contacts.overlap.push_back(overlap);
    contacts.normalForce.push_back(normalForce);
    contacts.tangentialForce.push_back(tangential);
  }
};

std::vector<SpaceMoments> momentsOf(const std::shared_ptr<const SpaceBins>& bins,
                                    const SpaceInstant& instant,
                                    const Weight& weight = WeightMethod::slicing) {
  SpaceMomentSums sums(bins, {weight}, instant.scene);
  std::vector<std::vector<SpaceMoments>> moments;
  sums.compute(instant.snapshot, moments);
  return moments.front();
}

double field(const char* name, const SpaceBins& bins, const std::vector<SpaceMoments>& moments,
             std::size_t slot) {
  const auto table = fieldsOf(bins);
  const auto spec = std::ranges::find(table, name, &FieldSpec::name);
  if (spec == table.end()) throw std::invalid_argument(name);
  const auto value = evaluate(*spec, BinView(bins, moments, slot));
  return value ? value->value : NAN;
}

std::shared_ptr<const Cells> slabs(const Vec3& low, const Vec3& high, int count,
                                   std::array<bool, 3> periodic, int axis = 2) {
  std::array<int, 3> counts = {1, 1, 1};
  counts[static_cast<std::size_t>(axis)] = count;
  return std::make_shared<Cells>(low, high, counts, BoxOf<3>{low, high, periodic}, axis);
}

const std::array<bool, 3> everywhere = {true, true, true}, across = {true, true, false};

/// n³ touching spheres (a = ½) that fill a box of n, pushed together by that force.
SpaceInstant cubicLattice(int n, const Vec3& force, const Vec3& shift) {
  SpaceInstant instant;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) instant.addSphere(shift + Vec3(x + 0.5, y + 0.5, z + 0.5), 0.5);
  const auto id = [n](int x, int y, int z) { return x % n + n * (y % n + n * (z % n)); };
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        for (int k = 0; k < 3; ++k) {
          const int i = id(x, y, z), j = id(x + (k == 0), y + (k == 1), z + (k == 2));
          // The normal points from j to i, and i is the smaller: its image may lie beyond.
          instant.addContact(std::min(i, j), std::max(i, j), (i < j ? -1.0 : 1.0) * Vec3::Unit(k),
                             0.0, force[k]);
        }
  return instant;
}

/// Bodies of 2 × 1 × ½ about their centres.
SpaceInstant blocks(const std::vector<std::pair<Vec3, TurnOf<3>>>& placed) {
  SpaceInstant instant;
  SpaceScene& scene = instant.scene;
  scene.shapes = {{ShapeKind::box, {}, 0.0}};
  for (const double x : {-1.0, 1.0})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.25, 0.25}) scene.shapes[0].vertices.emplace_back(x, y, z);
  instant.snapshot.turn.emplace();
  for (const auto& [position, turn] : placed) {
    instant.addSphere(position, scene.shapes[0].reach());
    scene.disks.shape.push_back(0);
    instant.snapshot.turn->push_back(turn);
  }
  scene.disks.turn = *instant.snapshot.turn;
  return instant;
}

TEST(ConvexBodiesInSpace, BlockBetweenPlanesHasTheStressOfItsTwoCorners) {
  // f = (1, 0, 3) N at its corner (−1, −½, −¼) and −f at (1, ½, ¼): −Σ f⊗l = −2 f⊗(−1, −½, −¼), so
  // that σ_xx, σ_xy, σ_xz are 2, 1, ½ and σ_zx, σ_zy, σ_zz 6, 3, 3/2 over the volume of 64.
  SpaceInstant instant = blocks({{Vec3(0.3, 0.2, 0.1), noTurn<3>()}});
  instant.addPlane();
  instant.addPlane();
  instant.addContact(0, 1, Vec3::UnitZ(), 0.0, 3.0, Vec3::UnitX());
  instant.addContact(0, 2, -Vec3::UnitZ(), 0.0, 3.0, -Vec3::UnitX());
  instant.snapshot.contacts->point = {{-0.7, -0.3, -0.15}, {1.3, 0.7, 0.35}};
  const auto bins = slabs(Vec3::Constant(-2.0), Vec3::Constant(2.0), 1, {false, false, false});
  const auto moments = momentsOf(bins, instant);
  for (const auto& [name, value] : {std::pair("stress_xx", 2.0),
                                    {"stress_xy", 1.0},
                                    {"stress_xz", 0.5},
                                    {"stress_yx", 0.0},
                                    {"stress_yy", 0.0},
                                    {"stress_yz", 0.0},
                                    {"stress_zx", 6.0},
                                    {"stress_zy", 3.0},
                                    {"stress_zz", 1.5}})
    EXPECT_NEAR(field(name, *bins, moments, 1), value / 64.0, 1e-15) << name;
  EXPECT_NEAR(field("volume_fraction", *bins, moments, 1), 1.0 / 64.0, 1e-15);
  EXPECT_EQ(field("coordination", *bins, moments, 1), 2.0);  // points, not partners
  // Stood on end by 90° about y the same body reaches from z = −0.9 to 1.1: 1.1 of its 2 m of
  // height lie above 0, of which 16 layers of points find 9/16 (0.55 to the layer).
  SpaceInstant stood = blocks({{Vec3(0.3, 0.2, 0.1), {std::sqrt(0.5), 0, std::sqrt(0.5), 0}}});
  const auto halves = slabs(Vec3::Constant(-2.0), Vec3::Constant(2.0), 2, {false, false, false});
  const auto cut = momentsOf(halves, stood);
  EXPECT_NEAR(field("volume_fraction", *halves, cut, 2), 9.0 / 16.0 / 32.0, 1e-15);
  EXPECT_NEAR(field("volume_fraction", *halves, cut, 1), 7.0 / 16.0 / 32.0, 1e-15);
}

TEST(ConvexBodiesInSpace, StressOfAPairIsThatOfItsTwoArms) {
  // One acts on the other with f = (1, 2, 4) N at (0.5, 0.1, 0.2), off the line of their centres:
  // the arms are (0.5, 0.1, 0.2) from (0, 0, 0) and (0.1, 0.1, −0.3) from (0.4, 0, 0.5), and
  // −(−f)⊗l_0 − f⊗l_1 = f⊗(0.4, 0, 0.5), the branch, wherever they touch. So σ_zx = 4 · 0.4 / 64.
  const double half = std::sqrt(0.5);
  SpaceInstant instant =
      blocks({{Vec3::Zero(), noTurn<3>()}, {Vec3(0.4, 0.0, 0.5), {half, 0.0, 0.0, half}}});
  instant.addContact(0, 1, -Vec3::UnitZ(), 0.0, 4.0, Vec3(-1.0, -2.0, 0.0));  // on body 0
  instant.snapshot.contacts->point = {{0.5, 0.1, 0.2}};
  const auto bins = slabs(Vec3::Constant(-2.0), Vec3::Constant(2.0), 1, {false, false, false});
  const auto moments = momentsOf(bins, instant);
  for (const auto& [name, value] : {std::pair("stress_xx", 0.4),
                                    {"stress_xz", 0.5},
                                    {"stress_yx", 0.8},
                                    {"stress_yz", 1.0},
                                    {"stress_zx", 1.6},
                                    {"stress_zy", 0.0},
                                    {"stress_zz", 2.0}})
    EXPECT_NEAR(field(name, *bins, moments, 1), value / 64.0, 1e-15) << name;
  EXPECT_NEAR(field("volume_fraction", *bins, moments, 1), 2.0 / 64.0, 1e-15);
  EXPECT_EQ(field("coordination", *bins, moments, 1), 1.0);
}

TEST(SpaceFields, LatticeIsUniformWhereverItLies) {
  constexpr int n = 3;
  for (const double shift : {0.0, 0.123, 1.0, -7.77}) {
    const SpaceInstant lattice = cubicLattice(n, Vec3(1.0, 2.0, 3.0), Vec3::Constant(shift));
    // Stress lies along branches, and is even in slabs of any width; volume in whole layers.
    for (const int count : {3, 7}) {
      const auto bins = slabs(Vec3::Zero(), Vec3::Constant(n), count, everywhere);
      for (const Weight& weight : {Weight(WeightMethod::slicing), Weight(WeightMethod::centre),
                                   Weight(WeightMethod::gauss, 0.2)}) {
        const auto moments = momentsOf(bins, lattice, weight);
        for (std::size_t slot = 1; slot < bins->slots(); ++slot) {
          EXPECT_NEAR(field("stress_zz", *bins, moments, slot), 3.0, 1e-12);
          EXPECT_NEAR(field("stress_xz", *bins, moments, slot), 0.0, 1e-15);
          if (weight.method == WeightMethod::slicing && count == n) {
            EXPECT_NEAR(field("stress_xx", *bins, moments, slot), 1.0, 1e-12);
            EXPECT_NEAR(field("volume_fraction", *bins, moments, slot), pi / 6.0, 1e-12);
            EXPECT_NEAR(field("coordination", *bins, moments, slot), 6.0, 1e-12);
            EXPECT_NEAR(field("fabric_trace", *bins, moments, slot), pi, 1e-12) << "ν C";
            EXPECT_NEAR(field("fabric_yy", *bins, moments, slot), pi / 3.0, 1e-12);
            EXPECT_NEAR(field("contact_density", *bins, moments, slot), 3.0, 1e-12);
            EXPECT_NEAR(field("pressure", *bins, moments, slot), 2.0, 1e-12);
          }
        }
      }
    }
  }
}

TEST(SpaceFields, LatticeOfSprings_StrainAndModuliByHand) {
  SpaceInstant lattice = cubicLattice(3, Vec3(1.0, 2.0, 3.0), Vec3::Zero());
  auto& overlap = lattice.snapshot.contacts->overlap;
  for (std::size_t c = 0; c < overlap.size(); ++c)  // δ = f/100 along x, y and z by turns
    overlap[c] = 0.01 * static_cast<double>(c % 3 + 1);
  const auto whole = slabs(Vec3::Zero(), Vec3::Constant(3.0), 1, everywhere);
  const auto moments = momentsOf(whole, lattice);
  const auto of = [&](const char* name) { return field(name, *whole, moments, 1); };
  EXPECT_NEAR(of("strain_xx"), 0.02, 1e-14);  // δ/a
  EXPECT_NEAR(of("strain_zz"), 0.06, 1e-14);
  EXPECT_NEAR(of("strain_xy"), 0.0, 1e-15);
  EXPECT_NEAR(of("strain_deviator"), 0.04, 1e-14);
  // Branches are 2a − δ long: σ = f (1 − δ) per area 1.
  const double xx = 1.0 * 0.99, yy = 2.0 * 0.98, zz = 3.0 * 0.97;
  EXPECT_NEAR(of("stress_deviator"), zz - xx, 1e-12);
  EXPECT_NEAR(of("bulk_modulus"), (xx + yy + zz) / 0.12, 1e-11);
  EXPECT_NEAR(of("shear_modulus"), (zz - xx) / 0.04, 1e-11);
  EXPECT_NEAR(of("full_stress_zz"), zz, 1e-12);
  EXPECT_NEAR(of("fabric_deviator"), 0.0, 1e-12);
}

/// Spheres everywhere in and about a box of (2, 3, 4), some in contact across its borders.
SpaceInstant randomInstant(const Vec3& shift) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto vector = [&] { return Vec3(unit(generator), unit(generator), unit(generator)); };
  SpaceInstant instant;
  instant.snapshot.spin.emplace();
  for (int k = 0; k < 40; ++k) {
    instant.addSphere(4.0 * vector() + shift, 0.2 + 0.1 * unit(generator), 1.5 + unit(generator),
                      vector());
    instant.snapshot.spin->push_back(vector());
  }
  for (int k = 0; k < 30; ++k)
    instant.addContact(k, k + 1 + k % 5, vector().normalized(), 0.01, unit(generator),
                       0.3 * vector());
  return instant;
}

TEST(SpaceFields, SlopesMatchFiniteDifferences) {
  SpaceInstant instant = randomInstant(Vec3::Zero());
  for (int k = 0; k < 38; ++k)  // so that some spheres are held
    instant.addContact(k, k + 2, Vec3(1.0, k, -2.0).normalized(), 0.02, 1.0);
  const auto whole = slabs(Vec3::Zero(), Vec3(2.0, 3.0, 4.0), 1, everywhere);
  test::expectSlopes(*whole, momentsOf(whole, instant), 1);
}

TEST(SpaceFields, SumsOverSlabsAreThoseOfTheWhole) {
  const SpaceInstant instant = randomInstant(Vec3::Zero());
  const Vec3 size(2.0, 3.0, 4.0);
  const auto whole = slabs(Vec3::Zero(), size, 1, everywhere);
  const auto total = momentsOf(whole, instant)[1];
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();  // Σ f⊗l, and Σ m v⊗v, by hand
  const auto& contacts = *instant.snapshot.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto i = static_cast<std::size_t>(contacts.i[c]);
    const auto j = static_cast<std::size_t>(contacts.j[c]);
    const double length = instant.scene.disks.radius[i] + instant.scene.disks.radius[j] - 0.01;
    stress += contacts.force(c) * (length * contacts.normal[c]).transpose();
  }
  for (int q = 0; q < 9; ++q) {
    const auto [row, column] = tensorIn<3>[static_cast<std::size_t>(q)];
    EXPECT_NEAR(at(total, Moment::stress, q), stress(row, column), 1e-12);
  }
  EXPECT_NEAR(at(total, Moment::branches), 30.0, 1e-12);
  for (const int axis : {0, 1, 2})
    for (const Weight& weight :
         {Weight(WeightMethod::slicing), Weight(WeightMethod::centre),
          Weight(WeightMethod::heaviside, 0.4), Weight(WeightMethod::lucy, 0.6)}) {
      const auto bins = slabs(Vec3::Zero(), size, 5, everywhere, axis);
      const auto moments = momentsOf(bins, instant, weight);
      for (std::size_t q = 0; q < std::tuple_size_v<SpaceMoments>; ++q) {
        double sum = 0.0;
        for (std::size_t slot = 1; slot < bins->slots(); ++slot) sum += moments[slot][q];
        EXPECT_NEAR(sum, total[q], 1e-12) << "moment " << q << " along " << axis;
      }
    }
}

TEST(SpaceFields, WhatIsShiftedByAThirdOfTheBoxIsShiftedByAThirdOfTheSlabs) {
  const Vec3 size(2.0, 3.0, 4.0);
  const auto bins = slabs(Vec3::Zero(), size, 6, everywhere);
  for (const Weight& weight : {Weight(WeightMethod::slicing), Weight(WeightMethod::gauss, 0.3)}) {
    const auto here = momentsOf(bins, randomInstant(Vec3::Zero()), weight);
    const auto there = momentsOf(bins, randomInstant(size / 3.0), weight);
    for (std::size_t slab = 0; slab < 6; ++slab)
      for (std::size_t q = 0; q < std::tuple_size_v<SpaceMoments>; ++q)
        EXPECT_NEAR(there[1 + (slab + 2) % 6][q], here[1 + slab][q], 1e-12) << q;
  }
}

TEST(SpaceFields, PairAcrossABorderCountsOnBothSides) {
  SpaceInstant pair;  // centres 0.4 apart through the border, as images far from each other
  pair.addSphere(Vec3(0.5, 0.5, 0.2), 0.25);
  pair.addSphere(Vec3(7.5, -0.5, 3.8), 0.25);
  pair.addContact(0, 1, Vec3::UnitZ(), 0.1, 2.0);
  const auto bins = slabs(Vec3::Zero(), Vec3(1.0, 1.0, 4.0), 4, everywhere);
  const auto moments = momentsOf(bins, pair);
  // Half of the branch in slabs of volume 1: 2 N · 0.2 m.
  for (const std::size_t slot : {1U, 4U})
    EXPECT_NEAR(field("stress_zz", *bins, moments, slot), 0.4, 1e-15);
  for (const std::size_t slot : {2U, 3U}) EXPECT_EQ(field("stress_zz", *bins, moments, slot), 0.0);
  EXPECT_NEAR(at(moments[1], Moment::volume), 4.0 * pi / 3.0 * std::pow(0.25, 3), 1e-15);
}

TEST(SpaceFields, WallForceIsTheStressOfTheSlabNextToIt) {
  // A sphere is held between a wall sphere below it and a plane above; both push and drag.
  SpaceInstant held;
  held.addSphere(Vec3(1.0, 1.0, 0.45), 0.5);
  held.addWallSphere(0.3);
  held.addPlane();
  const Vec3 force(0.5, 0.25, 3.0);  // of the lower wall on the sphere
  held.addContact(0, 1, Vec3::UnitZ(), 0.02, force.z(), Vec3(force.x(), force.y(), 0.0));
  held.addContact(0, 2, -Vec3::UnitZ(), 0.04, force.z(), -Vec3(force.x(), force.y(), 0.0));
  // From where the lower wall's force acts, 0.49 below the centre, to the plane 0.46 above.
  const double area = 4.0 * 5.0, low = 0.45 - 0.49, high = 0.45 + 0.46;
  const auto bins = slabs(Vec3(0.0, 0.0, low), Vec3(4.0, 5.0, high), 5, across);
  const auto moments = momentsOf(bins, held);
  for (std::size_t slot = 1; slot < bins->slots(); ++slot) {
    EXPECT_NEAR(field("stress_xz", *bins, moments, slot), force.x() / area, 1e-14);
    EXPECT_NEAR(field("stress_yz", *bins, moments, slot), force.y() / area, 1e-14);
    EXPECT_NEAR(field("stress_zz", *bins, moments, slot), force.z() / area, 1e-14);
    EXPECT_EQ(field("stress_zx", *bins, moments, slot), 0.0);
  }
}

TEST(SpaceFields, WeightAboveIsCarriedDownToTheFloorAndThroughIt) {
  // A column on a plane at z = 0; σ_zz(z) = ∫ (ρ g − t) above z for any function (Weinhart 2012).
  constexpr int spheres = 4;
  constexpr double g = 9.81, m = 0.7, height = 6.0, low = -2.0, dz = 0.02;
  SpaceInstant column;
  for (int k = 0; k < spheres; ++k) column.addSphere(Vec3(1.0, 1.0, 0.5 + k), 0.5, m);
  column.addPlane();
  column.addContact(0, spheres, Vec3::UnitZ(), 0.0, spheres * m * g);
  for (int k = 0; k + 1 < spheres; ++k)
    column.addContact(k, k + 1, -Vec3::UnitZ(), 0.0, (spheres - 1 - k) * m * g);
  const auto count = static_cast<int>(std::lround((height - low) / dz));
  const auto bins = slabs(Vec3(0.0, 0.0, low), Vec3(2.0, 2.0, height), count, across);
  for (const Weight& weight :
       {Weight(WeightMethod::heaviside, 0.6), Weight(WeightMethod::lucy, 0.8),
        Weight(WeightMethod::gauss, 0.25)}) {
    const auto moments = momentsOf(bins, column, weight);
    double above = 0.0;  // ∫ (ρ g − t) from the upper edge [N/m²]
    for (std::size_t slot = bins->slots() - 1; slot > 0; --slot) {
      const double within = dz * (g * field("density", *bins, moments, slot) -
                                  field("wall_force_density_z", *bins, moments, slot));
      const double sigma = field("stress_zz", *bins, moments, slot);
      // Of a slab the mean, against the trapezium's: they differ by dz²/12 σ″, and by jumps of
      // heaviside's density within one slab.
      EXPECT_NEAR(sigma, above + 0.5 * within, 0.01 * spheres * m * g / 4.0) << slot;
      above += within;
    }
    EXPECT_NEAR(above, 0.0, 1e-12) << "the floor takes all of it";
    const auto middle = static_cast<std::size_t>(std::lround((2.0 - low) / dz));
    EXPECT_NEAR(field("stress_zz", *bins, moments, middle), 2.0 * m * g / 4.0, 0.05 * m * g)
        << "half way up stands half the weight";
  }
}

TEST(SpaceFields, GranularTemperatureAndWhatResolutionAddsToIt) {
  SpaceInstant two;
  two.addSphere(Vec3(0.5, 0.5, 0.5), 0.2, 1.0, Vec3(3.0, 1.0, 0.0));
  two.addSphere(Vec3(0.5, 0.5, 0.5), 0.2, 2.0, Vec3(0.0, 1.0, 0.0));
  const auto whole = slabs(Vec3::Zero(), Vec3::Ones(), 1, everywhere);
  const auto moments = momentsOf(whole, two);
  // u_x = 1; Σ m v'² = 1·4 + 2·1 = 6
  EXPECT_NEAR(field("velocity_x", *whole, moments, 1), 1.0, 1e-15);
  EXPECT_NEAR(field("granular_temperature", *whole, moments, 1), 6.0 / 9.0, 1e-15);
  EXPECT_NEAR(field("fluctuation_stress_xx", *whole, moments, 1), 6.0, 1e-14);
  EXPECT_NEAR(field("dynamic_stress_xx", *whole, moments, 1), 9.0, 1e-14);
  EXPECT_NEAR(field("dynamic_stress_xy", *whole, moments, 1), 3.0, 1e-14);
  EXPECT_NEAR(field("fluctuation_stress_xy", *whole, moments, 1), 0.0, 1e-14);
  EXPECT_NEAR(field("pressure", *whole, moments, 1), 2.0, 1e-14);

  // v_x = γ z without any fluctuation: the function's own width shows as ρ (γ w)², here of the
  // Gaussian that is cut at 3w: w² (1 − 6 φ(3)/0.9973) = 0.97334 w².
  constexpr double gamma = 2.0, w = 0.4;
  SpaceInstant shear;
  for (int k = 0; k < 2000; ++k)
    shear.addSphere(Vec3(0.5, 0.5, 0.005 * k), 0.1, 1.0, Vec3(gamma * 0.005 * k, 0.0, 0.0));
  const auto thin = slabs(Vec3::Zero(), Vec3(1.0, 1.0, 10.0), 500, across);
  const auto smooth = momentsOf(thin, shear, Weight(WeightMethod::gauss, w));
  EXPECT_NEAR(
      field("fluctuation_stress_xx", *thin, smooth, 250) / field("density", *thin, smooth, 250),
      0.97334 * gamma * gamma * w * w, 1e-3);
}

TEST(SpaceFields, RattlersAreLeftOut) {
  SpaceInstant five;
  for (int k = 0; k < 5; ++k) five.addSphere(Vec3(0.5, 0.5, 0.1 + 0.2 * k), 0.05);
  for (int k = 1; k < 5; ++k) five.addContact(0, k, Vec3::UnitZ(), 0.0, 1.0);
  five.addContact(1, 2, Vec3::UnitZ(), 0.0, 0.0);  // listed, and transmits nothing
  const auto whole = slabs(Vec3::Zero(), Vec3::Ones(), 1, everywhere);
  const auto moments = momentsOf(whole, five);
  EXPECT_NEAR(field("coordination", *whole, moments, 1), 8.0 / 5.0, 1e-15);
  EXPECT_NEAR(field("coordination_without_rattlers", *whole, moments, 1), 4.0, 1e-15);
}

TEST(SpaceFields, RingsSeeSpinAndThrustAlongTheirDirections) {
  // A wheel of spheres turns about z at Ω = 3; the ring outside presses on one of them.
  SpaceInstant wheel;
  for (const double angle : {0.3, 1.7, 4.0}) {
    const Vec3 x(std::cos(angle), std::sin(angle), 0.5);
    wheel.addSphere(x, 0.1, 2.0, 3.0 * Vec3(-x.y(), x.x(), 0.0) + Vec3(0.0, 0.0, 1.0));
  }
  wheel.addPlane();
  wheel.addContact(0, 3, -Vec3(std::cos(0.3), std::sin(0.3), 0.0), 0.0, 5.0,
                   Vec3(-std::sin(0.3), std::cos(0.3), 0.0));
  const auto rings = std::make_shared<SpaceRings>(0.5, 1.5, 1, 0.0, 1.0, 1);
  const auto moments = momentsOf(rings, wheel);
  EXPECT_NEAR(field("azimuthal_velocity", *rings, moments, 1), 3.0, 1e-14);
  EXPECT_NEAR(field("radial_velocity", *rings, moments, 1), 0.0, 1e-14);
  EXPECT_NEAR(field("velocity_z", *rings, moments, 1), 1.0, 1e-14);
  // Force (−5, 1, 0) along (r, φ, z) on the sphere; branch −0.1 e_r.
  const double V = 2.0 * pi;
  EXPECT_NEAR(field("stress_rr", *rings, moments, 1), 0.5 / V, 1e-15);
  EXPECT_NEAR(field("stress_pr", *rings, moments, 1), -0.1 / V, 1e-15);
  EXPECT_NEAR(field("stress_rp", *rings, moments, 1), 0.0, 1e-15);
  EXPECT_NEAR(field("wall_force_density_r", *rings, moments, 1), -5.0 / V, 1e-14);
  EXPECT_NEAR(field("fabric_rr", *rings, moments, 1), at(moments[1], Moment::volume) / 3.0 / V,
              1e-15);
}

TEST(SpaceFields, ProfilesAreMeansOverTimeWithErrors) {
  SpaceInstant one;
  one.addSphere(Vec3(0.5, 0.5, 0.5), 0.2);
  const auto bins = slabs(Vec3::Zero(), Vec3(1.0, 1.0, 2.0), 2, across);
  ProfileAccumulatorOf<3> profiles(bins, {Weight(WeightMethod::slicing)}, one.scene);
  for (int k = 0; k < 64; ++k) {
    one.snapshot.velocity[0].x() = k % 2 == 0 ? 1.0 : 3.0;
    profiles.add(one.snapshot);
  }
  const auto all = profiles.profiles();
  const auto of = [&](const char* name) {
    const auto found = std::ranges::find(all, name, &Profile::field);
    EXPECT_NE(found, all.end()) << name;
    return *found;
  };
  const Profile velocity = of("velocity_x");
  ASSERT_EQ(velocity.mean.size(), 2U);
  EXPECT_NEAR(velocity.mean[0].value(), 2.0, 1e-14);
  EXPECT_FALSE(velocity.mean[1]);
  EXPECT_TRUE(velocity.standardError[0]);
  EXPECT_NEAR(of("granular_temperature").mean[0].value(), 1.0 / 3.0, 1e-14);
  EXPECT_EQ(of("stress_zz").mean[1], 0.0);
  EXPECT_EQ(std::ranges::find(all, "spin_x", &Profile::field), all.end());
  one.snapshot.contacts.reset();
  EXPECT_THROW(profiles.add(one.snapshot), std::invalid_argument);
}

TEST(SpaceFields, KnowWhatGrowsWithTheirContent) {
  for (const bool rings : {false, true})
    for (const FieldSpec& spec : fieldsIn(3, rings)) {
      const auto is = [&](std::string_view stem) { return spec.name.starts_with(stem); };
      const bool perVolume = spec.definition.find("V_bin") != std::string_view::npos ||
                             is("pressure") || is("stress_") || is("full_stress_") ||
                             is("bulk_modulus") || is("shear_modulus");
      EXPECT_EQ(spec.perVolume, perVolume) << spec.name;
      // By one name one unit and one kind in all tables.
      EXPECT_EQ(fieldSpec(spec.name).unit, spec.unit) << spec.name;
      EXPECT_EQ(fieldSpec(spec.name).perVolume, spec.perVolume) << spec.name;
      EXPECT_EQ(fieldSpec(spec.name).needs, spec.needs) << spec.name;
    }
}

}  // namespace
}  // namespace crossgrain
