#!/usr/bin/env python3
"""Reads a million generated inputs of each kind, some thousands at a time: README.md.

    shards.py --inputs …/fuzz_input_tests --messages …/fuzz_tests --out out/fuzz --minutes 60
"""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
# Inputs of a shard: about half a minute in a build with sanitizers. Of recordings a shard reads a tenth as many.
kinds = {
    "cases": ("inputs", "FuzzedInput.CasesLoadOrAreRefusedInOneLine", 10000),
    "packings": ("inputs", "FuzzedInput.PackingsAreSoundOrRefusedInOneLine", 2000),
    "starts": ("inputs", "FuzzedInput.StartsAreSoundOrRefusedInOneLine", 10000),
    "results": ("inputs", "FuzzedInput.ResultsAreReadOrRefusedInOneLine", 10000),
    "answers": ("messages", "Hostile.AnswersAreAValueOrOneLine", 20000),
    "recordings": ("messages", "Hostile.RecordingsAreExchangesOrBadInput", 200000),
}


def read_shard(program, test, first, count, folder):
    """@returns what was said if it failed. The folder has the last input that was written then."""
    environment = os.environ | {"CROSSGRAIN_FUZZ_FROM": str(first), "CROSSGRAIN_FUZZ": str(count), "TMPDIR": str(folder),
                                "ASAN_OPTIONS": f"allocator_may_return_null=1:detect_leaks=1:suppressions={HERE / 'asan_suppressions.txt'}",
                                "LSAN_OPTIONS": f"suppressions={HERE / 'lsan_suppressions.txt'}:print_suppressions=0",
                                "UBSAN_OPTIONS": "print_stacktrace=1"}
    folder.mkdir(parents=True)
    try:
        done = subprocess.run([program, f"--gtest_filter={test}", "--gtest_brief=1"], env=environment, capture_output=True, text=True,
                              errors="replace", timeout=3600)
    except subprocess.TimeoutExpired:
        return "hangs: an hour was not enough"
    if done.returncode != 0 or "[  PASSED  ] 1 test" not in done.stdout:
        return (done.stdout + done.stderr)[-4000:]
    shutil.rmtree(folder)
    return ""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--inputs", type=pathlib.Path, required=True, help="the program fuzz_input_tests")
    parser.add_argument("--messages", type=pathlib.Path, required=True, help="the program fuzz_tests")
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
        total = sum(int(count) for name, _, count in lines if name == kind) // (10 if kind == "recordings" else 1)
        print(f"{kind}: {total} read, none wrongly")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
