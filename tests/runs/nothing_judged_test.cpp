// Where a comparison judged nothing it says so, and why.
#include "runs/common/nothing_judged.hpp"

#include <gtest/gtest.h>

namespace crossgrain {
namespace {

Case judging() {
  Case setup;
  setup.averaging.margins["spin"] = {1.0, false, "because", ""};
  return setup;
}

AgreementRow row(PairKind kind, int packings) {
  AgreementRow result;
  result.kind = kind;
  result.rings.resize(1);
  result.rings[0].packings = packings;
  return result;
}

using Rows = std::vector<AgreementRow>;

TEST(NothingJudged, OneEngineIsNoComparison) {
  const auto found = nothingJudged(judging(), {}, 1);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->byRequest);
}

TEST(NothingJudged, SaysWhatIsMissing) {
  const auto reason = [](const Case& setup, const Rows& agreement) {
    const auto found = nothingJudged(setup, agreement, 2);
    EXPECT_FALSE(found && found->byRequest);
    return found ? found->reason : "";
  };
  EXPECT_EQ(reason({}, Rows({row(PairKind::peer, 4)})), "the case has no [averaging.margins]");
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::peer, 2), row(PairKind::peer, 1)})),
            "2 packings of both engines, and a verdict needs at least 4");
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::peer, 1)})),
            "1 packing of both engines, and a verdict needs at least 4");
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::mirrorModel, 8)})),
            "no two engines finished a run that shows a field with a margin");
  AgreementRow empty = row(PairKind::peer, 0);
  empty.rings.clear();
  EXPECT_EQ(reason(judging(), Rows({empty})), "no ring has a value on two engines");
  // Tested and left open is judged.
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::peer, 4)})), "");
}

}  // namespace
}  // namespace crossgrain
