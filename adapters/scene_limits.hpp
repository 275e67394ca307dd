#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adapters/scene.hpp"

namespace crossgrain {

/// Limits on an engine's scenes besides its effects and its law, declared before any is loaded: a
/// scene beyond them is refused before anything starts. Where a limit is absent, every scene
/// is allowed, or the engine refuses it itself.
struct SceneLimits {
  std::optional<std::vector<double>> inertia;             ///< q of J = q m a² that disks may have
  std::optional<std::vector<Motion::Kind>> wallMotions;   ///< of bodies with wall disks
  std::optional<std::vector<Motion::Kind>> planeMotions;  ///< of those with planes; empty: none
  bool cylinders = false;                                 ///< bodies may have cylinders
  std::vector<ShapeKind> shapes;  ///< that moving bodies may have besides disks and spheres
  int mostVertices = 1000;        ///< of a polygon or polyhedron
  bool rounded = false;           ///< polygons may be rounded
  bool planesAlongAxes = false;  ///< planes have normals along axes (±x, ±y, ±z) alone, to the bit
  /// Of rigid contacts: each body has one restitution, so that a soft law, whose restitution
  /// depends on the masses of the pair, cannot be stood for where pairs differ.
  bool restitutionPerBody = false;
};

/// Whether disks may have J = q m a², to within roundings.
bool hasInertia(const SceneLimits& limits, double q);

/// Features of a scene that are beyond them, a clause each; empty: none.
/// @param softLawStoodFor  the engine has rigid contacts in place of the scene's law
template <int D>
std::vector<std::string> beyondLimits(const SceneLimits& limits, const SceneOf<D>& scene,
                                      bool softLawStoodFor);

/// The first number of a scene that single precision cannot hold, or square, in a unit of about the
/// smallest radius: such engines end with an assertion, or take a mass that is rounded to nothing
/// for another. Empty: none.
std::string beyondSinglePrecision(const Scene& scene);

}  // namespace crossgrain
