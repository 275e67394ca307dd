#include "oracle/contact_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/impact.hpp"

namespace crossgrain::inline oracle {

ContactForces::ContactForces(const ContactLaw& law, const CollidingPair& pair)
    : law_(law),
      pair_(pair),
      reach_(pair.radius[0] + pair.radius[1]),
      inverseMass_(1.0 / pair.mass[0] + 1.0 / pair.mass[1]),
      reducedRadius_(pair.reducedRadius()) {
  if (law.tangential == TangentialLaw::spring) law_.gt = 0.0;
  if (law.mu == 0.0) law_.tangential = TangentialLaw::none;
}

double ContactForces::contactTime(double speed) const {
  return impactTime(law_, {pair_.reducedMass(), reducedRadius_, speed});
}

double ContactForces::stretchedShare() const {
  switch (law_.conventions.springUpdate) {
    case SpringUpdate::after:
      return 0.0;
    case SpringUpdate::midpoint:
      return 0.5;
    case SpringUpdate::before:
      break;
  }
  return 1.0;
}

double ContactForces::visibleLength() const {
  return 64.0 * std::numeric_limits<double>::epsilon() * reach_;
}

}  // namespace crossgrain::inline oracle
