"""What the results of a command say of a planted fault: found, put down to what, named or not (faults.toml has the rules)."""

import re

from table import naming


def found(status):
    """Whether a user's script sees it."""
    return status in (1, 3)


def accused(command, status, results, engine, own_law=True):
    """Whether an engine that is right is found at fault (false_alarms.toml, other_engines.toml). @param own_law  whether the case has the law that it declares"""
    if command == "compare" and not own_law:
        return status == 3 or blame(command, status, results, engine) == "implementation"
    if command == "collide" and status == 1:  # where nothing can be judged, which is said, no fault is found
        return blame(command, status, results, engine) == "implementation"
    if command == "lockstep" and status == 1:  # likewise
        return blame(command, status, results, engine) != ""
    runs = results.get("runs", []) if command == "stability" else []
    if status != 1 or not any(run["engine"] == "grain" for run in runs):
        return status in (1, 3)
    unstable = {(run["engine"], run["case"], run.get("variant")) for run in runs if run["verdict"] == "unstable"}
    return any(name == engine and ("grain", *run) not in unstable for name, *run in unstable)


def _cells(results, engine):
    rows = (results.get("overview") or {}).get("rows", [])
    return [cell for row in rows if row["name"] == engine for cell in row["cells"]]


def blame(command, status, results, engine):
    """What the results put it down to: "implementation", "model" or "" (nothing is said)."""
    if command == "conformance":
        bad = any(row["outcome"] in ("failed", "broke_down") for row in results.get("checks", []))
        return "implementation" if bad else ""
    if command in ("stability", "diff"):  # they say what broke, not why
        return ""
    states = {cell["state"] for cell in _cells(results, engine)}
    if status == 3 or "bad" in states:
        return "implementation"
    return "model" if "model_difference" in states else ""


def failures(command, results, engine, errors):
    """What is said of runs that broke down."""
    said = [line.removeprefix("crossgrain: ") for line in errors.splitlines() if line.startswith("crossgrain: ")]
    if command == "conformance":
        said += [row["detail"] for row in results.get("checks", []) if row["outcome"] == "broke_down"]
    for row in (results.get("lockstep") or {}).get("rows", []):
        if row["engine"] == engine and row["failure"]:
            said.append(row["failure"])
    said += [run["reason"] for run in results.get("runs", [])
             if run.get("engine") == engine and run.get("reason")
             and run.get("status") != "refused" and run.get("verdict") != "stable"]
    return said


def _statements(cause):
    """(name, relative change or None) of each statement of a "most likely" sentence."""
    for statement in cause.split("; "):
        statement = re.sub(r"^(lockstep's closest term|found from outside|rolling): ", "", statement)
        statement = statement.removeprefix("its ").removeprefix("it has ")
        statement = re.sub(r" \(leaves .*|, and declares .*| off the case's$", "", statement)
        statement = re.sub(r"(%), (?:at|of|[\d.]+ s after) .*", r"\1", statement)  # the place
        change = re.search(r"(?: is)? ([+−-])([\d.]+)(?:×10([⁻⁰¹²³⁴-⁹]+))? %$", statement)
        if not change:
            yield statement, None
            continue
        power = (change[3] or "").translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
        size = float(change[2]) * 10.0 ** int(power or 0) / 100.0
        size = size if change[1] == "+" else -size
        name = statement[: change.start()]
        if name == "torque" and size > -1.0:  # f times the torque and 1/f of the inertia are one motion
            name, size = "inertia", 1.0 / (1.0 + size) - 1.0
        yield name, size


def term_of(command, results, engine):
    """The first term that is named, with its change; None: none is."""
    if command == "conformance":
        return next(_statements(results["cause"]), None) if results.get("cause") else None
    rows = (results.get("lockstep") or {}).get("rows", [])
    if command == "diff":
        rows = [row["windows"] for row in results.get("engines", [])]
    for row in rows:
        if row["engine"] == engine and row.get("term"):
            return row["term"]["name"], row["term"].get("amount")
    return None


def failed_checks(results):
    return [row["check"] for row in results.get("checks", []) if row["outcome"] in ("failed", "broke_down")]


def _is_term(fault, term, whole):
    """@param whole  the statement with its amount and its place"""
    name, change = term
    if "later_term" in fault and re.search(fault["later_term"], whole):
        return True
    if not re.search(rf"(?:^|\b|without )(?:{fault['term']})\b" if fault["term"][-1].isalnum() else fault["term"], name):
        return False
    low, high = fault.get("amount", (None, None))
    return change is None or low is None or low <= change <= high


def named(command, results, engine, fault, errors):
    """ "rightly", "wrongly", "by check" (no cause is given, and a check fails that is for the fault), "" (nothing is named)."""
    if command not in naming:
        return ""
    term = term_of(command, results, engine)
    if term is not None:
        whole = results["cause"].split("; ")[0] if command == "conformance" else term[0]
        return "rightly" if _is_term(fault, term, whole) else "wrongly"
    broken = failures(command, results, engine, errors)
    if broken and "says" in fault and any(re.search(fault["says"], what) for what in broken):
        return "rightly"
    if command == "conformance" and set(failed_checks(results)) & {*fault.get("checks", []), *fault.get("later", [])}:
        return "by check"
    return ""


def sentence(command, results, engine, errors):
    """The one that a reader meets first."""
    if command == "conformance":
        if results.get("cause"):
            return "most likely: " + results["cause"]
        for row in results.get("checks", []):
            if row["outcome"] in ("failed", "broke_down"):
                return f"{row['check']} ({row['what']}): {row['detail']}"
        return ""
    broken = failures(command, results, engine, errors)
    if broken:
        return broken[0]
    said = (results.get("overview") or {}).get("conclusion", [])
    if command in ("lockstep", "compare"):
        parts = [line for line in said if "not the law" in line or "parts them" in line]
        return " ".join(parts or said[:1])
    return said[0] if said else ""
