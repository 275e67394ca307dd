#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/engine.hpp"
#include "adapters/engine_entry.hpp"
#include "adapters/grain.hpp"
#include "adapters/registry.hpp"
#include "adapters/suitability.hpp"
#include "cases/case.hpp"

namespace crossgrain::inline studies {

/// Capabilities of an engine, asked once in the life of this program. Absent if it cannot be
/// started.
std::optional<Capabilities> capabilitiesOf(const EngineEntry& entry, double timeout);

/// The scene that a mirror is given: the one that its peer runs. Effects that the peer lacks are
/// gone, its conventions stand in place of those that it lacks, and its time step is taken, so that
/// no difference between the two is due to the model. All of it follows from the peer's
/// capabilities.
/// Where the peer has another normal law (soft contacts that stand for rigid ones) law and step are
/// the mirror's own, as contacts of another kind need another step.
///
/// The mirror's precision stays its own: a peer's rounding is the peer's implementation.
/// Deviations say what came from the peer, in the peer's words.
/// @throws UnsupportedScene if the case does not let the peer run it
template <int D>
AdaptedOf<D> sceneOfPeer(const EngineEntry& mirror, const Case& setup, const SceneOf<D>& scene);

/// Adds an engine of the user's own to the registry. addMirrors() adds its mirror: the in-house
/// engine with the conventions that the engine declares.
/// @returns its name
std::string addExternalEngine(EngineEntry entry);

/// The same for an engine that came with the program as a file, unless it has a mirror; for "all",
/// for each of them that can be started.
void addMirrorOfShelved(const std::string& name);

/// Adds the mirrors that are missing. Each engine is started once to be asked; one that does not
/// answer, or has no soft law, gets no mirror, and reports that itself where it is used.
/// @param timeout  longest wait for an answer [s]: the case's, where there is one
void addMirrors(double timeout = 60.0);

/// Conventions from the command line of such a mirror's worker, "lever_arm=radius,contact_point".
LawConventionSets conventionsFromWords(const std::vector<std::string>& words);

/// The conventions in which engines would differ from the defaults that the case leaves, and which
/// all of them can share: those that the case neither gives nor lists in `may_differ`, of which an
/// engine lacks the default, and of which all have one value, the first of the first engine's.
/// Engines without the case's normal law have no say: they refuse it or convert it. A value of
/// which an engine would lack something else, a lever arm that makes `plane_arm` matter, is not
/// taken: who can run the case as it is can run it with what is shared.
/// @returns overrides, "law.tension=\"cut\"", in the order of lawOptions(); none where nothing has
/// to be changed, or where engines share no value, which they then refuse in their own words
std::vector<std::string> sharedConventions(const Case& setup, const std::vector<Capabilities>& all);

/// The same of engines by the names that a user gave, two or more, which are started to be asked
/// where the case leaves a convention open. One that does not start and runs that are files have no
/// say; of "all" engines nothing is shared.
std::vector<std::string> sharedConventionsOf(const Case& setup,
                                             const std::vector<std::string>& engines);

/// "conventions that all engines named share: law.tension="cut", …", one line for people.
/// @pre there are some
std::string describeShared(const std::vector<std::string>& shared);

/// Puts what engines share behind the overrides of a command, and says so in a line.
/// @returns whether there was any, so that the case has to be loaded with it
bool shareConventions(const Case& setup, const std::vector<std::string>& engines,
                      std::vector<std::string>& overrides);

}  // namespace crossgrain::inline studies
