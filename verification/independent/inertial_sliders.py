"""Spring sliders with mass, by scipy's integrators only, independent of the Rust code.

    python inertial_sliders.py

A cycle is composed of three parts, chosen to avoid unnecessary stiffness.
* Below V_SWITCH inertia is neglected: DOP853 in w = ln(V/Vref) and the state. The error is M V'/(sigma a) < 1e-7 in ln V for the last
  100 to 8000 s before an event, some 1e-12 of a recurrence.
* Above it, and until V has fallen to V_ARREST: Radau IIA in w, the state and the traction T of the spring, M V' = T - sigma mu.
* The block then loses its remaining V within M V_ARREST/(sigma a) or less. T and the state are unchanged, and V is the one at which
  sigma mu = T: the root of a linear equation in ln V.
mu = mu0 + a w + phi, which agrees with the regularised form to exp(-2 mu/a) < 1e-20 here.  Units: SI.  Writes inertial_sliders.json.
"""

import json
import pathlib

import numpy as np
from scipy.integrate import solve_ivp

MU0, VREF, SIGMA, B = 0.6, 1e-6, 50e6, 0.015
V_SWITCH, V_ARREST, ON, OFF = 1e-6, 1e-9, 1e-3, 1e-4
SETS = [
    dict(law="slip", a=0.006, L=8e-3, k=28.125e6, M=71.24, load=1e-9),
    dict(law="slip", a=0.010, L=8e-3, k=6.25e6, M=1.5e5, load=1e-9),
    dict(law="ageing", a=0.0045, L=8e-3, k=3.28125e6, M=2e6, load=1e-9),
    dict(law="ageing", a=0.010, L=8e-3, k=15.625e6, M=3e3, load=1e-7),
    dict(law="ageing", a=0.006, L=1e-4, k=2.25e9, M=2e6, load=1e-9),
]


def phi(p, s):
    return B * s if p["law"] == "ageing" else s


def rate(p, w, s):
    """Rate of the state: psi = ln(Vref theta/L), or phi itself for the slip law."""
    if p["law"] == "ageing":
        return (VREF / p["L"]) * (np.exp(-s) - np.exp(w))
    return -(VREF / p["L"]) * np.exp(w) * (s + B * w)


def dphi(p, w, s):
    return (B if p["law"] == "ageing" else 1.0) * rate(p, w, s)


def slow(p, y):
    """Integrates without inertia from y = (w, s) until V rises to V_SWITCH: duration, and unknowns then."""

    def rhs(_, y):
        w, s = y
        stress = p["k"] * (p["load"] - VREF * np.exp(w)) / SIGMA
        return [(stress - dphi(p, w, s)) / p["a"], rate(p, w, s)]

    def fast(_, y):
        return y[0] - np.log(V_SWITCH / VREF)

    fast.terminal, fast.direction = True, 1
    r = solve_ivp(rhs, (0, 1e12), y, method="DOP853", rtol=1e-12, atol=1e-12, events=fast)
    assert r.status == 1, r.message
    return r.t[-1], r.y[:, -1]


def fast(p, y):
    """Integrates with inertia from y = (w, s) until V falls to V_ARREST: onset, end, largest V, duration, state and traction then."""

    def rhs(_, y):
        w, s, tau = y
        v = VREF * np.exp(w)
        net = SIGMA * (tau - MU0 - p["a"] * w - phi(p, s))
        return [net / (p["M"] * v), rate(p, w, s), p["k"] * (p["load"] - v) / SIGMA]

    def jac(_, y):
        w, s, tau = y
        v = VREF * np.exp(w)
        net = tau - MU0 - p["a"] * w - phi(p, s)
        c = SIGMA / (p["M"] * v)
        by = B if p["law"] == "ageing" else 1.0
        if p["law"] == "ageing":
            state = [-v / p["L"], -(VREF / p["L"]) * np.exp(-s), 0]
        else:
            state = [-(v / p["L"]) * (s + B * w + B), -v / p["L"], 0]
        return [[c * (-p["a"] - net), -c * by, c], state, [-p["k"] * v / SIGMA, 0, 0]]

    def through(v, direction):
        def event(_, y):
            return y[0] - np.log(v / VREF)

        event.terminal, event.direction = True, direction
        return event

    def peak(t, y):
        return rhs(t, y)[0] * np.exp(y[0])

    peak.direction, peak.terminal = -1, True
    y = np.array([y[0], y[1], MU0 + p["a"] * y[0] + phi(p, y[1])])
    times, largest = [], None
    # Time restarts at 0 in each part: the last ones take 1e-9 s.
    for stop in (through(ON, 1), peak, through(OFF, -1), through(V_ARREST, -1)):
        r = solve_ivp(rhs, (0, 1e9), y, method="Radau", jac=jac, rtol=1e-10, atol=1e-10, events=stop)
        assert r.status == 1, r.message
        times.append(r.t[-1])
        y = r.y[:, -1]
        if stop is peak:
            largest = VREF * np.exp(y[0])
    return times[0], times[0] + times[1] + times[2], largest, sum(times), y[1], y[2]


def cycles(p, number):
    w, load = np.log(1.5 * p["load"] / VREF), np.log(p["load"] / VREF)
    s = -load if p["law"] == "ageing" else -B * load
    before, since, found = None, 0.0, []
    for _ in range(number):
        waited, (w, s) = slow(p, (w, s))
        onset, end, peak, taken, s, tau = fast(p, (w, s))
        found.append(dict(interval=since + waited + onset if before else None, duration=end - onset, peak=peak))
        before, since = True, taken - onset
        w = (tau - MU0 - phi(p, s)) / p["a"]
    return found


if __name__ == "__main__":
    results = [dict(**p, events=cycles(p, 3)) for p in SETS]
    path = pathlib.Path(__file__).with_suffix(".json")
    path.write_text(json.dumps(results, indent=1) + "\n")
    for r in results:
        print(r)
