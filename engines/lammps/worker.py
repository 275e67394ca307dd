"""A worker of crossgrain that runs scenes on LAMMPS, through its C library:  python3 worker.py

Disks and wall disks are atoms of style sphere in two dimensions, planes are `fix wall/gran`.
README.md of this folder says what LAMMPS makes of a scene.
"""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "python")]
sys.dont_write_bytecode = True

import crossgrain_worker
from engine import Engine

crossgrain_worker.serve(Engine())
