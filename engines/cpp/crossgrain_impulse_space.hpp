#pragma once

// Space of an engine of rigid contacts and impulses, as crossgrain_impulse_engine.hpp uses it.

#include <cstdint>
#include <functional>
#include <vector>

#include "crossgrain_scene.hpp"

namespace crossgrain_worker {

/// Impulse between two bodies in a step, in scenes with convex bodies at each of the points in
/// which they touch. Ids: disks, then wall disks, then planes, then cylinders; i < j.
template <int D>
struct PairImpulseOf {
  using Vector = VectorOf<D>;

  std::int32_t i, j;
  Vector normal;           ///< from j to i, as the engine had it
  double pressing;         ///< on i, along the normal [N s]
  TangentOf<D> along;      ///< on i, along z × normal, or normal to it in space [N s]
  Vector place;            ///< where j takes it; needed of walls and convex bodies alone [m]
  SpinOf<D> rolling = {};  ///< against rolling, on i; j takes as much the other way [N m s]
  double depth = 0.0;      ///< of the overlap there, where there are convex bodies [m]

  Vector onFirst() const { return pressing * normal + alongTangent(along, normal); }

  /// Impulse between any two, in either order: pressing and the part along z × their own normal are
  /// the same on both.
  static PairImpulseOf between(std::int32_t a, std::int32_t b, Vector normalToA, double pressing,
                               TangentOf<D> alongOnA, Vector placeOnA, Vector placeOnB,
                               SpinOf<D> rollingOnA = {}) {
    if (a < b) return {a, b, normalToA, pressing, alongOnA, placeOnB, rollingOnA};
    if constexpr (D == 3) alongOnA = -1.0 * alongOnA;
    return {b, a, -1.0 * normalToA, pressing, alongOnA, placeOnA, -1.0 * rollingOnA};
  }
};
using PairImpulse = PairImpulseOf<2>;

/// Scene and settings that a space is made from.
template <int D>
struct ImpulseSceneOf {
  std::vector<DiskOf<D>> disks;
  std::vector<BodyOf<D>>& walls;  ///< at t = 0; they outlive the space, which moves them
  double dt;                      ///< [s]
  double friction;                ///< µ of all pairs
  VectorOf<D> gravity;            ///< [m/s²]
  double smallest;                ///< radius; 1 m where there is no disk
  bool convex;                    ///< whether there are convex bodies
  /// e_n of two ids.
  std::function<double(std::int32_t, std::int32_t)> restitution;
  /// µ_r L of two ids [m]; empty where nothing resists rolling.
  std::function<double(std::int32_t, std::int32_t)> rolling;
  /// Value of a setting.
  std::function<double(const char*)> setting;
};
using ImpulseScene = ImpulseSceneOf<2>;

/// Disks, or spheres, and walls in SI units.
template <int D>
class ImpulseSpaceOf {
 public:
  ImpulseSpaceOf() = default;
  ImpulseSpaceOf(const ImpulseSpaceOf&) = delete;
  ImpulseSpaceOf& operator=(const ImpulseSpaceOf&) = delete;
  virtual ~ImpulseSpaceOf() = default;

  /// @param next  time after the step [s]; the walls are left there
  virtual void step(double next) = 0;

  virtual VectorOf<D> position(std::size_t disk) const = 0;
  virtual VectorOf<D> velocity(std::size_t disk) const = 0;
  virtual SpinOf<D> spin(std::size_t disk) const = 0;
  /// Called where there are convex bodies, which engines have that declare shapes.
  virtual OrientationOf<D> turn(std::size_t) const { return {}; }
  /// Impulses of the last step, in ascending order of ids.
  const std::vector<PairImpulseOf<D>>& impulses() const { return impulses_; }
  /// Deviations that the engine reports besides those of the law.
  virtual Json deviations() const { return Json::array(); }

 protected:
  std::vector<PairImpulseOf<D>> impulses_;  ///< which step() leaves
};
using ImpulseSpace = ImpulseSpaceOf<2>;

}  // namespace crossgrain_worker
