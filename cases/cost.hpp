#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crossgrain::inline cases {

/// Kinds of error that `crossgrain cost` measures against time; the three are never mixed.
enum class CostKind {
  collision,   ///< two disks against the oracle
  trajectory,  ///< a packing's path against a run at a much smaller step
  averages     ///< of the flow against a reference on the same packings
};
constexpr auto namesOf(CostKind) {
  return std::array<std::string_view, 3>{"collision", "trajectory", "averages"};
}
inline constexpr std::array costKinds = {CostKind::collision, CostKind::trajectory,
                                         CostKind::averages};

inline std::string toString(CostKind kind) {
  return std::string(namesOf(kind)[static_cast<std::size_t>(kind)]);
}

/// Knobs that `crossgrain cost` varies, one setting at a time, in the order of its results;
/// studies/cost/settings.cpp has the settings of each and the kinds of error that it may change.
/// "settings" are engines' own, which go by their names; "effects" go by "effect:NAME".
/// "disks" and "threads" change no error: they are what the time of a step is measured against.
inline constexpr std::array<std::string_view, 9> costKnobs = {
    "time_step", "integrator", "precision", "settings", "tangential",
    "tension",   "effects",    "disks",     "threads"};

/// Whether a setting's text says what was changed, as "t_c/50" does.
inline bool speaksForItself(std::string_view knob) {
  return knob == "time_step" || knob == "integrator";
}

/// Contacts of one kind of pair that begin in a run of a scene.
struct PairImpacts {
  std::string pair;                     ///< as pairsOf() names it
  std::size_t contacts = 0;             ///< that began
  double median = 0.0;                  ///< approach speed v_n [m/s]
  double fast = 0.0;                    ///< 95 % of them approach no faster [m/s]
  double radius[2] = {}, mass[2] = {};  ///< of the pair with the smallest m₁₂; inf: a wall [m, kg]
};

/// Settings and measures of `crossgrain cost` in a flow, [cost] of a case file. Steps are numbers
/// of steps in the contact time t_c of the lightest pair; of rigid bodies, whose contacts take no
/// time, in the case's own step.
struct Cost {
  std::vector<CostKind> kinds = {costKinds.begin(), costKinds.end()};
  std::vector<std::string> knobs = {costKnobs.begin(), costKnobs.end()};
  std::vector<double> disks;    ///< sizes of the scene [bodies]; none: its own and four times it
  std::vector<double> threads;  ///< or ranks, that share a step; none: 1, 2, 4 … to the cores
  double timed = 0.02;          ///< shortest time that counts as measured [s]
  int repeats = 5;  ///< rounds in which settings take turns; their scatter is a time's interval

  /// Two bodies that meet as in `approach = "spin"`, Ψ_i = 0 … psiMax.
  std::vector<double> collisionSteps = {400, 200, 100, 50, 20, 10, 5, 2, 1.2};
  std::optional<double> speed;  ///< v_n; absent: those of `impacts` [m/s]
  double psiMax = 4.0;
  int psiCount = 41;
  /// Steps per t_c of an engine's own limit of small steps, where its law has no oracle; compared
  /// with itself at half of them.
  double collisionReference = 6400.0;

  /// A packing over a window that is short against its chaos.
  std::vector<double> trajectorySteps = {400, 200, 100, 50, 20, 10, 5, 2};
  double trajectoryReference = 1600.0;  ///< steps per t_c of the references
  double windowMost = 40.0;             ///< its length [t_c]
  int trajectoryPackings = 4;           ///< so many of the case's, from the first

  /// The case's packings and averaging.
  std::vector<double> averageSteps = {100, 50, 20, 10, 5, 2};
  double averageReference = 200.0;

  /// Of rigid bodies in place of averageSteps; and of each number that an engine declares as
  /// iterations, in units of that which it runs with.
  std::vector<double> rigidSteps = {0.25, 0.5, 1, 2, 4, 8};
  std::vector<double> iterations = {0.25, 0.5, 2, 4, 8};

  std::vector<std::string> tangential = {"viscous", "coulomb",
                                         "spring"};  ///< in place of the law's
  /// Engine → its setting → values, [cost.settings.NAME].
  std::map<std::string, std::map<std::string, std::vector<double>>> settings;

  /// Of a run of the scene, which a case file cannot say; and the speed where nothing began to
  /// touch [m/s].
  std::vector<PairImpacts> impacts = {};
  double quietSpeed = 0.01;

  bool has(std::string_view knob) const { return std::ranges::find(knobs, knob) != knobs.end(); }
};

}  // namespace crossgrain::inline cases
