"""One screen answers: the matrix at the end of the output, in summary.md, in results.json and on the page."""

import html
import json
import os
import re
import unittest

from harness import BAD_INPUT, HARD_SPHERE, HELD, SystemTest, on_terminal, wait_for

ESCAPE = re.compile(r"\x1b\[\d+m")


class Overview(SystemTest):
    def collide(self, **options):
        done = self.run_program(
            "collide", HARD_SPHERE, "--engines", "grain", "--out", self.out, "--quiet", **options
        )
        self.assert_status(done, HELD)
        return done.stdout

    def on_terminal(self, columns, **changes):
        """What a second `collide`, which has nothing left to run, prints on a pseudo-terminal."""
        command = ["collide", HARD_SPHERE, "--engines", "grain", "--out", self.out, "--quiet"]
        status, printed = on_terminal(columns, "stdout", command, {"NO_COLOR": None} | changes)
        self.assertEqual(HELD, status, printed)
        return printed.replace("\r\n", "\n")

    def test_the_same_everywhere(self):
        plain = self.collide()
        self.assertRegex(plain, r"(?m)^engine +cases passed ")
        self.assertRegex(plain, r"(?m)^grain +✓ (\d+) of \1 ")
        self.assertNotIn("\x1b", plain)

        overview = json.loads((self.out / "results.json").read_text(encoding="utf-8"))["overview"]
        self.assertEqual(["grain"], [row["name"] for row in overview["rows"]])
        self.assertLessEqual(len(overview["conclusion"]), 3)
        summary = (self.out / "summary.md").read_text(encoding="utf-8")
        page = html.unescape((self.out / "report.html").read_text(encoding="utf-8"))
        for cell in overview["rows"][0]["cells"]:
            for place in (plain, summary, page):
                self.assertIn(cell["shown"], place)
        self.assertIn(overview["conclusion"][0].split(":")[0], summary)

        before = (self.out / "results.json").read_bytes()
        self.assert_status(self.run_program("report", self.out), HELD)
        self.assertEqual(before, (self.out / "results.json").read_bytes())

        coloured = self.on_terminal(160)
        self.assertRegex(coloured, r"\x1b\[32m✓ \d+ of")
        self.assertEqual(plain, ESCAPE.sub("", coloured))
        self.assertEqual(plain, self.on_terminal(160, NO_COLOR="1"))
        narrow = ESCAPE.sub("", self.on_terminal(50)).partition("engine ")[2].partition("Passed every ")[0]
        for line in narrow.splitlines():
            self.assertLessEqual(len(line), 50)

    def test_report_opens_in_the_browser(self):
        self.collide()
        browser = self.write("xdg-open", f'#!/bin/sh\nprintf %s "$1" > "{self.folder}/opened"\n')
        browser.chmod(0o755)
        path = f"{self.folder}:{os.environ['PATH']}"
        self.assert_status(self.run_program("report", self.out, "--open", env={"PATH": path}), HELD)
        opened = self.folder / "opened"
        wait_for(lambda: opened.exists() and opened.read_text(), 60, "the browser")
        self.assertEqual(str(self.out / "report.html"), opened.read_text())

    def test_several_reports_are_one_site(self):
        self.collide()
        before = {path: path.read_bytes() for path in self.out.rglob("*") if path.is_file()}
        site = self.folder / "site"
        done = self.run_program("report", self.out, self.out, "--out", site)
        self.assert_status(done, HELD)
        self.assertEqual(f"site: {site / 'index.html'}\n", done.stdout)
        name = self.out.name
        index = (site / "index.html").read_text(encoding="utf-8")
        for page in (f"{name}/report.html", f"{name}-2/report.html"):
            self.assertIn(f'href="{page}"', index)
            self.assertTrue((site / page).exists(), page)
        self.assertRegex((site / "summary.md").read_text(encoding="utf-8"), r"(?m)^\| grain \| ✓ (\d+) of \1 passed \|")
        self.assert_status(self.run_program("report", self.out, "--out", site), HELD)
        for path, content in before.items():
            self.assertEqual(content, path.read_bytes(), "results are not touched")
        self.assert_one_line(
            self.run_program("report", self.out, "--out", self.out), BAD_INPUT, "--out", "results of its own"
        )
        self.assert_one_line(
            self.run_program("report", site, "--out", self.folder / "other"), BAD_INPUT, "results.json"
        )
        self.assertFalse((self.folder / "other").exists())

    def test_without_a_browser_nothing_is_rebuilt(self):
        self.collide()
        (self.out / "report.html").unlink()
        done = self.run_program("report", self.out, "--open", env={"PATH": "/nowhere"})
        self.assert_one_line(done, BAD_INPUT, "xdg-open")
        self.assertFalse((self.out / "report.html").exists())


if __name__ == "__main__":
    unittest.main()
