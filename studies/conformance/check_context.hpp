#pragma once

#include <fmt/format.h>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "studies/conformance/conformance_scenes.hpp"
#include "studies/core/in_space.hpp"

/// Context of a check: the engine, its declaration, comparisons with tolerances, and the faults
/// found so far.
namespace crossgrain::conformance {

/// How far a value may be from the expected one: `absolute` or `relative` of the expected value,
/// whichever allows more. `why` is not optional.
struct Tolerance {
  double absolute;
  double relative;
  const char* why;
};

struct Comparison {
  std::string difference;  ///< empty: equal to within the tolerance
};

Comparison close(double actual, double expected, const Tolerance& allowed);
Comparison close(const Vec2& actual, const Vec2& expected, const Tolerance& allowed);

/// " -30 %", " -100 %": two figures, and none of them an exponent.
std::string percentOf(double change);

/// Whether two snapshots have the same bits.
Comparison sameBits(const Snapshot& a, const Snapshot& b);

struct DiskState {
  Vec2 position, velocity;  ///< [m, m/s]
  double spin;  ///< where a snapshot has none, the one that the scene started with [rad/s]
};

/// The spins of a snapshot; where it has none, those that the scene started with.
std::vector<double> spinsOf(const Scene& scene, const Snapshot& snapshot);
std::vector<DiskState> statesOf(const Scene& scene, const Snapshot& snapshot);

/// How far the farthest disk is from the origin [m].
double farthestPlace(const Scene& scene);

/// The largest difference between two lists of equal length.
double farthest(const std::vector<double>& one, const std::vector<double>& other);

/// A small disk of a scene [m, m/s, rad/s].
struct SmallDisk {
  Vec2 position, velocity = Vec2::Zero();
  double spin = 0.0;
};

/// A scene of these walls and small disks.
Scene sceneOf(const ContactLaw& law, std::vector<WallBody> bodies,
              const std::vector<SmallDisk>& disks, double steps = coarseSteps);

/// A body of one plane that moves, and one of one wall disk.
WallBody planeWall(const Vec2& point, const Vec2& normal, const Motion& motion,
                   const std::string& name = "plane");
WallBody postAt(const Vec2& centre, const Motion& motion = {}, const std::string& name = "post");

// Names of declared capabilities: each is examined by some check, or reported as not examined.

inline const std::string planes = "planes";
inline const std::string slantingPlanes = "slanting planes";
inline const std::string planesAlongThemselves = "planes that move along themselves";
inline const std::string checkpoints = "checkpoints";
inline const std::string slidingFlags = "sliding flags";
inline const std::string instantContacts = "instant contacts";
inline const std::string accumulatedContacts = "accumulated contacts";
inline const std::string energyLedger = "energy ledger";
inline const std::string tangentialRestitution = "tangential restitution";
inline const std::string severalSizes = "several sizes";
inline const std::string manyDisks = "many disks";
inline const std::string farPlaces = "places far from the origin";
inline const std::string lateTimes = "late times";
inline const std::string spheresInSpace = "spheres in space";
inline const std::string periodicDirections = "periodic directions";
inline const std::string cylinders = "cylinders";
inline const std::string settingDt = "setting dt, other than its default";
std::string planeMotion(Motion::Kind kind);  ///< "planes: rotating"
std::string wallMotion(Motion::Kind kind);   ///< "walls: rotating"
std::string precisionNamed(Precision precision);
std::string convexBodies(ShapeKind kind);  ///< "convex bodies: polygon"

/// All of it: effects, each value of each law option, planes and walls with each motion,
/// observables, precisions, a setting of the time step; and what every engine must have: several
/// sizes, many disks, places far off and late times. Everything that limits do not exclude is
/// declared.
std::vector<std::string> declaredBy(const Capabilities& can);

bool simulates(const Capabilities& can, Effect effect);

/// Names of all effects, as `[run] may_differ` has them.
std::vector<std::string> effectNames();

/// Single precision by default.
bool single(const Capabilities& can);

// Single precision rounds a place x to ε|x|, ε = 2⁻²³, in every step, and so by half of that at
// most; in double nothing of it is seen, and both are 0. A velocity is rounded to ε|v|, which is
// nothing against a tolerance of a thousandth in ten thousand steps. [m]

/// In n steps of free flight: each adds the same v dt, so that rounding adds the same, ½ ε|x| at
/// most, which grows linearly. It is a velocity that is off by ½ ε|x|/dt.
double roundedInFlight(const Capabilities& can, double place, double steps);
/// In n steps of a contact: v dt is another part of ε|x| in each, so that roundings are
/// independent, evenly distributed within ½ ε|x|, and walk: ε|x| √(n/12), here 3.5 times that.
/// By Σ f δx they change the energy that a contact gives back: of two bodies, relative speeds by
/// this over the largest overlap (f = m₁₂ ω² δ, its mean square half of the largest; δ_max = v/ω).
double roundedInContact(const Capabilities& can, double place, double steps);

/// The values that the engine declares of an option; of one that it does not list, the law's own.
std::vector<std::string> valuesOf(const Capabilities& can, const ContactLaw& law,
                                  const std::string& option);

/// The law with each option that the engine lacks set to one that it has.
ContactLaw followed(const Capabilities& can, ContactLaw law);

/// A cause stands where it leaves less than this part of what it is to explain, as a term of
/// lockstep's (studies/lockstep/rules.hpp), besides less than is allowed: of what is hardly beyond
/// a tolerance nearly any constant leaves less than that.
inline constexpr double explainedLeaves = 0.2;

/// Cause that explains the collisions of a disk with partners of one kind.
struct SubjectCause {
  std::string name;     ///< "µ"
  double change = 0.0;  ///< of a constant [-]
};

/// Whether the causes of all partners have the same name, and amounts that differ by at most a
/// fifth of the larger.
bool oneCause(const std::vector<SubjectCause>& causes);

/// Ends a check: the engine does not declare what it needs, or refuses the scene. No fault.
struct Skipped {
  std::string reason;
};

/// Ends a check after a fault that makes the rest of it meaningless.
struct GivenUp {};

/// Values as one text.
template <typename... Parts>
std::string text(const Parts&... parts) {
  std::ostringstream all;
  ((all << parts), ...);
  return all.str();
}

/// One check of one engine.
class CheckContext {
 public:
  /// @param start  starts another worker of any engine; everything given outlives the context
  using Start = std::function<std::unique_ptr<Engine>(const EngineEntry&)>;
  CheckContext(Engine& checked, const EngineEntry& ofEntry, const Start& starter)
      : engine(checked), entry(ofEntry), start(starter), can(checked.capabilities()) {}

  Engine& engine;
  const EngineEntry& entry;
  const Start& start;
  Capabilities can;
  Scene scene;                    ///< the one loaded last
  EffectiveParameters effective;  ///< as the engine runs it
  bool inSpace = false;           ///< scenes of the plane lie in one of space
  bool turned = false;            ///< so, and aslant: what is seen of them has been turned back

  std::vector<std::string> faults;             ///< in the order found; a loop may repeat one
  std::set<std::string> examined;              ///< capabilities in which a fault would be found
  std::map<std::string, std::string> refused;  ///< capabilities that could not be examined, and why
  std::optional<std::string> cause;            ///< of the faults; empty: none that was tried fits
  std::vector<SubjectCause> subjectCauses;     ///< of partners whose collisions are explained
  bool lawIsOff = false;  ///< the law without rolling resistance and cohesion was found wrong
  std::vector<std::string> notes;  ///< of a check without faults: what follows from conventions

  /// Single precision by default.
  bool single() const { return conformance::single(can); }
  /// The thesis' law with the engine's own conventions where it lacks the thesis' ones.
  ContactLaw law() const { return followed(can, fullLaw()); }
  /// Rigid disks have no duration of contact, and no oracle of the soft law applies to them.
  bool rigid() const { return law().normal == NormalLaw::rigid; }
  /// q of J = q m a²: ½, that of solid disks, in space ⅖, that of solid spheres, unless the engine
  /// lacks it and has others.
  double inertiaFactor() const;
  /// The scene with that moment of inertia where it has solid disks: what is loaded.
  Scene withItsInertia(Scene wanted) const;
  /// It is the in-house engine, with whatever conventions.
  bool inHouse() const;
  /// The loaded scene, as the in-house engine runs it at the same time step under that law.
  Scene mirrored(const ContactLaw& law) const;
  /// The scene without effects that the engine does not have, for checks that need something to
  /// happen, whatever it is.
  Scene simplified(const Scene& scene) const;
  /// Many contacts of all kinds that the engine has.
  Scene busy() const { return simplified(busyScene(law())); }
  ContactReport contactReport() const;
  /// By the engine's precision, absolute in units of `unit`; relative as well where that is 1.
  Tolerance byPrecision(double ifDouble, double ifFloat, const char* why, double unit = 1.0) const;

  /// Has the engine load a scene with these settings, the others as its file has them.
  /// @returns why it cannot
  [[nodiscard]] std::optional<std::string> refusal(const Scene& scene,
                                                   const Settings& settings = {});
  /// The same; a refusal is a skip. @throws Skipped
  void load(const Scene& scene, const Settings& settings = {});
  /// The same where it is `required`. @returns whether it is loaded  @throws Skipped
  bool loads(const Scene& scene, bool required);
  /// The same for scenes that limits can exclude (adapters/scene_limits.hpp): refusing a scene that
  /// no declared limit excludes is a fault. @throws Skipped, GivenUp
  void loadWithinLimits(const Scene& scene);
  Snapshot at(double t);                        ///< advances to t; a snapshot with contacts
  Snapshot run(const Scene& wanted, double t);  ///< loads it and goes there. @throws Skipped
  /// Snapshots after every step from 0 to t; the first is the start.
  /// @param enough  whether what has been seen will do: no step is taken then
  std::vector<Snapshot> watch(double t,
                              const std::function<bool(const std::vector<Snapshot>&)>& enough = {});

  [[noreturn]] void skip(std::string reason) const { throw Skipped{std::move(reason)}; }
  /// A skip unless the engine declares it. @throws Skipped
  void needs(const std::string& capability) const;
  void needsContacts() const;

  void fault(std::string what) { faults.push_back(std::move(what)); }
  /// A fault unless it holds. @param otherwise  the fault
  void expect(bool holds, const std::string& otherwise);
  void expect(const Comparison& comparison, const std::string& what);
  /// A fault unless `found` is as close to `wanted` as allowed; numbers or vectors.
  void near(const auto& found, const auto& wanted, const Tolerance& allowed,
            const std::string& what) {
    expect(close(found, wanted, allowed), what);
  }
  /// The same as expect, and the end of the check. @throws GivenUp
  void require(bool holds, const std::string& otherwise);
  void equal(const auto& found, const auto& wanted, const std::string& what) {
    expect(found == wanted, text(what, ": ", found, ", not ", wanted));
  }
  void requireEqual(const auto& found, const auto& wanted, const std::string& what) {
    require(found == wanted, text(what, ": ", found, ", not ", wanted));
  }
  void above(const auto& found, const auto& limit, const std::string& what) {
    expect(found > limit, text(what, ": ", found, ", not above ", limit));
  }
  void atLeast(const auto& found, const auto& limit, const std::string& what) {
    expect(found >= limit, text(what, ": ", found, ", below ", limit));
  }
  void below(const auto& found, const auto& limit, const std::string& what) {
    expect(found < limit, text(what, ": ", found, ", not below ", limit));
  }
  void atMost(const auto& found, const auto& limit, const std::string& what) {
    expect(found <= limit, text(what, ": ", found, ", above ", limit));
  }
  /// Velocity to that part of Encounter::speed, spin to that part of a small disk's that rolls at
  /// that speed.
  void sameMotion(const DiskState& found, const DiskState& wanted, const Tolerance& part,
                  const std::string& which);
  /// The same and the position, to that part of a small radius.
  void sameState(const DiskState& found, const DiskState& wanted, const Tolerance& part,
                 const std::string& which);

  void examine(const std::string& capability) { examined.insert(capability); }
  void couldNotExamine(const std::string& capability, const std::string& why) {
    refused.try_emplace(capability, why);
  }
  /// Records a cause of the faults found, with sign and size; the first counts.
  void suspect(std::string what) {
    if (!cause && !what.empty()) cause = std::move(what);
  }
  /// The same for a part of the law; records nothing while the law without it is wrong.
  void suspectPart(std::string what) {
    if (!lawIsOff) suspect(std::move(what));
  }
};

/// Has the engine load a scene of D dimensions, which may differ from what it has in conventions.
/// @returns the scene as it runs it  @throws Skipped
template <int D>
SceneOf<D> loaded(CheckContext& c, SceneOf<D> wanted) {
  if constexpr (D == 2) wanted = c.withItsInertia(std::move(wanted));
  try {
    const SceneOf<D> scene = adaptScene(c.can, wanted, {}).scene;
    c.effective = loadOn<D>(c.engine, scene, c.entry.settings);
    return scene;
  } catch (const UnsupportedScene& unsupported) {
    c.skip(unsupported.what());
  }
}

/// The second of each pair as a disk, or sphere, of a wall at rest.
template <int D>
SceneOf<D> withPosts(SceneOf<D> scene) {
  WallBodyOf<D>& posts = scene.bodies.emplace_back();
  posts.name = "posts";
  const DisksOf<D> all = scene.disks;
  scene.disks.forEachList([](auto& list) {
    for (std::size_t k = 1; k < list.size(); ++k) list.erase(list.begin() + static_cast<long>(k));
  });
  for (std::size_t k = 1; k < all.size(); k += 2) {
    posts.diskPosition.push_back(all.position[k]);
    posts.diskRadius.push_back(all.radius[k]);
  }
  return scene;
}

template <int D>
SnapshotOf<D> shown(CheckContext& c, double t) {
  c.engine.advance(t);
  return snapshotOf<D>(c.engine, c.contactReport());
}

/// A property that holds for any engine.
struct Check {
  std::string name;            ///< "HeadOnCollision"
  const char* what;            ///< the property
  void (*run)(CheckContext&);  ///< finds faults, or throws Skipped
  int dimension = 2;           ///< of its scenes
  bool basis = false;  ///< no law enters it: others see their scenes through what it examines
  /// How its plane lies in space for an engine that has no other: flat where spheres would leave
  /// it, as a pile does sideways, by what roundings put beside it.
  PlaneFrame frame = PlaneFrame::any;
  /// Engines of both dimensions are asked twice: also in a plane of space, as those of space alone.
  bool inSpaceToo = false;
  const char* about = "";  ///< its subject's name
  bool lies = false;       ///< it is the second time
};

/// The check, in a plane of space too.
inline Check inBoth(Check check) {
  check.inSpaceToo = true;
  return check;
}

/// Why an engine of space alone is not asked twice.
inline constexpr const char* sameOfSpheres = "the same is asked for of spheres";

using Checks = std::vector<Check>;
/// Subject of a list of checks, which pass or fail together.
struct Subject {
  const char* name;
  Checks checks;
};

Checks capabilityChecks();
Checks lifecycleChecks();
Checks freeMotionChecks();
Checks collisionChecks();
Checks lawChecks();
Checks conventionChecks();
Checks resistanceChecks();
Checks symmetryChecks();
Checks wallChecks();
Checks contactChecks();
Checks reachChecks();
Checks sceneChecks();
Checks springChecks();
Checks spaceChecks();
Checks cylinderChecks();
Checks convexChecks();
Checks refusalChecks();

}  // namespace crossgrain::conformance
