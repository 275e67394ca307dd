"""The contacts of LAMMPS' last step, with the forces that it applied."""

import numpy as np


def turned(v):
    """z × v of every row."""
    return np.column_stack([-v[:, 1], v[:, 0]])


def pair_rows(lammps, law):
    """Of the pairs of this rank: ids from 1 on, and what the law asks for."""
    ids = lammps.local_compute("ids", 2).reshape(-1, 2)
    columns = len(law.asked().split())
    return np.column_stack([ids, lammps.local_compute("pairs", columns).reshape(-1, columns)])


def pair_geometry(rows, made, position):
    """Of two atoms: i < j, normal from j to i, overlap; 1 where the first of the row is i, else -1."""
    ids = rows[:, :2].astype(int) - 1
    sign = np.where(ids[:, 0] < ids[:, 1], 1.0, -1.0)
    i, j = ids.min(axis=1), ids.max(axis=1)
    apart = made.box.nearest(position[i] - position[j])
    distance = np.hypot(apart[:, 0], apart[:, 1]) if made.space == 2 else np.linalg.norm(apart, axis=1)
    overlap = made.radius[i] + made.radius[j] - distance
    return i, j, apart / distance[:, None], overlap, sign


def contacts_of_rows(rows, made, position):
    """Of two atoms: i < j, normal from j to i, overlap, forces on i, torque against rolling on i."""
    i, j, normal, overlap, sign = pair_geometry(rows, made, position)
    # LAMMPS' tangential force is that on the first of the two, and so is what it resists rolling with: R₁₂ times that
    # along the tangent as the first sees it.
    if made.space == 3:
        rolling = np.zeros((len(i), 3))
        if made.law.rolls:
            rolling = made.radii(i, j)[0][:, None] * np.cross(normal, rows[:, 6:9])
        return i, j, normal, overlap, rows[:, 2], sign[:, None] * rows[:, 3:6], rolling
    force, x, y = rows[:, 2:5].T
    tangent = turned(normal)
    rolling = np.zeros(len(i))
    if made.law.rolls:
        rolling = made.radii(i, j)[0] * (rows[:, 5:] * tangent).sum(axis=1)
    return i, j, normal, overlap, force, sign * (x * tangent[:, 0] + y * tangent[:, 1]), rolling


def read_plane_contacts(made, position, on_planes):
    """The same of disks with planes and cylinders, one after the other, the torque unknown. on_planes: force on each atom
    by each."""
    n = made.scene["disks"]
    for number, surface in enumerate(made.surfaces):
        # Across no periodic direction, so that any image of a disk is as far from it.
        normals, gap = surface.facing(position[:n])
        overlap = made.radius[:n] - gap
        i = np.flatnonzero(overlap > 0)
        force, normals = on_planes[number][i], normals[i]
        along = (force * normals).sum(axis=1)
        yield (
            i,
            np.full(len(i), made.atoms + number),
            normals,
            overlap[i],
            along,
            (force * turned(normals)).sum(axis=1) if made.space == 2 else force - along[:, None] * normals,
            np.full((len(i), 3)[: made.space - 1], np.nan),  # the fix does not report it
        )


def torques_at_planes(made, columns, torque):
    """Torques against rolling of the contacts in `columns`, those at planes from what is left of each disk's torque.
    None where a disk touches several planes: it does not say whose it is."""
    i, j, normal, overlap, _, tangential, rolling = columns
    unknown = np.isnan(rolling if made.space == 2 else rolling[:, 0])
    touched, counts = np.unique(i[unknown], return_counts=True)
    if (counts > 1).any():
        return None
    left = torque.copy()
    radius = np.concatenate([made.radius, np.zeros(made.planes)])
    known = np.where(unknown, 0.0, rolling.T).T
    at_plane = j >= made.atoms
    couple = tangential if made.space == 2 else np.cross(normal, tangential)  # n × f_t, in the plane about z

    def moment(of, part):
        return ((radius[of] - part * overlap) * couple.T).T

    np.add.at(left, i, moment(i, np.where(at_plane, made.plane_arm, 0.5)) - known)
    pair = ~at_plane
    np.add.at(left, j[pair], (moment(j, 0.5) + known)[pair])
    return np.where(unknown, left[i].T, rolling.T).T
