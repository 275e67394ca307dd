// Time of averaging one snapshot, in steps of the in-house engine on the same scene, measured in
// turns. README.md says what the figures mean.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>

#include "adapters/grain.hpp"
#include "averaging/profiles.hpp"
#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "runs/couette_run.hpp"
#include "tests/bench/packings.hpp"
#include "tests/bench/packings_option.hpp"

namespace crossgrain::bench {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::filesystem::path packingFolder;

/// Rings of the thesis' width, however large the cell.
Rings rings(const Case& setup) {
  const double width = setup.cell.outerRadius - setup.cell.innerRadius;
  const double diameter = 2.0 * setup.particles.smallRadius;
  return {setup.cell.innerRadius, setup.cell.outerRadius, static_cast<int>(width / diameter),
          setup.cell.height, diameter};
}

void snapshot(benchmark::State& state, WeightMethod method, std::size_t disks) {
  const Case setup = scaledCase(disks);
  const double dt = timeStep(setup);
  const Scene scene = couetteScene(setup, packed(disks, packingFolder), dt);
  const auto engine = makeGrain();
  engine->load(scene, {});
  const double width = setup.averaging.lineWidth * 2.0 * setup.particles.smallRadius;
  ProfileAccumulator profiles(rings(setup), {{method, width}}, scene);
  constexpr int stretch = 20;
  std::int64_t steps = 0;
  double stepping = 0.0, averaging = 0.0;
  for (auto _ : state) {
    steps += stretch;
    auto start = Clock::now();
    engine->advance(static_cast<double>(steps) * dt);
    stepping += secondsSince(start);
    const Snapshot now = engine->snapshot(ContactReport::instant);
    start = Clock::now();
    profiles.add(now);
    const double taken = secondsSince(start);
    averaging += taken;
    state.SetIterationTime(taken);
  }
  const double step = stepping / static_cast<double>(steps);
  const double one = averaging / static_cast<double>(state.iterations());
  state.counters["us_step"] = 1e6 * step;
  state.counters["in_steps"] = one / step;
  state.counters["ns_disk"] = 1e9 * one / static_cast<double>(disks);
}

void registerAll() {
  for (const WeightMethod method :
       {WeightMethod::slicing, WeightMethod::straightCut, WeightMethod::centre,
        WeightMethod::lineGaussian, WeightMethod::lineHeaviside})
    for (const std::size_t disks : {1000, 2921, 10000, 100000, 1000000})
      benchmark::RegisterBenchmark(fmt::format("snapshot/{}/{}", toString(method), disks).c_str(),
                                   [=](auto& state) { snapshot(state, method, disks); })
          ->UseManualTime()
          ->Unit(benchmark::kMicrosecond);
}

}  // namespace
}  // namespace crossgrain::bench

int main(int argc, char** argv) {
  crossgrain::bench::packingFolder = crossgrain::bench::takePackingFolder(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  crossgrain::bench::registerAll();
  benchmark::RunSpecifiedBenchmarks();
}
