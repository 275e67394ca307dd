#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/common/engines.hpp"
#include "reports/common/json_view.hpp"

/// results["legs"] of kind "effects", ready to be told.
namespace crossgrain::reports {

/// What switching an effect off does to one field, at the ring that says most: of those told apart
/// from no change the one that changes most, else the one that came nearest to it. Shares are of
/// the profile's largest value with everything on, so that a ring where next to nothing is left of
/// a field does not count for more than it is.
struct FieldChange {
  std::string field;
  std::string verdict;  ///< against the case's margin: "agree", "disagree", "undecided" or empty
  std::string verdictHere;  ///< that of the ring alone
  std::size_t ring = 0;
  double change = 0.0;          ///< switched − everything on, a share
  std::optional<double> error;  ///< standard error, a share too
  /// The interval that `detected` rests on, shares: it leaves out 0 exactly if it is true.
  std::optional<double> low, high;
  std::optional<bool> detected;          ///< absent: too few packings to tell
  std::optional<double> inErrors;        ///< |change|/error
  std::optional<double> detectable;      ///< the smallest share that some ring would have shown
  std::optional<double> detectableHere;  ///< and that ring
};

/// One engine with one effect switched off.
struct EffectLeg {
  std::string engine, effect;
  std::string status, reason;               ///< "ran" | "refused" | "failed"
  std::optional<double> saved, savedError;  ///< time saved per step, a share of the whole step's
  std::optional<double> step, contacts;     ///< [s], number: of one step
  std::optional<double> wholeContacts;      ///< with everything on
  std::size_t packings = 0;
  std::vector<FieldChange> changes;  ///< of the fields that are judged, and have any number

  bool ran() const { return status == "ran"; }
  bool decidable() const;  ///< enough packings to tell what changes
  bool changesSomething() const;
  bool withinMargins() const;  ///< every field is shown to be
  /// Null where the field has no number.
  const FieldChange* of(const std::string& field) const;
};

/// In the order of the results; legs with everything on are left out.
std::vector<EffectLeg> effectLegs(const Json& results);

/// An engine's leg with everything on, or null.
const Json& wholeLeg(const Json& results, const std::string& engine);

/// Fields that any leg judges, in the order of the results.
std::vector<std::string> judgedFields(const std::vector<EffectLeg>& legs);

/// The runs of one engine with everything on and with each effect switched off, each as if it were
/// an engine of its own.
std::vector<EngineResults> legResults(const Json& results, const std::string& engine);

/// Of an effect: "bottom friction", "tension", "double precision"; and of the run that lacks it:
/// "without bottom friction", "tension cut off", "single precision".
std::string effectLabel(const std::string& effect);
std::string legLabel(const std::string& effect);

}  // namespace crossgrain::reports
