"""Writes a parameter of a fault with VTK and meshio in all forms of a VTU file, and lets the program read it.

    python interop/check_fields.py target/release/asperity interop/fields.toml

The plan must name the range of the values at the points, which is known: the values are linear in the position. Damaged copies must be
refused with a message that names the file.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

import meshio
import numpy as np
import pyvista
import vtk

# Surface of the rectangle [km] and somewhat beyond, and values that are linear on it.
DIP = np.radians(30.0)
DOWN = np.linspace(-0.5, 10.5, 12)
ALONG = np.linspace(-0.5, 10.5, 9)
POINTS = np.array([[d * np.cos(DIP), -d * np.sin(DIP), a] for d in DOWN for a in ALONG])
N = len(ALONG)
CORNERS = np.array(
    [
        corners
        for i in range(len(DOWN) - 1)
        for j in range(N - 1)
        for k in [i * N + j]
        for corners in [(k, k + 1, k + N), (k + 1, k + N + 1, k + N)]
    ]
)


def friction(down, along):
    return 0.010 + 0.001 * down + 0.0005 * along


VALUES = np.array([friction(d, a) for d in DOWN for a in ALONG])
# Centres of the cells of the scene lie between 0.5 and 9.5 km.
RANGE = (friction(0.5, 0.5), friction(9.5, 9.5))


def by_vtk(path, mode, order="little", compressed=True, wide=False, encoded=False):
    cells = np.hstack([np.full((len(CORNERS), 1), 3), CORNERS]).ravel()
    grid = pyvista.UnstructuredGrid(cells, np.full(len(CORNERS), 5, np.uint8), POINTS)
    grid.point_data["a"] = VALUES
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(str(path))
    {"ascii": writer.SetDataModeToAscii, "inline": writer.SetDataModeToBinary, "end": writer.SetDataModeToAppended}[mode]()
    writer.SetByteOrderToBigEndian() if order == "big" else writer.SetByteOrderToLittleEndian()
    if not compressed:
        writer.SetCompressorTypeToNone()
    writer.SetHeaderTypeToUInt64() if wide else writer.SetHeaderTypeToUInt32()
    writer.SetEncodeAppendedData(encoded)
    writer.Write()


def by_meshio(path, compression):
    mesh = meshio.Mesh(POINTS, [("triangle", CORNERS)], {"a": VALUES})
    meshio.vtu.write(path, mesh, compression=compression)


FORMS = {
    "VTK, text": lambda path: by_vtk(path, "ascii"),
    "VTK, zlib": lambda path: by_vtk(path, "inline"),
    "VTK, zlib, at the end": lambda path: by_vtk(path, "end"),
    "VTK, plain, big endian": lambda path: by_vtk(path, "inline", order="big", compressed=False),
    "VTK, plain, at the end, wide": lambda path: by_vtk(path, "end", compressed=False, wide=True),
    "VTK, base64 at the end": lambda path: by_vtk(path, "end", encoded=True),
    "meshio, zlib": lambda path: by_meshio(path, "zlib"),
    "meshio, plain": lambda path: by_meshio(path, None),
}


def planned(program, scene):
    """Exit code and text of `asperity check`."""
    done = subprocess.run([program, "check", scene], capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout + done.stderr


def problem_of(program, scene):
    """What is wrong with the plan of a scene whose file is whole."""
    code, text = planned(program, scene)
    flat = " ".join(text.split())
    found = re.search(r"`a` from \d+ values of `a\.vtu`.*?from ([\d.e+-]+) to ([\d.e+-]+) at \d+ points", flat)
    if code != 0 or not found:
        return f"exit code {code}: {text}"
    ends = [float(found[1]), float(found[2])]
    if np.abs(np.array(ends) / np.array(RANGE) - 1.0).max() > 1e-12:
        return f"values from {ends[0]} to {ends[1]}, expected {RANGE[0]} to {RANGE[1]}"
    return None


def damages(whole):
    """Damaged copies of a file of meshio in zlib."""
    middle = whole.index(b'Name="a"')
    body = whole.index(b"\n", middle) + 40
    yield "half of the file", whole[: len(whole) // 2]
    yield "a character of its values", whole[:body] + bytes([whole[body] ^ 1]) + whole[body + 1 :]
    yield "fewer points", whole.replace(b'NumberOfPoints="', b'NumberOfPoints="1', 1)
    yield "another name", whole.replace(b'Name="a"', b'Name="b"', 1)
    yield "another type", whole.replace(b'type="Float64" Name="a"', b'type="Float32" Name="a"', 1)
    yield "a value that is missing", None


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    program, text = str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]).read_text()
    problems, refused = [], 0
    with tempfile.TemporaryDirectory() as folder:
        scene, file = Path(folder) / "scene.toml", Path(folder) / "a.vtu"
        scene.write_text(text)
        for name, write in FORMS.items():
            write(file)
            problem = problem_of(program, scene)
            if problem:
                problems.append(f"{name}: {problem}")
        whole = file.read_bytes() if by_meshio(file, "zlib") is None else b""
        for name, damaged in damages(whole):
            if damaged is None:
                VALUES[N * 5 + 4] = np.nan
                by_meshio(file, "zlib")
            else:
                file.write_bytes(damaged)
            code, told = planned(program, scene)
            refused += 1
            if code == 0 or "a.vtu" not in told:
                problems.append(f"{name}: exit code {code}: {told}")
    if problems:
        sys.exit("\n".join(problems))
    print(f"{len(FORMS)} files of VTK and meshio are read, and {refused} damaged copies are refused")


if __name__ == "__main__":
    main()
