#pragma once

#include <optional>
#include <string>
#include <vector>

#include "oracle/collision_end.hpp"
#include "studies/conformance/check_context.hpp"

/// Two bodies that meet once, in several ways side by side, compared with the theory.
namespace crossgrain::conformance {

/// Partner that a small disk meets.
enum class Partner { disk, wallDisk, plane };

struct Meeting {
  ContactLaw law = {};
  Partner partner = Partner::disk;
  double radius = smallRadius, mass = smallMass;  ///< of the partner, of a disk [m, kg]
  std::optional<double> inertiaFactor = {};  ///< q of J = q m a²; absent: as the engine has disks
  std::vector<CollisionStart> starts = {};
  Vec2 wallVelocity = Vec2::Zero();  ///< of a plane, (along its normal, along it) [m/s]
  double steps = fineSteps;          ///< in a contact of two small disks
  double flight = 0.5;               ///< steps until they touch
  Vec2 place = Vec2::Zero();         ///< that it happens at [m]
};

/// Start by start.
struct MeetingResult {
  ContactLaw law;  ///< that the engine declares, its constants included
  CollidingPair pair;
  Scene whole;  ///< that is loaded, with both of each pair as disks and not shifted
  std::vector<std::optional<CollisionEnd>> ends;  ///< absent: they did not part
  double time;                                    ///< of the snapshot [s]
};

/// Has the engine run context. @returns nothing where the engine refuses context, or declares no
/// law with known constants; @param why  gets the reason
std::optional<MeetingResult> meet(CheckContext& context, const Meeting& meeting,
                                  std::string* why = nullptr);

/// Collisions with partners of one kind under laws of one kind: a cause has to explain all of them
/// with one amount, those that came out right included.
class Evidence {
 public:
  /// A fault for each number that is not the oracle's. Where the law has no limit of small steps
  /// the in-house engine with its conventions stands for the oracle.
  /// @returns whether there was any reference
  bool expectTheOracle(CheckContext& context, const Meeting& meeting, const MeetingResult& outcome,
                       const std::string& name);
  /// The most likely cause of the faults, of none if there were none.
  void explain(CheckContext& context) const;

 private:
  struct One {
    Meeting meeting;
    MeetingResult outcome;
    Scene mirrored;  ///< as the in-house engine would have it
  };
  std::vector<One> all_;
  std::optional<std::size_t> firstWrong_;
};

/// The same against what the same engine did elsewhere: Ψ_f to within `psi`, e_n and duration to
/// that part.
/// @param when  ", 2 s after load"
void expectTheSame(CheckContext& context, const Meeting& meeting, const MeetingResult& outcome,
                   const MeetingResult& wanted, const Tolerance& psi, const std::string& when);

}  // namespace crossgrain::conformance
