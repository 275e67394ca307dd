"""What is read from results: a table can only be as right as this."""

import re
import tomllib
import unittest
from pathlib import Path

import false_alarms
import publish
import reading
import table

KN = {"term": "kn|k_n", "amount": [0.008, 0.0125], "checks": ["HeadOnCollision"]}
CUT = {"term": "tension = cut"}
LOST = {"term": "tangential_spring", "says": "contact"}


def conformance(cause, *failed, broke=()):
    rows = [{"check": name, "what": "it holds", "detail": "off by 1", "outcome": "failed"} for name in failed]
    rows += [{"check": "Any", "what": "it holds", "detail": said, "outcome": "broke_down"} for said in broke]
    return {"cause": cause, "checks": rows}


def lockstep(name, amount=None, failure=""):
    term = {"name": name, "amount": amount, "unexplained": 0.1} if name else None
    return {"lockstep": {"rows": [{"engine": "mine", "term": term, "failure": failure}]}}


class Faults(unittest.TestCase):
    def test_every_check_that_a_fault_names_is_one_of_conformance(self):
        here = Path(__file__).parent
        sources = (here / "../../studies/conformance").glob("*.cpp")
        checks = {name for file in sources for name in re.findall(r'"([A-Z][A-Za-z]+)"', file.read_text())}
        for file in ("faults.toml", "audit.toml", "resistance.toml", "space.toml", "elsewhere.toml"):
            for fault in tomllib.loads((here / file).read_text()).get("fault", []):
                self.assertLessEqual(set(fault.get("checks", [])), checks, f"{file}: {fault['name']}")


class Named(unittest.TestCase):
    def named(self, command, results, fault):
        return reading.named(command, results, "mine", fault, "")

    def test_a_constant_is_named_by_its_symbol_and_its_amount(self):
        said = "lockstep's closest term: k_n {} (leaves 3.08 % of the separation)"
        self.assertEqual("rightly", self.named("conformance", conformance(said.format("+1.01 %")), KN))
        self.assertEqual("rightly", self.named("conformance", conformance(said.format("+1.01×10⁰ %")), KN))
        self.assertEqual("wrongly", self.named("conformance", conformance(said.format("−1.01 %")), KN))
        self.assertEqual("wrongly", self.named("conformance", conformance(said.format("+10.1 %")), KN))
        self.assertEqual("rightly", self.named("lockstep", lockstep("kn", 0.0101), KN))
        self.assertEqual("wrongly", self.named("lockstep", lockstep("kt", 0.0101), KN))

    def test_conventions_and_missing_effects_are_terms(self):
        said = "found from outside: it has tension = cut, and declares allow"
        self.assertEqual("rightly", self.named("conformance", conformance(said), CUT))
        self.assertEqual("wrongly", self.named("lockstep", lockstep("tension = allow"), CUT))
        self.assertEqual("rightly", self.named("lockstep", lockstep("without tangential_spring"), LOST))

    def test_the_first_statement_decides_and_checks_where_there_is_none(self):
        wrong = "lockstep's closest term: inertia +228 % (leaves 28.8 % of the separation); found from outside: its k_n is +1 % off the case's"
        self.assertEqual("wrongly", self.named("conformance", conformance(wrong, "HeadOnCollision"), KN))
        self.assertEqual("by check", self.named("conformance", conformance("", "HeadOnCollision"), KN))
        self.assertEqual("", self.named("conformance", conformance("", "FliesStraight"), KN))

    def test_a_place_is_no_part_of_a_term_and_torque_is_inertia(self):
        self.assertEqual([("k_n", 0.01)], list(reading._statements("k_n +1 %, at planes, 2 s after load")))
        self.assertEqual([("gravity", -0.05)], list(reading._statements("gravity -5 %, 2 s after load")))
        said = "rolling: its spring does not follow n as that turns: nothing takes out its part along n"
        self.assertEqual([("spring does not follow n as that turns: nothing takes out its part along n", None)], list(reading._statements(said)))
        self.assertEqual([("inertia", 1.0)], list(reading._statements("torque -50 %, of two disks")))

    def test_a_later_term_may_ask_for_amount_and_place(self):
        fault = {"term": "never", "later_term": "^µ -100 %, at (wall disks|planes)"}
        self.assertEqual("rightly", self.named("conformance", conformance("µ -100 %, at planes; k_t -10 %"), fault))
        self.assertEqual("wrongly", self.named("conformance", conformance("µ -100 %, of two disks"), fault))
        self.assertEqual("wrongly", self.named("conformance", conformance("k_t -10 %; µ -100 %, at planes"), fault))

    def test_what_is_said_of_a_run_that_broke_down_counts(self):
        self.assertEqual("rightly", self.named("lockstep", lockstep(None, failure="contact 0 is not there"), LOST))
        self.assertEqual("", self.named("lockstep", lockstep(None, failure="it died"), LOST))

    def test_commands_that_name_nothing_name_nothing(self):
        self.assertEqual("", self.named("collide", lockstep("kn", 0.0101), KN))


class Found(unittest.TestCase):
    def test_bad_input_and_success_are_no_finds(self):
        self.assertEqual([False, True, False, True, False], [reading.found(status) for status in (0, 1, 2, 3, None)])

    def test_a_model_that_differs_is_no_fault_of_the_implementation(self):
        def results(state):
            return {"overview": {"columns": [{"name": "own law"}], "rows": [{"name": "mine", "cells": [{"state": state}]}]}}

        self.assertEqual("model", reading.blame("collide", 1, results("model_difference"), "mine"))
        self.assertEqual("implementation", reading.blame("collide", 1, results("bad"), "mine"))
        self.assertEqual("", reading.blame("collide", 0, results("good"), "mine"))


class Table(unittest.TestCase):
    """Six runs of three faults and a right engine, and one that has not been."""

    def row(self, fault, command, found="no", named="", status="0", control=""):
        return {"list": "faults", "fault": fault, "control": control, "what": f"{fault} is off", "command": command, "status": status,
                "found": found, "cpu_s": "2.0", "put_down_to": "", "named": named, "build": "1", "sentence": ""}

    def setUp(self):
        self.rows = [self.row("right", "conformance", control="yes"), self.row("kn", "conformance", "yes", "rightly"),
                     self.row("mu", "conformance", "yes", "by check"), self.row("gn", "conformance"),
                     self.row("kn", "collide"), self.row("mu", "collide", "yes"), self.row("gn", "collide", status=table.not_run)]

    def test_totals_count_what_was_run(self):
        lines = table.totals(self.rows).splitlines()
        self.assertEqual("| `conformance` | 2 of 3 | 2 of 3 | 1 | 1 | 0 | 0 | 2.0 s | 0 of 1 |", lines[2])
        self.assertEqual("| `collide` | 1 of 2 | 1 of 2 | – | – | – | – | 2.0 s | – |", lines[3])

    def test_what_no_command_finds_escapes(self):
        self.assertEqual({"faults": ["gn is off"]}, table.escapes(self.rows))

    def test_each_fault_has_a_mark_for_each_command(self):
        self.assertEqual(["| right is off (`right`) | · | – |", "| kn is off | ✓ named 2 s | · |", "| mu is off | ✓ by check 2 s | ✓ 2 s |", "| gn is off | · | – |"],
                         table.by_fault(self.rows, "faults").splitlines()[2:])

    def test_what_an_unstable_run_says_of_an_engine_is_what_it_says_beside_the_in_house_engine(self):
        def results(**verdicts):
            return {"runs": [{"engine": engine, "case": "pile", "variant": "a", "verdict": verdict} for engine, verdict in verdicts.items()]}

        self.assertTrue(reading.accused("stability", 1, results(grain="stable", mine="unstable"), "mine"))
        self.assertFalse(reading.accused("stability", 1, results(grain="unstable", mine="unstable"), "mine"))
        self.assertTrue(reading.accused("stability", 1, results(mine="unstable"), "mine"))
        self.assertTrue(reading.accused("stability", 3, results(grain="unstable", mine="unstable"), "mine"))

    def test_collisions_that_nobody_can_judge_accuse_nobody(self):
        def results(*states):
            return {"overview": {"rows": [{"name": "mine", "cells": [{"state": state} for state in states]}]}}

        self.assertFalse(reading.accused("collide", 1, results("good", "not_measured"), "mine"))
        self.assertTrue(reading.accused("collide", 1, results("good", "bad"), "mine"))
        self.assertTrue(reading.accused("collide", 3, {}, "mine"))
        self.assertFalse(reading.accused("lockstep", 1, results("not_measured"), "mine"))
        for state in ("bad", "model_difference"):
            self.assertTrue(reading.accused("lockstep", 1, results(state), "mine"))
        self.assertTrue(reading.accused("lockstep", 3, {}, "mine"))


class FalseAlarms(unittest.TestCase):
    def test_the_interval_is_that_of_clopper_and_pearson(self):
        """Closed forms without alarms and with nothing else; a value of their table between."""
        self.assertEqual(0.0, false_alarms.interval(0, 200)[0])
        self.assertAlmostEqual(1.0 - 0.025 ** (1 / 200), false_alarms.interval(0, 200)[1], 12)
        self.assertEqual(1.0, false_alarms.interval(5, 5)[1])
        self.assertAlmostEqual(0.025 ** (1 / 5), false_alarms.interval(5, 5)[0], 12)
        low, high = false_alarms.interval(1, 10)
        self.assertAlmostEqual(0.0025, low, 4)
        self.assertAlmostEqual(0.4450, high, 4)

    def test_pages_say_what_the_tables_say(self):
        same = publish.sections(publish.trust) in (publish.trust / "README.md").read_text()
        self.assertTrue(same, "reports/curated/trust/README.md is not what publish.py makes of the tables beside it")
        for name, marks in publish.sentences(publish.trust).items():
            for mark, sentence in marks.items():
                self.assertEqual(sentence, publish.marked((false_alarms.project / name).read_text(), mark))

    def test_alarms_are_counted_for_each_command(self):
        rules = {"collide": {"promised": 0.0}, "compare": {"promised": 0.05}, "disguise": {}}
        records = [{"command": "collide", "alarm": alarm, "cpu": 0.5} for alarm in (False, True, False, False)]
        (row,) = false_alarms.rates(records, rules)
        self.assertEqual(("collide", 4, 1, "0.2500", "2"), (row["command"], row["trials"], row["alarms"], row["rate"], row["cpu_s"]))

    def test_a_trial_is_the_same_for_the_same_number(self):
        kinds = {"turn": [0.0, 1.0], "order": "seed", "mirror": [1]}
        disguises = [false_alarms.disguise_of(false_alarms.random.Random("collide 7"), kinds) for _ in range(2)]
        self.assertEqual(disguises[0], disguises[1])
        self.assertTrue(disguises[0])


if __name__ == "__main__":
    unittest.main()
