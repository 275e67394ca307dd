#!/usr/bin/env python3
"""Plants one wrong operator at a time in a copy of the project and asks its tests: README.md.

    mutate.py --out build/mutation --count 60 --minutes 120
    mutate.py --out build/mutation --count 60 --own         # quickly: the rest is asked later, of what lived
    mutate.py --out build/mutation --once-survived          # those of survivors.toml, once more
    mutate.py --out build/mutation --take-up reports/curated/trust/mutation.csv
    mutate.py --out build/mutation --publish reports/curated/trust
"""

import argparse
import collections
import csv
import dataclasses
import json
import pathlib
import re
import sys
import time

import mutants
import published
import workshop

here = pathlib.Path(__file__).resolve().parent
project = here.parent.parent


class Records:
    """One line for each mutant that was judged; the last one of the same place counts."""

    def __init__(self, path):
        self.path, self.by_key = path, {}
        for line in path.read_text().splitlines() if path.exists() else []:
            record = json.loads(line)
            self.by_key[tuple(record["key"])] = record

    def add(self, mutant, drawn, result, killed_by, seconds, at_first=None):
        at_first = self.by_key.get(mutant.key, {}).get("at_first") or at_first or result
        record = {"key": mutant.key, **dataclasses.asdict(mutant), "drawn": drawn, "result": result, "at_first": at_first,
                  "killed_by": killed_by, "seconds": round(seconds, 1)}
        self.by_key[mutant.key] = record
        with self.path.open("a") as file:
            file.write(json.dumps(record) + "\n")

    def take_up(self, table):
        """What a published table tells and is not known yet."""
        for row in csv.DictReader(table.open(newline="")):
            place = project / row["file"]
            mutant = published.taken_up(row, place.read_text()) if place.exists() else None
            if mutant is None:
                print(f"judged again if it is drawn: {row['file']}:{row['line']} {row['change']}")
            elif mutant.key not in self.by_key:
                # Equivalence is looked up in survivors.toml each time.
                result = "open" if row["result"] == "equivalent" else row["result"]
                self.add(mutant, row["drawn"] == "yes", result, row["killed_by"], float(row["seconds"]), row["at_first"])


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
    parser.add_argument("--take-up", type=pathlib.Path, help="nothing is run: what this published table (mutation.csv) tells is judged already")
    parser.add_argument("--publish", type=pathlib.Path, help="nothing is run: a table of the records into this folder")
    options = parser.parse_args()
    out = options.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    records = Records(out / "records.jsonl")
    if options.take_up:
        return records.take_up(options.take_up)
    if options.publish:
        return published.publish(records, project, options.publish)

    began = time.monotonic()
    shop = workshop.Workshop(project, out)
    once_survived = published.once_survived(project)
    equivalent = {key for key, (mutant, entry) in once_survived.items() if entry.get("equivalent")}

    def unsettled(record):
        return record["result"] == "open" and not options.own and tuple(record["key"]) not in equivalent

    def wanted(mutant):
        known = records.by_key.get(mutant.key)
        return re.search(options.only, mutant.file) and (known is None or unsettled(known))

    settled = collections.Counter(mutants.folder_of(record["file"]) for record in records.by_key.values()
                                  if record["drawn"] and record["result"] != "does not compile" and not unsettled(record))
    if options.once_survived:
        chosen = [mutant for key, (mutant, entry) in once_survived.items()
                  if key not in equivalent and re.search(options.only, mutant.file)]
        folders = {mutants.folder_of(mutant.file) for mutant in chosen}
    else:
        queues = {folder: list(filter(wanted, queue)) for folder, queue in mutants.drawn(shop.source, options.seed).items()}
        # Mutants that are open already come first.
        queues = {folder: sorted(queue, key=lambda mutant: mutant.key not in records.by_key) for folder, queue in queues.items()}
        chosen = mutants.in_turns(queues, settled)
        folders = {folder for folder in queues if queues[folder]}
    shop.check_whole({name for folder in folders for name in workshop.order(folder, options.own)})
    for mutant in chosen:
        if time.monotonic() - began > 60 * options.minutes or (not options.once_survived and settled.total() >= options.count):
            break
        drawn = not options.once_survived or records.by_key.get(mutant.key, {}).get("drawn", False)
        result, killed_by, seconds = shop.judge(mutant, options.own)
        records.add(mutant, drawn, result, killed_by, seconds)
        print(f"{result:<16} {seconds:>5.0f} s  {mutant}  {killed_by}", flush=True)
        settled[mutants.folder_of(mutant.file)] += result != "does not compile"
    return None


if __name__ == "__main__":
    sys.exit(main())
