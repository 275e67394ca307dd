"""C1 and C2: head-on collisions of two small disks, by the law in continuous time (crossgrain's oracle), by engines, and by the
discrete form of other time-stepping schemes."""

import math

import numpy as np

from laetzel.judge import Evidence, Reading, Scope, row_of
from laetzel.statistics import exactly

TENSION = {"allow": "tension allowed, as printed", "cut": "tension cut"}
LAWS = ("spring", "coulomb", "viscous", "spring_dashpot")
LAW_ITSELF = "-"  # no engine
SPEED = 0.01  # of approach [m/s]; the law is linear
PHASES = 20  # of the first touch within a step, which impacts are averaged over


def sweeps(variants, engine, tension, steps):
    """Of an engine at the time step next to so many steps per contact, by law: (Ψ_i, Ψ_f, e_n, µ)."""
    found = {}
    for variant in variants:
        curves = [variant["law"]] if engine == LAW_ITSELF else [c for c in variant["engines"] if c["engine"] == engine]
        if variant["tension"] != tension or not curves:
            continue
        curve = min(curves, key=lambda c: abs(math.log(c.get("steps", steps) / steps)))
        psi, after, en = (np.array(curve[name], float) for name in ("psi_i", "psi_f", "e_n"))
        found[variant["tangential"]] = psi, after, curve.get("e_n_closed", np.nanmean(en)), variant["mu"]
    return found


def figures_of(found, sliding_from):
    missing = lambda law: Evidence(missing=f'there is no sweep of the law "{law}"')
    lowest = lambda law: Evidence(exactly(np.min(found[law][1]))) if law in found else missing(law)
    def off_asymptote(law):
        """the largest distance from Ψ_i − 3(1 + e_n)µ, with its sign"""
        if law not in found:
            return missing(law)
        psi, after, en, mu = found[law]
        return Evidence(exactly(max((after - (psi - 3 * (1 + en) * mu))[psi >= sliding_from], key=abs)))

    # Figure 4.3 has no curve of the spring with dashpot.
    sliding = {f"sliding_{law}": off_asymptote(law) for law in ("coulomb", "viscous", "spring")}
    return {law: lowest(law) for law in LAWS} | sliding


def impact(scheme, kn, gn, mass, dt):
    """(e_n, duration) of a head-on impact by a scheme, velocities half a step late: of position Verlet the damper sees the velocity
    that it predicts for the force's own time, of semi-implicit Euler the one that it has."""
    restitution, duration = [], []
    for phase in range(PHASES):
        gap, velocity = SPEED * dt * (phase + 0.5) / PHASES, -SPEED
        acceleration, touched, steps = 0.0, False, 0
        while gap < 0 or not touched:
            velocity += acceleration * dt
            gap += velocity * dt
            seen = velocity if scheme == "semi_implicit_euler" else velocity + acceleration * dt / 2
            acceleration = (kn * -gap - gn * seen) / mass if gap < 0 else 0.0
            touched = touched or gap < 0
            steps += touched
        restitution.append(velocity / SPEED)
        duration.append((steps - 1) * dt)
    return np.mean(restitution), np.mean(duration)


def of_schemes(rule, law):
    """law: kn, gn [SI], mass of a small disk [kg] and the integrators' names"""
    kn, gn, mass = law["kn"], law["gn"], law["small_mass"] / 2
    dt = math.pi / math.sqrt(kn / mass - (gn / (2 * mass)) ** 2) / rule.numbers["steps_per_contact"]
    en, duration = impact("position_verlet", kn, gn, mass, dt)
    others = [impact(scheme, kn, gn, mass, dt) for scheme in ("velocity_verlet", "semi_implicit_euler")]
    changes = {"restitution": [e - en for e, _ in others], "duration": [d / duration - 1 for _, d in others]}
    return {name: Evidence(exactly(max(values, key=abs))) for name, values in changes.items()}


def judge_all(campaign, rules):
    """C1 of the law itself and of each engine, then C2."""
    rows, steps = [], rules.claims["C2"].numbers["steps_per_contact"]
    engines = sorted({curve["engine"] for variant in campaign.collisions for curve in variant["engines"]})
    for engine in [LAW_ITSELF, *engines]:
        rows += judge_engine(campaign, rules, engine, steps)
    rule = rules.claims["C2"]
    reading = Reading("", "head-on impacts at the thesis' step")
    rows.append(row_of(Scope(campaign, rules, rule, LAW_ITSELF, reading), of_schemes(rule, campaign.reference.law)))
    return rows


def judge_engine(campaign, rules, engine, steps):
    rule, rows = rules.claims["C1"], []
    for tension, label in TENSION.items():
        found = sweeps(campaign.collisions, engine, tension, steps)
        scope = Scope(campaign, rules, rule, engine, Reading("tension", label))
        rows.append(row_of(scope, figures_of(found, rule.numbers["sliding_from"])))
    return rows
