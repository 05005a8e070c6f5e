"""Changes of Coulomb stress by a dipping rectangle below a free surface, from other people's programs.

A rectangle of 2 km by 2 km reaches the surface. Its strike is N25E, its dip 40 degrees and its rake 30 degrees; it slips by
one metre in rock with a shear modulus of 32 GPa and a Poisson's ratio of a quarter. dislocs gives the strains of the
rectangle (Okada), cutde those of two triangles that cover it (Nikkhoo and Walter). Both work in east, north and up.

Stress is resolved on planes with strike, dip and rake in the convention of Aki and Richards. The traction that the hanging
wall exerts on the footwall is sigma n, with n from footwall to hanging wall; shear is its part along the slip of the hanging
wall, and the Coulomb change is shear + friction n.sigma n, tension positive.

    python coulomb.py > coulomb.json

Needs numpy 2.4.6, cutde 26.3.6 and dislocs 0.1.3 from PyPI.
"""

import json

import cutde.halfspace as half
import dislocs
import numpy as np

SHEAR, POISSON = 32e9, 0.25
STRIKE, DIP, RAKE = 25.0, 40.0, 30.0
SIZE = 2e3
FRICTION = 0.4
# Strike, dip and rake of receiver planes.
PLANES = [[200.0, 60.0, -70.0], [25.0, 40.0, 30.0], [310.0, 90.0, 180.0]]
# x to the right of the strike, y up and -z along the strike, from the middle of the upper edge [m].
POSITIONS = [
    [3.0e3, -0.4e3, 0.7e3],
    [-1.5e3, -2.0e3, -1.2e3],
    [0.9e3, -3.0e3, 0.2e3],
    [6.0e3, -5.0e3, -8.0e3],
    [-0.7e3, 0.0, 2.6e3],
]


def axes(strike):
    """Horizontal directions along a strike and to its right."""
    s, c = np.sin(np.radians(strike)), np.cos(np.radians(strike))
    return np.array([s, c, 0.0]), np.array([c, -s, 0.0])


def slip_and_normal(strike, dip, rake):
    """Slip of the hanging wall and normal from footwall to hanging wall: Aki and Richards (2002), equation 4.88 f."""
    f, d, r = np.radians([strike, dip, rake])
    north = np.cos(r) * np.cos(f) + np.cos(d) * np.sin(r) * np.sin(f)
    east = np.cos(r) * np.sin(f) - np.cos(d) * np.sin(r) * np.cos(f)
    slip = np.array([east, north, np.sin(d) * np.sin(r)])
    normal = np.array([np.sin(d) * np.cos(f), -np.sin(d) * np.sin(f), np.cos(d)])
    return slip, normal


def stress(strain):
    e = np.array(strain)
    lame = 2 * SHEAR * POISSON / (1 - 2 * POISSON)
    return lame * np.trace(e) * np.eye(3) + 2 * SHEAR * e


def full(xx, yy, zz, xy, xz, yz):
    return [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]


def by_rectangle(at):
    r = np.radians(RAKE)
    model = np.array([[0.0, 0.0, 0.0, SIZE, SIZE, STRIKE, DIP, np.cos(r), np.sin(r), 0.0]])
    _, _, e, _ = dislocs.rde(np.array([at]), model, SHEAR, POISSON)
    xx, xy, xz, yy, yz, zz = e[0]
    return stress(full(xx, yy, zz, xy, xz, yz))


def by_triangles(at):
    slip, normal = slip_and_normal(STRIKE, DIP, RAKE)
    along, right = axes(STRIKE)
    down = np.cos(np.radians(DIP)) * right - np.sin(np.radians(DIP)) * np.array([0, 0, 1.0])
    a, b = -0.5 * SIZE * along, 0.5 * SIZE * along
    c, d = b + SIZE * down, a + SIZE * down
    sum_ = np.zeros((3, 3))
    for corners in ([a, d, b], [b, d, c]):
        corners = np.array(corners)
        n = np.cross(corners[1] - corners[0], corners[2] - corners[0])
        n /= np.linalg.norm(n)
        assert np.allclose(n, normal)
        # Slip in the axes of the triangle: strike, dip, tensile.
        s = np.cross([0, 0, 1.0], n)
        s /= np.linalg.norm(s)
        u = np.cross(n, s)
        local = np.array([[slip @ s, slip @ u, slip @ n]])
        e = half.strain(np.array([at]), corners[None], local, POISSON)[0]
        xx, yy, zz, xy, xz, yz = e
        sum_ += stress(full(xx, yy, zz, xy, xz, yz))
    return sum_


def main():
    along, right = axes(STRIKE)
    rows, worst = [], 0.0
    for x, y, z in POSITIONS:
        at = x * right - z * along + y * np.array([0, 0, 1.0])
        both = by_rectangle(at), by_triangles(at)
        worst = max(worst, np.abs(both[0] - both[1]).max() / np.abs(both[0]).max())
        changes = []
        for plane in PLANES:
            slip, normal = slip_and_normal(*plane)
            traction = both[0] @ normal
            shear, opening = slip @ traction, normal @ traction
            changes.append([shear, -opening, shear + FRICTION * opening])
        rows.append({"at": [x, y, z], "changes": changes})
    out = {
        "programs": "dislocs 0.1.3, cutde 26.3.6, numpy 2.4.6",
        "largest_difference_of_the_two_programs": worst,
        "friction": FRICTION,
        "planes": PLANES,
        "positions": rows,
    }
    print(json.dumps(out, indent=1))


if __name__ == "__main__":
    main()
