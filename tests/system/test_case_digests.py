"""Every shipped case gives the in-house engine's bits that it gave, on any processor."""

import json
import pathlib
import tempfile
import unittest

import case_digests

# A cell, gravity and friction, collisions: with other instructions of the processor they are the same.
INSTRUCTED = ("couette/quick", "hard/restart", "collision/figure-4-3")


def processor_has(instructions):
    flags = pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8")
    return {"avx2": " avx2 ", "avx512": " avx512dq "}[instructions] in flags


class CaseDigests(unittest.TestCase):
    def setUp(self):
        self.kept = json.loads(case_digests.KEPT.read_text(encoding="utf-8"))
        folder = tempfile.TemporaryDirectory(prefix="crossgrain-bits-")
        self.addCleanup(folder.cleanup)
        self.cache = folder.name

    def test_all_are_as_they_were(self):
        self.assertEqual(sorted(case_digests.shipped()), sorted(self.kept))
        self.assertGreater(len(self.kept), 60)
        found = {name: case_digests.digest(name, self.cache) for name in self.kept}
        other = [name for name in self.kept if found[name] != self.kept[name]]
        self.assertEqual([], other, f"{len(other)} of {len(self.kept)} are not as they were")
        self.assertGreater(len(set(found.values())), 60)  # two share a scene with another, for as long as this
        for instructions in ("avx2", "avx512"):
            if not processor_has(instructions):
                continue
            for name in INSTRUCTED:
                with self.subTest(name, instructions=instructions):
                    self.assertEqual(self.kept[name], case_digests.digest(name, self.cache, GRAIN_INSTRUCTIONS=instructions))

    def test_what_is_left_out_is_there(self):
        for name in case_digests.LEFT_OUT:
            self.assertTrue((case_digests.CASES / f"{name}.toml").exists(), name)

    def test_the_last_bit_of_gravity_shows(self):
        gravity = "assembly.gravity=[0.0, -9.810000000000002]"
        self.assertNotEqual(self.kept["hard/wedge"], case_digests.digest("hard/wedge", self.cache, "--set", gravity))


if __name__ == "__main__":
    unittest.main()
