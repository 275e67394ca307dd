#!/usr/bin/env python3
"""Takes an engine that is right, in disguises, through crossgrain's commands and counts false alarms: README.md.

    false_alarms.py --crossgrain build/full/cli/crossgrain --engine build/full/tests/faults/disguised_engine --out out/false
"""

import argparse
import csv
import ctypes
import ctypes.util
import json
import pathlib
import random
import shutil
import subprocess
import sys
import time
import tomllib

import reading

here = pathlib.Path(__file__).resolve().parent
project = here.parent.parent
COLUMNS = ["command", "promised", "trials", "alarms", "rate", "low", "high", "cpu_s"]


def interval(alarms, trials, confidence=0.95):
    """Of a rate, after Clopper and Pearson (1934): quantiles of beta distributions, GSL's."""
    ctypes.CDLL(ctypes.util.find_library("gslcblas"), mode=ctypes.RTLD_GLOBAL)
    quantile = ctypes.CDLL(ctypes.util.find_library("gsl")).gsl_cdf_beta_Pinv
    quantile.restype, quantile.argtypes = ctypes.c_double, [ctypes.c_double] * 3
    tail = 0.5 * (1.0 - confidence)
    low = quantile(tail, alarms, trials - alarms + 1) if alarms > 0 else 0.0
    high = quantile(1.0 - tail, alarms + 1, trials - alarms) if alarms < trials else 1.0
    return low, high


def disguise_of(draw, kinds):
    """Words for the engine; one at least."""
    while True:
        words = []
        for name, values in kinds.items():
            if draw.random() < 0.5:
                continue
            if values == "seed":
                value = draw.randrange(1, 2**31)
            elif name == "turn":
                value = draw.uniform(*values)
            else:
                value = draw.choice(values)
            words.append(f"{name}={value}")
        if words:
            return words


def trial(options, rules, command, number):
    """One command on one disguise; the same number is the same trial."""
    draw = random.Random(f"{command} {number}")
    words = disguise_of(draw, rules["disguise"])
    engine = options.out / "engines" / f"{command}-{number}.toml"
    line = json.dumps([str(options.engine), *words])
    engine.write_text(f'name = "disguised"\nsummary = "the in-house engine: {" ".join(words)}"\ncommand = {line}\n')
    scene = draw.choice(rules[command]["scenes"])
    arguments = [word.format(engine=engine, seed=1 + number % 8) for word in scene]
    out = options.out / "run"
    shutil.rmtree(out, ignore_errors=True)
    began = time.monotonic()
    done = subprocess.run([str(options.crossgrain), command, *arguments, "--quiet", "--out", str(out)],
                          cwd=project, capture_output=True, text=True, check=False)
    if done.returncode not in (0, 1, 3):
        sys.exit(f"{command} {arguments}: status {done.returncode}: {done.stderr}")
    results = json.loads((out / "results.json").read_text()) if (out / "results.json").exists() else {}
    alarm = reading.found(done.returncode)
    return {"command": command, "trial": number, "disguise": words, "arguments": arguments[:-1], "status": done.returncode, "alarm": alarm,
            "seconds": round(time.monotonic() - began, 2),
            "sentence": reading.sentence(command, results, "disguised", done.stderr) if alarm else "",
            "printed": done.stdout[-600:] if alarm else ""}


def rates(records, rules):
    """A row for each command: how many alarms, and between what and what the rate lies at 95 %."""
    rows = []
    for command in rules:
        own = [record for record in records if record["command"] == command]
        if command == "disguise" or not own:
            continue
        alarms = sum(record["alarm"] for record in own)
        low, high = interval(alarms, len(own))
        rows.append({"command": command, "promised": rules[command]["promised"], "trials": len(own), "alarms": alarms,
                     "rate": f"{alarms / len(own):.4f}", "low": f"{low:.4f}", "high": f"{high:.4f}",
                     "cpu_s": f"{sum(record['cpu'] for record in own):.0f}"})
    return rows


def cpu_of_children():
    import resource

    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--crossgrain", type=pathlib.Path, required=True, help="the program")
    parser.add_argument("--engine", type=pathlib.Path, required=True, help="disguised_engine")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="records, and false-alarms.csv")
    parser.add_argument("--commands", default="", help="some of them, separated by commas; all unless given")
    parser.add_argument("--trials", type=int, default=200, help="of each command")
    parser.add_argument("--cpu", type=float, default=float("inf"), help="no trial of a command begins after so much of it [s]")
    parser.add_argument("--first", type=int, default=0, help="number of the first trial")
    parser.add_argument("--again", action="store_true", help="forget the trials that there are")
    parser.add_argument("--require", action="store_true", help="status 1 where there are alarms of a command that promises none")
    options = parser.parse_args()
    options.crossgrain, options.engine, options.out = (
        path.resolve() for path in (options.crossgrain, options.engine, options.out))
    (options.out / "engines").mkdir(parents=True, exist_ok=True)
    rules = tomllib.loads((here / "false_alarms.toml").read_text())
    wanted = options.commands.split(",") if options.commands else [name for name in rules if name != "disguise"]
    kept = options.out / "trials.jsonl"
    if options.again:
        kept.unlink(missing_ok=True)
    records = [json.loads(line) for line in kept.read_text().splitlines()] if kept.exists() else []
    there = {(record["command"], record["trial"]) for record in records}
    for command in wanted:
        used = 0.0
        for number in range(options.first, options.first + options.trials):
            if (command, number) in there or used > options.cpu:
                continue
            before = cpu_of_children()
            record = trial(options, rules, command, number)
            record["cpu"] = round(cpu_of_children() - before, 2)
            used += record["cpu"]
            records.append(record)
            with open(kept, "a", encoding="utf-8") as file:
                file.write(json.dumps(record, ensure_ascii=False) + "\n")
            if record["alarm"]:
                print(f"alarm: {command} {number}: {' '.join(record['disguise'])}: {record['sentence'] or record['printed']}", flush=True)
    rows = rates(records, rules)
    with open(options.out / "false-alarms.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    for row in rows:
        print("{command}: {alarms} alarms in {trials} trials, {low} to {high}; promised: {promised}".format(**row))
    broken = [row for row in rows if row["promised"] == 0.0 and row["alarms"] > 0]
    return 1 if options.require and broken else 0


if __name__ == "__main__":
    sys.exit(main())
