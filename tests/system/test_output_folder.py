"""The output folder cannot be written (status 2), or has no room (status 3): the system's own reason, and
how to go on."""

import os
import resource
import signal
import subprocess
import unittest

from harness import (
    BAD_INPUT,
    COLLISION,
    COUETTE,
    ENGINE_FAILED,
    HELD,
    PATIENCE,
    PROGRAM,
    Finished,
    SystemTest,
    settings,
)

SHORT = settings(averaging__rotations=0.02, preparation__rotations=0.0)


class Unwritable(SystemTest):
    def commands(self, out):
        yield self.compare("--quiet", *SHORT, out=out)
        yield self.run_program(
            "collide", COLLISION, "--engines", "grain", "--out", out, "--quiet"
        )

    def test_below_a_file(self):
        file = self.write("file", "")
        for done in self.commands(file / "out"):
            self.assert_one_line(done, BAD_INPUT, str(file / "out"), "Not a directory")

    def test_in_proc(self):
        for done in self.commands("/proc/crossgrain"):
            self.assert_one_line(done, BAD_INPUT, "/proc/crossgrain", "No such file or directory")

    @unittest.skipIf(os.geteuid() == 0, "permissions do not hold for root")
    def test_without_permission(self):
        self.out.mkdir(mode=0o500)
        for done in self.commands(self.out):
            self.assert_one_line(done, BAD_INPUT, str(self.out), "Permission denied")


class Full(SystemTest):
    """The input is not at fault, and what is finished is taken up once there is room."""

    ROOM = "what is finished is kept: make room, and the same command goes on"

    def on_small_disk(self, kib, disk, *arguments):
        """A `compare` while a file system of that size lies over the folder `disk`, in a mount
        namespace of its own."""
        disk.mkdir(exist_ok=True)
        mount = 'mount -t tmpfs -o "size=$1k" none "$2" || exit 77; shift 2; exec "$@"'
        flags = ["--mount"] if os.geteuid() == 0 else ["--user", "--map-root-user", "--mount"]
        command = [
            "unshare", *flags, "sh", "-c", mount, "sh", kib, disk,
            PROGRAM, "compare", COUETTE, "--engines=grain", "--out", self.out, "--quick", "--quiet",
            *SHORT, *arguments,
        ]  # fmt: skip
        done = subprocess.run(
            [*map(str, command)],
            capture_output=True,
            encoding="utf-8",
            env=os.environ | {"CROSSGRAIN_CACHE": str(self.folder / "cache")},
            timeout=PATIENCE,
            check=False,
        )
        if done.returncode == 77 or "unshare:" in done.stderr:
            self.skipTest(f"no file system can be mounted here: {done.stderr.strip()}")
        return self.check_no_crash(Finished(done.returncode, done.stdout, done.stderr))

    def test_full_disk(self):
        # The first to find no room: a worker's arrays, a run's file, the results of all runs.
        for kib in (16, 64, 128, 256):
            with self.subTest(kib=kib):
                done = self.on_small_disk(kib, self.out)
                self.assert_one_line(
                    done, ENGINE_FAILED, str(self.out), "No space left on device", self.ROOM
                )

    def test_full_disk_under_the_packings(self):
        cache = self.folder / "cache"
        for kib in (4, 12):
            with self.subTest(kib=kib):
                # Packings that cannot be kept cost time, not the run, and leave no half file.
                done = self.on_small_disk(kib, cache)
                self.assert_status(done, HELD)

    def test_file_size_limit(self):
        """As a quota would: files may not grow beyond some kilobytes."""

        def limit():
            # The limit's signal would end the program; ignored, write() fails with EFBIG.
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))

        def limited(*arguments):
            return self.compare("--quiet", *SHORT, *arguments, preexec_fn=limit, restore_signals=False)

        self.assert_status(self.compare("--quiet", *SHORT), HELD)  # the packings are in the cache
        done = limited("--fresh")
        self.assertIn(f"{self.out / 'earlier/1'}\n", done.stderr)
        self.assert_one_error(
            done, ENGINE_FAILED, str(self.out), "File too large", "without --fresh goes on"
        )
        self.assertEqual([], list(self.out.rglob("*.part*")), "nothing half written is left")
        self.assertEqual({}, self.finished_runs())

    def test_what_is_finished_is_taken_up_when_there_is_room(self):
        """Two packings are finished; of two more the disk takes no byte."""

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (50_000, 50_000))

        self.assert_status(self.compare("--quiet", *SHORT), HELD)
        more = [*SHORT, *settings(preparation__packings=3)]
        finished, report = self.finished_runs(), (self.out / "results.json").read_bytes()
        done = self.compare("--quiet", *more, preexec_fn=limit, restore_signals=False)
        self.assert_one_line(done, ENGINE_FAILED, "grain-p2", "File too large", self.ROOM)
        self.assertEqual(finished, self.finished_runs())
        self.assertEqual(report, (self.out / "results.json").read_bytes())
        done = self.compare(*more)
        self.assert_status(done, HELD)
        self.assertEqual(2, done.stderr.count("finished in an earlier run"), str(done))


if __name__ == "__main__":
    unittest.main()
