"""The schema of the worker protocol holds what both sides say, and refuses what the program refuses.

The messages are those of recorded runs: of both examples, of the in-house engine and of one of rigid disks.
"""

import copy
import json
import os
import pathlib
import unittest

import jsonschema

from harness import CASES, HELD, SystemTest, recorded_exchanges

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCHEMA = json.loads((ROOT / "adapters/worker/protocol.schema.json").read_text(encoding="utf-8"))
PYTHON = ROOT / "examples/python/engine.toml"
CPP = pathlib.Path(os.environ["CROSSGRAIN_BUILD"]) / "examples/cpp/engine.toml"
FIGURE = CASES / "collision/figure-4-3.toml"


def faults(part, message):
    """What a part of the schema, "request" or "answers/load", says against a message."""
    checker = jsonschema.Draft202012Validator(SCHEMA | {"$ref": f"#/$defs/{part}"})
    return [f"{error.json_path}: {error.message}" for error in checker.iter_errors(message)]


def answer_faults(request, answer):
    return faults(f"answers/{request['request']}", answer)


def without(message, *keys):
    """A copy that lacks what the keys lead to."""
    changed = copy.deepcopy(message)
    place = changed
    for key in keys[:-1]:
        place = place[key]
    del place[keys[-1]]
    return changed


def with_value(message, value, *keys):
    changed = copy.deepcopy(message)
    place = changed
    for key in keys[:-1]:
        place = place[key]
    place[keys[-1]] = value
    return changed


class Protocol(SystemTest):
    def recorded(self, engine, case, *arguments):
        recording = self.folder / "run.rec"
        recording.unlink(missing_ok=True)
        done = self.run_program(
            "record", case, "--engines", engine, "--out", recording, "--looks=2", *arguments
        )
        self.assert_status(done, HELD)
        said = [(request, answer) for request, answer, _ in recorded_exchanges(recording)]
        for request, _ in said:
            if request["request"] in ("load", "snapshot"):
                request["file"] = "/somewhere"  # recordings leave it out
        return said

    def test_the_schema_is_one(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)

    def test_it_holds_what_both_sides_say(self):
        spring = "-kspring_dashpot-tension"
        for engine, case, *arguments in (
            (PYTHON, FIGURE, spring),
            (CPP, FIGURE, spring),
            (PYTHON, CASES / "hard/pile.toml", "--time=0.001"),
            ("grain", CASES / "hard/pile.toml", "--time=0.001", "--set=run.energy_ledger=true"),
            ("grain", FIGURE),
            ("box2d-impulse", CASES / "collision/hard-sphere.toml"),
        ):
            with self.subTest(engine=str(engine), case=case.name):
                seen = set()
                for request, answer in self.recorded(engine, case, *arguments):
                    seen.add(request["request"])
                    self.assertEqual([], faults("request", request))
                    self.assertEqual([], answer_faults(request, answer))
                self.assertEqual({"hello", "load", "advance", "snapshot", "stats"}, seen)

    def test_it_has_every_law_option(self):
        """The in-house engine has them all."""
        (_, hello), (load, _), *_ = self.recorded("grain", FIGURE)
        options = {name: set(of["enum"]) for name, of in SCHEMA["$defs"]["lawOptions"].items()}
        declared = hello["capabilities"]["law_options"]
        self.assertEqual(options, {name: set(values) for name, values in declared.items()})
        self.assertEqual(set(SCHEMA["$defs"]["law"]["properties"]), set(load["scene"]["law"]))
        effects = set(SCHEMA["$defs"]["effect"]["enum"])
        self.assertEqual(effects, set(hello["capabilities"]["effects"]))

    def test_it_refuses_what_is_wrong(self):
        said = {
            request["request"]: (request, answer)
            for request, answer in self.recorded(PYTHON, FIGURE, "-kspring_dashpot-tension")
        }
        hello, load, snapshot, stats = (said[name][1] for name in ("hello", "load", "snapshot", "stats"))
        for name, wrong in (
            ("hello", without(hello, "capabilities", "version")),
            ("hello", with_value(hello, ["red"], "capabilities", "law_options", "tension")),
            ("hello", with_value(hello, [], "capabilities", "law_options", "tension")),
            ("hello", with_value(hello, ["red"], "capabilities", "law_options", "colour")),
            ("hello", with_value(hello, "sometimes", "capabilities", "effects", "gravity")),
            ("hello", with_value(hello, "optional", "capabilities", "effects", "levity")),
            ("load", with_value(load, 0.0, "realised", "dt")),
            ("load", without(load, "realised", "deviations")),
            ("load", {"ok": False, "kind": "tired", "what": "no"}),
            ("advance", {"ok": True, "tmie": 1.0}),
            ("snapshot", without(snapshot, "snapshot", "contact_time")),
            ("snapshot", with_value(snapshot, "f32", "arrays", 0, "type")),
            ("snapshot", with_value(snapshot, -1, "arrays", 0, "count")),
            ("stats", with_value(stats, -1, "stats", "steps")),
        ):
            with self.subTest(request=name):
                self.assertNotEqual([], faults(f"answers/{name}", wrong))
        scene = said["load"][0]
        for wrong in (
            with_value(scene, 1, "scene", "colour"),
            without(scene, "scene", "law", "history"),
            with_value(scene, [{"motion": {"kind": "spinning"}}], "scene", "bodies"),
            {"request": "jump"},
        ):
            with self.subTest(request="load"):
                self.assertNotEqual([], faults("request", wrong))


if __name__ == "__main__":
    unittest.main()
