// Reasons of refuted claims: what a file of them may say, and one line where it says otherwise.
#include "cases/claim_reasons.hpp"

#include <gtest/gtest.h>

#include "files.hpp"

namespace crossgrain::test {
namespace {

class ClaimReasonsFile : public InFolder {
 protected:
  static const ClaimRules& rules() {
    static const ClaimRules of =
        loadClaimRules(std::filesystem::path(CROSSGRAIN_CASES) / "couette/thesis/claims.toml");
    return of;
  }

  static std::string messageOf(const std::string& text) {
    write("reasons.toml", text);
    try {
      loadClaimReasons("reasons.toml", rules());
    } catch (const BadInput& error) {
      return error.what();
    }
    return {};
  }

  static void refused(const std::string& text, const std::string& word) {
    const std::string message = messageOf(text);
    EXPECT_NE(message.find(word), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with("reasons.toml:")) << message;
  }

  static std::string reason(const std::string& members) {
    return "[[reasons]]\ntext = \"it is so\"\nevidence = \"figure 7.14\"\n" + members;
  }
};

TEST_F(ClaimReasonsFile, ShippedOnesLoad) {
  const auto file = std::filesystem::path(CROSSGRAIN_CASES) / "couette/thesis/reasons.toml";
  EXPECT_NO_THROW(loadClaimReasons(file, rules()));
}

TEST_F(ClaimReasonsFile, HaveConditionsOnFiguresOfTheirOwnClaimOrOfOthers) {
  const ClaimReasons all = claimReasonsOf(
      reason(
          "claim = \"C26\"\nengine = \"grain\"\nwhen = [{ figure = \"overlap\", above = -6.5 }, { "
          "claim = \"C4\", figure = \"pressure_late\", above = -9.0, below = -1.0 }]\n"),
      rules());
  ASSERT_EQ(all.reasons.size(), 1u);
  const ClaimReason& one = all.reasons[0];
  EXPECT_EQ(one.claim, "C26");
  EXPECT_EQ(one.engine, "grain");
  ASSERT_EQ(one.when.size(), 2u);
  EXPECT_EQ(one.when[0].claim, "C26");
  EXPECT_EQ(one.when[0].above, -6.5);
  EXPECT_FALSE(one.when[0].below);
  EXPECT_EQ(one.when[1].claim, "C4");
  EXPECT_EQ(one.when[1].below, -1.0);
  EXPECT_TRUE(claimReasonsOf("", rules()).reasons.empty());
}

TEST_F(ClaimReasonsFile, AreRefusedInOneLineThatSaysWhere) {
  const std::string when = "when = [{ figure = \"overlap\", above = 1.0 }]\n";
  refused(reason("claim = \"C28\"\n" + when), "C28");
  refused(reason(when), "claim");
  refused(reason("claim = \"C26\"\n"), "when");
  refused(reason("claim = \"C26\"\nwhen = [{ figure = \"overlip\", above = 1.0 }]\n"), "overlap");
  refused(reason("claim = \"C26\"\nwhen = [{ figure = \"overlap\" }]\n"), "above");
  refused(reason("claim = \"C26\"\nwehn = 1\n" + when), "wehn");
  refused("[[reasons]]\nclaim = \"C26\"\nevidence = \"figure 7.14\"\n" + when, "text");
  refused("[[reasons]]\nclaim = \"C26\"\ntext = \"it is so\"\n" + when, "evidence");
}

}  // namespace
}  // namespace crossgrain::test
