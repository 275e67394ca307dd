"""Hertz' law in YADE's terms: FrictMat, Law2_ScGeom_MindlinPhys_Mindlin."""

import math

import numpy as np
from yade import (
    FrictMat,
    Ip2_FrictMat_FrictMat_MindlinPhys,
    Law2_ScGeom_MindlinPhys_Mindlin,
    MatchMaker,
    O,
)

from contacts import dot, xy
from law import Law
from crossgrain_worker import Unsupported


class Mindlin(Law):
    def __init__(self, law):
        super().__init__(law)
        self.demand_damper(law, "critical")
        self.ratio = self.kt / self.kn  # of two alike bodies 3 (1 − ν)/(2 − ν)
        if self.friction and not 0 < self.ratio < 2:
            raise Unsupported(
                f"has Poisson's ratios between -1 and 1 only, which is kt/kn between 0 and 2, "
                f"not {self.ratio:g}"
            )
        self.functors = Ip2_FrictMat_FrictMat_MindlinPhys(), Law2_ScGeom_MindlinPhys_Mindlin()
        self.inertia = 1.0
        self.set_dampers()

    def material(self):
        # That of two alike bodies whose 4/3 E₁₂ and 8 G₁₂ are the scene's k_n and k_t.
        poisson = (3 - 2 * self.ratio) / (3 - self.ratio) if self.friction else 0.0
        young = 1.5 * self.kn * (1 - poisson**2)
        return FrictMat(young=young, poisson=poisson, frictionAngle=math.atan(self.mu))

    def set_dampers(self):
        # γ √(m₁₂ S) is 2 β √(m₁₂ S) to YADE, which takes betan for a betas that is not given.
        betan, betas = (g / 2 / math.sqrt(self.inertia) for g in (self.gn, self.gt))
        constants, _ = self.functors
        constants.betan = MatchMaker(algo="val", val=betan)
        constants.betas = MatchMaker(algo="val", val=betas)
        return betan, betas

    def scale_inertia(self, factor):
        self.inertia *= factor
        betan, betas = self.set_dampers()
        for interaction in O.interactions:
            if interaction.isReal:
                interaction.phys.betan, interaction.phys.betas = betan, betas

    def coefficients(self, interaction):
        geom, phys = interaction.geom, interaction.phys
        root = math.sqrt(geom.refR1 * geom.refR2 / (geom.refR1 + geom.refR2))
        return {
            "kn": phys.kno / root,
            "gn": 2 * phys.betan,
            "kt": phys.kso / root,
            "gt": 2 * phys.betas,
            "mu": phys.tangensOfFrictionAngle,
        }

    def forces(self, physs, normal, tangent, slip):
        force = xy([p.normalForce + p.shearForce for p in physs])  # dashpots are in them
        sliding = np.array([p.isSliding for p in physs], bool)
        return dot(force, normal), dot(force, tangent), sliding
