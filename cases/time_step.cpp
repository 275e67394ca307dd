#include "cases/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cases/collision_scene.hpp"
#include "oracle/impact.hpp"

namespace crossgrain::inline cases {

namespace {

/// The two largest of some inverse masses: those of a pair. A single disk meets walls only.
struct LargestTwo {
  double first = 0.0, second = 0.0;
  void add(double inverse) {
    second = std::max(second, std::min(first, inverse));
    first = std::max(first, inverse);
  }
  double reducedMass() const { return 1.0 / (first + second); }
};

class Lightest {
 public:
  void add(double mass, double radius, double inertia, bool rotation) {
    normal_.add(1.0 / mass);
    tangential_.add(1.0 / mass + (rotation ? radius * radius / inertia : 0.0));
  }
  LightestPair pair() const { return {normal_.reducedMass(), tangential_.reducedMass()}; }

 private:
  LargestTwo normal_, tangential_;
};

void add(Lightest& lightest, const Disks& disks, bool rotation) {
  for (std::size_t i = 0; i < disks.size(); ++i)
    lightest.add(disks.mass[i], disks.radius[i], disks.inertia[i], rotation);
}

LightestPair lightestPair(const Assembly& assembly) {
  Lightest lightest;
  for (const DiskGroup& group : assembly.disks) {
    const double share = 1.0 - group.radiusSpread;
    const double radius = group.radius * share, mass = group.mass * share * share;
    for (std::size_t k = 0; k < std::min<std::size_t>(group.places.size(), 2); ++k)
      lightest.add(mass, radius, assembly.inertiaFactor * mass * radius * radius,
                   assembly.rotation);
  }
  for (const Disks& disks : assembly.starts.disks) add(lightest, disks, assembly.rotation);
  return lightest.pair();
}

}  // namespace

LightestPair lightestPair(const Disks& disks, bool rotation) {
  Lightest lightest;
  add(lightest, disks, rotation);
  return lightest.pair();
}

LightestPair lightestPair(const Case& c) {
  if (c.kind == CaseKind::collision) {
    const CollidingPair pair = collidingPair(c);
    return {pair.reducedMass(), 1.0 / pair.tangentialCompliance()};
  }
  if (c.kind == CaseKind::assembly) return lightestPair(c.assembly);
  // A single disk of a kind never meets its like, but a bound is all that is wanted.
  const Particles& p = c.particles;
  double mass = std::min(p.smallMass, p.largeMass);
  if (p.small > 0 && p.large == 0) mass = p.smallMass;
  if (p.large > 0 && p.small == 0) mass = p.largeMass;
  return {mass / 2.0, mass / 2.0 / (1.0 + 1.0 / p.inertiaFactor)};
}

double lightestReducedMass(const Case& c) {
  return lightestPair(c).normal;
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
