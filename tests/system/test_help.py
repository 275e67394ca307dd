"""What the program says of itself: help and its examples, lists, the page of commands, completion in shells."""

import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import unittest

from harness import BAD_INPUT, CASES, HELD, PROGRAM, SystemTest

HOME = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(HOME / "docs"))
import commands as reference  # noqa: E402


class Help(SystemTest):
    @classmethod
    def setUpClass(cls):
        def help_of(*arguments):
            return subprocess.run([PROGRAM, *arguments], capture_output=True, encoding="utf-8", check=True).stdout

        cls.of_program = help_of("--help")
        cls.commands = reference.commands_of(PROGRAM)
        cls.of = {command: help_of(command, "--help") for command in cls.commands}
        cls.short = {command: (help_of(command, "-h"), help_of("help", command)) for command in cls.commands[:3]}
        cls.version = help_of("--version")

    def test_help_fits_the_terminal(self):
        for columns in (72, 100):
            for command in ((), *((each,) for each in self.commands)):
                with self.subTest(columns=columns, command=command):
                    text = self.run_program(*command, "--help", env={"COLUMNS": str(columns)}).stdout
                    # A path or a list of values has no blank to be broken at.
                    long = [line for line in text.splitlines() if len(line) > columns and " " in line.strip()]
                    self.assertEqual([], long)
                    joined = re.sub(r"( \\)?\n +", " ", text)
                    for example in re.findall(r"(?m)^  (crossgrain .*)$", self.of[command[0]]) if command else ():
                        self.assertIn(example, joined, "an example that is broken can be pasted")
        self.assertLessEqual(max(map(len, self.run_program("--help", env={"COLUMNS": None}).stdout.splitlines())), 80)

    def examples(self):
        for command, text in self.of.items():
            found = re.findall(r"(?m)^  crossgrain (.*)$", text)
            self.assertNotEqual([], found, command)
            yield from ((command, shlex.split(example, comments=True)) for example in found)

    def test_help_has_usage_and_once_exit_status_and_environment(self):
        for command, text in self.of.items():
            with self.subTest(command):
                self.assertRegex(text, rf"Usage: crossgrain {command}\b")
                self.assertNotIn("CROSSGRAIN_CACHE", text)
                self.assertIn("Exit status and environment: crossgrain --help", text)
        for command, others in self.short.items():
            self.assertEqual({self.of[command]}, set(others))
        self.assertRegex(self.of_program, r"Exit status:\n  0 +passed[\s\S]*\n  130 +interrupted")
        self.assertIn("CROSSGRAIN_CACHE", self.of_program)
        questions = re.findall(r"(?m)^(\S[^\n]*):\n  [a-z]", self.of_program)
        self.assertEqual(["Check an engine", "Compare", "Accuracy, cost, hard cases", "Tools"], [each.partition(" (")[0] for each in questions])
        self.assertNotIn("__serve", self.of_program)
        self.assertRegex(self.version, r"^\d+\.\d+\.\d+\n$")

    def test_examples_run_up_to_where_they_would_write(self):
        """Each is run where the case files are; --out is a file."""
        (self.folder / "cases").symlink_to(CASES)
        (self.folder / "examples").symlink_to(HOME / "examples")
        (self.folder / "taken").write_text("", encoding="utf-8")
        for command, words in self.examples():
            with self.subTest(shlex.join(words)):
                if "--out" in words and command != "report":
                    words[words.index("--out") + 1] = "taken/out"
                    self.assert_one_error(self.run_program(*words), BAD_INPUT, "taken")
                elif command in ("report", "diff", "replay"):  # of what another command left
                    self.assert_one_line(self.run_program(*words), BAD_INPUT, words[1])
                elif command not in ("identify", "engines", "conformance", "check"):  # take seconds, and have tests of their own
                    self.held(*words)

    def test_examples_take_no_folder_of_another_command_and_read_what_one_left(self):
        left, read = {}, []
        for command, words in self.examples():
            for option, place in zip(words, words[1:]):
                if option in ("--out", "--slurm"):
                    self.assertEqual(command, left.setdefault(place, command), place)
                elif place.startswith("out/"):
                    read.append(place)
        self.assertIn("out/compare", left)
        self.assertEqual([], [place for place in read if not any(place.startswith(one) for one in left)])

    def test_page_of_commands_is_that_of_help(self):
        """After a change of --help: docs/commands.py PROGRAM."""
        page = reference.PAGE.read_text(encoding="utf-8")
        self.assertEqual(reference.written(page, reference.table_of(PROGRAM)), page)

    def complete(self, *words, shell="bash"):
        """Of the last word, as bash calls it, where --option=value are three words; or as the other shells do."""
        if shell != "bash":
            return set(self.held("__complete", *words, cwd=self.folder).stdout.split())
        quoted = " ".join(f"'{word}'" for word in (PROGRAM, *words))
        script = self.held("completion", "bash").stdout
        done = subprocess.run(
            ["bash", "-c", f"set -u; {script}\ncompopt() {{ :; }}; COMP_WORDS=({quoted}); COMP_CWORD={len(words)};"
             " _crossgrain; printf '%s\\n' \"${COMPREPLY[@]}\""],
            capture_output=True, encoding="utf-8", check=True, cwd=self.folder,
        )  # fmt: skip
        self.assertEqual("", done.stderr)
        return set(done.stdout.split())

    def test_completion(self):
        commands = self.complete("")
        self.assertEqual(set(self.commands), commands)
        for command, text in self.of.items():
            with self.subTest(command):
                self.assertEqual(set(re.findall(r"(?m)^  (?:-\w,)?(--[a-z0-9-]+)", text)), self.complete(command, "--"))
        (self.folder / "mine.toml").write_text("", encoding="utf-8")
        for words, expected in (
            (("comp",), {"compare", "completion"}), (("--v",), {"--version"}), (("calibrate", "--tension", "="), {"allow", "cut"}),
            (("calibrate", "--tension", "c"), {"cut"}), (("list", "m"), {"measures"}), (("help", "sta"), {"stability"}),
            (("compare", "x"), set()), (("compare", "mi"), {"mine.toml"}),
            (("compare", "cases/couette/q"), {"cases/couette/quick.toml"}), (("compare", "cas"), {"cases/"}),
            (("compare", "mine.toml", "--engines", "grain,box2d-p"), {"grain,box2d-penalty"}),
            (("conformance", "box2d-p"), {"box2d-penalty"}), (("engines", "box2d-p"), {"box2d-penalty"}),
            (("compare", "--out", "mi"), {"mine.toml"}), (("compare", "mine.toml", "mi"), set()), (("nonsense", ""), set()),
        ):  # fmt: skip
            self.assertEqual(expected, self.complete(*words), words)
            if "=" not in words:
                self.assertEqual(expected, self.complete(*words, shell="fish"), words)
        self.assertEqual({"--tension=allow", "--tension=cut"}, self.complete("calibrate", "--tension=", shell="zsh"))

    def test_completion_in_other_shells(self):
        """Those that are installed take the script, and complete with it."""
        path = {"PATH": f"{pathlib.Path(PROGRAM).parent}:{os.environ['PATH']}"}
        for shell in ("zsh", "fish"):
            script = self.write(f"crossgrain.{shell}", self.held("completion", shell).stdout)
            if not shutil.which(shell):
                continue
            with self.subTest(shell):
                self.assertEqual("", self.call(shell, "--no-execute", script).stderr)
                if shell == "fish":
                    done = self.call(shell, "-c", f"source {script}; complete -C 'crossgrain calibrate --tension c'", env=path)
                    self.assertEqual("cut", done.stdout.strip(), str(done))


class List(SystemTest):
    def listed(self, *arguments):
        done, text = (self.run_program("list", *arguments, *json_) for json_ in (["--json"], []))
        self.assert_status(done, HELD)
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
        self.assertLessEqual({str(file) for file in CASES.glob("hard/*.toml")}, set(rows))
        self.assertTrue(all(row["what"] for row in rows.values()))
        self.assert_one_line(self.run_program("list", "cases", "."), BAD_INPUT, ".: there is no case file")
        (self.folder / "cases").symlink_to(CASES)
        self.assertTrue(self.listed("cases")[0]["file"].startswith("cases/"))

    def test_fields_measures_and_keys(self):
        """That keys are the loader's is tested beside the loader."""
        fields = {row["name"]: row for row in self.listed("fields")}
        self.assertEqual("m/s", fields["azimuthal_velocity"]["unit"])
        self.assertIn("Σ", fields["stress_rr"]["what"])
        self.assertEqual("radii", {row["name"]: row for row in self.listed("measures")}["max_overlap"]["unit"])
        keys = {(row["section"], row["key"]): row for row in self.listed("keys")}
        self.assertEqual(("N/m", "required (linear)"), (keys["law", "kn"]["unit"], keys["law", "kn"]["default"]))
        self.assertEqual("allow, cut", keys["law", "tension"]["values"])
        self.assertFalse([row for row in keys.values() if "`" in row["what"] + row["default"]])


if __name__ == "__main__":
    unittest.main()
