"""The scene's linear laws in LIGGGHTS' terms: model hooke/stiffness, tangential history, rolling friction, cohesion."""

import math

import numpy as np
from crossgrain_answers import demand_linear
from crossgrain_worker import Unsupported
from law import demand_part, demand_spring_units

KINDS = ("none", "spring", "spring_dashpot")
ROLLING = ("none", "constant_torque", "spring")
COHESION = ("none", "area")
AREAS = {"lens": "sjkr", "twice_between_disks": "sjkr2"}  # cohesion_area → LIGGGHTS' cohesion model
AT_THE_BOUND = 1 - 1e-12  # the worker holds |f_t| to be there within this
SAME = 1e-12  # two k_r, of which one is worked out in another order


class Law:
    """f_n = k_n δ − γ_n v_n − k_c A(δ); the tangential spring limited to µ times the load, its dashpot only while it
    sticks; rolling resistance likewise."""

    def __init__(self, law):
        kind = law["tangential"]
        demand_linear(law, KINDS)
        self.space = "spring_turn" in law
        self.friction = kind != "none" and law["mu"] > 0
        self.kn, self.gn = law["kn"], law["gn"]
        self.mu = law["mu"] if self.friction else 0.0
        self.kt = law["kt"] if self.friction else 0.0
        self.dashpot = self.friction and kind == "spring_dashpot"
        self.gt = law["gt"] if self.dashpot else 0.0
        if self.friction and self.kt == 0:
            raise Unsupported("has friction by springs alone: kt must be > 0")
        self.bonds = False
        self.cohesion = demand_part(law, "cohesion", COHESION)
        self.kc = law["kc"] if self.cohesion != "none" else 0.0
        self.area_model = AREAS[law["cohesion_area"]] if self.cohesion != "none" else ""
        self.net = self.cohesion != "none" and law["cohesion_load"] == "net"
        rolling = demand_part(law, "rolling", ROLLING)
        self.rolls = rolling != "none"
        self.turns = self.friction or self.rolls
        self.mu_r = law["mu_r"] if self.rolls else 0.0
        self.kr = self.gr = 0.0
        self.rolling_model = ""
        if rolling == "constant_torque":
            self.rolling_model = "cdt"
            self.demand_load(law, "elastic")
        elif rolling == "spring":
            self.demand_load(law, "magnitude")
            self.set_spring(law)

    def demand_load(self, law, load):
        """Its models have one each; without dashpot and cohesion all are the same.

        @raise Unsupported"""
        if (self.gn > 0 or self.cohesion != "none") and law["rolling_load"] != load:
            raise Unsupported(f'has rolling_load = "{load}" with rolling = "{law["rolling"]}", not "{law["rolling_load"]}"')

    def set_spring(self, law):
        """LIGGGHTS is given no k_r, it has its own.

        @raise Unsupported where that is another than the scene's"""
        demand_spring_units(law, "critical")
        self.kr, self.gr = law["kr"], law["gr"]
        of_model = {"epsd": 2.25 * self.kn * self.mu_r**2}
        if self.friction and self.gr == 0:
            of_model["epsd2"] = self.kt
        for model, kr in of_model.items():
            if math.isclose(self.kr, kr, rel_tol=SAME):
                self.rolling_model = model
                return
        instead = " or ".join(f"{kr:.6g} N/m ({model})" for model, kr in of_model.items())
        raise Unsupported(
            f"makes rolling springs of its own, kr = 2.25 kn mu_r² or, undamped and with friction, kt: here kr = {instead}, "
            f"not {self.kr:.6g} N/m; kr_factor = 2.25 or kr_per_kt = 1 ask for these"
        )

    def properties(self):
        """What `fix property/global … peratomtypepair` is given."""
        found = {"kn": self.kn, "kt": self.kt or self.kn, "gamman_abs": self.gn, "gammat_abs": self.gt}
        if self.friction:
            found["coefficientFriction"] = self.mu
        if self.rolls:
            found["coefficientRollingFriction"] = self.mu_r
        if self.rolling_model == "epsd":
            found["coefficientRollingViscousDamping"] = self.gr
        if self.cohesion != "none":
            found["cohesionEnergyDensity"] = self.kc
        return found

    def words(self):
        return f"{self.model_words()} {self.setting_words()}"

    def model_words(self):
        tangential = "history" if self.friction else "off"
        models = f"model hooke/stiffness tangential {tangential}"
        if self.cohesion != "none":
            models += f" cohesion {self.area_model}"
        if self.rolls:
            models += f" rolling_friction {self.rolling_model}"
        return models

    def setting_words(self):
        damping = "on" if self.dashpot else "off"
        words = f"tangential_damping {damping} absolute_damping on limitForce off"
        return words + (f" tangential_reduce {'on' if self.net else 'off'}" if self.cohesion != "none" else "")

    def pull(self, overlap, radius, reach):
        """k_c A. A is the lens of two spheres, at a plane its disk, or 4π R₁₂ δ, at a plane half that."""
        if self.cohesion == "none":
            return 0.0
        at_plane = radius == reach
        if self.area_model == "sjkr2":
            return self.kc * np.where(at_plane, 2.0, 4.0) * math.pi * radius * overlap
        d2 = (reach - overlap) ** 2
        lens = 0.25 * math.pi * overlap * (2.0 * reach - overlap) * (d2 - reach * (reach - 4.0 * radius)) / d2
        return self.kc * np.where(at_plane, math.pi * overlap * (2.0 * reach - overlap), lens)

    def load(self, pressing, overlap, radius, reach):
        """What µ and µ_r multiply the magnitude of: f_n, the pull in it or not."""
        return pressing if self.net else pressing + self.pull(overlap, radius, reach)

    def sliding(self, pressing, tangential, overlap, radius, reach):
        """Where the spring is at the bound: it alone is limited, and acts alone there."""
        bound = self.mu * np.abs(self.load(pressing, overlap, radius, reach))
        return self.friction & (bound > 0) & (np.abs(np.abs(tangential) - bound) <= (1 - AT_THE_BOUND) * bound)

    def spring_force(self, stretch):
        return -self.kt * stretch

    def rolling_torque(self, spring, spin, pressing, overlap, radius, reach, inertia):
        """On the first of two disks.

        @param spring   torque of the spring on it, in the plane about z [N m]
        @param spin     ω of the first less that of the second, as far as it rolls [rad/s]
        @param inertia  of 1/I = Σ 1/(J + m a²) [kg m²]"""
        bound = self.mu_r * radius * np.abs(self.load(pressing, overlap, radius, reach))
        dashpot = (-2.0 * self.gr * np.sqrt(inertia * self.kr) * radius * spin.T).T
        size = np.abs(spring) if spring.ndim == 1 else np.linalg.norm(spring, axis=1)
        return np.where(size < AT_THE_BOUND * bound, (spring + dashpot).T, spring.T).T

    def asked(self):
        """Of each contact: 2 ids and a flag, 3 components of the force, and what the law has: of the torque, of the
        tangential spring, of the rolling spring's torque."""
        words = "id force" + (" torque" if self.rolling_model == "cdt" else "")
        return words + (" history" if self.history() else "")

    def history(self):
        return 3 * self.friction + 3 * (self.rolling_model in ("epsd", "epsd2"))

    def coefficients(self):
        """Those that contacts have."""
        found = {"kn": self.kn, "gn": self.gn}
        if self.friction:
            found |= {"mu": self.mu, "kt": self.kt}
        if self.dashpot:
            found["gt"] = self.gt
        if self.rolls:
            found["mu_r"] = self.mu_r
        if self.kr > 0:
            found |= {"kr": self.kr, "gr": self.gr}
        if self.cohesion != "none":
            found["kc"] = self.kc
        return found
