#!/usr/bin/env python3
"""Makes reports/curated/trust from what planted_faults.py and harness_faults.py wrote: publish.py --from OUT --to reports/curated/trust"""

import argparse
import csv
import json
import pathlib
import shutil

head = """# Trust: what is found of planted faults

Faults as numbers in an engine that is otherwise right, and in the harness itself: [tests/faults](../../../tests/faults/README.md) says what they
are, what counts as found and as named, and why what escapes does. Small and quick scenes, at most two minutes a command; version {versions}. Made by

```
cmake --build build/release --target planted_faults    # an hour and more
tests/faults/publish.py --from build/release/planted_faults --to reports/curated/trust
```

`table.csv` and `harness.csv` have every row with the sentence that the report says. Seconds are those of the whole command, {machine}.{note}

"""


def versions_of(records):
    found = set()
    for path in records.glob("*.results.json"):
        found.add(json.loads(path.read_text()).get("version", ""))
    return ", ".join(sorted(version for version in found if version))


def machine_of(records):
    for path in sorted(records.glob("right-*.results.json")):
        return "on " + machine_words(json.loads(path.read_text()).get("machine", {}))
    return "on a machine that is not known"


def machine_words(machine):
    return f"{machine.get('cores', '?')} cores of {machine.get('cpu', 'an unknown kind')}"


def harness_table(path):
    with path.open() as file:
        rows = list(csv.DictReader(file))
    checks = list(dict.fromkeys(row["check"] for row in rows))
    of = {(row["fault"], row["check"]): row for row in rows}
    lines = ["| fault | " + " | ".join(checks) + " |", "|---" * (len(checks) + 1) + "|"]
    for fault in dict.fromkeys(row["fault"] for row in rows):
        what = next(row["what"] for row in rows if row["fault"] == fault)
        cells = []
        for check in checks:
            row = of.get((fault, check))
            if row is None:
                cells.append("–")
            elif row["found"] == "no":
                cells.append("·")
            elif row["put_down_to"] == "implementation":
                cells.append(f"✓ the engine is blamed {float(row['seconds']):.0f} s")
            else:
                cells.append(f"✓ {row['named'] and 'named '}{float(row['seconds']):.0f} s")
        lines.append(f"| {what} | " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def false_alarms(path):
    """The section on false alarms, of false_alarms.py's table."""
    with path.open() as file:
        rows = list(csv.DictReader(file))
    trials, alarms = (sum(int(row[name]) for row in rows) for name in ("trials", "alarms"))
    lines = [
        "\n## False alarms\n",
        "The in-house engine in disguise: turned, mirrored, in other units, renumbered, nudged by a rounding, taken up again and again, drawn anew for each trial",
        "([tests/faults](../../../tests/faults/README.md#false-alarms) says how). Rates with their 95 % intervals after Clopper and Pearson; *promised* is what a command's own rules allow.\n",
        "| command | alarms | trials | rate | between | promised |",
        "|---|---|---|---|---|---|",
    ]
    for row in rows:
        rate, low, high, promised = (f"{100.0 * float(row[name]):.1f} %" for name in ("rate", "low", "high", "promised"))
        lines.append(f"| `{row['command']}` | {row['alarms']} | {row['trials']} | {rate} | {low} and {high} | {promised} |")
    lines.append(f"\n{alarms} in {trials} trials of all commands together. Made by\n\n```\ncmake --build build/release --target false_alarms    # an hour and more\n```")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--from", dest="source", type=pathlib.Path, required=True)
    parser.add_argument("--to", type=pathlib.Path, required=True)
    parser.add_argument("--note", default="", help="a sentence on how it was run")
    options = parser.parse_args()
    source, to = options.source, options.to
    to.mkdir(parents=True, exist_ok=True)
    records = source / "records"
    page = head.format(versions=versions_of(records), machine=machine_of(records), note=options.note and " " + options.note)
    page += "## In the engine\n\n" + (source / "totals.md").read_text() + "\n"
    page += "✓ found, · not found, – not measured; *named* or *misnamed* what was planted.\n\n" + (source / "table.md").read_text()
    files = ["table.csv"]
    if (source / "harness.csv").exists():
        page += "\n## In the harness itself, on the right engine\n\n" + harness_table(source / "harness.csv")
        files.append("harness.csv")
    for made in (source / "false-alarms.csv", to / "false-alarms.csv"):
        if made.exists():
            page += false_alarms(made)
            break
    (to / "README.md").write_text(page)
    for name in files:
        if source.resolve() != to.resolve():
            shutil.copy(source / name, to / name)


if __name__ == "__main__":
    main()
