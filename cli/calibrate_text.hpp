#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"
#include "cases/collision_scene.hpp"

/// Output of calibrate: TOML that a case can take, all else as comments.
namespace crossgrain::inline cli {

/// The law as a [law] table that a case can take, every line that is not TOML a comment.
/// @param asked  what it was made from, for the head
std::string lawText(const ContactLaw& law, const std::string& asked);

/// Rolling resistance as lines of such a table, and its meaning for a pair, if one is asked.
/// @throws std::invalid_argument for a pair that does not oscillate
std::string rollingText(const ContactLaw& law, const std::optional<CollidingPair>& pair);

/// The same of cohesion by a work of adhesion. @param reducedRadius  R₁₂ [m]
std::string cohesionText(const ContactLaw& law, double reducedRadius);

/// The laws of materials that differ from [law], as tables likewise.
std::string materialsText(const Case& setup);

/// Meaning of the law for one pair, as comments. @param vn  of an impact, for its overlap [m/s]
std::string impactText(const ContactLaw& law, const CollidingPair& pair, std::optional<double> vn);

/// Outcome of a head-on impact of each pair under a law that stiffens. @param speed  v_n [m/s]
/// @throws std::invalid_argument where the pair does not part
std::string stiffeningPairsText(const std::vector<NamedPair>& pairs, double speed);

/// One row for each pair, of the linear law.
std::string pairsText(const std::vector<NamedPair>& pairs, std::optional<double> vn);

}  // namespace crossgrain::inline cli
