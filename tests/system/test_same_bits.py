"""The results of the quick cell, of all collisions and of the quick hard cases, to the bit."""

import json
import tempfile
import unittest

import same_bits


class SameBits(unittest.TestCase):
    def check(self, command):
        kept = json.loads(same_bits.KEPT.read_text(encoding="utf-8"))[command]
        with tempfile.TemporaryDirectory(prefix="crossgrain-bits-") as cache:
            found = same_bits.run(command, cache)
        self.assertGreater(len(found), 10)
        other = sorted(name for name in kept.keys() | found.keys() if kept.get(name) != found.get(name))
        self.assertEqual([], other, f"{command}: {len(other)} of {len(kept)} are not as they were")

    def test_the_quick_cell(self):
        self.check("compare")

    def test_collisions(self):
        self.check("collide")

    def test_hard_cases(self):
        self.check("stability")


if __name__ == "__main__":
    unittest.main()
