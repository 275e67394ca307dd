#pragma once

#include <cstddef>
#include <vector>

#include "adapters/engine.hpp"

namespace crossgrain {

/// What the snapshots of one run are compared with: worked out once, so that an audit is cheap.
struct AuditBasis {
  const Scene* scene =
      nullptr;      ///< as the engine runs it; only its bodies and places are asked for
  double dt = 0.0;  ///< the engine's [s]; 0: not known, then times are not counted
  /// Whether a contact is a pair that overlaps at contactTime, as soft disks have it. Rigid disks
  /// show the pairs that an impulse passed between in the last step, while they moved on.
  bool byOverlap = true;
  /// Whether walls have moved as the scene prescribes since t = 0.
  bool prescribed = true;
  /// How far geometry worked out again may be off by rounding, of the farthest coordinate: 10⁶
  /// roundings of double precision, 10 of single.
  double rounding = 1e-10;

  std::vector<double> radius;  ///< disks, then wall disks [m]
  Vec2 middle = Vec2::Zero();  ///< of everything at t = 0 [m]
  double extent = 0.0;         ///< farthest from there that anything reaches at t = 0 [m]
  double farthest = 0.0;       ///< from the origin, rounding's measure [m]
  double fastest = 0.0;        ///< of what the scene starts or prescribes [m/s]
};

/// Of an engine that has loaded the scene, which outlives it.
AuditBasis auditBasis(const Scene& scene, const Capabilities& can,
                      const EffectiveParameters& effective);

/// Of snapshots of unknown origin: soft, single precision, nothing known of step and walls' motion.
AuditBasis auditBasis(const Scene& scene);

}  // namespace crossgrain
