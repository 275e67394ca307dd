#pragma once

#include <chipmunk/chipmunk.h>

#include <cstdint>
#include <vector>

#include "crossgrain_impulse_space.hpp"

namespace crossgrain_worker::chipmunk {

/// Chipmunk's space, SI units, walls moved as prescribed. A step moves disks with the velocities
/// that they have, then solves for new ones where they are by then.
class Space : public ImpulseSpace {
 public:
  explicit Space(const ImpulseScene& scene);
  ~Space() override;

  void step(double next) override;
  Vector position(std::size_t disk) const override;
  Vector velocity(std::size_t disk) const override;
  double spin(std::size_t disk) const override;
  double turn(std::size_t disk) const override;
  Json deviations() const override;

 private:
  /// A segment that stays before the disks which could touch it, whatever the way that they or the
  /// wall go: planes are infinite.
  struct PlaneShape {
    cpBody* body;
    cpShape* shape;
    Vector normal;  ///< at t = 0
    Vector at;      ///< place of the body, on the plane [m]
    double half;    ///< length [m]
  };
  struct WallShapes {
    std::vector<cpBody*> disks;  ///< each by itself, so that a ring can shrink
    std::vector<PlaneShape> planes;
  };

  void addDisk(const Disk& disk);
  void addWall(Body& wall);
  void setEnds(const PlaneShape& plane) const;
  void cover(PlaneShape& shape, const Plane& plane) const;
  void add(cpShape* shape, bool wall);
  void placeWalls();
  cpBody* newWallBody(bool moves, Vector place);
  static void setPose(cpBody* body, Vector place, double angle, Vector velocity, double spin);
  void take(const cpArbiter* arbiter);

  static cpBool beforeSolving(cpArbiter* arbiter, cpSpace*, cpDataPointer self);
  static void afterSolving(cpArbiter* arbiter, cpSpace*, cpDataPointer self);

  ImpulseScene scene_;
  std::vector<Body>& walls_;
  double slop_;  ///< overlaps up to this are left standing [m]
  cpSpace* space_;
  std::vector<cpBody*> disks_;
  std::vector<double> radius_;
  std::vector<WallShapes> shapes_;  ///< by wall body
  double extent_;                   ///< how far anything reaches from the origin at the start [m]
  std::vector<cpBody*> allBodies_;
  std::vector<cpShape*> allShapes_;
  std::intptr_t nextId_ = 0;
};

}  // namespace crossgrain_worker::chipmunk
