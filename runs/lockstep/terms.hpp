#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "results/lockstep.hpp"

namespace crossgrain::inline runs {

/// One thing in which a mirror could be otherwise: a constant a little larger, another convention,
/// an effect less.
struct MirrorChange {
  std::string name;         ///< "kn", "tension = cut", "without gravity"
  bool isConstant = false;  ///< the response is linear in it: any amount can be told
  /// `by`: of a constant the relative change; no matter to others.
  std::function<void(Scene&, double by)> apply;
};

/// All that could be otherwise in this scene.
/// @param can  of the in-house engine
std::vector<MirrorChange> changesOf(const Scene& scene, const Capabilities& can);

/// The constant that deviations are expressed in: k_n, of rigid disks e_n.
std::string yardstickOf(const ContactLaw& law);

/// Changes it by that part of itself.
void changeYardstick(ContactLaw& law, double by);

/// ε_eq: the change of the yardstick that parts the mirror from itself as far as the engine is from
/// it. Between the changes tried on a straight line of the logarithms, which is exact where
/// separations are proportional to the change; beyond them in proportion.
/// @param responses  separations by yardstickChanges [any unit]; a larger change counts for no less
/// than a smaller one
/// @returns nothing where even the largest change moves nothing
std::optional<double> equivalentChange(double separation, std::vector<double> responses);

/// How much of a separation a change accounts for: for a constant the amount that fits best, in
/// least squares; another convention or a missing effect as it is.
/// @param separation, response  of all starts, one after the other; a constant's to termChange
NamedTerm asTerm(const MirrorChange& change, const std::vector<double>& separation,
                 const std::vector<double>& response);

/// The term that leaves least, if that is less than termUnexplained.
std::optional<NamedTerm> bestTerm(const std::vector<NamedTerm>& terms);

}  // namespace crossgrain::inline runs
