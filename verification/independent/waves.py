"""References for waves in bodies, independent of the Rust code: Lamb's line load, and plane waves at a border of dashpots.

    python waves.py                            # rewrites waves.json; ten seconds

**Lamb's problem in plane strain.** Half-plane z > 0, a line load F(t) [N/m] on its surface at x = 0, along +z (into the body). Displacements at the
surface at x > 0 per unit impulse, by the method of Cagniard and de Hoop with p = t/x, A = 1/cs^2 - 2 p^2, a = sqrt|p^2 - 1/cp^2|,
b = sqrt|p^2 - 1/cs^2|, and R = A^2 + 4 i p^2 a b for 1/cp < p < 1/cs, R = A^2 - 4 p^2 a b for p > 1/cs:

    g_z = -Im(i a/R)/(pi mu x cs^2)                                              p > 1/cp, principal value at the Rayleigh pole p_R
    g_x = -Im(p (A - 2 i a b)/R)/(pi mu x)   1/cp < p < 1/cs,   and   -(p_R/mu) (A + 2 a b)/(dR/dp) delta(t - p_R x)

Checked against the integral over real wavenumbers of the Laplace transform, and against Flamant's static u_x. Responses are numerical integrals of
g times the load, good to 1e-8 of the largest. `step`: F = F0 from t = 0 (u_z is infinite at the Rayleigh arrival, logarithmically). `smooth`:
F = F0 [t/T - sin(2 pi t/T)/(2 pi)] up to T, then F0.

**Dashpots** of Lysmer and Kuhlemeyer, tractions -rho cp v_n and -rho cs v_t. A plane wave comes at an angle to the normal; the reflected P and SV wave
(displacement amplitudes over that of the incoming wave, moduli) follow from two equations, the tractions of the three waves being those of the
dashpots. `energy` is the reflected flux through the border over the incoming one. Beyond the critical angle of SV waves the P wave creeps along the
border, and carries no energy. SH: (1 - cos)/(1 + cos).

Layout of waves.json: `lamb` has the parameters, `arrivals_s` and `receivers`, each with x_m, `smooth` (u_x_m, u_z_m, v_x_m_s, v_z_m_s) and `step`
(u_x_m, u_z_m) at `times_s`; `dashpots` has, by ratio cp/cs, `angle_deg` and, for P, SV and SH, moduli and energy. z and u_z point into the body.
"""

import json
import platform
import time
from pathlib import Path

import numpy as np
import scipy
from scipy.integrate import quad
from scipy.optimize import brentq

from dynamic_rupture import dump

RHO, CS = 2000.0, 2000.0
CP = np.sqrt(3.0) * CS  # lambda = mu
MU, F0, RISE = RHO * CS**2, 1e6, 0.4
RECEIVERS, TIMES = [500.0, 1000.0, 2000.0], np.round(np.arange(0, 2.0001, 0.02), 10)


def parts(p):
    return 1 / CS**2 - 2 * p * p, np.sqrt(abs(p * p - 1 / CP**2)), np.sqrt(abs(p * p - 1 / CS**2))


def rayleigh(p):
    """R for p > 1/cs."""
    big, a, b = parts(p)
    return big**2 - 4 * p * p * a * b


P_R = brentq(rayleigh, 1.0000001 / CS, 2 / CS, xtol=1e-20, rtol=1e-15)


def slope():
    """dR/dp at the pole."""
    big, a, b = parts(P_R)
    return -8 * P_R * big - 8 * P_R * a * b - 4 * P_R**3 * (b / a + a / b)


def g_z(p, x):
    big, a, b = parts(p)
    r = big**2 + 4j * p * p * a * b if p < 1 / CS else rayleigh(p)
    return -(1j * a / r).imag / (np.pi * MU * x * CS**2)


def g_x(p, x):
    big, a, b = parts(p)
    return -(p * (big - 2j * a * b) / (big**2 + 4j * p * p * a * b)).imag / (np.pi * MU * x)


def jump_x():
    big, a, b = parts(P_R)
    return -(P_R / MU) * (big + 2 * a * b) / slope()


def integrate(f, lower, upper):
    return quad(f, lower, upper, epsabs=1e-12 / MU, epsrel=1e-10, limit=400)[0] if upper > lower else 0.0


def respond(load, t, x, kinks):
    """u_x and u_z of a load(time) at time t; `kinks` are times where a derivative of the load jumps."""
    ends = [x / CP, x / CS, P_R * x]
    if t <= ends[0]:
        return 0.0, 0.0
    edges = sorted({e for e in [*ends, *(t - k for k in kinks)] if ends[0] <= e < t} | {t})
    u_x = load(t - ends[2]) * jump_x() if t > ends[2] else 0.0
    u_z = 0.0
    for lower, upper in zip(edges[:-1], edges[1:]):
        if upper <= ends[1] * (1 + 1e-15):
            u_x += integrate(lambda s: g_x(s / x, x) * load(t - s), lower, upper)
    # The pole is taken out of its neighbourhood, within which the load is smooth or the pole lies at its edge.
    pole, strength = ends[2], -parts(P_R)[1] / (np.pi * MU * x * CS**2) / slope() * x
    reach = 0.9 * (pole - ends[1])

    def regular(s):
        if abs(s - pole) < 1e-7 * pole:
            s = pole * (1 + 1e-7)
        return g_z(s / x, x) - (strength / (s - pole) if abs(s - pole) < reach else 0.0)

    marks = sorted(set(edges) | {e for e in (pole - reach, pole + reach) if ends[0] < e < t})
    for lower, upper in zip(marks[:-1], marks[1:]):
        u_z += integrate(lambda s: regular(s) * load(t - s), lower, upper)
    return u_x, u_z + strength * principal(load, t, pole, reach, kinks)


def principal(load, t, pole, reach, kinks):
    """Principal value of the integral of load(t - s)/(s - pole) over |s - pole| < reach, s < t, with load(t - pole) taken out."""
    lower, upper = pole - reach, min(pole + reach, t)
    if upper <= lower:
        return 0.0
    value = load(t - pole) if t > pole else 0.0
    marks = sorted({lower, upper, *(e for e in (pole, *(t - k for k in kinks)) if lower < e < upper)})
    total = sum(integrate_difference(load, value, t, pole, a, b) for a, b in zip(marks[:-1], marks[1:]))
    return total + (value * np.log((upper - pole) / reach) if value else 0.0)


def integrate_difference(load, value, t, pole, lower, upper):
    return quad(lambda s: (load(t - s) - value) / (s - pole), lower, upper, epsabs=1e-13, epsrel=1e-10, limit=400)[0]


def ramp(t):
    return 0.0 if t <= 0 else 1.0 if t >= RISE else t / RISE - np.sin(2 * np.pi * t / RISE) / (2 * np.pi)


def ramp_rate(t):
    return (1 - np.cos(2 * np.pi * t / RISE)) / RISE if 0 < t < RISE else 0.0


def step(t):
    return 1.0 if t >= 0 else 0.0


def check():
    """Laplace transforms at s = 3 1/s against the integral over wavenumbers, and Flamant's horizontal displacement."""
    x, s = 700.0, 3.0

    def root(k, c):
        return np.sqrt(k * k + (s / c) ** 2)

    def kernel(k):
        na, nb = root(k, CP), root(k, CS)
        m = k * k + nb * nb
        return na * (s / CS) ** 2 / (m * m - 4 * k * k * na * nb), k * (m - 2 * na * nb) / (m * m - 4 * k * k * na * nb)

    cosine = quad(lambda k: kernel(k)[0], 0, np.inf, weight="cos", wvar=x, epsabs=1e-10, limlst=200, limit=400)[0] / (np.pi * MU)
    sine = quad(lambda k: kernel(k)[1], 0, np.inf, weight="sin", wvar=x, epsabs=1e-10, limlst=200, limit=400)[0] / (np.pi * MU)
    pole, wing = P_R * x, 0.5 * (P_R - 1 / CS) * x
    z = integrate(lambda t: g_z(t / x, x) * np.exp(-s * t), x / CP, x / CS) + integrate(lambda t: g_z(t / x, x) * np.exp(-s * t), x / CS, pole - wing)
    z += quad(lambda t: g_z(t / x, x) * (t - pole) * np.exp(-s * t), pole - wing, pole + wing, weight="cauchy", wvar=pole, epsabs=0, epsrel=1e-9)[0]
    z += integrate(lambda t: g_z(t / x, x) * np.exp(-s * t), pole + wing, pole + 20)
    moved = integrate(lambda t: g_x(t / x, x) * np.exp(-s * t), x / CP, x / CS) + jump_x() * np.exp(-s * pole)
    static = integrate(lambda t: g_x(t / x, x), x / CP, x / CS) + jump_x()
    flamant = -0.5 / (4 * MU)  # -(1 - 2 nu)/(4 mu), nu = 1/4
    errors = {"u_z_transform": abs(z / cosine - 1), "u_x_transform": abs(moved / sine - 1), "u_x_static": abs(static / flamant - 1)}
    assert max(errors.values()) < 1e-9, errors
    return {k: float(f"{v:.2g}") for k, v in errors.items()}


def lamb():
    receivers = []
    for x in RECEIVERS:
        smooth = np.array([(*respond(ramp, t, x, [0.0, RISE]), *respond(ramp_rate, t, x, [0.0, RISE])) for t in TIMES]) * F0
        sudden = np.array([respond(step, t, x, []) for t in TIMES]) * F0
        receivers.append({"x_m": x, "smooth": {k: digits(smooth[:, i]) for i, k in enumerate(["u_x_m", "u_z_m", "v_x_m_s", "v_z_m_s"])},
                          "step": {k: digits(sudden[:, i]) for i, k in enumerate(["u_x_m", "u_z_m"])}})
    return {"parameters": {"rho_kg_m3": RHO, "cp_m_s": CP, "cs_m_s": CS, "mu_pa": MU, "f0_n_m": F0, "rise_s": RISE, "rayleigh_m_s": 1 / P_R},
            "checks": check(), "times_s": TIMES.tolist(),
            "arrivals_s": [{"x_m": x, "p": x / CP, "s": x / CS, "rayleigh": P_R * x} for x in RECEIVERS], "receivers": receivers}


def reflect(wave, angle, ratio):
    """Moduli of reflected P and SV and the share of energy reflected; cs = rho = 1, cp = ratio, body z < 0, incoming wave along +z."""
    cp = ratio
    p = np.sin(angle) / (cp if wave == "P" else 1.0)

    def upright(c):  # vertical slowness of a reflected wave: towards -z, or decaying
        d = 1 / c**2 - p * p
        return -np.sqrt(d) if d >= 0 else -1j * np.sqrt(-d)

    ep, es = upright(cp), upright(1.0)
    waves = {"P": ((cp * p, cp * ep), ep), "SV": ((-es, p), es)}
    incoming = ((cp * p, -cp * ep), -ep) if wave == "P" else ((-es, -p), -es)

    def excess(displacement, vertical):
        ux, uz = displacement
        return np.array([vertical * ux + p * uz - ux, cp**2 * vertical * uz + (cp**2 - 2) * p * ux - cp * uz])

    matrix = np.array([excess(*waves["P"]), excess(*waves["SV"])], dtype=complex).T
    amplitudes = np.linalg.solve(matrix, -excess(*incoming).astype(complex))
    flux = [abs(amplitudes[0]) ** 2 * cp**2 * -np.real(ep), abs(amplitudes[1]) ** 2 * -np.real(es)]
    came = cp**2 * -np.real(ep) if wave == "P" else -np.real(es)
    ux, uz = (sum(a * np.array(w[0]) for a, w in zip(amplitudes, waves.values())) + incoming[0])
    assert abs(abs(ux) ** 2 + cp * abs(uz) ** 2 + sum(flux) - came) < 1e-12  # what dashpots take
    return abs(amplitudes[0]), abs(amplitudes[1]), sum(flux) / came


def dashpots():
    out, degrees = {}, np.arange(0, 90)
    for name, ratio in (("lambda = mu", np.sqrt(3.0)), ("6000/3464", 6000 / 3464)):
        table = {"cp_over_cs": ratio, "angle_deg": degrees.tolist()}
        for wave in ("P", "SV"):
            rows = np.array([reflect(wave, np.radians(d), ratio) for d in degrees])
            table[wave] = {k: digits(rows[:, i]) for i, k in enumerate(["p", "sv", "energy"])}
        c = np.cos(np.radians(degrees))
        table["SH"] = {"sh": digits((1 - c) / (1 + c)), "energy": digits(((1 - c) / (1 + c)) ** 2)}
        assert max(table["P"]["p"][0], table["SV"]["sv"][0]) < 1e-12 and max(table["P"]["energy"] + table["SV"]["energy"]) < 1 + 1e-9
        out[name] = table
    return out


def digits(values):
    return [float(f"{v:.7g}") if abs(v) > 1e-15 else 0.0 for v in values]


if __name__ == "__main__":
    versions = {"python": platform.python_version(), "numpy": np.__version__, "scipy": scipy.__version__, "date": time.strftime("%Y-%m-%d")}
    results = {"versions": versions, "lamb": lamb(), "dashpots": dashpots()}
    Path(__file__).with_suffix(".json").write_text(dump(results, 0) + "\n")
