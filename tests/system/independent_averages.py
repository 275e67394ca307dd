"""The averages of a Couette run worked out again from its snapshots, by a route that shares no code with
the program: whole arrays instead of loops over contacts, Cartesian tensors that are turned at the end,
areas by Green's theorem.

By Debian's own Python, which has numpy and h5py:
    /usr/bin/python3 independent_averages.py SNAPSHOTS.h5 RESULTS.json
prints {field: {"worst": largest difference over rings in units of the field's largest value}}.
"""

import json
import sys

import h5py
import numpy as np


def area_within(r, a, edge):
    """Of disks of radius a at distances r, the area inside r = edge: ½∮(x dy − y dx) along both arcs."""
    area = np.where(r + a <= edge, np.pi * a * a, 0.0)
    cut = (np.abs(r - a) < edge) & (edge < r + a)
    rc, ac = r[cut], a[cut]
    x = (rc * rc + edge * edge - ac * ac) / (2.0 * rc)  # where the circles meet, disk on the x axis
    y = np.sqrt(np.maximum(edge * edge - x * x, 0.0))
    wide = np.arctan2(y, x)  # half-angle of the ring's arc, seen from the origin
    # The disk's arc inside the edge runs from the upper meeting point on over the side towards the
    # origin to the lower one.
    start = np.arctan2(y, x - rc)
    turned = 2.0 * np.pi - 2.0 * start
    disk_arc = 0.5 * (ac * ac * turned + rc * ac * (np.sin(-start) - np.sin(start)))
    ring_arc = edge * edge * wide
    area[cut] = disk_arc + ring_arc
    return area


def shares(r, a, edges):
    """Disks × rings."""
    within = np.array([area_within(r, a, edge) for edge in edges])
    return np.diff(within, axis=0).T / (np.pi * a * a)[:, None]


def turned(tensor, angle):
    """Cartesian tensors of disks in their own (r, φ)."""
    c, s = np.cos(angle), np.sin(angle)
    q = np.array([[c, s], [-s, c]]).transpose(2, 0, 1)  # rows: e_r, e_φ
    return q @ tensor @ q.transpose(0, 2, 1)


def add_at(size, index, values):
    out = np.zeros((size,) + values.shape[1:])
    np.add.at(out, index, values)
    return out


class Sums:
    """Σ w Q over disks per ring, as means over snapshots."""

    def __init__(self, file, edges, height):
        self.count = 0
        self.edges, self.height = edges, height
        self.total = {}
        self.radius = file["disks/radius"][:]
        self.mass = file["disks/mass"][:]
        self.inertia = file["disks/inertia"][:]
        self.wall = file["walls/radius"][:]

    def put(self, name, weights, values):
        flat = values.reshape(len(values), -1)
        ring = (weights.T @ flat).reshape((weights.shape[1],) + values.shape[1:])
        self.total[name] = self.total.get(name, 0.0) + ring

    def add(self, group):
        self.count += 1
        x, v, spin = group["position"][:], group["velocity"][:], group["spin"][:]
        walls = group["wall_position"][:]
        n = len(x)
        a = np.concatenate([self.radius, self.wall])
        place = np.concatenate([x, walls])
        angle = np.arctan2(place[:, 1], place[:, 0])
        w = shares(np.hypot(x[:, 0], x[:, 1]), self.radius, self.edges)
        volume = np.pi * self.radius**2 * self.height
        m = self.mass
        c, s = np.cos(angle[:n]), np.sin(angle[:n])
        u = np.stack([c * v[:, 0] + s * v[:, 1], c * v[:, 1] - s * v[:, 0]], axis=1)
        self.put("V", w, volume)
        self.put("m", w, m)
        self.put("Vv", w, volume[:, None] * u)
        self.put("mv", w, m[:, None] * u)
        self.put("mvv", w, m[:, None, None] * u[:, :, None] * u[:, None, :])
        self.put("Vspin", w, volume * spin)
        self.put("spinEnergy", w, 0.5 * self.inertia * spin**2)

        contacts = group["contacts"]
        i, j = contacts["i"][:], contacts["j"][:]
        normal = contacts["normal"][:]
        across = np.stack([-normal[:, 1], normal[:, 0]], axis=1)
        force = (
            contacts["normal_force"][:][:, None] * normal
            + contacts["tangential_force"][:][:, None] * across
        )
        both = np.concatenate([i, j])
        outward = np.concatenate([-normal, normal])  # from the disk's centre
        on = np.concatenate([force, -force])
        branch = a[both][:, None] * outward
        overlap = np.concatenate([contacts["overlap"][:]] * 2)
        stress = add_at(len(a), both, -on[:, :, None] * branch[:, None, :])
        fabric = add_at(len(a), both, outward[:, :, None] * outward[:, None, :])
        strain = add_at(len(a), both, (overlap[:, None] * outward)[:, :, None] * branch[:, None, :])
        moment = branch[:, 0] * on[:, 1] - branch[:, 1] * on[:, 0]
        couple = add_at(len(a), both, -moment[:, None] * branch)
        contacts_of = add_at(len(a), both, np.ones(len(both)))
        self.put("stress", w, turned(stress[:n], angle[:n]))
        self.put("VF", w, volume[:, None, None] * turned(fabric[:n], angle[:n]))
        self.put("strain", w, turned(strain[:n], angle[:n]))
        self.put("VC", w, volume * contacts_of[:n])
        held = contacts_of[:n] > 2
        self.put("heldV", w, volume * held)
        self.put("heldVC", w, volume * held * contacts_of[:n])
        radial = np.stack([c * couple[:n, 0] + s * couple[:n, 1], c * couple[:n, 1] - s * couple[:n, 0]], axis=1)
        self.put("couple", w, radial)
        for order in (4, 6):
            alpha = np.arctan2(outward[:, 1], outward[:, 0]) - angle[both]
            for name, wave in (("cos", np.cos), ("sin", np.sin)):
                harmonic = add_at(len(a), both, wave(order * alpha))[:n]
                self.put(f"{name}{order}", w, volume * harmonic)

        # Wall disks: all of their stress goes to the rings that they reach into.
        reach = shares(np.hypot(walls[:, 0], walls[:, 1]), self.wall, self.edges)
        reach = reach / reach.sum(axis=1, keepdims=True)
        self.put("wallStress", reach, turned(stress[n:], angle[n:]))
        cw, sw, k = np.cos(angle[n:]), np.sin(angle[n:]), couple[n:]
        self.put("wallCouple", reach, np.stack([cw * k[:, 0] + sw * k[:, 1], cw * k[:, 1] - sw * k[:, 0]], axis=1))

    def fields(self, kn):
        mean = {name: value / self.count for name, value in self.total.items()}
        ring = np.pi * np.diff(self.edges**2) * self.height
        per = lambda name: mean[name] / ring.reshape((-1,) + (1,) * (mean[name].ndim - 1))
        out = {}
        out["volume_fraction"] = per("V")
        for suffix, of, weight in (("", "mv", "m"), ("_by_volume", "Vv", "V")):
            out["radial_velocity" + suffix], out["azimuthal_velocity" + suffix] = (mean[of] / mean[weight][:, None]).T
        out["spin"] = mean["Vspin"] / mean["V"]
        out["density"] = per("m")
        out["rotational_stress"] = per("spinEnergy")
        moving = per("stress")
        sigma = moving + per("wallStress")
        dynamic = per("mvv")
        out.update(components("stress", sigma))
        symmetric = lambda t: 0.5 * (t + t.transpose(0, 2, 1))
        fluctuation = dynamic - (mean["mv"][:, :, None] * mean["mv"][:, None, :]) / mean["m"][:, None, None] / ring[:, None, None]
        for name, t in (
            ("dynamic_stress", dynamic),
            ("full_stress", symmetric(sigma) + dynamic),
            ("fluctuation_stress", fluctuation),
        ):
            parts = components(name, t)
            parts.pop(name + "_pr")
            out.update(parts)
        fabric = per("VF")
        strain = np.pi * self.height * per("strain") @ np.linalg.inv(fabric)
        parts = components("fabric", fabric)
        parts.pop("fabric_pr")
        out.update(parts)
        out.update(components("strain", strain))
        for name, t in (("stress", sigma), ("fabric", fabric), ("strain", strain)):
            values = np.linalg.eigvalsh(symmetric(t))
            out[f"{name}_trace"] = np.trace(t, axis1=1, axis2=2)
            out[f"{name}_deviator"] = values[:, 1] - values[:, 0]
        out["stress_antisymmetric"] = 0.5 * (sigma[:, 1, 0] - sigma[:, 0, 1])
        out["coordination"] = mean["VC"] / mean["V"]
        out["coordination_without_rattlers"] = mean["heldVC"] / mean["heldV"]
        out["granular_temperature"] = np.trace(fluctuation, axis1=1, axis2=2) / (2.0 * out["density"])
        out["pressure"] = np.trace(sigma + fluctuation, axis1=1, axis2=2) / 2.0
        spread = lambda t: np.ptp(np.linalg.eigvalsh(symmetric(t)), axis=1)
        trace = lambda t: np.trace(t, axis1=1, axis2=2)
        out["bulk_modulus"] = trace(moving) / trace(strain)
        out["shear_modulus"] = spread(moving) / spread(strain)
        out["mean_field_modulus"] = kn * trace(fabric) / (2.0 * np.pi * self.height)
        couple = per("couple") + per("wallCouple")
        out["couple_stress_zr"], out["couple_stress_zp"] = couple.T
        for order in (4, 6):
            for name in ("cos", "sin"):
                out[f"contact_{name}_{order}"] = 2.0 * mean[f"{name}{order}"] / mean["VC"]
        return out


def components(name, t):
    return {f"{name}_{'rp'[k]}{'rp'[l]}": t[:, k, l] for k in (0, 1) for l in (0, 1)}


def main(snapshots, results):
    with open(results, encoding="utf-8") as file:
        results = json.load(file)
    cell = results["cell"]
    edges = np.linspace(cell["inner_radius"], cell["outer_radius"], len(results["rings"]["r"]) + 1)
    with h5py.File(snapshots) as file:
        sums = Sums(file, edges, cell["height"])
        for name in sorted(name for name in file if name.startswith("snapshot-")):
            sums.add(file[name])
    run = results["runs"][0]
    fields = sums.fields(run["realised"]["pairs"][0]["kn"])
    worst = {}
    for profile in run["profiles"]:
        if profile["method"] != "slicing" or profile["field"] not in fields:
            continue
        ours = fields[profile["field"]]
        theirs = np.array(profile["mean"], dtype=float)
        worst[profile["field"]] = float(np.abs(ours - theirs).max() / np.abs(theirs).max())
    missing = sorted(set(fields) - set(worst))
    print(json.dumps({"worst": worst, "missing": missing}))


if __name__ == "__main__":
    main(*sys.argv[1:])
