// Checks of spheres that no scene in a plane can make: torques about any axis, impacts in turned
// frames; and boxes with periodic directions.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "adapters/suitability.hpp"
#include "studies/conformance/check_context.hpp"
#include "studies/conformance/moved_pairs.hpp"
#include "studies/conformance/space_scenes.hpp"

namespace crossgrain::conformance {
namespace {

constexpr double approachSpeed = 0.05, framesApart = 12.0 * radius;  // [m/s, m]

// ---- torques ------------------------------------------------------------------------------------

/// Cause why a sphere turned by `found` and not by `wanted`, both Δω; n is the normal.
std::string causeOfTurn(const Vec3& found, const Vec3& wanted, const Vec3& n) {
  const double size = wanted.norm();
  const Vec3 axis = wanted / size;
  const double part = found.dot(axis) / size;
  if (found.norm() < 0.02 * size) return "no torque turns spheres";
  if ((found - part * wanted).norm() < 0.05 * found.norm()) {
    const double inertia = 0.4 / part;
    if (part < 0.0) return "the torque turns spheres the other way round";
    return fmt::format("J is {:.2g} m a², not 2/5 m a²{}, or the torque is off as much", inertia,
                       std::abs(inertia - 0.5) < 0.02 ? ": that of a disk" : "");
  }
  const Vec3 along = n.cross(axis);  // f_t
  const double of[] = {std::abs(part), std::abs(found.dot(along)) / size,
                       std::abs(found.dot(n)) / size};
  return fmt::format(
      "the torque is about the wrong axis: not about n × f_t alone ({:.2g} of it), but {:.2g} "
      "about "
      "f_t and {:.2g} about n",
      of[0], of[1], of[2]);
}

/// Two spheres meet while they slide. Of each J Δω = −l ∫ n × f_t dt and m Δv = ∫ f dt, so that
/// Δω = −(l m/J) n × Δv with n from the other to it: n turns by 2e-3 rad meanwhile.
void torqueTurnsSpheres(CheckContext& c) {
  c.needs(toString(Effect::rotation));
  SpaceScene scene = emptySpace(c, "spheres that meet");
  const Eigen::Matrix3d frame =
      Eigen::AngleAxisd(-0.8, Vec3(2.0, -1.0, 1.0).normalized()).toRotationMatrix();
  const Vec3 n = frame.col(0), slip = frame * Vec3(0.0, 0.03, 0.04);
  constexpr double approach = 0.05;
  for (const double side : {1.0, -1.0})
    addBody<3>(scene, side * (radius + approach * 5.0 * scene.dt) * n,
               0.5 * side * (slip - 2.0 * approach * n), frame * Vec3(6.0 * side, 2.0, 1.0));
  scene = loaded(c, scene);
  const SpaceSnapshot after = shown<3>(c, 1e-3);
  c.require(after.spin.has_value(), "shows no spins");
  for (const int k : {0, 1}) {
    const Vec3 change = after.velocity[k] - scene.disks.velocity[k];
    const Vec3 outward = k == 0 ? n : Vec3(-n);
    const Vec3 wanted = -2.5 / radius * outward.cross(change);
    const Vec3 found = (*after.spin)[k] - scene.disks.spin[k];
    c.require(wanted.norm() * radius > 0.1 * approach,
              "spheres that slide as they meet do not "
              "change their velocity along each other");
    const double off = (found - wanted).norm() / wanted.norm();
    const std::size_t before = c.faults.size();
    c.near(off, 0.0,
           {0.03, 0.0, "n turns by 2e-3 rad while Δv_n is seven times Δv_t; arms are a to 1e-3"},
           text("Δω of sphere ", k, ", off from (m a/J) times n × Δv by a part of it"));
    if (c.faults.size() > before) c.suspect(causeOfTurn(found, wanted, outward));
  }
}

/// Two spheres meet as before, with spins about n besides that the two have in opposite directions:
/// these leave the slip as it is, the mean spin along n too, and J is the same about every axis. So
/// nothing else is another one: dω/dt is T/J, without ω × T, ω × Jω or what a wrong frame makes of
/// T.
void spinsAboutTheLineChangeNothing(CheckContext& c) {
  c.needs(toString(Effect::rotation));
  constexpr double extra = 40.0;  // [rad/s]; |ω| dt is 1.6e-4
  const Eigen::Matrix3d frame =
      Eigen::AngleAxisd(-0.8, Vec3(2.0, -1.0, 1.0).normalized()).toRotationMatrix();
  const Vec3 n = frame.col(0), slip = frame * Vec3(0.0, 0.03, 0.04);
  const auto ended = [&](double about) {
    SpaceScene scene = emptySpace(c, "spheres that spin about their line as they meet");
    for (const double side : {1.0, -1.0})
      addBody<3>(scene, side * (radius + 5.0 * approachSpeed * scene.dt) * n,
                 0.5 * side * (slip - 2.0 * approachSpeed * n), side * about * n);
    loaded(c, scene);
    SpaceSnapshot after = shown<3>(c, 1e-3);
    c.require(after.spin.has_value(), "shows no spins");
    for (const int k : {0, 1}) (*after.spin)[k] -= (k == 0 ? 1.0 : -1.0) * about * n;
    return after;
  };
  const SpaceSnapshot still = ended(0.0), spun = ended(extra);
  const double size = (*still.spin)[0].norm();
  c.require(size * radius > 0.1 * approachSpeed, "spheres that slide as they meet do not turn");
  const Tolerance rounding = c.byPrecision(
      1e-9, std::max(1e-3, roundedImpact(c, 2.0 * radius, approachSpeed)), "roundings of ω");
  for (const int k : {0, 1}) {
    const std::string which = text(" of sphere ", k, ", off from that without a spin about n");
    c.near(((*spun.spin)[k] - (*still.spin)[k]).norm() / size, 0.0, rounding, "Δω" + which);
    c.near((spun.velocity[k] - still.velocity[k]).norm() / approachSpeed, 0.0, rounding,
           "v" + which);
  }
}

// ---- frames -------------------------------------------------------------------------------------

/// Of n, s and b = n × s: about n, and about other axes.
std::vector<Eigen::Matrix3d> framesAllRound() {
  std::vector<Eigen::Matrix3d> frames;
  const auto add = [&](const Vec3& axis, double degrees) {
    frames.push_back(Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, axis.normalized())
                         .toRotationMatrix());
  };
  for (const double degrees : {0.0, 12.0, 30.0, 45.0, 63.0, 90.0, 130.0, 200.0})
    add(Vec3::UnitX(), degrees);
  for (const Vec3& axis : {Vec3(2, -1, 1), Vec3(0, 1, 0), Vec3(1, 1, 1), Vec3(-1, 3, 2)})
    for (const double degrees : {45.0, 110.0}) add(axis, degrees);
  return frames;
}

constexpr double speedAlong = 0.3;  ///< of two that slide past each other as they meet [m/s]

/// In each frame two spheres that meet, far from the others and none far from the origin. K µ (1 +
/// e_n) v_n is 0.16 m/s: they slide throughout.
SpaceScene turnedImpacts(const CheckContext& c, const std::vector<Eigen::Matrix3d>& frames) {
  SpaceScene scene = emptySpace(c, "an impact in turned frames");
  for (std::size_t k = 0; k < frames.size(); ++k)
    for (const double side : {1.0, -1.0}) {
      const auto at = static_cast<int>(k);
      const Vec3 middle = framesApart * Vec3(0.0, at % 4 - 1.5, at / 4 - 1.5);
      const double apart = side * (radius + 2.75 * approachSpeed * scene.dt);
      addBody<3>(scene, middle + frames[k] * (apart * Vec3::UnitX()),
                 frames[k] * (0.5 * side * Vec3(-approachSpeed, speedAlong, 0.0)),
                 frames[k] * Vec3(6.0 * side, 2.0, 1.0));
    }
  return scene;
}

void turnedImpactsAreTurnedAlike(CheckContext& c) {
  c.needs(toString(Effect::friction));
  const std::vector<Eigen::Matrix3d> frames = framesAllRound();
  SpaceScene scene = turnedImpacts(c, frames);
  if (!simulates(c.can, Effect::rotation)) std::ranges::fill(scene.disks.spin, noSpin<3>());
  scene = loaded(c, scene);
  const SpaceSnapshot after = shown<3>(c, std::max(2e-3, 6.0 * c.effective.dt));
  std::vector<Vec3> changes;
  for (std::size_t k = 0; k < frames.size(); ++k)
    changes.push_back(frames[k].transpose() *
                      (after.velocity[2 * k] - scene.disks.velocity[2 * k]));
  c.require(changes[0].norm() > 0.01, "two spheres that meet do not bounce off each other");
  const double single = roundedImpact(c, 2.2 * framesApart, approachSpeed);
  const Tolerance rounding = c.byPrecision(1e-6, std::max(1e-2, single),
                                           "overlaps of 1e-3 radii of places some 25 radii off");
  double least = speedAlong, most = 0.0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    c.near((changes[k] - changes[0]).norm() / changes[0].norm(), 0.0, rounding,
           text("Δv of an impact in frame ", k, ", off from that in frame 0 by a part of it"));
    const double aside = changes[k].tail<2>().norm();
    least = std::min(least, aside);
    most = std::max(most, aside);
  }
  c.examine(toString(Effect::friction));
  c.examine(spheresInSpace);
  if (most > 1.1 * least && most < 1.45 * least)
    c.suspect(
        fmt::format("friction is up to {:.2f} times as large in some directions: it is bounded "
                    "along each of two by itself, a pyramid in place of Coulomb's cone",
                    most / least));
}

// ---- images -------------------------------------------------------------------------------------

constexpr double boxWidth = 16.0;  // [radius]

/// Two that meet, and the same two elsewhere in a box that does not begin at the origin and is
/// periodic along the directions given.
/// @param at     of both pairs along these, whose first is also that of their lines of centres,
///               nearly [radius]
/// @param speed  that all have along the first besides [m/s]
/// @param rolls  what the second's spin is times the first's
template <int D>
SceneOf<D> twoPairs(const ContactLaw& law, std::array<double, 2> at, double speed, double rolls,
                    const std::vector<int>& along) {
  SceneOf<D> scene;
  scene.law = law;
  scene.dt = 4e-6;
  BoxOf<D>& box = scene.box.emplace();
  for (int k = 0; k < D; ++k) box.low[k] = (k == 0 ? -3.0 : 2.0) * radius;
  box.high = box.low + VecOf<D>::Constant(boxWidth * radius);
  for (const int k : along) box.periodic[static_cast<std::size_t>(k)] = true;
  const int first = along.front(), second = (first + 1) % D;
  VecOf<D> apart = VecOf<D>::Constant(0.07 * radius), velocity = VecOf<D>::Zero();
  apart[first] = 0.98 * radius;
  apart[second] = 0.1 * radius;
  velocity[first] = -0.2;
  velocity[(first + D - 1) % D] += 0.1;
  SpinOf<D> spin = noSpin<D>();
  if constexpr (D == 2)
    spin = 20.0;
  else
    spin = Vec3(20.0, -30.0, 10.0);
  for (const double middle : at)
    for (const double side : {1.0, -1.0}) {
      VecOf<D> place = box.low + VecOf<D>::Constant(0.5 * boxWidth * radius),
               moving = side * velocity;
      for (const int k : along) place[k] = box.low[k] + middle * radius;
      place += side * apart;
      moving[first] += speed;
      addBody<D>(scene, box.wrapped(place), moving, side > 0.0 ? spin : SpinOf<D>(rolls * spin));
    }
  return scene;
}

/// Each direction alone, and all of them, at a corner.
template <int D>
std::vector<std::vector<int>> acrossWhat() {
  std::vector<std::vector<int>> all(D + 1);
  for (int k = 0; k < D; ++k) {
    all[static_cast<std::size_t>(k)] = {k};
    all[D].push_back(k);
  }
  return all;
}

/// Of an engine of spheres alone the same check in space stands, which has the names of its axes.
template <int D>
void skipWhatSpaceHas(const CheckContext& c) {
  if (D == 2 && c.inSpace) c.skip(sameOfSpheres);
}

template <int D>
SceneOf<D> loadedPairs(CheckContext& c, SceneOf<D> scene) {
  if (!simulates(c.can, Effect::rotation)) std::ranges::fill(scene.disks.spin, noSpin<D>());
  return loaded(c, scene);
}

Vec3 asVector(const Vec3& v) {
  return v;
}
Vec3 asVector(const Vec2& v) {
  return {v.x(), v.y(), 0.0};
}
Vec3 asVector(double aboutZ) {
  return {0.0, 0.0, aboutZ};
}

/// Fault of a rolling spring as its pair crosses a border, by the torque that one of the two then
/// has more than in the pair inside.
/// @param part  that torque by the spring's own just before
std::string causeAtBorder(double part) {
  if (std::abs(part + 2.0) < 0.1)
    return "the spring of rolling resistance is reversed as its pair goes over a border: on one of "
           "the two its torque has the other sign";
  if (std::abs(part + 1.0) < 0.1)
    return "the spring of rolling resistance is lost as its pair goes over a border";
  return {};
}

/// Where the snapshot of a pair at the border first differs from that of the same pair inside: the
/// cause, as far as it is seen in the torques of the step that follows.
/// @param inertia  of both
template <int D>
void nameCauseAtBorder(CheckContext& c, double inertia, const SnapshotOf<D>& before,
                       const SnapshotOf<D>& now, const SnapshotOf<D>& next) {
  if (!now.spin || !before.contacts || before.contacts->rollingTorque.empty()) return;
  const std::vector<std::int32_t>& first = before.contacts->i;
  const auto inside = std::ranges::find(first, 0) - first.begin();
  if (inside == std::ssize(first)) return;
  const Vec3 own = asVector(before.contacts->rollingTorque[static_cast<std::size_t>(inside)]);
  for (const int side : {0, 1}) {
    const auto difference = [&](const SnapshotOf<D>& of) {
      return asVector(SpinOf<D>((*of.spin)[2 + side] - (*of.spin)[side]));
    };
    const Vec3 torque = inertia / c.effective.dt * (difference(next) - difference(now));
    const double part = (side == 0 ? 1.0 : -1.0) * torque.dot(own) / own.squaredNorm();
    if (const std::string cause = causeAtBorder(part); !cause.empty()) c.suspect(cause);
  }
}

/// Two in contact of which first one and then the other goes over a border, with 50 m/s, and the
/// same two that do not come to it: by Galileo's principle, and as images are alike, both pairs do
/// the same. Springs, of rolling too where there are such, are loaded meanwhile.
template <int D>
void pairsThatCrossBorders(CheckContext& c) {
  c.needs(periodicDirections);
  skipWhatSpaceHas<D>(c);
  constexpr int steps = 60;
  constexpr double fast = 50.0, pairSpeed = 0.4;  // [m/s]
  const SceneOf<D> scene =
      loadedPairs(c, twoPairs<D>(rollingLawOf(c.can, D), {4.0, 14.8}, fast, -2.0, {0}));
  c.examine(periodicDirections);
  // The pair is some 5e-3 radii deep, as in an impact at 0.6 m/s, and its motion rounded as well.
  const double moving = roundedInContact(c.can, fast, steps) / pairSpeed;
  const Tolerance rounding =
      c.byPrecision(1e-9, roundedImpact(c, boxWidth * radius, pairSpeed) + moving,
                    "the same sums of places that are rounded in another way");
  SnapshotOf<D> before = shown<D>(c, 0.0);
  for (int k = 1; k <= steps && c.faults.empty(); ++k) {
    const SnapshotOf<D> now = shown<D>(c, k * c.effective.dt);
    const auto compare = [&](const char* name, int side, const auto& list, double size) {
      const typename std::decay_t<decltype(list)>::value_type apart = list[2 + side] - list[side];
      c.near(asVector(apart).norm() / size, 0.0, rounding,
             text("after ", k, " steps ", name, " of ", side,
                  " of two that go over the border, off from that of the same two inside by a "
                  "part of it"));
    };
    for (const int side : {0, 1}) {
      compare("Δv", side, now.velocity, (now.velocity[0] - now.velocity[1]).norm());
      if (now.spin) compare("ω", side, *now.spin, asVector(scene.disks.spin[0]).norm());
    }
    if (!c.faults.empty())
      nameCauseAtBorder<D>(c, scene.disks.inertia[0], before, now,
                           shown<D>(c, (k + 1) * c.effective.dt));
    before = now;
  }
}

/// " along x and z"
std::string alongAxes(const std::vector<int>& along) {
  constexpr const char* names[] = {"x", "y", "z"};
  std::string all;
  for (const int axis : along)
    all += (all.empty() ? " along " : " and ") + std::string(names[axis]);
  return all;
}

/// Of several " at a corner".
std::string alongWhat(const std::vector<int>& along) {
  return along.size() > 1 ? " at a corner" : alongAxes(along);
}

/// Directions along which bodies do not meet, and whether along others something else is wrong.
struct AcrossBorders {
  std::vector<int> missing;
  bool otherwise = false;
};

/// Two that meet, or one at a wall's, and the same half a box further on, on either side of its
/// border, or at a corner.
template <int D, bool atWall>
void expectTheSameAcross(CheckContext& c, const std::vector<int>& along, AcrossBorders& found) {
  SceneOf<D> scene =
      twoPairs<D>(followed(c.can, dampedLaw(D)), {0.5 * boxWidth, boxWidth}, 0.0, 1.0, along);
  scene = loadedPairs(c, atWall ? withPosts<D>(std::move(scene)) : std::move(scene));
  const BoxOf<D>& box = *scene.box;
  c.examine(periodicDirections);
  const bool held = c.faults.empty();  // at a border: else a corner says nothing more
  const std::size_t faults = c.faults.size();
  const Tolerance rounding =
      c.byPrecision(1e-9, std::max(1e-4, roundedImpact(c, boxWidth * radius, 0.4)),
                    "the same sums of places that are rounded in another way");
  const SnapshotOf<D> during = shown<D>(c, 4e-5), after = shown<D>(c, 1e-3);
  constexpr std::size_t bodies = atWall ? 1 : 2;  // of a pair
  VecOf<D> changes[2];
  for (std::size_t side = 0; side < bodies; ++side) {
    for (const std::size_t pair : {0, 1})
      changes[pair] =
          after.velocity[bodies * pair + side] - scene.disks.velocity[bodies * pair + side];
    c.require(changes[0].norm() > 0.1,
              atWall ? "one in the middle of the box does not bounce off a wall's"
                     : "two in the middle of the box do not bounce off each other");
    c.near((changes[1] - changes[0]).norm() / changes[0].norm(), 0.0, rounding,
           text("Δv of ", atWall ? "one at a wall's" : text(side, " of two"), " across the border",
                alongWhat(along), ", off from that of the same ", atWall ? "" : "two ",
                "inside by a part of it"));
  }
  if (along.size() == 1 && changes[1].norm() < 1e-3 * changes[0].norm())
    found.missing.push_back(along.front());
  else if (along.size() == 1 && c.faults.size() > faults)
    found.otherwise = true;
  if (atWall) return;
  if (held && found.missing.empty() && changes[1].dot(changes[0]) < 0.0)
    c.suspect("the force across a border is that of the wrong image: it has the other sign");
  if (!during.contacts) return;
  const auto contactsOf = [&](std::int32_t first) {
    return std::ranges::count(during.contacts->i, first);
  };
  c.equal(contactsOf(2), contactsOf(0), "contacts of the two across the border");
  for (std::size_t k = 0; k < during.contacts->size(); ++k) {
    VecOf<D> line = during.position[static_cast<std::size_t>(during.contacts->i[k])] -
                    during.position[static_cast<std::size_t>(during.contacts->j[k])];
    line = box.nearest(line);
    const double deep = during.contacts->overlap[k] - (2.0 * radius - line.norm());
    const double off = (during.contacts->normal[k] - line.normalized()).norm();
    // Contacts may be a step older than positions.
    c.near(off, 0.0, {1e-2, 0.0, "n turns by 1e-3 in a step"},
           text("n of a contact of ", during.contacts->i[k], " and ", during.contacts->j[k],
                ", off from the line to the nearest image"));
    // Of a box of another period the overlap would be another one, too.
    if (held && off > 1.0 && std::abs(deep) < 0.1 * radius)
      c.suspect("the normal of a contact across the border is that to the wrong image");
  }
}

/// Two bodies, or one and a wall's disk or sphere, which have images too.
template <int D, bool atWall>
void sameAcrossBorders(CheckContext& c) {
  c.needs(periodicDirections);
  if (atWall) c.needs(wallMotion(Motion::Kind::fixed));
  skipWhatSpaceHas<D>(c);
  AcrossBorders found;
  for (const std::vector<int>& along : acrossWhat<D>())
    expectTheSameAcross<D, atWall>(c, along, found);
  if (!found.missing.empty() && (atWall || !found.otherwise))
    c.suspect(text("bodies do not meet ", atWall ? "images of walls' disks" : "each other's images",
                   " across the border", alongAxes(found.missing)));
}

}  // namespace

Checks spaceChecks() {
  return {
      {"TorqueTurnsSpheres", "f_t turns spheres about n × f_t, with 2/5 m a²", torqueTurnsSpheres,
       3},
      {"SpinsAboutTheLineChangeNothing",
       "spins about the line of centres, opposite ones, change nothing else as spheres meet",
       spinsAboutTheLineChangeNothing, 3},
      {"TurnedImpactsAreTurnedAlike",
       "an impact in another frame, its slip in any direction, is the same, turned",
       turnedImpactsAreTurnedAlike, 3},
      {"PairsAcrossBorders", "two disks across a periodic border are the same two inside",
       sameAcrossBorders<2, false>},
      {"PairsAcrossBordersInSpace", "two spheres across a periodic border are the same two inside",
       sameAcrossBorders<3, false>, 3},
      {"WallsAcrossBorders", "so is a disk at a wall's disk", sameAcrossBorders<2, true>},
      {"WallsAcrossBordersInSpace", "so is a sphere at a wall's sphere", sameAcrossBorders<3, true>,
       3},
      {"PairsThatCrossBorders",
       "two disks in contact that go over a periodic border do what the same two do inside",
       pairsThatCrossBorders<2>},
      {"PairsThatCrossBordersInSpace",
       "two spheres in contact that go over a periodic border do what the same two do inside",
       pairsThatCrossBorders<3>, 3},
  };
}

}  // namespace crossgrain::conformance
