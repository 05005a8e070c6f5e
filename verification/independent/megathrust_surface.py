"""A plate interface in the style of the Nankai Trough, as longitude, latitude and depth.

The trench runs towards N70E with a bend of 15 km, and the plate dips towards N20W. On the plane of the transverse
Mercator projection of WGS84 around 135 E, 33 N, with s along the trench and q down dip [km],

    depth = 5 + 0.08 p + 0.0012 p^2  [km],    p = q - 15 sin(s / 90).

PROJ, through pyproj, turns positions of contours of this surface into longitudes and latitudes.

    python megathrust_surface.py > ../../scenes/surfaces/nankai-style.txt
"""

import numpy as np
import pyproj

ORIGIN = (135.0, 33.0)
STRIKE = np.radians(70.0)


def main():
    plane = pyproj.Proj(f"+proj=tmerc +lat_0={ORIGIN[1]} +lon_0={ORIGIN[0]} +k=1 +ellps=WGS84 +units=m")
    version = f"pyproj {pyproj.__version__}, PROJ {pyproj.proj_version_str}"
    print("# A plate interface in the style of the Nankai Trough: longitude [deg], latitude [deg], depth [km].")
    print(f"# Contours of a formula, see verification/independent/megathrust_surface.py ({version}).")
    for depth in np.arange(5.0, 61.0, 2.5):
        print(f"> contour at {depth} km")
        # Positive root of the quadratic in p.
        p = (-0.08 + np.sqrt(0.08**2 + 4 * 0.0012 * (depth - 5.0))) / (2 * 0.0012)
        for s in np.arange(-150.0, 151.0, 12.5):
            q = p + 15.0 * np.sin(s / 90.0)
            east = 1e3 * (s * np.sin(STRIKE) - q * np.cos(STRIKE))
            north = 1e3 * (s * np.cos(STRIKE) + q * np.sin(STRIKE))
            longitude, latitude = plane(east, north, inverse=True)
            print(f"{longitude:.6f} {latitude:.6f} {depth:.2f}")


if __name__ == "__main__":
    main()
