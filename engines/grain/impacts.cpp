#include "engines/grain/impacts.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace grain {
namespace {

constexpr int mostRounds = 1000;
constexpr double negligible = 1e-8;  ///< of the fastest approach

double normalVelocity(const Impact& c, const ImpactBody& i, const ImpactBody& j) {
  return (i.vx - j.vx) * c.nx + (i.vy - j.vy) * c.ny;
}

double slipVelocity(const Impact& c, const ImpactBody& i, const ImpactBody& j) {
  return (i.vy - j.vy) * c.nx - (i.vx - j.vx) * c.ny - (c.armI * i.spin + c.armJ * j.spin);
}

/// 1/m_n and 1/m_t.
double normalCompliance(const ImpactBody& i, const ImpactBody& j) {
  return i.inverseMass + j.inverseMass;
}

double slipCompliance(const Impact& c, const ImpactBody& i, const ImpactBody& j) {
  return normalCompliance(i, j) + c.armI * c.leverI * i.inverseInertia +
         c.armJ * c.leverJ * j.inverseInertia;
}

const ImpactLaw& lawOf(const Impact& c, const ImpactLaw& ofAll) {
  return c.law != nullptr ? *c.law : ofAll;
}

void push(ImpactBody& body, double jx, double jy, double torque) {
  body.vx += jx * body.inverseMass;
  body.vy += jy * body.inverseMass;
  body.spin += torque * body.inverseInertia;
}

void push(const Impact& c, std::span<ImpactBody> bodies, double normal, double tangential) {
  const double jx = normal * c.nx - tangential * c.ny;
  const double jy = normal * c.ny + tangential * c.nx;
  push(bodies[c.i], jx, jy, -c.leverI * tangential);
  push(bodies[c.j], -jx, -jy, -c.leverJ * tangential);
}

/// @returns whether the two approached faster than that [m/s]
bool collide(const ImpactLaw& ofAll, Impact& c, std::span<ImpactBody> bodies, double still) {
  const ImpactLaw& law = lawOf(c, ofAll);
  const ImpactBody& i = bodies[c.i];
  const ImpactBody& j = bodies[c.j];
  const double vn = normalVelocity(c, i, j);
  if (!(vn < -still)) return false;
  const double normal = -(1.0 + law.en) * vn / normalCompliance(i, j);
  double tangential = 0.0;
  if (law.mu > 0.0) {
    const double sticking = -(1.0 + law.et0) * slipVelocity(c, i, j) / slipCompliance(c, i, j);
    const double bound = law.mu * normal;
    tangential = std::clamp(sticking, -bound, bound);
  }
  push(c, bodies, normal, tangential);
  c.normal += normal;
  c.tangential += tangential;
  return true;
}

/// @returns whether nothing approaches any more
bool collideAll(const ImpactLaw& law, std::span<ImpactBody> bodies, std::span<Impact> impacts,
                double still) {
  for (int round = 0; round < mostRounds; ++round) {
    bool quiet = true;
    for (std::size_t k = 0; k < impacts.size(); ++k) {
      const std::size_t at = round % 2 == 0 ? k : impacts.size() - 1 - k;
      if (collide(law, impacts[at], bodies, still)) quiet = false;
    }
    if (quiet) return true;
  }
  return false;
}

void kick(std::span<ImpactBody> bodies) {
  for (ImpactBody& body : bodies) {
    body.vx += body.kickX;
    body.vy += body.kickY;
    body.spin += body.kickSpin;
  }
}

/// Along the normal and across it.
struct Pair {
  double normal = 0.0, tangential = 0.0;
};

/// Impulse that holds a contact against the kick.
struct Hold {
  Pair target;   ///< velocities: the least, and where friction leads [m/s]
  Pair impulse;  ///< [N s]
  Pair change;   ///< of the impulses, by the last two sweeps, where no bound holds them
  Pair direction,
      response;  ///< of impulses, conjugate to the last one, and what velocities it adds
};

/// The velocity of a rebound, or what is left of it; nothing where it goes the other way.
double atMost(double rebound, double now) {
  return rebound > 0.0 ? std::clamp(now, 0.0, rebound) : std::clamp(now, rebound, 0.0);
}

/// @returns by how much it changed the contact's velocities [m/s]
double correct(const ImpactLaw& ofAll, const Impact& c, Hold& hold, std::span<ImpactBody> bodies) {
  const ImpactLaw& law = lawOf(c, ofAll);
  const ImpactBody& i = bodies[c.i];
  const ImpactBody& j = bodies[c.j];
  const double yields = normalCompliance(i, j);
  const double wanted =
      hold.impulse.normal - (normalVelocity(c, i, j) - hold.target.normal) / yields;
  const double normal = std::max(0.0, wanted) - hold.impulse.normal;
  push(c, bodies, normal, 0.0);
  hold.impulse.normal += normal;
  hold.change.normal += normal;
  if (!(law.mu > 0.0)) return yields * std::abs(normal);

  const double slips = slipCompliance(c, i, j);
  const double sticking =
      hold.impulse.tangential - (slipVelocity(c, i, j) - hold.target.tangential) / slips;
  const double bound = law.mu * hold.impulse.normal;
  const double tangential = std::clamp(sticking, -bound, bound) - hold.impulse.tangential;
  push(c, bodies, 0.0, tangential);
  hold.impulse.tangential += tangential;
  hold.change.tangential += tangential;
  return std::max(yields * std::abs(normal), slips * std::abs(tangential));
}

double dot(const Pair& a, const Pair& b) {
  return a.normal * b.normal + a.tangential * b.tangential;
}

Pair plus(const Pair& a, double factor, const Pair& b) {
  return {a.normal + factor * b.normal, a.tangential + factor * b.tangential};
}

/// One step of conjugate gradients for the impulses that no bound holds, with the sweeps' change as
/// the preconditioned residual: takes that change back and goes as far as is best along
/// `direction`.
void accelerate(const ImpactLaw& law, std::span<ImpactBody> bodies, std::span<const Impact> impacts,
                std::span<Hold> holds, std::vector<ImpactBody>& added) {
  double along = 0.0, curvature = 0.0, stiffness = 0.0, slope = 0.0;
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    Hold& hold = holds[k];
    const double mu = lawOf(impacts[k], law).mu;
    if (!(hold.impulse.normal > 0.0)) hold.change.normal = 0.0;
    if (!(std::abs(hold.impulse.tangential) < mu * hold.impulse.normal))
      hold.change.tangential = 0.0;
    along += dot(hold.change, hold.response);
    curvature += dot(hold.direction, hold.response);
  }
  const double conjugate = curvature > 0.0 ? -along / curvature : 0.0;
  added.assign(bodies.begin(), bodies.end());
  for (ImpactBody& body : added) body.vx = body.vy = body.spin = 0.0;
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    Hold& hold = holds[k];
    hold.impulse = plus(hold.impulse, -1.0, hold.change);
    push(impacts[k], bodies, -hold.change.normal, -hold.change.tangential);
    hold.direction = plus(hold.change, conjugate, hold.direction);
    if (hold.change.normal == 0.0) hold.direction.normal = 0.0;
    if (hold.change.tangential == 0.0) hold.direction.tangential = 0.0;
    push(impacts[k], added, hold.direction.normal, hold.direction.tangential);
  }
  curvature = 0.0;
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    const Impact& c = impacts[k];
    const ImpactBody& i = bodies[c.i];
    const ImpactBody& j = bodies[c.j];
    Hold& hold = holds[k];
    hold.response = {normalVelocity(c, added[c.i], added[c.j]),
                     slipVelocity(c, added[c.i], added[c.j])};
    const Pair missing = plus(hold.target, -1.0, {normalVelocity(c, i, j), slipVelocity(c, i, j)});
    curvature += dot(hold.direction, hold.response);
    slope += dot(hold.direction, missing);
    const double n = hold.direction.normal, t = hold.direction.tangential;
    stiffness += normalCompliance(i, j) * n * n + slipCompliance(c, i, j) * t * t;
  }
  // Where walls close in impulses go up and nothing moves.
  const double far = curvature > 1e-12 * stiffness ? slope / curvature : 0.0;
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    Hold& hold = holds[k];
    hold.impulse = plus(hold.impulse, far, hold.direction);
    push(impacts[k], bodies, far * hold.direction.normal, far * hold.direction.tangential);
  }
}

/// @returns whether a sweep no longer changes velocities by more than that [m/s]
bool holdAll(const ImpactLaw& law, std::span<ImpactBody> bodies, std::span<const Impact> impacts,
             std::span<Hold> holds, double still) {
  std::vector<ImpactBody> added;
  for (int round = 0; round < mostRounds; round += 2) {
    double largest = 0.0;
    for (Hold& hold : holds) hold.change = {};
    for (std::size_t k = 0; k < impacts.size(); ++k)
      largest = std::max(largest, correct(law, impacts[k], holds[k], bodies));
    if (!(largest > still)) return true;
    for (std::size_t k = impacts.size(); k-- > 0;) correct(law, impacts[k], holds[k], bodies);
    accelerate(law, bodies, impacts, holds, added);
  }
  return false;
}

}  // namespace

bool solveImpacts(const ImpactLaw& law, std::span<ImpactBody> bodies, std::span<Impact> impacts) {
  std::vector<Hold> holds(impacts.size());
  double fastest = 0.0;
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    const Impact& c = impacts[k];
    const ImpactBody& i = bodies[c.i];
    const ImpactBody& j = bodies[c.j];
    const double approach = -normalVelocity(c, i, j);
    const double kicked = (j.kickX - i.kickX) * c.nx + (j.kickY - i.kickY) * c.ny;
    fastest = std::max({fastest, approach, approach + kicked});
    const ImpactLaw& own = lawOf(c, law);
    holds[k].target = {own.en * approach, -own.et0 * slipVelocity(c, i, j)};
  }
  const double still = negligible * fastest;
  collideAll(law, bodies, impacts, still);
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    const Impact& c = impacts[k];
    const bool collided = c.normal > 0.0;
    const Pair rebound = collided ? holds[k].target : Pair{};
    holds[k].target = {
        std::max(0.0, atMost(rebound.normal, normalVelocity(c, bodies[c.i], bodies[c.j]))),
        atMost(rebound.tangential, slipVelocity(c, bodies[c.i], bodies[c.j]))};
  }
  kick(bodies);
  const bool held = holdAll(law, bodies, impacts, holds, still);
  for (std::size_t k = 0; k < impacts.size(); ++k) {
    Impact& c = impacts[k];
    c.normal += holds[k].impulse.normal;
    c.tangential += holds[k].impulse.tangential;
    // Rounding of a sum of two that are at the bound.
    const double mu = lawOf(c, law).mu;
    c.slid = mu > 0.0 && c.normal > 0.0 && std::abs(c.tangential) >= (1.0 - 1e-12) * mu * c.normal;
  }
  return held;
}

}  // namespace grain
