"""One rank of a run that several share: mpirun starts as many of it as there are.  python3 rank.py SOCKET

Speaks the worker protocol through the socket, after one line that says which rank it is. What it answers to
"snapshot" are the arrays of Engine.part(): this rank's part, in a file of its own.
"""

import json
import os
import socket
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "python")]
sys.dont_write_bytecode = True

import crossgrain_worker
from engine import Engine


class RankEngine(Engine):
    def snapshot(self, report):
        part = self.part(report)
        return {}, {name: ("i32" if name == "ids" else "f64", values) for name, values in part.items()}


def main():
    engine = RankEngine()
    rank, size = engine.lammps.place()
    with socket.socket(socket.AF_UNIX) as front:
        front.connect(sys.argv[1])
        front.sendall((json.dumps({"rank": rank, "size": size}) + "\n").encode())
        crossgrain_worker.serve(engine, descriptors=(os.dup(front.fileno()), os.dup(front.fileno())))
    engine.lammps.close()
    engine.lammps.end_mpi()


main()
