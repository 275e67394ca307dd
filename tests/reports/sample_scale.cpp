#include "tests/reports/sample_common.hpp"
#include "tests/reports/sample_results.hpp"

namespace crossgrain::sample {

ScaleResults scaleResults() {
  ScaleResults results;
  results.head = scaleFromJson(head("scale", "scaled cell")).head;
  results.repetitions = 3;
  results.engines = {engineRow("grain", "in-house"),
                     engineRow("odd-one", "a stranger", "", Status::failed, awkward)};
  results.sharing = {{"grain", "threads"}, {"odd-one", ""}};
  double perDisk = 16e-9;
  for (const std::size_t disks : {1000u, 10'000u, 100'000u}) {
    const auto n = static_cast<double>(disks);
    results.cells.push_back({disks, disks / 4, 1e-3 * std::sqrt(n), 0.8, "0123"});
    for (const int workers : {1, 2}) {
      ScalePoint point;
      point.engine = "grain";
      point.disks = disks;
      point.workers = workers;
      point.steps = 20'000'000 / disks;
      const double step = perDisk * n / (workers == 1 ? 1.0 : 1.6);
      point.seconds = {step, 1.05 * step, 1.02 * step};
      point.memory = 2e7 + 300.0 * n;
      point.precision = "double";
      point.dt = 4e-5;
      results.points.push_back(point);
    }
    ScalePoint odd;
    odd.engine = "odd-one";
    odd.disks = disks;
    odd.steps = 100;
    odd.seconds = {10.0 * perDisk * n};
    odd.differs = {"bottom_friction", "slop"};
    if (disks == 100'000) {
      odd.status = Status::failed;
      odd.reason = awkward;
      odd.seconds.clear();
      odd.differs.clear();
    }
    results.points.push_back(odd);
    perDisk *= 1.1;
  }
  return results;
}

}  // namespace crossgrain::sample
