"""Hertz line contact with partial slip: asperity beside CalculiX on the same mesh.

    python3 hertz.py ASPERITY SCENE [--n 5 10 20] [--methods mortar surface node] [--shear]

ASPERITY is the program, SCENE is scenes/hertz.toml; ccx (Debian: calculix-ccx) and numpy must be there. For every number n of
elements per half-width the scene is run with cells of 1/n mm, its mesh is read back from the field file, written as an input
of CalculiX and run there with the methods asked for. One line each: error of the peak pressure and error of pressure in L2 over the
slave nodes with |x| <= 1.2 a, against Hertz at the run's own load; with --shear, error of the shear traction in L2 and
Q, against Cattaneo and Mindlin at its own P and Q; iterations; user and wall time of the whole process, one thread.
"""

import argparse
import base64
import csv
import re
import struct
import tempfile
import xml.etree.ElementTree as ElementTree
import zlib
from pathlib import Path

import numpy as np

from frd import contact_field
from timed import run
from varied import Scene

YOUNG, POISSON, RADIUS, FRICTION = 210e3, 0.3, 100.0, 0.3  # N, mm


def exact(x, normal, shear):
    """Pressure and shear traction at x from the loads per length."""
    modulus = YOUNG / (2 * (1 - POISSON**2))
    a = np.sqrt(4 * normal * RADIUS / (np.pi * modulus))
    peak = 2 * normal / (np.pi * a)
    root = lambda half: np.sqrt(np.maximum(0, 1 - (x / half) ** 2))
    p = peak * root(a)
    if shear <= 0:
        return a, peak, p, 0 * p
    c = a * np.sqrt(max(1e-12, 1 - shear / (FRICTION * normal)))
    return a, peak, p, FRICTION * peak * (root(a) - c / a * root(c))


def errors(x, p, q, normal, shear):
    order = np.argsort(x)
    x, p, q = x[order], p[order], q[order]
    h = np.diff(x)
    area = np.zeros_like(x)
    area[:-1] += h / 2
    area[1:] += h / 2
    a, peak, p_exact, q_exact = exact(x, normal, shear)
    near = abs(x) <= 1.2 * a
    l2 = lambda v, e: np.sqrt(np.sum(area[near] * (v[near] - e[near]) ** 2) / np.sum(area[near] * e[near] ** 2))
    return p.max() / peak - 1, l2(p, p_exact), l2(abs(q), q_exact) if shear > 0 else np.nan


def arrays(path):
    """Points, connectivity and body of each cell of a field file."""
    text = path.read_bytes()
    cut = text.index(b"<AppendedData")
    head = ElementTree.fromstring(text[:cut] + b"</VTKFile>")
    data = text[text.index(b"_", cut) + 1 :]
    found = {}
    for a in head.iter("DataArray"):
        at, name = int(a.get("offset")), a.get("Name")
        blocks = struct.unpack("<Q", base64.b64decode(data[at : at + 12])[:8])[0]
        size = -(-(8 * (3 + blocks)) // 3) * 4
        sizes = struct.unpack(f"<{3 + blocks}Q", base64.b64decode(data[at : at + size])[: 8 * (3 + blocks)])[3:]
        length = -(-sum(sizes) // 3) * 4
        raw, values, begin = base64.b64decode(data[at + size : at + size + length]), b"", 0
        for s in sizes:
            values += zlib.decompress(raw[begin : begin + s])
            begin += s
        kind = {"Float64": "<f8", "Int64": "<i8", "UInt8": "u1", "Float32": "<f4", "Int32": "<i4"}[a.get("type")]
        found.setdefault(name, np.frombuffer(values, kind))
    points = found["Points"].reshape(-1, 3)[:, :2] * 1e3
    ends = found["offsets"]
    cells = [found["connectivity"][a:b] for a, b in zip([0, *ends[:-1]], ends)]
    return points, cells, found["body"]


def scene(text, n, shear):
    varied, cell = Scene(text), f"{1 / n:.17g} mm"
    for body in ("flat", "cylinder"):
        for axis in (0, 1):
            varied.put(f"bodies.{body}.mesh.block.spacing[{axis}].size", cell)
    stiffness = ("normal", "tangential") if shear else ("normal",)
    for key in stiffness:
        varied.put(f"interfaces.contact.enforcement.{key}", f"{100 * YOUNG * n:.17g} MPa/mm")
    if not shear:
        for path in ("stages[1]", "stages[0].frictionless", "interfaces.contact.law", "interfaces.contact.enforcement.tangential"):
            varied.remove(path)
    return varied.text()


def ours(program, text, folder):
    (folder / "hertz.toml").write_text(text)
    said, user, wall = run([program, "run", "hertz.toml", "--out", "out"], folder, 1800)
    profiles = sorted((folder / "out/profiles").glob("*.csv"))
    rows = list(csv.DictReader(open(profiles[-1])))
    column = lambda name: np.array([float(r[name]) for r in rows])
    times = column("time [s]")
    last = times == times.max()
    x, p, q = (column(c)[last] * s for c, s in (("x [m]", 1e3), ("mean_normal_traction [Pa]", 1e-6), ("mean_shear_traction [Pa]", 1e-6)))
    force = list(csv.reader(open(folder / "out/forces/top.csv")))[-1]
    head = next(csv.reader(open(folder / "out/forces/top.csv")))
    at = {c.split()[0]: float(v) / 1e3 for c, v in zip(head, force) if c.startswith("force")}
    iterations = re.search(r"(\d+) iterations, (\d+) fact", said)
    return x, p, q, -at["force_y"], abs(at["force_x"]), iterations[1] if iterations else "?", user, wall


METHODS = {
    "mortar": ("MORTAR", "HARD", None),
    "surface": ("SURFACE TO SURFACE", "LINEAR", 1.0),
    "node": ("NODE TO SURFACE", "LINEAR", 10.0),
}


def deck(points, cells, body, n, method, shear):
    # One layer of bricks 1 mm thick, held across: mortar contact does not take the plane elements of CalculiX, which it builds
    # with constraints of its own.
    total = len(points)
    lines = ["*NODE, NSET=NALL"]
    for z in (0, 1):
        lines += [f"{z * total + i + 1}, {x:.15g}, {y:.15g}, {z}" for i, (x, y) in enumerate(points)]
    lines += ["*ELEMENT, TYPE=C3D8, ELSET=EALL"]
    lines += [f"{i + 1}, " + ", ".join(str(v + 1 + z * total) for z in (0, 1) for v in c) for i, c in enumerate(cells)]
    upper = points[np.array([c[0] for c in cells])][:, 1].argmax()
    up = body[upper]
    in_upper = np.zeros(len(points), bool)
    for c, b in zip(cells, body):
        if b == up:
            in_upper[c] = True
    y = points[:, 1]
    slave = in_upper & (abs(y - points[:, 0] ** 2 / (2 * RADIUS)) < 1e-9)
    master = ~in_upper & (abs(y) < 1e-9)
    top, bottom = in_upper & (y > 20 - 1e-9), ~in_upper & (y < -20 + 1e-9)
    for name, which in (("TOP", top), ("BOTTOM", bottom), ("NSLAVE", slave)):
        lines += [f"*NSET, NSET={name}"] + [f"{i + 1 + z * total}," for z in (0, 1) for i in np.flatnonzero(which)]
    for name, which in (("SLAVE", slave), ("MASTER", master)):
        lines += [f"*SURFACE, NAME={name}, TYPE=ELEMENT"]
        for i, c in enumerate(cells):
            for f in range(4):
                if which[c[f]] and which[c[(f + 1) % 4]]:
                    lines.append(f"{i + 1}, S{f + 3}")
    form, law, factor = METHODS[method]
    lines += ["*MATERIAL, NAME=STEEL", "*ELASTIC", f"{YOUNG}, {POISSON}", "*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL"]
    lines += ["*SURFACE INTERACTION, NAME=SI"]
    stiffness = YOUNG * n * (factor or 1.0)
    lines += [f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={law}"]
    if law == "LINEAR":
        lines += [f"{stiffness:.15g}" + (", 0., 1e-6" if method == "node" else "")]
    if shear:
        lines += ["*FRICTION", f"{FRICTION}, {stiffness:.15g}"]
    lines += [f"*CONTACT PAIR, INTERACTION=SI, TYPE={form}", "SLAVE, MASTER"]
    lines += ["*BOUNDARY", "NALL, 3, 3", "BOTTOM, 1, 2"]
    steps = [(0.0, -0.0186)] + ([(0.004, -0.0186)] if shear else [])
    for dx, dy in steps:
        increment = "1., 1." if not shear else "0.5, 1."
        lines += ["*STEP, INC=1000", "*STATIC", increment, "*BOUNDARY", f"TOP, 1, 1, {dx}", f"TOP, 2, 2, {dy}"]
        lines += ["*NODE PRINT, NSET=TOP, TOTALS=ONLY, FREQUENCY=1000", "RF", "*CONTACT FILE, FREQUENCY=1000", "CDIS, CSTR", "*END STEP"]
    return "\n".join(lines) + "\n", slave


def calculix(points, cells, body, n, method, shear, folder, limit):
    text, slave = deck(points, cells, body, n, method, shear)
    (folder / "job.inp").write_text(text)
    said, user, wall = run(["ccx", "-i", "job"], folder, limit)
    iterations = len(re.findall(r"^ iteration\s+\d+", said, flags=re.M))
    if "Job finished" not in said:
        last = [l.strip() for l in said.splitlines() if "ERROR" in l]
        return None, (last[-1] if last else said[-60:].strip() or "stopped"), user, wall, iterations
    totals = re.findall(r"total force.*?\n\n\s+(\S+)\s+(\S+)\s+(\S+)", (folder / "job.dat").read_text())
    shear_force, normal = (float(v) for v in totals[-1][:2])
    nodes, field = contact_field(folder / "job.frd")
    rows = {}
    for node, values in field.items():
        x, y = nodes[node][:2]
        if abs(y - x * x / (2 * RADIUS)) < 1e-6 and abs(x) < 3:
            key = round(x, 7)
            # Of slave and master node above each other the one with the larger pressure is the slave.
            if key not in rows or values[3] > rows[key][0]:
                rows[key] = (values[3], np.hypot(values[4], values[5]))
    x = np.array(sorted(rows))
    p, q = (np.array([rows[k][c] for k in sorted(rows)]) for c in (0, 1))
    return (x, p, q, abs(normal), abs(shear_force)), None, user, wall, iterations


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--n", type=int, nargs="+", default=[5, 10, 20])
    parser.add_argument("--methods", nargs="*", default=list(METHODS))
    parser.add_argument("--shear", action="store_true")
    parser.add_argument("--limit", type=float, default=600, help="seconds a run of CalculiX may take")
    parser.add_argument("--keep", help="folder in which inputs and results stay")
    given = parser.parse_args()
    template = Path(given.scene).read_text()
    program = str(Path(given.program).resolve())
    print("| code | n | P [N/mm] | p_max | L2(p) | Q [N/mm] | L2(q) | iterations | user [s] | wall [s] |")
    print("|---|---|---|---|---|---|---|---|---|---|")

    def line(name, n, x, p, q, normal, shear, iterations, user, wall):
        top, l2, l2q = errors(x, p, q, normal, shear if given.shear else 0)
        tangential = f"{shear:.2f} | {100 * l2q:.2f} %" if given.shear else "- | -"
        print(f"| {name} | {n} | {normal:.2f} | {100 * top:+.2f} % | {100 * l2:.2f} % | {tangential} | {iterations} | {user:.2f} | {wall:.2f} |", flush=True)

    for n in given.n:
        folder = Path(given.keep or tempfile.mkdtemp()) / f"n{n}"
        folder.mkdir(parents=True, exist_ok=True)
        line("asperity", n, *ours(program, scene(template, n, given.shear), folder))
        points, cells, body = arrays(sorted((folder / "out/fields").glob("bodies*.vtu"))[-1])
        for method in given.methods:
            place = folder / method
            place.mkdir(exist_ok=True)
            result, why, user, wall, iterations = calculix(points, cells, body, n, method, given.shear, place, given.limit)
            if result is None:
                print(f"| CalculiX {method} | {n} | {why} | | | | | {iterations} | {user:.1f} | {wall:.1f} |", flush=True)
            else:
                line(f"CalculiX {method}", n, *result, iterations, user, wall)


if __name__ == "__main__":
    main()
