"""The scene's soft laws in LAMMPS' terms: pair_style granular, hooke, hertz or dmt, and rolling sds."""

import math
import os

import jkr
import numpy as np
from crossgrain_answers import demand_law, law_options
from crossgrain_walls import Box
from crossgrain_worker import Unsupported

OPTIONS = law_options(os.path.dirname(os.path.abspath(__file__)))
NORMALS, DAMPERS, KINDS, ROLLING, COHESION = map(OPTIONS.get, ("normal", "damper", "tangential", "rolling", "cohesion"))
# The pull-off that is to be in the bound of a DMT contact is not: it is worked out from a variable that only JKR sets.
LOADS = {"dmt": "net_without_dashpot", "jkr": "plus_twice_pull_off"}
# The worker holds |f_t| to be at the bound within this; LAMMPS scales the spring to it.
AT_THE_BOUND = 1 - 1e-12
# f_el′(δ) over f_el(δ)/δ: of Hertz' law f_el grows as δ^(3/2).
STIFFNESS = {"linear": 1.0, "hertz": 1.5}
# LAMMPS' `damping tsuji` is given a restitution e and takes this for α in α √(m₁₂ f_el/δ), whatever e comes of it:
# coefficients of e⁶ … e⁰ (its documentation of pair_style granular, after Tsuji et al. 1992).
ALPHA = (4.8218, -18.022, 27.467, -22.348, 11.087, -4.2783, 1.2728)


def demand_part(law, name, values):
    """Of a law with rolling resistance or cohesion, which one it is.

    @raise Unsupported"""
    value = law.get(name, "none")
    if value not in values:
        raise Unsupported(f'has {name} = {" | ".join(values)}, not "{value}"')
    return value


def demand_spring_units(law, damper):
    """What k_r and γ_r of a rolling spring are times, which a case may let differ: they would be other constants.

    @raise Unsupported"""
    wanted = {"rolling_stiffness": "length_square"} | ({"rolling_damper": damper} if law["gr"] > 0 else {})
    for name, value in wanted.items():
        if law["rolling"] == "spring" and law[name] != value:
            raise Unsupported(f'has {name} = "{value}", not "{law[name]}"')


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


class Laws:
    """Those of the scene's pairs: one, or that of each two of its materials, which differ in constants alone.

    one    what all of them share but the constants
    count  of materials
    of_disk, of_body  material of each disk, each body"""

    def __init__(self, law, scene, arrays, bodies):
        """@param law  makes one of the protocol's"""
        self.one = law(scene["law"])
        if self.one.cohesion == "jkr" and (scene.get("dimension", 2) == 3 or any(Box(scene).periodic)):
            raise Unsupported('has cohesion = "jkr" in the plane and without periodic directions alone')
        materials = scene.get("materials")
        if materials:
            self.all = [law(each) for each in materials["laws"]]
            self.names = materials["names"]
            self.count = len(self.names)
            self.of_disk, self.of_body = arrays["disks.material"], materials["of_body"]
        else:
            self.all, self.count = [self.one], 1
            self.of_disk, self.of_body = np.zeros(scene["disks"], int), [0] * len(bodies)
        of_walls = [np.full(len(body.disk_radius), of) for body, of in zip(bodies, self.of_body)]
        of_planes = [np.full(len(body.planes) + len(body.cylinders), of) for body, of in zip(bodies, self.of_body)]
        self.of_id = np.concatenate([self.of_disk, *of_walls, *of_planes]).astype(int)

    def between(self, a, b):
        """That of two materials."""
        return self.all[a * self.count + b]

    def of_pairs(self, name, i, j, *columns, of_each=()):
        """What the method `name` of their own law makes of the columns of each pair (i, j).

        @param of_each  shape of that: a number, or (3,)"""
        which = self.of_id[i] * self.count + self.of_id[j]
        found = np.zeros((len(which), *of_each))
        for k in np.unique(which):
            rows = which == k
            found[rows] = getattr(self.all[k], name)(*(column[rows] for column in columns))
        return found

    def table(self):
        """Of Realised."""
        if self.count == 1:
            return [{"pair": "all", **self.one.coefficients()}]
        return [
            {"pair": f"{self.names[a]} with {self.names[b]}", **self.between(a, b).coefficients()}
            for a in range(self.count)
            for b in range(a, self.count)
        ]


class Law:
    """f_n = f_el(δ) − γ v_n; the tangential spring and dashpot together limited to µ |f_n|.

    f_el is k_n δ or, of Hertz' law, k_n a δ with a = √(R₁₂ δ); the spring's stiffness is k_t or k_t a. γ is γ_n,
    or with critical dashpots γ_n √(m₁₂ f_el′(δ)), and of the tangential one γ_t √(m₁₂ k_t(δ))."""

    def __init__(self, law):
        kind = law["tangential"]
        demand_law(law, NORMALS, DAMPERS, KINDS)
        self.space = "spring_turn" in law
        self.rolls = demand_part(law, "rolling", ROLLING) != "none"
        if self.rolls:
            demand_spring_units(law, "constant")
        self.cohesion = demand_part(law, "cohesion", COHESION)
        if self.cohesion != "none" and law["normal"] != "hertz":
            raise Unsupported(f'has cohesion = "{self.cohesion}" with normal = "hertz" alone')
        self.bonds = self.cohesion == "jkr"
        if self.bonds and law["damper"] != "constant" and (law["gn"] > 0 or law["gt"] > 0):
            raise Unsupported('has dashpots of damper = "constant" alone with cohesion = "jkr"')
        self.normal, self.history = law["normal"], law.get("history", "displacement")
        self.critical = law["damper"] == "critical"
        self.friction = kind != "none" and law["mu"] > 0
        self.kn, self.gn = law["kn"], law["gn"]
        self.mu = law["mu"] if self.friction else 0.0
        self.spring = self.friction and kind in ("spring", "spring_dashpot")
        self.dashpot = self.friction and kind in ("viscous", "spring_dashpot")
        self.kt = law["kt"] if self.spring else 0.0
        self.gt = law["gt"] if self.dashpot else 0.0
        self.turns = self.friction or self.rolls
        load = LOADS.get(self.cohesion)
        if load and self.turns and law["cohesion_load"] != load:
            raise Unsupported(f'has cohesion_load = "{load}" with cohesion = "{self.cohesion}"')
        self.kr, self.gr, self.mu_r = (law[name] if self.rolls else 0.0 for name in ("kr", "gr", "mu_r"))
        self.w = law["w"] if self.cohesion != "none" else 0.0
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
        if plane and self.bonds:
            raise Unsupported('has cohesion = "jkr" between disks alone: at planes it lets go before the largest pull')
        if plane and self.cohesion == "dmt" and self.turns:
            raise Unsupported(
                'has cohesion = "dmt" with friction or rolling between disks alone: at planes their bound has 4π r² in it'
            )
        if plane and damping == "tsuji":
            raise Unsupported('has damper = "critical" between disks alone, not at planes')
        normal = f"{'hertz' if self.normal == 'hertz' else 'hooke'} {self.kn!r} {number!r}"
        if self.cohesion != "none":
            # By Young's modulus, Poisson's ratio 0 and γ = w/2: k_n is 4/3 E/2 of two bodies of the same E.
            normal = f"{self.cohesion} {1.5 * self.kn!r} {number!r} 0 {0.5 * self.w!r}"
        rolling = f" rolling sds {self.kr!r} {self.gr!r} {self.mu_r!r}" if self.rolls else ""
        if self.bonds and not self.rolls and not self.spring:
            rolling = " rolling sds 1.0 0.0 0.0"  # no torque; LAMMPS stops where bonds have no springs ("overflow")
        return f"{normal} damping {damping} tangential {self.tangential()}{rolling}"

    def asked(self):
        """Of `compute pair/local`: the normal force and, along x, y and in space z, the tangential force and that of
        rolling."""
        words = "force p1 p2 p3" if self.space else "force p1 p2"
        if self.rolls:
            words += " p5 p6 p7" if self.space else " p5 p6"
        return words

    def load(self, pressing, overlap, radius):
        """What µ multiplies: f_n, or of a law that coheres f_n without its dashpot, under JKR with 2 F_po besides.

        @param radius  R₁₂"""
        if self.cohesion == "none":
            return pressing
        if self.bonds:
            return self.bond_force(overlap, 0.0, radius) + 3.0 * math.pi * self.w * radius
        return self.kn * np.sqrt(radius * overlap) * overlap - 2.0 * math.pi * self.w * radius

    # Of JKR's contacts, which jkr.py works out: as the functions of pair_style granular do.

    def bond_range(self, radius):
        return jkr.RANGE * jkr.depth(self.kn, self.w, radius)

    def bond_force(self, overlap, approach, radius):
        return jkr.contact(self.kn, self.w, radius, overlap)[0] - self.gn * approach

    def bond_friction(self, of_spring, slip, overlap, radius, large_overlap, large_radius):
        """@param of_spring  force of the spring where the overlap and R₁₂ are the large ones"""
        if not self.friction:
            return np.zeros(len(slip))
        if self.history != "force":
            small, large = (
                jkr.contact(self.kn, self.w, r, d)[1] for r, d in ((radius, overlap), (large_radius, large_overlap))
            )
            of_spring = of_spring * small / large
        bound = self.mu * np.abs(self.load(None, overlap, radius))
        return np.clip(of_spring - self.gt * slip, -bound, bound)

    def bond_rolling(self, of_spring, spin, overlap, radius):
        """@param of_spring  its torque on the first, R₁₂ as it is"""
        bound = self.mu_r * radius * np.abs(self.load(None, overlap, radius))
        return np.clip(of_spring - self.gr * radius**2 * spin, -bound, bound)

    def sliding(self, pressing, tangential, overlap, radius, _reach):
        """Where |f_t| is at the bound; nothing slides without friction.

        @param radius, reach  R₁₂ and a_i + a_j"""
        bound = self.mu * np.abs(self.load(pressing, overlap, radius))
        return self.friction & (bound > 0) & (np.abs(tangential) >= AT_THE_BOUND * bound)

    def coefficients(self):
        """Those that contacts have."""
        found = {"kn": self.kn, "gn": self.gn}
        if self.rolls:
            found |= {"kr": self.kr, "gr": self.gr, "mu_r": self.mu_r}
        if self.cohesion != "none":
            found["w"] = self.w
        if self.friction:
            found["mu"] = self.mu
        if self.spring:
            found["kt"] = self.kt
        if self.dashpot:
            found["gt"] = self.gt
        return found
