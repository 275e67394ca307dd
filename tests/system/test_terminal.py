"""Progress and colours: redrawn in place with the time left on a terminal, plain lines elsewhere."""

import json
import re
import tomllib
import unittest

from harness import BAD_INPUT, COUETTE, HARD_SPHERE, HELD, SystemTest, on_terminal, settings

ESCAPE = re.compile(r"\x1b\[\d+m")


class NotATerminal(SystemTest):
    def test_progress_is_plain_lines_that_count_finished_pieces(self):
        # Pairs of equal runs side by side end almost at once.
        done = self.compare(*settings(averaging__rotations=0.02, preparation__packings=8), "--jobs=2")
        self.assert_status(done, HELD)
        self.assertNotRegex(done.stdout + done.stderr, r"[\r\x1b]")
        stage = done.stderr.partition("running engines: 8 to do\n")[2]
        self.assertEqual(list("12345678"), re.findall(r"(?m)^\[(\d)/8\]", stage), str(done))

    def test_quiet_and_json(self):
        done = self.compare(*settings(averaging__rotations=0.02), "--json")
        self.assertEqual(f"{self.out / 'results.json'}\n", done.stdout)
        self.assertEqual("", self.compare(*settings(averaging__rotations=0.02), "--quiet").stderr)


class Terminal(SystemTest):
    COLUMNS = 60

    def test_progress_redraws_one_row_with_growing_percentages(self):
        command = ["compare", COUETTE, "--engines", "grain,box2d-penalty", "--out", self.out, "--quick", "--jobs=2"]
        more = [*settings(averaging__rotations=0.15, run__mirrors="false")]
        status, drawn = on_terminal(self.COLUMNS, "stderr", [*command, *more])
        self.assertEqual(HELD, status, drawn)
        # Which of the two it says is a matter of the machine's speed; tests/studies/executor_test.cpp has the words.
        self.assertRegex(drawn, r"running engines: +\d+ %, (\d+ s left|estimating the time left)")
        # Every redrawing starts where the last one did, and fits in one row of the terminal.
        rows = re.findall(r"\r\x1b\[K(running engines:[^\r\n]*)", drawn)
        self.assertGreater(len(rows), 2)
        self.assertLessEqual(max(map(len, rows)), self.COLUMNS)
        self.assertTrue(drawn.endswith("\r\x1b[K"), "nothing half drawn is left in the last row")
        percent = [int(number) for number in re.findall(r"running engines: +(\d+) %", drawn)]
        self.assertEqual(sorted(percent), percent)
        self.assertEqual((HELD, ""), on_terminal(self.COLUMNS, "stderr", [*command, *more, "--quiet"]))

    def test_matrix_is_coloured_and_fits(self):
        command = ["collide", HARD_SPHERE, "--engines", "grain", "--out", self.out, "--quiet"]
        plain = self.run_program(*command).stdout
        self.assertRegex(plain, r"(?m)^engine +cases passed [\s\S]*^grain +✓ (\d+) of \1 ")
        self.assertNotIn("\x1b", plain)

        def drawn(columns, **changes):
            status, printed = on_terminal(columns, "stdout", command, {"NO_COLOR": None} | changes)
            self.assertEqual(HELD, status, printed)
            return printed.replace("\r\n", "\n")

        coloured = drawn(1000)
        self.assertRegex(coloured, r"\x1b\[32m✓ \d+ of")
        self.assertEqual(plain, ESCAPE.sub("", coloured))
        self.assertEqual(plain, drawn(1000, NO_COLOR="1"))
        for columns in (50, 80):
            narrow = ESCAPE.sub("", drawn(columns)).partition("report: ")[0]
            self.assertLessEqual(max(map(len, narrow.splitlines())), columns)
            self.assertEqual(narrow, self.run_program(*command, env={"COLUMNS": str(columns)}).stdout.partition("report: ")[0])


class Lines(SystemTest):
    """On a terminal no line is wider; a file or a pipe gets each refusal, note and comment in one line."""

    def assert_wraps(self, stream, command, start):
        done = self.run_program(*command)
        whole = next(line for line in getattr(done, stream).splitlines() if line.startswith(start))
        self.assertGreater(len(whole), 80)
        _, drawn = on_terminal(80, stream, command)
        lines = drawn.replace("\r\n", "\n").splitlines()
        self.assertLessEqual(max(map(len, lines)), 80, drawn)
        first = next(k for k, line in enumerate(lines) if line.startswith(start))
        comment = "# " if start.startswith("#") else ""
        told = [line for line in lines[first:] if line.startswith(comment)]
        self.assertIn(" ".join(whole.split()), " ".join(" ".join(line.removeprefix(comment) for line in told).join([comment, ""]).split()))

    def test_refusals(self):
        for command in (["calibrate"], ["compare", COUETTE, "--engines", "grain"]):
            self.assert_wraps("stderr", command, "crossgrain: ")

    def test_comments(self):
        command = ["calibrate", "--en", "0.9", "--et", "0.8", "--tc", "1e-3", "--mass", "1e-3"]
        _, drawn = on_terminal(60, "stdout", command)
        for line in drawn.splitlines():
            self.assertLessEqual(len(line), 60)
        plain = self.run_program(*command).stdout
        self.assertEqual(tomllib.loads(plain), tomllib.loads(drawn.replace("\r\n", "\n")))

    def test_many_engines_are_timed_with_a_line_before(self):
        done = self.run_program("check", COUETTE, "--engines", "grain,box2d-penalty,box2d-impulse,chipmunk,ode,bullet")
        self.assertRegex(done.stdout, r"^timing steps of \d+ engines; --no-timing leaves that out\n")
        for fewer in (["--no-timing"], ["--quiet"], ["--json"], ["--engines", "grain"]):
            words = ["check", COUETTE, *(fewer if "--engines" in fewer else ["--engines", "grain,box2d-penalty", *fewer])]
            self.assertNotIn("timing steps", self.run_program(*words).stdout, fewer)

    def test_parts_that_are_not_asked_for_are_not_counted(self):
        done = self.run_program("conformance", "grain", "-k", "FliesStraight")
        self.assertEqual(["1/1"], re.findall(r"(?m)^\[(\S+)\]", done.stderr), done.stderr)
        self.assertIn("suite: 1 check", done.stderr)
        self.assertNotIn("lockstep", done.stderr)


class Summaries(SystemTest):
    """At 80 columns."""

    WIDTH = {"COLUMNS": "80"}

    def assert_fits(self, text):
        self.assertLessEqual(max(map(len, text.splitlines())), 80, text)

    def test_compare_has_a_line_for_each_engine_and_value_difference_and_verdict_of_each_endpoint(self):
        command = ["compare", COUETTE, "--engines", "grain,box2d-penalty", "--out", self.out, "--quick", "--no-causes"]
        command += settings(averaging__rotations=0.05, preparation__packings=4)
        done = self.run_program(*command, env=self.WIDTH)
        self.assert_fits(done.stdout)
        self.assertLessEqual(len(done.stdout.splitlines()), 40, done.stdout)
        rows = [row for row in self.rows("endpoints.csv") if row["kind"] == "peer"]
        self.assertEqual(9, len(rows))
        self.assertEqual(9, len(re.findall(r"(?m)^\S[^:]*: grain \S+.*, margin \S+", done.stdout)))
        answers = re.findall(r"(?m)^  box2d-penalty +\S+ +[+−]?\S+ \(\S+ to \S+\)\S* +\S (.*)$", done.stdout)
        agree = {"no_difference_seen": "agree", "small_difference": "agree"}
        self.assertEqual([agree.get(row["answer"], row["answer"]) for row in rows], answers)
        self.assertEqual(2, len(re.findall(r"(?m)^(?:grain|box2d-penalty)  ", done.stdout)))
        self.assertNotIn("evaluated through", done.stdout)
        again = self.run_program(*command, env=self.WIDTH)
        self.assertEqual(done.stdout, again.stdout)
        self.assertRegex(again.stderr, r"(?m)^\d+ packings and \d+ runs kept$")
        self.assertNotRegex(again.stderr, r"(?m)^\[\d|to do$")
        everything = self.run_program(*command, "-v", env=self.WIDTH).stdout
        self.assert_fits(everything)
        self.assertIn("evaluated through", everything)

    def test_engines_have_a_line_each_and_one_is_printed_in_full(self):
        table = self.held("engines", env=self.WIDTH).stdout
        self.assert_fits(table)
        known = json.loads(self.held("engines", "--json").stdout)
        for engine in known:
            lines = re.findall(rf"(?m)^{re.escape(engine['name'])}  .*$", table)
            self.assertEqual(0 if engine["mirrors"] else 1, len(lines), engine["name"])
            if not lines:
                continue
            if "missing" in engine:
                self.assertIn("missing: ", lines[0])
            else:
                self.assertIn(engine["kind"], lines[0])
                self.assertEqual(engine["dimensions"], engine["capabilities"].get("dimensions", [2]))
                self.assertEqual({2: "disk", 3: "sphere"}[engine["dimensions"][0]], engine["shapes"][0])
        impulse = next(engine for engine in known if engine["name"] == "box2d-impulse")
        self.assertEqual((["disk", "polygon", "capsule"], "rigid"), (impulse["shapes"], impulse["kind"]))
        full = self.held("engines", "box2d-impulse", env=self.WIDTH).stdout
        self.assert_fits(full)
        self.assertRegex(full, r"(?m)^  bodies +disk, polygon, capsule$")
        self.assertNotIn("grain:", full)
        self.assert_one_line(self.run_program("engines", "box2d"), BAD_INPUT, "there is no engine 'box2d'")


if __name__ == "__main__":
    unittest.main()
