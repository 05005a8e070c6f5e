"""SEAS BP4-QD and BP7-QD, independent of the Rust code: a planar fault in a whole space with slip in both directions, cells of constant slip.

    python cycles_in_space.py PROBLEM CELL YEARS EVENTS [TOLERANCE]

PROBLEM is bp4, bp4:LENGTH (along strike, in m; 120000 by default), bp7 or bp7:L (characteristic slip in m; 5e-4 by default); CELL is
in m; TOLERANCE is the error per step in ln V. Adds the onsets (V rises above 1 mm/s after it was below 0.1 mm/s), the times at which
rates fall below 0.1 mm/s, largest rates and slip at the stations at the end of each event to cycles_in_space.json.

Traction on the plane x = 0 due to slip s in it (Kelvin's solution, integrated over the plane):

    T_a = G/(4 pi) (lap delta_ab + nu/(1 - nu) d_a d_b) int s_b / r dA.

For constant slip in a rectangle the second derivatives of the integral are sums over its four corners of 1/r and y/(z r). Shear
tractions and the logarithm of the state are integrated by an explicit pair of order 5; the slip rate follows from friction with
radiation damping by Newton's method in ln V.
"""

import json
import os
import sys
import time

import numpy as np
from scipy.fft import irfft2, next_fast_len, rfft2
from scipy.integrate import RK45

RHO, CS, NU = 2670.0, 3464.0, 0.25
G = RHO * CS**2
ETA = G / (2 * CS)
F0, V0, VP = 0.6, 1e-6, 1e-9
YEAR = 365.25 * 86400.0
ABOVE, BELOW = 1e-3, 1e-4


def corner(y, z):
    """Second derivatives of int 1/r over the quadrant y' < y, z' < z: by y y, z z and y z, without parts that cancel."""
    r = np.hypot(y, z)
    return -z / (y * r), -y / (z * r), 1 / r


def kernel(h, ny, nz):
    """Tractions (T_y, T_z) by (s_y, s_z) of a square cell at all offsets."""
    y, z = np.meshgrid(h * np.arange(-ny + 1, ny), h * np.arange(-nz + 1, nz), indexing="ij")
    yy, zz, yz = np.zeros_like(y), np.zeros_like(y), np.zeros_like(y)
    for i in (-1, 1):
        for j in (-1, 1):
            for total, part in zip((yy, zz, yz), corner(y + i * h / 2, z + j * h / 2)):
                total += i * j * part
    c, n = G / (4 * np.pi), NU / (1 - NU)
    lap = yy + zz
    return c * (lap + n * yy), c * (lap + n * zz), c * n * yz


class Operator:
    """Convolution on the grid by Fourier transforms of twice its size."""

    def __init__(self, h, ny, nz):
        self.n = ny, nz
        self.size = next_fast_len(2 * ny - 1, True), next_fast_len(2 * nz - 1, True)
        self.parts = [rfft2(np.roll(self.padded(k), (-ny + 1, -nz + 1), (0, 1))) for k in kernel(h, ny, nz)]

    def padded(self, k):
        out = np.zeros(self.size)
        out[: k.shape[0], : k.shape[1]] = k
        return out

    def __call__(self, sy, sz):
        fy, fz = rfft2(sy, self.size), rfft2(sz, self.size)
        yy, zz, yz = self.parts
        cut = lambda f: irfft2(f, self.size)[: self.n[0], : self.n[1]]
        return cut(yy * fy + yz * fz), cut(yz * fy + zz * fz)


def check():
    """A long strip of slip along strike is a pair of screws, of slip across it a pair of edges; the operator equals the plain sum."""
    h, n = 1.0, 4001
    ky, kz, kyz = kernel(h, 8, n)
    d = np.arange(-7, 8) * h
    strip = 1 / (2 * np.pi) * (1 / (d - 0.5) - 1 / (d + 0.5))
    assert np.allclose(kz.sum(1) / (G * strip), 1, rtol=1e-5)
    assert np.allclose(ky.sum(1) / (G / (1 - NU) * strip), 1, rtol=1e-5)
    assert np.max(np.abs(kyz.sum(1))) < 1e-12 * G
    rng = np.random.default_rng(1)
    ny, nz = 5, 7
    sy, sz = rng.random((2, ny, nz))
    ty, tz = Operator(h, ny, nz)(sy, sz)
    ky, kz, kyz = kernel(h, ny, nz)
    for i in range(ny):
        for j in range(nz):
            part = (slice(ny - 1 - i, 2 * ny - 1 - i), slice(nz - 1 - j, 2 * nz - 1 - j))
            assert np.isclose(ty[i, j], np.sum(ky[part] * sy + kyz[part] * sz))
            assert np.isclose(tz[i, j], np.sum(kyz[part] * sy + kz[part] * sz))


def linear(distance, width, inside, outside):
    return inside + np.clip(distance / width, 0, 1) * (outside - inside)


def bp4(h, length=120e3):
    ny, nz = round(80e3 / h), round(length / h)
    y, z = grid(h, ny, nz)
    beyond = np.maximum(np.abs(y) - 15e3, np.abs(z) - 30e3)
    a, b, L, sigma = linear(beyond, 3e3, 0.0065, 0.025), 0.013, 0.04, 50e6
    most = 0.025
    tau = sigma * most * np.arcsinh(VP / (2 * V0) * np.exp((F0 + b * np.log(V0 / VP)) / most)) + ETA * VP
    # V/(2 V0) exp((F0 + b w)/a) = sinh((tau - eta V)/(a sigma)), w = ln(V0 theta/L); sinh by logarithms.
    x = (tau - ETA * VP) / (a * sigma)
    w = (a * (x + np.log1p(-np.exp(-2 * x)) - np.log(2) - np.log(VP / (2 * V0))) - F0) / b
    # A cell with its centre on the border belongs to the seed.
    seed = (np.abs(y + 7.5e3) < 6001) & (np.abs(z + 22.5e3) < 6001)
    v = np.where(seed, 0.03, VP)
    tau = sigma * a * asinh_of(np.log(v / (2 * V0)) + (F0 + b * w) / a) + ETA * v
    stations = [(0, 0), (0, -22.5e3), (-7.5e3, -22.5e3), (0, 22.5e3), (12e3, 0), (18e3, 0), (0, 36e3)]
    return dict(h=h, y=y, z=z, a=a, b=b, L=L, sigma=sigma, tau=tau, w=w, stations=stations, pulse=None)


def bp7(h, L=5e-4):
    n = round(800 / h)
    y, z = grid(h, n, n)
    b, sigma = 0.010, 25e6
    a = np.where(np.hypot(y, z) < 200, 0.004, 0.016)
    w = np.full_like(a, np.log(V0 / VP))
    tau = sigma * a * asinh_of(np.log(VP / (2 * V0)) + (F0 + b * w) / a) + ETA * VP
    r2 = (y + 50) ** 2 + (z + 50) ** 2
    with np.errstate(divide="ignore", over="ignore"):
        shape = np.where(r2 < 150.0**2, np.exp(np.minimum(r2 / (r2 - 150.0**2), 0)), 0)
    stations = [(0, 0), (-50, -50), (0, 100), (100, 0), (0, 300)]
    return dict(h=h, y=y, z=z, a=a, b=b, L=L, sigma=sigma, tau=tau, w=w, stations=stations, pulse=1.75e6 * shape)


def grid(h, ny, nz):
    return np.meshgrid(h * (np.arange(ny) - (ny - 1) / 2), h * (np.arange(nz) - (nz - 1) / 2), indexing="ij")


def asinh_of(log):
    """asinh(exp(log))."""
    return np.where(log > 20, log + np.log(2), np.arcsinh(np.exp(np.minimum(log, 20))))


def rate(tau, psi, a, sigma, guess):
    """Slip rates of the size of tractions tau at psi = F0 + b w: tau = sigma a asinh(V/(2 V0) exp(psi/a)) + eta V."""
    u = guess
    for _ in range(60):
        log = u - np.log(2 * V0) + psi / a
        friction, slope = sigma * a * asinh_of(log), sigma * a / np.sqrt(1 + np.exp(np.minimum(-2 * log, 600)))
        v = np.exp(u)
        step = np.clip((tau - friction - ETA * v) / (slope + ETA * v), -3, 3)
        u = u + step
        if np.max(np.abs(step)) < 1e-13:
            break
    return u


def growth(t):
    """Rate of exp((t - 1)^2/(t (t - 2))) for 0 < t < 1."""
    if not 2e-3 < t < 1:
        return 0.0
    q = t * (t - 2)
    return np.exp((t - 1) ** 2 / q) * (-2 * (t - 1)) / q**2


class Cycles:
    def __init__(self, p):
        self.p, self.shape, self.n = p, p["a"].shape, p["a"].size
        self.operator = Operator(p["h"], *self.shape)
        self.guess = np.full(self.shape, np.log(VP))

    def start(self):
        p = self.p
        return np.concatenate([np.zeros(self.n), p["tau"].ravel(), p["w"].ravel(), np.zeros(2 * self.n)])

    def parts(self, y):
        return [part.reshape(self.shape) for part in y.reshape(5, self.n)]

    def rates(self, y):
        p = self.p
        ty, tz, w, _, _ = self.parts(y)
        size = np.hypot(ty, tz)
        self.guess = rate(size, F0 + p["b"] * w, p["a"], p["sigma"], self.guess)
        v = np.exp(self.guess)
        return v, v * ty / size, v * tz / size

    def __call__(self, t, y):
        p = self.p
        w = self.parts(y)[2]
        v, vy, vz = self.rates(y)
        ty, tz = self.operator(vy, vz - VP)
        if p["pulse"] is not None:
            tz = tz + growth(t) * p["pulse"]
        theta = p["L"] / V0 * np.exp(w)
        return np.concatenate([x.ravel() for x in (ty, tz, 1 / theta - v / p["L"], vy, vz)])


def run(p, years, most, tolerance):
    cycles = Cycles(p)
    a = p["a"].ravel()
    atol = tolerance * np.concatenate([a * p["sigma"], a * p["sigma"], a / p["b"], np.full(2 * cycles.n, p["L"])])
    at = [np.argmin(np.hypot(p["y"] - y, p["z"] - z)) for y, z in p["stations"]]
    t, y, events, slow, since = 0.0, cycles.start(), [], True, time.time()
    ends = [1.0, years * YEAR] if p["pulse"] is not None else [years * YEAR]
    steps, step = 0, 1e-3
    before = (t, np.log(cycles.rates(y)[0].max()))
    if before[1] > np.log(ABOVE):
        events.append(dict(onset=0.0))
        slow = False
    for end in ends:
        solver = RK45(cycles, t, y, end, rtol=1e-13, atol=atol, first_step=min(step, (end - t) / 2))
        while solver.status == "running":
            solver.step()
            steps += 1
            now = (solver.t, np.log(cycles.rates(solver.y)[0].max()))
            cross = lambda limit: before[0] + (np.log(limit) - before[1]) / (now[1] - before[1]) * (now[0] - before[0])
            if events and not slow:
                events[-1]["largest"] = max(events[-1].get("largest", 0), float(np.exp(now[1])))
            if slow and now[1] >= np.log(ABOVE):
                events.append(dict(onset=float(cross(ABOVE)), largest=float(np.exp(now[1]))))
                slow = False
            elif not slow and now[1] < np.log(BELOW):
                sy, sz = cycles.parts(solver.y)[3:]
                events[-1].update(end=float(cross(BELOW)), slip=[[float(s.ravel()[k]) for s in (sy, sz)] for k in at])
                slow = True
                print(len(events), events[-1], steps, round(time.time() - since), flush=True)
                if len(events) == most:
                    return events, steps
            before = now
        t, y, step = solver.t, solver.y, solver.h_abs if end > 1 else 1e-3
    return events, steps


def main():
    check()
    problem, h, years, most = sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4])
    tolerance = float(sys.argv[5]) if len(sys.argv) > 5 else 1e-5
    kind, _, value = problem.partition(":")
    p = {"bp4": bp4, "bp7": bp7}[kind](h, *([float(value)] if value else []))
    began = time.time()
    events, steps = run(p, years, most, tolerance)
    row = dict(problem=problem, tolerance=tolerance, steps=steps, seconds=round(time.time() - began))
    row["cell [m]"], row["events [s, m/s, m]"] = h, events
    path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "cycles_in_space.json")
    rows = json.load(open(path)) if os.path.exists(path) else []
    same = lambda r: (r["problem"], r["cell [m]"], r["tolerance"]) == (problem, h, tolerance)
    rows = [r for r in rows if not same(r)] + [row]
    json.dump(rows, open(path, "w"), indent=1)


if __name__ == "__main__":
    main()
