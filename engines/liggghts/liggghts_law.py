"""The scene's linear law in LIGGGHTS' terms: model hooke/stiffness, tangential history or no_history."""

import numpy as np
from crossgrain_answers import demand_linear
from crossgrain_worker import Unsupported

KINDS = ("none", "spring", "spring_dashpot")
AT_THE_BOUND = 1 - 1e-12  # the worker holds |f_t| to be there within this


class Law:
    """f_n = k_n δ − γ_n v_n; the tangential spring limited to µ |f_n|, its dashpot only while it sticks."""

    def __init__(self, law):
        kind = law["tangential"]
        demand_linear(law, KINDS)
        self.friction = kind != "none" and law["mu"] > 0
        self.kn, self.gn = law["kn"], law["gn"]
        self.mu = law["mu"] if self.friction else 0.0
        self.kt = law["kt"] if self.friction else 0.0
        self.dashpot = self.friction and kind == "spring_dashpot"
        self.gt = law["gt"] if self.dashpot else 0.0
        if self.friction and self.kt == 0:
            raise Unsupported("has friction by springs alone: kt must be > 0")

    def properties(self):
        """What `fix property/global … peratomtypepair` is given, the same for all pairs."""
        of_contacts = {"kn": self.kn, "kt": self.kt or self.kn, "gamman_abs": self.gn, "gammat_abs": self.gt}
        return of_contacts | ({"coefficientFriction": self.mu} if self.friction else {})

    def words(self):
        tangential = "history" if self.friction else "off"
        damping = "on" if self.dashpot else "off"
        return (
            f"model hooke/stiffness tangential {tangential} tangential_damping {damping} absolute_damping on "
            "limitForce off"
        )

    def sliding(self, pressing, tangential):
        """Where the spring is at the bound: it alone is limited, and acts alone there."""
        bound = self.mu * np.abs(pressing)
        return self.friction & (bound > 0) & (np.abs(np.abs(tangential) - bound) <= (1 - AT_THE_BOUND) * bound)

    def coefficients(self):
        """The same for all pairs: those that contacts have."""
        found = {"kn": self.kn, "gn": self.gn}
        if self.friction:
            found |= {"mu": self.mu, "kt": self.kt}
        if self.dashpot:
            found["gt"] = self.gt
        return found
