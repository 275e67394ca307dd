#pragma once

#include <string>
#include <vector>

#include "adapters/engine.hpp"

/// The laws that checks try, of those that an engine declares, each with constants under which its
/// parts show in a collision of small disks at Encounter::speed.
namespace crossgrain::conformance {

/// Constants of dashpots that take away about as much, whatever they multiply: e_n is between 0.2
/// and 0.9.
void setDampers(ContactLaw& law, const std::string& damper);

/// That normal law with the engine's own conventions.
ContactLaw lawOf(const Capabilities& can, const std::string& normal);

/// The law that resists rolling like that: with spins of some 10 rad/s springs stick and slip.
/// Constants are in the units of the conventions that it has.
ContactLaw withRolling(ContactLaw law, RollingLaw rolling);

/// The law with that attraction: a fifth of the largest force, area two fifths of the stiffness.
ContactLaw withCohesion(ContactLaw law, CohesionLaw cohesion);

/// Kinds of rolling resistance and of cohesion that the engine declares; empty: none.
std::vector<RollingLaw> rollingLaws(const Capabilities& can);
std::vector<CohesionLaw> cohesionLaws(const Capabilities& can);

/// Whether that attraction goes with the law's elastic force: JKR's is one of Hertz' law.
bool goesWith(CohesionLaw cohesion, NormalLaw normal);

/// Every law with rolling resistance and every one with cohesion, each with the first normal law
/// that it goes with, alone and with rolling resistance where the engine has both.
std::vector<ContactLaw> resistingLaws(const Capabilities& can);

/// A scene that calls for every effect there is: of a soft law that also resists rolling and
/// coheres, as the engine does where it does.
/// @param law  its soft part; of a rigid one the thesis' law stands for it
Scene fullScene(const Capabilities& can, const ContactLaw& law);

}  // namespace crossgrain::conformance
