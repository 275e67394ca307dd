"""Runs crossgrain as a user does and looks at what it says, leaves behind and leaves running.

CROSSGRAIN in the environment is the program; CROSSGRAIN_CACHE where packings are kept.
"""

import csv
import fcntl
import json
import os
import pathlib
import pty
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import termios
import time
import unittest
import uuid

PROGRAM = os.environ["CROSSGRAIN"]
# Examples and engines of tests say "python3": the one that runs these tests has numpy, the first in PATH need not.
os.environ["PATH"] = f"{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}"
# Sentences are looked for in one line; tests of terminals say how wide theirs is.
os.environ["COLUMNS"] = "5000"
HOME = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("CROSSGRAIN_BUILD", HOME / "build/release"))
CASES = HOME / "cases"
# An engine of a user's own in each language.
PYTHON, CPP = HOME / "examples/python/engine.toml", BUILD / "examples/cpp/engine.toml"
COUETTE = CASES / "couette/quick.toml"
COLLISION = CASES / "collision/figure-4-3.toml"
HARD_SPHERE = CASES / "collision/hard-sphere.toml"

# Longest wait [s] for commands that take seconds: it ends a hanging one; a busy machine needs far less.
PATIENCE = 1200

# Tests that take tens of seconds and whose parts other tests show: the target engine_examples.
nightly = unittest.skipUnless(os.environ.get("CROSSGRAIN_NIGHTLY"), "of the target engine_examples")

HELD, FELL_SHORT, BAD_INPUT, ENGINE_FAILED, INTERRUPTED = 0, 1, 2, 3, 130

# Output that a user must never see: crashes of Python, of the C++ runtime and of sanitizers.
CRASH = re.compile(r"Traceback|terminate called|core dumped|Sanitizer|Assertion|what\(\):|HDF5-DIAG")


def settings(**changes):
    """["--set=a.b=1", …] from a__b=1. Lists are written as TOML's, which are JSON's."""
    return [
        f"--set={key.replace('__', '.')}={json.dumps(value) if isinstance(value, list) else value}"
        for key, value in changes.items()
    ]


def installed_engines():
    """Capabilities by name. An engine that is there and does not start has none, and is an error."""
    done = subprocess.run([PROGRAM, "engines", "--json"], capture_output=True, check=True)
    there = [row for row in json.loads(done.stdout) if "is not available" not in row.get("missing", "")]
    return {row["name"]: row["capabilities"] for row in there}


def recorded_exchanges(recording):
    """Request, answer and the array file of the answer of each exchange of a recording (docs/files.md)."""
    with open(recording, "rb") as file:
        file.readline(), file.readline()  # the head and its checksum
        while line := file.readline():
            exchange = json.loads(line)
            file.seek(exchange["sent"], 1)
            yield exchange["request"], exchange["answer"], file.read(exchange["received"])
            file.readline()


def environment(changes):
    """This process' environment with changes; None takes a variable away."""
    merged = os.environ | (changes or {})
    return {name: value for name, value in merged.items() if value is not None}


class Finished:
    """How a program ended and what it printed."""

    def __init__(self, status, stdout, stderr):
        self.status, self.stdout, self.stderr = status, stdout, stderr

    def error_lines(self):
        return [line for line in self.stderr.splitlines() if line.startswith("crossgrain: ")]

    def __str__(self):
        return f"status {self.status}\n--- stdout\n{self.stdout}--- stderr\n{self.stderr}"


class Running:
    """A program that runs beside the test. Its processes, also orphaned ones, are found by a mark in
    their environment."""

    def __init__(self, command, folder, env):
        self.mark = uuid.uuid4().hex
        self._out = open(folder / f"{self.mark}.out", "w+", encoding="utf-8")
        self._err = open(folder / f"{self.mark}.err", "w+", encoding="utf-8")
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=self._out,
            stderr=self._err,
            env=env | {"CROSSGRAIN_TEST_MARK": self.mark},
        )

    def stderr(self):
        return pathlib.Path(self._err.name).read_text(encoding="utf-8")

    def end(self, seconds=PATIENCE):
        """Waits until it has ended by itself."""
        status = self.process.wait(timeout=seconds)
        return Finished(
            status, pathlib.Path(self._out.name).read_text(encoding="utf-8"), self.stderr()
        )

    def processes(self):
        """Ids of all processes that it started and that still run, but for itself."""
        return [pid for pid in marked_processes(self.mark) if pid != self.process.pid]

    def workers(self, engine):
        return [pid for pid in self.processes() if command_line(pid)[1:] == ["__serve", engine]]

    def worker_at_work(self, engine, cpu_seconds=0.15, stage="running engines"):
        """Waits until the runs have begun and a worker of that engine has computed for a while."""
        wait_for(lambda: stage in self.stderr(), PATIENCE, "the runs to begin")
        before, found = {}, []

        def computing():
            if self.process.poll() is not None:
                raise AssertionError(f"it ended before {engine} was seen at work: {self.stderr()}")
            # Workers go from run to run: time that one used before the runs began does not count.
            now = {pid: cpu_time(pid) for pid in self.workers(engine)}
            for pid, seconds in now.items():
                before.setdefault(pid, seconds)
            found[:] = [pid for pid, seconds in now.items() if seconds - before[pid] >= cpu_seconds]
            return found

        wait_for(computing, PATIENCE, f"a worker of {engine}")
        return found[0]

    def stop(self):
        """For tests that failed half way."""
        for pid in [*self.processes(), self.process.pid]:
            try:
                os.kill(pid, 9)
            except ProcessLookupError:
                pass
        self.process.wait()
        self._out.close()
        self._err.close()


def on_terminal(columns, stream, arguments, env=None):
    """Runs the program with one of its streams ("stdout", "stderr") on a pseudo-terminal of that width.
    Returns its status and what it drew there."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("4H", 24, columns, 0, 0))
    silent = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL} | {stream: theirs}
    with subprocess.Popen(
        [PROGRAM, *map(str, arguments)], stdin=subprocess.DEVNULL, env=environment({"COLUMNS": None} | (env or {})), **silent
    ) as process:
        os.close(theirs)
        drawn = b""
        try:
            while part := os.read(ours, 65536):
                drawn += part
        except OSError:  # EIO: the other end is closed
            pass
        os.close(ours)
    return process.returncode, drawn.decode()


def wait_for(condition, seconds, what):
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError(f"waited {seconds} s in vain for {what}")
        time.sleep(0.01)


def read_proc(pid, name):
    """A file of /proc, empty for a process that has gone."""
    try:
        return pathlib.Path(f"/proc/{pid}/{name}").read_bytes()
    except OSError:
        return b""


def marked_processes(mark):
    pids = [int(entry.name) for entry in os.scandir("/proc") if entry.name.isdigit()]
    return [pid for pid in pids if mark.encode() in read_proc(pid, "environ") and is_alive(pid)]


def process_state(pid):
    """Fields of /proc/PID/stat from the state on (proc(5))."""
    return read_proc(pid, "stat").rpartition(b") ")[2].split()


def is_alive(pid):
    state = process_state(pid)
    return bool(state) and state[0] != b"Z"


def command_line(pid):
    return read_proc(pid, "cmdline").decode().split("\0")[:-1]


def cpu_time(pid):
    """User time so far [s]."""
    state = process_state(pid)
    return int(state[11]) / os.sysconf("SC_CLK_TCK") if state else 0.0


class SystemTest(unittest.TestCase):
    """One folder per test, gone afterwards, and assertions on how the program ended."""

    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="crossgrain-test-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.out = self.folder / "out"

    @classmethod
    def compared_once(cls, engines, *arguments, case=COUETTE):
        """The folder of one compare, of the small cell unless another is named, for setUpClass: all tests of a class read it."""
        shared = tempfile.TemporaryDirectory(prefix="crossgrain-test-")
        cls.addClassCleanup(shared.cleanup)
        out = pathlib.Path(shared.name) / "run"
        done = subprocess.run(
            [PROGRAM, "compare", case, "--engines", engines, "--out", out, "--set=run.mirrors=false", *arguments],
            env=environment(None), capture_output=True, encoding="utf-8", check=False,
        )  # fmt: skip
        if done.returncode not in (HELD, FELL_SHORT):
            raise AssertionError(Finished(done.returncode, done.stdout, done.stderr))
        return out

    def write(self, name, text):
        file = self.folder / name
        file.write_text(text, encoding="utf-8")
        return file

    def call(self, *command, env=None, timeout=PATIENCE, cwd=None, **options):
        """Any program, with changes of the environment."""
        done = subprocess.run(
            [*map(str, command)], stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", cwd=cwd or self.folder,
            env=environment(env), timeout=timeout, check=False, **options,
        )  # fmt: skip
        return self.check_no_crash(Finished(done.returncode, done.stdout, done.stderr))

    def run_program(self, *arguments, **options):
        return self.call(PROGRAM, *arguments, **options)

    def held(self, *arguments, **options):
        """The program, which ends with status 0."""
        done = self.run_program(*arguments, **options)
        self.assert_status(done, HELD)
        return done

    def compare(self, *arguments, case=COUETTE, engines="grain", out=None, **options):
        """A short `compare` of the small cell, with no engines but those named."""
        return self.run_program(
            "compare", case, "--engines", engines, "--out", out or self.out, "--quick",
            "--set=run.mirrors=false", *arguments, **options,
        )  # fmt: skip

    def start(self, *arguments, env=None):
        command = [PROGRAM, *map(str, arguments)]
        running = Running(command, self.folder, os.environ | (env or {}))
        self.addCleanup(running.stop)
        return running

    def start_compare(self, *arguments, engines="grain", env=None):
        return self.start(
            "compare", COUETTE, "--engines", engines, "--out", self.out, "--quick",
            "--set=run.mirrors=false", *arguments, env=env,
        )  # fmt: skip

    def check_no_crash(self, done):
        """Ended by itself, and without last words of a runtime."""
        self.assertGreaterEqual(done.status, 0, f"killed by a signal: {done}")
        self.assertNotRegex(done.stderr + done.stdout, CRASH)
        return done

    def assert_status(self, done, *statuses):
        self.assertIn(done.status, statuses, str(done))

    def assert_one_line(self, done, status, *fragments):
        """That status, and nothing on stderr but one line that holds all fragments."""
        self.assert_status(done, status)
        lines = done.stderr.splitlines()
        self.assertEqual(1, len(lines), str(done))
        self.assert_line(lines[0], *fragments)

    def assert_one_error(self, done, status, *fragments):
        """As assert_one_line, where progress is on stderr too. Returns the line."""
        self.assert_status(done, status)
        lines = done.error_lines()
        self.assertEqual(1, len(lines), str(done))
        self.assert_line(lines[0], *fragments)
        return lines[0]

    def assert_line(self, line, *fragments):
        self.assertTrue(line.startswith("crossgrain: "), line)
        self.assertTrue(line.isprintable(), repr(line))
        for fragment in fragments:
            self.assertIn(fragment, line)

    def results(self, out=None):
        return json.loads(((out or self.out) / "results.json").read_text(encoding="utf-8"))

    def rows(self, table, out=None):
        with open((out or self.out) / table, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def changed_example(self, *pieces):
        """The engine in Python with pieces of its program changed: before, after, before, after …"""
        folder = self.folder / f"own{len(list(self.folder.glob('own*')))}"
        folder.mkdir()
        program = PYTHON.with_name("engine.py").read_text(encoding="utf-8")
        for before, after in zip(pieces[::2], pieces[1::2]):
            self.assertIn(before, program)
            program = program.replace(before, after)
        (folder / "engine.py").write_text(program, encoding="utf-8")
        shutil.copy(PYTHON, folder)
        return folder / "engine.toml"

    def engine_file(self, name, *command):
        """An engine file for that command."""
        words = json.dumps([str(word) for word in command])
        return self.write(f"{name}.toml", f'name = "{name}"\nsummary = "a test"\ncommand = {words}\n')

    def finished_runs(self):
        """Run files by name, with the time of their last change [ns]."""
        return {
            file.name.split(".")[0]: file.stat().st_mtime_ns for file in (self.out / "runs").glob("*.json.gz")
        }
