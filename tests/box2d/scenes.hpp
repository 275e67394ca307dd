#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "adapters/box2d_common.hpp"
#include "tests/support/laws.hpp"
#include "tests/support/scenes.hpp"

namespace crossgrain::test {

/// The thesis' law with the conventions that the penalty engine has.
inline ContactLaw box2dLaw(TangentialLaw tangential = TangentialLaw::springDashpot) {
  ContactLaw law = thesisLaw(tangential);
  law.conventions.dampingVelocity = DampingVelocity::lagged;
  law.conventions.integrator = Integrator::semiImplicitEuler;
  return law;
}

struct Outcome {
  double en, psiF;
};

/// Outcome of the pair of disks (first, first + 1) of addPair(), its normal taken as fixed.
inline Outcome outcome(const Snapshot& after, std::size_t first, double vn) {
  const Vec2 v = after.velocity[first] - after.velocity[first + 1];
  const double spins = after.spin ? (*after.spin)[first] + (*after.spin)[first + 1] : 0.0;
  return {v.x() / vn, (v.y() - smallRadius * spins) / vn};
}

inline Snapshot runTo(Engine& engine, const Scene& scene, double t, const Settings& settings = {}) {
  engine.load(scene, settings);
  engine.advance(t);
  return engine.snapshot(ContactReport::instant);
}

}  // namespace crossgrain::test
