"""Writes the meshes `unit_*` of this folder with Gmsh (pip install gmsh; written with 4.15.2).

Unit square or cube [0, 1]^D of a few elements. Groups: `body` (cells), `low` and `high` (the faces x = 0 and x = 1), `corner`
(the point at the origin). The faces of the cube are also in `hull`.
"""

import os

import gmsh

OUT = os.path.dirname(os.path.abspath(__file__))


def start(order=1, incomplete=0):
    gmsh.initialize(interruptible=False)
    for key, value in {
        "General.Terminal": 0,
        "General.NumThreads": 1,
        "Mesh.ElementOrder": order,
        "Mesh.SecondOrderIncomplete": incomplete,
    }.items():
        gmsh.option.setNumber(key, value)
    gmsh.model.add("unit")


def save(name, version=4.1, binary=0, **options):
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.option.setNumber("Mesh.Binary", binary)
    for key, value in options.items():
        gmsh.option.setNumber("Mesh." + key, value)
    # Gmsh writes the path of an Abaqus file into it.
    os.chdir(OUT)
    gmsh.write(name)


def square(quads, clockwise=False, names=True):
    g = gmsh.model.geo
    p = [g.addPoint(x, y, 0) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    lines = [g.addLine(p[i], p[(i + 1) % 4]) for i in range(4)]
    loop = [-l for l in reversed(lines)] if clockwise else lines
    s = g.addPlaneSurface([g.addCurveLoop(loop)])
    g.synchronize()
    for line in lines:
        gmsh.model.mesh.setTransfiniteCurve(line, 3)
    gmsh.model.mesh.setTransfiniteSurface(s)
    if quads:
        gmsh.model.mesh.setRecombine(2, s)
    group(2, [s], 7, "body", names)
    group(1, [lines[3]], 1, "low", names)
    group(1, [lines[1]], 2, "high", names)
    group(0, [p[0]], 5, "corner", names)
    gmsh.model.mesh.generate(2)
    return s


def group(dimension, entities, tag, name, names=True):
    gmsh.model.addPhysicalGroup(dimension, entities, tag, name if names else "")


def cube(kind):
    g = gmsh.model.geo
    p = [g.addPoint(0, y, z) for y, z in ((0, 0), (1, 0), (1, 1), (0, 1))]
    lines = [g.addLine(p[i], p[(i + 1) % 4]) for i in range(4)]
    low = g.addPlaneSurface([g.addCurveLoop(lines)])
    for line in lines:
        g.mesh.setTransfiniteCurve(line, 2)
    g.mesh.setTransfiniteSurface(low)
    if kind == "hex":
        g.mesh.setRecombine(2, low)
    out = g.extrude([(2, low)], 1, 0, 0, numElements=[2], recombine=kind != "tet")
    g.synchronize()
    volume = out[1][1]
    hull = [t for _, t in gmsh.model.getBoundary([(3, volume)], oriented=False)]
    group(3, [volume], 7, "body")
    group(2, [low], 1, "low")
    group(2, [out[0][1]], 2, "high")
    group(2, hull, 3, "hull")
    group(1, [lines[0]], 4, "edge")
    group(0, [p[0]], 5, "corner")
    gmsh.model.mesh.generate(3)


for shape, quads in (("tri", False), ("quad", True)):
    for name, order, incomplete in {
        "tri": (("3", 1, 0), ("6", 2, 0)),
        "quad": (("4", 1, 0), ("8", 2, 1), ("9", 2, 0)),
    }[shape]:
        start(order, incomplete)
        square(quads)
        save(f"unit_{shape}{name}.msh")
        save(f"unit_{shape}{name}_v22.msh", version=2.2)
        save(f"unit_{shape}{name}_v22_binary.msh", version=2.2, binary=1)
        gmsh.finalize()

for name, kind, order, incomplete in (
    ("tet4", "tet", 1, 0),
    ("tet10", "tet", 2, 0),
    ("hex8", "hex", 1, 0),
    ("hex20", "hex", 2, 1),
    ("hex27", "hex", 2, 0),
    ("wedge6", "wedge", 1, 0),
    ("wedge15", "wedge", 2, 1),
):
    start(order, incomplete)
    cube(kind)
    save(f"unit_{name}.msh")
    save(f"unit_{name}_v22_binary.msh", version=2.2, binary=1)
    save(f"unit_{name}.inp")
    gmsh.finalize()

start()
square(True, names=False)
save("unit_unnamed_tags.msh")
gmsh.finalize()

start()
square(True, clockwise=True)
save("unit_clockwise.msh")
gmsh.finalize()

start()
square(True)
save("unit_parametric.msh", SaveParametric=1)
save("unit_parametric_binary.msh", binary=1, SaveParametric=1)
save("unit_parametric_v22.msh", version=2.2, SaveParametric=1)
gmsh.finalize()

start()
square(True)
gmsh.model.mesh.setPeriodic(1, [2], [4], [1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
gmsh.model.mesh.generate(2)
save("unit_periodic_binary.msh", binary=1)
gmsh.finalize()

start()
square(True)
gmsh.model.mesh.partition(2)
save("unit_partitioned.msh")
save("unit_partitioned_binary.msh", binary=1)
save("unit_partitioned_v22.msh", version=2.2)
gmsh.finalize()

start()
surface = square(True)
group(2, [surface], 8, "also")
save("unit_two_groups.msh")
save("unit_two_groups_v22.msh", version=2.2)
gmsh.finalize()
