// Merging: extends, variants, overrides, and the resolved document.
#include "cases/time_step.hpp"
#include "cases/volume_fraction.hpp"
#include "files.hpp"

namespace crossgrain::test {
namespace {

using LoaderMerging = InFolder;

TEST_F(LoaderMerging, DefaultsAreThoseOfTheTypes) {
  write("plain.toml", soundCase);
  const auto cases = loadCase("plain.toml");
  ASSERT_EQ(cases.size(), 1u);
  const Case& c = cases.front();
  EXPECT_EQ(c.name, "plain");  // the file's name
  EXPECT_EQ(c.variant, "");
  EXPECT_EQ(c.kind, CaseKind::couette);
  EXPECT_FALSE(c.bottom);
  EXPECT_FALSE(c.run.dt);
  EXPECT_EQ(c.averaging.methods, std::vector<std::string>{"slicing"});
  EXPECT_EQ(c.preparation.packings, Preparation{}.packings);
  EXPECT_EQ(c.law.conventions.leverArm, LeverArm::radius);
}

TEST_F(LoaderMerging, AChainOfFilesIsMergedKeyByKeyLaterWins) {
  write("base/law.toml", soundCase);
  write("base/middle.toml",
        "[case]\nname = \"middle\"\nextends = \"law.toml\"\n[law]\nkn = 400\n"
        "[cell]\nomega = 0.5\n");
  write("top.toml", "[case]\nextends = \"base/middle.toml\"\n[law]\nkn = 500\n");
  const Case c = loadCase("top.toml").front();
  EXPECT_EQ(c.law.kn, 500.0);    // top over middle over law
  EXPECT_EQ(c.cell.omega, 0.5);  // middle over law
  EXPECT_EQ(c.law.gn, 0.19);     // law
  EXPECT_EQ(c.name, "top");      // a name is not inherited
  EXPECT_EQ(c.file, "top.toml");
}

TEST_F(LoaderMerging, ListsAreReplacedNotJoined) {
  write("base.toml", soundCase + "[run]\nmay_differ = [\"tension\", \"dashpot\"]\n");
  write("top.toml", "[case]\nextends = \"base.toml\"\n[run]\nmay_differ = [\"normal\"]\n");
  EXPECT_EQ(loadCase("top.toml").front().run.mayDiffer, std::vector<std::string>{"normal"});
}

TEST_F(LoaderMerging, TheLaterOfTwoWaysToSayOneThingReplacesTheEarlier) {
  write("base.toml", soundCase +
                         "[run]\ndt = 1e-5\n[averaging.margins]\n"
                         "spin = { relative = 0.1, why = \"a\" }\n");
  write("top.toml",
        "[case]\nextends = \"base.toml\"\n[run]\nsteps_per_contact = 100\n"
        "[averaging.margins]\nspin = { absolute = 0.3, why = \"b\" }\n");
  const Case c = loadCase("top.toml").front();
  EXPECT_FALSE(c.run.dt);
  EXPECT_EQ(c.run.stepsPerContact, 100.0);
  EXPECT_FALSE(c.averaging.margins.at("spin").relative);
  EXPECT_EQ(c.averaging.margins.at("spin").value, 0.3);
  EXPECT_EQ(loadCase("base.toml", {"run.steps_per_contact=70"}).front().run.stepsPerContact, 70.0);
}

TEST_F(LoaderMerging, VariantsGiveOneCaseEachInTheirOrder) {
  write("v.toml", soundCase +
                      "[[variants]]\nname = \"slow\"\ncell.omega = 0.1\n"
                      "[[variants]]\nname = \"cut\"\n[variants.law]\ntension = \"cut\"\n");
  const auto cases = loadCase("v.toml");
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].variant, "slow");
  EXPECT_EQ(cases[0].cell.omega, 0.1);
  EXPECT_EQ(cases[0].law.conventions.tension, Tension::allow);
  EXPECT_EQ(cases[1].variant, "cut");
  EXPECT_EQ(cases[1].cell.omega, 1.0);
  EXPECT_EQ(cases[1].law.conventions.tension, Tension::cut);
}

TEST_F(LoaderMerging, OverridesComeLastAndReadTomlOrBareWords) {
  write("v.toml", soundCase + "[[variants]]\nname = \"slow\"\ncell.omega = 0.1\n");
  const Case c = loadCase("v.toml", {"cell.omega=0.2", "law.tension=cut", "run.mirrors=false",
                                     "engines.box2d-impulse.dt=5e-4", "engines.x.solver=fast-one",
                                     "run.may_differ=[\"tension\"]", "averaging.method=centre"})
                     .front();
  EXPECT_EQ(c.cell.omega, 0.2);
  EXPECT_EQ(c.law.conventions.tension, Tension::cut);
  EXPECT_FALSE(c.run.mirrors);
  EXPECT_EQ(std::get<double>(c.engines.at("box2d-impulse").at("dt")), 5e-4);
  EXPECT_EQ(std::get<std::string>(c.engines.at("x").at("solver")), "fast-one");
  EXPECT_EQ(c.run.mayDiffer, std::vector<std::string>{"tension"});
  EXPECT_EQ(c.averaging.methods, std::vector<std::string>{"centre"});
}

TEST_F(LoaderMerging, EngineSettingsKeepTheirTypes) {
  write("e.toml", soundCase + "[engines.some]\nflag = true\ncount = 3\nrate = 0.5\nmode = \"a\"\n");
  const Settings settings = loadCase("e.toml").front().engines.at("some");
  EXPECT_TRUE(std::get<bool>(settings.at("flag")));
  EXPECT_EQ(std::get<double>(settings.at("count")), 3.0);
  EXPECT_EQ(std::get<double>(settings.at("rate")), 0.5);
  EXPECT_EQ(std::get<std::string>(settings.at("mode")), "a");
}

TEST_F(LoaderMerging, TheResolvedDocumentLoadsToTheSameCase) {
  write("law.toml", soundCase);
  write("v.toml",
        "[case]\nextends = \"law.toml\"\n[particles]\nsmall = 200\n"
        "[engines.\"odd name\"]\nword = \"a \\\"quoted\\\" line\\nand µ\"\n"
        "[[variants]]\nname = \"a\"\nlaw = { mu = 0.1, tangential = \"spring\" }\n");
  const Case first = loadCase("v.toml", {"run.dt=1.1e-5", "cell.omega=3"}).front();
  write("resolved.toml", first.resolvedToml);
  const Case second = loadCase("resolved.toml").front();
  EXPECT_EQ(second.resolvedToml, first.resolvedToml);
  EXPECT_EQ(second.name, "v");
  EXPECT_EQ(second.law.mu, 0.1);
  EXPECT_EQ(second.law.tangential, TangentialLaw::spring);
  EXPECT_EQ(second.run.dt, 1.1e-5);
  EXPECT_EQ(second.cell.omega, 3.0);
  EXPECT_EQ(second.particles.smallRadius, first.particles.smallRadius);
  EXPECT_EQ(second.engines, first.engines);
}

TEST_F(LoaderMerging, ParametersThatTheLawHasNoUseForAreCleared) {
  write("c.toml", soundCase);
  const auto law = [](const std::string& tangential) {
    return loadCase("c.toml", {"law.tangential=" + tangential}).front().law;
  };
  EXPECT_EQ(law("coulomb").kt, 0.0);
  EXPECT_EQ(law("coulomb").gt, 0.0);
  EXPECT_EQ(law("viscous").kt, 0.0);
  EXPECT_EQ(law("viscous").gt, 0.15);
  EXPECT_EQ(law("spring").kt, 267.1);
  EXPECT_EQ(law("spring").gt, 0.0);
  EXPECT_EQ(law("spring_dashpot").gt, 0.15);
  const Case smooth =
      loadCase("c.toml", {"law.tangential=none", "law.mu=0", "law.kt=0", "law.gt=0"}).front();
  EXPECT_EQ(smooth.law.tangential, TangentialLaw::none);
}

TEST_F(LoaderMerging, ARigidLawTakesCoulombFrictionWithItsCoefficient) {
  const std::string rigid = "[case]\nkind = \"collision\"\n[law]\nnormal = \"rigid\"\ne_n = 0.9\n";
  const std::string rest =
      "[collision]\npsi = 1\nvn = [0.1, 0.2]\nradius = [0.001, 0.002]\n"
      "mass = 0.001\n[run]\ndt = 1e-4\n";
  write("smooth.toml", rigid + rest);
  write("rough.toml", rigid + "mu = 0.3\n" + rest);
  const Case smooth = loadCase("smooth.toml").front();
  EXPECT_EQ(smooth.law.tangential, TangentialLaw::none);
  EXPECT_EQ(loadCase("rough.toml").front().law.tangential, TangentialLaw::coulomb);
  EXPECT_EQ(smooth.collision.psi, std::vector<double>{1.0});
  EXPECT_EQ(smooth.collision.vn, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(smooth.collision.radius[0], 0.001);
  EXPECT_EQ(smooth.collision.radius[1], 0.002);
  EXPECT_EQ(smooth.collision.mass[1], 0.001);
  EXPECT_EQ(collisionTimeSteps(smooth), std::vector<double>{1e-4});
}

TEST_F(LoaderMerging, APackingFileIsRelativeToTheFileThatNamesIt) {
  write("base/own.h5", "");
  write("base/case.toml", soundCase + "file = \"own.h5\"\n");
  write("top.toml", "[case]\nextends = \"base/case.toml\"\n");
  const Case c = loadCase("top.toml").front();
  EXPECT_EQ(c.particles.file, "base/own.h5");
  EXPECT_EQ(c.particles.small, 0);  // the file says how many
  EXPECT_NEAR(timeStep(c), 43.5e-6, 0.05e-6);
}

}  // namespace
}  // namespace crossgrain::test
