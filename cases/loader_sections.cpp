#include "cases/loader_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "adapters/effects.hpp"
#include "adapters/law_options.hpp"
#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "averaging/weights.hpp"
#include "support/nearest.hpp"

namespace crossgrain::inline cases {
namespace {

constexpr int mostSnapshots = 10'000'000;  // averaged in one run
constexpr int mostCollisions = 100'000;    // two disks each, all in one scene

/// Everything an engine may do otherwise than the scene says.
std::vector<std::string> deviationNames() {
  std::vector<std::string> names;
  for (const Effect effect : allEffects) names.push_back(toString(effect));
  for (const LawOption& option : lawOptions()) names.emplace_back(option.name);
  names.emplace_back("rounding");
  names.emplace_back(tangentialRestitutionName);
  return names;
}

/// A number, a list, or { from, to, count } for equal steps.
void requireSweep(Reader& in, std::string_view key, std::vector<double>& values,
                  const Range& allowed) {
  if (!in.isTable(key)) return in.require(key, values, allowed);
  double from = 0.0, to = 0.0;
  int count = 0;
  Reader range = in.section(key);
  range.require("from", from, allowed);
  range.require("to", to, allowed);
  range.require("count", count, between(2, 10'000));
  range.finish();
  if (!(to > from)) range.fail("to", fmt::format("must be > {} (from)", from));
  for (int k = 0; k < count; ++k) values.push_back(from + (to - from) * k / (count - 1));
}

/// Ψ_i, or the angle between velocity and normal whose tangent it is.
void requirePsi(Reader& in, std::vector<double>& psi) {
  if (!in.has("angle")) return requireSweep(in, "psi", psi, Range{});
  if (in.has("psi")) in.fail("angle", "and psi, its tangent: give one of them");
  requireSweep(in, "angle", psi, inside(-90.0, 90.0, "degrees"));
  for (double& value : psi) value = std::tan(value * std::numbers::pi / 180.0);
}

/// v_n, or the whole speed that Ψ_i divides.
void requireSpeeds(Reader& in, Collision& collision) {
  if (!in.has("speed"))
    return in.require("vn", collision.vn, positive("m/s, else the disks never meet"));
  if (in.has("vn")) in.fail("speed", "and vn, its part along the normal: give one of them");
  in.read("speed", collision.speed, positive("m/s, else the disks never meet"));
}

/// What the first disk meets: a second one, or a wall.
void readWall(Reader& in, Collision& collision) {
  static const std::vector<std::string> bodies = {"disk", "wall"};
  std::string second = bodies.front();
  in.read("second", second, bodies);
  collision.wall = second == "wall";
  std::vector<double> velocity;
  in.read("wall_velocity", velocity, Range{});
  if (in.has("wall_velocity")) {
    if (!collision.wall) in.fail("wall_velocity", "only a wall has one (second = \"wall\")");
    if (velocity.size() != 2)
      in.fail("wall_velocity", "must be [along its normal, along it] in m/s");
    collision.wallVelocity = {velocity[0], velocity[1]};
  }
  if (!collision.wall) return;
  for (const char* const key : {"radius", "mass"})
    if (const toml::node* node = in.take(key); node && node->is_array())
      in.fail(key, "a wall has none: give the disk's alone");
  if (collision.counterSpin != std::vector<double>{0.0})
    in.fail("counter_spin", "a wall does not turn");
}

}  // namespace

void requirePair(Reader& in, std::string_view key, double (&pair)[2], const Range& range) {
  std::vector<double> values;
  in.require(key, values, range);
  if (values.empty()) return;
  if (values.size() > 2) in.fail(key, "must be one number or two");
  pair[0] = values.front();
  pair[1] = values.back();
}

void readBottom(Reader& in, BottomPlate& bottom) {
  in.require("mu", bottom.mu, atLeast(0.0));
  in.require("kb", bottom.kb, atLeast(0.0, "N/m"));
  in.require("gb", bottom.gb, atLeast(0.0, "kg/s"));
  in.require("tau_m", bottom.tauM, atLeast(0.0));
  in.read("gravity", bottom.gravity, positive("m/s^2"));
  in.read("spin", bottom.spin);
  in.finish();
}

void readCell(Reader& in, Cell& cell) {
  in.require("inner_radius", cell.innerRadius, positive("m"));
  in.require("outer_radius", cell.outerRadius, positive("m"));
  in.require("wall_radius", cell.wallRadius, positive("m"));
  in.require("wall_spacing", cell.wallSpacing, positive("m"));
  in.require("height", cell.height, positive("m"));
  in.require("omega", cell.omega,
             eitherSign("rad/s: all is timed in rotations of the wheel; < 0 is clockwise"));
  in.finish();
  if (!(cell.outerRadius > cell.innerRadius))
    in.fail("outer_radius", fmt::format("must be > inner_radius = {} m", cell.innerRadius));
  if (cell.wallSpacing > cell.innerRadius)
    in.fail("wall_spacing", fmt::format("must be <= inner_radius = {} m", cell.innerRadius));
}

void readPreparation(Reader& in, Preparation& preparation) {
  in.read("engine", preparation.engine);
  if (in.has("engine") && !findEngine(preparation.engine)) {
    std::vector<std::string> known;
    for (const EngineEntry& entry : engineRegistry()) known.push_back(entry.name);
    in.fail("engine", "there is no such engine" + suggestion(preparation.engine, known));
  }
  in.read("packings", preparation.packings, between(1, 10'000));
  in.read("seed", preparation.seed, between(0, mostSeed));
  in.read("dilation", preparation.dilation, above(1.0));
  in.read("velocity", preparation.velocity, atLeast(0.0, "m/s"));
  in.read("shrink_time", preparation.shrinkTime, positive("s"));
  in.read("rotations", preparation.rotations, atLeast(0.0));
  if (in.has("dt")) in.read("dt", preparation.dt.emplace(), positive("s"));
  in.take("dt");
  in.finish();
}

void readAveraging(Reader& in, const Case& setup, Averaging& averaging) {
  static const std::vector<std::string> methods(weightNames.begin(), weightNames.end());
  in.read("rings", averaging.rings, between(1, 10'000));
  in.read("method", averaging.methods, methods);
  in.read("line_width", averaging.lineWidth, positive());
  in.read("settle_rotations", averaging.settleRotations, atLeast(0.0));
  in.read("rotations", averaging.rotations, positive());
  in.read("snapshots_per_rotation", averaging.snapshotsPerRotation, between(1, 1'000'000));
  in.read("confidence", averaging.confidence, inside(0.0, 1.0));
  averaging.margins = readFieldMargins(in.section("margins"), setup);
  averaging.endpoints = readEndpointMargins(in.section("endpoints"), setup);
  in.finish();
  if (averaging.methods.empty()) in.fail("method", "must not be empty");
  if (averaging.snapshotsPerRotation * averaging.rotations > mostSnapshots)
    in.fail("rotations", fmt::format("with {} snapshots_per_rotation: more than {} snapshots",
                                     averaging.snapshotsPerRotation, mostSnapshots));
}

void readLooks(Reader& in, Looks& looks) {
  in.read("count", looks.count, between(1, 100));
  in.read("budget", looks.budget, positive("s"));
  in.finish();
}

/// Answers are waited for in whole milliseconds, and no clock holds what is longer than some years
/// [s].
constexpr double shortestTimeout = 1e-3, longestTimeout = 1e9;

void readRun(Reader& in, RunOptions& run) {
  static const std::vector<std::string> handovers = {"cold", "warm"};
  if (in.has("dt")) in.read("dt", run.dt.emplace(), positive("s"));
  in.take("dt");
  in.read("steps_per_contact", run.stepsPerContact, atLeast(2.0));
  in.read("handover", run.handover, handovers);
  if (run.handover == "warm") in.fail("handover", "not yet supported; \"cold\" is");
  in.read("may_differ", run.mayDiffer, deviationNames());
  in.read("timeout", run.timeout, between(shortestTimeout, longestTimeout, "s"));
  static const std::vector<std::string> precisions(precisionNames.begin(), precisionNames.end());
  std::string precision = toString(run.precision);
  in.read("precision", precision, precisions);
  run.precision = precision == precisions.front() ? Precision::float64 : Precision::float32;
  in.read("mirrors", run.mirrors);
  in.read("energy_ledger", run.energyLedger);
  in.read("keep_snapshots", run.keepSnapshots, between(0, 1'000'000));
  in.finish();
  if (run.dt && in.has("steps_per_contact"))
    in.fail("steps_per_contact", "the step is given by run.dt, leave out one of them");
}

void readCollision(Reader& in, Collision& collision) {
  requirePsi(in, collision.psi);
  requireSpeeds(in, collision);
  static const std::vector<std::string> approaches = {"spin", "first_spin", "oblique"};
  std::string approach = approaches.front();
  in.read("approach", approach, approaches);
  collision.approach =
      static_cast<Approach>(std::ranges::find(approaches, approach) - approaches.begin());
  in.read("counter_spin", collision.counterSpin, Range{});
  requirePair(in, "radius", collision.radius, positive("m"));
  requirePair(in, "mass", collision.mass, positive("kg"));
  readWall(in, collision);
  in.read("inertia_factor", collision.inertiaFactor, aboveZeroTo(1.0));
  in.read("steps_per_contact", collision.stepsPerContact, atLeast(2.0));
  in.read("start_phase", collision.startPhase, Range{});
  if (collision.startPhase < 0.0)
    in.fail("start_phase", "must be >= 0, else the disks overlap at the start");
  if (!(collision.startPhase < 1.0)) in.fail("start_phase", "must be < 1");
  const auto starts = static_cast<double>(collision.psi.size()) *
                      static_cast<double>(std::max<std::size_t>(1, collision.vn.size())) *
                      static_cast<double>(collision.counterSpin.size());
  if (starts > mostCollisions)
    in.fail(in.has("psi") ? "psi" : "angle",
            fmt::format("with all vn and counter_spin {:.0f} collisions: at most {}", starts,
                        mostCollisions));
  collision.margins = readCollisionMargins(in.section("margins"));
  in.finish();
}

Settings readSettings(Reader engine) {
  Settings settings;
  for (const std::string& key : engine.keys()) {
    const toml::node& node = *engine.take(key);
    if (const auto flag = node.value_exact<bool>())
      settings[key] = *flag;
    else if (const auto text = node.value_exact<std::string>())
      settings[key] = *text;
    else
      engine.read(key, std::get<double>(settings[key] = 0.0), Range{});
  }
  return settings;
}

void readEngines(Reader& in, std::map<std::string, Settings>& engines) {
  for (const std::string& name : in.keys()) engines[name] = readSettings(in.section(name));
}

}  // namespace crossgrain::inline cases
