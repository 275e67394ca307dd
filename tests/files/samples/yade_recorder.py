# yade -n -x yade_recorder.py: two touching spheres by VTKRecorder, contacts too (YADE 2023.02a ends after the first file).
material = O.materials.append(FrictMat(young=1000, poisson=0.3, frictionAngle=0.4636476090008061, density=1.9098593171027443))
O.bodies.append(sphere((1, 2, 2), 0.5, material=material))
O.bodies.append(sphere((1.98, 2, 2), 0.5, material=material))
O.bodies[0].state.vel = (0, 0.1, 0)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
    VTKRecorder(fileName="yade-two-", recorders=["spheres", "intr", "velocity", "id", "mass"], iterPeriod=4),
    NewtonIntegrator(damping=0),
]
O.dt = 1e-3
O.step()
for i in O.interactions:
    print("CONTACT", i.id1, i.id2, i.geom.normal, i.phys.normalForce, i.phys.shearForce, i.geom.penetrationDepth)
