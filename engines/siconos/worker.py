"""A worker of crossgrain that runs scenes on Siconos:  /usr/bin/python3 worker.py

README.md of this folder says what Siconos makes of a scene.
"""

import os
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "python"))
sys.dont_write_bytecode = True

import numpy as np
from crossgrain_answers import at, setting, stats
from crossgrain_walls import bodies_of
from crossgrain_worker import Unsupported, serve
from world import RigidLaw, World, version

EFFECTS = ("normal_damping", "friction", "rotation", "gravity", "moving_walls")


class Siconos:
    def capabilities(self):
        return {
            "version": version(),
            "effects": {name: "optional" for name in EFFECTS},
            "law_options": {"normal": ["rigid"], "lever_arm": ["radius"], "velocity_arm": ["lever_arm"]},
            "plane_motions": ["fixed", "translating", "oscillating"],
            "precisions": ["double"],
            "instant_contacts": True,
            "accumulated_contacts": True,
            "warm_handover": False,
            "sliding_flags": False,
            "tangential_restitution": False,
            "settings": [
                setting("dt", 5e-4, "s", "time step; 0: the case's"),
                setting("tolerance", 1e-6, "-", "of the friction-contact problem's residual", least=1e-16, most=1.0),
                setting("iterations", 200.0, "-", "most of its solver, in a step", least=1.0, most=1e6, whole=True, role="iterations"),
            ],
        }

    def load(self, scene, arrays, settings):
        bottom = scene.get("bottom")
        if bottom and bottom["mu"] > 0:
            raise Unsupported("has no bottom_friction")
        law = RigidLaw(scene["law"])
        number = {each["name"]: each["default"] for each in self.capabilities()["settings"]} | settings
        self.dt = number["dt"] or scene["dt"]
        self.disks, self.mass = scene["disks"], arrays["disks.mass"]
        self.friction = law.friction > 0
        self.rotation = self.friction and scene["rotation"]
        self.bodies = bodies_of(scene, arrays)
        self.owner = [b for b, body in enumerate(self.bodies) for _ in body.disk_radius]
        self.owner += [b for b, body in enumerate(self.bodies) for _ in body.planes]
        self.plane_numbers = [p for body in self.bodies for p in range(len(body.planes))]
        disks = {name: arrays[f"disks.{name}"] for name in ("radius", "mass", "inertia", "spin")}
        disks |= {name: arrays[f"disks.{name}"].reshape(-1, 2) for name in ("position", "velocity")}
        if not self.rotation:
            disks["inertia"] = None
        if not self.friction:
            disks["spin"] = np.zeros(self.disks)
        pairs = self.pair_table(law, disks)
        self.world = World(
            disks, self.bodies, scene["gravity"], self.dt,
            lambda i, j: law.restitution(self.inverse_mass(i) + self.inverse_mass(j)),
            law.friction, number["tolerance"], int(number["iterations"]),
        )  # fmt: skip
        self.evaluations, self.wall, self.cpu = 0, 0.0, 0.0
        self.sums, self.last = self.no_sums(), self.no_sums()
        called = {
            "normal_damping": law.damps,
            "friction": self.friction,
            "rotation": self.rotation,
            "gravity": any(scene["gravity"]),
            "moving_walls": any(body.kind != "fixed" for body in self.bodies),
        }
        return {
            "engine": "siconos",
            "version": version(),
            "dt": self.dt,
            "precision": "double",
            "integrator": "Moreau-Jean, theta = 1/2",
            "velocity_lag": 0.0,
            "effects": [name for name in EFFECTS if called[name]],
            "pairs": pairs,
            "deviations": self.deviations(law, pairs),
        }

    def inverse_mass(self, id_):
        return 1.0 / self.mass[id_] if id_ < self.disks else 0.0

    def pair_table(self, law, disks):
        kinds = sorted(set(zip(disks["mass"], disks["radius"])))[:4]
        rows = []

        def add(name, inverse):
            row = {"pair": name, "en": law.restitution(inverse)}
            rows.append(row | ({"mu": law.friction, "et0": 0.0} if law.friction > 0 else {}))

        for k, (mass, radius) in enumerate(kinds):
            for other, far in kinds[k:]:
                add(f"{1e3 * radius:.3g} mm with {1e3 * far:.3g} mm", 1 / mass + 1 / other)
            if self.bodies:
                add(f"{1e3 * radius:.3g} mm with wall", 1 / mass)
        return rows

    def deviations(self, law, pairs):
        found = []
        if law.soft and pairs:
            note = "rigid contacts with the soft law's e_n for each pair"
            found.append({"name": "normal", "value": pairs[0]["en"], "unit": "-", "note": note})
            if law.friction > 0:
                note = "contacts that stick give back nothing of the tangential speed"
                found.append({"name": "e_t0", "value": 0.0, "unit": "-", "note": note})
        note = "velocities alone are constrained, so that overlaps of the start stay; the largest"
        found.append({"name": "overlaps", "value": self.deepest(), "unit": "m", "note": note})
        return found

    def deepest(self):
        """Overlap [m]."""
        place, walls = self.world.states()[0], self.wall_places()
        between = [
            self.geometry(i, j, place[i], walls if j >= self.disks else place) for i, j in self.world.links
        ]
        return max((0.0, *(float(overlap) for _, overlap in between)))

    def no_sums(self):
        return {
            "pairs": {},  # (i, j) → impulse on i along n and along z × n [N s]
            "force": np.zeros((len(self.bodies), 2)),
            "torque": np.zeros(len(self.bodies)),
            "steps": 0,
        }

    def advance(self, t):
        wall, cpu = time.perf_counter(), time.process_time()
        while self.world.steps < round(t / self.dt):
            self.last = self.no_sums()
            self.add(self.world.step())
        self.wall += time.perf_counter() - wall
        self.cpu += time.process_time() - cpu
        return self.world.steps * self.dt

    def add(self, impulses):
        self.evaluations += len(impulses)
        walls = self.wall_places() if any(j >= self.disks for _, j, _, _ in impulses) else None
        for i, j, pressing, along in impulses:
            on_body = None
            if j >= self.disks:
                on_body = self.on_body(i, j, pressing, along, walls)
            for sums in (self.last, self.sums):
                before = sums["pairs"].get((i, j), (0.0, 0.0))
                sums["pairs"][i, j] = (before[0] + pressing, before[1] + along)
                if on_body:
                    body, force, torque = on_body
                    sums["force"][body] += force
                    sums["torque"][body] += torque
        for sums in (self.last, self.sums):
            sums["steps"] += 1

    def on_body(self, i, j, pressing, along, walls):
        body = self.owner[j - self.disks]
        place = np.array(self.world.disks[i].q()[:2])
        n, overlap = self.geometry(i, j, place, walls)
        force = -np.array([pressing * n[0] - along * n[1], pressing * n[1] + along * n[0]])
        if j >= len(self.world.radius):
            point = place - (self.world.radius[i] - overlap) * n
        else:
            point = walls[j - self.disks] + (self.world.radius[j] * n if self.rotation else 0.0)
        arm = point - self.bodies[body].state(self.world.steps * self.dt)[0]
        return body, force, arm[0] * force[1] - arm[1] * force[0]

    def wall_places(self):
        t = self.world.steps * self.dt
        return np.concatenate([np.zeros((0, 2)), *(body.disk_states(t)[0] for body in self.bodies)])

    def geometry(self, i, j, place, others):
        """n towards disk i, which is at a place, and the overlap. others: places by id, from wall disks on for a j
        that is a wall, else from disk 0 on."""
        radius = self.world.radius
        if j >= len(radius):
            body = self.bodies[self.owner[j - self.disks]]
            points, normals = body.plane_states(self.world.steps * self.dt)
            p = self.plane_numbers[j - len(radius)]
            return normals[p], radius[i] - (place - points[p]) @ normals[p]
        apart = place - (others[j - self.disks] if j >= self.disks else others[j])
        distance = float(np.hypot(*apart))
        return apart / distance, radius[i] + radius[j] - distance

    def snapshot(self, contacts):
        t = self.world.steps * self.dt
        position, velocity, spin = self.world.states()
        walls = self.wall_places()
        arrays = {
            "position": ("f64", position.ravel()),
            "velocity": ("f64", velocity.ravel()),
            "wall_position": ("f64", walls.ravel()),
        }
        if self.friction:
            arrays["spin"] = ("f64", spin)
        sums = self.sums if contacts == "accumulated" else self.last
        interval = sums["steps"] * self.dt
        bodies = [body.shown(t) for body in self.bodies]
        for b, shown in enumerate(bodies if interval > 0 else []):
            shown["force"] = (sums["force"][b] / interval).tolist()
            shown["torque"] = sums["torque"][b] / interval
        if interval > 0 and contacts != "none":
            arrays.update(self.contact_arrays(sums["pairs"], interval, position, walls))
            if contacts == "accumulated":
                self.sums = self.no_sums()
        return at(t, bodies, interval), arrays

    def contact_arrays(self, pairs, interval, position, walls):
        """Mean forces over the interval, with the geometry of now."""
        ids = sorted(pairs)
        between = [self.geometry(i, j, position[i], walls if j >= self.disks else position) for i, j in ids]
        return {
            "contacts.i": ("i32", [i for i, _ in ids]),
            "contacts.j": ("i32", [j for _, j in ids]),
            "contacts.normal": ("f64", np.array([n for n, _ in between]).ravel()),
            "contacts.overlap": ("f64", [overlap for _, overlap in between]),
            "contacts.normal_force": ("f64", [pairs[pair][0] / interval for pair in ids]),
            "contacts.tangential_force": ("f64", [pairs[pair][1] / interval for pair in ids]),
        }

    def stats(self):
        not_solved = float(self.world.unsolved)
        return stats(self.world.steps, self.evaluations, self.wall, self.cpu, not_solved=not_solved)


serve(Siconos())
