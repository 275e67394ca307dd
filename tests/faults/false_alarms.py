#!/usr/bin/env python3
"""Takes engines that are right through crossgrain's commands and counts false alarms: README.md.

    false_alarms.py --crossgrain build/full/cli/crossgrain --engine build/full/tests/faults/disguised_engine --out out/false
    false_alarms.py … --rules tests/faults/other_engines.toml --out out/others
"""

import argparse
import csv
import ctypes
import ctypes.util
import hashlib
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
COLUMNS = ["command", "promised", "trials", "alarms", "rate", "low", "high", "cpu_s", "build"]


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


def declared_of(draw, kinds, not_both):
    """Words for the engine, and changes that make a case's law its own: of one kind, or each with an even chance."""
    ways = [(name, value) for name, values in kinds.items() for value in values]
    alone = draw.choice(ways) if draw.random() < 0.5 else None
    chosen = dict(way for way in ways if (way == alone if alone else draw.random() < 0.5))
    for one, other in not_both:
        if one in chosen:
            chosen.pop(other, None)
    law = [change for name, value in chosen.items() for change in kinds[name][value]]
    return ["declares=1", *(f"{name}={value}" for name, value in chosen.items())], law


def written(path, name, words, program):
    path.write_text(f'name = "{name}"\nsummary = "right: {" ".join(words)}"\ncommand = {json.dumps([str(program), *words])}\n')
    return path


def engine_of(options, rules, command, number, draw):
    """Draws an engine and a scene. @returns the engine's file, its words, the scene, changes of the case's law, whether these are the engine's own"""
    path, asked = options.out / "engines" / f"{command}-{number}.toml", rules[command]
    if "declared" not in rules or draw.random() < 0.5:
        disguises = rules.get("disguise") or tomllib.loads((here / "false_alarms.toml").read_text())["disguise"]
        words = disguise_of(draw, disguises)
        return written(path, "disguised", words, options.engine), words, draw.choice(asked["scenes"]), [], True
    scene = draw.choice([scene for scene in asked["scenes"] if not scene.get("disguise")])
    rolling = rules["declared_rolling"] if scene.get("rolls") else {}
    kinds = {name: values for name, values in {**rules["declared"], **rolling}.items() if name not in asked.get("without", [])}
    words, law = declared_of(draw, kinds, rules["not_both"])
    own = draw.random() < 0.5 or asked.get("law") == "own"
    changes = [word for change in law for word in ("--set", change)] if own and asked.get("law") != "none" else []
    return written(path, "declared", words, options.engine.with_name("planted_engine")), words, scene, changes, own


def asked_of(options, rules, command, number, scene, law, engine, draw):
    """The words after the command's name; makes what it compares with."""
    filled = {"engine": engine, "seed": 1 + number % 8, "starts": draw.choice(rules[command].get("starts", [0]))}
    if isinstance(scene, list):
        return [word.format(**filled) for word in scene]
    case, others = [*scene["arguments"], *law], [word.format(**filled) for word in rules[command]["with"]]
    if "before" not in rules[command]:
        return [*case, *others]
    name, *more = [word.format(**filled) for word in rules[command]["before"]]
    kept = options.out / "before" / hashlib.sha256(" ".join([name, *case, *more]).encode()).hexdigest()[:16]
    if not kept.exists():
        kept.parent.mkdir(exist_ok=True)
        subprocess.run([str(options.crossgrain), name, *case, *more, "--quiet", "--out", str(kept)], cwd=project, check=True, capture_output=True)
    return [str(kept), *others]


def trial(options, rules, command, number):
    """One command on one engine; the same number is the same trial. None: it cannot be asked."""
    draw = random.Random(f"{command} {number}")
    engine, words, scene, law, own = engine_of(options, rules, command, number, draw)
    arguments = asked_of(options, rules, command, number, scene, law, engine, draw)
    out = options.out / "run"
    shutil.rmtree(out, ignore_errors=True)
    began = time.monotonic()
    answers = ["--json"] if command == "diff" else ["--out", str(out)]
    done = subprocess.run([str(options.crossgrain), command, *arguments, "--quiet", *answers], cwd=project, capture_output=True, text=True, check=False)
    if done.returncode == 2 and "declared" in rules:
        print(f"no trial: {command} {number}: {done.stderr.strip()}", flush=True)
        return None
    if done.returncode not in (0, 1, 3):
        sys.exit(f"{command} {number} {arguments}: status {done.returncode}: {done.stderr}")
    results = json.loads((out / "results.json").read_text()) if (out / "results.json").exists() else {}
    if command == "diff":
        results = json.loads(done.stdout or "{}")
    name = engine_name(engine)
    alarm = reading.accused(command, done.returncode, results, name, own)
    build = " ".join(filter(None, (results.get("version"), results.get("build"))))
    return {"command": command, "trial": number, "build": build, "disguise": words, "arguments": [word for word in arguments if word != str(engine)],
            "status": done.returncode, "alarm": alarm, "seconds": round(time.monotonic() - began, 2),
            "sentence": reading.sentence(command, results, name, done.stderr) if alarm else "",
            "printed": (done.stdout[-600:] + done.stderr[-600:]) if alarm else ""}


def engine_name(path):
    return tomllib.loads(path.read_text())["name"]


def rates(records, rules):
    """A row for each command: how many alarms, and between what and what the rate lies at 95 %."""
    rows = []
    for command in commands_of(rules):
        own = [record for record in records if record["command"] == command]
        if not own:
            continue
        alarms = sum(record["alarm"] for record in own)
        low, high = interval(alarms, len(own))
        rows.append({"command": command, "promised": rules[command]["promised"], "trials": len(own), "alarms": alarms,
                     "rate": f"{alarms / len(own):.4f}", "low": f"{low:.4f}", "high": f"{high:.4f}",
                     "cpu_s": f"{sum(record['cpu'] for record in own):.0f}",
                     "build": " and ".join(sorted({record["build"] for record in own if record.get("build")}))})
    return rows


def commands_of(rules):
    return [name for name, asked in rules.items() if isinstance(asked, dict) and "promised" in asked]


def cpu_of_children():
    import resource

    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--crossgrain", type=pathlib.Path, required=True, help="the program")
    parser.add_argument("--engine", type=pathlib.Path, required=True, help="disguised_engine")
    parser.add_argument("--rules", type=pathlib.Path, default=here / "false_alarms.toml", help="what is asked in a trial")
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
    rules = tomllib.loads(options.rules.read_text())
    wanted = options.commands.split(",") if options.commands else commands_of(rules)
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
            if record is None:
                continue
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
