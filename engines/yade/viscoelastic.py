"""The linear law in YADE's terms: ViscElMat, Law2_ScGeom_ViscElPhys_Basic."""

import math

import numpy as np
from yade import Ip2_ViscElMat_ViscElMat_ViscElPhys, Law2_ScGeom_ViscElPhys_Basic, ViscElMat

from contacts import dot, xy
from law import Law

AT_THE_BOUND = 1 - 1e-12  # a slipping contact's spring is scaled to the bound, up to rounding


class Viscoelastic(Law):
    def __init__(self, law):
        super().__init__(law)
        self.demand_damper(law, "constant")
        self.functors = Ip2_ViscElMat_ViscElMat_ViscElPhys(), Law2_ScGeom_ViscElPhys_Basic()

    def material(self):
        # Two bodies' constants combine like springs in series: twice the pair's value for each.
        # Their friction angles combine to the smaller one.
        return ViscElMat(
            kn=2 * self.kn,
            cn=2 * self.gn,
            ks=2 * self.kt,
            cs=2 * self.gt,
            frictionAngle=math.atan(self.mu),
        )

    def coefficients(self, interaction):
        phys = interaction.phys
        return {
            "kn": phys.kn,
            "gn": phys.cn,
            "kt": phys.ks,
            "gt": phys.cs,
            "mu": phys.tangensOfFrictionAngle,
        }

    def forces(self, physs, normal, tangent, slip):
        """YADE keeps the spring's part of a tangential force but not the dashpot's, so that is
        computed here from the velocities that the law saw."""
        pressure = np.array([p.Fn + p.Fv for p in physs], float).clip(min=0.0)
        spring = xy([p.shearForce for p in physs])
        sliding = np.hypot(spring[:, 0], spring[:, 1]) >= self.mu * pressure * AT_THE_BOUND
        dashpot = np.where(sliding, 0.0, self.gt * slip)
        return pressure + dot(spring, normal), dot(spring, tangent) + dashpot, sliding
