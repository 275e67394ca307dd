"""What workers of engines that know disks, walls and a Coulomb law answer alike."""

import json
import os

from crossgrain_worker import Unsupported

EFFECTS = (
    "normal_damping",
    "friction",
    "tangential_spring",
    "tangential_damping",
    "rotation",
    "gravity",
    "moving_walls",
)
MOTIONS_IN_SPACE = ("fixed", "rotating", "translating", "oscillating")


def effects_without_bottom():
    """Of `capabilities`: all effects of disks in their plane can be had, the bottom plate's never."""
    never = ("bottom_friction", "bottom_spin_friction")
    return {name: "optional" for name in EFFECTS} | {name: "never" for name in never}


def law_options(folder):
    """Of `capabilities`: what the engine in that folder declares of its law, of which its mirror is made, too."""
    with open(os.path.join(folder, "law_options.json"), encoding="utf-8") as file:
        return json.load(file)


def setting(name, default, unit, doc, **limits):
    """Of `capabilities`: a setting that takes any number >= 0, or within `least`, `most`, `whole`."""
    return {"name": name, "default": default, "unit": unit, "doc": doc, "choices": []} | limits


def stats(steps, evaluations, wall, cpu, **counters):
    """The answer to `stats`: steps done, contacts evaluated, and seconds of `advance` alone."""
    return {
        "steps": steps,
        "contact_evaluations": evaluations,
        "wall_seconds": wall,
        "cpu_seconds": cpu,
        "counters": counters,
    }


def at(time, bodies, interval=0.0):
    """Of `snapshot`: all of it of one time."""
    times = {f"{name}_time": time for name in ("position", "velocity", "contact")}
    return times | {"contact_interval": interval, "bodies": bodies}


def demand_linear(law, kinds):
    """Of `load`: the linear law with a tangential part of one of those kinds.

    @raise Unsupported"""
    demand_law(law, ("linear",), ("constant",), kinds)


def demand_law(law, normals, dampers, kinds):
    """Of `load`: a law of one of those kinds each; a damper where there is one.

    @raise Unsupported"""
    if law["normal"] not in normals:
        raise Unsupported(f'has normal = {" | ".join(normals)}, not "{law["normal"]}"')
    demand_tangential(law, kinds)
    if (law["gn"] > 0 or law["gt"] > 0) and law["damper"] not in dampers:
        raise Unsupported(f'has damper = {" | ".join(dampers)}, not "{law["damper"]}"')


def demand_tangential(law, kinds):
    if law["tangential"] not in kinds:
        raise Unsupported(f'has tangential = {" | ".join(kinds)}, not "{law["tangential"]}"')


def demand_plain_walls(scene, bodies):
    """Of `load`: no plate below the disks, planes along axes only and, in space, no ring that shrinks.

    @raise Unsupported"""
    bottom = scene.get("bottom")
    if bottom and bottom["mu"] > 0:
        raise Unsupported("has no bottom_friction")
    for body in bodies:
        if scene.get("dimension", 2) == 3 and body.kind not in MOTIONS_IN_SPACE:
            had = " | ".join(MOTIONS_IN_SPACE)
            raise Unsupported(f"has walls that are {had} in space, not {body.kind}")
        for plane in body.planes:
            *zeros, one = sorted(map(abs, plane["normal"]))
            if any(zeros) or one != 1:
                raise Unsupported(
                    f"has planes along axes only; one of {body.name} has the normal "
                    f"{tuple(plane['normal'])}"
                )


def effects_called(law, scene):
    """Of `load`: which of EFFECTS a scene calls for. law has gn, kt and gt as they act, and friction."""
    called = (
        law.gn > 0,
        law.friction,
        law.kt > 0,
        law.gt > 0,
        law.friction and scene["rotation"],
        any(scene["gravity"]),
        any(body["motion"]["kind"] != "fixed" for body in scene["bodies"]),
    )
    return [name for name, calls in zip(EFFECTS, called) if calls]
