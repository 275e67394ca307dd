"""Golden folders: what every command finds out, kept in a folder each beside this file.

A redesign changes none of them. Whoever changes one on purpose says why in the commit and in changes/.

    CROSSGRAIN=build/release/cli/crossgrain python3 golden.py check [NAME …]   compares; status 1 where anything differs
    CROSSGRAIN=build/release/cli/crossgrain python3 golden.py make  [NAME …]   writes the folders anew

A file of a folder stands for results.json or for a CSV file of the run. It is text, a number or a row a line, without
what depends on the time of day, on the machine or on how long anything took. A file above MOST_TEXT is kept as digests
instead, one of each group of its lines, as fine as MOST_GROUPS allows: `golden.py make --to DIR NAME` writes every line,
so that the program before and after shows which numbers changed.

The processor must not have a say: the in-house engine and the C library are limited to instructions that every x86-64
machine has. The compiler and the C library have one, so the folders are of Debian 12.
"""

import csv
import hashlib
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
# Where the program runs, so that messages name files alike wherever the sources are.
ROOT = HERE.parents[1]
MOST_TEXT = 12_000  # bytes
MOST_GROUPS = 24

BASELINE = {
    "COLUMNS": "1000",  # no sentence is broken
    "GRAIN_INSTRUCTIONS": "baseline",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX2_Usable,-FMA_Usable,-FMA4_Usable",
}
# Without YADE, LAMMPS and others, whose bits are their packages'.
BUILT_IN = "grain,box2d-penalty,box2d-impulse"
CELL = "cases/couette/quick.toml"
SHORT = ["--set=averaging.rings=4", "--set=averaging.rotations=0.05", "--set=preparation.packings=2"]

# name → commands, of which the last one is kept; {out} is its folder, {first} that of the first.
COMMANDS = {
    "compare": ["compare {cell} --engines grain --set=preparation.packings=2 --out {out}"],
    "compare-engines": ["compare {cell} --engines {built_in} --out {out} {short}"],
    "compare-assembly": ["compare cases/assembly/pile.toml --engines grain,box2d-penalty --quick --out {out}"],
    "compare-closed-form": ["compare cases/assembly/squeeze.toml --engines grain,box2d-penalty --out {out}"],
    "collide": ["collide cases/collision --engines {built_in} --out {out}"],
    "collide-external": ["collide cases/collision/figure-4-3.toml --engines examples/python/engine.toml --out {out}"],
    "lockstep": ["lockstep {cell} --engines {built_in} --quick --out {out}"],
    "effects": ["effects {cell} --engines grain --quick --out {out} --set=averaging.rings=4"],
    "stability": ["stability cases/hard --engines {built_in} --quick --out {out}"],
    "transforms": ["stability --transforms {cell} --engines grain --out {out} {short}"],
    "cost": [
        'cost cases/cost/quick.toml --engines grain --quick --out {out} --set=cost.knobs=["time_step","integrator","precision"]'
    ],
    "average": [
        "compare {cell} --engines grain --out {first} --set=run.keep_snapshots=5 {short}",
        "average {first}/snapshots/grain-p0.h5 {cell} --set=averaging.rings=4 --out {out}",
    ],
    "average-assembly": [
        "compare cases/assembly/biaxial.toml --engines grain --quick --out {first} --set=run.keep_snapshots_of=2",
        "average {first}/snapshots/grain-p0.h5 {first}/snapshots/grain-p1.h5 cases/assembly/biaxial.toml --out {out}",
    ],
    "import": [
        "import lammps tests/studies/import/box-atoms.dump tests/studies/import/box-pairs.dump examples/import/box.toml"
        " --name my-lammps --out {first}.h5",
        "average {first}.h5 examples/import/box.toml --out {out}",
    ],
    "rev": [
        "compare {cell} --engines grain --out {first} --set=run.keep_snapshots=5 {short}",
        "average {first}/snapshots/grain-p0.h5 {cell} --rev --set=averaging.rings=4 --out {out}",
    ],
    "conformance": ["conformance box2d-penalty --out {out}"],
    "conformance-external": ["conformance examples/python/engine.toml -k Wall --out {out}"],
    "diff": [
        "baseline {cell} --engines grain --quick --out {first}.h5",
        "diff {first}.h5 --engines grain --set=law.integrator=velocity_verlet --json",
    ],
    "diff-collision": [
        "baseline cases/collision/figure-4-3.toml --engines grain --out {first}.h5",
        "diff {first}.h5 --engines grain --set=law.mu=0.3 --json",
    ],
    "replay": [
        "record cases/hard/pile.toml --engines grain --time 0.02 --out {first}.rec",
        "replay {first}.rec --engines box2d-penalty --json",
    ],
    "identify": ["identify {cell} --engines box2d-penalty"],
    "engines": ["engines --json"],
    "check": ["check {cell} --engines {built_in}"],
    "calibrate": ["calibrate --en 0.6 --tc 1e-3 --mass 1e-3 --radius 1e-3"],
}
# Members that depend on this run and machine; "stats" and "contacts_per_step" count steps of a timed
# length, "overview" repeats times.
TRANSIENT = {
    "elapsed_s", "started", "command", "version", "program", "build", "machine", "file", "stats", "wall_s", "cpu_s", "overview",
    "time_ratio", "time_ratio_stderr", "step_s", "spread", "strong", "weak", "ratio", "memory_bytes", "bytes_per_disk",
    "ns_per_disk", "steps", "repetitions", "predicted_s", "on_front", "cores", "timings", "best_s", "advice", "fronts",
    "measured", "cells", "tied", "time_low_s", "time_high_s", "cheapest", "startup", "contacts_per_step", "from_cache",
}  # fmt: skip
# Members that name an item of a list.
NAMES = ("name", "id", "case", "engine", "variant", "packing", "measure", "quantity")


def leaves(value, path=""):
    """(path, text) of every number and text of a JSON document."""
    if isinstance(value, dict):
        for key in sorted(value.keys() - TRANSIENT):
            yield from leaves(value[key], f"{path}/{key}")
        if not value:
            yield path, "{}"
    elif isinstance(value, list) and any(isinstance(item, (dict, list)) for item in value):
        for index, item in enumerate(value):
            named = [str(item[key]) for key in NAMES if isinstance(item, dict) and isinstance(item.get(key), (str, int))]
            yield from leaves(item, f"{path}/{index} {' '.join(named)}".rstrip())
    else:
        yield path, json.dumps(value)


def rows(text):
    """(first cells, line) of every row of a CSV file."""
    table = list(csv.reader(io.StringIO(text)))
    lasting_columns = [index for index, column in enumerate(table[0]) if column not in TRANSIENT]
    for row in table:
        cells = [row[index] for index in lasting_columns]
        yield cells[:2], ",".join(cells)


def lasting(file, folder):
    """(parts of its name, line) of every line of a file of a run."""
    text = file.read_text(encoding="utf-8").replace(str(folder), "FOLDER").replace(str(ROOT), "ROOT")
    if file.suffix == ".csv":
        return list(rows(text))
    if file.suffix == ".json":
        document = json.loads(text)
        if isinstance(document, list):  # of engines: others are installed here, and not there
            document = [item for item in document if item["name"] in BUILT_IN.split(",")]
        return [(path.split("/")[1:4], f"{path} {value}") for path, value in leaves(document)]
    return [([line], line) for line in text.splitlines() if " a step:" not in line and "predicted time of" not in line]


def kept(lines):
    """The lines themselves, or where they are many a digest and the number of those whose names begin alike."""
    if sum(len(line) for _, line in lines) <= MOST_TEXT:
        return [line for _, line in lines]
    for depth in (3, 2, 1):
        groups = {}
        for parts, line in lines:
            groups.setdefault("/".join(parts[:depth]), []).append(line + "\n")
        if len(groups) <= MOST_GROUPS:
            break
    return [
        f"{hashlib.sha256(''.join(group).encode()).hexdigest()[:12]} {len(group)} {name}" for name, group in groups.items()
    ]


def run(name, folder):
    """Runs the commands of that name. @returns named lines by file name"""
    out, first = folder / "out", folder / "first"
    names = {"out": out, "first": first, "cell": CELL, "built_in": BUILT_IN, "short": " ".join(SHORT)}
    env = os.environ | BASELINE | {"NO_COLOR": "1"}
    # Packings that other instructions prepared have other bits.
    env["CROSSGRAIN_CACHE"] = str(pathlib.Path(env.get("CROSSGRAIN_CACHE", tempfile.gettempdir())) / "golden")
    # Examples say "python3": the one that runs this has what they need.
    env["PATH"] = f"{pathlib.Path(sys.executable).parent}:{env['PATH']}"
    for command in COMMANDS[name]:
        done = subprocess.run(
            [os.environ["CROSSGRAIN"], *command.format(**names).split()],
            cwd=ROOT, env=env, capture_output=True, encoding="utf-8", check=False,
        )  # fmt: skip
        if done.returncode not in (0, 1):
            raise AssertionError(f"{command}: status {done.returncode}\n{done.stderr}")
    if out.is_dir():
        files = [file for file in sorted(out.iterdir()) if file.suffix in (".csv", ".json", ".toml")]
        found = {file.name: lasting(file, folder) for file in files}
    else:
        file = folder / ("stdout.json" if done.stdout.startswith(("{", "[")) else "stdout.txt")
        file.write_text(done.stdout, encoding="utf-8")
        found = {file.name: lasting(file, folder)}
    return found | {"status": [([], str(done.returncode))]}


def differences(name):
    """What is otherwise than kept, a line each."""
    written = {
        file.name.removesuffix(".txt"): file.read_text(encoding="utf-8").splitlines()
        for file in (HERE / name).iterdir()
    }
    with tempfile.TemporaryDirectory(prefix="crossgrain-golden-") as folder:
        found = run(name, pathlib.Path(folder))
    for file in sorted(written.keys() | found.keys()):
        before, after = written.get(file, []), kept(found.get(file, []))
        if before == after:
            continue
        yield from (f"{name}/{file}: - {line}" for line in before if line not in set(after))
        yield from (f"{name}/{file}: + {line}" for line in after if line not in set(before))
        if sorted(before) == sorted(after):
            yield f"{name}/{file}: same lines, another order"


def make(name, to):
    with tempfile.TemporaryDirectory(prefix="crossgrain-golden-") as folder:
        found = run(name, pathlib.Path(folder))
    (to / name).mkdir(parents=True, exist_ok=True)
    for old in (to / name).iterdir():
        old.unlink()
    for file, lines in found.items():
        text = kept(lines) if to == HERE else [line for _, line in lines]
        (to / name / f"{file}.txt").write_text("\n".join(text) + "\n", encoding="utf-8")


def main(arguments):
    what, *names = arguments
    if what == "names":
        print(*COMMANDS)
        return 0
    to = HERE
    if "--to" in names:
        at = names.index("--to")
        to = pathlib.Path(names[at + 1])
        del names[at : at + 2]
    different = 0
    for name in names or COMMANDS:
        if what == "make":
            make(name, to)
            continue
        found = list(differences(name))
        different += bool(found)
        print(f"{name}: {'same' if not found else f'{len(found)} lines differ'}", flush=True)
        print(*(f"  {line[:300]}" for line in found[:20]), sep="\n", end="\n" if found else "")
    return int(different > 0)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
