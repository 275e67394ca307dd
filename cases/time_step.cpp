#include "cases/time_step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace crossgrain {

double contactTime(const ContactLaw& law, double reducedMass) {
  if (law.normal == NormalLaw::rigid)
    throw std::invalid_argument("a rigid law has no contact time");
  const double eta = law.gn / (2.0 * reducedMass);
  const double omegaSquared = law.kn / reducedMass - eta * eta;
  if (!(omegaSquared > 0.0))
    throw std::invalid_argument("an overdamped contact has no contact time");
  return std::numbers::pi / std::sqrt(omegaSquared);
}

double lightestReducedMass(const Case& c) {
  if (c.kind == CaseKind::collision) {
    const auto& mass = c.collision.mass;
    return mass[0] * mass[1] / (mass[0] + mass[1]);
  }
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

std::vector<double> collisionTimeSteps(const Case& c) {
  if (c.run.dt) return {*c.run.dt};
  std::vector<double> steps;
  for (const double count : c.collision.stepsPerContact)
    steps.push_back(contactTime(c.law, lightestReducedMass(c)) / count);
  return steps;
}

}  // namespace crossgrain
