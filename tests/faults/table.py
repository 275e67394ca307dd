"""The table of planted faults: table.csv, README.md's rows, totals."""

import csv

import reading

deciding = ("compare", "conformance")  # a user's two commands, by which the aim is set


def _mark(record):
    if record is None:
        return "–"
    if record["status"] is None:
        return "not in time"
    if not record["found"]:
        return "·"
    mark = {"rightly": "✓ named", "wrongly": "✓ misnamed", "": "✓"}[record["named"]]
    return f"{mark} {record['seconds']:.0f} s"


def _counts(faults, commands, of):
    lines = []
    for command in commands:
        ran = [of[fault, command] for fault in faults if (fault, command) in of]
        if not ran:
            continue
        hit = [record for record in ran if record["found"]]
        blamed = sum(record["blame"] == "implementation" for record in hit)
        rightly = sum(record["named"] == "rightly" for record in hit)
        wrongly = sum(record["named"] == "wrongly" for record in hit)
        seconds = sorted(record["seconds"] for record in hit) or [0.0]
        lines.append((command, len(hit), len(ran), seconds[len(seconds) // 2], blamed, rightly, wrongly))
    return lines


def write(out, faults, commands, records):
    of = {(record["fault"], record["command"]): record for record in records}
    with (out / "table.csv").open("w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["fault", "what", "command", "status", "found", "seconds", "put_down_to", "named", "sentence"])
        for fault in faults:
            for command in commands:
                record = of.get((fault["name"], command))
                if record is None:
                    continue
                writer.writerow([fault["name"], fault["what"], command,
                                 "timeout" if record["status"] is None else record["status"],
                                 "yes" if record["found"] else "no", record["seconds"], record["blame"],
                                 record["named"], record["sentence"]])
    names = [fault["name"] for fault in faults if fault["patch"]]
    lines = ["| command | finds | median time | put down to the implementation | named rightly | named wrongly |",
             "|---|---|---|---|---|---|"]
    for command, hit, ran, seconds, blamed, rightly, wrongly in _counts(names, commands, of):
        names_things = command in reading.naming
        lines.append(f"| `{command}` | {hit} of {ran} | {seconds:.0f} s | {blamed or '–'} | "
                     f"{rightly if names_things else '–'} | {wrongly if names_things else '–'} |")

    def by_either(test):
        return [name for name in names
                if any((name, command) in of and test(of[name, command]) for command in deciding)]

    both = [name for name in names if all((name, command) in of for command in deciding)]
    hit = by_either(lambda record: record["found"])
    rightly = by_either(lambda record: record["named"] == "rightly")
    lines.append(f"\n`compare` or `conformance` finds {len(hit)} of {len(names)} within two minutes and names {len(rightly)} of them rightly."
                 if len(both) == len(names) else "\nNot every fault was run by both of `compare` and `conformance`.")
    missed = [name for name in names if name not in hit]
    if missed and len(both) == len(names):
        lines.append("Escapes of both: " + ", ".join(missed) + ".")
    (out / "totals.md").write_text("\n".join(lines) + "\n")
    rows = ["| fault | " + " | ".join(f"`{command}`" for command in commands) + " |", "|---" * (len(commands) + 1) + "|"]
    for fault in faults:
        cells = " | ".join(_mark(of.get((fault["name"], command))) for command in commands)
        rows.append(f"| {fault['what']} | {cells} |")
    (out / "table.md").write_text("\n".join(rows) + "\n")
