"""What the user gave cannot be used: status 2 and one line that says where and what."""

import os
import unittest

from harness import BAD_INPUT, CASES, COLLISION, COUETTE, HARD_SPHERE, FELL_SHORT, HELD, SystemTest, settings


class CaseFiles(SystemTest):
    """Mistakes in a case file, with their line."""

    def refuse(self, text, *fragments):
        """The case of the small cell with `text` appended is refused."""
        head = f'[case]\nextends = "{COUETTE}"\n'
        case = self.write("mistaken.toml", head + text)
        done = self.compare("--quiet", case=case)
        self.assert_one_line(done, BAD_INPUT, *fragments)
        self.assertFalse(self.out.exists(), "a refused case leaves no folder")

    def test_unknown_key(self):
        self.refuse(
            "[particles]\nsmal_mass = 1e-3\n",
            "mistaken.toml:4:1",
            "unknown key particles.smal_mass",
            "did you mean small_mass?",
        )

    def test_unknown_section(self):
        self.refuse("[averagin]\nrings = 3\n", "mistaken.toml:3:", "averagin", "averaging?")

    def test_wrong_type(self):
        self.refuse(
            '[averaging]\nrings = "six"\n',
            "mistaken.toml:4:9",
            'averaging.rings = "six"',
            "whole number",
        )

    def test_negative_radius(self):
        self.refuse(
            "[particles]\nsmall_radius = -0.0037\n",
            "mistaken.toml:4:16",
            "particles.small_radius = -0.0037",
            "> 0 m",
        )

    def test_zero_disks(self):
        self.refuse("[particles]\nsmall = 0\nlarge = 0\n", "mistaken.toml:4:", "without disks")

    def test_outer_radius_below_inner(self):
        self.refuse(
            "[cell]\nouter_radius = 0.02\n",
            "mistaken.toml:4:16",
            "cell.outer_radius = 0.02",
            "inner_radius = 0.03 m",
        )

    def test_more_disks_than_the_cell_has_room_for(self):
        self.refuse("[particles]\nsmall = 2000\n", "mistaken.toml", "particles")

    def test_syntax_error(self):
        self.refuse("[particles\nsmall = 3\n", "mistaken.toml:3:")

    def test_not_finite(self):
        self.refuse("[law]\nkn = nan\n", "mistaken.toml:4:", "law.kn")

    def test_missing_base(self):
        case = self.write("orphan.toml", '[case]\nextends = "gone.toml"\n')
        done = self.compare("--quiet", case=case)
        self.assert_one_line(done, BAD_INPUT, "orphan.toml:2:", "gone.toml", "no such file")

    def test_missing_case_file(self):
        done = self.compare("--quiet", case=self.folder / "gone.toml")
        self.assert_one_line(done, BAD_INPUT, "gone.toml", "no such file")

    def test_binary_case_file(self):
        case = self.folder / "noise.toml"
        case.write_bytes(bytes(range(256)))
        self.assert_one_line(self.compare("--quiet", case=case), BAD_INPUT, "noise.toml:1:1")

    def test_settings_of_an_unknown_engine(self):
        self.refuse("[engines.grian]\nskin = 0.1\n", "grian", "did you mean grain?")


class Overrides(SystemTest):
    """Mistakes in --set."""

    def refuse(self, override, *fragments):
        done = self.compare("--quiet", "--set", override)
        self.assert_one_line(done, BAD_INPUT, *fragments)

    def test_unknown_key(self):
        self.refuse(
            "law.tensoin=cut", "--set law.tensoin=cut", "unknown key law.tensoin", "tension?"
        )

    def test_unknown_value(self):
        self.refuse("law.tension=cutt", "--set law.tension=cutt", "did you mean cut?")

    def test_out_of_range(self):
        self.refuse("averaging.confidence=1.5", "--set averaging.confidence=1.5", "(0, 1)")

    def test_not_an_assignment(self):
        self.refuse("averaging.rings", "--set averaging.rings", "key.path=value")

    def test_unknown_setting_of_an_engine(self):
        self.refuse("engines.grain.skim=0.1", "[engines.grain]", "'skim'", "skin")

    def test_wrong_type_of_a_setting(self):
        self.refuse("engines.grain.skin=wide", "[engines.grain]", "skin", "a number", "a string")

    def test_of_two_engines_the_first_is_told_of(self):
        """The one in Python answers last."""
        own = CASES.parent / "examples/python/engine.toml"
        wrong = ["--set=engines.numpy.skim=1.0", "--set=engines.grain.skim=0.1"]
        done = self.compare("--quiet", *wrong, engines=f"{own},grain")
        self.assert_one_line(done, BAD_INPUT, "[engines.numpy]", "'skim'")

    def test_settings_are_checked_by_collide_too(self):
        done = self.run_program(
            "collide", COLLISION, "--engines", "grain", "--out", self.out, "--quiet",
            "--set", "engines.grain.skim=0.1",
        )  # fmt: skip
        self.assert_one_line(done, BAD_INPUT, "[engines.grain]", "'skim'", "skin")

    def test_settings_are_checked_by_check_too(self):
        done = self.run_program("check", COUETTE, "--set", "engines.grain.skim=0.1")
        self.assert_one_line(done, BAD_INPUT, "[engines.grain]", "'skim'", "skin")

    def test_a_setting_out_of_range_is_refused_by_every_command(self):
        out = ["--out", self.out]
        for command in (
            ["check", COUETTE], ["compare", COUETTE, *out], ["effects", COUETTE, *out], ["cost", COUETTE, *out],
            ["lockstep", COUETTE, *out], ["identify", COUETTE, *out], ["collide", COLLISION, *out],
            ["stability", CASES / "hard/grazing.toml", *out], ["stability", "--transforms", COUETTE, *out],
            ["baseline", COUETTE, "--out", "b.h5"], ["record", COUETTE, "--out", "r.rec"],
        ):  # fmt: skip
            with self.subTest(command=command[:-2]):
                done = self.run_program(*command, "--engines", "grain", "--set=engines.grain.threads=0")
                self.assert_one_line(done, BAD_INPUT, "[engines.grain]", "threads = 0", "a whole number from 1 to 1024")

    def test_settings_have_ranges(self):
        for engine, setting in (
            ("grain", "threads=1.5"), ("grain", "stiffness=0.0"), ("grain", "skin=inf"), ("lammps", "ranks=0"),
            ("box2d-impulse", "velocity_iterations=0"), ("box2d-impulse", "position_iterations=2.5"),
        ):  # fmt: skip
            with self.subTest(engine=engine, setting=setting):
                done = self.run_program("check", COUETTE, "--engines", engine, f"--set=engines.{engine}.{setting}")
                self.assert_one_line(done, BAD_INPUT, f"[engines.{engine}]", setting.split("=")[0], "must be")


class CommandLine(SystemTest):
    def refuse(self, arguments, *fragments):
        self.assert_one_line(self.run_program(*arguments), BAD_INPUT, *fragments)

    def test_no_subcommand(self):
        self.refuse([], "no command", "see crossgrain --help")

    def test_unknown_subcommand(self):
        self.refuse(["comprae", COUETTE], "comprae")

    def test_unknown_option(self):
        self.refuse(["engines", "--jsno"], "--jsno")

    def test_missing_out(self):
        for command in ("compare", "collide"):
            with self.subTest(command):
                self.refuse([command, COUETTE, "--engines", "grain"], "--out")

    def test_missing_engines(self):
        self.refuse(["compare", COUETTE, "--out", self.out], "--engines")

    def test_missing_case(self):
        self.refuse(["compare", "--engines=grain", "--out", self.out], "case")

    def test_no_jobs(self):
        done = self.compare("--jobs", "0")
        self.assert_one_line(done, BAD_INPUT, "--jobs", "0")
        self.assertLess(len(done.stderr), 200, "the range is not to be spelt out to 300 digits")

    def test_negative_seed(self):
        done = self.compare("--seed", "-1")
        self.assert_one_line(done, BAD_INPUT, "seed", "-1")

    def test_empty_out(self):
        done = self.run_program(
            "compare", COUETTE, "--engines", "grain", "--out", "", "--quick", "--quiet"
        )
        self.assert_one_line(done, BAD_INPUT, "--out")
        self.assertEqual([], list(self.folder.iterdir()), "nothing is written elsewhere instead")

    def test_unknown_engine(self):
        for name, nearest in {"grian": "grain", "box2d-penatly": "box2d-penalty"}.items():
            with self.subTest(name):
                done = self.compare("--quiet", engines=name)
                self.assert_one_line(
                    done, BAD_INPUT, "--engines", f"'{name}'", f"did you mean {nearest}?"
                )

    def test_engine_named_twice(self):
        done = self.compare("--quiet", engines="grain,grain")
        self.assert_one_line(done, BAD_INPUT, "'grain'", "twice")

    def test_unknown_engine_leaves_earlier_runs_alone(self):
        runs = self.out / "runs"
        runs.mkdir(parents=True)
        (runs / "grain-p0.json").write_text("{}", encoding="utf-8")
        self.assert_status(self.compare("--quiet", engines="grian"), BAD_INPUT)
        self.assertEqual(["grain-p0.json"], [file.name for file in runs.iterdir()])

    def test_case_of_the_wrong_kind(self):
        done = self.run_program(
            "collide", COUETTE, "--engines", "grain", "--out", self.out, "--quiet"
        )
        self.assert_one_line(done, BAD_INPUT, "quick.toml", "collide", "kind")
        done = self.compare("--quiet", case=HARD_SPHERE)
        self.assert_one_line(done, BAD_INPUT, "hard-sphere.toml", "compare", "kind")

    def test_collide_on_a_folder_without_cases(self):
        (self.folder / "empty").mkdir()
        self.refuse(
            ["collide", self.folder / "empty", "--engines", "grain", "--out", self.out], "empty"
        )

    def test_collide_on_a_folder_without_collisions(self):
        folder = self.folder / "sheared"
        folder.mkdir()
        (folder / "sheared.toml").write_text(f'[case]\nkind = "couette"\nextends = "{COUETTE}"\n')
        self.refuse(["collide", folder, "--engines", "grain", "--out", self.out], "sheared", "collision")

    def test_collide_on_cases_of_one_name(self):
        folder = self.folder / "twins"
        folder.mkdir()
        for name in ("a", "b"):
            (folder / f"{name}.toml").write_text(
                f'[case]\nname = "twin"\nkind = "collision"\nextends = "{COLLISION}"\n'
            )
        self.refuse(["collide", folder, "--engines", "grain", "--out", self.out], "b.toml", "twin")

    def test_line_break_in_a_name_stays_one_line(self):
        done = self.compare("--quiet", out="/proc/no\nsuch")
        self.assert_one_line(done, BAD_INPUT, "/proc/no")

    def test_options_may_stand_before_the_case(self):
        for option in (["--engines", "grain"], ["--set", "averaging.rings=5"]):
            with self.subTest(option[0]):
                rest = [] if option[0] == "--engines" else ["--engines=grain"]
                done = self.run_program(
                    "compare", *option, self.folder / "gone.toml", *rest, "--out", self.out
                )
                self.assert_one_line(done, BAD_INPUT, "gone.toml", "no such file")


class Files(SystemTest):
    """What is named is no file, or another one was meant."""

    def refuse(self, case, *fragments):
        for command in (
            ["check", case],
            ["compare", case, "--engines", "grain", "--out", self.out, "--quiet"],
        ):
            with self.subTest(command[0]):
                done = self.run_program(*command, timeout=20)
                self.assert_one_line(done, BAD_INPUT, *fragments)

    def test_a_mistyped_name(self):
        self.refuse(
            COUETTE.parent / "quik.toml", "quik.toml: no such file", "did you mean", "quick.toml?"
        )

    def test_a_folder(self):
        self.refuse(COUETTE.parent, "couette: is a folder, not a file", "quick.toml")

    def test_a_named_pipe(self):
        os.mkfifo(self.folder / "pipe.toml")
        self.refuse(self.folder / "pipe.toml", "is a named pipe, not a file")

    def test_a_named_pipe_of_snapshots(self):
        os.mkfifo(self.folder / "pipe.h5")
        for command in ("average", "rev"):
            done = self.run_program(command, self.folder / "pipe.h5", COUETTE, "--out", self.out)
            self.assert_one_line(done, BAD_INPUT, "is a named pipe")

    def test_only_cases_are_looked_for_where_they_are_installed(self):
        """A folder of results is the one that was named, here, and no other."""
        data = self.folder / "data"
        (data / "out").mkdir(parents=True)
        (data / "out/results.json").write_text("{}", encoding="utf-8")
        done = self.run_program("report", "out", env={"CROSSGRAIN_DATA": str(data)})
        self.assert_one_line(done, BAD_INPUT, "out/results.json: cannot be read")

    def test_a_file_that_opens_and_cannot_be_read(self):
        self.refuse("/proc/self/mem", "mem: cannot be read")

    def test_nothing_of_a_foreign_file_is_quoted(self):
        theirs = self.folder / "theirs"
        mine = self.folder / "mine"
        theirs.mkdir()
        mine.mkdir()
        (theirs / "secret.toml").write_text("root:hunter2:0\n", encoding="utf-8")
        (mine / "case.toml").write_text('[case]\nextends = "../theirs/secret.toml"\n', encoding="utf-8")
        done = self.run_program("check", mine / "case.toml")
        self.assert_one_line(done, BAD_INPUT, "secret.toml:1:")
        self.assertNotIn("hunter2", done.stderr)

    def test_a_seed_too_large(self):
        for seed in ("4294967296", "99999999999999999999999"):
            done = self.compare("--quiet", "--seed", seed)
            self.assert_one_line(done, BAD_INPUT, "seed")

    def test_a_grid_of_10_to_the_10(self):
        case = self.write(
            "grid.toml",
            '[case]\nkind = "assembly"\n[law]\nkn = 352.1\ngn = 0.19\ntangential = "none"\n'
            "[assembly]\nduration = 0.1\n[[assembly.disks]]\nposition = [0.0, 0.0]\nradius = 0.1\n"
            "mass = 1.0\ngrid = { columns = 100000, rows = 100000 }\n",
        )
        done = self.run_program("check", case, timeout=20)
        self.assert_one_line(done, BAD_INPUT, "1e+10 disks", "at most 1000000")


class TimeSteps(SystemTest):
    """Beyond what the normal spring and dashpot of two small disks bear, 0.57 ms."""

    def test_is_refused_by_check_and_by_what_runs_it(self):
        for command in ("check", "compare", "effects"):
            with self.subTest(command):
                out = [] if command == "check" else ["--out", self.out, "--quiet"]
                done = self.run_program(
                    command, COUETTE, "--engines", "grain", *out, "--set=run.dt=1"
                )
                self.assert_one_line(done, BAD_INPUT, "run.dt = 1 s is beyond 0.000572 s")

    def test_of_one_engine(self):
        done = self.run_program(
            "check", COUETTE, "--engines", "grain", "--set=engines.grain.dt=0.01"
        )
        self.assert_one_line(done, BAD_INPUT, "[engines.grain] dt = 0.01 s is beyond")

    def test_impulses_have_no_such_limit(self):
        done = self.run_program(
            "check", COUETTE, "--engines", "box2d-impulse", "--set=engines.box2d-impulse.dt=0.002"
        )
        self.assert_status(done, HELD)

    def test_an_inherited_step_that_fits_no_longer_is_told_of(self):
        done = self.run_program(
            "check", COUETTE, "--engines", "grain", "--no-timing", "--set=law.kn=1500"
        )
        self.assert_status(done, HELD)
        self.assertRegex(done.stdout, r"caution: run.dt = 4e-05 s is that of .*nu-0.804.toml")


class Unsupported(SystemTest):
    """A scene that an engine cannot do, and the case does not let it differ."""

    def test_lacking_effect(self):
        allowed = ["normal", "bottom_spin_friction"]
        done = self.compare(
            "--quiet", *settings(run__may_differ=allowed), engines="grain,box2d-impulse"
        )
        self.assert_one_line(
            done, BAD_INPUT, "box2d-impulse cannot run", "quick.toml", "no bottom_friction",
            'list "bottom_friction" under [run] may_differ',
        )  # fmt: skip
        # What it advises is the way out.
        allowed.append("bottom_friction")
        short = (
            *settings(averaging__rotations=0.01, preparation__packings=1),
            "--set=engines.box2d-impulse.dt=5e-4",  # the finer, the harder
        )
        done = self.compare(
            "--quiet", *settings(run__may_differ=allowed), *short, engines="grain,box2d-impulse"
        )
        # One packing has no verdict, but rigid disks hold twelve times the pressure: an alarm.
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"ALARM: box2d-impulse against grain: pressure is \d+ margins")

    def test_lacking_law(self):
        done = self.run_program(
            "collide", HARD_SPHERE, "--engines", "box2d-penalty", "--out", self.out, "--quiet"
        )
        self.assert_one_line(
            done, BAD_INPUT, "box2d-penalty", "hard-sphere.toml", "normal = linear, not rigid",
            'list "normal"', "under [run] may_differ",
        )  # fmt: skip

    def test_lacking_law_in_compare(self):
        done = self.compare(
            "--quiet", *settings(run__may_differ=["rounding"]), engines="box2d-penalty"
        )
        self.assert_one_line(
            done, BAD_INPUT, "box2d-penalty cannot run", "quick.toml",
            "damping_velocity = lagged, not predicted",
            '"damping_velocity"', "under [run] may_differ",
        )  # fmt: skip

    def test_mirror_named_by_the_user(self):
        """Mirrors that come along with their peers may be left out, but not the one asked for."""
        done = self.compare(
            "--quiet", *settings(run__may_differ=["rounding"]), engines="grain-as-yade"
        )
        self.assert_one_line(
            done, BAD_INPUT, "grain-as-yade cannot run", "damping_velocity = lagged, not predicted", "may_differ"
        )


class MissingEngine(SystemTest):
    """YADE is looked for in PATH."""

    def setUp(self):
        super().setUp()
        self.bare = {"PATH": "/nonexistent"}

    def test_compare(self):
        done = self.compare("--quiet", engines="grain,yade", env=self.bare)
        self.assert_one_line(done, BAD_INPUT, "yade", "PATH", "package yade")

    def test_collide(self):
        done = self.run_program(
            "collide", COLLISION, "--engines", "yade", "--out", self.out, "--quiet", env=self.bare
        )
        self.assert_one_line(done, BAD_INPUT, "yade", "PATH", "package yade")

    def test_check_tells_of_all_engines(self):
        done = self.run_program("check", COUETTE, env=self.bare)
        self.assert_status(done, 0, 1)
        self.assertIn("package yade", done.stdout)
        for engine in ("grain", "box2d-impulse", "box2d-penalty"):
            self.assertRegex(done.stdout, rf"(?m)^ *{engine} +can run it")

    def test_engines_tells_of_all_engines(self):
        done = self.run_program("engines", env=self.bare)
        self.assert_status(done, 0)
        self.assertRegex(done.stdout, r"(?m)^yade +not available: .*package yade")
        self.assertRegex(done.stdout, r"(?m)^grain +in-house")

    def test_all_means_those_installed(self):
        done = self.run_program(
            "collide", COLLISION, "--engines", "all", "--out", self.out,
            *settings(collision__psi=1.0, collision__steps_per_contact=50), env=self.bare,
        )  # fmt: skip
        # Without PATH there is no gnuplot either: status 2 for the plots, but the numbers are there.
        self.assert_one_error(done, BAD_INPUT, "gnuplot")
        status = {engine["name"]: engine["status"] for engine in self.results()["engines"]}
        self.assertEqual("ran", status["grain"])
        self.assertNotEqual("ran", status.get("yade"))


if __name__ == "__main__":
    unittest.main()
