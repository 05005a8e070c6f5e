"""Stiffness of a fault between half-spaces of trilinear hexahedra, over that of the continuum.

Slip varies as exp(i (kx x + ky y)) on a plane fault between two half-spaces of one rock, whose cubes have edges h. The half-space
is eliminated layer by layer: two slabs of equal thickness are joined over their common nodes until the far side no longer counts.
Displacement normal to the fault is free of force, as it is for slip between two equal half-spaces. In the continuum the stiffness is
G k/2 where slip is normal to the wave vector (mode III) and G k/(2 (1 - nu)) where it is along it (mode II).

The coefficient c is that of 1 + c theta^2, with theta = k h.

    python hexahedra_stiffness.py > hexahedra_stiffness.json

Needs numpy 2.4.6.
"""

import itertools
import json

import numpy as np

NODES = list(itertools.product((0, 1), repeat=3))
GAUSS = (0.5 - 0.5 / np.sqrt(3.0), 0.5 + 0.5 / np.sqrt(3.0))


def cube(poisson, mean):
    """Stiffness of a cube with edges and shear modulus of one, by 2x2x2 points; with `mean` (B-bar) its dilatation is uniform."""
    moduli = np.diag([2.0, 2.0, 2.0, 1.0, 1.0, 1.0])
    moduli[:3, :3] += 2.0 * poisson / (1.0 - 2.0 * poisson)
    stiffness = np.zeros((24, 24))
    for point in itertools.product(GAUSS, repeat=3):
        strain = np.zeros((6, 24))
        for a, node in enumerate(NODES):
            value = [p if n else 1.0 - p for p, n in zip(point, node)]
            slope = [1.0 if n else -1.0 for n in node]
            dx = slope[0] * value[1] * value[2]
            dy = slope[1] * value[0] * value[2]
            dz = slope[2] * value[0] * value[1]
            x, y, z = 3 * a, 3 * a + 1, 3 * a + 2
            strain[0, x], strain[1, y], strain[2, z] = dx, dy, dz
            strain[3, x], strain[3, y] = dy, dx
            strain[4, y], strain[4, z] = dz, dy
            strain[5, x], strain[5, z] = dz, dx
        if mean:
            dilatation = np.array([0.25 if n else -0.25 for node in NODES for n in node])
            strain[:3] += (dilatation - strain[:3].sum(axis=0)) / 3.0
        stiffness += strain.T @ moduli @ strain / 8.0
    return stiffness


def half_space(tx, ty, poisson, mean):
    """Forces of the nodes on the plane for their displacements of phases tx and ty from node to node, 3x3."""
    element = cube(poisson, mean)
    slab = np.zeros((6, 6), complex)
    for (a, m), (b, n) in itertools.product(enumerate(NODES), repeat=2):
        phase = np.exp(1j * (tx * (n[0] - m[0]) + ty * (n[1] - m[1])))
        rows, columns = slice(3 * m[2], 3 * m[2] + 3), slice(3 * n[2], 3 * n[2] + 3)
        slab[rows, columns] += element[3 * a : 3 * a + 3, 3 * b : 3 * b + 3] * phase
    near, out, back, far = slab[:3, :3], slab[:3, 3:], slab[3:, :3], slab[3:, 3:]
    for _ in range(60):
        joined = np.linalg.inv(far + near)
        near, far = near - out @ joined @ back, far - back @ joined @ out
        out, back = -out @ joined @ out, -back @ joined @ back
    return near


def coefficients(theta, angle, poisson, mean):
    """Coefficients of modes II and III for a wave vector at `angle` from an edge of the cubes."""
    direction = np.array([np.cos(angle), np.sin(angle)])
    normal = np.array([-direction[1], direction[0]])
    forces = half_space(*(theta * direction), poisson, mean)
    free = forces[:2, :2] - np.outer(forces[:2, 2], forces[2, :2]) / forces[2, 2]
    along, across = (direction @ free @ direction).real, (normal @ free @ normal).real
    return [(along * (1.0 - poisson) / theta - 1.0) / theta**2, (across / theta - 1.0) / theta**2]


rows = [
    {"element": e, "poisson": p, "angle": a, "theta": t, "mode II": two, "mode III": three}
    for e in ("standard", "B-bar")
    for p in (0.0, 0.25, 0.4)
    for a in (0.0, 22.5, 45.0)
    for t in (0.1, 1.0)
    for two, three in [coefficients(t, np.radians(a), p, e == "B-bar")]
]
print(json.dumps(rows, indent=1))
