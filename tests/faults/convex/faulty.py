#!/usr/bin/env python3
"""An engine that is right about convex bodies, with one fault between it and the harness.

    faulty.py FAULT COMMAND …     a worker: COMMAND is the right engine's, FAULT one of FAULTS, or none

Scenes are changed before the engine has them, or snapshots before the harness does.
"""
import json
import os
import subprocess
import sys

import numpy as np

TYPES = {'f64': '<f8', 'i32': '<i4', 'u8': 'u1'}


def read_arrays(path, entries):
    with open(path, 'rb') as file:
        data = file.read()
    return {e['name']: np.frombuffer(data, TYPES[e['type']], e['count'], e['offset']).copy() for e in entries}


def write_arrays(path, arrays):
    names = {np.dtype(t).str: name for name, t in TYPES.items()}
    entries, data = [], b''
    for name, array in arrays.items():
        data += b'\0' * (-len(data) % 8)
        entries.append({'name': name, 'type': names.get(array.dtype.str, 'u8'), 'count': len(array), 'offset': len(data)})
        data += array.tobytes()
    with open(path, 'r+b' if os.path.exists(path) else 'wb') as file:
        file.write(data)
    return entries


def rotation(quaternion):
    w, x, y, z = quaternion
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


# ---- of scenes: fault(scene, arrays), where it has shapes ----

def inertia_of_disk(scene, arrays):
    """Moments of inertia of a disk, or sphere, of the body's reach."""
    q = 0.4 if scene.get('dimension') == 3 else 0.5
    arrays['disks.inertia'] = q * arrays['disks.mass'] * arrays['disks.radius']**2
    if 'disks.moments' in arrays:
        arrays['disks.moments'] = np.repeat(arrays['disks.inertia'], 3)


def moments_in_another_order(scene, arrays):
    """J_x and J_z exchanged."""
    if 'disks.moments' in arrays:
        arrays['disks.moments'] = arrays['disks.moments'].reshape(-1, 3)[:, ::-1].ravel()


def no_torque(scene, arrays):
    """Impulses give no spin."""
    for name in ('disks.inertia', 'disks.moments'):
        if name in arrays:
            arrays[name] = arrays[name] * 1e6


def corner_missed(scene, arrays):
    """One corner of every shape is not there."""
    for shape in scene['shapes']:
        if len(shape['vertices']) > 3:
            del shape['vertices'][0]
        if shape['kind'] == 'box':
            shape['kind'] = 'polyhedron'


def turned_the_other_way(scene, arrays):
    """Bodies start turned clockwise by what they should be counter-clockwise."""
    arrays['disks.turn'] *= -1 if scene.get('dimension') != 3 else np.tile([1, -1, -1, -1], scene['disks'])


def no_restitution(scene, arrays):
    """e_n = 0."""
    scene['law']['en'] = 0.0


def less_friction(scene, arrays):
    """µ is a tenth less."""
    scene['law']['mu'] *= 0.9


def no_friction(scene, arrays):
    """µ = 0."""
    scene['law']['mu'] = 0.0


def much_gravity(scene, arrays):
    """Gravity is ten times as strong."""
    scene['gravity'] = [10 * g for g in scene['gravity']]


def small_shapes(scene, arrays):
    """Bodies meet when their cores do, of a hundredth of their size."""
    for shape in scene['shapes']:
        shape['vertices'] = [[0.01 * x for x in vertex] for vertex in shape['vertices']]


# ---- of snapshots: fault(snapshot, arrays) ----

def not_normalised(snapshot, arrays):
    """Quaternions grow by a part in 2000 a step, angles stay."""
    if len(arrays['turn']) == 4 * len(arrays['velocity']) // 3:
        arrays['turn'] *= 1 + snapshot['position_time']


def one_point(snapshot, arrays):
    """A face that lies on a plane has its force at one corner."""
    if 'contacts.point' in arrays:
        arrays['contacts.point'][0::3 if len(arrays['velocity']) % 3 == 0 and len(arrays['spin']) == len(arrays['velocity']) else 2] += 0.03


def spin_of_the_body(snapshot, arrays):
    """ω in the body's frame, where the scene's is asked for."""
    if len(arrays['turn']) == 4 * len(arrays['velocity']) // 3:
        spins = arrays['spin'].reshape(-1, 3)
        for k, quaternion in enumerate(arrays['turn'].reshape(-1, 4)):
            spins[k] = rotation(quaternion).T @ spins[k]


def half_the_load(snapshot, arrays):
    """Of two points of a face one is shown."""
    if 'contacts.normal_force' in arrays:
        arrays['contacts.normal_force'] *= 0.5


def faster(snapshot, arrays):
    """Velocities are too large by as much as seconds have passed."""
    arrays['velocity'] *= 1 + snapshot['velocity_time']


def creeps(snapshot, arrays):
    """All bodies are shown to creep along x, by 10 mm/s."""
    in_space = len(arrays['turn']) == 4 * len(arrays['velocity']) // 3
    for name in arrays.keys() & {'position', 'contacts.point'}:
        arrays[name][0::3 if in_space else 2] += 0.01 * snapshot['position_time']


OF_SCENES = [inertia_of_disk, moments_in_another_order, no_torque, corner_missed, turned_the_other_way, no_restitution, less_friction,
             no_friction, much_gravity, small_shapes]
OF_SNAPSHOTS = [not_normalised, one_point, spin_of_the_body, half_the_load, faster, creeps]
FAULTS = {fault.__name__: fault for fault in OF_SCENES + OF_SNAPSHOTS}


def start(command):
    """The engine, and its ends of two pipes on the descriptors 3 and 4."""
    request, to = os.pipe()
    back, reply = os.pipe()
    script = f'import os, sys; os.dup2({request}, 103); os.dup2({reply}, 104); os.dup2(103, 3); os.dup2(104, 4); os.execvp(sys.argv[1], sys.argv[1:])'
    process = subprocess.Popen([sys.executable, '-c', script, *command], pass_fds=(request, reply))
    os.close(request)
    os.close(reply)
    return process, os.fdopen(to, 'w'), os.fdopen(back)


def main():
    fault, command = FAULTS.get(sys.argv[1]), sys.argv[2:]
    requests, replies = os.fdopen(os.dup(3)), os.fdopen(os.dup(4), 'w')
    for inherited in (3, 4):
        os.close(inherited)
    process, to, back = start(command)
    convex = False
    for line in requests:
        request = json.loads(line)
        kind = request['request']
        if kind == 'load':
            convex = 'shapes' in request['scene']
            if convex and fault in OF_SCENES:
                arrays = read_arrays(request['file'], request['arrays'])
                fault(request['scene'], arrays)
                request['arrays'] = write_arrays(request['file'], arrays)
        to.write(json.dumps(request) + '\n')
        to.flush()
        answer = json.loads(back.readline())
        if kind == 'snapshot' and convex and fault in OF_SNAPSHOTS and answer['ok']:
            arrays = read_arrays(request['file'], answer['arrays'])
            fault(answer['snapshot'], arrays)
            answer['arrays'] = write_arrays(request['file'], arrays)
        replies.write(json.dumps(answer) + '\n')
        replies.flush()
        if kind == 'quit':
            break
    process.wait()


if __name__ == '__main__':
    main()
