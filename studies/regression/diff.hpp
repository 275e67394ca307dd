#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <optional>
#include "adapters/engine_entry.hpp"
#include "results/regression.hpp"
#include "studies/core/study.hpp"
#include "studies/regression/baseline.hpp"
#include "studies/regression/recording.hpp"

namespace crossgrain::inline studies {

/// Comparison of one engine, from the same starts and in the same collisions, with a baseline.
/// @param engine  started; that of `entry`
/// @param cases   as it is to run them now
/// @param before  that of the baseline's cases
/// @throws UnsupportedScene, BadInput, Interrupted; a failure of the engine is in the row
DiffRow diffEngine(Engine& engine, const EngineEntry& entry, const std::vector<Case>& cases,
                   const Baseline& baseline, const BaselineEngine& before,
                   const std::function<void(double)>& progress);

/// Every engine named, compared with what was kept of it, or else of the first engine that was; of
/// a dry run none.
/// @throws UnsupportedScene, BadInput, Interrupted
DiffResults diffAgainst(const std::filesystem::path& file,
                        const std::vector<std::string>& overrides, const RunCommand& command);

/// An engine that failed, then one that differs; nothing measured is no success.
Outcome outcomeOf(const DiffResults& results);

/// Where two lists of numbers of one length differ. NaN stands for a value that is absent: a value
/// on one side only differs by as much as there is, by 1 in relative terms.
struct NumbersDifference {
  std::size_t differ = 0, of = 0;  ///< elements
  std::size_t at = 0;              ///< the element that differs most
  double change = 0.0;             ///< there, now − before; NaN: absent on one side
  double relative = 0.0;           ///< its size in units of the largest number before [-]
};

/// @param tolerance  numbers that differ by no more than this part of the largest before are alike
NumbersDifference differenceOf(const std::vector<double>& before, const std::vector<double>& now,
                               double tolerance = 0.0);

/// Quantities of sweeps that are not the same bits, of each sweep those that changed most first.
/// Leaves out what one side refused.
struct CollisionChanges {
  std::size_t sweeps = 0;  ///< that were compared
  std::vector<CollisionChange> changes;
};
/// @throws BadInput where they are of other cases or impacts
CollisionChanges collisionChanges(const std::vector<KeptCollisions>& before,
                                  const std::vector<KeptCollisions>& now);

/// By the largest relative change: rules.hpp has the limits and their reasons.
Equivalence equivalenceOf(const std::vector<CollisionChange>& changes);

/// Declaration of an engine.
struct Declaration {
  std::string engine;
  const Capabilities& can;
  const std::optional<EffectiveParameters>& ran;  ///< absent: it did not come to that
};

/// Declarations that are new: of what was realised of a scene the step,
/// precision, integrator, effects, constants and deviations; and where it is the same engine, its
/// version and its options of the law.
std::vector<DeclaredChange> declaredChanges(const Declaration& before, const Declaration& now);

/// Endpoints paired start by start: one analysis of all of them. @param names  before, now
std::vector<EndpointRow> endpointChanges(const Case& setup, const KeptEndpoints& before,
                                         const KeptEndpoints& now,
                                         const std::pair<std::string, std::string>& names);

/// Differences of two answers to one request: arrays first, in the order of the earlier
/// answer, then the other fields. Contacts are compared by their ids, whatever order they are
/// listed in. Not compared: names and versions of the engine, times of clocks, the layout of files,
/// and why there is no answer where both have none.
/// @param tolerance  numbers that differ by no more than this part of the largest of their array,
///                   or of the larger of the two, are alike
std::vector<AnswerDifference> answerDifferences(const Exchange& before, const Exchange& now,
                                                double tolerance);

}  // namespace crossgrain::inline studies
