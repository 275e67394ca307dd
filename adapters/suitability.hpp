#pragma once

#include <string>
#include <vector>

#include "adapters/engine.hpp"

namespace crossgrain {

/// One thing in which an engine cannot follow a scene.
struct Mismatch {
  std::string name;            ///< the effect or law option, as in `[run] may_differ`
  std::string reason;          ///< one clause: "always cuts tension", "has no bottom_friction"
  bool effectMissing = false;  ///< an effect that the engine cannot simulate at all
};

/// Refused for mismatches that a case may allow. What it says ends with how.
struct UnlistedDifferences : UnsupportedScene {
  UnlistedDifferences(std::string why, std::vector<std::string> unlisted);
  std::string reasons;             ///< without the advice
  std::vector<std::string> names;  ///< to be listed under [run] may_differ
};

/// Names for `[run] may_differ`, each once, of several conventions the word for all of them.
std::vector<std::string> briefly(const std::vector<std::string>& names);

/// In `[run] may_differ`: all conventions of the law.
inline constexpr const char* allConventionsName = "conventions";

/// In `[run] may_differ`: an engine of rigid contacts that has none runs a scene of e_t0 ≠ 0 with
/// 0.
inline constexpr const char* tangentialRestitutionName = "tangential_restitution";

/// Whether the engine has the normal law itself, not another one in its place.
bool hasNormalLaw(const Capabilities& can, const ContactLaw& law);

/// Everything in the scene that the engine cannot do as written. Empty: it can run it faithfully.
/// Where the engine lacks the normal law that is one mismatch, "normal", for the law as a whole:
/// its conventions, springs and dashpots have no meaning in the law that stands for it.
template <int D>
std::vector<Mismatch> mismatches(const Capabilities& can, const SceneOf<D>& scene);

/// The effects that the engine simulates in a scene: those called for, without those that it never
/// does. EffectiveParameters::effects of an adapted scene is this set.
template <int D>
Effects simulatedEffects(const Capabilities& can, const SceneOf<D>& scene);

/// The law with the conventions that the engine has in place of those it lacks: its first of each.
ContactLaw lawAsRun(const Capabilities& can, ContactLaw law);

/// The scene as this engine may run it: what it cannot do, and `mayDiffer` lists, is changed to
/// what the engine has, each change a deviation. A precision that the engine lacks is no reason to
/// refuse: it runs in its own.
template <int D>
struct AdaptedOf {
  SceneOf<D> scene;
  std::vector<Deviation> deviations;
};
using Adapted = AdaptedOf<2>;

/// @throws UnsupportedScene of a dimension or periodic directions that the engine does not have;
/// UnlistedDifferences naming every mismatch that is not in mayDiffer, and where to list them; or
/// what is then still beyond the engine's limits, which no case can have it run
template <int D>
AdaptedOf<D> adaptScene(const Capabilities& can, const SceneOf<D>& scene,
                        const std::vector<std::string>& mayDiffer);

}  // namespace crossgrain
