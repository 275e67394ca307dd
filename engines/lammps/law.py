"""The scene's soft laws in LAMMPS' terms: pair_style granular, hooke, hertz or dmt, and rolling sds."""

import math

import numpy as np
from crossgrain_answers import demand_law
from crossgrain_worker import Unsupported

NORMALS = ("linear", "hertz")
DAMPERS = ("constant", "critical")
KINDS = ("none", "viscous", "spring", "spring_dashpot")
ROLLING = ("none", "spring")
COHESION = ("none", "dmt")
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
        materials = scene.get("materials")
        if materials:
            self.all = [law(each) for each in materials["laws"]]
            self.count = len(materials["names"])
            self.of_disk, self.of_body = arrays["disks.material"], materials["of_body"]
        else:
            self.all, self.count = [self.one], 1
            self.of_disk, self.of_body = np.zeros(scene["disks"], int), [0] * len(bodies)
        of_walls = [np.full(len(body.disk_radius), of) for body, of in zip(bodies, self.of_body)]
        of_planes = [np.full(len(body.planes), of) for body, of in zip(bodies, self.of_body)]
        self.of_id = np.concatenate([self.of_disk, *of_walls, *of_planes]).astype(int)

    def between(self, a, b):
        """That of two materials."""
        return self.all[a * self.count + b]

    def of_pairs(self, name, i, j, *columns):
        """What the method `name` of their own law makes of the columns of each pair (i, j)."""
        which = self.of_id[i] * self.count + self.of_id[j]
        found = np.zeros(len(which))
        for k in np.unique(which):
            rows = which == k
            found[rows] = getattr(self.all[k], name)(*(column[rows] for column in columns))
        return found

    def table(self):
        """Of Realised."""
        if self.count == 1:
            return [{"pair": "all", **self.one.coefficients()}]
        return [
            {"pair": f"material {a + 1} with {b + 1}", **self.between(a, b).coefficients()}
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
        self.rolls = demand_part(law, "rolling", ROLLING) != "none"
        self.cohesion = demand_part(law, "cohesion", COHESION)
        if self.cohesion != "none" and law["normal"] != "hertz":
            raise Unsupported(f'has cohesion = "{self.cohesion}" with normal = "hertz" alone')
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
        if plane and damping == "tsuji":
            raise Unsupported('has damper = "critical" between disks alone, not at planes')
        normal = f"{'hertz' if self.normal == 'hertz' else 'hooke'} {self.kn!r} {number!r}"
        if self.cohesion != "none":
            # By Young's modulus, Poisson's ratio 0 and γ = w/2: k_n is 4/3 E/2 of two bodies of the same E.
            normal = f"{self.cohesion} {1.5 * self.kn!r} {number!r} 0 {0.5 * self.w!r}"
        rolling = f" rolling sds {self.kr!r} {self.gr!r} {self.mu_r!r}" if self.rolls else ""
        return f"{normal} damping {damping} tangential {self.tangential()}{rolling}"

    def asked(self):
        """Of `compute pair/local`: the normal force, tangential force and, of rolling, that along x and y."""
        return "force p1 p2 p5 p6" if self.rolls else "force p1 p2"

    def load(self, pressing, overlap, radius):
        """What µ multiplies: f_n, or of a law that coheres f_n without its dashpot and twice the pull-off besides.

        @param radius  R₁₂"""
        if self.cohesion == "none":
            return pressing
        return self.kn * np.sqrt(radius * overlap) * overlap + self.pull_off(radius)

    def pull_off(self, radius):
        """F_po"""
        return 2.0 * math.pi * self.w * radius

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
