#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cases/cost_kind.hpp"

namespace crossgrain::inline cases {

/// Something that `crossgrain cost` varies, one setting at a time. A new one is an entry in
/// cost_knobs.cpp and, in runs/cost/settings.cpp, what its settings are; the case file's keys, the
/// words of reports and which finished runs stay valid follow from here.
struct CostKnob {
  /// In `[cost] knobs` and of its points; in words its underscores are spaces. Points of
  /// "settings" and "effects" go by what was set.
  std::string_view name;
  /// Of its values in [cost]: one list of texts or numbers. Empty: they are not the case's to say.
  std::string_view key = {};
  std::vector<std::string> texts = {}, choices = {};  ///< by default, and all that may be said
  std::vector<double> numbers = {};                   ///< by default
  double least = 0.0;                                 ///< of the numbers; 0 itself is out
  std::vector<CostKind> kinds = {};                   ///< of error that it may change
  bool speaksForItself = false;                       ///< see below
  /// Its settings leave the law as it is: what they change is how it is worked out.
  bool sameLaw = false;
  bool sameRun = false;  ///< its settings sample the runs of the case as it is differently
};

/// In the order that `[cost] knobs` lists them by default.
const std::vector<CostKnob>& costKnobs();

/// The knob of that name, or null.
const CostKnob* findCostKnob(std::string_view name);

/// Whether the words of that knob's settings say what was changed, as "t_c/50" does.
bool speaksForItself(std::string_view knob);

}  // namespace crossgrain::inline cases
