"""A worker of crossgrain that runs scenes on LIGGGHTS, through its C library:  python3 worker.py

LIGGGHTS descends from LAMMPS and is driven as it is (../lammps/engine.py); here is what it says in other words.
README.md of this folder says what LIGGGHTS makes of a scene.
"""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, "..", "lammps"), os.path.join(HERE, "..", "python")]
sys.dont_write_bytecode = True

import crossgrain_worker
from engine import Engine
from law import OPTIONS
from liggghts_law import AREAS, COHESION, ROLLING, Law
from liggghts_scene import Liggghts, Scene, contacts_of_rows, pair_rows


class LiggghtsEngine(Engine):
    name = "liggghts"
    Law, Scene = Law, Scene
    law_options = {
        **{name: values for name, values in OPTIONS.items() if name not in ("history", "jkr_end")},
        "normal": ["linear"],
        "damper": ["constant"],
        "tangential": ["none", "spring", "spring_dashpot"],
        "dashpot": ["outside"],
        "spring_reset": ["total"],
        "velocity_arm": ["lever_arm"],
        "plane_arm": ["middle"],
        "rolling": list(ROLLING),
        "rolling_damper": ["critical"],
        "rolling_load": ["magnitude", "elastic"],
        "rolling_dashpot": ["outside"],
        "rolling_reset": ["total"],
        "cohesion": list(COHESION),
        "cohesion_area": list(AREAS),
        "cohesion_load": ["without_pull", "net"],
        "spring_turn": ["projected"],
    }

    def deviations(self):
        notes = {}
        if self.made.planes and self.law.kr > 0:
            notes["rolling_velocity_at_planes"] = (
                0.0, "at a plane LIGGGHTS takes ω (a − δ/2)/(a − δ) for ω in rolling springs and their dashpots"
            )
        if self.space == 3 and self.law.kr > 0:
            notes["rolling_spring_stays"] = 0.0, "the torque of a rolling spring does not follow a normal that turns"
        if self.space == 3 and self.law.rolling_model == "cdt":
            notes["rolling_torque_by_twist"] = (
                0.0, "|M| is the law's times |ω_r|/|ω_i − ω_j|, ω_r being the part normal to n: less where a pair twists"
            )
        if speed := self.made.other_speed:
            notes["speed_of_cylinders"] = (
                speed, "a cylinder's speed is taken at spheres' centres: right for the mean radius, off by this for the others"
            )
        return [{"name": name, "value": value, "unit": "", "note": note} for name, (value, note) in notes.items()]

    def pair_rows(self):
        return pair_rows(self.lammps, self.law)

    def contacts_of_rows(self, rows, position):
        return contacts_of_rows(rows, self.made, position)


crossgrain_worker.serve(LiggghtsEngine(Liggghts()))
