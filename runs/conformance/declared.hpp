#pragma once

#include <string>
#include <vector>

#include "adapters/engine.hpp"

/// What an engine declares, by names: each is examined by some check, or reported as not examined.
namespace crossgrain::conformance {

inline const std::string planes = "planes";
inline const std::string slantingPlanes = "slanting planes";
inline const std::string planesAlongThemselves = "planes that move along themselves";
inline const std::string checkpoints = "checkpoints";
inline const std::string slidingFlags = "sliding flags";
inline const std::string instantContacts = "instant contacts";
inline const std::string accumulatedContacts = "accumulated contacts";
inline const std::string warmHandover = "warm hand-over";
inline const std::string energyLedger = "energy ledger";
inline const std::string tangentialRestitution = "tangential restitution";
inline const std::string severalSizes = "several sizes";
inline const std::string manyDisks = "many disks";
inline const std::string farPlaces = "places far from the origin";
inline const std::string lateTimes = "late times";

std::string planeMotion(Motion::Kind kind);         ///< "planes: rotating"
std::string wallMotion(Motion::Kind kind);          ///< "walls: rotating"
std::string settingNamed(const std::string& name);  ///< "setting skin, other than its default"
std::string precisionNamed(Precision precision);    ///< "precision float"

/// Why nothing is asked of what is none of it: "declares no checkpoints".
std::string undeclared(const std::string& capability);

/// All of it: effects, each value of each law option, planes and walls with each motion, what it
/// shows, precisions, settings; and what no engine may lack, several sizes, many disks, places far
/// off and late times. What limits do not exclude is declared.
std::vector<std::string> declaredBy(const Capabilities& can);

}  // namespace crossgrain::conformance
