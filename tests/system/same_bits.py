"""Fingerprints of what the three main commands find out, kept in same_bits.json.

A redesign must not change a bit of them. What changes them on purpose says so in CHANGELOG.md and
renews the file:  CROSSGRAIN=build/release/cli/crossgrain python3 same_bits.py   (in this folder)

The processor must not have a say: the engine and the C library are held to instructions that every
x86-64 machine has. The compiler and the C library have one, so the fingerprints are Debian 12's.
"""

import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
KEPT = HERE / "same_bits.json"
# Where the program runs, so that reasons name files alike wherever the sources are.
ROOT = HERE.parents[1]

BASELINE = {
    "GRAIN_INSTRUCTIONS": "baseline",
    "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX2_Usable,-FMA_Usable,-FMA4_Usable",
}
# Without YADE, whose bits are its package's, and mirrors, which are grain.
ENGINES = "grain,box2d-penalty,box2d-impulse"
COMMANDS = {
    "compare": ["compare", "cases/couette/quick.toml", "--engines", "grain", "--set=preparation.packings=2"],
    "collide": ["collide", "cases/collision", "--engines", ENGINES],
    "stability": ["stability", "cases/hard", "--engines", ENGINES, "--quick"],
}
# What a list's items are called by.
NAMES = ("name", "id", "case", "engine", "variant", "packing", "measure", "quantity")
# What tells of this run and machine, not of the physics; `stats` counts lists that are tuned by time, `overview` has times
# and says again what the rest does.
TRANSIENT = ("elapsed_s", "started", "command", "version", "build", "machine", "file", "stats", "wall_s", "cpu_s", "overview")


def lasting(value):
    """Without what tells of this run and machine."""
    if isinstance(value, dict):
        return {key: lasting(item) for key, item in value.items() if key not in TRANSIENT}
    return [lasting(item) for item in value] if isinstance(value, list) else value


def label(item, index):
    named = [str(item[key]) for key in NAMES if isinstance(item.get(key), (str, int))]
    return " ".join(named) if named else str(index)


def fingerprints(results):
    """By what a reader of a failure wants to know: 'cases/elastic/grain' → fingerprint."""
    found = {}

    def add(name, value):
        text = json.dumps(value, sort_keys=True, separators=(",", ":"))
        assert name not in found, name
        found[name] = hashlib.sha256(text.encode()).hexdigest()[:12]

    for key, value in lasting(results).items():
        items = value if isinstance(value, list) else None
        if items and all(isinstance(item, dict) for item in items):
            for index, item in enumerate(items):
                add(f"{key}/{label(item, index)}", item)
        else:
            add(key, value)
    return found


def run(command, cache):
    """The fingerprints of one of COMMANDS."""
    with tempfile.TemporaryDirectory(prefix="crossgrain-bits-") as folder:
        done = subprocess.run(
            [os.environ["CROSSGRAIN"], *COMMANDS[command], "--out", folder, "--quiet"],
            cwd=ROOT, env=os.environ | BASELINE | {"CROSSGRAIN_CACHE": str(cache)},
            capture_output=True, encoding="utf-8", check=False,
        )  # fmt: skip
        if done.returncode not in (0, 1):
            raise AssertionError(f"{command}: status {done.returncode}\n{done.stderr}")
        return fingerprints(json.loads((pathlib.Path(folder) / "results.json").read_text()))


def main():
    with tempfile.TemporaryDirectory(prefix="crossgrain-bits-") as cache:
        found = {command: run(command, cache) for command in COMMANDS}
    KEPT.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    print({command: len(of) for command, of in found.items()}, file=sys.stderr)


if __name__ == "__main__":
    main()
