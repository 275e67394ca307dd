"""LIGGGHTS beside its mirror, where its package is installed (./setup --engines all)."""

import json
import shutil
import unittest

from harness import COLLISION, COUETTE, HELD, SystemTest, settings


@unittest.skipUnless(shutil.which("liggghts"), "liggghts is not installed")
class Liggghts(SystemTest):
    def test_it_is_its_law(self):
        """Contacts that open and close again within a list's life are in these windows; an old spring showed as 2 %
        of k_n."""
        done = self.run_program(
            "lockstep", COUETTE, "--engines", "liggghts", "--quick", "--starts=2", "--out", self.out, "--quiet"
        )
        self.assert_status(done, HELD)
        (row,) = self.results()["lockstep"]["rows"]
        self.assertEqual("same_law", row["verdict"])
        self.assertLess(row["equivalent"], 1e-3)
        self.assertLess(row["forces"]["normal"], 1e-12)
        self.assertLess(row["forces"]["tangential"], 1e-8)
        self.assertGreater(row["kinds"]["opening"], 50)

    def test_two_disks_take_the_steps_of_its_scheme(self):
        self.run_program(
            "collide", COLLISION, "--engines", "liggghts", "-k", "*spring*", "--out", self.out, "--quiet",
            *settings(collision__psi=[0.5, 3.0], collision__steps_per_contact=50),
        )  # fmt: skip
        seen = 0
        for variant in self.results()["variants"]:
            for curve in variant["curves"]:
                if curve["engine"] == "liggghts":
                    self.assertEqual("finished", curve["status"])
                    self.assertTrue(curve["own_scheme"]["held"], curve["own_scheme"])
                    seen += 1
        self.assertEqual(4, seen)

    def test_its_checks(self):
        done = self.run_program("conformance", "liggghts", "--quiet", "--json", "-k", "Contact")
        self.assert_status(done, HELD)
        self.assertIn("passed", {check["outcome"] for check in json.loads(done.stdout)["checks"]})


if __name__ == "__main__":
    unittest.main()
