#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "adapters/engine.hpp"
#include "adapters/motion.hpp"
#include "adapters/scene.hpp"
#include "adapters/vec2.hpp"
#include "cases/cost.hpp"
#include "law/contact_law.hpp"
#include "oracle/collision_end.hpp"
#include "stability/limits.hpp"
#include "stability/placement.hpp"

namespace crossgrain::inline cases {

/// The most disks that a case may have, wall disks too: checked before room for them is taken.
inline constexpr int mostDisks = 1'000'000;

/// Material of a body, as the case file says.
struct MaterialName {
  std::string name;   ///< empty: it does not say
  std::string where;  ///< "file:3:1: assembly.disks[0].material"
};

/// The Couette shear cell (Lätzel 2003, chapter 3). All wall disks' centres lie on R_i and R_o.
struct Cell {
  double innerRadius = 0.0;  ///< R_i, the wheel, centre at the origin [m]
  double outerRadius = 0.0;  ///< R_o, the fixed ring [m]
  double wallRadius = 0.0;   ///< of a wall disk [m]
  double wallSpacing = 0.0;  ///< between wall disks along each wall [m]
  double height = 0.0;       ///< h of the disks, normal to the plane [m]
  double omega = 0.0;        ///< Ω of the wheel, counter-clockwise positive [rad/s]
  MaterialName wheelMaterial = {}, ringMaterial = {};

  double rimSpeed() const { return std::abs(omega) * innerRadius; }  ///< [m/s]
};

struct Particles {
  int small = 0, large = 0;                     ///< numbers
  double smallRadius = 0.0, largeRadius = 0.0;  ///< [m]
  double smallMass = 0.0, largeMass = 0.0;      ///< [kg]
  double inertiaFactor = 0.5;                   ///< q in J = q m a²: 1/2 disk, 2/5 sphere
  bool rotation = true;     ///< false: friction acts, but no disk has a spin or gets one
  double maxOverlap = 0.2;  ///< largest overlap allowed at a start, in units of the small radius
  std::string maxOverlapKey = "particles.max_overlap";  ///< where the user says it
  std::optional<std::filesystem::path> file;  ///< a packing of the user's own (docs/cases.md)
  MaterialName smallMaterial = {}, largeMaterial = {};
};

/// How a cell is filled: dilute lattice, random velocities, turning wheel, shrinking ring, then
/// rotations (thesis §3.3).
struct Filling {
  std::string engine;        ///< that does it; empty: the in-house one
  double dilation = 1.25;    ///< R_prepare / R_o
  double velocity = 0.05;    ///< rms of each component of the initial velocities [m/s]
  double shrinkTime = 1.0;   ///< in which the ring goes from R_prepare to R_o [s]
  double rotations = 2.0;    ///< of the wheel, after the ring has reached R_o
  std::optional<double> dt;  ///< time step of all that [s]; absent: that of the runs
};

/// How long a cell is sheared, in rotations of its wheel, and over how many rings it is averaged.
struct CellTimes {
  int rings = 20;
  double settleRotations = 0.25;  ///< after hand-over, not averaged
  double rotations = 1.0;         ///< averaged
  int snapshotsPerRotation = 400;
};

/// A scene source: the cell, and what it is filled with.
struct Couette {
  Cell cell;
  Particles particles;
  Filling filling;
  CellTimes times;
};

/// The starts of a flow.
struct Preparation {
  int packings = 4;
  std::uint64_t seed = 1;
};

/// How far apart two engines may be in one field and still agree.
struct Margin {
  double value = 0.0;  ///< in the field's unit, or a fraction of the reference's mean
  bool relative = false;
  std::string why;    ///< not optional in a case file
  std::string scale;  ///< of which the case file says a share (couette.hpp); empty: `value` is said
};

/// How a flow is averaged, and how far apart two engines may be.
struct Averaging {
  std::vector<std::string> methods = {"slicing"};  ///< as in weightNames
  double lineWidth = 0.5;  ///< kernel width of line methods, in units of d [-]
  double confidence = 0.95;
  std::map<std::string, Margin> margins;    ///< by field name as in profiles.csv
  std::map<std::string, Margin> endpoints;  ///< by name (endpoints.hpp)
};

/// How `compare` adds packings (averaging/interim_analyses.hpp).
struct InterimSettings {
  int count = 1;          ///< the most, each after as many packings more as a campaign begins with
  double budget = 120.0;  ///< no further look begins that would end later [s]
};

struct RunOptions {
  std::optional<double> dt;            ///< [s]; else from stepsPerContact
  double stepsPerContact = 50.0;       ///< t_c of the stiffest, lightest pair divided by dt
  std::string handover = "cold";       ///< "cold" | "warm"
  std::vector<std::string> mayDiffer;  ///< law options and effects in which engines may deviate
  double timeout = 120.0;              ///< longest wait for one answer of a worker [s]
  Precision precision = Precision::float64;  ///< of engines that can choose
  bool mirrors = true;                       ///< also run the in-house mirrors of the engines named
  bool energyLedger = false;  ///< engines that can account for their energy, term by term
  int keepSnapshots = 20;     ///< snapshots kept of a run in HDF5
  int keepSnapshotsOf = 1;    ///< packings, from the first, whose runs keep theirs
};

/// Disks, or spheres in space, or convex bodies, of one kind, each at `position` plus one of
/// `places`.
template <int D>
struct DiskGroupOf {
  VecOf<D> position = VecOf<D>::Zero();               ///< [m]
  std::vector<VecOf<D>> places = {VecOf<D>::Zero()};  ///< in multiples of pitch()
  VecOf<D> velocity = VecOf<D>::Zero();               ///< [m/s]
  SpinOf<D> spin = noSpin<D>();                       ///< [rad/s]
  double radius = 0.0;                                ///< [m]
  double mass = 0.0;          ///< of a disk of `radius`; others as a², spheres as a³ [kg]
  double jitter = 0.0;        ///< each coordinate is off by up to this, uniformly [diameters]
  double radiusSpread = 0.0;  ///< radii are off by up to this share, uniformly [-]
  double velocityRms = 0.0;   ///< of each component, normally distributed about `velocity` [m/s]
  MaterialName material = {};
  int choose = 0;  ///< so many of the places, others in each packing; 0: all of them

  std::optional<ShapeOf<D>> shape = {};  ///< of convex bodies, which `radius` reaches around
  TurnOf<D> turn = noTurn<D>();          ///< of each, or
  bool randomTurn = false;               ///< any, each as likely
  Vec3 moments = Vec3::Zero();           ///< of inertia of one; in the plane that about z [kg m²]
  VecOf<D> extents = VecOf<D>::Zero();   ///< of the shape [m]

  std::size_t count() const {
    return choose > 0 ? static_cast<std::size_t>(choose) : places.size();
  }
  /// A diameter, or the extents of the shape [m].
  VecOf<D> pitch() const { return shape ? extents : VecOf<D>::Constant(2.0 * radius); }
};
using DiskGroup = DiskGroupOf<2>;

/// Convex bodies that meet once, in the frame n, s (, b) of the touch, which is at x = 0.
template <int D>
struct ConvexPairOf {
  /// The second without a shape is a disk, or sphere; with a wall there is none.
  DiskGroupOf<D> body[2];
  Vec3 axis = Vec3::UnitZ();        ///< in space, that the first is turned about by its orientation
  VecOf<D> arm = VecOf<D>::Zero();  ///< from the second's centre of mass to the contact [m]
  /// From there to the rim of the second's face, at least [m].
  double room = std::numeric_limits<double>::infinity();
};

/// Two-body collisions: disks or convex bodies that meet each other, or a wall, with v_t = Ψ_i v_n.
struct Collision {
  std::vector<double> psi;             ///< Ψ_i = v_t/|v_n| before
  Approach approach = Approach::spin;  ///< source of v_t
  std::vector<double> vn;              ///< approach speeds [m/s]; empty: `speed` is given
  double speed = 0.0;                  ///< √(v_n² + v_t²), for every Ψ_i its own v_n [m/s]
  std::vector<double> counterSpin = {0.0};  ///< CollisionStart::counterSpin [rad/s]
  bool wall = false;                        ///< the second body is a plane wall
  Vec2 wallVelocity =
      Vec2::Zero();  ///< (along its normal, along it): relative motion is the same [m/s]
  double radius[2] = {0.0, 0.0};  ///< of a wall not used [m]
  double mass[2] = {0.0, 0.0};    ///< likewise [kg]
  double inertiaFactor = 0.5;
  std::vector<double> stepsPerContact = {50.0};           ///< one sweep for each
  Vec2 spinOutOfPlane[2] = {Vec2::Zero(), Vec2::Zero()};  ///< CollisionStart's, in space [rad/s]
  /// In space the whole scene is turned by that angle about that axis, through the origin [rad].
  Vec3 turn = Vec3::Zero();
  double startPhase = 0.5;  ///< the disks touch this fraction of a step after a step, [0, 1)
  std::map<std::string, Margin> margins;    ///< "psi_f", "e_n": largest distance from the oracle
  std::vector<MaterialName> material = {};  ///< of the two, where [[law.pairs]] has them
  /// Of convex bodies, of the case's dimension; `radius` is then what reaches around each.
  std::variant<std::monostate, ConvexPairOf<2>, ConvexPairOf<3>> convex = {};
  std::vector<double> orientation = {0.0}, spin = {0.0};  ///< as CollisionStart [rad, rad/s]

  bool isConvex() const { return convex.index() > 0; }
};

/// A body of planes, cylinders and wall disks that moves as prescribed.
template <int D>
struct WallGroupOf {
  VecOf<D> centre = VecOf<D>::Zero();  ///< about which it rotates [m]
  std::vector<PlaneOf<D>> planes;
  std::vector<VecOf<D>> position;  ///< of wall disks [m]
  double radius = 0.0;             ///< of wall disks [m]
  std::vector<double> radii;       ///< of each, where they are not all alike [m]
  MotionOf<D> motion;
  MaterialName material = {};
  std::vector<Cylinder> cylinders = {};  ///< of space alone
};
using WallGroup = WallGroupOf<2>;

/// Starts of the user's own, in place of groups: each is a packing.
template <int D>
struct StartFilesOf {
  std::vector<std::filesystem::path> files;
  std::vector<DisksOf<D>> disks;        ///< of each
  std::vector<ShapeOf<D>> shapes = {};  ///< of convex bodies among them
  /// Of each component, added to all velocities, other ones in each packing: so one file makes
  /// several packings [m/s].
  double velocityRms = 0.0;
  std::vector<VecOf<D>> fixedPosition = {};  ///< of disks that stand still, alike in all files [m]
  std::vector<double> fixedRadius = {};      ///< [m]
  std::vector<std::vector<int>> lines = {};  ///< of each file, of its disks and then its fixed ones
  MaterialName material = {};                ///< of disks whose file says none
  /// Materials of the files' rows, each once with the row that says it first; and of each disk,
  /// alike in all files, which of them it is, −1: nothing. Empty: no file says any.
  std::vector<MaterialName> rowMaterials = {};
  std::vector<std::int32_t> rowMaterialOf = {};
};

/// Disks and walls put together as a case file says, and then, in the plane, placed as a whole;
/// gravity and walls go along.
template <int D>
struct AssemblyOf {
  std::vector<DiskGroupOf<D>> disks;
  StartFilesOf<D> starts;  ///< either these or `disks`
  std::vector<WallGroupOf<D>> walls;
  std::optional<BoxOf<D>> box;                ///< with periodic directions
  VecOf<D> gravity = VecOf<D>::Zero();        ///< [m/s²]
  double inertiaFactor = D == 2 ? 0.5 : 0.4;  ///< q in J = q m a²
  bool rotation = true;     ///< false: friction acts, but no disk has a spin or gets one
  double maxOverlap = 0.2;  ///< largest overlap of a start, in units of the smallest radius
  std::uint64_t seed = 1;   ///< of jitter, radii, velocities and chosen places

  Placement placement;  ///< of the plane alone

  /// How long it is watched: one of the three. Contact times are those of the lightest pair.
  std::optional<double> duration;      ///< [s]
  std::optional<double> contactTimes;  ///< [-]
  std::optional<double> steps;         ///< of the case's time step

  /// Of each packing.
  std::size_t diskCount() const {
    std::size_t count = starts.disks.empty() ? 0 : starts.disks.front().size();
    for (const auto& group : disks) count += group.count();
    return count;
  }
  bool anyConvex() const {
    return !starts.shapes.empty() ||
           std::ranges::any_of(disks, [](const auto& group) { return group.shape.has_value(); });
  }
};
using Assembly = AssemblyOf<2>;

/// How the averaged part of the plane is divided into bins.
enum class BinKind { rings, slabs, grid, whole };
inline constexpr std::array<std::string_view, 4> binKindNames = {"rings", "slabs", "grid", "whole"};

/// The part of the plane or of space that is averaged, and the time of it. Rings lie about the
/// origin, in space about the z axis; all others divide the box between two corners. It stays where
/// it is while walls move.
struct Region {
  BinKind bins = BinKind::whole;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< corners of the box; in the plane z is 0 [m]
  double innerRadius = 0.0, outerRadius = 0.0;   ///< of rings [m]
  int axis = 1;               ///< slabs lie one after the other along 0: x, 1: y, 2: z
  int count = 1;              ///< of rings or slabs
  int columns = 1, rows = 1;  ///< of a grid
  int layers = 1;             ///< along z, of a grid or rings in space
  double height = 1.0;  ///< h of the disks, normal to the plane: with 1 m a stress in N/m² is the
                        ///< force per length in N/m [m]
  double from = 0.0;    ///< start of averaging [s]
  int snapshots = 100;  ///< evenly from there to the end

  bool hasRings() const { return bins == BinKind::rings; }
  int columnCount() const { return bins == BinKind::slabs && axis == 0 ? count : columns; }
  int rowCount() const { return bins == BinKind::slabs && axis == 1 ? count : rows; }
  int layerCount() const { return bins == BinKind::slabs && axis == 2 ? count : layers; }
  int binCount() const { return (hasRings() ? count : columnCount() * rowCount()) * layerCount(); }
};

/// Reduction of a quantity to one number of a run. A mean or slope over bins weighs them
/// with their volumes where the field is per volume, else with what they hold.
enum class Reduction {
  mean,     ///< of a field over all bins; of a series over time
  bin,      ///< a field in one bin
  slope,    ///< of a field along its slabs or rings, by least squares [per m]
  end,      ///< the last value of a series
  rate,     ///< of a series over time, by least squares [per s]
  maximum,  ///< of a series: of the parabola through the largest value and its two neighbours,
            ///< where a fourth point lies on it, too
  minimum,  ///< likewise
  time,     ///< a series at one time
  reaches   ///< when a series first is at a value [s]
};

/// One number of a run that carries a verdict between engines: few of them, so that a test can find
/// something, and each says another thing of the flow. Bins show where a difference is.
struct Endpoint {
  std::string name;         ///< "mean_spin"
  std::string words;        ///< the name with blanks
  std::string symbol;       ///< marks as in reports/common/text.hpp; empty: it has none
  std::string quantity;     ///< a field of profiles.csv or a number of regionNumbers()
  std::optional<int> disk;  ///< from 0: then a number of diskNumbers()
  /// Of [[assembly.walls]], from 0: then a number of wallNumbers(), of all of it or of one plane.
  std::optional<int> wall, plane;
  double area = 1.0;  ///< that a force on a wall is divided by [m²]
  std::string per;    ///< divided by another one, reduced likewise; empty: not
  Reduction reduction = Reduction::mean;
  int bin = 0;         ///< of Reduction::bin, from 0
  double level = 0.0;  ///< of Reduction::time [s], of Reduction::reaches [unit of the quantity]
  std::optional<std::pair<double, double>> between;  ///< the part of a series that counts [s]
  /// By a closed form: then engines are judged by it too, on one start that is run twice [unit].
  std::optional<double> expected;
  std::string unit;
  std::string definition;  ///< in words
  /// Engines are compared by their ratio, on logarithms, and the margin is relative: of what has
  /// one sign in every run and spreads over packings by factors. Else by the difference.
  bool byRatio = false;

  /// The quantity's column of series.csv: "disks", "disk_0_y".
  std::string series() const;
};

/// Where the bodies of a scene come from.
using SceneSource = std::variant<Couette, Collision, AssemblyOf<2>, AssemblyOf<3>>;

/// One case with all its `extends` resolved and one variant applied.
struct Case {
  std::string name;
  std::string variant;  ///< empty for the case itself
  int dimension = 2;    ///< 3: spheres in space
  SceneSource source;
  std::filesystem::path file;
  std::string resolvedToml;  ///< the merged document, printed: what was really run
  ContactLaw law;
  /// Where pairs of bodies differ: names and laws alone. `law` is that of pairs without one of
  /// their own, whose options and effects all have.
  std::optional<Materials> materials;
  std::optional<BottomPlate> bottom;
  Preparation preparation;
  Averaging averaging;
  InterimSettings looks;
  RunOptions run;
  std::optional<Region> region;        ///< averaged part of a flow: rings of a cell
  std::vector<Endpoint> endpoints;     ///< all of them have an expected value, or none
  std::optional<Stability> stability;  ///< of a hard case
  Cost cost;
  std::map<std::string, Settings> engines;  ///< [engines.NAME]
  std::vector<std::string> warnings;        ///< entries that load but are hardly meant; a line each
  std::vector<std::string> overrides;       ///< "key.path=value" each, as after `--set`
};

/// The cell that the case fills; null: its scene is no Couette cell.
inline const Couette* cellOf(const Case& setup) {
  return std::get_if<Couette>(&setup.source);
}

inline bool isCollision(const Case& setup) {
  return std::holds_alternative<Collision>(setup.source);
}

/// Disks and walls that the case file puts together itself.
inline bool isAssembly(const Case& setup) {
  return !cellOf(setup) && !isCollision(setup);
}

/// Source of the scene of a case. @throws std::bad_variant_access where it is something else
auto& couetteIn(auto&& setup) {
  return std::get<Couette>(setup.source);
}
auto& collisionIn(auto&& setup) {
  return std::get<Collision>(setup.source);
}
template <int D>
auto& assemblyIn(auto&& setup) {
  return std::get<AssemblyOf<D>>(setup.source);
}

/// A packing of the user's own that fills a cell; null: there is none.
inline const std::filesystem::path* packingFile(const Case& setup) {
  const Couette* const cell = cellOf(setup);
  return cell && cell->particles.file ? &*cell->particles.file : nullptr;
}

/// Does the same to the assembly of the case's own dimension. @throws as assemblyIn()
decltype(auto) withAssembly(auto& setup, auto&& work) {
  return setup.dimension == 3 ? work(assemblyIn<3>(setup)) : work(assemblyIn<2>(setup));
}

/// Whether there are convex bodies among its disks.
inline bool anyConvex(const Case& setup) {
  const auto* const plane = std::get_if<AssemblyOf<2>>(&setup.source);
  const auto* const space = std::get_if<AssemblyOf<3>>(&setup.source);
  return (plane && plane->anyConvex()) || (space && space->anyConvex());
}

/// Calls work.operator()<D>() with the case's dimension.
decltype(auto) inDimensionOf(const Case& setup, auto&& work) {
  return setup.dimension == 3 ? work.template operator()<3>() : work.template operator()<2>();
}

}  // namespace crossgrain::inline cases
