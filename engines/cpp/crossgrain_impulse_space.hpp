#pragma once

// What an engine of rigid contacts and impulses brings to crossgrain_impulse_engine.hpp: its space.

#include <cstdint>
#include <functional>
#include <vector>

#include "crossgrain_scene.hpp"

namespace crossgrain_worker {

/// What passed between two in a step. Ids: disks, then wall disks, then planes; i < j.
struct PairImpulse {
  std::int32_t i, j;
  Vector normal;           ///< from j to i, as the engine had it
  double pressing, along;  ///< on i: along the normal and along z × normal [N s]
  Vector place;            ///< where j takes it; needed of walls alone [m]
  double rolling = 0.0;    ///< against rolling, on i; j takes as much the other way [N m s]

  Vector onFirst() const { return pressing * normal + along * turned(normal); }

  /// Of any two; pressing and along are the same on both.
  static PairImpulse between(std::int32_t a, std::int32_t b, Vector normalToA, double pressing,
                             double along, Vector placeOnA, Vector placeOnB,
                             double rollingOnA = 0.0) {
    return a < b ? PairImpulse{a, b, normalToA, pressing, along, placeOnB, rollingOnA}
                 : PairImpulse{b, a, -1.0 * normalToA, pressing, along, placeOnA, -rollingOnA};
  }
};

/// What a space is made of.
struct ImpulseScene {
  std::vector<Disk> disks;
  std::vector<Body>& walls;  ///< at t = 0; they outlive the space, which moves them
  double dt;                 ///< [s]
  double friction;           ///< µ of all pairs
  Vector gravity;            ///< [m/s²]
  double smallest;           ///< radius; 1 m where there is no disk
  /// e_n of two ids.
  std::function<double(std::int32_t, std::int32_t)> restitution;
  /// µ_r L of two ids [m]; empty where nothing resists rolling.
  std::function<double(std::int32_t, std::int32_t)> rolling;
  /// Value of a setting.
  std::function<double(const char*)> setting;
};

/// Disks and walls in SI units.
class ImpulseSpace {
 public:
  ImpulseSpace() = default;
  ImpulseSpace(const ImpulseSpace&) = delete;
  ImpulseSpace& operator=(const ImpulseSpace&) = delete;
  virtual ~ImpulseSpace() = default;

  /// @param next  time after the step [s]; the walls are left there
  virtual void step(double next) = 0;

  virtual Vector position(std::size_t disk) const = 0;
  virtual Vector velocity(std::size_t disk) const = 0;
  virtual double spin(std::size_t disk) const = 0;
  /// Of the last step, in ascending order of ids.
  const std::vector<PairImpulse>& impulses() const { return impulses_; }
  /// What Realised reports besides the law's own.
  virtual Json deviations() const { return Json::array(); }

 protected:
  std::vector<PairImpulse> impulses_;  ///< which step() leaves
};

}  // namespace crossgrain_worker
