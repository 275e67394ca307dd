// Time per step of the in-house engine: sizes × effects × precision × threads. README.md says what
// the figures mean.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <barrier>
#include <chrono>
#include <ctime>
#include <map>
#include <numbers>
#include <thread>
#include <vector>

#include "adapters/grain.hpp"
#include "cases/couette.hpp"
#include "cases/time_step.hpp"
#include "engines/grain/simulation.hpp"
#include "tests/bench/effect_sets.hpp"
#include "tests/bench/packings_option.hpp"

namespace crossgrain::bench {
namespace {

using Clock = std::chrono::steady_clock;
using grain::Setup;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The stream test.

constexpr std::size_t streamLength = std::size_t{1} << 24;
constexpr int streamPasses = 30;

double measureStream(int threads) {
  std::vector<double> a(streamLength), b(streamLength, 1.0), c(streamLength, 2.0);
  std::vector<Clock::time_point> time;
  std::barrier pass(threads, [&time]() noexcept { time.push_back(Clock::now()); });
  time.reserve(streamPasses + 1);
  const auto work = [&](int thread) {
    const std::size_t begin = streamLength * static_cast<std::size_t>(thread) / threads;
    const std::size_t end = streamLength * static_cast<std::size_t>(thread + 1) / threads;
    pass.arrive_and_wait();
    for (int k = 0; k < streamPasses; ++k) {
      const double factor = 3.0 + k;  // so that no pass is the one before
      for (std::size_t i = begin; i < end; ++i) a[i] = b[i] + factor * c[i];
      pass.arrive_and_wait();
    }
  };
  {
    std::vector<std::jthread> others;
    for (int thread = 1; thread < threads; ++thread) others.emplace_back(work, thread);
    work(0);
  }
  double best = 1e9;
  for (std::size_t k = 1; k < time.size(); ++k)
    best = std::min(best, std::chrono::duration<double>(time[k] - time[k - 1]).count());
  return 3.0 * sizeof(double) * streamLength / best;
}

/// Memory bandwidth of the loop a[i] = b[i] + s c[i] (triad; McCalpin 1995) on arrays of 128 MiB,
/// far beyond the caches, counted as there: 24 bytes an element, without the read that a write
/// causes. The best of some passes [byte/s]. Measured once per number of threads.
double streamBandwidth(int threads) {
  static std::map<int, double> known;
  if (!known.contains(threads)) known[threads] = measureStream(threads);
  return known[threads];
}

/// Bytes that one step without new lists moves between core and memory when nothing of it fits a
/// cache: every array once per pass over it, read and write counted apart, the read that a write
/// causes not counted, as in the stream test. Partners of a disk are taken to be in cache:
/// disks are near each other in memory if they are in space.
struct Traffic {
  double perDisk = 0.0, perPair = 0.0;  ///< [byte]; pairs are the near ones

  double perStep(double disks, double pairs) const { return perDisk * disks + perPair * pairs; }
};

/// The model for the step of engines/grain, pass by pass: `setup` says which arrays there are.
Traffic stepTraffic(const Setup& setup) {
  const bool single = setup.precision == grain::Precision::float32;
  const double real = single ? 4.0 : 8.0;
  const bool spins = setup.law.friction() && setup.rotation;
  const bool velocities = setup.law.friction() || setup.law.gn > 0.0;
  const bool predict = grain::dampingVelocity(setup.law) == grain::DampingVelocity::predicted;
  Traffic traffic;
  const auto disk = [&](int reads, int writes) { traffic.perDisk += real * (reads + writes); };

  disk(10, 6);                          // motion: x, v, f, 1/m, x chosen, allowance → x, v, f
  if (predict) disk(0, 2);              //         → u
  if (spins) disk(3, predict ? 3 : 2);  //         ω, M, 1/J → ω, M, u_ω
  if (setup.bottom) disk(4, 2);         //         plate: m, a, ξ_b → ξ_b
  disk(4, 2);                           // pairs: x, f → f
  if (velocities) disk(2, 0);           //        u
  if (spins) disk(2, 1);                //        u_ω, M → M
  traffic.perPair += 8 + 2 * real;      //        i, j, a of both
  if (setup.law.springs()) traffic.perPair += 2 * real;  // ξ → ξ
  if (single) traffic.perPair += 8;                      //        origin of i − origin of j
  return traffic;
}

/// Springs against rolling, k_r = k_t (Iwashita and Oda 1998).
void resistRolling(Setup& s) {
  s.law.rolling = grain::RollingLaw::spring;
  s.law.kr = s.law.kt;
  s.law.muR = 0.3;
}

/// A pull of a tenth of the elastic force, 2π k_c R₁₂ = k_n/10 of two small disks.
void cohere(Setup& s) {
  s.law.cohesion = grain::CohesionLaw::area;
  s.law.kc = 0.1 * s.law.kn / (std::numbers::pi * s.disks.radius.front());
}

/// Disks of two materials in turn, walls of a third, and all pairs with the same law: the contacts
/// are those of the law without materials.
void mix(Setup& s) {
  grain::Materials& materials = s.materials.emplace();
  materials.count = 3;
  for (std::size_t i = 0; i < s.disks.size(); ++i)
    materials.ofDisk.push_back(static_cast<std::int32_t>(i % 2));
  materials.ofWall.assign(s.walls.size(), 2);
  materials.laws.assign(9, s.law);
}

using Effects = EffectSet<Setup>;

constexpr Effects thesis{"thesis", [](Setup&) {}};  ///< the thesis' law, which the others change

const std::vector<Effects> effectSets = withCommonEffects<Setup, cohere, resistRolling>({
    thesis,
    {"defaults_no_friction",
     [](Setup& s) {
       useDefaults(s);
       s.law.tangential = grain::TangentialLaw::none;
     }},
    {"no_bottom", [](Setup& s) { s.bottom.reset(); }},
    {"no_friction_no_bottom",
     [](Setup& s) {
       s.law.tangential = grain::TangentialLaw::none;
       s.bottom.reset();
     }},
    {"coulomb", [](Setup& s) { s.law.tangential = grain::TangentialLaw::coulomb; }},
    {"ledger", [](Setup& s) { s.ledger = true; }},
    {"cohesion_twice",
     [](Setup& s) {
       cohere(s);
       s.law.conventions.cohesionArea = grain::CohesionArea::twiceBetweenDisks;
     }},
    {"rolling_cohesion",
     [](Setup& s) {
       resistRolling(s);
       cohere(s);
     }},
    {"materials", mix},
    {"rolling_cohesion_materials",
     [](Setup& s) {
       resistRolling(s);
       cohere(s);
       mix(s);
     }},
});

std::filesystem::path packingFolder;

/// Packings are shared by all benchmarks of one size.
const Setup& packed(std::size_t disks) {
  static std::map<std::size_t, Setup> kept;
  if (const auto found = kept.find(disks); found != kept.end()) return found->second;
  const Case scaled = scaledCase(thesisCell(), disks);
  const Scene scene = couetteScene(scaled, packedInto(scaled, packingFolder), timeStep(scaled));
  return kept.emplace(disks, setupOf(scene)).first->second;
}

struct Variant {
  std::size_t disks;
  const Effects* effects;
  grain::Precision precision;
  int threads;

  Setup setup() const {
    Setup setup = packed(disks);
    effects->change(setup);
    setup.precision = precision;
    setup.threads = threads;
    return setup;
  }
  std::string name(const char* what) const {
    return fmt::format("{}/{}/{}/{}/{}", what, disks, effects->name,
                       precision == grain::Precision::float64 ? "double" : "float", threads);
  }
};

/// Of this process, all its threads [s].
double processorTime() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Sums up time and contacts over steps: of one thread its processor time, to which other
/// programs on the machine add little.
struct Meter {
  bool oneThread;
  double seconds = 0.0;
  std::uint64_t steps = 0, contacts = 0;

  /// Advances and times; absent contacts are none. @returns the time taken [s]
  double advance(grain::Simulation& simulation, std::uint64_t count) {
    const std::uint64_t before = simulation.contactEvaluations();
    const auto start = Clock::now();
    const double processor = processorTime();
    simulation.advance(count);
    const double taken = oneThread ? processorTime() - processor : secondsSince(start);
    seconds += taken;
    steps += count;
    contacts += simulation.contactEvaluations() - before;
    return taken;
  }
};

double nearPairs(const grain::Simulation& simulation) {
  return static_cast<double>(simulation.neighbours().nearPairs);
}

void report(benchmark::State& state, const Meter& quiet, const Setup& setup, double pairs) {
  if (quiet.steps == 0) return;
  const auto disks = static_cast<double>(setup.disks.size());
  const double step = quiet.seconds / static_cast<double>(quiet.steps);
  const double contacts = static_cast<double>(quiet.contacts) / static_cast<double>(quiet.steps);
  const double bytes = stepTraffic(setup).perStep(disks, pairs);
  state.counters["us_step"] = 1e6 * step;
  state.counters["ns_disk"] = 1e9 * step / disks;
  state.counters["ns_contact"] = 1e9 * step / contacts;
  state.counters["contacts"] = contacts;
  state.counters["pairs"] = pairs;
  state.counters["model_bytes"] = bytes;
  state.counters["of_stream"] = bytes / step / streamBandwidth(setup.threads);
}

/// Running on and on. Time counts every step, `us_step` and what follows from it only those of
/// stretches without a rebuild.
void step(benchmark::State& state, const Variant& variant) {
  const Setup setup = variant.setup();
  grain::Simulation simulation(setup);
  const std::uint64_t stretch = variant.disks >= 100000 ? 2 : 10;
  simulation.advance(20);
  const bool oneThread = variant.threads == 1;
  Meter all{oneThread}, quiet{oneThread};
  const std::size_t rebuildsBefore = simulation.neighbours().rebuilds;
  for (auto _ : state) {
    const std::size_t rebuilds = simulation.neighbours().rebuilds;
    Meter meter{oneThread};
    state.SetIterationTime(meter.advance(simulation, stretch) / static_cast<double>(stretch));
    all.steps += meter.steps;
    if (simulation.neighbours().rebuilds != rebuilds) continue;
    quiet.seconds += meter.seconds;
    quiet.steps += meter.steps;
    quiet.contacts += meter.contacts;
  }
  report(state, quiet, setup, nearPairs(simulation));
  state.counters["steps_run"] = static_cast<double>(simulation.steps());  // for count.py
  state.counters["rebuilds_per_1000"] =
      1e3 * static_cast<double>(simulation.neighbours().rebuilds - rebuildsBefore) /
      static_cast<double>(all.steps);
}

/// The first steps from the packing, again and again, so that sets of effects are compared on the
/// same list of contacts.
void sameContacts(benchmark::State& state, const Variant& variant) {
  const Setup setup = variant.setup();
  constexpr std::uint64_t stretch = 10;
  Meter meter{variant.threads == 1};
  double pairs = 0.0;
  for (auto _ : state) {
    grain::Simulation simulation(setup);
    simulation.advance(2);
    state.SetIterationTime(meter.advance(simulation, stretch) / stretch);
    pairs = nearPairs(simulation);
  }
  report(state, meter, setup, pairs);
}

void rebuild(benchmark::State& state, const Variant& variant) {
  const Setup setup = variant.setup();
  grain::Simulation simulation(setup);
  simulation.advance(20);
  double seconds = 0.0;
  for (auto _ : state) {
    const auto start = Clock::now();
    simulation.findNeighbours();
    const double taken = secondsSince(start);
    state.SetIterationTime(taken);
    seconds += taken;
  }
  state.counters["pairs"] = static_cast<double>(simulation.neighbours().farPairs);
  state.counters["ns_disk"] = 1e9 * seconds / static_cast<double>(state.iterations()) /
                              static_cast<double>(setup.disks.size());
}

void stream(benchmark::State& state, int threads) {
  for (auto _ : state) state.SetIterationTime(24.0 * (1 << 24) / streamBandwidth(threads));
  state.counters["GB_s"] = 1e-9 * streamBandwidth(threads);
}

void add(const std::string& name, auto&& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->UseManualTime()->Unit(benchmark::kMicrosecond);
}

void registerAll() {
  for (const int threads : {1, 2})
    add(fmt::format("stream/{}", threads), [threads](auto& state) { stream(state, threads); });
  using enum grain::Precision;
  for (const std::size_t disks : {1000, 10000, 100000, 1000000}) {
    for (const auto precision : {float64, float32})
      for (const int threads : {1, 2}) {
        for (const Effects& effects : effectSets) {
          const Variant variant{disks, &effects, precision, threads};
          add(variant.name("step"), [=](auto& state) { step(state, variant); });
          add(variant.name("same_contacts"), [=](auto& state) { sameContacts(state, variant); });
        }
        const Variant plain{disks, &thesis, precision, threads};
        add(plain.name("rebuild"), [=](auto& state) { rebuild(state, plain); });
      }
  }
}

}  // namespace
}  // namespace crossgrain::bench

int main(int argc, char** argv) {
  using namespace crossgrain::bench;
  return runBenchmarks(argc, argv, packingFolder, registerAll);
}
