"""LAMMPS, where it is installed: what its worker makes of scenes, held against its mirror."""

import array
import csv
import json
import math
import os
import pathlib
import shutil
import signal
import tempfile
import unittest

from harness import (
    BAD_INPUT,
    COUETTE,
    ENGINE_FAILED,
    HELD,
    PATIENCE,
    SystemTest,
    command_line,
    cpu_time,
    marked_processes,
    recorded_exchanges,
    wait_for,
)

CASES = COUETTE.parents[1]


@unittest.skipUnless(shutil.which("lmp"), "LAMMPS is not installed (Debian: package lammps)")
class Lammps(SystemTest):
    def test_it_is_the_law_that_it_declares(self):
        """Same to rounding: the law, its conventions, the wheel's motion, and forces read back from pairs."""
        done = self.run_program(
            "lockstep", COUETTE, "--engines", "lammps", "--out", self.out, "--quick", "--quiet", "--starts=2"
        )
        self.assert_status(done, HELD)
        row = self.results()["lockstep"]["rows"][0]
        self.assertEqual("same_to_rounding", row["verdict"])
        self.assertGreater(row["kinds"]["wall"], 0)
        self.assertLess(row["forces"]["normal"], 1e-12)
        self.assertLess(row["forces"]["tangential"], 1e-12)

    def test_its_conventions_are_found_from_outside(self):
        """Arms of f_t and of v_t that differ: neither alone brings a mirror nearer, the two together do."""
        done = self.run_program("identify", COUETTE, "--engines", "lammps", "--quiet")
        self.assert_status(done, HELD)
        for option, value in (
            ("lever_arm", "overlap_middle"), ("velocity_arm", "radius"), ("coulomb_bound", "magnitude"),
            ("spring_reset", "spring_only"), ("spring_update", "before"), ("damping_velocity", "lagged"),
        ):  # fmt: skip
            self.assertRegex(done.stdout, rf"(?m)^{option} +{value} +declares {value}$")
        self.assertIn("does not simulate bottom_friction", done.stdout)

    def test_collisions(self):
        """What it lacks of the scene's law is a model difference; to its own law it holds."""
        done = self.run_program(
            "collide", CASES / "collision" / "figure-4-3.toml", "--engines", "lammps", "--out", self.out, "--quiet",
            "--set=collision.psi=[0.1, 1.0, 4.0]",
        )  # fmt: skip
        with open(self.out / "collisions.csv", encoding="utf-8", newline="") as file:
            own = [row for row in csv.DictReader(file) if row["engine"] == "lammps"]
        judged = {row["verdict_declared"] for row in own if row["outcome"] != "refused"}
        self.assertEqual({"held"}, judged)
        refused = {row["variant"] for row in own if row["outcome"] == "refused"}
        self.assertIn("coulomb", " ".join(refused))
        self.assertEqual("", done.stderr)

    def test_planes_and_gravity(self):
        """A pile on planes: forces of disks and planes come from two parts of LAMMPS."""
        done = self.run_program(
            "stability", CASES / "hard" / "pile.toml", "--engines", "lammps", "--out", self.out, "--quick", "--quiet"
        )
        self.assert_status(done, HELD)

    def test_hertz(self):
        """Mindlin's spring as displacement and as force, critical dashpots, at disks of walls too: same to rounding."""
        for history in ("displacement", "force"):
            with self.subTest(history):
                out = self.folder / history
                done = self.run_program(
                    "lockstep", CASES / "cost" / "hertz.toml", "--engines", "lammps", "--out", out, "--quick",
                    "--quiet", "--starts=2", f"--set=law.history={history}",
                )  # fmt: skip
                self.assert_status(done, HELD)
                row = json.loads((out / "results.json").read_text())["lockstep"]["rows"][0]
                self.assertEqual("same_to_rounding", row["verdict"])
                self.assertGreater(row["kinds"]["wall"], 0)
                self.assertLess(row["forces"]["tangential"], 1e-12)

    def test_what_it_cannot_do_is_refused_by_name(self):
        for file, changes, reason in (
            ("measured-disk", [], "has normal = linear | hertz, not polynomial"),
            ("chung-ooi-1", ["law.damper=viscoelastic", "law.gn=1e-6"], "has damper = constant | critical, not"),
            ("chung-ooi-1", ["law.gn=1.2"], "between 0.0003 and 1.27, not 1.47"),  # 1.2 √1.5
        ):
            with self.subTest(reason):
                done = self.run_program(
                    "collide", CASES / "collision" / f"{file}.toml", "--engines", "lammps", "--quiet",
                    "--out", self.folder / "refused", "--fresh", *(f"--set={change}" for change in changes),
                )  # fmt: skip
                self.assert_status(done, BAD_INPUT)
                self.assertIn(reason, done.stderr)


TWO = "--set=engines.lammps.ranks=2"
DIAMETER = 2 * 3.7e-3  # m, of a small disk of the quick cell


@unittest.skipUnless(shutil.which("lmp"), "LAMMPS is not installed (Debian: package lammps)")
@unittest.skipUnless(shutil.which("mpirun"), "there is no mpirun (Debian: package openmpi-bin)")
class Ranks(SystemTest):
    def test_two_are_the_law_that_one_is(self):
        done = self.run_program(
            "lockstep", COUETTE, "--engines", "lammps", "--out", self.out, "--quick", "--quiet", "--starts=2", TWO
        )
        self.assert_status(done, HELD)
        row = self.results()["lockstep"]["rows"][0]
        self.assertEqual("same_to_rounding", row["verdict"])
        self.assertLess(row["forces"]["normal"], 1e-12)
        self.assertLess(row["forces"]["tangential"], 1e-12)

    def looks_of(self, ranks):
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
                kind = {"f64": "d", "i32": "i", "u8": "B"}[entry["type"]]
                values = array.array(kind)
                values.frombytes(content[entry["offset"]:][:entry["count"] * values.itemsize])
                arrays[entry["name"]] = values
            yield answer["snapshot"]["position_time"], arrays

    def test_two_go_where_one_goes(self):
        """Sums of forces in another order: 2⁻⁵³ of a force, and of the cell's 10 d in a place, at each of 250 steps
        are at most 3e-13 d after 10 ms. Neighbours part e-fold within some ms, so up to 30 times that: 1e-11 d."""
        bound = 1e-11
        compared = 0
        for (time, one), (other_time, two) in zip(self.looks_of(1), self.looks_of(2)):
            self.assertEqual(time, other_time)
            self.assertEqual(one.keys(), two.keys())
            apart = max(map(abs, map(float.__sub__, one["position"], two["position"])))
            self.assertLessEqual(apart, bound * DIAMETER, f"after {time} s")
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

    def test_planes_and_gravity_on_two(self):
        done = self.run_program(
            "stability", CASES / "hard" / "pile.toml", "--engines", "lammps", "--out", self.out, "--quick", "--quiet", TWO
        )
        self.assert_status(done, HELD)

    def ranks_of(self, running):
        return [pid for pid in running.processes() if any("rank.py" in word for word in command_line(pid)[:2])]

    def seconds_of_ranks(self, running):
        return sum(cpu_time(pid) for pid in self.ranks_of(running))

    def test_a_killed_rank_is_one_error_and_what_was_finished_stays(self):
        arguments = (
            "compare", COUETTE, "--engines", "lammps", "--out", self.out, "--quick", "--set=run.mirrors=false",
            "--set=preparation.packings=2", "--set=averaging.settle_rotations=0.05", "--set=averaging.rotations=0.15", "--jobs=1", TWO,
        )  # fmt: skip
        running = self.start(*arguments)
        wait_for(lambda: "[1/2] lammps packing 0: " in running.stderr(), PATIENCE, "the first run")
        before = self.seconds_of_ranks(running)
        wait_for(lambda: self.seconds_of_ranks(running) > before + 0.2, PATIENCE, "ranks at work on the second")
        os.kill(self.ranks_of(running)[-1], signal.SIGKILL)
        done = running.end()
        self.assert_one_error(done, ENGINE_FAILED, "lammps", "rank ", "signal 9", "and with it all ranks")
        self.assertEqual({"lammps-p0"}, set(self.finished_runs()))
        self.assertEqual([], running.processes())
        before = self.finished_runs()
        again = self.run_program(*arguments)
        self.assertIn("finished in an earlier run", again.stderr)
        self.assertEqual({"lammps-p0", "lammps-p1"}, set(self.finished_runs()))
        self.assertEqual(before["lammps-p0"], self.finished_runs()["lammps-p0"])

    def test_ranks_end_with_who_asked_for_them(self):
        running = self.start(
            "record", COUETTE, "--engines", "lammps", "--out", self.folder / "long.rec", "--time=100000", TWO
        )
        wait_for(lambda: len(self.ranks_of(running)) == 2, PATIENCE, "two ranks")
        os.kill(running.process.pid, signal.SIGKILL)
        running.process.wait()
        wait_for(lambda: not marked_processes(running.mark), 60, "all of them to end")

    def test_scale_counts_ranks(self):
        done = self.run_program(
            "scale", "--disks=1000", "--steps=20", "--repetitions=1", "--engines=lammps", "--threads=1,2", "--quiet",
            "--out", self.out,
        )  # fmt: skip
        self.assert_status(done, HELD)
        with open(self.out / "scale.csv", encoding="utf-8", newline="") as file:
            one, two = csv.DictReader(file)
        self.assertEqual(("1", "ranks", "2", "ranks"), (
            one["workers"], one["workers_are"], two["workers"], two["workers_are"]
        ))  # fmt: skip
        # Each pair counts once, whichever rank tells of it; and each rank is a process more.
        self.assertEqual(float(one["contacts_per_step"]), float(two["contacts_per_step"]))
        self.assertGreater(float(two["memory_bytes"]), 2 * float(one["memory_bytes"]))

    def test_counts_that_are_none(self):
        for ranks in ("1.5", "0", "2000"):
            with self.subTest(ranks):
                done = self.compare(f"--set=engines.lammps.ranks={ranks}", "--quiet", engines="lammps")
                self.assert_one_error(done, BAD_INPUT, "whole number from 1 to 1024", ranks)

    def test_without_mpirun_its_package_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            for program in pathlib.Path("/usr/bin").iterdir():
                if not program.name.startswith("mpi"):
                    (pathlib.Path(folder) / program.name).symlink_to(program)
            done = self.compare(TWO, "--quiet", engines="lammps", env={"PATH": folder})
        self.assert_one_error(done, BAD_INPUT, "ranks = 2", "mpirun", "openmpi-bin")


if __name__ == "__main__":
    unittest.main()
