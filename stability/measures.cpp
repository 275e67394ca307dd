#include "stability/measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "oracle/collision_end.hpp"
#include "oracle/collision_oracle.hpp"

namespace crossgrain::inline stability {

namespace {

using Curve = std::vector<double>;

// Operations on spins and torques, in either dimension.
double dot(double a, double b) {
  return a * b;
}
double dot(const Vec3& a, const Vec3& b) {
  return a.dot(b);
}
double sizeOf(double value) {
  return std::abs(value);
}
double sizeOf(const Vec3& value) {
  return value.norm();
}
using crossgrain::cross;
Vec3 cross(const Vec3& a, const Vec3& b) {
  return a.cross(b);
}

/// A value for each snapshot.
template <int D, typename Value>
Curve each(const RecordingOf<D>& run, Value&& value) {
  Curve curve;
  for (const SnapshotOf<D>& snapshot : run.snapshots) curve.push_back(value(snapshot));
  return curve;
}

template <int D>
bool wallsMove(const SceneOf<D>& scene) {
  return effectsOf(scene).contains(Effect::movingWalls);
}

/// Power that the walls put into the disks, from the forces on the walls [W].
template <int D>
std::optional<double> wallPower(const SnapshotOf<D>& snapshot) {
  double power = 0.0;
  for (const BodySnapshotOf<D>& body : snapshot.bodies) {
    const bool turns = body.angularVelocity != noSpin<D>(), travels = !body.velocity.isZero(0.0);
    if ((travels && !body.force) || (turns && !body.torque)) return std::nullopt;
    if (travels) power -= body.force->dot(body.velocity);
    if (turns) power -= dot(*body.torque, body.angularVelocity);
  }
  return power;
}

/// Energy less what the walls have put in since the start [J]; empty where that is not known.
template <int D>
Curve ownEnergy(const RecordingOf<D>& run) {
  Curve energy = each(run, [&](const SnapshotOf<D>& now) {
    const double work = now.ledger ? now.ledger->workOfWalls : 0.0;
    return energyOf(run, now).total() - work;
  });
  if (!wallsMove(run.scene) || run.snapshots.front().ledger) return energy;
  double work = 0.0;
  for (std::size_t k = 1; k < run.snapshots.size(); ++k) {
    if (run.snapshots[k].positionTime == 0.0) continue;  // no forces before the first step
    const auto after = wallPower(run.snapshots[k]);
    const auto before = wallPower(run.snapshots[k - 1]);
    if (!after) return {};
    work += 0.5 * (before.value_or(*after) + *after) *
            (run.snapshots[k].contactTime - run.snapshots[k - 1].contactTime);
    energy[k] -= work;
  }
  return energy;
}

/// Energy above that of the start, and where losses count below it. What the law's springs would
/// hold at the start an engine of impulses need not make motion of: of that it loses nothing.
template <int D>
Curve energyChange(const RecordingOf<D>& run, bool losses) {
  Curve curve = ownEnergy(run);
  if (curve.empty()) return curve;
  const double start = curve.front(), scale = energyScale(run);
  const double least =
      start - (hasNoSprings(run) ? energyOf(run, run.snapshots.front()).elastic : 0.0);
  for (double& value : curve) {
    const double change = std::max({value - start, losses ? least - value : 0.0, 0.0});
    value = change == 0.0 ? 0.0 : change / scale;
  }
  return curve;
}

template <int D>
Curve energyGain(const RecordingOf<D>& run) {
  return energyChange(run, false);
}

template <int D>
Curve energyDrift(const RecordingOf<D>& run) {
  return energyChange(run, true);
}

template <int D>
Curve ledgerResidual(const RecordingOf<D>& run) {
  const double scale = energyScale(run);
  Curve curve;
  for (const SnapshotOf<D>& now : run.snapshots) {
    if (!now.ledger) return {};
    const double rest = std::abs(residual(*now.ledger));
    curve.push_back(rest == 0.0 ? 0.0 : rest / scale);
  }
  return curve;
}

/// Sum of a vector over the disks, weighed with their mass.
template <int D>
VecOf<D> massSum(const DisksOf<D>& disks, const std::vector<VecOf<D>>& of) {
  VecOf<D> sum = VecOf<D>::Zero();
  for (std::size_t i = 0; i < disks.size(); ++i) sum += disks.mass[i] * of[i];
  return sum;
}

template <int D>
double massOf(const DisksOf<D>& disks) {
  double mass = 0.0;
  for (const double each : disks.mass) mass += each;
  return mass;
}

template <int D>
Curve momentumDrift(const RecordingOf<D>& run) {
  const DisksOf<D>& disks = run.scene.disks;
  const VecOf<D> start = massSum(disks, disks.velocity);
  double scale = 0.0;
  for (const SnapshotOf<D>& now : run.snapshots) {
    double sum = 0.0;
    for (std::size_t i = 0; i < disks.size(); ++i) sum += disks.mass[i] * now.velocity[i].norm();
    scale = std::max(scale, sum);
  }
  return each(run, [&](const SnapshotOf<D>& now) {
    const VecOf<D> fallen = massOf(disks) * now.velocityTime * run.scene.gravity;
    const double change = (massSum(disks, now.velocity) - start - fallen).norm();
    return change == 0.0 ? 0.0 : change / scale;
  });
}

/// About the centre of mass and in its frame.
template <int D>
struct AngularMomentum {
  SpinOf<D> value = noSpin<D>();  ///< [kg m²/s]
  double scale = 0.0;             ///< upper bound of its size: Σ m (|x| + a) |v| + J |ω|
};

template <int D>
AngularMomentum<D> angularMomentumOf(const DisksOf<D>& disks, const SnapshotOf<D>& now) {
  const double mass = massOf(disks);
  std::vector<VecOf<D>> position = now.position;
  for (std::size_t i = 0; i < position.size(); ++i)
    position[i] -= (now.positionTime - now.velocityTime) * now.velocity[i];
  const VecOf<D> centre = massSum(disks, position) / mass,
                 drift = massSum(disks, now.velocity) / mass;
  AngularMomentum<D> sum;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const VecOf<D> arm = position[i] - centre, velocity = now.velocity[i] - drift;
    const SpinOf<D> spin = now.spin ? (*now.spin)[i] : disks.spin[i];
    if constexpr (D == 2)
      sum.value += disks.mass[i] * cross(arm, velocity) + disks.inertia[i] * spin;
    else
      sum.value +=
          disks.mass[i] * cross(arm, velocity) + spinMomentum(disks, i, spin, turnIn(now, i));
    sum.scale += disks.mass[i] * (arm.norm() + disks.radius[i]) * velocity.norm() +
                 disks.inertia[i] * sizeOf(spin);
  }
  return sum;
}

template <int D>
Curve angularMomentumDrift(const RecordingOf<D>& run) {
  const AngularMomentum<D> start = angularMomentumOf(run.scene.disks, run.snapshots.front());
  return each(run, [&](const SnapshotOf<D>& now) {
    const double change =
        sizeOf(SpinOf<D>(angularMomentumOf(run.scene.disks, now).value - start.value));
    return change == 0.0 ? 0.0 : change / start.scale;
  });
}

template <int D>
Curve maxOverlap(const RecordingOf<D>& run) {
  return each(run, [&](const SnapshotOf<D>& now) {
    double deepest = 0.0;
    for (const OverlapOf<D>& overlap :
         overlapsOf(run.scene, now.position, now.positionTime, now.turn ? &*now.turn : nullptr))
      deepest = std::max(deepest, overlap.depth / overlap.smallerRadius);
    return deepest;
  });
}

template <int D>
double endOf(const RecordingOf<D>& run) {
  return run.snapshots.back().positionTime;
}

/// When what is to be at rest should be [s].
template <int D>
double restFrom(const RecordingOf<D>& run) {
  return run.settle * endOf(run);
}

template <int D>
double farthest(const SceneOf<D>& scene, const SnapshotOf<D>& from, const SnapshotOf<D>& to) {
  double largest = 0.0;
  for (std::size_t i = 0; i < scene.disks.size(); ++i)
    largest = std::max(largest, apartIn<D>(scene, to.position[i] - from.position[i]).norm());
  return largest / smallestDiameter(scene);
}

/// The first snapshot from which on the scene should be at rest. What stands and yet moves by more
/// than contacts settle has fallen: its rest afterwards is not the one that is asked for.
template <int D>
const SnapshotOf<D>& restingStart(const RecordingOf<D>& run) {
  constexpr double mostSettling = 0.5;  // [diameters]
  const double from = restFrom(run) * (1.0 - 1e-9);
  const SnapshotOf<D>& first = run.snapshots.front();
  for (const SnapshotOf<D>& now : run.snapshots) {
    if (run.stands && farthest(run.scene, first, now) > mostSettling) return first;
    if (now.positionTime >= from) return now;
  }
  return run.snapshots.back();
}

/// False: all that is seen at rest is one snapshot, which is as far from itself as any.
template <int D>
bool isWatchedAtRest(const RecordingOf<D>& run) {
  return restingStart(run).positionTime < endOf(run);
}

template <int D>
Curve kineticAtRest(const RecordingOf<D>& run) {
  const double scale = energyScale(run), from = restingStart(run).positionTime;
  return each(run, [&](const SnapshotOf<D>& now) {
    const double kinetic = energyOf(run, now).kinetic;
    return now.positionTime >= from && kinetic > 0.0 ? kinetic / scale : 0.0;
  });
}

/// Farthest turn of a convex body since it should be at rest.
template <int D>
Curve lean(const RecordingOf<D>& run) {
  const SnapshotOf<D>& start = run.settle > 0.0 ? restingStart(run) : run.snapshots.front();
  if (!start.turn) return {};
  return each(run, [&](const SnapshotOf<D>& now) {
    double most = 0.0;
    for (std::size_t i = 0; now.turn && i < now.turn->size(); ++i)
      if (run.scene.isConvex(i) && now.positionTime >= start.positionTime)
        most = std::max(most, turnBetween<D>((*start.turn)[i], (*now.turn)[i]));
    return most;
  });
}

/// Number of convex bodies that are turned by more than 45° against the start.
template <int D>
Curve fallen(const RecordingOf<D>& run) {
  const SnapshotOf<D>& start = run.snapshots.front();
  if (!start.turn) return {};
  return each(run, [&](const SnapshotOf<D>& now) {
    std::size_t number = 0;
    for (std::size_t i = 0; now.turn && i < now.turn->size(); ++i)
      number += run.scene.isConvex(i) &&
                turnBetween<D>((*start.turn)[i], (*now.turn)[i]) > 0.25 * std::numbers::pi;
    return static_cast<double>(number);
  });
}

/// At the end, those that are not: 0 before.
template <int D>
Curve standing(const RecordingOf<D>& run) {
  Curve curve = fallen(run);
  if (curve.empty()) return {};
  const double last = curve.back();
  std::ranges::fill(curve, 0.0);
  for (std::size_t i = 0; i < run.scene.disks.size(); ++i) curve.back() += run.scene.isConvex(i);
  curve.back() -= last;
  return curve;
}

template <int D>
Curve creep(const RecordingOf<D>& run) {
  if (!isWatchedAtRest(run)) return {};
  const SnapshotOf<D>& start = restingStart(run);
  const double watched = endOf(run) - start.positionTime;
  return each(run, [&](const SnapshotOf<D>& now) {
    return now.positionTime >= start.positionTime ? farthest(run.scene, start, now) / watched : 0.0;
  });
}

/// Base angle of the isosceles triangle, in space of the cone, that has the second moments of the
/// disks' centres [deg].
template <int D>
double pileAngle(const SceneOf<D>& scene, const SnapshotOf<D>& now) {
  const DisksOf<D>& disks = scene.disks;
  VecOf<D> up = VecOf<D>::Unit(D - 1);
  if (!scene.gravity.isZero(0.0)) up = -scene.gravity.normalized();
  const VecOf<D> centre = massSum(disks, now.position) / massOf(disks);
  double across = 0.0, upward = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const VecOf<D> arm = now.position[i] - centre;
    upward += arm.dot(up) * arm.dot(up);
    across += (arm - arm.dot(up) * up).squaredNorm();
  }
  // Of a triangle: base²/24 and height²/18. Of a cone: 3/20 r² along each of two, and 3/80 h².
  const double slope = D == 2 ? std::sqrt(4.0 * 18.0 * upward) / std::sqrt(24.0 * across)
                              : std::sqrt(80.0 / 3.0 * upward) / std::sqrt(10.0 / 3.0 * across);
  return std::atan(slope) * 180.0 / std::numbers::pi;
}

template <int D>
Curve pileAngleChange(const RecordingOf<D>& run) {
  if (!isWatchedAtRest(run)) return {};
  const SnapshotOf<D>& start = restingStart(run);
  const double angle = pileAngle(run.scene, start);
  return each(run, [&](const SnapshotOf<D>& now) {
    return now.positionTime >= start.positionTime ? std::abs(pileAngle(run.scene, now) - angle)
                                                  : 0.0;
  });
}

/// Whether two bodies that went through each other by where they are did so: what has gone round
/// the other is farther by then than 1.27 of the reach, and no straight way stands for its path: it
/// is one that both velocities lead along.
/// @param way  of one past the other  @param led  that of its velocity before, and of that after
template <int D>
bool wentStraight(const VecOf<D>& way, const std::array<VecOf<D>, 2>& led, double reach) {
  const auto strays = [&](const VecOf<D>& one) { return (one - way).norm() > 0.5 * reach; };
  return way.norm() <= 1.25 * reach || std::ranges::none_of(led, strays);
}

/// Whether a disk went through another between two samples: their centres changed sides, and the
/// straight way between passes deep inside.
template <int D>
bool crossed(const VecOf<D>& before, const VecOf<D>& way, double reach) {
  if (before.dot(before + way) >= 0.0) return false;
  const double fraction = std::clamp(-before.dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (before + fraction * way).norm() < 0.5 * reach;
}

/// Radius of the largest circle, or sphere, about the centre of mass that is inside a body [m].
template <int D>
double innerRadius(const SceneOf<D>& scene, std::size_t i, double radius) {
  if (i >= scene.disks.size() || !scene.isConvex(i)) return radius;
  const ShapeOf<D> point = roundShape<D>(0.0);
  return overlapOf<D>(PlacedBody<D>(scene, i, VecOf<D>::Zero(), noTurn<D>()).get(), {&point});
}

/// The same of bodies of which one is convex. Centres tell nothing of a plank that another slides
/// along: the two overlapped on the straight way by more than half of what their inner radii are
/// together, and the shortest way out, along which a solver parts them, is reversed.
/// @param inner  sum of the inner radii [m]
/// @param turns  before and after; null: as at the start
template <int D>
bool crossed(const SceneOf<D>& scene, std::size_t i, std::size_t j, const VecOf<D>& before,
             const VecOf<D>& way, double reach, double inner,
             const std::array<const std::vector<TurnOf<D>>*, 2>& turns) {
  const auto overlap = [&](const VecOf<D>& apart, double share) {
    return overlapOfPair(scene, i, j, apart, turns[share < 0.5 ? 0 : 1]);
  };
  const auto wayOut = [&](double share) {
    const VecOf<D> place = before + share * way;
    VecOf<D> direction;
    for (int k = 0; k < D; ++k) {
      const VecOf<D> little = 1e-6 * reach * VecOf<D>::Unit(k);
      direction[k] = overlap(place - little, share) - overlap(place + little, share);
    }
    return direction;
  };
  const int parts = static_cast<int>(std::clamp(std::ceil(4.0 * way.norm() / inner), 1.0, 1e3));
  double deepest = 0.0;
  for (int k = 0; k <= parts; ++k) {
    const double share = static_cast<double>(k) / parts;
    const VecOf<D> place = before + share * way;
    if (place.norm() < reach) deepest = std::max(deepest, overlap(place, share));
  }
  return deepest > 0.5 * inner && wayOut(0.0).dot(wayOut(1.0)) < 0.0;
}

/// Adds disks whose centres are behind a plane or outside of a cylinder.
template <int D>
void addBehindWalls(const RecordingOf<D>& run, const SnapshotOf<D>& now,
                    std::set<std::size_t>& found) {
  const auto add = [&](std::size_t i, const PlaneOf<D>& plane) {
    if ((now.position[i] - plane.point).dot(plane.normal) < 0.0) found.insert(i);
  };
  const std::vector<PlaneOf<D>> planes = planesAt(run.scene, now.positionTime);
  for (std::size_t i = 0; i < now.position.size(); ++i) {
    for (const PlaneOf<D>& plane : planes) add(i, plane);
    if constexpr (D == 3)
      for (const WallBodyOf<D>& body : run.scene.bodies)
        for (const Cylinder& cylinder : body.cylinders)
          add(i, tangentPlane(cylinder, now.position[i]));
  }
}

template <int D>
Curve tunnelled(const RecordingOf<D>& run) {
  const std::size_t disks = run.scene.disks.size();
  std::set<std::size_t> through;
  Curve curve;
  const std::vector<double> radius = run.scene.radii();
  std::vector<VecOf<D>> before, after;
  const SnapshotOf<D>* last = nullptr;
  std::vector<double> inner;
  for (std::size_t k = 0; !run.scene.shapes.empty() && k < radius.size(); ++k)
    inner.push_back(innerRadius(run.scene, k, radius[k]));
  const auto turnsOf = [](const SnapshotOf<D>& at) { return at.turn ? &*at.turn : nullptr; };
  for (const SnapshotOf<D>& now : run.snapshots) {
    after = now.position;
    const std::vector<VecOf<D>> walls = wallDisksAt(run.scene, now.positionTime);
    after.insert(after.end(), walls.begin(), walls.end());
    const double passed = last ? now.positionTime - last->positionTime : 0.0;
    // Walls' disks have no velocities in a snapshot: their way is known.
    const auto led = [&](const SnapshotOf<D>& at, std::size_t k) {
      return k < disks ? VecOf<D>(passed * at.velocity[k]) : VecOf<D>(after[k] - before[k]);
    };
    if (last)
      for (std::size_t i = 0; i < disks; ++i)
        for (std::size_t j = i + 1; j < after.size(); ++j) {
          const VecOf<D> apart = apartIn<D>(run.scene, before[i] - before[j]),
                         way = (after[i] - before[i]) - (after[j] - before[j]);
          const double reach = radius[i] + radius[j];
          const bool convex = run.scene.isConvex(i) || (j < disks && run.scene.isConvex(j));
          if ((convex ? crossed<D>(run.scene, i, j, apart, way, reach, inner[i] + inner[j],
                                   {turnsOf(*last), turnsOf(now)})
                      : crossed<D>(apart, way, reach)) &&
              wentStraight<D>(way, {led(*last, i) - led(*last, j), led(now, i) - led(now, j)},
                              reach))
            through.insert(i);
        }
    addBehindWalls(run, now, through);
    before = std::move(after);
    last = &now;
    curve.push_back(static_cast<double>(through.size()));
  }
  return curve;
}

template <int D>
Curve escaped(const RecordingOf<D>& run) {
  return each(run, [&](const SnapshotOf<D>& now) {
    std::set<std::size_t> outside;
    addBehindWalls(run, now, outside);
    const std::vector<VecOf<D>> walls = wallDisksAt(run.scene, now.positionTime);
    VecOf<D> centre = VecOf<D>::Zero();
    for (const VecOf<D>& wall : walls) centre += wall / static_cast<double>(walls.size());
    double reach = 0.0;
    for (const VecOf<D>& wall : walls) reach = std::max(reach, (wall - centre).norm());
    if (!walls.empty())
      for (std::size_t i = 0; i < now.position.size(); ++i)
        if ((now.position[i] - centre).norm() > reach) outside.insert(i);
    return static_cast<double>(outside.size());
  });
}

/// Known once the disks have parted; the largest.
Curve restitutionError(const Recording& run) {
  if (run.collisions.empty()) return {};
  Curve curve(run.snapshots.size(), 0.0);
  curve.back() = std::ranges::max(restitutionErrors(run));
  return curve;
}

/// Distance of √(T_0/T) from 1 + t/τ, by that: Haff's law of a gas of equal spheres or disks in a
/// box that is periodic all around (Haff 1983). A collision takes m (1 − e²) T, T the mean square
/// of a component of the velocities, so that with ω collisions of each per time dT/dt = −(1 − e²) ω
/// T/D and 1/τ = (1 − e²) ω_0/2D; ω = 4 √(πT) n d² χ with χ = (1 − φ/2)/(1 − φ)³ (Carnahan and
/// Starling 1969), of disks 2 √(πT) n d χ with χ = (1 − 7/16 φ)/(1 − φ)² (Henderson 1975).
template <int D>
Curve haffError(const RecordingOf<D>& run) {
  const DisksOf<D>& disks = run.scene.disks;
  const auto& box = run.scene.box;
  const double radius = disks.radius.front();
  const auto alike = [&](double a) { return a == radius; };
  if (!box || !std::ranges::all_of(box->periodic, std::identity()) ||
      !std::ranges::all_of(disks.radius, alike))
    return {};
  const double mass = massOf(disks);
  const auto temperature = [&](const SnapshotOf<D>& now) {
    const VecOf<D> drift = massSum(disks, now.velocity) / mass;
    double sum = 0.0;
    for (std::size_t i = 0; i < disks.size(); ++i)
      sum += disks.mass[i] * (now.velocity[i] - drift).squaredNorm();
    return sum / (D * mass);
  };
  const double start = temperature(run.snapshots.front()), speed = std::sqrt(start);
  CollidingPair pair{};
  for (const int k : {0, 1}) {
    pair.radius[k] = radius;
    pair.mass[k] = disks.mass.front();
    pair.inertia[k] = disks.inertia.front();
  }
  const double en = oracleOutcome(run.law, pair, {.vn = speed}).en;
  const double number = static_cast<double>(disks.size()) / (box->high - box->low).prod();
  const double pi = std::numbers::pi, d = 2.0 * radius;
  const double filled = number * (D == 2 ? pi * d * d / 4.0 : pi * d * d * d / 6.0);
  const double denser = D == 2 ? (1.0 - 7.0 / 16.0 * filled) / std::pow(1.0 - filled, 2)
                               : (1.0 - 0.5 * filled) / std::pow(1.0 - filled, 3);
  const double often =
      (D == 2 ? 2.0 * d : 4.0 * d * d) * std::sqrt(pi) * number * denser * speed;  // ω_0 [1/s]
  const double rate = (1.0 - en * en) * often / (2.0 * D);
  return each(run, [&](const SnapshotOf<D>& now) {
    const double expected = 1.0 + now.velocityTime * rate;
    return std::abs(std::sqrt(start / temperature(now)) - expected) / expected;
  });
}

/// Kinetic energy that bodies would have if velocities changed on as they did between two
/// snapshots of a burst of steps, for as long as nothing was seen before the burst [J].
/// @param first  not the first of the run
template <int D>
double energyOfPush(const RecordingOf<D>& run, std::size_t first, std::size_t last) {
  const auto after = [&](std::size_t k, std::size_t earlier) {
    return run.snapshots[k].positionTime - run.snapshots[earlier].positionTime;
  };
  const SnapshotOf<D>&from = run.snapshots[first], &to = run.snapshots[last];
  std::size_t burst = first;
  while (burst > 1 && after(burst, burst - 1) < 1.5 * run.effective.dt) --burst;
  const double longer = std::max(after(burst, burst - 1) / after(last, first), 1.0);
  SnapshotOf<D> change = to;
  for (std::size_t i = 0; i < change.velocity.size(); ++i)
    change.velocity[i] = longer * (to.velocity[i] - from.velocity[i]);
  if (to.spin && from.spin)
    for (std::size_t i = 0; i < change.spin->size(); ++i)
      (*change.spin)[i] = longer * ((*to.spin)[i] - (*from.spin)[i]);
  return kineticEnergy(run.scene.disks, change);
}

/// Bodies that have come to rest and move again: their kinetic energy then. At rest it is below
/// 10⁻⁸ of the energy over eight steps, and so is that of what pushes them: a swing that turns back
/// is still for as long. Empty where walls move or nothing rests.
template <int D>
Curve wakes(const RecordingOf<D>& run) {
  constexpr double still = 1e-8;
  if (wallsMove(run.scene)) return {};
  const double scale = energyScale(run);
  std::size_t place = 0, quiet = 0;
  bool rested = false;
  const Curve curve = each(run, [&](const SnapshotOf<D>& now) {
    const double kinetic = energyOf(run, now).kinetic / scale;
    const bool before = rested;
    quiet = kinetic < still ? quiet + 1 : 0;  // false for what is no number
    const std::size_t first = place + 1 - std::min<std::size_t>(quiet, burstSteps);
    rested = rested ||
             (quiet >= burstSteps && first > 0 && energyOfPush(run, first, place) < still * scale);
    ++place;
    return before ? kinetic : 0.0;
  });
  return rested ? curve : Curve{};
}

/// Momentum and angular momentum of all disks in the windows of consecutive steps, beyond what
/// gravity and the walls have given them by the forces that the engine shows: the larger of both
/// sums, each by the sum of sizes of what gave it. Over a window Δp = Σ (M g − Σ F) dt, F on a
/// wall, and ΔL = Σ (X × M g − Σ (T + c × F)) dt about the origin. There is no ΔL in a periodic
/// box, nor where friction acts on spins that are held: what holds them turns with torques that
/// nothing shows. Forces of an instant count by trapezoids.
template <int D>
Curve wallBalance(const RecordingOf<D>& run) {
  if (run.scene.bottom) return {};
  const DisksOf<D>& disks = run.scene.disks;
  const double mass = massOf(disks), dt = run.effective.dt;
  const Effects& acts = run.effective.effects;
  const bool turns =
      !run.scene.box && (acts.contains(Effect::rotation) || !acts.contains(Effect::friction));
  struct Rates {
    VecOf<D> force = VecOf<D>::Zero();
    SpinOf<D> torque = noSpin<D>();
    double sizes[2] = {0.0, 0.0};
  };
  bool shown = true;
  const auto ratesOf = [&](const SnapshotOf<D>& now) {
    Rates rates;
    const VecOf<D> weight = mass * run.scene.gravity;
    const auto add = [&](const VecOf<D>& place, const VecOf<D>& force, const SpinOf<D>& torque) {
      const SpinOf<D> about = cross(place, force) + torque;
      rates.force += force;
      rates.torque += about;
      rates.sizes[0] += force.norm();
      rates.sizes[1] += sizeOf(about);
    };
    add(massSum(disks, now.position) / mass, weight, noSpin<D>());
    for (const BodySnapshotOf<D>& body : now.bodies) {
      shown = shown && body.force && body.torque;
      if (shown) add(body.centre, -*body.force, -*body.torque);
    }
    return rates;
  };
  const auto turning = [&](const SnapshotOf<D>& now) {
    SpinOf<D> sum = noSpin<D>();
    for (std::size_t i = 0; i < disks.size(); ++i) {
      const VecOf<D> place =
          now.position[i] - (now.positionTime - now.velocityTime) * now.velocity[i];
      sum += disks.mass[i] * cross(place, now.velocity[i]) +
             disks.inertia[i] * (now.spin ? (*now.spin)[i] : disks.spin[i]);
    }
    return sum;
  };
  VecOf<D> momentum = VecOf<D>::Zero();
  SpinOf<D> angular = noSpin<D>();
  double sizes[2] = {0.0, 0.0};
  Curve curve(1, 0.0);
  for (std::size_t k = 1; k < run.snapshots.size(); ++k) {
    const SnapshotOf<D>&before = run.snapshots[k - 1], &now = run.snapshots[k];
    const double passed = now.positionTime - before.positionTime;  // 0 where two looks meet
    if (before.positionTime > 0.0 && passed < 1.5 * dt) {
      const Rates end = ratesOf(now), start = now.contactInterval > 0.0 ? end : ratesOf(before);
      if (!shown) return {};
      momentum += massSum(disks, now.velocity) - massSum(disks, before.velocity) -
                  0.5 * passed * (start.force + end.force);
      angular += turning(now) - turning(before) - 0.5 * passed * (start.torque + end.torque);
      for (const int n : {0, 1}) sizes[n] += 0.5 * passed * (start.sizes[n] + end.sizes[n]);
    }
    const auto share = [](double error, double of) { return of > 0.0 ? error / of : 0.0; };
    curve.push_back(
        std::max(share(momentum.norm(), sizes[0]), turns ? share(sizeOf(angular), sizes[1]) : 0.0));
  }
  return curve;
}

template <int D>
Curve timeToRest(const RecordingOf<D>& run) {
  constexpr double still = 1e-6;
  const double scale = energyScale(run);
  double last = 0.0;
  return each(run, [&](const SnapshotOf<D>& now) {
    if (energyOf(run, now).kinetic > still * scale) last = now.positionTime;
    return last;
  });
}

/// How far a disk has moved from one cycle of the oscillating wall to the next.
template <int D>
Curve ratchet(const RecordingOf<D>& run) {
  const auto& bodies = run.scene.bodies;
  const auto wall = std::ranges::find_if(bodies, [](const WallBodyOf<D>& body) {
    return body.motion.kind == MotionKind::oscillating;
  });
  if (wall == bodies.end() || run.snapshots.size() < 2) return {};
  const double cycle = 2.0 * std::numbers::pi / wall->motion.frequency;
  const auto samples = static_cast<std::size_t>(
      std::llround(cycle / (endOf(run) / static_cast<double>(run.snapshots.size() - 1))));
  Curve curve(run.snapshots.size(), 0.0);
  const double from = restingStart(run).positionTime;
  bool compared = false;
  for (std::size_t k = samples; k < curve.size(); ++k)
    if (samples > 0 && run.snapshots[k - samples].positionTime >= from) {
      curve[k] = farthest(run.scene, run.snapshots[k - samples], run.snapshots[k]);
      compared = true;
    }
  return compared ? curve : Curve{};
}

constexpr std::array measures = {
    StabilityMeasure{"energy_gain", "of the energy",
                     "kinetic, elastic and potential energy above that of the start, without the "
                     "work of moving walls",
                     energyGain<2>, energyGain<3>, StabilityProtocol::oneRun, true},
    StabilityMeasure{"energy_drift", "of the energy", "the same, gained or lost", energyDrift<2>,
                     energyDrift<3>, StabilityProtocol::oneRun, true},
    StabilityMeasure{"ledger_residual", "of the energy",
                     "what no term of the engine's own energy ledger accounts for",
                     ledgerResidual<2>, ledgerResidual<3>, StabilityProtocol::oneRun, true},
    StabilityMeasure{"momentum_drift", "of Σ m|v|",
                     "change of the bodies' momentum beyond gravity's, in a scene without walls",
                     momentumDrift<2>, momentumDrift<3>},
    StabilityMeasure{"angular_momentum_drift", "of Σ m(|x|+a)|v|",
                     "change of the angular momentum about the centre of mass, without walls",
                     angularMomentumDrift<2>, angularMomentumDrift<3>},
    StabilityMeasure{"max_overlap", "radii", "deepest overlap, by the smaller radius of the two",
                     maxOverlap<2>, maxOverlap<3>},
    StabilityMeasure{"kinetic_at_rest", "of the energy", "kinetic energy of what should be at rest",
                     kineticAtRest<2>, kineticAtRest<3>},
    StabilityMeasure{"creep", "diameters/s", "farthest displacement at rest, by the time watched",
                     creep<2>, creep<3>},
    StabilityMeasure{"lean", "rad", "farthest turn of a convex body at rest", lean<2>, lean<3>},
    StabilityMeasure{"fallen", "bodies", "convex bodies turned by more than 45° at once", fallen<2>,
                     fallen<3>},
    StabilityMeasure{"standing", "bodies", "convex bodies not turned by 45° at the end",
                     standing<2>, standing<3>},
    StabilityMeasure{"pile_angle_change", "degrees", "of the slope of a pile at rest",
                     pileAngleChange<2>, pileAngleChange<3>},
    StabilityMeasure{"copies_differ", "diameters",
                     "farthest a body is from its place in the first variant of the case", nullptr,
                     nullptr, StabilityProtocol::againstOriginal},
    StabilityMeasure{"tunnelled", "bodies", "bodies that went through another or a wall",
                     tunnelled<2>, tunnelled<3>},
    StabilityMeasure{"escaped", "bodies", "bodies outside the walls at once", escaped<2>,
                     escaped<3>},
    StabilityMeasure{"restitution_error", "-", "distance of e_n from the oracle's",
                     restitutionError},
    StabilityMeasure{"time_to_rest", "s", "until the kinetic energy stays below 10⁻⁶ of the energy",
                     timeToRest<2>, timeToRest<3>},
    StabilityMeasure{"ratchet", "diameters/cycle",
                     "farthest a body moves from one cycle of an oscillating wall to the next",
                     ratchet<2>, ratchet<3>},
    StabilityMeasure{"haff_error", "-",
                     "distance of √(T_0/T) from Haff's 1 + t/τ, by that; of a periodic gas",
                     haffError<2>, haffError<3>},
    StabilityMeasure{"wakes", "of the energy",
                     "kinetic energy of what had come to rest between walls that stand still",
                     wakes<2>, wakes<3>, StabilityProtocol::oneRun, false, burstSteps,
                     "has nothing that comes to rest"},
    StabilityMeasure{"wall_balance", "of the impulse",
                     "momentum or angular momentum beyond that from gravity and the walls' forces",
                     wallBalance<2>, wallBalance<3>, StabilityProtocol::oneRun, false, burstSteps},
    StabilityMeasure{"step_limit", "-",
                     "1 − the largest stable time step by that of theory, 2/ω_max of the contacts",
                     nullptr, nullptr, StabilityProtocol::stepLimit},
    StabilityMeasure{"largest_step", "-",
                     "the case's time step by the largest with which the run is still sound",
                     nullptr, nullptr, StabilityProtocol::largestStep},
    StabilityMeasure{"restart_differs", "diameters",
                     "between a run and one restarted from a checkpoint at its middle", nullptr,
                     nullptr, StabilityProtocol::restart},
    StabilityMeasure{
        "invariances", "of rounding",
        "farthest a turned, mirrored, rescaled, renumbered, restarted or unwatched run "
        "is from where it should be, by how far rounding may take it",
        nullptr, nullptr, StabilityProtocol::invariances},
    StabilityMeasure{"accepted", "-", "1 where a start that no engine can run was not refused",
                     nullptr, nullptr, StabilityProtocol::acceptance}};

}  // namespace

template <int D>
bool isSound(const RecordingOf<D>& run, const RecordingOf<D>& calm) {
  constexpr double growth = 100.0, deepest = 1.0;  // by then centres pass each other
  if (!run.failure.empty()) return false;
  const auto largest = [](const Curve& curve) {
    return curve.empty() ? 0.0 : std::ranges::max(curve);
  };
  const auto kinetic = [](const RecordingOf<D>& of) {
    double most = 0.0;
    for (const SnapshotOf<D>& now : of.snapshots) {
      const double energy = energyOf(of, now).kinetic;
      if (!std::isfinite(energy)) return std::numeric_limits<double>::infinity();
      most = std::max(most, energy);
    }
    return most;
  };
  constexpr double gained = 0.1;
  const bool driven = effectsOf(run.scene).contains(Effect::movingWalls);
  return largest(maxOverlap(run)) < deepest && largest(tunnelled(run)) == 0.0 &&
         kinetic(run) <= growth * kinetic(calm) && (driven || largest(energyGain(run)) <= gained);
}
template bool isSound<2>(const Recording&, const Recording&);
template bool isSound<3>(const SpaceRecording&, const SpaceRecording&);

std::span<const StabilityMeasure> stabilityMeasures() {
  return measures;
}

const StabilityMeasure& stabilityMeasure(std::string_view name) {
  const auto found = std::ranges::find(measures, name, &StabilityMeasure::name);
  if (found == measures.end()) throw std::out_of_range("no measure " + std::string(name));
  return *found;
}

std::vector<double> restitutionErrors(const Recording& run) {
  std::vector<double> errors;
  std::map<std::pair<double, double>, double> expected;  // of starts that are alike
  for (std::size_t k = 0; k < run.collisions.size(); ++k) {
    const CollisionStart& start = run.collisions[k];
    const auto [known, isNew] = expected.try_emplace({start.psi, start.vn});
    if (isNew) known->second = oracleOutcome(run.law, pairOf(run.scene, k), start).en;
    const auto end = collisionEnd(run.scene, run.snapshots.back(), k, start);
    errors.push_back(std::abs((end ? end->en : 0.0) - known->second));
  }
  return errors;
}

template <int D>
double largestDistance(const SceneOf<D>& scene, const SnapshotOf<D>& one,
                       const SnapshotOf<D>& other) {
  return farthest(scene, one, other);
}
template double largestDistance<2>(const Scene&, const Snapshot&, const Snapshot&);
template double largestDistance<3>(const SpaceScene&, const SpaceSnapshot&, const SpaceSnapshot&);

template <int D>
std::vector<double> copiesDiffer(const RecordingOf<D>& original, const RecordingOf<D>& copy) {
  const auto way = [](const RecordingOf<D>& run, const SnapshotOf<D>& now, std::size_t i) {
    if constexpr (D == 2)
      return run.placement.undoneAt(now.position[i], now.positionTime);
    else
      return Vec3(now.position[i] - run.scene.disks.position[i]);
  };
  const double diameter = smallestDiameter(original.scene);
  Curve curve;
  const std::size_t both = std::min(original.snapshots.size(), copy.snapshots.size());
  for (std::size_t k = 0; k < both; ++k) {
    const SnapshotOf<D>&here = original.snapshots[k], &there = copy.snapshots[k];
    double largest = 0.0;
    for (std::size_t i = 0; i < here.position.size(); ++i)
      largest = std::max(largest, (way(original, here, i) - way(copy, there, i)).norm());
    curve.push_back(largest / diameter);
  }
  return curve;
}
template Curve copiesDiffer<2>(const Recording&, const Recording&);
template Curve copiesDiffer<3>(const SpaceRecording&, const SpaceRecording&);

}  // namespace crossgrain::inline stability
