"""Puts a scene into LAMMPS. Atom ids are the scene's plus one: disks, then wall disks by body; a plane,
and a cylinder, is a fix of its own."""

import math

import jkr
import numpy as np
from crossgrain_answers import demand_plain_walls
from crossgrain_walls import Box, Cylinder, Plane
from crossgrain_worker import Unsupported

FEW = 50  # atoms: a box that small may have no room for bins
MOST_BINS = 2e7  # above, spheres are few in a large space, and lists are made of all pairs
IMMOVABLE = 1e30  # kg, of walls: nothing integrates them, and m₁₂ of a pair with one is the disk's mass to the last bit
SHAPES = {0.5: "disc", 0.4: ""}  # J/(m a²) → what `fix nve/sphere` calls it


def shape_of(arrays):
    """What kind of body LAMMPS takes the disks for; J is not a number there. Absent: none."""
    ratio = arrays["disks.inertia"] / (arrays["disks.mass"] * arrays["disks.radius"] ** 2)
    for share, word in SHAPES.items():
        if np.allclose(ratio, share, rtol=1e-12, atol=0):
            return word
    return None


def check(scene, bodies, arrays):
    """@raise Unsupported for what LAMMPS cannot do and its capabilities do not say"""
    demand_plain_walls(scene, bodies)
    if scene["rotation"] and shape_of(arrays) is None:
        raise Unsupported("has moments of inertia of disks (m a²/2) or spheres (2/5 m a²) only")
    if scene["rotation"] and scene.get("dimension", 2) == 3 and shape_of(arrays):
        raise Unsupported("has moments of inertia of spheres (2/5 m a²) only in space")
    periodic = Box(scene).periodic
    for body in bodies:
        if any(along and n for plane in body.planes for along, n in zip(periodic, plane["normal"])):
            raise Unsupported(f"has no planes across periodic directions, and {body.name} has one")
        for cylinder in body.cylinders:
            if sorted(map(abs, cylinder["axis"])) != [0, 0, 1]:
                axis = tuple(round(component, 6) for component in cylinder["axis"])
                raise Unsupported(f"has cylinders along axes only; that of {body.name} is along {axis}")


def with_z(vectors):
    """Rows of x and y, or of x, y and z, as the latter."""
    return np.column_stack([vectors, np.zeros(len(vectors))]) if vectors.shape[1] == 2 else vectors


def axis_of(vector):
    """0, 1 or 2: that which it is along."""
    return next(k for k, component in enumerate(vector) if component)


class Scene:
    """A scene as LAMMPS has it. Sets each body's disk_ids and plane_numbers, of its planes and then its cylinders.

    space  2, or 3 in space
    planes, surfaces  how many planes and cylinders, and what they are: all planes, then all cylinders
    plane_arm, plane_point  what of the overlap the arm of f_t at a plane is shorter than a, and how much nearer to the
                            centre than a the force on the plane is taken to act"""

    plane_arm, plane_point = 0.0, 1.0

    def __init__(self, lammps, scene, arrays, bodies, laws, rotation):
        self.lammps, self.scene, self.arrays = lammps, scene, arrays
        self.bodies, self.laws, self.law, self.rotation = bodies, laws, laws.one, rotation
        self.box, self.space = Box(scene), scene.get("dimension", 2)
        # Types: one of moving disks for each material from 1 on, then one for each wall body.
        self.materials_of_types = [*range(laws.count), *laws.of_body]
        self.first_body = 1 + laws.count
        self.disk_types = " ".join(map(str, range(1, self.first_body)))
        next_id = scene["disks"]
        for body in bodies:
            body.disk_ids = list(range(next_id, next_id + len(body.disk_radius)))
            next_id += len(body.disk_radius)
            body.plane_numbers = []
        self.atoms = next_id
        self.surfaces = []
        for kind, make in (("planes", Plane), ("cylinders", Cylinder)):
            for body in bodies:
                for description in getattr(body, kind):
                    body.plane_numbers.append(len(self.surfaces))
                    self.surfaces.append(make(description))
        self.planes = len(self.surfaces)
        self.radius = np.concatenate(
            [arrays["disks.radius"], *(body.disk_radius for body in bodies)]
        )
        self.turning_regions = {}  # of cylinders, by name: what follows the name

    def place(self, skin, dt):
        """@param skin  in radii of the smallest disk"""
        arrays, bodies, n = self.arrays, self.bodies, self.scene["disks"]
        position = np.concatenate(
            [arrays["disks.position"].reshape(-1, self.space), *(b.disk_position for b in bodies)]
        )
        starts = [body.disk_states(0.0)[1] for body in bodies]
        velocity = np.concatenate([arrays["disks.velocity"].reshape(-1, self.space), *starts])
        turning = [np.tile(b.state(0.0)[3], (len(b.disk_ids), 1)) for b in bodies]
        spin = np.concatenate([arrays["disks.spin"].reshape(n, -1), *turning])
        kind = np.concatenate(
            [1 + self.laws.of_disk, *(np.full(len(b.disk_ids), k) for k, b in enumerate(bodies, self.first_body))]
        )
        skin *= self.radius[:n].min()
        self.set_up(position, kind, skin)
        self.lammps.create_atoms(kind, with_z(self.box.wrapped(position)))
        self.lammps.scatter("radius", self.radius)
        mass = np.full(len(kind), IMMOVABLE)
        mass[:n] = arrays["disks.mass"]
        self.lammps.scatter("rmass", mass)
        self.lammps.scatter("v", with_z(velocity))
        omega = np.zeros((len(kind), 3))
        omega[:, -spin.shape[1] :] = spin
        self.lammps.scatter("omega", omega)
        self.set_law(skin, dt)
        for k, body in enumerate(bodies, self.first_body):
            self.leave_out_pairs(k)
            for number in body.plane_numbers:
                surface = self.surfaces[number]
                if isinstance(surface, Plane):
                    self.raise_plane(number, surface, k)
                else:
                    self.raise_cylinder(number, surface, body, k)
        self.stretch_springs()
        self.integrate()
        for k, body in enumerate(bodies, self.first_body):
            self.move(k, body)

    def region(self, position, room=4.0):
        """The ends of LAMMPS' box along x, y and z [m], around what is there, wherever that is: with empty room as far as
        the origin there are more bins than it can count. Sets how many bins that is at the start.
        @param room  beside what is there, in diameters of the largest disk"""
        depth = 2.0 * self.radius.max()
        low, high = (end(position, axis=0)[: self.space] for end in (np.min, np.max))
        centre, reach = 0.5 * (low + high), (high - low).max() + room * depth
        ends = [[float(x - reach), float(x + reach)] for x in centre] + [[-depth, depth]] * (3 - self.space)
        for k in np.flatnonzero(self.box.periodic):
            ends[k] = [float(self.box.low[k]), float(self.box.high[k])]
        self.bins = math.prod((high - low) / depth for low, high in ends)
        return " ".join(f"{low!r} {high!r}" for low, high in ends)

    def boundary(self, open_end, across="p"):
        """@param open_end  LAMMPS' word for a direction that is not periodic
        @param across  that for the one across the plane"""
        words = ["p" if along else open_end for along in self.box.periodic]
        return " ".join(words + [across] * (3 - self.space))

    def set_up(self, position, kind, skin):
        """An empty box for atoms of that many types."""
        everywhere = self.region(position)
        self.run(
            f"""units si
            dimension {self.space}
            atom_style sphere
            atom_modify map array{self.order_of_atoms()}
            boundary {self.boundary("s")}
            newton off
            comm_modify vel yes
            region everywhere block {everywhere}
            create_box {len(self.materials_of_types)} everywhere"""
        )

    def order_of_atoms(self):
        """Where a pair (i, j) becomes (j, i), LAMMPS reverses its springs: right of the tangential one, wrong of that of
        rolling, which is the same seen from either side. That happens as atoms are sorted or go over to another rank.
        Bonds (jkr.py) are known of the atoms of one rank, in the order of their ids. Atoms are sorted by bins, of which a
        huge box has more than LAMMPS can count.

        @raise Unsupported for several ranks"""
        if not (self.law.rolls or self.law.bonds):
            return "" if self.bins < MOST_BINS else " sort 0 0"
        if self.lammps.place()[1] > 1:
            what = "rolling_resistance" if self.law.rolls else 'cohesion = "jkr"'
            raise Unsupported(f"has {what} on one rank alone (README.md of engines/lammps)")
        return " sort 0 0"

    def list_lines(self, skin):
        """Of neighbours. They are those nearer than the skin, so that a bond which is longer is lost as lists are made anew."""
        if self.law.bonds:
            skin = max(skin, 1.01 * jkr.largest_range(self))
        return f"""neighbor {skin!r} {self.list_style()}
            neigh_modify delay 0 every 1 check yes"""

    def list_style(self):
        return "bin" if self.atoms > FEW and self.bins < MOST_BINS else "nsq"

    def law_lines(self):
        if self.laws.count == 1:
            return f"pair_coeff * * {self.law.words()}"
        kinds = list(enumerate(self.materials_of_types, 1))
        return "\n".join(
            f"pair_coeff {a} {b} {self.laws.between(of_a, of_b).words()}" for a, of_a in kinds for b, of_b in kinds if a <= b
        )

    def set_law(self, skin, dt):
        """The law, the lists and what is asked for of contacts."""
        self.run(
            f"""pair_style granular
            {self.law_lines()}
            {self.list_lines(skin)}
            timestep {dt!r}
            group disks type {self.disk_types}
            compute pairs all pair/local {self.law.asked()} cutoff radius
            compute ids all property/local patom1 patom2 cutoff radius
            thermo_style custom step
            thermo 0"""
        )

    def run(self, lines):
        for line in lines.splitlines():
            self.lammps.command(line.strip())

    def stretch_springs(self):
        """LAMMPS stretches no spring in the forces that it starts from; spring_update = "before" means
        that they are stretched by then. In a step that nothing integrates they are, and nothing else
        happens."""
        self.lammps.command("run 1 post no")
        for name, words in self.turning_regions.items():
            self.lammps.command(f"region {name} delete")
            self.lammps.command(f"region {name} {words}")
        if not self.turning_regions:
            self.lammps.command("reset_timestep 0")

    def put_first_forces(self):
        """Where those that a run is set up with are not the law's."""

    def integrate(self):
        gravity = math.hypot(*self.scene["gravity"])
        if gravity > 0:
            x, y, z = *(g / gravity for g in self.scene["gravity"]), *[0] * (3 - self.space)
            self.lammps.command(f"fix gravity disks gravity {gravity!r} vector {x!r} {y!r} {z!r}")
        self.lammps.command(f"fix motion disks {self.motion_style()}")
        self.keep_in_plane()

    def keep_in_plane(self):
        if self.space == 2:
            self.lammps.command("fix plane all enforce2d")

    def motion_style(self):
        # Without rotation torques are summed up and spin nothing.
        return f"nve/sphere {shape_of(self.arrays)}" if self.rotation else "nve"

    def leave_out_pairs(self, kind):
        """Of wall disks with each other."""
        for other in range(self.first_body, kind + 1):
            self.lammps.command(f"neigh_modify exclude type {other} {kind}")

    def move(self, kind, body):
        """A body at rest is not integrated."""
        if not body.disk_ids or body.kind == "fixed":
            return
        group = f"wall{kind}"
        self.lammps.command(f"group {group} type {kind}")
        motion = body.motion
        if body.kind == "rotating":
            speed = np.linalg.norm(motion["angular_velocity"])
            if speed == 0:
                return
            x, y, z = [*body.centre.tolist(), 0][:3]
            spin = motion["angular_velocity"] if self.space == 3 else [0, 0, motion["angular_velocity"]]
            axis = " ".join(repr(float(component / speed)) for component in spin)
            words = f"rotate {x!r} {y!r} {z!r} {axis} {2.0 * math.pi / speed!r}"
        elif body.kind == "translating":
            words = "linear {!r} {!r} {!r}".format(*motion["velocity"], 0)
        else:
            if not motion["frequency"]:
                return
            x, y, z = [*motion["amplitude"], 0][:3]
            words = f"wiggle {x!r} {y!r} {z!r} {2.0 * math.pi / motion['frequency']!r}"
        self.lammps.command(f"fix move{kind} {group} move {words}")

    def raise_plane(self, number, plane, kind):
        """@param kind  type of its body"""
        axis = axis_of(plane.normal)
        place = repr(float(plane.point[axis]))
        ends = f"{place} NULL" if plane.normal[axis] > 0 else f"NULL {place}"
        self.raise_wall(number, kind, "wall/gran", f"{'xyz'[axis]}plane {ends}")

    def raise_cylinder(self, number, cylinder, body, kind):
        """A region, which turns by a variable. Its velocity is what it turned since the step before, so that at step 0 it
        has none: stretch_springs() ends with a region that is new at step 1."""
        if self.law.normal != "linear":
            raise Unsupported('has cylinders with normal = "linear" alone: its Hertz\' law has their curvature in it')
        axis = axis_of(cylinder.axis)
        across = [k for k in range(3) if k != axis]
        x, y = (repr(float(cylinder.point[k])) for k in across)
        words = f"cylinder {'xyz'[axis]} {x} {y} {cylinder.radius!r} INF INF side in units box"
        omega = float(body.state(0.0)[3][axis])
        if omega:
            self.lammps.command(f"variable turn{number} equal {omega!r}*step*dt")
            centre = " ".join(repr(float(component)) for component in cylinder.point)
            direction = " ".join("1" if k == axis else "0" for k in range(3))
            words += f" rotate v_turn{number} {centre} {direction}"
            self.turning_regions[f"cylinder{number}"] = words
        self.lammps.command(f"region cylinder{number} {words}")
        self.raise_wall(number, kind, "wall/gran/region", f"region cylinder{number}")

    def raise_wall(self, number, kind, style, words):
        """A fix for each material of disks."""
        for name, group, of_disks in self.plane_fixes(number):
            if group != "disks":
                self.lammps.command(f"group {group} type {1 + of_disks}")
            law = self.laws.between(of_disks, self.materials_of_types[kind - 1]).words(plane=True)
            self.lammps.command(f"fix {name} {group} {style} granular {law} {words} contacts")

    def plane_fixes(self, number):
        """Of one plane: the fix' name, its group, the material of that."""
        if self.laws.count == 1:
            return [(f"plane{number}", "disks", 0)]
        return [(f"plane{number}of{of}", f"disks{of}", of) for of in range(self.laws.count)]

    def forces_of_plane(self, number):
        """On this rank's atoms, (n, 2) or (n, 3)."""
        columns = 1 + self.space
        return sum(self.lammps.fix_array(name, columns)[:, 1:] for name, _, _ in self.plane_fixes(number))

    def radii(self, i, j):
        """R₁₂ and a_i + a_j of pairs; at a plane both a_i."""
        curvature = np.concatenate([1.0 / self.radius, np.zeros(self.planes)])
        radius = np.concatenate([self.radius, np.zeros(self.planes)])
        return 1.0 / (curvature[i] + curvature[j]), radius[i] + radius[j]
