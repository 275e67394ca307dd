// Spheres in a hollow cylinder: it is met as a plane is, wherever it is met, and moves as it turns.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "studies/conformance/check_context.hpp"
#include "studies/conformance/space_scenes.hpp"

namespace crossgrain::conformance {
namespace {

constexpr double bore = 6.0 * radius;               ///< of the cylinder [m]
constexpr double approach = 0.05, slipSpeed = 0.3;  ///< K µ (1 + e_n) v_n is 0.16: all slide [m/s]
constexpr std::size_t atWall = 6;                   ///< spheres that run into the cylinder

/// Spheres that run into a cylinder all round at the same speed, and one that runs in the same way
/// into a plane across it: at that one the others are measured.
struct InCylinder {
  SpaceScene scene;
  /// Of each sphere: the normal of its wall, a direction along the wall (the axis at the cylinder),
  /// and that in which a turning cylinder moves.
  std::vector<Eigen::Matrix3d> frames;
};

/// @param along  that all have along the second of their directions [m/s]
/// @param omega  of the cylinder. Its surface moves by ω R past spheres; in place of that the one
/// at
///               the plane moves the other way [rad/s]
InCylinder runIntoCylinder(const CheckContext& c, double along, double omega) {
  InCylinder made{emptySpace(c, "spheres in a cylinder"), {}};
  SpaceScene& scene = made.scene;
  Eigen::Matrix3d frame = Eigen::Matrix3d::Identity();
  // An engine whose planes lie along axes may have cylinders along axes alone, too.
  if (!c.can.limits.planesAlongAxes)
    frame = Eigen::AngleAxisd(1.1, Vec3(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  const Vec3 axis = frame.col(0), centre(0.02, -0.01, 0.03);
  const double gap = 2.75 * approach * scene.dt;
  const auto add = [&](const Vec3& from, const Eigen::Matrix3d& own, double aside) {
    made.frames.push_back(own);
    addBody<3>(scene, from + (radius + gap) * own.col(0), own * Vec3(-approach, along, aside),
               Vec3::Zero());
  };
  for (std::size_t k = 0; k < atWall; ++k) {
    const double angle = 0.3 + static_cast<double>(k) * std::numbers::pi / 3.0;
    const Vec3 n = frame * Vec3(0.0, -std::cos(angle), -std::sin(angle));
    Eigen::Matrix3d own;
    own << n, axis, n.cross(axis);
    add(centre - bore * n, own, 0.0);
  }
  WallBodyOf<3>& drum = scene.bodies.emplace_back();
  drum.name = "drum";
  drum.centre = centre;
  drum.cylinders.push_back({centre, axis, bore});
  if (omega != 0.0) drum.motion.kind = MotionKind::rotating;
  drum.motion.angularVelocity = omega * axis;
  WallBodyOf<3>& end = scene.bodies.emplace_back();
  end.name = "end";
  end.centre = centre;
  end.planes.push_back({centre - 8.0 * radius * axis, axis});
  add(end.planes[0].point, frame, -omega * bore);
  return made;
}

/// Over an impact, in the sphere's own frame.
struct Change {
  Vec3 velocity, spin;
};

std::vector<Change> changesOf(const InCylinder& run, const SpaceSnapshot& after) {
  std::vector<Change> changes;
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    const Eigen::Matrix3d toOwn = run.frames[k].transpose();
    const Vec3 turned = after.spin ? (*after.spin)[k] : Vec3::Zero();
    changes.push_back({toOwn * (after.velocity[k] - run.scene.disks.velocity[k]), toOwn * turned});
  }
  return changes;
}

/// Cause why spheres at a fixed cylinder do not move as the one at the plane.
std::string causeAtCylinder(const std::vector<Change>& changes) {
  const double wanted = changes[atWall].velocity.x();
  std::size_t met = 0;
  bool outward = false;
  for (std::size_t k = 0; k < atWall; ++k) {
    met += std::abs(changes[k].velocity.x() - wanted) < 0.01 * wanted;
    outward = outward || changes[k].velocity.x() < -0.01 * wanted;
  }
  if (outward) return "n of a cylinder points away from its axis: it pulls spheres out";
  if (met < atWall)
    return fmt::format(
        "a cylinder meets {} of {} spheres all round as a plane would: δ is not a − (R − s) with s "
        "the distance from its axis",
        met, atWall);
  return {};
}

/// Where contacts with the cylinder are shown, they are of its id, with n and δ of the sphere.
void examineContacts(CheckContext& c, const InCylinder& run, const SpaceSnapshot& now) {
  if (!now.contacts || now.positionTime != now.contactTime) return;
  const auto id = static_cast<std::int32_t>(run.scene.idCount()) - 1;
  const Cylinder& cylinder = run.scene.bodies[0].cylinders[0];
  for (std::size_t k = 0; k < now.contacts->size(); ++k) {
    const auto i = static_cast<std::size_t>(now.contacts->i[k]);
    if (i >= atWall) continue;
    c.equal(now.contacts->j[k], id, text("the other of the contact of sphere ", i));
    const PlaneOf<3> plane = tangentPlane(cylinder, now.position[i]);
    c.near((now.contacts->normal[k] - plane.normal).norm(), 0.0,
           {1e-3, 0.0, "spheres run straight at the wall"},
           text("n of sphere ", i, " at the cylinder, off from that to the axis"));
  }
}

void cylinderIsMetAsAPlane(CheckContext& c) {
  c.needs(cylinders);
  InCylinder run = runIntoCylinder(c, slipSpeed, 0.0);
  run.scene = loaded(c, run.scene);
  c.examine(cylinders);
  examineContacts(c, run, shown<3>(c, std::max(2e-5, c.effective.dt)));
  const std::vector<Change> changes =
      changesOf(run, shown<3>(c, std::max(2e-3, 6.0 * c.effective.dt)));
  const Change& wanted = changes[atWall];
  c.require(wanted.velocity.x() > approach, "a sphere that runs into a plane does not come back");
  const Tolerance rounding =
      c.byPrecision(1e-6, 1e-2, "overlaps of 1e-5 radii of places up to 10 radii off");
  const std::size_t before = c.faults.size();
  for (std::size_t k = 0; k < atWall; ++k) {
    const auto compare = [&](const Vec3& found, const Vec3& of, double unit, const char* name) {
      c.near((found - of).norm() / unit, 0.0, rounding,
             text(name, " of sphere ", k,
                  " at the cylinder, off from that at a plane by a part of it"));
    };
    compare(changes[k].velocity, wanted.velocity, wanted.velocity.norm(), "Δv");
    compare(changes[k].spin, wanted.spin, wanted.velocity.norm() / radius, "Δω");
  }
  if (c.faults.size() == before) return;
  if (const std::string cause = causeAtCylinder(changes); !cause.empty()) c.suspect(cause);
}

/// By Galileo's principle a surface that moves by ω R acts as one at rest on a sphere that moves
/// the other way: nothing turns meanwhile but n, by Δv_t t_c/(R − a).
void turningCylinderDrivesSpheres(CheckContext& c) {
  c.needs(cylinders);
  c.needs(toString(Effect::movingWalls));
  c.needs(toString(Effect::friction));
  const double omega = slipSpeed / bore;
  InCylinder run = runIntoCylinder(c, 0.0, omega);
  run.scene = loaded(c, run.scene);
  c.examine(cylinders);
  const double dt = c.effective.dt;
  const auto steps = static_cast<int>(std::ceil(std::max(1e-3 / dt, 6.0)));
  Vec3 torque = Vec3::Zero();
  SpaceSnapshot now;
  for (int step = 1; step <= steps; ++step) {
    now = shown<3>(c, step * dt);
    torque += dt * now.bodies.at(0).torque.value_or(Vec3::Zero());
  }
  const std::vector<Change> changes = changesOf(run, now);
  const Vec3& wanted = changes[atWall].velocity;
  c.require(wanted.z() > 0.1 * approach, "a sphere that slides on a plane is not slowed down");
  const Tolerance tolerance{0.02, 0.0, "n turns by 2e-3 rad in a contact"};
  const std::size_t before = c.faults.size();
  double least = slipSpeed, most = -slipSpeed;
  for (std::size_t k = 0; k < atWall; ++k) {
    c.near((changes[k].velocity - wanted).norm() / wanted.norm(), 0.0, tolerance,
           text("Δv of sphere ", k,
                " at a cylinder that turns, off from that of a sphere that slides as fast over a "
                "plane by a part of it"));
    least = std::min(least, changes[k].velocity.z());
    most = std::max(most, changes[k].velocity.z());
  }
  if (c.faults.size() > before) {
    if (std::max(std::abs(least), std::abs(most)) < 0.1 * wanted.z())
      c.suspect(
          "a cylinder's turning is left out of the relative velocity: it drags no sphere along");
    else if (most < 0.0)
      c.suspect("a cylinder that turns drags spheres the other way round");
  }
  if (!now.bodies[0].torque || !c.faults.empty()) return;
  Vec3 gained = Vec3::Zero();  // by the spheres, about the drum's centre
  for (std::size_t k = 0; k < atWall; ++k) {
    const DisksOf<3>& disks = run.scene.disks;
    gained +=
        disks.mass[k] *
        (now.position[k] - run.scene.bodies[0].centre).cross(now.velocity[k] - disks.velocity[k]);
    if (now.spin) gained += disks.inertia[k] * (*now.spin)[k];
  }
  c.near((torque + gained).norm() / gained.norm(), 0.0, {0.03, 0.0, "n turns by 2e-3 rad"},
         "Σ T dt on the cylinder, off from what spheres gain of angular momentum by a part of it");
}

}  // namespace

Checks cylinderChecks() {
  return {
      {"CylinderIsMetAsAPlane", "spheres run into a cylinder all round as into a plane",
       cylinderIsMetAsAPlane, 3},
      {"TurningCylinderDrivesSpheres",
       "a cylinder that turns drags spheres along by the speed of its surface, and bears the "
       "torque",
       turningCylinderDrivesSpheres, 3},
  };
}

}  // namespace crossgrain::conformance
