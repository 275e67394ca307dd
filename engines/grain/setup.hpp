#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engines/grain/bottom.hpp"
#include "engines/grain/law.hpp"
#include "engines/grain/walls.hpp"

namespace grain {

/// State of disks, structure of arrays [SI units].
struct Disks {
  std::vector<double> x, y, vx, vy, spin, radius, mass, inertia;

  std::size_t size() const { return radius.size(); }
};

enum class Precision { float64, float32 };

/// Everything a simulation starts from.
struct Setup {
  Disks disks;
  std::vector<Wall> walls;
  ContactLaw law;
  std::optional<Materials> materials;  ///< where pairs differ: then `law` is of none
  std::optional<BottomPlate> bottom;
  double gravityX = 0.0, gravityY = 0.0;  ///< [m/s²]
  double dt = 0.0;                        ///< [s]
  bool rotation = true;                   ///< false: friction, but no disk turns about itself
  double skin = 0.0;                      ///< of the Verlet lists [m]; 0: tuned
  /// Overlaps beyond this many times the smaller radius end the run: at 1, the default, the centre
  /// of one disk lies inside the other, where no law of small overlaps means anything. 0: any, but
  /// for coincident centres, which have no normal. Looked at whenever near pairs are chosen anew,
  /// before two disks can come closer by half the skin.
  double maxOverlap = 1.0;
  Precision precision = Precision::float64;
  int threads = 1;
  bool ledger = false;          ///< keep an EnergyLedger, at every step's cost
  bool generalKernels = false;  ///< all options at run time: the reference of the specialised ones
};

/// One contact of the last force evaluation; the force acts on i, n points from j to i.
/// Numbers: disks as in Disks, then wall disks wall by wall, then planes wall by wall.
struct Contact {
  std::int32_t i, j;
  double nx, ny;
  double overlap;
  double normalForce, tangentialForce;
  double spring;  ///< ξ after the evaluation [m]
  bool sliding;
  double rollingTorque = 0.0;  ///< M on i, −M on j [N m]
  double angle = 0.0;          ///< θ after the evaluation [rad]
  bool rollingSlides = false;  ///< M is at its bound
  double memory = 0.0;         ///< as of contactForce() [1] or [m]
};

/// The same with i < j: the force acts on the lower number.
inline Contact fromLower(Contact contact) {
  if (contact.i < contact.j) return contact;
  std::swap(contact.i, contact.j);
  contact.nx = -contact.nx;
  contact.ny = -contact.ny;
  contact.rollingTorque = -contact.rollingTorque;
  contact.angle = -contact.angle;
  return contact;
}

}  // namespace grain
