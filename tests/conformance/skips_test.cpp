// Coverage must not shrink unseen: what was skipped is what expected_skips.cpp lists, no more and
// no less.
#include <map>

#include "tests/conformance/conformance.hpp"
#include "tests/conformance/expected_skips.hpp"
#include "tests/conformance/names.hpp"

namespace crossgrain::test {
namespace {

std::string reasonOf(const testing::TestResult& result) {
  for (int part = 0; part < result.total_part_count(); ++part)
    if (result.GetTestPartResult(part).skipped()) return result.GetTestPartResult(part).message();
  return {};
}

/// Every other test of one engine that was to run in this process, by name.
std::map<std::string, const testing::TestResult*> testsOf(const std::string& engine) {
  const std::string ending = "/" + testName(engine);
  std::map<std::string, const testing::TestResult*> found;
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int s = 0; s < program.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *program.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) {
      const testing::TestInfo& test = *suite.GetTestInfo(t);
      const std::string name = test.name();
      if (!test.should_run() || !name.ends_with(ending) || &test == program.current_test_info())
        continue;
      found[name.substr(0, name.size() - ending.size())] = test.result();
    }
  }
  return found;
}

class Skips : public testing::TestWithParam<std::string> {};

TEST_P(Skips, AreTheExpectedOnes) {
  const EngineEntry& entry = *findEngine(GetParam());
  if (entry.missing && !entry.missing().empty()) GTEST_SKIP() << entry.missing();
  const auto tests = testsOf(GetParam());
  for (const auto& [name, result] : tests)
    ASSERT_GT(result->start_timestamp(), 0) << name << " has yet to run: this test goes last";

  std::map<std::string, std::string> expected;
  for (const ExpectedSkip& skip : expectedSkips())
    if (skip.engine == GetParam()) expected[std::string(skip.test)] = skip.reason;
  for (const auto& [name, result] : tests) {
    const auto known = expected.find(name);
    if (known == expected.end()) {
      EXPECT_FALSE(result->Skipped()) << name << " is skipped, which expected_skips.cpp does not "
                                      << "list: " << reasonOf(*result);
    } else {
      EXPECT_NE(reasonOf(*result).find(known->second), std::string::npos)
          << name << " is expected to be skipped because the engine " << known->second;
    }
  }
  const std::string filter = testing::GTEST_FLAG(filter);
  if (filter != "*" && filter != "*/" + testName(GetParam())) return;
  for (const auto& [name, reason] : expected)
    EXPECT_TRUE(tests.contains(name)) << "there is no test " << name << " to skip";
}

std::vector<std::string> allEngines() {
  std::vector<std::string> names;
  for (const EngineEntry& entry : engineRegistry()) names.push_back(entry.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Engines, Conformance, testing::ValuesIn(allEngines()),
                         [](const auto& one) { return testName(one.param); });
INSTANTIATE_TEST_SUITE_P(Engines, Skips, testing::ValuesIn(allEngines()),
                         [](const auto& one) { return testName(one.param); });

}  // namespace

TEST(ExpectedSkips, AreOfEnginesThatThereAre) {
  for (const ExpectedSkip& skip : expectedSkips())
    EXPECT_TRUE(findEngine(std::string(skip.engine))) << skip.engine;
}

}  // namespace crossgrain::test
