"""Reads an output directory of asperity with common readers, and exits non-zero if a check fails.

    python interop/check_vtu.py out/sandwich

Fields are read with VTK (through pyvista) and with meshio; both accept damaged files silently, so names, sizes and
values are checked. Tables are read with the standard library, plots with Pillow and an XML parser. Nothing is rendered.
"""

import contextlib
import csv
import io
import logging
import math
import re
import shutil
import sys
import tempfile
import warnings
import xml.etree.ElementTree as xml
from pathlib import Path

import meshio
import numpy as np
import pyvista
from PIL import Image

BODY_POINTS = {"displacement": 3, "mises": 1}
BODY_CELLS = {"stress": 6, "mises": 1, "body": 1}
INTERFACE_POINTS = dict.fromkeys(
    ["gap", "slip", "relative_displacement", "slip_rate", "normal_traction", "shear_traction", "friction", "status", "paired"], 1
) | {"displacement": 3, "area": 1, "friction_work": 1, "mean_normal_traction": 1, "mean_shear_traction": 1}
# Arrays at points and at cells of each kind of part: bodies, the slave and the master side of an interface.
PARTS = {
    "bodies": (BODY_POINTS, BODY_CELLS),
    "slave": (INTERFACE_POINTS, {}),
    "master": ({"displacement": 3}, {}),
}
PROFILE = {
    "gap [m]": "gap",
    "slip [m]": "slip",
    "relative_displacement [m]": "relative_displacement",
    "slip_rate [m/s]": "slip_rate",
    "normal_traction [Pa]": "normal_traction",
    "shear_traction [Pa]": "shear_traction",
    "friction [-]": "friction",
    "mean_normal_traction [Pa]": "mean_normal_traction",
    "mean_shear_traction [Pa]": "mean_shear_traction",
    "friction_work [J/m2]": "friction_work",
    "paired [0 no 1 yes]": "paired",
}

problems: list[str] = []


def expect(condition, message):
    """Records a problem and continues, so that one run shows all of them."""
    if not condition:
        problems.append(message)
    return bool(condition)


def check_arrays(where, found, expected, count):
    # States are present if a law has them.
    expected = expected | {name: 1 for name in found if name.startswith("state_")}
    expect(set(found) == set(expected), f"{where}: arrays {sorted(found)}, expected {sorted(expected)}")
    for name in set(found) & set(expected):
        values = np.asarray(found[name]).reshape(count, -1) if len(found[name]) == count else None
        if expect(values is not None, f"{where}: {name} has {len(found[name])} tuples, expected {count}"):
            expect(values.shape[1] == expected[name], f"{where}: {name} has {values.shape[1]} components")
            finite = np.isfinite(values).all(axis=1)
            meant = np.asarray(found["paired"]) == 1 if name == "gap" and "paired" in found else np.full(count, True)
            # Frictionless stages have no states.
            absent = name.startswith("state_") and not finite.any()
            expect(absent or (finite | ~meant).all(), f"{where}: {name} is not finite everywhere")
            expect(name != "gap" or (finite == meant).all(), f"{where}: gap has a value without a partner")


def check_field(path, time, part):
    """Checks one `.vtu` with both readers; returns VTK's grid."""
    points, cells = PARTS[part]
    grid = pyvista.read(path)
    expect(grid.n_points > 0 and grid.n_cells > 0, f"{path}: empty in VTK")
    check_arrays(f"{path} (VTK, points)", dict(grid.point_data), points, grid.n_points)
    check_arrays(f"{path} (VTK, cells)", dict(grid.cell_data), cells, grid.n_cells)
    stored = grid.field_data.get("TimeValue", [math.nan])[0]
    expect(stored == time, f"{path}: TimeValue {stored}, the collection says {time}")
    mesh = meshio.read(path)
    expect(len(mesh.points) == grid.n_points, f"{path}: meshio sees {len(mesh.points)} points")
    expect(sum(len(block.data) for block in mesh.cells) == grid.n_cells, f"{path}: meshio sees other cells")
    expect(np.array_equal(mesh.points, grid.points), f"{path}: points differ between the readers")
    for name in points:
        same = name in mesh.point_data and np.array_equal(mesh.point_data[name], grid.point_data[name], equal_nan=True)
        expect(same, f"{path}: {name} differs between the readers")
    expect(grid.cell_connectivity.max() < grid.n_points, f"{path}: a cell names a point that does not exist")
    if part == "bodies":
        sizes = grid.compute_cell_sizes(length=False)
        size = sizes["Volume"] if grid.bounds[5] > grid.bounds[4] else sizes["Area"]
        expect((size > 0).all(), f"{path}: cells without size or turned inside out")
        check_mises(path, grid)
    return grid


def check_mises(path, grid):
    """Checks Mises stress by its convexity: that of a cell's mean stress is at most the mean over its points."""
    xx, yy, zz, xy, yz, zx = np.asarray(grid.cell_data["stress"]).T
    mises = np.sqrt(((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) / 2 + 3 * (xy**2 + yz**2 + zx**2))
    given = np.asarray(grid.cell_data["mises"])
    scale = max(given.max(), mises.max())
    expect((mises <= given + 1e-9 * scale).all(), f"{path}: Mises stress below that of the mean stress")


def kind_of(name):
    if name == "bodies":
        return name
    return "master" if name.endswith(", master") else "slave"


def check_sides(grids):
    """Checks that each interface has both sides at each time, and that a node which both have moves with its body."""
    for name, time in grids:
        if kind_of(name) == "slave":
            expect((f"{name}, master", time) in grids, f"fields.pvd: {name} has no master side at {time}")
    for (name, time), grid in grids.items():
        bodies = grids.get(("bodies", time))
        if kind_of(name) == "bodies" or bodies is None:
            continue
        # Sides that touch have nodes at one place: one of these must move alike.
        for point, moved in zip(grid.points, np.asarray(grid.point_data["displacement"])):
            at = np.asarray(bodies.point_data["displacement"])[(bodies.points == point).all(axis=1)]
            if not expect((at == moved).all(axis=1).any(), f"{name} at {time}: {point} moves unlike its body"):
                break


def check_collection(out):
    """Checks the `.pvd`; returns {(interface, time): grid}."""
    root = xml.parse(out / "fields.pvd").getroot()
    sets = root.findall("./Collection/DataSet")
    expect(sets, "fields.pvd is empty")
    parts = {int(entry.get("part")): entry.get("name") for entry in sets}
    times = sorted({float(entry.get("timestep")) for entry in sets})
    expect(len(sets) == len(parts) * len(times), "fields.pvd: some time lacks a part")
    reader = pyvista.get_reader(out / "fields.pvd")
    expect(sorted(set(reader.time_values)) == times, "fields.pvd: VTK sees other times")
    reader.set_active_time_value(times[-1])
    expect(len(reader.read()) == len(parts), "fields.pvd: VTK sees another number of parts")
    grids = {}
    for entry in sets:
        path, time = out / entry.get("file"), float(entry.get("timestep"))
        if expect(path.is_file(), f"{path} is missing"):
            try:
                grids[entry.get("name"), time] = check_field(path, time, kind_of(entry.get("name")))
            except (Exception, SystemExit) as error:  # meshio exits the program if it cannot read a file.
                expect(False, f"{path}: {type(error).__name__}: {error}")
    on_disk = {path.relative_to(out).as_posix() for path in (out / "fields").glob("*")}
    expect(on_disk == {entry.get("file") for entry in sets}, "fields/ holds other files than the collection names")
    return grids


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    expect(all(len(row) == len(head) for row in rows), f"{path}: rows of different length")
    expect(len(set(head)) == len(head), f"{path}: two columns of one name")
    return head, np.array([[float(value) for value in row] for row in rows])


def check_tables(out, grids):
    compared = 0
    for path in sorted((out / "profiles").glob("*.csv")):
        head, rows = table(path)
        time, interface = rows[0][0], path.stem.rsplit("_", 1)[0]
        expect((rows[:, 0] == time).all(), f"{path}: several times")
        grid = grids.get((interface, time))
        if grid is None:
            continue
        compared += 1
        expect(np.array_equal(rows[:, 2:5], grid.points), f"{path}: positions differ from the field's")
        states = {name: name for name in head if name.startswith("state_")}
        for column, name in (PROFILE | states).items():
            same = np.array_equal(rows[:, head.index(column)], grid.point_data[name], equal_nan=True)
            expect(same, f"{path}: {column} differs from the field's")
    for path in sorted((out / "probes").glob("*.csv")):
        head, rows = table(path)
        expect(head[:3] == ["time [s]", "stage", "step"], f"{path}: unexpected first columns")
        expect((np.diff(rows[:, 0]) > 0).all(), f"{path}: time does not increase")
        expect(np.array_equal(rows[:, 2], np.arange(1, len(rows) + 1)), f"{path}: a step is missing")
    return compared


def check_plots(out):
    names = sorted(path.stem for path in (out / "plots").glob("*.svg"))
    expect(names, "no plots")
    expect(names == sorted(path.stem for path in (out / "plots").glob("*.png")), "SVG and PNG differ in number")
    for path in sorted((out / "plots").glob("*")):
        if path.suffix == ".svg":
            expect(xml.parse(path).getroot().tag.endswith("svg"), f"{path} is no SVG")
        else:
            with Image.open(path) as image:
                image.load()
                colours = np.unique(np.asarray(image.convert("RGB")).reshape(-1, 3), axis=0)
                expect(len(colours) > 8, f"{path} looks blank")
    return len(names)


def check(out):
    """Problems of an output directory, and what was compared."""
    problems.clear()
    grids, compared, plots = {}, 0, 0
    try:
        grids = check_collection(out)
        check_sides(grids)
        compared = check_tables(out, grids)
        plots = check_plots(out)
    except (Exception, SystemExit) as error:  # meshio exits the program if it cannot read a file.
        expect(False, f"{type(error).__name__}: {error}")
    leftovers = [path for path in out.rglob(".*") if path.is_file() and path.name != ".lock"]
    expect(not leftovers, f"temporary files left behind: {leftovers}")
    return list(problems), f"{len(grids)} field files, {compared} profiles compared with fields, {plots} plots"


def last_number_changed(text):
    *before, last = text.rstrip("\n").split(",")
    return ",".join([*before, str(float(last) + 1.0)]) + "\n"


def positions_for_displacements(text):
    """Lets the displacements of a side name the bytes of its points, which are as many."""
    points = re.search(r'Name="Points"[^>]*offset="(\d+)"', text)[1]
    return re.sub(r'(Name="displacement"[^>]*offset=)"\d+"', rf'\1"{points}"', text)


def damages(out):
    """Files of the directory, each with a way to damage it; no text removes the file."""
    field = sorted((out / "fields").glob("*.vtu"))[0]
    master = sorted((out / "fields").glob("master_*.vtu"))[0]
    profile = sorted((out / "profiles").glob("*.csv"))[-1]
    plot = sorted((out / "plots").glob("*.png"))[0]
    yield field, "half of the file", lambda text: text[: len(text) // 2]
    yield field, "an array of another name", lambda text: text.replace('Name="mises"', 'Name="misses"', 1)
    yield field, "a cell too many", lambda text: re.sub(r'NumberOfCells="(\d+)"', lambda m: f'NumberOfCells="{int(m[1]) + 1}"', text)
    yield master, "positions for displacements", positions_for_displacements
    yield out / "fields.pvd", "another time", lambda text: text.replace('timestep="', 'timestep="9', 1)
    yield profile, "another number", last_number_changed
    yield plot, "its absence", None


def accepted(out):
    """Damages that go unnoticed, and the number tried."""
    unnoticed, tried = [], 0
    for path, what, change in damages(out):
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / "out"
            shutil.copytree(out, copy)
            damaged = copy / path.relative_to(out)
            if change is None:
                damaged.unlink()
            else:
                # Fields hold bytes after their header: one character per byte.
                text = damaged.read_text(encoding="latin-1")
                damaged.write_text(change(text), encoding="latin-1")
            tried += 1
            if not check(copy)[0]:
                unnoticed.append(f"{path}: {what} is not noticed")
    return unnoticed, tried


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    out = Path(sys.argv[1])
    found, compared = check(out)
    # The readers' own words about damaged copies would hide the result.
    logging.disable()
    warnings.simplefilter("ignore")
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        unnoticed, tried = accepted(out) if not found else ([], 0)
    for problem in found + unnoticed:
        print(problem, file=sys.stderr)
    print(f"{compared}, {tried} damaged copies tried, {len(found + unnoticed)} problems")
    sys.exit(1 if found or unnoticed else 0)


if __name__ == "__main__":
    main()
