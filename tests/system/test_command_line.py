"""What stands on the command line: help and examples, mistakes, odd surroundings, parts of a suite."""

import re
import shlex
import signal
import subprocess
import unittest

from harness import (
    BAD_INPUT,
    CASES,
    COLLISION,
    COUETTE,
    FELL_SHORT,
    HELD,
    PROGRAM,
    SystemTest,
    environment,
    settings,
)

QUICK = settings(collision__psi=[0.5], collision__steps_per_contact=50)
RUN = ("--engines", "grain", "--out", "out", "--quiet")


def commands_of(test):
    done = test.run_program("--help")
    section = done.stdout.partition("Subcommands:\n")[2].partition("\n\n")[0]
    return re.findall(r"(?m)^  (\S+) +\S", section)


class Help(SystemTest):
    def test_of_every_command_in_three_ways(self):
        for command in commands_of(self):
            with self.subTest(command):
                usual = self.run_program(command, "--help").stdout
                self.assertEqual(usual, self.run_program(command, "-h").stdout)
                self.assertEqual(usual, self.run_program("help", command).stdout)
                self.assertRegex(usual, rf"Usage: crossgrain {command}\b")
                self.assertRegex(usual, r"Exit status:\n  0 +passed")
                self.assertIn("CROSSGRAIN_CACHE", usual)

    def test_of_the_program(self):
        usual = self.run_program("--help").stdout
        self.assertEqual(usual, self.run_program("help").stdout)
        self.assertRegex(usual, r"Exit status:\n  0 +passed[\s\S]*\n  130 +interrupted")
        self.assertNotIn("__serve", usual)
        self.assertRegex(self.run_program("--version").stdout, r"^\d+\.\d+\.\d+\n$")

    def test_of_no_command(self):
        done = self.run_program("help", "comprae")
        self.assert_one_line(done, BAD_INPUT, "no command 'comprae'", "did you mean compare?")

    def test_examples_are_understood(self):
        """Each is run where the case files are, up to where it would write: --out is a file."""
        (self.folder / "cases").symlink_to(CASES)
        (self.folder / "examples").symlink_to(CASES.parent / "examples")
        (self.folder / "taken").write_text("", encoding="utf-8")
        for command in commands_of(self):
            text = self.run_program(command, "--help").stdout
            examples = re.findall(r"(?m)^  (crossgrain .*)$", text)
            self.assertNotEqual([], examples, command)
            for example in examples:
                with self.subTest(example):
                    words = shlex.split(example, comments=True)[1:]
                    if "--out" not in words or command == "report":
                        done = self.run_program(*words)
                        if command in ("report", "diff", "replay"):  # of what another command left
                            self.assert_one_line(done, BAD_INPUT, words[1])
                        else:
                            self.assert_status(done, HELD)
                        continue
                    words[words.index("--out") + 1] = "taken/out"
                    done = self.run_program(*words)
                    self.assert_one_error(done, BAD_INPUT, "taken")


    def test_examples_follow_upon_each_other(self):
        """Whoever runs one after the other finds no folder taken by another command, and what an example reads was left by one."""
        left, read = {}, []
        for command in commands_of(self):
            for example in re.findall(r"(?m)^  crossgrain (.*)$", self.run_program(command, "--help").stdout):
                words = shlex.split(example, comments=True)
                for option, place in zip(words, words[1:]):
                    if option in ("--out", "--slurm"):
                        self.assertEqual(command, left.setdefault(place, command), place)
                    elif place.startswith("out/"):
                        read.append(place)
        self.assertIn("out/compare", left)
        self.assertEqual([], [place for place in read if not any(place.startswith(one) for one in left)])


class Mistakes(SystemTest):
    def refuse(self, arguments, *fragments):
        self.assert_one_line(self.run_program(*arguments), BAD_INPUT, *fragments)
        self.assertEqual([], list(self.folder.iterdir()), "nothing is written")

    def test_unknown_option(self):
        self.refuse(
            ["compare", COUETTE, "--enginees", "grain", "--out", "out"],
            "no option '--enginees' (did you mean --engines?); see crossgrain compare --help",
        )
        self.refuse(
            ["collide", COLLISION, *RUN, "--jbos=3"], "'--jbos' (did you mean --jobs?)", "collide --help"
        )
        self.refuse(["--jobs", "3", "engines"], "no option '--jobs'", "see crossgrain --help")
        self.refuse(["engines", "-q"], "no option '-q'", "see crossgrain engines --help")

    def test_what_is_missing(self):
        self.refuse(["compare"], "case, --engines, --out are missing", "see crossgrain compare --help")
        self.refuse(["compare", COUETTE, "--engines=grain"], "--out is missing (folder for results")
        self.refuse(["compare", COUETTE, "--out=out", "--engines"], "--engines needs a value (engines")
        self.refuse(["report"], "folder is missing")

    def test_too_many(self):
        self.refuse(["check", COUETTE, COLLISION], "figure-4-3.toml' is one argument too many: check takes case")
        self.refuse(["engines", "grain"], "'grain' is one argument too many: engines takes none")
        self.refuse(["compare", COUETTE, *RUN, "--out", "b"], "--out is given twice")
        self.refuse(["compare", COUETTE, *RUN, "--jobs=1", "--jobs=2"], "--jobs is given twice")
        self.refuse(["compare", COUETTE, *RUN, "--json=maybe"], "--json takes no value")

    def test_values(self):
        most = 2**63 - 1
        for option, value, right in (
            ("--jobs", "0", "from 1 to 4096"),
            ("--jobs", "-1", "from 1 to 4096"),
            ("--jobs", "many", "must be a whole number"),
            ("--jobs", "1.5", "must be a whole number"),
            ("--jobs", "1e3", "must be a whole number"),
            ("--jobs", "99999999999999999999", "from 1 to 4096"),
            ("--seed", str(2**63), f"from 0 to {most}"),
            ("--seed", "x", f"from 0 to {most}"),
        ):
            with self.subTest(f"{option} {value}"):
                self.refuse(
                    ["compare", COUETTE, *RUN, f"{option}={value}"], f"{option}: ", right, f"'{value}'",
                    "see crossgrain compare --help",
                )  # fmt: skip
        self.refuse(["calibrate", "--en=high"], "--en: must be a number, not 'high'")
        self.refuse(["cost", COUETTE, *RUN, "--budget=10x"], "--budget 10x: must be like 90s, 10m or 1h")
        self.refuse(["cost", COUETTE, *RUN, "--want=-1%"], "--want -1%: must be like")

    def test_names_of_engines(self):
        done = self.run_program("check", COUETTE, "--engines", " grain , box2d-penalty ")
        self.assert_status(done, HELD)
        for names in ("grain,,yade", "grain,", " ", ","):
            with self.subTest(names):
                self.refuse(["check", COUETTE, f"--engines={names}"], f"--engines '{names}': a name is empty")
        self.refuse(["check", COUETTE, "--engines=grain, grain"], "'grain' is named twice")
        self.refuse(["check", COUETTE, "--engines=Grain"], "'Grain'", "did you mean grain?")

    def test_set(self):
        for override, told in {
            "averaging.rings": "key.path=value",
            "=3": "key.path=value",
            "averaging.rings=": "key.path=value",
            "": "key.path=value",
            "averagin.rings=3": "unknown key averagin (did you mean averaging?)",
            "averaging=3": "must be a table",
            "averaging.rings=[": "averaging.rings=[",
            "averaging..rings=3": "averaging..rings=3",
            "case.extends=x": "case.extends",
        }.items():
            with self.subTest(override):
                self.refuse(["check", COUETTE, "--set", override], f"--set {override}", told)

    def test_files(self):
        for name in ("", ".", "gone.toml", "/dev/null/x"):
            with self.subTest(name):
                self.refuse(["check", name], name)

    def test_a_name_that_is_no_utf8(self):
        done = subprocess.run(
            [PROGRAM, b"check", b"caf\xe9.toml"], capture_output=True, check=False, cwd=self.folder
        )
        self.assertEqual(BAD_INPUT, done.returncode)
        self.assertRegex(done.stderr, rb"^crossgrain: argument 2 .*is not UTF-8.*\n$")


class Surroundings(SystemTest):
    """Closed descriptors, full disks, homes that are none."""

    def shell(self, command, **options):
        return subprocess.run(
            ["bash", "-c", command, "bash", PROGRAM], capture_output=True, encoding="utf-8",
            cwd=self.folder, timeout=100, check=False, env=environment(options.pop("env", None)),
        )  # fmt: skip

    def test_output_that_cannot_be_written(self):
        for redirection, reason in ((">&-", "Bad file descriptor"), (">/dev/full", "No space left")):
            with self.subTest(redirection):
                done = self.shell(f'"$1" list fields {redirection}')
                self.assertEqual(BAD_INPUT, done.returncode, done)
                self.assertRegex(done.stderr, rf"^crossgrain: .*{reason}.*\n$")

    def test_closed_descriptors_do_not_end_up_in_files(self):
        words = shlex.join(["collide", str(COLLISION), "--engines=grain", "--out=out", *QUICK])
        done = self.shell(f'"$1" {words} <&- 2>&- | cat')
        self.assertEqual("", done.stderr)
        self.assertIn("report: out/report.html", done.stdout)
        for file in (self.folder / "out").rglob("*"):
            if file.is_file():
                self.assertNotIn(b"running engines", file.read_bytes(), file)

    def test_a_reader_that_has_seen_enough(self):
        done = self.shell('"$1" list keys | head -1; echo "${PIPESTATUS[0]}"')
        status = int(done.stdout.splitlines()[-1])
        self.assertIn(status, (HELD, 128 + signal.SIGPIPE))
        self.assertEqual("", done.stderr)

    def test_homes(self):
        """Packings are kept in memory only, where there is no place for them."""
        readonly = self.folder / "file"
        readonly.write_text("", encoding="utf-8")
        for home in (None, "", "/nonexistent", str(readonly)):
            with self.subTest(home=home):
                env = {"HOME": home, "CROSSGRAIN_CACHE": None, "XDG_CACHE_HOME": None}
                if home in (None, ""):
                    env["TMPDIR"] = str(self.folder)
                done = self.run_program(
                    "collide", COLLISION, "--engines=grain", "--out", self.out, *QUICK, "--quiet", env=env
                )
                self.assert_status(done, HELD, FELL_SHORT)

    def test_scratch_folder_that_is_none(self):
        done = self.run_program("engines", env={"TMPDIR": str(self.folder / "gone")})
        self.assert_one_line(done, BAD_INPUT, "gone", "TMPDIR")

    def test_where_packings_are_kept(self):
        for env, place in (
            ({"CROSSGRAIN_CACHE": "/a"}, "/a"),
            ({"CROSSGRAIN_CACHE": None, "XDG_CACHE_HOME": "/b"}, "/b/crossgrain"),
            ({"CROSSGRAIN_CACHE": "", "XDG_CACHE_HOME": None, "HOME": "/c"}, "/c/.cache/crossgrain"),
        ):
            done = self.run_program("engines", env={"PATH": "/nonexistent"} | env)
            self.assertIn(f"packings are kept in {place} ", done.stdout)


class Parts(SystemTest):
    """-k: a part of a suite."""

    def test_of_collide(self):
        for pattern, expected in {
            "figure-4-3/coulomb": {"coulomb-tension", "coulomb-cut"},
            "*/spring-*": {"spring-tension", "spring-cut"},
            "viscous-c": {"viscous-cut"},
        }.items():
            with self.subTest(pattern):
                done = self.run_program(
                    "collide", COLLISION, "-k", pattern, "--engines=grain", "--out", self.out, "--quiet", *QUICK
                )
                self.assert_status(done, HELD, FELL_SHORT)
                self.assertEqual(expected, {row["variant"] for row in self.results()["variants"]})

    def test_nothing(self):
        for command, folder, pattern, near in (
            ("stability", CASES / "hard", "pille", "pile"),
            ("collide", COLLISION, "coulomb-tensoin", "coulomb"),
        ):
            done = self.run_program(
                command, folder, "-k", pattern, "--engines=grain", "--out", self.out, "--quiet"
            )
            self.assert_one_line(done, BAD_INPUT, f"-k '{pattern}'", near)
            self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
