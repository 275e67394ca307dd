"""Folders know each other one way only: what a file includes lies in a folder named before its own.

The order is that of the list below, from what knows nothing to what knows all. A folder that is not
in the list fails the test: its place is to be thought about.
"""

import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Each may include those before it. Studies stand on core/, reports on common/ and render/, and on each other where
# one makes use of another.
ORDER = [
    "support",
    "law",
    "engines/cpp", "engines/bullet", "engines/chipmunk", "engines/mujoco", "engines/ode", "engines/grain", "engines/box2d",
    "adapters", "adapters/files", "adapters/worker",
    "oracle", "stability", "averaging", "cases", "results",
    "reports/common", "reports/render", "reports/lockstep", "reports/flow", "reports/regression", "reports/collide", "reports/conformance", "reports/effects", "reports/cost", "reports/stability", "reports/site",
    "reports",
    "studies/core", "studies/lockstep", "studies/flow", "studies/collide", "studies/conformance", "studies/stability", "studies/effects", "studies/cost", "studies/regression", "studies/check", "studies/plan",
    "cli",
]  # fmt: skip

# Those that know nothing of the other, though the order would let them.
UNRELATED = [("engines/box2d", "engines/grain"), ("oracle", "averaging"), ("studies", "reports")]


def sources():
    for top in sorted({folder.split("/")[0] for folder in ORDER}):
        yield from (path for path in (ROOT / top).rglob("*") if path.suffix in (".hpp", ".cpp"))


def folder_of(path):
    return str(path.parent.relative_to(ROOT))


def includes():
    """(including file, its folder, folder of what it includes), of the project's own headers."""
    for path in sources():
        for header in re.findall(r'^#include "([^"]+)"', path.read_text(encoding="utf-8"), re.M):
            target = ROOT / header if (ROOT / header).exists() else path.parent / header
            yield path.relative_to(ROOT), folder_of(path), str(pathlib.Path(folder_of(target)))


def types_of(path):
    """(namespace, name) of each type that a file defines outside of nameless namespaces."""
    inside = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if opened := re.match(r"namespace ?([\w:]*(?: [\w:]+)?) ?\{$", line):
            inside.append(opened[1])
        elif line.startswith("}  // namespace"):
            inside.pop()
        elif defined := re.match(r"(?:struct|class|enum class) (?:alignas\(\d+\) )?(\w+)\b(?!::)[^;]*$", line):
            if "" not in inside:
                yield "::".join(inside), defined[1]


class Architecture(unittest.TestCase):
    def test_every_folder_has_its_place(self):
        self.assertEqual(set(), {folder_of(path) for path in sources()} - set(ORDER))

    def test_arrows_go_one_way(self):
        place = {folder: k for k, folder in enumerate(ORDER)}
        wrong = [
            f"{file} includes {target}/"
            for file, folder, target in includes()
            if target != folder and place[target] > place[folder]
        ]
        self.assertEqual([], wrong)

    def test_strangers_stay_strangers(self):
        wrong = [
            f"{file} includes {target}/"
            for file, folder, target in includes()
            for who, whom in UNRELATED
            if (folder + "/").startswith(who + "/") and (target + "/").startswith(whom + "/")
        ]
        self.assertEqual([], wrong)

    def test_no_two_types_of_one_namespace_have_one_name(self):
        """The linker would take one for the other (the odr preset has the compiler look, too)."""
        found = {}
        for path in sources():
            for namespace, name in types_of(path):
                found.setdefault((namespace, name), set()).add(str(path.relative_to(ROOT)))
        self.assertGreater(len(found), 300)
        self.assertEqual({}, {name: files for name, files in found.items() if len(files) > 1})

    def test_there_is_something_to_check(self):
        self.assertGreater(len(list(includes())), 1000)


if __name__ == "__main__":
    unittest.main()
