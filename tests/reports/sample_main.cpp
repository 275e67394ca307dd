// Writes made-up reports to look at: crossgrain_sample_reports DIR
#include <cstdio>
#include <filesystem>

#include "reports/report.hpp"
#include "tests/reports/sample_results.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path dir = argv[1];

  crossgrain::writeReport(crossgrain::sample::compareResults(4, 2921), dir / "compare");
  crossgrain::writeReport(crossgrain::sample::compareResults(1, 244), dir / "single");
  crossgrain::writeReport(crossgrain::sample::collideResults(), dir / "collide");
  crossgrain::writeReport(crossgrain::sample::manyCollideResults(), dir / "collide-many");
  crossgrain::writeReport(crossgrain::sample::lockstepResults(), dir / "lockstep");
  crossgrain::writeReport(crossgrain::sample::effectsResults(4), dir / "effects");
  crossgrain::writeReport(crossgrain::sample::stabilityResults(), dir / "stability");
  crossgrain::writeReport(crossgrain::sample::costResults(), dir / "cost");
  crossgrain::writeReport(crossgrain::sample::averageResults(), dir / "average");
  crossgrain::writeReport(crossgrain::sample::revResults(), dir / "rev");
  crossgrain::LockstepResults before = crossgrain::sample::lockstepResults();
  before.head.version = "0.0.9";
  crossgrain::writeSite(
      {{"lockstep", toJson(crossgrain::sample::lockstepResults())}, {"before", toJson(before)}},
      dir / "site");
  std::printf("%s\n", dir.c_str());
}
