// Fields that take more than one sum: strain, moduli, the constitutive law, couple stress, stresses
// of motion, gradients, contact directions.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/averaging/scenes.hpp"
#include "tests/support/thesis.hpp"

namespace crossgrain {
namespace {

using test::Instant;
using test::twoRings;
using test::valueOf;

using std::numbers::pi;
constexpr SpringConstants springs{test::thesis.kn, test::thesis.kt};

/// randomInstant with overlaps, undamped forces that belong to them, and springs.
Instant elasticInstant(std::uint64_t seed) {
  Instant instant = test::randomInstant(seed, 2900);
  Contacts& contacts = *instant.snapshot.contacts;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    contacts.overlap[c] = contacts.normalForce[c] / *springs.kn;
  return instant;
}

TEST(Strain, EqualOverlapsOnALattice_AreIsotropic_AndAsStiffAsTheirFabric) {
  // ε = (δ/a) I (Lätzel 2003, Eq. 7.88 with prefactor 1), exactly, however rings cut the disks, and
  // 2πhE/k_n = tr F (Eq. 7.104 read with E).
  constexpr double a = test::smallRadius, force = 1e-3;
  const double strain = force / *springs.kn / a;
  const Rings rings = test::thesisRings(7);
  Instant instant = test::triangularLattice(a, force);
  for (double& overlap : instant.snapshot.contacts->overlap) overlap = force / *springs.kn;
  const auto moments = test::momentsOf(rings, instant);
  for (int ring = 0; ring < rings.count(); ++ring) {
    const auto field = [&](const char* name) {
      return valueOf(name, rings, moments, ring, springs);
    };
    EXPECT_NEAR(field("strain_rr"), strain, 1e-12 * strain);
    EXPECT_NEAR(field("strain_pp"), strain, 1e-12 * strain);
    EXPECT_NEAR(field("strain_rp"), 0.0, 1e-12 * strain);
    EXPECT_NEAR(field("strain_trace"), 2.0 * strain, 2e-12 * strain);
    const double stiffness = field("bulk_modulus"), trace = field("fabric_trace");
    EXPECT_NEAR(2.0 * pi * rings.height() * stiffness / *springs.kn, trace, 1e-11 * trace);
    EXPECT_NEAR(field("mean_field_modulus"), stiffness, 1e-11 * stiffness);
  }
}

TEST(Strain, StiffnessFollowsFromFabricAndStrainForUndampedForces) {
  // 2πhE/k_n = tr F + dev F (dev ε/tr ε) cos 2(φ_ε − φ_F), an identity for f = k_n δ n whatever the
  // packing: σ = (k_n/πh) ε·F.
  const Rings rings = test::thesisRings();
  const auto moments = test::momentsOf(rings, elasticInstant(21));
  for (int ring = 0; ring < rings.count(); ++ring) {
    const auto field = [&](const char* name) { return valueOf(name, rings, moments, ring); };
    const double right =
        field("fabric_trace") + field("fabric_deviator") * field("strain_deviator") /
                                    field("strain_trace") *
                                    std::cos(2.0 * (field("strain_angle") - field("fabric_angle")));
    const double left = 2.0 * pi * rings.height() * field("bulk_modulus") / *springs.kn;
    EXPECT_NEAR(left, right, 1e-11 * right) << "ring " << ring;
  }
}

TEST(Strain, TwoDirectionsAreNeededForIt) {
  Instant pair;
  pair.addDisk({1.6, 0.0}, 0.3);
  pair.addDisk({2.4, 0.0}, 0.2);
  pair.addContact(0, 1, {-0.6, -0.8}, 5.0, 2.0);
  const Rings rings = twoRings();
  const auto moments = test::momentsOf(rings, pair);
  const BinView ring(rings, moments, rings.slot(0), springs);
  for (const char* name : {"strain_rr", "strain_trace", "bulk_modulus", "curvature_zr"})
    EXPECT_FALSE(evaluate(fieldSpec(name), ring)) << name;
  EXPECT_TRUE(evaluate(fieldSpec("stress_rr"), ring));
}

TEST(Moduli, ByHand) {
  // One disk, contacts along r and φ with overlaps 3 and 1 µm: ε = diag(3, 1) µm/a,
  // F = ν I, σ = k_n a diag(3, 1) µm/V.
  constexpr double a = 0.2, kn = 1000.0;
  Instant cross;
  cross.addDisk({1.5, 0.0}, a);
  cross.addWall("wheel", {Vec2(1.2, 0.0), Vec2(1.5, 0.3)}, 0.1);
  cross.addContact(0, 1, {1.0, 0.0}, kn * 3e-6, 0.0);
  cross.addContact(0, 2, {0.0, -1.0}, kn * 1e-6, 0.0);
  cross.snapshot.contacts->overlap = {3e-6, 1e-6};
  const Rings rings = twoRings();
  const auto moments = test::momentsOf(rings, cross);
  const auto field = [&](const char* name) {
    return valueOf(name, rings, moments, 0, SpringConstants{kn, {}});
  };
  const double volume = 3.0 * pi * 0.5;
  EXPECT_NEAR(field("strain_trace"), 4e-6 / a, 1e-18);
  EXPECT_NEAR(field("strain_deviator"), 2e-6 / a, 1e-18);
  EXPECT_NEAR(field("strain_angle"), 0.0, 1e-12);
  const double modulus = kn * a * a / volume;  // both: σ is proportional to ε
  EXPECT_NEAR(field("bulk_modulus"), modulus, 1e-10 * modulus);
  EXPECT_NEAR(field("shear_modulus"), modulus, 1e-10 * modulus);
  EXPECT_NEAR(field("modulus_ratio"), 1.0, 1e-12);
  // F is isotropic: it has no axis for the law to take.
  EXPECT_FALSE(
      evaluate(fieldSpec("predicted_stress_rr"), BinView(rings, moments, rings.slot(0), {kn, {}})));
}

TEST(ConstitutiveLaw, PredictsTheDeviatorAndTheMeanAxis) {
  // ε₀E[I + G* ε₁ R diag(1, −1) Rᵀ]: deviator 2 ε₀ E G* ε₁ about φ = (φ_ε + φ_F)/2 (Lätzel 2003,
  // Eqs. 7.105–7.109).
  const Rings rings = test::thesisRings();
  const auto moments = test::momentsOf(rings, elasticInstant(22));
  for (int ring = 0; ring < rings.count(); ++ring) {
    const auto field = [&](const char* name) {
      return valueOf(name, rings, moments, ring, springs);
    };
    const double rr = field("predicted_stress_rr"), pp = field("predicted_stress_pp"),
                 rp = field("predicted_stress_rp");
    const double mean = field("mean_field_modulus") * field("strain_trace") / 2.0;
    EXPECT_NEAR(rr + pp, 2.0 * mean, 1e-12 * mean);
    EXPECT_NEAR(
        std::hypot(rr - pp, 2.0 * rp),
        2.0 * mean * field("modulus_ratio") * field("strain_deviator") / field("strain_trace"),
        1e-12 * mean);
    double apart = field("strain_angle") - field("fabric_angle");
    apart -= pi * std::round(apart / pi);
    const double axis = field("fabric_angle") + apart / 2.0;
    EXPECT_NEAR(std::cos(2.0 * axis) * (rr - pp) + std::sin(2.0 * axis) * 2.0 * rp,
                std::hypot(rr - pp, 2.0 * rp), 1e-9 * mean);
  }
}

TEST(CoupleStress, ByHandAndAgainstCurvature) {
  // Disk of radius a pushed along +s by f_t in a contact on its inner side: l = −a n, n = e_r, and
  // (l × f)_z = −a f_t, so M_zr = −(l × f)_z l_r/V = −a² f_t/V; the wall disk, l = +a_w n, has
  // +a_w² f_t/V.
  Instant disk;
  disk.addDisk({1.5, 0.0}, 0.2);
  disk.addWall("wheel", {Vec2(1.2, 0.0)}, 0.1);
  disk.addContact(0, 1, {1.0, 0.0}, 5.0, 2.0);
  const Rings two = twoRings();
  EXPECT_NEAR(valueOf("couple_stress_zr", two, test::momentsOf(two, disk), 0),
              (-0.2 * 0.2 + 0.1 * 0.1) * 2.0 / (3.0 * pi * 0.5), 1e-15);

  // M_zr = (k_t/πh)(κ·F)_zr of the moving disks for the spring ξ = −f_t/k_t.
  const Rings rings = test::thesisRings();
  const auto moments = test::momentsOf(rings, elasticInstant(23));
  for (int ring = 0; ring < rings.count(); ++ring) {
    const auto field = [&](const char* name) {
      return valueOf(name, rings, moments, ring, springs);
    };
    const auto moving = [&](Moment which, int k) {
      return at(moments[rings.slot(ring)], which, k) / rings.ringVolume(ring);
    };
    const double zr = field("curvature_zr"), zp = field("curvature_zp");
    const double factor = *springs.kt / (pi * rings.height());
    const double scale = factor * (std::abs(zr) + std::abs(zp)) * field("fabric_trace");
    EXPECT_NEAR(moving(Moment::couple, 0),
                factor * (zr * field("fabric_rr") + zp * field("fabric_rp")), 1e-12 * scale);
    EXPECT_NEAR(moving(Moment::couple, 1),
                factor * (zr * field("fabric_rp") + zp * field("fabric_pp")), 1e-12 * scale);
    EXPECT_NEAR(field("torque_resistance") * zr, moving(Moment::couple, 0), 1e-12 * scale);
  }
}

TEST(FullStress, IsThatOfARigidDiskPointByPoint) {
  // A disk under contact forces: ∮ traction ⊗ x − ∫ ρ a ⊗ x is its volume's mean Cauchy stress
  // (tension positive), ∫ ρ v ⊗ v its flux of momentum. Here both integrals are sums over a fine
  // polar grid of points of the disk.
  constexpr double a = 0.2, m = 3.0, spin = 7.0;
  const Vec2 velocity(0.4, -0.3);
  Instant disk;
  disk.addDisk({1.5, 0.0}, a, m, velocity, spin);
  // Planes push it: unlike wall disks they have no stress of their own.
  disk.scene.bodies.push_back({"box", Vec2::Zero(), {}, {}, {Plane{}, Plane{}}, {}});
  disk.addContact(0, 1, {1.0, 0.0}, 5.0, 2.0);
  disk.addContact(0, 2, {0.0, -1.0}, 4.0, -3.0);

  const Vec2 forces[] = {{5.0, 2.0}, {-3.0, -4.0}};  // f_n n + f_t z × n
  const Vec2 branches[] = {{-a, 0.0}, {0.0, a}};
  Eigen::Matrix2d stress = Eigen::Matrix2d::Zero();  // compression positive
  Vec2 force = Vec2::Zero();
  double torque = 0.0;
  for (int c = 0; c < 2; ++c) {
    stress -= forces[c] * branches[c].transpose();
    force += forces[c];
    torque += branches[c].x() * forces[c].y() - branches[c].y() * forces[c].x();
  }
  const Vec2 acceleration = force / m;
  const double spinUp = torque / (0.5 * m * a * a);
  constexpr int radial = 400, around = 64;
  for (int i = 0; i < radial; ++i)
    for (int k = 0; k < around; ++k) {
      const double r = a * (i + 0.5) / radial, angle = 2.0 * pi * k / around;
      const double mass = m * 2.0 * (i + 0.5) / (radial * radial) / around;
      const Vec2 x = r * Vec2(std::cos(angle), std::sin(angle));
      const Vec2 across(-x.y(), x.x());
      const Vec2 v = velocity + spin * across;
      const Vec2 pointAcceleration = acceleration + spinUp * across - spin * spin * x;
      stress += mass * pointAcceleration * x.transpose() + mass * v * v.transpose();
    }
  stress /= 3.0 * pi * 0.5;

  const Rings rings = twoRings();
  const auto moments = test::momentsOf(rings, disk);
  const double tolerance = 1e-5 * stress.norm();  // (1/400)² of the midpoint rule over r
  EXPECT_NEAR(valueOf("full_stress_rr", rings, moments, 0), stress(0, 0), tolerance);
  EXPECT_NEAR(valueOf("full_stress_pp", rings, moments, 0), stress(1, 1), tolerance);
  EXPECT_NEAR(valueOf("full_stress_rp", rings, moments, 0), stress(0, 1), tolerance);
  EXPECT_NEAR(stress(1, 0), stress(0, 1), tolerance);  // the torque's term makes it symmetric
  // That term is J ω̇/2V (here with compression positive), and the terms in ω², ± J ω²/2V, leave
  // nothing.
  const double volume = 3.0 * pi * 0.5;
  EXPECT_NEAR(valueOf("stress_antisymmetric", rings, moments, 0), -torque / 2.0 / volume, 1e-14);
  EXPECT_NEAR(valueOf("rotational_stress", rings, moments, 0),
              0.5 * (0.5 * m * a * a) * spin * spin / volume, 1e-14);
}

TEST(FluctuationStress, IsWithoutTheMeanMotion) {
  // Masses 1 and 3 at 5 and 1 m/s: mean 2, deviations 3 and −1: Σ m v′² = 9 + 3 = 12.
  Instant instant;
  instant.addDisk({1.5, 0.0}, 0.1, 1.0, {0.0, 5.0});
  instant.addDisk({0.0, 1.5}, 0.1, 3.0, {-1.0, 0.0});
  const Rings rings = twoRings();
  const auto moments = test::momentsOf(rings, instant);
  const double volume = 3.0 * pi * 0.5;
  EXPECT_NEAR(valueOf("fluctuation_stress_pp", rings, moments, 0), 12.0 / volume, 1e-14);
  EXPECT_NEAR(valueOf("dynamic_stress_pp", rings, moments, 0), 28.0 / volume, 1e-14);
  EXPECT_NEAR(valueOf("fluctuation_stress_rr", rings, moments, 0), 0.0, 1e-15);
}

TEST(Gradients, AParabolaIsExactAndARigidRotationHasNoShear) {
  // Small disks at the rings' centres: v_φ = 2 + 3r − r², with slope 3 − 2r also at both walls.
  const Rings rings(1.0, 2.0, 5, 0.5, 0.1);
  Instant curved, rigid;
  for (int k = 0; k < 5; ++k) {
    const double r = rings.centre(k);
    curved.addDisk({r, 0.0}, 0.01, 1.0, {0.0, 2.0 + 3.0 * r - r * r}, 0.5);
    rigid.addDisk({r, 0.0}, 0.01, 1.0, {0.0, 0.7 * r}, 0.7);
  }
  const auto bent = test::momentsOf(rings, curved), stiff = test::momentsOf(rings, rigid);
  for (int k = 0; k < 5; ++k) {
    const double r = rings.centre(k), v = 2.0 + 3.0 * r - r * r, slope = 3.0 - 2.0 * r;
    EXPECT_NEAR(valueOf("velocity_gradient", rings, bent, k), slope, 1e-12);
    EXPECT_NEAR(valueOf("shear_rate", rings, bent, k), slope - v / r, 1e-12);
    EXPECT_NEAR(valueOf("continuum_rotation", rings, bent, k), 0.5 * (slope + v / r), 1e-12);
    EXPECT_NEAR(valueOf("excess_rotation", rings, bent, k), 0.5 - 0.5 * (slope + v / r), 1e-12);
    EXPECT_NEAR(valueOf("shear_rate", rings, stiff, k), 0.0, 1e-12);
    EXPECT_NEAR(valueOf("continuum_rotation", rings, stiff, k), 0.7, 1e-12);
    EXPECT_NEAR(valueOf("excess_rotation", rings, stiff, k), 0.0, 1e-12);
  }
}

TEST(Gradients, AreAbsentBesideAnEmptyRing) {
  const Rings rings(1.0, 2.0, 5, 0.5, 0.1);
  Instant instant;
  for (const int k : {0, 2, 3, 4}) instant.addDisk({rings.centre(k), 0.0}, 0.01, 1.0, {0.0, 1.0});
  const auto moments = test::momentsOf(rings, instant);
  for (int k = 0; k < 5; ++k)
    EXPECT_EQ(evaluate(fieldSpec("shear_rate"), BinView(rings, moments, rings.slot(k))).has_value(),
              k >= 3)
        << k;  // those made of rings 2 to 4
  const Rings two = twoRings();
  EXPECT_FALSE(two.slope(two.slot(0)));
}

TEST(ContactDirections, ASquareHasOrderFourAndAHexagonOrderSix) {
  // Normals at α₀ + 2πj/n: Σ cos kα is n cos kα₀ where n divides k, else 0.
  for (const int n : {4, 6}) {
    Instant star;
    star.addDisk({0.0, 1.5}, 0.2);
    std::vector<Vec2> around;
    constexpr double first = 0.3;
    for (int j = 0; j < n; ++j) {
      // e_r = ŷ at the disk: α counts from there.
      const double angle = pi / 2.0 + first + 2.0 * pi * j / n;
      const Vec2 outward(std::cos(angle), std::sin(angle));
      around.push_back(star.snapshot.position[0] + 0.3 * outward);
      star.addContact(0, j + 1, -outward, 1.0, 0.0);
    }
    star.addWall("wheel", around, 0.1);
    const Rings rings = twoRings();
    const auto moments = test::momentsOf(rings, star);
    const auto field = [&](const char* name) { return valueOf(name, rings, moments, 0); };
    EXPECT_NEAR(field("contact_amplitude_2"), 0.0, 1e-14);
    EXPECT_NEAR(field("contact_amplitude_4"), n == 4 ? 2.0 : 0.0, 1e-14);
    EXPECT_NEAR(field("contact_amplitude_6"), n == 6 ? 2.0 : 0.0, 1e-14);
    EXPECT_NEAR(field("contact_cos_4"), n == 4 ? 2.0 * std::cos(4 * first) : 0.0, 1e-14);
    EXPECT_NEAR(field("contact_sin_6"), n == 6 ? 2.0 * std::sin(6 * first) : 0.0, 1e-14);
    EXPECT_NEAR(field(n == 4 ? "contact_axis_4" : "contact_axis_6"), first, 1e-13);
  }
}

TEST(ContactDirections, TheSecondOrderIsTheFabric) {
  const Rings rings = test::thesisRings();
  const auto moments = test::momentsOf(rings, test::randomInstant(24, 2900));
  for (int ring = 0; ring < rings.count(); ++ring) {
    const double ratio = valueOf("fabric_deviator", rings, moments, ring) /
                         valueOf("fabric_trace", rings, moments, ring);
    EXPECT_NEAR(valueOf("contact_amplitude_2", rings, moments, ring), 2.0 * ratio, 1e-13);
  }
}

}  // namespace
}  // namespace crossgrain
