"""A small scene in YADE, written as start.csv:  yade -n -x export_from_yade.py

Spheres kept in the plane z = 0 fall on a row of fixed ones for a while; what is to be kept of any other scene is the loop at the end.
YADE's spheres have the moment of inertia of spheres, which the column "inertia" keeps.
"""

import math
import random

from yade import O, utils
from yade.wrapper import *  # noqa: F403, which is how scripts of YADE find its classes

random.seed(1)
O.materials.append(FrictMat(young=1e5, poisson=0.3, frictionAngle=math.atan(0.44), density=1200))
for k in range(28):
    O.bodies.append(utils.sphere((0.0037 * k, 0, 0), 0.00185, fixed=True))
for row in range(8):
    for column in range(12):
        place = (0.004 + 0.0083 * column + random.uniform(0, 1e-3), 0.01 + 0.0085 * row, 0)
        O.bodies.append(utils.sphere(place, random.uniform(0.003, 0.004)))
        O.bodies[-1].state.blockedDOFs = "zXY"

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0.2, gravity=(0, -9.81, 0)),
]
O.dt = 0.3 * utils.PWaveTimeStep()
O.run(int(0.1 / O.dt), True)

with open("start.csv", "w", encoding="utf-8") as file:
    file.write("x,y,radius,vx,vy,spin,mass,inertia,fixed\n")
    for body in O.bodies:
        state, fixed = body.state, not body.dynamic
        numbers = (state.pos[0], state.pos[1], body.shape.radius, state.vel[0], state.vel[1], state.angVel[2], state.mass, state.inertia[2])
        file.write(",".join(repr(float(number)) for number in numbers) + f",{int(fixed)}\n")
