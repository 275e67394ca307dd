"""crossgrain average: a run's own snapshots give the run's own profiles; bad files end in one line."""

import csv
import subprocess
import unittest

from harness import BAD_INPUT, CASES, COUETTE, HELD, FELL_SHORT, SystemTest, settings

# By Debian's own Python, which has the package, whichever one runs the tests.
H5PY = """
import h5py, numpy, sys
with h5py.File(sys.argv[1]) as file:
    first = file["snapshot-000"]
    assert file.attrs["engine"] == b"grain" or file.attrs["engine"] == "grain"
    assert first["position"].shape == (len(file["disks/radius"]), 2), first["position"].shape
    assert first["contacts/normal"].shape == (len(first["contacts/i"]), 2)
    assert numpy.allclose(numpy.linalg.norm(first["contacts/normal"], axis=1), 1.0)
    assert (file["disks/index"][:] == numpy.arange(len(file["disks/radius"]))).all()
    print(*(name for name in file if name.startswith("snapshot-")))
"""

METHODS = '["slicing","straight_cut","centre","line_gaussian","line_heaviside"]'


class Average(SystemTest):
    def rows(self, folder):
        with open(folder / "profiles.csv", encoding="utf-8", newline="") as file:
            return [row for row in csv.DictReader(file) if row["packing"] == "0"]

    def average(self, *arguments, snapshots, out, case=COUETTE):
        return self.run_program("average", str(snapshots), str(case), "--out", str(out), *arguments)

    def test_a_runs_own_snapshots_give_its_profiles(self):
        changes = ["--set", f"averaging.method={METHODS}"]
        done = self.compare(
            *settings(averaging__rotations=0.05, run__keep_snapshots=100000), *changes
        )
        self.assert_status(done, HELD, FELL_SHORT)
        snapshots = self.out / "snapshots" / "grain-p0.h5"
        done = subprocess.run(
            ["/usr/bin/python3", "-c", H5PY, str(snapshots)], capture_output=True, text=True
        )
        self.assertEqual("", done.stderr)
        self.assertEqual(20, len(done.stdout.split()))
        again = self.folder / "again"
        done = self.average(*changes, snapshots=snapshots, out=again)
        self.assert_status(done, HELD)
        self.assertTrue((again / "report.html").is_file())
        run, averaged = self.rows(self.out), self.rows(again)
        self.assertGreater(len(run), 1000)
        # A file of snapshots does not know since when the wheel has turned.
        for row in run:
            self.assertEqual("0.07", row.pop("to_rotation"))
            row |= {"from_rotation": "", "to_rotation": "", "prepared_rotations": ""}
        self.assertEqual(run, averaged)

    def test_ring_widths(self):
        done = self.compare(*settings(averaging__rotations=0.05, run__keep_snapshots=4))
        self.assert_status(done, HELD, FELL_SHORT)
        snapshots = self.out / "snapshots" / "grain-p0.h5"
        out = self.folder / "rev"
        done = self.run_program(
            "rev", str(snapshots), str(COUETTE), "--out", str(out), "--quiet"
        )
        self.assert_status(done, HELD)
        with open(out / "rev.csv", encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(
            "engine,method,field,r_m,width_over_d,mean,stderr,unit".split(","), list(rows[0])
        )
        filling = [row for row in rows if row["field"] == "volume_fraction"]
        self.assertEqual(5, len({row["method"] for row in filling}))
        spread = {}  # of the volume fraction over ring widths, by method
        for method in ("slicing", "centre"):
            values = [float(row["mean"]) for row in filling if row["method"] == method]
            spread[method] = max(values) - min(values)
            if method == "slicing":  # Lätzel 2003, section 5.3: never above 1
                self.assertLess(max(values), 1.0)
        self.assertGreater(spread["centre"], 1.2 * spread["slicing"])
        with open(out / "rev_meetings.csv", encoding="utf-8", newline="") as file:
            near = [r for r in csv.DictReader(file) if r["field"] == "volume_fraction"]
        self.assertEqual(8, len(near))
        # The report alone can be made again.
        done = self.run_program("report", str(out))
        self.assert_status(done, HELD)

    def test_snapshots_of_another_cell(self):
        done = self.compare(*settings(averaging__rotations=0.02, run__keep_snapshots=2))
        self.assert_status(done, HELD)
        snapshots = self.out / "snapshots" / "grain-p0.h5"
        big = CASES / "couette/nu-0.804.toml"
        for command in ("average", "rev"):
            with self.subTest(command):
                out = self.folder / "other"
                done = self.run_program(command, snapshots, big, "--out", out)
                self.assert_one_error(
                    done, BAD_INPUT, "grain-p0.h5 does not fit", "nu-0.804.toml", "disks, not 2921",
                    "the wheel's radius 0.03 m, not 0.1032 m",
                )  # fmt: skip
                self.assertFalse(out.exists())
        for change, told in (
            ({"cell__omega": 2}, "a wheel that turns at 1 rad/s, not 2 rad/s"),
            ({"particles__small": 200}, "disks, not "),
        ):
            with self.subTest(told):
                done = self.average(*settings(**change), snapshots=snapshots, out=self.folder / "x")
                self.assert_one_error(done, BAD_INPUT, told)

    def test_bad_files(self):
        for what in ("missing.h5", "text.h5"):
            self.write("text.h5", "no HDF5")
            done = self.average(snapshots=self.folder / what, out=self.folder / "x")
            self.assert_one_error(done, BAD_INPUT, what, "cannot be read as an HDF5 file")

    def test_damaged_files(self):
        """Some of them crash HDF5, or have it go round for ever."""
        files = sorted(CASES.parent.glob("tests/fuzz/corpus/packings/*.h5"))
        self.assertGreater(len(files), 10)
        for file in files:
            with self.subTest(file.name):
                done = self.average(snapshots=file, out=self.folder / "x")
                self.assert_one_error(done, BAD_INPUT, file.name)


if __name__ == "__main__":
    unittest.main()
