"""SEAS BP6-QD-A and -S, independent of the Rust code: boundary elements of constant slip in a whole space, scipy's DOP853 for slip
and the logarithm of the state, slip rates from the balance of tractions by Newton's method, pressure in closed form.

Writes bp6.json: slip at 0, 1 and 2 km from the injection after 100 d and 2 yr, and the largest slip rate of all times.
"""

import json
import sys

import numpy as np
from scipy.integrate import solve_ivp
from scipy.special import erfc

RHO, CS = 2670.0, 3464.0
MU = RHO * CS**2
ETA = MU / (2 * CS)
A, B, L, F0, V0 = 0.007, 0.005, 4e-3, 0.6, 1e-6
SIGMA, TAU, V_INIT = 50e6, 29.2e6, 1e-12
ALPHA, PHI, BETA, Q0 = 0.1, 0.1, 1e-8, 1.25e-6
DAY = 86400.0
OFF, END = 100 * DAY, 2 * 365.25 * DAY
HALF = 20e3


def response(z, t):
    if t <= 0:
        return np.zeros_like(z)
    x = np.abs(z) / np.sqrt(4 * ALPHA * t)
    return np.sqrt(t) * (np.exp(-x * x) / np.sqrt(np.pi) - x * erfc(x))


def pressure(z, t):
    return Q0 / (BETA * PHI * np.sqrt(ALPHA)) * (response(z, t) - response(z, t - OFF))


def solve(law, h):
    n = round(2 * HALF / h)
    # Midpoints of cells, an odd number, so that one lies at the injection.
    n += 1 - n % 2
    h = 2 * HALF / n
    z = (np.arange(n) - (n - 1) / 2) * h
    d = z[:, None] - z[None, :]
    # Slip s between z' - h/2 and z' + h/2 lowers the traction at z' by 2 MU s/(pi h).
    kernel = MU / (2 * np.pi) * (1 / (d - h / 2) - 1 / (d + h / 2))
    assert np.isclose(kernel[0, 0], -2 * MU / (np.pi * h)) and kernel[0, 1] > 0
    theta = L / V0 * np.exp(A / B * np.log(2 * V0 / V_INIT * np.sinh((TAU - ETA * V_INIT) / (A * SIGMA))) - F0 / B)
    guess = np.full(n, np.log(V_INIT))

    def rates(t, y):
        """ln V of all cells: sigma a asinh(V/(2 V0) exp((f0 + b ln(V0 theta/L))/a)) + eta V = tau."""
        s, psi = y[:n], y[n:]
        tau = TAU + kernel @ s
        sigma = SIGMA - pressure(z, t)
        c = (F0 + B * (np.log(V0 / L) + psi)) / A - np.log(2 * V0)
        x = guess.copy()
        for _ in range(100):
            v = np.exp(x)
            e = np.exp(np.minimum(x + c, 300.0))
            f = sigma * A * np.arcsinh(e) + ETA * v - tau
            step = f / (sigma * A * e / np.sqrt(1 + e * e) + ETA * v)
            x -= np.clip(step, -2, 2)
            if np.max(np.abs(step)) < 1e-13 * 40:
                break
        guess[:] = x
        v = np.exp(x)
        if law == "ageing":
            dpsi = np.exp(-psi) - v / L
        else:
            dpsi = -v / L * (x + psi - np.log(L))
        return np.concatenate([v, dpsi])

    y = np.concatenate([np.zeros(n), np.full(n, np.log(theta))])
    peak, found = 0.0, {}
    for start, end, name in [(0.0, OFF, "100 d"), (OFF, END, "2 yr")]:
        out = solve_ivp(rates, (start, end), y, method="DOP853", rtol=1e-10, atol=np.r_[np.full(n, 1e-9), np.full(n, 1e-8)], first_step=1.0)
        assert out.success
        for t, column in zip(out.t, out.y.T):
            peak = max(peak, rates(t, column)[:n].max())
        y = out.y[:, -1]
        found[name] = [float(np.interp(place, z, y[:n])) for place in (0.0, 1e3, 2e3)]
    return {"law": law, "cell [m]": h, "slip after 100 d [m]": found["100 d"], "slip after 2 yr [m]": found["2 yr"], "peak rate [m/s]": float(peak)}


if __name__ == "__main__":
    sizes = [float(a) for a in sys.argv[1:]] or [200.0, 100.0, 50.0, 25.0]
    results = []
    for law in ("ageing", "slip"):
        for h in sizes:
            results.append(solve(law, h))
            print(results[-1], flush=True)
    with open("bp6.json", "w") as file:
        json.dump(results, file, indent=1)
