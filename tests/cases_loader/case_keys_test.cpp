#include "cases/case_keys.hpp"

#include "files.hpp"

namespace crossgrain::test {
namespace {

using KeysOfCases = InFolder;

TEST_F(KeysOfCases, AreThoseOfTheMergedDocumentByTheirFullName) {
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

TEST_F(KeysOfCases, ChangesAreNamedKeyByKey) {
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
}

TEST(CaseKeysInWords, AreFewAndShort) {
  CaseKeys before, now;
  for (int k = 0; k < 10; ++k) now["key" + std::to_string(k)] = "1";
  EXPECT_TRUE(changesInWords(changes(before, now)).ends_with("key7: none → 1; and 2 more"));
  before = {{"psi", "1.5"}};
  now = {{"psi", "'" + std::string(58, 'a') + "ΨΨΨΨ'"}};
  EXPECT_EQ(changesInWords(changes(before, now)), "psi: 1.5 → '" + std::string(58, 'a') + "…");
}

TEST(CaseKeysInSections, ASectionIsNotWhatBeginsLikeIt) {
  EXPECT_TRUE(isIn("averaging.margins", "averaging.margins.spin.absolute"));
  EXPECT_TRUE(isIn("run.timeout", "run.timeout"));
  EXPECT_FALSE(isIn("engines.grain", "engines.grain-as-yade.threads"));
}

}  // namespace
}  // namespace crossgrain::test
