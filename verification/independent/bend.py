"""Tractions of slip across a bend of a fault in an infinite plane, plane strain: benchmark fault-bend/v1.

The gradient of slip along both halves is a density of edge dislocations; the turn of its direction at the bend is one discrete
dislocation.  Stresses are those of Hirth and Lothe.  Integrals are computed by scipy, as principal values on the half where the
traction is evaluated; slip is not discretised.  Writes bend.json.  Takes seconds.
"""

import json
import pathlib

import numpy as np
from scipy.integrate import quad

G, NU = 80.0953008e9 / 2.5, 0.25
TURN = np.pi / 6
HALF = 10e3  # m, distance from the bend at which slip ends
DISTANCES = [-12e3, -10e3, -8e3, -6e3, -5e3, -4e3, -3e3, -2.5e3, -2e3, 2e3, 2.5e3, 3e3, 4e3, 5e3, 6e3, 8e3, 10e3, 12e3]
UP = {1: np.array([0.0, 1.0]), -1: np.array([np.sin(TURN), np.cos(TURN)])}


def slip(s):
    """Slip [m] at the distance s above the bend."""
    return max(0.0, 1 - (s / HALF) ** 2) ** 3


def slope(s):
    return -6 * s / HALF**2 * max(0.0, 1 - (s / HALF) ** 2) ** 2


def along(b):
    """Stress field of an edge dislocation at 0 with Burgers vector `b`, computed in axes along `b` and rotated back."""
    size = np.hypot(*b)
    c, s = b / size if size > 0 else (1.0, 0.0)

    def stress(at):
        x, y = c * at[0] + s * at[1], -s * at[0] + c * at[1]
        r = (x * x + y * y) ** 2
        d = G * size / (2 * np.pi * (1 - NU))
        xx, yy, xy = -d * y * (3 * x * x + y * y) / r, d * y * (x * x - y * y) / r, d * x * (x * x - y * y) / r
        turn = np.array([[c, -s], [s, c]])
        return turn @ np.array([[xx, xy], [xy, yy]]) @ turn.T

    return stress


def tractions(s):
    """Shear traction along the slip and normal traction, compression positive, at the distance s above the bend."""
    own = 1 if s > 0 else -1
    t = UP[own]
    n = np.array([t[1], -t[0]])
    at = s * t

    def of(stress):
        return np.array([n @ stress @ t, -n @ stress @ n])

    total = np.zeros(2)
    for half in (1, -1):
        tangent, (low, high) = UP[half], ((0.0, HALF) if half > 0 else (-HALF, 0.0))
        if half == own and low < s < high:
            # Shear traction of a half on itself: G/(2 pi (1 - nu)) times the principal value of int slope/(x - s) dx.
            total[0] += G / (2 * np.pi * (1 - NU)) * quad(slope, low, high, weight="cauchy", wvar=s, epsrel=1e-13)[0]
            continue
        # Looking along the fault, the normal of `of` points to the right and the y axis of `along` to the left.
        unit = along(tangent)
        for component in (0, 1):
            density = lambda x: slope(x) * of(unit(at - x * tangent))[component]
            total[component] += quad(density, low, high, epsabs=1e-9, epsrel=1e-12)[0]
    bend = along(slip(0.0) * (UP[1] - UP[-1]))
    return total + of(bend(at))


def check():
    """Without a turn both halves form one straight fault, and both ways of integration agree."""
    global UP
    bent, UP = UP, {1: UP[1], -1: UP[1]}
    for s in (-12e3, -4e3, 2e3):
        whole = quad(slope, -HALF, HALF, weight="cauchy", wvar=s)[0] * G / (2 * np.pi * (1 - NU))
        shear, normal = tractions(s)
        assert abs(shear / whole - 1) < 1e-9 and abs(normal) < 1e-9 * abs(shear), (shear, whole, normal)
    UP = bent


def main():
    check()
    rows = [[s, *tractions(s)] for s in DISTANCES]
    for row in rows:
        print(row)
    text = {"distance above the bend [m], shear [Pa], normal [Pa]": rows}
    pathlib.Path(__file__).with_name("bend.json").write_text(json.dumps(text, indent=1) + "\n")


if __name__ == "__main__":
    main()
