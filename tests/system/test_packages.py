"""What the project is built, tested and run with is in packages.txt, or comes along with what is.

A package that somebody installed by hand hides that it is missing: on a bare machine ./test then stops at
once. So everything that this build really read (headers, packages that CMake found, libraries), every module that
a script imports and every program that is called is traced to the Debian package that owns it.
CROSSGRAIN_BUILD is the build's folder.
"""

import ast
import functools
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["CROSSGRAIN_BUILD"])

# Modules that only exist inside the program that runs the script.
INSIDE_PROGRAMS = {"yade": "yade"}

# Modules of optional engines: without them the engine is refused.
OPTIONAL_MODULES = {"siconos"}
# Packages of optional engines, by ./setup --engines all: without them the build leaves the engine out.
OPTIONAL_PACKAGES = {"libmujoco-dev"}

# Programs that are asked for before they are used.
OPTIONAL_PROGRAMS = {"sudo", "ccache", "groff", "chromium", "node", "nodejs", "npm", "liggghts"}


def sources(pattern):
    """Files of the project, without what builds and runs leave beside them."""
    return [
        path for path in ROOT.rglob(pattern) if not re.match(r"build|out|\.", str(path.relative_to(ROOT)))
    ]


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


def wanted():
    lines = (ROOT / "packages.txt").read_text(encoding="utf-8").splitlines()
    return {line.strip() for line in lines if line.strip() and not line.startswith("#")}


@functools.cache
def installed_with_packages_txt():
    """Names of all packages that a bare Debian has once packages.txt is installed on it."""
    fields = "${Package}\t${Depends}, ${Pre-Depends}\t${Provides}\t${Essential}\t${Priority}\n"
    needs, providers, known = {}, {}, set(wanted())
    for line in output("dpkg-query", "-W", "-f", fields).splitlines():
        name, depends, provides, essential, priority = line.split("\t")
        needs[name] = {word for word in re.findall(r"(?:^|[,|])\s*([a-z0-9][a-z0-9+.-]+)", depends)}
        for virtual in re.findall(r"(?:^|,)\s*([a-z0-9][a-z0-9+.-]+)", provides):
            providers.setdefault(virtual, set()).add(name)
        if essential == "yes" or priority in ("required", "important"):
            known.add(name)
    todo, found = list(known), set()
    while todo:
        name = todo.pop()
        if name in found:
            continue
        found.add(name)
        todo += needs.get(name, ())
        todo += providers.get(name, ()) if name not in needs else ()
    return found


def owners(paths):
    """path → package that owns it, for those that a package owns."""
    paths = sorted({str(path) for path in paths})
    owner = {}
    for start in range(0, len(paths), 500):
        piece = paths[start : start + 500]
        # Where /lib is a link to /usr/lib, a package may say either.
        either = piece + [path[4:] for path in piece if path.startswith("/usr/")]
        for line in output("dpkg", "-S", *either).splitlines():
            packages, _, path = line.partition(": ")
            if not packages.startswith("diversion "):
                owner[path if path in piece else "/usr" + path] = packages.split(",")[0].split(":")[0]
    return owner


def canonical(path):
    """The file that a package ships, however many links lead to it."""
    return os.path.realpath(path)


@unittest.skipUnless(shutil.which("dpkg-query"), "not a Debian: no packages to look things up in")
class Packages(unittest.TestCase):
    maxDiff = None

    def assert_in_packages_txt(self, paths):
        """paths: what needs it → the file"""
        owner = owners(canonical(path) for path in paths.values())
        missing = {
            (what, owner.get(canonical(path), f"{path}, of no package"))
            for what, path in paths.items()
            if owner.get(canonical(path)) not in installed_with_packages_txt() | OPTIONAL_PACKAGES
        }
        self.assertEqual(set(), missing, "needed, and not installed by packages.txt")

    def test_every_package_that_cmake_finds(self):
        asked = set()
        for file in sources("CMakeLists.txt"):
            asked |= set(re.findall(r"find_package\((\w+)", file.read_text(encoding="utf-8")))
        self.assertIn("rapidcheck", asked)
        cache = (BUILD / "CMakeCache.txt").read_text(encoding="utf-8")
        entries = dict(re.findall(r"^(\w+):\w+=(/.*)$", cache, re.M))
        found = {}
        for name in asked - {"Threads", "crossgrain"}:
            paths = [
                path for key, path in entries.items()
                if re.fullmatch(rf"_?{name}_(DIR|EXECUTABLE|INCLUDE_DIR|(C_)?LIBRARY(_\w+)?)", key, re.I)
                and key not in (f"{name}_SOURCE_DIR", f"{name}_BINARY_DIR")
            ]
            self.assertTrue(paths, f"find_package({name}): nothing in CMakeCache.txt says where it is")
            for path in paths:
                # Folders of all packages say nothing of one.
                if not re.fullmatch(r"/usr/(include|lib(/[\w-]+-linux-gnu)?)", path):
                    found[f"find_package({name}) {path}"] = path
        self.assert_in_packages_txt(found)

    def test_every_header_that_the_build_reads(self):
        headers = set(re.findall(r"^\s+(/usr/\S+)$", output("ninja", "-C", str(BUILD), "-t", "deps"), re.M))
        self.assertGreater(len(headers), 100)
        self.assert_in_packages_txt({header: header for header in headers})

    def test_every_module_that_a_script_imports(self):
        scripts = sources("*.py")
        self.assertIn(pathlib.Path(__file__).resolve(), scripts)
        own = {script.stem for script in scripts} | {script.parent.name for script in scripts if script.stem == "__init__"}
        modules = set()
        for script in scripts:
            for node in ast.walk(ast.parse(script.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Import):
                    modules |= {alias.name.split(".")[0] for alias in node.names}
                elif isinstance(node, ast.ImportFrom) and not node.level:
                    modules.add(node.module.split(".")[0])
        foreign = modules - own - set(sys.stdlib_module_names) - OPTIONAL_MODULES
        self.assertLessEqual({"numpy", "yade"}, foreign)
        for module in foreign & set(INSIDE_PROGRAMS):
            self.assertIn(INSIDE_PROGRAMS[module], wanted())
        found = {}
        for module in foreign - set(INSIDE_PROGRAMS):
            spec = importlib.util.find_spec(module)
            self.assertIsNotNone(spec, f"{module} is not there for {sys.executable}")
            found[f"import {module}"] = spec.origin
        self.assert_in_packages_txt(found)

    def test_every_program_that_is_called(self):
        called = set()
        patterns = {
            "*.py": [r"which\(\s*\"([\w.-]+)\"", r"(?:run|Popen)\(\s*\[\s*\"([\w.-]+)\""],
            "*.cpp": [r"onPath\(\"([\w.-]+)\"\)", r"posix_spawnp\(&\w+, \"([\w.-]+)\"", r"execvp\(\"([\w.-]+)\""],
        }
        for kind, expressions in patterns.items():
            for file in sources(kind):
                text = file.read_text(encoding="utf-8")
                called |= {word for expression in expressions for word in re.findall(expression, text)}
        self.assertLessEqual({"gnuplot", "yade", "lmp"}, called)
        for name in ("run", "test", "setup", ".ci/run"):
            text = re.sub(r"(^|\s)#.*|'[^']*'|\$\{?crossgrain\}?\"? \w+", " ", (ROOT / name).read_text(encoding="utf-8"))
            called |= {word for word in re.findall(r"(?<![\w./$=-])[a-z][\w.-]+(?![\w/=-])", text) if shutil.which(word)}
        self.assertLessEqual({"cmake", "ctest"}, called)
        paths = {word: shutil.which(word) for word in called - OPTIONAL_PROGRAMS}
        absent = {word for word, path in paths.items() if not path}
        self.assertEqual(set(), absent, "programs that are called and not installed")
        self.assert_in_packages_txt(paths)

    def test_scripts_that_are_called_by_name_can_be(self):
        for name in ("run", "test", "setup", ".ci/run"):
            self.assertTrue(os.access(ROOT / name, os.X_OK), f"./{name} has no run bit")


if __name__ == "__main__":
    unittest.main()
