"""What the program says of itself: lists, the page of commands, completion."""

import json
import pathlib
import re
import subprocess
import sys
import unittest

from harness import BAD_INPUT, CASES, HELD, PROGRAM, SystemTest
from test_command_line import commands_of

HOME = pathlib.Path(__file__).resolve().parents[2]
COMPLETION = HOME / "cli/completion.bash"
sys.path.insert(0, str(HOME / "docs"))
import commands as reference  # noqa: E402


class List(SystemTest):
    def listed(self, *arguments):
        done = self.run_program("list", *arguments, "--json")
        self.assert_status(done, HELD)
        text = self.run_program("list", *arguments)
        self.assert_status(text, HELD)
        rows = json.loads(done.stdout)
        self.assertEqual(len(rows), len(text.stdout.splitlines()))
        for row, line in zip(rows, text.stdout.splitlines()):
            self.assertIn(row.get("name") or row["key"], line)
        return rows

    def test_cases(self):
        rows = {row["file"]: row for row in self.listed("cases", CASES)}
        quick = rows[str(CASES / "couette/quick.toml")]
        self.assertEqual(("quick", "couette"), (quick["name"], quick["kind"]))
        self.assertIn("small cell", quick["what"])
        self.assertFalse([file for file in rows if "/laws/" in file], "these are no cases")
        for file in CASES.glob("hard/*.toml"):
            self.assertIn(str(file), rows)
        for row in rows.values():
            self.assertNotEqual("", row["what"], row)

    def test_cases_of_where_one_stands(self):
        self.assertIn("cases/couette/quick.toml", " ".join(row["file"] for row in self.listed("cases")))
        empty = self.run_program("list", "cases", ".")
        self.assert_one_line(empty, BAD_INPUT, ".: there is no case file")
        self.assert_one_line(self.run_program("list", "cases", "gone"), BAD_INPUT, "gone: No such file")
        (self.folder / "cases").symlink_to(CASES)
        self.assertTrue(self.listed("cases")[0]["file"].startswith("cases/"))

    def test_fields(self):
        rows = {row["name"]: row for row in self.listed("fields")}
        self.assertEqual("m/s", rows["azimuthal_velocity"]["unit"])
        self.assertIn("Σ", rows["stress_rr"]["what"])

    def test_measures(self):
        rows = {row["name"]: row for row in self.listed("measures")}
        self.assertEqual("radii", rows["max_overlap"]["unit"])

    def test_keys(self):
        """That they are the loader's is tested beside the loader."""
        rows = {(row["section"], row["key"]): row for row in self.listed("keys")}
        kn = rows["law", "kn"]
        self.assertEqual(("N/m", "required (linear)"), (kn["unit"], kn["default"]))
        self.assertEqual(("\"allow\"", "allow, cut"), (rows["law", "tension"]["default"], rows["law", "tension"]["values"]))
        self.assertIn("upward", rows["assembly.disks", "stack"]["what"])
        self.assertFalse([row for row in rows.values() if "`" in row["what"] + row["default"]])

    def test_something_else(self):
        done = self.run_program("list", "feilds")
        self.assert_one_line(done, BAD_INPUT, "'feilds'", "did you mean fields?")


class Commands(SystemTest):
    def test_the_page_of_commands_is_that_of_help(self):
        """After a change of --help: docs/commands.py PROGRAM."""
        page = reference.PAGE.read_text(encoding="utf-8")
        self.assertEqual(reference.written(page, reference.table_of(PROGRAM)), page)


class Completion(SystemTest):
    """In a real bash."""

    def complete(self, *words):
        """Of the last word, as bash calls it: --option=value are three words."""
        quoted = " ".join(f"'{word}'" for word in (PROGRAM, *words))
        done = subprocess.run(
            ["bash", "-c", f"set -u; source {COMPLETION}; COMP_WORDS=({quoted}); COMP_CWORD={len(words)};"
             " _crossgrain; printf '%s\\n' \"${COMPREPLY[@]}\""],
            capture_output=True, encoding="utf-8", check=True, cwd=self.folder,
        )  # fmt: skip
        self.assertEqual("", done.stderr)
        return set(done.stdout.split())

    def test_commands(self):
        self.assertLessEqual(set(commands_of(self)), self.complete(""))
        self.assertEqual({"compare"}, self.complete("comp"))
        self.assertEqual({"--version"}, self.complete("--v"))
        self.assertFalse([word for word in self.complete("") if word.startswith("__")])

    def test_every_option_of_every_command(self):
        for command in commands_of(self):
            with self.subTest(command):
                text = self.run_program(command, "--help").stdout
                self.assertEqual(set(re.findall(r"(?m)^  (?:-\w,)?(--[a-z0-9-]+)", text)), self.complete(command, "--"))

    def test_values(self):
        self.assertEqual({"allow", "cut"}, self.complete("calibrate", "--tension", "="))
        self.assertEqual({"cut"}, self.complete("calibrate", "--tension", "c"))
        self.assertEqual({"measures"}, self.complete("list", "m"))
        self.assertEqual({"stability"}, self.complete("help", "sta"))
        self.assertEqual(set(), self.complete("compare", "x"), "files are bash's own")


if __name__ == "__main__":
    unittest.main()
