"""Prescribed motion of wall bodies: the closed forms of adapters/motion.hpp."""

import math

import numpy as np


def bodies_of(scene, arrays):
    """Of `load`: the scene's wall bodies."""
    return [
        Body(body, arrays[f"bodies.{b}.disk_position"], arrays[f"bodies.{b}.disk_radius"])
        for b, body in enumerate(scene["bodies"])
    ]


class Body:
    """A rigid body of wall disks and planes at any time. Lists of vectors are (n, 2) arrays; in space
    there are planes alone."""

    def __init__(self, description, disk_position, disk_radius):
        self.name = description["name"]
        self.centre = np.array(description["centre"])
        self.planes = description["planes"]
        self.motion = description["motion"]
        self.kind = self.motion["kind"]
        self.disk_radius = disk_radius
        self.disk_position = disk_position.reshape(-1, len(self.centre))
        self.offset = self.disk_position - self.centre
        self.distance = np.hypot(self.offset[:, 0], self.offset[:, 1])

    def state(self, t):
        """Centre, velocity of the centre, angle and angular velocity at time t."""
        motion, velocity = self.motion, np.zeros(len(self.centre))
        if self.kind == "rotating":
            spin = motion["angular_velocity"]
            return self.centre, velocity, spin * t, spin
        if self.kind == "translating":
            velocity = np.array(motion["velocity"])
            return self.centre + velocity * t, velocity, 0.0, 0.0
        if self.kind == "oscillating":
            w, amplitude = motion["frequency"], np.array(motion["amplitude"])
            centre = self.centre + amplitude * math.sin(w * t)
            return centre, amplitude * (w * math.cos(w * t)), 0.0, 0.0
        return self.centre, velocity, 0.0, 0.0

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
        cos, sin = math.cos(angle), math.sin(angle)
        turn = np.array([[cos, sin], [-sin, cos]])  # of vectors in rows
        point, normal = (
            np.array([plane[key] for plane in self.planes], float).reshape(-1, 2)
            for key in ("point", "normal")
        )
        return centre + (point - self.centre) @ turn, normal @ turn

    def velocity_at(self, t, place):
        """Velocity of the body's material at places, (n, 2), as planes have it."""
        centre, velocity, _, spin = self.state(t)
        arm = place - centre
        return velocity + spin * np.column_stack([-arm[:, 1], arm[:, 0]])
