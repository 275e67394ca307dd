#include "studies/cost/collision_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "adapters/declared_law.hpp"
#include "adapters/grain_space.hpp"
#include "cases/collision_scene.hpp"
#include "cases/flow.hpp"
#include "cases/time_step.hpp"
#include "oracle/collision_end.hpp"

namespace crossgrain::inline studies {

namespace {

/// On a wall disk or a plane.
bool isOnWall(const Case& collision) {
  return std::isinf(collisionIn(collision).mass[1]);
}

/// Calls work with a planar scene as engines run it: in space at z = 0, where all that moves stays
/// in that plane.
auto withRunScene(const Case& setup, const Scene& scene, auto&& work) {
  return setup.dimension == 3 ? work(inSpace(scene)) : work(scene);
}

EffectiveParameters loadPlanar(Engine& engine, const EngineEntry& entry, const Case& setup,
                               const Scene& scene) {
  return withRunScene(setup, scene,
                      [&](const auto& run) { return loadScene(engine, entry, setup, run); });
}

bool areAlike(const Case& one, const Case& other) {
  const Collision &a = collisionIn(one), &b = collisionIn(other);
  return std::ranges::equal(a.radius, b.radius) && std::ranges::equal(a.mass, b.mass) &&
         a.vn == b.vn && one.law == other.law;
}

/// Speeds of a kind of pair. Under a linear law without cohesion everything in a collision is in
/// proportion to v_n, but for what its normal turns, so that one speed is enough.
std::vector<double> speedsOf(const Cost& cost, const PairImpacts* seen, const ContactLaw& law) {
  if (cost.speed) return {*cost.speed};
  double median = cost.quietSpeed, fast = cost.quietSpeed;
  if (!seen && !cost.impacts.empty())  // a kind that did not meet: as the most frequent one
    seen = &*std::ranges::max_element(cost.impacts, {}, &PairImpacts::contacts);
  if (seen) median = seen->median, fast = seen->fast;
  const bool depends = law.stiffens() || law.coheres();
  return depends && fast > median ? std::vector{median, fast} : std::vector{median};
}

}  // namespace

std::vector<Case> collisionsOf(const Case& setup) {
  constexpr int mostOfOthers = 9;
  const Cost& cost = setup.cost;
  std::vector<Case> all;
  for (const NamedPair& named : pairsOf(setup)) {
    const auto found = std::ranges::find(cost.impacts, named.name, &PairImpacts::pair);
    const PairImpacts* const seen = found == cost.impacts.end() ? nullptr : &*found;
    for (const double speed : speedsOf(cost, seen, named.law)) {
      Case pair = setup;
      pair.name = named.name;
      pair.law = named.law;
      pair.materials.reset();
      pair.bottom.reset();
      Collision& collision = pair.source.emplace<Collision>();
      for (const int side : {0, 1}) {
        collision.radius[side] = seen ? seen->radius[side] : named.bodies.radius[side];
        collision.mass[side] = seen ? seen->mass[side] : named.bodies.mass[side];
      }
      collision.wall = named.bodies.plane;
      collision.inertiaFactor = inertiaFactorOf(setup);
      collision.vn = {speed};
      collision.approach = isOnWall(pair) ? Approach::firstSpin : Approach::spin;
      if (std::ranges::any_of(all, [&](const Case& one) { return areAlike(one, pair); })) continue;
      const int count = all.empty() ? cost.psiCount : std::min(cost.psiCount, mostOfOthers);
      collision.psi.clear();
      for (int k = 0; k < count; ++k) collision.psi.push_back(cost.psiMax * k / (count - 1));
      // A collision has a number of steps of its own: that which makes the case's step.
      collision.stepsPerContact = {impactTimes(pair).shortest / timeStep(setup)};
      all.push_back(std::move(pair));
    }
  }
  return all;
}

Case collisionOf(const Case& setup) {
  Case first = collisionsOf(setup).front();
  first.name = setup.name;
  return first;
}

CollisionReference collisionReference(const Case& setup) {
  CollisionReference reference;
  for (Case& pair : collisionsOf(setup)) {
    const auto starts = collisionStarts(pair);
    OracleCurve oracle = oracleCurve(pair, starts);
    reference.pairs.push_back({std::move(pair), starts, std::move(oracle)});
  }
  return reference;
}

double cycleStep(double step, double contactTime, int j) {
  const double perContact = contactTime / step;
  const double cycle = std::min(1.0, perContact / 10.0);
  return contactTime / (perContact + cycle * j / cycleSteps);
}

double phaseOf(std::size_t k) {
  const double place = (static_cast<double>(k) + 0.5) / std::numbers::phi;
  return place - std::floor(place);
}

namespace {

/// A collision's place in a scene of many.
struct PlacedCollision {
  std::size_t pair = 0, start = 0;
  std::size_t disk = 0;  ///< i; j follows, unless it is of the wall
  Vec2 centre = Vec2::Zero(), apart = Vec2::Zero();
  PairMotion motion = {};
};

/// Room for a collision: two disks beside each other, a diameter of the larger away from others.
struct Room {
  double width, height;
};
Room roomOf(const CollidingPair& bodies) {
  const double largest = std::max(bodies.radius[0], bodies.radius[1]);
  return {2.0 * (bodies.radius[0] + bodies.radius[1]) + 2.0 * largest, 4.0 * largest};
}

/// Collisions of pairs under one law in a scene, row by row in a square about the origin, as
/// engines in single precision round places the more the farther out they are.
struct PairScene {
  Scene scene;
  std::vector<PlacedCollision> placed;

  PairScene(const std::vector<Case>& collisions, const std::vector<std::size_t>& pairs,
            const CollisionReference& reference, double step, std::size_t first) {
    const Case& common = collisions[pairs.front()];
    scene.name = common.name;
    scene.law = common.law;
    scene.precision = common.run.precision;
    scene.energyLedger = common.run.energyLedger;
    scene.dt = timeStep(common);
    place(collisions, pairs, reference);
    for (PlacedCollision& one : placed) {
      const CollidingPair bodies = collidingPair(collisions[one.pair]);
      one.motion = motionBefore(bodies, reference.pairs[one.pair].starts[one.start]);
      const Vec2 velocity(one.motion.normal, one.motion.tangential);
      one.apart =
          Vec2(bodies.radius[0] + bodies.radius[1], 0.0) - phaseOf(first++) * step * velocity;
      addBodies(one, bodies, velocity);
    }
    if (!wall_.diskPosition.empty() || !wall_.planes.empty())
      scene.bodies.push_back(std::move(wall_));
  }

  /// From a snapshot after all of them.
  std::optional<CollisionOutcome> outcomeOf(const PlacedCollision& one, const Case& collision,
                                            const CollisionStart& start, const ContactLaw& law,
                                            const Snapshot& after) const {
    const CollidingPair bodies = collidingPair(collision);
    Scene both;
    both.law = law;
    Snapshot then;
    then.positionTime = after.positionTime;
    then.spin.emplace();
    for (const int side : {0, 1}) {
      const bool onWall = side == 1 && isOnWall(collision);
      if (onWall && bodies.plane) {
        both.bodies.push_back(scene.bodies.front());
        break;
      }
      const std::size_t i = one.disk + static_cast<std::size_t>(side);
      both.disks.radius.push_back(bodies.radius[side]);
      both.disks.mass.push_back(bodies.mass[side]);
      both.disks.inertia.push_back(bodies.inertia[side]);
      both.disks.position.push_back(onWall ? one.centre : scene.disks.position[i]);
      both.disks.velocity.push_back(onWall ? Vec2::Zero() : scene.disks.velocity[i]);
      both.disks.spin.push_back(onWall ? 0.0 : scene.disks.spin[i]);
      then.position.push_back(onWall ? one.centre : after.position[i]);
      then.velocity.push_back(onWall ? Vec2::Zero() : after.velocity[i]);
      then.spin->push_back(onWall ? 0.0 : (after.spin ? *after.spin : scene.disks.spin)[i]);
    }
    const auto end = collisionEnd(both, then, 0, start);
    return end ? std::optional(CollisionOutcome{*end, {}}) : std::nullopt;
  }

 private:
  void place(const std::vector<Case>& collisions, const std::vector<std::size_t>& pairs,
             const CollisionReference& reference) {
    double area = 0.0, height = 0.0;
    for (const std::size_t pair : pairs) {
      const Room room = roomOf(collidingPair(collisions[pair]));
      const auto starts = static_cast<double>(reference.pairs[pair].starts.size());
      area += starts * room.width * room.height;
      height += starts * room.height;
    }
    const bool onPlane = collidingPair(collisions[pairs.front()]).plane;  // all in one column
    const double side = onPlane ? height : std::sqrt(area);
    double x = 0.0, y = 0.0, row = 0.0;
    for (const std::size_t pair : pairs) {
      const Room room = roomOf(collidingPair(collisions[pair]));
      for (std::size_t k = 0; k < reference.pairs[pair].starts.size(); ++k) {
        if (x >= (onPlane ? 0.0 : side)) x = 0.0, y += row, row = 0.0;
        row = std::max(row, room.height);
        PlacedCollision& one = placed.emplace_back();
        one.pair = pair;
        one.start = k;
        one.centre = {onPlane ? 0.0 : x + 0.5 * room.width - 0.5 * side, y - 0.5 * side};
        x += room.width;
      }
    }
  }

  void addBodies(PlacedCollision& one, const CollidingPair& bodies, const Vec2& velocity) {
    one.disk = scene.disks.size();
    const bool onWall = std::isinf(bodies.mass[1]);
    const double shareOfFirst = onWall ? 1.0 : bodies.mass[1] / (bodies.mass[0] + bodies.mass[1]);
    const auto add = [&](int side, double share) {
      scene.disks.radius.push_back(bodies.radius[side]);
      scene.disks.mass.push_back(bodies.mass[side]);
      scene.disks.inertia.push_back(bodies.inertia[side]);
      scene.disks.position.push_back(one.centre + share * one.apart);
      scene.disks.velocity.push_back(share * velocity);
      scene.disks.spin.push_back(one.motion.spin[side]);
    };
    add(0, shareOfFirst);
    if (!onWall) {
      add(1, shareOfFirst - 1.0);
      return;
    }
    wall_.name = "wall";
    if (bodies.plane) {
      if (wall_.planes.empty()) wall_.planes.push_back({Vec2::Zero(), Vec2::UnitX()});
      return;
    }
    wall_.diskPosition.push_back(one.centre);
    wall_.diskRadius.push_back(bodies.radius[1]);
  }

  WallBody wall_;
};

/// Pairs under one law after the other, those under the first one first; those on a plane, which
/// reaches everywhere, by themselves.
std::vector<std::vector<std::size_t>> pairsByLaw(const std::vector<Case>& collisions) {
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t p = 0; p < collisions.size(); ++p) {
    const auto same = std::ranges::find_if(groups, [&](const auto& group) {
      return collisions[group.front()].law == collisions[p].law &&
             collisionIn(collisions[group.front()]).wall == collisionIn(collisions[p]).wall;
    });
    (same == groups.end() ? groups.emplace_back() : *same).push_back(p);
  }
  return groups;
}

}  // namespace

PairOutcomes runPairs(Engine& engine, const EngineEntry& entry, const std::vector<Case>& collisions,
                      const CollisionReference& reference, double step, std::size_t first) {
  PairOutcomes outcomes;
  for (const PairCurve& pair : reference.pairs) outcomes.of.emplace_back(pair.starts.size());
  const Capabilities can = engine.capabilities();
  for (const std::vector<std::size_t>& group : pairsByLaw(collisions)) {
    const PairScene pairs(collisions, group, reference, step, first);
    first += pairs.placed.size();
    const Case& common = collisions[group.front()];
    const EffectiveParameters effective = loadPlanar(engine, entry, common, pairs.scene);
    const ContactLaw law = withRunScene(common, pairs.scene, [&](const auto& run) {
      return sceneFor(can, entry, common, run).scene.law;
    });
    outcomes.dt = effective.dt;
    double end = 0.0;
    for (const std::size_t pair : group)
      end = std::max(end, sweepEnd(collisions[pair], pairs.scene.dt, effective.dt));
    engine.advance(end);
    const Stats stats = engine.stats();
    outcomes.seconds += stats.wallSeconds;
    outcomes.steps = std::max(outcomes.steps, stats.steps);
    const Snapshot after = common.dimension == 3
                               ? inPlane(engine.snapshotInSpace(ContactReport::none))
                               : engine.snapshot(ContactReport::none);
    for (const PlacedCollision& one : pairs.placed)
      outcomes.of[one.pair][one.start] = pairs.outcomeOf(
          one, collisions[one.pair], reference.pairs[one.pair].starts[one.start], law, after);
  }
  return outcomes;
}

std::optional<ContactLaw> lawDeclared(Engine& engine, const EngineEntry& entry,
                                      const Case& collision,
                                      const std::vector<CollisionStart>& starts) {
  const CollisionReference alone{{{collision, starts, {}}}};
  const Scene scene = PairScene({collision}, {0}, alone, timeStep(collision), 0).scene;
  const EffectiveParameters effective = loadPlanar(engine, entry, collision, scene);
  const Capabilities can = engine.capabilities();
  const double mass = collidingPair(collision).reducedMass();
  return withRunScene(collision, scene, [&](const auto& run) {
    return declaredLaw(can, sceneFor(can, entry, collision, run).scene, effective, mass);
  });
}

}  // namespace crossgrain::inline studies
