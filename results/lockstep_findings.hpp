#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/engine.hpp"
#include "results/causes.hpp"
#include "results/schema.hpp"

/// Engines compared with their mirrors, step by step from the same starts. A mirror is the in-house
/// engine with the conventions that an engine declares, on the scene that this engine runs.
namespace crossgrain::inline results {

/// How alike two runs are that should be the same: of an engine and its mirror, or of an engine now
/// and before. From what says nothing to what differs.
enum class Equivalence {
  notMeasured,     ///< the reason says why
  sameBits,        ///< of what was kept of an engine
  sameToRounding,  ///< no disk ever leaves the mirror's by more than LockstepRules::rounding
  /// Not double precision is declared, and no disk ever leaves the mirror's by more than rounding
  /// to what is declared, once in every step, may do: LockstepSeparation::rounding.
  sameToPrecision,
  sameLaw,    ///< from no start beyond the rule, or from a share of starts shown to be small
  undecided,  ///< neither is shown; the reason says why
  differs     ///< beyond the rule from a share of starts shown to be larger than strayShare
};
constexpr auto namesOf(Equivalence) {
  return std::array<std::string_view, 7>{
      "not_measured", "same_bits", "same_to_rounding", "same_to_its_precision",
      "same_law",     "undecided", "differs"};
}

constexpr Verdict verdictOf(Equivalence found) {
  return found == Equivalence::notMeasured ? Verdict::notMeasured
         : found == Equivalence::undecided ? Verdict::undecided
         : found == Equivalence::differs   ? Verdict::fail
                                           : Verdict::pass;
}

/// Basis of the verdicts.
struct LockstepRules {
  double rounding = 0.0;              ///< [d]
  double sameLaw = 0.0;               ///< reference perturbation, as a fraction of its constant
  double referenceChange = 0.0;       ///< largest by which it was changed to see what that does
  std::string referencePerturbation;  ///< the constant: "kn"
  double strayShare = 0.0;            ///< of starts that may be beyond sameLaw by chance

  void fields(auto& io) {
    FIELDS(io, rounding, sameLaw, strayShare);
    io("yardstick", referencePerturbation);
    io("yardstick_change", referenceChange);
  }
};

/// One of the states that all engines start from.
struct LockstepStart {
  std::size_t packing = 0;  ///< index
  double time = 0.0;        ///< since the hand-over [s]
  double wheelAngle = 0.0;  ///< since the wheel was built [rad]

  void fields(auto& io) {
    FIELDS(io, packing, wheelAngle);
    io("time_s", time);
  }
};

/// How far disks are from the mirror's, so long after the start: of each start the disk that is
/// farthest.
struct LockstepSeparation {
  double time = 0.0;     ///< since the start [s]
  double median = 0.0;   ///< over the starts [d]
  double largest = 0.0;  ///< [d]
  std::optional<double>
      referencePerturbation;  ///< median of what the reference perturbation does [d]
  /// Effect of a rounding to the declared precision, the median over the starts [d]; absent of
  /// double precision.
  std::optional<double> rounding;
  /// ε_eq, the median over the starts that can be read then; absent: none can, or nothing is beyond
  /// `rounding`.
  std::optional<double> equivalent;

  void fields(auto& io) {
    io("time_s", time);
    FIELDS(io, median, largest, rounding, equivalent);
    io("yardstick", referencePerturbation);
  }
};

/// Finding of one start.
struct StartReading {
  /// ε_eq, the largest over the times that can be read; absent: none can, or nothing is beyond what
  /// the declared precision explains.
  std::optional<double> equivalent;
  double until = 0.0;   ///< the last time that can be read, since the start [s]; 0: none can
  bool beyond = false;  ///< ε_eq is above LockstepRules::sameLaw, or disks that touch nothing part

  void fields(auto& io) {
    FIELDS(io, equivalent, beyond);
    io("until_s", until);
  }
};

/// Contacts of the mirror that the windows came upon, each counted once a window and kind.
struct ContactKinds {
  std::size_t sticking = 0, sliding = 0;
  std::size_t made = 0, opened = 0;  ///< since the frame before
  std::size_t wall = 0;              ///< with a wall disk

  void fields(auto& io) {
    FIELDS(io, sticking, sliding, wall);
    io("new", made);
    io("opening", opened);
  }
};

/// Where an engine first leaves its mirror by more than rounding in its precision, over all starts.
struct FirstExceedance {
  std::size_t start = 0;               ///< index
  double after = 0.0, until = 0.0;     ///< between these times since the start [s]
  std::size_t disk = 0;                ///< that is farthest off
  std::optional<std::size_t> partner;  ///< of its contact whose force is farthest off
  std::string contact;                 ///< "sliding", "new, wall"; empty: it touches nothing
  std::size_t touching = 0;            ///< how many contacts it has, or its partner if more

  void fields(auto& io) {
    FIELDS(io, start, disk, partner, contact, touching);
    io("after_s", after);
    io("until_s", until);
  }
};

/// Forces of the first step, from the same positions and velocities.
struct LockstepForces {
  std::size_t contacts = 0;  ///< of the mirror, all starts
  std::size_t missing = 0;   ///< that the engine does not have
  std::size_t extra = 0;     ///< that the mirror does not have
  double normal = 0.0;       ///< largest difference, in the largest normal force [-]
  double tangential = 0.0;   ///< likewise

  void fields(auto& io) { FIELDS(io, contacts, missing, extra, normal, tangential); }
};

/// A single change of the mirror that would account for what was seen.
struct NamedTerm {
  std::string name;              ///< "kn", "tension = cut", "without gravity"
  std::optional<double> amount;  ///< of a constant: relative change
  double unexplained = 0.0;      ///< rms part of the separation that is left, 0 … 1

  void fields(auto& io) { FIELDS(io, name, amount, unexplained); }
};

/// Causes of how far an engine's mirror leaves the in-house engine under the case's own law, both
/// in the engine's steps.
struct LockstepCauses : Causes {
  std::size_t starts = 0;  ///< the first so many
  /// By difference: the first step after which it alone has moved a disk by more than rounding, the
  /// smallest over the starts; absent: none has.
  std::vector<std::optional<std::size_t>> firstStep;
  std::vector<double> time;    ///< since the start [s]
  std::vector<Numbers> parts;  ///< by difference and time: of the divergence, to which …
  Numbers interaction;         ///< … they add up with this [-]; absent: it is rounding then

  void fields(auto& io) {
    Causes::fields(io);
    FIELDS(io, starts, firstStep, parts, interaction);
    io("time_s", time);
  }
};

/// One engine against its mirror.
struct LockstepRow {
  std::string engine;
  Equivalence verdict = Equivalence::notMeasured;
  std::string reason;  ///< of not measured and undecided
  /// ε_eq, the median over the starts that can be read, and the interval of that median between two
  /// of them (95 %; of fewer than 6 starts the least and the largest).
  std::optional<double> equivalent, equivalentLow, equivalentHigh;
  std::vector<StartReading> readings;  ///< by start, of those followed to the end
  std::size_t read = 0;                ///< of those, that can be read
  std::size_t beyond = 0;              ///< of those read, beyond the rule
  /// Of differs: all starts but a share within chance first part where a disk touches several at
  /// once, or may have.
  bool severalAtOnce = false;
  /// Upper bound of the share of all states that are beyond the rule, at 95 %.
  std::optional<double> shareHigh;
  /// Of same to its precision: the smallest change of that constant that would show beyond
  /// rounding; absent: none of those tried.
  std::optional<double> resolution;
  std::size_t starts = 0;   ///< that were followed to the end
  std::size_t precise = 0;  ///< of those, that are same to its precision; 0 of double precision
  std::string failure;      ///< of the first start that was not
  std::vector<LockstepSeparation> separations;
  std::vector<double> trackTime, track;  ///< largest separation over starts [s], [d]
  ContactKinds kinds;
  std::optional<FirstExceedance> first;
  std::optional<LockstepForces> forces;
  std::optional<NamedTerm> term;         ///< absent: same to rounding, or none fits
  std::optional<LockstepCauses> causes;  ///< absent: it declares the case's law, and has it
  std::optional<EffectiveParameters> effective;
  double wallSeconds = 0.0;  ///< that it took in all [s]

  void fields(auto& io) {
    io("engine", engine, aName);
    FIELDS(io, verdict, reason, equivalent, equivalentLow, equivalentHigh, readings, read, beyond,
           shareHigh, resolution, starts, failure, separations, track, kinds, first, forces, term);
    io.when(severalAtOnce, "several_at_once", severalAtOnce);
    io("same_to_its_precision", precise);
    io("track_time_s", trackTime);
    io.present("causes", causes);
    io("realised", effective);
    io("wall_s", wallSeconds);
  }
};

struct LockstepFindings {
  LockstepRules rules;
  std::vector<LockstepStart> starts;
  std::vector<LockstepRow> rows;

  void fields(auto& io) { FIELDS(io, rules, starts, rows); }
};

}  // namespace crossgrain::inline results
