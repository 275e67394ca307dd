# yade -n -x yade_export.py: three spheres as in lammps.in, without the floor, by each of YADE's exporters.
from yade import export

O.periodic = True
O.cell.setBox(4, 4, 4)
material = O.materials.append(FrictMat(young=1000, poisson=0.3, frictionAngle=0.4636476090008061, density=1.9098593171027443))
for centre in ((0.4, 2, 2), (3.41, 2, 2), (2, 2, 0.48), (2, 2.4, 1.3)):
    O.bodies.append(sphere(centre, 0.5, material=material))
O.bodies[0].state.vel = (0, 0.1, 0)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()], [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0),
    VTKRecorder(fileName="yade-", recorders=["spheres", "velocity", "id", "mass"], iterPeriod=4, label="vtk"),
]
O.dt = 1e-3
O.run(5, True)
export.textExt("yade.4.txt", format="id_x_y_z_r_matId")
export.textExt("yade-attrs.4.txt", format="x_y_z_r_attrs", attrs=["b.id", "b.state.vel", "b.state.angVel"], comment="id vx vy vz spin_x spin_y spin_z")
out = export.VTKExporter("yade-export")
out.exportSpheres(what=dict(id="b.id", vel="b.state.vel", spin="b.state.angVel", mass="b.state.mass"), numLabel=4)
out.exportInteractions(what=dict(id1="i.id1", id2="i.id2", n="i.geom.normal", F="i.phys.normalForce+i.phys.shearForce", overlap="i.geom.penetrationDepth", point="i.geom.contactPoint"), numLabel=4)
for i in O.interactions:
    print("CONTACT", i.id1, i.id2, i.geom.normal, i.phys.normalForce, i.phys.shearForce, i.cellDist, i.geom.contactPoint, i.geom.penetrationDepth)
print("STRESS", utils.getStress())
