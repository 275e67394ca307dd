#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/thesis/leg_runs.hpp"
#include "results/thesis.hpp"

/// How much each reading of the thesis, and each constant, changes each profile.
namespace crossgrain::reports {

/// What is read off a run's profiles.
struct ProfileNumber {
  const char* key;    ///< "velocity_wheel"
  const char* label;  ///< "v_φ/(ΩR_i), ring 1"
  const char* unit;   ///< empty: a number
  std::optional<double> (*of)(const LegRun& at);
};

/// ν, v_φ, spin, stresses, fabric and contacts, at the wheel and outside of the band. Stresses are
/// told as lg, since they change by factors.
const std::vector<ProfileNumber>& profileNumbers();

struct ReadingChange {
  std::optional<double> standard;  ///< without the change, mean over the pairs
  std::optional<double> change;    ///< reading less default, mean over the pairs
  std::optional<double> error;     ///< of it, sd/√pairs; absent of one pair
  int pairs = 0;
};

/// One engine's runs of legs that differ from the default in one thing, held against runs of the
/// default: of the same ν̄, the same packing's index and the same rotations. Packings of another
/// reading are others, so that a pair differs as packings do, too.
struct ReadingRow {
  std::string family;  ///< "spacing"
  std::string words;   ///< "wall spacing 7 mm"
  std::string engine;
  std::vector<double> labels;  ///< ν̄ of the pairs, rising
  std::string rotations;       ///< "5 to 8"
  int pairs = 0;
  std::vector<ReadingChange> changes;  ///< of profileNumbers(); absent where runs are missing
};

/// A row for each reading that there are legs of, also where nothing was run of it, by the first
/// engine; of other engines where they have pairs.
/// @param eachDensity  a row for each ν̄ instead of one for all
std::vector<ReadingRow> readingRows(const ThesisResults& results, bool eachDensity = false);

/// engine,family,reading,nu,rotations,number,unit,default,change,stderr,pairs
/// Rows of all ν̄ together have none; stderr is over pairs.
std::string readingsCsv(const ThesisResults& results);

}  // namespace crossgrain::reports
