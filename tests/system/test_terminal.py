"""Progress: redrawn in place with the time left on a terminal, plain lines elsewhere."""

import re
import unittest

from harness import COUETTE, HELD, SystemTest, on_terminal, settings

CONTROL = re.compile(r"[\r\x1b]")


class NotATerminal(SystemTest):
    def setUp(self):
        super().setUp()
        self.short = settings(averaging__rotations=0.05)

    def test_plain_lines(self):
        done = self.compare(*self.short, engines="grain,box2d-penalty")
        self.assert_status(done, HELD)
        self.assertNotRegex(done.stdout, CONTROL)
        self.assertNotRegex(done.stderr, CONTROL)

    def test_counts_finished_pieces(self):
        # Pairs of equal runs side by side end almost at once.
        done = self.compare(
            *settings(averaging__rotations=0.02, preparation__packings=8), "--jobs=2"
        )
        stage = done.stderr.partition("running engines: 8 to do\n")[2]
        counted = re.findall(r"(?m)^\[(\d)/8\]", stage)
        self.assertEqual(list("12345678"), counted, str(done))

    def test_quiet(self):
        done = self.compare(*self.short, "--quiet")
        self.assert_status(done, HELD)
        self.assertEqual("", done.stderr)

    def test_json_prints_the_path_alone(self):
        done = self.compare(*self.short, "--json", "--quiet")
        self.assert_status(done, HELD)
        self.assertEqual(f"{self.out / 'results.json'}\n", done.stdout)


class Terminal(SystemTest):
    COLUMNS = 60

    def on_terminal(self, engines, *arguments):
        """What a `compare` draws on a pseudo-terminal."""
        command = ["compare", COUETTE, "--engines", engines, "--out", self.out, "--quick", *arguments]
        status, drawn = on_terminal(self.COLUMNS, "stderr", command)
        self.assertEqual(HELD, status, drawn)
        return drawn

    def test_redraws_one_row(self):
        drawn = self.on_terminal("box2d-penalty", *settings(averaging__rotations=0.15), "--jobs=1")
        # Which of the two it says is a matter of the machine's speed; tests/studies/executor_test.cpp has the words.
        self.assertRegex(drawn, r"running engines: +\d+ %, (\d+ s left|estimating the time left)")
        # Every redrawing starts where the last one did, and fits in one row of the terminal.
        rows = re.findall(r"\r\x1b\[K(running engines:[^\r\n]*)", drawn)
        self.assertGreater(len(rows), 2)
        for row in rows:
            self.assertLess(len(row), self.COLUMNS + 1, row)
        self.assertTrue(drawn.endswith("\r\x1b[K"), "nothing half drawn is left in the last row")

    def test_percentages_grow(self):
        drawn = self.on_terminal(
            "grain,box2d-penalty", *settings(averaging__rotations=0.15), "--jobs=2"
        )
        percent = [int(number) for number in re.findall(r"running engines: +(\d+) %", drawn)]
        self.assertGreater(len(percent), 2)
        self.assertEqual(sorted(percent), percent)

    def test_quiet(self):
        short = settings(averaging__rotations=0.02)
        self.assertEqual("", self.on_terminal("grain", *short, "--quiet"))


if __name__ == "__main__":
    unittest.main()
