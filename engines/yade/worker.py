"""A worker of crossgrain that runs scenes on YADE:  yade -n -x -j1 worker.py

Disks are spheres kept in the plane z = 0, or, of a scene in space, spheres; wall disks are spheres
that move as prescribed, planes are YADE's axis-aligned walls. README.md of this folder says what YADE makes of a scene.
"""

import gc
import math
import os
import socketserver
import sys
import threading
import time

HERE = os.path.dirname(os.path.abspath(sys.argv[0]))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "python")]
sys.dont_write_bytecode = True

import numpy as np
import yade.config
from yade import O, utils

import build
import crossgrain_worker
from cohesive_frictional import CohesiveFrictional
from contacts import read_contacts, xy, xyz, z
from crossgrain_answers import demand_plain_walls, effects_called, effects_without_bottom, law_options, setting, stats
from crossgrain_walls import bodies_of, moments
from kinds import Kinds
from law import representative_pairs
from luding import Luding
from mindlin import Mindlin
from viscoelastic import Viscoelastic

LAWS = {"linear": Viscoelastic, "hertz": Mindlin}
COUNT_EVERY = 100  # steps between two checks of the number of contacts


def close_yades_servers():
    """YADE listens for Python commands on all interfaces; a worker must not."""
    for server in [o for o in gc.get_objects() if isinstance(o, socketserver.BaseServer)]:
        threading.Thread(
            target=lambda s=server: (s.shutdown(), s.server_close()), daemon=True
        ).start()


def law_of(law):
    normal = law["normal"]
    if normal not in LAWS:
        raise crossgrain_worker.Unsupported(f'has normal = {" | ".join(LAWS)}, not "{normal}"')
    if normal == "linear" and law.get("cohesion", "none") != "none":
        return Luding(law)
    if normal == "linear" and law.get("rolling") == "spring":
        return CohesiveFrictional(law)
    return LAWS[normal](law)


class Yade:
    def capabilities(self):
        return {
            "version": yade.config.version,
            "dimensions": [2, 3],
            "periodic": True,
            "effects": effects_without_bottom()
            | {name: "optional" for name in ("rolling_resistance", "cohesion", "pair_materials")},
            "law_options": law_options(HERE),
            "plane_motions": ["fixed", "translating", "oscillating"],
            "plane_normals": "axis",
            "precisions": ["double"],
            "instant_contacts": True,
            "accumulated_contacts": False,
            "warm_handover": False,
            "sliding_flags": True,
            "settings": [
                setting("dt", 0.0, "s", "time step; 0: the case's"),
                setting(
                    "verlet_distance",
                    0.2,
                    "smallest radius",
                    "how far bounding boxes reach beyond disks; changes the speed only",
                ),
            ],
        }

    def load(self, scene, arrays, settings):
        self.law = law_of(scene["law"])
        self.space = scene.get("dimension", 2) == 3
        self.bodies = bodies_of(scene, arrays)
        demand_plain_walls(scene, self.bodies)
        for body in self.bodies:
            if body.cylinders:
                raise crossgrain_worker.Unsupported(f"has no cylinders, as {body.name} has")
        self.law.demand_plane_arm(any(body.planes for body in self.bodies))
        kinds = Kinds(scene, arrays, self.bodies, self.law.by_radius, self.law.by_plane)
        self.law.set_kinds(kinds)
        self.dt = settings.get("dt", 0.0) or scene["dt"]
        self.gravity = scene["gravity"]
        self.disks = scene["disks"]
        self.mass, self.inertia = arrays["disks.mass"], arrays["disks.inertia"]

        O.reset()
        O.dt = self.dt
        build.set_cell(scene, arrays, self.bodies)
        O.materials.append(self.law.materials())
        self.spins = self.law.friction or self.law.rolls
        self.rotation = self.spins and scene["rotation"]
        boxes = self.law.boxes and bool(kinds.plane.any())
        build.place_disks(arrays, kinds, self.rotation, boxes, self.space)
        build.place_walls(self.bodies, self.law)
        self.states = [body.state for body in O.bodies]
        self.first_plane = self.disks + sum(len(body.disk_ids) for body in self.bodies)
        self.radius = np.zeros(len(self.states))  # of planes: no arm
        self.radius[: self.first_plane] = np.concatenate(
            [arrays["disks.radius"], *(body.disk_radius for body in self.bodies)]
        )
        self.newton = build.build_engines(
            self.law,
            self.bodies,
            self.dt,
            self.gravity,
            settings.get("verlet_distance", 0.2),
        )
        realised = self.realised(scene)
        build.start_walls(self.bodies)
        self.radial_changes = build.radial_changes(self.bodies, self.dt)

        self.steps = self.evaluations = 0
        self.wall_seconds = self.cpu_seconds = 0.0
        gc.collect()
        gc.freeze()  # thousands of lasting objects: a collection among them would take 40 ms
        return realised

    def realised(self, scene):
        """Reads the pairs' coefficients back from YADE."""
        pairs = []
        wall_disks = [id_ for body in self.bodies for id_ in body.disk_ids]
        planes = [id_ for body in self.bodies for id_ in body.plane_ids]
        kinds, radius = self.law.kinds, self.radius
        for name, i, j in representative_pairs(
            radius[: self.disks],
            self.mass,
            wall_disks,
            planes and (lambda i: planes[kinds.of_disk[i] if self.law.boxes else 0]),
        ):
            other = radius[j] if j < self.first_plane else math.inf
            made = self.law.coefficients(utils.createInteraction(i, j), radius[i], other)
            pairs.append({"pair": name, **self.law.without_absent(made)})
        O.interactions.clear()
        return {
            "engine": "yade",
            "version": yade.config.version,
            "dt": self.dt,
            "precision": "double",
            "integrator": "position_verlet",
            "velocity_lag": 0.0,
            "effects": self.effects(scene),
            "pairs": pairs,
            "deviations": [*self.law.deviations, *(self.law.deviations_in_space if self.space else ())],
        }

    def effects(self, scene):
        called = effects_called(self.law, scene)
        more = {
            "rolling_resistance": self.law.rolls,
            "cohesion": self.law.coheres,
            "pair_materials": self.law.kinds.several,
            "rotation": self.rotation and "rotation" not in called,
        }
        return called + [name for name, calls in more.items() if calls]

    def advance(self, t):
        wall, cpu = time.perf_counter(), time.thread_time()
        target = math.floor(t / self.dt + 0.5)
        while self.steps < target:
            self.change_radial_motion()
            if self.steps == 0:
                self.first_step()
                continue
            stops = [step for step in self.radial_changes if step > self.steps]
            chunk = min([target, self.steps + COUNT_EVERY, *stops]) - self.steps
            for _ in range(chunk):  # O.run() would wait 40 ms for each call
                O.step()
            self.kick = self.dt
            self.steps += chunk
            self.evaluations += chunk * O.interactions.countReal()
        self.wall_seconds += time.perf_counter() - wall
        self.cpu_seconds += time.thread_time() - cpu
        return self.steps * self.dt

    def first_step(self):
        """The scene's velocities are those of t = 0, YADE's live half a step earlier: the first
        kick is half a kick, which twice the inertia and half the gravity make of a whole one."""
        self.scale_inertia(2.0)
        O.step()
        self.scale_inertia(0.5)
        self.law.begin()
        self.kick = self.dt / 2
        self.steps = 1
        self.evaluations = O.interactions.countReal()

    def scale_inertia(self, factor):
        self.newton.gravity /= factor
        for state in self.states[: self.disks]:
            state.mass *= factor
            state.inertia *= factor
        self.law.scale_inertia(factor)

    def change_radial_motion(self):
        for body, share in self.radial_changes.get(self.steps, []):
            velocities = body.disk_states(0.0)[1]
            for id_, (u, v) in zip(body.disk_ids, velocities.tolist()):
                self.states[id_].vel = (share * u, share * v, 0)

    def vectors(self, of_yade):
        return (xyz if self.space else xy)(of_yade)

    def spins_of(self, of_yade):
        return (xyz if self.space else z)(of_yade)

    def snapshot(self, report):
        if report == "accumulated":
            raise ValueError("has no accumulated contacts")
        time_ = self.steps * self.dt
        disks = self.states[: self.disks]
        walls = self.states[self.disks : self.first_plane]
        snapshot = {
            "position_time": time_,
            "velocity_time": time_ - self.dt / 2 if self.steps else 0.0,
            "contact_time": time_ - self.dt if self.steps else 0.0,
            "contact_interval": 0.0,
        }
        velocity = self.vectors([state.vel for state in disks])
        spin = self.spins_of([state.angVel for state in disks])
        arrays = {
            "position": ("f64", self.vectors([state.pos for state in disks])),
            "velocity": ("f64", velocity),
            "wall_position": ("f64", self.vectors([state.pos for state in walls])),
        }
        if self.spins:
            arrays["spin"] = ("f64", spin)
        forces = None  # before the first step there are none, and so no contacts
        if self.steps:
            forces = self.forces(0 if report == "instant" else self.disks)
            if report == "instant":
                seen = self.seen_by_the_law(velocity, spin, *forces)
                per_plane = np.count_nonzero(~self.law.kinds.wall) if self.law.boxes else 1
                arrays.update(
                    read_contacts(self.law, self.radius, self.first_plane, per_plane, *seen)
                )
        snapshot["bodies"] = [self.body_snapshot(body, time_, forces) for body in self.bodies]
        return snapshot, arrays

    def forces(self, first):
        """Forces and torques of the last step by id; those of ids below `first` are left out."""
        of_yade, ids = O.forces, range(first, len(self.states))
        force = self.vectors([of_yade.f(i) for i in ids])
        torque = self.spins_of([of_yade.t(i) for i in ids])
        return self.after(first, force), self.after(first, torque)

    @staticmethod
    def after(first, rows):
        """The rows after so many of zeros."""
        return np.concatenate([np.zeros((first, *rows.shape[1:])), rows])

    def seen_by_the_law(self, velocity, spin, force, torque):
        """Velocities and spins of all bodies as the forces of the last step saw them."""
        n = self.disks
        all_velocity, all_spin = np.zeros_like(force), np.zeros_like(torque)
        all_velocity[:n] = velocity - self.kick * (force[:n] / self.mass[:, None] + self.gravity)
        all_spin[:n] = spin
        if self.rotation:
            all_spin[:n] -= (self.kick * torque[:n].T / self.inertia).T
        then = (self.steps - 1) * self.dt
        for body in self.bodies:
            _, of_centre, _, body_spin = body.state(then)
            all_velocity[body.plane_ids] = of_centre
            all_velocity[body.disk_ids] = body.disk_states(then)[1]
            all_spin[body.disk_ids] = body_spin
        return all_velocity, all_spin

    def body_snapshot(self, body, time_, forces):
        snapshot = body.shown(time_)
        if forces:
            then = time_ - self.dt
            ids = body.disk_ids + body.plane_ids
            force, torque = forces[0][ids], forces[1][ids]
            at, normal = body.plane_states(then)
            if len(at):  # boxes have their centres below
                at = np.repeat(at - body.plane_depth * normal, len(body.plane_ids) // len(at), 0)
            points = np.concatenate([body.disk_states(then)[0], at])
            arm = points - body.state(then)[0]
            snapshot["force"] = force.sum(axis=0).tolist()
            snapshot["torque"] = (torque.sum(axis=0) + moments(arm, force).sum(axis=0)).tolist()
        return snapshot

    def stats(self):
        return stats(self.steps, self.evaluations, self.wall_seconds, self.cpu_seconds)


close_yades_servers()
crossgrain_worker.serve(Yade())
