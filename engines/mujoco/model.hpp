#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <ostream>
#include <vector>

#include <mujoco/mujoco.h>
#include "crossgrain_scene.hpp"

/// A scene of disks and walls as MuJoCo's model: spheres with two slides and a hinge, fixed planes.
/// Outside of this class everything is in SI units and in the protocol's ids: disks, then wall
/// disks, then planes.
namespace crossgrain_worker::mujoco {

/// Pair law by which every contact is set: f_n = k_n δ − γ_n δ̇, f_t = −γ_t v_t within µ f_n.
struct PairLaw {
  double kn, gn;  ///< [N/m], [kg/s]
  double gt, mu;  ///< [kg/s], [-]; 0: no friction
};

struct ModelOptions {
  double dt;         ///< [s]
  Vector gravity;    ///< [m/s²]
  bool rotation;     ///< false: disks keep their angle
  bool convex;       ///< whether there are convex bodies
  double impedance;  ///< MuJoCo's d, see README.md [-]
  double tolerance;  ///< of its solver [-]
  int iterations;    ///< most of its solver
  bool newton;       ///< its solver; else conjugate gradients
};

/// Force of one contact at the positions and velocities of now.
struct ContactForce {
  std::int32_t i, j;  ///< i < j, i a disk
  Vector normal;      ///< unit vector from j to i
  double overlap;     ///< [m]
  Vector onFirst;     ///< force on i [N]
  Vector point;       ///< where it acts: the middle of the overlap [m]
};

class Model {
 public:
  /// @throws std::runtime_error with MuJoCo's own words where it does not take the scene
  Model(const std::vector<Disk>& disks, const std::vector<Body>& bodies, const PairLaw& law,
        const ModelOptions& options);

  /// One step of semi-implicit Euler with the forces of now, walls as prescribed, then the forces
  /// there.
  void step(const std::vector<Body>& bodies);

  const std::vector<ContactForce>& contacts() const { return contacts_; }
  Vector position(std::size_t disk) const;
  Vector velocity(std::size_t disk) const;
  double spin(std::size_t disk) const;
  double turn(std::size_t disk) const;
  /// Of the solver, over all steps.
  long long iterations() const { return iterations_; }

 private:
  struct Deleter {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };

  void build(const std::vector<Disk>& disks, const std::vector<Body>& bodies);
  void writeMeshes(std::ostream& xml, const std::vector<Disk>& disks) const;
  void writeShape(std::ostream& xml, const Disk& disk, std::size_t number) const;
  void setState(const std::vector<Disk>& disks);
  void placeWalls(const std::vector<Body>& bodies);
  void findForces();
  void setContacts();
  void readContacts();
  void requireRoom() const;
  double inverseMass(std::int32_t id) const;

  PairLaw law_;
  ModelOptions options_;
  double length_ = 1.0, mass_ = 1.0;  ///< MuJoCo's units [m], [kg]
  std::size_t disks_ = 0;
  int freedoms_ = 3;              ///< of a disk
  std::vector<double> diskMass_;  ///< [kg]
  std::vector<int> movingBody_;   ///< by body: its first degree of freedom; −1: fixed
  std::vector<std::int32_t> idOfGeom_;
  std::unique_ptr<mjModel, Deleter> model_;
  std::unique_ptr<mjData, Deleter> data_;
  std::vector<ContactForce> contacts_;
  long long iterations_ = 0;
};

}  // namespace crossgrain_worker::mujoco
