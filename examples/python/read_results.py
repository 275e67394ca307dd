#!/usr/bin/env python3
"""Reads a folder of `crossgrain compare` with python/crossgrain.py and prints what a notebook would begin with:

    crossgrain compare cases/couette/quick.toml --out out/quick
    python3 examples/python/read_results.py out/quick

Each cell of a notebook is a block below. Nothing is drawn: profile.r and profile.mean are what plot() takes.
"""

import pathlib
import sys

import numpy as np

# Beside the examples in the source; what is installed lies in share/crossgrain/python.
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python"))
import crossgrain  # noqa: E402

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/compare")

# %% Profiles: a field against the radius, with error bars
results = crossgrain.Results(folder)
print(f"{results.kind} of {results.case}: {', '.join(results.engines)}")
for engine in dict.fromkeys(run["engine"] for run in results.runs()):
    profile = results.profile("volume_fraction", engine=engine)
    print(f"{engine}, packing {profile.packing}: {profile.field} [{profile.unit}]")
    for k, (mean, stderr) in enumerate(zip(profile.mean, profile.stderr)):
        place = f"r = {profile.r[k]:.4f} m" if len(profile.r) else f"({profile.x[k]:.4f}, {profile.y[k]:.4f}) m"
        print(f"  {place}: {mean:.3f} ± {stderr:.3f}")

# %% Verdicts on endpoints
if results.document.get("endpoints"):
    table = results.endpoints()
    for a, b, endpoint, answer in zip(*(table.get(name, []) for name in ("a", "b", "endpoint", "answer"))):
        print(f"{b} against {a}, {endpoint}: {answer}")

# %% A series over time
series = results.series()
print(f"kinetic energy of {results.engines[0]}: {np.nanmean(series['kinetic_energy']):.3g} J on average over {len(series['t_s'])} snapshots")

# %% Snapshots: the force on every disk, and the stress of all contacts
for file in sorted((folder / "snapshots").glob(f"{results.engines[0]}-p*.h5"))[:1]:
    with crossgrain.Snapshots(file) as snapshots:
        snapshot = snapshots[-1]
        print(f"{file.name}: {len(snapshots)} snapshots of {snapshots.engine}, {len(snapshots.radius)} disks; the last at t = {snapshot.time:g} s")
        contacts = snapshot.contacts
        if contacts is None:
            continue
        force = np.zeros((len(snapshots.radius) + len(snapshots.wall_radius), 2))
        known = contacts.j < len(force)  # planes have no row
        np.add.at(force, contacts.i, contacts.force)
        np.add.at(force, contacts.j[known], -contacts.force[known])
        print(f"  contacts: {np.count_nonzero(contacts.transmits)}, largest normal force {contacts.normal_force.max(initial=0.0):.3g} N")
        disks = force[: len(snapshots.radius)]
        print(f"  largest net force on a disk: {np.linalg.norm(disks, axis=1).max(initial=0.0):.3g} N")
