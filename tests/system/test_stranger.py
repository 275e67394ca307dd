"""An engine of the user's own: one TOML file, named where any other engine is named."""

import csv
import json
import os
import pathlib
import shutil
import struct
import unittest

from harness import BAD_INPUT, CASES, COLLISION, COUETTE, ENGINE_FAILED, HELD, SystemTest, recorded_exchanges

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "examples"
CPP = pathlib.Path(os.environ["CROSSGRAIN_BUILD"]) / "examples/cpp/engine.toml"

# A disk on a board that turns by half a radian about a point beside it: carried, pushed, and made to roll.
TURNING = f"""
[case]
name = "turning"
kind = "assembly"
extends = "{CASES / 'laws/hard.toml'}"
[law]
tangential = "spring_dashpot"
gn = 0.19
mu = 0.5
kt = 267.1
gt = 0.15
[assembly]
duration = 0.05
gravity = [0.0, -9.81]
[[assembly.disks]]
position = [0.02, 0.00369]
radius = 0.0037
mass = 0.275e-3
[[assembly.walls]]
point = [0.0, 0.0]
normal = [0.0, 1.0]
omega = 10.0
centre = [-0.01, -0.02]
"""


def last_disk(recording):
    """Position and spin of the first disk in the last snapshot of a recording."""
    for _, answer, arrays in recorded_exchanges(recording):
        if arrays:
            offset = {each["name"]: each["offset"] for each in answer["arrays"]}
            found = [*struct.unpack_from("<2d", arrays, offset["position"])]
            found += struct.unpack_from("<d", arrays, offset["spin"])
    return found


class Stranger(SystemTest):
    def run_with(self, command, case, engines, *arguments):
        return self.run_program(
            command, case, "--engines", engines, "--out", self.out, "--quiet", *arguments,
        )

    def own(self, text):
        """A copy of the example that may be changed, described by `text`."""
        folder = self.folder / "own"
        folder.mkdir(exist_ok=True)
        shutil.copy(EXAMPLES / "python/engine.py", folder)
        (folder / "mine.toml").write_text(text, encoding="utf-8")
        return folder / "mine.toml"

    def refused(self, text, *words):
        done = self.run_with("lockstep", COUETTE, self.own(text), "--quick")
        self.assert_status(done, BAD_INPUT)
        for word in words:
            self.assertIn(word, done.error_lines()[0])

    def test_the_example_is_its_mirror_to_rounding(self):
        done = self.run_with(
            "lockstep", COUETTE, EXAMPLES / "python/engine.toml", "--quick", "--starts=2"
        )
        self.assert_status(done, HELD)
        self.assertIn("numpy: identical to rounding over 2 starts", done.stdout)

    def test_beside_an_engine_of_the_program_and_its_own_mirror(self):
        case = self.write(
            "case.toml",
            f'[case]\nname = "own"\nextends = "{COLLISION}"\n'
            "[collision]\npsi = { from = 0, to = 4, count = 5 }\n",
        )
        done = self.run_with("collide", case, f"grain,{EXAMPLES / 'python/engine.toml'}")
        self.assertIn(done.status, (HELD, 1), str(done))
        with open(self.out / "collisions.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(
            {"grain", "numpy", "grain-as-numpy"}, {row["engine"] for row in rows}
        )
        springs = [
            row for row in rows
            if row["engine"] == "numpy" and row["variant"] == "spring_dashpot-tension"
        ]  # fmt: skip
        self.assertEqual({"held"}, {row["verdict_declared"] for row in springs})
        self.assertLess(max(float(row["own_scheme"] or 0) for row in springs), 1e-12)

    def test_of_the_command_line(self):
        folder = self.own("").parent
        done = self.run_program(
            "lockstep", COUETTE, f"--engine=mine=python3 {folder / 'engine.py'}", "--engines=mine",
            "--out", self.out, "--quiet", "--quick", "--starts=1",
        )  # fmt: skip
        self.assert_status(done, HELD)
        self.assertIn("mine: identical to rounding", done.stdout)

    def test_another_program_under_the_same_version_is_another_engine(self):
        mine = self.own('name = "mine"\ncommand = ["python3", "engine.py"]\n')
        arguments = ("lockstep", COUETTE, mine, "--quick", "--starts=1")
        self.assert_status(self.run_with(*arguments), HELD)
        self.assert_status(self.run_with(*arguments), HELD)
        program = mine.parent / "engine.py"
        program.write_text(program.read_text(encoding="utf-8") + "# changed\n", encoding="utf-8")
        done = self.run_with(*arguments)
        self.assert_status(done, BAD_INPUT)
        self.assertIn("program", done.error_lines()[0])

    def test_bad_files(self):
        command = 'command = ["python3", "engine.py"]\n'
        self.refused(command, "mine.toml", "name is missing")
        self.refused('name = "mine"\n', "mine.toml", "command is missing")
        self.refused(f'name = "grain"\n{command}', 'name = "grain"', "is taken")
        self.refused(f'name = "mine.toml"\n{command}', "is that of a file")
        self.refused(f'name = "a b"\n{command}', "must be of letters")
        self.refused(f'name = "mine"\nfoldr = "x"\n{command}', "foldr", "did you mean folder?")
        self.refused(f'name = "mine"\nfolder = "nowhere"\n{command}', "is no folder")
        self.refused(f'name = "mine"\nmemory = 2\n{command}', "memory", "bytes")
        self.refused('name = "mine"\ncommand = ["no-such-program"]\n', "no-such-program", "PATH")
        done = self.run_with("lockstep", COUETTE, "./none.toml", "--quick")
        self.assert_status(done, BAD_INPUT)
        self.assertIn("no such file", done.error_lines()[0])

    def test_one_that_wants_more_memory_than_its_file_allows(self):
        mine = self.own('name = "mine"\nmemory = 3e9\ncommand = ["python3", "engine.py"]\n')
        program = mine.parent / "engine.py"
        text = program.read_text(encoding="utf-8").replace(
            "def step(self):\n", "def step(self):\n        np.ones(10**9)\n"
        )
        program.write_text(text, encoding="utf-8")
        done = self.run_with("lockstep", COUETTE, mine, "--quick", "--starts=1")
        self.assert_status(done, ENGINE_FAILED)
        self.assertRegex(done.error_lines()[0], r"mine, .*: (numpy\S*)?MemoryError|Unable to allocate")

    def test_planes_turn_with_their_body(self):
        case = self.write("turning.toml", TURNING)
        numpy = f"--engine=numpy=python3 {EXAMPLES / 'python/engine.py'}"
        ends = {}
        for name, arguments in (
            ("python", ("--engines", EXAMPLES / "python/engine.toml")),
            ("cpp", ("--engines", CPP)),
            ("mirror", (numpy, "--engines=grain-as-numpy")),
        ):
            recording = self.folder / f"{name}.rec"
            done = self.run_program("record", case, *arguments, "--out", recording)
            self.assert_status(done, HELD)
            ends[name] = last_disk(recording)
        self.assertGreater(ends["mirror"][1], 0.01)  # lifted by more than a radius
        self.assertLess(ends["mirror"][2], -1.0)  # it rolls
        for name in ("python", "cpp"):
            for value, of_mirror in zip(ends[name], ends["mirror"]):
                self.assertAlmostEqual(value, of_mirror, delta=1e-11 + 1e-9 * abs(of_mirror), msg=name)

    def test_a_scene_beyond_its_limits_is_refused_before_it_is_loaded(self):
        mine = self.own('name = "mine"\ncommand = ["python3", "engine.py"]\n')
        program = mine.parent / "engine.py"
        text = program.read_text(encoding="utf-8")
        text = text.replace('"settings": [],', '"settings": [], "plane_normals": "axis",')
        text = text.replace("def load(self, scene, arrays, settings):\n", "def load(self, *_):\n        os.abort()\n")
        program.write_text(text, encoding="utf-8")
        case = self.write("turning.toml", TURNING)
        done = self.run_program("record", case, "--engines", mine, "--out", self.folder / "none.rec")
        self.assert_status(done, BAD_INPUT)
        self.assertIn("has planes along an axis only, and those of", done.error_lines()[0])

    def test_a_program_that_speaks_no_protocol_fails(self):
        mine = self.own('name = "mine"\ncommand = ["true"]\n')
        done = self.run_with("lockstep", COUETTE, mine, "--quick", "--starts=1")
        self.assert_status(done, ENGINE_FAILED)
        self.assertIn("mine: ended (exit status 0) during hello", done.stderr)


if __name__ == "__main__":
    unittest.main()
