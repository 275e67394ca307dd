#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/compare.hpp"
#include "results/schema.hpp"

namespace crossgrain::inline results {

/// How the change of a field, or of a ring, stands against the case's margin.
/// Meaning of standard errors.
enum class BarKind { packings, withinRun };
constexpr auto namesOf(BarKind) {
  return std::array<std::string_view, 2>{"packings", "within_run"};
}

/// switched − whole case in one ring, in the field's unit.
struct RingChange {
  std::size_t ring = 0;             ///< from 0
  std::optional<double> reference;  ///< with everything on, mean over packings
  std::optional<double> change, standardError;
  std::optional<double> p;          ///< adjusted; this and the next four: absent where not tested
  std::optional<bool> resolved;     ///< significant
  std::optional<double> low, high;  ///< the interval that `resolved` rests on
  std::optional<double> smallest;   ///< change that would just have been resolved
  Verdict verdict = Verdict::notApplicable;
};

struct ChangedField {
  std::string field, unit;
  bool judged = false;
  Verdict verdict = Verdict::notApplicable;
  std::vector<RingChange> rings;
};

/// Changes by one thing switched off, over the packings that both have finished.
struct EffectChanges {
  std::size_t packings = 0;
  BarKind bars = BarKind::packings;
  std::vector<ChangedField> fields;
  std::vector<EndpointRow> endpoints;  ///< `a` with everything on, `b` without
};

/// One engine with one effect switched off, or with everything on.
struct EffectVariant {
  std::string engine;
  std::string effect;  ///< that is switched off; empty: everything is on
  Status status = Status::finished;
  std::string reason;
  std::optional<double> step;                       ///< [s] of processor time
  std::optional<double> contacts;                   ///< evaluated per step
  std::optional<double> timeRatio, timeRatioError;  ///< of a step, over that with everything on
  std::optional<std::string> precision;             ///< that was used
  std::optional<std::vector<std::string>> effects;  ///< simulated
  EffectChanges changes;

  /// Whether anything is switched off.
  bool isSwitched() const { return !effect.empty(); }

  void fields(auto& io) {
    const bool ran = status != Status::refused;
    const bool changed = ran && isSwitched();
    io("engine", engine, aName);
    io("effect", effect, aName);
    io("status", status, engineStatusNames);
    io("reason", reason);
    io.when(ran, "step_s", step);
    io.when(ran, "contacts_per_step", contacts);
    io.when(ran, "time_ratio", timeRatio);
    io.when(ran, "time_ratio_stderr", timeRatioError);
    PRESENT_FIELDS(io, precision, effects);
    io.when(changed, "packings", changes.packings);
    io.when(changed, "stderr_kind", changes.bars);
    io.when(changed, "fields", changes.fields);
    io.when(changed && !changes.endpoints.empty(), "endpoints", changes.endpoints);
  }
};

/// Sentence on what was switched off.
struct SwitchRow {
  std::string effect, what;

  void fields(auto& io) {
    io("effect", effect, aName);
    io("what", what);
  }
};

/// How steps are timed.
struct TimingPlan {
  double seconds = 0.2;  ///< each variant steps for at least as long in each round
  int rounds = 5;

  void fields(auto& io) { FIELDS(io, seconds, rounds); }
};

struct EffectsResults : FlowStudy {
  std::vector<CouetteEnsemble> ensemble;
  std::vector<SwitchRow> switches;
  TimingPlan timing;
  std::vector<EffectVariant> variants;  ///< of each engine first that with everything on

  void fields(auto& io) {
    FlowStudy::fields(io);
    io.when(!ensemble.empty(), "ensemble", ensemble);
    FIELDS(io, switches, timing);
    io("legs", variants);
  }
};

}  // namespace crossgrain::inline results
