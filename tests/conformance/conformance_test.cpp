// Every engine of the registry passes every check of runs/conformance, each through its real
// worker; what it skips is what expected_skips.cpp lists, no more and no less, so that coverage
// does not shrink unseen.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>

#include "adapters/registry.hpp"
#include "results/json_fields.hpp"
#include "runs/conformance/examination.hpp"
#include "support/scratch_folder.hpp"
#include "tests/conformance/expected_skips.hpp"
#include "tests/conformance/names.hpp"

namespace crossgrain::test {
namespace {

using conformance::Check;
using conformance::checksOf;

std::vector<std::string> allEngines() {
  std::vector<std::string> names;
  for (const EngineEntry& entry : engineRegistry()) names.push_back(entry.name);
  return names;
}

class Conformance : public testing::TestWithParam<std::string> {};

TEST_P(Conformance, OfEveryCheck) {
  const EngineEntry& entry = *findEngine(GetParam());
  if (entry.missing && !entry.missing().empty()) GTEST_SKIP() << entry.missing();
  std::map<std::string, std::string> expected;
  for (const ExpectedSkip& skip : expectedSkips())
    if (skip.engine == entry.name) expected[std::string(skip.test)] = skip.reason;

  const ScratchFolder scratch;
  const std::vector<Check> checks = checksOf(!entry.mirrors.empty());
  const conformance::Examination done =
      conformance::examine(entry, checks, scratch.path, [](const std::string&, double) {});
  for (const ConformanceRow& row : done.rows) {
    // What it does not declare cannot be asked for.
    constexpr std::string_view undeclared = "declares no ";
    if (row.outcome == ConformanceOutcome::skipped && row.detail.starts_with(undeclared) &&
        std::ranges::count(done.declared, row.detail.substr(undeclared.size())) == 0)
      continue;
    const auto known = expected.find(row.name);
    if (known != expected.end()) {
      EXPECT_EQ(row.outcome, ConformanceOutcome::skipped) << row.name << ": " << row.detail;
      EXPECT_NE(row.detail.find(known->second), std::string::npos)
          << row.name << " is expected to be skipped because the engine " << known->second
          << ", not: " << row.detail;
    } else {
      EXPECT_EQ(row.outcome, ConformanceOutcome::passed)
          << row.name << " (" << nameOf(row.outcome) << "): " << row.detail
          << fmt::format(" ({} faults)", row.faults);
    }
  }
  // A check that marks what nobody declares marks nothing: it is named otherwise there.
  if (entry.name == engineRegistry().front().name) {
    for (const std::string& one : done.examined)
      EXPECT_EQ(std::ranges::count(done.declared, one), 1) << one;
  }
  for (const auto& [name, reason] : expected)
    EXPECT_TRUE(std::ranges::any_of(checks, [&](const Check& check) { return check.name == name; }))
        << "there is no check " << name << " to skip";
}

INSTANTIATE_TEST_SUITE_P(Engines, Conformance, testing::ValuesIn(allEngines()),
                         [](const auto& one) { return testName(one.param); });

}  // namespace

TEST(ExpectedSkips, AreOfEnginesThatThereAre) {
  for (const ExpectedSkip& skip : expectedSkips())
    EXPECT_TRUE(findEngine(std::string(skip.engine))) << skip.engine;
}

}  // namespace crossgrain::test
