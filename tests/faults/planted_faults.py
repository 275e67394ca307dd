#!/usr/bin/env python3
"""Runs crossgrain's commands on engines with planted faults and keeps what they found: README.md.

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
lists = ("faults", "elsewhere", "audit", "resistance", "space")
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


def works_of(path, out, only=""):
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
    return [{"list": path.stem, "fault": fault, "command": command, "program": program, "most_seconds": most,
             "arguments": fault.get(command, commands[command]), "kept": out / "records" / f"{fault['name']}-{command}.json"}
            for command in commands for fault in faults if not fault["patch"] or re.search(only, fault["name"])]


def works_of_lists(paths, out, only=""):
    """Those of all; a control of several lists once."""
    works = {}
    for path in paths:
        for work in works_of(path, out, only):
            works.setdefault(work["kept"], work)
    return list(works.values())


def judged(work):
    """A row of the table: what the kept results say."""
    fault, command = work["fault"], work["command"]
    row = dict.fromkeys(table.columns, "") | {"list": work["list"], "fault": fault["name"], "control": "" if fault["patch"] else "yes",
                                               "what": fault["what"], "command": command}
    if not work["kept"].exists():
        return row | {"status": table.not_run}
    ran, results, name = json.loads(work["kept"].read_text()), results_of(work["kept"]), fault["name"]
    found = reading.found(ran["status"])
    if found:
        sentence = reading.sentence(command, results, name, ran["errors"])
    else:
        sentence = ran["errors"].strip() if ran["status"] else ""
    return row | {
        "status": "timeout" if ran["status"] is None else ran["status"], "found": "yes" if found else "no",
        "cpu_s": ran["cpu_seconds"], "put_down_to": reading.blame(command, ran["status"], results, name),
        "named": reading.named(command, results, name, fault, ran["errors"]) if found else "",
        "build": " ".join(filter(None, (results.get("version"), results.get("build")))), "sentence": sentence}


def rows_of(works):
    """The table."""
    return [judged(work) for work in works]


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
    parser.add_argument("--cpu", action="store_true", help="for a machine with other work: none is stopped after so many seconds")
    parser.add_argument("--require", action="store_true", help="status 1 unless all are found by one of the commands, and the control by none")
    options = parser.parse_args()
    options.crossgrain, options.engine, options.out = (
        path.resolve() for path in (options.crossgrain, options.engine, options.out))
    for folder in ("records", "engines"):
        (options.out / folder).mkdir(parents=True, exist_ok=True)
    works = works_of_lists(options.faults, options.out, options.only)
    commands = list(dict.fromkeys(work["command"] for work in works))
    wanted = options.commands.split(",") if options.commands else commands
    if "diff" in wanted:
        baseline_of_right(options)
    missing = [work for command in wanted for work in works if work["command"] == command and (options.again or not work["kept"].exists())]
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for work, running in [(work, pool.submit(run, options, work)) for work in missing]:
            running.result()
            row = judged(work)
            print(f"{row['fault']:<26} {row['command']:<12} {'found' if row['found'] == 'yes' else '–':<6} {row['cpu_s']:>6} s  "
                  f"{row['named']:<8} {row['sentence'][:90]}", flush=True)
    rows = rows_of(works)
    table.write(options.out / "table.csv", rows)
    print(table.totals(rows))
    if not options.require:
        return 0
    missed = [what for missed in table.escapes(rows).values() for what in missed]
    for what in missed:
        print(f"not found: {what}")
    accused = table.found(table.of(rows, control=True))
    if accused:
        print("the right engine was found at fault")
    return 1 if missed or accused else 0


if __name__ == "__main__":
    sys.exit(main())
