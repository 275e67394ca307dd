"""Prescribed motion of wall bodies: the closed forms of adapters/motion.hpp; and periodic boxes."""

import math

import numpy as np


def bodies_of(scene, arrays):
    """Of `load`: the scene's wall bodies."""
    return [
        Body(body, arrays[f"bodies.{b}.disk_position"], arrays[f"bodies.{b}.disk_radius"])
        for b, body in enumerate(scene["bodies"])
    ]


def moments(arm, force, torque=0.0):
    """Of forces, one a row, at those arms: about z in the plane, vectors in space."""
    if arm.shape[1] == 2:
        return torque + arm[:, 0] * force[:, 1] - arm[:, 1] * force[:, 0]
    return torque + np.cross(arm, force)


def swept(spin, arm):
    """Velocities ω × r, one a row. Spins about z, in the plane, are a number or a column of them."""
    if arm.shape[1] == 2:
        return spin * np.column_stack([-arm[:, 1], arm[:, 0]])
    return np.cross(spin, arm)


class Box:
    """The scene's: which directions are periodic, and how long it is along these."""

    def __init__(self, scene):
        box = scene.get("box")
        dimension = scene.get("dimension", 2)
        self.periodic = box["periodic"] if box else [False] * dimension
        self.low, self.high = (np.array(box[end] if box else [0.0] * dimension) for end in ("low", "high"))

    def nearest(self, difference):
        """Of the images of differences of two places, one a row, the shortest."""
        return self.shifted(difference, 0.0, np.round)

    def wrapped(self, place):
        """Of the images of places, one a row, that in the box; what is in it keeps its bits."""
        return self.shifted(place, self.low, np.floor)

    def shifted(self, rows, origin, images):
        along = np.flatnonzero(self.periodic)
        if not along.size:
            return rows
        length = (self.high - self.low)[along]
        moved = rows.copy()
        moved[:, along] -= length * images((rows - origin)[:, along] / length)
        return moved


def turned(angle, vectors):
    """Vectors, one a row, by an angle about its direction (Rodrigues' formula)."""
    size = np.linalg.norm(angle)
    if size == 0:
        return vectors
    axis = angle / size
    aside = np.cross(axis, vectors)
    return vectors + math.sin(size) * aside + (1.0 - math.cos(size)) * np.cross(axis, aside)


class Plane:
    """One that stays where it is."""

    def __init__(self, description):
        self.point, self.normal = (np.array(description[key], float) for key in ("point", "normal"))

    def facing(self, places):
        """Normals into the free side, one a row, and how far the places are from the surface."""
        return np.tile(self.normal, (len(places), 1)), (places - self.point) @ self.normal


class Cylinder:
    """Hollow, with spheres inside; its body stands still or turns about its axis."""

    def __init__(self, description):
        self.point, self.axis = (np.array(description[key], float) for key in ("point", "axis"))
        self.radius = description["radius"]

    def facing(self, places):
        """As Plane.facing: normals to the axis. On the axis itself there is none."""
        apart = places - self.point
        aside = apart - np.outer(apart @ self.axis, self.axis)
        distance = np.linalg.norm(aside, axis=1)
        return -aside / np.where(distance > 0, distance, 1.0)[:, None], self.radius - distance


class Body:
    """A rigid body of wall disks, planes and cylinders at any time. Lists of vectors are (n, 2) arrays, in space
    (n, 3), where angles and spins are vectors."""

    def __init__(self, description, disk_position, disk_radius):
        self.name = description["name"]
        self.centre = np.array(description["centre"])
        self.planes = description["planes"]
        self.cylinders = description.get("cylinders", [])
        self.motion = description["motion"]
        self.kind = self.motion["kind"]
        self.disk_radius = disk_radius
        self.disk_position = disk_position.reshape(-1, len(self.centre))
        self.offset = self.disk_position - self.centre
        self.distance = np.hypot.reduce(self.offset, axis=1)

    def state(self, t):
        """Centre, velocity of the centre, angle and angular velocity at time t."""
        motion, velocity = self.motion, np.zeros(len(self.centre))
        none = np.zeros(3) if len(self.centre) == 3 else 0.0
        if self.kind == "rotating":
            spin = motion["angular_velocity"] + none
            return self.centre, velocity, spin * t, spin
        if self.kind == "translating":
            velocity = np.array(motion["velocity"])
            return self.centre + velocity * t, velocity, none, none
        if self.kind == "oscillating":
            w, amplitude = motion["frequency"], np.array(motion["amplitude"])
            centre = self.centre + amplitude * math.sin(w * t)
            return centre, amplitude * (w * math.cos(w * t)), none, none
        return self.centre, velocity, none, none

    def shown(self, t):
        """Of `snapshot`, without force and torque."""
        names = ("centre", "velocity", "angle", "angular_velocity")
        return {name: np.asarray(value).tolist() for name, value in zip(names, self.state(t))}

    def radial(self, t):
        """How far members have moved from the centre, and their outward velocity, at time t."""
        if self.kind != "radial":
            return 0.0, 0.0
        speed, end = self.motion["radial_velocity"], self.motion["radial_end"]
        return speed * min(t, end), speed if t < end else 0.0

    def disk_states(self, t):
        """Positions and velocities of the wall disks at time t."""
        centre, velocity, angle, spin = self.state(t)
        shift, outward = self.radial(t)
        apart = np.where(self.distance > 0, self.distance, 1.0)  # a disk at the centre stays there
        scale = 1.0 + shift / apart
        if len(centre) == 3:
            arm = scale[:, None] * turned(angle, self.offset)
            return centre + arm, velocity + (outward / (scale * apart))[:, None] * arm + swept(spin, arm)
        cos, sin = math.cos(angle) * scale, math.sin(angle) * scale
        x = cos * self.offset[:, 0] - sin * self.offset[:, 1]
        y = sin * self.offset[:, 0] + cos * self.offset[:, 1]
        stretch = outward / (scale * apart)
        return (
            centre + np.column_stack([x, y]),
            velocity + np.column_stack([stretch * x - spin * y, stretch * y + spin * x]),
        )

    def plane_states(self, t):
        """Points and normals of the planes at time t. They turn and shift with the body; in radial
        motion they stay."""
        centre, _, angle, _ = self.state(t)
        point, normal = (
            np.array([plane[key] for plane in self.planes], float).reshape(-1, len(centre))
            for key in ("point", "normal")
        )
        if len(centre) == 3:
            return centre + turned(angle, point - self.centre), turned(angle, normal)
        cos, sin = math.cos(angle), math.sin(angle)
        turn = np.array([[cos, sin], [-sin, cos]])  # of vectors in rows
        return centre + (point - self.centre) @ turn, normal @ turn

    def velocity_at(self, t, place):
        """Velocity of the body's material at places, one a row, as planes and cylinders have it."""
        centre, velocity, _, spin = self.state(t)
        return velocity + swept(spin, place - centre)
