"""Dynamic rupture of a planar fault in a whole space by a spectral boundary integral, independent of the Rust code.

    python dynamic_rupture.py                  # the analytic checks, then every problem on every grid: about half an hour
    python dynamic_rupture.py checks | PROBLEM[:MODE[:CELL,CELL,...]] ...

PROBLEM is tpv205, tpv3, tpv101, tpv101_locked or tpv104; MODE is III (antiplane) or II (plane strain, slip along x). Results replace those of the same
name in dynamic_rupture.json.

Equations (Geubelle and Rice 1995; Breitenfeld and Geubelle 1998; Lapusta et al. 2000). Slip D and slip rate V of one side relative to the other;
traction tau = tau0 + f - mu V/(2 cs); per wavenumber k, with T = k cs (t - t'),

    f(k, t) = -(mu k/2) [ W(0) D(k, t) - integral from 0 to t of W(T) V(k, t') dt' ],    W(T) = integral from T to infinity of C,

where C is the inverse Laplace transform of G(s) - s and G that of the half-spaces, r_s = sqrt(1 + s^2), r_d = sqrt(1 + (s cs/cp)^2):
    antiplane      G = r_s                                          C = J1(T)/T,  W(0) = 1
    plane strain   G = [(1 + r_s^2)^2 - 4 r_s r_d]/(r_s s^2)        W(0) = 2 (1 - (cs/cp)^2) = 1/(1 - nu)
Plane strain is derived from Lame potentials with no normal traction on the plane, which symmetry asks for. `closed_form` has W by Bessel functions.

Convolution is over all of the history. W is written as the integral of exp(s T) along cuts between the branch points, which agrees with `closed_form`
to 1e-8 for T < 300, and is compressed to 31 to 69 terms, which differ from it by less than 2e-9. Each term is a linear filter, integrated exactly for V
linear in each step.

Steps in time have two stages, so are of order two: forces and state with V constant over the step give V*, with V linear from V to V* the result.
Points lie at middles of cells: borders of stress patches and ends of faults at borders of cells. The line is repeated every 96 km, and no wave from
a repetition reaches |x| <= 18 km within 12 s. (A P wave from 3 km, the end of the pulses, takes 12.5 s to 18 km of the next.)

Layout of the json. `versions`; `checks` (see `checks` below); `problems`, by name and mode such as "tpv205_III":
    parameters        numbers and words that define the problem, SI units
    cells_m, steps_s  grids, coarse to fine
    x_m               places of rupture times and of slip at the end; x >= 0 alone where the problem is even in x
    rupture_s         by threshold of slip rate [m/s] ("0.001", "0.1"): `finest`, `extrapolated` to no cell size, `uncertainty`, one number per x_m, null
                      where the threshold is not passed and where a patch of initial traction ends, as they jump there; `order`, that of the
                      extrapolation; `change`, largest |difference| of consecutive grids
    slip_end          `finest` and `uncertainty` [m] per x_m, at the last time
    stations          list of {x_m, slip_m, rate_m_s, traction_mpa, state, peak_rate_m_s, peak_uncertainty}: histories on the finest grid, at times
                      0, 0.05, 0.1, ... s; state is log10(theta/s) (ageing) or psi (flash heating), absent otherwise; peak_rate_m_s by grid
    history_change    largest |difference| of the histories, finest against next grid: `slip_m`, root mean square of `rate_m_s`, of `traction_mpa`
    peak_rate_m_s     largest slip rate of all places and times, by grid
    sensitivity       largest change of rupture times (0.001 m/s) [s] on the second coarsest grid: `half_step`, and `double_length` of repetition
Values between points are linear between neighbours (of a rupture time, 1e-5 s).
"""

import json
import platform
import sys
import time
from pathlib import Path

import numpy as np
import scipy
import scipy.integrate
from scipy import special
from scipy.linalg import qr

RHO, CP, CS = 2670.0, 6000.0, 3464.0
MU, KAPPA = RHO * CS**2, CP / CS
ETA = MU / (2 * CS)
LENGTH, END, SAMPLE = 96e3, 12.0, 0.05
STEP = {100.0: 6, 50.0: 12, 25.0: 24, 12.5: 48, 6.25: 96}  # steps in 0.05 s
STATIC = {"III": 1.0, "II": 2 * (1 - 1 / KAPPA**2)}
V0, F0 = 1e-6, 0.6
OUT = Path(__file__).with_suffix(".json")


# ---------------------------------------------------------------- kernels


def closed_form(mode, t):
    """W(T) by Bessel functions and their integrals, in which terms of size T^2 cancel."""

    def j0_integral(x):
        j0, j1 = special.j0(x), special.j1(x)
        return x * j0 + np.pi * x / 2 * (j1 * special.struve(0, x) - j0 * special.struve(1, x))

    def antiplane(x):
        return 1 - j0_integral(x) + special.j1(x)

    def moment(a):  # of x W_III(a x) from 0 to t
        return t**2 / 2 * antiplane(a * t) + (j0_integral(a * t) / a - t * special.j0(a * t)) / (2 * a)

    if mode == "III":
        return antiplane(t)
    c = 1 - antiplane(t) + 4 * (moment(KAPPA) - moment(1.0)) - 4 / KAPPA**2 * j0_integral(KAPPA * t) + 3 * j0_integral(t)
    return STATIC["II"] - c


def transfer(mode, rs, rd, s):
    return rs if mode == "III" else ((1 + rs**2) ** 2 - 4 * rs * rd) / (rs * s**2)


def root(s, c):
    """sqrt(1 + (s/c)^2), which grows like s/c, with its cut on the straight line between the branch points."""
    return s / c * np.sqrt(1 + (c / s) ** 2)


def cut_integral(mode, t_max):
    """Exponents and weights of W(T) = 2 Re sum c exp(lambda T) for T <= t_max: integral along cuts moved into Re s < 0, upper half.

    A cut starts at i b, runs to i b - R, and down to -R. Pieces shrink geometrically towards the branch point; Gauss-Legendre on each. The cut of r_d
    (b = cp/cs) is outside that of r_s (b = 1), so that on the latter r_d has its value near s = 0, where the double pole of G cancels."""
    gauss, weights = np.polynomial.legendre.leggauss(12)
    nodes, coefficients = [], []
    for b, reach in [(1.0, 2.0)] + ([(KAPPA, 4.0)] if mode == "II" else []):
        y = np.concatenate([[0.0], np.geomspace(1e-3 / t_max, reach, int(np.log2(reach * t_max / 1e-3)) + 2)])
        corners = np.concatenate([1j * b - y, -reach + 1j * np.linspace(b, 0, 4)[1:]])
        for i, (p, q) in enumerate(zip(corners[:-1], corners[1:])):
            u = (gauss + 1) / 2
            # A root begins at the first piece: substitute its square.
            s, w = (p + (q - p) * u**2, (q - p) * u * weights) if i == 0 else (p + (q - p) * u, (q - p) * weights / 2)
            rs, rd = root(s, 1.0), root(s, KAPPA)
            if b == 1.0:
                jump = transfer(mode, rs, -rd, s) - transfer(mode, -rs, -rd, s)
            else:
                jump = transfer(mode, rs, rd, s) - transfer(mode, rs, -rd, s)
            nodes.append(s)
            coefficients.append(-jump / s * w / (2j * np.pi))
    return np.concatenate(nodes), np.concatenate(coefficients)


def evaluate(t, nodes, coefficients):
    return 2 * np.real(np.exp(np.multiply.outer(t, nodes)) @ coefficients)


def exponentials(mode, t_max):
    """The same with few terms: exponents chosen by QR with pivots, weights by least squares. Returns them and the largest error found between."""
    nodes, coefficients = cut_integral(mode, t_max)
    t = np.concatenate([[0], np.geomspace(1e-3, 1, 60), np.linspace(1, 40, 500), np.geomspace(40, max(t_max, 50), 1500)])
    _, r, order = qr(np.exp(np.multiply.outer(t, nodes)), mode="economic", pivoting=True)
    size = np.abs(np.diag(r))
    few = nodes[order[: int((size > 1e-8 * size[0]).sum())]]
    a = np.exp(np.multiply.outer(t, few))
    x, *_ = np.linalg.lstsq(np.hstack([2 * a.real, -2 * a.imag]), evaluate(t, nodes, coefficients), rcond=1e-13)
    c = x[: len(few)] + 1j * x[len(few) :]
    between = np.concatenate([np.linspace(0, 50, 1501), np.geomspace(50, max(t_max, 50), 2001)])
    return few, c, np.abs(evaluate(between, few, c) - evaluate(between, nodes, coefficients)).max()


class Elasticity:
    """Tractions f from the history of V at n points `cell` apart, in steps of dt; real and imaginary parts of modes are filtered apart."""

    def __init__(self, mode, n, cell, dt, end):
        self.n, self.dt = n, dt
        k = 2 * np.pi * np.fft.rfftfreq(n, cell)
        nodes, c, self.kernel_error = exponentials(mode, k[-1] * CS * end)
        a = np.multiply.outer(k * CS * dt, nodes)
        small = np.abs(a) < 0.3
        safe = np.where(small, 1, a)
        e = np.exp(a)
        phi1 = np.where(small, sum(a**j / special.factorial(j + 1) for j in range(14)), (e - 1) / safe)
        phi2 = np.where(small, sum(a**j / special.factorial(j + 2) for j in range(14)), (e - 1 - a) / safe**2)
        weight = 2 * c * dt
        self.decay, self.drive, self.first = e, weight * (e * phi2 + phi1 - phi2), weight * (phi1 - phi2)
        self.now = (weight * phi2).sum(1).real
        self.stiff, self.static = -MU * k / 2, STATIC[mode]

    def start(self, slip, rate):
        """Sets slip and rate at t = 0. `filters` holds what the history adds at the end of the next step with V linear, but for V at the end."""
        self.slip, self.rate = np.fft.rfft(slip), np.fft.rfft(rate)
        parts = np.stack([self.rate.real, self.rate.imag])
        self.filters = self.first * parts[:, :, None]
        self.collect()

    def collect(self):
        past = self.filters.real.sum(2)
        self.past = past[0] + 1j * past[1]

    def force(self, guess):
        """f at the end of the step if V goes linearly to `guess` there."""
        end = np.fft.rfft(guess)
        slip = self.slip + self.dt / 2 * (self.rate + end)
        return np.fft.irfft(self.stiff * (self.static * slip - self.past - self.now * end), self.n)

    def advance(self, guess, rate):
        """Ends the step: slip by the trapezium with `guess`, as in the last `force`, and `rate` as its V."""
        self.slip += self.dt / 2 * (self.rate + np.fft.rfft(guess))
        self.rate = np.fft.rfft(rate)
        self.filters *= self.decay
        self.filters += self.drive * np.stack([self.rate.real, self.rate.imag])[:, :, None]
        self.collect()


# ---------------------------------------------------------------- friction: V >= 0 with tau = load - ETA V


class SlipWeakening:
    """Strength sigma [mu_s - (mu_s - mu_d) min(D/d_c, 1)] on |x| <= half, no slip beyond."""

    def __init__(self, x, p):
        self.p, self.active, self.load = p, np.abs(x) < p["half_length_m"], np.full(len(x), p["tau0_pa"])
        for patch in p["patches"]:
            self.load[np.abs(x - patch["centre_m"]) < patch["half_width_m"]] = patch["tau0_pa"]
        self.state = None

    def start(self):
        return self.solve(self.load, 0 * self.load, None)[0]

    def evolve(self, rate, dt):
        return None

    def back(self, v, before, rate):
        """Share of the step since V passed v. A point that sticks has a negative rate before, so that its start is found between two steps."""
        return (rate - v) / (rate - before)

    def solve(self, load, slip, state):
        p = self.p
        strength = p["sigma_pa"] * (p["mu_s"] - (p["mu_s"] - p["mu_d"]) * np.minimum(slip / p["d_c_m"], 1))
        self.signed = np.where(self.active, (load - strength) / ETA, -1.0)
        rate = np.maximum(self.signed, 0)
        return rate, load - ETA * rate

    def pulse(self, t):
        return 0.0

    def residual(self, slip, rate, traction, state):
        """Largest traction above strength, or off it where the fault slips, on the fault. Slip that goes back is none of this law."""
        p = self.p
        strength = p["sigma_pa"] * (p["mu_s"] - (p["mu_s"] - p["mu_d"]) * np.clip(slip / p["d_c_m"], 0, 1))
        off = np.where(rate > 0, np.abs(traction - strength), np.maximum(np.abs(traction) - strength, 0))
        return off[self.active].max()


def smooth_step(x, p):
    """B: 1 for |x| <= W, 0 from W + w on, smooth between."""
    width, layer = p["W_m"], p["w_m"]
    d = np.abs(x) - width
    inside = (d > 0) & (d < layer)
    s = np.where(inside, d, layer / 2)
    return np.where(d <= 0, 1.0, np.where(inside, (1 + np.tanh(layer / (s - layer) + layer / s)) / 2, 0.0))


class RateState:
    """tau = sigma a asinh(V/(2 V0) exp(psi/a)); ageing: psi = f0 + b ln(V0 theta/L), theta' = 1 - V theta/L.

    Flash heating: psi' = -(V/L) (psi - psi_ss), psi_ss = a ln[(2 V0/V) sinh(f_ss/a)], f_ss = f_w + (f_LV - f_w)/(1 + (V/V_w)^8)^(1/8),
    f_LV = f0 - (b - a) ln(V/V0). At the start V is V_ini and tau is tau0 everywhere, which gives psi."""

    def __init__(self, x, p):
        self.p, outside = p, 1 - smooth_step(x, p)
        self.active = np.abs(x) < p.get("half_length_m", np.inf)
        self.a = p["a"] + p["delta_a"] * outside
        self.flash = "f_w" in p
        self.v_w = p["v_w_m_s"] + p["delta_v_w_m_s"] * outside if self.flash else None
        self.load = np.full(len(x), p["tau0_pa"])
        v = p["v_ini_m_s"]
        psi = self.a * np.log(2 * V0 / v * np.sinh((p["tau0_pa"] - ETA * v) / (self.a * p["sigma_pa"])))
        self.state = psi if self.flash else p["L_m"] / V0 * np.exp((psi - F0) / p["b"])
        r2, self.shape = (x / p["pulse_radius_m"]) ** 2, np.zeros(len(x))
        self.shape[r2 < 1] = p["pulse_pa"] * np.exp(r2[r2 < 1] / (r2[r2 < 1] - 1))
        self.strength = self.load.copy()

    def start(self):
        return np.where(self.active, self.p["v_ini_m_s"], 0)

    def back(self, v, before, rate):
        return np.log(rate / v) / np.log(rate / np.maximum(before, 1e-30))

    def pulse(self, t):
        rise = self.p["pulse_s"]
        return self.shape * (0 if t <= 0 else 1 if t >= rise else np.exp((t - rise) ** 2 / (t * (t - 2 * rise))))

    def evolve(self, rate, dt):
        """State after dt at constant V, exactly."""
        v = np.maximum(rate, 1e-30)
        y = v * dt / self.p["L_m"]
        if not self.flash:
            return self.state * np.exp(-y) - dt * np.expm1(-y) / y
        a, p = self.a, self.p
        f_lv = F0 - (p["b"] - a) * np.log(v / V0)
        g = (p["f_w"] + (f_lv - p["f_w"]) / (1 + (v / self.v_w) ** 8) ** 0.125) / a
        steady = a * (np.log(V0 / v) + g + np.log1p(-np.exp(-2 * g)))
        return steady + (self.state - steady) * np.exp(-y)

    def solve(self, load, slip, state):
        """Newton in the strength; the function is concave and falls, so from above its steps do not pass the root."""
        p, a = self.p, self.a
        psi = state if self.flash else F0 + p["b"] * np.log(V0 * state / p["L_m"])
        scale, c = p["sigma_pa"] * a, np.log(2 * V0) - psi / a
        top = np.minimum(load, scale * np.arcsinh(load / ETA * np.exp(-c)))
        y = np.minimum(self.strength, top)
        for i in range(60):
            v, dv = np.exp(c) * np.sinh(y / scale), np.exp(c) * np.cosh(y / scale) / scale
            step = (load - y - ETA * v) / (1 + ETA * dv)
            y = np.minimum(y + step, top)
            if np.all((np.abs(step) < 1e-7) | ~self.active):
                break
        else:
            raise ArithmeticError("friction not solved")
        self.strength = y
        rate = np.where(self.active, np.exp(c) * np.sinh(y / scale), 0)
        return rate, load - ETA * rate

    def residual(self, slip, rate, traction, state):
        psi = state if self.flash else F0 + self.p["b"] * np.log(V0 * state / self.p["L_m"])
        strength = self.p["sigma_pa"] * self.a * np.arcsinh(rate / (2 * V0) * np.exp(psi / self.a))
        return np.abs(traction - strength)[self.active].max()


class StressDrop:
    """Traction `drop` below the initial one where |x| < speed t + start, no slip beyond; slip may go back. For the checks."""

    def __init__(self, x, drop, speed, start):
        self.x, self.drop, self.speed, self.half, self.load, self.state = x, drop, speed, start, np.zeros(len(x)), None

    def start(self):
        return np.where(np.abs(self.x) < self.half, self.drop / ETA, 0)

    def pulse(self, t):
        self.inside = np.abs(self.x) < self.half + self.speed * t
        return 0.0

    def evolve(self, rate, dt):
        return None

    def solve(self, load, slip, state):
        rate = np.where(self.inside, (load + self.drop) / ETA, 0)
        return rate, load - ETA * rate


def march(law, elasticity, dt, steps, look):
    """Integrates; look(step, slip, rate, traction, state) is called at t = 0 and after each step."""
    rate = law.start()
    slip, state = np.zeros(len(rate)), law.state
    elasticity.start(slip, rate)
    look(0, slip, rate, law.load - ETA * rate, state)
    for i in range(1, steps + 1):
        load = law.load + law.pulse(i * dt)
        guess = law.solve(load + elasticity.force(rate), slip + dt * rate, law.evolve(rate, dt))[0]
        mean = (rate + guess) / 2
        slip, state = slip + dt * mean, law.evolve(mean, dt)
        rate, traction = law.solve(load + elasticity.force(guess), slip, state)
        elasticity.advance(guess, rate)
        law.state = state
        look(i, slip, rate, traction, state)


# ---------------------------------------------------------------- problems

BARRIER = {"sigma_pa": 120e6, "tau0_pa": 70e6, "mu_s": 0.677, "mu_d": 0.525, "d_c_m": 0.40, "half_length_m": 15e3}
PULSE = {"pulse_radius_m": 3e3, "pulse_s": 1.0, "W_m": 15e3, "w_m": 3e3, "sigma_pa": 120e6}
AGEING = {"a": 0.008, "delta_a": 0.008, "b": 0.012, "L_m": 0.02, "tau0_pa": 75e6, "v_ini_m_s": 1e-12, "pulse_pa": 25e6, **PULSE}


def patches(*pairs):
    return [{"centre_m": x, "half_width_m": 1.5e3, "tau0_pa": tau} for x, tau in pairs]


PROBLEMS = {
    "tpv205": {**BARRIER, "patches": patches((0.0, 81.6e6), (-7.5e3, 78e6), (7.5e3, 62e6))},
    "tpv3": {**BARRIER, "patches": patches((0.0, 81.6e6))},
    "tpv101": AGEING,
    "tpv101_locked": {**AGEING, "half_length_m": 18e3},
    "tpv104": {"a": 0.01, "delta_a": 0.01, "b": 0.014, "L_m": 0.4, "v_w_m_s": 0.1, "delta_v_w_m_s": 0.9, "f_w": 0.2, "tau0_pa": 40e6,
               "v_ini_m_s": 1e-16, "pulse_pa": 45e6, **PULSE},
}
STATIONS = [-12e3, -7.5e3, -4.5e3, 0.0, 4.5e3, 7.5e3, 12e3]
THRESHOLDS = [1e-3, 0.1]
CELLS = [100.0, 50.0, 25.0, 12.5]


def points(length, cell):
    n = round(length / cell)
    return (np.arange(n) - n // 2 + 0.5) * cell


def run(name, mode, cell, refine=1, length=LENGTH):
    """One grid: rupture times, slip at the end, largest rates and histories at the stations."""
    p = PROBLEMS[name]
    x = points(length, cell)
    law = (SlipWeakening if "mu_s" in p else RateState)(x, p)
    per = STEP[cell] * refine
    dt, steps = SAMPLE / per, round(END / SAMPLE) * per
    elasticity = Elasticity(mode, len(x), cell, dt, END)
    stations = [0.0, 12e3] if name == "tpv101_locked" else [s for s in STATIONS if s >= 0 or name == "tpv205"]
    half = 18e3 if name.startswith("tpv1") else 15e3
    reported = np.arange(-half if name == "tpv205" else 0.0, half + 1, 500.0)
    rupture = {v: np.full(len(x), np.nan) for v in THRESHOLDS}
    peak, before, histories = np.zeros(len(x)), None, []

    def at(values, where):
        return np.interp(where, x, values)

    def look(i, slip, rate, traction, state):
        nonlocal before, peak
        peak = np.maximum(peak, rate)
        for v, times in rupture.items():
            new = np.isnan(times) & (rate >= v)
            if new.any():
                times[new] = 0 if i == 0 else (i - law.back(v, before[new], rate[new])) * dt
        before = law.signed if law.state is None else rate
        if i % per == 0:
            row = [at(slip, stations), at(rate, stations), at(traction, stations) / 1e6]
            if state is not None:
                row.append(at(state if law.flash else np.log10(state), stations))
            histories.append(row)
        if i == steps:
            look.slip = at(slip, reported)
            assert law.residual(slip, rate, traction, state) < 1.0, "friction is not satisfied to 1 Pa"

    # Rupture times jump where the initial traction does.
    borders = [q["centre_m"] + e * q["half_width_m"] for q in p.get("patches", []) for e in (-1, 1)]

    def times_at(times):
        return np.where(np.isin(reported, borders), np.nan, at(times, reported))

    clock = time.process_time()
    march(law, elasticity, dt, steps, look)
    print(f"{name} {mode} cell {cell} m: {steps} steps, {elasticity.decay.shape[1]} terms, kernel {elasticity.kernel_error:.1e}, "
          f"{time.process_time() - clock:.0f} s, peak {peak.max():.4f} m/s", flush=True)
    return {"x": reported, "stations": stations, "rupture": {v: times_at(t) for v, t in rupture.items()}, "slip": look.slip,
            "peak": peak.max(), "peaks": at(peak, stations), "histories": np.array(histories), "step": dt}


def extrapolate(grids):
    """Finest value, its limit, the uncertainty (larger of the last correction and the change of the limit from one grid coarser), and the order."""
    t0, t1, t2 = grids[-3:]
    ok = np.isfinite(t0 + t1 + t2) & (t2 > 0)
    first, second = (t0 - t1)[ok], (t1 - t2)[ok]
    order = float(np.clip(np.log2(np.median(np.abs(first)) / np.median(np.abs(second))), 1, 3)) if ok.any() else 1.0
    limit, coarser = t2 + (t2 - t1) / (2**order - 1), t1 + (t1 - t0) / (2**order - 1)
    return limit, np.maximum(np.abs(limit - t2), np.abs(limit - coarser)), order


def rounded(values, digits=5):
    """Nested lists with few significant digits; null for what is not a number."""
    if np.ndim(values):
        return [rounded(v, digits) for v in values]
    return None if not np.isfinite(values) else float(f"{values:.{digits}g}")


def largest(values):
    values = np.abs(values[np.isfinite(values)])
    return rounded(values.max(), 3) if len(values) else None


def problem(name, mode, cells):
    """All grids of a problem, as the json has them."""
    runs = [run(name, mode, c) for c in cells]
    fine, next_ = runs[-1], runs[-2]
    rupture = {}
    for v in THRESHOLDS:
        grids = [r["rupture"][v] for r in runs]
        limit, error, order = extrapolate(grids)
        rupture[str(v)] = {"finest": rounded(grids[-1], 7), "extrapolated": rounded(limit, 7), "uncertainty": rounded(error, 2),
                           "order": rounded(order, 3), "change": [largest(b - a) for a, b in zip(grids[:-1], grids[1:])]}
    fields = ["slip_m", "rate_m_s", "traction_mpa", "state"][: fine["histories"].shape[1]]
    stations = []
    for j, x in enumerate(fine["stations"]):
        peaks = [r["peaks"][j] for r in runs]
        one = {"x_m": x, "peak_rate_m_s": rounded(peaks), "peak_uncertainty": rounded(abs(peaks[-1] - peaks[-2]), 2)}
        one.update({f: rounded(fine["histories"][:, i, j]) for i, f in enumerate(fields)})
        stations.append(one)
    difference = fine["histories"] - next_["histories"]
    changes = {"slip_m": largest(difference[:, 0].ravel()), "rate_m_s": rounded(np.sqrt((difference[:, 1] ** 2).mean()), 3),
               "traction_mpa": rounded(np.sqrt((difference[:, 2] ** 2).mean()), 3)}
    base, cell = runs[1]["rupture"][1e-3], cells[1]
    sensitivity = {"half_step": largest(run(name, mode, cell, refine=2)["rupture"][1e-3] - base),
                   "double_length": largest(run(name, mode, cell, length=2 * LENGTH)["rupture"][1e-3] - base)}
    return {"parameters": {"mode": mode, "rho_kg_m3": RHO, "cp_m_s": CP, "cs_m_s": CS, "mu_pa": MU, "v0_m_s": V0, "f0": F0, "length_m": LENGTH,
                           "end_s": END, **PROBLEMS[name]},
            "cells_m": cells, "steps_s": rounded([r["step"] for r in runs]), "x_m": fine["x"].tolist(), "rupture_s": rupture,
            "slip_end": {"finest": rounded(fine["slip"]), "uncertainty": rounded(np.abs(fine["slip"] - next_["slip"]), 2)},
            "stations": stations, "history_change": changes, "peak_rate_m_s": rounded([r["peak"] for r in runs]), "sensitivity": sensitivity}


# ---------------------------------------------------------------- checks


def kostrov_factor(mode, speed):
    """C in V = C (drop/mu) v t/sqrt(t^2 - x^2/v^2), slip rate of a crack growing both ways from a point at speed v with a constant stress drop.

    By Laplace and Fourier transforms traction at x = 0 is -(mu C/2)(drop/mu) times the integral of sin(q) G(v cot(q)/cs) over 0 < q < pi/2;
    antiplane, C = 2/E(1 - v^2/cs^2) with the complete elliptic integral E of that parameter."""

    def integrand(q):
        s = speed / CS / np.tan(q)
        g = STATIC[mode] if s < 1e-4 else transfer(mode, np.sqrt(1 + s**2), np.sqrt(1 + (s / KAPPA) ** 2), s)
        return np.sin(q) * g

    return 2 / scipy.integrate.quad(integrand, 1e-9, np.pi / 2, epsrel=1e-10)[0]


def kostrov(mode, cell, speed):
    """Relative errors when v t = 12 km: slip, root mean square over |x| < 0.9 v t; mean slip rate since 0.9 t, over |x| < 0.8 v t.

    Slip rates themselves are noisy at the size of cells, as cells start one by one."""
    end, x, dt = 12e3 / speed, points(72e3, cell), SAMPLE / STEP[cell]
    steps = round(end / dt)
    elasticity = Elasticity(mode, len(x), cell, dt, steps * dt)
    slips = {}

    def look(i, slip, rate, traction, state):
        if i in (steps, steps * 9 // 10):
            slips[i * dt] = slip

    march(StressDrop(x, 1e6, speed, 0.0), elasticity, dt, steps, look)
    (t1, d1), (t2, d2) = slips.items()
    factor = kostrov_factor(mode, speed) * 1e6 / MU

    def exact(t, near):
        return factor * np.sqrt((speed * t) ** 2 - x[near] ** 2)

    def rms(values):
        return float(np.sqrt(np.mean(values**2)))

    near, core = np.abs(x) < 0.9 * speed * t2, np.abs(x) < 0.8 * speed * t2
    return rms(d2[near] / exact(t2, near) - 1), rms((d2 - d1)[core] / (exact(t2, core) - exact(t1, core)) - 1)


def rest(mode, cell):
    """Relative error of slip at the middle of a crack of 6 km repeated every 24 km, 1 MPa: mean from 100 to 200 s, as waves decay slowly there."""
    x, dt, half, length = points(24e3, cell), SAMPLE / STEP[cell], 3e3, 24e3
    steps = round(200 / dt)
    elasticity, middle, slips = Elasticity(mode, len(x), cell, dt, steps * dt), len(x) // 2, []
    march(StressDrop(x, 1e6, 0.0, half), elasticity, dt, steps, lambda i, slip, rate, traction, state: slips.append(slip[middle]))
    exact = 2e6 / MU / STATIC[mode] * length / np.pi * np.arccosh(np.cos(np.pi * cell / 2 / length) / np.cos(np.pi * half / length))
    return float(np.mean(slips[steps // 2 :]) / exact - 1)


def checks():
    """Kernels against Bessel functions and against G, Kostrov's crack, and the crack at rest; errors by cell size."""
    out = {"kernel": {}, "kostrov": {}, "static_crack": {}}
    for mode in STATIC:
        t = np.concatenate([np.linspace(0, 20, 2001), np.geomspace(20, 300, 500)])
        nodes, c, error = exponentials(mode, 3000.0)
        exact = closed_form(mode, t)
        s = np.array([1e-3, 0.02 + 0.95j, 0.01 + 1j, 0.3 + 1.7j, 2.0, 1 + 30j])
        sums = STATIC[mode] + s - s * ((c / (s[:, None] - nodes)).sum(1) + (c.conj() / (s[:, None] - nodes.conj())).sum(1))
        g = transfer(mode, np.sqrt(1 + s**2), np.sqrt(1 + (s / KAPPA) ** 2), s)
        out["kernel"][mode] = {
            "terms": len(nodes), "of_terms_from_full_integral": rounded(error, 2),
            "of_full_integral_from_closed_form": rounded(np.abs(evaluate(t, *cut_integral(mode, 3000.0)) - exact).max(), 2),
            "of_transform_from_transfer_function": rounded(np.abs(sums - g).max(), 2)}
        assert out["kernel"][mode]["of_full_integral_from_closed_form"] < 1e-6
        assert out["kernel"][mode]["of_transform_from_transfer_function"] < 1e-6
        out["kostrov"][mode] = {}
        for share in (0.5, 0.8):
            speed, cells = share * CS, [100.0, 50.0, 25.0]
            slip, rate = zip(*[kostrov(mode, c, speed) for c in cells])
            out["kostrov"][mode][str(share)] = {"speed_m_s": speed, "factor": rounded(kostrov_factor(mode, speed), 10), "cells_m": cells,
                                                "slip_error": rounded(slip, 3), "rate_error": rounded(rate, 3)}
            assert slip[-1] < 2e-3 and rate[-1] < 5e-3  # a quarter of a cell of a half-length of 12 km is 5e-4
        out["static_crack"][mode] = {"cells_m": cells, "relative_error": rounded([rest(mode, c) for c in cells], 3)}
        first, second, third = out["static_crack"][mode]["relative_error"]
        assert max(abs(third - second / 2), abs(second - first / 2)) < 3e-4  # half a cell of a half-length of 3 km, so of order one
    e = special.ellipe(1 - 0.25)
    assert abs(kostrov_factor("III", 0.5 * CS) * e / 2 - 1) < 1e-8
    print(json.dumps(out, indent=1))
    return out


def main(words):
    results = json.loads(OUT.read_text()) if OUT.exists() else {"checks": {}, "problems": {}}
    for word in words or ["checks", *PROBLEMS]:
        name, *rest_ = word.split(":")
        if name == "checks":
            results["checks"] = checks()
        else:
            cells = [float(c) for c in rest_[1].split(",")] if len(rest_) > 1 else CELLS
            for mode in [rest_[0]] if rest_ else STATIC:
                results["problems"][f"{name}_{mode}"] = problem(name, mode, cells)
        results["versions"] = {"python": platform.python_version(), "numpy": np.__version__, "scipy": scipy.__version__,
                               "date": time.strftime("%Y-%m-%d")}
        write(results)


def write(results):
    """One line per list of numbers, problems in the order of their names."""
    results["problems"] = dict(sorted(results["problems"].items()))
    OUT.write_text(dump(results, 0) + "\n")


def dump(value, depth):
    flat = json.dumps(value, separators=(",", ":"))
    if not isinstance(value, (dict, list)) or len(flat) < 100 or (isinstance(value, list) and not isinstance(value[0], (dict, list))):
        return flat
    pad = " " * (depth + 1)
    if isinstance(value, dict):
        return "{\n" + ",\n".join(f"{pad}{json.dumps(k)}: {dump(v, depth + 1)}" for k, v in value.items()) + "\n" + pad[1:] + "}"
    return "[\n" + ",\n".join(pad + dump(v, depth + 1) for v in value) + "\n" + pad[1:] + "]"


if __name__ == "__main__":
    main(sys.argv[1:])
