#!/usr/bin/env python3
"""Runs crossgrain's commands on engines with planted faults and writes what they found: README.md.

    planted_faults.py --crossgrain build/full/cli/crossgrain --engine build/full/tests/faults/planted_engine --out out/trust
"""

import argparse
import json
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import time
import tomllib

import reading
import table

here = pathlib.Path(__file__).resolve().parent
project = here.parent.parent
control = {"name": "right", "patch": {}, "what": "nothing: the control", "term": "never"}


def engine_file(folder, program, fault):
    patch = [f"{name}={value}" for name, value in fault["patch"].items()]
    words = ", ".join(json.dumps(word) for word in [str(program), *patch])
    path = folder / f"{fault['name']}.toml"
    path.write_text(f'name = "{fault["name"]}"\nsummary = {json.dumps(fault["what"])}\ncommand = [{words}]\n')
    return path


def results_of(kept):
    path = kept.with_suffix(".results.json")
    return json.loads(path.read_text()) if path.exists() else {}


def seconds_of_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(options, spec, seconds, fault, command, kept):
    """One command on one fault; keeps its status, its time and its results."""
    out = options.out / "run"
    shutil.rmtree(out, ignore_errors=True)
    engine = engine_file(options.out / "engines", options.engine, fault)
    words = [word.format(engine=engine, cell=fault.get("cell", ""), collision=fault.get("collision", "")) for word in spec]
    line = [str(options.crossgrain), command, *words, "--quiet", "--out", str(out)]
    began, cpu = time.monotonic(), seconds_of_children()
    try:
        done = subprocess.run(line, cwd=project, capture_output=True, text=True, timeout=seconds)
        status, errors = done.returncode, done.stderr
    except subprocess.TimeoutExpired:
        status, errors = None, f"crossgrain: not done within {seconds} s"
    took = round(time.monotonic() - began, 1)
    results = kept.with_suffix(".results.json")
    results.unlink(missing_ok=True)
    if (out / "results.json").exists():
        shutil.copy(out / "results.json", results)
    record = {"status": status, "seconds": took, "cpu_seconds": round(seconds_of_children() - cpu, 1), "errors": errors}
    kept.write_text(json.dumps(record, ensure_ascii=False, indent=1))


def judged(command, fault, kept, right, cpu):
    """What the kept results say. @param right  of `cost`: accuracies that the right engine reaches; cpu: which seconds"""
    ran = json.loads(kept.read_text())
    results, name = results_of(kept), fault["name"]
    record = {"fault": name, "command": command, "status": ran["status"], "seconds": ran["cpu_seconds" if cpu else "seconds"],
              "version": results.get("version", ""), "found": reading.found(ran["status"])}
    lost = right - reading.good_columns(results, name) if command == "cost" and ran["status"] == 0 else set()
    record["found"] = record["found"] or bool(lost)
    record["blame"] = reading.blame(command, ran["status"], results, name)
    record["named"] = reading.named(command, results, name, fault, ran["errors"]) if record["found"] else ""
    record["term"] = reading.term_of(command, results, name)
    if lost:
        record["sentence"] = "does not reach " + ", ".join(sorted(lost))
    elif record["found"]:
        record["sentence"] = reading.sentence(command, results, name, ran["errors"])
    else:
        record["sentence"] = ran["errors"].strip() if ran["status"] else ""
    return record


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--crossgrain", type=pathlib.Path, required=True, help="the program")
    parser.add_argument("--engine", type=pathlib.Path, required=True, help="planted_engine")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="records, and the table")
    parser.add_argument("--faults", type=pathlib.Path, default=here / "faults.toml", help="the list of them")
    parser.add_argument("--only", default="", help="faults whose names this regular expression matches, and the control")
    parser.add_argument("--commands", default="", help="some of them, separated by commas; all unless given")
    parser.add_argument("--again", action="store_true", help="run also what has a record")
    parser.add_argument("--cpu", action="store_true", help="seconds are those of processors: for a machine with other work; none is stopped")
    parser.add_argument("--require", action="store_true", help="status 1 unless all are found by one of the commands, and the control by none")
    options = parser.parse_args()
    options.crossgrain, options.engine, options.out = (
        path.resolve() for path in (options.crossgrain, options.engine, options.out))
    for folder in ("records", "engines"):
        (options.out / folder).mkdir(parents=True, exist_ok=True)
    given = tomllib.loads(options.faults.read_text())
    if "commands" in given:  # with controls of their own
        most, commands, faults = given["most_seconds"], given["commands"], given["fault"]
    else:
        commands = tomllib.loads((here / "commands.toml").read_text())
        most = commands.pop("most_seconds")
        commands = {name: spec["arguments"] for name, spec in commands.items()}
        faults = [control, *given["fault"]]
    wanted = options.commands.split(",") if options.commands else list(commands)
    chosen = [fault for fault in faults if fault is control or re.search(options.only, fault["name"])]
    right = set()
    records = []
    for command in wanted:  # the control comes first
        for fault in chosen:
            kept = options.out / "records" / f"{fault['name']}-{command}.json"
            fresh = options.again or not kept.exists()
            if fresh:
                run(options, fault.get(command, commands[command]), None if options.cpu else most, fault, command, kept)
            if fault is control:
                right = reading.good_columns(results_of(kept), "right")
            record = judged(command, fault, kept, right, options.cpu)
            records.append(record)
            if not fresh:
                continue
            print(f"{fault['name']:<26} {command:<12} {'found' if record['found'] else '–':<6} {record['seconds']:>6} s  "
                  f"{record['named']:<8} {record['sentence'][:90]}", flush=True)
    table.write(options.out, chosen, list(commands), records)
    print((options.out / "totals.md").read_text())
    if not options.require:
        return 0
    seen = {record["fault"] for record in records if record["found"]}
    missed = [fault["name"] for fault in chosen if fault["patch"] and fault["name"] not in seen]
    for name in missed:
        print(f"not found: {name}")
    accused = [fault["name"] for fault in chosen if not fault["patch"] and fault["name"] in seen]
    if accused:
        print("the right engine was found at fault")
    return 1 if missed or accused else 0


if __name__ == "__main__":
    sys.exit(main())
