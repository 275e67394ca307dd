"""Writes sandpile.csv anew: 3000 disks poured into the hopper of sandpile.toml above its closed slot, at rest after 3.5 s;
and sandpile-small.csv: the lowest 600 of them.

    python3 make_sandpile.py CROSSGRAIN [SEED]     (needs h5py; half a minute)
"""

import math
import pathlib
import random
import subprocess
import sys
import tempfile

import h5py

HERE = pathlib.Path(__file__).resolve().parent
DENSITY = 1056.0  # kg/m³, of spheres
FILLING = """
[case]
name = "sandpile-filling"
extends = "{here}/sandpile.toml"

[assembly]
duration = 3.5
start = {{ file = "loose.csv", velocity_rms = 0.0 }}
walls = [
  {{ point = [0.0, 0.0], normal = [0.0, 1.0] }},
  {{ position = [0.038086, -0.002545], line = {{ count = 187, step = [0.31810, 0.38575] }}, radius = 0.004 }},
  {{ position = [-0.038086, -0.002545], line = {{ count = 187, step = [-0.31810, 0.38575] }}, radius = 0.004 }},
]

[run]
keep_snapshots = 1

[preparation]
packings = 1

[[endpoints]]
name = "height"
quantity = "top"
at = "end"
absolute = 0.01
why = "nothing is compared"
"""


def loose(seed):
    """Rows of (x, y, radius, mass): a loose lattice above the hopper's floor, small and large disks in any order."""
    draw = random.Random(seed)
    radii = [0.00345] * 2500 + [0.00445] * 500
    draw.shuffle(radii)
    for k, radius in enumerate(radii):
        x = (k % 60 - 29.5) * 0.0102 + draw.uniform(-4e-4, 4e-4)
        y = 0.38 + k // 60 * 0.0102 + draw.uniform(-4e-4, 4e-4)
        yield x, y, radius, DENSITY * 4.0 / 3.0 * math.pi * radius**3


def write(file, rows, title):
    with open(file, "w", encoding="utf-8") as out:
        out.write(f"# {title}: made by make_sandpile.py\nx,y,radius,mass\n")
        for x, y, radius, mass in rows:
            out.write(f"{x:.6f},{y:.6f},{radius:.5f},{mass:.4e}\n")


def main(program, seed="1"):
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        write(folder / "loose.csv", loose(int(seed)), "Disks above the hopper")
        (folder / "filling.toml").write_text(FILLING.format(here=HERE), encoding="utf-8")
        subprocess.run([program, "compare", folder / "filling.toml", "--engines", "grain", "--out", folder / "out"], check=True)
        with h5py.File(folder / "out/snapshots/grain-p0.h5") as run:
            last = run[max(name for name in run if name.startswith("snapshot-"))]
            x, radius, mass = last["position"][:], run["disks/radius"][:], run["disks/mass"][:]
    rows = list(zip(x[:, 0], x[:, 1], radius, mass))
    write(HERE / "sandpile.csv", rows, "3000 disks at rest in the hopper of sandpile.toml above its closed slot")
    write(HERE / "sandpile-small.csv", sorted(rows, key=lambda row: row[1])[:600], "The lowest 600 disks of sandpile.csv")


if __name__ == "__main__":
    main(*sys.argv[1:])
