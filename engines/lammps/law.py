"""The scene's soft law in LAMMPS' terms: pair_style granular, hooke or hertz."""

import math

import numpy as np
from crossgrain_answers import demand_law
from crossgrain_worker import Unsupported

NORMALS = ("linear", "hertz")
DAMPERS = ("constant", "critical")
KINDS = ("none", "viscous", "spring", "spring_dashpot")
# The worker holds |f_t| to be at the bound within this; LAMMPS scales the spring to it.
AT_THE_BOUND = 1 - 1e-12
# f_el′(δ) over f_el(δ)/δ: of Hertz' law f_el grows as δ^(3/2).
STIFFNESS = {"linear": 1.0, "hertz": 1.5}
# LAMMPS' `damping tsuji` is given a restitution e and takes this for α in α √(m₁₂ f_el/δ), whatever e comes of it:
# coefficients of e⁶ … e⁰ (its documentation of pair_style granular, after Tsuji et al. 1992).
ALPHA = (4.8218, -18.022, 27.467, -22.348, 11.087, -4.2783, 1.2728)


def told_restitution(alpha):
    """The e in [0, 1] of which `damping tsuji` makes that α.

    @raise Unsupported where there is none"""
    roots = np.roots([*ALPHA[:-1], ALPHA[-1] - alpha])
    real = [root.real for root in roots if abs(root.imag) < 1e-9 and -1e-12 <= root.real <= 1 + 1e-12]
    if not real:
        raise Unsupported(
            f"has dashpots of damper = critical with gn √(f_el′ δ/f_el) between {np.polyval(ALPHA, 1):.3g} "
            f"and {ALPHA[-1]:.3g}, not {alpha:.3g}"
        )
    return min(max(real[0], 0.0), 1.0)


class Law:
    """f_n = f_el(δ) − γ v_n; the tangential spring and dashpot together limited to µ |f_n|.

    f_el is k_n δ or, of Hertz' law, k_n a δ with a = √(R₁₂ δ); the spring's stiffness is k_t or k_t a. γ is γ_n,
    or with critical dashpots γ_n √(m₁₂ f_el′(δ)), and of the tangential one γ_t √(m₁₂ k_t(δ))."""

    def __init__(self, law):
        kind = law["tangential"]
        demand_law(law, NORMALS, DAMPERS, KINDS)
        self.normal, self.history = law["normal"], law.get("history", "displacement")
        self.critical = law["damper"] == "critical"
        self.friction = kind != "none" and law["mu"] > 0
        self.kn, self.gn = law["kn"], law["gn"]
        self.mu = law["mu"] if self.friction else 0.0
        self.spring = self.friction and kind in ("spring", "spring_dashpot")
        self.dashpot = self.friction and kind in ("viscous", "spring_dashpot")
        self.kt = law["kt"] if self.spring else 0.0
        self.gt = law["gt"] if self.dashpot else 0.0
        if self.gt > 0 and self.gn == 0:
            raise Unsupported(
                "expresses the tangential dashpot as a multiple of the normal one, so it has none "
                "where gn = 0"
            )
        if self.critical and self.gt > 0 and self.kt == 0:
            raise Unsupported("has critical tangential dashpots beside a spring alone: kt must be > 0")

    def damping(self):
        """The number that stands for γ_n, and the damping's name."""
        if not self.critical or self.gn == 0:
            return self.gn, "velocity"
        return told_restitution(self.gn * math.sqrt(STIFFNESS[self.normal])), "tsuji"

    def tangential_ratio(self):
        """Of the tangential dashpot to the normal one, the same at every overlap."""
        if self.gt == 0:
            return 0.0
        of_stiffness = math.sqrt(self.kt / (STIFFNESS[self.normal] * self.kn)) if self.critical else 1.0
        return self.gt / self.gn * of_stiffness

    def tangential(self):
        if not self.spring:
            return f"linear_nohistory {self.tangential_ratio()!r} {self.mu!r}"
        of_hertz = "mindlin/force" if self.history == "force" else "mindlin"
        name = of_hertz if self.normal == "hertz" else "linear_history"
        return f"{name} {self.kt!r} {self.tangential_ratio()!r} {self.mu!r}"

    def words(self, plane=False):
        """What follows `pair_coeff * *` and `fix wall/gran granular`.

        @raise Unsupported for planes with critical dashpots: LAMMPS' are others there (README.md)"""
        number, damping = self.damping()
        if plane and damping == "tsuji":
            raise Unsupported('has damper = "critical" between disks alone, not at planes')
        name = "hertz" if self.normal == "hertz" else "hooke"
        return f"{name} {self.kn!r} {number!r} damping {damping} tangential {self.tangential()}"

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
