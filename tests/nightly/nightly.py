#!/usr/bin/env python3
"""Builds targets that take hours, one after another, and keeps in BUILD/nightly.txt when and with which build of crossgrain
each passed last.

    nightly.py --build build/release --crossgrain build/release/cli/crossgrain [--only fuzz,endurance]

One that fails keeps the line of its last pass and stops none of the others; exit status 1 then.
"""

import argparse
import datetime
import hashlib
import pathlib
import shutil
import subprocess
import sys

# Targets, the shortest first, each with the folder of the build that is removed before, as it would go on from there. Judged mutants stay.
TARGETS = {
    "engine_examples": None,
    "all_declared_laws": None,
    "all_planted_causes": None,
    "one_definition": None,
    "planted_checks": None,
    "all_of_peers": None,
    "coverage_of_verdicts": "coverage",
    "fuzz": "tests/fuzz/shards",
    "false_alarms": "false_alarms",
    "planted_faults": "planted_faults",
    "endurance": "endurance",
    "mutation": None,
}


def passed(path):
    """Lines of the file by target."""
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return {line.split()[0]: line for line in lines}


def build_of(program):
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    return f"crossgrain {version}, sha256 {hashlib.sha256(program.read_bytes()).hexdigest()[:12]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--crossgrain", type=pathlib.Path, required=True)
    parser.add_argument("--only", default=",".join(TARGETS), help="some of them, separated by commas")
    options = parser.parse_args()
    table = options.build / "nightly.txt"
    failed = []
    for target in options.only.split(","):
        if TARGETS[target]:
            shutil.rmtree(options.build / TARGETS[target], ignore_errors=True)
        if subprocess.run(["cmake", "--build", options.build, "--target", target], check=False).returncode:
            failed.append(target)
        else:
            now = datetime.datetime.now().strftime("%Y-%m-%d %H:%M")
            lines = passed(table) | {target: f"{target:<21} {now}  {build_of(options.crossgrain)}"}
            table.write_text("\n".join(lines.values()) + "\n", encoding="utf-8")
    print(table.read_text(encoding="utf-8") if table.exists() else "", end="")
    print("".join(f"{target} failed\n" for target in failed), end="")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
