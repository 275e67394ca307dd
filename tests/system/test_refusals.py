"""What the user gave cannot be used: status 2, one line that says where and what, and nothing is written.

Every message of the loader has its test in tests/cases_loader; here are those of the command line, one of each way in, and
files that are none.
"""

import json
import os
import re
import shlex
import subprocess
import unittest

from harness import BAD_INPUT, CASES, COLLISION, COUETTE, FELL_SHORT, HARD_SPHERE, HELD, PROGRAM, SystemTest, settings

CELL, PAIR, RIGID, PILE = COUETTE, COLLISION, HARD_SPHERE, CASES / "hard/pile.toml"
RUN = "--engines grain --out out --quiet"
MATERIAL = "--mass=1e-3 --radius=5e-3"
WANTED = f"--en=0.9 --et=0.5 --tc=1e-3 --mu=0.4 {MATERIAL}"
THESIS = "--kn=352.1 --gn=0.19 --kt=267.1 --gt=0.15 --mu=0.44 --mass=0.275e-3 --radius=3.7e-3"

COMMAND_LINE = {
    "": ("no command", "see crossgrain --help"),
    "comprae": "comprae",
    "help comprae": ("no command 'comprae'", "did you mean compare?"),
    "engines --jsno": "--jsno",
    "engines -q": ("no option '-q'", "see crossgrain engines --help"),
    "--jobs 3 engines": ("no option '--jobs'", "see crossgrain --help"),
    f"compare {CELL} --enginees grain --out out": "no option '--enginees' (did you mean --engines?); see crossgrain compare --help",
    "compare": ("case, --engines, --out are missing", "see crossgrain compare --help"),
    f"compare {CELL} --engines=grain": "--out is missing (folder for results",
    f"compare {CELL} --out=out --engines": "--engines needs a value (engines",
    f"compare {CELL} --engines grain --out ''": "--out",
    f"check {CELL} {PAIR}": "figure-4-3.toml' is one argument too many: check takes case",
    "engines grian": "there is no engine 'grian' (did you mean grain?)",
    f"compare {CELL} {RUN} --out b": "--out is given twice",
    f"compare {CELL} {RUN} --json=maybe": "--json takes no value",
    f"stability {RUN} --transforms --in-space": "--transforms and --in-space do not go together",
    f"compare {CELL} {RUN} --jobs=0": ("--jobs: ", "from 1 to 4096", "'0'", "see crossgrain compare --help"),
    f"compare {CELL} {RUN} --jobs=1.5": ("--jobs: ", "must be a whole number"),
    f"compare {CELL} {RUN} --jobs=99999999999999999999": "from 1 to 4096",
    f"compare {CELL} {RUN} --seed=-1": ("--seed: ", f"from 0 to {2**63 - 1}"),
    f"compare {CELL} {RUN} --seed={2**63}": f"from 0 to {2**63 - 1}",
    f"compare {CELL} {RUN} --seed=4294967296": "seed",
    f"cost {CELL} {RUN} --budget=10x": "--budget 10x: must be like 90s, 10m or 1h",
    f"cost {CELL} {RUN} --want=-1%": "--want -1%: must be like",
    f"compare {CELL} --out='/proc/no\nsuch' --engines=grain --quiet": "/proc/no",
    "list feilds": ("'feilds'", "did you mean fields?"),
    "list cases gone": "gone: No such file",
}
ENGINES = {
    f"compare {CELL} --engines=box2d-penatly --out out": ("--engines", "'box2d-penatly'", "did you mean box2d-penalty?"),
    f"check {CELL} --engines=Grain": ("'Grain'", "did you mean grain?"),
    f"check {CELL} --engines=grain,,yade": "--engines 'grain,,yade': a name is empty",
    f"check {CELL} '--engines=grain, grain'": "'grain' is named twice",
    f"check {CELL} --engine grain": "did you mean --engines grain?",
    f"lockstep {CELL} --engines ./none.toml --out out": "no such file",
    f"identify {CELL} --engines grain,yade": "identify takes one engine",
    f"identify {CELL} --engines box2d-impulse": "another normal law",
    f"record {PAIR} --engines grain,yade --out r.rec": "one engine",
    f"record {PAIR} --engine=gone=/no/such/program --engines gone --out r.rec": "/no/such/program",
    f"compare {CELL} --engines box2d-penalty --out out --quiet '--set=run.may_differ=[\"rounding\"]'": (
        "box2d-penalty cannot run", "quick.toml", "damping_velocity = lagged, not predicted", '"damping_velocity"',
    ),
    f"compare {CELL} {RUN} --set=preparation.engine=box2d-penalty": "box2d-penalty cannot prepare packings of",
    f"compare {CELL} --engines box2d-impulse --out out --quiet --set=law.rolling=constant_torque --set=law.mu_r=0.1": (
        "box2d-impulse cannot run", "has no rolling_resistance", '"rolling_resistance" under [run] may_differ',
    ),
    f"compare {CELL} --engines box2d-impulse --out out --quiet --set=law.cohesion=dmt --set=law.w=0.1": "has no cohesion",
    "conformance yad": "did you mean yade?",
    "conformance all": "takes one engine",
}  # fmt: skip
CASE_FILES = {
    "check gone.toml": "gone.toml: no such file",
    "check ''": "file",
    "check /dev/null/x": "/dev/null/x",
    f"check {CELL.with_name('quik.toml')}": ("quik.toml: no such file", "did you mean", "quick.toml?"),
    f"check {CELL.parent}": ("couette: is a folder, not a file", "quick.toml"),
    "check /proc/self/mem": "mem: cannot be read",
    "check pipe.toml": "is a named pipe, not a file",
    f"average pipe.toml {CELL} --out out": "is a named pipe",
    f"average text.h5 {CELL} --out out": ("text.h5", "is no HDF5 file"),
    "check noise.toml": "noise.toml:1:1",
    "check mistaken.toml": ("mistaken.toml:4:1", "unknown key particles.smal_mass", "did you mean small_mass?"),
    "check mine/case.toml": "secret.toml:1:",
    f"compare --engines grain gone.toml --out out": "gone.toml: no such file",
    f"collide {CELL} {RUN}": ("quick.toml", "collide takes two bodies that meet once", "crossgrain compare can run it"),
    f"compare {RIGID} {RUN}": ("hard-sphere.toml", "compare needs a flow, and here two bodies meet once"),
    f"compare {PILE} {RUN}": "give it [average] and [[endpoints]]",
    f"cost {PAIR} {RUN}": "cost needs a flow, and here two bodies meet once; crossgrain collide can run it",
    f"effects {PAIR} {RUN}": "effects needs a flow",
    f"lockstep {PAIR} {RUN}": "lockstep needs a flow",
    f"baseline {PILE} --engines grain --out b.h5": "give it [average] and [[endpoints]]",
    f"baseline {PAIR} --engines grain --out b.h5 --endpoints": ("--endpoints", "has no endpoints to keep"),
    f"collide mine {RUN}": "secret.toml",
    f"collide twins {RUN}": ("b.toml", "twin"),
    f"stability {PILE.parent} -k pille {RUN}": ("-k 'pille'", "pile"),
    f"collide {PAIR} -k coulomb-tensoin {RUN}": ("-k 'coulomb-tensoin'", "coulomb"),
    f"compare several.toml {RUN}": "compare takes a case without variants",
    f"identify several.toml --engines yade": "identify takes a case without variants",
    "report .": "results.json",
    "report other": ("results.json", '"other-1"'),
}
VALUES = {
    f"check {CELL} --set=averaging.rings": "--set averaging.rings: must be key.path=value",
    f"check {CELL} --set=averaging.rings=": "key.path=value",
    f"check {CELL} --set=averagin.rings=3": "unknown key averagin (did you mean averaging?)",
    f"check {CELL} --set=averaging..rings=3": "averaging..rings=3",
    f"check {CELL} --set=case.extends=x": "case.extends",
    f"check {CELL} --set=law.tension=cutt": ("--set law.tension=cutt", "did you mean cut?"),
    f"check {CELL} --set=averaging.confidence=1.5": ("--set averaging.confidence=1.5", "(0, 1)"),
    f"check {CELL} --set=engines.grian.skin=1.0": ("grian", "did you mean grain?"),
    f"check {CELL} --set=engines.grain.skim=0.1": ("[engines.grain]", "'skim'", "skin"),
    f"check {CELL} --set=engines.grain.skin=wide": ("[engines.grain]", "skin", "a number", "a string"),
    f"check {CELL} --set=engines.lammps.ranks=0": ("[engines.lammps]", "ranks", "must be"),
    f"check {RIGID} --engines ode --set=engines.ode.relaxation=0.0": "[engines.ode] relaxation = 0 must be from 0.01 to 1.99",
    f"check {RIGID} --engines bullet --set=engines.bullet.dt=1e-300": "[engines.bullet] dt = 1e-300 s must be 0, or from 5e-10 to 500 s",
    f"check {CELL} --engines grain --set=engines.grain.dt=0.01": "[engines.grain] dt = 0.01 s is beyond",
    f"compare {CELL} {RUN} --set=run.dt=1": "run.dt = 1 s is beyond 0.000572 s",
    f"cost {CASES / 'cost/quick.toml'} {RUN} --set=cost.omega=[2]": "is a key no more",
    f"cost {CASES / 'convex/heap.toml'} {RUN}": "cost of rigid bodies needs [[endpoints]] with expected values",
    f"baseline {CASES / 'convex/heap.toml'} {RUN}": "baseline needs grain, which has no convex bodies",
    f"identify {CASES / 'convex/heap.toml'} --engines=chipmunk": "identify needs grain, which has no convex bodies",
    **{f"cost {CASES / 'convex/slide.toml'} {RUN} --want={want}": f"--want {want}: must be like 1 or 0.5, in margins" for want in ("0", "nan", "x", "1%")},
    f"cost {CASES / 'convex/slide.toml'} {RUN} --set=cost.iterations=[1e9]": "cost.iterations[0] = 1000000000.0: must be in [0.001, 1000]",
    f"cost {CASES / 'convex/slide.toml'} {RUN} --set=cost.rigid_steps=[2e3]": "cost.rigid_steps[0] = 2000.0: must be in [0.001, 1000]",
    f"cost {CASES / 'convex/slide.toml'} {RUN} '--set=cost.kinds=[\"collision\"]'": "cost.kinds: of rigid bodies there are averages alone",
    f"lockstep {CELL} {RUN} --starts=2.5": "--starts",
    f"record {PAIR} --engines grain --out r.rec --time=-1": "must be > 0",
    f"record {PAIR} --engines grain --out r.rec --looks=0": "from 1 to",
    "scale --engines grain --out out": "cost CASE --disks N,N",
    f"plan {CELL} --engines grain --slurm out": ("there is no command 'plan' any more", "--shard K/N"),
    f"compare {CELL} {RUN} --shard=3/2": "1 <= K <= N",
    f"compare {CELL} {RUN} --shard=2": "like 2/4",
    "thesis --quick --out out": ("there is no command 'thesis' any more", "papers/laetzel-2003"),
    "help thesis": ("there is no command 'thesis' any more", "papers/laetzel-2003"),
    "help scale": "cost CASE --disks N,N",
    "help rev": "crossgrain average FILES CASE --rev does its work",
    f"cost {CELL} {RUN} --disks=0": "must be in [1, 20000000]",
    f"cost {CELL} {RUN} --disks=1000.5": "no whole number",
    f"cost {CELL} {RUN} --threads=many": "cost.threads=[many]",
    f"stability --transforms {PILE} {RUN} --budget=soon": "must be like 90s",
    f"stability {PILE} {RUN} --budget=1m": "goes with --transforms",
    "diff none.h5 --engines grain": "none.h5: no such file",
    "diff text.h5 --engines grain": "`crossgrain baseline CASE --out FILE` makes one",
    f"baseline {CELL} --engines grain --out text.h5": "this file exists, and a baseline is not replaced",
    f"record {PAIR} --engines grain --out text.h5": "is not replaced",
}
SPHERES = CASES / "space/shear-3d.toml"
IN_SPACE = {  # what knows no assembly of spheres
    "rev run.h5 case.toml --out out": "crossgrain average FILES CASE --rev does its work",
    f"average none.h5 {SPHERES} --out out": "none.h5: no such file",
    f"stability {SPHERES} {RUN} --in-space": "these are in space as they are",
    f"compare {SPHERES} --engines chipmunk --out out": "has dimension = 2, not 3",
    f"compare {SPHERES} --engines bullet --out out": "has no periodic directions",
    f"compare {CASES / 'space/drum.toml'} --engines yade --out out": "has no cylinders, as wall-0 has",
    f"compare {SPHERES} {RUN} --set=case.dimension=2": "must be [x, y] in m",
    f"compare {SPHERES} {RUN} --set=assembly.box.high=[10,1.9,12]": "must be wider than two reaches",
}
CALIBRATION = {
    "": "one of",
    f"--en=0.9 {CELL}": "one of",
    "--en=0.9 --tc=1e-3 --radius=1": "--mass is missing",
    f"--en=0.9 {MATERIAL}": "--tc is missing",
    f"--en=0.9 --tc=1e-3 --kn=1 {MATERIAL}": "--tc and --kn: with e_n each gives the other",
    f"--en=0.9 --gn=1 --kn=1 {MATERIAL}": "--en and --gn: e_n gives gn",
    f"--en=0.9 --et=0.5 --kt=1 --kn=1 {MATERIAL}": "--et and --kt",
    f"--tc=1e-3 {MATERIAL}": "--en is missing",
    f"--en=0.9 --tc=1e-3 --mu=0.4 {MATERIAL}": "--et is missing",
    f"--en=0 --tc=1e-3 {MATERIAL}": "--en = 0: must be in (0, 1]",
    f"--en=nan --tc=1e-3 {MATERIAL}": "--en = nan",
    "--en=high": "--en: must be a number, not 'high'",
    f"--en=0.9 --tc=-1 {MATERIAL}": "--tc = -1: must be > 0 s",
    f"--en=0.9 --tc=1e-300 {MATERIAL}": "--tc = 1e-300",
    f"--en=0.1 --tc=1e-3 --tension=cut {MATERIAL}": "exp(-2) = 0.1353",
    f"--et=-0.5 --en=0.9 --tc=1e-3 {MATERIAL}": "0 < e_t0 <= 1",
    f"{WANTED} --tension=cutt": "did you mean cut?",
    f"{WANTED} --tangential=viscous": "--tangential = viscous",
    f"{WANTED} --set=law.mu=1": "--set",
    f"--kn=1 {MATERIAL}": "--gn is missing: an undamped law says 0 [kg/s]; or --en, if kn is wanted",
    f"--kn=352.1 --gn=1 {MATERIAL}": "must be < 0.839166 kg/s",
    f"{THESIS} --tangential=spring": "--tangential",
    f"{CELL} --mass=1": "the case file says it",
    f"{RIGID}": "rigid",
}


class Refusals(SystemTest):
    def names(self):
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*"))

    def refuse_all(self, table, *first):
        before = self.names()
        for line, fragments in table.items():
            with self.subTest(line):
                done = self.run_program(*first, *shlex.split(line))
                self.assert_one_line(done, BAD_INPUT, *([fragments] if isinstance(fragments, str) else fragments))
                self.assertLess(len(done.stderr), 700)
                self.assertEqual(before, self.names(), "nothing is written")

    def test_command_line(self):
        self.refuse_all(COMMAND_LINE)

    def test_engines(self):
        self.refuse_all(ENGINES)

    def test_values(self):
        self.write("text.h5", "{}")
        self.refuse_all(VALUES)

    def test_spheres(self):
        self.refuse_all(IN_SPACE)

    def test_calibrate(self):
        self.refuse_all(CALIBRATION, "calibrate")

    def test_case_files(self):
        os.mkfifo(self.folder / "pipe.toml")
        self.write("text.h5", "no HDF5")
        (self.folder / "noise.toml").write_bytes(bytes(range(256)))
        self.write("mistaken.toml", f'[case]\nextends = "{CELL}"\n[particles]\nsmal_mass = 1e-3\n')
        self.write("several.toml", f'[case]\nextends = "{CELL}"\n[[variants]]\nname = "a"\n[[variants]]\nname = "b"\n')
        for folder in ("theirs", "mine", "twins", "other"):
            (self.folder / folder).mkdir()
        self.write("theirs/secret.toml", "root:hunter2:0\n")
        self.write("mine/case.toml", '[case]\nextends = "../theirs/secret.toml"\n')
        for name in ("a", "b"):
            self.write(f"twins/{name}.toml", f'[case]\nname = "twin"\nkind = "collision"\nextends = "{PAIR}"\n')
        self.write("other/results.json", '{"schema": "other-1", "kind": "compare"}')
        self.refuse_all(CASE_FILES)
        self.assertNotIn("hunter2", self.run_program("check", "mine/case.toml").stderr, "foreign files are not quoted")

    def test_name_that_is_no_utf8(self):
        done = subprocess.run([PROGRAM, b"check", b"caf\xe9.toml"], capture_output=True, check=False, cwd=self.folder)
        self.assertEqual(BAD_INPUT, done.returncode)
        self.assertRegex(done.stderr, rb"^crossgrain: argument 2 .*is not UTF-8.*\n$")

    def test_setting_out_of_range_is_refused_by_every_command(self):
        for command in (
            f"check {CELL}", f"compare {CELL} --out out", f"effects {CELL} --out out", f"cost {CELL} --out out",
            f"lockstep {CELL} --out out", f"identify {CELL}", f"collide {PAIR} --out out", f"stability {PILE} --out out",
            f"stability --transforms {CELL} --out out", f"baseline {CELL} --out b.h5", f"record {CELL} --out r.rec",
        ):  # fmt: skip
            with self.subTest(command):
                done = self.run_program(*command.split(), "--engines", "grain", "--set=engines.grain.threads=0")
                self.assert_status(done, BAD_INPUT)
                self.assert_line(done.stderr.splitlines()[-1], "[engines.grain]", "threads = 0", "a whole number from 1 to 1024")

    def test_of_two_engines_the_first_named_is_reported(self):
        """The one in Python answers last."""
        own = CASES.parent / "examples/python/engine.toml"
        wrong = ["--set=engines.numpy.skim=1.0", "--set=engines.grain.skim=0.1"]
        done = self.compare("--quiet", *wrong, engines=f"{own},grain")
        self.assert_one_line(done, BAD_INPUT, "[engines.numpy]", "'skim'")

    def test_refused_command_leaves_earlier_runs_alone(self):
        (self.out / "runs").mkdir(parents=True)
        self.write("out/runs/grain-p0.json.gz", "{}")
        self.assert_status(self.compare("--quiet", engines="grian"), BAD_INPUT)
        self.assertEqual(["grain-p0.json.gz"], [file.name for file in (self.out / "runs").iterdir()])

    def test_results_are_looked_for_where_they_were_named_only(self):
        (self.folder / "data/out").mkdir(parents=True)
        self.write("data/out/results.json", "{}")
        done = self.run_program("report", "out", env={"CROSSGRAIN_DATA": str(self.folder / "data")})
        self.assert_one_line(done, BAD_INPUT, "out/results.json: cannot be read")

    def test_all_folders_are_read_before_any_report_is_rebuilt(self):
        self.write("results.json", '{"schema": "crossgrain-results-1", "kind": "collide"}')
        self.assert_one_line(self.run_program("report", self.folder, self.folder / "gone"), BAD_INPUT, "gone")


class Unsupported(SystemTest):
    """An engine cannot do the scene, and the case does not let it differ."""

    def test_advice_works_where_it_is_followed(self):
        """Laws of which each engine lacks something: what a refusal has listed under may_differ is all that it takes."""
        laws = (
            'rolling = "constant_torque"\nmu_r = 0.3\ncohesion = "dmt"\nw = 0.05\n',
            'rolling = "spring"\nmu_r = 0.3\nkr_factor = 2.25\ncohesion = "elasto_plastic"\nk_unload = 2e4\nkc = 1e3\nplastic_depth = 0.05\n',
        )
        advised, refused = 0, 0
        for number, law in enumerate(laws):
            case = self.write(
                f"law-{number}.toml",
                '[case]\nname = "advice"\nkind = "collision"\n[law]\nnormal = "linear"\ntangential = "spring_dashpot"\nkn = 1e4\n'
                f"gn = 0.2\nkt = 3e3\ngt = 0.05\nmu = 0.4\n{law}[collision]\nsecond = \"wall\"\npsi = [0.5]\nvn = 0.1\nradius = 5e-3\n"
                'mass = 1e-3\nsteps_per_contact = 50\n[collision.margins]\ne_n = { absolute = 0.01, why = "none" }\n',
            )
            def check(engine, *more, case=case):
                return json.loads(self.run_program("check", case, "--engines", engine, "--no-timing", "--json", *more).stdout)[0]["engines"]

            advice = {}  # engines by what they ask for
            for row in check("all"):
                refused += not row["can"]
                listed = re.findall(r'"([^"]+)"', row["reason"].partition("; list ")[2].partition(" under [run]")[0])
                if not row["can"] and listed:
                    advised += 1
                    advice.setdefault(json.dumps(listed), []).append(row["name"])
            for listed, engines in advice.items():
                for again in check(",".join(engines), f"--set=run.may_differ={listed}"):
                    with self.subTest(law=law, engine=again["name"], listed=listed):
                        self.assertTrue(again["can"], again["reason"])
        self.assertGreater(advised, 3)
        self.assertGreaterEqual(refused, advised)

    def test_lacking_law(self):
        done = self.run_program("collide", RIGID, "--engines", "box2d-penalty", "--out", self.out, "--quiet")
        self.assert_one_line(done, BAD_INPUT, "box2d-penalty", "hard-sphere.toml", 'normal = linear | hertz, not "rigid"')
        self.assertNotIn("may_differ", done.stderr)  # which would not help

    def test_advice_of_a_refusal_is_the_way_out(self):
        allowed = ["normal", "bottom_spin_friction"]
        impulse = settings(preparation__packings=1, averaging__rotations=0.01) + ["--set=engines.box2d-impulse.dt=5e-4"]
        done = self.compare("--quiet", *impulse, *settings(run__may_differ=allowed), engines="box2d-impulse")
        self.assert_one_line(
            done, BAD_INPUT, "box2d-impulse cannot run", "quick.toml", 'list "bottom_friction" under [run] may_differ'
        )
        done = self.compare(
            "--quiet", *impulse, *settings(run__may_differ=[*allowed, "bottom_friction"]), engines="grain,box2d-impulse"
        )
        # One packing has no verdict, but rigid disks hold twelve times the pressure.
        self.assert_status(done, FELL_SHORT)
        self.assertRegex(done.stdout, r"ALARM: box2d-impulse against grain: pressure is \d+ margins")

    def test_all_refused_each_says_why_and_what_lets_all_run(self):
        """Fewer than two engines can run the case: status 2, a line for each that cannot, and what to list."""
        cut = settings(run__may_differ=[]) + ["--set=law.lever_arm=radius", "--set=law.tension=cut"]
        # One that can is enough for all but `compare`.
        for command, engines in (("compare", "grain,yade,lammps"), ("lockstep", "yade,lammps")):
            done = self.run_program(command, CELL, "--engines", engines, "--out", self.out, "--quiet", *cut)
            self.assert_status(done, BAD_INPUT)
            lines = done.error_lines()
            self.assertEqual(3, len(lines), done)
            for line, name in zip(lines, ("yade", "lammps")):
                self.assert_line(line, f"{name} cannot run", "has no bottom_friction", '("conventions" lists all conventions)')
            listed = '["bottom_friction", "bottom_spin_friction", "conventions"]'
            self.assertEqual(f"crossgrain: all of them run it with [run] may_differ = {listed}", lines[2])
        self.held(
            "check", CELL, "--engines=yade,lammps", "--no-timing", *cut[1:], f"--set=run.may_differ={listed}"
        )
        for engines, *rest in (("bullet,chipmunk", "collide", COLLISION, *cut[:1]), ("yade,lammps", "baseline", CELL, "--quick", *cut)):
            done = self.run_program(*rest, "--engines", engines, "--out", rest[0], "--quiet")
            self.assert_status(done, BAD_INPUT)
            self.assertEqual(engines.split(","), [line.split()[1] for line in done.error_lines()])

    def test_engine_that_cannot_run_is_left_out_and_the_first_that_can_is_the_reference(self):
        allowed = ["damping_velocity", "integrator", "bottom_friction", "bottom_spin_friction", "rounding"]
        asked = settings(run__may_differ=allowed + ["tangential_restitution"], averaging__rotations=0.02)
        for strict, status in ((["--strict"], FELL_SHORT), ([], HELD)):
            done = self.compare("--quiet", *asked, *strict, engines="box2d-impulse,grain,box2d-penalty")
            self.assert_one_line(done, status, "box2d-impulse cannot run", "quick.toml")
        results = self.results()
        status_of = {row["name"]: row["status"] for row in results["engines"]}
        self.assertEqual({"grain": "ran", "box2d-penalty": "ran", "box2d-impulse": "refused"}, status_of)
        self.assertEqual({"grain"}, {row["a"] for row in results["endpoints"]["rows"]})
        self.assertIn("box2d-impulse was named first", " ".join(results["notes"]))
        for command in ("lockstep", "effects"):
            done = self.held(
                command, CELL, "--engines", "box2d-impulse,box2d-penalty", "--quick", *asked, "--out", command, "--dry-run"
            )
            self.assertRegex(done.stdout, r"box2d-impulse +cannot: box2d-impulse cannot run")

    def test_missing_engine_names_its_package(self):
        """YADE is looked for in PATH."""
        bare = {"PATH": "/nonexistent"}
        self.assert_one_line(self.compare("--quiet", engines="grain,yade", env=bare), BAD_INPUT, "yade", "PATH", "package yade")
        done = self.held("engines", env=bare)
        self.assertRegex(done.stdout, r"(?m)^yade +missing: .*package yade")
        short = settings(collision__psi=1.0, collision__steps_per_contact=50, run__mirrors="false")
        done = self.run_program("collide", PAIR, "-k", "spring-cut", "--engines", "all", "--out", self.out, *short, env=bare)
        # There is no gnuplot in PATH either: status 2 for the plots, but the numbers are there.
        self.assert_one_error(done, BAD_INPUT, "gnuplot")
        status = {engine["name"]: engine["status"] for engine in self.results()["engines"]}
        self.assertEqual("ran", status["grain"])
        self.assertNotEqual("ran", status.get("yade"))


if __name__ == "__main__":
    unittest.main()
