"""Engines that are programs of their own, where they are installed: YADE, LAMMPS, LIGGGHTS, engines in Node, Bullet, ODE, Chipmunk, Siconos.

Each passes crossgrain's own conformance checks in tests/conformance; here: that it is its law along a flow, what is particular
to it, and that it is refused with what to install where it is missing."""

import array
import importlib.util
import json
import math
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import unittest

from harness import (
    BAD_INPUT,
    CASES,
    COLLISION,
    COUETTE,
    ENGINE_FAILED,
    FELL_SHORT,
    HARD_SPHERE,
    HELD,
    HOME,
    INTERRUPTED,
    PATIENCE,
    PROGRAM,
    SystemTest,
    command_line,
    cpu_time,
    installed_engines,
    marked_processes,
    recorded_exchanges,
    settings,
    wait_for,
)

MU, EN = 0.44, 0.9  # of cases/collision/hard-sphere.toml


# Each engine × each law, case and rank, and the whole suite of rigid engines: cmake --build … --target all_of_peers
AT_NIGHT = "CROSSGRAIN_AT_NIGHT" in os.environ
at_night = unittest.skipUnless(AT_NIGHT, "for the night")


INSTALLED = installed_engines()


def one_of(several, index=0):
    """By day one of what shows the same."""
    return several if AT_NIGHT else several[index : index + 1]


class Peer(SystemTest):
    def lockstep(self, engine, *arguments, case=COUETTE, starts=2):
        self.held(
            "lockstep", case, "--engines", engine, "--out", self.out, "--quick", "--quiet", f"--starts={starts}", "--fresh", *arguments
        )
        (row,) = self.results()["lockstep"]["rows"]
        return row

    def laws(self, changes):
        return (f"--set={key}={value}" for key, value in changes.items())

    def passes(self, *checks):
        """Those of `conformance` whose names contain one of these words."""
        self.held("conformance", self.engine, "--quiet", "-k", ",".join(checks))

    def last_sliding(self, engines):
        """The last of a sweep of hard disks, Ψ_i = 4, by engine, and how the command ended."""
        done = self.run_program("collide", HARD_SPHERE, "--engines", engines, "-k", "*e_t0-0", "--out", self.out, "--quiet")
        return done, {row["engine"]: row for row in self.rows("collisions.csv") if float(row["psi_i"]) == 4.0}


class Refuses:
    """refused: cases, changes of their law, and words of the reason."""

    def test_what_it_cannot_do_is_refused_by_name(self):
        for case, law, reason in self.refused:
            with self.subTest(reason):
                done = self.run_program("check", case, "--no-timing", "--engines", self.engine, *self.laws(law))
                self.assertIn(reason, done.stdout + done.stderr)


class OutOfTheBox:
    """Cases without a convention, which say what was measured or follows from closed forms, not from this project."""

    def test_benchmarks_without_a_convention(self):
        self.held(
            "collide", CASES / "space/benchmarks.toml", "--engines", self.engine, "--quiet", "--fresh", "--out", self.out,
            *settings(run__mirrors="false", collision__steps_per_contact=[100]),
        )  # fmt: skip
        curves = [curve for variant in self.results()["variants"] for curve in variant["curves"]]
        self.assertEqual(["held", "held"], [curve["score"]["verdict"] for curve in curves])
        for name, endpoints in one_of((("mfix-dem01", 3), ("mfix-dem03", 4), ("mfix-dem04", 2)), 1):
            self.held(
                "compare", CASES / f"space/{name}.toml", "--engines", f"grain,{self.engine}", "--quiet", "--fresh", "--out", self.out
            )
            judged = [row["answer"] for row in self.rows("endpoints.csv") if row["kind"] == "closed_form"]
            self.assertEqual(["small_difference"] * 2 * endpoints, judged, name)


@unittest.skipUnless(shutil.which("yade"), "yade is not installed (Debian: package yade)")
class Yade(OutOfTheBox, Peer):
    engine = "yade"

    def test_is_the_law_that_it_declares(self):
        row = self.lockstep("yade")
        self.assertEqual("same_law", row["verdict"])
        self.assertLess(row["equivalent"], 1e-3)
        done = self.held("identify", COUETTE, "--engines", "yade", "--quiet")
        for line in (r"tension +cut +declares cut", r"dashpot +outside +declares outside", "does not simulate +bottom_friction"):
            self.assertRegex(done.stdout, rf"(?m)^{line}")
        self.assertNotIn("<-", done.stdout)

    def test_compare_notes_what_differs_and_its_mirror_follows_it(self):
        short = settings(
            run__mirrors="true", preparation__packings=1, averaging__settle_rotations=0.0, averaging__rotations=0.01,
            averaging__snapshots_per_rotation=400,
        )  # fmt: skip
        self.assert_status(self.compare(*short, engines="grain,yade"), HELD)
        results = self.results()
        self.assertEqual(
            {"peer", "mirror_model", "mirror_implementation"}, {row["kind"] for row in results["agreement"]}
        )
        runs = {run["engine"]: run for run in results["runs"]}
        self.assertEqual({"grain", "yade", "grain-as-yade"}, set(runs))
        noted = {deviation["name"] for deviation in runs["yade"]["realised"]["deviations"]}
        self.assertLessEqual({"tension", "bottom_friction"}, noted)
        first = {name: run["series"]["kinetic_energy"][0] for name, run in runs.items()}
        self.assertAlmostEqual(1.0, first["yade"] / first["grain-as-yade"], delta=0.02)

    def test_prepares_packings_of_its_own(self):
        """preparation.engine: kept under the engine's name and version."""
        env = {"CROSSGRAIN_CACHE": str(self.folder / "packings")}
        short = settings(
            preparation__packings=1, preparation__shrink_time=0.2, preparation__rotations=0.01,
            averaging__settle_rotations=0.0, averaging__rotations=0.01,
        )  # fmt: skip
        kept = set()
        for engine, told in (("grain", "prepared"), ("yade", "prepared"), ("yade", None)):
            done = self.compare("--fresh", *short, f"--set=preparation.engine={engine}", env=env)
            self.assertIn(f"packing 0: {told}" if told else "1 packing kept", done.stderr)
            kept.add(self.results()["packings"][0]["hash"])
        self.assertEqual(2, len(kept))

    def test_starts_without_a_home_and_says_why_it_does_not(self):
        """It looks for its settings there and would not start."""
        done = self.run_program("check", COUETTE, "--no-timing", "--engines", "yade", env={"HOME": "/nonexistent"})
        self.assertRegex(done.stdout, r"(?m)^ *yade +can run it")
        fake = self.write("yade", "#!/usr/bin/env python3\nprint('Welcome')\nimport no_such_module\n")
        fake.chmod(0o755)
        env = {"PATH": f"{self.folder}:{os.environ['PATH']}"}
        self.assert_one_line(
            self.run_program("check", COUETTE, "--engines", "yade", env=env), ENGINE_FAILED,
            "yade: ended (exit status 1) during hello", "its error: ModuleNotFoundError: No module named 'no_such_module'",
        )  # fmt: skip

    def test_collision_is_that_of_its_mirror(self):
        done = self.run_program(
            "collide", COLLISION, "--engines", "yade", "--out", self.out, "--quiet", "-k", "spring_dashpot-cut",
            *settings(collision__psi=[0.5, 2.0], collision__steps_per_contact=1000),
        )  # fmt: skip
        self.assert_status(done, HELD)  # its dashpot is outside the Coulomb test: a model difference
        (variant,) = self.results()["variants"]
        curves = {curve["engine"]: curve for curve in variant["curves"]}
        # In double precision, step by step, it is the leapfrog of its law to rounding.
        self.assertTrue(curves["yade"]["own_scheme"]["held"])
        # No limit of small steps: the in-house engine with its conventions is the reference.
        declared = curves["yade"]["declared"]
        self.assertEqual(("mirror", "held"), (declared["reference"], declared["score"]["verdict"]))
        for en in curves["yade"]["points"]["e_n"]:
            self.assertAlmostEqual(0.3408, en, delta=0.002)
        for column in ("psi_f", "max_overlap", "lost_normal_damping", "lost_tangential"):
            both = (curves[name]["points"][column] for name in ("yade", "grain-as-yade"))
            for found, mirrored in zip(*both, strict=True):
                self.assertAlmostEqual(mirrored, found, delta=1e-6 * abs(mirrored) + 1e-12)

    def test_ends_with_crossgrain(self):
        for number in (signal.SIGINT, signal.SIGKILL):
            running = self.start_compare(*settings(averaging__rotations=0.5), "--fresh", engines="yade")
            wait_for(lambda: "running engines" in running.stderr(), PATIENCE, "the runs to begin")
            wait_for(lambda: len(running.processes()) >= 2, PATIENCE, "YADE to start")
            os.kill(running.process.pid, number)
            running.process.wait()
            if number == signal.SIGINT:
                self.assert_one_error(running.end(), INTERRUPTED, "interrupted")
            wait_for(lambda: not running.processes(), PATIENCE, "YADE to end")


TWO = "--set=engines.lammps.ranks=2"
HERTZ = CASES / "cost/hertz.toml"
SPRING = {"law.rolling": "spring", "law.mu_r": 0.1, "law.rolling_load": "magnitude"}
DAMPED_HERTZ = {"law.tangential": "spring_dashpot", "law.damper": "constant", "law.gn": 0.1, "law.gt": 0.08}
# A pull of 2 mN, about that of a chain of disks in the cell.
ADHESIVE = {"law.w": 0.17}
DMT = {"law.cohesion": "dmt", "law.cohesion_load": "net_without_dashpot"}
JKR = {"law.cohesion": "jkr", "law.cohesion_load": "plus_twice_pull_off"}
DIAMETER = 2 * 3.7e-3  # m, of a small disk of the quick cell
CHUNG_OOI = CASES / "collision/chung-ooi-1.toml"


@unittest.skipUnless(shutil.which("lmp"), "LAMMPS is not installed (Debian: package lammps)")
@unittest.skipUnless(shutil.which("mpirun"), "there is no mpirun (Debian: package openmpi-bin)")
class Lammps(OutOfTheBox, Refuses, Peer):
    engine = "lammps"
    refused = (
        (COUETTE, SPRING | {"law.rolling": "constant_torque"}, "has rolling = none | spring, not constant_torque"),
        (COUETTE, SPRING | {"law.kr": 100.0, "engines.lammps.ranks": 2}, "has rolling_resistance on one rank alone"),
        (COUETTE, {"law.cohesion": "area", "law.kc": 1e3}, "has cohesion = none | dmt | jkr, not area"),
        (COUETTE, ADHESIVE | DMT, 'has cohesion = "dmt" with normal = "hertz" alone'),
        (HERTZ, DAMPED_HERTZ | ADHESIVE | JKR | {"law.cohesion_load": "net_without_dashpot"}, 'has cohesion_load = "plus_twice_pull_off" with'),
        (HERTZ, DAMPED_HERTZ | ADHESIVE | JKR | {"law.damper": "critical"}, 'dashpots of damper = "constant" alone with cohesion = "jkr"'),
        (CASES / "assembly/pile.toml", {"law.rolling": "viscous", "law.gr": 1.0}, "has rolling = none | spring, not viscous"),
        (CASES / "collision/measured-disk.toml", {}, "has normal = linear | hertz, not polynomial"),
        (CHUNG_OOI, {"law.damper": "viscoelastic", "law.gn": 1e-6}, "has damper = constant | critical, not"),
        (CHUNG_OOI, {"law.gn": 1.2}, "between 0.0003 and 1.27, not 1.47"),  # 1.2 √1.5
    )

    def test_is_the_law_that_it_declares_on_one_rank_and_two(self):
        """Law, conventions, the wheel's motion, forces read back; Mindlin's spring as displacement and as force."""
        for case, more in one_of((
            (COUETTE, []), (COUETTE, [TWO]), (HERTZ, ["--set=law.history=displacement"]), (HERTZ, ["--set=law.history=force"]),
        ), 1):  # fmt: skip
            with self.subTest(case=case.stem, more=more):
                row = self.lockstep("lammps", *more, case=case)
                self.assertEqual("same_to_rounding", row["verdict"])
                self.assertGreater(row["kinds"]["wall"], 0)
                self.assertLess(max(row["forces"]["normal"], row["forces"]["tangential"]), 1e-12)

    def test_is_its_laws_of_rolling_and_cohesion(self):
        """In windows of 100 ms, in which LAMMPS would sort atoms and reverse rolling springs: 0.02 d."""
        spring = SPRING | {"law.gr": 0.05, "law.rolling_reset": "spring_only"}
        jkr = DAMPED_HERTZ | ADHESIVE | JKR
        for case, law in one_of((
            (COUETTE, spring | {"law.kr_per_kt": 1.0}),
            (HERTZ, DAMPED_HERTZ | ADHESIVE | DMT),
            (HERTZ, jkr),
            (HERTZ, jkr | spring | {"law.kr": 100.0, "law.history": "force"}),
        ), 3):  # fmt: skip
            with self.subTest(law=law):
                row = self.lockstep("lammps", *self.laws(law), case=case, starts=1)
                self.assertIn(row["verdict"], ("same_to_rounding", "same_law"))
                self.assertLess(row["equivalent"] or 0.0, 1e-9)
                self.assertLess(max(row["forces"]["normal"], row["forces"]["tangential"]), 1e-10)

    @at_night
    def test_conventions_are_found_from_outside(self):
        """Arms of f_t and of v_t that differ: neither alone brings a mirror nearer, the two together do."""
        done = self.held("identify", COUETTE, "--engines", "lammps", "--quiet")
        for option, value in (
            ("lever_arm", "overlap_middle"), ("velocity_arm", "radius"), ("coulomb_bound", "magnitude"),
            ("spring_reset", "spring_only"), ("spring_update", "before"), ("damping_velocity", "lagged"),
        ):  # fmt: skip
            self.assertRegex(done.stdout, rf"(?m)^{option} +{value} +declares {value}$")

    @at_night
    def test_pile_on_planes(self):
        """Forces of disks and planes come from two parts of LAMMPS."""
        self.held("stability", CASES / "hard/pile.toml", "--engines", "lammps", "--out", self.out, "--quick", TWO)

    def test_several_ranks_without_mpirun_are_refused_with_what_to_install(self):
        with tempfile.TemporaryDirectory() as folder:
            for program in pathlib.Path("/usr/bin").iterdir():
                if not program.name.startswith("mpi"):
                    (pathlib.Path(folder) / program.name).symlink_to(program)
            done = self.compare(TWO, "--quiet", engines="lammps", out=self.folder / "other", env={"PATH": folder})
        self.assert_one_error(done, BAD_INPUT, "ranks = 2", "mpirun", "openmpi-bin")

    def snapshots_of(self, ranks):
        """Time and arrays of every snapshot of a recorded run."""
        recording = self.folder / f"{ranks}.rec"
        self.assert_status(self.run_program(
            "record", COUETTE, "--engines", "lammps", "--out", recording, "--time=0.01", "--looks=5",
            f"--set=engines.lammps.ranks={ranks}",
        ), HELD)  # fmt: skip
        for request, answer, content in recorded_exchanges(recording):
            if request["request"] != "snapshot":
                continue
            arrays = {}
            for entry in answer["arrays"]:
                values = array.array({"f64": "d", "i32": "i", "u8": "B"}[entry["type"]])
                values.frombytes(content[entry["offset"]:][:entry["count"] * values.itemsize])
                arrays[entry["name"]] = values
            yield answer["snapshot"]["position_time"], arrays

    def test_two_ranks_go_where_one_goes(self):
        """Sums of forces in another order: 2⁻⁵³ of a force, and of the cell's 10 d in a place, at each of 250 steps
        are at most 3e-13 d after 10 ms. Neighbours part e-fold within some ms, so up to 30 times that: 1e-11 d."""
        compared = 0
        for (time, one), (other_time, two) in zip(self.snapshots_of(1), self.snapshots_of(2)):
            self.assertEqual((time, one.keys()), (other_time, two.keys()))
            apart = max(map(abs, map(float.__sub__, one["position"], two["position"])))
            self.assertLessEqual(apart, 1e-11 * DIAMETER, f"after {time} s")
            for force in {"contacts.normal_force", "contacts.tangential_force"} & one.keys():
                of_one, of_two = (
                    dict(zip(zip(each["contacts.i"], each["contacts.j"]), each[force])) for each in (one, two)
                )
                self.assertEqual(of_one.keys(), of_two.keys())
                largest = max(map(abs, of_one.values()))
                for pair, value in of_one.items():
                    self.assertTrue(math.isclose(value, of_two[pair], rel_tol=0, abs_tol=1e-9 * largest), pair)
            compared += 1
        self.assertEqual(6, compared)

    def ranks_of(self, running):
        return [pid for pid in running.processes() if any("rank.py" in word for word in command_line(pid)[:2])]

    def seconds_of_ranks(self, running):
        return sum(cpu_time(pid) for pid in self.ranks_of(running))

    def test_killed_rank_is_one_error_and_what_was_finished_stays(self):
        arguments = (
            "compare", COUETTE, "--engines", "lammps", "--out", self.out, "--quick", "--jobs=1", TWO, *settings(
                run__mirrors="false", preparation__packings=2, averaging__settle_rotations=0.05, averaging__rotations=0.1
            ),
        )  # fmt: skip
        running = self.start(*arguments)
        wait_for(lambda: "[1/2] lammps packing 0: " in running.stderr(), PATIENCE, "the first run")
        before = self.seconds_of_ranks(running)
        wait_for(lambda: self.seconds_of_ranks(running) > before + 0.2, PATIENCE, "ranks at work on the second")
        os.kill(self.ranks_of(running)[-1], signal.SIGKILL)
        self.assert_one_error(running.end(), ENGINE_FAILED, "lammps", "rank ", "signal 9", "and with it all ranks")
        self.assertEqual({"lammps-p0"}, set(self.finished_runs()))
        self.assertEqual([], running.processes())

    def test_ranks_end_with_who_asked_for_them(self):
        running = self.start(
            "record", COUETTE, "--engines", "lammps", "--out", self.folder / "long.rec", "--time=100000", TWO
        )
        wait_for(lambda: len(self.ranks_of(running)) == 2, PATIENCE, "two ranks")
        os.kill(running.process.pid, signal.SIGKILL)
        running.process.wait()
        wait_for(lambda: not marked_processes(running.mark), 60, "all of them to end")

    def test_cost_counts_ranks(self):
        self.held(
            "cost", COUETTE, "--quick", "--disks=1", "--engines=lammps", "--threads=1,2", "--quiet", "--out", self.out,
            "--set=cost.kinds=[]",
        )  # fmt: skip
        one, two = self.rows("scale.csv")
        self.assertEqual(("1", "ranks", "2", "ranks"), (one["workers"], one["workers_are"], two["workers"], two["workers_are"]))
        # Each pair counts once, whichever rank reports it; and each rank is a process more.
        self.assertEqual(float(one["contacts_per_step"]), float(two["contacts_per_step"]))
        self.assertGreater(float(two["memory_bytes"]), 2 * float(one["memory_bytes"]))


@unittest.skipUnless(shutil.which("liggghts"), "liggghts is not installed (./setup --engines all)")
class Liggghts(OutOfTheBox, Refuses, Peer):
    engine = "liggghts"
    refused = (
        (COUETTE, SPRING | {"law.kr": 100.0}, "here kr = 7.92225 N/m (epsd) or 267.1 N/m (epsd2), not 100 N/m"),  # 2.25 k_n µ_r²; k_t
        (COUETTE, SPRING | {"law.rolling": "constant_torque"}, 'has rolling_load = "elastic" with rolling = "constant_torque"'),
        (COUETTE, SPRING | {"law.rolling": "viscous", "law.gr": 1.0}, "has rolling = none | constant_torque | spring, not viscous"),
        (COUETTE, ADHESIVE | {"law.cohesion": "dmt"}, "has cohesion = none | area, not dmt"),
        (COUETTE, {"law.cohesion": "area", "law.kc": 1e3, "law.cohesion_area": "first_order"}, "not first_order"),
    )

    def test_is_its_law_along_a_flow_and_in_collisions(self):
        """Contacts that open and close again within a list's life are in these windows; an old spring showed as 2 % of k_n."""
        row = self.lockstep("liggghts")
        self.assertEqual("same_law", row["verdict"])
        self.assertLess(row["equivalent"], 1e-3)
        self.assertLess(row["forces"]["normal"], 1e-12)
        self.assertLess(row["forces"]["tangential"], 1e-8)
        self.assertGreater(row["kinds"]["opening"], 50)
        self.run_program(
            "collide", COLLISION, "--engines", "liggghts", "-k", "*spring*", "--out", self.out, "--quiet", "--fresh",
            *settings(collision__psi=[0.5, 3.0], collision__steps_per_contact=50),
        )  # fmt: skip
        curves = [c for variant in self.results()["variants"] for c in variant["curves"] if c["engine"] == "liggghts"]
        self.assertEqual([("finished", True)] * 4, [(curve["status"], curve["own_scheme"]["held"]) for curve in curves])

    def test_is_its_laws_of_rolling_and_cohesion(self):
        """ε_eq is to be within a thousandth; what LIGGGHTS leaves of it without these laws is 3e-7."""
        epsd = SPRING | {"law.kr_factor": 2.25, "law.rolling_dashpot": "outside", "law.rolling_damper": "critical", "law.gr": 0.1}
        area = {"law.cohesion": "area", "law.kc": 6e3}
        for law in one_of((
            {"law.rolling": "constant_torque", "law.mu_r": 0.05, "law.rolling_load": "elastic"},
            SPRING | {"law.kr_per_kt": 1.0},
            area | {"law.cohesion_area": "twice_between_disks"},
            epsd | area | {"law.cohesion_load": "net"},
        ), 3):  # fmt: skip
            with self.subTest(law=law):
                row = self.lockstep("liggghts", *self.laws(law), starts=1)
                self.assertEqual("same_law", row["verdict"])
                self.assertLess(row["equivalent"], 1e-4)

    def test_passes_its_checks(self):
        self.passes("Contact", "AcrossBorders", "CrossBorders", "Cylinder", "TurnedImpacts", "TorqueTurns", "RotatingWall",
                    "RollingFollows", "CohesionFollows", "Materials")  # fmt: skip


@unittest.skipUnless("rapier" in INSTALLED, "node, or what engines/node needs, is not installed")
class NodeEngines(Peer):
    others = ("rapier", "rapier-before", "box2d-v3")

    def test_what_a_sliding_impact_takes(self):
        """Ψ_i − Ψ_f = 3 (1 + e_n) µ by theory. The two of today bound friction by the impulse before its restitution, so
        3 µ; the older Rapier by all of it, yet it gives back less than it is told."""
        done, last = self.last_sliding("rapier,box2d-v3,rapier-before")
        self.assert_status(done, FELL_SHORT)
        taken = {name: 4.0 - float(row["psi_f"]) for name, row in last.items()}
        self.assertAlmostEqual(3 * MU, taken["rapier"], delta=1e-3)
        self.assertAlmostEqual(3 * MU, taken["box2d-v3"], delta=0.02 * 3 * MU)
        for name in ("rapier", "box2d-v3"):
            self.assertAlmostEqual(EN, float(last[name]["e_n"]), delta=1e-3)
        before = float(last["rapier-before"]["e_n"])
        self.assertLess(before, 0.75)
        self.assertAlmostEqual(3 * (1 + before) * MU, taken["rapier-before"], delta=1e-3)

    def test_tangential_restitution_is_refused_unless_it_may_differ(self):
        variant = ("check", HARD_SPHERE, "--no-timing", "--engines", "rapier", "--set=law.e_t0=0.5")
        self.assertIn("has no tangential restitution", self.run_program(*variant).stdout)
        allowed = self.run_program(*variant, '--set=run.may_differ=["integrator", "rounding", "tangential_restitution"]')
        self.assertIn("can run it", allowed.stdout)

    def test_cpu_time_is_not_that_of_the_clock(self):
        """On a busy machine the clock goes on while a worker waits."""
        recording = self.folder / "run.rec"
        self.held("record", HARD_SPHERE, "-k", "e_t0-0", "--engines", "rapier", "--out", recording, "--time=0.1")
        (stats,) = [answer["stats"] for request, answer, _ in recorded_exchanges(recording) if request["request"] == "stats"]
        self.assertGreater(stats["cpu_seconds"], 0.0)
        self.assertNotEqual(stats["cpu_seconds"], stats["wall_seconds"])

    def test_diff_tells_one_version_from_another(self):
        kept = self.folder / "before.h5"
        psi = "--set=collision.psi=[0.5, 4.0]"
        self.held("baseline", HARD_SPHERE, "--engines", "rapier-before", "--out", kept, "--quiet", psi)
        done = self.run_program("diff", kept, "--engines", "rapier", "--quiet", "--json")
        self.assert_status(done, FELL_SHORT)
        self.assertIn("psi_f", done.stdout)

    def test_contacts_are_what_acts(self):
        """Means over the time between two snapshots: what the ring's disks bear is what its contacts add up to. Of every
        version: what reads contacts is called by the engine, which is silent about what goes wrong there."""
        more = (
            "ContactForcesAreThoseThatAct", "LoadsAreThoseOfTheirContacts", "HeadOnCollision", "RotatingWallPushes",
            "WorkersAgreeBitForBit",
        )  # fmt: skip
        for engine, others in one_of((("rapier", more), ("rapier-before", ()), ("box2d-v3", more))):
            with self.subTest(engine):
                checks = ",".join(("ContactsSayWhereTheyAre", *others))
                self.held("conformance", engine, "-k", checks, "--out", self.folder / engine, "--quiet")
                self.out = self.folder / engine
                outcomes = {row["check"]: row["outcome"] for row in self.results()["checks"]}
                self.assertEqual({"passed"}, set(outcomes.values()) - {"skipped"}, outcomes)


# Four kinds of disks, and one that is light enough for the law to be overdamped, γ_n² (1/m₁ + 1/m₂) ≥ 4 k_n = 1408 N/m:
# 4592 with the next lighter one, and 180 of that with its like.
LIGHT = """
[case]
name = "light"
kind = "assembly"
extends = "{laws}/hard.toml"
[law]
gn = 0.3
[assembly]
duration = 0.1
""" + "".join(
    f"[[assembly.disks]]\nposition = [{0.01 * k}, 0.0]\nradius = 0.0037\nmass = {mass}\n"
    for k, mass in enumerate([1e-3, 1.1e-3, 1.2e-3, 1.3e-3, 2e-5])
)


def is_installed(package):
    """Whether dpkg has it; without dpkg nobody knows."""
    if not shutil.which("dpkg-query"):
        return False
    command = ["dpkg-query", "--show", "--showformat=${Status}", package]
    return subprocess.run(command, capture_output=True, check=False).stdout == b"install ok installed"


# Checks of scenes of space alone, of those that engines of both dimensions are asked twice, and of periodic scenes.
OF_SPACE = {
    "TorqueTurnsSpheres", "TurnedImpactsAreTurnedAlike", "CylinderIsMetAsAPlane", "TurningCylinderDrivesSpheres",
    "SpinsAboutTheLineChangeNothing",
}  # fmt: skip
TWICE = {
    f"{check}InSpace" for check in (
        "FallsFreely", "ForcesAreThoseOfTheLaw", "ContactForcesAreThoseThatAct", "RotatingWallPushes",
        "WallLoadsAreThoseOfTheirContacts", "PlaneLoadsAreThoseOfTheirContacts",
    )
}  # fmt: skip
PERIODIC = {f"{check}{where}" for check in ("PairsAcrossBorders", "PairsThatCrossBorders", "WallsAcrossBorders") for where in ("", "InSpace")}
# Checks of stiffness, springs, slow overlaps and mirrors.
OF_SOFT_LAWS = {
    "ConventionsAreThoseDeclared", "CornersHaveNoFirstPlane", "FastDisksAreNotMissed", "FastIsAsSlow", "FollowsItsMirror",
    "FollowsItsMirrorRolling", "MemoriesHoldWhileAnotherFliesBy", "RollingSpringsOfMovedPairs", "SeveralActAtOnce", "SlowIsNotAtRest",
    "SpringsHoldWhileAnotherFalls", "SpringsOfMovedPairs", "WallsUnderWayAct",
}  # fmt: skip


def skipped_by_rigid(can):
    """Checks that an engine of rigid contacts skips, by its capabilities: no more, so that coverage does not shrink unseen."""
    lacks = {effect for effect, support in can["effects"].items() if support == "never"}
    rows = (
        (True, OF_SOFT_LAWS),
        (3 not in can.get("dimensions", [2]), OF_SPACE | TWICE),
        (not can.get("periodic"), PERIODIC),
        ("bottom_friction" in lacks, {"BottomPlateBrakesADisk", "BottomPlateHoldsASlowDisk", "PlateBrakesEachByItself"}),
        ("cohesion" in lacks, {"CohesionFollowsItsClosedForms"}),
        ("pair_materials" in lacks, {"MaterialsHaveTheirOwnLaws"}),
        ("rolling_resistance" in lacks, {"RollingFollowsItsClosedForms"}),
        # A constant torque of rigid spheres is none in space.
        ("spring" not in can["law_options"].get("rolling", []), {"RollingFollowsItsClosedFormsInSpace", "RollingHoldsASlope"}),
        (not can["checkpoints"], {"CheckpointsGoOnToTheBit"}),
        (not can["energy_ledger"], {"EnergyLedgerIsClosed"}),
        (not can["sliding_flags"], {"SlidingFlagsMarkTheBound"}),
        (not can["tangential_restitution"], {"e_t0-0.5"}),
        ("radial" not in can.get("wall_motions", ["radial"]), {"ShrinkingWallPushes"}),
        ("rotating" not in can.get("plane_motions", ["rotating"]), {"TurningPlanePushes"}),
    )
    return set().union(*(checks for applies, checks in rows if applies))


# Of rigid engines by day: motion, impacts and loads, which are each engine's own; all of the suite at night.
CHOSEN = (
    "AdvancesByWhole", "StartIs", "LookingChanges", "LoadingStarts", "FallsFreely", "FrictionFollows", "PlanesFollow", "WallDisksFollow",
    "UnequalDisks", "WallPushes", "PlanePushes", "WallsSpin", "ForcesAreThose", "LoadsAreThose", "FarIsAsNear", "TurnedImpacts", "Cylinder",
    "EngineRefuses", "UnknownSettings",
)  # fmt: skip


class RigidEngine:
    failed = set()  # by what the engine does otherwise

    def test_passes_its_checks(self):
        words = () if AT_NIGHT else ("-k", ",".join(CHOSEN))
        done = self.run_program("conformance", self.engine, "--quiet", "--json", *words)
        self.assert_status(done, FELL_SHORT if self.failed else HELD)
        checks = json.loads(done.stdout)["checks"]
        of = {outcome: {check["check"] for check in checks if check["outcome"] == outcome} for outcome in ("skipped", "failed", "passed")}
        self.assertEqual(skipped_by_rigid(INSTALLED[self.engine]) & {check["check"] for check in checks}, of["skipped"])
        self.assertEqual(self.failed, of["failed"])
        self.assertLess(40 if AT_NIGHT else 15, len(of["passed"]))

    def test_friction_is_bounded_by_the_whole_impulse(self):
        """Ψ_i − Ψ_f = 3 (1 + e_n) µ of an impact that slides, by theory; the normal turns by up to 5e-4 in a step."""
        done, last = self.last_sliding(self.engine)
        self.assert_status(done, HELD)
        row = last[self.engine]
        self.assertAlmostEqual(EN, float(row["e_n"]), delta=1e-3)
        self.assertAlmostEqual(3 * (1 + EN) * MU, 4.0 - float(row["psi_f"]), delta=1e-3)

    def test_a_soft_law_that_it_stands_for_is_a_model_difference(self):
        """Its law is Walton's with the e_n that it reports and e_t0 = 0, which it meets, whatever it calls its pairs."""
        self.held("collide", COLLISION, "--engines", self.engine, "-k", "viscous-cut", "--out", self.out, "--quiet")
        (curve,) = self.results()["variants"][0]["curves"]
        self.assertEqual(("oracle", "rigid"), (curve["declared"]["reference"], curve["declared"]["law"]["normal"]))
        self.assertTrue(curve["declared"]["score"]["psi_f"]["held"])

    def test_disks_that_fall_on_planes(self):
        """It keeps no ledger, but every snapshot is audited: an impact worked out from the velocities before the last one
        was a force across a gap."""
        self.run_program(
            "stability", CASES / "hard", "--quick", "-k", "ledger*", "--engines", self.engine, "--out", self.out,
            "--quiet", f"--set=engines.{self.engine}.dt=5e-4",
        )  # fmt: skip
        (run,) = self.results()["runs"]
        self.assertEqual(("refused", "does not show what the measure takes"), (run["verdict"], run["reason"]))


class InSpace:
    """An engine of rigid contacts that has spheres in space as well."""

    def impacts(self, *arguments, case="spheres-rigid"):
        """Status and verdict of each sweep."""
        done = self.run_program(
            "collide", CASES / f"space/{case}.toml", "--engines", self.engine, "--out", self.out, "--quiet", "--fresh", *arguments
        )
        (curves,) = zip(*(variant["curves"] for variant in self.results()["variants"]))
        return done, curves

    def test_impacts_in_space_are_waltons_along_their_slip(self):
        for case, sweeps in one_of((("spheres-rigid", 5), ("chung-ooi-rigid", 6))):
            with self.subTest(case):
                done, curves = self.impacts(case=case)
                self.assert_status(done, HELD)
                self.assertEqual(["held"] * sweeps, [curve["score"]["verdict"] for curve in curves])


def worker_of(engine):
    return pathlib.Path(PROGRAM).with_name(f"crossgrain-{engine}")


def where_it_can_be_built(peer):
    """An engine whose worker is built with the program, where its package is installed."""
    package = f"lib{peer.engine}-dev"
    return unittest.skipUnless(worker_of(peer.engine).exists() or is_installed(package), f"{package} is not installed")(peer)


class BuiltEngine:
    def test_was_built(self):
        self.assertTrue(worker_of(self.engine).exists(), f"lib{self.engine}-dev is installed, and the build did not find it")


class ResistsRolling(BuiltEngine, RigidEngine):
    def head_on(self, **of_engine):
        """e_n of two disks that meet at 0.01 m/s without slip; 0 where they do not part."""
        changes = settings(collision__psi=[0.0]) + [f"--set=engines.{self.engine}.{name}={value}" for name, value in of_engine.items()]
        self.run_program(
            "collide", HARD_SPHERE, "--engines", self.engine, "-k", "*e_t0-0", "--out", self.out, "--quiet", "--fresh", *changes
        )
        return float(self.rows("collisions.csv")[0]["e_n"] or 0)

    def test_slow_approaches_give_nothing_back_below_its_threshold(self):
        self.assertAlmostEqual(EN, self.head_on(restitution_threshold=0.009), delta=1e-8)
        self.assertLessEqual(self.head_on(restitution_threshold=0.011), 0.2)  # what pushes overlaps apart

    def test_its_rolling_friction_is_a_constant_torque(self):
        """A disk rolls to rest within (1 + q) v²/(2 µ_r g); a step of 0.5 ms errs by half of what it goes in one, 25 µm."""
        lacking = "normal tangential_spring tangential_damping tension dashpot spring_reset spring_update coulomb_bound"
        may = lacking.split() + ["lever_arm", "velocity_arm", "plane_arm", "damping_velocity", "integrator", "rolling_length"]
        self.held(
            "compare", CASES / "assembly/rolling/constant-torque.toml", "--engines", f"{self.engine},grain", "--quiet", "--out", self.out,
            *settings(run__may_differ=may),
        )  # fmt: skip
        rows = [row for row in self.rows("endpoints.csv") if (row["kind"], row["b"]) == ("closed_form", self.engine)]
        error = {row["endpoint"]: abs(float(row["difference"])) for row in rows}
        self.assertEqual({"speed", "distance", "rest"}, set(error))
        self.assertLess(error["distance"], 26e-6)
        self.assertLess(error["rest"], 1e-12)

    def stability(self, case, variant=None, **of_engine):
        """Verdict and value of a quick case, or of that of its quick variants."""
        changes = [f"--set=engines.{self.engine}.{name}={value}" for name, value in of_engine.items()]
        self.run_program(
            "stability", CASES / f"hard/{case}.toml", "--quick", "--engines", self.engine, "--out", self.out, "--quiet", "--fresh",
            *(["-k", f"*{variant}"] if variant else []), *changes,
        )  # fmt: skip
        (run,) = self.results()["runs"]
        return run["verdict"], run["value"]


@where_it_can_be_built
class Bullet(ResistsRolling, InSpace, Peer):
    engine = "bullet"

    @at_night
    def test_overlaps_are_pushed_apart_without_speed(self):
        """An elastic start with deep overlaps; Bullet's own threshold would add a fifth of the overlap each step to the
        velocities. What a stack gains is height: with nothing pushed, nothing."""
        self.assertEqual("stable", self.stability("deep-start", "elastic")[0])
        self.assertEqual("stable", self.stability("warm-start", "gain", erp=0.0)[0])

    @at_night
    def test_more_passes_make_up_for_the_missing_warm_start(self):
        self.assertLess(0.05, self.stability("newtons-cradle")[1])
        self.assertEqual("stable", self.stability("newtons-cradle", iterations=50)[0])


@where_it_can_be_built
class Ode(ResistsRolling, InSpace, Refuses, Peer):
    engine = "ode"
    # Its rows against rolling bring spins to rest, not to a wall's.
    refused = ((COUETTE, {"law.rolling": "constant_torque", "law.mu_r": 0.05}, "no rolling on walls that turn"),)

    def test_its_own_directions_of_friction_are_a_pyramid(self):
        """By the normal alone, each bounded by itself: off by up to (√2 − 1) K (1 + e_n) µ = 0.83 in some direction."""
        done, curves = self.impacts("--set=engines.ode.friction_along_slip=0")
        self.assert_status(done, FELL_SHORT)
        self.assertEqual({"fell short"}, {curve["score"]["verdict"] for curve in curves})
        self.assertLess(0.3, max(curve["score"]["psi_f"]["max"] * curve["score"]["psi_f"]["unit"] for curve in curves))
        file = (HOME / "engines/ode/ode.toml").read_text(encoding="utf-8").replace('"ode"', '"ode-own"')
        own = self.write("ode-own.toml", file + "\n[settings]\nfriction_along_slip = 0\n")
        done = self.run_program("conformance", own, "-k", "TurnedImpacts", "--quiet")
        self.assert_status(done, FELL_SHORT)
        self.assertIn("a pyramid in place of Coulomb's cone", done.stdout)

    @at_night
    def test_direct_solver_holds_what_relaxation_does_not(self):
        """A disk of a hundredth of the mass between two heavy ones; rest under a load that oscillates."""
        self.assertEqual("unstable", self.stability("mass-ratio")[0])
        self.assertEqual("stable", self.stability("mass-ratio", iterations=0)[0])
        self.assertEqual("stable", self.stability("column-heat", iterations=0)[0])

    @at_night
    def test_what_pushes_overlaps_apart_stays_as_speed(self):
        self.assertLess(100, self.stability("warm-start", "gain")[1])
        self.assertGreater(1, self.stability("warm-start", "gain", correcting_speed=0.01)[1])
        self.assertEqual("stable", self.stability("warm-start", "gain", erp=0.0)[0])


@where_it_can_be_built
class Chipmunk(BuiltEngine, RigidEngine, Peer):
    engine = "chipmunk"

    def test_overdamped_pair_is_refused_before_the_first_step(self):
        """Not by an exception through Chipmunk's C, when two such disks meet. The table of pairs ends before the fifth."""
        case = self.write("light.toml", LIGHT.replace("{laws}", str(CASES / "laws")))
        done = self.run_program("check", case, "--engines", "chipmunk", "--set=run.may_differ=['normal']")
        self.assert_status(done, BAD_INPUT)
        self.assertRegex(done.stdout, "chipmunk +cannot: .*overdamped")


@unittest.skipUnless("jolt" in INSTALLED, "node, or what engines/node needs, is not installed")
class Jolt(RigidEngine, InSpace, Peer):
    engine = "jolt"
    others = ("jolt-before",)

    def test_a_scene_leaves_nothing_behind_in_its_heap(self):
        """Of 128 MB; what was left split it, and after some hundred scenes there was no room for another."""
        script = """
            const {JoltWorld} = await import(process.argv[1]);
            const {RigidLaw} = await import(process.argv[2]);
            const disks = [{position: [0, 0], velocity: [0, 0], spin: 0, radius: 0.0037, mass: 0.275e-3, inertia: 1.9e-9}];
            const law = new RigidLaw({normal: "rigid", en: 0.5, et0: 0, mu: 0.44});
            const scene = {disks, bodies: [], law, gravity: [0, 0], dt: 5e-4, rotation: true, number: () => 10};
            const free = [];
            for (let load = 0; load < 20; ++load) {
              const world = new JoltWorld(scene);
              world.step();
              world.impulses(() => {});
              free.push(world.jolt.sGetFreeMemory());
              world.free();
            }
            console.log(free[1] - free[19]);
        """
        modules = [str(HOME / "engines" / name) for name in ("jolt/world.mjs", "node/rigid_law.mjs")]
        command = ["node", "--input-type=module", "--eval", script, *modules]
        done = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
        self.assertEqual(("0\n", ""), (done.stdout, done.stderr))

    def test_older_version_turns_walls_at_a_wrong_speed(self):
        """Jolt 5.5 takes a step's small angle from the arc cosine of a number near 1 (JoltPhysics#1893)."""
        done = self.run_program("conformance", "jolt-before", "-k", "TurningPlanePushes", "--quiet")
        self.assert_status(done, FELL_SHORT)
        self.held("conformance", "jolt-before", "-k", "PlaneLoadsAreThoseOfTheirContacts", "--quiet")

    def test_speculative_contacts_push_across_gaps(self):
        """As Jolt has them, up to a distance: disks that never touched part, which the audit refuses."""
        done = self.run_program(
            "collide", HARD_SPHERE, "--engines", "jolt", "-k", "*e_t0-0", "--out", self.out, "--quiet",
            "--set=engines.jolt.speculative_distance=1e-3",
        )  # fmt: skip
        self.assert_status(done, ENGINE_FAILED)
        self.assertRegex(done.stderr, "a force of .* passes a gap")


@unittest.skipUnless("havok" in INSTALLED, "node, or what engines/node needs, is not installed")
class Havok(Peer):
    engine = "havok"

    def test_what_a_sliding_impact_takes(self):
        """Of Ψ_i − Ψ_f = (1 + 2) (1 + e_n) µ the part of velocities, 1, has 5/8 of what friction does in the step that sends the
        disks back. e_n has eight digits."""
        done, last = self.last_sliding(self.engine)
        self.assert_status(done, FELL_SHORT)
        en = float(last[self.engine]["e_n"])
        self.assertAlmostEqual(EN, en, delta=EN / 128)
        share = (4.0 - float(last[self.engine]["psi_f"])) / ((1 + en) * MU)
        self.assertLess(2 + 5 / 8, share)
        self.assertLess(share, 2.99)

    def test_dense_disks_keep_to_their_plane(self):
        """With a gravity of 10⁻⁹ across it they left it within some hundred steps."""
        self.held("record", COUETTE, "--engines", self.engine, "--out", self.folder / "run.rec", "--time=1.5")

    def test_passes_its_checks(self):
        self.passes("AdvancesByWhole", "StartIs", "LoadingStarts", "FallsFreely", "TurnedImpacts", "WallPushes", "PlanePushes",
                    "ComesFromAfar", "CylinderIsMet", "EngineRefuses", "UnknownSettings")  # fmt: skip


@unittest.skipUnless("physx" in INSTALLED, "node, or what engines/node needs, is not installed")
class Physx(RigidEngine, InSpace, Peer):
    engine = "physx"
    failed = {"WallsSpinIsFelt"}  # contacts' points lie on one body's surface

    def test_impacts_in_space_are_waltons_along_their_slip(self):
        """With pgs, friction of two axes, each bounded by itself: up to √2 K (1 + e_n) µ of what slides; with tgs, of a cone."""
        taken = {}
        for solver in ("pgs", "tgs"):
            done, curves = self.impacts("-k", "*any-slip*", f'--set=engines.physx.solver="{solver}"')
            self.assert_status(done, FELL_SHORT)
            slid = [row for row in self.rows("collisions.csv") if row["engine"] == self.engine and abs(float(row["psi_i"])) > 3]
            taken[solver] = [
                (math.hypot(float(row["psi_i"]), 1.5) - math.hypot(float(row["psi_f"]), float(row["psi_f_out"]))) / (3.5 * 1.9 * 0.3)
                for row in slid
            ]
            if solver == "pgs":
                self.assertTrue(all(curve["score"]["e_n"]["held"] for curve in curves))
        self.assertLess(0.99, min(taken["pgs"]))
        self.assertLess(1.1, max(taken["pgs"]))
        self.assertLess(max(taken["pgs"]), math.sqrt(2) + 0.01)
        for share in taken["tgs"]:
            self.assertAlmostEqual(1.0, share, delta=0.01)


@unittest.skipUnless("rapier3d" in INSTALLED, "node, or what engines/node needs, is not installed")
class Rapier3d(InSpace, Peer):
    engine = "rapier3d"

    def test_impacts_in_space_are_waltons_along_their_slip(self):
        """But for friction, which is bounded by µ times the impulse that stops the approach, as in the plane: K e_n µ = 0.945 of Ψ_f
        are missing where it slides. To a hundredth: contacts act from a gap of 0.004 a on, with arms that are longer by half of it, and n turns
        in that time."""
        done, curves = self.impacts("-k", "*any-slip*")
        self.assert_status(done, FELL_SHORT)
        for curve in curves:
            self.assertTrue(curve["score"]["e_n"]["held"])
        slid = [row for row in self.rows("collisions.csv") if row["engine"] == self.engine and abs(float(row["psi_i"])) > 3]
        for row in slid:
            before = math.hypot(float(row["psi_i"]), 1.5)
            after = math.hypot(float(row["psi_f"]), float(row["psi_f_out"]))
            self.assertAlmostEqual(3.5 * 0.3, before - after, delta=0.01 * 3.5 * 0.3)
        self.assertLess(20, len(slid))

    def test_passes_its_checks(self):
        self.passes("TurnedImpacts", "Cylinder")


@unittest.skipUnless(importlib.util.find_spec("siconos"), "python3-siconos is not installed")
class Siconos(RigidEngine, Peer):
    engine = "siconos"


def projected_impact(psi, law, vn=0.01, a=3.7e-3, m=0.275e-3, q=0.5, dt=1e-6):
    """Two equal disks with equal spins, whose contact force is the point of Coulomb's cone that is nearest to
    (X, Y) = (k_n δ − γ_n δ̇', γ_t |v_t|) in the metric (1/γ_n, 1/γ_t): engines/mujoco/README.md.
    @returns e_n, Ψ_f"""
    kn, gn, gt, mu = law
    (rx, ry), (vx, vy), spin = (2 * a, 0.0), (-vn, 0.0), -psi * vn / (2 * a)
    while True:
        apart = math.hypot(rx, ry)
        nx, ny, overlap = rx / apart, ry / apart, 2 * a - apart
        arm, rate = a - overlap / 2, vx * nx + vy * ny
        slip = vy * nx - vx * ny - 2 * arm * spin
        if overlap < 0:
            return rate / vn, slip / vn
        x, y = kn * overlap - gn * rate, gt * abs(slip)
        if y <= mu * x:
            fn, ft = x, y
        elif x <= -mu * y * gn / gt:
            fn = ft = 0.0
        else:
            fn = (x + mu * gn * abs(slip)) / (1 + mu**2 * gn / gt)
            ft = mu * fn
        ft = -math.copysign(ft, slip)
        vx, vy = vx + 2 * dt * (fn * nx - ft * ny) / m, vy + 2 * dt * (fn * ny + ft * nx) / m
        spin -= dt * arm * ft / (q * m * a**2)
        rx, ry = rx + dt * vx, ry + dt * vy


@where_it_can_be_built
class Mujoco(BuiltEngine, Refuses, Peer):
    engine = "mujoco"
    FRICTIONLESS = settings(law__tangential="none", law__mu=0.0, law__kt=0.0, law__gt=0.0)
    refused = (
        (HARD_SPHERE, {}, "has normal = linear, not rigid"),
        (CASES / "couette/nu-0.804.toml", {}, "GB for so many disks"),
        (COLLISION, {"law.tangential": "viscous", "law.kt": 0.0, "law.gn": 0.0}, "both must be > 0"),
    )

    def test_without_friction_it_is_the_law_that_it_declares_to_its_impedance(self):
        """d is the part of what others do to a pair that a contact works against: ε_eq was 0.9 d at 10⁻⁴ and 10⁻²; by 2
        either way for other starts."""
        row = self.lockstep("mujoco", *self.FRICTIONLESS, "--set=engines.mujoco.impedance=4e-4")
        self.assertEqual("same_law", row["verdict"])
        self.assertLess(2e-4, row["equivalent"])
        self.assertLess(row["equivalent"], 8e-4)

    def test_sliding_impacts_are_the_projection_on_the_cone(self):
        """At t_c/2000 schemes of first order err by 1/2000 of what a contact changes, 1e-3 of e_n and Ψ_f; the law as it
        is declared, whose e_n does not depend on slip, is 0.2 off."""
        psi = [0.5, 2.0, 4.0]
        done = self.run_program(
            "collide", COLLISION, "--engines", "mujoco", "--out", self.out, "--quiet", "-k", "viscous-cut",
            *settings(collision__psi=psi, collision__steps_per_contact=2000),
        )  # fmt: skip
        self.assert_status(done, FELL_SHORT)
        rows = [row for row in self.rows("collisions.csv") if row["engine"] == "mujoco"]
        self.assertEqual(psi, [float(row["psi_i"]) for row in rows])
        for row in rows:
            en, psi_f = projected_impact(float(row["psi_i"]), (352.1, 0.19, 0.15, MU))
            self.assertAlmostEqual(en, float(row["e_n"]), delta=1e-3)
            self.assertAlmostEqual(psi_f, float(row["psi_f"]), delta=1e-3)
        self.assertGreater(float(rows[-1]["e_n"]), 0.5)

    def test_passes_its_checks(self):
        """All those in which no contact slides, and of contacts that do, that the forces shown are those that act."""
        self.passes("ContactForcesAreThoseThatAct", "WallLoadsAreThoseOfTheirContacts", "LoadingStartsAfresh", "Head")


@unittest.skipUnless({"mujoco", "mujoco3"} <= set(INSTALLED), "mujoco, node, or what engines/node needs, is not installed")
class Mujoco3(Refuses, Peer):
    engine = "mujoco3"
    refused = Mujoco.refused[::2] if "mujoco" in INSTALLED else ()  # its matrices are not dense

    def test_collisions_are_those_of_the_older_version_to_rounding(self):
        kept = self.folder / "mujoco.baseline"
        self.held("baseline", COLLISION, "--engines", "mujoco", "--quick", "--quiet", "--out", kept)
        done = self.run_program("diff", kept, "--engines", "mujoco3", "--quiet")
        self.assert_status(done, HELD)
        self.assertIn("mujoco3: same to rounding", done.stdout)

    def test_boxes_on_boxes_are_not(self):
        """Where two boxes touch, what one of them reaches over the other is no longer the same points."""
        law = settings(law__normal="linear", law__kn=1e5, law__gn=600.0, law__tangential="viscous", law__gt=600.0, law__tension="cut")
        self.held(
            "compare", CASES / "convex/overhang-stands.toml", "--engines", "mujoco,mujoco3", "--out", self.out, "--quiet", "--no-causes",
            *law, "--set=run.dt=1e-4",
        )  # fmt: skip
        tops = {row["b"]: float(row["difference"]) for row in self.rows("endpoints.csv") if row["kind"] == "closed_form"}
        self.assertGreater(abs(tops["mujoco"] - tops["mujoco3"]), 1e-5)

    def test_passes_its_checks(self):
        """Walls that move for a second, thousands of disks, and that forces shown are those that act."""
        self.passes("ContactForcesAreThoseThatAct", "OscillatingWallPushes", "ManyAreAsFew", "LoadingStartsAfresh")


# Engines of rigid contacts without a class of their own.
NAMED = {name for peer in Peer.__subclasses__() for name in (getattr(peer, "engine", None), *getattr(peer, "others", ()))}
for name in sorted({file.stem for file in HOME.glob("engines/*/*.toml")} & set(INSTALLED) - NAMED):
    if INSTALLED[name]["law_options"].get("normal") == ["rigid"]:
        parts = (RigidEngine, InSpace, Peer) if 3 in INSTALLED[name].get("dimensions", [2]) else (RigidEngine, Peer)
        globals()[name] = type(name, parts, {"engine": name})


class Absent(SystemTest):
    def test_engine_without_its_packages_is_refused_with_what_to_install(self):
        data = self.folder / "data"
        for name in ("rapier", "node", "siconos"):
            shutil.copytree(HOME / "engines" / name, data / "engines" / name, ignore=shutil.ignore_patterns("node_modules"))
        (data / "cases").symlink_to(CASES)
        file = data / "engines/siconos/siconos.toml"
        file.write_text(file.read_text(encoding="utf-8").replace("/usr/lib/", "/usr/no/"), encoding="utf-8")
        alone = self.folder / "crossgrain"  # without workers beside it, or installed ones in PATH
        shutil.copy(PROGRAM, alone)
        for engine, package, options in (
            ("rapier", "npm ci", {"env": {"CROSSGRAIN_DATA": str(data)}}),
            ("siconos", "python3-siconos", {"env": {"CROSSGRAIN_DATA": str(data)}}),
            *((name, f"lib{name}-dev", {
                "executable": str(alone), "env": {"CROSSGRAIN_DATA": str(HOME), "PATH": str(self.folder)},
            }) for name in ("bullet", "chipmunk", "mujoco", "ode")),
        ):  # fmt: skip
            done = self.run_program("check", HARD_SPHERE, "--engines", engine, **options)
            self.assert_one_line(done, BAD_INPUT, f"{engine} is not available", package)


if __name__ == "__main__":
    unittest.main()
