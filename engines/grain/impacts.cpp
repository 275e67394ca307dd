#include "engines/grain/impacts.hpp"

#include <algorithm>
#include <cmath>

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

void push(ImpactBody& body, double jx, double jy, double torque) {
  body.vx += jx * body.inverseMass;
  body.vy += jy * body.inverseMass;
  body.spin += torque * body.inverseInertia;
}

/// @returns whether the two approached faster than that [m/s]
bool collide(const ImpactLaw& law, Impact& c, std::span<ImpactBody> bodies, double still) {
  ImpactBody& i = bodies[c.i];
  ImpactBody& j = bodies[c.j];
  const double vn = normalVelocity(c, i, j);
  if (!(vn < -still)) return false;
  const double compliance = i.inverseMass + j.inverseMass;
  const double normal = -(1.0 + law.en) * vn / compliance;
  double tangential = 0.0;
  if (law.mu > 0.0) {
    const double across =
        compliance + c.armI * c.leverI * i.inverseInertia + c.armJ * c.leverJ * j.inverseInertia;
    const double sticking = -(1.0 + law.et0) * slipVelocity(c, i, j) / across;
    const double bound = law.mu * normal;
    tangential = std::clamp(sticking, -bound, bound);
    c.slid = tangential != sticking;
  }
  const double jx = normal * c.nx - tangential * c.ny;
  const double jy = normal * c.ny + tangential * c.nx;
  push(i, jx, jy, -c.leverI * tangential);
  push(j, -jx, -jy, -c.leverJ * tangential);
  c.normal += normal;
  c.tangential += tangential;
  return true;
}

double fastestApproach(std::span<const ImpactBody> bodies, std::span<const Impact> impacts) {
  double fastest = 0.0;
  for (const Impact& c : impacts)
    fastest = std::max(fastest, -normalVelocity(c, bodies[c.i], bodies[c.j]));
  return fastest;
}

}  // namespace

bool solveImpacts(const ImpactLaw& law, std::span<ImpactBody> bodies, std::span<Impact> impacts) {
  const double still = negligible * fastestApproach(bodies, impacts);
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

}  // namespace grain
