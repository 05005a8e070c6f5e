"""Hertzian line contact, and partial slip of Cattaneo and Mindlin, by boundary elements of two half-planes.

Tractions are constant on equal elements.  Relative displacements of the surfaces, up to a constant, are
-2/(pi E*) int p(s) ln|x - s| ds, for normal tractions, and for shear tractions if the materials are equal; they are prescribed
at the midpoints of elements.  The sets of elements in contact and in stick are found iteratively.  Lengths are over a, pressures
over p0: with a = p0 = 1, E*/R = 2 and P = pi/2.  Writes line_contact.json.  Takes seconds.
"""

import json
import pathlib

import numpy as np

# Half of the meshed length, over a: chosen so that no element ends at a.
REACH = 1.1
PLACES = [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95]


def kernel(n):
    """Relative displacement at the midpoints per unit traction of elements, E*/R = 2 and R = 1."""
    h = 2 * REACH / n
    x = (np.arange(n) + 0.5) * h - REACH

    def primitive(d):
        return d * np.log(np.abs(d)) - d

    d = x[:, None] - x[None, :]
    return x, h, -(2 / (np.pi * 2)) * (primitive(d + h / 2) - primitive(d - h / 2))


def solve(k, h, free, total, wanted):
    """Tractions of the elements `free` with resultant `total`, whose displacement is `wanted` plus a constant."""
    n = free.sum()
    matrix = np.zeros((n + 1, n + 1))
    matrix[:n, :n], matrix[:n, n], matrix[n, :n] = k[np.ix_(free, free)], -1, h
    found = np.linalg.solve(matrix, np.append(wanted[free], total))
    return found[:n]


def press(x, h, k, load):
    """Pressure: u + x^2/2R = constant where it is positive."""
    closed, p = np.ones(x.size, bool), np.zeros(x.size)
    while True:
        p[:] = 0
        p[closed] = solve(k, h, closed, load, -(x**2) / 2)
        if p.min() >= 0:
            return p
        closed &= p > 0


def shear(h, k, p, q0, total, sense):
    """Shear tractions over mu after a change from q0 to this total, with slip of one sense where the strength is reached."""
    stick = p > 0
    while True:
        change = np.where(p > 0, sense * p - q0, 0.0)
        change[stick] = 0
        rest = total - h * (q0.sum() + change.sum())
        # Slipping elements displace sticking ones; the total displacement of the stick zone must be uniform.
        change[stick] = solve(k, h, stick, rest, -k @ change)
        over = stick & (sense * (q0 + change) > p)
        if not over.any():
            return q0 + change
        stick &= ~over


def profile(x, values):
    return np.interp(PLACES, x, values).tolist()


def run(n):
    x, h, k = kernel(n)
    load = np.pi / 2
    p = press(x, h, k, load)
    q = shear(h, k, p, np.zeros(n), 0.5 * load, 1)
    back = shear(h, k, p, q, 0.0, -1)
    return {
        "elements on 2.2 a": n,
        "pressure": profile(x, p),
        "largest pressure": p.max(),
        "half-width by the second moment": 2 * np.sqrt((x**2 * p).sum() / p.sum()),
        "shear": profile(x, q),
        "second moment of shear": 4 * (x**2 * q).sum() / q.sum(),
        "shear after unloading": profile(x, back),
        "second moment after unloading": 4 * h * (x**2 * back).sum() / load,
    }


def main():
    results = {"places": PLACES, "runs": [run(n) for n in (101, 201, 401, 801)]}
    pathlib.Path(__file__).with_name("line_contact.json").write_text(json.dumps(results, indent=1) + "\n")
    for r in results["runs"]:
        print(r)


if __name__ == "__main__":
    main()
