#!/usr/bin/env python3
"""Runs crossgrain's commands on engines with planted faults and writes what they found: README.md.

    planted_faults.py --crossgrain build/full/cli/crossgrain --engine build/full/tests/faults/planted_engine --out out/trust
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time
import tomllib

import reading
import table

here = pathlib.Path(__file__).resolve().parent
project = here.parent.parent
lists = ("faults", "elsewhere", "resistance", "space")
control = {"name": "right", "patch": {}, "what": "nothing: the control", "term": "never"}


def engine_file(path, program, fault, name):
    patch = [f"{number}={value}" for number, value in fault["patch"].items()]
    words = ", ".join(json.dumps(word) for word in [str(program), *patch])
    path.write_text(f'name = "{name}"\nsummary = {json.dumps(fault["what"])}\ncommand = [{words}]\n')
    return path


def results_of(kept):
    path = kept.with_suffix(".results.json")
    return json.loads(path.read_text()) if path.exists() else {}


def finished(line, seconds, log):
    """Runs it. @returns status, None where it was stopped after so many seconds; seconds; seconds of processors"""
    began = time.monotonic()
    with log.open("w") as errors:
        process = subprocess.Popen(line, cwd=project, stdout=log.with_suffix(".out").open("w"), stderr=errors)
    stopped = False
    while True:
        pid, status, used = os.wait4(process.pid, os.WNOHANG)
        if pid:
            break
        if seconds and time.monotonic() - began > seconds and not stopped:
            stopped = True
            process.kill()
        time.sleep(0.02)
    process.returncode = os.waitstatus_to_exitcode(status)
    return None if stopped else process.returncode, time.monotonic() - began, used.ru_utime + used.ru_stime


def baseline_of_right(options):
    """What `diff` compares with: the right engine."""
    path = options.out / "right.baseline"
    if not path.exists():
        engine = engine_file(options.out / "engines" / "right.toml", options.engine, control, "right")
        subprocess.run([options.crossgrain, "baseline", "cases/couette/quick.toml", "--engines", engine, "--quiet", "--out", path], cwd=project, check=True, capture_output=True)
    return path


def run(options, work):
    """One command on one fault; keeps its status, its time and its results."""
    fault, command, kept = work["fault"], work["command"], work["kept"]
    out = options.out / "run" / kept.stem
    shutil.rmtree(out, ignore_errors=True)
    out.parent.mkdir(exist_ok=True)
    engine = engine_file(options.out / "engines" / f"{fault['name']}.toml", options.engine.with_name(work["program"]), fault, fault["name"])
    words = [word.format(engine=engine, cell=fault.get("cell", ""), collision=fault.get("collision", ""), baseline=options.out / "right.baseline")
             for word in work["arguments"]]
    line = [str(options.crossgrain), command, *words, "--quiet", *(["--json"] if command == "diff" else ["--out", str(out)])]
    log = out.with_suffix(".log")
    seconds = None if options.cpu else work["most_seconds"]
    status, took, used = finished(line, seconds, log)
    errors = log.read_text(errors="replace") if status is not None else f"crossgrain: not done within {seconds} s"
    results = kept.with_suffix(".results.json")
    results.unlink(missing_ok=True)
    if command == "diff" and status is not None:
        shutil.copy(log.with_suffix(".out"), results)
    elif (out / "results.json").exists():
        shutil.copy(out / "results.json", results)
    shutil.rmtree(out, ignore_errors=True)
    record = {"status": status, "seconds": round(took, 1), "cpu_seconds": round(used, 1), "errors": errors}
    kept.write_text(json.dumps(record, ensure_ascii=False, indent=1))


def works_of(path, options):
    """What a file of faults asks for: each command on each of its faults, its controls first."""
    given = tomllib.loads(path.read_text())
    if "commands" in given:
        most, commands = given["most_seconds"], given["commands"]
    else:
        commands = tomllib.loads((here / "commands.toml").read_text())
        most = commands.pop("most_seconds")
        commands = {name: spec["arguments"] for name, spec in commands.items()}
    program = given.get("program", "planted_engine")
    faults = given["fault"] if any(not fault["patch"] for fault in given["fault"]) else [control, *given["fault"]]
    return [{"fault": fault, "command": command, "program": program, "most_seconds": most,
             "arguments": fault.get(command, commands[command]), "kept": options.out / "records" / f"{fault['name']}-{command}.json"}
            for command in commands for fault in faults if not fault["patch"] or re.search(options.only, fault["name"])]


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
    parser.add_argument("--faults", type=pathlib.Path, nargs="+", default=[here / f"{name}.toml" for name in lists], help="the lists of them")
    parser.add_argument("--only", default="", help="faults whose names this regular expression matches, and the control")
    parser.add_argument("--commands", default="", help="some of them, separated by commas; all unless given")
    parser.add_argument("--jobs", type=int, default=1, help="so many side by side")
    parser.add_argument("--again", action="store_true", help="run also what has a record")
    parser.add_argument("--cpu", action="store_true", help="seconds are those of processors: for a machine with other work; none is stopped")
    parser.add_argument("--require", action="store_true", help="status 1 unless all are found by one of the commands, and the control by none")
    options = parser.parse_args()
    options.crossgrain, options.engine, options.out = (
        path.resolve() for path in (options.crossgrain, options.engine, options.out))
    for folder in ("records", "engines"):
        (options.out / folder).mkdir(parents=True, exist_ok=True)
    works = {work["kept"]: work for path in options.faults for work in works_of(path, options)}  # controls of several lists once
    commands = list(dict.fromkeys(work["command"] for work in works.values()))
    wanted = options.commands.split(",") if options.commands else commands
    if "diff" in wanted:
        baseline_of_right(options)
    chosen = {work["fault"]["name"]: work["fault"] for work in works.values()}
    missing = {kept for kept, work in works.items() if work["command"] in wanted and (options.again or not kept.exists())}
    right = set()
    records = []

    def report(work):
        nonlocal right
        kept, fault, command = work["kept"], work["fault"], work["command"]
        if fault is control:
            right = reading.good_columns(results_of(kept), "right") if command == "cost" else right
        record = judged(command, fault, kept, right, options.cpu)
        if kept in missing:
            print(f"{fault['name']:<26} {command:<12} {'found' if record['found'] else '–':<6} {record['seconds']:>6} s  "
                  f"{record['named']:<8} {record['sentence'][:90]}", flush=True)
        records.append(record)

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for command in wanted:
            own = [work for work in works.values() if work["command"] == command]
            running = {work["kept"]: pool.submit(run, options, work) for work in own if work["kept"] in missing}
            for work in own:
                if work["kept"] in running:
                    running[work["kept"]].result()
                report(work)
    # What other calls have kept of other commands.
    for work in works.values():
        if work["command"] not in wanted and work["kept"].exists():
            records.append(judged(work["command"], work["fault"], work["kept"], right, options.cpu))
    table.write(options.out, list(chosen.values()), commands, records)
    print((options.out / "totals.md").read_text())
    if not options.require:
        return 0
    seen = {record["fault"] for record in records if record["found"]}
    missed = [fault["name"] for fault in chosen.values() if fault["patch"] and fault["name"] not in seen]
    for name in missed:
        print(f"not found: {name}")
    accused = [fault["name"] for fault in chosen.values() if not fault["patch"] and fault["name"] in seen]
    if accused:
        print("the right engine was found at fault")
    return 1 if missed or accused else 0


if __name__ == "__main__":
    sys.exit(main())
