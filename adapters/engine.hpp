#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "adapters/effects.hpp"
#include "adapters/scene.hpp"
#include "adapters/scene_limits.hpp"
#include "adapters/snapshot.hpp"

namespace crossgrain {

enum class Support { optional, always, never };

/// A setting of one engine, under [engines.NAME] in a case file.
using SettingValue = std::variant<bool, double, std::string>;
using Settings = std::map<std::string, SettingValue>;

/// Meaning of a setting, for studies that vary it without knowing its name.
enum class SettingRole {
  none,
  iterations  ///< a number of passes or parts that its solver makes of a step: more take longer
};

struct SettingSpec {
  std::string name;
  SettingValue defaultValue;  ///< its alternative is the setting's type
  std::string unit;
  std::string doc;
  std::vector<std::string> choices = {};  ///< of a string setting; empty: any
  // Of a number.
  double least = 0.0, most = std::numeric_limits<double>::infinity();
  bool whole = false;
  SettingRole role = SettingRole::none;
};

/// Abilities of an engine, as it reports them.
struct Capabilities {
  std::string version;  ///< of the engine itself
  /// Dimensions of the scenes that it takes: 2, disks in a plane; 3, spheres in space, with
  /// loadInSpace() and snapshotInSpace().
  std::vector<int> dimensions = {2};
  bool periodic = false;  ///< that a scene's box may have periodic directions
  std::map<Effect, Support> effects;
  /// Law options by their case-file name ("tension", "dashpot", …) → values that the engine has.
  /// An option that is not listed does not matter to the engine's law.
  std::map<std::string, std::vector<std::string>> lawOptions;
  std::vector<Precision> precisions;  ///< that it can run in, its own choice first
  bool instantContacts = true;
  bool accumulatedContacts = false;
  bool warmHandover = false;
  bool checkpoints = false;
  bool slidingFlags = false;
  bool tangentialRestitution = true;  ///< of rigid contacts: an e_t0 other than 0
  bool energyLedger = false;          ///< that it can keep one
  std::vector<SettingSpec> settings;
  SceneLimits limits;
};

/// Difference between an engine and the scene.
struct Deviation {
  std::string name;  ///< a law option or effect as in `may_differ`, or free-standing ("rounding")
  double value = 0.0;
  std::string unit;
  std::string note;  ///< one sentence for the report
};

/// The constants of one kind of pair after the engine's own mixing rule.
struct PairCoefficients {
  std::string pair;  ///< e.g. "3.70 mm – 3.70 mm", "3.70 mm – wall"
  double kn = 0.0, gn = 0.0, kt = 0.0, gt = 0.0, mu = 0.0;
  double en = 0.0, et0 = 0.0;            ///< where the engine uses restitutions
  double kr = 0.0, gr = 0.0, muR = 0.0;  ///< where contacts resist rolling
  double kc = 0.0, w = 0.0;              ///< where they cohere
};

/// Parameters that an engine really uses after loading a scene.
struct EffectiveParameters {
  std::string engine;
  std::string version;
  double dt = 0.0;         ///< [s]
  std::string precision;   ///< "double" | "float"
  std::string integrator;  ///< its name, to be shown
  /// How long before velocityTime the motion had the velocity that a snapshot of a time > 0 shows
  /// there [s]: dt/2 of semi-implicit Euler, whose velocity of a step is the one that leads to its
  /// position; 0 where velocityTime says it all.
  double velocityLag = 0.0;
  Effects effects;
  std::vector<PairCoefficients> pairs;
  std::vector<Deviation> deviations;
};

/// Cost so far, of advance() alone.
struct Stats {
  std::uint64_t steps = 0;
  std::uint64_t contactEvaluations = 0;
  double wallSeconds = 0.0;
  double cpuSeconds = 0.0;
  std::map<std::string, double> counters;  ///< engine's own, e.g. "impacts", "rebuilds"

  /// As results have them (support/json_fields.hpp).
  void fields(auto& io) {
    io("steps", steps);
    io("contact_evaluations", contactEvaluations);
    io("wall_s", wallSeconds);
    io("cpu_s", cpuSeconds);
    io("counters", counters);
  }
};

/// The engine cannot do what the scene calls for; what() names the first such thing.
struct UnsupportedScene : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The engine itself failed: died, hung, returned a short file or a NaN.
struct EngineFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One engine run.
///
///   load(scene) ── advance(t) ── snapshot() ── advance(t') ── … ── load(another) starts afresh
///
/// Every call but capabilities() needs a load() before it.
class Engine {
 public:
  virtual ~Engine() = default;

  virtual Capabilities capabilities() const = 0;

  /// @pre scene is valid (Scene's own rules) and its effects are within capabilities() but for
  ///      what the caller knows to differ
  /// @post the run is at t = 0, stats() begin at 0
  /// @throws UnsupportedScene naming the first thing the engine cannot do; EngineFailure
  virtual EffectiveParameters load(const Scene& scene, const Settings& settings) = 0;

  /// Does llround(t/dt) − (steps done) steps. @returns the time reached [s]
  /// @pre t is finite and not before the time reached  @post |t − what it returns| ≤ dt/2
  /// @throws EngineFailure
  virtual double advance(double t) = 0;

  /// @name The same of a scene in space, where Capabilities::dimensions has 3
  /// @{
  virtual EffectiveParameters loadInSpace(const SpaceScene&, const Settings&) {
    throw UnsupportedScene(planeOnly);
  }
  virtual SpaceSnapshot snapshotInSpace(ContactReport) { throw UnsupportedScene(planeOnly); }
  /// @}

  /// State of the run. @post the run goes on to the same bits as without this call
  /// @throws EngineFailure
  virtual Snapshot snapshot(ContactReport contacts) = 0;

  /// @post counts never fall between two load()
  virtual Stats stats() const = 0;

  /// Writes the state that the rest of the run depends on; and restores it in an engine that has
  /// loaded the same scene with the same settings, which then goes on to the same bits.
  /// Capabilities::checkpoints says which engines can.
  /// @post of restore(): advance() and snapshot() are what they would have been to the bit
  /// @throws EngineFailure if the file cannot be written, or is none of this engine and scene
  virtual void checkpoint(const std::filesystem::path&) { throw EngineFailure(noCheckpoints); }
  virtual void restore(const std::filesystem::path&) { throw EngineFailure(noCheckpoints); }

 private:
  static constexpr const char* planeOnly = "has dimension = 2, not 3";
  static constexpr const char* noCheckpoints = "this engine has no checkpoints";
};

/// load() or loadInSpace(), and snapshot() or snapshotInSpace(), for templates over the dimension.
template <int D>
EffectiveParameters loadOn(Engine& engine, const SceneOf<D>& scene, const Settings& settings) {
  if constexpr (D == 2)
    return engine.load(scene, settings);
  else
    return engine.loadInSpace(scene, settings);
}
template <int D>
SnapshotOf<D> snapshotOf(Engine& engine, ContactReport contacts) {
  if constexpr (D == 2)
    return engine.snapshot(contacts);
  else
    return engine.snapshotInSpace(contacts);
}

}  // namespace crossgrain
