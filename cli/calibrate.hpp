#pragma once

#include <optional>
#include <string>
#include <vector>

#include "oracle/calibration.hpp"

namespace crossgrain::inline cli {

/// What `crossgrain calibrate` was asked: wanted values, or constants, or a case file (which is in
/// CommandLine::inputs), and the pair that they are for. SI units.
struct CalibrationRequest {
  std::optional<double> en, et0, contactTime;
  std::optional<double> kn, gn, kt, gt;
  std::optional<double> mass, mass2, radius, radius2, inertiaFactor;
  std::optional<double> mu, vn;
  std::optional<std::string> tension, tangential;
};

/// The law as a [law] table that a case can take, every line that is not TOML a comment.
/// @param asked what it was made from, for the head
void printLaw(const ContactLaw& law, const std::string& asked);

/// What the law means for one pair, as comments.
/// @param vn speed of an impact, for its overlap [m/s]
void printImpact(const ContactLaw& law, const CollidingPair& pair, std::optional<double> vn);

struct NamedPair {
  std::string name;
  CollidingPair bodies;
};

/// What a head-on impact does to each pair under a law that stiffens. @param speed  v_n [m/s]
/// @throws std::invalid_argument where the pair does not part
std::vector<CollisionEnd> headOnImpacts(const ContactLaw& law, const std::vector<NamedPair>& pairs,
                                        double speed);
/// Of those one row for each pair.
void printStiffeningPairs(const std::vector<NamedPair>& pairs,
                          const std::vector<CollisionEnd>& ends, double speed);

/// One row for each pair, of the linear law.
void printPairs(const ContactLaw& law, const std::vector<NamedPair>& pairs,
                std::optional<double> vn);

}  // namespace crossgrain::inline cli
