#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "adapters/engine.hpp"
#include "cases/case.hpp"
#include "results/lockstep_findings.hpp"

namespace crossgrain::inline studies {

/// One thing in which a mirror could be otherwise: a constant a little larger, another convention,
/// an effect less.
template <int D>
struct MirrorChangeOf {
  std::string name;         ///< "kn", "tension = cut", "without gravity"
  bool isConstant = false;  ///< the response is linear in it: any amount can be given
  /// `by`: of a constant the relative change; no matter to others.
  std::function<void(SceneOf<D>&, double by)> apply;
};
using MirrorChange = MirrorChangeOf<2>;

template <int D>
struct AppliedChangeOf {
  MirrorChangeOf<D> change;
  double by = 0.0;  ///< of a constant
};
using AppliedChange = AppliedChangeOf<2>;

/// Whether a mirror may follow otherwise by another value of an option. More do than matter to the
/// law: an arm of v_t that is that of f_t can become another one, and the velocity that dashpots
/// see, of this instant or half a step before, is the one that stretches springs and turns
/// friction.
bool bearsOnMirror(const ContactLaw& law, std::string_view option);

/// Whether the constants of a law mean the same under another value of an option: with another kind
/// of damper, say, they would have another unit, and others would be missing. Where a law resists
/// rolling or coheres, "none" is no such value: that is a missing effect.
bool constantsServe(const ContactLaw& law, std::string_view option, std::string_view value);

/// All that could be otherwise in this scene.
/// @param can  of the in-house engine
template <int D>
std::vector<MirrorChangeOf<D>> changesOf(const SceneOf<D>& scene, const Capabilities& can);

/// The constant that deviations are expressed in: k_n, of rigid disks e_n.
std::string referencePerturbationOf(const ContactLaw& law);

/// Basis of verdicts in a scene of that law.
LockstepRules lockstepRules(const ContactLaw& law);

/// Changes it by that part of itself.
void changeReference(ContactLaw& law, double by);

/// By disk, how far a unit of change of the reference constant moves it; 0 of a disk whose
/// responses are not in proportion (responsesAlike), or that does not move.
/// @param responses  how far each of referencePerturbations moves each disk, change by change [d]
/// @returns empty where they cannot be read: nothing moves, fewer than half of the disks that do
/// are in proportion, or one of these moves by largestResponse
std::vector<double> proportionalRates(const std::vector<double>& responses);

/// ε_eq: the change of the reference constant that parts the mirror from itself as far as the
/// engine is from it, root mean squares over the disks in proportion. A disk that is not counts
/// with what is beyond the largest of its responses: so far an event may have taken it.
/// @param apart  by disk [d]
/// @returns nothing where it cannot be read, likewise
std::optional<double> equivalentChange(const std::vector<double>& apart,
                                       const std::vector<double>& responses);

/// How much of a separation a change accounts for: for a constant the amount that fits best, in
/// least squares; another convention or a missing effect as it is.
/// @param separation, response  of all starts, one after the other; a constant's to termChange
template <int D>
NamedTerm asTerm(const MirrorChangeOf<D>& change, const std::vector<double>& separation,
                 const std::vector<double>& response);

/// The term that leaves least, if that is less than termUnexplained.
std::optional<NamedTerm> bestTerm(const std::vector<NamedTerm>& terms);

/// By which constants are changed to see how averages respond, relative: ten times what lockstep's
/// reference perturbation is read off at, so that it shows in averages.
inline constexpr double responseChange = 0.1;

/// A case with one constant of its law larger by responseChange.
struct ChangedCase {
  std::string constant;  ///< "kn"
  std::string name;      ///< of its runs, "kn+10%"
  Case setup;
};

/// Changes the reference constant, or µ, by that part of itself. @param constant  by name
void changeConstant(ContactLaw& law, const std::string& constant, double by);

/// The constant that ε_eq is expressed in, and µ where there is friction.
std::vector<ChangedCase> changedCases(const Case& setup);

}  // namespace crossgrain::inline studies
