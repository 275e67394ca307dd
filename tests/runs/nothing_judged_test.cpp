// Where a comparison judged nothing it says so, and why.
#include "runs/common/nothing_judged.hpp"

#include <gtest/gtest.h>

namespace crossgrain {
namespace {

using nlohmann::json;

Case judging() {
  Case setup;
  setup.averaging.margins["spin"] = {1.0, false, "because", ""};
  return setup;
}

json row(const char* kind, int packings) {
  return {{"kind", kind},
          {"verdict", "undecided"},
          {"rings", json::array({json{{"packings", packings}}})}};
}

TEST(NothingJudged, OneEngineIsNoComparison) {
  const auto found = nothingJudged(judging(), json::array(), 1);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->byRequest);
}

TEST(NothingJudged, SaysWhatIsMissing) {
  const auto reason = [](const Case& setup, const json& agreement) {
    const auto found = nothingJudged(setup, agreement, 2);
    EXPECT_FALSE(found && found->byRequest);
    return found ? found->reason : "";
  };
  EXPECT_EQ(reason({}, json::array({row("peer", 4)})), "the case has no [averaging.margins]");
  EXPECT_EQ(reason(judging(), json::array({row("peer", 2), row("peer", 1)})),
            "2 packings of both engines, and a verdict needs at least 4");
  EXPECT_EQ(reason(judging(), json::array({row("peer", 1)})),
            "1 packing of both engines, and a verdict needs at least 4");
  EXPECT_EQ(reason(judging(), json::array({row("mirror_model", 8)})),
            "no two engines finished a run that shows a field with a margin");
  json empty = row("peer", 0);
  empty["rings"] = json::array();
  EXPECT_EQ(reason(judging(), json::array({empty})), "no ring has a value on two engines");
  // Tested and left open is judged.
  EXPECT_EQ(reason(judging(), json::array({row("peer", 4)})), "");
}

}  // namespace
}  // namespace crossgrain
