"""What a finished run leaves in its folder: the tables' columns, the same bits each time, a page that
opens offline, and a case that can be run again."""

import csv
import json
import math
import re
import unittest
import urllib.parse

from harness import BAD_INPUT, CASES, COLLISION, COUETTE, FELL_SHORT, HARD_SPHERE, HELD, SystemTest, settings

PROFILES = (
    "engine,packing,method,field,ring,r_m,r_tilde,mean,stderr,n_eff,unit,stderr_kind,dof,"
    "from_rotation,to_rotation,prepared_rotations"
)
REGIMES = (
    "engine,packing,regime,wheel_contacts,wheel_slip,shear_share,inertial_number,blocked_share,"
    "from_rotation,to_rotation,prepared_rotations,reason"
)
STEADINESS = (
    "engine,packing,quantity,verdict,change,half_width,excluded,from_rotation,to_rotation,"
    "prepared_rotations"
)
SERIES = (
    "engine,packing,t_s,wheel_torque,outer_pressure,kinetic_energy,coordination,max_overlap"
)
COLLISIONS = "engine,case,variant,psi_i,v_n,e_n,psi_f,e_n_reference,psi_f_reference,dt_s,status"


class ResultsTest(SystemTest):
    def first_line(self, name):
        with open(self.out / name, encoding="utf-8") as file:
            return file.readline().rstrip("\n")

    def rows(self, name):
        with open(self.out / name, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def assert_numbers(self, rows, *columns):
        """Finite, or absent."""
        for row in rows:
            for column in columns:
                if row[column]:
                    self.assertTrue(math.isfinite(float(row[column])), row)

    def assert_strict_json(self, file):
        def refuse(constant):
            raise AssertionError(f"{file}: {constant} is not JSON")

        json.loads(file.read_text(encoding="utf-8"), parse_constant=refuse)

    def assert_opens_offline(self):
        page = (self.out / "report.html").read_text(encoding="utf-8")
        self.assertIn("</html>", page)
        page = urllib.parse.unquote(page)  # what its drawings refer to, too
        for reference in re.findall(r"""(?:src|href)\s*=\s*["']([^"']*)""", page):
            self.assertRegex(reference, r"^(data:|#)", "loads nothing from elsewhere")
        self.assertNotRegex(page, r"@import|url\((?!['\"]?(data:|#))")


class Compare(ResultsTest):
    def setUp(self):
        super().setUp()
        self.short = settings(averaging__rotations=0.05)

    def test_energy_ledger(self):
        asked = settings(run__energy_ledger="true")
        done = self.compare(*self.short, *asked, engines="grain,box2d-penalty")
        self.assert_status(done, HELD, FELL_SHORT)
        self.assertTrue(
            self.first_line("series.csv").endswith(
                "mean_overlap,pairs_listed,shear_share,wheel_contacts,wheel_slip,"
                "energy_elastic_normal,energy_elastic_tangential,"
                "energy_gained_by_convention,energy_initial,energy_kinetic,energy_lost_bottom,"
                "energy_lost_normal_damping,energy_lost_release,energy_lost_sliding,"
                "energy_lost_tangential_damping,energy_plate_springs,energy_potential,"
                "energy_residual,energy_work_of_walls"
            )
        )
        for row in self.rows("series.csv"):
            if row["engine"] != "grain":  # has no ledger
                self.assertEqual("", row["energy_residual"])
                continue
            work = float(row["energy_work_of_walls"])
            self.assertGreater(work, 0.0)
            self.assertGreater(float(row["energy_lost_sliding"]), 0.0)
            # Springs stretched after their force, 50 steps a contact: a few per cent at most.
            put_in = work + float(row["energy_initial"])
            self.assertLess(abs(float(row["energy_residual"])), 0.05 * put_in)

    def test_tables(self):
        done = self.compare(*self.short, engines="grain,box2d-penalty")
        self.assert_status(done, HELD, FELL_SHORT)

        self.assertEqual(PROFILES, self.first_line("profiles.csv"))
        rows = self.rows("profiles.csv")
        self.assert_numbers(rows, "r_m", "r_tilde", "mean", "stderr", "n_eff")
        self.assertEqual(
            {(e, p) for e in ("grain", "box2d-penalty") for p in ("0", "1", "all")},
            {(row["engine"], row["packing"]) for row in rows},
        )
        fields = {row["field"] for row in rows}
        self.assertLessEqual(
            {"volume_fraction", "azimuthal_velocity", "radial_velocity", "spin", "stress_rr",
             "stress_pp", "stress_rp", "stress_pr"}, fields,
        )  # fmt: skip
        # 2 engines × (2 packings + all) × 6 rings, for each field.
        self.assertEqual(2 * 3 * 6 * len(fields), len(rows))
        self.assertEqual([str(k) for k in range(1, 7)], [row["ring"] for row in rows[:6]])
        # The middle of the first of six rings between 0.03 and 0.075 m.
        self.assertAlmostEqual(0.03375, float(rows[0]["r_m"]), places=12)

        self.assertEqual(REGIMES, self.first_line("regimes.csv"))
        rows = self.rows("regimes.csv")
        self.assertEqual(2 * 2, len(rows))
        for row in rows:
            self.assertIn(row["regime"], ("flowing", "blocked", "collisional"))
            self.assertGreater(float(row["wheel_contacts"]), 0.0)
            # Averaged from the end of settling on, for a twentieth of a rotation.
            length = float(row["to_rotation"]) - float(row["from_rotation"])
            self.assertAlmostEqual(0.05, length, places=12)
        self.assertEqual(STEADINESS, self.first_line("steadiness.csv"))
        rows = self.rows("steadiness.csv")
        # 3 series × 2 engines × (2 packings + all).
        self.assertEqual(3 * 2 * 3, len(rows))
        for row in rows:
            self.assertIn(row["verdict"], ("drifts", "no drift seen", "cannot tell"))

        self.assertTrue(self.first_line("series.csv").startswith(SERIES))
        rows = self.rows("series.csv")
        self.assert_numbers(rows, *SERIES.split(",")[2:])
        # 400 snapshots a rotation, over 0.05 rotations, for each of 4 runs.
        self.assertEqual(4 * 20, len(rows))

        self.assert_strict_json(self.out / "results.json")
        self.assertEqual(
            {"grain", "box2d-penalty"},
            {engine["name"] for engine in self.results()["engines"]},
        )
        self.assert_opens_offline()

    def test_same_bits_each_time(self):
        """Whether the packings come from a cache, and however many runs are side by side."""
        tables = []
        for jobs, cache in ((1, "one"), (2, "one"), (2, "two")):
            out = self.folder / f"jobs-{jobs}-{cache}"
            done = self.compare(
                *self.short, f"--jobs={jobs}", out=out,
                env={"CROSSGRAIN_CACHE": str(self.folder / cache)},
            )  # fmt: skip
            self.assert_status(done, HELD)
            tables.append([(out / name).read_bytes() for name in ("profiles.csv", "series.csv")])
        self.assertEqual(tables[0], tables[1])
        self.assertEqual(tables[0], tables[2])

    def test_another_seed_gives_other_bits(self):
        self.assert_status(self.compare(*self.short), HELD)
        one = (self.out / "profiles.csv").read_bytes()
        self.assert_status(self.compare(*self.short, "--seed=9", "--fresh"), HELD)
        self.assertNotEqual(one, (self.out / "profiles.csv").read_bytes())

    def test_case_in_the_results_gives_the_same_again(self):
        changes = [*self.short, *settings(law__tension="cut", averaging__rings=4)]
        self.assert_status(self.compare(*changes), HELD)
        table = (self.out / "profiles.csv").read_bytes()
        case = self.write("again.toml", self.results()["case"]["toml"])
        again = self.run_program(
            "compare", case, "--engines", "grain", "--out", self.folder / "again"
        )
        self.assert_status(again, HELD)
        self.assertEqual(table, (self.folder / "again/profiles.csv").read_bytes())

    def test_strict(self):
        """Two packings decide nothing: held as it is, fallen short under --strict."""
        args = [*self.short, "--quiet"]
        self.assert_status(self.compare(*args, engines="grain,box2d-penalty"), HELD)
        done = self.compare(*args, "--strict", engines="grain,box2d-penalty")
        self.assert_status(done, FELL_SHORT)
        self.assertEqual("", done.stderr)

    def test_without_gnuplot_the_numbers_are_there(self):
        done = self.compare(*self.short, "--quiet", env={"PATH": "/nonexistent"})
        self.assert_one_line(done, BAD_INPUT, "gnuplot", "crossgrain report")
        self.assertEqual(PROFILES, self.first_line("profiles.csv"))
        self.assertTrue((self.out / "report.html").exists())
        self.assert_status(self.run_program("report", self.out), HELD)


class Collide(ResultsTest):
    def test_a_folder_of_collisions_is_one_report(self):
        folder = self.folder / "mine"
        folder.mkdir()
        few = "[collision]\npsi = [0.5, 2.0, 4.0]\nsteps_per_contact = [50, 100]\n"
        for name, kind, base in (
            ("b", "collision", COLLISION), ("a", "collision", COLLISION), ("c", "couette", COUETTE)
        ):
            text = f'[case]\nkind = "{kind}"\nextends = "{base}"\n'
            (folder / f"{name}.toml").write_text(text + (few if kind == "collision" else ""))
        done = self.collide(folder, "grain")
        self.assert_status(done, HELD, FELL_SHORT)
        rows = self.rows("collisions.csv")
        self.assertEqual(["a", "b"], list(dict.fromkeys(row["case"] for row in rows)))
        # Two of the eight variants have three time steps of their own.
        self.assertEqual(2 * (6 * 2 + 2 * 3) * 3, len(rows))
        page = (self.out / "report.html").read_text()
        for words in ('href="#case_2"', '<h2 id="case_2">b<', "spring-tension"):
            self.assertIn(words, page)

    def test_mirrors_run_in_the_cases_that_want_them(self):
        folder = self.folder / "mirrored"
        folder.mkdir()
        for name, mirrors in (("a", "false"), ("b", "true")):
            (folder / f"{name}.toml").write_text(
                f'[case]\nextends = "{COLLISION}"\n[run]\nmirrors = {mirrors}\n'
                "[collision]\npsi = [0.5, 2.0]\nsteps_per_contact = 50\n"
            )
        self.assert_status(
            self.run_program("collide", folder, "--engines", "box2d-penalty", "--out", self.out),
            HELD, FELL_SHORT,
        )  # fmt: skip
        ran = {(row["case"], row["engine"]) for row in self.rows("collisions.csv")}
        mirror = "grain-as-box2d-penalty"
        self.assertEqual(
            {("a", "box2d-penalty"), ("b", "box2d-penalty"), ("b", mirror)}, ran
        )
        # Of the one that ran where it was wanted the page can tell model from implementation.
        self.assertEqual(1, (self.out / "report.html").read_text().count("Model or implementation?"))

    def collide(self, case, engines, *arguments):
        return self.run_program(
            "collide", case, "--engines", engines, "--out", self.out,
            "--set=run.mirrors=false", *arguments,
        )  # fmt: skip

    def test_table(self):
        psi = [0.25, 0.5, 1.0, 2.0, 4.0]
        done = self.collide(
            COLLISION, "grain,box2d-penalty",
            *settings(collision__steps_per_contact=50, collision__psi=psi),
        )  # fmt: skip
        self.assert_status(done, HELD, FELL_SHORT)
        header = self.first_line("collisions.csv")
        self.assertTrue(header.startswith(COLLISIONS + ","))
        self.assertTrue(header.endswith(",outcome,verdict_scene,verdict_declared,own_scheme"))
        rows = self.rows("collisions.csv")
        self.assert_numbers(rows, *COLLISIONS.split(",")[3:10])
        # 2 engines × 8 variants × 5 Ψ_i.
        self.assertEqual(2 * 8 * 5, len(rows))
        self.assertEqual({"figure-4-3"}, {row["case"] for row in rows})
        # The law of a spring alone jumps beside Ψ_i = 0.5: no engine is judged there.
        self.assertEqual(
            {("spring-tension", 0.5), ("spring-cut", 0.5)},
            {(row["variant"], float(row["psi_i"])) for row in rows if row["status"] != "parted"},
        )
        self.assert_strict_json(self.out / "results.json")
        self.assert_opens_offline()

    def test_a_model_difference_is_told_from_a_fault(self):
        """An engine true to conventions that the case lets it have does what it says; whether that
        is the scene's law, too, is asked under --strict."""
        sweep = settings(collision__steps_per_contact=50, collision__psi=[0.5, 2.0, 4.0])
        wall = CASES / "collision/wall-oblique.toml"
        for strict, status in (((), HELD), (("--strict",), FELL_SHORT)):
            done = self.collide(wall, "box2d-penalty", "-k", "fixed", *sweep, *strict)
            self.assert_status(done, status)
            self.assertRegex(done.stdout, r"0 curves passed, 1 differ by their model, 0 failed")
        (row, *_) = self.rows("collisions.csv")
        self.assertEqual(
            ("model difference", "fell short", "held"),
            (row["outcome"], row["verdict_scene"], row["verdict_declared"]),
        )
        self.assertLess(float(row["own_scheme"]), 1e-12)
        self.assertIn('failures="0"', (self.out / "junit.xml").read_text())

    def test_closed_form_of_hard_disks(self):
        """The reference column is Walton's law, Ψ_f = max(−e_t0 Ψ_i, Ψ_i − 3 (1 + e_n) µ), and an
        engine of impulses follows it."""
        done = self.collide(HARD_SPHERE, "box2d-impulse")
        self.assert_status(done, HELD)
        rows = self.rows("collisions.csv")
        self.assertEqual(2 * 41, len(rows))
        for row in rows:
            et0 = {"e_t0-0": 0.0, "e_t0-0.5": 0.5}[row["variant"]]
            psi = float(row["psi_i"])
            expected = max(-et0 * psi, psi - 3 * 1.9 * 0.44)
            self.assertAlmostEqual(expected, float(row["psi_f_reference"]), places=9)
            self.assertAlmostEqual(expected, float(row["psi_f"]), delta=1e-3)
            self.assertAlmostEqual(0.9, float(row["e_n"]), delta=1e-3)

    def test_same_bits_each_time(self):
        tables = []
        for jobs in (1, 2):
            done = self.collide(
                COLLISION, "grain,box2d-penalty", f"--jobs={jobs}",
                *settings(collision__steps_per_contact=50),
            )  # fmt: skip
            self.assert_status(done, HELD, FELL_SHORT)
            tables.append((self.out / "collisions.csv").read_bytes())
        self.assertEqual(*tables)


if __name__ == "__main__":
    unittest.main()
