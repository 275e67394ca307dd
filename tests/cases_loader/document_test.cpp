// Merging: extends, variants, overrides; the resolved document, and the keys in it.
#include "cases/case_keys.hpp"
#include "cases/packing.hpp"
#include "cases/time_step.hpp"
#include "files.hpp"

namespace crossgrain::test {
namespace {

using LoaderMerging = InFolder;

TEST_F(LoaderMerging, ChainOfFiles_IsMergedKeyByKey_LaterWins) {
  write("base/law.toml", soundCase + "[run]\nmay_differ = [\"tension\", \"dashpot\"]\n");
  write("base/middle.toml",
        "[case]\nname = \"middle\"\nextends = \"law.toml\"\n[law]\nkn = 400\n"
        "[cell]\nomega = 0.5\n");
  write("top.toml",
        "[case]\nextends = \"base/middle.toml\"\n[law]\nkn = 500\n"
        "[run]\nmay_differ = [\"normal\"]\n");
  const Case c = loadCase("top.toml").front();
  EXPECT_EQ(c.run.mayDiffer, std::vector<std::string>{"normal"});  // lists are replaced
  EXPECT_EQ(c.law.kn, 500.0);                                      // top over middle over law
  EXPECT_EQ(couetteIn(c).cell.omega, 0.5);                         // middle over law
  EXPECT_EQ(c.law.gn, 0.19);                                       // law
  EXPECT_EQ(c.name, "top");                                        // a name is not inherited
  EXPECT_EQ(c.file, "top.toml");
}

TEST_F(LoaderMerging, TwoWaysToSayOneThing_LaterReplaces) {
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

TEST_F(LoaderMerging, Variants_GiveOneCaseEachInOrder) {
  write("v.toml", soundCase +
                      "[[variants]]\nname = \"slow\"\ncell.omega = 0.1\n"
                      "[[variants]]\nname = \"cut\"\n[variants.law]\ntension = \"cut\"\n");
  const auto cases = loadCase("v.toml");
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].variant, "slow");
  EXPECT_EQ(couetteIn(cases[0]).cell.omega, 0.1);
  EXPECT_EQ(cases[0].law.conventions.tension, Tension::allow);
  EXPECT_EQ(cases[1].variant, "cut");
  EXPECT_EQ(couetteIn(cases[1]).cell.omega, 1.0);
  EXPECT_EQ(cases[1].law.conventions.tension, Tension::cut);
}

TEST_F(LoaderMerging, FaultOfOneVariant_NamesItAndSparesThoseThatAreChosen) {
  write("v.toml", soundCase +
                      "[[variants]]\nname = \"slow\"\ncell.omega = 0.1\n"
                      "[[variants]]\nname = \"wrong\"\ncell.omega = \"x\"\n"
                      "[[variants]]\nname = \"fast\"\ncell.omega = 2.0\n");
  const auto fault = [](const std::vector<std::string>& overrides,
                        const std::optional<std::string>& only) {
    return refusalOf([&] { loadCase("v.toml", overrides, {}, Starts::made, only); });
  };
  EXPECT_TRUE(fault({}, {}).ends_with("(variant wrong)")) << fault({}, {});
  EXPECT_TRUE(fault({}, "wrong").ends_with("(variant wrong)"));
  EXPECT_EQ(fault({}, "fast"), "");
  EXPECT_EQ(loadCase("v.toml", {}, {}, Starts::made, "fast").size(), 2u);
  // Of all variants: none is named.
  EXPECT_EQ(fault({"law.kn=-1"}, {}).find("variant"), std::string::npos)
      << fault({"law.kn=-1"}, {});
}

TEST_F(LoaderMerging, Overrides_ComeLast_TomlOrBareWords) {
  write("v.toml", soundCase + "[[variants]]\nname = \"slow\"\ncell.omega = 0.1\n");
  const Case c = loadCase("v.toml", {"cell.omega=0.2", "law.tension=cut", "run.mirrors=false",
                                     "engines.box2d-impulse.dt=5e-4", "engines.x.solver=fast-one",
                                     "run.may_differ=[\"tension\"]", "averaging.method=centre"})
                     .front();
  EXPECT_EQ(couetteIn(c).cell.omega, 0.2);
  EXPECT_EQ(c.law.conventions.tension, Tension::cut);
  EXPECT_FALSE(c.run.mirrors);
  EXPECT_EQ(std::get<double>(c.engines.at("box2d-impulse").at("dt")), 5e-4);
  EXPECT_EQ(std::get<std::string>(c.engines.at("x").at("solver")), "fast-one");
  EXPECT_EQ(c.run.mayDiffer, std::vector<std::string>{"tension"});
  EXPECT_EQ(c.averaging.methods, std::vector<std::string>{"centre"});
}

TEST_F(LoaderMerging, EngineSettings_KeepTheirTypes) {
  write("e.toml", soundCase + "[engines.some]\nflag = true\ncount = 3\nrate = 0.5\nmode = \"a\"\n");
  const Settings settings = loadCase("e.toml").front().engines.at("some");
  EXPECT_TRUE(std::get<bool>(settings.at("flag")));
  EXPECT_EQ(std::get<double>(settings.at("count")), 3.0);
  EXPECT_EQ(std::get<double>(settings.at("rate")), 0.5);
  EXPECT_EQ(std::get<std::string>(settings.at("mode")), "a");
}

TEST_F(LoaderMerging, Resolved_LoadsToTheSameCase) {
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
  EXPECT_EQ(couetteIn(second).cell.omega, 3.0);
  EXPECT_EQ(couetteIn(second).particles.smallRadius, couetteIn(first).particles.smallRadius);
  EXPECT_EQ(second.engines, first.engines);
}

TEST_F(LoaderMerging, UnusedLawParameters_AreCleared) {
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

TEST_F(LoaderMerging, RigidLaw_WithMu_IsCoulomb) {
  const std::string rigid = "[case]\nkind = \"collision\"\n[law]\nnormal = \"rigid\"\ne_n = 0.9\n";
  const std::string rest =
      "[collision]\npsi = 1\nvn = [0.1, 0.2]\nradius = [0.001, 0.002]\n"
      "mass = 0.001\n[run]\ndt = 1e-4\n";
  write("smooth.toml", rigid + rest);
  write("rough.toml", rigid + "mu = 0.3\n" + rest);
  const Case smooth = loadCase("smooth.toml").front();
  EXPECT_EQ(smooth.law.tangential, TangentialLaw::none);
  EXPECT_EQ(loadCase("rough.toml").front().law.tangential, TangentialLaw::coulomb);
  EXPECT_EQ(collisionIn(smooth).psi, std::vector<double>{1.0});
  EXPECT_EQ(collisionIn(smooth).vn, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(collisionIn(smooth).radius[0], 0.001);
  EXPECT_EQ(collisionIn(smooth).radius[1], 0.002);
  EXPECT_EQ(collisionIn(smooth).mass[1], 0.001);
  EXPECT_EQ(collisionTimeSteps(smooth), std::vector<double>{1e-4});
}

TEST_F(LoaderMerging, PackingFile_IsRelativeToItsCaseFile) {
  write("base/own.h5", "");
  write("base/case.toml", soundCase + "file = \"own.h5\"\n");
  write("top.toml", "[case]\nextends = \"base/case.toml\"\n");
  const Case c = loadCase("top.toml").front();
  EXPECT_EQ(couetteIn(c).particles.file, "base/own.h5");
  EXPECT_EQ(couetteIn(c).particles.small, 0);  // the file says how many
  EXPECT_NEAR(timeStep(c), 43.5e-6, 0.05e-6);
}

void expectSame(const Case& a, const Case& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.variant, b.variant);
  EXPECT_EQ(a.source.index(), b.source.index());
  EXPECT_EQ(a.resolvedToml, b.resolvedToml);
  if (cellOf(a)) {
    EXPECT_EQ(couetteIn(a).particles.file, couetteIn(b).particles.file);
    EXPECT_EQ(packingHash(a, 0, 1e-5), packingHash(b, 0, 1e-5));
    ASSERT_EQ(a.averaging.margins.size(), b.averaging.margins.size());
    for (const auto& [field, margin] : a.averaging.margins) {
      EXPECT_EQ(margin.value, b.averaging.margins.at(field).value) << field;
      EXPECT_EQ(margin.why, b.averaging.margins.at(field).why);
    }
  }
  if (isCollision(a)) {
    EXPECT_EQ(collisionIn(a).psi, collisionIn(b).psi);
  }
}

TEST_F(LoaderMerging, ShippedCases_ResolvedLoadToThemselves) {
  int count = 0;
  for (const char* const part : {"couette", "collision", "cost", "hard"})
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(CROSSGRAIN_CASES) / part)) {
      if (entry.path().extension() != ".toml") continue;
      const std::vector<Case> once = loadCase(entry.path());
      if (std::string_view(part) != "cost") {  // those are called cost-…
        EXPECT_EQ(once.front().name, entry.path().stem());
      }
      const std::string text = resolvedFile(once);
      write("again.toml", text);
      const std::vector<Case> again = loadCase("again.toml");
      ASSERT_EQ(once.size(), again.size()) << entry.path();
      for (std::size_t k = 0; k < once.size(); ++k) expectSame(once[k], again[k]);
      EXPECT_EQ(resolvedFile(again), text) << entry.path();
      ++count;
    }
  EXPECT_GT(count, 60);
}

TEST_F(LoaderMerging, Resolved_NamesAPackingFileInFull) {
  write("sub/mine.h5", "");
  write("sub/case.toml", soundCase + "file = \"mine.h5\"\n[run]\ndt = 1e-5\n");
  const auto once = loadCase("sub/case.toml");
  write("again.toml", resolvedFile(once));
  EXPECT_EQ(std::filesystem::absolute(*couetteIn(once.front()).particles.file),
            *couetteIn(loadCase("again.toml").front()).particles.file);
}

using CaseKeysOf = InFolder;

TEST_F(CaseKeysOf, MergedDocument_ByFullName) {
  write("base.toml", soundCase +
                         "[averaging.margins]\nspin = { absolute = 0.3, why = \"b\" }\n"
                         "[engines.box2d-impulse]\ndt = 5e-4\n");
  write("top.toml", "[case]\nextends = \"base.toml\"\n[law]\nmu = 0.5\n");
  const CaseKeys keys = caseKeys(loadCase("top.toml").front().resolvedToml);
  EXPECT_EQ(keys.at("case.name"), "\"top\"");
  EXPECT_EQ(keys.at("law.mu"), "0.5");
  EXPECT_EQ(keys.at("law.kn"), "352.1");
  EXPECT_EQ(keys.at("averaging.margins.spin.absolute"), "0.3");
  EXPECT_EQ(keys.at("engines.box2d-impulse.dt"), "0.0005");
  EXPECT_FALSE(keys.contains("averaging.rings"));  // left to its default
}

TEST_F(CaseKeysOf, Changes_KeyByKey_FewAndShort) {
  write("one.toml", soundCase);
  const auto keysWith = [](const std::vector<std::string>& overrides) {
    return caseKeys(loadCase("one.toml", overrides).front().resolvedToml);
  };
  EXPECT_EQ(changes(keysWith({}), keysWith({})), std::vector<std::string>{});
  EXPECT_EQ(
      changes(keysWith({"averaging.rings=20"}), keysWith({"averaging.rings=30", "law.mu=1.0"})),
      (std::vector<std::string>{"averaging.rings: 20 → 30", "law.mu: 0.44 → 1.0"}));
  EXPECT_EQ(changes(keysWith({}), keysWith({"averaging.rings=30"})),
            std::vector<std::string>{"averaging.rings: none → 30"});
  CaseKeys before, now;
  for (int k = 0; k < 10; ++k) now["key" + std::to_string(k)] = "1";
  EXPECT_TRUE(describeChanges(changes(before, now)).ends_with("key7: none → 1; and 2 more"));
  before = {{"psi", "1.5"}};
  now = {{"psi", "'" + std::string(58, 'a') + "ΨΨΨΨ'"}};
  EXPECT_EQ(describeChanges(changes(before, now)), "psi: 1.5 → '" + std::string(58, 'a') + "…");
}

TEST(CaseKeysIn, Section_IsNotWhatBeginsLikeIt) {
  EXPECT_TRUE(isIn("averaging.margins", "averaging.margins.spin.absolute"));
  EXPECT_TRUE(isIn("run.timeout", "run.timeout"));
  EXPECT_FALSE(isIn("engines.grain", "engines.grain-as-yade.threads"));
}

}  // namespace
}  // namespace crossgrain::test
