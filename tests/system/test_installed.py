"""What `cmake --install` lays out works from anywhere, without the sources; so do its libraries and its package.

The installed tree is moved before it is used, and the sources lie under an empty file system while the
program runs, in a mount namespace of its own.
"""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from harness import FELL_SHORT, HELD, PATIENCE, Finished, SystemTest

SOURCES = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["CROSSGRAIN_BUILD"])
CONSUMER = pathlib.Path(__file__).resolve().parent / "consumer"
SHORT_COUETTE = ["--engines", "grain", "--quick", "--quiet", "--set=run.mirrors=false", "--set=averaging.rotations=0.02"]


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

    def test_commands_that_only_report(self):
        self.assertEqual("", self.run_hidden("ls", SOURCES).stdout, "the sources are out of sight")
        for command, words in (
            ("engines", "yade"), ("list cases", "couette/quick.toml"), ("list keys", "packings"), ("help compare", "crossgrain compare"),
            ("check cases/couette/quick.toml --engines grain", "can run it"), ("calibrate cases/couette/quick.toml", "e_n"), ("-V", "."),
        ):  # fmt: skip
            self.assertIn(words, self.held(*command.split()))

    def test_copies_of_the_examples(self):
        """As docs/your-engine.md has it: both are copied, the one in C++ is built against the installed headers."""
        share = self.prefix / "share/crossgrain"
        for name in ("python", "cpp"):
            shutil.copytree(share / "examples" / name, self.folder / name)
        self.assertIn("passed", self.held("conformance", "python/engine.toml", "-k", "HeadOn", "--quiet"))
        done = self.run_hidden(
            "sh", "-c", f"cd cpp && g++ -std=c++17 -I{share}/engines/cpp engine.cpp -o engine"
        )
        self.assert_status(done, HELD)
        self.assertIn("passed", self.held("conformance", "cpp/engine.toml", "-k", "HeadOn", "--quiet"))

    def test_runs_that_read_cases_scripts_and_page(self):
        """A worker whose script is installed, hard cases, a packing, what average and report make of its snapshots."""
        few = ["-k", "spring_dashpot-cut", "--set=collision.psi=[0.5]", "--out", "collide", "--quiet"]
        done = self.installed("collide", "cases/collision/figure-4-3.toml", "--engines", "grain,yade", *few)
        self.assert_status(done, HELD, FELL_SHORT)
        self.assertNotIn("failed", done.stderr)
        self.held("stability", "-k", "billiard*", "--engines", "grain", "--out", "stability", "--quiet")
        case = "cases/couette/quick.toml"
        self.held("compare", case, *SHORT_COUETTE, "--set=run.keep_snapshots=2", "--out", "out")
        self.held("average", "out/snapshots/grain-p0.h5", case, "--out", "average")
        page = self.folder / "out/report.html"
        page.unlink()
        self.held("report", "out")
        self.assertGreater(page.stat().st_size, 10_000)


class LaidOut(InstalledTest):
    def test_links_of_the_documents_lead_somewhere(self):
        documents = next(self.prefix.glob("share/doc/*"))
        for page in (documents / "README.md", *documents.glob("docs/*.md")):
            links = re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8"))
            for link in links:
                if "://" not in link:
                    self.assertTrue((page.parent / link).exists(), f"{page.name}: {link}")

    def test_completion(self):
        for place in ("bash-completion/completions/crossgrain", "zsh/vendor-completions/_crossgrain", "fish/vendor_completions.d/crossgrain.fish"):
            self.assertIn("__complete", (self.prefix / "share" / place).read_text(encoding="utf-8"))

    def test_manual_page_has_every_command(self):
        page = (self.prefix / "share/man/man1/crossgrain.1").read_text(encoding="utf-8")
        for command in ("compare", "collide", "stability", "cost"):
            self.assertIn(command, page)

    def test_site_has_every_page_and_its_words(self):
        site = next(self.prefix.glob("share/doc/*/html"))
        index = (SOURCES / "docs/README.md").read_text(encoding="utf-8")
        sidebar = (site / "docs/README.html").read_text(encoding="utf-8").partition('class="sidebar-tree"')[2].partition("<article")[0]
        for page in re.findall(r"\]\((\w[\w/.-]*)\.md\)", index):
            self.assertTrue((site / "docs" / f"{page}.html").exists(), page)
            self.assertIn(f"{page}.html", sidebar)
        self.assertIn('"docs/quickstart"', (site / "searchindex.js").read_text(encoding="utf-8"))
        self.assertIn("docs/README.html", (site / "index.html").read_text(encoding="utf-8"))
        call("sphinx-build", "-q", "-W", "-c", SOURCES / "docs", SOURCES, self.folder / "site")  # a link without target is an error

    def test_uninstall_leaves_no_file(self):
        made, manifest = self.folder / "made", self.folder / "install_manifest.txt"
        call("cmake", "--install", BUILD, "--prefix", made)
        shutil.copy(BUILD / "install_manifest.txt", manifest)
        own = made / "share/crossgrain/cases/own.toml"
        own.write_text("", encoding="utf-8")
        call("cmake", f"-DMANIFEST={manifest}", "-P", SOURCES / "cmake/Uninstall.cmake")
        self.assertEqual([own], [path for path in made.rglob("*") if not path.is_dir()])

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
        self.assertIn("/usr/share/doc/crossgrain/copyright\n", call("dpkg-deb", "-c", deb))
        call("dpkg-deb", "-x", deb, self.folder / "root")
        program = self.folder / "root/usr/bin/crossgrain"
        self.assertIn("grain", call(program, "engines"))
        self.assertIn("cases", call(program, "list", "cases", cwd=self.folder))


if __name__ == "__main__":
    unittest.main()
