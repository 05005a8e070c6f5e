"""The plate interface of `megathrust_surface.py` as a grid of longitude and latitude, in two files with the same numbers.

SciPy writes the grid in the classic netCDF format; the text has the shortest decimals that read back as the same numbers. Where
the depth is above 5 km or below 60 km there is none.

    python megathrust_grid.py ../cases/fault_medium/grid
"""

import sys
from pathlib import Path

import numpy as np
import pyproj
import scipy
from scipy.io import netcdf_file

ORIGIN = (135.0, 33.0)
STRIKE = np.radians(70.0)


def depth(longitude, latitude):
    """Depth of the formula [km]; NaN outside its range."""
    plane = pyproj.Proj(f"+proj=tmerc +lat_0={ORIGIN[1]} +lon_0={ORIGIN[0]} +k=1 +ellps=WGS84 +units=m")
    east, north = plane(longitude, latitude)
    s = 1e-3 * (east * np.sin(STRIKE) + north * np.cos(STRIKE))
    q = 1e-3 * (north * np.sin(STRIKE) - east * np.cos(STRIKE))
    p = q - 15.0 * np.sin(s / 90.0)
    found = 5.0 + 0.08 * p + 0.0012 * p**2
    return np.where((p > 0.0) & (found < 60.0) & (np.abs(s) < 150.0), found, np.nan)


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(exist_ok=True)
    longitudes = np.linspace(133.0, 137.0, 21)
    latitudes = np.linspace(32.2, 35.8, 19)
    depths = depth(*np.meshgrid(longitudes, latitudes))
    with netcdf_file(folder / "interface.grd", "w", version=1) as file:
        file.Conventions = "CF-1.7"
        file.history = f"megathrust_grid.py, SciPy {scipy.__version__}, pyproj {pyproj.__version__}"
        file.createDimension("lon", len(longitudes))
        file.createDimension("lat", len(latitudes))
        for name, unit, values in (("lon", "degrees_east", longitudes), ("lat", "degrees_north", latitudes)):
            variable = file.createVariable(name, "d", (name,))
            variable.units = unit
            variable[:] = values
        variable = file.createVariable("z", "d", ("lat", "lon"))
        variable.units = "km"
        variable._FillValue = np.nan
        variable[:] = depths
    with open(folder / "interface.txt", "w") as file:
        print("# longitude [deg], latitude [deg], depth [km]: the numbers of interface.grd", file=file)
        for latitude, row in zip(latitudes, depths):
            for longitude, value in zip(longitudes, row):
                print(f"{longitude!r} {latitude!r} {value!r}".replace("np.float64(", "").replace(")", ""), file=file)


if __name__ == "__main__":
    main()
