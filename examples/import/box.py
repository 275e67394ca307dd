# yade -x -n box.py SEED: 48 disks fall into a box and come to rest. Leaves particles-SEED.csv and contacts-SEED.csv.
import random
import sys

SEED = int(sys.argv[1]) if len(sys.argv) > 1 else 1
rng = random.Random(SEED)  # sphere() seeds the global one anew, for its colour
RADIUS, MASS = 0.005, 0.001

# Of a pair kn = kn1 kn2/(kn1 + kn2), so that two of 2e4 make 1e4 N/m; likewise the others.
law = dict(kn=2e4, ks=1e4, cn=2.0, cs=1.0, frictionAngle=math.atan(0.4), density=MASS / (4 / 3 * math.pi * RADIUS**3))
disks = O.materials.append(ViscElMat(label="disks", **law))
for row in range(8):
    for column in range(6):
        x, y = (0.00575 + 0.0115 * k + rng.uniform(-0.0005, 0.0005) for k in (column, row))
        body = sphere((x, y, 0), RADIUS, material=disks)
        body.state.blockedDOFs = "zXY"
        O.bodies.append(body)
for position, axis, sense in ((0, 1, 1), (0, 0, 1), (0.07, 0, -1)):
    O.bodies.append(wall(position, axis=axis, sense=sense, material=disks))

O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
    InteractionLoop(
        [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
        [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
        [Law2_ScGeom_ViscElPhys_Basic()],
    ),
    NewtonIntegrator(gravity=(0, -9.81, 0), damping=0),
]
O.dt = 1e-5
particles, contacts = open(f"particles-{SEED}.csv", "w"), open(f"contacts-{SEED}.csv", "w")
print("t,id,x,y,vx,vy,spin,radius,mass", file=particles)
print("t,first,second,nx,ny,fx,fy,overlap", file=contacts)


def save():
    for b in O.bodies:
        if isinstance(b.shape, Sphere):
            s = b.state
            print(O.time, b.id, s.pos[0], s.pos[1], s.vel[0], s.vel[1], s.angVel[2], b.shape.radius, s.mass, sep=",", file=particles)
    for i in O.interactions:
        # YADE's normal points from id1 to id2, and its force acts on id2: so id2 is the first. Its walls have ids of their own.
        first, second, sign = i.id2, i.id1, 1
        if not isinstance(O.bodies[first].shape, Sphere):
            first, second, sign = i.id1, i.id2, -1
        if not isinstance(O.bodies[second].shape, Sphere):
            second = -1 - (second - 48)
        n, f = sign * i.geom.normal, sign * (i.phys.normalForce + i.phys.shearForce)
        print(O.time, first, second, n[0], n[1], f[0], f[1], i.geom.penetrationDepth, sep=",", file=contacts)


for _ in range(80):
    O.run(1000, True)
    save()
particles.close()
contacts.close()
