"""Crack with friction under compression: asperity beside CalculiX with cells of the same sizes.

    python3 crack.py ASPERITY SCENE [--n 10 20] [--methods surface node mortar] [--limit 300]

ASPERITY is the program, SCENE is verification/cases/frictional_crack/scene.toml; ccx (Debian: calculix-ccx) must be there. For every number n of
equal cells on the half-length b = 1 m the scene is run in a box of +-20 b with cells that grow by 1.1 away from the crack, and CalculiX
on the same grid, one layer of bricks held across. One line each: error of the slip in the middle, unknowns, user and wall
time of the whole process, one thread.
"""

import argparse
import csv
import math
import re
import tempfile
from pathlib import Path

from timed import run
from varied import Scene

YOUNG, POISSON, COMPRESSION, HALF, GROWTH = 25e9, 0.25, 100e6, 20.0, 1.1
SIN, COS = math.sin(math.pi / 9), math.cos(math.pi / 9)
FRICTION = math.tan(math.pi / 6)
SLIP = 4 * (1 - POISSON**2) / YOUNG * COMPRESSION * SIN * (COS - SIN * FRICTION)
# Contact, its law, its stiffness over E/h.
METHODS = {"surface": ("SURFACE TO SURFACE", "LINEAR", 100.0), "node": ("NODE TO SURFACE", "LINEAR", 10.0), "mortar": ("MORTAR", "HARD", 100.0)}


def ours(program, text, measure, n, folder):
    varied = Scene(text)
    varied.put("interfaces.crack.measure", measure)
    varied.put("bodies.plane.mesh.fault.spacing", f"{1 / n:.17g} m")
    varied.put("bodies.plane.mesh.fault.min", [f"-{HALF:g} m"] * 2)
    varied.put("bodies.plane.mesh.fault.max", [f"{HALF:g} m"] * 2)
    (folder / "crack.toml").write_text(varied.text())
    said, user, wall = run([program, "run", "crack.toml", "--out", "out"], folder, 600)
    rows = list(csv.DictReader(open(sorted((folder / "out/profiles").glob("*.csv"))[-1])))
    middle = min(rows, key=lambda r: abs(float(r["y [m]"])))
    return abs(float(middle["slip [m]"])), re.search(r"(\d+) degrees", said)[1], user, wall


def beyond(start, h):
    """Coordinates from `start` to the side of the box, steps growing by at most GROWTH."""
    steps = math.ceil(math.log(1 + (HALF - start) / h * (GROWTH - 1)) / math.log(GROWTH))
    while True:
        sizes = [h * GROWTH ** (k + 1) for k in range(steps)]
        factor = (HALF - start) / sum(sizes)
        if factor <= 1:
            break
        steps += 1
    out = [start]
    for s in sizes:
        out.append(out[-1] + s * factor)
    out[-1] = HALF
    return out[1:]


def deck(n, method):
    h = 1 / n
    xs = [h, *beyond(h, h)]
    xs = [-x for x in reversed(xs)] + [0.0, *xs]
    ys = beyond(1.0, h)
    ys = [-y for y in reversed(ys)] + [-1 + k * h for k in range(2 * n + 1)] + ys
    ys = [0.0 if abs(y) < 1e-12 else y for y in ys]
    columns, rows = len(xs), len(ys)
    points = [(x, y) for y in ys for x in xs]
    split = {}
    for j, y in enumerate(ys):
        if abs(y) < 1 - 1e-9:
            split[j * columns + xs.index(0.0)] = len(points)
            points.append((0.0, y))
    cells, minus, plus = [], [], []
    for j in range(rows - 1):
        for i in range(columns - 1):
            c = [j * columns + i, j * columns + i + 1, (j + 1) * columns + i + 1, (j + 1) * columns + i]
            on = max(abs(ys[j]), abs(ys[j + 1])) < 1 + 1e-9
            if xs[i] == 0.0:
                c = [split.get(v, v) for v in c]
                plus += [(len(cells), 3)] if on else []
            elif xs[i + 1] == 0.0:
                minus += [(len(cells), 1)] if on else []
            cells.append(c)
    total = len(points)
    lines = ["*NODE, NSET=NALL"]
    for z in (0, 1):
        lines += [f"{z * total + i + 1}, {x:.15g}, {y:.15g}, {z}" for i, (x, y) in enumerate(points)]
    lines += ["*ELEMENT, TYPE=C3D8, ELSET=EALL"]
    lines += [f"{i + 1}, " + ", ".join(str(v + 1 + z * total) for z in (0, 1) for v in c) for i, c in enumerate(cells)]
    for name, faces in (("MINUS", minus), ("PLUS", plus)):
        lines += [f"*SURFACE, NAME={name}, TYPE=ELEMENT"] + [f"{c + 1}, S{f + 3}" for c, f in faces]
    middle = (rows // 2) * columns + xs.index(0.0)
    lines += ["*NSET, NSET=MIDDLE", f"{middle + 1}, {split[middle] + 1}"]
    form, law, factor = METHODS[method]
    stiffness = factor * YOUNG / h
    lines += ["*MATERIAL, NAME=ROCK", "*ELASTIC", f"{YOUNG}, {POISSON}", "*SOLID SECTION, ELSET=EALL, MATERIAL=ROCK"]
    lines += ["*SURFACE INTERACTION, NAME=SI", f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={law}"]
    if law == "LINEAR":
        lines += [f"{stiffness:.15g}" + (", 0., 1e-6" if method == "node" else "")]
    lines += ["*FRICTION", f"{FRICTION:.15g}, {stiffness:.15g}"]
    lines += [f"*CONTACT PAIR, INTERACTION=SI, TYPE={form}", "MINUS, PLUS"]
    # The outer sides move as the plane would without a crack, which is the compression with held sides.
    xx, yy, xy = (-COMPRESSION * v for v in (SIN * SIN, COS * COS, SIN * COS))
    c = (1 + POISSON) / YOUNG
    strain = (c * ((1 - POISSON) * xx - POISSON * yy), c * ((1 - POISSON) * yy - POISSON * xx), c * xy)
    lines += ["*BOUNDARY", "NALL, 3, 3", "*STEP, INC=1000", "*STATIC", "1., 1.", "*BOUNDARY"]
    for i, (x, y) in enumerate(points):
        if max(abs(x), abs(y)) > HALF - 1e-9:
            for z in (0, 1):
                lines.append(f"{z * total + i + 1}, 1, 1, {strain[0] * x + strain[2] * y:.15g}")
                lines.append(f"{z * total + i + 1}, 2, 2, {strain[2] * x + strain[1] * y:.15g}")
    lines += ["*NODE PRINT, NSET=MIDDLE", "U", "*END STEP"]
    return "\n".join(lines) + "\n", 2 * total


def calculix(n, method, folder, limit):
    text, unknowns = deck(n, method)
    (folder / "job.inp").write_text(text)
    said, user, wall = run(["ccx", "-i", "job"], folder, limit)
    (folder / "said.txt").write_text(said)
    if "Job finished" not in said:
        errors = [line.strip() for line in said.splitlines() if "ERROR" in line]
        return None, (errors[-1] if errors else said[-60:].strip()) or "stopped", user, wall
    rows = re.findall(r"^\s+\d+\s+(\S+)\s+(\S+)\s+(\S+)\s*$", (folder / "job.dat").read_text(), flags=re.M)
    return abs(float(rows[-1][1]) - float(rows[-2][1])), unknowns, user, wall


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("scene")
    parser.add_argument("--n", type=int, nargs="+", default=[10, 20])
    parser.add_argument("--methods", nargs="*", default=list(METHODS))
    parser.add_argument("--limit", type=float, default=300, help="seconds a run of CalculiX may take")
    given = parser.parse_args()
    program, text = str(Path(given.program).resolve()), Path(given.scene).read_text()
    print("| code | cells on b | slip in the middle | unknowns | user [s] | wall [s] |\n|---|---|---|---|---|---|")

    def line(name, n, slip, unknowns, user, wall):
        slip = f"{100 * (slip / SLIP - 1):+.2f} %" if slip is not None else f"no result: {unknowns}"
        print(f"| {name} | {n} | {slip} | {unknowns if '%' in slip else ''} | {user:.2f} | {wall:.2f} |", flush=True)

    for n in given.n:
        root = Path(tempfile.mkdtemp())
        for measure in ("mortar", "node-to-point"):
            folder = root / measure
            folder.mkdir()
            line(f"asperity {measure}", n, *ours(program, text, measure, n, folder))
        for method in given.methods:
            folder = root / f"ccx-{method}"
            folder.mkdir()
            line(f"CalculiX {method}", n, *calculix(n, method, folder, given.limit))


if __name__ == "__main__":
    main()
