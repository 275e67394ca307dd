// Reports of made-up results, kept as text in golden/: what a report says changes only where that
// is meant. CROSSGRAIN_KEEP_GOLDEN=1 writes them anew.
#include <gtest/gtest.h>

#include <cstdlib>

#include "reports/report.hpp"
#include "results/conformance.hpp"
#include "results/schema.hpp"
#include "support/files.hpp"
#include "tests/reports/report_text.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::reports {
namespace {

ConformanceResults conformanceResults() {
  ConformanceResults results;
  results.head = sample::lockstepResults().head;
  results.head.kind = kindConformance;
  results.engine.name = "mine";
  results.engine.version = "1";
  results.rows = {{"suite", "HeadOnCollision", "two disks part", checkFailed, "e_n is 0.5", 3},
                  {"suite", "FreeFlight", "a disk keeps its velocity", checkPassed, ""},
                  {"lockstep", "quick cell", "it follows its mirror", checkPassed, ""},
                  {"collisions", "rolling", "both pass", checkSkipped, "it has no springs"}};
  results.declared = 12;
  results.notExamined = {"warm hand-over"};
  results.cause = "µ −30 %";
  return results;
}

void expectKept(const char* name, const nlohmann::json& results) {
  const auto file =
      std::filesystem::path(__FILE__).parent_path() / "golden" / (std::string(name) + ".txt");
  const std::string text = wholeTextOf(crossgrain::reportOf(results));
  if (std::getenv("CROSSGRAIN_KEEP_GOLDEN")) writeFile(file, text);
  EXPECT_EQ(readFile(file).value_or("there is none"), text) << file;
}

TEST(GoldenReports, Text_IsAsKept) {
  expectKept("average", toJson(sample::averageResults()));
  expectKept("collide", toJson(sample::collideResults()));
  expectKept("compare", toJson(sample::compareResults(4, 10)));
  expectKept("conformance", toJson(conformanceResults()));
  expectKept("cost", toJson(sample::costResults()));
  expectKept("effects", toJson(sample::effectsResults(4)));
  expectKept("lockstep", toJson(sample::lockstepResults()));
  expectKept("rev", toJson(sample::revResults()));
  expectKept("stability", toJson(sample::stabilityResults()));
}

}  // namespace
}  // namespace crossgrain::reports
