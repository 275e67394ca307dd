#include "stability/measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "oracle/collision_flight.hpp"
#include "oracle/collision_oracle.hpp"

namespace crossgrain::inline stability {

namespace {

using Curve = std::vector<double>;

/// A value for each snapshot.
template <typename Value>
Curve each(const Recording& run, Value&& value) {
  Curve curve;
  for (const Snapshot& snapshot : run.snapshots) curve.push_back(value(snapshot));
  return curve;
}

bool wallsMove(const Scene& scene) {
  return effectsOf(scene).contains(Effect::movingWalls);
}

/// Power that the walls put into the disks, from the forces on the walls [W].
std::optional<double> wallPower(const Snapshot& snapshot) {
  double power = 0.0;
  for (const BodySnapshot& body : snapshot.bodies) {
    const bool turns = body.angularVelocity != 0.0, travels = !body.velocity.isZero(0.0);
    if ((travels && !body.force) || (turns && !body.torque)) return std::nullopt;
    if (travels) power -= body.force->dot(body.velocity);
    if (turns) power -= *body.torque * body.angularVelocity;
  }
  return power;
}

/// Energy less what the walls have put in since the start [J]; empty where that is not known.
Curve ownEnergy(const Recording& run) {
  Curve energy = each(run, [&](const Snapshot& now) {
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
Curve energyChange(const Recording& run, bool losses) {
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

Curve energyGain(const Recording& run) {
  return energyChange(run, false);
}

Curve energyDrift(const Recording& run) {
  return energyChange(run, true);
}

Curve ledgerResidual(const Recording& run) {
  const double scale = energyScale(run);
  Curve curve;
  for (const Snapshot& now : run.snapshots) {
    if (!now.ledger) return {};
    const double rest = std::abs(residual(*now.ledger));
    curve.push_back(rest == 0.0 ? 0.0 : rest / scale);
  }
  return curve;
}

/// Sum of a vector over the disks, weighed with their mass.
Vec2 massSum(const Disks& disks, const std::vector<Vec2>& of) {
  Vec2 sum = Vec2::Zero();
  for (std::size_t i = 0; i < disks.size(); ++i) sum += disks.mass[i] * of[i];
  return sum;
}

double massOf(const Disks& disks) {
  double mass = 0.0;
  for (const double each : disks.mass) mass += each;
  return mass;
}

Curve momentumDrift(const Recording& run) {
  const Disks& disks = run.scene.disks;
  const Vec2 start = massSum(disks, disks.velocity);
  double scale = 0.0;
  for (const Snapshot& now : run.snapshots) {
    double sum = 0.0;
    for (std::size_t i = 0; i < disks.size(); ++i) sum += disks.mass[i] * now.velocity[i].norm();
    scale = std::max(scale, sum);
  }
  return each(run, [&](const Snapshot& now) {
    const Vec2 fallen = massOf(disks) * now.velocityTime * run.scene.gravity;
    const double change = (massSum(disks, now.velocity) - start - fallen).norm();
    return change == 0.0 ? 0.0 : change / scale;
  });
}

/// About the centre of mass and in its frame.
struct AngularMomentum {
  double value = 0.0;  ///< [kg m²/s]
  double scale = 0.0;  ///< what it could have been: Σ m (|x| + a) |v| + J |ω|
};

AngularMomentum angularMomentumOf(const Disks& disks, const Snapshot& now) {
  const double mass = massOf(disks);
  std::vector<Vec2> position = now.position;
  for (std::size_t i = 0; i < position.size(); ++i)
    position[i] -= (now.positionTime - now.velocityTime) * now.velocity[i];
  const Vec2 centre = massSum(disks, position) / mass, drift = massSum(disks, now.velocity) / mass;
  AngularMomentum sum;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const Vec2 arm = position[i] - centre, velocity = now.velocity[i] - drift;
    const double spin = now.spin ? (*now.spin)[i] : disks.spin[i];
    sum.value += disks.mass[i] * cross(arm, velocity) + disks.inertia[i] * spin;
    sum.scale += disks.mass[i] * (arm.norm() + disks.radius[i]) * velocity.norm() +
                 disks.inertia[i] * std::abs(spin);
  }
  return sum;
}

Curve angularMomentumDrift(const Recording& run) {
  const AngularMomentum start = angularMomentumOf(run.scene.disks, run.snapshots.front());
  return each(run, [&](const Snapshot& now) {
    const double change = angularMomentumOf(run.scene.disks, now).value - start.value;
    return change == 0.0 ? 0.0 : std::abs(change) / start.scale;
  });
}

Curve maxOverlap(const Recording& run) {
  return each(run, [&](const Snapshot& now) {
    double deepest = 0.0;
    for (const Overlap& overlap : overlapsOf(run.scene, now.position, now.positionTime))
      deepest = std::max(deepest, overlap.depth / overlap.smallerRadius);
    return deepest;
  });
}

double endOf(const Recording& run) {
  return run.snapshots.back().positionTime;
}

/// When what is to be at rest should be [s].
double restFrom(const Recording& run) {
  return run.settle * endOf(run);
}

/// The first snapshot from which on the scene should be at rest.
const Snapshot& restingStart(const Recording& run) {
  const double from = restFrom(run) * (1.0 - 1e-9);
  return *std::ranges::find_if(run.snapshots,
                               [&](const Snapshot& now) { return now.positionTime >= from; });
}

bool atRest(const Recording& run, const Snapshot& now) {
  return now.positionTime >= restingStart(run).positionTime;
}

/// False: all that is seen at rest is one snapshot, which is as far from itself as any.
bool isWatchedAtRest(const Recording& run) {
  return restingStart(run).positionTime < endOf(run);
}

Curve kineticAtRest(const Recording& run) {
  const double scale = energyScale(run);
  return each(run, [&](const Snapshot& now) {
    const double kinetic = energyOf(run, now).kinetic;
    return atRest(run, now) && kinetic > 0.0 ? kinetic / scale : 0.0;
  });
}

double farthest(const Scene& scene, const Snapshot& from, const Snapshot& to) {
  double largest = 0.0;
  for (std::size_t i = 0; i < scene.disks.size(); ++i)
    largest = std::max(largest, (to.position[i] - from.position[i]).norm());
  return largest / smallestDiameter(scene);
}

Curve creep(const Recording& run) {
  if (!isWatchedAtRest(run)) return {};
  const Snapshot& start = restingStart(run);
  const double watched = endOf(run) - start.positionTime;
  return each(run, [&](const Snapshot& now) {
    return atRest(run, now) ? farthest(run.scene, start, now) / watched : 0.0;
  });
}

/// Base angle of the isosceles triangle that has the second moments of the disks' centres [deg].
double pileAngle(const Scene& scene, const Snapshot& now) {
  const Disks& disks = scene.disks;
  const Vec2 up =
      scene.gravity.isZero(0.0) ? Vec2(Vec2::UnitY()) : Vec2(-scene.gravity.normalized());
  const Vec2 along = -perpendicular(up);
  const Vec2 centre = massSum(disks, now.position) / massOf(disks);
  double across = 0.0, upward = 0.0;
  for (std::size_t i = 0; i < disks.size(); ++i) {
    const Vec2 arm = now.position[i] - centre;
    across += arm.dot(along) * arm.dot(along);
    upward += arm.dot(up) * arm.dot(up);
  }
  // Of a triangle: base²/24 and height²/18.
  return std::atan2(2.0 * std::sqrt(18.0 * upward), std::sqrt(24.0 * across)) * 180.0 /
         std::numbers::pi;
}

Curve pileAngleChange(const Recording& run) {
  if (!isWatchedAtRest(run)) return {};
  const double start = pileAngle(run.scene, restingStart(run));
  return each(run, [&](const Snapshot& now) {
    return atRest(run, now) ? std::abs(pileAngle(run.scene, now) - start) : 0.0;
  });
}

/// Whether two bodies went through each other between two samples: their centres changed sides, and
/// the straight way between passes deep inside.
bool crossed(const Vec2& before, const Vec2& after, double reach) {
  if (before.dot(after) >= 0.0) return false;
  const Vec2 way = after - before;
  const double fraction = std::clamp(-before.dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (before + fraction * way).norm() < 0.5 * reach;
}

void addBehindPlanes(const Recording& run, const Snapshot& now, std::set<std::size_t>& found) {
  for (const Plane& plane : planesAt(run.scene, now.positionTime))
    for (std::size_t i = 0; i < now.position.size(); ++i)
      if ((now.position[i] - plane.point).dot(plane.normal) < 0.0) found.insert(i);
}

Curve tunnelled(const Recording& run) {
  const Disks& disks = run.scene.disks;
  std::set<std::size_t> through;
  Curve curve;
  std::vector<double> radius = disks.radius;
  for (const WallBody& body : run.scene.bodies)
    radius.insert(radius.end(), body.diskRadius.begin(), body.diskRadius.end());
  std::vector<Vec2> before, after;
  for (const Snapshot& now : run.snapshots) {
    after = now.position;
    const std::vector<Vec2> walls = wallDisksAt(run.scene, now.positionTime);
    after.insert(after.end(), walls.begin(), walls.end());
    if (!before.empty())
      for (std::size_t i = 0; i < disks.size(); ++i)
        for (std::size_t j = i + 1; j < after.size(); ++j)
          if (crossed(before[i] - before[j], after[i] - after[j], radius[i] + radius[j]))
            through.insert(i);
    addBehindPlanes(run, now, through);
    before = std::move(after);
    curve.push_back(static_cast<double>(through.size()));
  }
  return curve;
}

Curve escaped(const Recording& run) {
  return each(run, [&](const Snapshot& now) {
    std::set<std::size_t> outside;
    addBehindPlanes(run, now, outside);
    const std::vector<Vec2> walls = wallDisksAt(run.scene, now.positionTime);
    Vec2 centre = Vec2::Zero();
    for (const Vec2& wall : walls) centre += wall / static_cast<double>(walls.size());
    double reach = 0.0;
    for (const Vec2& wall : walls) reach = std::max(reach, (wall - centre).norm());
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

Curve timeToRest(const Recording& run) {
  constexpr double still = 1e-6;
  const double scale = energyScale(run);
  double last = 0.0;
  return each(run, [&](const Snapshot& now) {
    if (energyOf(run, now).kinetic > still * scale) last = now.positionTime;
    return last;
  });
}

/// How far a disk has moved from one cycle of the oscillating wall to the next.
Curve ratchet(const Recording& run) {
  const auto& bodies = run.scene.bodies;
  const auto wall = std::ranges::find_if(
      bodies, [](const WallBody& body) { return body.motion.kind == Motion::Kind::oscillating; });
  if (wall == bodies.end() || run.snapshots.size() < 2) return {};
  const double cycle = 2.0 * std::numbers::pi / wall->motion.frequency;
  const auto samples = static_cast<std::size_t>(
      std::llround(cycle / (endOf(run) / static_cast<double>(run.snapshots.size() - 1))));
  Curve curve(run.snapshots.size(), 0.0);
  bool compared = false;
  for (std::size_t k = samples; k < curve.size(); ++k)
    if (samples > 0 && atRest(run, run.snapshots[k - samples])) {
      curve[k] = farthest(run.scene, run.snapshots[k - samples], run.snapshots[k]);
      compared = true;
    }
  return compared ? curve : Curve{};
}

constexpr std::array measures = {
    StabilityMeasure{"energy_gain", "of the energy",
                     "kinetic, elastic and potential energy above that of the start, without the "
                     "work of moving walls",
                     energyGain, StabilityProtocol::oneRun, true},
    StabilityMeasure{"energy_drift", "of the energy", "the same, gained or lost", energyDrift,
                     StabilityProtocol::oneRun, true},
    StabilityMeasure{"ledger_residual", "of the energy",
                     "what no term of the engine's own energy ledger accounts for", ledgerResidual,
                     StabilityProtocol::oneRun, true},
    StabilityMeasure{"momentum_drift", "of Σ m|v|",
                     "change of the disks' momentum beyond gravity's, in a scene without walls",
                     momentumDrift},
    StabilityMeasure{"angular_momentum_drift", "of Σ m(|x|+a)|v|",
                     "change of the angular momentum about the centre of mass, without walls",
                     angularMomentumDrift},
    StabilityMeasure{"max_overlap", "radii", "deepest overlap, by the smaller radius of the two",
                     maxOverlap},
    StabilityMeasure{"kinetic_at_rest", "of the energy", "kinetic energy of what should be at rest",
                     kineticAtRest},
    StabilityMeasure{"creep", "diameters/s", "farthest displacement at rest, by the time watched",
                     creep},
    StabilityMeasure{"pile_angle_change", "degrees", "of the slope of a pile at rest",
                     pileAngleChange},
    StabilityMeasure{"copies_differ", "diameters",
                     "farthest a disk is from its place in the first variant of the case", nullptr,
                     StabilityProtocol::againstOriginal},
    StabilityMeasure{"tunnelled", "disks", "disks that went through another or a wall", tunnelled},
    StabilityMeasure{"escaped", "disks", "disks outside the walls at once", escaped},
    StabilityMeasure{"restitution_error", "-", "distance of e_n from the oracle's",
                     restitutionError},
    StabilityMeasure{"time_to_rest", "s", "until the kinetic energy stays below 10⁻⁶ of the energy",
                     timeToRest},
    StabilityMeasure{"ratchet", "diameters/cycle",
                     "farthest a disk moves from one cycle of an oscillating wall to the next",
                     ratchet},
    StabilityMeasure{"step_limit", "-",
                     "1 − the largest stable time step by that of theory, 2/ω_max of the contacts",
                     nullptr, StabilityProtocol::stepLimit},
    StabilityMeasure{"largest_step", "-",
                     "the case's time step by the largest with which the run is still sound",
                     nullptr, StabilityProtocol::largestStep},
    StabilityMeasure{"restart_differs", "diameters",
                     "between a run and one restarted from a checkpoint at its middle", nullptr,
                     StabilityProtocol::restart},
    StabilityMeasure{"accepted", "-", "1 where a start that no engine can run was not refused",
                     nullptr, StabilityProtocol::acceptance}};

}  // namespace

bool isSound(const Recording& run, const Recording& calm) {
  constexpr double growth = 100.0, deepest = 1.0;  // by then centres pass each other
  if (!run.failure.empty()) return false;
  const auto largest = [](const Curve& curve) {
    return curve.empty() ? 0.0 : std::ranges::max(curve);
  };
  const auto kinetic = [](const Recording& of) {
    double most = 0.0;
    for (const Snapshot& now : of.snapshots) {
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

double largestDistance(const Scene& scene, const Snapshot& one, const Snapshot& other) {
  return farthest(scene, one, other);
}

std::vector<double> copiesDiffer(const Recording& original, const Recording& copy) {
  const double diameter = smallestDiameter(original.scene);
  Curve curve;
  const std::size_t both = std::min(original.snapshots.size(), copy.snapshots.size());
  for (std::size_t k = 0; k < both; ++k) {
    const Snapshot &here = original.snapshots[k], &there = copy.snapshots[k];
    double largest = 0.0;
    for (std::size_t i = 0; i < here.position.size(); ++i)
      largest =
          std::max(largest, (original.placement.undoneAt(here.position[i], here.positionTime) -
                             copy.placement.undoneAt(there.position[i], there.positionTime))
                                .norm());
    curve.push_back(largest / diameter);
  }
  return curve;
}

}  // namespace crossgrain::inline stability
