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
#include "tests/bench/effect_sets.hpp"

namespace crossgrain::bench {
namespace {

using grain::SpheresSetup;
using Vector = grain::Vec3<double>;

/// Unit spheres between two walls of touching ones that slide: some places of a lattice.
struct Cell {
  double height;    ///< between the walls' centres [d]
  double fraction;  ///< of that room which spheres fill
  int layers;
  double speed;  ///< at the start: root mean square of each component
};
/// As cases/space/on-dem-shear.toml and shear-3d.toml, but for the area.
constexpr Cell dilute{21.0, 0.36, 24, 0.3}, dense{11.0, 0.513, 12, 0.3};

SpheresSetup shearCell(const Cell& cell, std::size_t spheres) {
  const double rowDistance = std::sqrt(3.0) / 2.0;
  const double area =
      static_cast<double>(spheres) * std::numbers::pi / (6.0 * cell.fraction * cell.height);
  // Twenty by twelve places in a layer of 3000 spheres, ten by six in one of 560, as in the cases.
  const int columns = static_cast<int>(std::lround(std::sqrt(2.0 * area)));
  const int rows = 2 * static_cast<int>(std::lround(area / columns / rowDistance / 2.0));
  SpheresSetup setup;
  setup.box = grain::SpaceBox{
      {0.0, 0.0, 0.0}, {1.0 * columns, rows * rowDistance, 1.0}, {true, true, false}};
  // Odd layers lie in the hollows of even ones.
  const auto layer = [&](int number, double z) {
    const Vector first = number % 2 * Vector{0.5, std::sqrt(3.0) / 6.0, 0.0};
    std::vector<Vector> places;
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        places.push_back(first + Vector{x + 0.5 * (y % 2), rowDistance * y, z});
    return places;
  };
  std::vector<Vector> places;
  for (int n = 1; n <= cell.layers; ++n)
    for (const Vector& place : layer(n, n * cell.height / (cell.layers + 1)))
      places.push_back(place);
  std::mt19937_64 random(1);
  std::ranges::shuffle(places, random);
  places.resize(std::min(places.size(), spheres));
  std::normal_distribution<double> speed(0.0, cell.speed);
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
    wall.position = side > 0.0 ? layer(cell.layers + 1, cell.height) : layer(0, 0.0);
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
  setup.law.tangential = grain::TangentialLaw::springDashpot;
  setup.law.conventions.coulombBound = grain::CoulombBound::magnitude;
  setup.dt = 7.1925e-5;
  return setup;
}

/// Layers of a hexagonal packing that lie on one of walls under their own weight, some six contacts
/// each that last: 0.1 % of a radius deep at the start.
SpheresSetup restingBed(std::size_t spheres) {
  constexpr int columns = 10, rows = 6;
  const double rowDistance = std::sqrt(3.0) / 2.0, layerDistance = std::sqrt(2.0 / 3.0) - 5e-4;
  SpheresSetup setup = shearCell(dense, 0);
  const grain::SpaceWall floor = setup.walls.front();
  setup.walls = {floor};
  setup.walls[0].motion = [](double) { return grain::SpaceWall::State{}; };
  setup.box = grain::SpaceBox{
      {0.0, 0.0, 0.0}, {1.0 * columns, rows * rowDistance, 1.0}, {true, true, false}};
  setup.walls[0].position.clear();
  for (int k = 0; k < columns * rows; ++k)
    setup.walls[0].position.push_back(
        {k % columns + 0.5 * (k / columns % 2), rowDistance * (k / columns), 0.0});
  setup.walls[0].radius.assign(setup.walls[0].position.size(), 0.5);
  for (std::size_t k = 0; k < spheres; ++k) {
    const auto layer = static_cast<int>(k / (columns * rows)) + 1;
    setup.position.push_back(setup.walls[0].position[k % (columns * rows)] +
                             layer % 2 * Vector{0.5, std::sqrt(3.0) / 6.0, 0.0} +
                             Vector{0.0, 0.0, layer * layerDistance});
  }
  const double mass = std::numbers::pi / 6.0;
  setup.velocity.assign(spheres, {});
  setup.spin.assign(spheres, {});
  setup.radius.assign(spheres, 0.5);
  setup.mass.assign(spheres, mass);
  setup.inertia.assign(spheres, 0.1 * mass);
  setup.gravity = {0.0, 0.0, -1.0};
  return setup;
}

/// As cases/space/silo.toml with its opening shut: layers of rings of spheres in a hollow cylinder,
/// on spheres that touch, of two materials; at rest after 0.1 s.
SpheresSetup filledSilo(std::size_t spheres) {
  constexpr double radius = 0.002, pitch = 2.2 * radius, hollow = 0.025;
  SpheresSetup setup;
  const auto rings = [](double outer, double spacing) {
    std::vector<Vector> places;
    for (double ring = 0.0; ring <= outer; ring += spacing) {
      const auto count = std::max(1, static_cast<int>(2.0 * std::numbers::pi * ring / spacing));
      for (int k = 0; k < count; ++k)
        places.push_back(ring * Vector{std::cos(2.0 * std::numbers::pi * k / count),
                                       std::sin(2.0 * std::numbers::pi * k / count), 0.0});
    }
    return places;
  };
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> off(-1.0, 1.0);
  const std::vector<Vector> layer = rings(hollow - 1.05 * radius, pitch);
  for (std::size_t k = 0; k < spheres; ++k) {
    const double a = radius * (1.0 + 0.05 * off(random));
    const double mass = 4.0 / 3.0 * std::numbers::pi * a * a * a * 2500.0;
    const auto up = static_cast<double>(k / layer.size() + 1);
    setup.position.push_back(layer[k % layer.size()] + Vector{0.0, 0.0, up * pitch} +
                             0.02 * radius * Vector{off(random), off(random), off(random)});
    setup.radius.push_back(a);
    setup.mass.push_back(mass);
    setup.inertia.push_back(0.4 * mass * a * a);
  }
  setup.velocity.resize(spheres);
  setup.spin.resize(spheres);
  grain::SpaceWall silo, ground;
  silo.position = rings(hollow, 2.0 * radius);
  silo.radius.assign(silo.position.size(), radius);
  silo.cylinders.push_back({{}, {0.0, 0.0, 1.0}, hollow});
  ground.planes.push_back({{0.0, 0.0, -0.09}, {0.0, 0.0, 1.0}});
  silo.motion = ground.motion = [](double) { return grain::SpaceWall::State{}; };
  setup.walls = {silo, ground};
  setup.law.kn = 1000.0;
  setup.law.gn = 0.0882;
  setup.law.kt = 285.7;
  setup.law.gt = 0.0252;
  setup.law.mu = 0.3;
  setup.law.tangential = grain::TangentialLaw::springDashpot;
  setup.law.conventions.coulombBound = grain::CoulombBound::magnitude;
  grain::ContactLaw steel = setup.law;
  steel.gn = 0.162;
  steel.gt = 0.0463;
  steel.mu = 0.2;
  setup.materials = grain::Materials{
      std::vector<std::int32_t>(spheres, 0), {1, 1}, 2, {setup.law, steel, steel, steel}};
  setup.gravity = {0.0, 0.0, -9.81};
  setup.dt = 2.4e-5;
  return setup;
}

/// A pull of a twentieth of the elastic force.
void cohere(SpheresSetup& s) {
  s.law.cohesion = grain::CohesionLaw::area;
  s.law.kc = 0.05 * s.law.kn / (std::numbers::pi * 0.5);
}

void resistRolling(SpheresSetup& s) {
  s.law.rolling = grain::RollingLaw::spring;
  s.law.kr = s.law.kt;
  s.law.gr = s.law.gt;
  s.law.muR = 0.1;
}

using Task = EffectSet<SpheresSetup>;

const std::vector<Task> tasks = withCommonEffects<SpheresSetup, cohere, resistRolling>({
    {"everyday", [](SpheresSetup&) {}},
    {"no_normal_dashpot", [](SpheresSetup& s) { s.law.gn = 0.0; }},
    {"no_tangential_dashpot",
     [](SpheresSetup& s) { s.law.tangential = grain::TangentialLaw::spring; }},
    {"mirror", [](SpheresSetup& s) { s.law.conventions.springTurn = grain::SpringTurn::rescaled; }},
    {"everyone",
     [](SpheresSetup& s) {
       grain::SpaceWall& wall = s.walls.emplace_back();
       wall.planes.push_back({{0.0, 0.0, -1e3}, {0.0, 0.0, 1.0}});
       wall.motion = [](double) { return grain::SpaceWall::State{}; };
     }},
});

/// On one thread the processor's, which other programs do not disturb, else wall time [s].
double timeOn(int threads) {
  timespec now{};
  clock_gettime(threads == 1 ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Running on and on, rebuilds counted in, after the lattice has melted. Time is that of 200 steps.
void step(benchmark::State& state, SpheresSetup setup, const Task& task, int threads) {
  const std::size_t spheres = setup.position.size();
  setup.threads = threads;
  task.change(setup);
  grain::Spheres simulation(setup);
  simulation.advance(spheres > 100000 ? 2000 : spheres > 1000 ? 10000 : 40000);
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
  const auto add = [](const char* name, auto make, std::size_t spheres) {
    for (const Task& task : tasks)
      for (const int threads : {1, 2})
        benchmark::RegisterBenchmark(
            fmt::format("{}/{}/{}/{}", name, spheres, task.name, threads).c_str(),
            [=, &task](auto& state) { step(state, make(spheres), task, threads); })
            ->Iterations(spheres > 10000 ? 10 : 100)  // each trial would melt the lattice anew
            ->UseManualTime()
            ->Unit(benchmark::kMicrosecond);
  };
  const auto cellOf = [](const Cell& cell) {
    return [&cell](std::size_t spheres) { return shearCell(cell, spheres); };
  };
  for (const std::size_t spheres : {500, 3000, 20000, 100000, 1000000})
    add("dilute", cellOf(dilute), spheres);
  for (const std::size_t spheres : {560, 20000}) add("dense", cellOf(dense), spheres);
  for (const std::size_t spheres : {600, 20000}) add("bed", restingBed, spheres);
  add("silo", filledSilo, 1488);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
