"""The claims C3 to C27, a function each: of a Scope the Evidence of every figure that claims.toml has of it, in the order of reports.
C1 and C2 are of collisions (collisions.py). A number is a function of a run; a field is one that gives an array over its rings."""

import functools
import math

import numpy as np

from laetzel import cosserat
from laetzel.campaign import ROUNDING, axis, chosen, largest, mean, median, positive, rms, scatter
from laetzel.judge import Evidence, Scope, is_number, readings_of, row_of
from laetzel.statistics import Estimate, critical_density, exactly, mean_over, power_law, slope_over_runs

CLAIMS = {}


def claim(name):
    return lambda figures: CLAIMS.setdefault(name, figures)


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
                has_runs = any(campaign.of(leg, engine) for leg in reading.judged)
                if not reading.key or (reading.key in rules.claims[name].readings and has_runs):
                    rows.append(judge(campaign, rules, name, engine, reading))
    return rows


def field(name):
    return lambda run: run[name]


def fitted(name):
    return lambda run: run.fit(name)


def share(tensor):
    return lambda run: run[f"{tensor}_deviator"] / run[f"{tensor}_trace"]


def inside(zone, rings, statistic=mean):
    """of the rings of a zone: band, inside_band, bulk, off_walls"""
    return lambda run: statistic(rings(run), getattr(run, zone))


def ratio(a, b):
    return lambda run: np.divide(a(run), b(run))


def bulk_over_band(rings, statistic=mean):
    return ratio(inside("bulk", rings, statistic), inside("band", rings, statistic))


def log10(x):
    return math.log10(x) if x > 0 else math.nan


def lg(number):
    return lambda run: log10(number(run))


def over_rim_speed(leg):
    return 1 / (leg.omega * leg.inner)


def over_spin_scale(leg):
    """S d/(ΩD) of S, D = 2R_i"""
    return leg.d / (leg.omega * 2 * leg.inner)


@claim("C3")
def slicing_and_centres_meet_at_one_diameter(s):
    difference = lambda rings: rms(rings.by("centre") - rings.by("slicing")) if rings else math.nan
    peak = lambda method: lambda run: largest(fine(run).by(method)) if fine(run) else math.nan
    fine = lambda run: run.fine(s["fewest_fine"])
    runs = s.at_label()
    peaks = {"centre_peak": peak("centre"), "slicing_peak": peak("slicing")}
    return s.means(runs, meeting=difference, **peaks, noise=ratio(lambda run: difference(fine(run)), difference))


@claim("C4")
def steady_within_five_rotations(s):
    def of_spans(number):
        """number(first, begin, end, late) of a run's spans: the first, the first and the last of the time in which the thesis has
        its cell steady, a late one"""

        def of(run):
            begins = [k for k, span in enumerate(run.history) if span["from"] > s["steady_from"] - ROUNDING]
            ends = [k for k, span in enumerate(run.history) if span["to"] < s["steady_to"] + ROUNDING]
            if not begins or not ends or not 0 < begins[0] < ends[-1]:
                return math.nan
            absent = dict.fromkeys(run.history[0], math.nan)
            return number(run.history[0], run.history[begins[0]], run.history[ends[-1]], run.span(s["late"]) or absent)

        return s.mean(runs, of)

    wheel, outside, pressure = "volume_fraction_at_wheel", "volume_fraction_outside", "outer_pressure"
    label = s["label"]
    runs = s.timed().where(lambda run: abs(run.leg.label - label) <= s["same_label"], f" at ν̄ = {label:g}")
    return {
        "inner_change": of_spans(lambda first, begin, end, late: end[wheel] - begin[wheel]),
        "early_less_late": of_spans(lambda first, begin, end, late: abs(begin[wheel] - first[wheel]) - abs(end[wheel] - begin[wheel])),
        "outer_change": of_spans(lambda first, begin, end, late: end[outside] - first[outside]),
        "inner_late": of_spans(lambda first, begin, end, late: late[wheel] - begin[wheel]),
        "pressure_late": of_spans(lambda first, begin, end, late: np.log(late[pressure] / begin[pressure])),
    }


@claim("C5")
def dilated_zone(s):
    dilation_of_ring_1 = lambda run: float(run.fit("dilation")) * np.exp(-0.5 * float(run.fit("dilation_decay")))
    width = lambda run: run.fit("dilation_decay").over(1)
    reach = lambda run: run.fit("dilation_decay").over(3)
    outside, b = fitted("volume_fraction_outside"), fitted("dilation")
    return s.means(s.flow(), width=width, dilation=dilation_of_ring_1, nu0=outside, b=b, reach=reach)


@claim("C6")
def critical_volume_fraction(s):
    def followed(rotation):
        """runs that were followed so long, and whether each carries then"""
        runs = s.timed().where(lambda run: run.contacts_in(rotation) is not None, f" followed for {rotation:g} rotations")
        return runs, [run.contacts_in(rotation) >= s["wheel_contacts"] for run in runs.runs]

    def critical(rotation):
        runs, carries = followed(rotation)
        found = critical_density([run.leg.label for run in runs.runs], carries, s["label_spread"])
        none = f"{sum(carries)} of {len(carries)} {runs.label} carry, from which no critical ν̄ follows"
        return Evidence(found and Estimate(*found, runs=len(carries)), none if carries else runs.missing(), runs.runs)

    def share_that_carries(rotation):
        runs, carries = followed(rotation)
        return Evidence(mean_over([float(each) for each in carries]), runs.missing())

    blocked = lambda run: run.regime.get("blocked_share")
    times, figures = (1, 2, 5, 10, 20), {"critical": critical(s["thesis_rotation"])}
    figures |= s.means(s.blocked(), blocked_above=blocked) | s.means(s.flow(), blocked_below=blocked)
    return figures | {f"critical_{t}": critical(t) for t in times} | {f"carry_{t}": share_that_carries(t) for t in times}


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

    length, amplitude = fitted("velocity_decay"), fitted("velocity_amplitude")
    return s.means(s.flow(), length=length, roughness=roughness, slip=amplitude) | s.trends(s.upward(), with_density=amplitude)


@claim("C8")
def layers_spin_against_each_other(s):
    def period(run):
        """Twice the distance from the deepest trough to the highest peak beyond it, on fine rings."""
        fine = run.fine(s["fewest_fine"])
        if not fine:
            return math.nan
        spin = fine.by("centre", "spin") * run.leg.omega
        rings = np.isfinite(spin) & (fine.r_tilde <= s["period_within"])
        if rings.sum() < 4:
            return math.nan
        r_tilde, spin = fine.r_tilde[rings], spin[rings]
        trough = np.argmin(spin)
        peak = trough + np.argmax(spin[trough:])
        return 2 * (r_tilde[peak] - r_tilde[trough]) if peak > trough else math.nan

    layer = lambda k: lambda run: run.ring("spin", k) * over_spin_scale(run.leg)
    fits = {name: fitted(f"spin_{name}") for name in ("amplitude", "decay", "phase")}
    return s.means(s.flow(), first_layer=layer(0), second_layer=layer(1), period=period) | s.means(s.at_label(), **fits)


@claim("C9")
def no_dependence_on_the_rate(s):
    to, slack = s["independent_to"], 1e-6 * s["independent_to"]
    rates = s.family("rate").where(lambda run: run.leg.label >= s["flow_from"], "")
    slow = rates.where(lambda run: abs(run.leg.omega) <= to + slack, f" up to Ω = {to:g} /s")
    fast = rates.where(lambda run: abs(run.leg.omega) >= to - slack, f" from Ω = {to:g} /s on")
    pressure = lg(lambda run: run.averaged("outer_pressure"))
    return {
        "exponent": s.slope_in_rate(slow, pressure),
        "velocity": s.slope_in_rate(slow, lambda run: run["azimuthal_velocity"][0] * over_rim_speed(run.leg)),
        "length": s.slope_in_rate(slow, lambda run: np.log(float(run.fit("velocity_decay")))),
        "exponent_fast": s.slope_in_rate(fast, pressure),
    }


@claim("C10")
def radial_velocities(s):
    at = lambda where, rings: lambda run: rings(run)[run.near(s[where])]
    # root mean square of fluctuations: stress of fluctuations over density
    width = lambda run: np.sqrt(run["fluctuation_stress_rr"] / run["density"])
    relative = ratio(field("radial_velocity"), width)
    widths = ratio(at("inner", width), at("outer", width))
    figures = s.means(s.flow(), widths=widths, inner_mean=at("inner", relative), outer_mean=at("outer", relative))
    return figures | s.trends(s.upward(), width_with_density=at("inner", width))


@claim("C11")
def velocity_and_spin_at_the_wheel(s):
    # mean density of (v_φ/(ΩR_i), S d/(ΩD)) over the bins of region(v, s)
    joint = lambda region: lambda run: density_where(run.distribution("azimuthal_velocity_and_spin", None), region)
    def velocities(start, end):
        return lambda run: density_where(run.distribution("azimuthal_velocity", 0), lambda v: (v >= start) & (v <= end))

    within = lambda v, spin, times: (abs(v) <= times * s["rest_velocity"]) & (abs(spin) <= times * s["rest_spin"])
    # away from rest and up to the wheel's own speed
    stripe = lambda v, distance: (v > 2 * s["rest_velocity"]) & (v < 1) & (abs(distance) <= s["ridge_half_width"])
    rest = joint(lambda v, spin: within(v, spin, 1))
    beside_rest = joint(lambda v, spin: within(v, spin, 3) & ~within(v, spin, 1))
    ridge = joint(lambda v, spin: stripe(v, v - 1 - spin))
    beside_ridge = joint(lambda v, spin: stripe(v, abs(v - 1 - spin) - s["ridge_off"]))
    half, one = ratio(velocities(0.42, 0.58), velocities(0.18, 0.34)), ratio(velocities(0.94, 1.06), velocities(0.78, 0.90))
    runs = s.upward()
    figures = s.means(runs, ridge=ratio(ridge, beside_ridge), rest=ratio(rest, beside_rest))
    figures |= s.trends(runs, rest_with_density=rest)  # one window for all: as its share
    return figures | s.means(runs, second_peak=half, peak_at_one=one)


def density_where(distribution, region):
    """Mean density over the bins of region(middles of each axis …); NaN without a distribution."""
    if distribution is None:
        return math.nan
    *middles, density = distribution
    return mean(density[region(*np.meshgrid(*middles))])


@claim("C12")
def trace_of_fabric(s):
    off_identity = lambda run: abs(run["fabric_trace"] / run["coordination"] / positive(run["volume_fraction"]) - 1)
    trace, runs = field("fabric_trace"), s.carrying(s.upward())
    bulk, identity = inside("bulk", trace), inside("off_walls", off_identity, largest)
    figures = s.means(runs, band=ratio(inside("band", trace), bulk), outermost=ratio(lambda run: run["fabric_trace"][-1], bulk))
    return figures | s.trends(runs, with_density=bulk) | s.means(runs, identity=identity)


@claim("C13")
def anisotropy_of_fabric(s):
    runs, of_band = s.carrying(s.upward()), inside("band", share("fabric"))
    figures = s.means(runs, axis=lambda run: np.degrees(axis(run["fabric_angle"], run.inside_band)))
    return figures | s.trends(runs, with_density=of_band) | s.means(runs, with_distance=bulk_over_band(share("fabric")))


@claim("C14")
def directions_of_contacts(s):
    def near(run, ring, angle):
        """density relative to uniform about the angle, opposite directions taken together"""

        def window(direction):
            off = direction - angle
            return abs(off - np.pi * np.round(off / np.pi)) <= s["window"]

        return 2 * np.pi * density_where(run.distribution("contact_direction", ring), window)

    # in the rings at the wheel and 2 d out (figures 7.9 a and b)
    in_band = lambda angle: lambda run: np.mean([near(run, run.near(0.5), angle), near(run, run.near(2.5), angle)])
    outermost = lambda angle: lambda run: near(run, run.count - 1, angle)
    def anisotropy(*places):
        """root mean square distance from uniform"""

        def at(run, r_tilde):
            found = run.distribution("contact_direction", run.near(r_tilde))
            return rms(np.pi * (found[1] + np.roll(found[1], len(found[1]) // 2)) - 1) if found else math.nan

        return lambda run: np.mean([at(run, r_tilde) for r_tilde in places])

    left, right, out = outermost(-np.pi / 6), outermost(np.pi / 6), outermost(np.pi / 2)
    band = {"tangential": in_band(np.pi / 2), "shear_side": in_band(np.pi / 6), "other_side": in_band(5 * np.pi / 6)}
    lattice = lambda run: np.min([left(run), right(run), out(run)])
    homogeneous = ratio(anisotropy(8, 12), anisotropy(0.5))
    return s.means(s.at_label(), **band, homogeneous=homogeneous, outer_lattice=lattice, outer_symmetry=ratio(left, right))


@claim("C15")
def stress_over_the_radius(s):
    def exponent(name):
        def of(run):
            there = run.off_walls
            return power_law(run.r[there] / run.leg.inner, run[name][there], run.errors(name)[there])

        return of

    torque = lambda run: run.r * (run.r * run["stress_pr"] + run["couple_stress_zr"])  # r(r σ_φr + M_zr)
    rr, pp, rp, pr = (inside("off_walls", field(f"stress_{of}")) for of in ("rr", "pp", "rp", "pr"))
    exponents = {"exponent_rp": exponent("stress_rp"), "exponent_pr": exponent("stress_pr")}
    constant = inside("off_walls", field("stress_rr"), scatter)
    without = s.family("bottom").where(lambda run: not run.leg.bottom_friction, " without bottom friction")
    figures = s.means(s.carrying(s.upward()), **exponents, diagonal=ratio(pp, rr), constant=constant, symmetry=ratio(pr, rp))
    return figures | s.means(without, balance=inside("off_walls", torque, scatter))


@claim("C16")
def dynamic_stress(s):
    trace = lambda kind: lambda run: run[f"{kind}stress_rr"][0] + run[f"{kind}stress_pp"][0]
    log_ratio = lambda a, b: inside("band", lambda run: np.log(abs(run[f"dynamic_stress_{a}"] / run[f"dynamic_stress_{b}"])))
    orders = lg(ratio(trace(""), trace("dynamic_")))
    return s.means(s.carrying(s.flow()), orders=orders, pp_over_rr=log_ratio("pp", "rr"), rr_over_rp=log_ratio("rr", "rp"))


@claim("C17")
def stresses_grow_with_density(s):
    rr, rp = (inside("off_walls", field(f"stress_{of}")) for of in ("rr", "rp"))
    runs = s.carrying(s.upward())
    figures = s.trends(s.upward(), rr_with_density=rr, rp_with_density=rp)
    figures |= s.trends(runs, dev_with_density=inside("band", share("stress")))
    return figures | s.means(runs, dev_with_distance=bulk_over_band(share("stress"))) | s.means(s.at_label(), rr=lg(rr))


@claim("C18")
def elastic_deformation(s):
    def change(tensor):
        """along the regression line"""
        band = inside("band", share(tensor))
        return s.slope_in_density(drawn, lambda run: np.log(band(run)), s["change_to"] - s["change_from"])

    band_over_bulk = ratio(*(inside(zone, field("strain_trace")) for zone in ("band", "bulk")))
    low = s.carrying(s.densities(s["flow_from"], s["low_to"], "of low ν̄"))
    drawn = s.carrying(s.densities(s["flow_from"], s["change_to"] + s["same_label"], "of the figure's ν̄"))
    figures = s.means(low, band=band_over_bulk) | s.trends(s.carrying(s.upward()), flatter=band_over_bulk)
    return figures | {"deviator": change("strain"), "fabric": change("fabric")}


@claim("C19")
def axes_are_not_collinear(s):
    between = lambda a, b: lambda run: np.degrees(axis(run[f"{a}_angle"] - run[f"{b}_angle"], run.inside_band))
    both = {"fabric_stress": between("fabric", "stress"), "stress_strain": between("stress", "strain")}
    return s.means(s.carrying(s.upward()), **both)


@claim("C20")
def stiffness_collapses_on_the_fabric(s):
    def ratios(run):
        """E over the mean field's, in rings that hold enough contacts"""
        return np.where(run["fabric_trace"] >= s["least_trace"], run["bulk_modulus"] / run["mean_field_modulus"], np.nan)

    excess = lambda run: mean(ratios(run), run.off_walls) - 1
    def beyond_judged(run):
        """beyond the judged run's excess of the same packing; where there is none, beyond the mean of that label's"""
        others = [(other, excess(other)) for other in judged.runs if abs(other.leg.label - run.leg.label) <= s["same_label"]]
        others = [(other, value) for other, value in others if is_number(value)]
        same = [value for other, value in others if other.identity == run.identity]
        return excess(run) - (same or [np.mean([value for _, value in others]) if others else np.nan])[0]

    def off_identity(run):
        turned = np.cos(2 * (run["strain_angle"] - run["fabric_angle"]))
        return abs(ratios(run) - 1 - share("fabric")(run) * share("strain")(run) * turned)

    judged = s.carrying(s.upward())
    everywhere = np.mean(np.concatenate([chosen(ratios(run), run.off_walls) for run in judged.runs] or [[math.nan]]))
    kn = judged.runs[0].leg.kn if judged.runs else 0
    others = s.family("kn").where(lambda run: run.leg.kn != kn, " of another k_n")
    frictionless = s.family("friction").where(lambda run: run.leg.mu == 0, " without friction")
    figures = s.means(judged, mean_field=excess, collapse=lambda run: rms(ratios(run) - everywhere, run.off_walls))
    figures |= s.means(s.carrying(others), stiffness=beyond_judged) | s.means(s.carrying(frictionless), frictionless=beyond_judged)
    return figures | s.means(judged, identity=inside("off_walls", off_identity, largest))


def shear_ratio(run):
    """G/tr F; rings whose G is not positive count nowhere"""
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
        "divergence": s.mean(runs, bulk_over_band(shear_ratio, median)),
    }


def divergence_trace(factor):
    """tr F of the ring from which on, to the last that is examined, G/tr F is above the factor times its median in the band; NaN
    where the last ring is not."""

    def of(run):
        values, found = shear_ratio(run), math.nan
        limit = factor * median(values, run.band)
        examined = (run.r_tilde >= run.common["first_layer_to"]) & (run.r_tilde < run.common["bulk_to"]) & np.isfinite(values)
        for k in reversed(np.flatnonzero(examined)):
            if not values[k] > limit:
                break
            found = run["fabric_trace"][k]
        return found

    return of


@claim("C27")
def trace_at_which_shear_resistance_diverges(s):
    trace, runs = divergence_trace(s["factor"]), s.carrying(s.upward())
    figures = s.trends(runs, with_density=trace) | {"slope": s.slope_in_density(runs, trace)}
    return figures | s.means(s.carrying(s.flow()), trace=trace)


@claim("C22")
def spin_follows_the_continuum(s):
    layers = lambda name: lambda run: mean(run[name], run.r_tilde < s["layers_to"])
    def alternates(run):
        first, second, third = run["excess_rotation"][:3]
        return (2 * second - first - third) / (4 * run.leg.omega)

    return s.means(s.flow(), follows=ratio(layers("spin"), layers("continuum_rotation")), oscillates=alternates)


def couple_at_wheel(run):
    return abs(run["couple_stress_zr"][0])


COUPLE_OF_BULK = inside("bulk", field("couple_stress_zr"), rms)


@claim("C23")
def couple_stress_and_torque_resistance(s):
    over_identity = lambda run: run["torque_resistance"] / run["fabric_trace"] * 2 * np.pi * run.leg.cell["height"] / run.leg.kt
    resistance, runs = field("torque_resistance"), s.carrying(s.upward())
    figures = s.means(runs, wheel=ratio(couple_at_wheel, COUPLE_OF_BULK), with_distance=bulk_over_band(resistance, median))
    figures |= s.trends(runs, with_density=inside("bulk", resistance, median))
    return figures | s.means(runs, identity=inside("bulk", over_identity, median))


@functools.cache
def model_as_printed():
    """ξ and the model's fields there, finer than any ring: u falls by a tenth between points."""
    xi = np.linspace(0, 1, 401)
    return xi, cosserat.solve()(xi)


def distance_from_model(leg, r, values, name):
    """Root mean square of ln(model/run) over rings, both relative to the first ring."""
    xi, fields = model_as_printed()
    off = np.interp((r - leg.inner) / leg.gap, xi, np.log(positive(fields[name]))) - np.log(positive(values))
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
        return couple_at_wheel(run) / scale / mean(run["stress_rr"], run.off_walls)

    m, runs = model_as_printed()[1]["m"], s.carrying(s.flow())
    couple = {"couple": ratio(COUPLE_OF_BULK, couple_at_wheel), "couple_size": couple_in_the_model}
    figures = s.means(runs, velocity=velocity, spin=spin, asymmetry=asymmetry)
    return figures | {"model_couple": Evidence(exactly(m[-1] / m[0]))} | s.means(runs, **couple)


@claim("C25")
def what_a_rotation_cost(s):
    # CPU seconds at the rule's rate
    rotation = lambda run: run.data["cpu_s"] / run.data["steps"] * (2 * np.pi / s["omega"] / run.data["dt"])
    return s.means(s.flow(), speed_up=lambda run: s["days"] * 86400 / rotation(run), hours=lambda run: rotation(run) / 3600)


@claim("C26")
def size_of_overlaps(s):
    overlap = lambda name: lg(lambda run: run.head.get(name, math.nan) * run.leg.d)
    largest_of_all, trace = overlap("max_overlap_over_d"), lg(inside("off_walls", field("stress_trace")))
    figures = s.means(s.flow(), overlap=largest_of_all, trace=trace, mean_overlap=overlap("mean_overlap_over_d"))
    return figures | s.means(s.at_label(), overlap_804=largest_of_all)
