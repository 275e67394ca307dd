"""The table that is published of what was judged, and what a table published before tells of the code as it is now."""

import csv
import tomllib

import mutants

results = ("killed", "lived", "open", "equivalent")
heading = "## Mutants of the project's own code\n"
words = """
One operator made wrong at a time, drawn by a seed folder by folder, and the project's tests asked, without `tests/system` and benchmarks ([tests/mutation](../../../tests/mutation/README.md)).
*Open*: the tests of its own folder let it live, those of the others were not asked. *Equivalent*: no other program, with the reason in `survivors.toml`. `mutation.csv` has each with its
place (the column is that in `code`), the test that killed it and the seconds until then. *At first*: before tests were written for what had lived. Mutants that had lived in an earlier trial were not drawn and are not in the table: {others}.

"""


def once_survived(project):
    """What survivors.toml names, where it is now, with what was found out about it; what is nowhere any more is printed and left out."""
    found = {}
    for entry in tomllib.loads((project / "tests/mutation/survivors.toml").read_text())["mutant"]:
        source = project / entry["file"]
        places = [mutant for mutant in mutants.mutants_of(entry["file"], source.read_text() if source.exists() else "")
                  if mutant.text.strip() == entry["text"] and (mutant.before, mutant.after) == (entry["before"], entry["after"])]
        if len(places) < entry.get("which", 1):
            print(f"survivors.toml: {entry['file']} has no {entry['before']} in “{entry['text']}” any more", flush=True)
            continue
        mutant = places[entry.get("which", 1) - 1]
        found[mutant.key] = (mutant, entry)
    return found


def rows_of(records, project):
    judged = once_survived(project)
    rows = []
    for key, record in records.by_key.items():
        result = record["result"]
        if result == "does not compile":
            continue
        if result in ("lived", "open") and key in judged and judged[key][1].get("equivalent"):
            result = "equivalent"
        rows.append({"file": record["file"], "line": record["line"], "column": key[2] + 1, "operator": record["operator"],
                     "change": f"{record['before']} → {record['after'] or 'nothing'}", "drawn": "yes" if record["drawn"] else "no",
                     "result": result, "at_first": record["at_first"], "killed_by": record["killed_by"], "seconds": record["seconds"],
                     "code": record["text"].strip()})
    return sorted(rows, key=lambda row: (row["file"], row["line"], row["column"], row["change"]))


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


def publish(records, project, folder):
    """mutation.csv, and the section of the README beside it."""
    rows = rows_of(records, project)
    with (folder / "mutation.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    page = folder / "README.md"
    text = page.read_text() if page.exists() else ""
    before, _, after = text.partition("\n" + heading)
    rest = after[after.index("\n## ") :] if "\n## " in after else ""
    page.write_text(before.rstrip("\n") + "\n\n" + section(rows) + rest)


def taken_up(row, source):
    """The mutant of the source that a published row is of; None where its line is gone."""
    before, _, after = row["change"].partition(" → ")
    alike = {mutant.key: mutant for mutant in mutants.mutants_of(row["file"], source)
             if mutant.text.strip() == row["code"] and (mutant.before, mutant.after) == (before, "" if after == "nothing" else after)}
    return next((mutant for mutant in alike.values() if mutant.key[2] + 1 == int(row["column"])), None)
