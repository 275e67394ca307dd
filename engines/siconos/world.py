"""A scene as a nonsmooth dynamical system of Siconos, in SI units. Ids are the protocol's: disks, then wall disks, then
planes."""

import math

import numpy as np
import siconos.kernel as sk
import siconos.numerics as sn
from crossgrain_worker import Unsupported
from siconos.mechanics.collision.bodies import DiskDiskR

FOR_EVER = 1e9  # [s]: Siconos wants an end
BLOCKED = 1e12  # times m a²: an inertia that nothing here turns


def version():
    """Of Debian's package; the modules report none."""
    with open("/var/lib/dpkg/status", encoding="utf-8") as status:
        for entry in status.read().split("\n\n"):
            if entry.startswith("Package: python3-siconos\n"):
                return next(l[9:] for l in entry.splitlines() if l.startswith("Version: "))
    return "unknown"


class RigidLaw:
    """What rigid contacts make of a scene's law: a friction coefficient, and a restitution for each pair."""

    def __init__(self, law):
        """@raise Unsupported for laws whose restitution depends on speed"""
        self.soft = law["normal"] == "linear"
        if not self.soft and law["normal"] != "rigid":
            raise Unsupported(
                'has rigid contacts, normal = "rigid"; they can stand for normal = "linear", whose restitution is '
                "the same at every speed"
            )
        if self.soft and law["gn"] > 0 and law["damper"] != "constant":
            raise Unsupported('can stand in for a linear law with damper = "constant" only')
        if not self.soft and law["et0"] != 0:
            raise Unsupported("has no tangential restitution, so it needs et0 = 0")
        self.law = law
        self.friction = 0.0 if self.soft and law["tangential"] == "none" else law["mu"]
        self.damps = law["gn"] > 0 if self.soft else law["en"] < 1

    def restitution(self, inverse_mass):
        """inverse_mass: 1/m₁ + 1/m₂, a wall's being 0.

        Of f = k_n δ − γ_n v_n: exp(−β t_c), β = γ_n/(2 m₁₂), ω² = k_n/m₁₂ − β². The contact ends when the bodies
        part, ω t_c = π, or, where tension is cut, when the force does (Schwager and Pöschel, Granular Matter 9
        (2007) 465)."""
        if not self.soft:
            return self.law["en"]
        beta = 0.5 * self.law["gn"] * inverse_mass
        squared = self.law["kn"] * inverse_mass - beta * beta
        if not squared > 0:
            raise Unsupported("has rigid contacts, which stand for no law that is overdamped")
        omega = math.sqrt(squared)
        phase = math.atan2(2 * beta * omega, beta * beta - squared) if self.law["tension"] == "cut" else math.pi
        return math.exp(-beta * phase / omega)


class World:
    """restitution(i, j) and friction are those of pairs; inertia None: spins stay."""

    def __init__(self, disks, bodies, gravity, dt, restitution, friction, tolerance, iterations):
        self.bodies, self.restitution, self.friction, self.dt = bodies, restitution, friction, dt
        self.count, self.steps, self.unsolved, self.tolerance = len(disks["mass"]), 0, 0, tolerance
        # The solver's residual has impulses beside velocities: with masses in kg it took wrong ones for right.
        self.unit = float(np.mean(disks["mass"])) if self.count else 1.0
        self.system = sk.NonSmoothDynamicalSystem(0.0, FOR_EVER)
        self.kept = []  # Siconos points into these arrays
        self.laws = {}  # e_n → law
        self.disks = [self.new_disk(disks, k, gravity) for k in range(self.count)]
        self.place_walls(disks["radius"])
        self.links = {}  # (i, j) → interaction
        self.reach = 0.2 * min(disks["radius"]) if self.count else 0.0
        self.list_pairs()
        problem = sk.FrictionContact(2, sn.SICONOS_FRICTION_2D_NSGS)
        problem.setMStorageType(sn.NM_SPARSE_BLOCK)  # dense: 600 contacts take seconds a step
        self.options = problem.numericsSolverOptions()
        self.options.dparam[sn.SICONOS_DPARAM_TOL] = tolerance
        self.options.iparam[sn.SICONOS_IPARAM_MAX_ITER] = iterations
        self.simulation = sk.TimeStepping(
            self.system, sk.TimeDiscretisation(0.0, dt), sk.MoreauJeanOSI(0.5), problem
        )
        self.simulation.setNewtonOptions(sk.SICONOS_TS_LINEAR)  # H of the step's start; else y and its rate are stale
        self.simulation.setWarnOnNonConvergence(False)  # counted instead
        self.kept += [problem]

    def held(self, values):
        self.kept.append(np.array(values, float))
        return self.kept[-1]

    def new_disk(self, disks, k, gravity):
        mass, radius = disks["mass"][k] / self.unit, disks["radius"][k]
        inertia = BLOCKED * mass * radius**2 if disks["inertia"] is None else disks["inertia"][k] / self.unit
        place = self.held([*disks["position"][k], 0.0])
        velocity = self.held([*disks["velocity"][k], disks["spin"][k]])
        body = sk.LagrangianLinearTIDS(place, velocity, self.held(np.diag([mass, mass, inertia])))
        if np.any(gravity):
            body.setFExtPtr(self.held([mass * gravity[0], mass * gravity[1], 0.0]))
        self.system.insertDynamicalSystem(body)
        return body

    def driven(self, place, velocity):
        """A body whose three velocities are prescribed, and the array that prescribes them."""
        body = sk.LagrangianLinearTIDS(self.held(place), self.held(velocity), self.held(np.eye(3)))
        condition = sk.BoundaryCondition([0, 1, 2], list(velocity))
        body.setBoundaryConditions(condition)
        self.system.insertDynamicalSystem(body)
        self.kept.append(condition)
        return body, condition.prescribedVelocity()

    def place_walls(self, radius):
        """Each wall disk is driven by itself; a plane with the body that carries it, if that moves."""
        self.walls, self.drives, self.planes = [], [], []
        self.radius = np.concatenate([radius, *(body.disk_radius for body in self.bodies)])
        for body in self.bodies:
            places, velocities = body.disk_states(0.0)
            spin = body.state(0.0)[3]
            drives = []
            for place, velocity in zip(places, velocities):
                driven, drive = self.driven([*place, 0.0], [*velocity, spin])
                self.walls.append(driven)
                drives.append(drive)
            self.drives.append((body, drives))
        for body in self.bodies:
            carrier = None
            if body.planes and body.kind in ("translating", "oscillating"):
                carrier, drive = self.driven([0.0] * 3, [*body.state(0.0)[1], 0.0])
                self.drives.append((body, drive))
            for plane in body.planes:
                self.planes.append((np.array(plane["point"]), np.array(plane["normal"]), carrier, body))

    def drive_walls(self, t):
        for body, drives in self.drives:
            if body.kind == "fixed":
                continue
            if isinstance(drives, list):
                spin = body.state(t)[3]
                for drive, velocity in zip(drives, body.disk_states(t)[1]):
                    drive[:] = (*velocity, spin)
            else:
                drives[:2] = body.state(t)[1]

    def places(self):
        """Centres of disks and wall disks, (n, 2)."""
        return np.array([body.q()[:2] for body in (*self.disks, *self.walls)]).reshape(-1, 2)

    def landmarks(self):
        """What lists of pairs grow old by: the places, then the centres of the bodies of planes, which turn none of them."""
        centres = [body.state(self.steps * self.dt)[0] for _, _, _, body in self.planes]
        return np.concatenate([self.places(), np.reshape(centres, (-1, 2))])

    def near(self):
        """Pairs that may touch before anything has moved by half of the reach."""
        place = self.places()
        for i in range(self.count):
            apart = np.hypot(*(place[i + 1 :] - place[i]).T) - self.radius[i] - self.radius[i + 1 :]
            for j in np.flatnonzero(apart < self.reach):
                yield i, i + 1 + int(j)
        t = self.steps * self.dt
        for p, (point, normal, _, body) in enumerate(self.planes):
            moved = body.state(t)[0] - body.centre
            height = (place[: self.count] - point - moved) @ normal - self.radius[: self.count]
            for i in np.flatnonzero(height < self.reach):
                yield int(i), len(self.radius) + p

    def list_pairs(self):
        wanted = set(self.near())
        for pair in sorted(self.links.keys() - wanted):
            self.system.removeInteraction(self.links.pop(pair))
        for pair in sorted(wanted - self.links.keys()):
            self.links[pair] = self.new_link(*pair)
        self.listed = self.landmarks()

    def law_of(self, i, j):
        en = self.restitution(i, j)
        if en not in self.laws:
            self.laws[en] = sk.NewtonImpactFrictionNSL(en, 0.0, self.friction, 2)
        return self.laws[en]

    def new_link(self, i, j):
        """Normal and tangential velocity as the protocol has them: along n from j to i, and along z × n."""
        if j < len(self.radius):
            relation = DiskDiskR(self.radius[i], self.radius[j])
            other = self.disks[j] if j < self.count else self.walls[j - self.count]
        else:
            point, n, other, _ = self.planes[j - len(self.radius)]
            rows = [[n[0], n[1], 0.0], [-n[1], n[0], -self.radius[i]]]
            if other:
                rows = [[*row, -row[0], -row[1], 0.0] for row in rows]
            relation = sk.LagrangianLinearTIR(self.held(rows), self.held([-n @ point - self.radius[i], 0.0]))
        link = sk.Interaction(self.law_of(i, j), relation)
        both = (self.disks[i], other) if other else (self.disks[i],)
        self.system.link(link, *both)
        return link

    def step(self):
        """Returns impulses [(i, j, normal, tangential)] of pairs between which one passed."""
        self.drive_walls((self.steps + 1) * self.dt)
        self.simulation.computeOneStep()
        found = []
        for (i, j), link in self.links.items():
            impulse = link.lambda_(1)
            if impulse[0] != 0.0 or impulse[1] != 0.0:
                found.append((i, j, impulse[0] * self.unit, impulse[1] * self.unit))
        if found and self.options.dparam[sn.SICONOS_DPARAM_RESIDU] > self.tolerance:
            self.unsolved += 1
        self.simulation.nextStep()
        self.steps += 1
        moved = self.landmarks() - self.listed
        if moved.size and np.max(np.sum(moved**2, axis=1)) > (0.4 * self.reach) ** 2:
            self.list_pairs()
        return sorted(found)

    def states(self):
        """Places, velocities and spins of the disks."""
        q = np.array([disk.q()[:2] for disk in self.disks]).reshape(-1, 2)
        v = np.array([disk.velocity() for disk in self.disks]).reshape(-1, 3)
        return q, v[:, :2], v[:, 2]
