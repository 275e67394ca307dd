"""Several processes that share a run under mpirun, seen as one worker. Open MPI; README.md has its options."""

import collections
import ctypes
import json
import os
import re
import select
import selectors
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

import crossgrain_worker
import numpy as np
from crossgrain_worker import Failed, Unsupported

PATIENCE = 120  # s that ranks have to begin
RANK = os.path.join(os.path.dirname(os.path.abspath(__file__)), "rank.py")

# Variables that let Open MPI run as root, in a container, with more ranks than cores; the user's own take precedence.
OPEN_MPI = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    # Runs side by side would all be bound to the first cores.
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    # Containers forbid a process to read another's memory (process_vm_readv).
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",
    # A rank that waits gives its core away: where others need it, a step may take ten times as long without.
    "OMPI_MCA_mpi_yield_when_idle": "1",
}

# Components of each of a rank's arrays in the plane; all others are of vectors.
COLUMNS = {"ids": 1, "spin": 1, "torque": 1, "pairs": 5}
COLUMNS_IN_SPACE = {"ids": 1, "pairs": 6}


def part_of(arrays, space):
    """What a rank saw (Engine.part), from the arrays that it answers with.

    @param space  2, or 3 in space"""
    part = {}
    for name, values in arrays.items():
        columns = (COLUMNS if space == 2 else COLUMNS_IN_SPACE).get(name, space)
        part[name] = np.reshape(values, (-1, columns)) if columns > 1 else values
    return part


def count_of(settings):
    """The setting `ranks`. @raise Unsupported where there are no such"""
    ranks = settings.get("ranks", 1)
    if ranks > 1 and not shutil.which("mpirun"):
        raise Unsupported(
            f"has ranks = {ranks:g} by the program 'mpirun' alone, and there is none in PATH "
            "(Debian and Ubuntu: package openmpi-bin)"
        )
    return int(ranks)


def end_with_parent():
    """mpirun ends its ranks when it is asked to end."""
    pr_set_pdeathsig = 1
    ctypes.CDLL(None).prctl(pr_set_pdeathsig, signal.SIGTERM)


class Ranks:
    """Started, spoken to and ended together. Requests go to all of them at once."""

    def __init__(self, count):
        self.said = collections.deque(maxlen=200)  # the last lines of mpirun and of all ranks
        self.failure = ""
        self.connections = {}  # by rank
        with tempfile.TemporaryDirectory(prefix="crossgrain-ranks-") as folder:
            address = os.path.join(folder, "socket")
            with socket.socket(socket.AF_UNIX) as listener:
                listener.bind(address)
                listener.listen(count)
                # os.environ is what this process was started with: MPI, which LAMMPS may have begun here, adds to its
                # own copy what its children must not see.
                self.process = subprocess.Popen(
                    ["mpirun", "-np", str(count), sys.executable, RANK, address],
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.STDOUT,
                    env=OPEN_MPI | dict(os.environ),
                    preexec_fn=end_with_parent,
                )
                self.listening = threading.Thread(target=self.listen, daemon=True)
                self.listening.start()
                try:
                    self.accept(listener, count)
                except BaseException:
                    self.end()
                    raise

    def listen(self):
        for line in self.process.stdout:
            text = line.decode(errors="replace").rstrip()
            self.said.append(text)
            print(text, file=sys.stderr, flush=True)

    def accept(self, listener, count):
        deadline = time.monotonic() + PATIENCE
        listener.settimeout(0.05)
        while len(self.connections) < count:
            try:
                connection, _ = listener.accept()
            except TimeoutError:
                if self.process.poll() is not None or time.monotonic() > deadline:
                    self.fail("ranks did not begin")
                continue
            connection.settimeout(None)
            stream = connection.makefile("r", encoding="utf-8")
            first = stream.readline()
            if not first:
                self.fail("a rank ended as it began")
            reported = json.loads(first)
            if reported["size"] != count:
                raise Failed(
                    f"of {count} ranks one says that there are {reported['size']}: mpirun is of another MPI than LAMMPS' "
                    "library (Debian: Open MPI for both, package openmpi-bin)"
                )
            self.connections[reported["rank"]] = connection, stream

    def are_there(self, count):
        """So many of them, and none has ended since it was asked last."""
        if self.failure or count != len(self.connections) or self.process.poll() is not None:
            return False
        ended, _, _ = select.select([connection for connection, _ in self.connections.values()], [], [], 0)
        return not ended

    def ask_all(self, requests):
        """@param requests  one for each rank. @returns their replies, by rank: all are ok, or it is one that is not"""
        if self.failure:
            raise Failed(self.failure)
        with selectors.DefaultSelector() as waiting:
            for rank, (connection, stream) in self.connections.items():
                try:
                    connection.sendall((json.dumps(requests[rank]) + "\n").encode())
                except OSError:
                    self.fail(f"rank {rank} reads no more")
                waiting.register(connection, selectors.EVENT_READ, (rank, stream))
            replies = {}
            while len(replies) < len(self.connections):
                for key, _ in waiting.select():
                    rank, stream = key.data
                    try:
                        line = stream.readline()
                    except ConnectionResetError:  # it was killed before it had read all that was sent
                        line = ""
                    if not line.endswith("\n"):
                        self.fail(f"rank {rank} ended")
                    replies[rank] = json.loads(line)
                    waiting.unregister(key.fileobj)
        for rank in sorted(replies):
            if not replies[rank]["ok"]:
                return [replies[rank]]
        return [replies[rank] for rank in sorted(replies)]

    def fail(self, what):
        """The rest is of no use either: MPI ends all ranks where one has ended. Raises with what mpirun said of it."""
        try:
            self.process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            pass
        status = self.process.poll()
        self.end()
        reported = re.search(
            r"process rank (\d+) with PID (\d+) on node \S+ exited on (signal \d+ \([^)]*\))", " ".join(self.said)
        )
        error = next((line for line in self.said if line.startswith("ERROR")), "")
        if reported:
            what = f"rank {reported[1]} ended ({reported[3]})"
        elif status is not None:
            what += f"; mpirun ended with status {status}"
        self.failure = f"{what}, and with it all ranks" + (f": {error}" if error else "")
        raise Failed(self.failure)

    def end(self):
        for connection, stream in self.connections.values():
            stream.close()
            connection.close()
        try:
            self.process.wait(timeout=5)
        except subprocess.TimeoutExpired:
            self.process.terminate()
            try:
                self.process.wait(timeout=5)
            except subprocess.TimeoutExpired:
                self.process.kill()
                self.process.wait()
        self.listening.join(timeout=5)


class Front:
    """The worker that the harness sees: one process by itself, or the one that several are spoken to through.

    engine  runs scenes alone; of a shared run it knows the scene and makes snapshots of what ranks saw"""

    def __init__(self, engine):
        self.engine = engine
        self.ranks = None

    def answer(self, request):
        what = request["request"]
        # Starting ranks takes a second: those of the scene before load the next one.
        count = count_of(request["settings"]) if what == "load" else 0
        if what == "quit" or what == "load" and not (self.ranks and self.ranks.are_there(count)):
            self.end_ranks()
        if count > 1:
            self.ranks = self.ranks or Ranks(count)
            return self.load(request)
        if self.ranks is None:
            return crossgrain_worker.answer(self.engine, request)
        return getattr(self, what)(request)

    def end_ranks(self):
        if self.ranks and not self.ranks.failure:
            if self.ranks.are_there(len(self.ranks.connections)):
                self.ranks.ask_all([{"request": "quit"}] * len(self.ranks.connections))
            self.ranks.end()
        self.ranks = None

    def of_first(self, replies):
        """What rank 0 says stands for all. @raise what went wrong on one of them"""
        reply = replies[0]
        if reply["ok"]:
            return reply
        raise Unsupported(reply["what"]) if reply["kind"] == "unsupported" else Failed(reply["what"])

    def ask(self, request):
        return self.of_first(self.ranks.ask_all([request] * len(self.ranks.connections)))

    def load(self, request):
        reply = self.ask(request)
        arrays = crossgrain_worker.read_arrays(request["file"], request["arrays"])
        self.engine.take(request["scene"], arrays, request["settings"])
        self.engine.forget_arrays()
        self.time = 0.0
        return {"realised": reply["realised"]}

    def advance(self, request):
        self.time = self.ask(request)["time"]
        return {"time": self.time}

    def snapshot(self, request):
        files = [f"{request['file']}.{rank}" for rank in range(len(self.ranks.connections))]
        try:
            replies = self.ranks.ask_all([request | {"file": file} for file in files])
            self.of_first(replies)
            parts = [
                part_of(crossgrain_worker.read_arrays(file, reply["arrays"]), self.engine.space)
                for file, reply in zip(files, replies)
            ]
        finally:
            for file in files:
                if os.path.exists(file):
                    os.unlink(file)
        steps = round(self.time / self.engine.dt)
        snapshot, arrays = self.engine.snapshot_of(parts, request["contacts"], steps)
        return {
            "snapshot": snapshot,
            "arrays": crossgrain_worker.write_arrays(request["file"], arrays),
        }

    def stats(self, request):
        """Each rank reports its own pairs; the run takes as long as the slowest."""
        replies = self.ranks.ask_all([request] * len(self.ranks.connections))
        self.of_first(replies)
        all_stats = [reply["stats"] for reply in replies]
        return {
            "stats": {
                "steps": all_stats[0]["steps"],
                "contact_evaluations": sum(each["contact_evaluations"] for each in all_stats),
                "wall_seconds": max(each["wall_seconds"] for each in all_stats),
                "cpu_seconds": sum(each["cpu_seconds"] for each in all_stats),
                "counters": {"ranks": len(all_stats)},
            }
        }
