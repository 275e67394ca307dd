"""The linear law with a rolling spring in YADE's terms: CohFrictMat without cohesion,
Law2_ScGeom6D_CohFrictPhys_CohesionMoment. It has no dashpot of any kind."""

import numpy as np
from crossgrain_worker import Unsupported
from yade import (
    Bo1_Box_Aabb,
    Bo1_Sphere_Aabb,
    CohFrictMat,
    Ig2_Box_Sphere_ScGeom6D,
    Ig2_Sphere_Sphere_ScGeom6D,
    Ip2_CohFrictMat_CohFrictMat_CohFrictPhys,
    Law2_ScGeom6D_CohFrictPhys_CohesionMoment,
    MatchMaker,
)

from kinds import lengths
from law import Law

MOST_DISKS_AT_PLANES = 16  # kinds: each needs a bit of YADE's masks


class CohesiveFrictional(Law):
    rolling = ("spring",)
    by_plane = boxes = True
    plane_arm = "middle"

    def __init__(self, law):
        super().__init__(law)
        if self.gn > 0 or self.gt > 0:
            raise Unsupported(
                'has rolling = "spring" with normal = "linear" without dashpots only '
                "(gn = gt = 0): its CohFrictMat has none"
            )
        self.functors = (
            Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(),
            Law2_ScGeom6D_CohFrictPhys_CohesionMoment(
                # Else moments are of cohesive contacts alone, and forget where they slipped.
                always_use_moment_law=True,
                useIncrementalForm=True,
            ),
        )

    def shapes(self):
        # Walls have no geometry with rotations: planes are boxes.
        spheres = Ig2_Sphere_Sphere_ScGeom6D(avoidGranularRatcheting=False, updateRotations=False)
        return [Bo1_Sphere_Aabb(), Bo1_Box_Aabb()], [spheres, Ig2_Box_Sphere_ScGeom6D()]

    def set_kinds(self, kinds):
        super().set_kinds(kinds)
        disks = np.count_nonzero(~kinds.wall)
        if kinds.plane.any() and disks > MOST_DISKS_AT_PLANES:
            raise Unsupported(f"has this law at planes for at most {MOST_DISKS_AT_PLANES} radii")
        self.set_friction()
        length, square = kinds.lengths()
        a, b = kinds.radii()
        # k_n = 2/(1/E_a a + 1/E_b b), k_s the same of ν E, α the harmonic mean, k_r = α k_s a b.
        shear = kinds.table("kt") if self.friction else kinds.table("kr")
        with np.errstate(invalid="ignore"):  # of two planes
            alpha = kinds.table("kr") * square / (a * b * shear)
        normal = kinds.in_series(0.5 * kinds.table("kn"), "kn/2")
        poisson = kinds.in_series(0.5 * shear, "kt/2") / normal
        alpha = kinds.in_series(0.5 * alpha, "alphaKr/2")
        # The limit is min(η_a a, η_b b) f_n.
        wanted = kinds.table("mu_r") * length
        limit = np.diag(wanted).copy()
        limit[kinds.wall] = wanted[:, kinds.wall][~kinds.wall].max(axis=0)
        made = np.minimum(limit[:, None], limit[None, :])
        kinds.demand(made, wanted, "mu_r L", "limit is the smaller one of two materials'")
        self.constants = np.column_stack([normal, poisson, alpha, limit]).tolist()

    def materials(self):
        return [self.material(k, a) for k, a in enumerate(self.kinds.radius.tolist())]

    def material(self, kind, radius):
        """Of a kind; of a plane for disks of that radius, which YADE gives it too."""
        normal, poisson, alpha, limit = self.constants[kind]
        return CohFrictMat(
            young=normal / radius,
            poisson=poisson,
            frictionAngle=self.friction_angle(),
            momentRotationLaw=True,
            alphaKr=alpha,
            alphaKtw=0,
            etaRoll=limit / radius,
            etaTwist=0,
        )

    def name_box(self, material, plane, disks):
        """That material is the plane's kind to those disks."""
        if self.friction and self.kinds.several:
            angles, constants = np.arctan(self.kinds.table("mu")), self.functors[0]
            own = disks, material, float(angles[plane, disks])
            constants.frictAngle = MatchMaker(matches=[*constants.frictAngle.matches, own])

    def coefficients(self, interaction, a, b):
        phys = interaction.phys
        length, square = map(float, lengths(self.conventions, a, b))
        return {
            "kn": phys.kn,
            "gn": 0.0,
            "kt": phys.ks,
            "gt": 0.0,
            "mu": phys.tangensOfFrictionAngle,
            "kr": phys.kr / square,
            "mu_r": phys.maxRollPl / length,
        }

    def forces(self, physs, normal, tangent, slip):
        return self.elastic_forces(physs, normal, tangent, lambda pressure: pressure)

    @staticmethod
    def moment(phys):
        return phys.moment_bending
