// Numbers that follow the case that they are in: margins as shares of its scales, disks from a
// volume fraction, masses from a density, a time step that was chosen for other contacts.

#include <numbers>

#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "files.hpp"
#include "tests/support/thesis.hpp"

namespace crossgrain::test {
namespace {

using Scales = InFolder;

const std::string rimMargin =
    "[averaging.margins]\nazimuthal_velocity = { share = 0.05, of = \"rim_speed\", why = \"w\" }\n";

TEST_F(Scales, Share_FollowsTheWheel) {
  write("case.toml", plus(rimMargin));
  const auto margin = [](const std::vector<std::string>& overrides) {
    return loadCase("case.toml", overrides).front().averaging.margins.at("azimuthal_velocity");
  };
  EXPECT_EQ(margin({}).value, 1.5e-3);  // 0.05 · 1 rad/s · 0.03 m
  EXPECT_FALSE(margin({}).relative);
  EXPECT_EQ(margin({}).scale, "rim_speed");
  EXPECT_EQ(margin({}).why, "0.05 of rim_speed (Ω R_i = 0.03 m/s): w");
  EXPECT_EQ(margin({"cell.omega=0.1"}).value, 1.5e-4);
  EXPECT_EQ(margin({"cell.inner_radius=0.0344"}).value, 1.7e-3);  // 1.72e-3, in two digits
}

TEST_F(Scales, Values) {
  write("case.toml", soundCase);
  const Case c = loadCase("case.toml").front();
  const auto value = [&](std::string_view name) {
    return std::ranges::find(scales(), name, &Scale::name)->of(c);
  };
  EXPECT_DOUBLE_EQ(value("rim_speed"), 0.03);
  EXPECT_DOUBLE_EQ(value("spin_scale"), 0.06 / 0.0074);  // Ω D/d with D = 2 R_i
  EXPECT_DOUBLE_EQ(value("shear_rate"), 0.03 / 0.0074);
  EXPECT_DOUBLE_EQ(value("diameter"), 0.0074);
  const double density = smallMass / (std::numbers::pi * smallRadius * smallRadius * 0.006);
  EXPECT_DOUBLE_EQ(value("disk_density"), density);
  EXPECT_DOUBLE_EQ(value("rim_pressure"), density * 0.03 * 0.03);
  EXPECT_DOUBLE_EQ(value("contact_pressure"), thesis.kn / 0.006);
}

TEST_F(Scales, Margin_LaterWayReplaces) {
  write("base.toml", plus(rimMargin));
  write("top.toml",
        "[case]\nextends = \"base.toml\"\n"
        "[averaging.margins]\nazimuthal_velocity = { absolute = 2.0, why = \"b\" }\n");
  const Case top = loadCase("top.toml").front();
  EXPECT_EQ(top.averaging.margins.at("azimuthal_velocity").value, 2.0);
  EXPECT_EQ(top.averaging.margins.at("azimuthal_velocity").scale, "");
  // One half of a share replaces that half.
  const Case wider =
      loadCase("base.toml", {"averaging.margins.azimuthal_velocity.share=0.1"}).front();
  EXPECT_EQ(wider.averaging.margins.at("azimuthal_velocity").value, 3e-3);
}

TEST_F(Scales, BadShares) {
  const auto margins = [](const std::string& spin) {
    return plus("[averaging.margins]\nspin = { " + spin + ", why = \"w\" }\n");
  };
  expectMessages({
      {margins("share = 0.1, of = \"rim_sped\""),
       "case.toml:25:28: averaging.margins.spin.of = \"rim_sped\": unknown name (did you mean "
       "rim_speed?)"},
      {margins("share = 0.1, of = \"rim_speed\""),
       "case.toml:25:28: averaging.margins.spin.of = \"rim_speed\": is in m/s, and spin in rad/s"},
      {margins("share = 0.1"),
       "case.toml:25:8: averaging.margins.spin.of is missing: a margin of a share says of what"},
      {margins("share = 0.1, of = \"spin_scale\", absolute = 1"),
       "case.toml:25:18: averaging.margins.spin.share = 0.1: stands beside absolute: give one of "
       "the two"},
  });
}

/// The sound case without its numbers and masses of disks, and with these lines instead.
std::string particles(const std::string& lines) {
  const std::string head = soundCase.substr(0, soundCase.find("small = 210"));
  return head + "small_radius = 0.0037\nlarge_radius = 0.004495\n" + lines;
}
const std::string masses = "small_mass = 0.275e-3\nlarge_mass = 0.490e-3\n";

TEST_F(Scales, VolumeFraction_GivesNumbersOfDisks) {
  // Lätzel 2003, table 3.2: from the fraction that its numbers have, the numbers.
  constexpr int rows[][2] = {{2462, 404}, {2498, 409}, {2511, 400}, {2511, 410},
                             {2545, 394}, {2560, 418}, {2588, 422}};
  for (const auto& [small, large] : rows) {
    Case c;
    couetteIn(c).cell = {.innerRadius = 0.1032, .outerRadius = 0.2524, .height = 0.006};
    couetteIn(c).particles.small = small;
    couetteIn(c).particles.large = large;
    couetteIn(c).particles.smallRadius = smallRadius;
    couetteIn(c).particles.largeRadius = largeRadius;
    const double fraction = volumeFraction(c);
    setNumbers(couetteIn(c).cell, couetteIn(c).particles, fraction,
               static_cast<double>(large) / (small + large));
    EXPECT_EQ(couetteIn(c).particles.small, small);
    EXPECT_EQ(couetteIn(c).particles.large, large);
  }
}

TEST_F(Scales, ShareOfLargeDisks_ByNumberOrMass) {
  write("case.toml", particles(masses + "volume_fraction = 0.754\nlarge_number_share = 0.14\n"));
  const Case byNumber = loadCase("case.toml").front();
  EXPECT_EQ(couetteIn(byNumber).particles.small, 210);
  EXPECT_EQ(couetteIn(byNumber).particles.large, 34);
  EXPECT_NEAR(volumeFraction(byNumber), 0.754,
              0.5 * smallRadius * smallRadius / (0.075 * 0.075 - 0.03 * 0.03));
  // 34 · 0.49 g of 34 · 0.49 g + 210 · 0.275 g
  write("case.toml", particles(masses + "volume_fraction = 0.754\nlarge_mass_share = 0.2239\n"));
  const Case byMass = loadCase("case.toml").front();
  EXPECT_EQ(couetteIn(byMass).particles.small, 210);
  EXPECT_EQ(couetteIn(byMass).particles.large, 34);
  write("case.toml", particles(masses + "volume_fraction = 0.5\nlarge_number_share = 0\n"));
  EXPECT_EQ(couetteIn(loadCase("case.toml").front()).particles.large, 0);
  write("case.toml", particles(masses + "volume_fraction = 0.5\nlarge_mass_share = 1\n"));
  EXPECT_EQ(couetteIn(loadCase("case.toml").front()).particles.small, 0);
}

TEST_F(Scales, Density_GivesMasses) {
  write("case.toml", particles("density = 1060.0\nsmall = 210\nlarge = 34\n"));
  const Case c = loadCase("case.toml").front();
  EXPECT_DOUBLE_EQ(couetteIn(c).particles.smallMass,
                   1060.0 * std::numbers::pi * smallRadius * smallRadius * 0.006);
  EXPECT_NEAR(couetteIn(c).particles.largeMass, 0.404e-3, 0.0005e-3);  // facts 1.1
}

TEST_F(Scales, BothForms_OrNone_AreRefused) {
  const std::string counts = "small = 210\nlarge = 34\n";
  expectMessages({
      {particles(masses + counts + "volume_fraction = 0.7\nlarge_number_share = 0.1\n"),
       "case.toml:24:19: particles.volume_fraction = 0.7: stands beside small, a number of "
       "disks: give one of the two"},
      {particles(masses + counts + "large_number_share = 0.1\n"),
       "case.toml:17:1: particles.volume_fraction is missing: the share of large disks is for a "
       "case that gives it"},
      {particles(masses + "volume_fraction = 0.7\n"),
       "case.toml:17:1: particles.large_number_share is missing: or large_mass_share: 0 if there "
       "are no large disks"},
      {particles(masses +
                 "volume_fraction = 0.7\nlarge_number_share = 0.1\nlarge_mass_share = 0.1\n"),
       "case.toml:24:20: particles.large_mass_share = 0.1: stands beside large_number_share: "
       "give one of the two"},
      {particles(masses + "volume_fraction = 1.0\nlarge_number_share = 0.1\n"),
       "case.toml:22:19: particles.volume_fraction = 1.0: must be in (0, 1)"},
      {particles("small_mass = 1e-3\ndensity = 1060\n" + counts),
       "case.toml:21:11: particles.density = 1060: stands beside small_mass: give one of the two"},
      {particles(counts), "case.toml:17:1: particles.small_mass is missing"},
  });
}

TEST_F(Scales, StepOfOtherContacts_GivesAWarning) {
  write("base.toml", plus("[run]\ndt = 4e-5\n"));
  write("same.toml", "[case]\nextends = \"base.toml\"\n[cell]\nomega = 0.5\n");
  write("stiff.toml", "[case]\nextends = \"base.toml\"\n[law]\nkn = 1500\n");
  write("own.toml", "[case]\nextends = \"base.toml\"\n[law]\nkn = 1500\n[run]\ndt = 2e-5\n");
  EXPECT_TRUE(loadCase("base.toml").front().warnings.empty());
  EXPECT_TRUE(loadCase("same.toml").front().warnings.empty());
  EXPECT_TRUE(loadCase("own.toml").front().warnings.empty());
  EXPECT_EQ(loadCase("stiff.toml").front().warnings,
            std::vector<std::string>{
                "run.dt = 4e-05 s is that of base.toml, where a contact lasts 0.00218 s, 54.4 "
                "steps; here it lasts 0.000973 s, 24.3 steps: give dt anew, or steps_per_contact"});
  EXPECT_EQ(loadCase("base.toml", {"law.kn=1500"}).front().warnings.size(), 1u);
  EXPECT_TRUE(loadCase("base.toml", {"law.kn=1500", "run.dt=2e-5"}).front().warnings.empty());
}

}  // namespace
}  // namespace crossgrain::test
