"""The averages of a run against another program's, from the snapshots that the run kept."""

import json
import pathlib
import subprocess
import unittest

from harness import FELL_SHORT, HELD, SystemTest, settings

OTHER = pathlib.Path(__file__).with_name("independent_averages.py")


class IndependentAverages(SystemTest):
    def test_every_field_is_what_another_program_makes_of_the_snapshots(self):
        done = self.compare(*settings(averaging__rotations=0.05, run__keep_snapshots=100000))
        self.assert_status(done, HELD, FELL_SHORT)
        other = subprocess.run(
            ["/usr/bin/python3", str(OTHER), str(self.out / "snapshots/grain-p0.h5"), str(self.out / "results.json")],
            capture_output=True,
            text=True,
        )
        self.assertEqual("", other.stderr)
        found = json.loads(other.stdout)
        self.assertEqual([], found["missing"])
        self.assertGreaterEqual(len(found["worst"]), 43)
        for field, worst in found["worst"].items():
            with self.subTest(field):
                # Of the field's largest value: sums of some hundred disks, cut near tangency.
                self.assertLess(worst, 1e-10)


if __name__ == "__main__":
    unittest.main()
