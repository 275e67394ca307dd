#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "adapters/engine_entry.hpp"
#include "engines/grain/setup.hpp"

namespace crossgrain {

/// A scene in the in-house engine's own terms, on one thread, for those who drive the engine
/// without an adapter. Its law is one that the engine has.
grain::Setup setupOf(const Scene& scene);

/// Materials in the in-house engine's own terms.
std::optional<grain::Materials> grainMaterialsOf(const std::optional<Materials>& materials);

/// The in-house engine.
std::unique_ptr<Engine> makeGrain();

/// Law option → the values that an engine has, its own choice first.
using LawConventionSets = std::map<std::string, std::vector<std::string>>;

/// Declared conventions without the laws themselves, which the scene chooses.
LawConventionSets conventionsOf(LawConventionSets declared);

/// The in-house engine with a peer's conventions. Where it agrees with the peer, the peer differs
/// from the scene's law by its conventions alone; where it does not, an implementation is at fault.
std::unique_ptr<Engine> makeGrainMirror(LawConventionSets conventions);

/// Its entry. @param normals  EngineEntry::mirrorsNormal
EngineEntry mirrorEntry(std::string name, std::string summary, std::string peer,
                        std::vector<std::string> normals, LawConventionSets conventions);

/// The in-house engine with contacts `factor` times as stiff, for peers with rigid ones: k_n and
/// k_t grow by it, γ_n and γ_t by its root, so that restitutions stay, and the time step shrinks by
/// its root like the contact time.
std::unique_ptr<Engine> makeStiffGrain(double factor);

/// Starts the in-house engine or a mirror in the middle of a run: with springs stretched for the
/// tangential forces and torques of these contacts, as another engine reports them, bonds of JKR's
/// law where there are contacts, and velocities within a step. Largest overlaps of plastic
/// contacts, which no engine reports, are those of the instant. See
/// grain::Simulation::beginUnderWay().
/// @pre it has loaded a scene of soft disks and not yet advanced
/// @throws UnsupportedScene of any other engine
template <int D>
void beginUnderWay(Engine& inHouse, const ContactsOf<D>& contacts);

}  // namespace crossgrain
