"""Files of values as other programs write them: grids by SciPy in classic netCDF, unstructured grids by VTK and meshio.

The first folder takes `normal.grd` and `normal.vtu`, a linear function [MPa] on a rectangle that dips by 30 degrees, and `map.grd`, the
depth of `megathrust_surface.py` [km, as MPa] over longitude and latitude. The second takes one surface in every form of a VTU file. The third
takes `friction.grd`, coefficients that grow along an interface.

    python field_files.py ../cases/fault_medium/files ../../crates/output/tests/vtu ../cases/interface_laws/files
"""

import sys
from pathlib import Path

import meshio
import numpy as np
import pyproj
import pyvista
import vtk
from scipy.io import netcdf_file

from megathrust_grid import ORIGIN, STRIKE

WIDTH = 10.0
DIP = np.radians(30.0)


def linear(x, y, z):
    """Normal traction of the case [MPa] at a position [km]."""
    return 40.0 + 1.5 * x - 2.0 * y + 0.7 * z


def depth(longitude, latitude):
    """Depth of the formula of `megathrust_surface.py` [km], everywhere."""
    plane = pyproj.Proj(f"+proj=tmerc +lat_0={ORIGIN[1]} +lon_0={ORIGIN[0]} +k=1 +ellps=WGS84 +units=m")
    east, north = plane(longitude, latitude)
    s = 1e-3 * (east * np.sin(STRIKE) + north * np.cos(STRIKE))
    p = 1e-3 * (north * np.sin(STRIKE) - east * np.cos(STRIKE)) - 15.0 * np.sin(s / 90.0)
    return 5.0 + 0.08 * p + 0.0012 * p**2


def write_grid(path, names, units, axes, variable, unit, values):
    """A grid whose rows run along the second coordinate."""
    with netcdf_file(path, "w", version=1) as file:
        file.Conventions = "CF-1.7"
        for name, of, coordinate in zip(names, units, axes):
            file.createDimension(name, len(coordinate))
            own = file.createVariable(name, "d", (name,))
            own.units = of
            own[:] = coordinate
        own = file.createVariable(variable, "d", names)
        own.units = unit
        own[:] = values


def rectangle():
    """Nodes [km] and triangles of a plane that reaches beyond the rectangle, uneven along both directions."""
    down = WIDTH * np.array([-0.1, 0.05, 0.31, 0.42, 0.77, 1.1])
    along = WIDTH * np.array([-0.1, 0.2, 0.24, 0.6, 0.93, 1.1])
    points = np.array([[d * np.cos(DIP), -d * np.sin(DIP), a] for d in down for a in along])
    n = len(along)
    corners = [(i * n + j, i * n + j + 1, (i + 1) * n + j) for i in range(5) for j in range(5)]
    corners += [(i * n + j + 1, (i + 1) * n + j + 1, (i + 1) * n + j) for i in range(5) for j in range(5)]
    return points, np.array(corners)


def surface(points, corners, name, values):
    cells = np.hstack([np.full((len(corners), 1), 3), corners]).ravel()
    grid = pyvista.UnstructuredGrid(cells, np.full(len(corners), 5, np.uint8), points)
    grid.point_data[name] = values
    return grid


def write_by_vtk(grid, path, mode, order="little", compressed=True, wide=False, encoded=False):
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


def main():
    case, forms, interface = map(Path, sys.argv[1:4])
    for folder in (case, forms, interface):
        folder.mkdir(exist_ok=True)
    x = np.array([-2.0, 1.0, 4.5, 11.0])
    write_grid(interface / "friction.grd", ("x",), ("cm",), (x,), "mu", "1", 0.3 + 0.02 * x)
    x, z = np.linspace(-1.0, 10.0, 8), np.linspace(-1.0, 11.0, 7)
    values = linear(x[None, :], -np.tan(DIP) * x[None, :], z[:, None])
    write_grid(case / "normal.grd", ("z", "x"), ("km", "km"), (z, x), "normal", "MPa", values)
    longitudes, latitudes = np.linspace(133.0, 137.0, 21), np.linspace(32.2, 35.8, 19)
    depths = depth(*np.meshgrid(longitudes, latitudes))
    units = ("degrees_north", "degrees_east")
    write_grid(case / "map.grd", ("lat", "lon"), units, (latitudes, longitudes), "normal", "MPa", depths)
    points, corners = rectangle()
    write_by_vtk(surface(points, corners, "normal", linear(*points.T)), case / "normal.vtu", "end")

    # One surface in every form; the values have all bits of a number.
    points = np.array([[0.0, 0.0, 0.1], [1.0, 0.0, 0.2], [1.0, 1.0, 0.3], [0.0, 1.0, 0.4]]) / 3.0
    corners = np.array([[0, 1, 2], [0, 2, 3]])
    values = np.array([1.0, 2.0, 4.0, 8.0]) / 7.0
    grid = surface(points, corners, "a", values)
    grid.cell_data["c"] = np.array([1.0, 2.0]) / 9.0
    write_by_vtk(grid, forms / "vtk_ascii.vtu", "ascii")
    write_by_vtk(grid, forms / "vtk_inline.vtu", "inline")
    write_by_vtk(grid, forms / "vtk_inline_plain_big.vtu", "inline", order="big", compressed=False)
    write_by_vtk(grid, forms / "vtk_end.vtu", "end")
    write_by_vtk(grid, forms / "vtk_end_plain_wide.vtu", "end", compressed=False, wide=True)
    write_by_vtk(grid, forms / "vtk_end_base64_big.vtu", "end", order="big", encoded=True)
    mesh = meshio.Mesh(points, [("triangle", corners)], {"a": values}, {"c": [np.array([1.0, 2.0]) / 9.0]})
    meshio.vtu.write(forms / "meshio_zlib.vtu", mesh, compression="zlib")
    meshio.vtu.write(forms / "meshio_plain.vtu", mesh, compression=None)
    meshio.vtu.write(forms / "meshio_lzma.vtu", mesh, compression="lzma")


if __name__ == "__main__":
    main()
