"""Kinds of bodies, each of which becomes a material of YADE, and what two kinds want of a contact.

YADE makes a pair's constants of the constants of two materials. Where a scene has materials of its
own, or a law in which lengths occur, those of the kinds have to be found whose combinations are the
scene's; what no combination gives is refused with the pair's name."""

import numpy as np
from crossgrain_worker import Unsupported

MOST_RADII = 400
ROUNDING = 1e-12


class Kinds:
    """wall[k]: no disk is of that kind; plane[k]: it is one of planes alone; radius[k]: of its
    spheres, NaN if they are of several and no matter. meets[a, b]: two such can touch."""

    def __init__(self, scene, arrays, bodies, by_radius, by_plane):
        self.law = scene["law"]
        pairs = scene.get("materials")
        self.names = pairs["names"] if pairs else [""]
        self.laws = pairs["laws"] if pairs else [self.law]
        self.several = pairs is not None
        self.index, self.keys = {}, []
        radius = arrays["disks.radius"].tolist() if by_radius else None
        count = scene["disks"]
        of_disk = arrays["disks.material"].tolist() if pairs else [0] * count
        of_body = pairs["of_body"] if pairs else [0] * len(bodies)
        own = radius if by_radius else [None] * count
        self.of_disk = [self.kind(m, a) for m, a in zip(of_disk, own)]
        disks = len(self.keys)
        self.of_wall = [
            [self.kind(m, a if by_radius else None) for a in body.disk_radius.tolist()]
            for m, body in zip(of_body, bodies)
        ]
        self.of_plane = [
            [self.kind(m, np.inf if by_plane else None) for _ in body.planes]
            for m, body in zip(of_body, bodies)
        ]
        if by_radius and len(self.keys) > MOST_RADII:
            raise Unsupported(f"has this law for at most {MOST_RADII} different radii")
        self.material = np.array([m for m, _ in self.keys], int)
        self.radius = np.array([np.nan if a is None else a for _, a in self.keys])
        self.plane = np.isinf(self.radius)
        self.wall = np.arange(len(self.keys)) >= disks
        self.meets = ~(self.wall[:, None] & self.wall[None, :])

    def kind(self, material, radius):
        key = material, radius
        if key not in self.index:
            self.index[key] = len(self.keys)
            self.keys.append(key)
        return self.index[key]

    def __len__(self):
        return len(self.keys)

    def name(self, k):
        radius = self.radius[k]
        what = "a plane" if self.plane[k] else f"{radius * 1e3:.4g} mm" if radius > 0 else ""
        return f"{self.names[self.material[k]]} {what}".strip()

    def table(self, constant):
        """A constant of the law of each two kinds."""
        values = np.array([law[constant] for law in self.laws], float)
        values = values.reshape(len(self.names), -1)
        return values[self.material[:, None], self.material[None, :]]

    def radii(self):
        """Of the first and the second of each two; of a plane that of the other."""
        a, b = np.broadcast_arrays(self.radius[:, None], self.radius[None, :])
        return np.where(np.isinf(a), b, a), np.where(np.isinf(b), a, b)

    def lengths(self):
        """L and what k_r's constant multiplies [m, m² or 1], as the law's conventions have them."""
        a, b = self.radii()
        flat = self.plane[:, None] | self.plane[None, :]
        with np.errstate(invalid="ignore"):  # of two planes
            return lengths(self.law, a, np.where(flat, np.inf, b))

    def in_series(self, wanted, what):
        """Constants v of the kinds with 1/v_a + 1/v_b = 1/wanted[a, b]."""
        constants = 2.0 * np.diag(wanted).copy()
        for w in np.flatnonzero(self.wall):
            first, own = wanted[0, w], constants[0]
            with np.errstate(divide="ignore"):
                constants[w] = own if 2.0 * first == own else 1.0 / (1.0 / first - 1.0 / own)
        a, b = constants[:, None], constants[None, :]
        with np.errstate(divide="ignore", invalid="ignore"):
            made = np.where((a == 0) | (b == 0), np.maximum(a, b), 1.0 / (1.0 / a + 1.0 / b))
        self.demand(made, wanted, what, "materials combine like springs in series")
        return constants

    def demand(self, made, wanted, what, rule):
        """@raise Unsupported where YADE's rule does not make of two kinds what is wanted of them"""
        with np.errstate(invalid="ignore"):
            wrong = ~(np.abs(made - wanted) <= ROUNDING * np.abs(wanted)) & self.meets
        if wrong.any():
            a, b = np.argwhere(wrong)[0]
            raise Unsupported(
                f"makes {what} {made[a, b]:.6g} of {self.name(a)} with {self.name(b)}, not "
                f"{wanted[a, b]:.6g}: its {rule}"
            )

    def one(self, wanted, what):
        """The value of all pairs that can meet. @raise Unsupported if they differ"""
        value = wanted[0, 0]
        self.demand(np.full_like(wanted, value), wanted, what, "functor has one for all pairs")
        return float(value)


def lengths(law, a, b):
    """L and what k_r's constant multiplies, of radii a and b; b is infinite at a plane."""
    flat = np.isinf(b)
    other = np.where(flat, a, b)
    effective = np.where(flat, a, a * other / (a + other))
    length = {
        "effective": effective,
        "twice_effective": 2.0 * effective,
        "smaller_radius": np.minimum(a, other),
        "mean_radius": 0.5 * (a + other),
    }[law["rolling_length"]]
    square = {"length_square": length**2, "radii": a * other, "constant": np.ones_like(length)}
    return length, square[law["rolling_stiffness"]]
