"""Scenes on LAMMPS through its C library, or on a descendant of it that says the same in other words."""

import math
import time

import jkr
import numpy as np
from build import Scene, check
from contacts import contacts_of_rows, pair_rows, read_plane_contacts, torques_at_planes
from crossgrain_answers import at, effects_called, effects_without_bottom, setting, stats
from crossgrain_walls import bodies_of, moments
from law import OPTIONS, Law, Laws
from library import Lammps

CHUNK = 1000  # steps between two checks of the number of contacts
PARTS = ("rolling_resistance", "cohesion", "pair_materials")  # effects


class Engine:
    """What a descendant says otherwise: the members before __init__, `pair_rows` and `contacts_of_rows`.

    One instance for each rank where several share a run; what LAMMPS is asked for is then this rank's part."""

    name = "lammps"
    Law, Scene, check = Law, Scene, staticmethod(check)
    law_options = OPTIONS

    limits = {
        "inertia": [0.5, 0.4],
        "wall_motions": ["fixed", "rotating", "translating", "oscillating"],
        "plane_motions": ["fixed"],
        "plane_normals": "axis",
        "cylinders": True,
    }

    bonds = None  # under JKR, in the process that runs it

    def __init__(self, lammps=None):
        self.lammps = lammps or Lammps()

    def pair_rows(self):
        if self.bonds:
            return jkr.pair_rows(self.lammps, self.law, self.bonds)
        return pair_rows(self.lammps, self.law)

    def contacts_of_rows(self, rows, position):
        if self.bonds:
            return jkr.contacts_of_rows(rows, self.made, position, self.bonds)
        return contacts_of_rows(rows, self.made, position)

    def capabilities(self):
        return {
            "version": self.lammps.version(),
            "dimensions": [2, 3],
            "periodic": True,
            "effects": effects_without_bottom() | {name: "optional" for name in PARTS},
            "law_options": self.law_options,
            **self.limits,
            "precisions": ["double"],
            "instant_contacts": True,
            "accumulated_contacts": False,
            "warm_handover": False,
            "sliding_flags": True,
            "settings": [
                setting("dt", 0.0, "s", "time step; 0: the case's"),
                setting(
                    "skin",
                    0.2,
                    "smallest radius",
                    "how far lists reach beyond disks that touch; changes the speed only",
                ),
            ],
        }

    def take(self, scene, arrays, settings):
        """All of a scene that LAMMPS need not know of."""
        self.bodies = bodies_of(scene, arrays)
        self.laws = Laws(self.Law, scene, arrays, self.bodies)
        self.law = self.laws.one
        self.check(scene, self.bodies, arrays)
        self.dt = settings.get("dt", 0.0) or scene["dt"]
        self.gravity = np.array(scene["gravity"])
        self.disks = scene["disks"]
        self.space = scene.get("dimension", 2)
        self.turning = 2 if self.space == 2 else slice(3)  # components of spins and torques
        self.mass, self.inertia = arrays["disks.mass"], arrays["disks.inertia"]
        self.rotation = self.law.turns and scene["rotation"]
        self.made = self.Scene(self.lammps, scene, arrays, self.bodies, self.laws, self.rotation)

    def forget_arrays(self):
        """Of who makes snapshots alone: nothing of a scene's disks but their radii."""
        self.made.arrays = self.mass = self.inertia = None

    def load(self, scene, arrays, settings):
        self.take(scene, arrays, settings)
        self.lammps.command("clear")
        self.made.place(settings.get("skin", 0.2), self.dt)
        self.lammps.command("run 0 post no")
        self.made.put_first_forces()
        self.bonds = jkr.Bonds(self.made, self.lammps.gather("x", 3)[:, :2]) if self.law.bonds else None
        self.follow_bonds()
        self.steps = self.evaluations = 0
        self.wall_seconds = self.cpu_seconds = 0.0
        return {
            "engine": self.name,
            "version": self.lammps.version(),
            "dt": self.dt,
            "precision": "double",
            "integrator": "position_verlet",
            "velocity_lag": 0.0,
            "effects": self.effects(scene),
            "pairs": self.laws.table(),
            "deviations": self.deviations(),
        }

    def deviations(self):
        if not (self.law.rolls and any(self.made.box.periodic)):
            return []
        note = (
            "where a pair in contact goes over a periodic border LAMMPS reverses the rolling spring on the side of the "
            "second (README.md of engines/lammps)"
        )
        return [{"name": "rolling_spring_at_borders", "value": 0.0, "unit": "", "note": note}]

    def effects(self, scene):
        """Those that the scene calls for."""
        law = self.law
        called = set(effects_called(law, scene))
        called |= {
            name
            for name, calls in zip((*PARTS, "rotation"), (law.rolls, law.cohesion != "none", "materials" in scene, self.rotation))
            if calls
        }
        return sorted(called)

    def advance(self, t):
        wall, cpu = time.perf_counter(), time.thread_time()
        target = math.floor(t / self.dt + 0.5)
        while self.steps < target:
            chunk = 1 if self.bonds else min(target - self.steps, CHUNK)
            self.lammps.command(f"run {chunk} pre no post no")
            self.follow_bonds()
            self.steps += chunk
            self.evaluations += chunk * (self.bonds.count() if self.bonds else self.lammps.count_of_compute("ids"))
        self.wall_seconds += time.perf_counter() - wall
        self.cpu_seconds += time.thread_time() - cpu
        return self.steps * self.dt

    def follow_bonds(self):
        if self.bonds:
            self.bonds.follow(self.lammps.own("x")[:, :2])

    def snapshot(self, report):
        return self.snapshot_of([self.part(report)], report, self.steps)

    def part(self, report):
        """What this rank knows of its own atoms, in LAMMPS' order, and of its pairs."""
        if report == "accumulated":
            raise ValueError("has no accumulated contacts")
        found = {
            "ids": self.lammps.ids(),
            "position": self.lammps.own("x")[:, : self.space].copy(),
            "velocity": self.lammps.own("v")[:, : self.space].copy(),
            "spin": self.lammps.own("omega")[:, self.turning].copy(),
            "force": self.lammps.own("f")[:, : self.space].copy(),
            "torque": self.lammps.own("torque")[:, self.turning].copy(),
        }
        for k in range(self.made.planes):
            found[f"on_plane.{k}"] = self.made.forces_of_plane(k)
        if report == "instant":
            found["pairs"] = self.pairs_of_step(found)
        return found

    def pairs_of_step(self, found):
        """LAMMPS computes forces of pairs from the velocities that it has when it is asked, and the step
        from those before its second half kick; so these are put there while it is asked. What a rank
        sees of others' atoms was sent to it before that kick. It answers once in a step: nobody else
        may ask for "pairs"."""
        if not self.steps:
            return self.pair_rows()
        velocity, spin = self.lammps.own("v"), self.lammps.own("omega")
        kept = velocity.copy(), spin.copy()
        free = found["ids"] <= self.disks
        which = found["ids"][free] - 1
        velocity[free, : self.space] -= 0.5 * self.dt * found["force"][free] / self.mass[which, None]
        if self.rotation:
            spin[free, self.turning] -= (0.5 * self.dt * found["torque"][free].T / self.inertia[which]).T
        rows = self.pair_rows()
        velocity[:], spin[:] = kept
        return rows

    def snapshot_of(self, parts, report, steps):
        """One snapshot of what all ranks saw after that many steps."""
        ids = np.concatenate([part["ids"] for part in parts])
        if len(ids) != self.made.atoms:
            raise RuntimeError(f"{len(ids)} of {self.made.atoms} atoms are left")
        order = np.argsort(ids)

        def of_all(name):
            return np.concatenate([part[name] for part in parts])[order]

        now, n = steps * self.dt, self.disks
        position, force, torque = of_all("position"), of_all("force"), of_all("torque")
        on_planes = [of_all(f"on_plane.{k}") for k in range(self.made.planes)]
        arrays = {
            "position": ("f64", position[:n]),
            "velocity": ("f64", of_all("velocity")[:n]),
            "wall_position": ("f64", position[n:]),
        }
        if self.law.turns:
            arrays["spin"] = ("f64", of_all("spin")[:n])
        if report == "instant":
            rows = np.concatenate([part["pairs"] for part in parts])
            arrays.update(self.contacts(rows, position, on_planes, torque))
        bodies = [self.body_snapshot(b, now, position, force, torque, on_planes, arrays) for b in self.bodies]
        return at(now, bodies), arrays

    def contacts(self, rows, position, on_planes, torque):
        of_pairs = self.contacts_of_rows(rows, position)
        columns = [of_pairs, *read_plane_contacts(self.made, position, on_planes)]
        columns = [np.concatenate(column) for column in zip(*columns)]
        i, j, normal, overlap, pressing, tangential, _ = columns
        strength = tangential if self.space == 2 else np.linalg.norm(tangential, axis=1)
        sliding = self.laws.of_pairs("sliding", i, j, pressing, strength, overlap, *self.made.radii(i, j))
        found = {
            "contacts.i": ("i32", i),
            "contacts.j": ("i32", j),
            "contacts.normal": ("f64", normal),
            "contacts.overlap": ("f64", overlap),
            "contacts.normal_force": ("f64", pressing),
            "contacts.tangential_force": ("f64", tangential),
            "contacts.sliding": ("u8", sliding),
        }
        rolling = torques_at_planes(self.made, columns, torque) if self.law.rolls else None
        if rolling is not None:
            found["contacts.rolling_torque"] = ("f64", rolling)
        return found

    def rolling_on_planes(self, body, arrays):
        """The sum of torques against rolling on a body's planes, which the fix leaves out; None where they are unknown."""
        if not self.law.rolls or not len(body.plane_numbers):
            return 0.0
        if "contacts.rolling_torque" not in arrays:
            return None
        partner, rolling = arrays["contacts.j"][1], arrays["contacts.rolling_torque"][1]
        return -rolling[np.isin(partner, self.made.atoms + np.asarray(body.plane_numbers))].sum(axis=0)

    def body_snapshot(self, body, now, position, force, torque, on_planes, arrays):
        centre = body.state(now)[0]
        members = body.disk_ids
        total = force[members].sum(axis=0)
        # Where LAMMPS moves them to another image their body goes on.
        place = body.disk_states(now)[0] if any(self.made.box.periodic) else position[members]
        moment = moments(place - centre, force[members], torque[members]).sum(axis=0)
        for k in body.plane_numbers:
            on_plane = -on_planes[k][: self.disks]
            total = total + on_plane.sum(axis=0)
            # On the line from a disk's centre to its projection onto the surface.
            normals, gap = self.made.surfaces[k].facing(position[: self.disks])
            overlap = self.made.radius[: self.disks] - gap
            apart = gap + (1.0 - self.made.plane_point) * overlap
            arm = position[: self.disks] - apart[:, None] * normals - centre
            moment += moments(arm, on_plane).sum(axis=0)
        shown = body.shown(now) | {"force": total.tolist()}
        rolling = self.rolling_on_planes(body, arrays)
        return shown if rolling is None else shown | {"torque": (moment + rolling).tolist()}

    def stats(self):
        return stats(self.steps, self.evaluations, self.wall_seconds, self.cpu_seconds)

