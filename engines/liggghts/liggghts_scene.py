"""Puts a scene into LIGGGHTS and reads its contacts, where that differs from LAMMPS (../lammps/build.py)."""

import ctypes

import build
import numpy as np
from contacts import pair_geometry, turned
from library import ARRAY, LOCAL, Lammps

SHARED = "libliggghts.so.3"
# Pairs nearer than so many sums of their radii are looked at, and those that do not touch lose their spring. With 1.0,
# LIGGGHTS' own, a contact that opens and closes again before the lists are made anew goes on from its old spring.
FORGETS = 1.01
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

    def count_of_compute(self, name):
        """LIGGGHTS does not report the rows of a local compute: half of all disks' partners."""
        self.library.lammps_extract_compute.restype = ctypes.c_void_p
        pointer = self.library.lammps_extract_compute(self.handle, b"partners", 1, 1)
        partners = ctypes.cast(pointer, ctypes.POINTER(ctypes.c_double))
        return round(sum(partners[: self.atoms()])) // 2


class Scene(build.Scene):
    def set_up(self, position, kind, skin):
        depth, reach = self.extent(position)
        kinds = 1 + len(self.bodies)
        self.run(
            f"""units si
            dimension 2
            atom_style granular
            atom_modify map array sort 0 0
            boundary f f p
            newton off
            communicate single vel yes
            region everywhere block {-reach!r} {reach!r} {-reach!r} {reach!r} {-depth!r} {depth!r} units box
            create_box {kinds} everywhere
            neighbor {skin!r} bin"""
        )
        for name, value in self.law.properties().items():
            values = " ".join([repr(value)] * kinds**2)
            self.lammps.command(
                f"fix {name} all property/global {name} peratomtypepair {kinds} {values}"
            )

    def set_law(self, skin, dt):
        self.run(
            f"""pair_style gran {self.law.words()}
            pair_coeff * *
            neigh_modify delay 0 every 1 check yes contact_distance_factor {FORGETS!r}
            timestep {dt!r}
            group disks type {build.DISKS}
            compute pairs all pair/gran/local {self.asked()}
            compute partners all contact/atom
            thermo_style custom step
            thermo 1000000"""
        )

    def asked(self):
        """Of each contact: 2 ids and a flag, 3 components of the force and, with friction, of the spring."""
        return "id force history" if self.law.friction else "id force"

    def stretch_springs(self):
        super().stretch_springs()
        self.first = self.lammps.gather("f", 3), self.lammps.gather("torque", 3)

    def put_first_forces(self):
        """A run is set up by evaluating the law once more, which shows sliding contacts with a dashpot (read_contacts
        says why). Those of the step that stretched the springs are the law's."""
        force, torque = self.first
        n = self.scene["disks"]
        force[:n, :2] += self.arrays["disks.mass"][:, None] * self.scene["gravity"]
        self.lammps.scatter("f", force)
        self.lammps.scatter("torque", torque)

    def motion_style(self):
        # Without rotation torques are summed up and spin nothing.
        return "nve/sphere" if self.rotation else "nve"


def pair_rows(lammps, law):
    return lammps.local_compute("pairs", 9 if law.friction else 6)


def contacts_of_rows(rows, made, position):
    """Of two atoms: i < j, normal from j to i, overlap, forces on i.

    LIGGGHTS evaluates its law anew when it is asked. A spring that was set to the bound is not over it then, so it
    would show the dashpot beside it, which did not act: there the force is the spring's alone."""
    law = made.law
    i, j, normal, overlap, sign = pair_geometry(rows, made, position)
    force = rows[:, 3:5]  # on the first of the two
    tangent = turned(normal)
    pressing = sign * (force * normal).sum(axis=1)
    tangential = sign * (force * tangent).sum(axis=1)
    if law.friction:
        of_spring = -law.kt * sign * (rows[:, 6:8] * tangent).sum(axis=1)
        tangential = np.where(law.sliding(pressing, of_spring), of_spring, tangential)
    return i, j, normal, overlap, pressing, tangential
