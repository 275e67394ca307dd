"""crossgrain record and replay: a run's requests and answers as one file, asked again."""

import json
import pathlib
import shutil
import unittest

from harness import BAD_INPUT, COLLISION, ENGINE_FAILED, FELL_SHORT, HELD, SystemTest

EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / "examples/python"


class Record(SystemTest):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "run.rec"

    def record(self, engine, *arguments):
        return self.run_program(
            "record", COLLISION, "--engines", engine, "--out", self.file, "-kspring_dashpot-tension", *arguments
        )

    def replay(self, engine, *arguments):
        return self.run_program("replay", self.file, "--engines", engine, *arguments)

    def changed(self, before, after):
        """The example with one piece of it changed."""
        folder = self.folder / f"own{len(list(self.folder.glob('own*')))}"
        folder.mkdir()
        program = (EXAMPLE / "engine.py").read_text(encoding="utf-8")
        self.assertIn(before, program)
        (folder / "engine.py").write_text(program.replace(before, after), encoding="utf-8")
        shutil.copy(EXAMPLE / "engine.toml", folder)
        return folder / "engine.toml"

    def test_changed_engine_first_different_answer_is_found(self):
        done = self.record(EXAMPLE / "engine.toml")
        self.assert_status(done, HELD)
        self.assertRegex(done.stdout, r"run\.rec: \d+ requests and answers of numpy 1 \(program \w+\)")
        # One file holds it all: what it was made from may have gone.
        done = self.replay(EXAMPLE / "engine.toml")
        self.assert_status(done, HELD)
        self.assertIn("same answers to all", done.stdout)
        own = self.changed('law["kn"] * overlap', '1.001 * law["kn"] * overlap')
        done = self.replay(own)
        self.assert_status(done, FELL_SHORT)
        # The first snapshot shows disks apart: k_n does nothing before the second.
        self.assertRegex(done.stdout, r"request 5, snapshot, has the first different answer")
        self.assertRegex(done.stdout, r"  velocity\[\d+\]: then \S+, now \S+, differs by \S+; \d+ of \d+ differ")
        found = json.loads(self.replay(own, "--json").stdout)
        self.assertEqual((5, "snapshot"), (found["asked"], found["request"]))
        self.assertIn("position", [each["field"].split("[")[0] for each in found["differences"]])
        self.assert_status(self.replay(own, "--tolerance=0.1"), HELD)
        # Two files that cannot be asked.
        whole = self.file.read_bytes()
        self.file.write_bytes(whole[:-20])
        done = self.replay(EXAMPLE / "engine.toml")
        self.assert_status(done, BAD_INPUT)
        self.file.write_bytes(b"\n")
        done = self.replay(EXAMPLE / "engine.toml")
        self.assert_status(done, BAD_INPUT)
        self.assertIn("is no recording", done.error_lines()[0])

    def test_a_failure_is_recorded_and_comes_again(self):
        own = self.changed("def step(self):\n", "def step(self):\n        if self.steps == 9: raise SystemExit(7)\n")
        done = self.record(own)
        self.assert_status(done, ENGINE_FAILED)
        self.assertIn("ended (exit status 7) during advance", done.error_lines()[0])
        self.assertIn("4 requests and answers", done.stdout)
        done = self.replay(own)
        self.assert_status(done, ENGINE_FAILED)
        self.assertIn("same answers as far as request 4, where it fails", done.stdout)
        done = self.replay(EXAMPLE / "engine.toml")
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"failure: then .*exit status 7.*, now an answer")

    def test_what_cannot_run_leaves_no_file(self):
        done = self.run_program("record", COLLISION, "--engines", EXAMPLE / "engine.toml", "--out", self.file)
        self.assert_status(done, BAD_INPUT)
        self.assertIn("kt must be > 0", done.error_lines()[0])
        self.assertFalse(self.file.exists())
        done = self.run_program(
            "record", COLLISION, "--engine=gone=/no/such/program", "--engines=gone", "--out", self.file
        )
        self.assert_status(done, BAD_INPUT)
        self.assertFalse(self.file.exists())

    def test_bad_input(self):
        self.file.write_text("mine", encoding="utf-8")
        done = self.record("grain")
        self.assert_status(done, BAD_INPUT)
        self.assertIn("is not replaced", done.error_lines()[0])
        self.assertEqual("mine", self.file.read_text(encoding="utf-8"))
        self.file.unlink()
        for option, words in (("--time=-1", "must be > 0"), ("--looks=0", "from 1 to"), ("--engines=yade", "one engine"), ("-knothing", "no case or variant")):
            with self.subTest(option=option):
                done = self.run_program(
                    "record", COLLISION, "--engines=grain", "--out", self.file, option
                )
                self.assert_status(done, BAD_INPUT)
                self.assertIn(words, done.error_lines()[0])
                self.assertFalse(self.file.exists())


if __name__ == "__main__":
    unittest.main()
