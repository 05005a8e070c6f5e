"""Reference solutions of spring sliders with the laws of Perrin, Rice and Zheng, Nagata et al., and flash heating.

Primary: heyoka (adaptive Taylor series, events to rounding) in w = ln(V/Vref) and phi, in 80-bit numbers.
Checks: the same in 64-bit numbers; scipy's DOP853 at rtol 1e-13 in other variables, with V by Newton's method: the traction T,
and ln theta (PRZ), phi + c mu (Nagata), phi (flash).  See README.md for the conventions and the meaning of the uncertainties.

Model: T' = k (V_load - V), T = sigma mu + eta V, mu = a asinh(V/(2 Vref) exp((mu0 + phi)/a)).  With g the derivative of mu with
respect to phi (a g: to w) the laws are phi' = A - c mu', so that mu' = g (a w' + A)/(1 + c g) and

    w' = (k (V_load - V) - sigma g A/(1 + c g)) / (sigma a g/(1 + c g) + eta V)

    PRZ,    phi = b ln(Vref theta/2L), theta' = 1 - (V theta/2L)^2:  A = b/theta - b theta (V/2L)^2, c = 0
    Nagata, phi = b ln(Vref theta/L):                                A = b/theta - b V/L
    flash:  A = -(V/L) (phi + mu0 + a w - mu_ss), c = 0,
            mu_ss = mu_w + (mu0 + (a - b) w - mu_w)/[1 + (V/V_w)^8]^(1/8)

Units: SI.
"""

import datetime
import json
import math
import pathlib
import platform

import heyoka as hy
import numpy as np
import scipy
from scipy.integrate import solve_ivp

MU0 = 0.6
SET = dict(sigma=5e6, a=0.01, b=0.015, L=1e-5, Vref=1e-6, V_load=1e-6, eta=5e6)
K_C = SET["sigma"] * (SET["b"] - SET["a"]) / SET["L"]
LAWS = {"prz": {}, "nagata": dict(c=2.0), "flash": dict(mu_w=0.2, V_w=0.05)}
# Half of the critical stiffness of the law.
SOFT = {"prz": 0.5 * K_C, "nagata": 0.5 * K_C / 3.0, "flash": 0.5 * K_C}
V_EVENT = 1e-3  # m/s, rising
EVENTS = 5
HOLD = 100.0
# Times since the hold began; the load point moves again from HOLD on.
TIMES = [0.01, 1.0, 10.0, 100.0, 100.1, 100.5, 101.0, 102.0, 105.0, 120.0, 200.0]


class Taylor:
    """A slider by heyoka.  Time restarts at 0 after every event."""

    def __init__(self, law, k, fp):
        self.fp = fp
        names = SET | LAWS[law] | dict(k=k, mu0=MU0)
        index = {name: i for i, name in enumerate(names)}
        self.load = index["V_load"]
        self.values = np.array([fp(v) for v in names.values()], dtype=fp)
        sig, a, b, L, Vr, Vl, eta, stiff, mu0 = (
            hy.par[index[n]] for n in ("sigma", "a", "b", "L", "Vref", "V_load", "eta", "k", "mu0")
        )
        w, f = hy.make_vars("w", "f")
        V, c = Vr * hy.exp(w), 0.0
        if law == "prz":
            A = b * Vr / (2.0 * L) * hy.exp(-f / b) - b * V**2.0 / (2.0 * L * Vr) * hy.exp(f / b)
        elif law == "nagata":
            A, c = b * Vr / L * hy.exp(-f / b) - b * V / L, hy.par[index["c"]]
        else:
            mu_w, V_w = hy.par[index["mu_w"]], hy.par[index["V_w"]]
            # (V/V_w)^8 as the exponential of eight times the logarithm.
            steady = mu_w + (mu0 + (a - b) * w - mu_w) / (1.0 + hy.exp(8.0 * (w + hy.log(Vr / V_w)))) ** 0.125
            A = -(V / L) * (f + mu0 + a * w - steady)
        ln2 = float(np.log(2.0)) if fp is np.float64 else np.log(fp(2))
        X = w - hy.expression(ln2) + (mu0 + f) / a
        root = hy.sqrt(1.0 + hy.exp(-2.0 * X))
        g, mu = 1.0 / root, a * (X + hy.log(1.0 + root))
        dw = (stiff * (Vl - V) - sig * g * A / (1.0 + c * g)) / (sig * a * g / (1.0 + c * g) + eta * V)
        df = (A - c * a * g * dw) / (1.0 + c * g)
        self.system = [(w, dw), (f, df)]
        self.speed_up = dw / (V / L + stiff * Vl / (sig * a))
        self.w = w
        self.ln_event = np.log(fp(V_EVENT) / fp(SET["Vref"]))
        self.mu = hy.cfunc([mu], [w, f], fp_type=fp)
        self.scale = fp(k) * fp(SET["V_load"]) / (fp(SET["sigma"]) * fp(SET["a"]))
        self.cache = {}

    def integrator(self, kind):
        if kind not in self.cache:
            up, down = hy.event_direction.positive, hy.event_direction.negative
            events = {
                "plain": [],
                "cross": [(self.w - hy.expression(self.ln_event), up)],
                "max": [(self.speed_up, down)],
                "min": [(self.speed_up, up)],
            }[kind]
            events = [hy.t_event(e, direction=d, fp_type=self.fp) for e, d in events]
            zeros = np.zeros(2, dtype=self.fp)
            self.cache[kind] = hy.taylor_adaptive(
                self.system, zeros, fp_type=self.fp, pars=self.values.copy(), t_events=events
            )
        return self.cache[kind]

    def run(self, kind, y, t, load=None):
        """Integrates to the event (or for the time t): state and duration."""
        ta = self.integrator(kind)
        ta.pars[:] = self.values
        if load is not None:
            ta.pars[self.load] = self.fp(load)
        if kind != "plain":
            ta.reset_cooldowns()
        ta.time, ta.state[:] = self.fp(0), y
        outcome = int(ta.propagate_until(self.fp(t), max_steps=200000)[0])
        if outcome != int(hy.taylor_outcome.time_limit) and not -10 < outcome < 0:
            raise RuntimeError(f"heyoka: {outcome}")
        return ta.state.copy(), ta.time

    def hop(self, y):
        """Moves away from an event just located, by a thousandth of the current time scale."""
        rate = self.fp(SET["Vref"]) * np.exp(y[0]) / self.fp(SET["L"])
        return self.run("plain", y, self.fp(1e-3) / (rate + self.scale))

    def speed(self, y):
        return np.exp(y[0]) * self.fp(SET["Vref"])

    def friction(self, y):
        return self.mu(y, pars=self.values[: self.mu.nparams])[0]


def start(law, factor, fp):
    """Initial unknowns: ln(V/Vref) for V = factor V_load, and the state steady at V_load."""
    v = np.log(fp(SET["V_load"]) / fp(SET["Vref"]))
    phi = -fp(SET["b"]) * v
    if law == "flash":
        q = (fp(SET["V_load"]) / fp(LAWS[law]["V_w"])) ** 8
        mu_w, low = fp(LAWS[law]["mu_w"]), fp(MU0) + (fp(SET["a"]) - fp(SET["b"])) * v
        phi = mu_w + (low - mu_w) / (1 + q) ** fp(0.125) - fp(MU0) - fp(SET["a"]) * v
    return np.array([v + np.log(fp(factor)), phi], dtype=fp)


def cycles(law, fp):
    s = Taylor(law, SOFT[law], fp)
    y, t, times = start(law, 1.5, fp), fp(0), []
    extremes = {}
    while True:
        y, dt = s.run("cross", y, 1e9)
        t += dt
        times.append(t)
        if len(times) == EVENTS:
            return {
                "crossings_s": times,
                "v_max_between_last_two": extremes["max"],
                "v_min_between_last_two": extremes["min"],
            }
        for kind in ("max", "min"):
            y, dt = s.hop(y)
            t += dt
            y, dt = s.run(kind, y, 1e9)
            t += dt
            extremes[kind] = s.speed(y)
        y, dt = s.hop(y)
        t += dt


def hold(law, fp):
    """Steady sliding, a hold of the load point, and sliding again, on a spring of five times the critical stiffness."""
    s = Taylor(law, 5 * K_C, fp)
    y, at, v, mu = start(law, 1.0, fp), fp(0), [], []
    for t in TIMES:
        y, _ = s.run("plain", y, fp(t) - at, load=0.0 if t <= HOLD else None)
        at = fp(t)
        v.append(s.speed(y))
        mu.append(s.friction(y))
    return {"t_s": TIMES, "v": v, "mu": mu}


class Traction:
    """The second formulation: q = (T - sigma mu0)/(sigma a), and ln(Vref theta/2L), (phi + c mu)/b or phi."""

    def __init__(self, law, k):
        self.p, self.law, self.guess, self.V_load = SET | LAWS[law] | dict(k=k), law, 0.0, SET["V_load"]
        self.c = self.p.get("c", 0.0)

    def steady(self, w):
        p = self.p
        return p["mu_w"] + (MU0 + (p["a"] - p["b"]) * w - p["mu_w"]) / (1 + (p["Vref"] * math.exp(w) / p["V_w"]) ** 8) ** 0.125

    def phi(self, y, mu):
        if self.law == "prz":
            return self.p["b"] * y[1]
        return self.p["b"] * y[1] - self.c * mu if self.law == "nagata" else y[1]

    def mu(self, w, phi):
        a = self.p["a"]
        X = max(w - math.log(2) + (MU0 + phi) / a, -300.0)  # the limit acts only in trial steps that are rejected
        root = math.sqrt(1 + math.exp(-2 * X))
        return a * (X + math.log1p(root)), 1 / root

    def at(self, y):
        """w, phi and mu from T and the state: sigma mu + eta V = T."""
        p, w = self.p, self.guess
        T = p["sigma"] * (MU0 + p["a"] * y[0])
        for _ in range(100):
            V = p["Vref"] * math.exp(min(w, 600.0))
            phi = self.phi(y, (T - p["eta"] * V) / p["sigma"])
            m, g = self.mu(w, phi)
            slope = p["sigma"] * p["a"] * g + (1 + self.c * g) * p["eta"] * V
            d = (p["sigma"] * m + p["eta"] * V - T) / slope
            w -= max(min(d, 2.0), -2.0)
            if abs(d) < 1e-12 * max(1.0, abs(w)):  # quadratic convergence: the next update would be rounding
                break
        self.guess = w
        V = p["Vref"] * math.exp(min(w, 600.0))
        mu = (T - p["eta"] * V) / p["sigma"]
        return w, self.phi(y, mu), mu, V

    def rhs(self, _, y):
        p = self.p
        w, phi, _, V = self.at(y)
        if self.law == "prz":
            theta = 2 * p["L"] / p["Vref"] * math.exp(max(min(y[1], 600.0), -600.0))
            dx = 1 / theta - theta * (V / (2 * p["L"])) ** 2
        elif self.law == "nagata":
            dx = p["Vref"] / p["L"] * math.exp(min(-phi / p["b"], 600.0)) - V / p["L"]
        else:
            dx = -(V / p["L"]) * (phi + MU0 + p["a"] * w - self.steady(w))
        return [p["k"] * (self.V_load - V) / (p["sigma"] * p["a"]), dx]

    def of(self, w, phi):
        """The unknowns from w and phi."""
        p = self.p
        mu = self.mu(w, phi)[0]
        T = p["sigma"] * mu + p["eta"] * p["Vref"] * math.exp(w)
        x = {"prz": phi / p["b"], "nagata": (phi + self.c * mu) / p["b"], "flash": phi}[self.law]
        self.guess = w
        return np.array([(T / p["sigma"] - MU0) / p["a"], x])

    def plain(self, y, t0, t1):
        return solve_ivp(self.rhs, (t0, t1), y, "DOP853", rtol=1e-13, atol=1e-15).y[:, -1]


def check_cycles(law, n):
    """Crossings by DOP853, refined to rounding by restarts; extremes of ln V between the last two from a parabola through
    short steps around the interpolated extreme."""
    s = Traction(law, SOFT[law])
    w0, phi0 = (float(x) for x in start(law, 1.5, np.float64))
    level = math.log(V_EVENT / SET["Vref"])

    def cross(_, y):
        return s.at(y)[0] - level

    cross.terminal, cross.direction = True, 1
    y, t, times = s.of(w0, phi0), 0.0, []
    while len(times) < n:
        r = solve_ivp(s.rhs, (0.0, 1e9), y, "DOP853", rtol=1e-13, atol=1e-15, events=cross)
        t0, y0, te = r.t[-2], r.y[:, -2], r.t[-1]
        for _ in range(4):  # the interpolant only brackets the root; w' from finite differences of T and the state
            y = s.plain(y0, t0, te)
            h = 1e-6 * max(te - t0, 1e-9)
            speed = (s.at(s.plain(y, 0.0, h))[0] - s.at(y)[0]) / h
            te -= (s.at(y)[0] - level) / speed
        y, t = s.plain(y0, t0, te), t + te
        times.append(t)
        hop = 1e-4 * SET["L"] / V_EVENT
        y, t = s.plain(y, 0.0, hop), t + hop
    return {"crossings_s": times}


def check_hold(law):
    s = Traction(law, 5 * K_C)
    y, at, v, mu = s.of(*(float(x) for x in start(law, 1.0, np.float64))), 0.0, [], []
    for t in TIMES:
        s.V_load = 0.0 if t <= HOLD else SET["V_load"]
        y, at = s.plain(y, at, t), t
        w, _, m, V = s.at(y)
        v.append(V)
        mu.append(m)
    return {"v": v, "mu": mu}


def difference(x, y):
    """Largest relative difference per quantity."""
    out = {}
    for key in x:
        if key in y and key != "t_s":
            u, v = (np.atleast_1d(np.array(z, dtype=np.longdouble)) for z in (x[key], y[key]))
            out[key] = float(np.max(np.abs(u - v) / np.abs(u)))
    return out


def main():
    results = {
        "date": datetime.date.today().isoformat(),
        "python": platform.python_version(),
        "packages": {m.__name__: m.__version__ for m in (np, scipy, hy)},
        "units": "SI; mu0 = 0.6; uncertainty: largest relative difference of the quantity, see README.md",
    }
    for law, own in LAWS.items():
        for name, k, solve, check in (
            (f"cycles_{law}", SOFT[law], cycles, lambda law: check_cycles(law, EVENTS)),
            (f"hold_{law}", 5 * K_C, hold, check_hold),
        ):
            found = solve(law, np.longdouble)
            uncertainty = {
                "heyoka_64_bit": difference(found, solve(law, np.float64)),
                "scipy_dop853": difference(found, check(law)),
            }
            plain = {key: [float(x) for x in v] if isinstance(v, list) else float(v) for key, v in found.items()}
            results[name] = {"parameters": SET | own | dict(k=k), "quantities": plain, "uncertainty": uncertainty}
            print(name, json.dumps(plain), json.dumps(uncertainty), flush=True)
    pathlib.Path(__file__).with_suffix(".json").write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
