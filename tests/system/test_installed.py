"""What `cmake --install` lays out works from anywhere, without the sources; so do its libraries and its package.

The installed tree is moved before it is used, and the sources lie under an empty file system while the
program runs, in a mount namespace of its own.
"""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from harness import FELL_SHORT, HELD, PATIENCE, Finished, SystemTest

SOURCES = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["CROSSGRAIN_BUILD"])
CONSUMER = pathlib.Path(__file__).resolve().parent / "consumer"
SHORT_COUETTE = ["--engines", "grain", "--quick", "--quiet", "--set=run.mirrors=false"]
ONE_EFFECT = [
    f"--set={change}"
    for change in (
        'law.tangential="none"', "law.mu=0", "law.kt=0", "law.gt=0", 'law.tension="cut"', "bottom.mu=0",
        'run.precision="float"', "averaging.rotations=0.02",
    )
]  # fmt: skip


def call(*command, **options):
    done = subprocess.run(
        [str(word) for word in command], capture_output=True, text=True, timeout=PATIENCE, check=False, **options
    )
    if done.returncode != 0:
        raise AssertionError(f"{command}: status {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def may_hide():
    """Whether this process may mount in a namespace of its own."""
    return subprocess.run([*HIDE, "true"], capture_output=True, check=False).returncode == 0


HIDE = ["unshare", *([] if os.geteuid() == 0 else ["--map-root-user"]), "--mount"]


class InstalledTest(SystemTest):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory(prefix="crossgrain-installed-")
        cls.addClassCleanup(scratch.cleanup)
        made = pathlib.Path(scratch.name) / "made"
        cls.prefix = pathlib.Path(scratch.name) / "moved" / "here"
        call("cmake", "--install", BUILD, "--prefix", made)
        cls.prefix.parent.mkdir()
        shutil.move(made, cls.prefix)

    def run_hidden(self, program, *arguments):
        """From an empty folder, with the sources and their build out of sight."""
        done = subprocess.run(
            [*HIDE, "sh", "-c", 'mount -t tmpfs none "$0" && exec "$@"', SOURCES, program, *map(str, arguments)],
            capture_output=True, text=True, cwd=self.folder, timeout=PATIENCE, check=False,
            env={k: v for k, v in os.environ.items() if k != "CROSSGRAIN_DATA"},
        )  # fmt: skip
        return self.check_no_crash(Finished(done.returncode, done.stdout, done.stderr))


@unittest.skipUnless(may_hide(), "mount namespaces are not allowed here")
class WithoutTheSources(InstalledTest):
    def installed(self, *arguments):
        return self.run_hidden(self.prefix / "bin/crossgrain", *arguments)

    def held(self, *arguments):
        done = self.installed(*arguments)
        self.assert_status(done, HELD)
        return done.stdout

    def test_the_sources_are_out_of_sight(self):
        done = self.run_hidden("ls", SOURCES)
        self.assertEqual("", done.stdout)

    def test_commands_that_only_tell(self):
        self.assertIn("yade", self.held("engines"))
        self.assertIn("couette/quick.toml", self.held("list", "cases"))
        self.assertRegex(self.held("list", "keys"), r"(?m)^preparation +packings ")
        self.assertIn("energy_drift", self.held("list", "measures"))
        self.assertIn("volume_fraction", self.held("list", "fields"))
        self.assertIn("can run it", self.held("check", "cases/couette/quick.toml"))
        self.assertIn("e_n", self.held("calibrate", "cases/couette/quick.toml"))
        self.assertIn("crossgrain compare", self.held("help", "compare"))
        self.assertRegex(self.held("-V"), r"\d+\.\d+\.\d+")

    def test_collide_on_a_worker_whose_script_is_installed(self):
        done = self.installed(
            "collide", "cases/collision/figure-4-3.toml", "--engines", "grain,yade", "--out", "out", "--quiet"
        )
        self.assert_status(done, HELD, FELL_SHORT)
        self.assertNotIn("failed", done.stderr)
        self.assertTrue((self.folder / "out/report.html").exists())

    def test_copies_of_the_examples(self):
        """As docs/your-engine.md has it: both are copied, the one in C++ is built against the installed headers."""
        share = self.prefix / "share/crossgrain"
        for name in ("python", "cpp"):
            shutil.copytree(share / "examples" / name, self.folder / name)
        done = self.held(
            "lockstep", "cases/couette/quick.toml", "--engines", "python/engine.toml", "--quick", "--starts=1",
            "--out", "out", "--quiet",
        )  # fmt: skip
        self.assertIn("numpy: same to rounding", done)
        done = self.run_hidden(
            "sh", "-c", f"cd cpp && g++ -std=c++17 -I{share}/engines/cpp engine.cpp -o engine"
        )
        self.assert_status(done, HELD)
        self.assertIn("passed", self.held("conformance", "cpp/engine.toml", "-k", "HeadOn", "--quiet"))

    def test_stability(self):
        self.held("stability", "-k", "billiard*", "--engines", "grain", "--out", "out", "--quiet")

    def test_compare_average_rev_and_report(self):
        case = "cases/couette/quick.toml"
        done = self.installed("compare", case, *SHORT_COUETTE, "--out", "out")
        self.assert_status(done, HELD, FELL_SHORT)
        snapshots = "out/snapshots/grain-p0.h5"
        self.held("average", snapshots, case, "--out", "average")
        self.held("rev", snapshots, case, "--out", "rev")
        page = self.folder / "out/report.html"
        page.unlink()
        self.held("report", "out")
        self.assertGreater(page.stat().st_size, 10_000)

    def test_effects(self):
        self.held("effects", "cases/couette/quick.toml", *SHORT_COUETTE, *ONE_EFFECT, "--out", "out")

    def test_cost(self):
        self.held(
            "cost", "cases/cost/quick.toml", "--engines", "grain", "--quick", "--quiet", "--out", "out",
            '--set=cost.kinds=["collision"]', '--set=cost.knobs=["time_step"]',
        )  # fmt: skip


class LaidOut(InstalledTest):
    def test_completion(self):
        self.assertTrue((self.prefix / "share/bash-completion/completions/crossgrain").exists())

    def test_another_project_finds_builds_and_runs_with_the_libraries(self):
        build = self.folder / "build"
        call("cmake", "-S", CONSUMER, "-B", build, "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={self.prefix}")
        call("cmake", "--build", build)
        case = self.prefix / "share/crossgrain/cases/hard/billiard-break.toml"
        self.assertRegex(call(build / "consumer", case), r"^\d+ disks, e_n 1\.000000\n$")

    def test_another_project_takes_the_sources_as_a_part_of_its_own(self):
        build = self.folder / "build"
        call("cmake", "-S", CONSUMER, "-B", build, "-G", "Ninja", f"-DCROSSGRAIN_SOURCES={SOURCES}")
        self.assertIn("main.cpp", call("ninja", "-C", build, "-t", "inputs", "consumer"))


class Package(InstalledTest):
    def test_a_deb_with_its_dependencies(self):
        call("cpack", "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", self.folder, cwd=self.folder)
        (deb,) = self.folder.glob("crossgrain_*.deb")
        depends = call("dpkg-deb", "-f", deb, "Depends")
        for library in ("libgsl", "libhdf5", "libbox2d", "libfmt", "libc6", "gnuplot"):
            self.assertIn(library, depends)
        self.assertIn("yade", call("dpkg-deb", "-f", deb, "Recommends"))
        call("dpkg-deb", "-x", deb, self.folder / "root")
        program = self.folder / "root/usr/bin/crossgrain"
        self.assertIn("grain", call(program, "engines"))
        self.assertIn("cases", call(program, "list", "cases", cwd=self.folder))


if __name__ == "__main__":
    unittest.main()
