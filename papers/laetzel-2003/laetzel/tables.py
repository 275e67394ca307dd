"""The tables that are written of a campaign: claims.csv, readings.csv, regime_map.csv and history.csv."""

import csv
import itertools
import math

import numpy as np

from laetzel.campaign import longest_of_each_packing, mean
from laetzel.claims import log10, over_rim_speed, over_spin_scale
from laetzel.judge import OPEN, describe, describe_rate, is_number, same, same_but, same_law
from laetzel.statistics import critical_density, mean_over
from laetzel.text import setting

MAP_ROTATIONS = (1, 2, 5, 8, 10, 20)  # after which states are reported; 8 is the thesis' longest run


def cells(row):
    return ["" if value is None or (isinstance(value, float) and not math.isfinite(value)) else value for value in row]


def write(file, columns, rows):
    with open(file, "w", encoding="utf-8", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        table.writerow(columns.split(","))
        table.writerows(map(cells, rows))


def claims_rows(rows):
    for row in rows:
        for f in row.figures.values():
            e, b = f.estimate, f.band
            numbers = (e and float(e.value), e and e.error, b.low, b.high)
            yield row.id, row.engine, row.reading, b.label, *numbers, b.unit, row.verdict, row.why, f.verdict, " ".join(row.reasons)


# ---- What each reading, and each constant, changes.

#: label, unit, of a run: stresses as lg, since they change by factors
PROFILE_NUMBERS = (
    ("ν, ring 1", "", lambda run: run["volume_fraction"][0]),
    ("ν, bulk", "", lambda run: mean(run["volume_fraction"], run.zone(8, 16))),
    ("v_φ/(ΩR_i), ring 1", "", lambda run: run["azimuthal_velocity"][0] * over_rim_speed(run.leg)),
    ("B of v_φ", "d", lambda run: float(run.fit("velocity_decay"))),
    ("S d/(ΩD), ring 1", "", lambda run: run["spin"][0] * over_spin_scale(run.leg)),
    ("lg σ_rr [N/m²], bulk", "", lambda run: log10(mean(run["stress_rr"], run.zone(8, 16)))),
    ("lg σ_rφ [N/m²], ring 1", "", lambda run: log10(run["stress_rp"][0])),
    ("tr F, bulk", "", lambda run: mean(run["fabric_trace"], run.zone(8, 16))),
    ("wheel contacts", "", lambda run: run.regime.get("wheel_contacts")),
)
FAMILIES = ("spacing", "mass", "radius", "kn", "bottom", "friction", "rate")


def change_of(leg, reference):
    """(family, label) of the one thing in which a leg differs from the reference; None: of none, or several"""
    changes = [(each[0], describe(each, leg)) for each in OPEN if not same(each[2](leg), each[2](reference))]
    if not same(leg.kn, reference.kn):
        changes.append(("kn", f"k_n {setting(leg.kn)} N/m"))
    if leg.bottom_friction != reference.bottom_friction:
        changes.append(("bottom", "friction with the plate" if leg.bottom_friction else "no friction with the plate"))
    if not same(leg.mu, reference.mu):
        changes.append(("friction", f"µ = {setting(leg.mu)}"))
    if not same(leg.omega, reference.omega):
        changes.append(("rate", describe_rate(leg)))
    return changes[0] if len(changes) == 1 else None


def pairs_of(campaign, leg, engine):
    """The engine's runs of a leg, each with that of the default: of the same ν̄, rotations and index of the packing."""
    defaults = [
        each
        for each in campaign.legs
        if same_but(None, False, each, campaign.reference) and abs(each.label - leg.label) < 6e-4 and each.rotations == leg.rotations
    ]
    for run in campaign.of(leg, engine):
        others = [other for each in defaults for other in campaign.of(each, engine) if other.packing == run.packing]
        if others:
            yield run, others[0]


def readings_rows(campaign):
    for each_density, (k, engine) in itertools.product((False, True), enumerate(campaign.engines)):
        gathered = {}
        for leg in campaign.legs:
            change = change_of(leg, campaign.reference)
            if change and change[0] in leg.families:
                key = (*change, leg.rotations, leg.label if each_density else None)
                gathered.setdefault(key, []).extend(pairs_of(campaign, leg, engine))
        for (family, label, rotations, nu), pairs in sorted(gathered.items(), key=lambda item: FAMILIES.index(item[0][0])):
            if k > 0 and not pairs:
                continue
            for name, unit, of in PROFILE_NUMBERS:
                values = [(of(own), of(default)) for own, default in pairs]
                values = [pair for pair in values if is_number(pair[0]) and is_number(pair[1])]
                change = mean_over([own - default for own, default in values])
                default = mean_over([default for _, default in values])
                text = None if nu is None else f"{nu:.3f}"
                numbers = (default and default.value, change and change.value, change and change.error, len(values))
                yield engine, family, label, text, rotations, name, unit, *numbers


# ---- In what state packings are over volume fractions and rotations.


def regime_map_rows(campaign, rules):
    def group_of(leg):
        others = [describe(each, leg) for each in OPEN if not same(each[2](leg), each[2](campaign.reference))]
        return ", ".join((others or ["default"]) + [describe_rate(leg)])

    for engine in campaign.engines:
        groups = {group_of(campaign.reference): []}
        for leg in campaign.legs:
            if same_law(leg, campaign.reference):
                groups.setdefault(group_of(leg), []).extend(campaign.of(leg, engine))
        for group, runs in groups.items():
            seen = {}  # by ν̄ and rotation
            for run, rotation in itertools.product(longest_of_each_packing(runs), MAP_ROTATIONS):
                span = run.span(rotation)
                if span and span["wheel_contacts"] is not None:
                    seen.setdefault((run.leg.label, rotation), []).append((span["wheel_contacts"], span["outer_pressure"]))
            fewest = rules.common["wheel_contacts"]
            for (label, rotation), spans in sorted(seen.items()):
                contacts, pressure = (mean_over([s[k] for s in spans if s[k] is not None]) for k in (0, 1))
                carry = sum(s[0] >= fewest for s in spans)
                numbers = [number for e in (contacts, pressure) for number in (e and e.value, e and e.error)]
                yield engine, group, f"{label:.3f}", rotation, len(spans), carry, *numbers, None, None
            for rotation in MAP_ROTATIONS:
                states = [(label, s[0] >= fewest) for (label, r), spans in sorted(seen.items()) if r == rotation for s in spans]
                if states:
                    labels, carries = zip(*states)
                    found = critical_density(labels, carries, rules.claims["C6"].numbers["label_spread"]) or (None, None)
                    yield engine, group, None, rotation, len(states), sum(carries), None, None, None, None, *found


SPAN_NUMBERS = """outer_pressure wheel_torque wheel_contacts wheel_touched coordination volume_fraction_at_wheel
volume_fraction_outside velocity_at_wheel kinetic_energy max_overlap mean_overlap""".split()


def history_rows(campaign):
    for run in campaign.runs:
        for span in run.history:
            numbers = [span[name] for name in SPAN_NUMBERS]
            yield run.leg.name, run.engine, run.packing, float(span["from"]), float(span["to"]), *numbers


def write_all(campaign, rules, rows, out):
    claims = "id,engine,reading,figure,value,stderr,low,high,unit,verdict,why,figure_verdict,reasons"
    write(out / "claims.csv", claims, claims_rows(rows))
    readings = "engine,family,reading,nu,rotations,number,unit,default,change,stderr,pairs"
    with np.errstate(all="ignore"):
        write(out / "readings.csv", readings, readings_rows(campaign))
    states = "engine,group,nu,after_rotations,packings,carry,wheel_contacts,wheel_contacts_stderr,outer_pressure,outer_pressure_stderr"
    write(out / "regime_map.csv", states + ",critical_nu,critical_nu_stderr", regime_map_rows(campaign, rules))
    write(out / "history.csv", "leg,engine,packing,from_rotation,to_rotation," + ",".join(SPAN_NUMBERS), history_rows(campaign))
