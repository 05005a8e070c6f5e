"""SEAS BP1-QD and BP3-QD, independent of the Rust code: boundary elements of constant slip in a half-plane. As in other boundary-element
codes, ln V and ln theta (and normal traction, if slip changes it) are integrated by an explicit pair of order 5. Slip is not needed.

    python cycles.py PROBLEM CELLS YEARS [TOLERANCE [EVENTS]]

PROBLEM is bp1, or bp3:DIP:thrust or bp3:DIP:normal; CELLS is the number of cells on 40 km; TOLERANCE is the error per step in ln V
and ln theta, 1e-6 by default. Writes onsets of events (V rises above 1 mm/s after it was below 0.1 mm/s) until YEARS or EVENTS to cycles.json.
"""

import json
import sys
import time

import numpy as np

RHO, CS, NU = 2670.0, 3464.0, 0.25
MU = RHO * CS**2
ETA = MU / (2 * CS)
B, L, F0, V0, VP = 0.015, 8e-3, 0.6, 1e-6, 1e-9
SIGMA, A_MAX, WF = 50e6, 0.025, 40e3
YEAR = 365.25 * 86400.0


def half_plane(z, s, b):
    """sxx, syy, sxy at z of an edge dislocation at s in y < 0 (free surface y = 0), displacement jump b = bx + i by of an anticlockwise circuit.

    Potentials Phi = phi' and Psi = psi' of Muskhelishvili: sxx + syy = 4 Re Phi, syy - sxx + 2i sxy = 2 (conj(z) Phi' + Psi).
    The surface is made traction-free by continuing Phi across it: Phi = Phi0 + Phi1 with Phi1(z) = -Phi0bar(z) - z Phi0bar'(z) - Psi0bar(z),
    and Psi = -Phi - Phibar - z Phi' on it, where bars conjugate the coefficients."""
    kappa = 3 - 4 * NU
    a = MU * b / (1j * np.pi * (kappa + 1))
    phi0, dphi0 = a / (z - s), -a / (z - s) ** 2
    psi0 = np.conj(a) / (z - s) + a * np.conj(s) / (z - s) ** 2
    ac, sc = np.conj(a), np.conj(s)
    w = z - sc
    phib, dphib, ddphib = ac / w, -ac / w**2, 2 * ac / w**3
    psib, dpsib = a / w + ac * s / w**2, -a / w**2 - 2 * ac * s / w**3
    phi1 = -phib - z * dphib - psib
    dphi1 = -2 * dphib - z * ddphib - dpsib
    # Psi1 from tractions syy + i sxy = Phi + conj(Phi) + z conj(Phi') + conj(Psi) = 0 on y = 0, continued.
    psi1 = -phib - phi1 - z * dphi1
    phi, dphi, psi = phi0 + phi1, dphi0 + dphi1, psi0 + psi1
    total, difference = 4 * phi.real, 2 * (np.conj(z) * dphi + psi)
    return (total - difference.real) / 2, (total + difference.real) / 2, difference.imag / 2


def check():
    """Checks the free surface, and equilibrium by finite differences, at random positions and slips."""
    rng = np.random.default_rng(1)
    for _ in range(5):
        s, b = complex(*(-rng.random(2) * 1e4)), complex(*rng.random(2))
        x = rng.random(7) * 2e4 - 1e4
        _, syy, sxy = half_plane(x + 0j, s, b)
        size = MU * abs(b) / abs(s.imag)
        assert np.max(np.abs([syy, sxy])) < 1e-10 * size, (syy, sxy, size)
        z, h = complex(3e3, -2e3) + s / 3, 1.0
        grad = [[(p - m) / (2 * h) for p, m in zip(half_plane(z + d, s, b), half_plane(z - d, s, b))] for d in (h, 1j * h)]
        assert abs(grad[0][0] + grad[1][2]) < 1e-6 * abs(grad[0][0]) + 1e-6
        assert abs(grad[0][2] + grad[1][1]) < 1e-6 * abs(grad[0][2]) + 1e-6


def antiplane(n):
    """Shear traction at midpoints of cells per unit slip of cells, vertical fault: screw dislocations and their images above the surface."""
    h = WF / n
    z = ((np.arange(n) + 0.5) * h)[:, None]
    top, bottom = (np.arange(n) * h)[None, :], (np.arange(1, n + 1) * h)[None, :]
    k = MU / (2 * np.pi) * (1 / (z - bottom) - 1 / (z - top) - 1 / (z + bottom) + 1 / (z + top))
    mid = n // 2
    assert abs(k[mid, mid] / (-2 * MU / (np.pi * h)) - 1) < 1e-3 and np.all(np.diag(k) < 0) and k[0, 1] > 0
    return k


def kernels(dip, n):
    """Shear traction along the fault and compression at midpoints of cells per unit slip of cells; upward slip of the hanging wall is positive."""
    h = WF / n
    angle = np.radians(dip)
    along = np.exp(-1j * angle)  # down the dip, towards +x
    middles = (np.arange(n) + 0.5) * h * along
    ends = np.arange(n + 1) * h * along
    normal = along * 1j  # from the footwall to the hanging wall above it
    slip = -along  # of the hanging wall relative to the footwall: up
    t, m = (slip.real, slip.imag), (normal.real, normal.imag)

    def on(s, b):
        sxx, syy, sxy = half_plane(middles, s, b)
        tx, ty = sxx * m[0] + sxy * m[1], sxy * m[0] + syy * m[1]
        return tx * t[0] + ty * t[1], -(tx * m[0] + ty * m[1])

    # Slip from the surface down to an end of a cell is one dislocation there. Its sign follows below: slip lowers the traction of its own cell.
    shear, press = np.zeros((n, n + 1)), np.zeros((n, n + 1))
    for j in range(1, n + 1):
        shear[:, j], press[:, j] = on(ends[j], slip)
    k, p = np.diff(shear, axis=1), np.diff(press, axis=1)
    sign = -np.sign(k[0, 0])
    k, p = sign * k, sign * p
    mid = n // 2
    assert abs(k[mid, mid] / (-2 * MU / (np.pi * (1 - NU) * h)) - 1) < 1e-3
    assert np.all(np.diag(k) < 0)
    return k, p


# Dormand and Prince (1980).
AA = [[], [1 / 5], [3 / 40, 9 / 40], [44 / 45, -56 / 15, 32 / 9], [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729],
      [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656], [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84]]
E = np.array([71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40])


def run(problem, n, years, tolerance, stop=10**9, look=None):
    """Onsets of events; `look` is called with time [s] and unknowns (ln V, ln theta, f_n) after each step."""
    start = time.process_time()
    if problem == "bp1":
        k = antiplane(n)
        p = 0 * k
    else:
        _, dip, sense = problem.split(":")
        k, p = kernels(float(dip), n)
        p *= {"thrust": 1, "normal": -1}[sense]
    h = WF / n
    x = (np.arange(n) + 0.5) * h
    a = np.interp(x, [15e3, 18e3], [0.010, A_MAX])
    tau0 = SIGMA * A_MAX * np.arcsinh(VP / (2 * V0) * np.exp((F0 + B * np.log(V0 / VP)) / A_MAX)) + ETA * VP
    theta = L / V0 * np.exp(a / B * np.log(2 * V0 / VP * np.sinh((tau0 - ETA * VP) / (a * SIGMA))) - F0 / B)
    vertical = np.max(np.abs(p)) < 1e-9 * np.max(np.abs(k))
    # Stack shear and compression, so that one product gives both.
    both = k if vertical else np.vstack([k, p])
    y = np.concatenate([np.full(n, np.log(VP)), np.log(theta), np.full(n, SIGMA)])
    if vertical:
        y = y[: 2 * n]
    c0 = (F0 + B * np.log(V0 / L)) / a - np.log(2 * V0)
    count = 0

    def rates(y):
        nonlocal count
        count += 1
        lv, lt = y[:n], y[n : 2 * n]
        v = np.exp(lv)
        sigma = SIGMA if vertical else y[2 * n :]
        e = np.exp(lv + c0 + B / a * lt)
        f = a * np.arcsinh(e)
        d = e / np.sqrt(1 + e * e)
        dlt = np.exp(-lt) - v / L
        stress = both @ (v - VP)
        dlv = (stress[:n] - sigma * B * d * dlt - (0 if vertical else f * stress[n:])) / (sigma * a * d + ETA * v)
        out = [dlv, dlt]
        if not vertical:
            out.append(stress[n:])
        return np.concatenate(out)

    weight = np.full(len(y), 1 / tolerance)
    if not vertical:
        weight[2 * n :] /= SIGMA * 0.01
    t, dt, first = 0.0, 1e3, rates(y)
    compensation = 0.0
    onsets, seismic, peak, peaks, steps = [], False, 0.0, [], 0
    end = years * YEAR
    while t < end and len(onsets) < stop:
        ks = [first]
        for i in range(1, 7):
            ks.append(rates(y + dt * sum(w * q for w, q in zip(AA[i], ks) if w)))
        new = y + dt * sum(w * q for w, q in zip(AA[6], ks) if w)
        with np.errstate(all="ignore"):
            error = np.max(np.abs(dt * (E @ np.array(ks))) * weight)
        if not error <= 1:
            dt *= max(0.2, 0.9 * error**-0.2) if np.isfinite(error) else 0.2
            continue
        steps += 1
        was, now = y[:n].max() , new[:n].max()
        mark = np.log(1e-3)
        if not seismic and now >= mark:
            onsets.append((t + compensation + dt * (mark - was) / (now - was)) / YEAR)
            seismic, peak = True, -99.0
            print(f"{len(onsets)}: {onsets[-1]:.5f} yr, {steps} steps, {count} rates, {time.process_time() - start:.0f} s", flush=True)
        if seismic:
            peak = max(peak, now)
            if now < np.log(1e-4):
                seismic = False
                peaks.append(float(np.exp(peak)))
        # Compensated summation of time: steps fall to milliseconds at 1e10 s.
        add = dt + compensation
        later = t + add
        compensation = add - (later - t)
        t, y, first = later, new, ks[6]
        if look:
            look(t, y)
        dt *= min(5.0, 0.9 * max(error, 1e-10) ** -0.2)
    return {"problem": problem, "cell [m]": h, "tolerance": tolerance, "onsets [yr]": onsets, "peaks [m/s]": peaks, "steps": steps, "rates": count}


def keep(found, name="cycles.json"):
    """Stores a run in place of an earlier one with the same problem and cells."""
    try:
        with open(name) as file:
            runs = json.load(file)
    except FileNotFoundError:
        runs = []
    key = lambda run: (run["problem"], -run["cell [m]"])
    runs = sorted([run for run in runs if key(run) != key(found)] + [found], key=key)
    with open(name, "w") as file:
        json.dump(runs, file, indent=1)
        file.write("\n")


if __name__ == "__main__":
    check()
    problem, cells, years = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
    tolerance = float(sys.argv[4]) if len(sys.argv) > 4 else 1e-6
    events = int(sys.argv[5]) if len(sys.argv) > 5 else 10**9
    found = run(problem, cells, years, tolerance, events)
    print(json.dumps(found))
    keep(found)
