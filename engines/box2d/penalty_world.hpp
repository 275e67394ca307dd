#pragma once

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "engines/box2d/members.hpp"
#include "engines/box2d/soft_law.hpp"
#include "engines/box2d/world.hpp"

namespace box2d_granular {

/// Action of the disks on a wall: force [N] and torque about the wall's centre [N m].
struct WallLoad {
  Vector force;
  double torque = 0.0;
};

/// A pair of shapes that Box2D says are close, and its state at the last force evaluation.
struct SoftContact {
  std::int32_t i, j;
  double spring = 0.0;  ///< ξ [m], or the force [N]
  bool touching = false;
  PairGeometry geometry{};
  ContactForce force{};
};

/// Laws of pairs of materials.
struct PairLaws {
  std::vector<std::int32_t> material;  ///< of each id
  std::size_t count = 0;               ///< of materials
  std::vector<ContactLaw> laws;        ///< of materials a and b at a · count + b
};

/// Soft disks on Box2D's collision detection.
///
/// Box2D's float32 cannot carry such a law: at a time step of 4×10⁻⁵ s slow disks move less than it
/// resolves, and overlaps of 10⁻⁷ m vanish. So positions, velocities and spins are kept here in
/// double precision and moved by the semi-implicit Euler scheme that Box2D itself uses,
///
///   v += a dt   x += v dt   shapes to where the disks are (SetTransform)   b2World::Step(0)   a(x,
///   v)
///
/// Box2D supplies its dynamic tree, its contact list and the life of each contact, from
/// BeginContact to EndContact, to which the tangential spring is bound. A step of length zero does
/// exactly this: it looks for new pairs and updates all contacts, but leaves out islands and
/// solver, which would have nothing to solve and read the clock for every disk. Shapes are a skin
/// larger than the disks so that a contact begins before, and ends after, the disks themselves
/// touch.
class PenaltyWorld : private b2ContactListener {
 public:
  /// @param law    linear or Hertz', without rolling resistance and cohesion
  /// @param pairs  laws in place of `law`, which has the same parts
  PenaltyWorld(const Model& model, const ContactLaw& law, std::optional<BottomPlate> plate,
               std::optional<PairLaws> pairs = std::nullopt);

  void step();

  std::uint64_t steps() const { return steps_; }
  double time() const { return static_cast<double>(steps_) * dt_; }
  double dt() const { return dt_; }

  /// All at time(): Euler's velocities belong to the same time as its positions.
  const Members& members() const { return members_; }
  /// Of the force evaluation at time(); only those that are touching carry a force.
  std::span<const SoftContact> contacts() const { return contacts_; }

  std::vector<WallLoad> wallLoads() const;  ///< at time(), wall by wall

  double kineticEnergy() const;  ///< ½ m v² + ½ J ω² [J]
  double elasticEnergy() const;  ///< of contacts: storedEnergy() [J]

  std::uint64_t contactEvaluations() const { return contactEvaluations_; }

 private:
  void BeginContact(b2Contact* contact) override;
  void EndContact(b2Contact* contact) override;

  void integrate();
  void moveWalls();
  void showBox2d();
  void evaluateForces();
  template <bool Damped, TangentialLaw T>
  void addContactForces();
  const ContactLaw& lawOf(const SoftContact& contact) const;
  double radiusOf(const SoftContact& contact) const;
  double massOf(const SoftContact& contact) const;
  void addPlateForces();
  /// The arms of f_t about the two centres [m].
  struct Levers {
    double i, j;
  };
  Levers levers(const SoftContact& contact) const;
  Vector footOnPlane(const SoftContact& contact) const;
  Vector planeVelocity(const SoftContact& contact) const;

  ContactLaw law_;
  std::optional<PairLaws> pairs_;
  std::optional<BottomPlate> plate_;
  Vector gravity_;
  double dt_;
  bool rotation_;
  std::vector<Wall> walls_;
  std::vector<double> mass_, inertia_;
  Members members_;
  World world_;
  std::uint64_t steps_ = 0, contactEvaluations_ = 0;
  std::vector<SoftContact> contacts_;
  std::vector<const b2Contact*> owner_;  ///< of each element of contacts_
  std::unordered_map<const b2Contact*, std::size_t> slot_;
  std::vector<Vector> force_;        ///< on the disks [N]
  std::vector<double> torque_;       ///< likewise, with friction only [N m]
  std::vector<Vector> plateSpring_;  ///< likewise, on a plate only [m]
};

}  // namespace box2d_granular
