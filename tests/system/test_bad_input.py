"""What the user gave cannot be used: status 2 and one line that says where and what."""

import json
import os
import re
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

    def test_syntax_error(self):
        self.refuse("[particles\nsmall = 3\n", "mistaken.toml:3:")

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
            ["lockstep", COUETTE, *out], ["identify", COUETTE], ["collide", COLLISION, *out],
            ["stability", CASES / "hard/grazing.toml", *out], ["stability", "--transforms", COUETTE, *out],
            ["baseline", COUETTE, "--out", "b.h5"], ["record", COUETTE, "--out", "r.rec"],
        ):  # fmt: skip
            with self.subTest(command=command):
                done = self.run_program(*command, "--engines", "grain", "--set=engines.grain.threads=0")
                self.assert_status(done, BAD_INPUT)
                self.assert_line(done.stderr.splitlines()[-1], "[engines.grain]", "threads = 0", "a whole number from 1 to 1024")

    def test_settings_have_ranges(self):
        for engine, setting in (
            ("grain", "threads=1.5"), ("grain", "stiffness=0.0"), ("lammps", "ranks=0"),
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


TWO_DISKS = """[case]
kind = "collision"
[law]
kn = 352.1
gn = 0.19
mu = 0.44
kt = 267.1
gt = 0.15
tangential = "spring_dashpot"
[run]
may_differ = ["damping_velocity", "integrator", "rounding"]
[collision]
psi = [0.3, 1.0, 4.0]
vn = 0.01
radius = 0.0037
mass = 0.275e-3
[collision.margins]
psi_f = { absolute = 0.02, why = "a test" }
"""


class KeysWithoutUse(SystemTest):
    """Nothing that a case says is ignored in silence: a key does something, or the command says that it does not."""

    #: Of each section that a command can do without, or a key in it, the commands that use it.
    EXPECTED = {
        "preparation.packings": "compare lockstep effects cost",
        "preparation": "compare lockstep effects cost stability",
        "averaging.rings": "compare effects cost",
        "averaging.method": "compare effects cost",
        "averaging.snapshots_per_rotation": "compare effects cost",
        "averaging.confidence": "compare effects cost",
        "averaging.settle_rotations": "compare lockstep effects cost stability",
        "averaging.rotations": "compare lockstep effects cost stability",
        "averaging.margins": "compare effects",
        "averaging.endpoints": "compare",
        "looks": "compare",
        "cost": "cost",
        "run.mirrors": "compare",
        "run.keep_snapshots": "compare effects cost",
        "run.energy_ledger": "compare effects cost stability",
    }

    def said(self, done):
        """What the command says that it does not use."""
        found = re.search(r"(?:does not use|not used:) (.*)", done.stdout)
        return found.group(1).split(", ") if found else []

    def test_of_a_cell_every_key_is_used_or_named(self):
        every = self.write(
            "every.toml",
            f'[case]\nextends = "{COUETTE}"\n[run]\nmirrors = false\nkeep_snapshots = 3\nenergy_ledger = true\n'
            "[cost]\nrepeats = 3\n[averaging]\nmethod = \"slicing\"\n[engines.mine]\nblur = 1\n",
        )
        for command in ("compare", "lockstep", "effects", "cost", "stability"):
            transforms = ["--transforms"] if command == "stability" else []
            done = self.run_program(
                command, every, "--engines", "grain", "--out", self.out, "--dry-run", "--quiet", *transforms
            )
            self.assert_status(done, HELD)
            said = self.said(done)
            for key, users in self.EXPECTED.items():
                with self.subTest(command=command, key=key):
                    unused = key in said or key.split(".")[0] in said
                    self.assertEqual(command not in users.split(), unused, done.stdout)
            self.assertIn("engines.mine", " ".join(said), "settings of an engine that is not here")

    def test_every_key_that_exists_is_known_here(self):
        """A new key of a section that some commands do without is to be placed above."""
        listed = json.loads(self.run_program("list", "keys", "--json").stdout)
        paths = {f"{each['section']}.{each['key']}" for each in listed}
        for section in ("averaging", "run"):
            shared = {"dt", "steps_per_contact", "handover", "may_differ", "precision", "timeout", "line_width"}
            for path in sorted(path for path in paths if path.startswith(section + ".")):
                known = any(path == key or path.startswith(key + ".") for key in self.EXPECTED)
                self.assertTrue(known or path.split(".")[1] in shared, path)

    CHANGES = {
        "law.mu": "0.3",
        "collision.psi": "[0.5, 1.0, 4.0]",
        "collision.vn": "0.02",
        "collision.radius": "0.004",
        "collision.mass": "3e-4",
        "collision.inertia_factor": "0.4",
        "collision.steps_per_contact": "80",
        "collision.start_phase": "0.2",
        "collision.counter_spin": "1.0",
        "collision.margins.psi_f.absolute": "0.03",
        "run.mirrors": "false",
        "run.precision": '"float"',
        "run.keep_snapshots": "3",
    }

    def by_deed(self, command, result, apart=()):
        """A key that changes what comes out is used, one that does not is named."""
        case = self.write("two.toml", TWO_DISKS)
        before, _ = result(case)
        for key, value in self.CHANGES.items():
            if key in apart:
                continue
            with self.subTest(command=command, key=key):
                after, done = result(case, f"--set={key}={value}")
                said = self.said(done)
                unused = any(key == each or key.startswith(each + ".") for each in said)
                self.assertEqual(before != after, not unused, done.stdout)

    def test_calibrate_by_deed(self):
        def result(*arguments):
            done = self.run_program("calibrate", *arguments)
            self.assert_status(done, HELD)
            return [line for line in done.stdout.splitlines() if "not used" not in line], done

        # Nothing of a linear contact hangs on the radii; Hertz' law uses them.
        self.by_deed("calibrate", result, apart=["collision.radius"])

    def test_collide_by_deed(self):
        apart = {"head", "case", "command", "started", "elapsed_s", "machine", "stats", "wall_s", "cpu_s", "toml"}

        def plain(node):
            if isinstance(node, dict):
                return {key: plain(value) for key, value in node.items() if key not in apart}
            return [plain(each) for each in node] if isinstance(node, list) else node

        def result(*arguments):
            done = self.run_program(
                "collide", *arguments, "--engines", "grain,box2d-penalty", "--out", self.out, "--quiet", "--fresh"
            )
            self.assert_status(done, HELD, FELL_SHORT)
            return plain(self.results()), done

        self.by_deed("collide", result)

    def test_of_several_variants_record_names_its_own(self):
        done = self.run_program("record", COLLISION, "--engines", "grain", "--out", self.folder / "run.rec")
        self.assert_status(done, HELD)
        self.assertRegex(done.stdout, r"variant \S+ is recorded, one of 8")

    def test_others_refuse_variants(self):
        several = self.write(
            "several.toml", f'[case]\nextends = "{COUETTE}"\n[[variants]]\nname = "a"\n[[variants]]\nname = "b"\n'
        )
        for command in ("compare", "lockstep", "effects", "cost"):
            done = self.run_program(command, several, "--engines", "grain", "--out", self.out, "--quiet")
            self.assert_one_line(done, BAD_INPUT, f"{command} takes a case without variants")
        for command in ("identify", "baseline"):
            out = ["--out", self.out] if command == "baseline" else []
            done = self.run_program(command, several, "--engines", "yade", *out, "--quiet")
            self.assert_one_line(done, BAD_INPUT, f"{command} takes a case without variants")


class Hints(SystemTest):
    """What was meant is said, and what is not the question is not."""

    def test_an_engine_of_this_program_is_no_command(self):
        done = self.run_program("check", COUETTE, "--engine", "grain")
        self.assert_one_line(done, BAD_INPUT, "did you mean --engines grain?")

    def test_check_of_one_engine_lists_no_others(self):
        with_path = {"PATH": "/nowhere"}
        one = self.run_program("check", COUETTE, "--engines", "grain", "--no-timing", env=with_path)
        self.assert_status(one, HELD)
        self.assertNotIn("not available", one.stdout)
        every = self.run_program("check", COUETTE, "--no-timing", env=with_path)
        self.assertIn("not available", every.stdout)

    def test_quick_makes_nothing_longer(self):
        done = self.run_program(
            "compare", COUETTE, "--engines", "grain,box2d-penalty", "--out", self.out, "--quick", "--dry-run",
            "--set=run.mirrors=false", "--set=preparation.packings=1",
        )  # fmt: skip
        self.assertIn("1 packings", done.stdout)
        one = self.write("one.toml", f'[case]\nextends = "{COUETTE}"\n[preparation]\npackings = 1\n')
        done = self.run_program(
            "compare", one, "--engines", "grain,box2d-penalty", "--out", self.out, "--quick", "--dry-run"
        )
        self.assertIn("1 packings", done.stdout)

    def test_one_engine_is_neither_undecided_nor_decided(self):
        done = self.run_program(
            "compare", COUETTE, "--engines", "box2d-penalty", "--out", self.out, "--quick", "--quiet"
        )
        self.assert_status(done, HELD)
        self.assertIn("nothing was judged: one engine has nothing", done.stdout)
        overview = self.results()["overview"]
        states = {cell["state"] for row in overview["rows"] for cell in row["cells"]}
        for contradiction in ("undecided", "every endpoint"):
            self.assertNotIn(contradiction, done.stdout)
            self.assertNotIn(contradiction, " ".join(overview["conclusion"]))
        self.assertNotIn("undecided", states)


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

    def test_what_one_engine_lacks_is_its_own_affair(self):
        """It is refused for itself, the others run; the first that can is the reference."""
        allowed = ["damping_velocity", "integrator", "bottom_friction", "bottom_spin_friction", "rounding"]
        asked = settings(run__may_differ=allowed + ["tangential_restitution"])
        for engines, strict, status in (
            ("grain,box2d-impulse,box2d-penalty", [], HELD),  # --quick: nothing is judged, by request
            ("box2d-impulse,grain,box2d-penalty", ["--strict"], FELL_SHORT),
        ):
            with self.subTest(engines):
                done = self.compare("--quiet", *asked, *strict, engines=engines)
                self.assert_one_line(done, status, "box2d-impulse cannot run", "quick.toml")
                results = self.results()
                engines_of = {row["name"]: row["status"] for row in results["engines"]}
                self.assertEqual(
                    {"grain": "ran", "box2d-penalty": "ran", "box2d-impulse": "refused"}, engines_of
                )
                self.assertEqual({"grain"}, {row["a"] for row in results["endpoints"]["rows"]})
        self.assertIn("box2d-impulse was named first", " ".join(results["notes"]))
        for command in ("lockstep", "effects"):
            done = self.run_program(
                command, COUETTE, "--engines", "box2d-impulse,box2d-penalty", "--quick", *asked,
                "--out", self.folder / command, "--dry-run", "--quiet",
            )  # fmt: skip
            self.assert_status(done, HELD)
            self.assertRegex(done.stdout, r"box2d-impulse +cannot: box2d-impulse cannot run")
            self.assertRegex(done.stdout, r"box2d-penalty +\d+ ")

    def test_lacking_law_of_one_in_collide(self):
        done = self.run_program(
            "collide", HARD_SPHERE, "--engines", "grain,box2d-penalty", "--out", self.out, "--quiet"
        )
        self.assert_status(done, HELD)
        self.assertEqual(
            ["ran", "refused"], [row["status"] for row in self.results()["engines"]]
        )

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
