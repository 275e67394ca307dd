"""crossgrain thesis runs a sweep of cases, keeps what is finished, goes on to the bit, and judges."""

import csv
import json
import os
import pathlib
import signal
import unittest

from harness import BAD_INPUT, ENGINE_FAILED, FELL_SHORT, HELD, INTERRUPTED, SystemTest

FOLDER = pathlib.Path(__file__).resolve().parents[1] / "studies/thesis"
SWEEP = FOLDER / "ladder.toml"

# Binding: columns that other programs read, in this order; further ones come after.
CLAIMS = "id,engine,carrier,reading,figure,value,stderr,low,high,unit,verdict,why".split(",")
HISTORY = (
    "leg,engine,packing,from_rotation,to_rotation,outer_pressure,wheel_torque,wheel_contacts,wheel_touched,"
    "coordination,volume_fraction_at_wheel,volume_fraction_outside,velocity_at_wheel,kinetic_energy,"
    "max_overlap,mean_overlap"
).split(",")

MAP = (
    "engine,group,nu,after_rotations,packings,carry,wheel_contacts,wheel_contacts_stderr,outer_pressure,"
    "outer_pressure_stderr,critical_nu,critical_nu_stderr"
).split(",")
READINGS = "engine,family,reading,nu,rotations,number,unit,default,change,stderr,pairs".split(",")


class Thesis(SystemTest):
    def sweep(self, *arguments, out=None, **options):
        return self.run_program(
            "thesis", SWEEP, "--out", out or self.out, "--quiet", *arguments, **options
        )

    def table(self, name, out=None):
        with open((out or self.out) / name, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def all_but_time(self, out):
        """Every run without what it took."""
        runs = {}
        for file in (out / "runs").glob("tiny*.json"):
            run = json.loads(file.read_text(encoding="utf-8"))
            run["run"]["run"].pop("stats")
            runs[file.stem] = run
        return runs

    def test_a_small_sweep(self):
        done = self.sweep()
        self.assert_status(done, HELD)
        results = self.results()
        self.assertEqual(8, len(results["collisions"]["variants"]))
        self.assertEqual(["tiny", "tiny-smooth"], [leg["name"] for leg in results["legs"]])
        steps = [(run["leg"], run["engine"], run["packing"]) for run in results["runs"]]
        self.assertEqual(
            [("tiny", "grain", 0), ("tiny-smooth", "grain", 0), ("tiny", "grain", 1)], steps
        )
        for run in results["runs"]:
            # Finer rings are kept of the table's legs and its readings.
            self.assertEqual(
                [18] if run["leg"] == "tiny" else [], [finer["count"] for finer in run["finer"]]
            )
            self.assertEqual({}, run["run"]["series"])  # of whole runs, which stay in runs/
            spans = [(span["from"], span["to"]) for span in run["history"]]
            self.assertEqual([(0, 1), (1, 1.5), (1.5, 2.5)], spans)
        for file in (self.out / "runs").glob("tiny*.json"):
            run = json.loads(file.read_text(encoding="utf-8"))["run"]
            self.assertEqual(40, len(run["run"]["series"]["t_s"]))
            # Both are means over the same snapshots.
            pressures = run["run"]["series"]["outer_pressure"]
            self.assertAlmostEqual(
                sum(pressures) / len(pressures), run["history"][-1]["outer_pressure"], delta=1e-9 * max(pressures)
            )
        history = self.table("history.csv")
        self.assertEqual(HISTORY, list(history[0])[: len(HISTORY)])
        self.assertEqual(9, len(history))
        first = (self.out / "claims.csv").read_text(encoding="utf-8").splitlines()[0]
        self.assertEqual(MAP, list(self.table("regime_map.csv")[0])[: len(MAP)])
        self.assertEqual(READINGS, list(self.table("readings.csv")[0])[: len(READINGS)])
        self.assertEqual(CLAIMS, first.split(",")[: len(CLAIMS)])
        self.assertIn("report: ", done.stdout)
        self.assertIn("tiny-smooth", (self.out / "report.html").read_text(encoding="utf-8"))

    def test_what_is_finished_is_loaded_and_the_report_is_rebuilt_to_the_bit(self):
        self.assert_status(self.sweep(), HELD)
        runs = self.finished_runs()
        self.assert_status(self.sweep("--resume"), HELD)
        self.assertEqual(runs, self.finished_runs())
        verdicts = {row["verdict"] for row in self.table("claims.csv")}
        self.assertIn("refuted", verdicts)  # a finding, no failure
        self.assertIn("undecided", verdicts)
        self.assert_status(self.sweep("--strict"), FELL_SHORT)
        files = {name: (self.out / name).read_bytes() for name in ("claims.csv", "history.csv", "results.json")}
        self.assert_status(self.run_program("report", self.out), HELD)
        for name, content in files.items():
            self.assertEqual(content, (self.out / name).read_bytes(), name)

    def test_whole_runs_of_an_earlier_file_make_the_same_report(self):
        self.assert_status(self.sweep(), HELD)
        names = ("claims.csv", "history.csv", "regime_map.csv", "readings.csv", "results.json", "report.html")
        files = {name: (self.out / name).read_bytes() for name in names}
        results = self.results()
        for run in results["runs"]:
            name = f"{run['leg']}-{run['engine']}-p{run['packing']}.json"
            whole = json.loads((self.out / "runs" / name).read_text(encoding="utf-8"))["run"]
            self.assertLess(10 * len(json.dumps(run)), 2 * len(json.dumps(whole)))
            run.update(whole)
        (self.out / "results.json").write_text(json.dumps(results), encoding="utf-8")
        self.assert_status(self.run_program("report", self.out), HELD)
        for name, content in files.items():
            self.assertEqual(content, (self.out / name).read_bytes(), name)

    def test_reasons_that_were_found_since_stand_under_refuted_claims(self):
        self.assert_status(self.sweep(), HELD)
        (refuted, *_) = (
            claim
            for claim in self.results()["claims"]
            if claim["verdict"] == "refuted" and claim["engine"] == "grain"
        )
        figure = refuted["figures"][0]
        reasons = self.folder / "reasons.toml"
        text = "[[reasons]]\nclaim = '{}'\nwhen = [{{ figure = '{}', {} = {!r} }}]\ntext = 'Two disks.'\nevidence = 'x'\n"
        for edge, there in (("above", True), ("below", False)):
            reasons.write_text(
                text.format(refuted["id"], figure["key"], edge, figure["value"] - 1.0), encoding="utf-8"
            )
            self.assert_status(self.run_program("report", self.out, "--reasons", reasons), HELD)
            found = [reason for claim in self.results()["claims"] for reason in claim["reasons"]]
            self.assertEqual(there, "Two disks. (Rests on x.)" in found)
            page = (self.out / "report.html").read_text(encoding="utf-8")
            self.assertEqual(there, "Two disks." in page)
            self.assert_status(self.run_program("report", self.out), HELD)  # it holds them now
            self.assertEqual(page, (self.out / "report.html").read_text(encoding="utf-8"))
        reasons.write_text("[[reasons]]\nclaim = 'C99'\n", encoding="utf-8")
        self.assert_one_line(
            self.run_program("report", self.out, "--reasons", reasons), BAD_INPUT, "reasons.toml:2", "C99"
        )

    def test_another_session_takes_finished_runs_from_the_results_alone(self):
        self.assert_status(self.sweep(), HELD)
        first = self.results()
        for run in first["runs"]:
            run["program"] = "0.0.1 (of another build)"
        missing = first["runs"].pop()
        before = self.folder / "before.json"
        before.write_text(json.dumps(first), encoding="utf-8")
        plan = self.sweep("--from", before, "--dry-run", out=self.folder / "second")
        self.assertIn("3 runs: 2 finished, 1 to do", plan.stdout)
        self.assert_status(self.sweep("--from", before, out=self.folder / "second"), HELD)
        second = json.loads((self.folder / "second/results.json").read_text(encoding="utf-8"))
        self.assertEqual(first["runs"], second["runs"][:2])
        made = second["runs"][2]
        self.assertNotEqual("0.0.1 (of another build)", made["program"])
        self.assertEqual((missing["key"], missing["history"]), (made["key"], made["history"]))
        notes = [note for note in second["notes"] if note.startswith("2 of 3 runs were made by crossgrain 0.0.1")]
        self.assertEqual(1, len(notes), second["notes"])

        # Another seed makes other packings: nothing of it can be taken.
        plan = self.sweep("--from", before, "--seed=2", "--dry-run", out=self.folder / "third")
        self.assertIn("3 runs: 0 finished, 3 to do", plan.stdout)
        first["kind"] = "collide"
        before.write_text(json.dumps(first), encoding="utf-8")
        self.assert_one_line(
            self.sweep("--from", before, out=self.folder / "fourth"), BAD_INPUT, "--from", "'crossgrain collide'"
        )

    def test_interrupted_runs_go_on_to_the_bit(self):
        longer = "--set=averaging.snapshots_per_rotation=400", "--set=averaging.settle_rotations=10.0"
        whole = self.folder / "whole"
        self.assert_status(self.sweep(*longer, out=whole), HELD)
        unfinished = set()
        for _ in range(2):
            running = self.start("thesis", SWEEP, "--out", self.out, "--jobs", 1, *longer)
            running.worker_at_work("grain", cpu_seconds=0.5, stage="running")
            running.process.send_signal(signal.SIGINT)
            done = self.check_no_crash(running.end())
            self.assert_one_error(done, INTERRUPTED, "the same command goes on from there")
            unfinished |= {file.parent.name for file in (self.out / "unfinished").rglob("index.json")}
        self.assertTrue(unfinished)
        self.assert_status(self.sweep(*longer), HELD)
        wanted, found = self.all_but_time(whole), self.all_but_time(self.out)
        self.assertEqual(3, len(wanted))
        self.assertEqual([], [name for name in wanted if wanted[name] != found.get(name)])

    def test_an_engine_that_dies_ends_its_run_alone_and_is_tried_again(self):
        longer = "--set=averaging.settle_rotations=6.0"
        running = self.start("thesis", SWEEP, "--out", self.out, "--jobs", 1, longer)
        os.kill(running.worker_at_work("grain", stage="running"), signal.SIGKILL)
        done = self.check_no_crash(running.end())
        self.assert_one_error(done, ENGINE_FAILED, "packing 0", "grain")
        states = [run["run"]["status"] for run in self.results()["runs"]]
        self.assertEqual((2, 1), (states.count("finished"), states.count("failed")))
        runs = self.finished_runs()
        self.assert_status(self.sweep(longer), HELD)
        now = self.finished_runs()
        self.assertEqual(runs, {name: now[name] for name in runs})
        self.assertEqual({"finished"}, {run["run"]["status"] for run in self.results()["runs"]})

    def test_what_the_budget_has_no_room_for_is_left_out_and_noted(self):
        done = self.sweep("--budget=0.001s")
        self.assert_status(done, FELL_SHORT)
        self.assertIn("nothing was judged: no run was finished", done.stdout)
        self.assertIn("tiny, grain, packing 0 was left out: it would take about", done.stdout)
        self.assertEqual([], self.results()["runs"])
        self.assert_status(self.sweep("--budget=1h"), HELD)
        self.assertEqual(3, len(self.results()["runs"]))

    def test_a_mirror_stands_for_an_engine_that_lockstep_shows_to_be_equivalent(self):
        done = self.sweep("--engines=grain,box2d-penalty")
        self.assert_status(done, HELD)
        results = self.results()
        (carrier,) = results["carriers"]
        self.assertEqual(
            ("box2d-penalty", "grain-as-box2d-penalty", True),
            (carrier["engine"], carrier["mirror"], carrier["carries"]),
        )
        self.assertLess(carrier["equivalent"], 1e-6)
        engines = [run["engine"] for run in results["runs"]]
        self.assertEqual((3, 2, 2), tuple(map(engines.count, ("grain", "box2d-penalty", carrier["mirror"]))))

    def test_a_dry_run_prints_and_writes_nothing(self):
        done = self.sweep("--dry-run")
        self.assert_status(done, HELD)
        self.assertIn("3 runs: 0 finished, 3 to do", done.stdout)
        self.assertFalse(self.out.exists())

    def test_another_seed_is_another_run(self):
        self.assert_status(self.sweep("--seed=2"), HELD)
        self.assertEqual({2}, {run["seed"] for run in self.results()["runs"]})
        self.assert_one_line(self.sweep("--seed=3"), BAD_INPUT, "preparation.seed: 2 → 3")

    def test_bad_input_is_one_line(self):
        self.assert_one_line(
            self.run_program("thesis", self.folder / "none.toml", "--out", self.out), BAD_INPUT, "no such file"
        )
        self.assert_one_line(self.sweep("--budget=soon"), BAD_INPUT, "soon")
        self.assert_one_line(self.sweep("--engines=grian"), BAD_INPUT, "did you mean grain?")
        self.assert_one_line(
            self.run_program("thesis", FOLDER / "tiny.toml", "--out", self.out), BAD_INPUT, "tiny.toml: is a case"
        )


if __name__ == "__main__":
    unittest.main()
