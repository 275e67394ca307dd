"""The worker's side of the protocol (adapters/worker/README.md) for engines that Python drives.

serve(engine) answers requests with the methods of `engine`:
    capabilities() -> dict
    load(scene, arrays, settings) -> dict          raises Unsupported
    advance(time) -> float
    snapshot(contacts) -> (dict, {name: (type, numpy array or list)})
    stats() -> dict
and, of an engine with the capability `checkpoints`, all that its future depends on:
    checkpoint(file)
    restore(file)                                  after a load of the same scene
Dictionaries are the protocol's JSON objects; arrays go under the protocol's names.
"""

import json
import os
import sys

import numpy as np

PROTOCOL = 1
TYPES = {"f64": np.dtype("<f8"), "i32": np.dtype("<i4"), "u8": np.dtype("u1")}


class Unsupported(Exception):
    """The engine cannot do what the scene calls for; the text names the first such thing."""


class Failed(Exception):
    """The engine failed; the text says it all."""


def read_arrays(path, entries):
    """The arrays of an array file by name."""
    with open(path, "rb") as file:
        data = file.read()
    return {
        entry["name"]: np.frombuffer(data, TYPES[entry["type"]], entry["count"], entry["offset"])
        for entry in entries
    }


def write_arrays(path, arrays):
    """Writes an array file. Returns the list that describes it."""
    entries = []
    # Over what is there, and not cut off first: the harness names one file again and again.
    with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT, 0o666), "wb") as file:
        for name, (kind, values) in arrays.items():
            values = np.asarray(values, TYPES[kind])
            file.write(bytes(-file.tell() % 8))
            entries.append(
                {"name": name, "type": kind, "count": values.size, "offset": file.tell()}
            )
            file.write(values.tobytes())
    return entries


def answer(engine, request):
    what = request["request"]
    if what == "hello":
        return {"protocol": PROTOCOL, "capabilities": engine.capabilities(), "writes_over": True}
    if what == "load":
        arrays = read_arrays(request["file"], request["arrays"])
        return {"realised": engine.load(request["scene"], arrays, request["settings"])}
    if what == "advance":
        return {"time": engine.advance(request["time"])}
    if what == "snapshot":
        snapshot, arrays = engine.snapshot(request["contacts"])
        return {"snapshot": snapshot, "arrays": write_arrays(request["file"], arrays)}
    if what == "stats":
        return {"stats": engine.stats()}
    if what in ("checkpoint", "restore") and hasattr(engine, what):
        getattr(engine, what)(request["file"])
        return {}
    if what == "quit":
        return {}
    raise ValueError(f"no request '{what}'")


def one_line(error):
    return " ".join(f"{type(error).__name__}: {error}".split())


def serve(engine, answer=answer, descriptors=(3, 4)):
    """Answers requests until "quit" or until they end.

    answer       may be another function of engine and request
    descriptors  to read requests from and write replies to"""
    with os.fdopen(descriptors[0], "r", encoding="utf-8") as requests, os.fdopen(
        descriptors[1], "w", encoding="utf-8"
    ) as replies:
        for line in requests:
            request = json.loads(line)
            try:
                reply = {"ok": True, **answer(engine, request)}
            except Unsupported as refusal:
                reply = {"ok": False, "kind": "unsupported", "what": str(refusal)}
            except Failed as failure:
                reply = {"ok": False, "kind": "failed", "what": str(failure)}
            except Exception as error:
                reply = {"ok": False, "kind": "failed", "what": one_line(error)}
            sys.stdout.flush()  # what it printed is in the log of this run, and not of the next
            replies.write(json.dumps(reply) + "\n")
            replies.flush()
            if request["request"] == "quit":
                return
