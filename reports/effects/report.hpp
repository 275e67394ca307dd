#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/flow/report.hpp"
#include "results/effects.hpp"

namespace crossgrain::reports {

/// Table: effects.csv, one row per field and ring; a variant without any is one row with its
/// status.
Report reportOf(const EffectsResults& results);

/// An effect per row; for each engine what a step without it saves, and what that changes most.
Overview effectsOverview(const EffectsResults& results);

/// For each engine k = 1, 2, …: effects_k_cost, what each effect costs and changes;
/// effects_k_profile_FIELD, with and without.
std::vector<Figure> effectFigures(const EffectsResults& results);

/// Change of one field by an effect switched off, at one ring: the largest of the significant
/// changes, else the one with the most errors. Changes are over the profile's largest value with
/// everything on, so that a ring where next to nothing is left of a field does not dominate.
struct FieldChange {
  std::string field;
  Verdict verdict = Verdict::notApplicable;
  Verdict verdictHere = Verdict::notApplicable;  ///< that of the ring alone
  std::size_t ring = 0;
  std::string bin;              ///< name of the ring: "ring 3", "bin 3"
  double change = 0.0;          ///< switched − everything on
  std::optional<double> error;  ///< standard error
  /// The interval that `detected` rests on: it leaves out 0 exactly if it is true.
  std::optional<double> low, high;
  std::optional<bool> detected;          ///< absent: too few packings to tell
  std::optional<double> inErrors;        ///< |change|/error
  std::optional<double> detectable;      ///< the smallest that some ring would have shown
  std::optional<double> detectableHere;  ///< and that ring
};

/// One engine with one effect switched off.
struct VariantSummary : EffectVariant {
  std::optional<double> saved;          ///< time saved per step, over the whole step's
  std::optional<double> wholeContacts;  ///< of a step, with everything on
  std::vector<FieldChange> judged;      ///< of the fields that are judged, and have any number
  bool oneStart = false;                ///< whose profiles have no scatter to be tested against

  bool ran() const { return status == Status::finished; }
  bool decidable() const;         ///< enough packings to tell what changes
  const char* untested() const;   ///< why it is not decidable
  bool changesSomething() const;  ///< a field, or an endpoint beyond its margin
  bool withinMargins() const;     ///< every field and endpoint is shown to be
  bool changesTime() const;       ///< by more than two errors
  bool costsTime() const;         ///< likewise, and saves it
  /// Null where the field has no number.
  const FieldChange* of(const std::string& field) const;
};

/// In the order of the results, of all engines or one; variants with everything on are left out.
std::vector<VariantSummary> variantSummaries(const EffectsResults& results,
                                             const std::string& engine = {});

/// An engine's variant with everything on, or null.
const EffectVariant* wholeVariant(const EffectsResults& results, const std::string& engine);

/// Fields that any variant judges, in the order of the results.
Names judgedFields(const std::vector<VariantSummary>& variants);

/// Effects that plots of profiles have, beside everything on: each has a colour of its own.
inline constexpr std::size_t mostVariants = 6;

/// The runs of one engine with everything on and with each of the mostVariants effects switched off
/// that change a profile most, each as if it were an engine of its own.
Engines variantRuns(const EffectsResults& results, const std::string& engine);

/// Of an effect: "bottom friction", "tension", "double precision"; and of the run that lacks it:
/// "without bottom friction", "tension cut off", "single precision".
std::string effectLabel(const std::string& effect);
std::string variantLabel(const std::string& effect);

}  // namespace crossgrain::reports
