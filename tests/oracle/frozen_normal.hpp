#pragma once

#include "adapters/contact_law.hpp"
#include "oracle/collision_end.hpp"

namespace crossgrain {

/// The outcome of a collision of the linear law with its normal frozen, n(t) = n(0): the limit
/// v_n → 0 of oracleOutcome(), by another route. The normal is then a damped oscillator, the
/// tangential motion another one while the contact sticks and the integral of the bound while it
/// slips; each is exact, and only the instants between are numbers found (Brent's bracketing, GSL).
/// Levers are the radii. No account of the energy.
/// @throws std::invalid_argument for an overdamped pair and for other conventions than
///         coulomb_bound = "compression", dashpot = "inside", spring_reset = "total" and
///         spring_update = "after"; tension is allowed or cut
CollisionEnd frozenNormalOutcome(const ContactLaw& law, const CollidingPair& pair,
                                 const CollisionStart& start);

}  // namespace crossgrain
