#!/usr/bin/env python3
"""Makes reports/curated/trust, and the sentences of README.md and docs/validation.md, of what was kept: publish.py --from OUT

Reads OUT/records of planted_faults.py, of one build, and harness.csv, false-alarms.csv, other-engines.csv where OUT has them, else those published
before. What is not run is –."""

import argparse
import csv
import json
import pathlib
import shutil

import planted_faults
import table

trust = planted_faults.project / "reports/curated/trust"
head = """# Trust: what is found of planted faults, and false alarms

Faults as numbers in an engine that is otherwise right, and in the harness itself: [tests/faults](../../../tests/faults/README.md) says what they
are, what counts as found and as named, and why what escapes does. All is made by

```
cmake --build build/release --target planted_faults    # hours
tests/faults/publish.py --from build/release/planted_faults
```

"""
titles = {
    "faults": "`faults`: constants, geometry, history, conventions, what is shown",
    "elsewhere": "`elsewhere`: late, far, fast, in corners, second loads",
    "audit": "`audit`: what several bodies do at once, walls under way, the plate, what is slow, light or many",
    "resistance": "`resistance`: rolling resistance and cohesion",
    "space": "`space`: spheres and periodic boxes",
}
limits = """**What these figures are not.** They are shares of faults that were thought of. The rules of what counts were written before any fault was run, but checks were not: of `faults`, checks came from what had escaped (`later` in `faults.toml`); of `elsewhere` and the last two of
`space`, written before there were checks for their kinds, `conformance` found 5 of 20 then; checks for the first thirteen of `space` were made with them; `audit` has faults that `conformance` had not found (48 of 70 of an independent audit it had, [which](../../../tests/faults/README.md#an-independent-audit)), with checks made since. **Of 48 faults of a [second audit](../../../tests/faults/README.md#a-second-audit), planted blind in an engine of its own, the build of this table found 43 by `conformance`**, 33 by name or by a check that is for the fault; the checks and scenes made since are not in this table. **Of 48 of a [third](../../../tests/faults/README.md#a-third-audit) a build with these found 45, 41 by name or by a check** (and 46 with `stability`). What no scene of a command excites no command finds. Commands that were not run for a list have no figure there (–).
"""


more_measured = """## When more is measured

No verdict may turn into its opposite. `lockstep` on engines that are right and on engines with a fault far above, just above and just below its limit (0.1 % of k_n), with 2 to 32 starts and two time steps ([other engines, 64 starts](../lockstep/README.md#verdicts-that-do-not-turn)).

```
tests/coverage/lockstep_verdicts.py --crossgrain build/release/cli/crossgrain --program build/release/tests/faults/planted_engine --out out/verdicts \\
    --starts 32 --halved 4 --scenes cases/couette/quick.toml,cases/assembly/hopper.toml --engines 'kn=1.0008,kn=1.0012,…'
```

`kn` is a factor of k_n; with `declares=1` an engine is right; one contact in `drop_every` has no force; springs are lost with one list of neighbours in `history_lost_every`. *Same law* may become *undecided*: where one start of 32 is beyond
the limit, 14 % of all states may be, and 5 % is what chance may do. No row changes in any other way.

"""


def machine_of(records):
    for path in sorted(records.glob("right-*.results.json")):
        machine = json.loads(path.read_text()).get("machine", {})
        if machine:
            return f"{machine.get('cores', '?')} cores of {machine.get('cpu', 'an unknown kind')}"
    return "a machine that is not known"


def builds_in_words(rows):
    """ "one build, 0.3.0 1234abcd"; of several, what each has run. What a build has not run again stays as it was published."""
    builds = table.builds_of(rows)
    if len(builds) == 1:
        return f"one build, {next(iter(builds))}"
    return "builds " + " and ".join(f"{build} ({', '.join(commands)})" for build, commands in builds.items())


def planted(rows):
    """The section on faults in engines."""
    faults, rights = (len({row["fault"] for row in rows if row["control"] == control}) for control in ("", "yes"))
    text = f"## In engines\n\nBy {builds_in_words(rows)}: {faults} faults of {len(table.lists_of(rows))} lists and {rights} right engines, their controls. Seconds are those of a processor, of the whole command.\n"
    text += "" if table.ran(rows) == rows else f"**Not all of it has been run yet: {len(table.ran(rows))} of {len(rows)} runs.**\n"
    text += "\n"
    text += table.totals(rows) + "\n"
    text += "*By the check that fails*: no cause is given, and a check fails that is for the fault. `collide` and `stability` name no causes.\n\n"
    missed = {name: what for name, what in table.escapes(rows).items() if what}
    text += "Found by no command that was run: " + ("; ".join(f"`{name}`: {', '.join(what)}" for name, what in missed.items()) or "none") + ".\n\n"
    text += limits + "\n✓ found, · not found, – not run. `table.csv` has the sentence that each report says.\n"
    for name in table.lists_of(rows):
        text += f"\n### {titles.get(name, name)}\n\n" + table.by_fault(rows, name)
    return text


def harness(rows):
    """The section on faults of averaging and oracle, of harness_faults.py's table."""
    checks = list(dict.fromkeys(row["check"] for row in rows))
    of = {(row["fault"], row["check"]): row for row in rows}

    def cell(row):
        if row is None:
            return "–"
        if row["found"] == "no":
            return "·"
        if row["put_down_to"] == "implementation":
            return f"✓ the engine is blamed {float(row['seconds']):.0f} s"
        return f"✓ {row['named'] and 'named '}{float(row['seconds']):.0f} s"

    lines = [["fault", *checks]]
    for fault, what in dict.fromkeys((row["fault"], row["what"]) for row in rows):
        lines.append([what, *(cell(of.get((fault, check))) for check in checks)])
    return "## In the harness itself, on the right engine\n\nBy 0.3.0 of 23 November 2026.\n\n" + table.markdown(lines)


def rates(rows):
    def share(row, name):
        return f"{100.0 * float(row[name]):.1f} %"

    lines = [["command", "alarms", "trials", "rate", "between", "promised"]]
    lines += [[f"`{row['command']}`", row["alarms"], row["trials"], share(row, "rate"), f"{share(row, 'low')} and {share(row, 'high')}", share(row, "promised")]
              for row in rows]
    trials, alarms = (sum(int(row[name]) for row in rows) for name in ("trials", "alarms"))
    return table.markdown(lines) + f"\n{alarms} in {trials} trials of all commands together.\n"


def false_alarms(disguised, others):
    """The section on false alarms, of false_alarms.py's tables."""
    text = "## False alarms\n\nRates with their 95 % intervals after Clopper and Pearson; *promised* is what a command's own rules allow. [tests/faults](../../../tests/faults/README.md#false-alarms) says what is asked.\n"
    if disguised:
        text += f"\n**In disguise**: the in-house engine, turned, mirrored, in other units, renumbered, nudged by a rounding, taken up again and again, drawn anew for each trial. By {builds_in_words(disguised)}.\n\n" + rates(disguised)
        text += "\n```\ncmake --build build/release --target false_alarms    # an hour and more\n```\n"
    if others:
        text += f"\n**Of other kinds**: that engine, or one that declares another integrator, single precision, lagged velocities or other conventions and has them, in the quick cell, the thesis' cell, a hopper, plane shear, a biaxial box, a pile, a sandpile, a fast gas and with rigid disks. By {builds_in_words(others)} ([alarms of earlier builds and their causes](../../../tests/faults/README.md#false-alarms)).\n\n" + rates(others)
        text += "\n```\ntests/faults/false_alarms.py --crossgrain build/release/cli/crossgrain --engine build/release/tests/faults/disguised_engine \\\n    --rules tests/faults/other_engines.toml --out out/others\n```\n"
    return text


def read(folder, name):
    return table.read(folder / name) if (folder / name).exists() else []


def sections(folder):
    """What the page says of the tables in a folder."""
    parts = []
    if rows := read(folder, "table.csv"):
        parts.append(planted(rows))
    if rows := read(folder, "harness.csv"):
        parts.append(harness(rows))
    disguised, others = read(folder, "false-alarms.csv"), read(folder, "other-engines.csv")
    if disguised or others:
        parts.append(false_alarms(disguised, others))
    if (folder / "verdicts.md").exists():
        parts.append(more_measured + (folder / "verdicts.md").read_text())
    return "\n".join(parts)


def sentences(folder):
    """Page by page, mark by mark, what stands in README.md and docs/validation.md: from the tables alone."""
    rows = read(folder, "table.csv")

    def of(command):
        ran = table.of(rows, command=command)
        return f"{len(table.found(ran))} of {len(ran)}"

    ran = table.of(rows, command="conformance")
    how = f"{table.count(ran, 'rightly')} by their cause and {table.count(ran, 'by check')} by the check that fails, {table.count(ran, 'wrongly')} wrongly"
    finds = f"Of {len(ran)} faults planted in engines that are otherwise right, `conformance` finds {len(table.found(ran))} and names {how}"
    others = ", ".join(f"`{command}` {of(command)}" for command in table.commands_of(table.ran(rows)) if command != "conformance")
    right = {row["fault"] for row in table.of(rows, control=True)}
    accused = {row["fault"] for row in table.found(table.of(rows, control=True))}
    disguised, kinds = read(folder, "false-alarms.csv"), read(folder, "other-engines.csv")

    def alarms(trials):
        return tuple(sum(int(row[name]) for row in trials) for name in ("alarms", "trials"))

    raised = " and ".join(f"{alarms(trials)[0]} of {alarms(trials)[1]} trials {whose}" for trials, whose in
                          ((disguised, "of the in-house engine in disguise"), (kinds, "of right engines of other kinds in other scenes")) if trials)
    asked = len({row["command"] for row in disguised + kinds})
    return {
        "README.md": {"": f"{finds}; right engines gave {alarms(disguised + kinds)[0]} false alarms in {alarms(disguised + kinds)[1]} trials. "
                          "For many of these faults checks were made once they were known; of 96 that two independent audits then planted in engines of their own it found 88, of these 74 by their cause or a check that is for them ([tables, limits](reports/curated/trust/README.md))."},
        "docs/validation.md": {
            "": f"{finds}. The other commands find: {others}. Right engines, controls of the lists, found at fault: {len(accused)} of {len(right)}. "
                f"By {builds_in_words(rows)} ([table, limits](../reports/curated/trust/README.md)).",
            " false alarms": f"Right engines raised false alarms in {raised}, of {asked} commands ([rates, with what is promised](../reports/curated/trust/README.md#false-alarms)).",
        },
    }


def marked(text, mark, sentence=None):
    """What stands at a mark of a page; with a sentence: the page with it there. @throws ValueError where there is no such mark"""
    begin = f"<!-- tests/faults/publish.py:{mark} -->"
    at = text.index(begin) + len(begin)
    end = text.index("<!-- end -->", at)
    return text[at:end] if sentence is None else text[:at] + sentence + text[end:]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--from", dest="source", type=pathlib.Path, required=True)
    parser.add_argument("--to", type=pathlib.Path, default=trust)
    parser.add_argument("--note", default="", help="a sentence on how it was run")
    options = parser.parse_args()
    source, to = options.source.resolve(), options.to.resolve()
    to.mkdir(parents=True, exist_ok=True)
    before = {(row["fault"], row["command"]): row for row in read(to, "table.csv")}
    rows = planted_faults.rows_of(planted_faults.works_of_lists([planted_faults.here / f"{name}.toml" for name in planted_faults.lists], source))
    rows = [before.get((row["fault"], row["command"]), row) if row["status"] == table.not_run else row for row in rows]
    table.write(to / "table.csv", rows)
    for name in ("harness.csv", "false-alarms.csv", "other-engines.csv"):
        if (source / name).exists() and source != to:
            shutil.copy(source / name, to / name)
    page = to / "README.md"
    mutants = page.read_text().partition("\n## Mutants")[1:] if page.exists() else ()  # tests/mutation's own
    text = head + f"On {machine_of(source / 'records')}.{options.note and ' ' + options.note}\n\n" + sections(to)
    page.write_text(text + "".join(mutants))
    if to == trust:
        for name, marks in sentences(to).items():
            path = planted_faults.project / name
            for mark, sentence in marks.items():
                path.write_text(marked(path.read_text(), mark, sentence))


if __name__ == "__main__":
    main()
