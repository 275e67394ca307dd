#pragma once

#include <functional>
#include <vector>

#include "adapters/engine.hpp"
#include "cases/case.hpp"
#include "results/causes.hpp"
#include "studies/causes/attribution.hpp"
#include "studies/causes/changes.hpp"

namespace crossgrain::inline studies {

/// One thing in which two ways of running a scene differ. @tparam Setup  a scene, or a case
template <class Setup>
struct Difference {
  CauseName words;
  std::function<void(Setup&)> take;  ///< makes the reference's like the peer's in this
};

/// In what two laws differ: options that bear on either, each by itself; constants, each by itself,
/// or all as one where one law is the other made stiffer; and together what means nothing apart: a
/// normal, tangential, rolling or cohesive law, or a kind of damper, with its constants; a
/// dashpot's place and what springs are set to at the bound.
template <class Setup>
std::vector<Difference<Setup>> lawDifferences(const ContactLaw& from, const ContactLaw& to);

/// In what two scenes of the same bodies differ, or two cases for the in-house engine: laws,
/// effects that are no matter of the law, time step. All of them taken, `from` is `to`.
/// @pre of cases: [engines.grain] has a dt
template <class Setup>
std::vector<Difference<Setup>> differencesOf(const Setup& from, const Setup& to);

/// Of all in which differencesOf() cases can differ.
std::string fingerprintOf(const Case& setup);

/// Setup with some differences taken, in their order; with all it is `to`.
template <class Setup>
Setup mixed(Setup from, const Setup& to, const std::vector<Difference<Setup>>& differences,
            Mixture mixture) {
  if (mixture + 1 == Mixture{1} << differences.size()) return to;
  for (std::size_t k = 0; k < differences.size(); ++k)
    if (mixture >> k & 1) differences[k].take(from);
  return from;
}

/// Names of the differences, before anything is run.
template <class Setup>
Causes causesOf(const std::vector<Difference<Setup>>& differences) {
  Causes causes;
  for (const Difference<Setup>& one : differences) causes.differences.push_back(one.words);
  return causes;
}

/// A peer as it behaves, beside a scene.
template <int D>
struct BehaviourOf {
  SceneOf<D> scene;
  std::vector<Difference<SceneOf<D>>> differences;  ///< taken, the other scene behaves like it
  Causes causes;                                    ///< what is to be said before anything is run
};

/// @param declared  the peer's scene as it declares to run it
/// @param changes   what it is seen to do otherwise: its differences are of what it does
template <int D>
BehaviourOf<D> behaviourOf(const SceneOf<D>& from, const SceneOf<D>& declared,
                           const std::vector<AppliedChangeOf<D>>& changes);

/// Adds what attribute() says of all numbers together.
void addFindings(Causes& causes, const Attribution& found);

}  // namespace crossgrain::inline studies
