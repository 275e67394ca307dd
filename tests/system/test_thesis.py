"""crossgrain thesis runs a sweep of cases, keeps what is finished, goes on to the bit, and judges; kept reports of the claims
follow from their results to the bit, and say why a claim is refuted."""

import gzip
import json
import os
import shutil
import signal
import tomllib
import unittest

from harness import BAD_INPUT, CASES, ENGINE_FAILED, FELL_SHORT, HELD, HOME, INTERRUPTED, SystemTest

SWEEP = HOME / "tests/studies/thesis/ladder.toml"
CURATED = sorted(file.parent for file in HOME.glob("reports/curated/thesis*/results.json"))
REASONS = CASES / "couette/thesis/reasons.toml"


class Thesis(SystemTest):
    def sweep(self, *arguments, out=None):
        return self.run_program("thesis", SWEEP, "--out", out or self.out, "--quiet", *arguments)

    def all_but_time(self, out):
        """Every run without what it took."""
        runs = {}
        for file in (out / "runs").glob("tiny*.json.gz"):
            run = json.loads(gzip.decompress(file.read_bytes()))
            run["run"]["run"].pop("stats")
            runs[file.name] = run
        return runs

    def test_report_is_rebuilt_to_the_bit_also_from_whole_runs(self):
        self.assert_status(self.sweep(), HELD)
        runs = self.finished_runs()
        verdicts = {row["verdict"] for row in self.rows("claims.csv")}
        self.assertLessEqual({"cannot be tested", "reproduced", "undecided"}, verdicts)  # findings, no failures
        self.assert_status(self.sweep("--strict"), FELL_SHORT)
        self.assertEqual(runs, self.finished_runs())
        results = self.results()
        names = ("claims.csv", "history.csv", "regime_map.csv", "readings.csv", "results.json", "report.html")
        files = {name: (self.out / name).read_bytes() for name in names}
        for run in results["runs"]:
            # Of whole runs, which stay in runs/; finer rings are kept of the table's cases and its interpretations.
            self.assertEqual({}, run["run"]["series"])
            self.assertEqual([18] if run["leg"] == "tiny" else [], [finer["count"] for finer in run["finer"]])
            self.assertEqual([(0, 1), (1, 1.5), (1.5, 2.5)], [(span["from"], span["to"]) for span in run["history"]])
            name = f"{run['leg']}-{run['engine']}-p{run['packing']}.json.gz"
            whole = json.loads(gzip.decompress((self.out / "runs" / name).read_bytes()))["run"]
            self.assertLess(10 * len(json.dumps(run)), 2 * len(json.dumps(whole)))
            # Both are means over the same snapshots.
            pressures = whole["run"]["series"]["outer_pressure"]
            self.assertAlmostEqual(
                sum(pressures) / len(pressures), whole["history"][-1]["outer_pressure"], delta=1e-9 * max(pressures)
            )
            run.update(whole)
        for content in (files["results.json"], json.dumps(results).encode()):
            (self.out / "results.json").write_bytes(content)
            self.assert_status(self.run_program("report", self.out), HELD)
            for name in names[:-1]:
                self.assertEqual(files[name], (self.out / name).read_bytes(), name)

    def test_another_session_takes_finished_runs_from_the_results_alone(self):
        self.assert_status(self.sweep(), HELD)
        first = self.results()
        for run in first["runs"]:
            run["program"] = "0.0.1 (of another build)"
        missing = first["runs"].pop()
        before = self.folder / "before.json"
        before.write_text(json.dumps(first), encoding="utf-8")
        second = self.folder / "second"
        plan = self.sweep("--from", before, "--dry-run", out=second)
        self.assertIn("3 runs: 2 finished, 1 to do", plan.stdout)
        self.assertFalse(second.exists())
        self.assert_status(self.sweep("--from", before, out=second), HELD)
        results = self.results(second)
        self.assertEqual(first["runs"], results["runs"][:2])
        made = results["runs"][2]
        self.assertNotEqual("0.0.1 (of another build)", made["program"])
        self.assertEqual((missing["key"], missing["history"]), (made["key"], made["history"]))
        self.assertIn("2 of 3 runs were made by crossgrain 0.0.1", " ".join(results["notes"]))
        # Another seed makes other packings: nothing of it can be taken.
        plan = self.sweep("--from", before, "--seed=2", "--dry-run", out=self.folder / "third")
        self.assertIn("3 runs: 0 finished, 3 to do", plan.stdout)
        first["kind"] = "collide"
        before.write_text(json.dumps(first), encoding="utf-8")
        done = self.sweep("--from", before, out=self.folder / "fourth")
        self.assert_one_line(done, BAD_INPUT, "--from", "'crossgrain collide'")

    def test_interrupted_or_dying_runs_go_on_to_the_bit(self):
        longer = "--set=averaging.snapshots_per_rotation=400", "--set=averaging.settle_rotations=4.0"
        whole = self.folder / "whole"
        self.assert_status(self.sweep(*longer, out=whole), HELD)
        running = self.start("thesis", SWEEP, "--out", self.out, "--jobs", 1, *longer)
        running.worker_at_work("grain", cpu_seconds=0.3, stage="running")
        running.process.send_signal(signal.SIGINT)
        done = self.check_no_crash(running.end())
        self.assert_one_error(done, INTERRUPTED, "the same command goes on from there")
        self.assertTrue(list((self.out / "unfinished").rglob("index.json")))
        running = self.start("thesis", SWEEP, "--out", self.out, "--jobs", 1, *longer)
        os.kill(running.worker_at_work("grain", stage="running"), signal.SIGKILL)
        self.assert_one_error(self.check_no_crash(running.end()), ENGINE_FAILED, "packing ", "grain")
        states = [run["run"]["status"] for run in self.results()["runs"]]
        self.assertEqual((2, 1), (states.count("finished"), states.count("failed")))
        runs = self.finished_runs()
        self.assert_status(self.sweep(*longer), HELD)
        now = self.finished_runs()
        self.assertEqual(runs, {name: now[name] for name in runs})
        self.assertEqual(self.all_but_time(whole), self.all_but_time(self.out))

    def test_what_the_budget_has_no_room_for_is_left_out_and_noted(self):
        done = self.sweep("--budget=0.001s")
        self.assert_status(done, FELL_SHORT)
        self.assertIn("nothing was judged: no run was finished", done.stdout)
        self.assertIn("tiny, grain, packing 0 was left out: it would take about", done.stdout)
        self.assertEqual([], self.results()["runs"])

    def test_mirror_stands_for_an_engine_that_lockstep_shows_to_be_equivalent(self):
        self.assert_status(self.sweep("--engines=grain,box2d-penalty", "--seed=2"), HELD)
        results = self.results()
        (surrogate,) = results["carriers"]
        mirror = "grain-as-box2d-penalty"
        self.assertEqual(
            ("box2d-penalty", mirror, True), (surrogate["engine"], surrogate["mirror"], surrogate["carries"])
        )
        self.assertLess(surrogate["equivalent"], 1e-6)
        engines = [run["engine"] for run in results["runs"]]
        self.assertEqual((3, 2, 2), tuple(map(engines.count, ("grain", "box2d-penalty", mirror))))
        self.assertEqual({2}, {run["seed"] for run in results["runs"]})
        self.assert_one_line(self.sweep("--engines=grain,box2d-penalty", "--seed=3"), BAD_INPUT, "preparation.seed: 2 → 3")


def opposite(condition):
    """What holds where the condition does not."""
    edge, other = ("above", "below") if "above" in condition else ("below", "above")
    return {key: condition[key] for key in ("claim", "figure") if key in condition} | {other: condition[edge]}


def toml_of(reasons):
    def inline(condition):
        return "{ " + ", ".join(f"{key} = {json.dumps(value)}" for key, value in condition.items()) + " }"

    parts = []
    for reason in reasons:
        lines = [f"{key} = {json.dumps(value)}" for key, value in reason.items() if key != "when"]
        conditions = ", ".join(inline(each) for each in reason["when"])
        parts.append("\n".join(["[[reasons]]", *lines, f"when = [{conditions}]"]))
    return "\n\n".join(parts) + "\n"


class Curated(SystemTest):
    def judged_again(self, folder, *arguments):
        """The claims of a report that is made from the folder's results alone."""
        shutil.rmtree(self.out, ignore_errors=True)
        self.out.mkdir()
        shutil.copy(folder / "results.json", self.out)
        self.assert_status(self.run_program("report", self.out, *arguments), HELD)
        return self.results()["claims"]

    def test_tables_follow_from_results_to_the_bit(self):
        self.assertTrue(CURATED)
        for folder in CURATED:
            self.judged_again(folder)
            for kept in [*folder.glob("*.csv"), folder / "results.json"]:
                self.assertEqual(kept.read_bytes(), (self.out / kept.name).read_bytes(), kept)

    def test_reasons_that_were_found_since_stand_under_refuted_claims(self):
        claims = self.judged_again(CURATED[-1])
        refuted = next(one for one in claims if one["verdict"] == "refuted" and one["engine"] == "grain")
        figure = refuted["figures"][0]
        reasons = self.folder / "reasons.toml"
        for edge, there in (("above", True), ("below", False)):
            reasons.write_text(
                f"[[reasons]]\nclaim = '{refuted['id']}'\ntext = 'Two disks.'\nevidence = 'x'\n"
                f"when = [{{ figure = '{figure['key']}', {edge} = {figure['value'] - 1.0!r} }}]\n", encoding="utf-8",
            )  # fmt: skip
            self.assert_status(self.run_program("report", self.out, "--reasons", reasons), HELD)
            found = [reason for claim in self.results()["claims"] for reason in claim["reasons"]]
            self.assertEqual(there, "Two disks. (Rests on x.)" in found)
            page = (self.out / "report.html").read_text(encoding="utf-8")
            self.assertEqual(there, "Two disks." in page)
            self.assert_status(self.run_program("report", self.out), HELD)  # it holds them now
            self.assertEqual(page, (self.out / "report.html").read_text(encoding="utf-8"))
        reasons.write_text("[[reasons]]\nclaim = 'C99'\n", encoding="utf-8")
        done = self.run_program("report", self.out, "--reasons", reasons)
        self.assert_one_line(done, BAD_INPUT, "reasons.toml:2", "C99")

    def test_every_refuted_claim_has_a_reason_that_goes_with_each_of_its_conditions(self):
        """None that is shipped is idle, and none is printed where a condition of it does not hold."""
        shipped = tomllib.loads(REASONS.read_text(encoding="utf-8"))["reasons"]
        reversed_ones = [
            reason
            | {"text": f"turned: {reason['text']}"}
            | {"when": [*reason["when"][:k], opposite(condition), *reason["when"][k + 1 :]]}
            for reason in shipped
            for k, condition in enumerate(reason["when"])
        ]
        file = self.folder / "turned.toml"
        file.write_text(toml_of([*shipped, *reversed_ones]), encoding="utf-8")
        texts, printed = {reason["text"] for reason in shipped}, set()
        for folder in CURATED:
            seen = set()
            for claim in self.judged_again(folder, "--reasons", file):
                where = f"{folder.name}: {claim['id']}, {claim['engine']}"
                found = {reason.split(" (Rests on ")[0] for reason in claim["reasons"] if " (Rests on " in reason}
                printed |= found & texts
                for text in found & texts:
                    self.assertNotIn(f"turned: {text}", found, where)
                standard = (claim["id"], claim["engine"]) not in seen  # the interpretation taken comes first
                seen.add((claim["id"], claim["engine"]))
                if standard and claim["verdict"] == "refuted" and claim["engine"] in ("grain", "-"):
                    self.assertTrue(found & texts, where)
        self.assertEqual(texts, printed)


if __name__ == "__main__":
    unittest.main()
