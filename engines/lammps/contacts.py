"""The contacts of LAMMPS' last step, with the forces that it applied."""

import numpy as np


def turned(v):
    """z × v of every row."""
    return np.column_stack([-v[:, 1], v[:, 0]])


def pair_rows(lammps):
    """Of the pairs of this rank: ids from 1 on, normal force, tangential force along x and y."""
    ids = lammps.local_compute("ids", 2).reshape(-1, 2)
    return np.column_stack([ids, lammps.local_compute("pairs", 3).reshape(-1, 3)])


def pair_geometry(rows, made, position):
    """Of two atoms: i < j, normal from j to i, overlap; 1 where the first of the row is i, else -1."""
    ids = rows[:, :2].astype(int) - 1
    sign = np.where(ids[:, 0] < ids[:, 1], 1.0, -1.0)
    i, j = ids.min(axis=1), ids.max(axis=1)
    apart = position[i] - position[j]
    distance = np.hypot(apart[:, 0], apart[:, 1])
    overlap = made.radius[i] + made.radius[j] - distance
    return i, j, apart / distance[:, None], overlap, sign


def contacts_of_rows(rows, made, position):
    """Of two atoms: i < j, normal from j to i, overlap, forces on i."""
    i, j, normal, overlap, sign = pair_geometry(rows, made, position)
    force, x, y = rows[:, 2:].T
    # LAMMPS' tangential force is that on the first of the two.
    tangent = turned(normal)
    return i, j, normal, overlap, force, sign * (x * tangent[:, 0] + y * tangent[:, 1])


def read_plane_contacts(made, bodies, position, on_planes):
    """The same of disks with planes, plane by plane. on_planes: force on each atom by each."""
    n = made.scene["disks"]
    for body in bodies:
        for number, plane in zip(body.plane_numbers, body.planes):
            normal = made.plane_normals[number]
            overlap = made.radius[:n] - (position[:n] - plane["point"]) @ normal
            i = np.flatnonzero(overlap > 0)
            force = on_planes[number][i]
            normals = np.tile(normal, (len(i), 1))
            tangent = turned(normals)
            yield (
                i,
                np.full(len(i), made.atoms + number),
                normals,
                overlap[i],
                force @ normal,
                (force * tangent).sum(axis=1),
            )
