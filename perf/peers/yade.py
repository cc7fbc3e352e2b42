"""YADE on our packing: yade -n -x yade.py SETTINGS.json. Prints what it measured as `name value`."""
import json
import math
import sys
import time

settings = json.load(open(sys.argv[1]))
discs = [line.split() for line in open(settings["discs"])]
kn, ks = settings["kn"], settings["ks"]
cohesive = settings["law"] == "bonded"


def disc_material(radius):
    """Springs in YADE are E r in series: E = kn / r gives the same kn to every pair."""
    springs = dict(young=kn / radius, poisson=ks / kn, density=1, frictionAngle=math.atan(settings["friction"]))
    if not cohesive:
        return FrictMat(**springs)
    # k_m = alphaKr ks r1 r2: for equal radii the rolling stiffness of our grains. The bonds are too strong to break.
    rolling = kn * settings["shape_factor"]**2 / (12 * ks)
    return CohFrictMat(**springs, isCohesive=True, momentRotationLaw=True, alphaKr=rolling, alphaKtw=0, normalCohesion=1e12,
                       shearCohesion=1e12)


def add_disc(x, y, radius):
    body = utils.sphere((x, y, 0), radius, material=disc_material(radius))
    mass = math.pi * radius**2 * settings["density"]
    body.state.mass, body.state.inertia = mass, (0.5 * mass * radius**2,) * 3
    body.state.blockedDOFs = "zXY"
    O.bodies.append(body)


def contact_stress():
    """Sum of force times branch over the contacts between discs, over the area of the box; compression positive."""
    xx = yy = 0
    for i in O.interactions:
        if not i.isReal or max(i.id1, i.id2) >= len(discs):
            continue
        force = i.phys.normalForce + i.phys.shearForce
        branch = O.bodies[i.id2].state.pos - O.bodies[i.id1].state.pos
        xx, yy = xx + force[0] * branch[0], yy + force[1] * branch[1]
    area = (settings["right"] - settings["left"]) * (settings["top"] - settings["bottom"])
    return xx / area, yy / area


for _, x, y, radius, *_ in discs:
    add_disc(float(x), float(y), float(radius))
smooth = O.materials.append(FrictMat(young=kn, poisson=ks / kn, density=1, frictionAngle=0))
for axis, sides in ((0, ("left", "right")), (1, ("bottom", "top"))):
    for side in sides:
        O.bodies.append(utils.wall(settings[side], axis, material=smooth))

reach = 1 + settings["bond_reach"] / settings["d50"] if cohesive else 1
bound, touch = Bo1_Sphere_Aabb(aabbEnlargeFactor=reach), Ig2_Sphere_Sphere_ScGeom6D if cohesive else Ig2_Sphere_Sphere_ScGeom
touch = touch(interactionDetectionFactor=reach)
physics = [Ip2_FrictMat_FrictMat_FrictPhys(kn=MatchMaker(algo="val", val=kn))]
laws = [Law2_ScGeom_FrictPhys_CundallStrack()]
if cohesive:
    physics.append(Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True))
    laws.append(Law2_ScGeom6D_CohFrictPhys_CohesionMoment())
collider = InsertionSortCollider([bound, Bo1_Wall_Aabb()], verletDist=settings["skin"] / 2)
O.engines = [
    ForceResetter(),
    collider,
    InteractionLoop([touch, Ig2_Wall_Sphere_ScGeom()], physics, laws),
    NewtonIntegrator(damping=0, gravity=(0, 0, 0)),
]
# A step of no length evaluates the forces and makes the bonds; those that span a gap are free of stress at first, as ours.
O.dt = 1e-30
O.run(1, True)
with open(settings["forces"], "w") as file:
    for number, disc in enumerate(discs):
        force = O.forces.f(number)
        file.write(f"{disc[0]} {force[0]!r} {force[1]!r}\n")
bound.aabbEnlargeFactor = touch.interactionDetectionFactor = 1
bonds = 0
for i in O.interactions:
    if cohesive and i.isReal and max(i.id1, i.id2) < len(discs):
        bonds += 1
        i.phys.unp = min(0, i.geom.penetrationDepth)
for number in range(len(discs)):
    O.bodies[number].state.vel = O.bodies[number].state.angVel = (0, 0, 0)
O.dt = settings["dt"]
O.run(settings["check"], True)
stress = contact_stress()
searches = collider.numAction
start = time.perf_counter()
O.run(settings["steps"], True)
print("loop", time.perf_counter() - start)
print("searches", collider.numAction - searches)
print("stress_xx", stress[0])
print("stress_yy", stress[1])
print("bonds", bonds)
