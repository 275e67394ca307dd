#pragma once

#include <array>
#include <functional>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "engines/box2d/members.hpp"
#include "engines/box2d/restitution.hpp"
#include "engines/box2d/world.hpp"
#include "engines/cpp/crossgrain_point_sums.hpp"

namespace box2d_granular {

struct ImpulseOptions {
  double friction = 0.0;  ///< µ
  /// e_n and e_t0 of the disk i with j, asked for when they begin to touch.
  std::function<Restitution(std::int32_t i, std::int32_t j)> restitution;
  /// Approach speed below which a beginning contact is taken for an enduring one that the position
  /// solver had pushed apart, and gets no tangential restitution [m/s].
  double impactSpeed = 0.0;
  int velocityIterations = 8;
  int positionIterations = 3;
};

/// Impulse that j gave i: `normal` along n (from j to i), `tangential` along z × n [N s].
struct PairImpulse {
  std::int32_t i, j;
  double normal, tangential;
};

/// Impulse of the disks on a wall [N s] and about its centre [N m s].
struct WallImpulse {
  Vector linear;
  double angular = 0.0;
};

/// Rigid disks under Box2D's own solver, extended by tangential restitution: Box2D drives the
/// contact point's tangential velocity to the contact's "tangent speed" within the friction it has,
/// so a contact that begins with v_t is given the tangent speed −e_t0 v_t for that one step.
/// Sticking then gives Ψ_f = −e_t0 Ψ_i, sliding Ψ_i − K(1 + e_n)µ (Walton; Luding 1998).
///
/// Box2D mixes friction by square root and restitution by maximum and ignores restitution below
/// one unit a second: all three are set contact by contact. What is left of that threshold is the
/// speed that gravity gives in two steps: the solver ends before the contacts of a stack all rest,
/// and rebounds of what is left would keep it warm and take its friction away step by step.
class ImpulseWorld : private b2ContactListener {
 public:
  ImpulseWorld(const Model& model, ImpulseOptions options);

  void step();

  std::uint64_t steps() const { return steps_; }
  double time() const { return static_cast<double>(steps_) * dt_; }
  double dt() const { return dt_; }

  /// Disks as Box2D has them, walls as prescribed, both at time(). Velocities of disks likewise.
  const Members& members();

  /// Impulses of the last step, of the pairs that touched at its beginning.
  std::span<const PairImpulse> lastImpulses() const { return last_; }
  std::span<const WallImpulse> lastWallImpulses() const { return lastOnWalls_; }

  /// Impulses summed since the last clearSums(), a pair's in the frame that turns along with it.
  std::vector<PairImpulse> sums() const;
  std::span<const WallImpulse> wallSums() const { return sumOnWalls_; }

  /// In scenes with convex bodies, instead of lastImpulses() and sums(): by i and j what the points
  /// of a pair got together [N s].
  using PairPoints =
      std::map<std::pair<std::int32_t, std::int32_t>, crossgrain_worker::PointSumsOf<2>>;
  const PairPoints& lastPoints() const { return lastPoints_; }
  const PairPoints& pointSums() const { return pointSums_; }

  std::uint64_t sumSteps() const { return steps_ - sumsFrom_; }
  void clearSums();

  std::uint64_t contactEvaluations() const { return contactEvaluations_; }  ///< touching, per step
  std::uint64_t impacts() const { return impacts_; }  ///< contacts given tangential restitution
  double restSpeed() const { return restSpeed_; }     ///< slower impacts do not rebound [m/s]

 private:
  /// Of a wall, over a step: velocity of its centre [m/s] and spin [rad/s].
  struct Motion {
    Vector velocity;
    double spin = 0.0;
  };
  /// A contact that the solver is about to see, with the geometry it will use.
  struct Touching {
    b2Contact* contact;
    std::int32_t i, j;
    Vector normal;                                   ///< from j to i
    int count;                                       ///< of points, 2 at most
    std::array<Vector, b2_maxManifoldPoints> point;  ///< [m]
    std::array<double, b2_maxManifoldPoints> depth;  ///< of the overlap there [m]
  };

  void BeginContact(b2Contact* contact) override;
  void PreSolve(b2Contact* contact, const b2Manifold* old) override;
  void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;
  void actBeforeTheKick(const Touching& touch);
  void setWallsMoving();
  void harvest();
  void addToSum(const PairImpulse& impulse);
  void addToPoints(const PairImpulse& impulse, const Touching& touch, std::size_t point);

  ImpulseOptions options_;
  double dt_;
  Vector gravity_;
  double restSpeed_;
  std::vector<Wall> walls_;
  Members members_;
  World world_;
  std::vector<Motion> ahead_, behind_;  ///< of walls, in this step and the last
  std::uint64_t steps_ = 0, sumsFrom_ = 0, contactEvaluations_ = 0, impacts_ = 0;
  std::vector<Touching> touching_;
  std::vector<b2Contact*> turnedBack_;  ///< contacts that hold a tangent speed in this step
  std::vector<b2Contact*> oneOfTwo_;    ///< of two points as good as one: the first alone acts
  std::vector<PairImpulse> last_;
  std::vector<WallImpulse> lastOnWalls_, sumOnWalls_;
  std::vector<std::vector<PairImpulse>> sums_;  ///< by i, which is always a disk
  PairPoints lastPoints_, pointSums_;
};

}  // namespace box2d_granular
