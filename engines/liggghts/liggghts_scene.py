"""Puts a scene into LIGGGHTS and reads its contacts, where that differs from LAMMPS (../lammps/build.py)."""

import ctypes

import build
import numpy as np
from contacts import pair_geometry, turned
from crossgrain_worker import Unsupported
from library import ARRAY, ATOM, LOCAL, Lammps

SHARED = "libliggghts.so.3"
# Pairs nearer than so many sums of their radii are looked at, and those that do not touch lose their spring. With 1.0,
# LIGGGHTS' own, a contact that opens and closes again before the lists are made anew goes on from its old spring.
FORGETS = 1.01
MOST_RADII = 8  # of spheres in a cylinder that turns, each with a wall of its own
VERSION = "3.8.0"  # of Debian's package; the library does not say it


class Liggghts(Lammps):
    def __init__(self):
        super().__init__(SHARED, (b"-screen", b"none"))
        self.library.lammps_get_natoms.restype = ctypes.c_int

    def version(self):
        return VERSION

    def create_atoms(self, kind, position):
        for each, (x, y, z) in zip(kind.tolist(), position.tolist()):
            self.command(f"create_atoms {each} single {x!r} {y!r} {z!r} units box")

    def own_count(self):
        return self.atoms()  # one rank

    def set_fix_array(self, name, values):
        """The first columns of a fix's array."""
        pointer = self.library.lammps_extract_fix(self.handle, name.encode(), ATOM, ARRAY, 0, 0)
        rows = ctypes.cast(pointer, ctypes.POINTER(ctypes.POINTER(ctypes.c_double)))
        for atom, row in enumerate(values):
            for column, value in enumerate(row):
                rows[atom][column] = value

    def count_of_compute(self, name):
        """LIGGGHTS does not report the rows of a local compute: half of all disks' partners."""
        self.library.lammps_extract_compute.restype = ctypes.c_void_p
        pointer = self.library.lammps_extract_compute(self.handle, b"partners", 1, 1)
        partners = ctypes.cast(pointer, ctypes.POINTER(ctypes.c_double))
        return round(sum(partners[: self.atoms()])) // 2


class Scene(build.Scene):
    plane_arm, plane_point = 0.5, 0.5

    def __init__(self, *arguments):
        super().__init__(*arguments)
        self.fixes_of_walls = {}  # names, by the plane's or cylinder's number
        self.other_speed = 0.0  # by what share a turning cylinder is too fast or too slow for some sphere

    def dimension(self):
        """LIGGGHTS has J = m a²/2 in two dimensions and 2/5 m a² in three, where nothing leaves the plane either."""
        return 3 if self.space == 3 or self.rotation and build.shape_of(self.arrays) == "" else 2

    def set_up(self, position, kind, skin):
        kinds = len(self.materials_of_types)
        self.run(
            f"""units si
            dimension {self.dimension()}
            atom_style granular
            atom_modify map array sort 0 0
            boundary {self.boundary("f", "f" if self.dimension() == 3 else "p")}
            newton off
            communicate single vel yes
            region everywhere block {self.region(position, room=40.0)} units box
            create_box {kinds} everywhere
            neighbor {skin!r} {"bin" if self.bins < build.MOST_BINS else "nsq"}"""
        )
        of = self.materials_of_types
        laws = [self.laws.between(a, b) for a in of for b in of]
        if any(law.words() != self.law.words() for law in laws):
            raise Unsupported("has one model of rolling friction for all materials")
        for name in self.law.properties():
            values = " ".join(repr(law.properties()[name]) for law in laws)
            self.lammps.command(f"fix {name} all property/global {name} peratomtypepair {kinds} {values}")

    def set_law(self, skin, dt):
        self.run(
            f"""pair_style gran {self.law.words()}
            pair_coeff * *
            neigh_modify delay 0 every 1 check yes contact_distance_factor {FORGETS!r}
            timestep {dt!r}
            group disks type {self.disk_types}
            compute pairs all pair/gran/local {self.law.asked()}
            compute partners all contact/atom
            thermo_style custom step
            thermo 1000000"""
        )

    def raise_plane(self, number, plane, kind):
        axis = build.axis_of(plane.normal)
        self.raise_primitive(number, kind, f"{'xyz'[axis]}plane {float(plane.point[axis])!r}")

    def raise_primitive(self, number, kind, shape, group="disks", motion=""):
        fixes = self.fixes_of_walls.setdefault(number, [])
        fixes.append(f"plane{number}of{len(fixes)}")
        models, settings = self.law.model_words(), self.law.setting_words()
        wall = f"primitive type {kind} {shape} {motion} store_force yes"
        self.lammps.command(f"fix {fixes[-1]} {group} wall/gran {models} {wall} {settings}")

    def raise_cylinder(self, number, cylinder, body, kind):
        """The wall's velocity is taken at a sphere's centre, R − a + δ from the axis: for each radius, if these are few, it
        turns faster by R/(R − a), else by that of the mean, and other_speed is what is left for others."""
        axis = build.axis_of(cylinder.axis)
        first, second = (repr(float(cylinder.point[(axis + k) % 3])) for k in (1, 2))
        shape = f"{'xyz'[axis]}cylinder {cylinder.radius!r} {first} {second}"
        omega = float(body.state(0.0)[3][axis])
        if not omega:
            return self.raise_primitive(number, kind, shape)
        if axis == 1:  # there LIGGGHTS confuses x and z
            raise Unsupported("has cylinders that turn about x or z, not about y (README.md of engines/liggghts)")
        radii = self.radius[: self.scene["disks"]]
        groups = {"disks": radii.mean()}
        if len(np.unique(radii)) <= MOST_RADII:
            groups = {f"radius{k}": radius for k, radius in enumerate(np.unique(radii))}
            for name, radius in groups.items():
                self.group(name, np.flatnonzero(radii == radius))
        else:
            self.other_speed = float(np.abs((cylinder.radius - radii) / (cylinder.radius - radii.mean()) - 1.0).max())
        for name, radius in groups.items():
            speed = omega * cylinder.radius / float(cylinder.radius - radius)
            self.raise_primitive(number, kind, shape, name, f"shear {'yzx'[axis]} {speed!r}")

    def group(self, name, disks):
        """@param disks  their numbers, rising; those that follow each other are one word"""
        for part in np.split(disks + 1, np.flatnonzero(np.diff(disks) > 1) + 1):
            self.lammps.command(f"group {name} id {part[0]}:{part[-1]}")

    def forces_of_plane(self, number):
        return sum(self.lammps.fix_array(f"force_{name}", self.space) for name in self.fixes_of_walls[number])

    def stretch_springs(self):
        super().stretch_springs()
        self.first = self.lammps.gather("f", 3), self.lammps.gather("torque", 3)
        names = [f"force_{name}" for fixes in self.fixes_of_walls.values() for name in fixes]
        self.first_of_walls = {name: self.lammps.fix_array(name, self.space) for name in names}

    def put_first_forces(self):
        """A run is set up by evaluating the law once more, which shows sliding contacts with a dashpot (read_contacts
        says why). Those of the step that stretched the springs are the law's."""
        force, torque = self.first
        n = self.scene["disks"]
        force[:n, : self.space] += self.arrays["disks.mass"][:, None] * self.scene["gravity"]
        self.lammps.scatter("f", force)
        self.lammps.scatter("torque", torque)
        for name, forces in self.first_of_walls.items():
            self.lammps.set_fix_array(name, forces)

    def keep_in_plane(self):
        if self.dimension() == 2:
            super().keep_in_plane()

    def motion_style(self):
        # Without rotation torques are summed up and spin nothing.
        return "nve/sphere" if self.rotation else "nve"


def pair_rows(lammps, law):
    """What the law asks for, and the spin of the first less that of the second."""
    rows = lammps.local_compute("pairs", 6 + 3 * (law.rolling_model == "cdt") + law.history())
    rows = rows[rows[:, 0] > 0]  # before the first step there are empty ones of neighbours that do not touch
    spin = lammps.gather("omega", 3)[:, 0 if law.space else 2 :]
    first, second = rows[:, :2].astype(int).T - 1
    return np.column_stack([rows, spin[first] - spin[second]])


def rolling_torques(rows, made, i, j, normal, overlap, sign, pressing):
    """On i. Of constant torque it is what the force at a − δ/2 leaves of the torque; of a spring, which is kept as its
    torque on the second, that with the dashpot."""
    law = made.law
    if not law.rolls:
        return np.zeros((len(i), 3)[: made.space - 1])
    radius, reach = made.radii(i, j)
    if law.rolling_model == "cdt":
        first = rows[:, 0].astype(int) - 1
        arm = sign * (made.radius[first] - 0.5 * overlap)
        if made.space == 3:
            return sign[:, None] * rows[:, 6:9] + arm[:, None] * np.cross(normal, sign[:, None] * rows[:, 3:6])
        return sign * rows[:, 8] + arm * (rows[:, 3:5] * turned(normal)).sum(axis=1) * sign
    mass = np.full(made.atoms, build.IMMOVABLE)
    mass[: made.scene["disks"]] = made.arrays["disks.mass"]
    of_i, of_j = mass[i] * made.radius[i] ** 2, mass[j] * made.radius[j] ** 2
    inertia = (1.5 if made.dimension() == 2 else 1.4) * of_i * of_j / (of_i + of_j)
    if made.space == 3:
        spring, spin = -sign[:, None] * rows[:, -6:-3], sign[:, None] * rows[:, -3:]
        spin -= (spin * normal).sum(axis=1)[:, None] * normal
    else:
        spring, spin = -sign * rows[:, -2], sign * rows[:, -1]
    columns = spring, spin, pressing, overlap, radius, reach, inertia
    return made.laws.of_pairs("rolling_torque", i, j, *columns, of_each=spring.shape[1:])


def contacts_of_rows(rows, made, position):
    """Of two atoms: i < j, normal from j to i, overlap, forces on i, torque against rolling on i.

    LIGGGHTS evaluates its law anew when it is asked. A spring that was set to the bound is not over it then, so it
    would show the dashpot beside it, which did not act: there the force is the spring's alone."""
    law, space = made.law, made.space
    i, j, normal, overlap, sign = pair_geometry(rows, made, position)
    tangent = turned(normal) if space == 2 else None
    force = sign[:, None] * rows[:, 3 : 3 + space]
    pressing = (force * normal).sum(axis=1)
    tangential = (force * tangent).sum(axis=1) if space == 2 else force - pressing[:, None] * normal
    if law.friction:
        at = 6 + 3 * (law.rolling_model == "cdt")
        spring = sign[:, None] * rows[:, at : at + space]
        stretch = (spring * tangent).sum(axis=1) if space == 2 else np.linalg.norm(spring, axis=1)
        of_spring = made.laws.of_pairs("spring_force", i, j, stretch)
        sliding = made.laws.of_pairs("sliding", i, j, pressing, of_spring, overlap, *made.radii(i, j)) > 0
        if space == 3:
            sliding = sliding[:, None]
            of_spring = of_spring[:, None] * (spring / np.where(stretch > 0, stretch, 1.0)[:, None])
        tangential = np.where(sliding, of_spring, tangential)
    rolling = rolling_torques(rows, made, i, j, normal, overlap, sign, pressing)
    return i, j, normal, overlap, pressing, tangential, rolling
