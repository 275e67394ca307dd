#include "cases/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/collision_scene.hpp"
#include "oracle/impact.hpp"

namespace crossgrain::inline cases {

namespace {

/// A single disk meets walls only.
double lightestReducedMass(const Assembly& assembly) {
  double lightest = INFINITY, second = INFINITY;
  for (const DiskGroup& group : assembly.disks) {
    const double smallest = group.mass * (1.0 - group.radiusSpread) * (1.0 - group.radiusSpread);
    for (std::size_t k = 0; k < std::min<std::size_t>(group.places.size(), 2); ++k) {
      second = std::min(second, std::max(lightest, smallest));
      lightest = std::min(lightest, smallest);
    }
  }
  for (const Disks& disks : assembly.starts.disks)
    for (const double mass : disks.mass) {
      second = std::min(second, std::max(lightest, mass));
      lightest = std::min(lightest, mass);
    }
  return 1.0 / (1.0 / lightest + 1.0 / second);
}

}  // namespace

double lightestReducedMass(const Case& c) {
  if (c.kind == CaseKind::collision) return collidingPair(c).reducedMass();
  if (c.kind == CaseKind::assembly) return lightestReducedMass(c.assembly);
  // A single disk of a kind never meets its like, but a bound is all that is wanted.
  const Particles& p = c.particles;
  if (p.small > 0 && p.large == 0) return p.smallMass / 2.0;
  if (p.large > 0 && p.small == 0) return p.largeMass / 2.0;
  return std::min(p.smallMass, p.largeMass) / 2.0;
}

double timeStep(const Case& c) {
  if (c.kind == CaseKind::collision) return collisionTimeSteps(c).front();
  if (c.run.dt) return *c.run.dt;
  return contactTime(c.law, lightestReducedMass(c)) / c.run.stepsPerContact;
}

double preparationTime(const Case& c) {
  const Preparation& how = c.preparation;
  return how.shrinkTime + how.rotations * 2.0 * std::numbers::pi / std::abs(c.cell.omega);
}

double preparationSteps(const Case& c) {
  return preparationTime(c) / (c.preparation.dt ? *c.preparation.dt : timeStep(c));
}

ImpactTimes impactTimes(const Case& c) {
  if (!c.law.soft()) return {};
  const CollidingPair pair = collidingPair(c);
  if (!c.law.stiffens()) {
    const double each = contactTime(c.law, pair.reducedMass());
    return {each, each};
  }
  const auto time = [&](double speed) {
    return impactTime(c.law, {pair.reducedMass(), pair.reducedRadius(), speed});
  };
  std::vector<double> speeds;
  for (const CollisionStart& start : collisionStarts(c)) speeds.push_back(start.vn);
  const auto [slowest, fastest] = std::ranges::minmax(speeds);
  const auto [shortest, longest] = std::minmax({time(slowest), time(fastest)});
  return {shortest, longest};
}

std::vector<double> collisionTimeSteps(const Case& c) {
  if (c.run.dt) return {*c.run.dt};
  std::vector<double> steps;
  const double shortest = impactTimes(c).shortest;
  for (const double count : c.collision.stepsPerContact) steps.push_back(shortest / count);
  return steps;
}

}  // namespace crossgrain::inline cases
