"""The claims C3 to C27, a function each: of a Scope the Evidence of every figure that claims.toml has of it. C1 and C2 are of
collisions (collisions.py)."""

import functools
import math

import numpy as np

from laetzel import cosserat
from laetzel.campaign import ROUNDING, axis, chosen, largest, mean, median, positive, rms, scatter
from laetzel.judge import Evidence, RunSet, Scope, is_number, readings_of, row_of
from laetzel.statistics import Estimate, critical_density, exactly, mean_over, power_law, slope_over_runs

CLAIMS = {}


def claim(name):
    def register(figures):
        CLAIMS[name] = figures
        return figures

    return register


def log10(x):
    return math.log10(x) if x > 0 else math.nan


def judge(campaign, rules, name, engine, reading):
    scope = Scope(campaign, rules, rules.claims[name], engine, reading)
    with np.errstate(all="ignore"):
        return row_of(scope, CLAIMS[name](scope))


def judge_all(campaign, rules):
    """A row for each claim and engine under the default reading, and for each further one that has runs."""
    rows = []
    for name in sorted(CLAIMS, key=lambda name: int(name[1:])):
        for engine in campaign.engines:
            for reading in readings_of(campaign):
                wanted = not reading.key or reading.key in rules.claims[name].readings
                if wanted and (not reading.key or any(campaign.of(leg, engine) for leg in reading.judged)):
                    rows.append(judge(campaign, rules, name, engine, reading))
    return rows


# ---- Averages, states and time.


@claim("C3")
def slicing_and_centres_meet_at_one_diameter(s):
    def difference(rings):
        return rms(rings.by("centre") - rings.by("slicing")) if rings else math.nan

    def fine(run):
        return run.fine(s["fewest_fine"])

    runs = s.at_label()
    return {
        "meeting": s.mean(runs, difference),
        "centre_peak": s.mean(runs, lambda run: largest(fine(run).by("centre")) if fine(run) else math.nan),
        "slicing_peak": s.mean(runs, lambda run: largest(fine(run).by("slicing")) if fine(run) else math.nan),
        "noise": s.mean(runs, lambda run: difference(fine(run)) / difference(run)),
    }


@claim("C4")
def steady_within_five_rotations(s):
    def steady(run):
        """The first span, and the first and the last of the time in which the thesis has its cell steady; () without."""
        begins = [k for k, span in enumerate(run.history) if span["from"] > s["steady_from"] - ROUNDING]
        ends = [k for k, span in enumerate(run.history) if span["to"] < s["steady_to"] + ROUNDING]
        if not begins or not ends or not 0 < begins[0] < ends[-1]:
            return ()
        return run.history[0], run.history[begins[0]], run.history[ends[-1]]

    def of_spans(number):
        """number(first, begin, end) of the spans; NaN without them"""

        def of(run):
            return number(*steady(run)) if steady(run) else math.nan

        return s.mean(runs, of)

    def of_late(number):
        def of(run):
            late = run.span(s["late"])
            return number(steady(run)[1], late) if steady(run) and late else math.nan

        return s.mean(runs, of)

    at_wheel, outside, pressure = "volume_fraction_at_wheel", "volume_fraction_outside", "outer_pressure"
    label = s["label"]
    runs = s.timed().where(lambda run: abs(run.leg.label - label) <= s["same_label"], f" at ν̄ = {label:g}")
    return {
        "inner_change": of_spans(lambda first, begin, end: end[at_wheel] - begin[at_wheel]),
        "early_less_late": of_spans(
            lambda first, begin, end: abs(begin[at_wheel] - first[at_wheel]) - abs(end[at_wheel] - begin[at_wheel])
        ),
        "outer_change": of_spans(lambda first, begin, end: end[outside] - first[outside]),
        "inner_late": of_late(lambda begin, late: late[at_wheel] - begin[at_wheel]),
        "pressure_late": of_late(lambda begin, late: math.log(late[pressure] / begin[pressure])),
    }


@claim("C5")
def dilatedzone(s):
    runs = s.flow()
    return {
        "width": s.mean(runs, lambda run: run.fit("dilation_decay").over(1)),
        "dilation": s.mean(runs, lambda run: float(run.fit("dilation")) * np.exp(-0.5 * float(run.fit("dilation_decay")))),
        "nu0": s.mean(runs, lambda run: run.fit("volume_fraction_outside")),
        "b": s.mean(runs, lambda run: run.fit("dilation")),
        "reach": s.mean(runs, lambda run: run.fit("dilation_decay").over(3)),
    }


@claim("C6")
def critical_volume_fraction(s):
    def followed(rotation):
        def there(run):
            span = run.span(rotation)
            return span is not None and span["wheel_contacts"] is not None

        runs = s.timed().where(there, f" followed for {rotation:g} rotations")
        return runs, [run.span(rotation)["wheel_contacts"] >= s["wheel_contacts"] for run in runs.runs]

    def critical(rotation):
        runs, carries = followed(rotation)
        found = critical_density([run.leg.label for run in runs.runs], carries, s["label_spread"])
        none = f"{sum(carries)} of {len(carries)} {runs.label} carry, from which no critical ν̄ follows"
        return Evidence(found and Estimate(*found, runs=len(carries)), none if carries else runs.missing(), runs.runs)

    def share(rotation):
        runs, carries = followed(rotation)
        return Evidence(mean_over([float(each) for each in carries]), runs.missing())

    def blocked(run):
        value = run.regime.get("blocked_share")
        return math.nan if value is None else value

    figures = {
        "critical": critical(s["thesis_rotation"]),
        "blocked_above": s.mean(s.blocked(), blocked),
        "blocked_below": s.mean(s.flow(), blocked),
    }
    times = (1, 2, 5, 10, 20)
    return figures | {f"critical_{t}": critical(t) for t in times} | {f"carry_{t}": share(t) for t in times}


# ---- Motion.


def over_rim_speed(leg):
    return 1 / (leg.omega * leg.inner)


def over_spin_scale(leg):
    """S d/(ΩD) of S, D = 2R_i"""
    return leg.d / (leg.omega * 2 * leg.inner)


@claim("C7")
def velocity_decays_exponentially(s):
    def roughness(run):
        """rms distance of ln v_φ from a straight line in r̃; of four rings or more that turn with the wheel"""
        speed = run["azimuthal_velocity"] / run.leg.omega
        rings = (run.r_tilde < s["fit_to"]) & (speed > 0)
        if rings.sum() < 4:
            return math.nan
        x, y = run.r_tilde[rings], np.log(speed[rings])
        return rms(y - np.polyval(np.polyfit(x, y, 1), x))

    runs = s.flow()
    return {
        "length": s.mean(runs, lambda run: run.fit("velocity_decay")),
        "roughness": s.mean(runs, roughness),
        "slip": s.mean(runs, lambda run: run.fit("velocity_amplitude")),
        "with_density": s.trend(s.upward(), lambda run: run.fit("velocity_amplitude")),
    }


@claim("C8")
def layers_spin_against_each_other(s):
    def period(run):
        """Twice the distance from the deepest trough to the highest peak beyond it, on fine rings."""
        fine = run.fine(s["fewest_fine"])
        if not fine:
            return math.nan
        spin = fine.by("centre" if "spin" in fine.profiles.get("centre", {}) else None, "spin") * run.leg.omega
        rings = np.isfinite(spin) & (fine.r_tilde <= s["period_within"])
        if rings.sum() < 4:
            return math.nan
        r_tilde, spin = fine.r_tilde[rings], spin[rings]
        trough = np.argmin(spin)
        peak = trough + np.argmax(spin[trough:])
        return 2 * (r_tilde[peak] - r_tilde[trough]) if peak > trough else math.nan

    runs, at_label = s.flow(), s.at_label()
    return {
        "first_layer": s.mean(runs, lambda run: run.ring("spin", 0) * over_spin_scale(run.leg)),
        "second_layer": s.mean(runs, lambda run: run.ring("spin", 1) * over_spin_scale(run.leg)),
        "period": s.mean(runs, period),
        "amplitude": s.mean(at_label, lambda run: run.fit("spin_amplitude")),
        "decay": s.mean(at_label, lambda run: run.fit("spin_decay")),
        "phase": s.mean(at_label, lambda run: run.fit("spin_phase")),
    }


@claim("C9")
def no_dependence_on_the_rate(s):
    to, slack = s["independent_to"], 1e-6 * s["independent_to"]
    rates = s.family("rate").where(lambda run: run.leg.label >= s["flow_from"], "")
    slow = rates.where(lambda run: abs(run.leg.omega) <= to + slack, f" up to Ω = {to:g} /s")
    fast = rates.where(lambda run: abs(run.leg.omega) >= to - slack, f" from Ω = {to:g} /s on")

    def pressure(run):
        return log10(run.averaged("outer_pressure"))

    return {
        "exponent": s.slope_in_rate(slow, pressure),
        "velocity": s.slope_in_rate(slow, lambda run: run["azimuthal_velocity"][0] * over_rim_speed(run.leg)),
        "length": s.slope_in_rate(slow, lambda run: np.log(float(run.fit("velocity_decay")))),
        "exponent_fast": s.slope_in_rate(fast, pressure),
    }


@claim("C10")
def radial_velocities(s):
    def width(run, where):
        """root mean square of fluctuations: stress of fluctuations over density"""
        k = run.near(s[where])
        return np.sqrt(run["fluctuation_stress_rr"][k] / run["density"][k])

    def mean_over_width(run, where):
        return run["radial_velocity"][run.near(s[where])] / width(run, where)

    runs = s.flow()
    return {
        "widths": s.mean(runs, lambda run: width(run, "inner") / width(run, "outer")),
        "inner_mean": s.mean(runs, lambda run: mean_over_width(run, "inner")),
        "outer_mean": s.mean(runs, lambda run: mean_over_width(run, "outer")),
        "width_with_density": s.trend(s.upward(), lambda run: width(run, "inner")),
    }


@claim("C11")
def velocity_and_spin_at_the_wheel(s):
    def joint(region):
        """Mean density of (v_φ/(ΩR_i), S d/(ΩD)) over the bins of region(v, s)"""

        def density(run):
            found = run.distribution("azimuthal_velocity_and_spin", None, axes=2)
            if found is None:
                return math.nan
            v, spin = np.meshgrid(found[0], found[1])
            return mean(found[2][region(v, spin)])

        return density

    def within(v, spin, times):
        return (abs(v) <= times * s["rest_velocity"]) & (abs(spin) <= times * s["rest_spin"])

    def stripe(v, distance):
        """away from rest and up to the wheel's own speed"""
        return (v > 2 * s["rest_velocity"]) & (v < 1) & (abs(distance) <= s["ridge_half_width"])

    def velocities(run, start, end):
        found = run.distribution("azimuthal_velocity", 0)
        return mean(found[1][(found[0] >= start) & (found[0] <= end)]) if found else math.nan

    rest = joint(lambda v, spin: within(v, spin, 1))
    beside_rest = joint(lambda v, spin: within(v, spin, 3) & ~within(v, spin, 1))
    ridge = joint(lambda v, spin: stripe(v, v - 1 - spin))
    beside_ridge = joint(lambda v, spin: stripe(v, abs(v - 1 - spin) - s["ridge_off"]))
    runs = s.upward()
    return {
        "ridge": s.mean(runs, lambda run: np.divide(ridge(run), beside_ridge(run))),
        "rest": s.mean(runs, lambda run: np.divide(rest(run), beside_rest(run))),
        "rest_with_density": s.trend(runs, rest),  # one window for all: as its share
        "second_peak": s.mean(runs, lambda run: np.divide(velocities(run, 0.42, 0.58), velocities(run, 0.18, 0.34))),
        "peak_at_one": s.mean(runs, lambda run: np.divide(velocities(run, 0.94, 1.06), velocities(run, 0.78, 0.90))),
    }


# ---- Structure.


@claim("C12")
def trace_of_fabric(s):
    def bulk(run):
        return mean(run["fabric_trace"], run.bulk)

    def off_identity(run):
        return largest(abs(run["fabric_trace"] / run["coordination"] / positive(run["volume_fraction"]) - 1), run.off_walls)

    runs = s.carrying(s.upward())
    return {
        "band": s.mean(runs, lambda run: mean(run["fabric_trace"], run.band) / bulk(run)),
        "outermost": s.mean(runs, lambda run: run["fabric_trace"][-1] / bulk(run)),
        "with_density": s.trend(runs, bulk),
        "identity": s.mean(runs, off_identity),
    }


@claim("C13")
def anisotropy_of_fabric(s):
    def share(run):
        return run["fabric_deviator"] / run["fabric_trace"]

    runs = s.carrying(s.upward())
    return {
        "axis": s.mean(runs, lambda run: np.degrees(axis(run["fabric_angle"], run.inside_band))),
        "with_density": s.trend(runs, lambda run: mean(share(run), run.band)),
        "with_distance": s.mean(runs, lambda run: mean(share(run), run.bulk) / mean(share(run), run.band)),
    }


@claim("C14")
def directions_of_contacts(s):
    def directions(run, ring):
        return run.distribution("contact_direction", ring)

    def near(run, ring, angle):
        """density relative to uniform about the angle, opposite directions taken together"""
        found = directions(run, ring)
        if found is None:
            return math.nan
        off = found[0] - angle
        return 2 * np.pi * mean(found[1][abs(off - np.pi * np.round(off / np.pi)) <= s["window"]])

    def in_band(angle):
        """in the rings at the wheel and 2 d out (figures 7.9 a and b)"""
        return lambda run: np.mean([near(run, run.near(0.5), angle), near(run, run.near(2.5), angle)])

    def outermost(run, angle):
        return near(run, run.count - 1, angle)

    def anisotropy(run, r_tilde):
        """root mean square distance from uniform"""
        found = directions(run, run.near(r_tilde))
        if found is None:
            return math.nan
        density = found[1]
        return rms(np.pi * (density + np.roll(density, len(density) // 2)) - 1)

    runs = s.at_label()
    return {
        "tangential": s.mean(runs, in_band(np.pi / 2)),
        "shear_side": s.mean(runs, in_band(np.pi / 6)),
        "other_side": s.mean(runs, in_band(5 * np.pi / 6)),
        "homogeneous": s.mean(runs, lambda run: np.mean([anisotropy(run, 8), anisotropy(run, 12)]) / anisotropy(run, 0.5)),
        "outer_lattice": s.mean(runs, lambda run: np.min([outermost(run, a) for a in (-np.pi / 6, np.pi / 6, np.pi / 2)])),
        "outer_symmetry": s.mean(runs, lambda run: np.divide(outermost(run, -np.pi / 6), outermost(run, np.pi / 6))),
    }


# ---- Stress.


@claim("C15")
def stress_over_the_radius(s):
    def exponent(field):
        def of(run):
            there = run.off_walls
            return power_law(run.r[there] / run.leg.inner, run[field][there], run.errors(field)[there])

        return of

    def off_walls(run, field):
        return mean(run[field], run.off_walls)

    def torque(run):
        """r(r σ_φr + M_zr)"""
        return run.r * (run.r * run["stress_pr"] + run["couple_stress_zr"])

    runs = s.carrying(s.upward())
    without = s.family("bottom").where(lambda run: not run.leg.bottom_friction, " without bottom friction")
    return {
        "exponent_rp": s.mean(runs, exponent("stress_rp")),
        "exponent_pr": s.mean(runs, exponent("stress_pr")),
        "diagonal": s.mean(runs, lambda run: off_walls(run, "stress_pp") / off_walls(run, "stress_rr")),
        "constant": s.mean(runs, lambda run: scatter(run["stress_rr"], run.off_walls)),
        "symmetry": s.mean(runs, lambda run: off_walls(run, "stress_pr") / off_walls(run, "stress_rp")),
        "balance": s.mean(without, lambda run: scatter(torque(run), run.off_walls)),
    }


@claim("C16")
def dynamic_stress(s):
    def trace(run, kind):
        return run[f"{kind}stress_rr"][0] + run[f"{kind}stress_pp"][0]

    def log_ratio(a, b):
        return lambda run: mean(np.log(abs(run[f"dynamic_stress_{a}"] / run[f"dynamic_stress_{b}"])), run.band)

    runs = s.carrying(s.flow())
    return {
        "orders": s.mean(runs, lambda run: log10(trace(run, "") / trace(run, "dynamic_"))),
        "pp_over_rr": s.mean(runs, log_ratio("pp", "rr")),
        "rr_over_rp": s.mean(runs, log_ratio("rr", "rp")),
    }


@claim("C17")
def stresses_grow_with_density(s):
    def off_walls(field):
        return lambda run: mean(run[field], run.off_walls)

    def share(run):
        return run["stress_deviator"] / run["stress_trace"]

    runs = s.carrying(s.upward())
    return {
        "rr_with_density": s.trend(s.upward(), off_walls("stress_rr")),
        "rp_with_density": s.trend(s.upward(), off_walls("stress_rp")),
        "dev_with_density": s.trend(runs, lambda run: mean(share(run), run.band)),
        "dev_with_distance": s.mean(runs, lambda run: mean(share(run), run.bulk) / mean(share(run), run.band)),
        "rr": s.mean(s.at_label(), lambda run: log10(off_walls("stress_rr")(run))),
    }


# ---- Deformation, and stiffness.


@claim("C18")
def elastic_deformation(s):
    def in_band(run):
        return mean(run["strain_trace"], run.band) / mean(run["strain_trace"], run.bulk)

    def log_share(tensor):
        return lambda run: np.log(mean(run[f"{tensor}_deviator"] / run[f"{tensor}_trace"], run.band))

    low = s.carrying(s.densities(s["flow_from"], s["low_to"], "of low ν̄"))
    drawn = s.carrying(s.densities(s["flow_from"], s["change_to"] + s["same_label"], "of the figure's ν̄"))
    span = s["change_to"] - s["change_from"]
    return {
        "band": s.mean(low, in_band),
        "flatter": s.trend(s.carrying(s.upward()), in_band),
        "deviator": s.slope_in_density(drawn, log_share("strain"), span),
        "fabric": s.slope_in_density(drawn, log_share("fabric"), span),
    }


@claim("C19")
def axes_are_not_collinear(s):
    def between(a, b):
        return lambda run: np.degrees(axis(run[f"{a}_angle"] - run[f"{b}_angle"], run.inside_band))

    runs = s.carrying(s.upward())
    return {
        "fabric_stress": s.mean(runs, between("fabric", "stress")),
        "stress_strain": s.mean(runs, between("stress", "strain")),
    }


@claim("C20")
def stiffness_collapses_on_the_fabric(s):
    judged = s.carrying(s.upward())

    def enough(run, values):
        return np.where(run["fabric_trace"] >= s["least_trace"], values, np.nan)

    def ratios(run):
        """E over the mean field's, off the walls, in rings that hold enough contacts"""
        return chosen(enough(run, run["bulk_modulus"] / run["mean_field_modulus"]), run.off_walls)

    def excess(run):
        return mean(ratios(run)) - 1

    def beyond_judged(run):
        """the excess beyond the judged run's of the same packing; where there is none, beyond the mean of that label's"""
        others = [(other, excess(other)) for other in judged.runs if abs(other.leg.label - run.leg.label) <= s["same_label"]]
        others = [(other, value) for other, value in others if is_number(value)]
        same = [value for other, value in others if other.identity == run.identity]
        return excess(run) - (same or [np.mean([value for _, value in others]) if others else np.nan])[0]

    def off_identity(run):
        identity = run["fabric_deviator"] / run["fabric_trace"] * run["strain_deviator"] / run["strain_trace"]
        identity = identity * np.cos(2 * (run["strain_angle"] - run["fabric_angle"]))
        return largest(abs(enough(run, run["bulk_modulus"] / run["mean_field_modulus"]) - 1 - identity), run.off_walls)

    all_ratios = np.concatenate([ratios(run) for run in judged.runs] or [np.zeros(0)])
    kn = judged.runs[0].leg.kn if judged.runs else 0
    others = s.family("kn").where(lambda run: run.leg.kn != kn, " of another k_n")
    frictionless = s.family("friction").where(lambda run: run.leg.mu == 0, " without friction")
    return {
        "mean_field": s.mean(judged, excess),
        "collapse": s.mean(judged, lambda run: rms(ratios(run) - np.mean(all_ratios))),
        "stiffness": s.mean(s.carrying(others), beyond_judged),
        "frictionless": s.mean(s.carrying(frictionless), beyond_judged),
        "identity": s.mean(judged, off_identity),
    }


def shear_ratio(run):
    return positive(run["shear_modulus"] / run["fabric_trace"])


@claim("C21")
def shear_resistance_in_the_band(s):
    def logarithms(run):
        there = run.band & np.isfinite(shear_ratio(run))
        trace = run["fabric_trace"][there]
        return np.log(np.stack([trace, shear_ratio(run)[there] * trace]))

    runs = s.carrying(s.flow())
    points = [own for own in map(logarithms, runs.runs) if own.size]
    few = f"{runs.label}: fewer than three with the data, or of one tr F"
    return {
        "exponent": Evidence(slope_over_runs(points), few if points else runs.missing(), runs.runs),
        "divergence": s.mean(runs, lambda run: median(shear_ratio(run), run.bulk) / median(shear_ratio(run), run.band)),
    }


def divergence_trace(run, factor):
    """tr F of the ring from which on, to the last that is examined, G/tr F is above the factor times its median in the band; NaN
    where the last ring is not. Rings whose G is not positive count nowhere."""
    ratio, found = shear_ratio(run), math.nan
    limit = factor * median(ratio, run.band)
    examined = (run.r_tilde >= run.common["first_layer_to"]) & (run.r_tilde < run.common["bulk_to"]) & np.isfinite(ratio)
    for k in reversed(np.flatnonzero(examined)):
        if not ratio[k] > limit:
            break
        found = run["fabric_trace"][k]
    return found


@claim("C27")
def trace_at_which_shear_resistance_diverges(s):
    def trace(run):
        return divergence_trace(run, s["factor"])

    runs = s.carrying(s.upward())
    return {
        "with_density": s.trend(runs, trace),
        "slope": s.slope_in_density(runs, trace),
        "trace": s.mean(s.carrying(s.flow()), trace),
    }


# ---- Rotation, couples and Mohan's model.


@claim("C22")
def spin_follows_the_continuum(s):
    def layers(run, field):
        return mean(run[field], run.r_tilde < s["layers_to"])

    def alternates(run):
        first, second, third = run["excess_rotation"][:3]
        return (2 * second - first - third) / (4 * run.leg.omega)

    return {
        "follows": s.mean(s.flow(), lambda run: layers(run, "spin") / layers(run, "continuum_rotation")),
        "oscillates": s.mean(s.flow(), alternates),
    }


@claim("C23")
def couple_stress_and_torque_resistance(s):
    def resistance(run, zone):
        return median(run["torque_resistance"], zone)

    def over_identity(run):
        ratio = median(run["torque_resistance"] / run["fabric_trace"], run.bulk)
        return ratio * 2 * np.pi * run.leg.cell["height"] / run.leg.kt

    runs = s.carrying(s.upward())
    return {
        "wheel": s.mean(runs, lambda run: abs(run["couple_stress_zr"][0]) / rms(run["couple_stress_zr"], run.bulk)),
        "with_distance": s.mean(runs, lambda run: resistance(run, run.bulk) / resistance(run, run.band)),
        "with_density": s.trend(runs, lambda run: resistance(run, run.bulk)),
        "identity": s.mean(runs, over_identity),
    }


@functools.cache
def model_as_printed():
    """ξ and the model's fields there, finer than any ring: u falls by a tenth between points."""
    xi = np.linspace(0, 1, 401)
    return xi, cosserat.solve()(xi)


def distance_from_model(leg, r, values, field):
    """Root mean square of ln(model/run) over rings, both relative to the first ring."""
    xi, fields = model_as_printed()
    model = np.interp((r - leg.inner) / leg.gap, xi, np.log(positive(fields[field])))
    off = model - np.log(positive(values))
    return rms(off - off[0]) if np.isfinite(off).sum() >= 3 and np.isfinite(off[0]) else math.nan


@claim("C24")
def mohans_model(s):
    def velocity(run):
        rings = run.r_tilde < s["fit_to"]
        return distance_from_model(run.leg, run.r[rings], run["azimuthal_velocity"][rings], "u")

    def spin(run):
        """of each ring with the one outside of it, at the edge between them: the oscillation from layer to layer cancels"""
        rings = (run.r_tilde < s["fit_to"]) & np.isfinite(run["spin"])
        r, spins = run.r[rings], run["spin"][rings]
        return distance_from_model(run.leg, (r[1:] + r[:-1]) / 2, abs(spins[1:] + spins[:-1]) / 2, "omega")

    def asymmetry(run):
        rp, pr = run["stress_rp"][0], run["stress_pr"][0]
        return 2 * (pr - rp) / (pr + rp)

    def couple_in_the_model(run):
        scale = s["particle_diameter"] * s["length_ratio"] * math.sqrt(2 * (s["shape"] + 1))
        return abs(run["couple_stress_zr"][0]) / scale / mean(run["stress_rr"], run.off_walls)

    m = model_as_printed()[1]["m"]
    runs = s.carrying(s.flow())
    return {
        "velocity": s.mean(runs, velocity),
        "spin": s.mean(runs, spin),
        "asymmetry": s.mean(runs, asymmetry),
        "model_couple": Evidence(exactly(m[-1] / m[0])),
        "couple": s.mean(runs, lambda run: rms(run["couple_stress_zr"], run.bulk) / abs(run["couple_stress_zr"][0])),
        "couple_size": s.mean(runs, couple_in_the_model),
    }


# ---- Cost, and size.


@claim("C25")
def what_a_rotation_cost(s):
    def rotation(run):
        """CPU seconds at the rule's rate"""
        return run.data["cpu_s"] / run.data["steps"] * (2 * np.pi / s["omega"] / run.data["dt"])

    return {
        "speed_up": s.mean(s.flow(), lambda run: s["days"] * 86400 / rotation(run)),
        "hours": s.mean(s.flow(), lambda run: rotation(run) / 3600),
    }


@claim("C26")
def size_of_overlaps(s):
    def overlap(name):
        return lambda run: log10(run.head.get(name, math.nan) * run.leg.d)

    return {
        "overlap": s.mean(s.flow(), overlap("max_overlap_over_d")),
        "trace": s.mean(s.flow(), lambda run: log10(mean(run["stress_trace"], run.off_walls))),
        "mean_overlap": s.mean(s.flow(), overlap("mean_overlap_over_d")),
        "overlap_804": s.mean(s.at_label(), overlap("max_overlap_over_d")),
    }
