"""Writes a scene as a LAMMPS data file and input script.

    engine_steps CASE.toml > scene.json
    python3 lammps_input.py scene.json FOLDER
    cd FOLDER && lmp -in in.scene -var skin 5e-4 -var check 2000 -var steps 5000

With `-var style gran/hooke/history` it runs LAMMPS's older style, which is faster and not quite the
law (README.md). The script runs `check` steps, writes the state to `check.dump`, prints the number of contacts, and
runs `steps` more without any output, to be timed. README.md says what LAMMPS makes of a scene.
"""

import json
import math
import pathlib
import sys

DISKS = 1  # the type of moving disks; wall bodies are 2, 3, …

INPUT = """\
units si
dimension 2
atom_style sphere
boundary f f p
newton off
comm_modify vel yes
variable skin index {skin:.17g}
variable check index 2000
variable steps index 5000
variable style index granular
read_data data.scene
if "${{style}} == granular" then &
  "pair_style granular" &
  "pair_coeff * * hooke {kn:.17g} {gn:.17g} tangential linear_history {kt:.17g} {gt_ratio:.17g} {mu:.17g} damping velocity" &
else &
  "pair_style ${{style}} {kn:.17g} {kt:.17g} {gn_rate:.17g} {gt_rate:.17g} {mu:.17g} 1" &
  "pair_coeff * *"
neighbor ${{skin}} bin
neigh_modify delay 0 every 1 check yes
timestep {dt:.17g}
group disks type 1
fix disks disks nve/sphere disc
{walls}fix plane all enforce2d
compute perDisk all contact/atom
compute contactEnds all reduce sum c_perDisk
thermo_style custom step c_contactEnds
thermo_modify norm no
thermo ${{check}}
run ${{check}}
write_dump all custom check.dump id type x y vx vy omegaz modify format float %.17g
thermo_style custom step
thermo 0
run ${{steps}}
"""


def sphere_density(mass, radius):
    """LAMMPS knows masses as densities of spheres, whatever moves in the plane."""
    return mass / (4.0 / 3.0 * math.pi * radius**3)


def data_file(scene):
    disks, walls = scene["disks"], scene["walls"]
    atoms, velocities = [], []
    for disk in disks:
        (x, y), (vx, vy) = disk["position"], disk["velocity"]
        density = sphere_density(disk["mass"], disk["radius"])
        atoms.append((DISKS, 2.0 * disk["radius"], density, x, y))
        velocities.append((vx, vy, disk["spin"]))
    for kind, wall in enumerate(walls, DISKS + 1):
        for x, y in wall["position"]:
            # A wall's mass plays no part: nothing integrates it and no damping is scaled by it.
            atoms.append((kind, 2.0 * wall["radius"], 1000.0, x, y))
            velocities.append((-wall["omega"] * y, wall["omega"] * x, wall["omega"]))
    reach = 2.0 * max(max(abs(x), abs(y)) for _, _, _, x, y in atoms)
    lines = ["a crossgrain scene", "", f"{len(atoms)} atoms", f"{DISKS + len(walls)} atom types", ""]
    lines += [f"{-reach!r} {reach!r} {axis}lo {axis}hi" for axis in "xy"]
    lines += ["-0.01 0.01 zlo zhi", "", "Atoms # sphere", ""]
    lines += [f"{i} {kind} {diameter!r} {density!r} {x!r} {y!r} 0.0"
              for i, (kind, diameter, density, x, y) in enumerate(atoms, 1)]
    lines += ["", "Velocities", ""]
    lines += [f"{i} {vx!r} {vy!r} 0.0 0.0 0.0 {spin!r}"
              for i, (vx, vy, spin) in enumerate(velocities, 1)]
    return "\n".join(lines) + "\n"


def wall_lines(walls):
    """Walls turn about the origin or rest, and never meet each other."""
    kinds = range(DISKS + 1, DISKS + 1 + len(walls))
    lines = [f"neigh_modify exclude type {a} {b}" for a in kinds for b in kinds if a <= b]
    for kind, wall in zip(kinds, walls):
        lines.append(f"group wall{kind} type {kind}")
        if wall["omega"]:
            period = 2.0 * math.pi / abs(wall["omega"])
            axis = math.copysign(1, wall["omega"])
            lines.append(f"fix turn{kind} wall{kind} move rotate 0 0 0 0 0 {axis:g} {period!r}")
    return "".join(line + "\n" for line in lines)


def write(scene, folder):
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    law = scene["law"]
    reduced = 0.5 * min(disk["mass"] for disk in scene["disks"])
    script = INPUT.format(
        **law,
        gt_ratio=law["gt"] / law["gn"],
        gn_rate=law["gn"] / reduced,
        gt_rate=law["gt"] / reduced,
        dt=scene["dt"],
        skin=0.2 * min(disk["radius"] for disk in scene["disks"]),
        walls=wall_lines(scene["walls"]),
    )
    (folder / "data.scene").write_text(data_file(scene))
    (folder / "in.scene").write_text(script)


def read_dump(file):
    """The rows of a dump as dictionaries, by id."""
    lines = pathlib.Path(file).read_text().splitlines()
    header = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    names = lines[header].split()[2:]
    rows = [dict(zip(names, map(float, line.split()))) for line in lines[header + 1 :]]
    return sorted(rows, key=lambda row: row["id"])


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    write(json.loads(pathlib.Path(sys.argv[1]).read_text()), sys.argv[2])
