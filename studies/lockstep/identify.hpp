#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "adapters/engine_entry.hpp"
#include "cases/case.hpp"
#include "studies/core/study.hpp"
#include "studies/lockstep/starts.hpp"

namespace crossgrain::inline studies {

/// Values that an engine's motion allows for one option of the law.
struct FoundOption {
  std::string name;
  std::vector<std::string> values;    ///< that fit alike, the closest mirror's first
  std::vector<std::string> declared;  ///< empty: the engine says nothing of it
  /// Whether none of the declared ones is among those that fit.
  bool contradicts() const;

  void fields(auto& io) { FIELDS(io, name, values, declared); }
};

struct FoundConstant {
  std::string name;
  double change = 0.0;  ///< relative to the case's

  void fields(auto& io) { FIELDS(io, name, change); }
};

/// The mirror that follows an engine most closely, found without asking what the engine declares.
struct Identification {
  std::vector<FoundOption> options;      ///< that have a bearing on the closest mirror
  std::vector<FoundConstant> constants;  ///< that are not the case's
  std::vector<std::string> missing;      ///< effects that the engine does not simulate
  std::vector<std::string> declaredMissing;
  double before = 0.0;  ///< largest separation from the case's own law [d], …
  double left = 0.0;    ///< … and from the closest mirror, at `time` [d]
  double time = 0.0;    ///< since each start [s]
  std::size_t starts = 0;

  /// Whether the closest mirror is one: it leaves a hundredth of the separation at most.
  bool closeEnough() const;

  void fields(auto& io) {
    FIELDS(io, options, constants, missing, declaredMissing);
    io("separation_before", before);
    io("separation_left", left);
    io("time_s", time);
    io("starts", starts);
  }
};

/// Failed where there is no mirror, or anything is other than the engine declares.
Outcome outcomeOf(const Identification& found);

/// Begins with the in-house engine on the case as it is and changes one thing after the other,
/// always the one that brings it nearest to the engine: conventions and effects first, then
/// constants.
/// @param engine  started; that of `entry`, with the case's normal law (noMirrorReason())
/// @throws EngineFailure, UnsupportedScene, BadInput, Interrupted
Identification identify(Engine& engine, const EngineEntry& entry, const Case& setup,
                        const std::vector<FlowState>& states, double dt,
                        const std::function<void(double)>& progress);

}  // namespace crossgrain::inline studies
