"""An engine of the user's own, one TOML file: conformance, record and replay, what is wrong with it, and its protocol's schema."""

import copy
import json
import struct
import unittest
import xml.etree.ElementTree

import jsonschema

from harness import (
    BAD_INPUT,
    BUILD,
    CASES,
    COLLISION,
    COUETTE,
    CPP,
    ENGINE_FAILED,
    FELL_SHORT,
    HELD,
    HOME,
    PYTHON,
    SystemTest,
    nightly,
    recorded_exchanges,
    settings,
)

# The first contact of every snapshot is left out.
LEFT_OUT = ("self.found, plane = [contacts], 0", "self.found, plane = [[c[1:] for c in contacts]], 0")
IN_SPACE = "MovedPairs,InSpace,RotatingWall,TorqueTurns,TurnedAlike"
ONE_STATE = ("lockstep", COUETTE, "--quick", "--starts=1", "--quiet")


# cases/space/pile.toml with fewer spheres, for less long.
HEAP = f"""
[case]
name = "heap"
extends = "{CASES / 'space/pile.toml'}"
[assembly]
duration = 0.1
[[assembly.disks]]
position = [-0.0125, -0.0125, 0.012]
radius = 0.005
density = 2500
radius_spread = 0.1
jitter = 0.05
grid = {{ columns = 3, rows = 3, layers = 2, spacing = [1.25, 1.25, 1.25] }}
[[assembly.walls]]
position = [-0.03, -0.03, 0.0]
radius = 0.005
grid = {{ columns = 7, rows = 7 }}
[[assembly.walls]]
point = [0.0, 0.0, -0.01]
normal = [0.0, 0.0, 1.0]
[average]
from = 0.05
snapshots = 5
[preparation]
packings = 4
[looks]
count = 1
"""

# A disk that rubs along a wall disk and does not turn.
RUBS = f"""
[case]
name = "rubs"
kind = "assembly"
extends = "{CASES / 'laws/rough.toml'}"
[law]
tension = "allow"
[assembly]
duration = 0.002
rotation = false
gravity = [0.0, 0.0]
[[assembly.disks]]
position = [0.0, 0.00995]
radius = 0.005
mass = 0.275e-3
velocity = [0.5, -0.2]
[[assembly.walls]]
position = [0.0, 0.0]
radius = 0.005
"""


class Conformance(SystemTest):
    def conformance(self, *arguments):
        return self.run_program("conformance", *arguments, "--quiet")

    def test_both_examples_pass_those_that_no_two_engines_share(self):
        """That they follow their mirrors is shown by lockstep (EngineFile); how bodies move, oscillating or not, is one line for
        planes and wall disks."""
        own = "RotatingWall,TranslatingWall,ShrinkingWall,TurningPlane,ThoseThatAct,Sound"
        for engine in (CPP, PYTHON):
            done = self.conformance(engine, "-k", own, "--out", self.out)
            self.assert_status(done, HELD)
            self.assertRegex(done.stdout, r"(plain|numpy) [^\n]*: (\d+) of \2 checks passed")
            suite = xml.etree.ElementTree.parse(self.out / "junit.xml").getroot()
            self.assertEqual(("0", "0"), (suite.get("failures"), suite.get("errors")))
        # Of several names each is that of a check.
        self.assert_one_line(self.conformance(PYTHON, "-k", "Sound,Sounds"), BAD_INPUT, "-k 'Sounds': no check has that")

    @nightly
    def test_example_in_cpp_passes_every_check(self):
        """The one in Python takes some twenty seconds for a wall that oscillates."""
        self.assert_status(self.conformance(PYTHON, "-k", "OscillatingWall"), HELD)
        done = self.conformance(CPP, "--out", self.out)
        self.assert_status(done, HELD)
        self.assertIn("plain: identical to rounding over 4 starts", done.stdout)
        results = self.results()
        self.assertEqual({"suite", "lockstep", "collisions"}, {row["part"] for row in results["checks"]})
        self.assertEqual({"passed", "skipped"}, {row["outcome"] for row in results["checks"]})
        self.assertTrue(all(row["detail"] for row in results["checks"] if row["outcome"] == "skipped"))
        self.assertEqual([], results["not_examined"])

    def passes_spheres_alone(self, name, program, *arguments):
        """As most engines of spheres are: [3] in place of [2, 3]. @return the engine's file"""
        engine = self.engine_file(name, *program, "3")
        self.assert_status(self.conformance(engine, *arguments, "--out", self.out), HELD)
        self.assertEqual({"passed", "skipped"}, {row["outcome"] for row in self.results()["checks"]})
        return engine

    def test_example_in_cpp_takes_spheres_alone(self):
        self.passes_spheres_alone("plain", (CPP.with_name("engine"),), "-k", IN_SPACE)

    @nightly
    def test_examples_pass_every_check_of_spheres(self):
        """A heap on a floor of spheres, too, on the one that is fast."""
        self.passes_spheres_alone("numpy", ("python3", PYTHON.with_name("engine.py")), "-k", IN_SPACE)
        plain = self.passes_spheres_alone("plain", (CPP.with_name("engine"),))
        heap = self.write("heap.toml", HEAP)
        done = self.held("lockstep", heap, "--engines", plain, "--starts=2", "--out", self.out / "lockstep", "--quiet")
        self.assertIn("plain follows the law that it declares", done.stdout)
        done = self.held("compare", heap, "--engines", f"grain,{plain}", "--out", self.out / "compare", "--quiet")
        self.assertRegex(done.stdout, r"[1-9] agree, \d borderline, 0 disagree")

    def test_wall_of_a_scene_without_rotation_bears_forces_alone(self):
        """A wall disk takes no −a f_t there: about its body's centre, its own, all of it is 0."""
        case = self.write("rubs.toml", RUBS)
        for engine in (PYTHON, CPP):
            recording = self.folder / f"{engine.parent.name}.rec"
            self.held("record", case, "--engines", engine, "--out", recording)
            shown = [answer["snapshot"]["bodies"][0] for _, answer, _ in recorded_exchanges(recording) if "snapshot" in answer]
            pushed = [body for body in shown if abs(body["force"][0]) > 1e-3]
            self.assertTrue(pushed)
            for body in pushed:
                self.assertLess(abs(body["torque"]), 1e-12 * 0.005 * abs(body["force"][1]))

    @nightly
    def test_wrong_constant_is_named(self):
        """Of an engine that shares no line with grain."""
        engine = self.engine_file("planted", BUILD / "tests/faults/planted_engine", "declares=1", "kn=1.02")
        done = self.conformance(engine, "-k", "FollowsItsMirror", "--out", self.out)
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"most likely: .*k_n")
        self.assertNotIn("declared", self.results())  # some of the checks cannot say what none examines

    def test_settings_of_its_file_reach_every_load(self):
        load = "def load(self, scene, arrays, settings):\n"
        engine = self.changed_example(
            '"settings": [],\n', '"settings": [{"name": "loudness", "default": 0.0, "unit": "-", "doc": "-", "choices": []}],\n',
            load, f"{load}        assert settings['loudness'] == 2.0\n",
        )  # fmt: skip
        plain = engine.read_text(encoding="utf-8")
        engine.write_text(f"{plain}[settings]\nloudness = 2.0\n", encoding="utf-8")
        for check in ("DefaultsSpoken", "WorkersAgree", "LivesOn", "EffectsAreThose"):
            self.assert_status(self.conformance(engine, "-k", check), HELD)
        engine.write_text(f"{plain}[settings]\nloudnes = 2.0\n", encoding="utf-8")
        self.assert_one_error(
            self.conformance(engine, "-k", "Flies"), BAD_INPUT,
            "numpy: [settings] of its file: there is no setting 'loudnes' (did you mean loudness?)",
        )  # fmt: skip

    def test_worker_in_python_has_checkpoints(self):
        """As adapters/worker/README.md says: all of the engine, as it is."""
        kept = "    def checkpoint(self, file):\n        pickle.dump(vars(self), open(file, 'wb'))\n\n"
        kept += "    def restore(self, file):\n        vars(self).update(pickle.load(open(file, 'rb')))\n\n"
        engine = self.changed_example(
            "import sys\n", "import pickle\nimport sys\n", '"settings": [],', '"settings": [], "checkpoints": True,',
            "    def stats(self):\n", f"{kept}    def stats(self):\n",
        )  # fmt: skip
        done = self.conformance(engine, "-k", "CheckpointsGoOn")
        self.assert_status(done, HELD)
        self.assertIn("1 of 1 checks passed", done.stdout)

    def test_checks_beyond_the_time_given_are_not_tried_and_not_passed(self):
        done = self.run_program("conformance", PYTHON, "--budget", "3s", "--out", self.out, "--quiet")
        self.assert_status(done, FELL_SHORT)
        rows = self.results()["checks"]
        outcomes = [row["outcome"] for row in rows]
        self.assertIn("passed", outcomes)
        self.assertEqual("not_tried", outcomes[-1])
        self.assertIn("lockstep", [row["part"] for row in rows if row["outcome"] == "not_tried"])
        self.assertRegex(done.stderr, rf"{outcomes.count('not_tried')} of {len(rows)} checks were not tried")
        self.assertIn("time of --budget", (self.out / "junit.xml").read_text(encoding="utf-8"))

    def test_engine_that_breaks_down_is_status_3(self):
        engine = self.changed_example("def advance(self, t):\n", "def advance(self, t):\n        raise SystemExit(3)\n")
        done = self.conformance(engine, "-k", "Flies")
        self.assertIn("broke down: FliesStraight", done.stdout)
        self.assert_one_error(done, ENGINE_FAILED, "ended (exit status 3) during advance")

    def test_snapshot_that_cannot_be_is_taken_by_no_command(self):
        engine = self.changed_example(*LEFT_OUT)
        done = self.conformance(engine, "-k", "SnapshotsAreSound")
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"failed: SnapshotsAreSound[\s\S]*no contact of disk \d+ with (wall )?disk \d+, which overlap by")
        short = settings(
            preparation__packings=1, averaging__settle_rotations=0.002, averaging__rotations=0.002,
            averaging__snapshots_per_rotation=2000, run__mirrors="false",
        )  # fmt: skip
        for command, engines, status in (
            (("compare", COUETTE, *short), f"grain,{engine}", ENGINE_FAILED), (ONE_STATE, engine, ENGINE_FAILED),
            (("collide", COLLISION, "-k", "*spring*", *settings(collision__psi=[0.5], collision__steps_per_contact=[50])), engine, ENGINE_FAILED),
            (("stability", CASES / "hard", "-k", "billiard-break*"), engine, FELL_SHORT),
        ):  # fmt: skip
            with self.subTest(command=command[0]):
                self.out = self.folder / command[0]
                self.assert_status(self.run_program(*command, "--engines", engines, "--out", self.out), status)
                self.assertRegex(
                    json.dumps(self.results()), r"numpy, [^\"]+ at t = \S+ s: its snapshot cannot be: no contact of disk \d+ with"
                )
                if command[0] == "compare":
                    states = {run["engine"]: run["status"] for run in self.results()["runs"]}
                    self.assertEqual({"grain": "finished", "numpy": "failed"}, states)


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


class EngineFile(SystemTest):
    def lockstep(self, *engines):
        return self.run_program(*ONE_STATE, *engines, "--out", self.out)

    def test_engine_of_the_command_line(self):
        program = PYTHON.with_name("engine.py")
        done = self.lockstep(f"--engine=mine=python3 {program}", "--engines=mine")
        self.assert_status(done, HELD)
        self.assertIn("mine follows the law that it declares.", done.stdout)

    def test_starts_once_where_it_is_only_asked(self):
        """Starting one takes up to seconds; its scene's conventions, law and steps are asked for one after the other."""
        counted = self.changed_example("import numpy as np\n", "import numpy as np\n\nwith open('starts', 'a') as f:\n    f.write('x')\n")
        starts = counted.parent / "starts"
        for command in (("check", "--no-timing"), ("compare", "--out", self.out, "--dry-run"), ("compare", "--out", self.out)):
            with self.subTest(command=command):
                starts.unlink(missing_ok=True)
                strict = [] if "--dry-run" in command or command[0] == "check" else settings(law__normal="hertz")
                done = self.run_program(command[0], COUETTE, "--engines", f"grain,{counted}", *command[1:], *strict)
                self.assert_status(done, BAD_INPUT if strict else HELD)
                # A case that cannot be read needs no engine.
                self.assertEqual("" if strict else "x", starts.read_text(encoding="utf-8") if starts.exists() else "")

    def test_beside_an_engine_of_the_program_and_its_own_mirror(self):
        few = ["-k", "spring_dashpot-tension", *settings(collision__psi=[0.0, 1.0, 4.0], collision__steps_per_contact=50)]
        self.held("collide", COLLISION, "--engines", f"grain,{PYTHON}", "--out", self.out, "--quiet", *few)
        self.assertEqual({"grain", "numpy", "grain-as-numpy"}, {row["engine"] for row in self.rows("collisions.csv")})
        own = [row for row in self.rows("collisions.csv") if row["engine"] == "numpy"]
        self.assertEqual({"held"}, {row["verdict_declared"] for row in own})
        self.assertLess(max(float(row["own_scheme"] or 0) for row in own), 1e-12)

    def test_another_program_under_the_same_version_is_another_engine(self):
        mine = self.changed_example()
        self.assert_status(self.lockstep("--engines", mine), HELD)
        program = mine.with_name("engine.py")
        program.write_text(program.read_text(encoding="utf-8") + "# changed\n", encoding="utf-8")
        self.assert_one_error(self.lockstep("--engines", mine), BAD_INPUT, "program")

    def test_file_that_is_wrong(self):
        command = 'command = ["python3", "engine.py"]\n'
        for text, *fragments in (
            (command, "mine.toml", "name is missing"), ('name = "mine"\n', "mine.toml", "command is missing"),
            (f'name = "grain"\n{command}', 'name = "grain"', "is taken"), (f'name = "mine.toml"\n{command}', "is that of a file"),
            (f'name = "a b"\n{command}', "must be of letters"),
            (f'name = "mine"\nfoldr = "x"\n{command}', "foldr", "did you mean folder?"),
            (f'name = "mine"\nfolder = "nowhere"\n{command}', "is no folder"),
            (f'name = "mine"\nmemory = 2\n{command}', "memory", "bytes"),
            ('name = "mine"\ncommand = ["no-such-program"]\n', "no-such-program", "PATH"),
        ):  # fmt: skip
            with self.subTest(text):
                self.assert_one_error(self.lockstep("--engines", self.write("mine.toml", text)), BAD_INPUT, *fragments)
        installed = self.folder / "engines/mine"
        installed.mkdir(parents=True)
        (installed / "mine.toml").write_text('name = "mine"\n', encoding="utf-8")
        done = self.run_program("engines", env={"CROSSGRAIN_DATA": str(self.folder)})
        self.assert_one_line(done, BAD_INPUT, "mine.toml", "command")

    def test_program_that_fails(self):
        greedy = self.changed_example("def step(self):\n", "def step(self):\n        np.ones(10**9)\n")
        greedy.write_text(greedy.read_text(encoding="utf-8") + "\n", encoding="utf-8")
        text = greedy.read_text(encoding="utf-8")
        greedy.write_text(f"memory = 3e9\n{text}", encoding="utf-8")
        done = self.lockstep("--engines", greedy)
        self.assert_status(done, ENGINE_FAILED)
        self.assertRegex(done.error_lines()[0], r"numpy, .*: (numpy\S*)?MemoryError|Unable to allocate")
        done = self.lockstep("--fresh", "--engines", self.engine_file("silent", "true"))
        self.assert_status(done, ENGINE_FAILED)
        self.assertIn("silent: ended (exit status 0) during hello", done.stderr)

    def test_planes_turn_with_their_body(self):
        case = self.write("turning.toml", TURNING)
        numpy = f"--engine=numpy=python3 {PYTHON.with_name('engine.py')}"
        ends = {}
        for name, arguments in (
            ("python", ("--engines", PYTHON)), ("cpp", ("--engines", CPP)), ("mirror", (numpy, "--engines=grain-as-numpy")),
        ):  # fmt: skip
            recording = self.folder / f"{name}.rec"
            self.held("record", case, *arguments, "--out", recording)
            ends[name] = last_disk(recording)
        self.assertGreater(ends["mirror"][1], 0.01)  # lifted by more than a radius
        self.assertLess(ends["mirror"][2], -1.0)  # it rolls
        for name in ("python", "cpp"):
            for value, of_mirror in zip(ends[name], ends["mirror"]):
                self.assertAlmostEqual(value, of_mirror, delta=1e-11 + 1e-9 * abs(of_mirror), msg=name)

    def test_scene_beyond_its_limits_is_refused_before_it_is_loaded(self):
        load = "def load(self, scene, arrays, settings):\n"
        mine = self.changed_example(
            '"settings": [],', '"settings": [], "plane_normals": "axis",', load, "def load(self, *_):\n        os.abort()\n"
        )
        case = self.write("turning.toml", TURNING)
        done = self.run_program("record", case, "--engines", mine, "--out", self.folder / "none.rec")
        self.assert_one_error(done, BAD_INPUT, "has planes along an axis only, and those of")
        self.assertFalse((self.folder / "none.rec").exists())


class Record(SystemTest):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "run.rec"

    def record(self, engine):
        return self.run_program("record", COLLISION, "--engines", engine, "--out", self.file, "-kspring_dashpot-tension")

    def replay(self, engine, *arguments):
        return self.run_program("replay", self.file, "--engines", engine, *arguments)

    def test_first_different_answer_of_a_changed_engine_is_found(self):
        done = self.record(PYTHON)
        self.assert_status(done, HELD)
        self.assertRegex(done.stdout, r"run\.rec: \d+ requests and answers of numpy 1 \(program \w+\)")
        done = self.replay(PYTHON)
        self.assert_status(done, HELD)
        self.assertIn("same answers to all", done.stdout)
        own = self.changed_example('law["kn"] * overlap', '1.001 * law["kn"] * overlap')
        done = self.replay(own)
        self.assert_status(done, FELL_SHORT)
        # The first snapshot shows disks apart: k_n does nothing before the second.
        self.assertRegex(done.stdout, r"request 5, snapshot, has the first different answer")
        self.assertRegex(done.stdout, r"  velocity\[\d+\]: then \S+, now \S+, differs by \S+; \d+ of \d+ differ")
        self.assert_status(self.replay(own, "--tolerance=0.1"), HELD)
        whole = self.file.read_bytes()
        for content in (whole[:-20], b"\n"):
            self.file.write_bytes(content)
            self.assert_status(self.replay(PYTHON), BAD_INPUT)

    def test_failure_is_recorded_and_comes_again(self):
        own = self.changed_example("def step(self):\n", "def step(self):\n        if self.steps == 9: raise SystemExit(7)\n")
        done = self.record(own)
        self.assert_one_error(done, ENGINE_FAILED, "ended (exit status 7) during advance")
        self.assertIn("4 requests and answers", done.stdout)
        done = self.replay(own)
        self.assert_status(done, ENGINE_FAILED)
        self.assertIn("same answers as far as request 4, where it fails", done.stdout)
        done = self.replay(PYTHON)
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"failure: then .*exit status 7.*, now an answer")


SCHEMA = json.loads((HOME / "adapters/worker/protocol.schema.json").read_text(encoding="utf-8"))


def faults(part, message):
    """What a part of the schema, "request" or "answers/load", says against a message."""
    checker = jsonschema.Draft202012Validator(SCHEMA | {"$ref": f"#/$defs/{part}"})
    return [f"{error.json_path}: {error.message}" for error in checker.iter_errors(message)]


GONE = object()


def altered(message, value, *keys):
    """A copy with another value where the keys lead, or without it."""
    changed = copy.deepcopy(message)
    place = changed
    for key in keys[:-1]:
        place = place[key]
    if value is GONE:
        del place[keys[-1]]
    else:
        place[keys[-1]] = value
    return changed


class Schema(SystemTest):
    """The schema of the worker protocol holds what both sides say, and refuses what the program refuses."""

    def recorded(self, engine, case, *arguments):
        recording = self.folder / "run.rec"
        recording.unlink(missing_ok=True)
        self.held("record", case, "--engines", engine, "--out", recording, "--looks=2", *arguments)
        exchanges = [(request, answer) for request, answer, _ in recorded_exchanges(recording)]
        for request, _ in exchanges:
            if request["request"] in ("load", "snapshot"):
                request["file"] = "/somewhere"  # recordings leave it out
        return exchanges

    def test_holds_what_both_sides_say(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)
        spring, pile = "-kspring_dashpot-tension", CASES / "hard/pile.toml"
        for engine, case, *arguments in (
            (PYTHON, COLLISION, spring), (CPP, COLLISION, spring), (PYTHON, pile, "--time=0.001"),
            ("grain", pile, "--time=0.001", "--set=run.energy_ledger=true"), ("grain", COLLISION),
            ("box2d-impulse", CASES / "collision/hard-sphere.toml"),
        ):  # fmt: skip
            with self.subTest(engine=str(engine), case=case.name):
                seen = set()
                for request, answer in self.recorded(engine, case, *arguments):
                    seen.add(request["request"])
                    self.assertEqual([], faults("request", request))
                    self.assertEqual([], faults(f"answers/{request['request']}", answer))
                self.assertEqual({"hello", "load", "advance", "snapshot", "stats"}, seen)

    def test_has_every_law_option(self):
        """The in-house engine has them all."""
        rolls = ['law.rolling="spring"', "law.kr=1e3", "law.mu_r=0.1"]
        coheres = ['law.cohesion="area"', "law.kc=1.0"]
        (_, hello), (load, _), *_ = self.recorded(
            "grain", CASES / "hard/pile.toml", "--time=0.001", *(f"--set={key}" for key in rolls + coheres)
        )
        options = {name: set(of["enum"]) for name, of in SCHEMA["$defs"]["lawOptions"].items()}
        declared = hello["capabilities"]["law_options"]
        self.assertEqual(options, {name: set(values) for name, values in declared.items()})
        in_space = {"spring_turn", "spring_twist"}  # not of this scene, which is in the plane
        self.assertEqual(set(SCHEMA["$defs"]["law"]["properties"]) - in_space, set(load["scene"]["law"]))
        self.assertEqual(set(SCHEMA["$defs"]["effect"]["enum"]), set(hello["capabilities"]["effects"]))

    def test_refuses_what_is_wrong(self):
        said = {request["request"]: (request, answer) for request, answer in self.recorded(PYTHON, COLLISION, "-kspring_dashpot-tension")}
        for name, value, *keys in (
            ("hello", GONE, "capabilities", "version"), ("hello", ["red"], "capabilities", "law_options", "tension"),
            ("hello", [], "capabilities", "law_options", "tension"), ("hello", ["red"], "capabilities", "law_options", "colour"),
            ("hello", "sometimes", "capabilities", "effects", "gravity"), ("hello", "optional", "capabilities", "effects", "levity"),
            ("load", 0.0, "realised", "dt"), ("load", GONE, "realised", "deviations"), ("advance", GONE, "time"),
            ("snapshot", GONE, "snapshot", "contact_time"), ("snapshot", "f32", "arrays", 0, "type"),
            ("snapshot", -1, "arrays", 0, "count"), ("stats", -1, "stats", "steps"),
        ):  # fmt: skip
            with self.subTest(request=name, keys=keys):
                self.assertNotEqual([], faults(f"answers/{name}", altered(said[name][1], value, *keys)))
        self.assertNotEqual([], faults("answers/load", {"ok": False, "kind": "tired", "what": "no"}))
        scene = said["load"][0]
        for wrong in (
            altered(scene, 1, "scene", "colour"), altered(scene, GONE, "scene", "law", "history"),
            altered(scene, [{"motion": {"kind": "spinning"}}], "scene", "bodies"), {"request": "jump"},
        ):  # fmt: skip
            self.assertNotEqual([], faults("request", wrong))


if __name__ == "__main__":
    unittest.main()
