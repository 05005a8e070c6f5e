"""Histories of the benchmark sandwich/v1 on four meshes, computed by sandwich.py.

Writes sandwich_histories.json: slip at y = 12.5, 25, 37.5 mm since the end of stage 1, mean normal and mean shear
traction of the face, at displacements u_y of the upper edge.  Takes half a minute.
"""

import datetime
import json
import pathlib
import platform

import numpy as np
import scipy
import skfem

import sandwich
from sandwich import U_X, Case, Interface

HEIGHTS = (12.5, 25.0, 37.5)
# u_y in mm: closer where slip propagates over the face.
CHECKPOINTS = np.array([0.005, 0.01, 0.012, 0.014, 0.016, 0.018, 0.02, 0.025, 0.03, 0.04, 0.05])
sandwich.CHECKPOINTS = CHECKPOINTS


def histories(h):
    face = Interface(Case(h=h))
    start, _ = face.press()
    _, slips = face.shear(start)
    shear, normal = [], []
    for u_y, slip in zip(CHECKPOINTS, slips):
        # Tractions from the slip of the integration: s = q(load) - Q (F_t - F_t0).
        ft = start + np.linalg.solve(face.q_matrix, -face.q_y * u_y - slip)
        shear.append(face.mean(ft))
        normal.append(face.mean(face.normal(ft, U_X, -u_y)))
    return {
        "h [mm]": h,
        "slip [um], rows u_y, columns y": [[1e3 * face.at(slip, y) for y in HEIGHTS] for slip in slips],
        "mean shear traction [MPa]": shear,
        "mean normal traction [MPa]": normal,
    }


def main():
    results = {
        "benchmark": "sandwich/v1",
        "date": datetime.date.today().isoformat(),
        "python": platform.python_version(),
        "packages": {m.__name__: m.__version__ for m in (np, scipy, skfem)},
        "u_y [mm]": CHECKPOINTS.tolist(),
        "y [mm]": HEIGHTS,
        "meshes": [histories(h) for h in (2.5, 1.25, 0.625, 0.3125)],
    }
    path = pathlib.Path(__file__).with_name("sandwich_histories.json")
    path.write_text(json.dumps(results, indent=1, default=float) + "\n")


if __name__ == "__main__":
    main()
