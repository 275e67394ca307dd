"""lockstep, stability with its transforms, baseline and diff, cost as whole runs: what a plain run and golden folders do not show."""

import json
import pathlib
import re
import sys
import unittest

from harness import BAD_INPUT, BUILD, CASES, COLLISION, COUETTE, ENGINE_FAILED, FELL_SHORT, HELD, HOME, PROGRAM, SystemTest, settings

PLANTED = BUILD / "tests/faults/planted_engine"
HARD = CASES / "hard"


class StudyTest(SystemTest):
    def piped(self, name, at_advance, *command):
        """An engine file for that worker, asked through a pipe that does something at each request to advance."""
        pipe = self.write(
            f"{name}.py",
            "import os, subprocess, sys, time\n"
            "requests = os.fdopen(os.dup(3))  # workers read from 3 and answer on 4\n"
            "own, engines = os.pipe()[::-1]\n"
            "os.dup2(engines, 3)\n"
            "subprocess.Popen(sys.argv[1:], pass_fds=(3, 4))\n"
            "for line in requests:\n"
            f"    if '\"advance\"' in line: {at_advance}\n"
            "    os.write(own, line.encode())\n",
        )
        return self.engine_file(name, sys.executable, pipe, *command)


# A tenth of a second of the hopper, and of spheres between bumpy walls, as `effects` and its like run them.
HOPPER = [CASES / "assembly/hopper.toml", *settings(assembly__duration=0.06, average__from=0.02, average__snapshots=20)]
SPHERES = [CASES / "space/shear-3d.toml", *settings(assembly__duration=0.4, average__from=0.1, average__snapshots=20)]


class Effects(SystemTest):
    def legs(self, case, *arguments):
        self.held("effects", *case, "--engines", "grain", "--out", self.out, "--quick", "--quiet", *arguments)
        return {leg["effect"]: leg for leg in self.results()["legs"]}

    def test_of_a_hopper(self):
        """What gravity drives changes most where the walls hold nothing: without friction more disks run out."""
        legs = self.legs(HOPPER, *settings(preparation__packings=4))
        self.assertEqual({"", "normal_damping", "friction", "tangential_spring", "tangential_damping", "rotation"}, set(legs) - {
            "double_precision", "tension_cut"})
        for effect, leg in legs.items():
            self.assertEqual("ran", leg["status"], effect)
            names = [row["endpoint"] for row in leg.get("endpoints", [])]
            self.assertEqual([] if effect == "" else ["discharge", "left", "filling_at_outlet", "velocity_at_outlet", "coordination"], names)
            for row in leg.get("endpoints", []):
                self.assertEqual(("grain", "grain", "effect"), (row["a"], row["b"], row["kind"]))
        self.assertEqual(4, legs["friction"]["packings"])
        page = (self.out / "report.html").read_text()
        self.assertIn("What each effect changes in the endpoints", page)
        self.assertRegex(page, r"averaged in each run: 0.02 to 0.06 s")
        self.assertNotRegex(page, r"\bring 1\b|rotations averaged")

    def test_of_spheres(self):
        legs = self.legs(SPHERES)
        self.assertIn("Friction acts, but no sphere turns", " ".join(one["what"] for one in self.results()["switches"]))
        without = legs["rotation"]
        self.assertNotIn("rotation", without["effects"])
        self.assertTrue(any(ring["change"] for field in without["fields"] for ring in field["rings"]))
        self.assertTrue(all(row["kind"] == "effect" for row in without["endpoints"]))


class Collide(SystemTest):
    def test_what_no_engine_runs_is_refused_before_it_is_solved(self):
        for case, engine, status, solved in ((COLLISION, "grain", HELD, True), (CASES / "collision/cohesion.toml", "box2d-impulse", BAD_INPUT, False)):
            done = self.run_program("collide", case, "--engines", engine, "--out", self.folder / engine, *settings(collision__psi=[0.5]))
            self.assert_status(done, status)
            self.assertEqual(solved, "solving the collisions for reference" in done.stdout + done.stderr, engine)


class Identify(SystemTest):
    def test_convention_of_another_mirror_is_found_in_every_kind_of_flow(self):
        for case in (HOPPER, SPHERES):
            done = self.run_program("identify", *case, "--engines", "grain-as-yade", "--quiet")
            self.assertRegex(done.stdout, r"(?m)^tension +cut +declares cut")
            self.assertIn("from the closest mirror", done.stdout)
            self.assert_status(done, HELD)


class Lockstep(SystemTest):
    def test_rigid_disks_are_equivalent_to_their_precision(self):
        """Single precision is reported as such, and by rule."""
        case = HOME / "tests/studies/rigid.toml"
        self.held("lockstep", case, "--engines", "box2d-impulse", "--out", self.out, "--quiet")
        row = self.results()["lockstep"]["rows"][0]
        self.assertEqual("same_to_its_precision", row["verdict"])
        for at in row["separations"]:
            self.assertGreater(at["largest"], 1e-7)  # rounding is there
            self.assertLess(at["median"], at["rounding"])
        self.assertEqual(16, row["same_to_its_precision"])


class Stability(SystemTest):
    def verdicts(self, case, *arguments, statuses=(HELD, FELL_SHORT), **options):
        done = self.run_program("stability", HARD / f"{case}.toml", *arguments, "--fresh", "--out", self.out, **options)
        self.assert_status(done, *statuses)
        return {row["verdict"] for row in self.rows("stability.csv")}

    def test_cases_after_public_threads_catch_what_they_are_named_after(self):
        """A slipping contact that keeps its anchor, friction of velocity alone, a bounce in seven steps."""
        keeps = self.engine_file("keeps", PLANTED, "keep_spring=1")
        self.assertEqual({"unstable"}, self.verdicts("pushed-and-let-go", "--engines", keeps))
        self.assertEqual({"unstable"}, self.verdicts("pinched", "--engines", "grain", "--set=law.tangential=viscous"))
        self.assertEqual({"degraded"}, self.verdicts("bouncing-ball", "-k", "*/soft", "--engines", "grain", "--set=run.dt=4e-4"))

    def test_where_no_packing_can_be_prepared_the_other_cases_go_on(self):
        """The guard of the engine that prepares them ends it at a rim of 3 m/s; the others never ran there."""
        self.verdicts(
            "couette-rates", "--engines", "grain", "--set=engines.grain.max_overlap=1.0", statuses=(HELD,),
            env={"CROSSGRAIN_CACHE": str(self.folder / "cache")},
        )  # fmt: skip
        rows = {row["variant"]: row for row in self.rows("stability.csv")}
        self.assertEqual(("stable", "refused"), (rows["1"]["verdict"], rows["1e2"]["verdict"]))
        self.assertRegex(rows["1e2"]["reason"], "no packing was prepared: .*overlap by")


TRANSFORMS = [
    "turned by 90°", "turned by 1 rad", "mirrored", "lengths by 2⁻¹⁰", "masses by 2⁻¹⁰", "times by 2¹⁰",
    "renumbered", "restarted", "in one go",
]  # fmt: skip
# Four layers of disks on a floor that slides under them against a stop: gravity, walls that move, stick and slip.
SLIDING = HARD / "restart.toml"


class Transforms(StudyTest):
    def planted(self, name, **patch):
        """An engine with those numbers planted."""
        return self.engine_file(name, PLANTED, *(f"{fault}={value}" for fault, value in patch.items()))

    def transform(self, *engines, status, more=()):
        names = ",".join(map(str, engines))
        done = self.run_program("stability", "--transforms", SLIDING, *more, "--engines", names, "--out", self.out)
        self.assert_status(done, status)
        return done

    def of(self, verdict, engine):
        rows = self.rows("stability.csv")
        return [row["variant"] for row in rows if (row["verdict"], row["engine"]) == (verdict, engine)]

    def test_faults_show_in_the_transform_that_they_break(self):
        expected = {
            "right": ({}, []),
            "gravity-x": ({"gravity_x": 0}, ["turned by 90°", "turned by 1 rad"]),
            "wall-y": ({"wall_velocity_y": 0}, ["turned by 90°", "turned by 1 rad"]),
            "odd": ({"mu_odd": 0.9}, ["renumbered"]),
            "handed": ({"mu_anticlockwise": 0.9}, ["mirrored"]),
            "absolute": ({"least_overlap": 1e-9}, None),
            "forgetful": ({"look_forgets": 1}, ["restarted", "in one go"]),  # both are looked at otherwise
        }
        self.transform(*(self.planted(name, **patch) for name, (patch, _) in expected.items()), status=FELL_SHORT)
        for name, (_, variants) in expected.items():
            if variants is None:
                self.assertIn("lengths by 2⁻¹⁰", self.of("unstable", name))
            else:
                self.assertEqual(variants, self.of("unstable", name), name)
        self.assertEqual([], self.of("refused", "right"))
        for row in self.rows("stability.csv"):
            if row["verdict"] == "unstable":
                self.assertGreater(float(row["value"]), float(row["limit"]))
                self.assertRegex(row["reason"], r"^body \d+ is where it should not be")

    def test_what_the_budget_has_no_time_for_is_not_run_until_there_is(self):
        slow = self.piped("slow", "time.sleep(float(os.environ['DELAY']))", PLANTED)
        command = ["stability", "--transforms", SLIDING, "--engines", slow, "--out", self.out]
        # Some forty snapshots at a third of a second: the run that the others are compared with is given up.
        done = self.run_program(*command, "--budget=1s", env={"DELAY": "0.3"})
        self.assert_status(done, FELL_SHORT)
        self.assertEqual(TRANSFORMS, self.of("not_run", "slow"))
        for row in self.rows("stability.csv"):
            self.assertEqual("", row["value"])
            self.assertRegex(row["reason"], "its part of the budget, [0-9.e-]+ s, leaves no time for it")
        self.assertIn("nothing was judged: the budget ended", done.stdout)
        self.held(*command, "--budget=1h", env={"DELAY": "0"})
        self.assertEqual(TRANSFORMS, self.of("stable", "slow"))

    def test_worker_gets_absolute_paths_from_a_relative_output_folder(self):
        """It may work in a folder of its own."""
        worker = self.write("elsewhere.sh", f'#!/bin/sh\ncd /\nexec "{PROGRAM}" __serve grain\n')
        worker.chmod(0o755)
        engine = self.engine_file("elsewhere", worker)
        self.out = pathlib.Path("o")
        self.transform(engine, status=HELD)
        self.out = self.folder / "o"
        self.assertIn("restarted", self.of("stable", "elsewhere"))


class SceneAudit(SystemTest):
    def audit(self, engine):
        done = self.run_program(
            "stability", *HOPPER, *settings(assembly__duration=0.12, run__may_differ=["conventions"]), "--engines", engine, "--out", self.out, "--quiet", "--fresh")  # fmt: skip
        return done, {row["variant"]: row for row in self.rows("stability.csv")}

    def test_right_engine_is_stable_and_bears_longer_steps(self):
        done, rows = self.audit("grain")
        self.assert_status(done, HELD)
        self.assertEqual({"overlap", "walls", "energy", "wall forces", "rest", "restart", "invariances", "largest step"}, set(rows))
        rest = rows.pop("rest")  # a hopper that runs out
        self.assertEqual(("refused", "has nothing that comes to rest"), (rest["verdict"], rest["reason"]))
        self.assertEqual({"stable"}, {row["verdict"] for row in rows.values()})
        last = rows["largest step"]
        found = re.search(r"up to (\S+) s, (\S+) times the case's own; one contact alone bears (\S+) s", last["reason"])
        _, times, _ = map(float, found.groups())
        self.assertAlmostEqual(1.0 / times, float(last["value"]), delta=0.01)
        self.assertTrue(1.0 < times < 25.0, times)  # 25: two steps a contact

    def test_dashpots_that_drive_and_disks_that_are_too_soft_are_found(self):
        for fault, audit in (("gt=-1.0", "energy"), ("kn=0.0001", "overlap")):
            done, rows = self.audit(self.engine_file(f"planted-{audit}", PLANTED, fault))
            self.assert_status(done, FELL_SHORT)
            self.assertEqual("unstable", rows[audit]["verdict"], rows[audit])

    def test_right_engine_is_not_accused(self):
        """Of a block whose spin is held, a swing that turns back, a pull that begins where a step ends."""
        for scene in ("stick-slip", "rolling/oscillation", "cohesion/dmt-impact"):
            with self.subTest(scene):
                self.held("stability", CASES / f"assembly/{scene}.toml", "--engines", "grain", "--quick", "--quiet", "--fresh", "--out", self.out)
                self.assertLessEqual({row["verdict"] for row in self.rows("stability.csv")}, {"stable", "refused"})


class Baseline(StudyTest):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "before.baseline"

    def keep(self, engines, *arguments, case=COUETTE, file=None):
        done = self.held("baseline", case, "--engines", engines, "--out", file or self.file, "--quiet", *arguments)
        return done

    def diff(self, engines, *arguments, **options):
        return self.run_program("diff", self.file, "--engines", engines, "--quiet", *arguments, **options)

    def test_same_engines_are_the_same_bits_without_any_packing(self):
        engines = "grain,box2d-penalty,box2d-impulse"
        again = self.folder / "again.baseline"
        self.keep(engines, "--starts=1")
        self.keep(engines, "--starts=1", file=again)
        self.assertEqual(self.file.read_bytes(), again.read_bytes())
        self.assertRegex(self.diff(engines, "--dry-run").stdout, r"^would compare 3 engines with \S+ ?\S*; nothing\s+was\s+done")
        self.assert_status(self.diff("grian", "--dry-run"), BAD_INPUT)
        done = self.diff(engines, env={"CROSSGRAIN_CACHE": str(self.folder / "empty")})
        self.assert_status(done, HELD)
        for engine in engines.split(","):
            self.assertRegex(done.stdout, rf"(?m)^{engine} \(.*\) against {engine} \(.*\): same bits$")
        self.assertFalse((self.folder / "empty").exists())

    def test_changed_constant_is_named_with_its_amount_and_a_tiny_one_is_the_same_law(self):
        self.keep("grain", "--starts=3")
        done = self.diff("grain", "--set=law.mu=0.441", "--json")
        self.assert_status(done, FELL_SHORT)
        row = json.loads(done.stdout)["engines"][0]
        self.assertEqual(("differs", "mu"), (row["verdict"], row["windows"]["term"]["name"]))
        self.assertAlmostEqual(1.0 / 440.0, row["windows"]["term"]["amount"], delta=1e-5)
        done = self.diff("grain", "--set=law.kn=352.1001")
        self.assert_status(done, HELD)
        self.assertIn("same law", done.stdout)

    def test_engine_that_refuses_the_case_is_left_out(self):
        done = self.keep("grain,box2d-impulse", "--starts=1", '--set=run.may_differ=["rounding"]')
        self.assertRegex(done.stdout, r"(?m)before.baseline: baseline of grain \S+$")
        self.assertRegex(done.error_lines()[0], "^crossgrain: box2d-impulse cannot run ")

    def test_averages_are_compared_where_they_were_kept(self):
        short = [*settings(averaging__settle_rotations=0.02, averaging__rotations=0.05), "--starts=4", "--endpoints"]
        self.keep("grain", *short)
        self.assertNotIn("averages from", self.diff("grain").stdout)  # the same bits need no runs
        done = self.diff("grain", "--set=law.kn=3521", "--set=run.dt=1e-5")
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"averages from 4 starts:[\s\S]*\n    pressure +disagree: [0-9.]+ margins")

    def test_of_a_hopper(self):
        self.keep("grain", "--starts=2", "--endpoints", *HOPPER[1:], case=HOPPER[0])
        self.assertRegex(self.diff("grain").stdout, r"hopper, 2 starts[\s\S]*same bits")
        done = self.diff("grain", "--set=law.mu=0.5")
        self.assert_status(done, FELL_SHORT)
        self.assertIn("averages from 2 starts", done.stdout)

    def test_collisions(self):
        self.keep("grain", *settings(collision__psi=[0.5, 2.0], collision__steps_per_contact=[50]), case=COLLISION)
        self.assertRegex(self.diff("grain").stdout, r"figure-4-3, 0 starts[\s\S]*same bits")
        done = self.diff("grain", "--set=law.gn=0.2")
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"(?m)^    e_n +\d+ of \d+ changed, most by −")
        self.assert_one_line(self.diff("grain", "--set=case.dimension=3"), BAD_INPUT, "a baseline is of one dimension")

    def test_in_space(self):
        coarse = settings(collision__steps_per_contact=[50])
        for case, name, more in (("shear-3d", "shear-3d, 2 starts", []), ("spheres", "spheres, 0 starts", coarse)):
            self.file = self.folder / f"{case}.baseline"
            self.keep("grain", "--starts=2", *more, case=CASES / f"space/{case}.toml")
            self.assertRegex(self.diff("grain").stdout, rf"{name}[\s\S]*same bits")
            self.assert_status(self.diff("grain", "--set=law.mu=0.45"), FELL_SHORT)

    def test_engine_that_fails_is_status_3(self):
        self.keep("grain", "--starts=1")
        self.assert_status(self.diff(self.piped("dies", "os._exit(7)", PROGRAM, "__serve", "grain")), ENGINE_FAILED)


class Cost(StudyTest):
    def cost(self, *arguments, engines="grain"):
        return self.run_program(
            "cost", CASES / "cost/quick.toml", "--engines", engines, "--out", self.out, "--quick",
            *settings(cost__kinds=["collision"], cost__knobs=["time_step"]), *arguments,
        )  # fmt: skip

    def test_printed_fragment_is_a_case(self):
        done = self.cost("--quiet", "--want", "10%")
        self.assert_status(done, HELD)
        case = self.write("pasted.toml", f'[case]\nextends = "{CASES / "cost/quick.toml"}"\n\n{done.stdout}')
        self.held("check", case, "--engines", "grain", "--no-timing")

    def test_sizes_that_were_timed_are_taken(self):
        """Their numbers of steps follow a timing, which differs in each call."""
        sizes = settings(cost__kinds=[], cost__knobs=["disks"], cost__disks=[1])
        kept = []
        for _ in range(2):
            self.assert_status(self.cost("--quiet", *sizes), HELD)
            kept.append((self.finished_runs(), self.rows("scale.csv")))
        self.assertTrue(any(name.startswith("steps-") for name in kept[0][0]), kept[0][0])
        self.assertEqual(*kept)

    def test_an_engine_more_and_no_time_take_nothing_back(self):
        paths = settings(cost__kinds=["trajectory"])
        ran = {}
        for engines, budget in (("grain", "1h"), ("grain,grain-as-lammps", "0.001s")):
            self.assert_status(self.cost("--quiet", "--budget", budget, *paths, engines=engines), HELD)
            ran[engines] = [
                (row["setting"], row["measure"], row["error"], row["low"], row["high"])
                for row in self.rows("cost.csv") if row["engine"] == "grain" and row["status"] == "ran"
            ]  # fmt: skip
        self.assertTrue(ran["grain"])
        self.assertEqual(ran["grain"], ran["grain,grain-as-lammps"])

    def test_of_every_kind_of_flow(self):
        """Collisions of its bodies, planes among them, paths, and its own endpoints in a second of the scene."""
        for case, endpoints in ((HOPPER, "discharge"), (SPHERES, "normal_stress")):
            out = self.folder / pathlib.Path(case[0]).stem
            done = self.run_program("cost", *case, "--engines", "grain", "--quick", "--quiet", "--want=10%", "--out", out,
                                    *settings(cost__knobs=["time_step"], cost__average_steps=[50], cost__trajectory_steps=[50]))
            self.assert_status(done, HELD)
            rows = [row for row in self.rows("cost.csv", out) if row["status"] == "ran"]
            for kind, measure in (("collision", "e_n"), ("trajectory", "position_rms_own"), ("averages", endpoints)):
                errors = [float(row["error"]) for row in rows if (row["error_kind"], row["measure"]) == (kind, measure) and row["error"]]
                self.assertTrue(errors, (kind, measure))
                self.assertTrue(all(0.0 <= error < 1.0 for error in errors), errors)
            self.assertIn("a second of the scene", (out / "report.html").read_text())

    def test_disks_of_a_file_collide_as_its_smallest_and_largest(self):
        case = CASES / "assembly/sandpile-small.toml"
        done = self.run_program("cost", case, "--engines", "grain", "--quick", "--quiet", "--out", self.out,
                                *settings(cost__kinds=["collision"], cost__knobs=["time_step"]))  # fmt: skip
        self.assert_status(done, HELD)
        self.assertTrue(any(row["measure"] == "e_n" and row["error"] for row in self.rows("cost.csv")))

    def test_what_does_not_fit_the_budget_is_not_measured(self):
        done = self.cost("--budget", "0.002s")
        self.assert_status(done, HELD)
        self.assertIn("are left of its share of the budget of 0.002 s", done.stderr)
        # "undecided" is what files call it; it is neither that of a target nor not reached.
        left_out = [point for point in self.results()["points"] if point["status"] == "undecided"]
        self.assertTrue(left_out)
        self.assertRegex(done.stdout, rf"\b{len(left_out)} not measured\n")
        for point in left_out:
            self.assertIn("would take about", point["reason"])
            self.assertIsNone(point["error"])

    def test_a_budget_without_room_for_endpoints_says_so_first_and_names_the_one_that_has(self):
        run = ["cost", *HOPPER, "--engines", "grain", "--quick", "--out", self.out,
               *settings(cost__knobs=["time_step", "disks"], cost__average_steps=[50])]  # fmt: skip
        done = self.run_program(*run, "--budget=0.01s")
        self.assert_status(done, FELL_SHORT)
        budget = re.search(r"No endpoint of the scene was measured .*; predicted: --budget (\d+)([smh]) for grain", done.stdout)
        self.assertTrue(budget, done.stdout)
        self.assertEqual(self.results()["steps"], [])
        done = self.run_program(*run, f"--budget={4 * int(budget[1])}{budget[2]}")  # on a machine that slows down meanwhile, too
        self.assert_status(done, HELD)
        self.assertNotIn("No endpoint", done.stdout)
        ran = [row for row in self.rows("cost.csv") if row["error_kind"] == "averages" and row["status"] == "ran"]
        self.assertTrue(ran)

    def test_threads_do_the_same_steps_and_columns_follow_from_each_other(self):
        for case in (CASES / "cost/quick.toml", SPHERES[0]):
            out = self.folder / pathlib.Path(case).stem
            done = self.run_program("cost", case, "--engines", "grain", "--quick", "--quiet", "--out", out, "--threads=1,2",
                                    "--disks=1,1000", *settings(cost__kinds=[], cost__timed=1e-4))  # fmt: skip
            self.assert_status(done, HELD)
            rows = self.rows("scale.csv", out)
            self.assertTrue(all(row["status"] == "ran" for row in rows), rows)
            one, two, more = rows[0], rows[1], rows[-1]  # between them what weak scaling needs
            self.assertEqual(["1", "2", "2"], [row["workers"] for row in (one, two, more)])
            self.assertEqual(one["contacts_per_step"], two["contacts_per_step"])
            self.assertGreater(int(more["disks"]), int(one["disks"]))
            for row in rows:
                self.assertAlmostEqual(float(row["ns_per_disk"]), float(row["step_s"]) / int(row["disks"]) * 1e9)
                self.assertTrue(float(row["low_s"]) <= float(row["step_s"]) <= float(row["high_s"]))
                # The in-house engine alone is some MB, and no more than some tens.
                self.assertTrue(2e6 < float(row["memory_bytes"]) < 2e8, row["memory_bytes"])
            self.assertAlmostEqual(float(two["strong"]), float(one["step_s"]) / (2 * float(two["step_s"])))

    def test_scene_that_cannot_be_made_larger_says_why(self):
        done = self.run_program("cost", *HOPPER, "--engines", "grain", "--quick", "--quiet", "--out", self.out, "--threads=1",
                                "--disks=1,4000", *settings(cost__kinds=[], cost__timed=1e-4))  # fmt: skip
        self.assert_status(done, HELD)
        own, more = self.rows("scale.csv")
        self.assertEqual(("ran", "refused"), (own["status"], more["status"]))
        self.assertRegex(more["reason"], "cannot be made larger: a plane of .* lies across x")

    def test_engine_that_dies_leaves_the_others_timings(self):
        """A worker that ends while it steps: one line, status 3, and what was timed is there."""
        dies = self.piped("dies", "os._exit(7)", PROGRAM, "__serve", "grain")
        done = self.run_program("cost", CASES / "cost/quick.toml", f"--engines=grain,{dies}", "--quick", "--quiet", "--out", self.out,
                                *settings(cost__kinds=[], cost__timed=1e-4))  # fmt: skip
        self.assert_one_line(done, ENGINE_FAILED, "dies", "exit status 7", "advance")
        self.assertEqual(["ran"], [row["status"] for row in self.rows("scale.csv")])


if __name__ == "__main__":
    unittest.main()
