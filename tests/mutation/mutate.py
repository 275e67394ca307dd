#!/usr/bin/env python3
"""Plants one wrong operator at a time in a copy of the project and asks its tests: README.md.

    mutate.py --out build/mutation --count 60 --minutes 120
    mutate.py --out build/mutation --count 60 --own         # quickly: the rest is asked later, of what lived
    mutate.py --out build/mutation --once-survived          # those of survivors.toml, once more
    mutate.py --out build/mutation --publish reports/curated/trust
"""

import argparse
import csv
import dataclasses
import json
import pathlib
import re
import sys
import time
import tomllib

import mutants
import workshop

here = pathlib.Path(__file__).resolve().parent
project = here.parent.parent


class Records:
    """One line for each mutant that was judged; the last one of the same place counts."""

    def __init__(self, path):
        self.path, self.by_key, self.at_first = path, {}, {}
        for line in path.read_text().splitlines() if path.exists() else []:
            record = json.loads(line)
            self.by_key[tuple(record["key"])] = record
            if tuple(record["key"]) not in self.at_first:
                self.at_first[tuple(record["key"])] = record["result"]

    def add(self, mutant, drawn, result, killed_by, seconds):
        record = {"key": mutant.key, **dataclasses.asdict(mutant), "drawn": drawn, "result": result, "killed_by": killed_by,
                  "seconds": round(seconds, 1)}
        self.by_key[mutant.key] = record
        self.at_first.setdefault(mutant.key, result)
        with self.path.open("a") as file:
            file.write(json.dumps(record) + "\n")


def once_survived():
    """What survivors.toml names, where it is now, with what was found out about it. @throws SystemExit for what is nowhere"""
    found = {}
    for entry in tomllib.loads((here / "survivors.toml").read_text())["mutant"]:
        places = [mutant for mutant in mutants.mutants_of(entry["file"], (project / entry["file"]).read_text())
                  if mutant.text.strip() == entry["text"] and (mutant.before, mutant.after) == (entry["before"], entry["after"])]
        if len(places) < entry.get("which", 1):
            raise SystemExit(f"survivors.toml: {entry['file']} has no {entry['before']} in “{entry['text']}”")
        mutant = places[entry.get("which", 1) - 1]
        found[mutant.key] = (mutant, entry)
    return found


results = ("killed", "lived", "open", "equivalent")
heading = "## Mutants of the project's own code\n"
words = """
One operator made wrong at a time, drawn by a seed folder by folder, and the project's tests asked, without `tests/system` and benchmarks ([tests/mutation](../../../tests/mutation/README.md)).
*Open*: the tests of its own folder let it live, those of the others were not asked. *Equivalent*: no other program, with the reason in `survivors.toml`. `mutation.csv` has each with
the test that killed it and the seconds until then. *At first*: before tests were written for what had lived. Mutants that had lived in an earlier trial were not drawn and are not in the table: {others}.

"""


def rows_of(records):
    judged = once_survived()
    rows = []
    for key, record in records.by_key.items():
        result = record["result"]
        if result == "does not compile":
            continue
        if result in ("lived", "open") and key in judged and judged[key][1].get("equivalent"):
            result = "equivalent"
        rows.append({"file": record["file"], "line": record["line"], "operator": record["operator"],
                     "change": f"{record['before']} → {record['after'] or 'nothing'}", "drawn": "yes" if record["drawn"] else "no",
                     "result": result, "at_first": records.at_first[key], "killed_by": record["killed_by"], "seconds": record["seconds"], "code": record["text"].strip()})
    return sorted(rows, key=lambda row: (row["file"], row["line"], row["change"]))


def section(rows):
    """A line for each folder and one for all, of those drawn by the seed."""
    table = [["folder", "mutants", *results, "killed of those that are another program", "at first"], ["---"] * 8]
    drawn = [row for row in rows if row["drawn"] == "yes"]
    for folder in [*mutants.folders, "all"]:
        of_folder = [row for row in drawn if folder in ("all", mutants.folder_of(row["file"]))]
        now = [row["result"] for row in of_folder]
        others = len(now) - now.count("equivalent")

        def rate(killed, others=others):
            return f"{100 * killed / others:.0f} %" if others else "–"

        first = sum(row["at_first"] == "killed" for row in of_folder)
        table.append([folder, len(now), *map(now.count, results), rate(now.count("killed")), rate(first)])
    chosen = [row["result"] for row in rows if row["drawn"] == "no"]
    others = ", ".join(f"{chosen.count(result)} {result}" for result in results if result in chosen) or "none"
    return heading + words.format(others=others) + "".join("| " + " | ".join(map(str, line)) + " |\n" for line in table)


def publish(records, folder):
    """mutation.csv, and the section of the README beside it."""
    rows = rows_of(records)
    with (folder / "mutation.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    page = folder / "README.md"
    text = page.read_text() if page.exists() else ""
    before, _, after = text.partition("\n" + heading)
    rest = after[after.index("\n## ") :] if "\n## " in after else ""
    page.write_text(before.rstrip("\n") + "\n\n" + section(rows) + rest)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, required=True, help="the copy, its build, and records.jsonl; what is there is gone on with")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=60, help="mutants of the seed that compile, those judged before among them")
    parser.add_argument("--minutes", type=float, default=float("inf"), help="none is begun later")
    parser.add_argument("--only", default="", help="files that this regular expression matches")
    parser.add_argument("--own", action="store_true",
                        help="ask the tests of a mutant's own folder only, which kill soonest; what lives stays open, and is gone on with without this")
    parser.add_argument("--once-survived", action="store_true", help="those of survivors.toml only, judged before or not")
    parser.add_argument("--publish", type=pathlib.Path, help="nothing is run: a table of the records into this folder")
    options = parser.parse_args()
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    records = Records(out / "records.jsonl")
    if options.publish:
        return publish(records, options.publish)

    began = time.monotonic()
    shop = workshop.Workshop(project, out)

    def late():
        return time.monotonic() - began > 60 * options.minutes

    def wanted(mutant):
        before = records.by_key.get(mutant.key, {}).get("result")
        return re.search(options.only, mutant.file) and (before is None or (before == "open" and not options.own))

    if options.once_survived:
        chosen = [mutant for mutant, entry in once_survived().values()
                  if not entry.get("equivalent") and re.search(options.only, mutant.file)]
    else:
        chosen = list(mutants.drawn(shop.source, options.seed))
        judged = sum(record["drawn"] and record["result"] not in ("does not compile", "open") for record in records.by_key.values())
        chosen = [mutant for mutant in chosen if wanted(mutant)]
        options.count -= judged
    shop.check_whole({name for mutant in chosen for name in workshop.order(mutants.folder_of(mutant.file), options.own)})
    for mutant in chosen:
        if options.count <= 0 or late():
            break
        drawn = not options.once_survived or records.by_key.get(mutant.key, {}).get("drawn", False)
        result, killed_by, seconds = shop.judge(mutant, options.own)
        records.add(mutant, drawn, result, killed_by, seconds)
        print(f"{result:<16} {seconds:>5.0f} s  {mutant}  {killed_by}", flush=True)
        options.count -= result != "does not compile"
    return None


if __name__ == "__main__":
    sys.exit(main())
