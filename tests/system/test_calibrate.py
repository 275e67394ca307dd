"""calibrate: constants from wanted values and back, what a case's law means, refused input."""

import math
import re
import tomllib
import unittest

from harness import BAD_INPUT, COLLISION, COUETTE, HARD_SPHERE, HELD, SystemTest

PAIR = ("--mass=1e-3", "--radius=5e-3")
WANTED = ("--en=0.9", "--et=0.5", "--tc=1e-3", "--mu=0.4")
THESIS = (
    "--kn=352.1", "--gn=0.19", "--kt=267.1", "--gt=0.15", "--mu=0.44",
    "--mass=0.275e-3", "--radius=3.7e-3",
)  # fmt: skip

COLLISION_OF_TWO = """
[case]
kind = "collision"
{law}
[collision]
psi = 0.3
vn = 1e-3
radius = 5e-3
mass = 1e-3
"""


class Calibrate(SystemTest):
    def calibrate(self, *arguments):
        done = self.run_program("calibrate", *arguments)
        self.assert_status(done, HELD)
        self.assertEqual("", done.stderr)
        return done.stdout

    def implied(self, text, label):
        """The first number after a label of the implied values."""
        found = re.search(rf"(?m)^#   {re.escape(label)} +([-+.e\d]+)", text)
        self.assertIsNotNone(found, text)
        return float(found[1])


class Wanted(Calibrate):
    def test_round_trip(self):
        for tension in ("allow", "cut"):
            for tangential in ("spring", "spring_dashpot"):
                with self.subTest(f"{tension} {tangential}"):
                    text = self.calibrate(
                        *WANTED, *PAIR, f"--tension={tension}", f"--tangential={tangential}"
                    )
                    law = tomllib.loads(text)["law"]
                    self.assertEqual((tension, tangential), (law["tension"], law["tangential"]))
                    constants = [f"--{key}={law[key]!r}" for key in ("kn", "gn", "kt", "gt", "mu") if key in law]
                    back = self.calibrate(*constants, *PAIR, f"--tension={tension}")
                    self.assertEqual(tangential, tomllib.loads(back)["law"]["tangential"])
                    self.assertEqual(0.9, self.implied(back, "e_n"))
                    self.assertEqual(0.5, self.implied(back, "e_t0 without slip"))
                    self.assertEqual(1e-3, self.implied(back, "contact time t_c"))
                    self.assertEqual(2e-5, self.implied(back, "suggested dt = t_c/50"))

    def test_a_case_takes_what_is_printed(self):
        case = self.write("pair.toml", COLLISION_OF_TWO.format(law=self.calibrate(*WANTED, *PAIR)))
        self.assert_status(self.run_program("check", case, "--engines", "grain"), HELD)
        self.assertRegex(self.calibrate(case), r"(?m)^# i-j .* 0\.9000 +0\.9020 +0\.001 +0\.5000 ")

    def test_frictionless(self):
        law = tomllib.loads(self.calibrate("--en=1", "--tc=1e-3", *PAIR))["law"]
        self.assertEqual(("none", 0), (law["tangential"], law["gn"]))
        self.assertLessEqual({"mu", "kt", "gt"} & set(law), set())
        self.assertAlmostEqual(500 * 3.141592653589793**2, law["kn"], 9)  # m12 (π/t_c)²

    def test_stiffness_instead_of_contact_time(self):
        # By hand: m = m12 = 0.5e-3 kg, t_c = π/√(k_n/m − (γ_n/2m)²), e_n = exp(−γ_n t_c/2m).
        mass, kn = 0.5e-3, 1e4
        for en in (0.9, 0.3, 1.0):
            text = self.calibrate(f"--en={en}", f"--kn={kn}", *PAIR)
            law = tomllib.loads(text)["law"]
            self.assertEqual(kn, law["kn"])
            half = law["gn"] / (2 * mass)
            time = math.pi / math.sqrt(kn / mass - half**2)
            self.assertAlmostEqual(en, math.exp(-half * time), 12)
            self.assertAlmostEqual(1, time / self.implied(text, "contact time t_c"), 5)
        with_friction = self.calibrate("--en=0.9", f"--kn={kn}", "--et=0.5", "--mu=0.4", *PAIR)
        self.assertEqual(0.5, self.implied(with_friction, "e_t0 without slip"))
        self.assertIn("# e_n = 0.9, k_n = 10000 N/m, e_t0 = 0.5; masses", with_friction)

    def test_stiffness_and_contact_time_are_two_ways_to_one_law(self):
        for tension in ("allow", "cut"):
            by_time = tomllib.loads(self.calibrate(*WANTED, *PAIR, f"--tension={tension}"))["law"]
            arguments = [each for each in WANTED if not each.startswith("--tc")]
            by_stiffness = tomllib.loads(
                self.calibrate(*arguments, f"--kn={by_time['kn']!r}", *PAIR, f"--tension={tension}")
            )["law"]
            for key in ("kn", "gn", "kt", "gt"):
                self.assertAlmostEqual(1.0, by_stiffness[key] / by_time[key], 12)

    def test_wall_is_twice_as_heavy(self):
        pair, wall = (
            tomllib.loads(self.calibrate(*WANTED, *PAIR, *mass2))["law"]
            for mass2 in ((), ("--mass2=inf",))
        )
        for key in ("kn", "gn", "kt", "gt"):
            self.assertAlmostEqual(2.0, wall[key] / pair[key], 12)

    def test_soft_contacts_are_warned_of(self):
        self.assertNotIn("warning", self.calibrate(*WANTED, *PAIR, "--vn=0.01"))
        self.assertIn("# warning: soft", self.calibrate(*WANTED, *PAIR, "--vn=1"))


class Inverse(Calibrate):
    def test_thesis(self):
        text = self.calibrate(*THESIS)
        self.assertRegex(text, r"(?m)^#   e_n +0\.222286, with tension cut: 0\.340822$")
        self.assertAlmostEqual(2.18e-3, self.implied(text, "contact time t_c"), delta=5e-6)
        self.assertIn("e_t0 holds up to |Ψ_i| = µ γ_n/γ_t = 0.557333 only", text)

    def test_pairs_of_a_case(self):
        # Lätzel (2003), table 4.1: e_n with tension and without depend on the pair.
        expected = {
            "small-small": (0.222, 0.341), "small-large": (0.274, 0.378), "large-large": (0.342, 0.428),
            "small-wall": (0.365, 0.446), "large-wall": (0.478, 0.533),
        }  # fmt: skip
        rows = {
            fields[1]: fields[2:]
            for fields in map(str.split, self.calibrate(COUETTE).splitlines())
            if len(fields) > 1 and "-" in fields[1] and fields[1] in expected
        }
        self.assertEqual(set(expected), set(rows))
        for name, (allowed, cut) in expected.items():
            self.assertAlmostEqual(allowed, float(rows[name][2]), delta=6e-4)
            self.assertAlmostEqual(cut, float(rows[name][3]), delta=6e-4)

    def test_every_variant(self):
        text = self.calibrate(COLLISION)
        self.assertEqual(8, len(re.findall(r"(?m)^# variant ", text)))
        self.assertEqual(8, len(re.findall(r"(?m)^# i-j ", text)))


class RoundTrip(Calibrate):
    """What is printed of a case's law loads, and is that law."""

    def lawAndRows(self, name, law):
        text = self.calibrate(self.write(name, COLLISION_OF_TWO.format(law=law)))
        head, _, rest = text.partition("\n")
        table = rest[: rest.index("\n\n")]
        return tomllib.loads(table)["law"], table, rest[len(table) :]

    def test_every_law_and_damper(self):
        normals = {
            "linear": "kn = 1e4\n",
            "hertz": "young = [7e7, 2e8]\npoisson = [0.25, 0.4]\n",
            "polynomial": "k2 = 1e8\nk3 = -1e9\n",
        }
        dampers = {"constant": 0.05, "viscoelastic": 1e-5, "critical": 0.4}
        for normal, stiffness in normals.items():
            for damper, gn in dampers.items():
                for tangential in ("none", "coulomb", "viscous", "spring", "spring_dashpot"):
                    for more in ("", 'tension = "cut"\nlever_arm = "contact_point"\nhistory = "force"\n'):
                        with self.subTest(f"{normal} {damper} {tangential} {more}"):
                            law = f'[law]\nnormal = "{normal}"\ndamper = "{damper}"\n'
                            law += f'tangential = "{tangential}"\n{stiffness}gn = {gn}\n{more}'
                            if tangential != "none":
                                law += f"mu = 0.3\ngt = {gn / 2}\n"
                                law += "kt = 8e3\n" if normal != "hertz" else ""
                            first, table, rows = self.lawAndRows("asked.toml", law)
                            again, _, same = self.lawAndRows("pasted.toml", table)
                            self.assertEqual(rows, same)
                            self.assertEqual(first.keys(), again.keys())
                            self.assertEqual((normal, gn), (first["normal"], first["gn"]))
                            self.assertEqual(damper, first.get("damper", "constant"))
                            for key, value in first.items():
                                if isinstance(value, str):
                                    self.assertEqual(value, again[key])
                                else:
                                    self.assertAlmostEqual(1.0, (again[key] or 1.0) / (value or 1.0), 12)

    def test_critical_damper_gives_every_pair_what_was_asked(self):
        for stiffness in ('normal = "linear"\nkn = 1e4', 'normal = "hertz"\nyoung = 7e7\npoisson = 0.25'):
            law = f'[law]\n{stiffness}\ndamper = "critical"\ntangential = "none"\n'
            _, table, rows = self.lawAndRows("asked.toml", law + "e_n = 0.6\n")
            self.assertRegex(rows, r"(?m)^# i-j .* 0\.6000 ")
            heavy = COLLISION_OF_TWO.format(law=table).replace("mass = 1e-3", "mass = 1.0")
            self.assertRegex(self.calibrate(self.write("heavy.toml", heavy)), r"(?m)^# i-j .* 0\.6000 ")
            self.assertNotIn("restitutions are not", rows)


class Refused(SystemTest):
    def test_one_line_each(self):
        inputs = {
            (): "one of",
            PAIR: "one of",
            ("--en=0.9", str(COUETTE)): "one of",
            ("--en=0.9", "--tc=1e-3", "--radius=1"): "--mass is missing",
            ("--en=0.9", "--tc=1e-3", "--mass=1"): "--radius is missing",
            ("--en=0.9", *PAIR): "--tc is missing",
            ("--en=0.9", "--tc=1e-3", "--kn=1", *PAIR): "--tc and --kn: with e_n each gives the other",
            ("--en=0.9", "--gn=1", "--kn=1", *PAIR): "--en and --gn: e_n gives gn",
            ("--en=0.9", "--et=0.5", "--kt=1", "--kn=1", *PAIR): "--et and --kt",
            ("--en=0.9", "--et=0.5", "--gt=1", "--kn=1", *PAIR): "--et and --gt",
            ("--et=0.5", "--kn=1", "--mu=0.4", *PAIR): "--en is missing",
            ("--en=0.9", "--kn=-1", *PAIR): "--kn = -1: must be > 0 N/m",
            (str(COUETTE), "--kn=1"): "one of",
            ("--tc=1e-3", *PAIR): "--en is missing",
            ("--en=0.9", "--tc=1e-3", "--mu=0.4", *PAIR): "--et is missing",
            ("--en=0", "--tc=1e-3", *PAIR): "--en = 0: must be in (0, 1]",
            ("--en=1.2", "--tc=1e-3", *PAIR): "--en = 1.2",
            ("--en=nan", "--tc=1e-3", *PAIR): "--en = nan",
            ("--en=x", "--tc=1e-3", *PAIR): "--en",
            ("--en=0.9", "--tc=-1", *PAIR): "--tc = -1: must be > 0 s",
            ("--en=0.9", "--tc=1e-300", *PAIR): "--tc = 1e-300",
            ("--en=0.9", "--tc=1e-3", "--mass=inf", "--radius=1"): "--mass = inf",
            ("--en=0.9", "--tc=1e-3", "--mass=1", "--radius=1e-200"): "--radius = 1e-200",
            ("--en=0.1", "--tc=1e-3", "--tension=cut", *PAIR): "exp(-2) = 0.1353",
            ("--et=-0.5", "--en=0.9", "--tc=1e-3", *PAIR): "0 < e_t0 <= 1",
            ("--et=-1", "--en=0.9", "--tc=1e-3", *PAIR): "--et = -1",
            (*WANTED, *PAIR, "--tension=cutt"): "did you mean cut?",
            (*WANTED, *PAIR, "--tangential=viscous"): "--tangential = viscous",
            (*WANTED, *PAIR, "--set=law.mu=1"): "--set",
            ("--kn=1", *PAIR): "--gn is missing: an undamped law says 0 [kg/s]; or --en, if kn is wanted",
            ("--kn=0", "--gn=0", *PAIR): "--kn = 0: must be > 0 N/m",
            ("--kn=352.1", "--gn=1", *PAIR): "must be < 0.839166 kg/s",
            (*THESIS, "--tangential=spring"): "--tangential",
            (str(COUETTE), "--mass=1"): "the case file says it",
            (str(COUETTE), "--tension=cut"): "the case file says it",
            (str(HARD_SPHERE),): "rigid",
            ("nowhere.toml",): "nowhere.toml",
        }  # fmt: skip
        for arguments, fragment in inputs.items():
            with self.subTest(arguments):
                done = self.run_program("calibrate", *arguments)
                self.assert_one_line(done, BAD_INPUT, fragment)
                self.assertEqual("", done.stdout)


if __name__ == "__main__":
    unittest.main()
