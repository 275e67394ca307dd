"""Snapshots as files of other programs, and results and snapshots by python/crossgrain.py: the same run read by every way
gives the same numbers. tests/unit/write_snapshots_test.cpp has the formats by hand, tests/averaging/mercurycg_test.cpp
averages them."""

import json
import re
import sys
import unittest

import h5py
import matplotlib
import numpy as np

from harness import BAD_INPUT, CASES, COLLISION, COUETTE, FELL_SHORT, HELD, HOME, SystemTest, settings

sys.path.insert(0, str(HOME / "python"))
import crossgrain  # noqa: E402

#: Runs the cells of a notebook and prints the value that each ends with, as a notebook would.
RUN_CELLS = """
import ast, json, sys
names = {}
for cell in json.load(open(sys.argv[1], encoding="utf-8"))["cells"]:
    if cell["cell_type"] == "code":
        lines = ast.parse("".join(cell["source"])).body
        last = lines.pop() if isinstance(lines[-1], ast.Expr) else None
        exec(compile(ast.Module(lines, []), "cell", "exec"), names)
        if last:
            print(eval(compile(ast.Expression(last.value), "cell", "eval"), names))
"""
SHORT = settings(averaging__rotations=0.05, averaging__settle_rotations=0.01, preparation__packings=1, run__keep_snapshots=3)


class OneRun(SystemTest):
    """A short run of the small cell, made once."""

    @classmethod
    def setUpClass(cls):
        cls.ran = cls.compared_once("grain,box2d-penalty", "--quick", *SHORT)
        cls.file = cls.ran / "snapshots/grain-p0.h5"

    def export(self, form, *arguments, case=COUETTE, out=None):
        return self.run_program("export", form, self.file, case, "--out", out or self.folder / "files/x", "--quiet", *arguments)

    def snapshots(self):
        snapshots = crossgrain.Snapshots(self.file)
        self.addCleanup(snapshots.close)
        return snapshots


class Export(OneRun):
    def test_mercurydpm_has_the_same_disks_and_forces(self):
        self.assertIn("would write 3 snapshots to ", self.export("mercurydpm", "--dry-run").stdout)
        self.assertFalse((self.folder / "files").exists())
        told = json.loads(self.export("mercurydpm", "--json", out=self.folder / "other/x").stdout)
        self.assertEqual(("grain", 3), (told["engine"], told["snapshots"]))
        done = self.export("mercurydpm")
        self.assert_status(done, HELD)
        self.assertIn("x.data", done.stdout)
        self.assertIn("3 snapshots of grain", done.stdout)
        self.assertIn("not in them: lengths of tangential springs", done.stdout)
        snapshots = self.snapshots()
        lines = (self.folder / "files/x.data").read_text(encoding="utf-8").splitlines()
        disks, rows = len(snapshots.radius), len(snapshots.radius) + len(snapshots.wall_radius)
        self.assertEqual(3 * (rows + 1), len(lines))
        forces = self.fstat(rows)
        restart = (self.folder / "files/x.restart").read_text(encoding="utf-8")
        density = np.array([float(d) for d in re.findall(r" density (\S+)", restart)])
        self.assertEqual(2, len(density))
        self.assertEqual(rows - disks, restart.count(" invMass 0 "))
        for k, snapshot in enumerate(snapshots):
            head = lines[k * (rows + 1)].split()
            self.assertEqual((rows, snapshot.time), (int(head[0]), float(head[1])))
            data = np.loadtxt(lines[k * (rows + 1) + 1 : (k + 1) * (rows + 1)])
            np.testing.assert_array_equal(snapshot.centres(), data[:, :2])
            np.testing.assert_array_equal(snapshot.velocity, data[:disks, 3:5])
            np.testing.assert_array_equal(snapshot.spin, data[:disks, 12])
            np.testing.assert_array_equal(snapshots.radius, data[:disks, 6])
            # As MercuryDPM makes masses of particles of two dimensions; small and large disks have a density each.
            np.testing.assert_allclose(density[data[:disks, 13].astype(int)] * np.pi * snapshots.radius**2, snapshots.mass, rtol=1e-11)
            # The wheel's disks turn with it.
            wheel = disks + np.flatnonzero(snapshots.wall_body == 0)
            spin = snapshot.bodies["angular_velocity"][0]
            turned = spin * np.stack([-data[wheel, 1], data[wheel, 0]], axis=1)
            np.testing.assert_allclose(data[wheel, 3:5], turned, atol=1e-15)
            # Two lines of a pair of disks, one of a wall disk; forces add up to those of the snapshot on each disk.
            contacts, rows_of = snapshot.contacts, forces[k]
            pairs = contacts.j < disks
            self.assertEqual(len(contacts) + np.count_nonzero(pairs), len(rows_of))
            force = rows_of[:, 8:9] * rows_of[:, 10:12] + rows_of[:, 9:10] * rows_of[:, 13:15]
            by_file, by_snapshot = np.zeros((disks, 2)), np.zeros((disks, 2))
            np.add.at(by_file, rows_of[:, 1].astype(int), force)
            np.add.at(by_snapshot, contacts.i, contacts.force)
            np.add.at(by_snapshot, contacts.j[pairs], -contacts.force[pairs])
            self.assertGreater(abs(by_snapshot).max(), 0.0)
            np.testing.assert_allclose(by_file, by_snapshot, rtol=0, atol=1e-13 * abs(contacts.normal_force).max())

    def fstat(self, rows):
        found = []
        for line in (self.folder / "files/x.fstat").read_text(encoding="utf-8").splitlines():
            if line.startswith("#") and line.endswith(" 1"):
                found.append([])
            elif not line.startswith("#"):
                found[-1].append([float(number) for number in line.split()])
        for frame in found:
            self.assertEqual({16}, {len(row) for row in frame})
            self.assertLess(max(row[2] for row in frame), rows)
        return [np.array(frame) for frame in found]

    def test_lammps_has_the_same_disks_and_forces(self):
        self.assert_status(self.export("lammps"), HELD)
        snapshots = self.snapshots()
        disks = len(snapshots.radius)
        for k, snapshot in enumerate(snapshots):
            text = (self.folder / "files/x.dump").read_text(encoding="utf-8").split("ITEM: TIME\n")[k + 1].split("ITEM: UNITS")[0]
            head, _, body = text.partition("ITEM: ATOMS id type x y z radius mass vx vy vz omegax omegay omegaz\n")
            self.assertEqual(snapshot.time, float(head.split()[0]))
            data = np.loadtxt(body.splitlines())
            np.testing.assert_array_equal(np.arange(1, len(data) + 1), data[:, 0])
            np.testing.assert_array_equal(np.concatenate([np.full(disks, 1), 2 + snapshots.wall_body]), data[:, 1])
            np.testing.assert_array_equal(snapshot.centres(), data[:, 2:4])
            np.testing.assert_array_equal(snapshots.mass, data[:disks, 6])
            local = (self.folder / "files/x.contacts").read_text(encoding="utf-8").split("ITEM: TIME\n")[k + 1]
            rows = np.loadtxt(local.partition("ITEM: ENTRIES")[2].splitlines()[1:], ndmin=2)
            contacts = snapshot.contacts
            np.testing.assert_array_equal(np.stack([contacts.i, contacts.j], axis=1) + 1, rows[:, 1:3])
            np.testing.assert_array_equal(contacts.normal_force, rows[:, 3])
            tangential = contacts.tangential_force[:, None] * contacts.tangent
            np.testing.assert_array_equal(tangential, rows[:, 4:6])
            centres = snapshot.centres()
            np.testing.assert_array_equal(centres[contacts.i] - centres[contacts.j], rows[:, 13:15])

    def test_ondem_has_blocks_and_forces_on_the_second(self):
        done = self.export("ondem")
        self.assert_status(done, HELD)
        snapshots = self.snapshots()
        for k, snapshot in enumerate(snapshots):
            with h5py.File(self.folder / f"files/x-{k:03d}.vtkhdf") as file:
                self.assertEqual(b"MultiBlockDataSet", file["VTKHDF"].attrs["Type"])
                self.assertEqual([2, 5], list(file["VTKHDF"].attrs["Version"]))
                self.assertEqual({"Points", "Others", "Assembly"}, set(file["VTKHDF"]))
                self.assertEqual(["Points", "Others"], list(file["VTKHDF/Assembly"]))
                self.assertEqual(["Points", "Others"], [n.decode() for n in file["ONDEM/Scene/display_group_names"]])
                self.assertEqual(snapshot.time, file["ONDEM/Scene"].attrs["time"])
                points, others = file["VTKHDF/Assembly/Points"], file["VTKHDF/Assembly/Others"]
                self.assertEqual(list(points["PointData"]), list(others["PointData"]))
                self.assertEqual((0, 3), others["Points"].shape)
                np.testing.assert_array_equal(snapshot.centres(), points["Points"][:, :2])
                np.testing.assert_array_equal(np.arange(len(points["Points"])), points["PointData/body_id"])
                self.assertEqual("wxyz", points["PointData/orientation"].attrs["order"].decode())
                self.assertEqual(b"sphere", file["ONDEM/Scene/shape_names"][0])
                group, contacts = file["ONDEM/Interactions/contact"], snapshot.contacts
                self.assertEqual(len(contacts), group.attrs["count"])
                force = -group["normal_force"][:][:, None] * group["normal"][:] + group["shear_force"][:]
                np.testing.assert_allclose(force[:, :2], -contacts.force, rtol=0, atol=1e-15 * abs(contacts.normal_force).max())

    def test_wrong_input_is_one_line(self):
        self.assert_one_line(self.export("pdb"), BAD_INPUT, "format pdb", "mercurydpm, lammps, ondem")
        self.assert_one_line(self.export("lammps", case=COLLISION), BAD_INPUT, "export takes a cell")
        self.assert_one_line(self.export("lammps", case=CASES / "couette/nu-0.804.toml"), BAD_INPUT, "does not fit")
        self.assert_status(self.export("lammps"), HELD)
        before = (self.folder / "files/x.dump").read_bytes()
        self.assert_one_line(self.export("lammps"), BAD_INPUT, "x.dump is there already")
        self.assertEqual(before, (self.folder / "files/x.dump").read_bytes())
        self.assertEqual({"x.dump", "x.contacts"}, {file.name for file in (self.folder / "files").iterdir()})


class InSpace(SystemTest):
    """Snapshot files of spheres between sliding walls."""

    BUMPY = CASES / "space/shear-3d.toml"
    SHORT = settings(
        assembly__duration=0.2, average__from=0.05, average__snapshots=5, preparation__packings=1, run__keep_snapshots=5, looks__count=1
    )

    @classmethod
    def setUpClass(cls):
        cls.ran = cls.compared_once("grain", *cls.SHORT, case=cls.BUMPY)
        cls.file = cls.ran / "snapshots/grain-p0.h5"

    def test_average_is_that_of_the_run(self):
        again = self.folder / "again"
        self.held("average", self.file, self.BUMPY, "--out", again, "--quiet", *self.SHORT)
        run, other = (self.rows("profiles.csv", folder) for folder in (self.ran, again))
        self.assertEqual([row for row in run if row["packing"] == "0"], [row for row in other if row["packing"] == "0"])
        self.assertIn("stress_xz", {row["field"] for row in other})
        done = self.run_program("average", self.file, CASES / "space/plane-shear.toml", "--out", self.folder / "no", "--quiet")
        self.assert_one_line(done, BAD_INPUT, "its snapshots have dimension 3, the case has 2")

    def test_files_are_compared_as_the_run_that_they_are_of(self):
        done = self.run_program("compare", self.BUMPY, "--engines", f"grain,mine={self.file}", "--out", self.folder / "both", *self.SHORT)
        self.assert_status(done, HELD, FELL_SHORT)  # one packing settles nothing
        rows = self.rows("profiles.csv", self.folder / "both")
        means = {name: [row["mean"] for row in rows if row["engine"] == name] for name in ("grain", "mine")}
        self.assertGreater(len(means["mine"]), 100)
        self.assertEqual(means["grain"], means["mine"])
        self.assertEqual({0.0}, {float(row["difference"] or 0.0) for row in self.rows("endpoints.csv", self.folder / "both")})

    def check_averages_of_exports(self, ran, case, changes, forms):
        """Of files of each form, and of what import makes of them, the profiles are those of the run."""
        own = {(r["field"], r["r_m"]): r for r in self.rows("profiles.csv", ran) if r["packing"] == "0"}
        settled = [*changes, *settings(engines__mine__contacts_behind=0)]
        for form, pattern in forms.items():
            with self.subTest(form):
                file, out = ran / "snapshots/grain-p0.h5", self.folder / form
                self.held("export", form, file, case, "--out", out, "--quiet", *changes)
                files = sorted(self.folder.glob(form + pattern))
                again = self.folder / f"{form}.h5"
                done = self.held("import", form, *files, case, "--name", "mine", "--out", again, "--quiet", *settled)
                for made in (files, [again]):
                    folder = self.folder / f"{form}-{len(made)}"
                    self.held("average", *made, case, "--name", "mine", "--out", folder, "--quiet", *settled)
                    rows = self.rows("profiles.csv", folder)
                    self.assertEqual(len(own), len(rows))
                    for row in rows:
                        wanted = own[row["field"], row["r_m"]]["mean"]
                        if wanted == "":
                            self.assertEqual("", row["mean"])
                        else:
                            self.assertAlmostEqual(float(wanted), float(row["mean"]), delta=1e-9 * (1 + abs(float(wanted))))

    def test_exported_files_have_the_averages_of_the_run(self):
        forms = {"lammps": ".[dc]*", "ondem": "-*.vtkhdf"}
        self.check_averages_of_exports(self.ran, self.BUMPY, self.SHORT, forms)

    def test_exported_files_of_a_periodic_plane_have_the_averages_of_the_run(self):
        case = CASES / "space/plane-shear.toml"
        changes = settings(
            assembly__duration=0.8, average__snapshots=3, preparation__packings=1, run__keep_snapshots=3, looks__count=1
        )
        ran = self.compared_once("grain", *changes, case=case)
        forms = {"lammps": ".[dc]*", "mercurydpm": ".[df]*", "ondem": "-*.vtkhdf"}
        self.check_averages_of_exports(ran, case, changes, forms)
        head = (self.folder / "lammps.dump").read_text(encoding="utf-8")[:200]
        self.assertIn("ITEM: BOX BOUNDS pp ff pp\n0 0.148\n", head)

    def test_contacts_with_a_cylinder_are_read_and_not_exported(self):
        drum = CASES / "space/drum.toml"
        short = [each for each in self.SHORT if "duration" not in each and "from" not in each]
        short += settings(assembly__duration=0.16, average__from=0.1, run__mirrors="false")
        self.assert_status(self.compare("--quick", *short, engines="grain", case=drum), HELD)
        file = self.out / "snapshots/grain-p0.h5"
        snapshots = crossgrain.Snapshots(file)
        self.addCleanup(snapshots.close)
        spheres = len(snapshots.radius)
        self.assertIn(spheres, {id for snapshot in snapshots for id in snapshot.contacts.j}, "on the drum")
        again = self.folder / "again"
        self.held("average", file, drum, "--out", again, "--quiet", *short)
        run, other = (self.rows("profiles.csv", folder) for folder in (self.out, again))
        self.assertEqual([row for row in run if row["packing"] == "0"], [row for row in other if row["packing"] == "0"])
        done = self.run_program("export", "ondem", file, drum, "--out", self.folder / "x", "--quiet", *short)
        self.assert_one_line(done, BAD_INPUT, "format ondem: has no cylinders")

    def test_ondem_has_spheres_and_their_forces(self):
        out = self.folder / "x"
        self.held("export", "ondem", self.file, self.BUMPY, "--out", out, "--quiet", *self.SHORT)
        snapshots = crossgrain.Snapshots(self.file)
        self.addCleanup(snapshots.close)
        spheres, touching = len(snapshots.radius), 0
        for k, snapshot in enumerate(snapshots):
            with h5py.File(self.folder / f"x-{k:03d}.vtkhdf") as file:
                points, contacts = file["VTKHDF/Assembly/Points"], snapshot.contacts
                np.testing.assert_array_equal(snapshot.centres(), points["Points"][:])
                data = points["PointData"]
                for name, own in (("velocity", snapshot.velocity), ("angular_velocity", snapshot.spin)):
                    np.testing.assert_array_equal(own, data[name][:spheres])
                self.assertEqual({0.0}, set(data["blocked_dofs"][:spheres]))
                np.testing.assert_allclose(4 / 3 * np.pi * snapshots.radius**3, data["volume"][:spheres], rtol=1e-15)
                inertia = 0.4 * snapshots.mass * snapshots.radius**2
                np.testing.assert_allclose(inertia[:, None, None] * np.eye(3), data["inertia"][:spheres].reshape(-1, 3, 3), rtol=1e-15)
                walls = np.where(snapshots.wall_body[:, None] == 0, [-1.0, 0, 0], [1.0, 0, 0])
                np.testing.assert_array_equal(walls, data["velocity"][spheres:])
                group = file["ONDEM/Interactions/contact"]
                force = -group["normal_force"][:][:, None] * group["normal"][:] + group["shear_force"][:]
                np.testing.assert_allclose(force, -contacts.force, rtol=0, atol=1e-15 * abs(contacts.normal_force).max(initial=0.0))
                touching += len(contacts)
        self.assertGreater(touching, 100)
        done = self.run_program("export", "mercurydpm", self.file, self.BUMPY, "--out", self.folder / "y", *self.SHORT)
        self.assert_one_line(done, BAD_INPUT, "format mercurydpm", "lammps and ondem alone")


class RoundTrip(OneRun):
    """export, then import: the same snapshots, but for what the files have no place for."""

    def check_round_trip(self, form, *files, file=None, case=COUETTE, changes=SHORT[:2], tolerance=1e-13):
        """@param changes  of the case: times of the run among them, as import leaves others out"""
        file = file or self.file
        self.held("export", form, file, case, "--out", self.folder / "x", "--quiet", *changes)
        again = self.folder / "again.h5"
        named = [self.folder / f"x{ending}" for ending in files] or sorted(self.folder.glob("x*.vtkhdf"))
        self.held("import", form, *named, case, "--out", again, "--quiet", *changes)
        before, after = crossgrain.Snapshots(file), crossgrain.Snapshots(again)
        self.addCleanup(before.close), self.addCleanup(after.close)
        self.assertEqual(len(before), len(after))
        np.testing.assert_array_equal(before.radius, after.radius)
        np.testing.assert_allclose(before.mass, after.mass, rtol=1e-12)
        touching = 0
        for a, b in zip(before, after):
            self.assertEqual(a.time, b.time)
            np.testing.assert_array_equal(a.position, b.position)
            np.testing.assert_array_equal(a.velocity, b.velocity)
            np.testing.assert_array_equal(a.spin, b.spin)
            # Wall disks of a cell are counted from another place on their circle.
            ids = np.arange(len(before.radius) + len(before.wall_radius) + 100)
            if len(before.wall_radius):
                apart = np.linalg.norm(a.wall_position[:, None] - b.wall_position[None, :], axis=2)
                np.testing.assert_allclose(apart.min(axis=0), 0.0, atol=1e-12)
                ids[len(before.radius) : len(before.radius) + len(a.wall_position)] = len(before.radius) + apart.argmin(axis=0)
            b.contacts.j = ids[b.contacts.j]
            order = [np.lexsort((c.j, c.i)) for c in (a.contacts, b.contacts)]
            # Pairs without a force may be left out of either.
            kept = [k[c.transmits[k]] for k, c in zip(order, (a.contacts, b.contacts))]
            mine, theirs = kept
            for name in ("i", "j"):
                np.testing.assert_array_equal(getattr(a.contacts, name)[mine], getattr(b.contacts, name)[theirs])
            np.testing.assert_allclose(a.contacts.normal[mine], b.contacts.normal[theirs], rtol=0, atol=1e-10)
            largest = abs(a.contacts.normal_force).max(initial=0.0)
            for name in ("normal_force", "tangential_force"):
                np.testing.assert_allclose(
                    getattr(a.contacts, name)[mine], getattr(b.contacts, name)[theirs], rtol=0, atol=tolerance * largest
                )
            np.testing.assert_allclose(a.contacts.overlap[mine], b.contacts.overlap[theirs], rtol=0, atol=1e-15)
            touching += len(mine)
        self.assertGreater(touching, 0)

    def test_of_a_cell(self):
        self.check_round_trip("mercurydpm", ".data", ".fstat")

    def test_of_a_cell_by_lammps(self):
        self.check_round_trip("lammps", ".dump", ".contacts", tolerance=1e-9)

    def test_of_an_assembly_with_planes(self):
        case = CASES / "assembly/biaxial.toml"
        # Some pairs overlap without a force: tension is cut. Contacts are as old as positions, not a step older as YADE's.
        changes = settings(average__snapshots=3, engines__ondem__contacts_behind=0)
        self.compare(*changes, *settings(preparation__packings=1, run__keep_snapshots=3), case=case)
        for form, *files in (("mercurydpm", ".data", ".fstat"), ("lammps", ".dump", ".contacts"), ("ondem",)):
            with self.subTest(form):
                file = self.out / "snapshots/grain-p0.h5"
                self.check_round_trip(form, *files, file=file, case=case, changes=changes, tolerance=1e-9)


class PythonReader(OneRun):
    def test_tables_are_those_of_the_csv_files(self):
        results = crossgrain.Results(self.ran)
        self.assertEqual(("compare", ["grain", "box2d-penalty"]), (results.kind, results.engines))
        ours, file = results.profiles(), results.table("profiles")
        self.assertGreater(len(ours["mean"]), 500)
        for name, column in (("mean", "mean"), ("stderr", "stderr"), ("n_eff", "n_eff"), ("r", "r_m")):
            np.testing.assert_array_equal(ours[name], file[column], name)
        self.assertEqual(list(ours["field"]), list(file["field"]))
        profile = results.profile("stress_rr", engine="box2d-penalty")
        chosen = (file["engine"] == "box2d-penalty") & (file["field"] == "stress_rr") & (file["packing"] == 0)
        np.testing.assert_array_equal(profile.mean, file["mean"][chosen])
        self.assertEqual((0, "slicing", "N/m²"), (profile.packing, profile.method, profile.unit))
        ours, file = results.endpoints(), results.table("endpoints")
        self.assertGreater(len(ours["endpoint"]), 3)
        self.assertEqual(list(ours["endpoint"]), list(file["endpoint"]))
        for name in ("difference", "low", "high", "distance"):
            np.testing.assert_array_equal(ours[name], file[name], name)
        series, file = results.series("grain"), results.table("series")
        chosen = file["engine"] == "grain"
        for name in ("t_s", "kinetic_energy", "wheel_torque"):
            np.testing.assert_array_equal(series[name], file[name][chosen], name)

    def test_a_single_run_is_asked_for_by_its_packing(self):
        """Beside means of others: by itself a profile is what verdicts rest on."""

        def of(engine, packing, mean):
            profile = {"method": "slicing", "field": "spin", "unit": "rad/s", "mean": [mean], "stderr": [0.1], "n_eff": [1]}
            return {"engine": engine, "packing": packing, "profiles": [profile]}

        runs = [of(engine, k, value + k) for engine, value in (("ours", 0.0), ("mirror", 2.0)) for k in (0, 1)]
        document = {
            "schema": crossgrain.SCHEMA,
            "kind": "compare",
            "engines": [{"name": "ours"}, {"name": "peer"}, {"name": "other"}],
            "averaging": {"method": "slicing"},
            "runs": [*runs, of("peer", 0, 9.0), of("other", 0, 8.0)],
            "ensemble": [of("ours", "all", 0.5), of("mirror", "all", 2.5)],
            "endpoints": {"rows": [], "carried": [{"engine": "peer", "mirror": "mirror", "carried": True}]},
        }
        (self.folder / "results.json").write_text(json.dumps(document))
        results = crossgrain.Results(self.folder)
        profile = results.profile("spin", engine="peer")
        self.assertEqual(("mirror", "all", 2.5), (profile.engine, profile.packing, profile.mean[0]))
        self.assertEqual(9.0, results.profile("spin", engine="peer", packing=0).mean[0])
        with self.assertRaisesRegex(KeyError, "ask for it by packing=0"):
            results.profile("spin", engine="other")
        self.assertEqual(8.0, results.profile("spin", engine="other", packing=0).mean[0])
        matplotlib.use("Agg")
        drawn = crossgrain.plot_profile(results, "spin").get_legend().get_texts()
        self.assertEqual(["ours", "peer"], [text.get_text() for text in drawn])
        for choice in ({"engines": ["other"]}, {"packing": 9}):
            with self.assertRaises(KeyError):
                crossgrain.plot_profile(results, "spin", **choice)

    def test_what_is_not_there_is_said(self):
        results = crossgrain.Results(self.ran)
        for act, words in (
            (lambda: results.profile("stress"), "stress_rr by slicing"),
            (lambda: results.profile("spin", engine="yade"), "box2d-penalty"),
            (results.collisions, "results of compare have no collisions; there are"),
            (lambda: results.table("claims"), "profiles.csv"),
            (lambda: self.snapshots()[3], "no snapshot 3 of 3"),
        ):
            with self.assertRaises((KeyError, IndexError)) as caught:
                act()
            self.assertIn(words, str(caught.exception))

    def test_what_a_file_does_not_have_is_none(self):
        bare = self.folder / "bare.h5"
        with h5py.File(bare, "w") as file:
            file["disks/radius"], file["disks/mass"] = np.ones(2), np.ones(2)
            file["snapshot-000/time"] = np.zeros(4)
            for name in ("position", "velocity"):
                file[f"snapshot-000/{name}"] = np.zeros((2, 2))
        with crossgrain.Snapshots(bare) as snapshots:
            self.assertIsNone(snapshots.inertia)
            now = snapshots[0]
        for name in ("spin", "wall_position", "contacts", "bodies", "energies"):
            self.assertIsNone(getattr(now, name), name)
        self.assertEqual((2, 2), now.centres().shape)

    def test_snapshots_give_the_series(self):
        """The kinetic energy of the last snapshot, worked out here, is the last of the series."""
        snapshots = self.snapshots()
        self.assertEqual("grain", snapshots.engine)
        last = snapshots[-1]
        energy = 0.5 * (snapshots.mass * (last.velocity**2).sum(axis=1) + snapshots.inertia * last.spin**2).sum()
        series = crossgrain.Results(self.ran).series("grain")
        self.assertEqual(series["t_s"][-1], last.time)
        self.assertAlmostEqual(1.0, series["kinetic_energy"][-1] / energy, delta=1e-12)
        touching = np.count_nonzero(last.contacts.transmits & (last.contacts.j < len(snapshots.radius)))
        walls = np.count_nonzero(last.contacts.transmits) - touching
        self.assertAlmostEqual(series["coordination"][-1], (2 * touching + walls) / len(snapshots.radius), delta=1e-12)

    def test_collisions_have_their_reference(self):
        quick = settings(collision__psi=[0.5, 2.0], collision__steps_per_contact=50, run__mirrors="false")
        self.assert_status(self.run_program("collide", COLLISION, "--engines", "grain", "--out", self.out, *quick), HELD, FELL_SHORT)
        results = crossgrain.Results(self.out / "results.json")
        ours, file = results.collisions(), results.table("collisions")
        self.assertEqual({0.5, 2.0}, set(ours["psi_i"]))
        for name in ("psi_i", "v_n", "e_n", "psi_f", "psi_f_reference", "e_n_reference"):
            np.testing.assert_array_equal(ours[name], file[name], name)
        self.assertLess(np.nanmax(abs(ours["psi_f"] - ours["psi_f_reference"])), 0.05)

    def test_notebook_runs(self):
        (self.folder / "out").mkdir()
        (self.folder / "out/quick").symlink_to(self.ran)
        environment = {"PYTHONPATH": str(HOME / "python"), "MPLBACKEND": "Agg"}
        done = self.call(sys.executable, "-c", RUN_CELLS, HOME / "examples/python/results.ipynb", env=environment)
        self.assert_status(done, 0)
        for words in ("<Results of compare, case ", "box2d-penalty", "kinetic energy of grain", "the largest net force"):
            self.assertIn(words, done.stdout)

    def test_plots_have_every_engine(self):
        matplotlib.use("Agg")
        results = crossgrain.Results(self.ran)
        of_profile = crossgrain.plot_profile(results, "volume_fraction")
        names = [text.get_text() for text in of_profile.get_legend().get_texts()]
        self.assertEqual(["grain", "box2d-penalty"], [name for name in names if not name.startswith("grain-as-")])
        line = of_profile.containers[1].lines[0].get_xydata()
        mine = results.profile("volume_fraction", engine="box2d-penalty")
        np.testing.assert_array_equal(line, np.stack([mine.r, mine.mean], axis=1))
        of_endpoints = crossgrain.plot_endpoints(results)
        rows = results.endpoints().frame()
        shown = rows[(rows.a == "grain") & (rows.b == "box2d-penalty") & rows.distance.notna()]
        drawn = {text.get_text(): bars.lines[0].get_xdata() for text, bars in zip(of_endpoints.get_legend().get_texts(), of_endpoints.containers)}
        np.testing.assert_array_equal(drawn["box2d-penalty"], shown.distance)
        with self.assertRaises(KeyError):
            crossgrain.plot_endpoints(results, against="nobody")

    def test_version_is_the_programs(self):
        self.assertIn(crossgrain.__version__, self.run_program("--version").stdout)
        self.assertIn(f"version: {crossgrain.__version__}\n", (HOME / "CITATION.cff").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
