#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "adapters/contact_law.hpp"
#include "adapters/engine.hpp"
#include "adapters/vec2.hpp"
#include "cases/assembly.hpp"
#include "cases/average.hpp"
#include "cases/cost.hpp"
#include "oracle/collision_end.hpp"
#include "stability/limits.hpp"

namespace crossgrain::inline cases {

/// The most disks that a case may have, wall disks too: checked before room for them is taken.
inline constexpr int mostDisks = 1'000'000;

/// The Couette shear cell (Lätzel 2003, chapter 3). All wall disks' centres lie on R_i and R_o.
struct Cell {
  double innerRadius = 0.0;  ///< R_i, the wheel, centre at the origin [m]
  double outerRadius = 0.0;  ///< R_o, the fixed ring [m]
  double wallRadius = 0.0;   ///< of a wall disk [m]
  double wallSpacing = 0.0;  ///< between wall disks along each wall [m]
  double height = 0.0;       ///< h of the disks, normal to the plane [m]
  double omega = 0.0;        ///< Ω of the wheel, counter-clockwise positive [rad/s]
};

struct Particles {
  int small = 0, large = 0;                     ///< numbers
  double smallRadius = 0.0, largeRadius = 0.0;  ///< [m]
  double smallMass = 0.0, largeMass = 0.0;      ///< [kg]
  double inertiaFactor = 0.5;                   ///< q in J = q m a²: 1/2 disk, 2/5 sphere
  bool rotation = true;     ///< false: friction acts, but no disk has a spin or gets one
  double maxOverlap = 0.2;  ///< largest overlap allowed at a start, in units of the small radius
  std::string maxOverlapKey = "particles.max_overlap";  ///< where the user says it
  std::optional<std::filesystem::path> file;  ///< a packing of the user's own (see cases/README)
};

/// Dilute lattice, random velocities, turning wheel, shrinking ring, then rotations (thesis §3.3).
struct Preparation {
  std::string engine;  ///< that prepares them; empty: the in-house one
  int packings = 4;
  std::uint64_t seed = 1;
  double dilation = 1.25;    ///< R_prepare / R_o
  double velocity = 0.05;    ///< rms of each component of the initial velocities [m/s]
  double shrinkTime = 1.0;   ///< in which the ring goes from R_prepare to R_o [s]
  double rotations = 2.0;    ///< of the wheel, after the ring has reached R_o
  std::optional<double> dt;  ///< time step of all that [s]; absent: that of the runs
};

/// How far apart two engines may be in one field and still agree.
struct Margin {
  double value = 0.0;  ///< in the field's unit, or a fraction of the reference's mean
  bool relative = false;
  std::string why;    ///< not optional in a case file
  std::string scale;  ///< of which the case file says a share (scales.hpp); empty: `value` is said
};

struct Averaging {
  int rings = 20;
  std::vector<std::string> methods = {"slicing"};  ///< as in weightNames
  double lineWidth = 0.5;         ///< kernel width of line methods, in units of d [-]
  double settleRotations = 0.25;  ///< after hand-over, not averaged
  double rotations = 1.0;         ///< averaged
  int snapshotsPerRotation = 400;
  double confidence = 0.95;
  std::map<std::string, Margin> margins;    ///< by field name as in profiles.csv
  std::map<std::string, Margin> endpoints;  ///< by name (endpoints.hpp)
};

/// How `compare` adds packings (averaging/looks.hpp).
struct Looks {
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
  int keepSnapshots = 20;     ///< snapshots kept per run in HDF5
};

/// Two-body collisions: disks that meet each other, or a wall, with v_t = Ψ_i v_n.
struct Collision {
  std::vector<double> psi;             ///< Ψ_i = v_t/|v_n| before
  Approach approach = Approach::spin;  ///< what v_t comes from
  std::vector<double> vn;              ///< approach speeds [m/s]; empty: `speed` is given
  double speed = 0.0;                  ///< √(v_n² + v_t²), for every Ψ_i its own v_n [m/s]
  std::vector<double> counterSpin = {0.0};  ///< CollisionStart::counterSpin [rad/s]
  bool wall = false;                        ///< the second body is a plane wall
  Vec2 wallVelocity =
      Vec2::Zero();  ///< (along its normal, along it): relative motion is the same [m/s]
  double radius[2] = {0.0, 0.0};  ///< of a wall not used [m]
  double mass[2] = {0.0, 0.0};    ///< likewise [kg]
  double inertiaFactor = 0.5;
  std::vector<double> stepsPerContact = {50.0};  ///< one sweep for each
  double startPhase = 0.5;  ///< the disks touch this fraction of a step after a step, [0, 1)
  std::map<std::string, Margin> margins;  ///< "psi_f", "e_n": largest distance from the oracle
};

enum class CaseKind { couette, collision, assembly };

/// One case with all its `extends` resolved and one variant applied.
struct Case {
  std::string name;
  std::string variant;  ///< empty for the case itself
  CaseKind kind = CaseKind::couette;
  std::filesystem::path file;
  std::string resolvedToml;  ///< the merged document, printed: what was really run
  ContactLaw law;
  std::optional<BottomPlate> bottom;
  Cell cell;
  Particles particles;
  Preparation preparation;
  Averaging averaging;
  Looks looks;
  RunOptions run;
  Collision collision;
  Assembly assembly;
  std::optional<Average> average;      ///< of an assembly that engines are compared on
  std::optional<Stability> stability;  ///< of a hard case
  Cost cost;
  std::map<std::string, Settings> engines;  ///< [engines.NAME]
  std::vector<std::string> warnings;        ///< what loads, but is hardly meant; one line each
  std::vector<std::string> overrides;       ///< "key.path=value" each, as after `--set`
};

}  // namespace crossgrain::inline cases
