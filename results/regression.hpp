#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/endpoints.hpp"
#include "results/head.hpp"
#include "results/lockstep_findings.hpp"

/// Difference of an engine from a baseline or a recording has it.
namespace crossgrain::inline results {

/// Something that an engine declares: its step, an option, a constant of a kind of pair.
struct DeclaredChange {
  std::string name, before, now;  ///< empty: not there

  void fields(auto& io) { FIELDS(io, name, before, now); }
};

/// One quantity over one sweep of collisions.
struct CollisionChange {
  std::string name, variant;  ///< of the case
  std::string quantity;
  std::size_t changed = 0;  ///< collisions of which it is not the same bits
  std::size_t points = 0;   ///< of the sweep
  double largest = 0.0;     ///< change, now − before [the quantity's unit]
  double relative = 0.0;    ///< its size in units of the largest value of the sweep before [-]
  double psi = 0.0;         ///< Ψ_i at which it is …
  double vn = 0.0;          ///< … and speed of approach [m/s]

  void fields(auto& io) {
    FIELDS(io, name, variant, changed, points, largest, relative);
    io("quantity", quantity, aName);
    io("psi_i", psi);
    io("v_n", vn);
  }
};

/// Forces that are reported of states that both came to.
struct ForcesChange {
  std::size_t frames = 0;                 ///< of such states
  double normal = 0.0, tangential = 0.0;  ///< of a contact, in the largest normal force before [-]
  double walls = 0.0;  ///< on a wall, in the largest force, or torque, before [-]

  void fields(auto& io) { FIELDS(io, frames, normal, tangential, walls); }
};

/// One engine compared with the baseline.
struct DiffRow {
  std::string engine, version;        ///< now
  std::string before, versionBefore;  ///< engine whose runs were kept, its version
  Equivalence verdict = Equivalence::notMeasured;
  std::string reason;   ///< why the windows were not compared
  std::string failure;  ///< of the first run that was not finished
  std::vector<DeclaredChange> declared;
  std::optional<LockstepRow> windows;  ///< compared with those kept; absent of cases of collisions
  bool mirrored = false;  ///< the kept engine has a mirror, in which a deviation can be sought
  Equivalence windowsVerdict = Equivalence::notMeasured;
  std::optional<ForcesChange>
      forces;  ///< absent where the engine does not report those of an instant
  Equivalence forcesVerdict = Equivalence::notMeasured;  ///< differs or not measured
  std::vector<CollisionChange> collisions;               ///< that are not the same bits
  std::size_t sweeps = 0;                                ///< that were compared
  Equivalence collisionsVerdict = Equivalence::notMeasured;
  /// Averages of whole runs from each start compared with those kept; empty where none were kept,
  /// or where the windows are the same bits.
  std::vector<EndpointRow> endpoints;

  void fields(auto& io) {
    io("engine", engine, aName);
    FIELDS(io, version, before, versionBefore, verdict, reason, failure, declared, windows,
           mirrored, windowsVerdict, forces, forcesVerdict, collisions, sweeps, collisionsVerdict,
           endpoints);
  }
};

struct DiffResults {
  ResultsHead head;
  std::string baseline;                  ///< file
  std::string baselineVersion;           ///< of the crossgrain that kept it
  std::vector<std::string> changedKeys;  ///< of the case, "law.mu: 0.44 → 0.5"
  LockstepRules rules;
  std::vector<LockstepStart> starts;
  std::vector<DiffRow> rows;

  void fields(auto& io) {
    head.fields(io);
    FIELDS(io, baseline, baselineVersion, changedKeys, rules, starts);
    io("engines", rows);
  }
};

/// A field or an array that two answers to one request do not have alike.
struct AnswerDifference {
  std::string field;  ///< "snapshot.bodies.0.torque", "position"
  std::string
      place;  ///< in an array, where it is largest: "[17]", or the contact's ids; else empty
  std::string then, now;           ///< there
  std::optional<double> off = {};  ///< |now − then| there, of numbers, in the field's unit
  std::size_t differ = 1, of = 1;  ///< elements

  /// The list writes place and field as one.
  void fields(auto& io) {
    std::string where = field + place;
    io("field", where);
    FIELDS(io, then, now, off, differ, of);
  }
};

/// Answers of an engine to the requests of a recording.
struct ReplayResults {
  std::string engine, version;  ///< that answered now
  std::string recordedEngine, recordedVersion;
  std::string recordedStamp;  ///< of its program; empty for engines of this one
  std::string caseName;
  std::size_t asked = 0;  ///< requests, the one of `request` being the last
  /// Declarations that differ, in answer to hello and load: the replay goes on.
  std::vector<AnswerDifference> declared;
  std::string request;  ///< the first other request with a different answer; empty: there is none
  std::vector<AnswerDifference> differences;
  std::string failure;  ///< of the engine, now; it may be the one that was recorded

  void fields(auto& io) {
    FIELDS(io, engine, version, recordedEngine, recordedVersion, recordedStamp, asked, declared,
           request, differences, failure);
    io("case", caseName);
  }
};

}  // namespace crossgrain::inline results
