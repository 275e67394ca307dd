"""Commands that run no study: engines, check, calibrate, report; keys that a command has no use for; odd surroundings."""

import json
import math
import os
import re
import shlex
import shutil
import signal
import subprocess
import tomllib
import unittest

from harness import (
    BAD_INPUT,
    CASES,
    COLLISION,
    COUETTE,
    FELL_SHORT,
    HELD,
    PATIENCE,
    PROGRAM,
    SystemTest,
    environment,
    settings,
    wait_for,
)

QUICK = settings(collision__psi=[0.5], collision__steps_per_contact=50, run__mirrors="false")


class Engines(SystemTest):
    @unittest.skipUnless(shutil.which("dpkg-query"), "only a package says what is installed")
    def test_version_of_box2d_is_the_package_s(self):
        """2.4.1 calls itself 2.4.0."""
        package = subprocess.run(
            ["dpkg-query", "-W", "-f", "${Version}", "libbox2d-dev"], capture_output=True, encoding="utf-8", check=True
        ).stdout.partition("-")[0]
        readme = (CASES.parent / "docs/engines.md").read_text(encoding="utf-8")
        done = self.held("engines", "--json")
        engines = {engine["name"]: engine for engine in json.loads(done.stdout)}
        for name, engine in engines.items():
            self.assertEqual(1, ("capabilities" in engine) + ("missing" in engine), name)
        for name in ("box2d-impulse", "box2d-penalty"):
            version, _, says = engines[name]["capabilities"]["version"].partition(", b2_version ")
            self.assertEqual(package, version)
            self.assertIn(f"`{name}` | Box2D {version} from Debian", readme)
            if says:
                self.assertIn(f"`b2_version` says {says}", readme)

    def test_engine_is_not_started_unless_asked_for(self):
        """YADE alone takes seconds."""
        mark = self.folder / "started"
        fake = self.write("yade", f"#!/bin/sh\ntouch {mark}\n")
        fake.chmod(0o755)
        env = {"PATH": f"{self.folder}:{os.environ['PATH']}"}
        quick = settings(preparation__packings=1, averaging__rotations=0.01, averaging__settle_rotations=0.001)
        for command in (("check", COUETTE, "--no-timing"), ("compare", COUETTE, *quick, "--out", self.out)):
            self.run_program(*command, "--engines", "grain,box2d-penalty", env=env)
            self.assertFalse(mark.exists(), command[0])
        self.run_program("check", COUETTE, "--engines", "yade", env=env)
        self.assertTrue(mark.exists())


class Check(SystemTest):
    def check(self, case, *arguments, engines="grain", **options):
        return self.run_program("check", case, "--engines", engines, "--no-timing", *arguments, **options)

    def test_prints_size_effects_and_expectations(self):
        done = self.held("check", COUETTE, "-v", "--engines", "grain,box2d-impulse,box2d-penalty")
        # 246 disks; rings of 2π·30/4.8 = 39 and 2π·75/4.8 = 98 wall disks, to the nearest; 1.25 rotations in steps of 4e-5 s.
        for line in (
            r"quick: 246 disks, 137 wall disks, dt 4e-05 s", r"per packing: 196350 steps[\s\S]*grain +can run it",
            r"(?m)^  effects called for: .*rotation.*; left out: gravity, rolling_resistance, cohesion, pair_materials$",
            r"volume fraction 0\.7\d+, .*39 on the wheel, 98 on the ring",
            r"54\.4 steps in the shortest contact; .*at most 0\.000572 s",
            r"margin of field azimuthal_velocity: 0\.0015 m/s, a share of rim_speed",
            r"predicted time of compare: .* steps were timed on",
        ):  # fmt: skip
            self.assertRegex(done.stdout, line)
        # Of every engine that can run it, mirrors that would run along included.
        able = re.findall(r"(?m)^  \S+ +can run it", done.stdout)
        self.assertGreaterEqual(len(able), 4)
        self.assertEqual(len(able), len(re.findall(r"µs a step: .* a packing, \d+ MB", done.stdout)))
        self.assertEqual([], list(self.folder.iterdir()))

    def test_a_scene_that_an_engine_cannot_be_given_is_a_failure_only_of_one_that_was_named(self):
        space = CASES / "space/pile.toml"
        every = self.check(space, engines="all")
        self.assert_status(every, HELD)
        self.assertRegex(every.stdout, r"(?m)^  box2d-penalty +cannot: has dimension = 2, not 3$")
        named = self.check(space, engines="grain,box2d-penalty")
        self.assert_status(named, FELL_SHORT)
        self.assertIn("status 1: box2d-penalty cannot run it\n", named.stdout)
        self.assert_status(self.check(space, engines="box2d-penalty"), BAD_INPUT)

    def test_numbers_of_differences_are_in_their_sentences(self):
        done = self.held("check", COUETTE, "--no-timing", "--engines", "box2d-impulse")
        for line in (r"largest rounding of positions to float32: 3\.73e-09 m", r"speed above which Box2D slows disks: 1\.3 m/s"):
            self.assertRegex(done.stdout, rf"(?m)^    differs: {line}$")

    def test_refusal_is_status_1(self):
        done = self.check(COUETTE, *settings(run__may_differ=["rounding"]), engines="grain,box2d-impulse")
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"(?m)^ *grain +can run it[\s\S]*^ *box2d-impulse +cannot: .*may_differ")

    def test_engines_have_the_conventions_that_they_share_where_the_case_leaves_them_open(self):
        squeeze = os.path.join(CASES, "assembly/squeeze.toml")
        cut = self.changed_example('"tension": ["allow"]', '"tension": ["cut"]')  # starts in a tenth of YADE's time
        damped = settings(law__gn=0.3, run__may_differ=["damping_velocity", "integrator"])
        done = self.check(squeeze, *damped, engines=f"grain,{cut}")
        self.assert_status(done, HELD)
        self.assertIn('share: law.tension="cut"', done.stdout)
        self.assertNotIn("differs: has tension", done.stdout)
        # Values that the case gives stay, and so does may_differ; one engine alone shares with no other.
        given = self.check(squeeze, *damped, "--set=law.tension=allow", engines=f"grain,{cut}")
        self.assert_status(given, FELL_SHORT)
        self.assertRegex(given.stdout, "numpy +cannot: .*has tension = cut")
        every = self.check(squeeze, "--set=law.gn=0.3", "--set=run.may_differ=conventions", engines=f"grain,{cut}")
        self.assert_status(every, HELD)
        self.assertRegex(every.stdout, "numpy +can run it[^\n]*\n(    differs: .*\n)*    differs: has tension = cut")
        self.assertNotIn("share", every.stdout + self.check(squeeze, *damped, "--set=law.tension=cut", engines=cut).stdout)
        # compare does as check says, and its results have it.
        done = self.run_program("compare", squeeze, *damped, "--engines", f"grain,{cut}", "--out", self.out, "--quiet")
        self.assertRegex(done.stderr, '(?m)^note: .*law.tension="cut"')
        self.assertRegex(self.results()["case"]["toml"], r"tension = ['\"]cut['\"]")

    def test_json_and_resolved(self):
        (checked,) = json.loads(self.check(COUETTE, "--json").stdout)
        self.assertEqual((246, 39), (checked["disks"], checked["cell"]["wheel_disks"]))
        self.assertNotIn("prediction", checked)
        first = self.check(COUETTE, "--resolved", "--set=cell.omega=0.5")
        again = self.check(self.write("again.toml", first.stdout), "--resolved")
        self.assertEqual(first.stdout, again.stdout)
        self.assertIn("omega = 0.5", again.stdout)

    def test_every_flow_is_timed_and_predicted(self):
        for case, bodies in (("assembly/hopper", "disks"), ("space/shear-3d", "spheres")):
            with self.subTest(case):
                path = os.path.join(CASES, case + ".toml")
                command = ("check", path, "--engines", "grain,lammps", *settings(run__may_differ="conventions"))
                (checked,) = json.loads(self.run_program(*command, "--json").stdout)
                flow, prediction = checked["flow"], checked["prediction"]
                self.assertGreater(len(checked["endpoints"]), 0)
                self.assertAlmostEqual(flow["duration_s"], flow["steps"] * checked["dt_s"], delta=checked["dt_s"])
                self.assertRegex(prediction["timed_on"], r"^the flow at t = [\d.e-]+ s$")
                once = sum(row["run_s"] for row in checked["engines"])
                self.assertAlmostEqual(prediction["total_s"], flow["packings"] * once, delta=1e-9 * prediction["total_s"])
                self.assertEqual(0, prediction["preparing_s"])
                for row in checked["engines"]:
                    self.assertAlmostEqual(row["run_s"], row["step_s"] * flow["steps"], delta=1e-9 * row["run_s"])
                    self.assertGreaterEqual(row["timed_steps"], 16)
                said = self.run_program(*command, "--no-timing", "-v").stdout
                self.assertRegex(said, rf"(?s)\d+ {bodies}.* per packing: \d+ steps .*; packings: \d.* margin of endpoint ")
                self.assertNotIn("predicted time", said)

    def test_cautions(self):
        for change, caution in (
            ("particles.small=100", "dilute: .*expect a gas"), ("particles.small=230", "over-dense: "),
            ("run.dt=2e-4", r"only 10\.9 steps in the shortest contact"),
            ("preparation.packings=2", "2 packings: compare judges nothing"),
            ("law.kn=1500", r"run.dt = 4e-05 s is that of .*nu-0.804.toml"),
        ):  # fmt: skip
            done = self.check(COUETTE, f"--set={change}")
            self.assert_status(done, HELD)
            self.assertRegex(done.stdout, f"caution: {caution}")
        # Impulses have no contact that a step must resolve.
        self.assert_status(self.check(COUETTE, "--set=engines.box2d-impulse.dt=2e-3", engines="box2d-impulse"), HELD)

    def test_absent_engines_are_listed_where_all_are_asked(self):
        bare = {"PATH": "/nowhere"}
        self.assertNotIn("not installed", self.check(COUETTE, env=bare).stdout)
        every = self.run_program("check", COUETTE, "--no-timing", env=bare)
        self.assertRegex(every.stdout, "(?m)^  not installed: .*yade")


PAIR = ("--mass=1e-3", "--radius=5e-3")
WANTED = ("--en=0.9", "--et=0.5", "--tc=1e-3", "--mu=0.4")
COLLISION_OF_TWO = '[case]\nkind = "collision"\n{law}\n[collision]\npsi = 0.3\nvn = 1e-3\nradius = 5e-3\nmass = 1e-3\n'


class Calibrate(SystemTest):
    """Formulas have their tests in tests/oracle/calibration_test.cpp; here: what is printed is the law that was asked for."""

    def calibrate(self, *arguments):
        done = self.held("calibrate", *arguments)
        self.assertEqual("", done.stderr)
        return done.stdout

    def implied(self, text, label):
        """The first number after a label of the implied values."""
        found = re.search(rf"(?m)^#   {re.escape(label)} +([-+.e\d]+)", text)
        self.assertIsNotNone(found, text)
        return float(found[1])

    def test_constants_give_back_what_was_wanted(self):
        for tension, tangential in (("allow", "spring"), ("cut", "spring_dashpot")):
            text = self.calibrate(*WANTED, *PAIR, f"--tension={tension}", f"--tangential={tangential}")
            law = tomllib.loads(text)["law"]
            self.assertEqual((tension, tangential), (law["tension"], law["tangential"]))
            constants = [f"--{key}={law[key]!r}" for key in ("kn", "gn", "kt", "gt", "mu") if key in law]
            back = self.calibrate(*constants, *PAIR, f"--tension={tension}")
            for label, value in (("e_n", 0.9), ("e_t0 without slip", 0.5), ("contact time t_c", 1e-3)):
                self.assertEqual(value, self.implied(back, label))

    def test_rolling_and_cohesion_give_back_what_was_wanted(self):
        """By hand: µ_r = tan β; (1 + q) m (ω² + λ²) = k_r on a plane, γ_r = 2 (1 + q) m λ; w = F/(3/2 π R12) of JKR."""
        disk = ("--mass=1e-3", "--mass2=inf", "--radius=5e-3")
        law = tomllib.loads(self.calibrate("--rolling-frequency=20", "--rolling-decay=5", "--rest-angle=12", *disk))["law"]
        self.assertAlmostEqual(math.tan(math.radians(12.0)), law["mu_r"], 12)
        self.assertAlmostEqual(1.5e-3 * ((40.0 * math.pi) ** 2 + 25.0), law["kr"], 9)
        self.assertAlmostEqual(0.015, law["gr"], 12)
        back = self.calibrate(*(f"--{key.replace('_', '-')}={law[key]!r}" for key in ("kr", "gr", "mu_r")), *disk)
        for label, value in (("frequency on a plane, without slip", 20.0), ("decay of its amplitude", 5.0),
                             ("a disk rests on inclines up to", 12.0)):  # fmt: skip
            self.assertEqual(value, self.implied(back, label))
        # An angle has no length, but for whose µ_r it is.
        twice = tomllib.loads(self.calibrate("--rest-angle=12", "--rolling-length=twice_effective"))["law"]
        self.assertAlmostEqual(0.5 * math.tan(math.radians(12.0)), twice["mu_r"], 12)
        pull = tomllib.loads(self.calibrate("--pull-off=1e-3", "--cohesion=jkr", "--radius=1e-3"))["law"]
        self.assertAlmostEqual(1e-3 / (1.5 * math.pi * 0.5e-3), pull["w"], 9)

    def test_stiffness_instead_of_contact_time(self):
        """By hand: m = m12 = 0.5e-3 kg, t_c = π/√(k_n/m − (γ_n/2m)²), e_n = exp(−γ_n t_c/2m)."""
        mass, kn = 0.5e-3, 1e4
        for en in (0.9, 1.0):
            text = self.calibrate(f"--en={en}", f"--kn={kn}", *PAIR)
            half = tomllib.loads(text)["law"]["gn"] / (2 * mass)
            time = math.pi / math.sqrt(kn / mass - half**2)
            self.assertAlmostEqual(en, math.exp(-half * time), 12)
            self.assertAlmostEqual(1, time / self.implied(text, "contact time t_c"), 5)

    def test_wall_is_twice_as_heavy_and_soft_contacts_are_warned_of(self):
        pair, wall = (tomllib.loads(self.calibrate(*WANTED, *PAIR, *more))["law"] for more in ((), ("--mass2=inf",)))
        for key in ("kn", "gn", "kt", "gt"):
            self.assertAlmostEqual(2.0, wall[key] / pair[key], 12)
        self.assertNotIn("warning", self.calibrate(*WANTED, *PAIR, "--vn=0.01"))
        self.assertIn("# warning: soft", self.calibrate(*WANTED, *PAIR, "--vn=1"))

    def test_pairs_of_a_case(self):
        """Lätzel (2003), table 4.1: e_n with tension and without depends on the pair."""
        expected = {
            "small-small": (0.222, 0.341), "small-large": (0.274, 0.378), "large-large": (0.342, 0.428),
            "small-wall": (0.365, 0.446), "large-wall": (0.478, 0.533),
        }  # fmt: skip
        rows = [line.split() for line in self.calibrate(COUETTE).splitlines()]
        found = {row[1]: (float(row[4]), float(row[5])) for row in rows if len(row) > 1 and row[1] in expected}
        self.assertEqual(set(expected), set(found))
        for name, values in expected.items():
            for wanted, printed in zip(values, found[name]):
                self.assertAlmostEqual(wanted, printed, delta=6e-4)
        self.assertEqual(8, len(re.findall(r"(?m)^# variant ", self.calibrate(COLLISION))))

    def test_pairs_of_materials(self):
        """Each pair that differs from [law] as a table of its own, and each row with the law of its own bodies: a
        stiffer pair touches for less time, one without friction has no sliding constant."""
        pairs = (
            "[[law.pairs]]\nbetween = ['glass', 'steel']\nkn = 500.0\nmu = 0.0\n"
            "[[law.pairs]]\nbetween = ['glass', 'glass']\ngt = 0.3\n"
        )
        case = (
            f"[case]\nname = 'two-materials'\nextends = '{COUETTE}'\n[cell]\nwheel_material = 'steel'\nring_material = 'glass'\n"
            f"[particles]\nsmall_material = 'steel'\nlarge_material = 'glass'\n{pairs}"
        )
        text = self.calibrate(self.write("materials.toml", case))
        tables = tomllib.loads(text)["law"]["pairs"]
        found = [(table["between"], table["kn"], table["mu"], table["gt"]) for table in tables]
        self.assertEqual([(["glass", "glass"], 352.1, 0.44, 0.3), (["glass", "steel"], 500, 0, 0.15)], found)
        rows = {row[1]: row for row in (line.split() for line in text.splitlines()) if len(row) > 9}
        self.assertLess(float(rows["small-ring"][6]), float(rows["small-wheel"][6]))  # the stiffer pair
        self.assertEqual("-", rows["small-large"][8])
        self.assertNotEqual("-", rows["large-ring"][8])

    def test_printed_law_loads_and_is_the_same(self):
        def law_and_rows(name, law):
            text = self.calibrate(self.write(name, COLLISION_OF_TWO.format(law=law)))
            table, _, rows = text.partition("\n")[2].partition("\n\n")
            return tomllib.loads(table)["law"], table, rows

        normals = {
            "linear": "kn = 1e4\n", "hertz": "young = [7e7, 2e8]\npoisson = [0.25, 0.4]\n", "polynomial": "k2 = 1e8\nk3 = -1e9\n",
        }  # fmt: skip
        dampers = {"constant": 0.05, "viscoelastic": 1e-5, "critical": 0.4}
        tangentials = ("none", "coulomb", "viscous", "spring", "spring_dashpot")
        mores = ("", 'tension = "cut"\nlever_arm = "contact_point"\nhistory = "force"\n')
        for k, normal in enumerate(normals):
            for j, (damper, gn) in enumerate(dampers.items()):
                # Each normal law and damper with each tangential law once.
                for tangential in tangentials[(k + j) % 3 :: 3]:
                    law = f'[law]\nnormal = "{normal}"\ndamper = "{damper}"\ntangential = "{tangential}"\n'
                    law += f"{normals[normal]}gn = {gn}\n{mores[(k + j) % 2]}"
                    if tangential != "none":
                        law += f"mu = 0.3\ngt = {gn / 2}\n" + ("kt = 8e3\n" if normal != "hertz" else "")
                    with self.subTest(law):
                        first, table, rows = law_and_rows("asked.toml", law)
                        again, _, same = law_and_rows("pasted.toml", table)
                        self.assertEqual(rows, same)
                        self.assertEqual(first.keys(), again.keys())
                        self.assertEqual((normal, gn, damper), (first["normal"], first["gn"], first.get("damper", "constant")))
                        for key, value in first.items():
                            if isinstance(value, str):
                                self.assertEqual(value, again[key])
                            else:
                                self.assertAlmostEqual(1.0, (again[key] or 1.0) / (value or 1.0), 12)


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
        "run.keep_snapshots_of": "compare effects cost",
        "run.energy_ledger": "compare effects cost stability",
    }

    def unused(self, done):
        """What the command says that it does not use."""
        found = re.search(r"(?:does not use|not used:) (.*)", done.stdout)
        return found.group(1).split(", ") if found else []

    def test_of_a_cell_every_key_is_used_or_named(self):
        every = self.write(
            "every.toml",
            f'[case]\nextends = "{COUETTE}"\n[run]\nmirrors = false\nkeep_snapshots = 3\nkeep_snapshots_of = 2\nenergy_ledger = true\n'
            "[cost]\nrepeats = 3\n[averaging]\nmethod = \"slicing\"\n[engines.mine]\nblur = 1\n",
        )
        for command in ("compare", "lockstep", "effects", "cost", "stability"):
            transforms = ["--transforms"] if command == "stability" else []
            done = self.held(
                command, every, "--engines", "grain", "--out", self.out, "--dry-run", "--quiet", *transforms
            )
            unused = self.unused(done)
            for key, users in self.EXPECTED.items():
                with self.subTest(command=command, key=key):
                    named = key in unused or key.split(".")[0] in unused
                    self.assertEqual(command not in users.split(), named, done.stdout)
            self.assertIn("engines.mine", " ".join(unused), "settings of an engine that is not here")

    def test_every_key_that_exists_is_known_here(self):
        """A new key of a section that some commands do without is to be placed above."""
        shared = {"dt", "steps_per_contact", "handover", "may_differ", "precision", "timeout", "line_width"}
        for row in json.loads(self.run_program("list", "keys", "--json").stdout):
            path = f"{row['section']}.{row['key']}"
            if path.startswith(("averaging.", "run.")):
                known = any(path == key or path.startswith(key + ".") for key in self.EXPECTED)
                self.assertTrue(known or path.split(".")[1] in shared, path)

    def test_collide_names_the_keys_that_change_nothing(self):
        def plain(node):
            apart = {"head", "case", "command", "started", "elapsed_s", "machine", "stats", "wall_s", "cpu_s", "toml"}
            if isinstance(node, dict):
                return {key: plain(value) for key, value in node.items() if key not in apart}
            return [plain(each) for each in node] if isinstance(node, list) else node

        def result(*changes):
            done = self.run_program(
                "collide", COLLISION, "-k", "spring_dashpot-cut", "--engines", "grain,box2d-penalty", "--out", self.out,
                "--quiet", "--fresh", *settings(collision__psi=[0.3, 4.0], collision__steps_per_contact=50), *changes,
            )  # fmt: skip
            self.assert_status(done, HELD, FELL_SHORT)
            return plain(self.results()), done

        before, _ = result()
        for key, value in {
            "law.mu": 0.3, "collision.vn": 0.02, "collision.mass": 3e-4, "collision.start_phase": 0.2,
            "collision.counter_spin": 1.0, "collision.margins.psi_f.absolute": 0.04, "run.mirrors": "false",
            "run.precision": '"float"', "run.keep_snapshots": 3,
        }.items():  # fmt: skip
            with self.subTest(key):
                after, done = result(f"--set={key}={value}")
                unused = any(key == each or key.startswith(each + ".") for each in self.unused(done))
                self.assertEqual(before != after, not unused, done.stdout)


class Report(SystemTest):
    def collide(self, *arguments, env=None):
        return self.run_program(
            "collide", COLLISION, "--engines", "grain", "--out", self.out, "--quiet", *QUICK, *arguments, env=env
        )

    def test_report_is_rebuilt_from_results_alone(self):
        self.assert_status(self.collide("-k", "*/spring-*"), HELD, FELL_SHORT)
        self.assertEqual({"spring-tension", "spring-cut"}, {row["variant"] for row in self.results()["variants"]})
        names = ("results.json", "collisions.csv", "summary.md", "junit.xml", "report.html")
        before = {name: (self.out / name).read_bytes() for name in names}
        for name in names[1:]:
            (self.out / name).unlink()
        done = self.held("report", self.out)
        self.assertIn(str(self.out / "report.html"), done.stdout)
        self.assertEqual({"reports": [str(self.out / "report.html")]}, json.loads(self.held("report", self.out, "--json").stdout))
        self.assertEqual(before, {name: (self.out / name).read_bytes() for name in names})
        json.loads(before["results.json"], parse_constant=lambda name: self.fail(f"{name} is not JSON"))
        page = before["report.html"].decode()
        for place in re.findall(r"""(?:src|href)\s*=\s*["']([^"']*)""", page):
            if not place.startswith(("data:", "#")):
                self.assertTrue((self.out / place).exists(), f"it opens offline: {place}")

    def test_without_gnuplot_the_numbers_are_there(self):
        done = self.collide(env={"PATH": "/nonexistent"})
        self.assert_one_line(done, BAD_INPUT, "gnuplot", "crossgrain report")
        for name in ("collisions.csv", "report.html"):
            self.assertTrue((self.out / name).exists(), name)
        self.held("report", self.out)

    def test_results_made_elsewhere_of_another_case_are_not_merged(self):
        self.assert_status(self.collide("-k", "*/spring-cut"), HELD, FELL_SHORT)
        theirs, site = self.folder / "theirs", self.folder / "site"
        shutil.copytree(self.out, theirs)
        kept = theirs / "results.json"
        document = json.loads(kept.read_text(encoding="utf-8"))
        document["machine"]["cpu"] = "their processor"
        kept.write_text(json.dumps(document), encoding="utf-8")
        self.held("report", self.out, theirs, "--out", site)
        self.assertIn("their processor", (site / "index.html").read_text(encoding="utf-8"))
        self.assertRegex(document["case"]["toml"], r"mu = [0-9.]+")
        document["case"]["toml"] = re.sub(r"mu = [0-9.]+", "mu = 0.123", document["case"]["toml"])
        kept.write_text(json.dumps(document), encoding="utf-8")
        refused = self.run_program("report", self.out, theirs, "--out", self.folder / "other")
        self.assert_one_line(refused, BAD_INPUT, "law.mu", "0.123", "--changed-cases")
        self.held("report", self.out, theirs, "--out", self.folder / "other", "--changed-cases")

    def test_several_reports_are_one_site(self):
        self.assert_status(self.collide(), HELD, FELL_SHORT)
        before = {path: path.read_bytes() for path in self.out.rglob("*") if path.is_file()}
        site = self.folder / "site"
        done = self.held("report", self.out, self.out, "--out", site)
        self.assertEqual(f"site: {site / 'index.html'}\n", done.stdout)
        as_json = self.held("report", self.out, "--out", self.folder / "one", "--json").stdout
        self.assertEqual({"site": str(self.folder / "one/index.html")}, json.loads(as_json))
        index = (site / "index.html").read_text(encoding="utf-8")
        for page in ("out/report.html", "out-2/report.html"):
            self.assertIn(f'href="{page}"', index)
            self.assertTrue((site / page).exists(), page)
        for path, content in before.items():
            self.assertEqual(content, path.read_bytes(), "results are not touched")
        self.assert_one_line(self.run_program("report", self.out, "--out", self.out), BAD_INPUT, "results of its own")
        self.assert_one_line(self.run_program("report", site, "--out", self.folder / "other"), BAD_INPUT, "results.json")
        self.assertFalse((self.folder / "other").exists())

    def test_open_calls_the_browser_or_rebuilds_nothing(self):
        self.assert_status(self.collide(), HELD, FELL_SHORT)
        (self.out / "report.html").unlink()
        done = self.run_program("report", self.out, "--open", env={"PATH": "/nowhere"})
        self.assert_one_line(done, BAD_INPUT, "xdg-open")
        self.assertFalse((self.out / "report.html").exists())
        browser = self.write("xdg-open", f'#!/bin/sh\nprintf %s "$1" > "{self.folder}/opened"\n')
        browser.chmod(0o755)
        path = f"{self.folder}:{os.environ['PATH']}"
        self.held("report", self.out, "--open", env={"PATH": path})
        opened = self.folder / "opened"
        wait_for(lambda: opened.exists() and opened.read_text(), PATIENCE, "the browser")
        self.assertEqual(str(self.out / "report.html"), opened.read_text())


class Surroundings(SystemTest):
    """Closed descriptors, full disks, homes that are none."""

    def shell(self, command):
        return subprocess.run(
            ["bash", "-c", command, "bash", PROGRAM], capture_output=True, encoding="utf-8",
            cwd=self.folder, timeout=PATIENCE, check=False, env=environment(None),
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

    def test_reader_that_has_seen_enough(self):
        done = self.shell('"$1" list keys | head -1; echo "${PIPESTATUS[0]}"')
        self.assertIn(int(done.stdout.splitlines()[-1]), (HELD, 128 + signal.SIGPIPE))
        self.assertEqual("", done.stderr)

    def test_homes_that_are_none(self):
        """Packings are kept in memory only, where there is no place for them."""
        short = settings(averaging__rotations=0.01, preparation__packings=1, preparation__rotations=0.0)
        for home in (None, str(self.write("file", ""))):
            with self.subTest(home=home):
                env = {"HOME": home, "CROSSGRAIN_CACHE": None, "XDG_CACHE_HOME": None, "TMPDIR": str(self.folder)}
                self.assert_status(self.compare("--fresh", *short, env=env), HELD)

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


if __name__ == "__main__":
    unittest.main()
