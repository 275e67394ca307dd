"""The table of planted faults, of what every command made of every fault: table.csv, totals, rows, sentences."""

import csv

naming = ("lockstep", "compare", "conformance", "diff")  # commands that name causes
columns = ["list", "fault", "control", "what", "command", "status", "found", "cpu_s", "put_down_to", "named", "build", "sentence"]
not_run = "not run"
named = {"rightly": "✓ named", "by check": "✓ by check", "wrongly": "✓ misnamed", "": "✓"}


def write(path, records):
    with path.open("w", newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(records)


def read(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def commands_of(rows):
    return list(dict.fromkeys(row["command"] for row in rows))


def lists_of(rows):
    return list(dict.fromkeys(row["list"] for row in rows))


def builds_of(rows):
    """By build, those with the most rows first, what it has run: commands, with lists where another build has others of theirs."""
    own = [row for row in rows if row["build"]]

    def ran_by(build):
        words = {}
        for row in own:
            if row["build"] != build:
                continue
            of_command = [other for other in own if other["command"] == row["command"]]
            whole = all(other["build"] == build for other in of_command)
            words[f"`{row['command']}`" + ("" if whole else f" of `{row['list']}`")] = None
        return list(words)

    counts = {build: sum(row["build"] == build for row in own) for build in dict.fromkeys(row["build"] for row in own)}
    return {build: ran_by(build) for build in sorted(counts, key=lambda build: -counts[build])}


def ran(rows):
    return [row for row in rows if row["status"] != not_run]


def of(rows, control=False, **wanted):
    """What has been run, of faults or of right engines."""
    return [row for row in ran(rows) if (row["control"] == "yes") == control and all(row[key] == value for key, value in wanted.items())]


def found(rows):
    return [row for row in rows if row["found"] == "yes"]


def count(rows, how):
    return sum(row["named"] == how for row in found(rows))


def markdown(lines):
    return "".join("| " + " | ".join(map(str, line)) + " |\n" for line in [lines[0], ["---"] * len(lines[0]), *lines[1:]])


def totals(rows):
    """Command by command: what is found of each list and of all, what is named how, after which time; the controls."""
    lists = lists_of(rows)
    lines = [["command", *(f"`{name}`" for name in lists), "all", "named rightly", "by the check that fails", "wrongly", "not named", "median time",
              "right engines at fault"]]
    for command in commands_of(rows):
        faults = of(rows, command=command)
        hits = found(faults)

        def share(part):
            return f"{len(found(part))} of {len(part)}" if part else "–"

        how = [count(faults, name) if faults and command in naming else "–" for name in ("rightly", "by check", "wrongly", "")]
        seconds = sorted(float(row["cpu_s"]) for row in hits)
        lines.append([f"`{command}`", *(share(of(rows, command=command, list=name)) for name in lists), share(faults), *how,
                      f"{seconds[len(seconds) // 2]:.1f} s" if seconds else "–", share(of(rows, True, command=command))])
    return markdown(lines)


def _mark(row):
    if row is None or row["status"] == not_run:
        return "–"
    if row["status"] == "timeout":
        return "not in time"
    return f"{named[row['named']]} {float(row['cpu_s']):.0f} s" if row["found"] == "yes" else "·"


def by_fault(rows, name):
    """Fault by fault of one list."""
    own, commands = [row for row in rows if row["list"] == name], commands_of(rows)
    cells = {(row["fault"], row["command"]): row for row in own}
    lines = [["fault", *(f"`{command}`" for command in commands)]]
    for fault, what, control in dict.fromkeys((row["fault"], row["what"], row["control"]) for row in own):
        lines.append([f"{what} (`{fault}`)" if control else what, *(_mark(cells.get((fault, command))) for command in commands)])
    return markdown(lines)


def escapes(rows):
    """Faults that no command found of those that were run, by list: what each is."""
    seen = {row["fault"] for row in found(rows)}
    missed = {(row["list"], row["fault"]): row["what"] for row in of(rows) if row["fault"] not in seen}
    return {name: [what for (of_list, _), what in missed.items() if of_list == name] for name in lists_of(rows)}
