"""What YADE's contact laws have in common."""

from crossgrain_answers import demand_tangential
from crossgrain_worker import Unsupported

MOST_KINDS = 4  # of disks in the table of pairs: a longer one is of no use to a reader


class Law:
    """A scene's constants. A law's own class adds

    functors        of YADE: one that makes a pair's constants, one that makes its force
    material()      of every body
    coefficients()  what YADE made of a pair's constants, in the scene's terms
    forces()        those of contacts
    """

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

    def demand_damper(self, law, only):
        if law["damper"] != only and (self.gn > 0 or self.gt > 0):
            raise Unsupported(
                f'has only damper = "{only}" with normal = "{law["normal"]}", '
                f'not "{law["damper"]}"'
            )

    def without_absent(self, constants):
        """Those that contacts have: without friction no tangential one, of a spring no dashpot."""
        has = {"mu": self.friction, "kt": self.friction, "gt": self.dashpot}
        return {name: value for name, value in constants.items() if has.get(name, True)}

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
