"""Reads the contacts of YADE's last step, with the forces that it applied."""

import numpy as np
from yade import O


def xyz(vectors):
    """YADE's vectors, shape (n, 3)."""
    return np.array([c for v in vectors for c in (v[0], v[1], v[2])], float).reshape(-1, 3)


def xy(vectors):
    """x and y of YADE's vectors, shape (n, 2)."""
    return np.array([c for v in vectors for c in (v[0], v[1])], float).reshape(-1, 2)


def z(vectors):
    return np.array([v[2] for v in vectors], float)


def dot(a, b):
    products = a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1]
    return products if a.shape[1] == 2 else products + a[:, 2] * b[:, 2]


def vectors(of_yade, normal):
    """With as many components as the normals have."""
    return (xy if normal.shape[1] == 2 else xyz)(of_yade)


def in_normal_and_tangential(force, normal, tangent=None):
    """Its size along n, and that along the tangent or, in space, what is left of it."""
    along = dot(force, normal)
    return along, force - along[:, None] * normal if tangent is None else dot(force, tangent)


def turned(v):
    """z × v of every row."""
    return np.column_stack([-v[:, 1], v[:, 0]])


def read_contacts(law, radius, first_plane, per_plane, velocity, spin):
    """@param radius, velocity, spin  of all bodies by id, as the law saw them
    @param per_plane  bodies of YADE that are one plane
    @return the protocol's contact arrays"""
    interactions = [i for i in O.interactions if i.isReal]
    first = np.array([i.id1 for i in interactions], int)
    second = np.array([i.id2 for i in interactions], int)
    geoms = [i.geom for i in interactions]
    space = velocity.shape[1] == 3
    normal = (xyz if space else xy)([g.normal for g in geoms])  # from the first to the second
    overlap = np.array([g.penetrationDepth for g in geoms], float)

    # Arms reach to the contact point: the middle of the overlap, with a plane the plane.
    at_plane = 0.5 if law.plane_arm == "middle" else 1.0
    depth = np.where((first < first_plane) & (second < first_plane), 0.5, at_plane) * overlap
    physs = [i.phys for i in interactions]
    forward = first < second
    apart, arms = velocity[first] - velocity[second], (radius[first] - depth, radius[second] - depth)
    # Forces on the second; in the plane along a tangent, which is z × n of either.
    tangent = None if space else turned(normal)
    if space:
        spins = arms[0][:, None] * spin[first] + arms[1][:, None] * spin[second]
        slip = apart - dot(apart, normal)[:, None] * normal + np.cross(spins, normal)
    else:
        slip = dot(apart, tangent)
        slip += spin[first] * arms[0] + spin[second] * arms[1]
    pressing, tangential, sliding = law.forces(physs, normal, tangent, slip)
    if space:
        tangential *= np.where(forward, -1.0, 1.0)[:, None]

    last = np.maximum(first, second)
    planes = np.maximum(last - first_plane, 0)
    arrays = {
        "contacts.i": ("i32", np.minimum(first, second)),
        "contacts.j": ("i32", last - planes + planes // per_plane),
        "contacts.normal": ("f64", np.where(forward, -1.0, 1.0)[:, None] * normal),
        "contacts.overlap": ("f64", overlap),
        "contacts.normal_force": ("f64", pressing),
        "contacts.tangential_force": ("f64", tangential),
        "contacts.sliding": ("u8", sliding & law.friction),
    }
    if law.rolls:
        torque = law.torques(physs, pressing, spin[first] - spin[second])
        arrays["contacts.rolling_torque"] = ("f64", (np.where(forward, -1.0, 1.0) * torque.T).T)
    return arrays
