"""A packing of the user's own (particles.file): what is wrong with it is status 2 and one line."""

import math
import itertools
import os
import unittest

import h5py

from harness import BAD_INPUT, COUETTE, HELD, SystemTest, settings
from packing_file import write_packing

SMALL = 0.0037  # m, cases/couette/quick.toml; the cell reaches from 0.03 to 0.075 m


def ring_of_disks(count, radius=0.05):
    return [
        (radius * math.cos(2 * math.pi * k / count), radius * math.sin(2 * math.pi * k / count))
        for k in range(count)
    ]


class PackingFiles(SystemTest):
    def setUp(self):
        super().setUp()
        self.file = self.folder / "mine.h5"

    def compare_it(self, *arguments, **datasets):
        """A short run of the packing with these datasets; without any, of the file as it is."""
        if datasets:
            write_packing(self.file, **datasets)
        short = settings(
            particles__file=self.file,
            preparation__packings=1,
            averaging__rotations=0.01,
            averaging__settle_rotations=0.0,
        )
        return self.compare("--quiet", "--fresh", *short, *arguments)

    def refuse(self, *fragments, **datasets):
        self.assert_one_line(self.compare_it(**datasets), BAD_INPUT, "mine.h5", *fragments)

    def test_good_one_runs_with_its_number_of_disks(self):
        done = self.compare_it(radius=[SMALL] * 12, position=ring_of_disks(12))
        self.assert_status(done, HELD)
        cell = self.results()["cell"]
        self.assertEqual((12, 0), (cell["small"], cell["large"]))

    def test_too_much_overlap_names_the_disks(self):
        # Centres of disks 3 and 7 are 2 mm apart: overlap 7.4 − 2 = 5.4 mm, allowed 0.2·3.7 mm.
        position = ring_of_disks(12)
        position[7] = (position[3][0], position[3][1] + 0.002)
        self.refuse(
            "disk 3 and disk 7", "0.0054 m", "max_overlap = 0.2", "0.00074 m",
            radius=[SMALL] * 12, position=position,
        )  # fmt: skip

    def test_an_engine_that_cannot_prepare_packings(self):
        done = self.compare("--quiet", "--set=preparation.engine=box2d-penalty")
        self.assert_one_line(done, BAD_INPUT, "box2d-penalty cannot prepare packings of", "not radial as ring is")

    def test_more_overlap_can_be_allowed(self):
        position = ring_of_disks(12)
        position[7] = (position[3][0], position[3][1] + 2 * SMALL - 0.001)  # 1 mm of overlap
        datasets = {"radius": [SMALL] * 12, "position": position}
        self.refuse("disk 3 and disk 7", "0.001 m", **datasets)
        allowed = self.compare_it(*settings(particles__max_overlap=0.3), **datasets)
        self.assert_status(allowed, HELD)

    def test_coincident_centres(self):
        position = ring_of_disks(12)
        position[7] = position[3]
        write_packing(self.file, radius=[SMALL] * 12, position=position)
        done = self.compare_it(*settings(particles__max_overlap=1.0))
        self.assert_one_line(done, BAD_INPUT, "mine.h5", "disk 3 and disk 7", "same centre")

    def test_disk_in_the_wheel(self):
        # Half its radius above a wall disk of the wheel at (R_i, 0).
        self.refuse("overlap by", radius=[SMALL], position=[(0.03 + SMALL / 2, 0.0)])

    def test_disk_outside_the_cell(self):
        self.refuse("disk 1", radius=[SMALL] * 2, position=[(0.05, 0.0), (0.2, 0.0)])

    def test_position_is_not_a_number(self):
        self.refuse(
            "position of disk 1", "not finite",
            radius=[SMALL] * 2, position=[(0.05, 0.0), (math.nan, 0.05)],
        )  # fmt: skip

    def test_velocity_is_not_a_number(self):
        self.refuse(
            "velocity", "not finite",
            radius=[SMALL] * 2, position=ring_of_disks(2), velocity=[(0.0, 0.0), (math.inf, 0.0)],
        )  # fmt: skip

    def test_radius_not_positive(self):
        self.refuse("radius of disk 1", "-0.1", radius=[SMALL, -0.1], position=ring_of_disks(2))

    def test_lists_of_different_lengths(self):
        self.refuse(
            "position has 4 values", "3 disks", radius=[SMALL] * 3, position=ring_of_disks(2)
        )

    def test_no_positions(self):
        self.refuse("position", radius=[SMALL] * 3)

    def test_no_disks(self):
        self.refuse("no disks", radius=[], position=[])

    def test_missing_file(self):
        done = self.compare_it()
        self.assert_one_line(done, BAD_INPUT, "particles.file", "mine.h5", "no such file")

    def test_text_file(self):
        self.file.write_text("radius position\n0.0037 0 0\n", encoding="utf-8")
        self.refuse("HDF5")

    def test_empty_file(self):
        self.file.touch()
        self.refuse("HDF5")

    def test_truncated_file(self):
        write_packing(self.file, radius=[SMALL] * 200, position=ring_of_disks(200))
        whole = self.file.stat().st_size
        for size in (100, whole // 2, whole - 8):
            with self.subTest(size=size):
                write_packing(self.file, radius=[SMALL] * 200, position=ring_of_disks(200))
                os.truncate(self.file, size)
                self.refuse()

    def test_damaged_file(self):
        """Each eighth of the file overwritten: refused, or the damage lies where nothing is kept.
        Whatever it is, no crash."""
        write_packing(self.file, radius=[SMALL] * 12, position=ring_of_disks(12))
        content = self.file.read_bytes()
        refused = 0
        for part in range(8):
            start, end = len(content) * part // 8, len(content) * (part + 1) // 8
            self.file.write_bytes(content[:start] + b"\xff" * (end - start) + content[end:])
            done = self.compare_it()
            if done.status == BAD_INPUT:
                self.assert_one_line(done, BAD_INPUT, "mine.h5")
                refused += 1
            else:
                self.assert_status(done, HELD)
        self.assertGreater(refused, 0)

    def test_check_reads_it(self):
        self.file.write_bytes(os.urandom(4096))
        case = self.write(
            "own.toml", f'[case]\nextends = "{COUETTE}"\n[particles]\nfile = "mine.h5"\n'
        )
        done = self.run_program("check", case, "--engines", "grain")
        self.assert_one_line(done, BAD_INPUT, "mine.h5", "cannot be read as an HDF5 file")
        write_packing(self.file, radius=[SMALL] * 2, position=[(0.05, 0.0), (0.05, 0.0)])
        done = self.run_program("check", case, "--engines", "grain")
        self.assert_one_line(done, BAD_INPUT, "mine.h5", "the same centre")
        write_packing(self.file, radius=[SMALL] * 12, position=ring_of_disks(12))
        done = self.run_program("check", case, "--engines", "grain")
        self.assert_status(done, HELD)
        self.assertIn("own: 12 disks", done.stdout)


class PackingCache(SystemTest):
    """Packings that crossgrain prepares itself."""

    def setUp(self):
        super().setUp()
        self.cache = self.folder / "cache"
        self.env = {"CROSSGRAIN_CACHE": str(self.cache)}

    def compare_with_cache(self, *arguments):
        short = settings(
            preparation__shrink_time=0.2,
            preparation__rotations=0.0,
            averaging__rotations=0.01,
            averaging__settle_rotations=0.0,
        )
        return self.compare("--fresh", *short, *arguments, env=self.env)

    def test_second_call_takes_them_from_the_cache(self):
        first = self.compare_with_cache()
        self.assert_status(first, HELD)
        self.assertIn("packing 0: prepared", first.stderr)
        self.assertEqual(2, len(list(self.cache.iterdir())))
        second = self.compare_with_cache()
        for packing in range(2):
            self.assertIn(f"packing {packing}: from the cache", second.stderr)
        self.assertEqual(
            [True, True], [packing["from_cache"] for packing in self.results()["packings"]]
        )

    def test_another_packing_is_prepared_for(self):
        self.assert_status(self.compare_with_cache(), HELD)
        for change, made_again in {
            "--seed=5": True,
            "--set=particles.small=209": True,
            "--set=averaging.rings=4": False,
        }.items():
            with self.subTest(change):
                done = self.compare_with_cache(change)
                self.assertEqual(made_again, "packing 0: prepared" in done.stderr, str(done))

    def test_packings_of_different_seeds_have_nothing_in_common(self):
        for seed in (1, 2):
            done = self.compare_with_cache(f"--seed={seed}")
            self.assert_status(done, HELD)
            for packing in (0, 1):
                self.assertIn(f"packing {packing}: prepared", done.stderr)
        files = sorted(self.cache.iterdir())
        self.assertEqual(4, len(files))
        places = []
        for file in files:
            with h5py.File(file) as packing:
                places.append(packing["position"][:])
        for a, b in itertools.combinations(places, 2):
            self.assertGreater(abs(a - b).min(axis=1).mean(), 1e-3)

    def test_truncated_packing_in_the_cache(self):
        self.assert_status(self.compare_with_cache(), HELD)
        packing = sorted(self.cache.iterdir())[0]
        os.truncate(packing, packing.stat().st_size // 2)
        damaged = packing.read_bytes()
        done = self.compare_with_cache()
        self.assert_status(done, HELD)
        self.assertIn("prepared", done.stderr)  # anew
        self.assertNotEqual(damaged, packing.read_bytes())

    def test_prepared_packing_as_a_file_of_the_user(self):
        self.assert_status(self.compare_with_cache(), HELD)
        packing = sorted(self.cache.iterdir())[0]
        as_file = settings(particles__file=packing, preparation__packings=1)
        # Freshly compressed disks overlap: a lot may be allowed, or hardly any.
        much = settings(particles__max_overlap=1.0)
        self.assert_status(self.compare_with_cache("--quiet", *as_file, *much), HELD)
        hardly_any = settings(particles__max_overlap=1e-9)
        done = self.compare_with_cache("--quiet", *as_file, *hardly_any)
        self.assert_one_line(done, BAD_INPUT, packing.name)
        self.assertRegex(done.stderr, r"disk \d+ and (wall )?disk \d+ overlap by")

    def test_cache_that_cannot_be_written(self):
        self.cache = self.write("file", "")
        self.env = {"CROSSGRAIN_CACHE": str(self.cache / "below")}
        done = self.compare_with_cache()
        self.assert_status(done, HELD)  # costs time, not the run
        self.assertRegex(done.stderr, r"prepared, not kept for next time: .*file")


if __name__ == "__main__":
    unittest.main()
