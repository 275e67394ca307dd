#!/usr/bin/env python3
"""Reads a million generated inputs of each kind, some thousands at a time: README.md.

    shards.py --inputs …/fuzz_input_tests --messages …/fuzz_tests --reports …/fuzz_report_tests --files …/fuzz_files_tests --out out/fuzz --minutes 60
"""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

# Inputs of a shard: some ten seconds of CPU time in a build with sanitizers.
kinds = {
    "cases": ("inputs", "FuzzedInput.CasesLoadOrAreRefusedInOneLine", 10000),
    "packings": ("inputs", "FuzzedInput.PackingsAreSoundOrRefusedInOneLine", 1000),
    "starts": ("inputs", "FuzzedInput.StartsAreSoundOrRefusedInOneLine", 10000),
    "results": ("inputs", "FuzzedInput.ResultsAreReadOrRefusedInOneLine", 10000),
    "texts": ("reports", "HostileResults.RunNothingAndStayWithinTheirQuotes", 200),
    "reports": ("reports", "HostileResults.AreReportsOrRefusedInOneLine", 200),
    "files-mercurydpm": ("files", "DamagedFiles.MercuryDpm", 20000),
    "files-lammps": ("files", "DamagedFiles.Lammps", 20000),
    "files-yade-text": ("files", "DamagedFiles.YadeText", 20000),
    "files-vtk": ("files", "DamagedFiles.Vtk", 20000),
    "files-csv": ("files", "DamagedFiles.Csv", 20000),
    "files-ondem": ("files", "DamagedFiles.OnDem", 1000),
    "answers": ("messages", "Hostile.AnswersAreAValueOrOneLine", 20000),
}
# Inputs are written before they are read: to memory, where there is a folder of that.
MEMORY = pathlib.Path("/dev/shm")


def read_shard(program, test, first, count, kept):
    """@param kept  folder that has the last input that was written, if it failed
    @returns what was said then"""
    with tempfile.TemporaryDirectory(prefix="crossgrain-fuzz-", dir=MEMORY if os.access(MEMORY, os.W_OK) else None) as folder:
        said = run(program, test, first, count, folder)
        if said:
            shutil.copytree(folder, kept, dirs_exist_ok=True)
        return said


def run(program, test, first, count, folder):
    environment = os.environ | {"CROSSGRAIN_FUZZ_FROM": str(first), "CROSSGRAIN_FUZZ": str(count), "TMPDIR": folder,
                                "UBSAN_OPTIONS": "print_stacktrace=1"}
    try:
        done = subprocess.run([program, f"--gtest_filter={test}", "--gtest_brief=1"], env=environment, capture_output=True, text=True,
                              errors="replace", timeout=3600)
    except subprocess.TimeoutExpired:
        return "hangs: an hour was not enough"
    if done.returncode != 0 or "[  PASSED  ] 1 test" not in done.stdout:
        return (done.stdout + done.stderr)[-4000:]
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--inputs", type=pathlib.Path, required=True, help="the program fuzz_input_tests")
    parser.add_argument("--messages", type=pathlib.Path, required=True, help="the program fuzz_tests")
    parser.add_argument("--reports", type=pathlib.Path, required=True, help="the program fuzz_report_tests")
    parser.add_argument("--files", type=pathlib.Path, required=True, help="the program fuzz_files_tests")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="which shards have been read; what is there is gone on with")
    parser.add_argument("--all", type=int, default=1000000, help="inputs of each kind")
    parser.add_argument("--kinds", default=",".join(kinds))
    parser.add_argument("--minutes", type=float, default=float("inf"), help="no shard is begun later")
    options = parser.parse_args()
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    read = out / "read.txt"  # a line for each shard: kind, first input, how many
    before = {tuple(line.split()) for line in read.read_text().splitlines()} if read.exists() else set()
    began, failures = time.monotonic(), 0
    # All kinds come forward alike.
    shards = sorted((first / options.all, kind, first) for kind in options.kinds.split(",") for first in range(0, options.all, kinds[kind][2]))
    for _, kind, first in shards:
        program, test, count = kinds[kind]
        shard = (kind, str(first), str(min(count, options.all - first)))
        if shard in before:
            continue
        if time.monotonic() - began > 60 * options.minutes:
            break
        folder = out / f"{kind}-{first}"
        shutil.rmtree(folder, ignore_errors=True)
        said = read_shard(vars(options)[program].resolve(), test, first, int(shard[2]), folder)
        if said:
            failures += 1
            print(f"{kind}, from {first} on: {said}\nthe last input is in {folder}", flush=True)
            continue
        with read.open("a") as file:
            file.write(" ".join(shard) + "\n")
    lines = [line.split() for line in read.read_text().splitlines()] if read.exists() else []
    for kind in kinds:
        total = sum(int(count) for name, _, count in lines if name == kind)
        print(f"{kind}: {total} read, none wrongly")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
