"""A slider with frictional heat through its first event, independent of the Rust code: temperature and pressure by finite
volumes across the fault, slip rates from the balance of tractions, scipy's BDF for everything at once.

Unknowns: slip, the logarithm of the state, temperature and pressure in cells that grow by a constant factor from the centre
of the zone. Nothing is transformed: no modes, no history, no unknown m. Writes frictional_heat.json: for each variant the
onset of the event, its duration, slip, largest slip rate, largest temperature and pressure, and drop of traction, with 100,
200 and 400 cells and extrapolated. About five minutes.
"""

import json
import sys

import numpy as np
import scipy
from scipy.integrate import solve_ivp
from scipy.sparse import lil_matrix
from scipy.special import erf

YOUNG, POISSON, RHO = 80e9, 0.25, 2670.0
G = YOUNG / (2 * (1 + POISSON))
ETA = 0.5 * np.sqrt(G * RHO)
LENGTH = 4e3
K = 2 * G / (np.pi * LENGTH)
A, B, L, F0, V0 = 0.010, 0.015, 10e-3, 0.6, 1e-6
SIGMA, V_PL, V_START, V_STATE = 50e6, 1e-9, 1e-9, 1e-8
H, CAPACITY, ALPHA_TH, T0 = 20e-3, 2.7e6, 1e-6, 400.0
LAMBDA, ALPHA_HY = 0.1e6, 10e-6
GAS = 8.314462618
ON, OFF = 1e-3, 1e-4
YEAR = 365.25 * 86400

VARIANTS = {
    # Temperature changes friction, and the pressure of fluid.
    "pressurised": dict(law="ageing", activation=1e5, coefficient=LAMBDA),
    # Temperature alone.
    "arrhenius": dict(law="ageing", activation=1e5, coefficient=0.0),
    # Fluid alone.
    "fluid": dict(law="ageing", activation=0.0, coefficient=LAMBDA),
    # Contacts that weaken at 1200 K, and fluid.
    "flash": dict(law="flash", activation=0.0, coefficient=LAMBDA, weakening=1200.0, mu_w=0.3, v_w=0.1),
}


def grid(n, w, far):
    """Faces of n cells from 0 to far, the first of which are w/40 at n = 400."""
    first = w / 40 * 400 / n
    low, high = 1.0 + 1e-9, 1.5
    for _ in range(200):
        q = 0.5 * (low + high)
        if first * (q**n - 1) / (q - 1) > far:
            high = q
        else:
            low = q
    return np.concatenate([[0.0], first * (q ** np.arange(1, n + 1) - 1) / (q - 1)])


class Slider:
    def __init__(self, n, variant):
        self.v = variant
        w = H / np.sqrt(2 * np.pi)
        faces = grid(n, w, 400.0)
        self.n, self.size = n, np.diff(faces)
        centres = 0.5 * (faces[1:] + faces[:-1])
        self.between = np.diff(centres)
        # Share of the heat per volume, exactly in each cell: both halves of the zone get half.
        self.source = 0.5 * np.diff(erf(faces / (np.sqrt(2) * w))) / self.size
        # The centre z = 0 from the two nearest cells: even in z, so value = a + b z².
        z0, z1 = centres[0] ** 2 + self.size[0] ** 2 / 12, centres[1] ** 2 + self.size[1] ** 2 / 12
        self.centre = np.array([z1, -z0]) / (z1 - z0)
        if variant["law"] == "ageing":
            self.psi0 = B * np.log(V0 / V_STATE)
        else:
            self.psi0 = self.steady(V_STATE, T0)
        self.tau0 = SIGMA * self.friction(np.log(V_START), self.psi0, T0) + ETA * V_START

    def friction(self, log_rate, psi, temperature):
        """Regularised friction; psi is the state in units of friction."""
        shift = self.v["activation"] / GAS * (1 / temperature - 1 / 400.0)
        return A * np.arcsinh(0.5 * np.exp(log_rate + shift - np.log(V0) + (F0 + psi) / A))

    def steady(self, rate, temperature):
        v = self.v
        share = max(v["weakening"] - temperature, 0.0) / (v["weakening"] - T0)
        v_w = v["v_w"] * share**2
        low = F0 + (A - B) * np.log(rate / V0)
        weak = v["mu_w"] + (low - v["mu_w"]) / (1 + (rate / v_w) ** 8) ** 0.125 if v_w > 0 else v["mu_w"]
        return weak - F0 - A * np.log(rate / V0)

    def log_rate(self, drive, normal, psi, temperature):
        """Root of drive = normal mu + eta V, by Newton's method in ln V from above, then checked."""
        x = np.log(max(drive, 1.0) / ETA)
        low, high = -120.0, x
        x = min(x, np.log(V0) + (drive / normal - F0 - psi) / A)
        for _ in range(200):
            shift = self.v["activation"] / GAS * (1 / temperature - 1 / 400.0)
            e = 0.5 * np.exp(min(x + shift - np.log(V0) + (F0 + psi) / A, 600.0))
            g = normal * A * np.arcsinh(e) + ETA * np.exp(x) - drive
            if g > 0:
                high = x
            else:
                low = x
            step = g / (normal * A * e / np.sqrt(1 + e * e) + ETA * np.exp(x))
            new = x - step
            if not low < new < high:
                new = 0.5 * (low + high)
            if abs(new - x) < 1e-14 * max(abs(x), 1.0):
                return new
            x = new
        return x

    def present(self, t, y):
        n = self.n
        temperature = T0 + self.centre @ y[2:4]
        pressure = self.centre @ y[2 + n : 4 + n]
        drive = self.tau0 + K * (V_PL * t - y[0])
        x = self.log_rate(drive, SIGMA - pressure, y[1], temperature)
        return x, temperature, pressure, drive

    def rates(self, t, y):
        n = self.n
        x, temperature, pressure, drive = self.present(t, y)
        rate = np.exp(x)
        dy = np.empty_like(y)
        dy[0] = rate
        if self.v["law"] == "ageing":
            # psi = B ln(V0 theta/L).
            dy[1] = B * (V0 / L * np.exp(-y[1] / B) - rate / L)
        else:
            dy[1] = -rate / L * (y[1] - self.steady(rate, temperature))
        heat = (drive - ETA * rate) * rate / CAPACITY

        def diffused(u, alpha):
            flow = np.concatenate([[0.0], alpha * np.diff(u) / self.between, [0.0]])
            return np.diff(flow) / self.size

        dt = diffused(y[2 : 2 + n], ALPHA_TH) + heat * self.source
        dy[2 : 2 + n] = dt
        dy[2 + n :] = diffused(y[2 + n :], ALPHA_HY) + self.v["coefficient"] * dt
        return dy

    def sparsity(self):
        n = self.n
        s = lil_matrix((2 * n + 2, 2 * n + 2), dtype=int)
        felt = [0, 1, 2, 3, 2 + n, 3 + n]
        s[:, felt] = 1
        for k in range(n):
            for j in range(max(k - 1, 0), min(k + 2, n)):
                s[2 + k, 2 + j] = s[2 + n + k, 2 + n + j] = s[2 + n + k, 2 + j] = 1
        return s

    def run(self, rtol):
        n = self.n
        y = np.zeros(2 * n + 2)
        y[1] = self.psi0
        atol = np.full(2 * n + 2, rtol)
        atol[0], atol[1] = 1e-2 * L * rtol, 0.1 * A * rtol
        atol[2 : 2 + n], atol[2 + n :] = 100.0 * rtol, 1e6 * rtol

        def crossing(level, direction):
            def event(t, y):
                return self.present(t, y)[0] - np.log(level)

            event.terminal, event.direction = True, direction
            return event

        # Time from the start of each part, so that short steps keep their digits.
        parts, base, out = [(ON, 1, 60 * YEAR), (ON, -1, 1e5), (OFF, -1, 1e6)], 0.0, {}
        seen = []
        for level, direction, longest in parts:
            def rates(t, y, base=base):
                return self.rates(base + t, y)

            hit = crossing(level, direction)

            def event(t, y, base=base, hit=hit):
                return hit(base + t, y)

            event.terminal, event.direction = True, direction
            sol = solve_ivp(
                rates, (0.0, longest), y, method="BDF", rtol=rtol, atol=atol, jac_sparsity=self.sparsity(), events=event, dense_output=direction < 0
            )
            assert sol.status == 1, sol.message
            t, y = sol.t_events[0][0], sol.y_events[0][0]
            if direction < 0:
                for a, b in zip(sol.t[:-1], sol.t[1:]):
                    for s in np.linspace(a, b, 9):
                        seen.append(self.present(base + s, sol.sol(s))[:3])
            else:
                start = (base + t, y.copy(), self.present(base + t, y))
            base += t
            if direction > 0:
                out["onset"] = base
            elif level == ON:
                out["duration_above"] = base - out["onset"]
        end = self.present(base, y)
        seen = np.array(seen)
        resisted = lambda p: p[3] - ETA * np.exp(p[0])
        out["duration"] = base - out["onset"]
        out["slip"] = y[0] - start[1][0]
        out["peak_rate"] = float(np.exp(seen[:, 0].max()))
        out["largest_temperature"] = float(seen[:, 1].max())
        out["largest_pressure"] = float(seen[:, 2].max())
        out["stress_drop"] = float(resisted(start[2]) - resisted(end))
        return {k: float(v) for k, v in out.items()}


def main(names, sizes, rtol):
    result = {"numpy": np.__version__, "scipy": scipy.__version__, "rtol": rtol, "cells": sizes}
    for name in names:
        levels = [Slider(n, VARIANTS[name]).run(rtol) for n in sizes]
        for n, level in zip(sizes, levels):
            print(name, n, level, flush=True)
        # Second order in the size of cells.
        limit = {k: levels[-1][k] + (levels[-1][k] - levels[-2][k]) / 3 for k in levels[-1]}
        change = {k: abs(levels[-1][k] - levels[-2][k]) / 3 / max(abs(limit[k]), 1e-300) for k in limit}
        result[name] = {"levels": levels, "limit": limit, "change": change}
    return result


if __name__ == "__main__":
    names = sys.argv[1:] or list(VARIANTS)
    result = main(names, [100, 200, 400], 1e-9)
    if not sys.argv[1:]:
        with open("frictional_heat.json", "w") as file:
            json.dump(result, file, indent=1)
            file.write("\n")
