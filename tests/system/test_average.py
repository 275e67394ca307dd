"""Averages, snapshots and packings: a run's own snapshots give its profiles, by this program and by another; packings of a
user's own and those that are kept."""

import itertools
import json
import math
import os
import pathlib
import subprocess
import unittest

import h5py
import numpy

from harness import BAD_INPUT, CASES, COUETTE, HELD, HOME, SystemTest, settings

OTHER = pathlib.Path(__file__).with_name("independent_averages.py")
METHODS = '["slicing","straight_cut","centre","line_gaussian","line_heaviside"]'
SMALL = 0.0037  # m, cases/couette/quick.toml; the cell reaches from 0.03 to 0.075 m


class Snapshots(SystemTest):
    def average(self, snapshots, *arguments, case=COUETTE):
        return self.run_program("average", snapshots, case, "--out", self.folder / "again", *arguments)

    def test_profiles_are_worked_out_again_from_snapshots(self):
        changes = ["--set", f"averaging.method={METHODS}"]
        self.assert_status(self.compare(*settings(averaging__rotations=0.05, run__keep_snapshots=100000), *changes), HELD)
        snapshots = self.out / "snapshots/grain-p0.h5"
        self.assert_status(self.average(snapshots, *changes), HELD)
        run, again = (
            [row for row in self.rows("profiles.csv", folder) if row["packing"] == "0"] for folder in (self.out, self.folder / "again")
        )
        self.assertGreater(len(run), 1000)
        # A file of snapshots does not know since when the wheel has turned.
        for row in run:
            self.assertEqual("0.07", row.pop("to_rotation"))
            row |= {"from_rotation": "", "to_rotation": "", "prepared_rotations": ""}
        self.assertEqual(run, again)
        # A program that shares no code with this one.
        other = subprocess.run(
            ["/usr/bin/python3", OTHER, snapshots, self.out / "results.json"], capture_output=True, text=True, check=False
        )
        self.assertEqual("", other.stderr)
        found = json.loads(other.stdout)
        self.assertEqual([], found["missing"])
        self.assertGreaterEqual(len(found["worst"]), 48)
        for field, worst in found["worst"].items():
            # Of the field's largest value: sums of some hundred disks, cut near tangency.
            self.assertLess(worst, 1e-10, field)
        # The other cell, wheel and packing; tests/studies/snapshot_file_test.cpp has each misfit.
        done = self.average(snapshots, "--fresh", case=CASES / "couette/nu-0.804.toml")
        self.assert_one_error(done, BAD_INPUT, "grain-p0.h5 does not fit", "nu-0.804.toml", "disks, not 2921")

    def test_rev_is_the_average_over_a_bin_of_each_width(self):
        """The slab half way up that is 2 d wide: of ten that the case could say."""
        case = CASES / "space/shear-3d.toml"
        short = settings(preparation__packings=1, average__snapshots=3, assembly__duration=2, **{"average__from": 1})
        slabs = settings(average__low=[0, 0, -5], average__high=[10, 5.196152422706632, 15])
        self.held("compare", case, "--engines", "grain", "--out", self.out, "--quiet", *short)
        snapshots = self.out / "snapshots/grain-p0.h5"
        self.assert_status(self.average(snapshots, "--rev", *short, case=case), HELD)
        curves = self.rows("rev.csv", self.folder / "again")
        self.assertEqual({"slicing", "centre", "heaviside", "lucy", "gauss"}, {row["method"] for row in curves})
        self.assert_status(self.average(snapshots, "--fresh", *short, *slabs, case=case), HELD)
        for row in self.rows("profiles.csv", self.folder / "again"):
            if row["packing"] == "0" and float(row["r_m"]) == 6.0 and row["mean"]:
                asked = (row["field"], row["method"], 6.0, 2.0)
                means = [
                    each["mean"] for each in curves if asked == (each["field"], each["method"], float(each["r_m"]), float(each["width_over_d"]))
                ]
                self.assertEqual([row["mean"]], means, row["field"])

    def test_damaged_files_are_refused(self):
        """Some of them crash HDF5, or have it go round for ever."""
        files = sorted(HOME.glob("tests/fuzz/corpus/packings/*.h5"))
        self.assertGreater(len(files), 10)
        for file in files:
            with self.subTest(file.name):
                self.assert_one_error(self.average(file), BAD_INPUT, file.name)


class ResultFiles(SystemTest):
    """Files of a run that this program took no part in: lmp -in examples/import/box.lmp, its last three times."""

    FILES = [HOME / f"tests/studies/import/box-{name}.dump" for name in ("atoms", "pairs")]
    CASE = HOME / "examples/import/box.toml"

    def setUp(self):
        super().setUp()
        self.snapshots = self.folder / "mine.h5"

    def import_files(self, *arguments, files=FILES, name="my-lammps"):
        return self.run_program("import", "lammps", *files, self.CASE, "--name", name, "--out", self.snapshots, *arguments)

    def copies(self, change):
        """The same files, with other contacts."""
        texts = [file.read_text(encoding="utf-8") for file in self.FILES]
        return [self.write(file.name, text) for file, text in zip(self.FILES, (texts[0], change(texts[1])), strict=True)]

    def test_are_snapshots_that_are_averaged_as_the_files_themselves(self):
        done = self.import_files()
        self.assert_status(done, HELD)
        self.assertIn("3 snapshots of 48 disks by my-lammps, t = 0.78 to 0.8 s", done.stdout)
        with h5py.File(self.snapshots) as file:
            group = file["snapshot-002"]
            i, j, fn = (group["contacts"][name][:] for name in ("i", "j", "normal_force"))
            self.assertTrue((i < j).all())
            # 48 disks of 1 g at rest: the floor, id 48, bears their weight but for what hangs on the sides.
            force = group["bodies/force"][:]
            self.assertAlmostEqual(-force[0, 1], fn[j == 48].sum(), delta=1e-12)
            self.assertAlmostEqual(-48e-3 * 9.81, force[:, 1].sum(), delta=2e-3 * 48e-3 * 9.81)
            self.assertAlmostEqual(0.0, force[:, 0].sum(), delta=2e-3 * 48e-3 * 9.81)
        for name, files in (("one", [self.snapshots]), ("other", self.FILES)):
            self.held("average", *files, self.CASE, "--name", "my-lammps", "--out", self.folder / name)
        one, other = (self.rows("profiles.csv", self.folder / name) for name in ("one", "other"))
        self.assertGreater(len(one), 50)
        self.assertEqual(one, other)

    def test_contacts_listed_from_both_sides_are_one(self):
        """The same run as MercuryDPM would write it: each pair twice, walls with n and t the other way round."""
        self.assert_status(self.import_files(), HELD)
        data, fstat = [], []
        with h5py.File(self.snapshots) as file:
            radius = file["disks/radius"][:]
            for name in ("snapshot-000", "snapshot-001", "snapshot-002"):
                now = file[name]
                t = now["time"][0]
                data.append(f"{len(radius)} {t!r} 0 0 0 1 1 1")
                for a, (x, y), (u, v), spin in zip(radius, now["position"][:], now["velocity"][:], now["spin"][:], strict=True):
                    data.append(f"{x!r} {y!r} 0 {u!r} {v!r} 0 {a!r} 0 0 0 0 0 {spin!r} 0")
                fstat += [f"# {t!r} 1", "# 0 0 0 1 1 1", f"# {radius[0]!r} {radius[0]!r} 0 0 0 0"]
                rows = (now["contacts"][key][:] for key in ("i", "j", "normal", "overlap", "normal_force", "tangential_force"))
                for i, j, (nx, ny), overlap, fn, ft in zip(*rows, strict=True):
                    sense = math.copysign(1.0, ft)  # the tangent is along the force
                    tx, ty = -sense * ny, sense * nx
                    x, y = now["position"][i] - (radius[i] - overlap / 2) * numpy.array([nx, ny])
                    line = f"{x!r} {y!r} 0 {overlap!r} 0 {fn!r} {abs(ft)!r}"
                    there, back = f"{nx!r} {ny!r} 0 {tx!r} {ty!r} 0", f"{-nx!r} {-ny!r} 0 {-tx!r} {-ty!r} 0"
                    if j < len(radius):
                        fstat += [f"{t!r} {i} {j} {line} {there}", f"{t!r} {j} {i} {line} {back}"]
                    else:
                        fstat.append(f"{t!r} {i} {len(radius) - j - 1} {line} {back}")
        files = [self.write(f"run.{name}", "\n".join(rows) + "\n") for name, rows in (("data", data), ("fstat", fstat))]
        again = self.folder / "again.h5"
        self.held("import", "mercurydpm", *files, self.CASE, "--out", again)
        with h5py.File(self.snapshots) as one, h5py.File(again) as other:
            for name in ("i", "j", "normal", "overlap", "normal_force", "tangential_force"):
                for k in range(3):
                    a, b = (file[f"snapshot-00{k}/contacts/{name}"][:] for file in (one, other))
                    self.assertEqual(a.shape, b.shape)
                    self.assertLess(abs(a - b).max(), 1e-12, name)

    def test_dry_run_writes_nothing(self):
        self.assertIn("would convert 2 files of my-lammps to ", self.import_files("--dry-run").stdout)
        self.assertIn("would convert", json.loads(self.import_files("--dry-run", "--json").stdout)["planned"])
        self.assert_one_error(self.import_files("--dry-run", name="my-lamps"), BAD_INPUT, "engines.my-lamps")
        self.assertFalse(self.snapshots.exists())

    def test_sections_of_files_are_no_slips_of_engines(self):
        plan = ["compare", self.CASE, "--engines", "grain", "--dry-run", "--out", self.out]
        self.assertNotIn("engines.", self.held(*plan).stdout)  # it has [engines.my-lammps], for who has such files
        self.assertIn("does not use engines.mine (nothing", self.held(*plan, "--set=engines.mine.blur=1").stdout)
        self.assert_one_error(self.run_program(*plan, "--set=engines.yadee.dt=1e-5"), BAD_INPUT, "engines.yadee", "did you mean yade?")

    def test_sections_of_files_are_noted_beside_files_that_have_none(self):
        plan = ["compare", self.CASE, "--dry-run", "--out", self.out, "--engines"]
        done = self.held(*plan, f"my-lammps={HOME}/tests/studies/import/box-*.dump")
        self.assertNotIn("does not use", done.stdout)
        self.assert_status(self.import_files(), HELD)
        self.assertNotIn("does not use", self.held(*plan, f"other={self.snapshots}").stdout, "snapshots need none")
        self.held("export", "mercurydpm", self.snapshots, self.CASE, "--out", self.folder / "run")
        done = self.held(*plan, f"other={self.folder}/run.*")
        self.assertIn("engines.my-lammps (nothing of this name takes part: --engines names result files as my-lammps=FILES)",
                      " ".join(done.stdout.split()))

    def test_wrong_settings_are_refused(self):
        for settings_, words in (
            (["length=1000"], ["say length = 1 in [engines.my-lammps]"]),
            (["mass=0.001"], ["mass", "say mass = 1 in [engines.my-lammps]"]),
            (["dt=0"], ["box-atoms.dump, step 78000", "say dt, the time step, in [engines.my-lammps]"]),
            (["dt=1e-7"], ["no snapshot lies between 0.6 and 0.8 s", "0.008 s"]),
            (["plane=xz"], ["nothing differs in z", 'plane = "xy"']),
            (["plane=zx"], ["plane cannot be 'zx'", "xy, xz, yz"]),
            (["lenght=1"], ["there is no setting 'lenght'", "length"]),
        ):
            with self.subTest(settings_):
                done = self.import_files(*(f"--set=engines.my-lammps.{each}" for each in settings_))
                self.assert_one_error(done, BAD_INPUT, *words)
                self.assertEqual([], list(self.folder.glob("mine*")))
        misspelt = self.import_files(name="my-lamps")
        self.assert_one_error(misspelt, BAD_INPUT, "in [engines.my-lamps], which the case does not have: it has settings of my-lammps, my-yade")

    def test_faulty_files_are_refused(self):
        def one_more(text):
            """The first contact is listed from the other side, too, with twice the force."""
            lines = text.split("\n")
            number = lines.index("ITEM: NUMBER OF ENTRIES") + 1
            row = next(k for k, line in enumerate(lines) if line.startswith("ITEM: ENTRIES")) + 1
            first, second, force, *_ = lines[row].split()
            lines.insert(row, f"{second} {first} {2 * float(force)} 0 0 0")
            lines[number] = str(int(lines[number]) + 1)
            return "\n".join(lines)

        self.assert_one_error(self.import_files(files=self.copies(one_more)), BAD_INPUT, "listed twice with different forces")
        self.assert_one_error(self.run_program("import", "mine", *self.FILES, self.CASE, "--out", self.snapshots), BAD_INPUT, "there is no format 'mine'")
        self.snapshots.write_text("mine", encoding="utf-8")
        self.assert_one_error(self.import_files(), BAD_INPUT, "mine.h5: this file exists and holds no snapshots")

    def test_what_is_missing_on_the_command_line_is_named(self):
        atoms, pairs = self.FILES
        rest = [self.CASE, "--out", self.snapshots]
        for arguments, words in (
            (["lammps", pairs, *rest], ["box-pairs.dump: contacts alone: the file of the particles is missing"]),
            (["lammps", atoms, pairs, *rest[1:]], ["the case, a TOML file, is missing behind the files", "box-pairs.dump is a result file (lammps)"]),
            (["lammps", atoms, *rest[1:]], ["the case, a TOML file, is missing behind the files"]),
            (["csv", atoms, pairs, *rest], ["box-atoms.dump: the file is of format lammps, not csv: crossgrain import lammps"]),
            ([atoms, pairs, *rest], ["FORMAT is missing", "crossgrain import lammps FILES"]),
        ):
            with self.subTest(arguments):
                self.assert_one_error(self.run_program("import", *arguments), BAD_INPUT, *words)
        done = self.run_program("average", atoms, pairs, "--out", self.folder / "averaged")
        self.assert_one_error(done, BAD_INPUT, "the case, a TOML file, is missing behind the files")

    def test_contacts_that_end_early_are_refused_alone(self):
        """Of three times the last has none; nothing stands beside the refusal."""
        files = self.copies(lambda text: text[: text.rindex("ITEM: TIMESTEP")])
        words = ["box-atoms.dump, step 80000: there are no contacts of this time, the last are of", "box-pairs.dump, step 79000"]
        self.assert_one_error(self.import_files(files=files), BAD_INPUT, *words)
        named = ["--name", "my-lammps", "--quiet"]
        for command in (
            ["average", *files, self.CASE, *named],
            ["compare", self.CASE, "--engines", f"my-lammps={self.folder}/*.dump,other={self.folder}/*.dump", "--set=engines.other.dt=1e-5", "--quiet"],
        ):
            done = self.run_program(*command, "--out", self.folder / command[0])
            self.assert_one_error(done, BAD_INPUT, *words)
            self.assertEqual("", done.stdout)
        self.assert_status(self.import_files(files=files[:1]), HELD)  # without contacts

    def test_files_that_mercurydpm_writes_beside_are_left_out(self):
        self.assert_status(self.import_files(), HELD)
        self.held("export", "mercurydpm", self.snapshots, self.CASE, "--out", self.folder / "run")
        self.write("run.ene", "time kinetic\n0 1\n")
        files = sorted(self.folder.glob("run.*"))
        self.assertEqual(["run.data", "run.ene", "run.fstat", "run.restart"], [file.name for file in files])
        again = self.folder / "again.h5"
        done = self.held("import", "mercurydpm", *files, self.CASE, "--out", again)
        self.assertIn("not read, as nothing in them is averaged: run.ene, run.restart", done.stdout)

    def test_export_writes_all_that_the_file_has(self):
        """Whatever is averaged: three snapshots, of which the case's later start leaves one."""
        self.assert_status(self.import_files(), HELD)
        done = self.held("export", "lammps", self.snapshots, self.CASE, "--set=average.from=0.795", "--out", self.folder / "run")
        self.assertIn("3 snapshots of my-lammps, t = 0.78 to 0.8 s", done.stdout)
        self.assertEqual(3, (self.folder / "run.dump").read_text(encoding="utf-8").count("ITEM: TIMESTEP"))


def ring_of_disks(count, radius=0.05):
    angles = [2 * math.pi * k / count for k in range(count)]
    return [(radius * math.cos(angle), radius * math.sin(angle)) for angle in angles]


class PackingFile(SystemTest):
    """particles.file"""

    def setUp(self):
        super().setUp()
        self.file = self.folder / "mine.h5"
        self.case = self.write("own.toml", f'[case]\nextends = "{COUETTE}"\n[particles]\nfile = "mine.h5"\n')

    def check(self, *arguments, **datasets):
        """Of the packing with these datasets; without any, of the file as it is."""
        if datasets:
            with h5py.File(self.file, "w") as file:
                for name, values in datasets.items():
                    file[name] = values
        return self.run_program("check", self.case, "--engines", "grain", "--no-timing", *arguments)

    def test_sound_one_runs_with_its_number_of_disks(self):
        self.assertIn("own: 12 disks", self.check(radius=[SMALL] * 12, position=ring_of_disks(12)).stdout)
        short = settings(preparation__packings=1, averaging__rotations=0.01, averaging__settle_rotations=0.0)
        self.assert_status(self.compare(*short, case=self.case), HELD)
        cell = self.results()["cell"]
        self.assertEqual((12, 0), (cell["small"], cell["large"]))

    def test_wrong_one_is_refused(self):
        two = ring_of_disks(2)
        near, over, same = ([*ring_of_disks(12)] for _ in range(3))
        near[7] = (near[3][0], near[3][1] + 2 * SMALL - 0.001)  # 1 mm of overlap
        over[7] = (over[3][0], over[3][1] + 0.002)  # 7.4 − 2 = 5.4 mm, allowed 0.2·3.7 mm
        same[7] = same[3]
        for told, datasets in (
            (("disk 3 and disk 7", "0.0054 m", "max_overlap = 0.2", "0.00074 m"), {"radius": [SMALL] * 12, "position": over}),
            (("disk 3 and disk 7", "0.001 m"), {"radius": [SMALL] * 12, "position": near}),
            (("disk 3 and disk 7", "same centre"), {"radius": [SMALL] * 12, "position": same}),
            # Half its radius above a wall disk of the wheel at (R_i, 0).
            (("overlap by",), {"radius": [SMALL], "position": [(0.03 + SMALL / 2, 0.0)]}),
            (("disk 1",), {"radius": [SMALL] * 2, "position": [(0.05, 0.0), (0.2, 0.0)]}),
            (("position of disk 1", "not finite"), {"radius": [SMALL] * 2, "position": [(0.05, 0.0), (math.nan, 0.05)]}),
            (("velocity", "not finite"), {"radius": [SMALL] * 2, "position": two, "velocity": [(0.0, 0.0), (math.inf, 0.0)]}),
            (("radius of disk 1", "-0.1"), {"radius": [SMALL, -0.1], "position": two}),
            (("position has 4 values", "3 disks"), {"radius": [SMALL] * 3, "position": two}),
            (("position",), {"radius": [SMALL] * 3}),
        ):
            with self.subTest(told):
                self.assert_one_line(self.check(**datasets), BAD_INPUT, "mine.h5", *told)
        self.assert_status(self.check("--set=particles.max_overlap=0.3", radius=[SMALL] * 12, position=near), HELD)
        self.file.write_text("radius position\n0.0037 0 0\n", encoding="utf-8")
        self.assert_one_line(self.check(), BAD_INPUT, "mine.h5", "cannot be read as an HDF5 file")
        self.file.unlink()
        self.assert_one_line(self.check(), BAD_INPUT, "particles.file", "mine.h5", "no such file")

    def test_cut_short_or_overwritten_one_crashes_nothing(self):
        self.check(radius=[SMALL] * 200, position=ring_of_disks(200))
        whole = self.file.read_bytes()
        for size in (100, len(whole) // 2, len(whole) - 8):
            self.file.write_bytes(whole[:size])
            self.assert_one_line(self.check(), BAD_INPUT, "mine.h5")
        for part in range(8):  # refused, or the damage lies where nothing is kept
            start, end = len(whole) * part // 8, len(whole) * (part + 1) // 8
            self.file.write_bytes(whole[:start] + b"\xff" * (end - start) + whole[end:])
            done = self.check()
            self.assertIn(done.status, (HELD, BAD_INPUT))


class KeptPackings(SystemTest):
    """Packings that crossgrain prepares itself."""

    def setUp(self):
        super().setUp()
        self.cache = self.folder / "cache"

    def compare_with_cache(self, *arguments):
        short = settings(
            preparation__shrink_time=0.2, preparation__rotations=0.0, averaging__rotations=0.01, averaging__settle_rotations=0.0
        )
        return self.compare("--fresh", *short, *arguments, env={"CROSSGRAIN_CACHE": str(self.cache)})

    def test_are_prepared_once_and_anew_where_they_are_others_or_damaged(self):
        prepared, cached = "packing 0: prepared", "2 packings kept"
        for arguments, told, kept in (
            ((), prepared, 2), ((), cached, 2), (("--set=averaging.rings=4",), cached, 2),
            (("--seed=5",), prepared, 4), (("--set=particles.small=209",), prepared, 6),
        ):  # fmt: skip
            with self.subTest(arguments):
                done = self.compare_with_cache(*arguments)
                self.assert_status(done, HELD)
                self.assertIn(told, done.stderr)
                self.assertEqual(kept, len(list(self.cache.iterdir())))
        for file in self.cache.iterdir():
            os.truncate(file, file.stat().st_size // 2)
        self.assertIn(prepared, self.compare_with_cache().stderr)

    def test_of_different_seeds_have_nothing_in_common_and_are_files_of_a_user_too(self):
        for seed in (1, 2):
            self.assert_status(self.compare_with_cache(f"--seed={seed}"), HELD)
        files = sorted(self.cache.iterdir())
        self.assertEqual(4, len(files))
        places = []
        for file in files:
            with h5py.File(file) as packing:
                places.append(packing["position"][:])
        for a, b in itertools.combinations(places, 2):
            self.assertGreater(abs(a - b).min(axis=1).mean(), 1e-3)
        # Freshly compressed disks overlap: a lot may be allowed, or hardly any.
        as_file = settings(particles__file=files[0], preparation__packings=1)
        self.assert_status(self.compare_with_cache("--quiet", *as_file, "--set=particles.max_overlap=1.0"), HELD)
        done = self.compare_with_cache("--quiet", *as_file, "--set=particles.max_overlap=1e-9")
        self.assert_one_line(done, BAD_INPUT, files[0].name, " overlap by")

    def test_where_they_cannot_be_kept_cost_time_and_not_the_run(self):
        self.cache = self.write("file", "") / "below"
        done = self.compare_with_cache()
        self.assert_status(done, HELD)
        self.assertRegex(done.stderr, r"prepared, not kept for next time: .*file")


if __name__ == "__main__":
    unittest.main()
