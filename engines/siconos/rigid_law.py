"""What rigid contacts make of a scene's law: a friction coefficient, and a restitution for each pair."""

import math

from crossgrain_worker import Unsupported


class RigidLaw:
    def __init__(self, law):
        """@raise Unsupported for laws whose restitution depends on speed"""
        self.soft = law["normal"] == "linear"
        if not self.soft and law["normal"] != "rigid":
            raise Unsupported(
                'has rigid contacts, normal = "rigid"; they can stand for normal = "linear", whose restitution is '
                "the same at every speed"
            )
        if self.soft and law["gn"] > 0 and law["damper"] != "constant":
            raise Unsupported('can stand in for a linear law with damper = "constant" only')
        if not self.soft and law["et0"] != 0:
            raise Unsupported("has no tangential restitution, so it needs et0 = 0")
        self.law = law
        self.friction = 0.0 if self.soft and law["tangential"] == "none" else law["mu"]
        self.damps = law["gn"] > 0 if self.soft else law["en"] < 1

    def restitution(self, inverse_mass):
        """inverse_mass: 1/m₁ + 1/m₂, a wall's being 0.

        Of f = k_n δ − γ_n v_n: exp(−β t_c), β = γ_n/(2 m₁₂), ω² = k_n/m₁₂ − β². The contact ends when the bodies
        part, ω t_c = π, or, where tension is cut, when the force does (Schwager and Pöschel, Granular Matter 9
        (2007) 465)."""
        if not self.soft:
            return self.law["en"]
        beta = 0.5 * self.law["gn"] * inverse_mass
        squared = self.law["kn"] * inverse_mass - beta * beta
        if not squared > 0:
            raise Unsupported("has rigid contacts, which stand for no law that is overdamped")
        omega = math.sqrt(squared)
        phase = math.atan2(2 * beta * omega, beta * beta - squared) if self.law["tension"] == "cut" else math.pi
        return math.exp(-beta * phase / omega)
