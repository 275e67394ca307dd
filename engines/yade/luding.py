"""The elasto-plastic adhesive law in YADE's terms: LudingMat, Law2_ScGeom_LudingPhys_Basic."""

import numpy as np
from crossgrain_worker import Unsupported
from yade import Ip2_LudingMat_LudingMat_LudingPhys, Law2_ScGeom_LudingPhys_Basic, LudingMat, O

from law import Law


class Luding(Law):
    cohesion = ("elasto_plastic",)

    def __init__(self, law):
        super().__init__(law)
        if self.gn > 0 or self.gt > 0:
            raise Unsupported(
                'has cohesion = "elasto_plastic" without dashpots only (gn = gt = 0): its '
                "LudingMat has one constant for both, and lets the normal one pull"
            )
        if law["plastic_depth"] == 0:
            raise Unsupported("divides by plastic_depth: has none of 0")
        self.functors = Ip2_LudingMat_LudingMat_LudingPhys(), Law2_ScGeom_LudingPhys_Basic()

    def set_kinds(self, kinds):
        super().set_kinds(kinds)
        if any(kinds.of_plane):
            raise Unsupported('has no planes with cohesion = "elasto_plastic": it divides by 0')
        if self.friction:  # YADE takes the smaller of two friction angles
            self.angles = np.arctan(np.diag(kinds.table("mu")))
            made = np.tan(np.minimum(self.angles[:, None], self.angles[None, :]))
            kinds.demand(made, kinds.table("mu"), "mu", "friction is the smaller one of two")
        else:
            self.angles = np.zeros(len(kinds))

    def materials(self):
        kinds = self.kinds
        none = np.zeros(kinds.meets.shape)
        columns = [
            kinds.in_series(0.5 * (kinds.table(name) if has else none), f"{name}/2")
            for name, has in (
                ("kn", True),
                ("k_unload", True),
                ("kc", True),
                ("plastic_depth", True),
                ("kt", self.friction),
            )
        ]
        return [
            LudingMat(k1=k1, kp=kp, kc=kc, PhiF=phi, ks=ks, G0=0, frictionAngle=angle)
            for k1, kp, kc, phi, ks, angle in np.column_stack([*columns, self.angles]).tolist()
        ]

    def begin(self):
        # YADE has δ₀ of the k₂ before the step in which δ_max grew. A contact that is there at the
        # start had none, and would be elastic until it is pressed deeper.
        for interaction in O.interactions:
            if interaction.isReal:
                phys = interaction.phys
                rise = (phys.kp - phys.k1) * min(phys.DeltMax / phys.DeltPMax, 1)
                phys.DeltNull = min(rise / (phys.k1 + rise) * phys.DeltMax, phys.DeltPNull)

    def coefficients(self, interaction, a, b):
        phys = interaction.phys
        return {
            "kn": phys.k1,
            "gn": 0.0,
            "kt": phys.ks,
            "gt": 0.0,
            "mu": phys.tangensOfFrictionAngle,
            "kc": phys.kc,
        }

    def forces(self, physs, normal, tangent, slip):
        return self.elastic_forces(physs, normal, tangent, np.abs)
