"""Reference solutions of spring sliders with rate-and-state friction, with third-party integrators only.

Primary: heyoka (adaptive Taylor series, events to rounding) in w = ln(V/Vref) and the states, in 80-bit numbers.
Checks: the same in 64-bit numbers; scipy's DOP853 in (spring traction, ln theta or phi) with V by Newton's method, at rtol 1e-13;
with mass, scipy's Radau IIA with an analytic Jacobian.  See README.md for the model, the conventions and the meaning of the uncertainties.

Model: T' = k (V_load - V), M V' = T - sigma mu - eta V, mu = a asinh(V/(2 Vref) exp((mu0 + phi)/a)).  With g the
derivative of mu with respect to phi (a g: to w), X the logarithm of the argument of asinh, M = 0:

    w' = (k (V_load - V) - sigma g phi' - mu sigma') / (sigma a g + eta V),   g = (1 + exp(-2 X))^(-1/2)
    ageing, phi = b ln(Vref theta/L):  phi' = (b Vref/L) exp(-phi/b) - b V/L - (alpha/sigma) sigma'
    slip:                              phi' = -(V/L) (phi + b w) - (alpha/sigma) sigma'

so the traction never appears and no difference of large numbers is formed.  Units: SI.
"""

import datetime
import json
import math
import pathlib
import platform
import sys
import time

import heyoka as hy
import numpy as np
import scipy
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

MU0 = 0.6
MILD = dict(sigma=5e6, a=0.01, b=0.015, L=1e-5, Vref=1e-6, V_load=1e-6, eta=5e6, k=1.25e9)
TWO = dict(sigma=5e6, a=0.01, b1=0.012, L1=1e-5, b2=0.003, L2=1e-4, Vref=1e-6, V_load=1e-6, eta=5e6, k=5e8)
HARD = dict(sigma=50e6, a=0.0045, b=0.015, L=1e-4, Vref=1e-6, V_load=1e-9, eta=4.62444e6)
HARD["k"] = 0.05 * (HARD["sigma"] * (HARD["b"] - HARD["a"]) / HARD["L"])
REFERENCE = dict(sigma=50e6, a=0.01, b=0.015, L=1e-4, Vref=1e-6, V_load=1e-9, eta=4.62444e6)
REFERENCE["k"] = 0.01 * (REFERENCE["sigma"] * (REFERENCE["b"] - REFERENCE["a"]) / REFERENCE["L"])
INERTIAL = MILD | dict(eta=0.0, M=MILD["k"] * (0.01 / (2 * math.pi)) ** 2)
DAMPED = dict(eta=5e6)
K_C = MILD["sigma"] * (MILD["b"] - MILD["a"]) / MILD["L"]
V_EVENT = 1e-3  # m/s, rising


class Taylor:
    """Sliders without inertia, by heyoka.  Local time restarts at 0 after every event."""

    def __init__(self, p, law, fp, bare=False, oscillation=None, sliders=1, k_c=0.0, alpha=0.0):
        self.p, self.fp, values, index = p, fp, [], {}

        def par(name, value):
            if name not in index:
                index[name] = len(values)
                values.append(fp(value))
            return hy.par[index[name]]

        self.set = lambda ta, name, value: ta.pars.__setitem__(index[name], fp(value))
        sig, a, Vr, Vl, eta, k = (par(n, p[n]) for n in ("sigma", "a", "Vref", "V_load", "eta", "k"))
        mu0, ln2, kc, al = par("mu0", MU0), par("ln2", np.log(fp(2))), par("k_c", k_c), par("alpha", alpha)
        self.ln_event = np.log(fp(V_EVENT) / fp(p["Vref"]))
        ev = par("ln_event", self.ln_event)
        dsig = 0.0
        if oscillation:
            amp, omega = par("amp", oscillation[0]), par("omega", oscillation[1])
            dsig = sig * amp * omega * hy.cos(omega * hy.time)
            sig = sig * (1.0 + amp * hy.sin(omega * hy.time))
        states = [(p["b"], p["L"])] if law != "two" else [(p["b1"], p["L1"]), (p["b2"], p["L2"])]
        ws = [hy.make_vars(f"w{i}") for i in range(sliders)]
        Vs = [Vr * hy.exp(w) for w in ws]
        sys_w, sys_p, self.dw, self.dmu, self.mu = [], [], [], [], []
        for i, (w, V) in enumerate(zip(ws, Vs)):
            phi, dphi = 0.0, 0.0
            for j, (b, L) in enumerate(states):
                f, b, L = hy.make_vars(f"p{i}_{j}"), par(f"b{j}", b), par(f"L{j}", L)
                if law == "ageing":
                    df = b * Vr / L * hy.exp(-f / b) - b * V / L
                else:
                    df = -(V / L) * (f + b * w)
                if oscillation:
                    df = df - al / sig * dsig
                sys_p.append((f, df))
                phi, dphi = f + phi, df + dphi
            X = w - ln2 + (mu0 + phi) / a
            if bare:
                g, mu = 1.0, mu0 + phi + a * w
            else:
                g, mu = 1.0 / hy.sqrt(1.0 + hy.exp(-2.0 * X)), a * (X + hy.log(1.0 + hy.sqrt(1.0 + hy.exp(-2.0 * X))))
            pull = k * (Vl - V)
            for other in range(sliders):
                if other != i:
                    pull = pull + kc * (Vs[other] - V)
            dw = (pull - sig * g * dphi - mu * dsig) / (sig * a * g + eta * V)
            sys_w.append((w, dw))
            scale = 1.0 / (V / par("L0", states[0][1]) + k * Vl / (sig * a))
            self.dw.append(dw * scale)
            self.dmu.append((a * dw + dphi) * scale)
            self.mu.append(mu)
        self.system, self.ws, self.values, self.ev = sys_w + sys_p, ws, np.array(values, dtype=fp), ev
        self.mu_of = hy.cfunc([self.mu[0]], [x for x, _ in self.system], fp_type=fp)
        self.cache = {}

    def integrator(self, kind):
        if kind not in self.cache:
            up, down = hy.event_direction.positive, hy.event_direction.negative
            events = {
                "plain": [],
                "cross": [(w - self.ev, up) for w in self.ws],
                "max": [(self.dw[0], down)],
                "min": [(self.dw[0], up)],
                "max_mu": [(self.dmu[0], down)],
                "phi": [(hy.make_vars("p0_0"), down)],
            }[kind]
            events = [hy.t_event(e, direction=d, fp_type=self.fp) for e, d in events]
            zeros = np.zeros(len(self.system), dtype=self.fp)
            self.cache[kind] = hy.taylor_adaptive(
                self.system, zeros, fp_type=self.fp, pars=self.values.copy(), t_events=events
            )
        return self.cache[kind]

    def run(self, kind, y, t, start=0.0, **pars):
        """Integrates to the event (or for the time t): state, duration, index of the event or None."""
        ta = self.integrator(kind)
        ta.pars[:] = self.values
        for name, value in pars.items():
            self.set(ta, name, value)
        if kind != "plain":
            ta.reset_cooldowns()
        ta.time, ta.state[:] = self.fp(start), y
        outcome = int(ta.propagate_until(self.fp(start) + self.fp(t), max_steps=200000)[0])
        if outcome == int(hy.taylor_outcome.time_limit):
            return ta.state.copy(), ta.time - self.fp(start), None
        if not -10 < outcome < 0:
            raise RuntimeError(f"heyoka: {outcome}")
        return ta.state.copy(), ta.time - self.fp(start), -1 - outcome

    def hop(self, y, length=1e-3):
        """Moves away from an event just located, by a fraction of the current time scale."""
        L = self.p.get("L", self.p.get("L1"))
        p = self.p
        rate = self.fp(p["Vref"]) * np.exp(y[: len(self.ws)].max()) / self.fp(L)
        t = self.fp(length) / (rate + self.fp(p["k"] * p["V_load"] / (p["sigma"] * p["a"])))
        return self.run("plain", y, t)[0], t

    def friction(self, y, t=0.0):
        n = self.mu_of.nparams
        more = {"time": self.fp(t)} if self.mu_of.is_time_dependent else {}
        return self.mu_of(y, **({"pars": self.values[:n]} if n else {}), **more)[0]

    def speed(self, y):
        return np.exp(y[0]) * self.fp(self.p["Vref"])


def start(p, factor, fp, law="ageing", state_speed=None):
    """Initial unknowns: ln(V/Vref) for V = factor V_load, and the states steady at V_load."""
    v = np.log(fp(state_speed or p["V_load"]) / fp(p["Vref"]))
    bs = [p["b"]] if law != "two" else [p["b1"], p["b2"]]
    return np.array([v + np.log(fp(factor))] + [-fp(b) * v for b in bs], dtype=fp)


def cycles(p, law, n, fp):
    s = Taylor(p, law, fp, bare=law == "two")
    y, t, times = start(p, 1.5, fp, law), fp(0), []
    out = {}
    while True:
        y, dt, _ = s.run("cross", y, 1e13)
        t += dt
        times.append(t)
        if len(times) == n:
            break
        y, dt = s.hop(y)
        t += dt
        y, dt, _ = s.run("max", y, 1e13)
        t += dt
        v_max = s.speed(y)
        y, dt = s.hop(y)
        t += dt
        y, dt, _ = s.run("min", y, 1e13)
        t += dt
        v_min = s.speed(y)
        y, dt = s.hop(y)
        t += dt
    out["crossings_s"], out["last_interval_s"] = times, times[-1] - times[-2]
    out["v_max_between_last_two"], out["v_min_between_last_two"] = v_max, v_min
    return out


def at_times(s, y, times, **pars):
    t, v, m = s.fp(0), [], []
    for target in times:
        if target > 0:
            y, _, _ = s.run("plain", y, s.fp(target) - t, start=t, **pars)
        t = s.fp(target)
        v.append(s.speed(y))
        m.append(s.friction(y, t))
    return {"t_s": list(times), "v": v, "mu": m}


def slow(law, fp):
    p = MILD | dict(k=1.1 * K_C, eta=0.0)
    s = Taylor(p, law, fp)
    return at_times(s, start(p, math.exp(0.1), fp), (1.0, 10.0, 50.0, 100.0, 200.0, 500.0))


def kick(p, x, fp):
    y = start(p, 1.0, fp)
    y[0] += fp(x)
    return y


def slide_hold_slide(law, fp):
    p = MILD | dict(k=5 * K_C)
    s = Taylor(p, law, fp)
    out = {"hold_s": [1, 10, 100, 1000, 10000], "peak_minus_steady_mu": [], "time_of_peak_after_reload_s": [], "v_end_of_hold": []}
    y0 = start(p, 1.0, fp)
    mu_s = s.friction(y0)
    for hold in out["hold_s"]:
        y, _, _ = s.run("plain", y0, hold, V_load=0.0)
        out["v_end_of_hold"].append(s.speed(y))
        y, dt, _ = s.run("max_mu", y, 1e6)
        out["peak_minus_steady_mu"].append(s.friction(y) - mu_s)
        out["time_of_peak_after_reload_s"].append(dt)
    return out


def normal_step(alpha, fp):
    p = MILD | dict(k=2 * K_C, sigma=5.5e6)
    s = Taylor(p, "ageing", fp)
    y = start(p, 1.0, fp)
    mu1 = s.friction(y)
    T = fp(5e6) * mu1 + fp(p["eta"]) * fp(p["V_load"])
    y[1] -= fp(alpha) * np.log(fp(5.5e6) / fp(5e6))
    for _ in range(60):  # Newton in w: sigma mu + eta V = T
        V = s.speed(y)
        X = y[0] - np.log(fp(2)) + (fp(MU0) + y[1]) / fp(p["a"])
        r = fp(p["sigma"]) * s.friction(y) + fp(p["eta"]) * V - T
        y[0] -= r / (fp(p["sigma"]) * fp(p["a"]) / np.sqrt(1 + np.exp(-2 * X)) + fp(p["eta"]) * V)
    return at_times(s, y, (0.0, 0.1, 1.0, 10.0, 50.0))


def normal_oscillation(fp):
    p = MILD | dict(k=2 * K_C)
    omega = 2 * fp(math.pi) / 5
    s = Taylor(p, "ageing", fp, oscillation=(0.1, omega), alpha=0.2)
    return at_times(s, start(p, 1.0, fp), (1.0, 3.0, 10.0, 12.0, 20.0, 47.0, 50.0))


def coupled(fp):
    p = MILD | dict(k=0.8e9)
    s = Taylor(p, "ageing", fp, sliders=2, k_c=0.3e9)
    y = np.array([np.log(fp(1.5)), np.log(fp(0.8)), 0, 0], dtype=fp)
    t, times = fp(0), [[], []]
    while min(map(len, times)) < 5:
        y, dt, i = s.run("cross", y, 1e6)
        t += dt
        times[i].append(t)
        y, dt = s.hop(y)
        t += dt
    return {"crossings_1_s": times[0][:5], "crossings_2_s": times[1][:5]}


def neutral(fp):
    p = MILD | dict(b=0.01, k=1e9, V_load=1e-5)
    s = Taylor(p, "ageing", fp)
    y = start(p, 1.0, fp, state_speed=1e-6)
    return at_times(s, y, (0.1, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0))


def orbit(fp):
    """Orbit under the slip law: k = k_c, bare logarithm, no damping, Vref = V_load."""
    p = MILD | dict(k=K_C, eta=0.0)
    s = Taylor(p, "slip", fp, bare=True)
    y0 = kick(p, 0.5, fp)
    y, t = s.hop(y0)
    out, total = {}, t
    y, dt, _ = s.run("max", y, 1e6)
    total, out["v_max"] = total + dt, s.speed(y)
    y, dt = s.hop(y)
    total += dt
    y, dt, _ = s.run("min", y, 1e6)
    total, out["v_min"] = total + dt, s.speed(y)
    y, dt = s.hop(y, 1e-4)
    total += dt
    y, dt, _ = s.run("phi", y, 1e6)
    out["period_s"] = total + dt
    out["closure_of_ln_v"] = y[0] - fp(0.5)
    return out


def orbit_closed_form(fp):
    """Orbit from its invariant (e^-x - 1 + x + F - 1/beta) e^(beta F), x = ln(V/V_load), F = (phi + a x)/(b - a), beta = (b - a)/a.

    The period has no closed form and is computed by DOP853."""
    a, b = MILD["a"], MILD["b"]
    beta, x = (b - a) / a, 0.5
    F = a * x / (b - a)
    c = (math.expm1(-x) + x + F - 1 / beta) * math.exp(beta * F)
    h = -math.log(-beta * c) / beta
    roots = [brentq(lambda z: math.expm1(-z) + z - h, *lim, xtol=1e-15) for lim in ((-5, 0), (0, 5))]
    L, V_load, sigma_a = MILD["L"], MILD["V_load"], MILD["sigma"] * a

    def rhs(_, y):
        V = V_load * math.exp(y[0])
        dphi = -(V / L) * (y[1] + b * y[0])
        return [(K_C * (V_load - V) - MILD["sigma"] * dphi) / sigma_a, dphi]

    def section(_, y):
        return y[1]

    section.terminal, section.direction = 2, -1  # the first is the start
    r = solve_ivp(rhs, (0, 1e3), [x, 0.0], "DOP853", events=section, rtol=1e-13, atol=1e-15)
    y0, t = r.y[:, -2], r.t[-1]
    for _ in range(3):  # the interpolant only brackets the root
        y = solve_ivp(rhs, (r.t[-2], t), y0, "DOP853", rtol=1e-13, atol=1e-15).y[:, -1]
        t -= y[1] / rhs(t, y)[1]
    return {"v_min": V_load * math.exp(roots[0]), "v_max": V_load * math.exp(roots[1]), "period_s": t}


def threshold(ratio, fp):
    """Smallest ln(V/V_load) from which the undamped slip-law slider (bare logarithm) with k = ratio k_c runs away.

    In slip S = s/L:  a w' = (b - a) (K (e^-w - 1) + w) + f,  f' = (b - a) K (e^-w - 1),  f = phi + a w.  The separatrix is
    the only orbit with w' -> K; it attracts as S decreases, so it is followed backwards from w = 60 until phi = 0."""
    w, f = hy.make_vars("w", "f")
    a, b, K = (hy.par[i] for i in range(3))
    pars = np.array([fp(MILD["a"]), fp(MILD["b"]), fp(ratio)], dtype=fp)
    sys_ = [(w, -((b - a) * (K * (hy.exp(-w) - 1.0) + w) + f) / a), (f, -(b - a) * K * (hy.exp(-w) - 1.0))]
    y = np.array([fp(60), pars[0] * pars[2] - (pars[1] - pars[0]) * (fp(60) - pars[2])], dtype=fp)
    event = hy.t_event(f - a * w, direction=hy.event_direction.positive, fp_type=fp)
    ta = hy.taylor_adaptive(sys_, y, fp_type=fp, pars=pars, t_events=[event])
    if int(ta.propagate_until(fp(1e3))[0]) != -1:
        raise RuntimeError("threshold")
    return ta.state[0]


def threshold_by_bisection(ratio):
    """The same threshold by bisection: scipy's DOP853, forward from the perturbed state."""
    a, b, K = MILD["a"], MILD["b"], ratio

    def rhs(_, y):
        e = math.expm1(-y[0])
        return [((b - a) * (K * e + y[0]) + y[1]) / a, (b - a) * K * e]

    ends = [lambda _, y: y[0] - 200, lambda _, y: y[0]]
    for e in ends:
        e.terminal = True

    def runs_away(x):
        r = solve_ivp(rhs, (0, 1e3), [x, a * x], "DOP853", events=ends, rtol=1e-13, atol=1e-15)
        return r.t_events[0].size > 0

    lo, hi = 0.1, 5.0
    while hi - lo > 1e-12:
        mid = (lo + hi) / 2
        lo, hi = (lo, mid) if runs_away(mid) else (mid, hi)
    return (lo + hi) / 2


def thresholds(fp):
    return {f"ln_v_over_v_load_k_{r:g}_k_c": threshold(r, fp) for r in (1.0, 1.1, 1.5, 2.0)}


class Traction:
    """The second set of variables: q = (T - sigma_0 mu0)/(sigma_0 a) and ln(Vref theta/L) or phi, by scipy's DOP853."""

    def __init__(self, p, law, sliders=1, k_c=0.0, oscillation=None, alpha=0.0, rtol=1e-13):
        self.p, self.law, self.n, self.k_c, self.osc, self.alpha, self.rtol = p, law, sliders, k_c, oscillation, alpha, rtol
        self.s0 = p["sigma"]
        self.states = [(p["b"], p["L"])] if law != "two" else [(p["b1"], p["L1"]), (p["b2"], p["L2"])]
        self.guess, self.V_load, self.nfev = [0.0] * sliders, p["V_load"], 0
        self.ln_event = math.log(V_EVENT / p["Vref"])

    def sigma(self, t):
        if not self.osc:
            return self.s0, 0.0
        amp, om = self.osc
        return self.s0 * (1 + amp * math.sin(om * t)), self.s0 * amp * om * math.cos(om * t)

    def phi(self, y, i):
        own = y[self.n + i * len(self.states) : self.n + (i + 1) * len(self.states)]
        return sum(self.states[0][0] * x for x in own) if self.law == "ageing" else sum(own)

    def mu(self, w, phi):
        a = self.p["a"]
        if self.law == "two":
            return MU0 + phi + a * w, 1.0
        X = max(w - math.log(2) + (MU0 + phi) / a, -300.0)  # the limit acts only in trial steps that are rejected
        root = math.sqrt(1 + math.exp(-2 * X))
        return a * (X + math.log1p(root)), 1 / root

    def w(self, t, y, i):
        p, phi, sig = self.p, self.phi(y, i), self.sigma(t)[0]
        T, w = self.s0 * (MU0 + p["a"] * y[i]), self.guess[i]
        for _ in range(100):
            m, g = self.mu(w, phi)
            V = p["Vref"] * math.exp(min(w, 600.0))
            d = (sig * m + p["eta"] * V - T) / (sig * p["a"] * g + p["eta"] * V)
            w -= max(min(d, 2.0), -2.0)
            if abs(d) < 1e-12 * max(1.0, abs(w)):  # quadratic convergence: the next update would be rounding
                break
        self.guess[i] = w
        return w

    def rhs(self, t, y):
        p, out = self.p, []
        ws = [self.w(t, y, i) for i in range(self.n)]
        Vs = [p["Vref"] * math.exp(min(w, 600.0)) for w in ws]
        sig, dsig = self.sigma(t)
        for i in range(self.n):
            out.append((p["k"] * (self.V_load - Vs[i]) + self.k_c * (sum(Vs) - self.n * Vs[i])) / (self.s0 * p["a"]))
        for i in range(self.n):
            for j, (b, L) in enumerate(self.states):
                x = y[self.n + i * len(self.states) + j]
                if self.law == "ageing":
                    out.append(p["Vref"] / L * math.exp(min(-x, 600.0)) - Vs[i] / L - self.alpha * dsig / (sig * b))
                else:
                    out.append(-(Vs[i] / L) * (x + b * ws[i]) - self.alpha * dsig / sig)
        return out

    def dw(self, t, y):
        p, f = self.p, self.rhs(t, y)
        dphi, w = self.phi(f, 0), self.w(t, y, 0)
        _, g = self.mu(w, self.phi(y, 0))
        V = p["Vref"] * math.exp(w)
        return (p["k"] * (self.V_load - V) - self.s0 * g * dphi) / (self.s0 * p["a"] * g + p["eta"] * V), dphi

    def event(self, kind):
        if kind == "cross":
            es = [lambda t, y, i=i: self.w(t, y, i) - self.ln_event for i in range(self.n)]
            sign = 1
        elif kind == "max_mu":

            def e(t, y):
                dw, dphi = self.dw(t, y)
                return self.p["a"] * dw + dphi

            es, sign = [e], -1
        else:
            es, sign = [lambda t, y: self.dw(t, y)[0]], -1 if kind == "max" else 1
        for e in es:
            e.terminal, e.direction = True, sign
        return es

    def plain(self, y, t0, t1):
        if t1 == t0:
            return y
        r = solve_ivp(self.rhs, (t0, t1), y, "DOP853", rtol=self.rtol, atol=self.rtol)
        self.nfev += r.nfev
        return r.y[:, -1]

    def run(self, kind, y, t_max):
        """Integrates to the event.  The interpolant only brackets it: the last step is repeated up to the root (secant method)."""
        es = self.event(kind)
        r = solve_ivp(self.rhs, (0, t_max), y, "DOP853", events=es, rtol=self.rtol, atol=self.rtol)
        self.nfev += r.nfev
        i = next(j for j, t in enumerate(r.t_events) if t.size)
        e, t0, y0 = es[i], r.t[-2], r.y[:, -2]
        t, h = r.t[-1], (r.t[-1] - t0) * 1e-3
        ta, ga = t - h, e(t - h, self.plain(y0, t0, t - h))
        for _ in range(4):
            yt = self.plain(y0, t0, t)
            g = e(t, yt)
            if g == ga or abs(t - ta) < 1e-15 * t:
                break
            ta, ga, t = t, g, t - g * (t - ta) / (g - ga)
        return self.plain(y0, t0, t), t, i

    def start(self, factors, speed=None):
        p = self.p
        v = math.log((speed or p["V_load"]) / p["Vref"])
        qs, st = [], []
        for i, f in enumerate(factors):
            own = [-v if self.law == "ageing" else -b * v for b, _ in self.states]
            w = v + math.log(f)
            phi = sum(self.states[0][0] * x for x in own) if self.law == "ageing" else sum(own)
            T = self.s0 * self.mu(w, phi)[0] + p["eta"] * p["Vref"] * math.exp(w)
            qs.append((T - self.s0 * MU0) / (self.s0 * p["a"]))
            st += own
            self.guess[i] = w
        return np.array(qs + st)


def check_cycles(p, law, n):
    s = Traction(p, law)
    y, t, times = s.start([1.5]), 0.0, []
    L = s.states[0][1]

    def hop(y, t):
        dt = 1e-3 / (p["Vref"] * math.exp(s.w(0, y, 0)) / L + p["k"] * p["V_load"] / (p["sigma"] * p["a"]))
        return s.plain(y, 0, dt), t + dt

    while True:
        y, dt, _ = s.run("cross", y, 1e12)
        t += dt
        times.append(t)
        if len(times) == n:
            break
        if len(times) == n - 1:
            y, t = hop(y, t)
            y, dt, _ = s.run("max", y, 1e12)
            v_max = p["Vref"] * math.exp(s.w(0, y, 0))
            y, t = hop(y, t + dt)
            y, dt, _ = s.run("min", y, 1e12)
            v_min, t = p["Vref"] * math.exp(s.w(0, y, 0)), t + dt
        y, t = hop(y, t)
    return {"crossings_s": times, "last_interval_s": times[-1] - times[-2], "v_max_between_last_two": v_max, "v_min_between_last_two": v_min}


def check_times(s, y, times):
    t, v, m = 0.0, [], []
    for target in times:
        y, t = s.plain(y, t, target), target
        w = s.w(t, y, 0)
        v.append(s.p["Vref"] * math.exp(w))
        m.append(s.mu(w, s.phi(y, 0))[0])
    return {"t_s": list(times), "v": v, "mu": m}


class Inertial:
    """Slider with mass: (w, phi, A = w'), A' = (k (V_load - V) - sigma g phi' - (sigma a g + eta V) A)/(M V) - A^2; net force M V A.

    Below the speed `switch`, where A relaxes within 1e-6 s or less, heyoka integrates (w, phi) on the slow manifold: A from the
    equation above, iterated twice from the slider without mass (relative error about e^3, e = 1 - A1/A2).  The full equation
    takes over when V rises to `switch`, and the manifold only once A has relaxed to it (see `cycles`)."""

    def __init__(self, p, law, fp, switch=2e-5):
        self.p, self.fp, self.switch, self.tol = p, fp, switch, 3e-15 if fp == np.float64 else 1e-17
        w, f, A = hy.make_vars("w", "f", "A")
        values = [p[n] for n in ("sigma", "a", "b", "L", "Vref", "V_load", "eta", "k", "M")]
        values += [np.log(fp(2)), np.log(fp(V_EVENT) / fp(p["Vref"])), np.log(fp(switch) / fp(p["Vref"])), MU0]
        self.values = np.array([fp(v) for v in values], dtype=fp)
        sig, a, b, L, Vr, Vl, eta, k, M, ln2, ev, sw, mu0 = (hy.par[i] for i in range(13))
        V = Vr * hy.exp(w)
        g = 1.0 / hy.sqrt(1.0 + hy.exp(-2.0 * (w - ln2 + (mu0 + f) / a)))
        df = b * Vr / L * hy.exp(-f / b) - b * V / L if law == "ageing" else -(V / L) * (f + b * w)
        pull, resist = k * (Vl - V) - sig * g * df, sig * a * g + eta * V
        S = pull / resist
        levels = [S]
        for _ in range(2):
            S = (pull - M * V * (S * S + hy.diff(S, w) * S + hy.diff(S, f) * df)) / resist
            levels.append(S)
        self.manifold = hy.cfunc(levels, [w, f], fp_type=fp)
        up, down = hy.event_direction.positive, hy.event_direction.negative

        def make(system, *events):
            events = [hy.t_event(e, direction=d, fp_type=fp) for e, d in events]
            zeros = np.zeros(len(system), dtype=fp)
            return hy.taylor_adaptive(system, zeros, fp_type=fp, pars=self.values, t_events=events)

        full, slow = [(w, A), (f, df), (A, (pull - resist * A) / (M * V) - A * A)], [(w, S), (f, df)]
        self.full_plain, self.slow_plain = make(full), make(slow)
        self.full = make(full, (w - sw, down), (w - ev, up), (A, down), (A, up))
        self.slow = make(slow, (w - sw, up), (S, up))

    def run(self, ta, y, t):
        ta.time, ta.state[:] = self.fp(0), y
        if ta.with_events:
            ta.reset_cooldowns()
        outcome = int(ta.propagate_until(self.fp(t), max_steps=10**8)[0])
        if outcome != int(hy.taylor_outcome.time_limit) and not -10 < outcome < 0:
            raise RuntimeError(f"heyoka: {outcome}")
        return ta.state.copy(), ta.time, -1 - outcome

    def cycles(self, n):
        fp, p = self.fp, self.p
        y, t, times = np.array([np.log(fp(1.5) * fp(p["V_load"]) / fp(p["Vref"])), 0, 0], dtype=fp), fp(0), []

        def go(ta, duration):
            nonlocal y, t
            y, dt, event = self.run(ta, y, duration)
            t += dt
            return event

        def speed():
            return np.exp(y[0]) * fp(p["Vref"])

        def manifold():
            return self.manifold(y[:2].copy(), pars=self.values[: self.manifold.nparams])

        lowest = highest = None
        while True:
            # relax with the full equation, then switch to the manifold; also at the start, with A = 0 (net force zero)
            relaxed = False
            while not relaxed and speed() < 1.000001 * self.switch:  # for rounding: V may start at the switch
                m = manifold()
                relaxed = abs(y[2] / m[2] - 1) < self.tol and abs(m[1] / m[2] - 1) < 1e-10
                if not relaxed:
                    go(self.full_plain, 40 * fp(p["M"]) * speed() / fp(p["sigma"] * p["a"]))
            if relaxed:
                y = y[:2]
                while go(self.slow, 1e9) == 1:
                    lowest = min(lowest or np.inf, speed())
                    go(self.slow_plain, 1e-2)
                y = np.append(y, manifold()[2])
            while True:
                event = go(self.full, 1e9)
                if event == 0:
                    break
                if event == 1:
                    times.append(t)
                    if len(times) == n:
                        return {
                            "crossings_s": times,
                            "last_interval_s": times[-1] - times[-2],
                            "v_max_between_last_two": highest,
                            "v_min_between_last_two": lowest,
                        }
                    lowest = highest = None
                if event == 2:
                    highest = max(highest or 0, speed())
                if event == 3:
                    lowest = min(lowest or np.inf, speed())
                go(self.full_plain, 1e-8 if event == 1 else 1e-7)


def check_inertial(p, law, n, rtol):
    """The same by scipy's Radau IIA in (w, phi, A) throughout, analytic Jacobian, restarted at every event."""
    sig, a, b, L, Vr, Vl, eta, k, M = (p[x] for x in ("sigma", "a", "b", "L", "Vref", "V_load", "eta", "k", "M"))

    def parts(y):
        w, f, A = y
        V = Vr * math.exp(min(max(w, -300.0), 100.0))
        g = 1 / math.sqrt(1 + math.exp(-2 * max(w - math.log(2) + (MU0 + f) / a, -300.0)))
        if law == "ageing":
            heal = b * Vr / L * math.exp(min(-f / b, 600.0))
            df, df_w, df_f = heal - b * V / L, -b * V / L, -heal / b
        else:
            df = -(V / L) * (f + b * w)
            df_w, df_f = df - b * V / L, -V / L
        return V, g, df, df_w, df_f, A

    def rhs(_, y):
        V, g, df, _, _, A = parts(y)
        return [A, df, (k * (Vl - V) - sig * g * df - (sig * a * g + eta * V) * A) / (M * V) - A * A]

    def jac(_, y):
        V, g, df, df_w, df_f, A = parts(y)
        gx = g * (1 - g * g)
        force = k * (Vl - V) - sig * g * df - (sig * a * g + eta * V) * A
        by_w = (-k * V - sig * (gx * df + g * df_w) - (sig * a * gx + eta * V) * A - force) / (M * V)
        by_f = (-sig * (gx / a * df + g * df_f) - sig * gx * A) / (M * V)
        return [[0, 0, 1], [df_w, df_f, 0], [by_w, by_f, -(sig * a * g + eta * V) / (M * V) - 2 * A]]

    level = math.log(V_EVENT / Vr)

    def cross(_, y):
        return y[0] - level

    def extreme(_, y):
        return y[2]

    cross.terminal, cross.direction = True, 1
    extreme.terminal = False

    def solve(y, t0, t1, **more):
        return solve_ivp(rhs, (t0, t1), y, "Radau", jac=jac, rtol=rtol, atol=[rtol, rtol * 1e-2, rtol * 1e-3], **more)

    y, t, times = np.array([math.log(1.5 * Vl / Vr), 0.0, 0.0]), 0.0, []
    while len(times) < n:
        r = solve(y, 0.0, 1e9, events=[cross, extreme])
        if r.status != 1:
            raise RuntimeError(r.message)
        speeds = [Vr * math.exp(z[0]) for z in r.y_events[1]]
        t0, y0, te = r.t[-2], r.y[:, -2], r.t[-1]
        for _ in range(3):  # the interpolant only brackets the root
            y = solve(y0, t0, te).y[:, -1]
            if abs(y[0] - level) < 1e-14:
                break
            te -= (y[0] - level) / y[2]
        t += te
        times.append(t)
        y, t = solve(y, 0.0, 1e-6).y[:, -1], t + 1e-6  # away from the event
    return {"crossings_s": times, "last_interval_s": times[-1] - times[-2], "v_max_between_last_two": max(speeds), "v_min_between_last_two": min(speeds)}


def scipy_cost(reference):
    """Cost of reference_ageing in (ln(V/Vref), ln(Vref theta/L)): one call up to the 10th crossing, atol = rtol, scipy's first_step."""
    p = REFERENCE
    sig, a, b, L, Vr, Vl, eta, k = (p[n] for n in ("sigma", "a", "b", "L", "Vref", "V_load", "eta", "k"))
    ln2 = math.log(2)

    def parts(y):
        w, x = y
        V = Vr * math.exp(min(w, 600.0))
        X = max(w - ln2 + (MU0 + b * x) / a, -300.0)
        g = 1 / math.sqrt(1 + math.exp(-2 * X))
        heal = Vr / L * math.exp(min(-x, 600.0))
        dx = heal - V / L
        den = sig * a * g + eta * V
        return V, g, heal, dx, den, (k * (Vl - V) - sig * g * b * dx) / den

    def rhs(_, y):
        *_, dx, _, dw = parts(y)
        return [dw, dx]

    def jac(_, y):
        V, g, heal, dx, den, dw = parts(y)
        dg_dX = g * (1 - g * g)
        by_w = (-k * V - sig * b * (dg_dX * dx - g * V / L) - dw * (sig * a * dg_dX + eta * V)) / den
        by_x = (-sig * b * (dg_dX * b / a * dx - g * heal) - dw * sig * a * dg_dX * b / a) / den
        return [[by_w, by_x], [-V / L, -heal]]

    level = math.log(V_EVENT / Vr)

    def event(_, y):
        return y[0] - level

    event.terminal, event.direction = len(reference), 1
    v = math.log(Vl / Vr)
    rows = []
    for method in ("DOP853", "LSODA", "Radau"):
        for rtol in (1e-6, 1e-8, 1e-10):
            more = {} if method == "DOP853" else {"jac": jac}
            t0 = time.process_time()
            r = solve_ivp(rhs, (0, 1e11), [v + math.log(1.5), -v], method, events=event, rtol=rtol, atol=rtol, **more)
            cpu = time.process_time() - t0
            found = r.t_events[0]
            error = float(abs(found[-1] - reference[-1]) / (reference[-1] - reference[-2])) if len(found) == len(reference) else None
            rows.append(dict(method=method, rtol=rtol, status=r.status, steps=len(r.t) - 1, rhs=r.nfev, jacobians=int(r.njev), lu=int(r.nlu), cpu_s=round(cpu, 3),
                             crossings=len(found), error_of_last_over_recurrence=error))
            print(rows[-1], flush=True)
    return rows


def check(name, found):
    """The same case by Traction; None if the case has its own check."""
    law = "two" if name.startswith("two") else "slip" if name.endswith("slip") else "ageing"
    if name.startswith(("mild", "hard", "reference", "two")):
        p = {"mild": MILD, "hard": HARD, "refe": REFERENCE, "two_": TWO}[name[:4]]
        return check_cycles(p, law, len(found["crossings_s"]))
    if name.startswith("quasi_static_slow"):
        s = Traction(MILD | dict(k=1.1 * K_C, eta=0.0), law)
        return check_times(s, s.start([math.exp(0.1)]), found["t_s"])
    if name.startswith("slide_hold"):
        s = Traction(MILD | dict(k=5 * K_C), law)
        y0 = s.start([1.0])
        mu0 = s.mu(0.0, 0.0)[0]
        out = {"hold_s": found["hold_s"], "peak_minus_steady_mu": [], "time_of_peak_after_reload_s": [], "v_end_of_hold": []}
        for hold in found["hold_s"]:
            s.V_load, s.guess = 0.0, [0.0]
            y = s.plain(y0, 0, hold)
            out["v_end_of_hold"].append(1e-6 * math.exp(s.w(0, y, 0)))
            s.V_load = 1e-6
            y, t, _ = s.run("max_mu", y, 1e6)
            out["peak_minus_steady_mu"].append(s.mu(s.w(0, y, 0), s.phi(y, 0))[0] - mu0)
            out["time_of_peak_after_reload_s"].append(t)
        return out
    if name.startswith("normal_step"):
        s = Traction(MILD | dict(k=2 * K_C, sigma=5.5e6), "ageing")
        T = 5e6 * s.mu(0.0, 0.0)[0] + 5e6 * 1e-6
        x = -float(name.split("_")[-1]) * math.log(5.5 / 5) / MILD["b"]
        return check_times(s, np.array([(T - 5.5e6 * MU0) / (5.5e6 * 0.01), x]), found["t_s"])
    if name == "normal_oscillation":
        s = Traction(MILD | dict(k=2 * K_C), "ageing", oscillation=(0.1, 2 * math.pi / 5), alpha=0.2)
        return check_times(s, s.start([1.0]), found["t_s"])
    if name == "cut_off_neutral":
        s = Traction(MILD | dict(b=0.01, k=1e9, V_load=1e-5), "ageing")
        return check_times(s, s.start([1.0], 1e-6), found["t_s"])
    if name == "coupled_two":
        s = Traction(MILD | dict(k=0.8e9), "ageing", sliders=2, k_c=0.3e9)
        y, t, times = s.start([1.5, 0.8]), 0.0, [[], []]
        while min(map(len, times)) < 5:
            y, dt, i = s.run("cross", y, 1e6)
            times[i].append(t + dt)
            hop = 1e-3 * MILD["L"] / (1e-6 * math.exp(max(s.w(0, y, 0), s.w(0, y, 1))))
            y, t = s.plain(y, 0, hop), t + dt + hop
        return {"crossings_1_s": times[0][:5], "crossings_2_s": times[1][:5]}
    if name == "periodic_orbit":
        return orbit_closed_form(float)
    if name == "runaway_threshold":
        return {k: threshold_by_bisection(float(k.split("_")[-3])) for k in found}
    if name.startswith("inertial"):
        return check_inertial(INERTIAL | (DAMPED if "damped" in name else {}), law, len(found["crossings_s"]), 1e-10)
    return None


def cases():
    slow_p = MILD | dict(k=1.1 * K_C, eta=0.0)
    shs_p = MILD | dict(k=5 * K_C)
    c = {}
    for law in ("ageing", "slip"):
        c[f"mild_{law}"] = (MILD, lambda fp, law=law: cycles(MILD, law, 12, fp))
        c[f"hard_{law}"] = (HARD, lambda fp, law=law: cycles(HARD, law, 6, fp))
        c[f"quasi_static_slow_{law}"] = (slow_p, lambda fp, law=law: slow(law, fp))
        c[f"slide_hold_slide_{law}"] = (shs_p, lambda fp, law=law: slide_hold_slide(law, fp))
    c["reference_ageing"] = (REFERENCE, lambda fp: cycles(REFERENCE, "ageing", 10, fp))
    c["two_state_slip"] = (TWO, lambda fp: cycles(TWO, "two", 12, fp))
    for name, p in (("ageing", INERTIAL), ("slip", INERTIAL), ("damped_ageing", INERTIAL | DAMPED)):
        c[f"inertial_{name}"] = (p, lambda fp, p=p, law=name.split("_")[-1]: Inertial(p, law, fp).cycles(6))
    for alpha in (0.0, 0.3):
        c[f"normal_step_alpha_{alpha:g}"] = (
            MILD | dict(k=2 * K_C, sigma_before=5e6, sigma_after=5.5e6, alpha=alpha),
            lambda fp, alpha=alpha: normal_step(alpha, fp),
        )
    c["normal_oscillation"] = (MILD | dict(k=2 * K_C, amplitude=0.1, period_s=5.0, alpha=0.2), normal_oscillation)
    c["coupled_two"] = (MILD | dict(k=0.8e9, k_coupling=0.3e9), coupled)
    c["periodic_orbit"] = (MILD | dict(k=K_C, eta=0.0, kick=0.5), orbit)
    c["runaway_threshold"] = (dict(a=0.01, b=0.015), thresholds)
    c["cut_off_neutral"] = (MILD | dict(b=0.01, k=1e9, V_load_before=1e-6, V_load=1e-5), neutral)
    return c


def difference(x, y):
    """Largest relative difference per quantity (of a closure, which is zero, the absolute one)."""
    out = {}
    for key in x:
        if key in ("t_s", "hold_s") or key not in y:
            continue
        u, v = (np.atleast_1d(np.array(z, dtype=np.longdouble)) for z in (x[key], y[key]))
        out[key] = float(np.max(np.abs(u - v) / (1 if key.startswith("closure") else np.abs(u))))
    return out


def plain_numbers(x):
    if isinstance(x, dict):
        return {k: plain_numbers(v) for k, v in x.items()}
    if isinstance(x, (list, tuple)):
        return [plain_numbers(v) for v in x]
    return float(x) if isinstance(x, np.floating) else x


def main():
    path = pathlib.Path(__file__).with_suffix(".json")
    only = sys.argv[1:]
    results = json.loads(path.read_text()) if only and path.exists() else {}
    results |= {
        "date": datetime.date.today().isoformat(),
        "python": platform.python_version(),
        "packages": {m.__name__: m.__version__ for m in (np, scipy, hy)},
        "units": "SI; mu0 = 0.6; uncertainty: largest relative difference of the quantity, see README.md",
    }
    for name, (p, f) in cases().items():
        if only and not any(o in name for o in only):
            continue
        t0 = time.time()
        r = f(np.longdouble)
        unc = {"heyoka_64_bit": difference(r, f(np.float64))}
        t1 = time.time()
        other = check(name, r)
        if other is not None:
            key = {"peri": "closed_form_and_dop853", "iner": "scipy_radau"}.get(name[:4], "scipy_dop853")
            unc[key] = difference(r, other)
        results[name] = {"parameters": p, "quantities": plain_numbers(r), "uncertainty": unc}
        print(name, f"{t1 - t0:.1f} s, {time.time() - t1:.1f} s", json.dumps(unc), flush=True)
        path.write_text(json.dumps(results, indent=1) + "\n")
    if not only or "scipy_cost" in only:
        results["scipy_cost"] = scipy_cost(np.array(results["reference_ageing"]["quantities"]["crossings_s"]))
        path.write_text(json.dumps(results, indent=1) + "\n")


if __name__ == "__main__":
    main()
