"""Why a claim is refuted, as far as that is found: by rule, in which regime its runs were, how their pressure changed, and where
else the same rule has its figures in their bands; by somebody, in reasons.toml, while its conditions hold. No verdict changes."""

import dataclasses
import statistics

from laetzel import claims, collisions
from laetzel.judge import Reading, describe_rate, readings_of, same, same_but
from laetzel.text import readable

ABOUT_THE_SAME = 2.0  # pressures within it are not said to have changed
MOST_PLACES = 5


def some_runs(campaign, runs):
    """The campaign of these runs alone."""
    part = object.__new__(type(campaign))
    part.legs, part.collisions, part.runs = campaign.legs, campaign.collisions, runs
    return part


def elsewhere_of(campaign):
    """(campaign, Reading) of other runs that claims can be judged by than the default's: of one regime, of one ν̄, and of legs of the
    families "rate" and "time" by their rate and rotations."""
    for regime in ("flowing", "blocked", "collisional"):
        runs = [run for run in campaign.runs if run.regime.get("name") == regime]
        if runs and len(runs) < len(campaign.runs):
            part = some_runs(campaign, runs)
            yield part, dataclasses.replace(readings_of(part)[0], label=f"of runs that are {regime} alone")
    default, by_label, by_rate = readings_of(campaign)[0], {}, {}
    for leg in default.judged + default.timed:
        by_label.setdefault(leg.label, Reading("", f"at ν̄ = {leg.label:.3f} alone"))
    for label, reading in sorted(by_label.items()):
        reading.judged = [leg for leg in default.judged if leg.label == label]
        reading.timed = [leg for leg in default.timed if leg.label == label]
        if len(by_label) > 1:
            yield campaign, reading
    for leg in campaign.legs if default.judged else ():
        first = default.judged[0]
        as_first = same(leg.omega, first.omega) and leg.rotations == first.rotations
        if {"rate", "time"} & set(leg.families) and same_but(None, True, leg, campaign.reference) and not as_first:
            label = f"at {describe_rate(leg)}, rotations {leg.rotations}"
            reading = by_rate.setdefault(label, Reading("", label))
            reading.judged.append(leg)
            reading.timed.append(leg)
    for _, reading in sorted(by_rate.items()):
        yield campaign, reading


def count(number, noun):
    return f"{number} {noun}{'' if number == 1 else 's'}"


def regimes(runs):
    """"Of its 9 runs 6 were collisional, 3 flowing while averaged." """
    names = [run.regime["name"] for run in runs if run.regime.get("name")]
    if not names:
        return ""
    counts = [(name, names.count(name)) for name in ("collisional", "flowing", "blocked") if name in names]
    parts = [f"{n} {('was ' if n == 1 else 'were ') if k == 0 else ''}{name}" for k, (name, n) in enumerate(counts)]
    mostly = 2 * names.count("collisional") > len(names)
    because = ", most in the regime in which stress comes from impacts and goes with Ω²" if mostly else ""
    return f"Of its {count(len(runs), 'run')} {', '.join(parts)} while averaged{because}."


def pressures(runs):
    """How the outer pressure's last rotation compares with the first."""
    spans = [(run.history[0], run.history[-1]) for run in runs if len(run.history) > 1]
    spans = [(a, b) for a, b in spans if a["outer_pressure"] and a["outer_pressure"] > 0 and b["outer_pressure"] is not None]
    if not spans:
        return ""
    median = statistics.median(b["outer_pressure"] / a["outer_pressure"] for a, b in spans)
    if 1 / ABOUT_THE_SAME <= median <= ABOUT_THE_SAME:
        return ""
    return (
        "The state was not the same all the time: the outer pressure of the last rotation "
        f"(up to {max(b['to'] for _, b in spans):g}) is {readable(median)} times that of the first, "
        f"in the median of {count(len(spans), 'run')}."
    )


def places_text(places):
    more = f"; and {len(places) - MOST_PLACES} more" if len(places) > MOST_PLACES else ""
    return "; ".join(places[:MOST_PLACES]) + more


def where_it_holds(name, figure, others):
    """Of one refuted figure: by which other runs the same rule has it in its band. others: (label, Row)"""
    places, judged = [], 0
    for label, row in others:
        there = row.figures[name]
        if there.estimate is None or not there.verdict:
            continue
        if there.estimate.value == figure.estimate.value != 0:
            continue  # of the same runs
        judged += 1
        if there.verdict == "reproduced":
            unit = f" {there.band.unit}" if there.band.unit else ""
            places.append(f"{label} ({readable(there.estimate.value, there.estimate.error)}{unit})")
    if judged == 0:
        return ""
    if not places:
        return f"{figure.band.label} is shown in its band by none of {count(judged, 'other set')} of runs that it was judged by."
    return f"{figure.band.label} lies in its band {places_text(places)}."


def other_steps(campaign, rules, rows, row):
    """C1 by the law itself, and at the engine's other time steps."""
    if row.engine == collisions.LAW_ITSELF:
        return
    for other in rows:
        if (other.id, other.engine, other.reading) == (row.id, collisions.LAW_ITSELF, row.reading):
            yield "of the law in continuous time", other
    curves = [c for variant in campaign.collisions for c in variant["engines"] if c["engine"] == row.engine]
    for steps in sorted({curve["steps"] for curve in curves}):
        for other in collisions.judge_engine(campaign, rules, row.engine, steps):
            if other.reading == row.reading:
                yield f"at {steps:.0f} steps per contact", other


def holds(reason, row, rows):
    """Whether somebody's reason is one of this row: all of its conditions are met."""

    def met(condition):
        of, name = row, condition.get("claim", row.id)
        if name != row.id:  # the default reading's comes first
            of = next((each for each in rows if each.id == name and each.engine in (row.engine, collisions.LAW_ITSELF)), None)
        estimate = of and of.figures[condition["figure"]].estimate
        return estimate and condition.get("below", float("inf")) > estimate.value > condition.get("above", float("-inf"))

    return reason["claim"] == row.id and reason.get("engine", row.engine) == row.engine and all(map(met, reason["when"]))


def add_reasons(campaign, rules, found, rows):
    """Gives each refuted row its reasons. found: those of reasons.toml"""
    elsewhere = list(elsewhere_of(campaign))
    for row in rows:
        if row.verdict != "refuted":
            continue
        same_claim = [each for each in rows if each.id == row.id and each.engine == row.engine]
        others = [("under " + each.reading, each) for each in same_claim if each is not row]
        if row.id == "C1":
            others += other_steps(campaign, rules, rows, row)
        if row is same_claim[0] and row.id in claims.CLAIMS:
            judged = [(reading.label, claims.judge(part, rules, row.id, row.engine, reading)) for part, reading in elsewhere]
            others += [(label, other) for label, other in judged if other.legs]
        runs = [run for run in campaign.runs if run.engine == row.engine and run.leg.name in row.legs]
        whole = [label for label, other in others if other.verdict == "reproduced"]
        reasons = [regimes(runs), pressures(runs), f"The whole claim is reproduced {places_text(whole)}." if whole else ""]
        reasons += [where_it_holds(name, f, others) for name, f in row.figures.items() if f.verdict == "refuted"]
        reasons += [f"{each['text']} (Rests on {each['evidence']}.)" for each in found if holds(each, row, rows)]
        row.reasons = [reason for reason in reasons if reason]
