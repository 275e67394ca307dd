"""Contacts under JKR (Johnson, Kendall and Roberts 1971): where they end, and what LAMMPS does not report of them.

`compute pair/local` takes a pair for open as long as it overlaps by less than the range of its bond, and says of none
whether it touched before. So the worker follows bonds itself, step by step, and asks for springs while all radii are
larger and nothing moves; the forces are worked out here."""

import math

import numpy as np

RANGE = 1.0 / 3.0  # of a bond, in units of a_p²/R₁₂: LAMMPS' ends at the largest pull
ENLARGED = 10.0  # ranges by which radii are larger while LAMMPS is asked: no spring is beyond its bound then


def depth(kn, w, radius):
    """a_p²/R₁₂, the unit of δ: a_p³ = 9π w R₁₂²/(8 E*), E* = 3/4 k_n [m]"""
    return np.cbrt(1.5 * math.pi * w * radius**2 / kn) ** 2 / radius


def contact(kn, w, radius, overlap):
    """Force and radius of a contact: with y = √(a/a_p), F = F_po (y⁶ − 2 y³) and δ = a_p²/R₁₂ (y⁴ − 4/3 y)."""
    unit = depth(kn, w, radius)
    target = overlap / unit
    y = 1.2 + np.sqrt(np.sqrt(np.maximum(target, 0.0)))  # above the root; the left side is convex there
    for _ in range(60):
        y = y - (y**4 - 4.0 / 3.0 * y - target) / (4.0 * y**3 - 4.0 / 3.0)
    return 1.5 * math.pi * w * radius * (y**6 - 2.0 * y**3), np.sqrt(unit * radius) * y**2


class Bonds:
    """Which pairs of atoms, i < j, are in contact: from when they touch until the range of their bond."""

    def __init__(self, made, position):
        self.made = made
        self.slack = 0.5 * made.radius.min()  # what atoms may move before pairs are looked for anew
        self.i = self.j = np.empty(0, int)
        self.held = np.empty(0, bool)
        self.look_for_pairs(position)

    def look_for_pairs(self, position):
        """All that are near; those that hold stay held."""
        made = self.made
        before = self.keys()[self.held]
        reach = 2.0 * self.slack + largest_range(made)
        near = []
        for i in range(made.scene["disks"]):
            gaps = self.distances(position, i, slice(i + 1, None)) - made.radius[i] - made.radius[i + 1 :]
            near.append(i + 1 + np.flatnonzero(gaps < reach))
        self.i = np.repeat(np.arange(len(near)), list(map(len, near)))
        self.j = np.concatenate(near)
        self.held = np.isin(self.keys(), before)
        radius, self.reach = made.radii(self.i, self.j)
        self.range = made.laws.of_pairs("bond_range", self.i, self.j, radius)
        self.seen = position.copy()

    def keys(self):
        return self.i * self.made.atoms + self.j

    @staticmethod
    def distances(position, i, j):
        apart = position[i] - position[j]
        return np.hypot(apart[:, 0], apart[:, 1])

    def follow(self, position):
        """To be called with the positions of every step."""
        moved = position - self.seen
        if (moved * moved).sum(axis=1).max() > self.slack**2:
            self.look_for_pairs(position)
        limit = self.reach + np.where(self.held, self.range, 0.0)
        self.held = self.distances(position, self.i, self.j) < limit

    def count(self):
        return int(self.held.sum())


def largest_range(made):
    """No bond of the scene is longer [m]."""
    return max(law.bond_range(made.radius.max()) for law in made.laws.all)


def pair_rows(lammps, law, bonds):
    """Of each bond: 2 ids from 0 on; along x and y the force of the tangential spring, and of the rolling one, on the
    first with the radii enlarged; v of the first less that of the second, along x and y; the spins of both."""
    made = bonds.made
    i, j = bonds.i[bonds.held], bonds.j[bonds.held]
    velocity, spin = lammps.own("v"), lammps.own("omega")
    kept = velocity.copy(), spin.copy()
    of_springs = np.zeros((len(i), 4))
    if law.turns and len(i):
        velocity[:], spin[:] = 0.0, 0.0
        lammps.scatter("radius", enlarged(bonds))
        ids = lammps.local_compute("ids", 2).astype(int) - 1
        columns = len(law.asked().split())
        found = lammps.local_compute("pairs", columns)[:, 1:]
        lammps.scatter("radius", made.radius)
        velocity[:], spin[:] = kept
        turned_round = ids[:, 0] > ids[:, 1]
        found[turned_round, :2] *= -1.0  # the tangential force is on the first; what resists rolling is the same
        key, wanted = ids.min(axis=1) * made.atoms + ids.max(axis=1), i * made.atoms + j
        order = np.argsort(key)
        rows = order[np.minimum(np.searchsorted(key, wanted, sorter=order), len(order) - 1)]
        if (key[rows] != wanted).any():
            raise RuntimeError("a bond is followed that LAMMPS does not list")
        of_springs[:, : columns - 1] = found[rows]
    v, w = kept
    return np.column_stack([i, j, of_springs, v[i, :2] - v[j, :2], w[i, 2], w[j, 2]])


def enlarged(bonds):
    return bonds.made.radius + ENLARGED * largest_range(bonds.made)


def contacts_of_rows(rows, made, position, bonds):
    """i < j, normal from j to i, overlap, forces on i, torque against rolling on i."""
    law, laws = made.law, made.laws
    i, j = rows[:, :2].astype(int).T
    apart = position[i] - position[j]
    distance = np.hypot(apart[:, 0], apart[:, 1])
    normal = apart / distance[:, None]
    tangent = np.column_stack([-normal[:, 1], normal[:, 0]])
    radius, reach = made.radii(i, j)
    overlap = reach - distance
    approach = (rows[:, 6:8] * normal).sum(axis=1)
    spin_i, spin_j = rows[:, 8:].T
    slip = (rows[:, 6:8] * tangent).sum(axis=1) - made.radius[i] * spin_i - made.radius[j] * spin_j
    pressing = laws.of_pairs("bond_force", i, j, overlap, approach, radius)
    large = enlarged(bonds)
    large_radius = large[i] * large[j] / (large[i] + large[j])
    of_spring = (rows[:, 2:4] * tangent).sum(axis=1)
    columns = of_spring, slip, overlap, radius, large[i] + large[j] - distance, large_radius
    tangential = laws.of_pairs("bond_friction", i, j, *columns)
    rolling = np.zeros(len(i))
    if law.rolls:
        of_rolling = (rows[:, 4:6] * tangent).sum(axis=1) * radius
        rolling = laws.of_pairs("bond_rolling", i, j, of_rolling, spin_i - spin_j, overlap, radius)
    return i, j, normal, overlap, pressing, tangential, rolling
