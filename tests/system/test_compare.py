"""crossgrain compare and collide as whole runs: the same bits, interim analyses, mirrors, scenes of a user's own.

What they write is kept in tests/golden."""

import concurrent.futures
import math
import re
import shutil
import subprocess
import sys
import unittest

from harness import BAD_INPUT, CASES, COLLISION, COUETTE, FELL_SHORT, HARD_SPHERE, HELD, HOME, SystemTest, settings

SHORT = settings(averaging__rotations=0.02)
SHEAR = CASES / "assembly/plane-shear.toml"


class Files(SystemTest):
    """compare of runs that are here as files."""

    @classmethod
    def setUpClass(cls):
        short = settings(averaging__rotations=0.1, preparation__packings=4, looks__count=1, run__keep_snapshots=100000,
                         run__keep_snapshots_of=4)  # fmt: skip
        cls.ran = cls.compared_once("grain,lammps", *short)
        cls.kept = cls.ran / "snapshots"

    def files(self, engines, *arguments, out="files"):
        return self.run_program("compare", COUETTE, "--engines", engines, "--out", self.folder / out, "--quiet", *arguments)

    def test_verdicts_of_files_are_those_of_the_runs(self):
        self.assert_status(self.files(f"mine={self.kept}/grain-p*.h5,theirs={self.kept}/lammps-p?.h5"), HELD)
        rows = self.rows("endpoints.csv", self.folder / "files")
        self.assertEqual(9, len(rows))
        for ran, read in zip(self.rows("endpoints.csv", self.ran), rows, strict=True):
            self.assertEqual(("mine", "theirs", "paired"), (read["a"], read["b"], read["basis"]))
            for same in ("endpoint", "answer", "difference", "low", "high", "packings", "lost"):
                self.assertEqual(ran[same], read[same], ran["endpoint"])
        results = self.results(self.folder / "files")
        self.assertEqual([], results["packings"])
        self.assertNotIn("grain", {row["engine"] for row in results["runs"]})

    def test_one_file_beside_an_engine_takes_its_scatter(self):
        self.assert_status(self.files(f"grain,theirs={self.kept}/lammps-p2.h5", *settings(preparation__packings=5, averaging__rotations=0.1)), HELD)
        rows = self.rows("endpoints.csv", self.folder / "files")
        self.assertEqual({"one_scatter"}, {row["basis"] for row in rows})
        self.assertEqual({("5", "1")}, {(row["packings_a"], row["packings_b"]) for row in rows})
        self.assertIn("it is taken to scatter as grain does", " ".join(self.results(self.folder / "files")["notes"]))

    def test_one_run_each_says_what_it_cannot_see(self):
        self.assert_status(self.files(f"mine={self.kept}/grain-p0.h5,theirs={self.kept}/lammps-p1.h5"), HELD)
        self.assertIn("do not see how packings differ", " ".join(self.results(self.folder / "files")["notes"]))
        self.assertEqual({"one_run_each"}, {row["basis"] for row in self.rows("endpoints.csv", self.folder / "files")})

    def test_what_is_no_run_is_refused_in_one_line(self):
        cell = self.write("not.h5", "x")
        for engines, words in (
            ("grain,mine=nowhere/*.h5", ("no file matches",)),
            (f"grain,lammps={self.kept}/grain-p0.h5", ("there is an engine 'lammps'",)),
            (f"grain,={self.kept}/grain-p0.h5", ("a name, '='",)),
            (f"grain,mine={cell}", ("not.h5",)),
        ):
            with self.subTest(engines):
                self.assert_one_error(self.files(engines), BAD_INPUT, *words)
        done = self.run_program("lockstep", COUETTE, "--engines", f"mine={self.kept}/grain-p0.h5", "--out", self.folder / "no")
        self.assert_one_error(done, BAD_INPUT, "mine", "files")

ROOM = """
[case]
name = "force-on-the-floor"
kind = "assembly"
dimension = 3
[law]
normal = "linear"
tangential = "none"
kn = 1e4
gn = 2.0
[run]
steps_per_contact = 40
mirrors = false
may_differ = ["conventions"]
[assembly]
duration = 0.6
gravity = [0.0, 0.0, -9.81]
[[assembly.disks]]
position = [0.01, 0.01, 0.01]
radius = 0.01
density = 2500
grid = { columns = 3, rows = 3, layers = 3 }
[[assembly.walls]]
box = [0.0, 0.0, 0.0, 0.06, 0.06, 0.5]
[average]
bins = "whole"
low = [0.0, 0.0, 0.0]
high = [0.06, 0.06, 0.06]
from = 0.5
snapshots = 10
[[endpoints]]
name = "floor"
wall = 0
plane = 2
quantity = "normal_force"
area = 0.0036
expected = EXPECTED
relative = 0.001
why = "at rest the floor carries the weight, by whatever law"
"""

PLANE_ROOM = (
    ROOM.replace("dimension = 3\n", "")
    .replace("gravity = [0.0, 0.0, -9.81]", "gravity = [0.0, -9.81]")
    .replace("[0.01, 0.01, 0.01]", "[0.01, 0.01]")
    .replace("rows = 3, layers = 3", "rows = 3")
    .replace("[0.0, 0.0, 0.0, 0.06, 0.06, 0.5]", "[0.0, 0.0, 0.06, 0.5]")
    .replace("low = [0.0, 0.0, 0.0]", "low = [0.0, 0.0]")
    .replace("high = [0.06, 0.06, 0.06]", "high = [0.06, 0.06]")
    .replace("plane = 2", "plane = 1")
    .replace("area = 0.0036", "area = 0.06")
    # The slowest oscillation of a column of three dies out by exp(−0.2 γ_n t/2m): by 10⁻⁵ in a second.
    .replace("gn = 2.0", "gn = 100.0")
    .replace("duration = 0.6", "duration = 1.1")
    .replace("from = 0.5", "from = 1.0")
)

RIGID_ROOM = """
[case]
name = "rigid"
kind = "assembly"
dimension = 3
[law]
normal = "rigid"
tangential = "coulomb"
e_n = 0.5
mu = 0.3
[run]
dt = 2e-4
may_differ = ["conventions"]
[assembly]
duration = 0.1
gravity = [0.0, 0.0, -9.81]
[[assembly.disks]]
position = [0.012, 0.012, 0.012]
radius = 0.01
density = 2500
velocity_rms = 0.01
grid = { columns = 2, rows = 2, layers = 2, spacing = 1.1 }
[[assembly.walls]]
box = [0.0, 0.0, 0.0, 0.06, 0.06, 0.5]
[preparation]
packings = 4
[looks]
count = 1
[average]
bins = "whole"
low = [0.0, 0.0, 0.0]
high = [0.06, 0.06, 0.06]
from = 0.02
snapshots = 10
[[endpoints]]
name = "height"
quantity = "mean_z"
absolute = 0.01
why = "a radius"
"""


class Space(SystemTest):
    """Spheres, and disks in a periodic cell."""

    BUMPY = CASES / "space/shear-3d.toml"
    SHORT = settings(assembly__duration=0.2, average__from=0.05, average__snapshots=30, preparation__packings=4, looks__count=1)

    def test_spheres_between_sliding_walls(self):
        command = ("compare", self.BUMPY, "--engines", "grain,grain-as-lammps", "--out", self.out, *self.SHORT)
        self.assert_status(self.run_program(*command), HELD, FELL_SHORT)
        results = self.results()
        self.assertEqual([("grain", "finished")] * 4 + [("grain-as-lammps", "finished")] * 4,
                         [(run["engine"], run["status"]) for run in results["runs"]])  # fmt: skip
        self.assertEqual(4, len({packing["hash"] for packing in results["packings"]}))
        self.assertEqual(9, len({row["endpoint"] for row in self.rows("endpoints.csv") if row["kind"] == "peer"}))
        slabs = [row for row in self.rows("profiles.csv") if row["engine"] == "grain" and row["packing"] == "0"]
        volume = sum(float(row["mean"]) * 10 * 27**0.5 for row in slabs if row["field"] == "volume_fraction")
        self.assertAlmostEqual(560 * math.pi / 6, volume, delta=560 * math.pi / 6 * 0.05)  # but for what is in the walls' hollows
        kept = {file: file.stat().st_mtime_ns for file in (self.out / "runs").glob("*.json.gz")}
        self.assertEqual(8, len(kept))
        self.assert_status(self.run_program(*command), HELD, FELL_SHORT)
        self.assertEqual(kept, {file: file.stat().st_mtime_ns for file in kept})

    def test_force_on_the_floor_is_the_weight(self):
        """27 spheres, or 9 disks, at rest in a closed room: weight over area, on every engine that reports wall forces."""
        weight = 27 * 2500 * 4 / 3 * math.pi * 1e-6 * 9.81
        self.assertAlmostEqual(770.476, weight / 0.0036, delta=1e-3)
        for text, engines, expected in (
            (ROOM, "grain,lammps", weight / 0.0036),
            (PLANE_ROOM, "grain,box2d-penalty", 9 * 2500 * math.pi * 1e-4 * 9.81 / 0.06),
        ):
            with self.subTest(engines):
                self.out = self.folder / engines
                case = self.write("room.toml", text.replace("EXPECTED", repr(expected)))
                done = self.held("compare", case, "--engines", engines, "--out", self.out)
                judged = [row for row in self.rows("endpoints.csv") if row["kind"] == "closed_form"]
                self.assertEqual(set(engines.split(",")), {row["b"] for row in judged})
                self.assertEqual({"small_difference"}, {row["answer"] for row in judged}, done.stdout)

    def test_rigid_law_in_space_has_no_mirror_and_is_compared_all_the_same(self):
        case = self.write("rigid.toml", RIGID_ROOM)
        self.held("check", case, "--engines", "bullet,ode", "--no-timing")
        done = self.run_program("compare", case, "--engines", "bullet,ode", "-v", "--out", self.out)
        self.assert_status(done, HELD, FELL_SHORT)
        self.assertIn("there is no mirror: grain, which mirrors are made of, has no rigid contacts in space", done.stdout)
        self.assertEqual({"height"}, {row["endpoint"] for row in self.rows("endpoints.csv") if row["kind"] == "peer"})

    def test_check_and_dry_run_refuse_alike(self):
        """Spheres that overlap, a place that no number resolves, a run without end."""
        room = ROOM.replace("EXPECTED", "1.0")
        for said, instead in (
            ("layers = 3", "layers = 3, spacing = 0.5"),
            ("position = [0.01, 0.01", "position = [1e308, 0.01"),
            ("duration = 0.6", "duration = 1e300"),
        ):
            with self.subTest(instead):
                case, lines = self.write("case.toml", room.replace(said, instead)), []
                for command in (("check", "--no-timing"), ("compare", "--dry-run", "--out", self.out)):
                    done = self.run_program(command[0], case, "--engines", "grain", *command[1:])
                    self.assert_status(done, BAD_INPUT)
                    lines.append(done.error_lines())
                self.assertEqual(1, len(lines[0]))
                self.assertEqual(lines[0], lines[1])

    def test_dry_run(self):
        done = self.held("compare", self.BUMPY, "--engines", "grain", "--out", self.out, "--dry-run", *self.SHORT)
        self.assertIn("shear-3d: 4 packings, 4 of them prepared already", done.stdout)

    def test_spheres_in_cylinders(self):
        for name in ("silo", "silo-large", "drum"):
            short = settings(assembly__duration=0.01, average__from=0.0, average__snapshots=10, preparation__packings=1)
            out = self.folder / name
            done = self.run_program("compare", CASES / f"space/{name}.toml", "--engines", "grain", "--out", out, *short)
            self.assert_status(done, HELD, FELL_SHORT)
            self.assertEqual(["finished"], [run["status"] for run in self.results(out)["runs"]])

    def test_disks_in_a_periodic_cell(self):
        case = CASES / "space/plane-shear.toml"
        short = settings(assembly__duration=0.05, average__from=0.0, average__snapshots=20, preparation__packings=4, looks__count=1)
        self.held("compare", case, "--engines", "grain", "--out", self.out, *short)
        self.assertEqual(["finished"] * 4, [run["status"] for run in self.results()["runs"]])


class Reference(SystemTest):
    """compare --reference"""

    THREE = "grain,lammps,box2d-penalty"
    FOUR = settings(averaging__rotations=0.02, preparation__packings=4, looks__count=1, run__mirrors="false")

    def test_without_one_each_is_compared_with_the_median_of_the_others(self):
        self.assert_status(self.compare(*self.FOUR, "--reference=none", engines=self.THREE), HELD, FELL_SHORT)
        rows = [row for row in self.rows("endpoints.csv") if row["a"] == "median"]
        self.assertEqual(set(self.THREE.split(",")), {row["b"] for row in rows})
        self.assertEqual(27, len(rows))
        # Worked out again from the series: coordination is the mean of its series, packing by packing.
        means = {}
        for row in self.rows("series.csv"):
            means.setdefault((row["engine"], row["packing"]), []).append(float(row["coordination"]))
        means = {run: sum(values) / len(values) for run, values in means.items()}
        for row in rows:
            if row["endpoint"] != "coordination":
                continue
            others = [name for name in self.THREE.split(",") if name != row["b"]]
            differences = [means[row["b"], p] - sum(means[name, p] for name in others) / 2 for p in "0123"]
            self.assertAlmostEqual(sum(differences) / 4, float(row["difference"]), delta=1e-9)
        results = self.results()
        self.assertEqual("median", results["endpoints"]["reference"])
        self.assertIn("No engine is the reference", " ".join(results["notes"]))
        self.assertEqual(self.THREE.split(","), [engine["name"] for engine in results["engines"]])

    def test_any_engine_may_be_it(self):
        self.assert_status(self.compare(*self.FOUR, "--reference=lammps", engines=self.THREE), HELD, FELL_SHORT)
        self.assertEqual(["lammps", "grain", "box2d-penalty"], [engine["name"] for engine in self.results()["engines"]])
        self.assert_one_error(self.compare(*self.FOUR, "--reference=yade", engines=self.THREE), BAD_INPUT, "--reference yade: it is not among")
        self.assert_one_error(self.compare(*self.FOUR, "--reference=none", engines="grain,lammps"), BAD_INPUT, "takes three engines", "here are 2")


class Compare(SystemTest):
    def test_same_bits_however_many_jobs_and_from_the_case_in_the_results(self):
        """Whether the packings come from a cache, and however many runs are side by side."""
        tables = []
        for jobs, cache in ((1, "one"), (2, "two")):
            out = self.folder / cache
            done = self.compare(*SHORT, f"--jobs={jobs}", out=out, env={"CROSSGRAIN_CACHE": str(self.folder / f"{cache}-cache")})
            self.assert_status(done, HELD)
            tables.append([(out / name).read_bytes() for name in ("profiles.csv", "series.csv")])
        self.assertEqual(*tables)
        case = self.write("again.toml", self.results(self.folder / "one")["case"]["toml"])
        self.held("compare", case, "--engines", "grain", "--out", self.folder / "again")
        self.assertEqual(tables[0][0], (self.folder / "again/profiles.csv").read_bytes())
        self.assert_status(self.compare(*SHORT, "--seed=9"), HELD)
        self.assertNotEqual(tables[0][0], (self.out / "profiles.csv").read_bytes())

    def test_energy_ledger_accounts_for_the_work_of_the_wheel(self):
        done = self.compare(*SHORT, *settings(run__energy_ledger="true"), engines="grain,box2d-penalty")
        self.assert_status(done, HELD, FELL_SHORT)
        for row in self.rows("series.csv"):
            if row["engine"] != "grain":  # has no ledger
                self.assertEqual("", row["energy_residual"])
                continue
            self.assertGreater(float(row["energy_lost_sliding"]), 0.0)
            # Springs stretched after their force, 50 steps a contact: a few per cent at most.
            put_in = float(row["energy_work_of_walls"]) + float(row["energy_initial"])
            self.assertLess(abs(float(row["energy_residual"])), 0.05 * put_in)

    def test_one_engine_is_neither_undecided_nor_decided(self):
        done = self.compare("--quiet", *SHORT, "--set=preparation.packings=1")
        self.assert_status(done, HELD)
        self.assertIn("nothing was judged: one engine has nothing", done.stdout)
        overview = self.results()["overview"]
        states = {cell["state"] for row in overview["rows"] for cell in row["cells"]}
        for contradiction in ("undecided", "every endpoint"):
            self.assertNotIn(contradiction, done.stdout + " ".join(overview["conclusion"]))
        self.assertNotIn("undecided", states)

    def test_quick_makes_nothing_longer(self):
        done = self.compare("--dry-run", "--set=preparation.packings=1")
        self.assertIn("1 packing,", done.stdout)


class InterimAnalyses(SystemTest):
    SHORT = settings(
        preparation__packings=4, preparation__shrink_time=0.3, preparation__rotations=0.05,
        averaging__settle_rotations=0.02, averaging__rotations=0.05, looks__count=3,
    )  # fmt: skip

    def compare_short(self, engines, *arguments):
        return self.run_program("compare", COUETTE, "--engines", engines, "--out", self.out, "-v", *self.SHORT, *arguments)

    def test_mirror_is_evaluated_in_place_of_its_peer(self):
        done = self.compare_short("grain,box2d-penalty")
        self.assert_status(done, HELD)
        rows = self.rows("endpoints.csv")
        self.assertEqual(9, len(rows))
        self.assertEqual({"grain-as-box2d-penalty"}, {row["carrier_b"] for row in rows})
        self.assertLess(max(float(row["bound"]) for row in rows), 1e-6)
        self.assertEqual(1, [run["engine"] for run in self.results()["runs"]].count("box2d-penalty"))
        self.assertIn("box2d-penalty: evaluated through its mirror grain-as-box2d-penalty", done.stdout)
        self.assertIn("16 equal windows leave at most 19 % of states different", done.stdout)
        # The first verdict is there before the first run.
        self.assertRegex(done.stderr, r"(?s)\nlockstep: box2d-penalty: identical to rounding over 16 starts[^\n]*\n.*running engines")

    def test_next_analysis_goes_on_where_the_budget_ended(self):
        engines = "grain,box2d-impulse"
        stiff = '--set=averaging.endpoints.mean_spin={ absolute = 1e-9, why = "never" }'
        first = self.compare_short(engines, "--budget=0.1s", stiff)
        self.assert_status(first, HELD)  # 10⁷ such margins are within chance: no alarm
        self.assertRegex(first.stdout, r"Analysed after 4 packings \(1 of 3 interim analyses\), agree tested at 2\.3\d % in each; 1\.25 of 5 %")
        self.assertRegex(first.stderr, r"the first analysis, at 4 packings, is likely to end after \S+ s, .* beyond the budget of 0\.1 s")
        decided = {
            row["endpoint"]: row["answer"] for row in self.rows("endpoints.csv") if row["answer"] not in ("undecided", "borderline")
        }
        runs = self.finished_runs()
        second = self.compare_short(engines, "--budget=10m", stiff)
        self.assert_status(second, FELL_SHORT)
        self.assertRegex(second.stdout, r"Analysed after 4, 8, 12 packings \(3 of 3 interim analyses\), .*; 5 of 5 %")
        now = self.finished_runs()
        self.assertEqual(runs, {name: now[name] for name in runs})
        # Large data are there once: distributions of a packing are in its run, snapshots of the first packing.
        self.assertFalse((self.out / "scratch").exists())
        self.assertTrue(all(not run["distributions"] for run in self.results()["runs"]))
        self.assertEqual({"all"}, {row["packing"] for row in self.rows("distributions.csv")})
        self.assertTrue(all(file.stem.endswith("-p0") for file in (self.out / "snapshots").iterdir()))
        for row in self.rows("endpoints.csv"):
            if row["endpoint"] in decided:
                self.assertEqual((decided[row["endpoint"]], "1"), (row["answer"], row["look"]))
        # A smaller budget takes nothing back: finished runs cost nothing.
        verdicts = self.rows("endpoints.csv")
        third = self.compare_short(engines, "--budget=0.1s", stiff)
        self.assertRegex(third.stdout, r"Analysed after 4, 8, 12 packings \(3 of 3 interim analyses\)")
        self.assertEqual(verdicts, self.rows("endpoints.csv"))
        # Nor does an engine more for which there is no time.
        fourth = self.compare_short(f"{engines},grain-stiff", "--budget=0.1s", stiff)
        self.assertIn("grain-stiff went no further than 4 packings, as the budget of 0.1 s ended", fourth.stdout)
        kept = [[row[key] for key in ("a", "b", "endpoint", "answer", "low", "high", "look", "lost")] for row in self.rows("endpoints.csv")]
        for row in verdicts:
            self.assertIn([row[key] for key in ("a", "b", "endpoint", "answer", "low", "high", "look", "lost")], kept)


class Collide(SystemTest):
    FEW = settings(collision__steps_per_contact=50, collision__psi=[0.5, 2.0, 4.0])

    def collide(self, case, engines, *arguments):
        return self.run_program("collide", case, "--engines", engines, "--out", self.out, *arguments)

    def test_folder_of_collisions_is_one_report_and_mirrors_run_where_they_are_wanted(self):
        folder = self.folder / "mine"
        folder.mkdir()
        for name, mirrors in (("a", "false"), ("b", "true")):
            (folder / f"{name}.toml").write_text(
                f'[case]\nextends = "{COLLISION}"\n[run]\nmirrors = {mirrors}\n[collision]\npsi = [0.5, 2.0]\nsteps_per_contact = 50\n'
            )
        (folder / "c.toml").write_text(f'[case]\nkind = "couette"\nextends = "{COUETTE}"\n')
        self.assert_status(self.collide(folder, "box2d-penalty", "-k", "*-cut"), HELD, FELL_SHORT)
        mirror = "grain-as-box2d-penalty"
        ran = {(row["case"], row["engine"]) for row in self.rows("collisions.csv")}
        self.assertEqual({("a", "box2d-penalty"), ("b", "box2d-penalty"), ("b", mirror)}, ran)
        page = (self.out / "report.html").read_text(encoding="utf-8")
        for words in ('href="#case_2"', 'id="case_2">b<', "spring-cut"):
            self.assertIn(words, page)
        self.assertEqual(1, page.count("Model or implementation?"))

    def test_model_difference_is_no_fault_unless_strict(self):
        """An engine true to conventions that the case lets it have does what it says; whether that is the scene's law, too,
        is asked under --strict."""
        wall = CASES / "collision/wall-oblique.toml"
        for strict, status in (((), HELD), (("--strict",), FELL_SHORT)):
            done = self.collide(wall, "box2d-penalty", "-k", "fixed", "--set=run.mirrors=false", *self.FEW, *strict)
            self.assert_status(done, status)
            self.assertRegex(done.stdout, r"0 curves passed, 1 differ by their model, 0 failed")
        (row, *_) = self.rows("collisions.csv")
        self.assertEqual(
            ("model difference", "fell short", "held"), (row["outcome"], row["verdict_scene"], row["verdict_declared"])
        )

    def test_impulses_follow_waltons_law(self):
        """Ψ_f = max(−e_t0 Ψ_i, Ψ_i − 3 (1 + e_n) µ)."""
        self.assert_status(self.collide(HARD_SPHERE, "box2d-impulse", "--set=run.mirrors=false"), HELD)
        rows = self.rows("collisions.csv")
        self.assertEqual(2 * 41, len(rows))
        for row in rows:
            psi = float(row["psi_i"])
            expected = max(-{"e_t0-0": 0.0, "e_t0-0.5": 0.5}[row["variant"]] * psi, psi - 3 * 1.9 * 0.44)
            self.assertAlmostEqual(expected, float(row["psi_f_reference"]), places=9)
            self.assertAlmostEqual(expected, float(row["psi_f"]), delta=1e-3)
            self.assertAlmostEqual(0.9, float(row["e_n"]), delta=1e-3)

    def test_same_bits_however_many_jobs(self):
        tables = []
        for jobs in (1, 2):
            done = self.collide(COLLISION, "grain,box2d-penalty", f"--jobs={jobs}", "--fresh", "-k", "*-cut", *self.FEW)
            self.assert_status(done, HELD, FELL_SHORT)
            tables.append((self.out / "collisions.csv").read_bytes())
        self.assertEqual(*tables)


# A disk that falls on a fixed one, without run.dt.
FILES = """
[case]
kind = "assembly"
extends = "LAWS/rough.toml"
[assembly]
duration = 0.02
gravity = [0.0, -9.81]
[assembly.start]
file = ["start-0.csv", "start-1.csv", "start-2.csv", "start-3.csv"]
density = 6.4
[looks]
count = 2
[average]
bins = "whole"
low = [-0.01, 0.0]
high = [0.01, 0.02]
from = 0.01
snapshots = 5
[[endpoints]]
name = "height"
quantity = "top"
absolute = 0.001
why = "a test"
[run]
mirrors = false
"""

# A disk that flies out of the averaged part.
LEAVES = """
[case]
kind = "assembly"
extends = "LAWS/rough.toml"
[run]
mirrors = false
[assembly]
duration = 0.1
[[assembly.disks]]
position = [0.0, 0.0]
radius = 0.0037
mass = 2.75e-4
velocity = [0.5, 0.0]
velocity_rms = 0.001
[average]
bins = "whole"
low = [-0.02, -0.02]
high = [0.02, 0.02]
from = 0.0
snapshots = 20
[[endpoints]]
name = "place"
quantity = "mean_x"
absolute = 0.01
why = "a test"
"""


class Assemblies(SystemTest):
    """Scenes that a case or a file of disks makes up."""

    def compare(self, case, *arguments, engines="grain"):
        return self.run_program("compare", case, "--engines", engines, "--out", self.out, "--quiet", *arguments)

    def test_plane_shear_in_slabs(self):
        short = settings(
            assembly__duration=0.06, average__from=0.03, average__snapshots=10, preparation__packings=1, looks__count=1,
            run__mirrors="false", run__energy_ledger="true",
        )  # fmt: skip
        self.assert_status(self.compare(SHEAR, *short), HELD, FELL_SHORT)
        top = [row for row in self.rows("profiles.csv") if row["field"] == "velocity_x" and row["ring"] == "6"]
        self.assertAlmostEqual(0.0604 * 11 / 12, float(top[0]["r_m"]))
        self.assertGreater(float(top[0]["mean"]), 0.0)  # the top wall pulls to the right
        self.assertIn("energy_work_of_walls", self.rows("series.csv")[0])

    def test_lockstep_begins_where_the_walls_are(self):
        """With walls elsewhere than the mirror's, or disks, the first steps would part them by far more than rounding."""
        self.held(
            "lockstep", SHEAR, "--engines", "box2d-penalty", "--starts=2", "--out", self.out, "--quiet",
            *settings(assembly__duration=0.2, average__from=0.1),
        )  # fmt: skip
        last = self.rows("lockstep.csv")[-1]
        self.assertIn(last["verdict"], ("same_to_rounding", "same_law"))
        self.assertLess(float(last["largest_d"]), 1e-8)

    def test_start_of_the_users_own(self):
        for file in ("make_start.py", "from-file.toml"):
            shutil.copy(HOME / "examples/starts" / file, self.folder)
        case = self.folder / "from-file.toml"
        case.write_text(case.read_text(encoding="utf-8").replace("../../cases", str(CASES)), encoding="utf-8")
        subprocess.run([sys.executable, "make_start.py"], cwd=self.folder, check=True)
        short = settings(assembly__duration=0.05, average__from=0.02, preparation__packings=2)
        self.assert_status(self.compare(case, *short), HELD)
        self.assertEqual(60, self.results()["region"]["disks"])
        start = self.folder / "start.csv"
        lines = start.read_text(encoding="utf-8").splitlines()
        lines[4] = lines[4].replace("0.00", "O.00", 1)
        start.write_text("\n".join(lines), encoding="utf-8")
        bad = self.compare(case)
        self.assert_status(bad, BAD_INPUT)
        self.assertRegex(bad.error_lines()[0], r"start\.csv:5: \w+ = .*: must be a number")

    def test_files_are_counted_once_and_another_fixed_disk_is_another_case(self):
        """Four files are four packings however many analyses, and need no run.dt."""
        for k in range(4):
            self.write(f"start-{k}.csv", f"x,y,radius,fixed\n0,{0.0077 + 0.0001 * k},0.0037,0\n0,0,0.0037,1\n")
        case = self.write("case.toml", FILES.replace("LAWS", str(CASES / "laws")))
        self.assert_status(self.compare(case), HELD)
        self.assertEqual(4, len(self.results()["packings"]))
        before = self.finished_runs()
        self.assert_status(self.compare(case), HELD)
        self.assertEqual(before, self.finished_runs())
        for k in range(4):
            start = self.folder / f"start-{k}.csv"
            start.write_text(start.read_text(encoding="utf-8").replace("0,0,0.0037", "0.001,0,0.0037"), encoding="utf-8")
        self.assert_one_line(self.compare(case), BAD_INPUT, "depends on what has changed: packing:", "--fresh")

    def test_closed_forms_find_a_law_a_little_off(self):
        """Every engine, the reference too, is judged by the case's expected values on one start."""
        for name, change in {"bounce": "law.gn=2.1", "roll": "law.mu=0.21", "squeeze": "law.kn=103"}.items():
            with self.subTest(name):
                case = CASES / f"assembly/{name}.toml"
                self.out = self.folder / name
                self.assert_status(self.compare(case, engines="grain,box2d-penalty"), HELD)
                judged = [row for row in self.rows("endpoints.csv") if row["kind"] == "closed_form"]
                self.assertEqual({"grain", "box2d-penalty"}, {row["b"] for row in judged})
                self.assertEqual({"small_difference"}, {row["answer"] for row in judged})
                self.out = self.folder / f"{name}-off"
                self.assert_status(self.compare(case, f"--set={change}"), FELL_SHORT)
                self.assertIn("disagree", {row["answer"] for row in self.rows("endpoints.csv")})

    def test_closed_forms_of_spheres_without_a_convention(self):
        """DEM01 to DEM04 of MFiX; a constant a little off fails each."""
        for name, change in {"mfix-dem01": "law.gn=148", "mfix-dem03": "law.kn=1030", "mfix-dem04": "law.mu=0.21"}.items():
            with self.subTest(name):
                case = CASES / f"space/{name}.toml"
                self.out = self.folder / name
                self.assert_status(self.compare(case), HELD)
                self.out = self.folder / f"{name}-off"
                self.assert_status(self.compare(case, f"--set={change}"), FELL_SHORT)
                self.assertIn("disagree", {row["answer"] for row in self.rows("endpoints.csv")})

    def test_quick_leaves_closed_forms_their_snapshots(self):
        """Of ten periods of stick and slip, 20 snapshots would show none of the times at which it slips."""
        case = CASES / "assembly/stick-slip.toml"
        self.held("compare", case, "--engines", "grain", "--quick", "--out", self.out, "--quiet")
        self.assertEqual(["small_difference"] * 3, [row["answer"] for row in self.rows("endpoints.csv")])

    def test_column_stands_by_its_cohesion_alone(self):
        for name, low, high in (("column", 0.074, 0.085), ("column-without", 0.0, 0.05)):  # of 12 layers of 6.4 mm
            self.out = self.folder / name
            self.assert_status(self.compare(CASES / f"assembly/cohesion/{name}.toml", "--set=preparation.packings=1"), HELD)
            top = float(self.rows("series.csv")[-1]["top"])
            self.assertTrue(low < top < high, top)

    def test_engine_that_loses_its_disk_has_no_mean(self):
        """The only disk leaves the averaged part: a mean of what was seen before is no value."""
        case = self.write("case.toml", LEAVES.replace("LAWS", str(CASES / "laws")))
        self.assertNotEqual(HELD, self.compare(case, engines="grain,box2d-penalty").status)
        row = self.rows("endpoints.csv")[0]
        self.assertEqual(("undecided", "0", "4"), (row["answer"], row["packings"], row["lost"]))
        self.assertRegex(row["reason"], r"grain, packing 0: no mean_x in \d+ of 20 snapshots")


class Shards(SystemTest):
    def test_share_the_runs_and_the_first_writes_what_one_process_would(self):
        def command(out, *more):
            return ["compare", COUETTE, "--engines", "grain,box2d-penalty", "--quick", "--set=run.mirrors=false", "--out", out, *SHORT, *more]

        with concurrent.futures.ThreadPoolExecutor() as pool:
            both = list(pool.map(lambda k: self.run_program(*command(self.out, f"--shard={k}/2")), (1, 2)))
        alone = self.folder / "alone"
        self.assertEqual((self.run_program(*command(alone)).status, HELD), (both[0].status, both[1].status))
        self.assertIn("shard 2 of 2: all runs are finished; shard 1 writes the results", both[1].stdout)
        runs, whole = ({(run["engine"], run["packing"]): run for run in self.results(out)["runs"]} for out in (self.out, alone))
        self.assertEqual(whole.keys(), runs.keys())
        for key in whole.keys() - {key for key in whole if key[0] != "grain"}:
            self.assertEqual(whole[key]["profiles"], runs[key]["profiles"])
        # Each process ran what the other did not: progress says how each run came.
        ran = [set(re.findall(r"\] (\S+ packing \d+): (?!finished)", done.stderr)) for done in both]
        self.assertEqual((set(), {f"{engine} packing {packing}" for engine, packing in runs}), (ran[0] & ran[1], ran[0] | ran[1]))
        self.assertFalse((self.out / "claims").exists())



if __name__ == "__main__":
    unittest.main()
