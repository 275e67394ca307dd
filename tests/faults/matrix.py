#!/usr/bin/env python3
"""Which checks of `conformance` find which fault: runs all of them on the engines of matrix.toml and rewrites its `also`.

    matrix.py --crossgrain build/release/cli/crossgrain --build build/release --out out/matrix [--only '^kn'] [--jobs 2]

What has a record in OUT is not run again. `check` and `cause` are written by hand: the check that is for the fault, and a
regular expression of the cause that it names. tests/conformance/planted_test.cpp holds the checks to this file.
"""

import argparse
import concurrent.futures
import json
import pathlib
import re
import subprocess
import tomllib

here = pathlib.Path(__file__).resolve().parent
project = here.parent.parent
file = here / "matrix.toml"


def name_of(row):
    return f"{row['engine']} {row['fault']}"


def failed(results):
    return [row["check"] for row in results["checks"] if row["outcome"] in ("failed", "broke_down")]


def run(options, row, checks):
    """The checks that fail, from the record where there is one; None where it is not to be run."""
    kept = options.out / re.sub(r"[^\w.=-]+", "-", name_of(row))
    record = kept / "results.json"
    if not record.exists():
        if options.read:
            return None
        kept.mkdir(parents=True, exist_ok=True)
        command = json.dumps([str(options.build / "tests" / row["engine"]), *row["fault"].split()])
        engine = kept / "engine.toml"
        engine.write_text(f'name = "planted"\nsummary = "has a planted fault"\ncommand = {command}\n')
        subprocess.run([options.crossgrain, "conformance", engine, "-k", ",".join(checks), "--quiet", "--out", kept], cwd=project, capture_output=True, check=False)
    return failed(json.loads(record.read_text()))


def line_of(row):
    words = [f"{key} = {json.dumps(row[key], ensure_ascii=False)}" for key in ("check", "engine", "fault", "cause", "also") if key in row]
    return "  { " + ", ".join(words) + " },\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--crossgrain", type=pathlib.Path, required=True)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--only", default="", help="rows whose engine and fault this regular expression matches")
    parser.add_argument("--read", action="store_true", help="run nothing: take what has a record")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    options.crossgrain, options.build, options.out = (path.resolve() for path in (options.crossgrain, options.build, options.out))
    text = file.read_text()
    given = tomllib.loads(text)
    rows, names = given["faults"], {row["check"] for row in given["faults"]} | given["reasons"].keys()
    asked = [row for row in rows if re.search(options.only, name_of(row))]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for row, checks in zip(asked, pool.map(lambda row: run(options, row, names), asked), strict=True):
            if checks is None:
                continue
            if row["check"] not in checks:
                print(f"{name_of(row)}: {row['check']} does not fail")
            row["also"] = [check for check in checks if check != row["check"]]
    head, rest = text.split("faults = [\n")
    file.write_text(head + "faults = [\n" + "".join(map(line_of, rows)) + rest[rest.index("]\n\n[reasons]") :])


if __name__ == "__main__":
    main()
