"""The scene's linear law in LAMMPS' terms: pair_style granular, hooke with damping velocity."""

import numpy as np
from crossgrain_answers import demand_linear
from crossgrain_worker import Unsupported

KINDS = ("none", "viscous", "spring", "spring_dashpot")
# The worker holds |f_t| to be at the bound within this; LAMMPS scales the spring to it.
AT_THE_BOUND = 1 - 1e-12


class Law:
    """f_n = k_n δ − γ_n v_n; the tangential spring and dashpot together held to µ |f_n|."""

    def __init__(self, law):
        kind = law["tangential"]
        demand_linear(law, KINDS)
        self.friction = kind != "none" and law["mu"] > 0
        self.kn, self.gn = law["kn"], law["gn"]
        self.mu = law["mu"] if self.friction else 0.0
        self.spring = self.friction and kind in ("spring", "spring_dashpot")
        self.dashpot = self.friction and kind in ("viscous", "spring_dashpot")
        self.kt = law["kt"] if self.spring else 0.0
        self.gt = law["gt"] if self.dashpot else 0.0
        if self.gt > 0 and self.gn == 0:
            raise Unsupported(
                "tells the tangential dashpot as a multiple of the normal one, so it has none "
                "where gn = 0"
            )

    def words(self):
        """What follows `pair_coeff * *` and `fix wall/gran granular`."""
        ratio = self.gt / self.gn if self.gt > 0 else 0.0
        normal = f"hooke {self.kn!r} {self.gn!r} damping velocity"
        if self.spring:
            return f"{normal} tangential linear_history {self.kt!r} {ratio!r} {self.mu!r}"
        return f"{normal} tangential linear_nohistory {ratio!r} {self.mu!r}"

    def sliding(self, pressing, tangential):
        """Where |f_t| is at the bound; nothing slides without friction."""
        bound = self.mu * np.abs(pressing)
        return self.friction & (bound > 0) & (np.abs(tangential) >= AT_THE_BOUND * bound)

    def coefficients(self):
        """The same for all pairs: those that contacts have."""
        found = {"kn": self.kn, "gn": self.gn}
        if self.friction:
            found["mu"] = self.mu
        if self.spring:
            found["kt"] = self.kt
        if self.dashpot:
            found["gt"] = self.gt
        return found
