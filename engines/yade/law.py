"""What YADE's contact laws have in common."""

import math

import numpy as np
from crossgrain_answers import demand_tangential
from crossgrain_worker import Unsupported
from yade import (
    Bo1_Sphere_Aabb,
    Bo1_Wall_Aabb,
    Ig2_Sphere_Sphere_ScGeom,
    Ig2_Wall_Sphere_ScGeom,
    MatchMaker,
)

from contacts import dot, in_normal_and_tangential, vectors, xyz, z

MOST_KINDS = 4  # of disks in the table of pairs: a longer one is of no use to a reader
AT_THE_BOUND = 1 - 1e-12  # a slipping contact's spring is scaled to the bound, up to rounding


class Law:
    """A scene's constants. A law's own class adds

    functors        of YADE: one that makes a pair's constants, one that makes its force
    materials()     of the kinds of bodies
    coefficients()  what YADE made of a pair's constants, in the scene's terms
    forces()        those of contacts: pressure, f_t along the tangent or, in space, where there is none, as a vector,
                    and whether they slide. Their slip is that of the first on the second, likewise
    torques()       of contacts that resist rolling, on the second, in the plane about z
    """

    rolls = coheres = False
    by_plane = False  # whether planes need a material of their own
    boxes = False  # whether planes are boxes, one for each kind of disks
    plane_arm = "surface"
    deviations = deviations_in_space = ()
    rolling, cohesion = ("none",), ("none",)  # what a class has

    def __init__(self, law):
        kind = law["tangential"]
        demand_tangential(law, ("none", "spring", "spring_dashpot"))
        self.friction = kind != "none" and law["mu"] > 0
        self.kn, self.gn = law["kn"], law["gn"]
        self.mu = law["mu"] if self.friction else 0.0
        self.kt = law["kt"] if self.friction else 0.0
        self.dashpot = self.friction and kind == "spring_dashpot"
        self.gt = law["gt"] if self.dashpot else 0.0
        if self.gt > 0 and self.kt == 0:
            raise Unsupported(
                "holds no tangential dashpot to the Coulomb bound without a spring (kt = 0)"
            )
        self.conventions = law
        self.demand_part(law, "rolling", self.rolling)
        self.demand_part(law, "cohesion", self.cohesion)
        self.rolls = law.get("rolling", "none") != "none"
        self.coheres = law.get("cohesion", "none") != "none"
        if self.rolls and self.coheres:
            raise Unsupported("has no law with rolling resistance and cohesion")
        if self.rolls and law["rolling"] == "spring" and law["gr"] > 0:
            raise Unsupported("has no rolling dashpot (gr = 0)")

    @property
    def by_radius(self):
        return self.rolls

    def set_kinds(self, kinds):
        """Called once, before materials()."""
        self.kinds = kinds

    @staticmethod
    def demand_part(law, part, values):
        value = law.get(part, "none")
        if value not in values:
            had = " | ".join(values)
            raise Unsupported(f'has {part} = {had} with normal = "{law["normal"]}", not "{value}"')

    def demand_damper(self, law, only):
        if law["damper"] != only and (self.gn > 0 or self.gt > 0):
            raise Unsupported(
                f'has only damper = "{only}" with normal = "{law["normal"]}", '
                f'not "{law["damper"]}"'
            )

    def demand_plane_arm(self, with_planes):
        """Only lever arms at planes differ between YADE's laws."""
        arm = self.conventions["plane_arm"]
        if with_planes and self.friction and arm != self.plane_arm:
            raise Unsupported(f'has plane_arm = "{self.plane_arm}" with this law, not "{arm}"')

    def shapes(self):
        """Functors that bound shapes, and those that find how two of them lie."""
        # noRatch would have springs stretched at another point than the one where forces act;
        # hertzian makes a plane a sphere of 1e8 radii, not of one.
        return [Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], [
            Ig2_Sphere_Sphere_ScGeom(avoidGranularRatcheting=False),
            Ig2_Wall_Sphere_ScGeom(noRatch=False, hertzian=True),
        ]

    def each_pair(self, values):
        """A MatchMaker of a table of two kinds' values; kinds are numbered as their materials."""
        if not self.kinds.several:
            return MatchMaker(algo="val", val=float(values[0, 0]))
        pairs = np.argwhere(np.triu(np.ones_like(values)))
        return MatchMaker(matches=[(int(a), int(b), float(values[a, b])) for a, b in pairs])

    def set_friction(self):
        """Else YADE takes the smaller of two materials' friction angles."""
        if self.friction and self.kinds.several:
            self.functors[0].frictAngle = self.each_pair(np.arctan(self.kinds.table("mu")))

    def friction_angle(self):
        return math.atan(self.mu)

    def of_each(self, physs, name, alike):
        """A constant of contacts, which all have the same in a scene of one material."""
        return np.array([getattr(p, name) for p in physs], float) if self.kinds.several else alike

    def torques(self, physs, pressure, rolling):
        """@param rolling  the first's spin less the second's"""
        return (z if rolling.ndim == 1 else xyz)([self.moment(p) for p in physs])

    def elastic_forces(self, physs, normal, tangent, bound):
        """Of a law without dashpots. @param bound  makes that of f_t of the pressure"""
        pressure = dot(vectors([p.normalForce for p in physs], normal), normal)
        shear = vectors([p.shearForce for p in physs], normal)
        mu = self.of_each(physs, "tangensOfFrictionAngle", self.mu)
        sliding = np.linalg.norm(shear, axis=1) >= mu * bound(pressure) * AT_THE_BOUND
        along, tangential = in_normal_and_tangential(shear, normal, tangent)
        return pressure + along, tangential, sliding

    def without_absent(self, constants):
        """Those that contacts have: without friction no tangential one, of a spring no dashpot."""
        has = {"mu": self.friction, "kt": self.friction, "gt": self.dashpot}
        return {name: value for name, value in constants.items() if has.get(name, True)}

    def begin(self):
        """Called after the first step, in which contacts of the start were made."""

    def scale_inertia(self, factor):
        """Called when the masses are set to so many times what they were, which must not change a
        force."""


def kinds_of_disks(radius, mass):
    """Ids of the first two disks of each kind by the kind's name."""
    kinds = {}
    for i, (a, m) in enumerate(zip(radius, mass)):
        name = f"{a * 1e3:.4g} mm, {m * 1e3:.4g} g"
        if name in kinds:
            if len(kinds[name]) < 2:
                kinds[name].append(i)
        elif len(kinds) < MOST_KINDS:
            kinds[name] = [i]
    return kinds


def representative_pairs(radius, mass, wall_disks, plane_of):
    """(name, i, j) of one pair of each kind that the scene can bring together.
    @param plane_of  a plane's id for a disk's, if there are planes"""
    kinds = list(kinds_of_disks(radius, mass).items())
    pairs = []
    for a, (name, ids) in enumerate(kinds):
        for other, others in kinds[a:]:
            if name != other or len(ids) == 2:
                pairs.append((f"{name} with {other}", ids[0], others[-1]))
        if wall_disks:
            pairs.append((f"{name} with wall disk", ids[0], wall_disks[0]))
        if plane_of:
            pairs.append((f"{name} with plane", ids[0], plane_of(ids[0])))
    return pairs
