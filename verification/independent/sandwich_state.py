"""Stick-slip of the sandwich-state/v1 block, independent of the Rust code: finite elements (bilinear squares, 2 x 2 Gauss
points), jumps imposed by Lagrange multipliers, the fault as a system of ordinary differential equations for scipy's DOP853.

Prints onset times (V > 1 mm/s), intervals, the position of the largest rate then and slip between onsets; writes sandwich_state.json.
"""

import json

import numpy as np
import scipy.sparse as sp
from scipy.integrate import solve_ivp
from scipy.sparse.linalg import splu

YOUNG, POISSON, DENSITY = 44.8e9, 0.12, 2700.0
WIDTH, HEIGHT = 25e-3, 50e-3
A, B, MU0, V0 = 0.005, 0.020, 0.6, 1e-6
PUSHED = 0.0966e-3
SHEAR = YOUNG / (2 * (1 + POISSON))
DAMPING = 0.5 * np.sqrt(SHEAR * DENSITY)
# Fractions of the second interval at which the mean shear traction is output.
PHASES = [0.1 * k for k in range(1, 10)]


def element(h):
    d = YOUNG / ((1 + POISSON) * (1 - 2 * POISSON)) * np.array(
        [[1 - POISSON, POISSON, 0], [POISSON, 1 - POISSON, 0], [0, 0, (1 - 2 * POISSON) / 2]]
    )
    k = np.zeros((8, 8))
    for x in (-1 / np.sqrt(3), 1 / np.sqrt(3)):
        for y in (-1 / np.sqrt(3), 1 / np.sqrt(3)):
            n = np.array([[y - 1, 1 - y, 1 + y, -1 - y], [x - 1, -1 - x, 1 + x, 1 - x]]) / (2 * h)
            b = np.zeros((3, 8))
            b[0, 0::2], b[1, 1::2], b[2, 0::2], b[2, 1::2] = n[0], n[1], n[1], n[0]
            k += b.T @ d @ b * (h / 2) ** 2
    return k


def condensed(ny, spring):
    """Tractions per slip of B relative to A along y, and per displacement of the spring's far end: shear S, s; normal N, m."""
    nx, h = ny // 2, HEIGHT / ny
    per_block = (nx + 1) * (ny + 1)
    node = lambda block, i, j: block * per_block + j * (nx + 1) + i
    size = 4 * per_block
    rows, columns, values, ke = [], [], [], element(h)
    for block in (0, 1):
        for j in range(ny):
            for i in range(nx):
                corners = [node(block, i, j), node(block, i + 1, j), node(block, i + 1, j + 1), node(block, i, j + 1)]
                dofs = np.array([[2 * n, 2 * n + 1] for n in corners]).ravel()
                rows.append(np.repeat(dofs, 8))
                columns.append(np.tile(dofs, 8))
                values.append(ke.ravel())
    k = sp.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), (size, size))
    fixed = {2 * node(0, 0, j) for j in range(ny + 1)} | {2 * node(1, nx, j) for j in range(ny + 1)}
    fixed |= {2 * node(0, i, 0) + 1 for i in range(nx + 1)}
    top = [2 * node(1, i, ny) + 1 for i in range(nx + 1)]
    free = [d for d in range(size) if d not in fixed and d not in top]
    t = sp.lil_matrix((size, len(free) + 1))
    t[free, range(len(free))] = 1
    t[top, len(free)] = 1
    t = t.tocsr()
    n = ny + 1
    gap, jump = sp.lil_matrix((n, size)), sp.lil_matrix((n, size))
    for j in range(n):
        minus, plus = node(0, nx, j), node(1, 0, j)
        gap[j, 2 * plus], gap[j, 2 * minus] = 1, -1
        jump[j, 2 * plus + 1], jump[j, 2 * minus + 1] = 1, -1
    kf = (t.T @ k @ t).tolil()
    kf[-1, -1] += spring
    g = sp.vstack([jump.tocsr() @ t, gap.tocsr() @ t])
    m = kf.shape[0]
    rhs = np.zeros((m + 2 * n, n + 1))
    # Multipliers are scaled so that both parts of the matrix have similar magnitude; otherwise pivoting loses digits.
    scale = YOUNG
    rhs[m : m + n, :n] = scale * np.eye(n)
    rhs[m - 1, n] = spring
    matrix = sp.bmat([[kf, scale * g.T], [scale * g, None]]).tocsc()
    factor = splu(matrix)
    solution = factor.solve(rhs)
    for _ in range(3):
        solution += factor.solve(rhs - matrix @ solution)
    force = scale * solution[m:]
    area = np.full(n, h)
    area[[0, -1]] = h / 2
    shear, normal = force[:n] / area[:, None], -force[n:] / area[:, None]
    return shear[:, :n], shear[:, n], normal[:, :n], normal[:, n]


def cycles(ny, length, spring, events):
    s, pull, n_slip, n_pull = condensed(ny, spring)
    n = ny + 1
    down = -1.0
    normal = YOUNG * PUSHED / ((1 - POISSON**2) * 2 * WIDTH)
    phi0 = -0.3
    m0 = np.arcsinh(0.5 * np.exp((MU0 + B * phi0) / A))

    def rate(m, phi):
        return 2 * V0 * np.sinh(m) * np.exp(-(MU0 + B * phi) / A)

    def rhs(_, y):
        m, phi, f, _ = y.reshape(4, n)
        v = rate(m, phi)
        dv = 2 * V0 * np.cosh(m) * np.exp(-(MU0 + B * phi) / A)
        dphi = V0 / length * np.exp(-phi) - v / length
        df = down * (n_slip @ v + n_pull * V0)
        dm = (s @ v + pull * V0 - df * A * m + DAMPING * v * B / A * dphi) / (f * A + DAMPING * dv)
        return np.concatenate([dm, dphi, df, v])

    def passes(threshold, direction):
        event = lambda _, y: np.max(rate(*y.reshape(4, n)[:2])) - threshold
        event.direction, event.terminal = direction, True
        return event

    one = np.ones(n)
    tolerance = 1e-6 * np.concatenate([one, one * A / B, one * A * normal, one * length])
    t, y = 0.0, np.concatenate([one * m0, one * phi0, one * normal, 0 * one])
    onsets, places, slips, between = [], [], [], None
    while len(onsets) < events:
        for threshold, direction in ((1e-3, 1), (1e-4, -1)):
            second = len(onsets) == 2 and direction == 1
            with np.errstate(over="ignore", invalid="ignore"):
                run = solve_ivp(
                    rhs,
                    (t, t + 1e4),
                    y,
                    method="DOP853",
                    rtol=1e-13,
                    atol=tolerance,
                    events=passes(threshold, direction),
                    dense_output=second,
                )
            if second:
                between = run.sol
            t, y = run.t[-1], run.y[:, -1]
            if direction == 1:
                onsets.append(t)
                v = rate(*y.reshape(4, n)[:2])
                places.append(float(np.argmax(v)) * HEIGHT / ny)
                slips.append(float(np.mean(y.reshape(4, n)[3])))
    area = np.full(n, 1.0 / ny)
    area[[0, -1]] /= 2

    def mean_shear(time):
        m, _, f, _ = between(time).reshape(4, n)
        return float(area @ (A * m * f))

    found = {
        "elements along the face": ny,
        "L [m]": length,
        "spring [N/m/m]": spring,
        "onsets [s]": onsets,
        "intervals [s]": list(np.diff(onsets)),
        "fastest at the onset, y [m]": places,
        "slip between onsets, mean [m]": list(np.diff(slips)),
        "shares of the interval from the second onset": PHASES,
        "mean shear traction there [Pa]": [mean_shear(onsets[1] + p * (onsets[2] - onsets[1])) for p in PHASES],
    }
    print(json.dumps(found, indent=1), flush=True)
    return found


if __name__ == "__main__":
    results = [cycles(40, 0.5e-6, 1.4e10, 4), cycles(80, 0.5e-6, 1.4e10, 4)]
    results += [cycles(160, 0.5e-6, 1.4e10, 4)]
    results += [cycles(n, 10e-6, 2e9, 3) for n in (20, 40, 80)]
    with open("sandwich_state.json", "w", encoding="utf-8") as file:
        json.dump(results, file, indent=1)
        file.write("\n")
