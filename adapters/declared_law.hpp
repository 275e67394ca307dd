#pragma once

#include <optional>

#include "adapters/engine.hpp"

namespace crossgrain {

/// A law whose contacts are `factor` times as stiff at the same restitution, so that they last
/// 1/√factor as long.
ContactLaw stiffened(ContactLaw law, double factor);

/// The law that an engine says it runs, between the two bodies of a collision scene, its first two:
/// the scene's, with
///   the engine's conventions in place of those that it lacks (lawAsRun()),
///   all constants as stiff as its deviation "stiffness" says,
///   and if it has rigid contacts in place of soft ones, e_n, e_t0 and µ of the pair as
///   EffectiveParameters has them.
/// Otherwise the constants are the scene's: an engine whose own differ is wrong, whatever it says.
/// Absent where it has another law whose constants are unknown.
/// @param scene  as the case lets the engine run it
template <int D>
std::optional<ContactLaw> declaredLaw(const Capabilities& can, const SceneOf<D>& scene,
                                      const EffectiveParameters& effective, double reducedMass);

/// The same of all pairs of a scene: rigid contacts have the means of e_n, e_t0 and µ over the
/// kinds of pairs.
std::optional<ContactLaw> declaredLaw(const Capabilities& can, const ContactLaw& law,
                                      const EffectiveParameters& effective);

}  // namespace crossgrain
