// Time of averaging one snapshot, in steps of the in-house engine on the same scene, measured in
// turns. README.md says what the figures mean.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>

#include "adapters/grain.hpp"
#include "averaging/profiles.hpp"
#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "studies/flow/averages.hpp"
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
  const double width = couetteIn(setup).cell.outerRadius - couetteIn(setup).cell.innerRadius;
  const double diameter = 2.0 * couetteIn(setup).particles.smallRadius;
  return {couetteIn(setup).cell.innerRadius, couetteIn(setup).cell.outerRadius,
          static_cast<int>(width / diameter), couetteIn(setup).cell.height, diameter};
}

/// Averages snapshots of a sheared packing with what `make` gives for it.
template <class Make>
void average(benchmark::State& state, std::size_t disks, Make&& make) {
  Case setup = scaledCase(thesisCell(), disks);
  couetteIn(setup).times.rings = rings(setup).count();
  setFlowOfCell(setup);
  const double dt = timeStep(setup);
  const Scene scene = couetteScene(setup, packedInto(setup, packingFolder), dt);
  const auto engine = makeGrain();
  engine->load(scene, {});
  auto averages = make(setup, scene);
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
    averages.add(now);
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

/// All fields of one weight.
ProfileAccumulator fields(WeightMethod method, const Case& setup, const Scene& scene) {
  const double width = setup.averaging.lineWidth * 2.0 * couetteIn(setup).particles.smallRadius;
  return {rings(setup), {{method, width}}, scene};
}

constexpr std::size_t sizes[] = {1000, 2921, 10000, 100000, 1000000};

template <class Make>
void registerAt(std::string_view name, Make make) {
  for (const std::size_t disks : sizes) {
    auto* const bench =
        benchmark::RegisterBenchmark(fmt::format("snapshot/{}/{}", name, disks).c_str(),
                                     [=](auto& state) { average(state, disks, make); });
    bench->UseManualTime()->Unit(benchmark::kMicrosecond);
    // The first snapshots of many disks touch new memory.
    if (disks >= 100000) bench->MinTime(2.0);
  }
}

void registerAll() {
  // All work of a run on a snapshot: fields by slicing, distributions, series, layers of spin.
  registerAt("everything",
             [](const Case& setup, const Scene& scene) { return FlowAverages<2>(setup, scene); });
  for (const WeightMethod method :
       {WeightMethod::slicing, WeightMethod::straightCut, WeightMethod::centre,
        WeightMethod::lineGaussian, WeightMethod::lineHeaviside})
    registerAt(toString(method), [method](const Case& setup, const Scene& scene) {
      return fields(method, setup, scene);
    });
}

}  // namespace
}  // namespace crossgrain::bench

int main(int argc, char** argv) {
  using namespace crossgrain::bench;
  return runBenchmarks(argc, argv, packingFolder, registerAll);
}
