#pragma once

#include <ode/ode.h>

#include <vector>

#include "crossgrain_impulse_space.hpp"

namespace crossgrain_worker::ode {

/// ODE's world of spheres, whose centres stay at z = 0 in the plane; SI units, walls moved as
/// prescribed. A step finds who overlaps, solves for the contact forces that give wanted
/// velocities, and moves disks with these.
template <int D>
class Space : public ImpulseSpaceOf<D> {
 public:
  explicit Space(const ImpulseSceneOf<D>& scene);
  ~Space() override;

  void step(double next) override;
  VectorOf<D> position(std::size_t disk) const override;
  VectorOf<D> velocity(std::size_t disk) const override;
  SpinOf<D> spin(std::size_t disk) const override;
  OrientationOf<D> turn(std::size_t disk) const override;

 private:
  using Vector = VectorOf<D>;

  struct Touch {
    std::int32_t i, j;
    dContactGeom geometry;  ///< normal from j to i
  };

  void addDisk(const DiskOf<D>& disk);
  dGeomID createShape(const DiskOf<D>& disk);
  void addWall(dGeomID shape);
  void placeWalls();
  void findTouches();
  void setDirections(const Touch& touch, dContact& contact) const;
  dContact contactOf(const Touch& touch) const;
  Vector wallVelocity(std::int32_t wall, Vector place) const;
  void requirePlane() const;

  static void near(void* space, dGeomID a, dGeomID b);
  void addConvex(dGeomID a, dGeomID b);

  ImpulseSceneOf<D> scene_;
  int iterations_;
  double erp_;
  bool alongSlip_;
  double bounceThreshold_;
  dWorldID world_;
  dSpaceID shapes_;
  dJointGroupID contacts_;
  std::vector<dBodyID> disks_;
  std::vector<std::vector<double>> corners_;  ///< of polyhedra, which ODE reads here
  std::vector<bool> turns_;
  std::vector<dGeomID> wallShapes_;  ///< wall disks, then planes, then cylinders
  /// Of each of these: its body, and its number among the body's disks, planes or cylinders.
  std::vector<std::pair<const BodyOf<D>*, std::size_t>> wallParts_;
  std::size_t wallDisks_ = 0, planesEnd_ = 0;
  std::vector<Touch> touches_;
  std::vector<dJointFeedback> forces_;
};

}  // namespace crossgrain_worker::ode
