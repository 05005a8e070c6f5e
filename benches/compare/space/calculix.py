"""Inputs of CalculiX and what its runs write."""

import re

import numpy as np

import paths  # noqa: F401
from frd import contact_field
from result import Result
from timed import measured

ELEMENTS = {"hex8": "C3D8", "tet10": "C3D10"}
# Corners of the faces S1, S2 .. of an element.
FACES = {
    "hex8": ((0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
    "tet10": ((0, 1, 2), (0, 1, 3), (1, 2, 3), (0, 2, 3)),
}
TYPES = {"mortar": "MORTAR", "surface": "SURFACE TO SURFACE", "node": "NODE TO SURFACE"}
AXES = "xyz"


def numbered(body, side):
    """Elements and face numbers of a side, from 0 and from 1."""
    corners = len(FACES[body.kind][0])
    wanted = {tuple(sorted(f[:corners])) for f in body.sides[side]}
    found = []
    for e, cell in enumerate(body.cells):
        for s, face in enumerate(FACES[body.kind]):
            if tuple(sorted(cell[list(face)])) in wanted:
                found.append((e, s + 1))
    return found


def element_size(problem):
    """Mean edge of the faces of the slave."""
    body = problem.bodies["upper"]
    corners = len(FACES[body.kind][0])
    faces = body.sides[problem.contact["upper"]][:, :corners]
    points = body.points[faces]
    return np.linalg.norm(points - np.roll(points, 1, axis=1), axis=2).mean()


def rows(values, width=12):
    values = [str(v) for v in values]
    return [", ".join(values[k : k + width]) + "," for k in range(0, len(values), width)]


def deck(problem, method, factor, large=False):
    lines, shift, numbers = ["*NODE, NSET=NALL"], {}, {}
    nodes = elements = 0
    for name, body in problem.bodies.items():
        shift[name], numbers[name] = nodes, elements
        lines += [f"{nodes + i + 1}, {x:.14g}, {y:.14g}, {z:.14g}" for i, (x, y, z) in enumerate(body.points)]
        nodes, elements = nodes + len(body.points), elements + len(body.cells)
    for name, body in problem.bodies.items():
        order = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8] if body.kind == "tet10" else range(8)
        lines.append(f"*ELEMENT, TYPE={ELEMENTS[body.kind]}, ELSET=E{name}")
        for e, cell in enumerate(body.cells):
            lines.append(f"{numbers[name] + e + 1}, " + ", ".join(str(cell[k] + 1 + shift[name]) for k in order))
    sides = set(problem.held) | {s for stage in problem.stages for s in stage.moved} | {f"upper.{problem.loaded}"}
    label = lambda side: side.replace(".", "_").upper()
    for side in sorted(sides):
        body, key = side.split(".")
        lines += [f"*NSET, NSET={label(side)}", *rows(problem.bodies[body].nodes(key) + 1 + shift[body])]
    for body, side in problem.contact.items():
        lines += [f"*SURFACE, NAME=S{body}, TYPE=ELEMENT"]
        lines += [f"{numbers[body] + e + 1}, S{s}" for e, s in numbered(problem.bodies[body], side)]
    for name in problem.bodies:
        lines += [f"*MATERIAL, NAME=M{name}", "*ELASTIC", f"{problem.young[name]}, {problem.poisson}"]
        if problem.plastic:
            yields, modulus = problem.plastic
            lines += ["*PLASTIC", f"{yields}, 0.", f"{yields + 0.5 * modulus}, 0.5"]
        lines += [f"*SOLID SECTION, ELSET=E{name}, MATERIAL=M{name}"]
    stiffness = factor * min(problem.young.values()) / element_size(problem)
    law = "HARD" if method == "mortar" else "LINEAR"
    lines += ["*SURFACE INTERACTION, NAME=SI", f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={law}"]
    lines += [f"{stiffness:.10g}" + (", 0., 1e-6" if method == "node" else "")] if law == "LINEAR" else []
    lines += ["*FRICTION", f"{problem.friction}, {stiffness:.10g}"] if problem.friction else []
    lines += [f"*CONTACT PAIR, INTERACTION=SI, TYPE={TYPES[method]}", "Supper, Slower", "*BOUNDARY"]
    lines += [f"{label(side)}, {AXES.index(a) + 1}, {AXES.index(a) + 1}" for side, axes in problem.held.items() for a in axes]
    for stage in problem.stages:
        # Increments grow where few iterations are needed; in finite sliding they are held.
        increment = f"{1 / stage.steps:.12g}, 1." + (f", 1e-6, {1 / stage.steps:.12g}" if problem.finite else "")
        lines += ["*STEP, INC=10000" + (", NLGEOM" if large else ""), "*STATIC", increment, "*BOUNDARY"]
        for side, motions in stage.moved.items():
            lines += [f"{label(side)}, {AXES.index(a) + 1}, {AXES.index(a) + 1}, {v}" for a, v in motions.items()]
        lines += [f"*NODE PRINT, NSET={label('upper.' + problem.loaded)}, TOTALS=ONLY", "RF"]
        lines += ["*CONTACT FILE, FREQUENCY=10000", "CDIS, CSTR", "*END STEP"]
    return "\n".join(lines) + "\n"


def run(problem, folder, limit, method, factor=1.0, large=False):
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("job.*"):
        old.unlink()
    (folder / "job.inp").write_text(deck(problem, method, factor, large))
    done = measured(["ccx", "-i", "job"], folder, limit)
    iterations = len(re.findall(r"^ iteration\s+\d+", done.said, flags=re.M))
    result = Result(f"CalculiX, {method}", done.user, done.wall, done.peak, iterations)
    if (folder / "job.dat").exists():
        result.forces = forces(folder / "job.dat")
    if "Job finished" not in done.said:
        result.why = reason(done, limit)
    else:
        nodes = problem.bodies["upper"].nodes(problem.contact["upper"])
        field = contact_field(folder / "job.frd")[1]
        result.pressures = {int(n): field[n + 1][3] for n in nodes if n + 1 in field}
    return result


def reason(done, limit):
    increments = len(re.findall(r"convergence; new increment|increment size", done.said))
    if not done.ended:
        return f"stopped after {limit:g} s"
    errors = [line.strip() for line in done.said.splitlines() if "ERROR" in line]
    if errors:
        return " ".join(errors[-1].split())
    return f"ended with code {done.code} after {increments} increments: " + " ".join(done.said[-200:].split())


def forces(path):
    found = []
    for time, values in re.findall(r"total force.*?time\s+(\S+)\n\n\s+(\S+\s+\S+\s+\S+)", path.read_text()):
        found.append((float(time), [float(v) for v in values.split()]))
    return found
