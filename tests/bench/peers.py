"""Times engines on the same packing in the same run, and says how they compare.

    python3 tests/bench/peers.py                              builds nothing; needs build/release
    python3 tests/bench/peers.py --engines grain,lammps --rounds 5 --steps 20000

Engines take turns in rounds, so that a busy machine hurts all of them, and the fastest round of each
counts. All start cold from the first packing of the case, run CHECK steps of its dt, where contacts
and kinetic energy are compared, then STEPS steps of their own dt, which are timed.
LAMMPS runs on one rank, without output while timed, with each skin in turn; its best is its figure.
`lammps` is the scene's law, `lammps-hooke` a faster style of LAMMPS that comes near it.
"""

import argparse
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "engines" / "lammps"))
import lammps_input  # noqa: E402

SKINS = (5e-4, 1e-3, 2e-3)  # m; a small disk has 3.7e-3
LAMMPS_DIFFERS = [  # engines/lammps/README.md
    "bottom_friction", "bottom_spin_friction", "coulomb_bound", "damping_velocity",
    "lever_arm", "spring_reset", "spring_update",
]  # fmt: skip


def output_of(*command, cwd=None):
    done = subprocess.run([str(part) for part in command], cwd=cwd, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{command[0]} failed:\n{done.stdout[-2000:]}{done.stderr[-2000:]}")
    return done.stdout


def kinetic_energy(scene, dump):
    """½ m v² + ½ J ω² with J = m a²/2."""
    total = 0.0
    for disk, now in zip(scene["disks"], lammps_input.read_dump(dump)):
        spin = 0.5 * (disk["radius"] * now["omegaz"]) ** 2
        total += 0.5 * disk["mass"] * (now["vx"] ** 2 + now["vy"] ** 2 + spin)
    return total


LAMMPS_STYLES = {"lammps": "granular", "lammps-hooke": "gran/hooke/history"}


def time_lammps(scene, folder, style, skin, check, steps):
    out = output_of(
        "lmp", "-in", "in.scene", "-log", "none",
        "-var", "style", style, "-var", "skin", skin, "-var", "check", check, "-var", "steps", steps, cwd=folder,
    )  # fmt: skip
    seconds = float(re.findall(r"Loop time of (\S+)", out)[-1])
    ends = re.search(rf"^\s*{check}\s+(\d+)\s*$", out, re.MULTILINE)
    return {
        "dt": scene["dt"],
        "us_per_step": 1e6 * seconds / steps,
        "contacts": int(ends[1]) // 2,
        "kinetic_energy": kinetic_energy(scene, folder / "check.dump"),
        "differs": LAMMPS_DIFFERS + ([] if style == "granular" else ["normal damping by mass"]),
        "skin": skin,
    }


def available(engine):
    program = "lmp" if engine in LAMMPS_STYLES else {"yade": "yade"}.get(engine)
    if program and not shutil.which(program):
        print(f"{engine} left out: no program {program}", file=sys.stderr)
        return False
    return True


def measure(options, engines, folder):
    """The fastest round of each engine, and all times."""
    tool = options.build / "tests" / "bench" / "engine_steps"
    scene = json.loads(output_of(tool, options.case))
    lammps_input.write(scene, folder)
    best, times = {}, {engine: [] for engine in engines}
    for number in range(options.rounds):
        for engine in engines:
            if engine in LAMMPS_STYLES:
                style = LAMMPS_STYLES[engine]
                runs = [
                    time_lammps(scene, folder, style, skin, options.check, options.steps)
                    for skin in SKINS
                ]
            else:
                runs = [
                    json.loads(output_of(tool, options.case, engine, options.check, options.steps))
                ]
            fastest = min(runs, key=lambda run: run["us_per_step"])
            times[engine].append(fastest["us_per_step"])
            if engine not in best or fastest["us_per_step"] < best[engine]["us_per_step"]:
                best[engine] = fastest
        print(f"round {number + 1} of {options.rounds} done", file=sys.stderr)
    return best, times


def print_table(best, times):
    reference = best["grain"]
    columns = "{:<15}{:>8}{:>10}{:>8}{:>10}{:>12}{:>10}{:>12}  {}"
    print(columns.format("engine", "dt [us]", "us/step", "spread", "per step", "per second", "contacts",
                         "E_kin [uJ]", "differs from the case in"))  # fmt: skip
    for engine, run in best.items():
        step = run["us_per_step"] / reference["us_per_step"]
        spread = max(times[engine]) / min(times[engine]) - 1.0
        differs = ", ".join(dict.fromkeys(run["differs"])) or "-"
        if "skin" in run:
            differs += f"; skin {run['skin']:g} m"
        print(columns.format(
            engine, f"{1e6 * run['dt']:g}", f"{run['us_per_step']:.1f}", f"{spread:.0%}",
            f"{step:.2f}", f"{step * reference['dt'] / run['dt']:.2f}", run["contacts"],
            f"{1e6 * run['kinetic_energy']:.2f}", differs,
        ))  # fmt: skip
    print(
        "\nper step, per second: time relative to grain, for one step of each engine's own dt and for a"
        "\nsecond of the scene. spread: slowest round over the fastest. contacts and E_kin: at the check."
    )


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--case", default=ROOT / "cases" / "couette" / "nu-0.804.toml")
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build" / "release")
    parser.add_argument("--engines", default="grain,lammps,lammps-hooke,yade,box2d-penalty,box2d-impulse",
                        help="grain is always among them")  # fmt: skip
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--check", type=int, default=2000)
    parser.add_argument("--steps", type=int, default=5000)
    parser.add_argument("--json", type=pathlib.Path, help="also write the figures to this file")
    options = parser.parse_args()
    engines = ["grain"] + [name for name in options.engines.split(",") if name != "grain"]
    engines = [engine for engine in engines if available(engine)]
    with tempfile.TemporaryDirectory() as folder:
        best, times = measure(options, engines, pathlib.Path(folder))
    print_table(best, times)
    if options.json:
        options.json.write_text(json.dumps({"best": best, "us_per_step": times}, indent=1) + "\n")


if __name__ == "__main__":
    main()
