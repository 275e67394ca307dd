"""Two disks that meet obliquely, without dashpots: how much energy a spring that is turned to first order makes, against one that keeps its
length. YADE turns the spring's force f by f − f × (n × n'), which is longer by √(1 + sin²θ) where the normal turns by θ in a step.

crossgrain compare two-disks.toml --engines grain-as-yade,yade --out out     # kinetic_energy of series.csv, at the end
"""

import math

import numpy as np

A, DENSITY, KN, KT, GAP, TIME = 0.0037, 6.394, 352.1, 267.1, 0.00745, 0.006
M = DENSITY * math.pi * A * A
J = 0.5 * M * A * A


def energy_after(speed, steps_per_contact, lengthens):
    dt = math.pi / math.sqrt(KN / (M / 2)) / steps_per_contact
    x, v, spin = [np.zeros(2), np.array([GAP, 0.0])], [np.zeros(2), np.array([-speed, speed])], [0.0, 0.0]
    spring, before = None, None
    for step in range(round(TIME / dt)):
        apart = x[0] - x[1]
        distance = np.linalg.norm(apart)
        normal, overlap = apart / distance, 2 * A - distance
        force, torque = np.zeros(2), 0.0
        if overlap > 0:
            arm, tangent = A - overlap / 2, np.array([-normal[1], normal[0]])
            if spring is None:
                spring = 0.0
            elif lengthens:
                spring *= math.sqrt(1 + (before[0] * normal[1] - before[1] * normal[0]) ** 2)
            spring -= KT * dt * ((v[0] - v[1]) @ tangent - arm * (spin[0] + spin[1]))
            force, torque, before = KN * overlap * normal + spring * tangent, -arm * spring, normal
        else:
            spring = None
        part = 0.5 if step == 0 else 1.0  # velocities are half a step behind
        v = [v[0] + part * dt * force / M, v[1] - part * dt * force / M]
        spin = [w + part * dt * torque / J for w in spin]
        x = [x[0] + dt * v[0], x[1] + dt * v[1]]
    return sum(0.5 * M * u @ u + 0.5 * J * w * w for u, w in zip(v, spin))


for speed, steps in ((0.3, 50), (0.15, 50), (0.075, 50), (0.3, 100), (0.3, 200)):
    keeps, longer = (energy_after(speed, steps, lengthens) for lengthens in (False, True))
    print(f"{speed} m/s, t_c/{steps}: {keeps:.16e} J, turned to first order {(longer - keeps) / keeps:+.2e}")
