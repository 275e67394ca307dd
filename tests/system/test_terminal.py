"""Progress and colours: redrawn in place with the time left on a terminal, plain lines elsewhere."""

import re
import unittest

from harness import COUETTE, HARD_SPHERE, HELD, SystemTest, on_terminal, settings

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


if __name__ == "__main__":
    unittest.main()
