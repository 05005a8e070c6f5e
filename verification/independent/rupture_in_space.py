"""Dynamic rupture of a planar fault in a whole space in three dimensions by a spectral boundary integral, independent of the Rust code.

    python rupture_in_space.py                          # the checks, then TPV3 on cells of 150, 75 and 37.5 m: 15 minutes and 4 GiB
    python rupture_in_space.py checks | tpv3[:CELL,CELL,CELL] ...

Results replace those of the same name in rupture_in_space.json.

Problem. TPV3 of the community (SCEC/USGS): the fault is the rectangle |x| < 15 km, |z| < 7.5 km of the plane y = 0, with slip along x at the start.
Linear slip weakening; traction is higher in a square of 3 km in the middle. Beyond the rectangle nothing slips. Slip may turn: friction is opposite to
the slip rate, whose magnitude weakens it.

Equations (Geubelle and Rice 1995; Breitenfeld and Geubelle 1998). For every wave vector (k, m), q = sqrt(k^2 + m^2), slip is split into the part along
the wave vector, which obeys the equation of plane strain with wavenumber q, and the part across it, which obeys that of antiplane motion:

    f(q, t) = -(mu q/2) [ W(0) D(q, t) - integral from 0 to t of W(T) V(q, t') dt' ],    T = q cs (t - t'),    traction = tau0 + f - mu V/(2 cs).

W of both modes, its compression to exponentials and the filters are those of dynamic_rupture.py, where they are checked on their own. The normal
traction does not change, by symmetry.

Vx is even in x and in z, and Vz is odd in both: a quarter of the plane is computed, with cosine and sine transforms. Points lie at middles of cells.
The fault is repeated every 55.8 km along x and 48 km along z. No wave from a repetition reaches it within 6.5 s: a P wave from the border of the next
square of high traction takes 6.5 s to the end of the fault. Steps in time have two stages, as in dynamic_rupture.py.

Layout of the json. `versions`; `checks`; `tpv3`:
    parameters    numbers that define the problem, SI units
    cells_m, steps_s   grids, coarse to fine; `costs_s` of processor time
    x_m, z_m      places of rupture times, which are rows along x, one for each z
    rupture_s     by threshold of slip rate [m/s] ("0.001", "0.1"): `finest`, `extrapolated` to no cell size, `uncertainty`; null at the border of the
                  square of high traction, where times jump, and at the ends of the fault. `order`, that of the extrapolation; `change`, largest
                  |difference| of consecutive grids
    stations      list of {at_m, slip_m, rate_m_s, across_m_s}: slip and slip rate along x, and slip rate along z if it is not zero by symmetry; every
                  0.05 s on the finest grid
    history_change  of the slip rates of stations, root mean square of the difference of the finest and the next grid
    turning       largest |slip along z| over the slip along x where that exceeds a tenth of its largest value, at the end
Values between points are bilinear.
"""

import json
import platform
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import scipy
from scipy import fft, integrate, special

from dynamic_rupture import CP, CS, ETA, KAPPA, MU, RHO, STATIC, dump, exponentials, extrapolate, largest, rounded, transfer

HALF, END, SAMPLE = (27.9e3, 24e3), 6.5, 0.05
STEPS = {300.0: 2, 150.0: 4, 75.0: 8, 37.5: 16}  # steps in 0.05 s
TPV3 = {"sigma_pa": 120e6, "tau0_pa": 70e6, "mu_s": 0.677, "mu_d": 0.525, "d_c_m": 0.40, "half_x_m": 15e3, "half_z_m": 7.5e3,
        "square_half_m": 1.5e3, "square_tau0_pa": 81.6e6}
STATIONS = [(0.0, 0.0), (7.5e3, 0.0), (0.0, 6e3), (9e3, 4.5e3)]
THRESHOLDS = [1e-3, 0.1]
OUT = Path(__file__).with_suffix(".json")


# ---------------------------------------------------------------- elasticity


class Mode:
    """Filters of one mode for wavenumbers q: what the history of V adds to W * V, for V linear in each step of dt."""

    def __init__(self, mode, q, dt, end):
        nodes, c, self.error = exponentials(mode, q.max() * CS * end)
        self.static = STATIC[mode]
        self.decay, self.drive, self.now = [], [], np.zeros(q.shape)
        for node, coefficient in zip(nodes, c):
            a = q * CS * dt * node
            small = np.abs(a) < 0.3
            safe = np.where(small, 1, a)
            e = np.exp(a)
            phi1 = np.where(small, sum(a**j / special.factorial(j + 1) for j in range(14)), (e - 1) / safe)
            phi2 = np.where(small, sum(a**j / special.factorial(j + 2) for j in range(14)), (e - 1 - a) / safe**2)
            weight = 2 * coefficient * dt
            self.decay.append(e)
            self.drive.append(weight * (e * phi2 + phi1 - phi2))
            self.now += (weight * phi2).real
        self.nodes, self.c, self.q, self.dt = nodes, c, q, dt

    def start(self, rate):
        """Filters at the end of the first step, but for the rate there."""
        self.slip, self.rate, self.filters, self.past = np.zeros_like(rate), rate, [], np.zeros_like(rate)
        for node, coefficient, e in zip(self.nodes, self.c, self.decay):
            a = self.q * CS * self.dt * node
            small = np.abs(a) < 0.3
            safe = np.where(small, 1, a)
            phi1 = np.where(small, sum(a**j / special.factorial(j + 1) for j in range(14)), (e - 1) / safe)
            phi2 = np.where(small, sum(a**j / special.factorial(j + 2) for j in range(14)), (e - 1 - a) / safe**2)
            self.filters.append(2 * coefficient * self.dt * (phi1 - phi2) * rate)
            self.past += self.filters[-1].real

    def force(self, end):
        """Force per mu q/2 at the end of the step if V goes linearly to `end` there."""
        return self.past + self.now * end - self.static * (self.slip + self.dt / 2 * (self.rate + end))

    def advance(self, guess, rate):
        self.slip += self.dt / 2 * (self.rate + guess)
        self.rate = rate
        self.past = np.zeros_like(rate)
        for state, decay, drive in zip(self.filters, self.decay, self.drive):
            state *= decay
            state += drive * rate
            self.past += state.real


class Elasticity:
    """Tractions f from the history of (Vx, Vz) at the points of a quarter of the plane, in steps of dt."""

    def __init__(self, shape, cell, dt, end):
        k, m = (np.pi / (n * cell) * np.arange(n) for n in shape)
        self.k, self.m = np.meshgrid(k, m, indexing="ij")
        self.q = np.hypot(self.k, self.m)
        safe = np.where(self.q > 0, self.q, 1)
        self.along, self.across = self.k / safe, self.m / safe
        self.modes = [Mode(mode, self.q, dt, end) for mode in ("II", "III")]
        self.stiff = MU * self.q / 2
        self.pool = ThreadPoolExecutor(2)

    def both(self, work):
        return list(self.pool.map(work, range(2)))

    def split(self, v):
        """Amplitudes of both modes: Vx is a sum of a cos(k x) cos(m z), Vz of b sin(k x) sin(m z). Of the wave vectors (+-k, +-m) all have the part
        (k a - m b)/q along themselves, but for a sign, and (m a + k b)/q across."""
        a = fft.dctn(v[0], type=2, norm="ortho")
        b = np.zeros_like(a)
        b[1:, 1:] = fft.dstn(v[1], type=2, norm="ortho")[:-1, :-1]
        return [self.along * a - self.across * b, self.across * a + self.along * b]

    def join(self, parts):
        p, r = (self.stiff * part for part in parts)
        b = np.zeros_like(p)
        b[:-1, :-1] = (self.along * r - self.across * p)[1:, 1:]
        return np.stack([fft.idctn(self.along * p + self.across * r, type=2, norm="ortho"), fft.idstn(b, type=2, norm="ortho")])

    def start(self, rate):
        parts = self.split(rate)
        self.both(lambda i: self.modes[i].start(parts[i]))

    def force(self, guess):
        self.guess = self.split(guess)
        return self.join([mode.force(part) for mode, part in zip(self.modes, self.guess)])

    def advance(self, rate):
        """Ends the step: slip by the trapezium with the guess of the last `force`, and `rate` as its V."""
        parts = self.split(rate)
        self.both(lambda i: self.modes[i].advance(self.guess[i], parts[i]))


# ---------------------------------------------------------------- friction


class SlipWeakening:
    """Strength sigma [mu_s - (mu_s - mu_d) min(D/d_c, 1)] within the fault, where D is the length of the path of slip; no slip beyond."""

    def __init__(self, x, z, p):
        self.p, self.active = p, (x < p["half_x_m"]) & (z < p["half_z_m"])
        inside = (x < p["square_half_m"]) & (z < p["square_half_m"])
        self.load = np.stack([np.where(inside, p["square_tau0_pa"], p["tau0_pa"]), 0 * x])

    def strength(self, path):
        p = self.p
        return p["sigma_pa"] * (p["mu_s"] - (p["mu_s"] - p["mu_d"]) * np.minimum(path / p["d_c_m"], 1))

    def solve(self, force, path, t):
        load = self.load + force
        size = np.hypot(*load)
        self.signed = np.where(self.active, (size - self.strength(path)) / ETA, -1.0)
        return np.maximum(self.signed, 0) * load / np.maximum(size, 1e-300)


class GrowingCircle:
    """Traction along x `drop` below the initial one, along z unchanged, where r < speed t; for the checks."""

    def __init__(self, x, z, drop, speed, start):
        self.r, self.drop, self.speed, self.first = np.hypot(x, z), np.stack([0 * x + drop, 0 * x]), speed, start

    def solve(self, force, path, t):
        return np.where(self.r < self.first + self.speed * t, (force + self.drop) / ETA, 0)


def march(law, elasticity, shape, dt, steps, look):
    """Integrates; look(step, slip, rate) is called at t = 0 and after each step."""
    nothing = np.zeros((2, *shape))
    path, slip = np.zeros(shape), nothing.copy()
    rate = law.solve(nothing, path, 0.0)
    elasticity.start(rate)
    look(0, slip, rate)
    for i in range(1, steps + 1):
        guess = law.solve(elasticity.force(rate), path + dt * np.hypot(*rate), i * dt)
        path = path + dt / 2 * (np.hypot(*rate) + np.hypot(*guess))
        slip = slip + dt / 2 * (rate + guess)
        rate = law.solve(elasticity.force(guess), path, i * dt)
        elasticity.advance(rate)
        look(i, slip, rate)


def grid(shape, cell):
    return np.meshgrid(*((np.arange(n) + 0.5) * cell for n in shape), indexing="ij")


def at(values, cell, x, z, odd=False):
    """Bilinear values at places of the quarter, whose mirror images have the same value, or the opposite."""
    def index(u):
        i = u / cell - 0.5
        low = int(np.floor(i))
        return low, i - low

    (i, s), (j, t) = index(x), index(z)

    def one(i, j):
        sign = (-1 if i < 0 else 1) * (-1 if j < 0 else 1) if odd else 1
        return sign * values[max(i, -1 - i), max(j, -1 - j)]

    # A place at the middle of a cell has its value alone, whatever lies beyond.
    corners = [((1 - s) * (1 - t), i, j), (s * (1 - t), i + 1, j), ((1 - s) * t, i, j + 1), (s * t, i + 1, j + 1)]
    return float(sum(w * one(i, j) for w, i, j in corners if w > 0))


# ---------------------------------------------------------------- TPV3


def run(p, cell, shape=None, end=END, stations=STATIONS):
    """One grid: rupture times as arrays, histories at the stations, slip at the end. `shape` is that of the quarter in cells."""
    shape = shape or tuple(round(half / cell) for half in HALF)
    x, z = grid(shape, cell)
    law, per = SlipWeakening(x, z, p), STEPS[cell]
    dt, steps = SAMPLE / per, round(end / SAMPLE) * per
    clock = time.process_time()
    elasticity = Elasticity(shape, cell, dt, end)
    times = {v: np.full(shape, np.nan) for v in THRESHOLDS}
    before, histories, last = None, [], None

    def look(i, slip, rate):
        nonlocal before, last
        size = np.hypot(*rate)
        for v, found in times.items():
            new = np.isnan(found) & (size >= v)
            if new.any():
                # A point that sticks has a negative rate before, so that its start is found between two steps.
                found[new] = 0 if i == 0 else (i - (size[new] - v) / (size[new] - before[new])) * dt
        before = law.signed
        if i % per == 0:
            histories.append([[at(slip[0], cell, *s), at(rate[0], cell, *s), at(rate[1], cell, *s, odd=True)] for s in stations])
        last = slip

    march(law, elasticity, shape, dt, steps, look)
    cost = time.process_time() - clock
    errors = [m.error for m in elasticity.modes]
    print(f"cells of {cell} m: {shape}, {steps} steps, kernels {max(errors):.1e}, {cost:.0f} s", flush=True)
    near = last[0] > 0.1 * last[0].max()
    return {"times": times, "cell": cell, "step": dt, "histories": np.array(histories), "cost": cost,
            "turning": float(np.abs(last[1][near] / last[0][near]).max())}


def reported(result, v, xs, zs, p):
    """Rupture times at the places of the json."""
    a = p["square_half_m"]

    def one(x, z):
        border = (x == a and z <= a) or (z == a and x <= a) or x == p["half_x_m"] or z == p["half_z_m"]
        return np.nan if border else at(result["times"][v], result["cell"], x, z)

    return np.array([[one(x, z) for x in xs] for z in zs])


def tpv3(cells):
    p = TPV3
    xs, zs = np.arange(0, p["half_x_m"], 500.0), np.arange(0, p["half_z_m"], 500.0)
    runs = [run(p, cell) for cell in cells]
    rupture = {}
    for v in THRESHOLDS:
        grids = [reported(r, v, xs, zs, p) for r in runs]
        limit, error, order = extrapolate(grids)
        rupture[str(v)] = {"finest": rounded(grids[-1], 6), "extrapolated": rounded(limit, 6), "uncertainty": rounded(error, 2),
                           "order": rounded(order, 3), "change": [largest((b - a).ravel()) for a, b in zip(grids[:-1], grids[1:])]}
    fine, next_ = runs[-1]["histories"], runs[-2]["histories"]
    stations = []
    for j, place in enumerate(STATIONS):
        one = {"at_m": list(place), "slip_m": rounded(fine[:, j, 0], 4), "rate_m_s": rounded(fine[:, j, 1], 4)}
        if place[0] * place[1] != 0:
            one["across_m_s"] = rounded(fine[:, j, 2], 4)
        stations.append(one)
    change = np.sqrt(((fine - next_)[:, :, 1] ** 2).mean(0))
    return {"parameters": {"rho_kg_m3": RHO, "cp_m_s": CP, "cs_m_s": CS, "end_s": END, "half_period_m": list(HALF), **p}, "cells_m": cells,
            "steps_s": rounded([r["step"] for r in runs]), "costs_s": rounded([r["cost"] for r in runs], 3), "x_m": xs.tolist(), "z_m": zs.tolist(),
            "rupture_s": rupture, "stations": stations, "history_change": rounded(change, 2), "turning": rounded(runs[-1]["turning"], 3)}


# ---------------------------------------------------------------- checks


def section(mode, cell):
    """Largest difference of rupture times (0.1 m/s) [s] from those of dynamic_rupture.py on the same cells, of a fault that is infinite in one direction.

    In plane strain nothing depends on z, in antiplane motion nothing on x."""
    import dynamic_rupture as section

    n = round(48e3 / cell)
    p = dict(TPV3, **({"half_z_m": np.inf} if mode == "II" else {"half_x_m": np.inf, "half_z_m": 15e3}))
    shape = (n, 4) if mode == "II" else (4, n)

    class Strip(SlipWeakening):
        def __init__(self, x, z, p):
            super().__init__(x, z, p)
            along = x if mode == "II" else z
            self.load[0] = np.where(along < p["square_half_m"], p["square_tau0_pa"], p["tau0_pa"])

    x, z = grid(shape, cell)
    per = STEPS[cell]
    dt, steps = SAMPLE / per, round(END / SAMPLE) * per
    law, found, before = Strip(x, z, p), np.full(shape, np.nan), None

    def look(i, slip, rate):
        nonlocal before
        size = np.hypot(*rate)
        new = np.isnan(found) & (size >= 0.1)
        if new.any():
            found[new] = 0 if i == 0 else (i - (size[new] - 0.1) / (size[new] - before[new])) * dt
        before = law.signed

    march(law, Elasticity(shape, cell, dt, END), shape, dt, steps, look)
    section.STEP[cell] = per
    line = section.run("tpv3", mode, cell)
    places = [v for v in line["x"] if v < 14.5e3]
    ours = [at(found, cell, *((v, cell / 2) if mode == "II" else (cell / 2, v))) for v in places]
    rest = np.array(ours) - line["rupture"][0.1][: len(places)]
    return float(np.nanmax(np.abs(rest)))


def circle_factor(speed):
    """C in slip = C (drop/mu) sqrt(speed^2 t^2 - r^2) of a circular shear crack that grows from a point with a constant stress drop (Kostrov 1964).

    The transform of the slip is 4 pi v^3 C/(s^2 + q^2 v^2)^2. Traction at the middle is its integral with -(mu q/2) G, where G is the mean of both
    modes over all directions; with q v/s = tan(a) it is -mu C times the integral of sin(a)^2 G(v cot(a)/cs) over 0 < a < pi/2."""

    def integrand(a):
        s = speed / CS / np.tan(a)
        g = [STATIC[m] if s < 1e-4 else transfer(m, np.sqrt(1 + s**2), np.sqrt(1 + (s / KAPPA) ** 2), s) for m in STATIC]
        return np.sin(a) ** 2 * sum(g) / 2

    return 1 / integrate.quad(integrand, 1e-9, np.pi / 2, epsrel=1e-10)[0]


def circle(cell, share):
    """Relative error of slip, root mean square over r < 0.9 v t, when v t = 9 km; and the largest slip across, over the largest along."""
    speed, radius = share * CS, 9e3
    shape, dt = (round(24e3 / cell),) * 2, SAMPLE / STEPS[cell]
    steps = round(radius / speed / dt)
    x, z = grid(shape, cell)
    last = None

    def look(i, slip, rate):
        nonlocal last
        last = slip

    march(GrowingCircle(x, z, 1e6, speed, 0.0), Elasticity(shape, cell, dt, steps * dt), shape, dt, steps, look)
    r, reached = np.hypot(x, z), speed * steps * dt
    near = r < 0.9 * reached
    exact = circle_factor(speed) * 1e6 / MU * np.sqrt(reached**2 - r[near] ** 2)
    return float(np.sqrt(np.mean((last[0][near] / exact - 1) ** 2))), float(np.abs(last[1]).max() / last[0].max())


def checks():
    """Faults without variation in one direction against dynamic_rupture.py; a circular crack against its closed form, by cell size."""
    # A slow circle is that of Eshelby (1957) for Poisson's ratio 1/4, but for cp/cs = 1.7321 here.
    assert abs(circle_factor(1e-7 * CS) - 24 / (7 * np.pi)) < 1e-4
    out = {"section": {}, "circle": {}}
    for mode in STATIC:
        out["section"][mode] = {"cell_m": 150.0, "difference_s": rounded(section(mode, 150.0), 2)}
        assert out["section"][mode]["difference_s"] < 1e-6
    for share in (0.5, 0.8):
        errors, across = zip(*[circle(cell, share) for cell in (300.0, 150.0, 75.0)])
        out["circle"][str(share)] = {"factor": rounded(circle_factor(share * CS), 8), "cells_m": [300.0, 150.0, 75.0],
                                     "slip_error": rounded(errors, 3), "slip_across": rounded(across, 2)}
        assert errors[-1] < 0.01 and across[-1] < 0.02
    print(json.dumps(out, indent=1))
    return out


def main(words):
    results = json.loads(OUT.read_text()) if OUT.exists() else {}
    for word in words or ["checks", "tpv3"]:
        name, *cells = word.split(":")
        if name == "checks":
            results["checks"] = checks()
        else:
            results["tpv3"] = tpv3([float(c) for c in cells[0].split(",")] if cells else [150.0, 75.0, 37.5])
        results["versions"] = {"python": platform.python_version(), "numpy": np.__version__, "scipy": scipy.__version__,
                               "date": time.strftime("%Y-%m-%d")}
        OUT.write_text(dump(results, 0) + "\n")


if __name__ == "__main__":
    main(sys.argv[1:])
