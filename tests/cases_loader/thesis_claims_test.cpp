// The rules by which the thesis' claims are judged and the reasons of refuted ones: complete, each
// number with its reason, and a file that is not is refused in one line that says where.
#include "cases/thesis_claims.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "files.hpp"

namespace crossgrain::test {
namespace {

const std::filesystem::path rulesFile =
    std::filesystem::path(CROSSGRAIN_CASES) / "couette/thesis/claims.toml";

/// What the shipped file has, as claims.cpp asks for it.
const ClaimSchema& shippedSchema() {
  static const ClaimSchema schema = [] {
    const ClaimRules rules = loadClaimRules(rulesFile, nullptr);
    ClaimSchema all;
    for (const ClaimNumber& number : rules.common) all.common.push_back(number.name);
    for (const ClaimRule& rule : rules.claims) {
      ClaimNeeds& needs = all.claims.emplace_back(ClaimNeeds{rule.id, {}, {}});
      for (const ClaimNumber& number : rule.numbers) needs.numbers.push_back(number.name);
      for (const ClaimBand& figure : rule.figures) needs.figures.push_back(figure.name);
    }
    return all;
  }();
  return schema;
}

class ThesisClaims : public InFolder {
 protected:
  /// The shipped file with one part replaced; empty: it loads.
  static std::string messageWith(const std::string& part, const std::string& replacement) {
    std::ostringstream text;
    text << std::ifstream(rulesFile).rdbuf();
    std::string broken = text.str();
    const auto at = broken.find(part);
    EXPECT_NE(at, std::string::npos) << part;
    broken.replace(at, part.size(), replacement);
    write("claims.toml", broken);
    try {
      loadClaimRules("claims.toml", &shippedSchema());
    } catch (const BadInput& error) {
      return error.what();
    }
    return {};
  }

  static void refused(const std::string& part, const std::string& replacement,
                      const std::string& word) {
    const std::string message = messageWith(part, replacement);
    EXPECT_NE(message.find(word), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with("claims.toml:")) << message;
  }
};

TEST_F(ThesisClaims, EachIsThereOnceInOrderWithAFigureThatIsJudged) {
  const ClaimRules rules = loadClaimRules(rulesFile, nullptr);
  ASSERT_EQ(rules.claims.size(), 27u);
  for (std::size_t k = 0; k < 27; ++k) {
    EXPECT_EQ(rules.claims[k].id, "C" + std::to_string(k + 1));
    EXPECT_TRUE(rules.claims[k].judgedFigures() > 0 ||
                !std::ranges::all_of(rules.claims[k].figures, &ClaimBand::testable))
        << rules.claims[k].id;
  }
  EXPECT_NE(rules.text.find("C27"), std::string::npos);
}

TEST_F(ThesisClaims, PrintedNumbersAreInTheirBands) {
  const ClaimRules rules = loadClaimRules(rulesFile, nullptr);
  const auto holds = [&](const char* id, const char* figure, double printed) {
    const ClaimBand& band = rules.of(id).band(figure);
    EXPECT_LT(band.low.value(), printed) << id << figure;
    EXPECT_GT(band.high.value(), printed) << id << figure;
  };
  holds("C5", "width", 5.5);
  holds("C6", "critical", 0.793);
  holds("C8", "amplitude", 0.24);
  holds("C8", "decay", 1.46);
  holds("C8", "phase", 1.79);
  holds("C15", "exponent_rp", -2.0);
  EXPECT_GT(rules.of("C24").band("couple_size").high.value(), 6e-5);
  EXPECT_GT(rules.of("C26").band("overlap").high.value(), -7.0);
}

TEST_F(ThesisClaims, WhatIsIncompleteUnknownOrInDisorder_IsRefusedWithLine) {
  refused("confidence = {", "surprise = { value = 1.0, why = \"w\" }\nconfidence = {", "surprise");
  refused("ridge_half_width = { value", "halb = { value", "half_width is missing");
  refused("width = { label", "wide = { label", "width is missing");
  refused("claim = \"There is a dilated", "clam = \"There is a dilated", "unknown key");
  refused("readings = [\"tension\"]", "readings = [\"tensoin\"]", "tension");
  refused("why = \"as everywhere in this project\"", "why = \" \"", "reason");
  refused(", why = \"figure 5.7's\"", "", "why is missing");
  refused("fewest_for_trend = { value = 5, ", "fewest_for_trend = { ", "value is missing");
  refused("low = 4.0, high = 7.0", "low = 7.0, high = 4.0", "above low");
  refused("low = 4.0, high = 7.0", "testable = false, low = 4.0", "neither low nor high");
  refused("low = 4.0, high = 7.0", "low = nan, high = 4.0", "not a number");
  refused("id = \"C7\"", "id = \"C77\"", "C7");
  std::ostringstream text;
  text << std::ifstream(rulesFile).rdbuf();
  const std::string whole = text.str();
  const auto from = whole.find("[[claims]]\nid = \"C27\"");
  ASSERT_NE(from, std::string::npos);
  const std::string last = whole.substr(from);
  refused(last, "", "C27");
  refused(last, last + last, "twice");
}

class ClaimReasonsFile : public InFolder {
 protected:
  static const ClaimRules& rules() {
    static const ClaimRules of = loadClaimRules(rulesFile, nullptr);
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
  EXPECT_NO_THROW(loadClaimReasons(rulesFile.parent_path() / "reasons.toml", rules()));
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
