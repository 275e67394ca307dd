// Convex bodies on a plane, and free: impacts at one corner against the oracle, rest, sliding and
// rotation against closed forms.
#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <tuple>

#include "oracle/convex_impact.hpp"
#include "studies/conformance/check_context.hpp"

namespace crossgrain::conformance {
namespace {

constexpr double side = 0.1, meetingSpeed = 0.1;  // [m, m/s]
constexpr double away = 10.0 * side;              // from one body to the next [m]

/// A body of each kind whose moments differ: boxes are no squares or cubes.
template <int D>
ShapeOf<D> oblong(ShapeKind kind = D == 2 ? ShapeKind::polygon : ShapeKind::box) {
  ShapeOf<D> shape{kind, {}, 0.0};
  const VecOf<D> end = 0.4 * side * VecOf<D>::Unit(D == 2 ? 0 : 2);
  if (kind == ShapeKind::capsule || kind == ShapeKind::cylinder) {
    shape.vertices = {-end, end};
    shape.rounding = 0.25 * side;
  } else if constexpr (D == 2) {
    const double a = 0.5 * side, b = 0.3 * side;
    shape.vertices = {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
  } else if (kind == ShapeKind::polyhedron) {
    for (const Vec3& corner : {Vec3(0.6, 0.0, -0.2),
                               {-0.4, 0.4, -0.3},
                               {-0.3, -0.5, -0.2},
                               {0.1, 0.1, 0.7},
                               {0.5, 0.5, 0.2}})
      shape.vertices.push_back(side * corner);
    intoOwnFrame(shape);
  } else {
    for (int k = 0; k < 8; ++k)
      shape.vertices.push_back(0.5 * side *
                               Vec3(k & 1 ? 1.0 : -1.0, k & 2 ? 0.7 : -0.7, k & 4 ? 0.5 : -0.5));
  }
  return shape;
}

/// Rigid contacts without gravity above a plane, up along the last axis.
template <int D>
SceneOf<D> aboveAPlane(const CheckContext& c, const ShapeOf<D>& shape, double e, double mu) {
  c.needs(convexBodies(shape.kind));
  SceneOf<D> scene;
  scene.name = "convex bodies above a plane";
  ContactLaw law;
  law.dimension = D;
  law.normal = NormalLaw::rigid;
  law.en = e;
  law.mu = mu;
  scene.law = followed(c.can, law);
  if (scene.law.soft()) c.skip("has no rigid contacts, which these closed forms are of");
  scene.dt = 5e-4;
  scene.shapes = {shape};
  scene.bodies.resize(1);
  scene.bodies[0].name = "floor";
  scene.bodies[0].planes = {{VecOf<D>::Zero(), VecOf<D>::Unit(D - 1)}};
  return scene;
}

template <int D>
void addConvex(SceneOf<D>& scene, const VecOf<D>& place, const TurnOf<D>& turn,
               const VecOf<D>& velocity, const SpinOf<D>& spin) {
  DisksOf<D>& disks = scene.disks;
  const ShapeMassOf<D> spread = massOf(scene.shapes[0]);
  constexpr double mass = 0.5;
  if constexpr (D == 3) {
    disks.moments.push_back(mass * momentsPerMass(spread));
    disks.inertia.push_back(disks.moments.back().mean());
  } else {
    disks.inertia.push_back(mass * momentsPerMass(spread));
  }
  disks.radius.push_back(scene.shapes[0].reach());
  disks.mass.push_back(mass);
  disks.position.push_back(place);
  disks.velocity.push_back(velocity);
  disks.spin.push_back(spin);
  disks.shape.push_back(0);
  disks.turn.push_back(turn);
}

/// The lowest point of a body.
template <int D>
CornerOf<D> lowestCorner(const SceneOf<D>& scene, std::size_t i) {
  return cornerTowards<D>(scene.shapes[0], scene.disks.turn[i], -VecOf<D>::Unit(D - 1));
}

/// Bodies in poses of all kinds, each with one corner a step and a half of flight above the plane.
template <int D>
SceneOf<D> falling(const CheckContext& c, ShapeKind kind, double e, double mu) {
  SceneOf<D> scene = aboveAPlane<D>(c, oblong<D>(kind), e, mu);
  std::mt19937_64 generator(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  while (scene.disks.size() < 8) {
    const std::size_t i = scene.disks.size();
    TurnOf<D> turn;
    SpinOf<D> spin;
    VecOf<D> velocity = -meetingSpeed * VecOf<D>::Unit(D - 1);
    for (int k = 0; k < D - 1; ++k) velocity[k] = meetingSpeed * unit(generator);
    if constexpr (D == 2) {
      turn = 3.0 * unit(generator);
      spin = meetingSpeed / side * unit(generator);
    } else {
      turn = Eigen::Vector4d(unit(generator), unit(generator), unit(generator), unit(generator))
                 .normalized();
      spin = meetingSpeed / side * Vec3(unit(generator), unit(generator), unit(generator));
    }
    addConvex<D>(scene, static_cast<double>(i) * away * VecOf<D>::UnitX(), turn, velocity, spin);
    const auto [corner, next] = lowestCorner(scene, i);
    if (next < 0.1 * side) {  // soon another corner would meet the plane
      DisksOf<D>& disks = scene.disks;
      const auto drop = [](auto&... lists) { (lists.pop_back(), ...); };
      drop(disks.radius, disks.mass, disks.inertia, disks.position, disks.velocity, disks.spin,
           disks.shape, disks.turn);
      if constexpr (D == 3) disks.moments.pop_back();
      continue;
    }
    scene.disks.position[i][D - 1] = -corner[D - 1] + 1.5 * scene.dt * meetingSpeed;
  }
  return scene;
}

/// One thing that an engine may have otherwise, and what then follows at the corner.
template <int D>
struct Otherwise {
  const char* name;
  void (*change)(ConvexImpactStart<D>& start, const SceneOf<D>& scene, std::size_t i);
};

template <int D>
const std::vector<Otherwise<D>>& otherwise() {
  using Start = ConvexImpactStart<D>;
  using Scene = SceneOf<D>;
  static const std::vector<Otherwise<D>> all = {
      {"moments of inertia are those of a disk, or sphere, of its reach",
       [](Start& start, const Scene& scene, std::size_t i) {
         const double a = scene.disks.radius[i], q = D == 2 ? 0.5 : 0.4;
         const double inverse = 1.0 / (q * scene.disks.mass[i] * a * a);
         if constexpr (D == 2)
           start.body[0].inverseInertia = inverse;
         else
           start.body[0].inverseInertia = inverse * Eigen::Matrix3d::Identity();
       }},
      {"moments of inertia are equal about all axes",
       [](Start& start, const Scene& scene, std::size_t i) {
         if constexpr (D == 3)
           start.body[0].inverseInertia = Eigen::Matrix3d::Identity() / scene.disks.inertia[i];
       }},
      {"moments of inertia are those of other axes",
       [](Start& start, const Scene& scene, std::size_t i) {
         if constexpr (D == 3) {
           const Eigen::Matrix3d axes = matrixOf<3>(scene.disks.turn[i]);
           start.body[0].inverseInertia =
               axes * scene.disks.moments[i].reverse().cwiseInverse().asDiagonal() *
               axes.transpose();
         }
       }},
      {"bodies do not turn",
       [](Start& start, const Scene&, std::size_t) {
         start.body[0].inverseInertia = noInverseInertia<D>();
       }},
      {"impulses act at the centre of mass: bodies get no spin",
       [](Start& start, const Scene&, std::size_t) { start.body[0].arm.setZero(); }},
      {"arms of impulses have the other sense, as if bodies were turned the other way",
       [](Start& start, const Scene&, std::size_t) {
         const VecOf<D> lever = start.body[0].arm;
         start.body[0].arm = -lever;
         start.body[0].arm[D - 1] = lever[D - 1];
       }},
      {"friction is left out", [](Start& start, const Scene&, std::size_t) { start.mu = 0.0; }},
      {"restitution is left out, or e_n = 1",
       [](Start& start, const Scene&, std::size_t) {
         start.restitution = start.restitution < 1.0 ? 1.0 : 0.0;
       }},
      {"restitution is left out: e_n = 0",
       [](Start& start, const Scene&, std::size_t) { start.restitution = 0.0; }}};
  return all;
}

template <int D>
ConvexImpactStart<D> startOf(const SceneOf<D>& scene, std::size_t i) {
  ConvexImpactStart<D> start;
  start.body[0] = impactBody<D>(scene.disks, i, lowestCorner(scene, i).arm);
  start.normal = VecOf<D>::Unit(D - 1);
  start.restitution = scene.law.en;
  start.mu = scene.law.mu;
  return start;
}

/// Velocity and rim's speed after an impact, of the approach.
template <int D>
struct After {
  VecOf<D> velocity;
  SpinOf<D> spin;

  double offFrom(const VecOf<D>& otherVelocity, const SpinOf<D>& otherSpin, double reach) const {
    double turning;
    if constexpr (D == 2)
      turning = std::abs(spin - otherSpin);
    else
      turning = (spin - otherSpin).norm();
    return std::max((velocity - otherVelocity).norm(), reach * turning) / meetingSpeed;
  }
};

/// Kinds of that dimension that the engine declares. @throws Skipped without any
template <int D>
std::vector<ShapeKind> kindsOf(const CheckContext& c) {
  std::vector<ShapeKind> kinds = c.can.limits.shapes;
  std::erase_if(kinds, [](ShapeKind kind) {
    return kind != ShapeKind::capsule && (kind == ShapeKind::polygon) != (D == 2);
  });
  if (kinds.empty()) c.skip("declares no convex bodies");
  return kinds;
}

/// Every kind with every restitution and friction.
std::vector<std::tuple<ShapeKind, double, double>> withEach(
    const std::vector<ShapeKind>& kinds, std::span<const std::pair<double, double>> contacts) {
  std::vector<std::tuple<ShapeKind, double, double>> all;
  for (const ShapeKind kind : kinds)
    for (const auto& [e, mu] : contacts) all.emplace_back(kind, e, mu);
  return all;
}

/// Bodies that meet a plane with one corner move on as the oracle says, where restitution has one
/// meaning, and gain no energy.
template <int D>
void cornersMeetAPlane(CheckContext& c) {
  const Tolerance allowed{0.02, 0.0,
                          "in a step of the approach a corner sinks by 5e-4 of a side and the body "
                          "turns by as much, and impulses in single precision are good to 1e-4"};
  std::vector<std::string> fitting;  // causes that explain all that was found
  bool first = true;
  const std::size_t before = c.faults.size();
  constexpr std::pair<double, double> contacts[] = {{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.2}, {0.8, 1.0}};
  for (const auto& [kind, e, mu] : withEach(kindsOf<D>(c), contacts)) {
    if (mu > 0.0 && !simulates(c.can, Effect::friction)) continue;
    const SceneOf<D> scene = loaded(c, falling<D>(c, kind, e, mu));
    c.examine(convexBodies(kind));
    const double steps = std::ceil(3.0 * scene.dt / c.effective.dt) + 6.0;
    const SnapshotOf<D> now = shown<D>(c, steps * c.effective.dt);
    c.require(now.spin && now.turn, "a snapshot of convex bodies has no spins or orientations");
    for (std::size_t i = 0; i < scene.disks.size(); ++i) {
      const ConvexImpactStart<D> start = startOf(scene, i);
      const ConvexImpact<D> impact = convexImpact(start);
      const After<D> found{now.velocity[i], (*now.spin)[i]};
      const double reach = scene.disks.radius[i];
      const std::string which =
          fmt::format("{}, e_n = {}, µ = {}", nameOfId(scene, i), scene.law.en, scene.law.mu);
      if (!impact.judged) continue;
      const ImpactOutcome<D>& wanted = *impact.newton;
      const double off = found.offFrom(wanted.velocity[0], wanted.spin[0], reach);
      c.near(off, 0.0, allowed,
             text("velocity and spin after a corner met a plane, ", which,
                  ", off from the oracle's by a part of the approach; v is ",
                  found.velocity.transpose(), " m/s for ", wanted.velocity[0].transpose()));
      if (!(off > allowed.absolute)) continue;
      std::vector<std::string> explains;
      for (const Otherwise<D>& other : otherwise<D>()) {
        ConvexImpactStart<D> changed = start;
        other.change(changed, scene, i);
        const ImpactOutcome<D> as = convexImpact(changed).poisson;
        if (found.offFrom(as.velocity[0], as.spin[0], reach) <=
            std::max(allowed.absolute, explainedLeaves * off))
          explains.emplace_back(other.name);
      }
      if (found.offFrom(scene.disks.velocity[i], scene.disks.spin[i], reach) <= allowed.absolute)
        explains.emplace_back("corners do not meet planes");
      if (first)
        fitting = explains;
      else
        std::erase_if(fitting, [&](const std::string& name) {
          return std::ranges::find(explains, name) == explains.end();
        });
      first = false;
    }
  }
  if (c.faults.size() > before && fitting.size() == 1) c.suspect(fitting.front());
}

/// Of a box that turns freely J ω is constant and ω is not: Euler's equations, by Runge and Kutta's
/// scheme of order 4.
Vec3 turnedFreely(const Vec3& moments, Vec3 spin, double t) {
  constexpr int steps = 4000;
  const auto rate = [&](const Vec3& w) {
    return Vec3(moments.cwiseProduct(w).cross(w).cwiseQuotient(moments));
  };
  const double h = t / steps;
  for (int k = 0; k < steps; ++k) {
    const Vec3 a = rate(spin), b = rate(spin + h / 2.0 * a), d = rate(spin + h / 2.0 * b),
               e = rate(spin + h * d);
    spin += h / 6.0 * (a + 2.0 * b + 2.0 * d + e);
  }
  return spin;
}

void boxesTurnFreely(CheckContext& c) {
  SpaceScene scene = aboveAPlane<3>(c, oblong<3>(), 0.0, 0.0);
  const Vec3 spin(2.0, 3.0, 1.0);
  addConvex<3>(scene, Vec3(0.0, 0.0, 10.0 * side), noTurn<3>(), Vec3::Zero(), spin);
  scene = loaded(c, scene);
  c.examine(convexBodies(ShapeKind::box));
  const double t = std::round(1.0 / c.effective.dt) * c.effective.dt;
  const SpaceSnapshot now = shown<3>(c, t);
  c.require(now.spin && now.turn, "a snapshot of convex bodies has no spins or orientations");
  const Vec3 &moments = scene.disks.moments[0], &found = (*now.spin)[0];
  const Vec3 momentum = moments.cwiseProduct(spin);
  const double length = (*now.turn)[0].norm();
  c.near(length, 1.0, {1e-5, 0.0, "ten times the error of single precision"},
         "length of a quaternion after 1 s");
  if (std::abs(length - 1.0) > 1e-5) {
    c.suspect("quaternions are not made unit ones again");
    return;
  }
  const Tolerance allowed{0.02, 0.0, "a scheme of first order is off by ω dt = 2e-3 in a radian"};
  const std::size_t before = c.faults.size();
  c.near((spinMomentum(scene.disks, 0, found, turnIn(now, 0)) - momentum).norm() / momentum.norm(),
         0.0, allowed, "J ω of a box that turns freely for 1 s, off by a part of it");
  // In its own frame ω is what Euler's equations say, whatever the frame.
  const Vec3 own = matrixOf<3>((*now.turn)[0]).transpose() * found;
  c.near((own - turnedFreely(moments, spin, t)).norm() / spin.norm(), 0.0, allowed,
         "ω of a box that turns freely for 1 s, in its frame, off from Euler's by a part of it");
  if (c.faults.size() == before) return;
  if ((found - spin).norm() <= 1e-3 * spin.norm())
    c.suspect("no gyroscopic term: ω stays as it is, and J ω does not");
  else if ((found - turnedFreely(moments, spin, t)).norm() <= allowed.absolute * spin.norm())
    c.suspect("ω is that in the body's frame, not in the scene's");
}

/// A box on a plane under gravity: it stays there, and pushes with its weight below its centre.
template <int D>
void boxesRest(CheckContext& c) {
  c.needs(toString(Effect::gravity));
  SceneOf<D> scene = aboveAPlane<D>(c, oblong<D>(), 0.0, 0.5);
  if (!simulates(c.can, Effect::friction)) scene.law.mu = 0.0;
  constexpr double g = 9.81;
  scene.gravity = -g * VecOf<D>::Unit(D - 1);
  const double height = farthest<D>(scene.shapes[0], VecOf<D>::Unit(D - 1))[D - 1];
  addConvex<D>(scene, height * VecOf<D>::Unit(D - 1), noTurn<D>(), VecOf<D>::Zero(), noSpin<D>());
  scene = loaded(c, scene);
  c.examine(convexBodies(scene.shapes[0].kind));
  const SnapshotOf<D> now = shown<D>(c, std::round(0.5 / c.effective.dt) * c.effective.dt);
  const Tolerance allowed{0.01, 0.0, "a hundredth of a side: skins and slops of solvers are less"};
  c.near((now.position[0] - scene.disks.position[0]).norm() / side, 0.0, allowed,
         "a box that rests on a plane moves, by a part of its side");
  if (now.turn)
    c.near(turnBetween<D>((*now.turn)[0], scene.disks.turn[0]), 0.0,
           {0.01, 0.0, "a corner that sinks by a hundredth of a side"},
           "a box that rests on a plane leans [rad]");
  if (!now.contacts) return;
  c.requireEqual(now.contacts->size(), std::size_t{1}, "contacts of a box on a plane");
  const double weight = scene.disks.mass[0] * g;
  c.near(now.contacts->normalForce[0] / weight, 1.0, {0.05, 0.0, "what swings of a solver is less"},
         "normal force of a box that rests, by its weight");
  c.require(!now.contacts->point.empty(), "a contact of convex bodies has no point");
  VecOf<D> beside = now.contacts->point[0] - now.position[0];
  beside[D - 1] = 0.0;
  c.near(beside.norm() / side, 0.0, {0.05, 0.0, "as the normal force"},
         "where a box that rests pushes, beside its centre by a part of its side");
}

/// Friction slows a box in space down against its motion, in every direction alike.
void boxesSlideStraight(CheckContext& c) {
  c.needs(toString(Effect::gravity));
  c.needs(toString(Effect::friction));
  constexpr double g = 9.81, mu = 0.3, speed = 1.0, t = 0.2;
  SpaceScene scene = aboveAPlane<3>(c, oblong<3>(), 0.0, mu);
  scene.gravity = {0.0, 0.0, -g};
  const double height = farthest<3>(scene.shapes[0], Vec3::UnitZ()).z();
  const Vec3 along(std::cos(0.5), std::sin(0.5), 0.0);
  addConvex<3>(scene, Vec3(0.0, 0.0, height), noTurn<3>(), speed * along, Vec3::Zero());
  scene = loaded(c, scene);
  const double end = std::round(t / c.effective.dt) * c.effective.dt;
  const SpaceSnapshot now = shown<3>(c, end);
  const Vec3& found = now.velocity[0];
  const std::size_t before = c.faults.size();
  c.near(found.dot(along), speed - mu * g * end,
         {0.02, 0.0, "µ off by 3 % makes as much of the speed lost"},
         "speed of a box that slides for 0.2 s [m/s]");
  const double turned = (found - found.dot(along) * along).norm();
  c.near(turned, 0.0,
         {0.02, 0.0,
          "Coulomb's friction on its corners acts below its centre, along the motion: nothing "
          "turns it aside"},
         "a box that slides goes astray [m/s]");
  if (c.faults.size() == before) return;
  const double lost = (speed - found.dot(along)) / (mu * g * end) - 1.0;
  // Of two axes, each with its own bound µ f_n.
  const Vec3 two = (speed * along).cwiseAbs() - mu * g * end * Vec3(1.0, 1.0, 0.0);
  if ((found.cwiseAbs() - two).head<2>().norm() <= 0.1)
    c.suspect("friction acts along two axes, each for itself: it is up to √2 too strong");
  else if ((found - speed * along).head<2>().norm() <= 0.02)
    c.suspect("friction is left out");
  else if (std::abs(lost) > 0.03 && std::abs(lost) < 0.5)
    c.suspect(text("µ of sliding boxes", percentOf(lost)));
}

}  // namespace

Checks convexChecks() {
  return {
      {"ConvexCornersMeetAPlane", "a corner that meets a plane: velocity and spin after it",
       cornersMeetAPlane<2>},
      {"ConvexCornersMeetAPlaneInSpace", "the same of boxes in space", cornersMeetAPlane<3>, 3},
      {"ConvexBodiesRest", "a box on a plane stays, and pushes with its weight", boxesRest<2>},
      {"ConvexBodiesRestInSpace", "the same in space", boxesRest<3>, 3},
      {"ConvexBodiesTurnFreely", "a box that turns freely in space keeps J ω", boxesTurnFreely, 3},
      {"ConvexBodiesSlideStraight", "friction acts against the motion of a box, in any direction",
       boxesSlideStraight, 3}};
}

}  // namespace crossgrain::conformance
