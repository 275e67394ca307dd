"""Folders know each other one way only: what a file includes lies in a folder named before its own.

The order is that of the list below, from what knows nothing to what knows all. A folder that is not
in the list fails the test: its place is to be thought about.
"""

import json
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
    "reports/common", "reports/render", "reports/lockstep", "reports/flow", "reports/regression", "reports/collide", "reports/conformance", "reports/effects", "reports/cost", "reports/stability",
    "reports",
    "studies/core", "studies/causes", "studies/lockstep", "studies/flow", "studies/collide", "studies/conformance", "studies/stability", "studies/effects", "studies/cost", "studies/regression", "studies/check",
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


# Files of other programs, and files that are written.
ELSEWHERE = {
    "ContactConstraintManager.cpp", "HertzMindlin.cpp", "LudingPM.cpp", "ViscoelasticPM.cpp", "collision_util.cpp",
    "compute_pair_gran_local.cpp", "gran_sub_mod_rolling.cpp", "implementation/README.md", "joints/contact.cpp", "lcp.cpp",
    "pair_gran_hooke_history.cpp", "pair_granular.cpp", "quickstep.cpp", "sphere.cpp", "summary.md", "out/quick/summary.md",
    "out/conformance/summary.md", "box.cpp", "collision_libccd.cpp", "../../../tests/faults/README.md", "runs/README.md", "my/engine.py", "engines/ENGINE/worker.py",
}  # fmt: skip


def references(path):
    """Source files and pages that a file's text or comments name."""
    lines = path.read_text(encoding="utf-8").splitlines()
    if path.suffix != ".md":
        sign = "//" if path.suffix in (".hpp", ".cpp", ".mjs") else "# "
        lines = [line.split(sign, 1)[1] for line in lines if sign in line and "://" not in line]
    for line in lines:
        yield from re.findall(r"(?<![\w./<*{}-])((?:[\w.-]+/)*[\w-]+\.(?:hpp|cpp|py|md))\b", line)


class References(unittest.TestCase):
    """What texts name is there: a file that moved takes its mentions along."""

    def files(self):
        """Those of the project, from its root, without what builds and runs leave beside them."""
        places = (path.relative_to(ROOT) for path in ROOT.rglob("*.*") if path.is_file())
        return [path for path in places if not re.match(r"build|out/|\.", str(path)) and "node_modules" not in path.parts]

    def test_files(self):
        files = self.files()
        by_name = {}
        for file in files:
            by_name.setdefault(file.name, []).append(str(file))
        stale = []
        for file in files:
            if file.suffix not in (".hpp", ".cpp", ".py", ".md", ".mjs") or file.name in ("CHANGELOG.md", pathlib.Path(__file__).name):
                continue
            for named in set(references(ROOT / file)) - ELSEWHERE:
                if "NAME" in named or ((ROOT / file).parent / named).exists():
                    continue
                if not any(("/" + each).endswith("/" + named) for each in by_name.get(pathlib.Path(named).name, [])):
                    stale.append(f"{file} names {named}")
        self.assertEqual([], sorted(stale))

    def test_presets(self):
        known = {preset["name"] for preset in json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]}
        named = {
            (str(file), preset)
            for file in self.files()
            if file.suffix == ".md"
            for preset in re.findall(r"--preset[ =]([\w-]+)", (ROOT / file).read_text(encoding="utf-8"))
        }
        self.assertTrue(named)
        self.assertEqual(set(), {pair for pair in named if pair[1] not in known})


if __name__ == "__main__":
    unittest.main()
