"""The contact law of a scene in YADE's terms: ViscElMat, Law2_ScGeom_ViscElPhys_Basic."""

import math

from protocol import Unsupported
from yade import ViscElMat

MOST_KINDS = 4  # of disks in the table of pairs: a longer one tells a reader nothing


class Law:
    def __init__(self, law):
        kind = law["tangential"]
        if law["normal"] != "linear":
            raise Unsupported('has only normal = "linear"')
        if law["damper"] != "constant" and (law["gn"] > 0 or law["gt"] > 0):
            raise Unsupported('has only damper = "constant"')
        if kind not in ("none", "spring", "spring_dashpot"):
            raise Unsupported(f'has tangential = none | spring | spring_dashpot, not "{kind}"')
        self.friction = kind != "none" and law["mu"] > 0
        self.kn, self.gn = law["kn"], law["gn"]
        self.mu = law["mu"] if self.friction else 0.0
        self.kt = law["kt"] if self.friction else 0.0
        self.gt = law["gt"] if self.friction and kind == "spring_dashpot" else 0.0
        if self.gt > 0 and self.kt == 0:
            raise Unsupported(
                "holds no tangential dashpot to the Coulomb bound without a spring (kt = 0)"
            )

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

    def effects(self, scene):
        called = {
            "normal_damping": self.gn > 0,
            "friction": self.friction,
            "tangential_spring": self.kt > 0,
            "tangential_damping": self.gt > 0,
            "rotation": self.friction and scene["rotation"],
            "gravity": any(scene["gravity"]),
            "moving_walls": any(body["motion"]["kind"] != "fixed" for body in scene["bodies"]),
        }
        return [name for name, calls in called.items() if calls]


def coefficients(phys):
    """What YADE made of a pair's constants."""
    return {
        "kn": phys.kn,
        "gn": phys.cn,
        "kt": phys.ks,
        "gt": phys.cs,
        "mu": phys.tangensOfFrictionAngle,
        "en": 0.0,
        "et0": 0.0,
    }


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


def representative_pairs(radius, mass, wall_disks, planes):
    """(name, i, j) of one pair of each kind that the scene can bring together."""
    kinds = list(kinds_of_disks(radius, mass).items())
    pairs = []
    for a, (name, ids) in enumerate(kinds):
        for other, others in kinds[a:]:
            if name != other or len(ids) == 2:
                pairs.append((f"{name} with {other}", ids[0], others[-1]))
        if wall_disks:
            pairs.append((f"{name} with wall disk", ids[0], wall_disks[0]))
        if planes:
            pairs.append((f"{name} with plane", ids[0], planes[0]))
    return pairs
