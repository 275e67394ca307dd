"""Soft disks on numpy, as small as an engine can be: a worker to begin your own with.

    crossgrain compare cases/couette/quick.toml --engines grain,examples/python/engine.toml --out out

Linear springs and dashpots, Coulomb friction with a tangential spring; semi-implicit Euler steps. Every
formula is that of adapters/worker/README.md, every array the whole scene's: disks first, then wall disks.
"""

import time

import numpy as np
from crossgrain_walls import Body
from crossgrain_worker import Unsupported, serve

CAN = "normal_damping friction tangential_spring tangential_damping rotation gravity moving_walls"


class Engine:
    def capabilities(self):
        return {
            "version": "1",
            "effects": {name: "optional" for name in CAN.split()},  # what is missing is "never"
            "law_options": {
                "normal": ["linear"],
                "damper": ["constant"],
                "tangential": ["none", "spring", "spring_dashpot"],
                "tension": ["allow"],
                "coulomb_bound": ["compression"],
                "dashpot": ["inside"],
                "spring_reset": ["total"],
                "spring_update": ["after"],
                "lever_arm": ["radius"],
                "velocity_arm": ["lever_arm"],
                "history": ["displacement"],
                "damping_velocity": ["lagged"],
                "integrator": ["semi_implicit_euler"],
            },
            "precisions": ["double"],
            "instant_contacts": True,
            "accumulated_contacts": False,
            "warm_handover": False,
            "sliding_flags": True,
            "settings": [],
        }

    def load(self, scene, arrays, settings):
        self.law, self.dt, self.n = scene["law"], scene["dt"], scene["disks"]
        self.gravity = np.array(scene["gravity"])
        self.mass, self.inertia = arrays["disks.mass"], arrays["disks.inertia"]
        self.bodies = [
            Body(body, arrays[f"bodies.{b}.disk_position"], arrays[f"bodies.{b}.disk_radius"])
            for b, body in enumerate(scene["bodies"])
        ]
        if self.law["normal"] != "linear":
            raise Unsupported("has only normal = linear")
        if "bottom" in scene:
            raise Unsupported("has no bottom_friction")
        self.gt = self.law["gt"] if self.law["tangential"] == "spring_dashpot" else 0.0
        self.friction = self.law["tangential"] != "none" and self.law["mu"] > 0.0
        if self.friction and not self.law["kt"] > 0.0:
            raise Unsupported("has friction by springs alone: kt must be > 0")
        self.turns = self.friction and scene["rotation"]
        self.radius = np.concatenate([arrays["disks.radius"], *(b.disk_radius for b in self.bodies)])
        walls = len(self.radius) - self.n
        self.position = np.concatenate([arrays["disks.position"].reshape(-1, 2), np.zeros((walls, 2))])
        self.velocity = np.concatenate([arrays["disks.velocity"].reshape(-1, 2), np.zeros((walls, 2))])
        self.spin = np.concatenate([arrays["disks.spin"] * self.turns, np.zeros(walls)])
        self.steps = self.touching = 0
        self.wall_seconds = self.cpu_seconds = 0.0
        self.move_walls()
        self.pairs = np.empty((2, 0), int)
        self.spring = np.empty(0)  # of each pair
        self.plane_spring = np.zeros((sum(len(body.planes) for body in self.bodies), self.n))
        self.find_pairs()
        self.add_forces()
        effects = {
            "normal_damping": self.law["gn"] > 0.0,
            "friction": self.friction,
            "tangential_spring": self.friction,
            "tangential_damping": self.friction and self.gt > 0.0,
            "rotation": self.turns,
            "gravity": bool(self.gravity.any()),
            "moving_walls": any(body.kind != "fixed" for body in self.bodies),
        }
        return {
            "engine": "numpy",
            "version": "1",
            "dt": self.dt,
            "precision": "double",
            "integrator": "semi_implicit_euler",
            "velocity_lag": self.dt / 2,
            "effects": [name for name, on in effects.items() if on],
            "pairs": [],
            "deviations": [],
        }

    def advance(self, t):
        wall, cpu = time.perf_counter(), time.process_time()
        while self.steps < round(t / self.dt):
            self.step()
        self.wall_seconds += time.perf_counter() - wall
        self.cpu_seconds += time.process_time() - cpu
        return self.steps * self.dt

    def step(self):
        n = self.n
        self.velocity[:n] += self.dt * (self.force[:n] / self.mass[:, None] + self.gravity)
        if self.turns:
            self.spin[:n] += self.dt * self.torque[:n] / self.inertia
        self.position[:n] += self.dt * self.velocity[:n]
        self.steps += 1
        self.move_walls()
        if np.abs(self.position - self.chosen).max() > self.skin / 3:  # in one coordinate: < skin/2
            self.find_pairs()
        self.add_forces()

    def move_walls(self):
        first = self.n
        for body in self.bodies:
            ids = slice(first, first + len(body.disk_radius))
            self.position[ids], self.velocity[ids] = body.disk_states(self.steps * self.dt)
            self.spin[ids] = body.state(self.steps * self.dt)[3] * self.turns
            first = ids.stop

    def find_pairs(self):
        """All pairs i < j, i a disk that moves, that may touch before one has moved by half the skin."""
        self.skin, self.chosen = 0.2 * self.radius[: self.n].min(), self.position.copy()
        apart = self.position[: self.n, None] - self.position
        reach = self.radius[: self.n, None] + self.radius + self.skin
        near = np.array(np.nonzero(np.triu(np.einsum("ijk,ijk->ij", apart, apart) < reach**2, 1)))
        spring = np.zeros(near.shape[1])
        key = lambda pairs: pairs[0] * len(self.radius) + pairs[1]
        _, new, old = np.intersect1d(key(near), key(self.pairs), return_indices=True)
        spring[new] = self.spring[old]
        self.pairs, self.spring = near, spring

    def add_forces(self):
        self.force, self.torque = np.zeros_like(self.position), np.zeros(len(self.radius))
        i, j = self.pairs
        apart = self.position[i] - self.position[j]
        distance = np.hypot(*apart.T)
        arm = self.radius[i] * self.spin[i] + self.radius[j] * self.spin[j]
        self.spring, contacts = self.contacts(
            i, j, apart / distance[:, None], self.radius[i] + self.radius[j] - distance,
            self.velocity[i] - self.velocity[j], arm, self.spring)  # fmt: skip
        self.found, plane = [contacts], 0
        self.loads = [(np.zeros(2), 0.0) for _ in self.bodies]  # of planes: force, torque
        everyone = np.arange(self.n)
        for b, body in enumerate(self.bodies):
            centre, velocity, _, _ = body.state(self.steps * self.dt)
            for k, point in enumerate(body.plane_points(self.steps * self.dt)):
                normal = np.array(body.planes[k]["normal"])
                height = (self.position[: self.n] - point) @ normal
                self.plane_spring[plane], contacts = self.contacts(
                    everyone, np.full(self.n, len(self.radius) + plane), np.tile(normal, (self.n, 1)),
                    self.radius[: self.n] - height, self.velocity[: self.n] - velocity,
                    self.radius[: self.n] * self.spin[: self.n], self.plane_spring[plane])  # fmt: skip
                ids, _, _, _, fn, ft, _ = contacts
                on_plane = -(fn[:, None] * normal + ft[:, None] * [-normal[1], normal[0]])
                lever = self.position[ids] - height[ids, None] * normal - centre
                force, torque = self.loads[b]
                torque += np.cross(lever, on_plane).sum()
                self.loads[b] = (force + on_plane.sum(axis=0), torque)
                self.found.append(contacts)
                plane += 1
        self.touching += sum(len(contacts[0]) for contacts in self.found)

    def contacts(self, i, j, normal, overlap, relative, arm, spring):
        """The law for all pairs; adds the forces of those that touch. Returns the springs, and i, j,
        normal, overlap, normal and tangential force, sliding of what touches."""
        law, touches = self.law, overlap > 0.0
        slip = relative[:, 1] * normal[:, 0] - relative[:, 0] * normal[:, 1] - arm
        fn = law["kn"] * overlap - law["gn"] * (relative * normal).sum(axis=1)
        ft, sliding = np.zeros_like(fn), np.zeros(len(fn), bool)
        if self.friction:
            bound, trial = law["mu"] * np.maximum(fn, 0.0), -law["kt"] * spring - self.gt * slip
            sliding = np.abs(trial) > bound
            ft = np.where(sliding, np.copysign(bound, trial), trial)
            spring = touches * np.where(sliding, -ft / law["kt"], spring + slip * self.dt)
        i, j, normal, fn, ft = i[touches], j[touches], normal[touches], fn[touches], ft[touches]
        force = fn[:, None] * normal + ft[:, None] * np.column_stack([-normal[:, 1], normal[:, 0]])
        for ids, sign in ((i, 1.0), (j, -1.0)):
            real = ids < len(self.radius)  # a plane has no place in the arrays
            np.add.at(self.force, ids[real], sign * force[real])
            np.add.at(self.torque, ids[real], -self.radius[ids[real]] * ft[real])
        return spring, (i, j, normal, overlap[touches], fn, ft, sliding[touches])

    def snapshot(self, contacts):
        now, n = self.steps * self.dt, self.n
        arrays = {
            "position": ("f64", self.position[:n].ravel()),
            "velocity": ("f64", self.velocity[:n].ravel()),
            "wall_position": ("f64", self.position[n:].ravel()),
        }
        if self.friction:
            arrays["spin"] = ("f64", self.spin[:n])
        if contacts == "instant":
            names = "i j normal overlap normal_force tangential_force sliding".split()
            for name, kind, values in zip(names, ["i32"] * 2 + ["f64"] * 4 + ["u8"], zip(*self.found)):
                arrays[f"contacts.{name}"] = (kind, np.concatenate(values).ravel())
        bodies, first = [], n
        for body, (force, torque) in zip(self.bodies, self.loads):
            centre, velocity, angle, spin = body.state(now)
            ids = slice(first, first + len(body.disk_radius))
            first = ids.stop
            lever, on_disks = self.position[ids] - centre, self.force[ids]
            torque += self.torque[ids].sum() + np.cross(lever, on_disks).sum()
            bodies.append({
                "centre": list(centre), "angle": angle, "velocity": list(velocity), "angular_velocity": spin,
                "force": list(force + on_disks.sum(axis=0)), "torque": torque})  # fmt: skip
        times = {f"{name}_time": now for name in ("position", "velocity", "contact")}
        return {**times, "contact_interval": 0.0, "bodies": bodies}, arrays

    def stats(self):
        return {
            "steps": self.steps,
            "contact_evaluations": self.touching,
            "wall_seconds": self.wall_seconds,
            "cpu_seconds": self.cpu_seconds,
            "counters": {},
        }


serve(Engine())
