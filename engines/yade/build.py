"""Puts a scene into YADE. Ids are the scene's: disks, wall disks by body, planes by body; bodies
of YADE's own (hubs, clumps) come after them."""

import math

import numpy as np
from crossgrain_walls import Box
from crossgrain_worker import Unsupported
from yade import (
    ForceResetter,
    FrictMat,
    HarmonicMotionEngine,
    InsertionSortCollider,
    InteractionLoop,
    NewtonIntegrator,
    O,
    Vector3,
    utils,
)

DISK_MASK, WALL_MASK, HUB_MASK = 1, 3, 0  # two walls share all bits: the collider skips them
BOX_REACH = 1e6  # half a box's length [m]
FAR = 1e4  # extents of a scene: beyond that no image of it is met


def kind_mask(kind):
    """The bit that disks of a kind share with the boxes that are planes to them alone."""
    return 4 << kind
WHITE = (1, 1, 1)  # without a colour YADE reseeds Python's random numbers for one


def set_cell(scene, arrays, bodies):
    """YADE's cell is periodic in all directions: along others it is so long that nothing meets its image.

    @raise Unsupported"""
    box = Box(scene)
    O.periodic = any(box.periodic)
    if not O.periodic:
        return
    for body in bodies:
        if body.planes:
            raise Unsupported(f"has no planes in periodic scenes, and {body.name} has one")
    places = [arrays["disks.position"], *(body.disk_position.ravel() for body in bodies)]
    far = FAR * np.abs(np.concatenate([*places, arrays["disks.radius"]])).max()
    lengths = np.where(box.periodic, box.high - box.low, far).tolist()
    O.cell.setBox([*lengths, far][:3])


def place_disks(arrays, kinds, rotation, boxes, space):
    """Disks are held in the plane; spheres are not. Without rotation spins are held, too."""
    size = 3 if space else 2
    held = ("" if space else "z") + ("XYZ" if not rotation else "" if space else "XY")
    columns = (
        kinds.of_disk,
        *(arrays[f"disks.{name}"].tolist() for name in ("radius", "mass", "inertia")),
        *(arrays[f"disks.{name}"].reshape(-1, size).tolist() for name in ("position", "velocity")),
        (arrays["disks.spin"].reshape(-1, 3) if space else arrays["disks.spin"]).tolist(),
    )
    for kind, radius, mass, inertia, position, velocity, spin in zip(*columns):
        mask = DISK_MASK | kind_mask(kind) if boxes else DISK_MASK
        disk = utils.sphere(in_space(position), radius, color=WHITE, material=kind, mask=mask)
        state = disk.state
        state.mass, state.inertia = mass, (inertia, inertia, inertia)
        state.vel, state.angVel = in_space(velocity), about(spin)
        state.blockedDOFs = held
        O.bodies.append(disk)


def in_space(vector):
    """Of the plane: with z = 0."""
    return (*vector, 0)[:3]


def about(spin):
    """Of the plane: about z."""
    return spin if np.ndim(spin) else (0, 0, spin)


def place_walls(bodies, law):
    """Sets each body's disk_ids and plane_ids, in the order of the scene's planes, and for boxes,
    of which each plane has one for every kind of disks, how deep their centres lie."""
    kinds = law.kinds
    for body, of_disks in zip(bodies, kinds.of_wall):
        disks = [
            utils.sphere(
                in_space(place), radius, fixed=True, color=WHITE, material=kind, mask=WALL_MASK
            )
            for place, radius, kind in zip(
                body.disk_position.tolist(), body.disk_radius.tolist(), of_disks
            )
        ]
        body.disk_ids = O.bodies.append(disks)
    for body, of_planes in zip(bodies, kinds.of_plane):
        shapes = boxes_of if law.boxes else wall_of
        body.plane_depth = box_depth(kinds) if law.boxes else 0.0
        made = [shapes(plane, kind, law) for plane, kind in zip(body.planes, of_planes)]
        body.plane_ids = [O.bodies.append(shape) for of_plane in made for shape in of_plane]


def wall_of(plane, kind, law):
    axis = next(k for k, component in enumerate(plane["normal"]) if component)
    point, sense = in_space(plane["point"]), int(plane["normal"][axis])
    wall = utils.wall(point, axis, sense=sense, color=WHITE, material=kind)
    wall.mask = WALL_MASK
    return [wall]


def boxes_of(plane, kind, law):
    """Of each kind of disks one, whose constants depend on their radius."""
    depth = box_depth(law.kinds)
    axis = next(k for k, component in enumerate(plane["normal"]) if component)
    extents = [BOX_REACH, BOX_REACH, BOX_REACH]
    extents[axis] = depth
    centre = Vector3(*in_space(plane["point"])) - depth * Vector3(*in_space(plane["normal"]))
    boxes = []
    for disks in np.flatnonzero(~law.kinds.wall).tolist():
        material = O.materials.append(law.material(kind, float(law.kinds.radius[disks])))
        law.name_box(material, kind, disks)
        box = utils.box(centre, extents, fixed=True, color=WHITE, material=material)
        box.mask = kind_mask(disks)  # nothing that walls have; two boxes have no geometry
        boxes.append(box)
    return boxes


def box_depth(kinds):
    """A power of two, with which centres round nothing."""
    return 2.0 ** math.ceil(math.log2(4 * kinds.radius[~kinds.wall].max()))


def start_walls(bodies):
    """Velocities at t = 0; a rotating body becomes a clump, which YADE turns rigidly."""
    for body in bodies:
        _, velocity, _, spin = body.state(0.0)
        for id_, of_disk in zip(body.disk_ids, body.disk_ids and body.disk_states(0.0)[1].tolist()):
            O.bodies[id_].state.vel = in_space(of_disk)
            O.bodies[id_].state.angVel = about(spin)
        for id_ in body.plane_ids:
            O.bodies[id_].state.vel = in_space(velocity.tolist())
        if body.kind == "rotating" and body.disk_ids:
            clump_about(body.centre.tolist(), body.disk_ids, spin)


def clump_about(centre, ids, spin):
    # A clump turns about its centre of mass: a hub that outweighs all else puts it at the centre.
    heavy = O.materials.append(FrictMat(density=1e40))
    hub = utils.sphere(in_space(centre), 1e-3, fixed=True, color=WHITE, material=heavy, mask=HUB_MASK)
    hub.bounded = False
    clump = O.bodies[O.bodies.clump([*ids, O.bodies.append(hub)], discretization=0)]
    clump.state.blockedDOFs = "xyzXYZ"
    clump.state.vel = (0, 0, 0)
    clump.state.angVel = about(spin)


def oscillation(body, dt):
    """Two engines: before the forces the exact velocity at t, before the drift the one that brings
    the body to its exact position at t + dt: a sin w(t + dt) − a sin wt = dt·a w' cos w(t + dt/2)
    with w' = sin(w dt/2)/(dt/2)."""
    w = body.motion["frequency"]
    shrink = math.sin(w * dt / 2) / (w * dt / 2)

    def engine(factor, phase):
        return HarmonicMotionEngine(
            ids=body.disk_ids + body.plane_ids,
            A=in_space([factor * a for a in body.motion["amplitude"]]),
            f=(w / (2 * math.pi),) * 3,
            fi=(phase - math.pi / 2,) * 3,  # YADE's velocity is −A w sin(wt + fi)
        )

    return engine(1.0, 0.0), engine(shrink, w * dt / 2)


def build_engines(law, bodies, dt, gravity, verlet_distance):
    """@return the integrator; O.engines is set"""
    moved = [
        oscillation(body, dt)
        for body in bodies
        if body.kind == "oscillating"
        and body.motion["frequency"]
        and body.disk_ids + body.plane_ids
    ]
    newton = NewtonIntegrator(damping=0, gravity=in_space(gravity))
    constants, force = law.functors
    bounds, geometries = law.shapes()
    O.engines = [
        ForceResetter(),
        *(exact for exact, _ in moved),
        InsertionSortCollider(
            bounds,
            verletDist=-verlet_distance,
            avoidSelfInteractionMask=WALL_MASK & ~DISK_MASK,
        ),
        InteractionLoop(geometries, [constants], [force]),
        *(drift for _, drift in moved),
        newton,
    ]
    return newton


def radial_changes(bodies, dt):
    """step → [(body, share of its radial speed from that step on)]: a ring stops at radial_end,
    if need be part of the way through a step."""
    changes = {}
    for body in bodies:
        if body.kind != "radial":
            continue
        last = body.motion["radial_end"] / dt
        whole = math.floor(last + 1e-9)
        share = max(last - whole, 0.0)
        if share > 0:
            changes.setdefault(whole, []).append((body, share))
        changes.setdefault(whole + (share > 0), []).append((body, 0.0))
    return changes
