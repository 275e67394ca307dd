// Where a comparison judged nothing it says so, and why.
#include "runs/couette/compare.hpp"

#include <gtest/gtest.h>

namespace crossgrain {
namespace {

Case judging() {
  Case setup;
  setup.averaging.endpoints["spin_at_wheel"] = {1.0, false, "because", ""};
  return setup;
}

EndpointRow row(PairKind kind, int packings) {
  EndpointRow result;
  result.kind = kind;
  result.packings = packings;
  return result;
}

using Rows = std::vector<EndpointRow>;

TEST(NothingJudged, OneEngineIsNoComparison) {
  const auto found = nothingJudged(judging(), {}, 1);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->byRequest);
}

TEST(NothingJudged, SaysWhatIsMissing) {
  const auto reason = [](const Case& setup, const Rows& rows) {
    const auto found = nothingJudged(setup, rows, 2);
    EXPECT_FALSE(found && found->byRequest);
    return found ? found->reason : "";
  };
  EXPECT_EQ(reason({}, Rows({row(PairKind::peer, 4)})), "the case has no [averaging.endpoints]");
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::peer, 2), row(PairKind::peer, 1)})),
            "2 packings of both engines, and a verdict needs at least 4");
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::peer, 1)})),
            "1 packing of both engines, and a verdict needs at least 4");
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::mirrorModel, 8)})),
            "no two engines finished a run that shows an endpoint with a margin");
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::peer, 0)})),
            "no endpoint has a value on two engines");
  // Tested and left open is judged.
  EXPECT_EQ(reason(judging(), Rows({row(PairKind::peer, 4)})), "");
}

}  // namespace
}  // namespace crossgrain
