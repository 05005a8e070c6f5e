"""Reads the grids and the finite-fault model of a run, and exits non-zero if a check fails.

    python interop/check_grids.py out/dipping

Grids are read by SciPy's reader of classic netCDF and compared with the tables of the run. The model is read by the layout of the
database of finite-source rupture models: entries `NAME = value` of lines that begin with `%`, and rows of numbers. It is compared with the
catalogue and the table of the points. Copies that are corrupted on purpose must fail.
"""

import csv
import json
import re
import shutil
import sys
import tempfile
from pathlib import Path

import numpy as np
from obspy.imaging.scripts.mopad import MomentTensor
from scipy.io import netcdf_file

COMPONENTS = ("east", "north", "up")
COLUMNS = ["LAT", "LON", "X==EW", "Y==NS", "Z", "SLIP", "RAKE", "TRUP", "SF_MOMENT"]
# Digits of tables and of the rows of models.
TABLE = 1e-9


class Problems(list):
    def expect(self, condition, message):
        if not condition:
            self.append(message)

    def near(self, found, expected, bound, message):
        off = np.nanmax(np.abs(np.asarray(found) - np.asarray(expected)))
        self.expect(off <= bound, f"{message}: off by {off:.2e}, at most {bound:.1e}")


def table(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    names = {name.split(" [")[0]: name for name in rows[0]}
    return {short: [row[name] for row in rows] for short, name in names.items()}


def numbers(columns, name):
    return np.array([float(value) for value in columns[name]])


def grid(path, names, problems):
    """Axes and values of a grid."""
    with netcdf_file(path, "r", mmap=False) as file:
        problems.expect(file.version_byte == 1, f"{path}: not the classic format")
        problems.expect(file.Conventions.startswith(b"CF-"), f"{path}: no conventions")
        x, y, z = (file.variables[name] for name in (*names, "z"))
        problems.expect(z.dimensions == (names[1], names[0]), f"{path}: dimensions {z.dimensions}")
        problems.expect(z.units == b"m" and x.units and y.units, f"{path}: units")
        found = [np.array(v[:], dtype=float) for v in (x, y, z)]
        for variable, values in zip((x, y, z), found):
            ends = [np.nanmin(values), np.nanmax(values)]
            problems.near(variable.actual_range, ends, 0.0, f"{path}: range")
    for axis in found[:2]:
        problems.expect(np.all(np.diff(axis) > 0.0), f"{path}: an axis does not ascend")
        problems.near(np.diff(axis), np.diff(axis).mean(), 1e-9 * np.ptp(axis), f"{path}: steps of an axis")
    return found


def check_surface(out, problems):
    columns = table(out / "events/surface_000.csv")
    for component in COMPONENTS:
        path = out / f"events/surface_000_{component}.grd"
        x, y, z = grid(path, ("lon", "lat"), problems)
        expected = numbers(columns, component)
        size = np.abs(expected).max()
        problems.expect(z.shape == (len(y), len(x)), f"{path}: shape {z.shape}")
        problems.near(z.ravel(), expected, TABLE * size, f"{path}: values")
        problems.near(np.tile(x, len(y)), numbers(columns, "longitude"), 1e-9, f"{path}: longitudes")
        problems.near(np.repeat(y, len(x)), numbers(columns, "latitude"), 1e-9, f"{path}: latitudes")


def check_slip(out, problems):
    path = out / "events/slip_000_main.grd"
    x, y, z = grid(path, ("x", "y"), problems)
    columns = table(out / "events/rupture_times_000.csv")
    slip = numbers(columns, "slip")
    problems.near(z.ravel(), slip, TABLE * slip.max(), f"{path}: slip")
    depth = -numbers(columns, "y").reshape(z.shape)
    down = (depth[-1] - depth[0]) / (y[-1] - y[0])
    problems.expect(np.all(down > 0.0) and np.all(down <= 1.0 + 1e-12), f"{path}: y is not down dip")


def heads(text):
    """First value of each entry of the head of a model."""
    found = {}
    for name, value in re.findall(r"(\w+)\s*=\s*([-+]?\d[\d.]*(?:[eE][-+]?\d+)?)", text):
        found.setdefault(name, float(value))
    return found


def check_model(out, problems):
    path = out / "events/finite_fault_000.fsp"
    event = json.loads((out / "events.json").read_text())[0]
    located = event["located"]
    lines = path.read_text().splitlines()
    head = heads("\n".join(line for line in lines if line.startswith("%")))
    names = [line[1:].split() for line in lines if line.startswith("% LAT LON")]
    problems.expect(names == [COLUMNS], f"{path}: columns {names}")
    rows = np.array([[float(v) for v in line.split()] for line in lines if not line.startswith("%")])
    problems.expect(len(rows) == head["Nx"] * head["Nz"] == head["Nsbfs"], f"{path}: {len(rows)} subfaults")
    column = dict(zip(COLUMNS, rows.T))
    for name, where, bound in (("LAT", "latitude", 6e-6), ("LON", "longitude", 6e-6)):
        problems.near(head[name], located["hypocentre"][where], bound, f"{path}: {name}")
    problems.near(head["DEP"], located["hypocentre"]["depth"] / 1e3, 6e-4, f"{path}: DEP")
    problems.near(head["Mo"] / event["moment"], 1.0, 1e-9, f"{path}: Mo")
    problems.near(head["Mw"], event["magnitude"], 6e-4, f"{path}: Mw")
    problems.near(head["LEN"] * head["WID"], len(rows) * head["Dx"] * head["Dz"], 1e-2, f"{path}: size")
    slipped = column["SLIP"] > 0.01 * column["SLIP"].max()
    problems.near(column["SF_MOMENT"][slipped].sum() / event["moment"], 1.0, 1e-8, f"{path}: moment of the rows")
    points = table(out / "events/rupture_times_000.csv")
    slip = numbers(points, "slip")
    problems.near(column["SLIP"], np.abs(slip), TABLE * np.abs(slip).max(), f"{path}: slip")
    times = numbers(points, "time since onset")
    problems.expect(np.array_equal(np.isnan(times), np.isnan(column["TRUP"])), f"{path}: points that ruptured")
    if not np.isnan(times).all():
        problems.near(column["TRUP"], times, 6e-5, f"{path}: rupture times")
    # The mechanism is one of the nodal planes: its double couple is that of the tensor of the catalogue.
    rr, tt, pp, rt, rp, tp = located["tensor"]
    tensor = np.array([[rr, rt, rp], [rt, tt, tp], [rp, tp, pp]])
    tensor /= np.sqrt(0.5 * (tensor**2).sum())
    angles = [head["STRK"], head["DIP"], head["RAKE"]]
    problems.near(np.array(MomentTensor(angles).get_M(system="USE")), tensor, 5e-5, f"{path}: mechanism")
    # The epicentre is the origin of X and Y.
    nearest = np.hypot(column["X==EW"], column["Y==NS"]).min()
    problems.expect(nearest <= head["Dz"], f"{path}: no subfault near the epicentre")
    top = np.sin(np.radians(head["DIP"])) * head["Dz"] / 2.0
    depth = -numbers(points, "y") / 1e3
    problems.near(depth - column["Z"], top, 2e-5, f"{path}: depths of upper edges")


def check(out):
    problems = Problems()
    for part in (check_surface, check_slip, check_model):
        try:
            part(out, problems)
        except Exception as error:  # Any exception of a reader on a damaged file is another problem to list.
            problems.append(f"{part.__name__}: {type(error).__name__}: {error}")
    return problems


def number_changed(name, by):
    """Change of the first number after `NAME =`."""
    pattern = rf"({name}\s*=\s*)([-+]?[\d.]+(?:e[-+]?\d+)?)"
    return lambda data: re.sub(pattern, lambda m: m[1] + repr(by(float(m[2]))), data.decode(), count=1).encode()


def breaks():
    """Ways to corrupt a file: its name and the change."""
    up = "events/surface_000_up.grd"
    yield up, "half of the file", lambda data: data[: len(data) // 2]
    yield up, "another magic number", lambda data: b"CDX" + data[3:]
    yield up, "bytes in the other order", lambda data: data[:-8] + data[-8:][::-1]
    yield up, "values of another row", lambda data: data[:-800] + data[-1600:-800]
    yield "events/slip_000_main.grd", "no slip", lambda data: data[:-8] + bytes(8)
    model = "events/finite_fault_000.fsp"
    for name, by in (
        ("Mo", lambda v: 1.1 * v),
        ("DIP", lambda v: v + 5.0),
        ("RAKE", lambda v: -v),
        ("STRK", lambda v: v + 180.0),
        ("LAT", lambda v: v + 0.1),
    ):
        yield model, f"another {name}", number_changed(name, by)
    yield model, "a missing row", lambda data: data[: data.rstrip().rindex(b"\n") + 1]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    out = Path(sys.argv[1])
    problems, tried = check(out), 0
    for name, what, change in breaks():
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder)
            shutil.copytree(out / "events", copy / "events")
            shutil.copy(out / "events.json", copy / "events.json")
            (copy / name).write_bytes(change((copy / name).read_bytes()))
            tried += 1
            problems.expect(check(copy), f"{name} broken by {what} is accepted")
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"grids and a model of {out}, {tried} broken files tried, {len(problems)} problems")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
