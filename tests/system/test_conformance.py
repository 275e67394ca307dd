"""crossgrain conformance: both examples pass; an engine with a fault is told which, with a number."""

import json
import os
import pathlib
import shutil
import unittest
import xml.etree.ElementTree

from harness import BAD_INPUT, CASES, COLLISION, COUETTE, ENGINE_FAILED, FELL_SHORT, HELD, SystemTest

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
CPP = pathlib.Path(os.environ["CROSSGRAIN_BUILD"]) / "examples/cpp/engine.toml"


# The first contact of every snapshot is left out.
LEFT_OUT = ("self.found, plane = [contacts], 0", "self.found, plane = [[c[1:] for c in contacts]], 0")


class Conformance(SystemTest):
    def conformance(self, *arguments):
        return self.run_program("conformance", *arguments, "--quiet")

    def changed(self, before, after):
        """The example in Python with one piece of it changed."""
        folder = self.folder / "own"
        folder.mkdir()
        program = (EXAMPLES / "python/engine.py").read_text(encoding="utf-8")
        self.assertIn(before, program)
        (folder / "engine.py").write_text(program.replace(before, after), encoding="utf-8")
        shutil.copy(EXAMPLES / "python/engine.toml", folder)
        return folder / "engine.toml"

    def test_the_example_in_python_passes(self):
        done = self.conformance(EXAMPLES / "python/engine.toml", "--out", self.out)
        self.assert_status(done, HELD)
        self.assertIn("numpy: identical to rounding over 4 starts", done.stdout)
        results = json.loads((self.out / "results.json").read_text(encoding="utf-8"))
        self.assertEqual("conformance", results["kind"])
        self.assertEqual(
            {"suite", "lockstep", "collisions"}, {row["part"] for row in results["checks"]}
        )
        self.assertEqual({"passed", "skipped"}, {row["outcome"] for row in results["checks"]})
        self.assertTrue(all(row["detail"] for row in results["checks"] if row["outcome"] == "skipped"))
        self.assertEqual([], results["not_examined"])
        self.assertGreater(results["declared"], 30)
        suite = xml.etree.ElementTree.parse(self.out / "junit.xml").getroot()
        self.assertEqual(("0", "0"), (suite.get("failures"), suite.get("errors")))
        self.assertIn("checks passed", (self.out / "report.html").read_text(encoding="utf-8"))

    def test_the_example_in_cpp_passes(self):
        done = self.conformance(CPP)
        self.assert_status(done, HELD)
        self.assertIn("plain: identical to rounding over 4 starts", done.stdout)

    def test_contacts_left_out_are_found(self):
        engine = self.changed(*LEFT_OUT)
        done = self.conformance(engine, "-k", "SnapshotsAreSound")
        self.assert_status(done, FELL_SHORT)
        self.assertIn("failed: SnapshotsAreSound", done.stdout)
        self.assertRegex(done.stdout, r"no contact of disk \d+ with (wall )?disk \d+, which overlap by")

    def test_what_is_averaged_is_audited(self):
        case = self.write(
            "case.toml",
            f'[case]\nname = "own"\nextends = "{COUETTE}"\n[run]\nmirrors = false\n'
            "[preparation]\npackings = 1\n"
            "[averaging]\nsettle_rotations = 0.002\nrotations = 0.002\n",
        )
        done = self.run_program(
            "compare", case, "--engines", f"grain,{self.changed(*LEFT_OUT)}", "--out", self.out, "--quiet",
            "--set=averaging.snapshots_per_rotation=2000",
        )  # fmt: skip
        self.assert_status(done, ENGINE_FAILED)
        self.assertRegex(
            done.error_lines()[0], r"numpy, own at t = \S+ s: its snapshot cannot be: no contact of disk"
        )
        results = json.loads((self.out / "results.json").read_text(encoding="utf-8"))
        self.assertEqual(
            {"grain": "finished", "numpy": "failed"},
            {run["engine"]: run["status"] for run in results["runs"]},
        )

    def test_no_command_takes_a_snapshot_that_cannot_be(self):
        engine = self.changed(*LEFT_OUT)
        for command, status in (
            (("lockstep", COUETTE, "--quick", "--starts=1"), ENGINE_FAILED),
            (("collide", COLLISION, "-k", "*spring*"), ENGINE_FAILED),
            (("stability", CASES / "hard", "-k", "billiard-break*"), FELL_SHORT),
        ):
            with self.subTest(command=command[0]):
                out = self.folder / command[0]
                done = self.run_program(*command, "--engines", engine, "--out", out, "--quiet")
                self.assert_status(done, status)
                results = (out / "results.json").read_text(encoding="utf-8")
                self.assertRegex(
                    results, r"numpy, [^\"]+ at t = \S+ s: its snapshot cannot be: no contact of disk \d+ with"
                )

    def test_a_wrong_constant_is_named(self):
        engine = self.changed('law["kn"] * overlap', '1.02 * law["kn"] * overlap')
        done = self.conformance(engine, "-k", "FollowsItsMirror", "--out", self.out)
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"most likely: .*k_n")
        self.assertIn("Most likely", (self.out / "report.html").read_text(encoding="utf-8"))
        results = json.loads((self.out / "results.json").read_text(encoding="utf-8"))
        self.assertNotIn("declared", results)  # some of the checks cannot say what none examines

    def test_it_is_loaded_as_its_file_says(self):
        """[settings] of the file reach every load; one that the engine does not have is bad input."""
        engine = self.changed(
            '"settings": [],\n',
            '"settings": [{"name": "loudness", "default": 0.0, "unit": "-", "doc": "-", "choices": []}],\n',
        )
        program = engine.parent / "engine.py"
        load = "def load(self, scene, arrays, settings):\n"
        text = program.read_text(encoding="utf-8")
        self.assertIn(load, text)
        program.write_text(text.replace(load, f"{load}        assert settings['loudness'] == 2.0\n"), encoding="utf-8")
        said = engine.read_text(encoding="utf-8")
        engine.write_text(f"{said}[settings]\nloudness = 2.0\n", encoding="utf-8")
        for check in ("DefaultsSpoken", "WorkersAgree", "LivesOn", "EffectsAreThose"):
            with self.subTest(check):
                self.assert_status(self.conformance(engine, "-k", check), HELD)
        engine.write_text(f"{said}[settings]\nloudnes = 2.0\n", encoding="utf-8")
        done = self.conformance(engine, "-k", "Flies")
        self.assert_status(done, BAD_INPUT)
        self.assertIn(
            "numpy: [settings] of its file: there is no setting 'loudnes' (did you mean loudness?)", done.error_lines()[0]
        )

    def test_one_that_breaks_down(self):
        engine = self.changed("def advance(self, t):\n", "def advance(self, t):\n        raise SystemExit(3)\n")
        done = self.conformance(engine, "-k", "Flies")
        self.assert_status(done, ENGINE_FAILED)
        self.assertIn("broke down: FliesStraight", done.stdout)
        self.assertIn("ended (exit status 3) during advance", done.error_lines()[0])

    def test_bad_input(self):
        for arguments, words in (
            (("yad",), "did you mean yade?"),
            (("./none.toml",), "no such file"),
            (("all",), "takes one engine"),
            (("grain", "-k", "NoSuchCheck"), "no check has that in its name"),
        ):
            with self.subTest(arguments=arguments):
                done = self.conformance(*arguments)
                self.assert_status(done, BAD_INPUT)
                self.assertIn(words, done.error_lines()[0])


if __name__ == "__main__":
    unittest.main()
