"""The linear law in YADE's terms: ViscElMat, Law2_ScGeom_ViscElPhys_Basic."""

import numpy as np
from yade import Ip2_ViscElMat_ViscElMat_ViscElPhys, Law2_ScGeom_ViscElPhys_Basic, ViscElMat

from contacts import in_normal_and_tangential, vectors
from kinds import lengths
from law import AT_THE_BOUND, Law


TWIST_RESISTED = {
    "name": "twist_resisted",
    "value": 1.0,
    "unit": "-",
    "note": "M is along ω_i − ω_j with its part along n, which the law leaves out: YADE resists twisting as rolling",
}


class Viscoelastic(Law):
    rolling = "none", "viscous_by_load", "spring"  # the last is CohesiveFrictional's

    def __init__(self, law):
        super().__init__(law)
        self.demand_damper(law, "constant")
        self.by_plane = self.rolls
        if self.rolls:
            self.deviations_in_space = (TWIST_RESISTED,)
        self.functors = Ip2_ViscElMat_ViscElMat_ViscElPhys(), Law2_ScGeom_ViscElPhys_Basic()

    def materials(self):
        # Two bodies' constants combine like springs in series: twice the pair's value for each.
        # Their friction angles combine to the smaller one.
        kinds = self.kinds
        self.set_friction()
        columns = [
            kinds.in_series(kinds.table(name) if has else np.zeros(kinds.meets.shape), name)
            for name, has in (
                ("kn", True),
                ("gn", True),
                ("kt", self.friction),
                ("gt", self.dashpot),
            )
        ]
        # M = −mR f_n ω_r, mR the harmonic mean of two (mRtype = 1).
        moments = np.zeros(len(kinds))
        if self.rolls:
            wanted = kinds.table("mu_r") * kinds.lengths()[0] ** 2
            moments = kinds.in_series(0.5 * wanted, "mu_r L²/2")
        return [
            ViscElMat(kn=kn, cn=cn, ks=ks, cs=cs, mR=mr, frictionAngle=self.friction_angle())
            for kn, cn, ks, cs, mr in np.column_stack([*columns, moments]).tolist()
        ]

    def coefficients(self, interaction, a, b):
        phys = interaction.phys
        made = {
            "kn": phys.kn,
            "gn": phys.cn,
            "kt": phys.ks,
            "gt": phys.cs,
            "mu": phys.tangensOfFrictionAngle,
        }
        if self.rolls:
            made["mu_r"] = phys.mR / float(lengths(self.conventions, a, b)[0]) ** 2
        return made

    def forces(self, physs, normal, tangent, slip):
        """YADE keeps the spring's part of a tangential force but not the dashpot's, so that is
        computed here from the velocities that the law saw."""
        pressure = np.array([p.Fn + p.Fv for p in physs], float).clip(min=0.0)
        spring = vectors([p.shearForce for p in physs], normal)
        mu = self.of_each(physs, "tangensOfFrictionAngle", self.mu)
        sliding = np.linalg.norm(spring, axis=1) >= mu * pressure * AT_THE_BOUND
        dashpot = (np.where(sliding, 0.0, self.of_each(physs, "cs", self.gt)) * slip.T).T
        along, tangential = in_normal_and_tangential(spring, normal, tangent)
        return pressure + along, tangential + dashpot, sliding

    def torques(self, physs, pressure, rolling):
        return (np.array([p.mR for p in physs], float) * pressure * rolling.T).T
