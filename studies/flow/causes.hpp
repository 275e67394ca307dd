#pragma once

#include <map>
#include <string>
#include <vector>

#include "results/causes.hpp"
#include "results/endpoints.hpp"
#include "results/lockstep_findings.hpp"
#include "studies/causes/differences.hpp"
#include "studies/flow/campaign.hpp"

namespace crossgrain::inline studies {

/// The scene, its bodies at any places, for the in-house engine to run as another one runs it: its
/// law, as it declares it, its time step, without the effects that it lacks. Rigid contacts in
/// place of soft ones have the means of the restitutions and of µ that it reports over kinds of
/// pairs.
/// @param dt  the case's time step [s]
/// @throws UnsupportedScene saying why there is no such scene, or no case of it
template <int D>
SceneOf<D> sceneAsRun(const Case& setup, double dt, const EngineEntry& entry,
                      const Capabilities& can, const EffectiveParameters& effective);

/// By engine, the term by which lockstep found its law to differ from the one that it declares.
using UndeclaredTerms = std::map<std::string, NamedTerm>;

/// Causes of the differences of every two peers that show one of at least a hundredth of a margin:
/// those from the reference first, of these the largest, on the packings of one interim analysis
/// after the other; before them, where the first has more, on four. Of a neutral campaign every
/// engine's from the in-house one.
///
/// With a packing's values v(S) of an endpoint under mixtures S of both engines' laws, run by the
/// in-house engine, on the scale of its test (its logarithm where engines are compared by their
/// ratio), attribute() gives parts of v(all) − v(0), all mixtures of up to two differences (six of
/// closed forms), else both ends. The remainder is what is then left of b − a. So on every packing,
/// and in their means,
///
///     whole = Σ parts + interaction + remainder.
///
/// Logarithms become the unit's by one factor, that which takes the mean whole log-ratio to
/// inUnit(): parts go on to add up, and an interval holds 0 as it did. Intervals of wholes are
/// those of the endpoints' verdicts, at the level of an interim analysis. Parts are named, as
/// *disagree* is said, with a chance of at most α that any of a pair is there by accident: those of
/// all its endpoints are one family under Holm's procedure, in interim analyses of two tails, and
/// an interval leaves out 0 exactly where that rejects it. Bins of a field are a family of their
/// own. Where a mirror stands for an engine, intervals of whole and remainder are wider by its
/// bound. Fewer than four packings give none.
///
/// @param campaign  over, its results taken: the in-house engine may be added to it
/// @param undeclared  causes are of what an engine does: a constant or convention of its law is one
///                  of them, `declared` = false; of other terms the remainder keeps what they do
/// @param field     whose bins are taken apart as well, of every engine against the reference;
///                  empty: none
/// @param until     no runs begin that would end later than this after the campaign began [s]; what
///                  is left out is said in PairCauses::missing. Finished runs cost nothing
std::vector<PairCauses> causesOfPairs(Campaign& campaign, const Case& setup,
                                      const RunCommand& command, const EndpointFindings& found,
                                      double until, const UndeclaredTerms& undeclared = {},
                                      const std::string& field = {});

}  // namespace crossgrain::inline studies
