#!/usr/bin/env python3
"""Whether lockstep's verdicts turn when more is measured: engines x scenes x 8, 16, 32, 64 starts x time steps.

    tests/coverage/lockstep_verdicts.py --crossgrain build/release/cli/crossgrain --out out/verdicts --starts 64 \\
        --scenes cases/couette/quick.toml,cases/assembly/hopper.toml --engines yade,lammps --steps 1,0.5

One run holds the verdicts of fewer starts: those of every second, fourth and eighth start, which lie along the flow
as a run of that many has them. `--steps` are factors of the case's own time step. Finished runs are kept in OUT.
An engine with a = in it is words for --program, "declares=1 lagged=1" for tests/faults/engine.
Status 1 where a verdict turns into its opposite, from same to differs or back."""

import argparse
import json
import math
import pathlib
import re
import subprocess
import sys

SAME = {"same_to_rounding", "same_to_its_precision", "same_law"}
LEAST_READ, CONFIDENCE = 4, 0.95


def at_least(x, n, share):
    """Chance of x or more of n."""
    return sum(math.comb(n, k) * share**k * (1.0 - share) ** (n - k) for k in range(x, n + 1))


def verdict(row, readings, rules):
    """The rule of studies/lockstep/account.cpp on some of the starts; main() compares it with the program's own on all of them."""
    if row["verdict"] in ("not_measured", "same_to_rounding"):
        return row["verdict"]
    read = sum(reading["until_s"] > 0.0 for reading in readings)
    beyond = sum(reading["beyond"] for reading in readings)
    if beyond and at_least(beyond, read, rules["stray_share"]) < 1.0 - CONFIDENCE:
        return "differs"
    if row["verdict"] == "same_to_its_precision" and not beyond:
        return row["verdict"]
    if read < min(LEAST_READ, len(readings)):
        return "undecided"
    # With none beyond no share is excluded; else the exact upper bound has to lie below it.
    small = 1.0 - at_least(beyond + 1, read, rules["stray_share"]) < 1.0 - CONFIDENCE
    return "same_law" if beyond == 0 or small else "undecided"


def step_of(crossgrain, scene, engine):
    """The step that an engine runs the case with [s]: its own of the case's [engines], or the case's."""
    checked = subprocess.run(
        [crossgrain, "check", scene, "--engines", engine, "--json", "--no-timing"], capture_output=True, text=True, check=False
    )
    known = checked.returncode == 0 and json.loads(checked.stdout)[0]
    rows = [row for row in known["engines"] if row["name"] == engine and row.get("dt_s")] if known else []
    return rows[0]["dt_s"] if rows else known and known["dt_s"]


def engine_file(arguments, words):
    """The engine's file, of words for the program."""
    name = re.sub("[^a-z0-9]+", "-", words)
    path = arguments.out / "engines" / f"{name}.toml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'name = "{name}"\ncommand = {json.dumps([str(arguments.program.resolve()), *words.split()])}\n', encoding="utf-8")
    return path


def row_of(arguments, scene, engine, factor):
    """A row of lockstep's results and the rules that it was judged by."""
    given = engine_file(arguments, engine) if "=" in engine else engine
    out = arguments.out / f"{scene.stem}-{pathlib.Path(given).stem}-{factor:g}"
    dt = step_of(arguments.crossgrain, scene, given)
    settings = []
    if factor != 1.0 and dt:
        settings = ["--set", f"run.dt={factor * dt:.6g}"]
        if given == engine:
            settings += ["--set", f"engines.{engine}.dt={factor * dt:.6g}"]
    done = subprocess.run(
        [arguments.crossgrain, "lockstep", scene, "--engines", given, "--starts", str(arguments.starts), "--quiet", "--out", out,
         *settings],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    file = out / "results.json"
    if file.exists() and done.returncode in (0, 1, 3):
        results = json.loads(file.read_text(encoding="utf-8"))
        row, rules = results["lockstep"]["rows"][0], results["lockstep"]["rules"]
    else:
        reason = (done.stderr.strip().splitlines() or ["failed"])[-1].removeprefix("crossgrain: ")
        row, rules = {"verdict": "not_measured", "reason": reason, "readings": []}, {}
    dt = row["realised"]["dt"] if row.get("realised") else dt and factor * dt
    print(f"{scene.stem} {engine} {factor:g}: {row['verdict']}", file=sys.stderr)
    return dt, row, rules


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--crossgrain", required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--scenes", required=True)
    parser.add_argument("--engines", required=True)
    parser.add_argument("--program", type=pathlib.Path, help="of engines that are words")
    parser.add_argument("--starts", type=int, default=64)
    parser.add_argument("--halved", type=int, default=3, help="how many times fewer starts are counted, by half each")
    parser.add_argument("--steps", default="1,0.5")
    arguments = parser.parse_args()
    counts = [arguments.starts // 2**part for part in range(arguments.halved, -1, -1)]
    print("| scene | dt [s] | engine | " + " | ".join(f"{count}" for count in counts) + " | read, beyond | ε_eq (95 %) |")
    print("|---" * (5 + len(counts)) + "|")
    turned = 0
    for scene in map(pathlib.Path, arguments.scenes.split(",")):
        for factor in map(float, arguments.steps.split(",")):
            for engine in arguments.engines.split(","):
                dt, row, rules = row_of(arguments, scene, engine, factor)
                readings = row["readings"]
                verdicts = [verdict(row, readings[:: max(1, len(readings) // count)], rules) for count in counts]
                if verdicts[-1] != row["verdict"]:
                    sys.exit(f"{scene} {engine}: the rule here says {verdicts[-1]}, the program {row['verdict']}")
                turned += bool(SAME & set(verdicts)) and "differs" in verdicts
                known = [row.get(key) for key in ("equivalent", "equivalent_low", "equivalent_high")]
                size = "–" if known[0] is None else "{:.2g} ({:.2g} to {:.2g})".format(*known)
                read = f"{row['read']}, {row['beyond']}" if readings else row["reason"]
                words = " | ".join(each.replace("_", " ") for each in verdicts)
                print(f"| {scene.stem} | {dt or 0.0:.3g} | `{engine}` | {words} | {read} | {size} |", flush=True)
    print(f"{turned} of the rows turn into the opposite.", file=sys.stderr)
    return int(turned > 0)


if __name__ == "__main__":
    sys.exit(main())
