#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>

#include "averaging/profiles.hpp"
#include "tests/averaging/scenes.hpp"
#include "tests/support/thesis.hpp"

namespace crossgrain {
namespace {

using test::Instant;

const std::vector<Weight> allWeights = {WeightMethod::slicing,
                                        WeightMethod::straightCut,
                                        WeightMethod::centre,
                                        {WeightMethod::lineGaussian, 0.003},
                                        {WeightMethod::lineHeaviside, 0.003}};

Eigen::Matrix2d turn(double angle) {
  return Eigen::Rotation2Dd(angle).toRotationMatrix();
}

/// The instant seen through a linear map: a rotation or a reflection (which turns spins and
/// tangential forces around, since z × n is reflected with the other sign).
Instant mapped(const Instant& instant, const Eigen::Matrix2d& map) {
  Instant result = instant;
  const double handedness = map.determinant() > 0.0 ? 1.0 : -1.0;
  for (auto* vectors : {&result.snapshot.position, &result.snapshot.velocity,
                        &result.snapshot.wallPosition, &result.snapshot.contacts->normal})
    for (Vec2& v : *vectors) v = map * v;
  for (double& spin : *result.snapshot.spin) spin *= handedness;
  for (double& force : result.snapshot.contacts->tangentialForce) force *= handedness;
  return result;
}

std::vector<Profile> profilesOf(const Instant& instant) {
  ProfileAccumulator accumulator(test::thesisRings(), allWeights, instant.scene);
  accumulator.add(instant.snapshot);
  return accumulator.profiles();
}

void expectSame(const std::vector<Profile>& one, const std::vector<Profile>& other,
                const std::set<std::string>& flipped) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t k = 0; k < one.size(); ++k) {
    const double sign = flipped.contains(one[k].field) ? -1.0 : 1.0;
    double scale = 0.0;
    for (const auto& value : one[k].mean) scale = std::max(scale, std::abs(value.value()));
    for (std::size_t ring = 0; ring < one[k].mean.size(); ++ring)
      // Rounding of positions (1e-16 m) through cuts of depth 1e-4 m, and sums of 150 disks.
      EXPECT_NEAR(*one[k].mean[ring], sign * *other[k].mean[ring], 1e-11 * scale)
          << one[k].field << " " << one[k].method << " ring " << ring;
  }
}

std::set<std::string> words(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}

TEST(Symmetry, RotationChangesNothing) {
  const Instant instant = test::randomInstant(6, 3000);
  expectSame(profilesOf(instant), profilesOf(mapped(instant, turn(1.234))), {});
}

TEST(Symmetry, ReflectionFlipsWhatHasOneAzimuthalIndex) {
  const Instant instant = test::randomInstant(7, 3000);
  const Eigen::Matrix2d mirror = Eigen::Vector2d(1.0, -1.0).asDiagonal();
  expectSame(profilesOf(instant), profilesOf(mapped(instant, mirror)),
             words("azimuthal_velocity azimuthal_velocity_by_volume spin stress_rp "
                   "stress_pr dynamic_stress_rp fabric_rp "
                   "fabric_angle stress_angle stress_antisymmetric fluctuation_stress_rp "
                   "full_stress_rp strain_rp strain_pr strain_angle predicted_stress_rp "
                   "couple_stress_zr curvature_zr velocity_gradient shear_rate "
                   "continuum_rotation excess_rotation contact_sin_2 contact_sin_4 "
                   "contact_sin_6 contact_axis_4 contact_axis_6"));
}

TEST(Symmetry, TheOrderOfAPairDoesNotMatter) {
  // i and j exchanged with the normal turned round: the same physical contact, for ids that allow
  // it.
  Instant one, other;
  const Vec2 left(0.15, 0.01), right(0.157, 0.012);
  const Vec2 toRight = (right - left).normalized();
  one.addDisk(left, test::smallRadius, 1.0, {0.1, 0.2});
  one.addDisk(right, 0.0045, 2.0, {-0.3, 0.4});
  one.addContact(0, 1, -toRight, 2.0, 0.7);
  other.addDisk(right, 0.0045, 2.0, {-0.3, 0.4});
  other.addDisk(left, test::smallRadius, 1.0, {0.1, 0.2});
  other.addContact(0, 1, toRight, 2.0, 0.7);  // f_t along z × n: the reaction has the same f_t
  const Rings rings = test::thesisRings();
  const auto a = test::momentsOf(rings, one), b = test::momentsOf(rings, other);
  for (std::size_t slot = 0; slot < rings.slots(); ++slot)
    for (std::size_t q = 0; q < std::tuple_size_v<Moments>; ++q)
      EXPECT_NEAR(a[slot][q], b[slot][q], 1e-15);
}

}  // namespace
}  // namespace crossgrain
