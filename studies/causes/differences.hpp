#pragma once

#include <functional>
#include <vector>

#include "adapters/engine.hpp"
#include "results/lockstep_findings.hpp"
#include "studies/causes/attribution.hpp"
#include "studies/causes/changes.hpp"

namespace crossgrain::inline studies {

/// One thing in which two ways of running a scene differ.
template <int D>
struct DifferenceOf {
  CauseName words;
  std::function<void(SceneOf<D>&)> take;  ///< makes the reference's like the peer's in this
};

/// In what two laws differ: options that bear on either, each by itself; constants, each by itself,
/// or all as one where one law is the other made stiffer; and together what means nothing apart: a
/// normal, tangential, rolling or cohesive law, or a kind of damper, with its constants; a
/// dashpot's place and what springs are set to at the bound.
template <int D>
std::vector<DifferenceOf<D>> lawDifferences(const ContactLaw& from, const ContactLaw& to);

/// In what two scenes of the same bodies differ: laws, effects that are no matter of the law, time
/// step. All of them taken, `from` is `to`.
template <int D>
std::vector<DifferenceOf<D>> differencesOf(const SceneOf<D>& from, const SceneOf<D>& to);

/// Of all in which differencesOf() scenes can differ.
template <int D>
std::string fingerprintOf(SceneOf<D> scene);

/// Scene with some differences taken, in their order; with all it is `to`.
template <int D>
SceneOf<D> mixed(SceneOf<D> from, const SceneOf<D>& to,
                 const std::vector<DifferenceOf<D>>& differences, Mixture mixture) {
  if (mixture + 1 == Mixture{1} << differences.size()) return to;
  for (std::size_t k = 0; k < differences.size(); ++k)
    if (mixture >> k & 1) differences[k].take(from);
  return from;
}

/// The change of a scene that a term names; none: null, or it names none.
/// @param can  of the in-house engine
template <int D>
std::vector<AppliedChangeOf<D>> changesNamed(const NamedTerm* term, const SceneOf<D>& scene,
                                             const Capabilities& can);

/// A peer as it behaves, beside a scene.
template <int D>
struct BehaviourOf {
  SceneOf<D> scene;
  std::vector<DifferenceOf<D>> differences;  ///< taken, the other scene behaves like it
  Causes causes;                             ///< what is to be said before anything is run
};

/// @param declared  the peer's scene as it declares to run it
/// @param changes   what it is seen to do otherwise: its differences are of what it does
template <int D>
BehaviourOf<D> behaviourOf(const SceneOf<D>& from, const SceneOf<D>& declared,
                           const std::vector<AppliedChangeOf<D>>& changes);

}  // namespace crossgrain::inline studies
