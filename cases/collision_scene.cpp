#include "cases/collision_scene.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "cases/materials.hpp"
#include "support/bad_input.hpp"

namespace crossgrain::inline cases {

namespace {

/// Of a body about z, in space the mean of its three [kg m²].
template <int D>
double momentOf(const DiskGroupOf<D>& body) {
  return D == 2 ? body.moments.z() : body.moments.mean();
}

double convexInertia(const Collision& c, int side) {
  if (const auto* const pair = std::get_if<ConvexPairOf<2>>(&c.convex))
    return momentOf(pair->body[side]);
  return momentOf(std::get<ConvexPairOf<3>>(c.convex).body[side]);
}

}  // namespace

CollidingPair collidingPair(const Case& setup) {
  const Collision& c = collisionIn(setup);
  const auto inertia = [&](int side) {
    if (c.isConvex()) return convexInertia(c, side);
    return c.inertiaFactor * c.mass[side] * c.radius[side] * c.radius[side];
  };
  if (c.wall) return diskOnWall(c.radius[0], c.mass[0], inertia(0));
  return {{c.radius[0], c.radius[1]}, {c.mass[0], c.mass[1]}, {inertia(0), inertia(1)}};
}

std::vector<CollisionStart> collisionStarts(const Case& setup) {
  const Collision& c = collisionIn(setup);
  std::vector<CollisionStart> starts;
  const auto add = [&](const std::vector<double>& speeds, bool whole) {
    for (const double speed : speeds)
      for (const double spin : c.counterSpin)
        for (const double own : c.spin)
          for (const double orientation : c.orientation)
            for (const double psi : c.psi)
              starts.push_back({psi,
                                whole ? speed / std::hypot(1.0, psi) : speed,
                                c.approach,
                                spin,
                                0.0,
                                {c.spinOutOfPlane[0], c.spinOutOfPlane[1]},
                                orientation,
                                own});
  };
  c.vn.empty() ? add({c.speed}, true) : add(c.vn, false);
  return starts;
}

namespace {

void addDisk(Disks& disks, const CollidingPair& pair, int side, const Vec2& position,
             const Vec2& velocity, double spin) {
  disks.radius.push_back(pair.radius[side]);
  disks.mass.push_back(pair.mass[side]);
  disks.inertia.push_back(pair.inertia[side]);
  disks.position.push_back(position);
  disks.velocity.push_back(velocity);
  disks.spin.push_back(spin);
}

template <int D>
WallBodyOf<D> movingWall(const VecOf<D>& normal, const VecOf<D>& velocity) {
  WallBodyOf<D> wall;
  wall.name = "wall";
  wall.planes.push_back({VecOf<D>::Zero(), normal});
  if (!velocity.isZero(0.0)) {
    wall.motion.kind = Motion::Kind::translating;
    wall.motion.velocity = velocity;
  }
  return wall;
}

/// All of a sweep's scene but the bodies that meet.
template <int D>
SceneOf<D> emptyScene(const Case& setup, double dt) {
  SceneOf<D> scene;
  scene.name = setup.name;
  scene.law = setup.law;
  scene.bottom = setup.bottom;
  scene.precision = setup.run.precision;
  scene.energyLedger = setup.run.energyLedger;
  scene.dt = dt;
  return scene;
}

/// Where the pairs of a sweep are, side by side [m].
std::vector<Vec2> placesOf(const CollidingPair& pair, std::size_t count) {
  const double reach = pair.radius[0] + pair.radius[1];
  const double spacing = 3.0 * std::max(2.0 * std::max(pair.radius[0], pair.radius[1]), reach);
  const std::size_t columns =
      pair.plane ? 1 : static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
  const double middle = 0.5 * static_cast<double>(columns - 1);
  std::vector<Vec2> places;
  for (std::size_t k = 0; k < count; ++k)
    places.emplace_back((static_cast<double>(k % columns) - middle) * spacing,
                        (static_cast<double>(k / columns) - middle) * spacing);
  return places;
}

/// Whatever the case's dimension: in space it is turned afterwards.
Scene planarScene(const Case& setup, const std::vector<CollisionStart>& starts, double dt) {
  const Collision& collision = collisionIn(setup);
  const CollidingPair pair = collidingPair(setup);
  const double reach = pair.radius[0] + pair.radius[1];
  Scene scene = emptyScene<2>(setup, dt);
  if (pair.plane) scene.bodies.push_back(movingWall<2>(Vec2::UnitX(), collision.wallVelocity));
  const std::vector<Vec2> places = placesOf(pair, starts.size());
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const Vec2& centre = places[k];
    const PairMotion motion = motionBefore(pair, starts[k]);
    const Vec2 velocity(motion.normal, motion.tangential);
    const Vec2 apart = Vec2(reach, 0.0) - collision.startPhase * dt * velocity;
    if (pair.plane) {
      addDisk(scene.disks, pair, 0, centre + apart, velocity + collision.wallVelocity,
              motion.spin[0]);
      continue;
    }
    const double massSum = pair.mass[0] + pair.mass[1];
    for (const int side : {0, 1}) {
      const double fraction = (side == 0 ? 1.0 : -1.0) * pair.mass[1 - side] / massSum;
      addDisk(scene.disks, pair, side, centre + fraction * apart, fraction * velocity,
              motion.spin[side]);
    }
  }
  return scene;
}

/// The same orientation turned on by a vector of rotation, in the plane an angle [rad].
template <int D>
TurnOf<D> turnedBy(const TurnOf<D>& turn, const SpinOf<D>& by) {
  if constexpr (D == 2) {
    return turn + by;
  } else {
    if (by.isZero(0.0)) return turn;
    const Eigen::Quaterniond on =
        Eigen::Quaterniond(Eigen::AngleAxisd(by.norm(), by.normalized())) *
        Eigen::Quaterniond(turn[0], turn[1], turn[2], turn[3]);
    return {on.w(), on.x(), on.y(), on.z()};
  }
}

/// [m/s]
template <int D>
VecOf<D> inFrame(const Vec2& planar) {
  VecOf<D> vector = VecOf<D>::Zero();
  vector.template head<2>() = planar;
  return vector;
}

/// Every start of a sweep, so much before its touch, over which spins are as they are then; and all
/// of it turned as the case says.
template <int D>
SceneOf<D> convexScene(const Case& setup, const std::vector<CollisionStart>& starts, double dt) {
  const Collision& collision = collisionIn(setup);
  const auto& pair = std::get<ConvexPairOf<D>>(collision.convex);
  const auto placed = [turn = turnOf(setup)](const VecOf<D>& v) -> VecOf<D> {
    if constexpr (D == 3)
      return turn * v;
    else
      return v;
  };
  const auto turnOn = [&](const SpinOf<D>& by) -> SpinOf<D> {
    if constexpr (D == 3)
      return placed(by);
    else
      return by;
  };
  SpinOf<D> whole = noSpin<D>();
  if constexpr (D == 3) whole = collision.turn;
  SceneOf<D> scene = emptyScene<D>(setup, dt);
  const VecOf<D> wall = inFrame<D>(collision.wallVelocity);
  if (collision.wall)
    scene.bodies.push_back(movingWall<D>(placed(VecOf<D>::UnitX()), placed(wall)));
  for (const auto& body : pair.body)
    if (body.shape) scene.shapes.push_back(*body.shape);
  const std::vector<Vec2> places = placesOf(collidingPair(setup), starts.size());
  const double flight = collision.startPhase * dt;
  DisksOf<D>& all = scene.disks;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const ConvexTouchOf<D> touch = convexTouch<D>(setup, starts[k]);
    const DisksOf<D>& two = touch.bodies;
    for (std::size_t i = 0; i < two.size(); ++i) {
      const VecOf<D> position = inFrame<D>(places[k]) + two.position[i] - flight * two.velocity[i];
      all.radius.push_back(two.radius[i]);
      all.mass.push_back(two.mass[i]);
      all.inertia.push_back(two.inertia[i]);
      all.position.push_back(placed(position));
      all.velocity.push_back(placed(two.velocity[i] + wall));
      all.spin.push_back(turnOn(two.spin[i]));
      all.shape.push_back(two.shape[i]);
      all.turn.push_back(turnedBy<D>(turnedBy<D>(two.turn[i], -flight * two.spin[i]), whole));
      if constexpr (D == 3) all.moments.push_back(two.moments[i]);
    }
  }
  return scene;
}

}  // namespace

template <int D>
ConvexTouchOf<D> convexTouch(const Case& setup, const CollisionStart& start) {
  const Collision& c = collisionIn(setup);
  const auto& pair = std::get<ConvexPairOf<D>>(c.convex);
  ConvexTouchOf<D> touch;
  DisksOf<D>& bodies = touch.bodies;
  VecOf<D> arm[2] = {VecOf<D>::Zero(), pair.arm};
  for (const int side : {0, 1}) {
    if (side == 1 && c.wall) break;
    const DiskGroupOf<D>& group = pair.body[side];
    TurnOf<D> turn = group.turn;
    SpinOf<D> spin;
    const double about = side == 0 ? start.spin : 0.0;
    if constexpr (D == 2) {
      spin = about;
      if (side == 0) turn += start.orientation;
    } else {
      spin << start.spinOutOfPlane[side], about;
      if (side == 0) turn = turnedBy<3>(turn, start.orientation * pair.axis);
      bodies.moments.push_back(group.moments);
    }
    if (side == 0) {
      const CornerOf<D> corner = cornerTowards<D>(*group.shape, turn, -VecOf<D>::UnitX());
      arm[0] = corner.arm;
      touch.next = corner.next * std::min(1.0, pair.room / (2.0 * group.radius));
    }
    bodies.radius.push_back(group.radius);
    bodies.mass.push_back(group.mass);
    bodies.inertia.push_back(momentOf(group));
    bodies.position.push_back(-arm[side]);
    bodies.velocity.push_back(VecOf<D>::Zero());
    bodies.spin.push_back(spin);
    bodies.shape.push_back(group.shape ? side : -1);
    bodies.turn.push_back(turn);
    touch.impact.body[side] = impactBody<D>(bodies, static_cast<std::size_t>(side), arm[side]);
  }
  touch.impact.normal = VecOf<D>::UnitX();
  touch.impact.restitution = setup.law.en;
  touch.impact.mu = setup.law.mu;
  // u = v_0 + ω_0 × r_0 − v_1 − ω_1 × r_1, with velocities that are 0 so far.
  auto& [first, second] = touch.impact.body;
  const VecOf<D> apart = inFrame<D>(start.vn * Vec2(-1.0, start.psi)) - velocityAtContact(first) +
                         velocityAtContact(second);
  const double share = c.wall ? 1.0 : second.mass / (first.mass + second.mass);
  first.velocity = bodies.velocity[0] = share * apart;
  if (!c.wall) second.velocity = bodies.velocity[1] = (share - 1.0) * apart;
  return touch;
}
template ConvexTouchOf<2> convexTouch<2>(const Case&, const CollisionStart&);
template ConvexTouchOf<3> convexTouch<3>(const Case&, const CollisionStart&);

template <int D>
double freeFlight(const ConvexTouchOf<D>& touch, const ConvexImpact<D>& impact, double speed) {
  const auto size = [](const SpinOf<D>& spin) {
    if constexpr (D == 2)
      return std::abs(spin);
    else
      return spin.norm();
  };
  double fastest = 0.0;  // of one body's points against the other's
  const auto take = [&](const ImpactOutcome<D>& after) {
    const CollisionEnd end = convexEnd<D>(touch.impact, after.velocity, after.spin);
    const double out = end.outOfPlane ? end.outOfPlane->psi : 0.0;
    fastest = std::max(
        fastest, speed * std::hypot(end.en, end.psi, out) +
                     2.0 * touch.bodies.radius[0] * (size(after.spin[0]) + size(after.spin[1])));
  };
  if (impact.newton) take(*impact.newton);
  take(impact.poisson);
  take(impact.stronge);
  return touch.next / fastest;
}
template double freeFlight(const ConvexTouchOf<2>&, const ConvexImpact<2>&, double);
template double freeFlight(const ConvexTouchOf<3>&, const ConvexImpact<3>&, double);

Scene collisionScene(const Case& setup, const std::vector<CollisionStart>& starts, double dt) {
  if (setup.dimension != 2)
    throw BadInput(
        fmt::format("{}: collide and check alone know collisions in space "
                    "(case.dimension = 3)",
                    setup.file.string()));
  if (collisionIn(setup).isConvex()) return convexScene<2>(setup, starts, dt);
  return planarScene(setup, starts, dt);
}

Eigen::Matrix3d turnOf(const Case& setup) {
  const Vec3& turn = collisionIn(setup).turn;
  if (turn.isZero(0.0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
}

SpaceScene spaceCollisionScene(const Case& setup, const std::vector<CollisionStart>& starts,
                               double dt) {
  if (collisionIn(setup).isConvex()) return convexScene<3>(setup, starts, dt);
  const Scene plane = planarScene(setup, starts, dt);
  const Eigen::Matrix3d turn = turnOf(setup);
  const auto placed = [&](const Vec2& v) -> Vec3 { return turn * Vec3(v.x(), v.y(), 0.0); };
  const std::size_t spheres = plane.bodies.empty() ? 2 : 1;  // of each collision
  SpaceScene scene;
  scene.name = plane.name;
  scene.law = plane.law;
  scene.precision = plane.precision;
  scene.energyLedger = plane.energyLedger;
  scene.dt = plane.dt;
  scene.disks.radius = plane.disks.radius;
  scene.disks.mass = plane.disks.mass;
  scene.disks.inertia = plane.disks.inertia;
  for (std::size_t i = 0; i < plane.disks.size(); ++i) {
    const Vec2& besides = starts[i / spheres].spinOutOfPlane[i % spheres];
    scene.disks.position.push_back(placed(plane.disks.position[i]));
    scene.disks.velocity.push_back(placed(plane.disks.velocity[i]));
    scene.disks.spin.push_back(turn * Vec3(besides.x(), besides.y(), plane.disks.spin[i]));
  }
  for (const WallBody& body : plane.bodies) {
    WallBodyOf<3>& wall = scene.bodies.emplace_back();
    wall.name = body.name;
    for (const Plane& each : body.planes)
      wall.planes.push_back({placed(each.point), placed(each.normal)});
    wall.motion.kind = body.motion.kind;
    wall.motion.velocity = placed(body.motion.velocity);
  }
  return scene;
}

namespace {

/// Bodies that are alike.
struct Kind {
  std::string name;
  double radius, mass;  ///< [m], 0 of a plane; [kg], inf of walls
  const MaterialName& material;
  double inertia(double factor) const { return factor * mass * radius * radius; }
};

/// Every disk with every other kind of disk and of wall.
/// @param disks  how many of the kinds are disks, the first ones
std::vector<NamedPair> pairsOfKinds(const Case& setup, const std::vector<Kind>& kinds,
                                    std::size_t disks, double inertiaFactor) {
  std::vector<NamedPair> pairs;
  for (std::size_t i = 0; i < disks; ++i)
    for (std::size_t j = i; j < kinds.size(); ++j) {
      const Kind &one = kinds[i], &two = kinds[j];
      const CollidingPair bodies =
          two.radius == 0.0
              ? diskOnWall(one.radius, one.mass, one.inertia(inertiaFactor))
              : CollidingPair{{one.radius, two.radius},
                              {one.mass, two.mass},
                              {one.inertia(inertiaFactor), two.inertia(inertiaFactor)}};
      pairs.push_back({fmt::format("{}-{}", one.name, two.name), bodies,
                       lawOf(setup, one.material, two.material)});
    }
  return pairs;
}

/// Of an assembly: groups of equal disks are one kind, and so are walls.
std::vector<NamedPair> pairsOfAssembly(const Case& setup) {
  std::vector<Kind> kinds;
  const auto add = [&](const char* name, double radius, double mass, const MaterialName& material) {
    const auto same = [&](const Kind& kind) {
      return kind.radius == radius && kind.mass == mass && kind.material.name == material.name;
    };
    if (std::ranges::any_of(kinds, same)) return;
    kinds.push_back({fmt::format("{}{}", name, kinds.size() + 1), radius, mass, material});
  };
  return withAssembly(setup, [&](const auto& assembly) {
    for (const auto& group : assembly.disks) add("disk", group.radius, group.mass, group.material);
    if (!assembly.starts.disks.empty()) {
      const auto& disks = assembly.starts.disks.front();
      const auto [smallest, largest] = std::ranges::minmax_element(disks.radius);
      for (const auto each : {smallest, largest})
        add("disk", *each, disks.mass[static_cast<std::size_t>(each - disks.radius.begin())],
            assembly.starts.material);
    }
    const std::size_t disks = kinds.size();
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const auto& wall : assembly.walls) {
      if (!wall.planes.empty()) add("plane", 0.0, infinite, wall.material);
      if (!wall.position.empty() && wall.radii.empty())
        add("wall", wall.radius, infinite, wall.material);
      for (const double radius : wall.radii) add("wall", radius, infinite, wall.material);
    }
    return pairsOfKinds(setup, kinds, disks, assembly.inertiaFactor);
  });
}

}  // namespace

std::vector<NamedPair> pairsOf(const Case& setup) {
  if (isCollision(setup)) return {{"i-j", collidingPair(setup), setup.law}};
  if (isAssembly(setup)) return pairsOfAssembly(setup);
  const Particles& p = couetteIn(setup).particles;
  std::vector<Kind> kinds;
  if (p.small > 0 || p.file)
    kinds.push_back({"small", p.smallRadius, p.smallMass, p.smallMaterial});
  if (p.large > 0 || p.file)
    kinds.push_back({"large", p.largeRadius, p.largeMass, p.largeMaterial});
  const std::size_t disks = kinds.size();
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Cell& cell = couetteIn(setup).cell;
  const bool alike = cell.wheelMaterial.name == cell.ringMaterial.name;
  kinds.push_back({alike ? "wall" : "wheel", cell.wallRadius, infinite, cell.wheelMaterial});
  if (!alike) kinds.push_back({"ring", cell.wallRadius, infinite, cell.ringMaterial});
  return pairsOfKinds(setup, kinds, disks, p.inertiaFactor);
}

template <int D>
SceneOf<D> sweepScene(const Case& setup, const std::vector<CollisionStart>& starts, double dt) {
  if constexpr (D == 2)
    return collisionScene(setup, starts, dt);
  else
    return spaceCollisionScene(setup, starts, dt);
}

template Scene sweepScene<2>(const Case&, const std::vector<CollisionStart>&, double);
template SpaceScene sweepScene<3>(const Case&, const std::vector<CollisionStart>&, double);

}  // namespace crossgrain::inline cases
