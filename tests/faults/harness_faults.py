#!/usr/bin/env python3
"""Runs the harness with faults of its own on the right engine, and its own tests on those faults: README.md.

    harness_faults.py --programs build/full/tests/faults --out out/trust
"""

import argparse
import csv
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import tomllib

import planted_faults
import reading

tests = {"averaging": "planted_averaging_tests", "oracle": "planted_oracle_tests"}
independent = planted_faults.project / "tests/system/independent_averages.py"
sound = 1e-10  # of a field's largest value, as in tests/system/test_average.py
seconds = 300


def own_tests(options, fault, environment):
    """The tests of the part that is at fault. @returns names of those that fail"""
    done = subprocess.run([options.programs / tests[fault["part"]], "--gtest_brief=1"], env=environment, cwd=planted_faults.project,
                          capture_output=True, text=True, timeout=seconds)
    return sorted(set(re.findall(r"^\[  FAILED  \] (\S+?)(?:,| \(|$)", done.stdout, re.M)))


def independent_check(options, environment):
    """Fields that another program makes otherwise of the snapshots that a run kept."""
    out = options.out / "run"
    shutil.rmtree(out, ignore_errors=True)
    subprocess.run([options.programs / "planted_crossgrain", "compare", "cases/couette/quick.toml", "--engines", "grain", "--quick",
                    "--set=run.mirrors=false", "--set=averaging.rotations=0.05", "--set=run.keep_snapshots=100000", "--quiet",
                    "--out", out], env=environment, cwd=planted_faults.project, capture_output=True, timeout=seconds)
    done = subprocess.run(["/usr/bin/python3", independent, out / "snapshots/grain-p0.h5", out / "results.json"],
                          capture_output=True, text=True, check=True, timeout=seconds)
    return sorted(field for field, worst in json.loads(done.stdout)["worst"].items() if not worst <= sound)


def command(options, name, spec, engine, environment):
    """@returns status, results, what was written to stderr"""
    out = options.out / "run"
    shutil.rmtree(out, ignore_errors=True)
    words = [word.format(engine=engine) for word in spec["arguments"]]
    done = subprocess.run([options.programs / "planted_crossgrain", name, *words, "--quiet", "--out", out], env=environment,
                          cwd=planted_faults.project, capture_output=True, text=True, timeout=seconds)
    path = out / "results.json"
    return done.returncode, json.loads(path.read_text()) if path.exists() else {}, done.stderr


def rows_of(options, fault, commands, engine):
    environment = os.environ | fault["environment"]

    def row(check, run):
        began = time.monotonic()
        found, blame, named, sentence = run()
        return {"fault": fault["name"], "what": fault["what"], "check": check, "found": "yes" if found else "no",
                "seconds": round(time.monotonic() - began, 1), "put_down_to": blame, "named": named, "sentence": sentence}

    def by_tests():
        failed = own_tests(options, fault, environment)
        rightly = any(re.search(fault["tests"], name) for name in failed)
        return failed, fault["part"] if failed else "", "rightly" if rightly else "", ", ".join(failed)

    def by_another_program():
        fields = independent_check(options, environment)
        return fields, "averaging" if fields else "", "rightly" if fields else "", ", ".join(fields)

    def by(name):
        status, results, errors = command(options, name, commands[name], engine, environment)
        found = reading.found(status)
        return (found, reading.blame(name, status, results, "right") if found else "", "",
                reading.sentence(name, results, "right", errors) if found else "")

    yield row("own tests", by_tests)
    if fault["part"] == "averaging":
        yield row("independent averages", by_another_program)
    for name in ("compare",) if fault["part"] == "averaging" else ("collide", "conformance", "stability"):
        yield row(name, lambda name=name: by(name))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", type=pathlib.Path, required=True, help="folder of planted_crossgrain and the planted tests")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--only", default="", help="faults whose names this regular expression matches, and the control")
    parser.add_argument("--require", action="store_true", help="status 1 unless own tests find all, and nothing where nothing is planted")
    options = parser.parse_args()
    options.programs, options.out = options.programs.resolve(), options.out.resolve()
    (options.out / "engines").mkdir(parents=True, exist_ok=True)
    commands = tomllib.loads((planted_faults.here / "commands.toml").read_text())
    faults = tomllib.loads((planted_faults.here / "faults.toml").read_text())["harness_fault"]
    chosen = [fault for fault in faults if re.search(options.only, fault["name"])]
    controls = [{"name": f"none_in_{part}", "part": part, "environment": {}, "what": f"{part}: nothing, the control", "tests": "never"}
                for part in sorted({fault["part"] for fault in chosen})]
    engine = planted_faults.engine_file(options.out / "engines" / "right.toml", options.programs / "planted_engine", planted_faults.control, "right")
    rows = []
    for fault in [*controls, *chosen]:
        for row in rows_of(options, fault, commands, engine):
            rows.append(row)
            print(f"{row['fault']:<24} {row['check']:<21} {row['found']:<4} {row['seconds']:>6} s  {row['sentence'][:90]}", flush=True)
    with (options.out / "harness.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    if not options.require:
        return 0
    own = {row["fault"] for row in rows if row["found"] == "yes" and row["put_down_to"] == fault_part(faults, row["fault"])}
    missed = [fault["name"] for fault in chosen if fault["name"] not in own]
    accused = [row["fault"] for row in rows if row["fault"].startswith("none_in_") and row["found"] == "yes"]
    for name in missed:
        print(f"not found by the harness' own tests: {name}")
    for name in accused:
        print(f"found though nothing was planted: {name}")
    return 1 if missed or accused else 0


def fault_part(faults, name):
    return next((fault["part"] for fault in faults if fault["name"] == name), None)


if __name__ == "__main__":
    sys.exit(main())
