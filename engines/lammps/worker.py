"""A worker of crossgrain that runs scenes on LAMMPS, through its C library:  python3 worker.py

Disks and wall disks are atoms of style sphere, planes are `fix wall/gran`.
README.md of this folder says what LAMMPS makes of a scene.
"""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "python")]
sys.dont_write_bytecode = True

import crossgrain_worker
from crossgrain_answers import setting
from engine import Engine
from ranks import Front


class LammpsEngine(Engine):
    def capabilities(self):
        can = super().capabilities()
        doc = "processes that share a step, under mpirun; sums in another order, so not to the same bits"
        can["settings"].append(setting("ranks", 1.0, "-", doc, least=1.0, most=1024.0, whole=True))
        return can


crossgrain_worker.serve(Front(LammpsEngine()), Front.answer)
