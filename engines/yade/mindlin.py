"""Hertz' law in YADE's terms: FrictMat, Law2_ScGeom_MindlinPhys_Mindlin, with its rolling spring
(includeMoment) or its adhesion (includeAdhesion: Derjaguin, Muller and Toporov)."""

import math

import numpy as np
from yade import (
    FrictMat,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom,
    Ip2_FrictMat_FrictMat_MindlinPhys,
    Law2_ScGeom_MindlinPhys_Mindlin,
    O,
)

from contacts import in_normal_and_tangential, vectors
from crossgrain_worker import Unsupported
from kinds import lengths
from law import Law


class Mindlin(Law):
    rolling, cohesion = ("none", "spring"), ("none", "dmt")

    def __init__(self, law):
        super().__init__(law)
        self.demand_damper(law, "critical")
        if self.coheres and self.gn > 0:
            raise Unsupported(
                'has cohesion = "dmt" without a normal dashpot only (gn = 0): its dashpot pulls '
                "by up to F_po besides"
            )
        self.functors = (
            Ip2_FrictMat_FrictMat_MindlinPhys(),
            Law2_ScGeom_MindlinPhys_Mindlin(includeMoment=self.rolls, includeAdhesion=self.coheres),
        )
        self.by_plane = self.rolls
        self.deviations = []

    def shapes(self):
        bounds, geometries = super().shapes()
        if self.rolls:
            # The limit of a moment is that of the mean radius, so a plane must be a sphere like
            # the one that it meets; materials() makes up for its R₁₂ of a/2.
            geometries[1] = Ig2_Wall_Sphere_ScGeom(noRatch=False, hertzian=False)
        return bounds, geometries

    def set_kinds(self, kinds):
        super().set_kinds(kinds)
        self.inertia = 1.0
        self.set_friction()
        constants, _ = self.functors
        self.set_dampers()
        if self.coheres:
            constants.gamma = kinds.one(0.5 * kinds.table("w"), "w/2")
        if self.rolls:
            length, square = kinds.lengths()
            a, b = kinds.radii()
            constants.krot = self.one_stiffness(kinds.table("kr") * square)
            with np.errstate(invalid="ignore"):  # of two planes
                limit = kinds.table("mu_r") * length / (0.5 * (a + b))
            constants.eta = kinds.one(limit, "mu_r L/mean radius")

    def one_stiffness(self, wanted):
        """krot. What another meaning of `kr` than N m gives is the mean of the pairs', reported."""
        if self.conventions["rolling_stiffness"] != "length_square":
            return self.kinds.one(wanted, "k_r")
        used = wanted[self.kinds.meets]
        if np.ptp(used) > 1e-12 * used.max():
            self.deviations.append(
                {
                    "name": "rolling_stiffness",
                    "value": float(used.max() / used.min()),
                    "unit": "-",
                    "note": "one k_r for all pairs, their mean; the value is the largest of the "
                    "scene's by the smallest",
                }
            )
        return float(used.mean())

    def materials(self):
        # E of two bodies' e = E/(1 − ν²) in series; two alike bodies have the scene's k_n and k_t.
        kinds = self.kinds
        scale = np.where(kinds.plane[:, None] | kinds.plane[None, :], math.sqrt(2.0), 1.0)
        normal = kinds.table("kn") * scale
        elastic = kinds.in_series(0.75 * normal, "E")
        poisson = np.zeros(len(kinds))
        if self.friction:
            shear = kinds.table("kt") * scale
            poisson = self.poisson(elastic, normal, shear)
        return [
            FrictMat(young=e * (1 - nu**2), poisson=nu, frictionAngle=self.friction_angle())
            for e, nu in zip(elastic.tolist(), poisson.tolist())
        ]

    def poisson(self, elastic, normal, shear):
        """k_t = 8/Σ 1/g of both bodies' g = G/(2 − ν) = e (1 − ν)/(2 (2 − ν)): of two alike bodies
        r = k_t/k_n = 3 (1 − ν)/(2 − ν)."""
        kinds = self.kinds
        ratio = np.diag(shear) / np.diag(normal)
        of_walls = 6 * kinds.in_series(shear / 8, "G") / elastic
        other = kinds.wall & ((elastic != elastic[0]) | (shear[0] != shear[0, 0]))
        ratio[other] = of_walls[other]
        if not all((0 < ratio) & (ratio < 2)):
            raise Unsupported(
                f"has Poisson's ratios between -1 and 1 only, which is kt/kn between 0 and 2, "
                f"not {ratio[(ratio <= 0) | (ratio >= 2)][0]:g}"
            )
        return (3 - 2 * ratio) / (3 - ratio)

    def dampers(self):
        # γ √(m₁₂ S) is 2 β √(m₁₂ S) to YADE, which takes betan for a betas that is not given.
        tables = self.kinds.table("gn"), self.kinds.table("gt") * self.dashpot
        return [table / 2 / math.sqrt(self.inertia) for table in tables]

    def set_dampers(self):
        constants, _ = self.functors
        constants.betan, constants.betas = map(self.each_pair, self.dampers())

    def scale_inertia(self, factor):
        self.inertia *= factor
        self.set_dampers()
        betan, betas = self.dampers()
        for interaction in O.interactions:
            if interaction.isReal:
                pair = tuple(O.bodies[i].material.id for i in (interaction.id1, interaction.id2))
                interaction.phys.betan = float(betan[pair])
                interaction.phys.betas = float(betas[pair])

    def coefficients(self, interaction, a, b):
        geom, phys = interaction.geom, interaction.phys
        radius = geom.refR1 * geom.refR2 / (geom.refR1 + geom.refR2)
        if self.rolls and math.isinf(b):
            radius = a
        root = math.sqrt(radius)
        made = {
            "kn": phys.kno / root,
            "gn": 2 * phys.betan,
            "kt": phys.kso / root,
            "gt": 2 * phys.betas,
            "mu": phys.tangensOfFrictionAngle,
        }
        if self.coheres:
            made["w"] = phys.adhesionForce / (2 * math.pi * radius)
        if self.rolls:
            length, square = map(float, lengths(self.conventions, a, b))
            made |= {"kr": phys.kr / square, "mu_r": phys.maxBendPl / length}
        return made

    def forces(self, physs, normal, tangent, slip):
        force = vectors([p.normalForce + p.shearForce for p in physs], normal)  # dashpots are in them
        return *in_normal_and_tangential(force, normal, tangent), np.array([p.isSliding for p in physs], bool)

    @staticmethod
    def moment(phys):
        return phys.momentBend
