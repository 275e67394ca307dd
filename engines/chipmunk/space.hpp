#pragma once

#include <chipmunk/chipmunk.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "crossgrain_walls.hpp"

namespace chipmunk_worker {

using crossgrain_worker::Body;
using crossgrain_worker::Vector;

struct Disk {
  double radius, mass, inertia;  ///< [m], [kg], [kg m²]; inertia INFINITY: its spin stays
  Vector position, velocity;
  double spin;
};

/// What passed between two in a step. Ids: disks, then wall disks, then planes; i < j.
struct PairImpulse {
  std::int32_t i, j;
  Vector onFirst;  ///< [N s]
};

struct SpaceOptions {
  double dt;        ///< [s]
  int iterations;   ///< of the solver
  double slop;      ///< overlaps up to this are left standing [m]
  double bias;      ///< what is left of a deeper overlap after a second
  double friction;  ///< µ of all pairs
  Vector gravity;   ///< [m/s²]
  /// e_n of two ids.
  std::function<double(std::int32_t, std::int32_t)> restitution;
};

/// Chipmunk's space, SI units, walls moved as prescribed. A step moves disks with the velocities
/// that they have, then solves for new ones where they are by then.
class Space {
 public:
  /// @param walls  at t = 0; outlives the space
  Space(const std::vector<Disk>& disks, std::vector<Body>& walls, SpaceOptions options);
  ~Space();
  Space(const Space&) = delete;
  Space& operator=(const Space&) = delete;

  /// @param next  time after the step [s]; the walls are left there
  void step(double next);

  Vector position(std::size_t disk) const;
  Vector velocity(std::size_t disk) const;
  double spin(std::size_t disk) const;
  /// Of the last step, in ascending order of ids.
  const std::vector<PairImpulse>& impulses() const { return impulses_; }

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
  void cover(PlaneShape& shape, const crossgrain_worker::Plane& plane) const;
  void add(cpShape* shape, bool wall);
  void placeWalls();
  cpBody* newWallBody(bool moves, Vector place);
  static void setPose(cpBody* body, Vector place, double angle, Vector velocity, double spin);
  void take(const cpArbiter* arbiter);

  static cpBool beforeSolving(cpArbiter* arbiter, cpSpace*, cpDataPointer self);
  static void afterSolving(cpArbiter* arbiter, cpSpace*, cpDataPointer self);

  SpaceOptions options_;
  std::vector<Body>& walls_;
  cpSpace* space_;
  std::vector<cpBody*> disks_;
  std::vector<double> radius_;
  std::vector<WallShapes> shapes_;  ///< by wall body
  double extent_;                   ///< how far anything reaches from the origin at the start [m]
  std::vector<cpBody*> allBodies_;
  std::vector<cpShape*> allShapes_;
  std::intptr_t nextId_ = 0;
  std::vector<PairImpulse> impulses_;
};

}  // namespace chipmunk_worker
