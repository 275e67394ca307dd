// Time per step of the in-house engine's spheres: sizes × what it has to do for them. README.md
// says what the figures mean.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>
#include <random>

#include "engines/grain/spheres.hpp"

namespace crossgrain::bench {
namespace {

using grain::SpheresSetup;
using Vector = grain::Vec3<double>;

constexpr double height = 21.0, fraction = 0.36;  // between the walls' centres, d; ν̄

/// The cell of cases/space/on-dem-shear.toml with another area: unit spheres between two walls of
/// touching ones that slide, half of a lattice's places.
SpheresSetup shearCell(std::size_t spheres) {
  const double rowDistance = std::sqrt(3.0) / 2.0;
  const double area = static_cast<double>(spheres) * std::numbers::pi / (6.0 * fraction * height);
  const int columns = static_cast<int>(std::lround(std::sqrt(area)));
  const int rows = 2 * static_cast<int>(std::lround(area / columns / rowDistance / 2.0));
  SpheresSetup setup;
  setup.box = grain::SpaceBox{
      {0.0, 0.0, 0.0}, {1.0 * columns, rows * rowDistance, 1.0}, {true, true, false}};
  const auto layer = [&](double z, double shift) {
    std::vector<Vector> places;
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        places.push_back({x + shift + 0.5 * (y % 2), rowDistance * (y + shift), z});
    return places;
  };
  constexpr int layers = 24;
  std::vector<Vector> places;
  for (int z = 1; z <= layers; ++z)
    for (const Vector& place : layer(z * height / (layers + 1), 0.3 * (z % 2)))
      places.push_back(place);
  std::mt19937_64 random(1);
  std::ranges::shuffle(places, random);
  places.resize(std::min(places.size(), spheres));
  std::normal_distribution<double> speed(0.0, 0.3);
  const double mass = std::numbers::pi / 6.0;
  for (const Vector& place : places) {
    setup.position.push_back(place);
    setup.velocity.push_back({speed(random), speed(random), speed(random)});
  }
  setup.spin.resize(places.size());
  setup.radius.assign(places.size(), 0.5);
  setup.mass.assign(places.size(), mass);
  setup.inertia.assign(places.size(), 0.1 * mass);
  for (const double side : {-1.0, 1.0}) {
    grain::SpaceWall wall;
    wall.position = layer(side > 0.0 ? height : 0.0, 0.0);
    wall.radius.assign(wall.position.size(), 0.5);
    wall.motion = [side](double t) {
      return grain::SpaceWall::State{{side * t, 0.0, 0.0}, {side, 0.0, 0.0}};
    };
    setup.walls.push_back(wall);
  }
  setup.law.kn = 2e5;
  setup.law.gn = 15.0;
  setup.law.kt = 2.0 / 7.0 * setup.law.kn;
  setup.law.gt = 2.0 / 7.0 * setup.law.gn;
  setup.law.mu = 0.3;
  setup.law.tangential = grain::Tangential::springDashpot;
  setup.law.bound = grain::Bound::magnitude;
  setup.dt = 7.1925e-5;
  return setup;
}

struct Task {
  const char* name;
  void (*change)(SpheresSetup&);
};

constexpr Task tasks[] = {
    {"everyday", [](SpheresSetup&) {}},
    {"mirror", [](SpheresSetup& s) { s.conventions.turn = grain::SpringTurn::rescaled; }},
    {"general",
     [](SpheresSetup& s) { s.law.rolling = grain::Rolling::viscous; }},  // of no strength
    {"everyone",
     [](SpheresSetup& s) {
       grain::SpaceWall& wall = s.walls.emplace_back();
       wall.planes.push_back({{0.0, 0.0, -1e3}, {0.0, 0.0, 1.0}});
       wall.motion = [](double) { return grain::SpaceWall::State{}; };
     }},
};

/// On one thread the processor's, which other programs do not disturb, else wall time [s].
double timeOn(int threads) {
  timespec now{};
  clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Running on and on, rebuilds counted in, after the lattice has melted. Time is that of 200 steps.
void step(benchmark::State& state, std::size_t spheres, const Task& task, int threads) {
  SpheresSetup setup = shearCell(spheres);
  setup.threads = threads;
  task.change(setup);
  grain::Spheres simulation(setup);
  simulation.advance(spheres > 30000 ? 2000 : 10000);
  constexpr std::uint64_t stretch = 200;
  const std::uint64_t contacts = simulation.contactEvaluations();
  const std::uint64_t rebuilds = simulation.rebuilds();
  double seconds = 0.0;
  for (auto _ : state) {
    const double start = timeOn(threads);
    simulation.advance(stretch);
    const double taken = timeOn(threads) - start;
    state.SetIterationTime(taken);
    seconds += taken;
  }
  const auto steps = static_cast<double>(stretch * state.iterations());
  const auto perStep = [&](std::uint64_t now, std::uint64_t before) {
    return static_cast<double>(now - before) / steps;
  };
  state.counters["us_step"] = 1e6 * seconds / steps;
  state.counters["ns_sphere"] = 1e9 * seconds / steps / static_cast<double>(simulation.size());
  const double touching = perStep(simulation.contactEvaluations(), contacts);
  state.counters["ns_contact"] = 1e9 * seconds / steps / touching;
  state.counters["contacts"] = touching;
  state.counters["rebuilds_per_1000"] = 1e3 * perStep(simulation.rebuilds(), rebuilds);
}

}  // namespace
}  // namespace crossgrain::bench

int main(int argc, char** argv) {
  using namespace crossgrain::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  for (const std::size_t spheres : {500, 3000, 20000, 100000, 1000000})
    for (const Task& task : tasks)
      for (const int threads : {1, 2})
        benchmark::RegisterBenchmark(
            fmt::format("spheres/{}/{}/{}", spheres, task.name, threads).c_str(),
            [=, &task](auto& state) { step(state, spheres, task, threads); })
            ->UseManualTime()
            ->Unit(benchmark::kMicrosecond);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
