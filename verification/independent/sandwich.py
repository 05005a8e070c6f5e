"""A second implementation of the benchmark sandwich/v1, with third-party tools only.

Space: scikit-fem, ElementQuad1, 2x2 Gauss, plane strain, small strain.  Time: the interface law is written as an
ordinary differential equation and handed to scipy's Radau IIA (order 5); no return mapping, no backward Euler.
Units: mm, N, s, MPa.  Signs: f_n > 0 in compression; slip and t > 0 when A moves up (+y) relative to B.

Derivation.  Each body has its own supports, and so a face flexibility C (the inverse of the Schur complement of its
stiffness on the face).  With pair forces F = (F_n, F_t), acting on A as -F and on B as +F, the jump is

    w = u_A - u_B = w_x u_x + w_y u_y - C F,   C = C_A + C_B,     u_x, u_y the two prescribed displacements,

and the penalty springs, of stiffness k_n = E_n area and k_t = E_t area, give  F_n = k_n w_n,  F_t = k_t (w_t - w_0 - s).
Eliminating the normal springs and then the jump leaves everything linear in (F_t, load):

    F_n = P (w_n - C_nt F_t),              P = (C_nn + 1/k_n)^-1
    s   = q(load) - Q F_t,                 Q = C_tt + 1/k_t - C_tn P C_nt,   q = w_t - w_0 - C_tn P w_n.

With V = ds/dt from the inverted strength law, V = 2 Vref exp(-mu0/a) sinh(F_t/(a F_n)), one obtains

    Q dF_t/dt = dq/dt - V(F_t, F_n).

The integrated unknown is the shear traction F_t/area, not s (they are related by the affine map above): an error
ds changes ln V by E_t ds/(a f_n), with E_t/(a f_n) = 4e4 per um at h = 1.25 mm, so that a relative tolerance of 1e-9
on a slip of 40 um would still leave V uncertain by 2e-3; the same tolerance on the traction leaves it 1e-7.
"""

import datetime
import json
import pathlib
import platform
import sys
from dataclasses import dataclass, replace

import numpy as np
import scipy
import skfem
from scipy.integrate import solve_ivp
from scipy.linalg import cho_factor, cho_solve
from scipy.sparse.linalg import splu
from skfem.models.elasticity import lame_parameters, linear_elasticity

U_X = 0.138 * 0.07  # mm, pressing displacement
T_PRESS = 9.66  # s
V_LOAD = 1e-3  # mm/s
MU0, A_FRICTION = 0.6, 0.01
CHECKPOINTS = np.arange(1, 11) / 200  # mm of u_y; an integration ends at each: no slip is interpolated


@dataclass(frozen=True)
class Case:
    h: float = 1.25  # mm
    w_a: float = 25.0  # mm, width of A
    overhang: float = 10.0  # mm, of B beyond A at either end
    young: float = 44.8e3  # MPa
    nu: float = 0.12
    penalty: float = 100.0  # E_n = E_t = penalty * E/h
    v_ref: float = 1e-3  # mm/s
    friction_in_stage_1: bool = False


def face_flexibility(case, x, y, face_x, face_y, supports):
    """Face flexibility of one rectangular body.  supports: (coordinate, value, component, prescribed unit value).

    Returns C (2N, 2N), face displacement per face force, and w (2N,), face displacement for the prescribed values.
    Both have all normal (x) components first, then all tangential (y) ones, by increasing y."""
    grid = [np.linspace(lo, hi, round((hi - lo) / case.h) + 1) for lo, hi in (x, y)]
    mesh = skfem.MeshQuad.init_tensor(*grid)
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementQuad1()), intorder=3)
    assert basis.X.shape[1] == 4, "2x2 Gauss points"
    # The three-dimensional Lame parameters in a two-dimensional form give plane strain.
    stiffness = linear_elasticity(*lame_parameters(case.young, case.nu)).assemble(basis).tocsc()

    def dofs(selected, component):
        nodes = np.flatnonzero(selected)
        return basis.nodal_dofs[component, nodes[np.argsort(mesh.p[1, nodes])]]

    u = np.zeros(basis.N)
    fixed = []
    for axis, value, component, prescribed in supports:
        held = dofs(np.isclose(mesh.p[axis], value), component)
        u[held] = prescribed
        fixed.append(held)
    free = np.setdiff1d(np.arange(basis.N), np.concatenate(fixed))
    on_face = np.isclose(mesh.p[0], face_x) & (mesh.p[1] > face_y[0] - 1e-6) & (mesh.p[1] < face_y[1] + 1e-6)
    face = np.concatenate([dofs(on_face, 0), dofs(on_face, 1)])

    factor = splu(stiffness[np.ix_(free, free)], permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    u[free] = factor.solve(-(stiffness @ u)[free])
    flexibility = np.zeros((face.size, face.size))
    response = np.zeros(basis.N)
    position = np.full(basis.N, -1)
    position[free] = np.arange(free.size)
    for j, dof in enumerate(face):
        if position[dof] < 0:  # a supported dof of the face (A's corner at y = 0) does not move under any force
            continue
        force = np.zeros(free.size)
        force[position[dof]] = 1.0
        response[free] = factor.solve(force)
        flexibility[:, j] = response[face]
    return (flexibility + flexibility.T) / 2, u[face]


class Interface:
    """The two bodies condensed to their common face x = 25 mm."""

    def __init__(self, case):
        y_b = (-case.overhang, 50 + case.overhang)
        c_a, w_a = face_flexibility(
            case, (25 - case.w_a, 25), (0, 50), 25, (0, 50), [(0, 25 - case.w_a, 0, 1.0), (1, 0.0, 1, 0.0)]
        )
        c_b, w_b = face_flexibility(case, (25, 50), y_b, 25, (0, 50), [(0, 50.0, 0, 0.0), (1, y_b[1], 1, 1.0)])
        n = w_a.size // 2
        self.case, self.y = case, np.linspace(0, 50, n)
        self.area = np.full(n, case.h)  # per mm of thickness, from A's face
        self.area[[0, -1]] /= 2
        spring = np.diag(case.h / (case.penalty * case.young) / self.area)  # 1/k_n = 1/k_t
        c = c_a + c_b
        c_nn, self.c_nt, c_tt = c[:n, :n] + spring, c[:n, n:], c[n:, n:] + spring
        self.p = cho_factor(c_nn)
        self.coupling = -cho_solve(self.p, self.c_nt)  # dF_n/dF_t
        self.q_matrix = c_tt + self.c_nt.T @ self.coupling
        self.q_factor = cho_factor(self.q_matrix)
        # Per unit of u_x and of u_y: F_n at F_t = 0, the jump w_t at F_t = 0 (frictionless), both (N,).
        self.fn_x, self.fn_y = cho_solve(self.p, w_a[:n]), cho_solve(self.p, -w_b[:n])
        self.q_x, self.q_y = w_a[n:] - self.c_nt.T @ self.fn_x, -w_b[n:] - self.c_nt.T @ self.fn_y

    def normal(self, ft, u_x, u_y):
        return self.fn_x * u_x + self.fn_y * u_y + self.coupling @ ft

    def mean(self, force):
        return force.sum() / self.area.sum()

    def rate(self, ft, fn):
        """V and its derivative with respect to F_t (N, N), where F_n depends on F_t through the bodies."""
        with np.errstate(over="ignore", invalid="ignore"):  # a bad trial of the integrator gives inf; it then halves the step
            x = ft / (A_FRICTION * fn)
            scale = self.case.v_ref * np.exp(-MU0 / A_FRICTION)
            v, dv_dx = 2 * scale * np.sinh(x), 2 * scale * np.cosh(x)
            d_ft, d_fn = dv_dx / (A_FRICTION * fn), -dv_dx * x / fn
            return v, np.diag(d_ft) + d_fn[:, None] * self.coupling

    def integrate(self, forcing, normal, decay, span, ft, method, rtol, event=None):
        """Q dF_t/dt = forcing - V(F_t, normal(time, F_t)) - decay Q F_t, in the unknown F_t/area [MPa]."""
        area = self.area

        def rhs(time, t):
            v = self.rate(t * area, normal(time, t * area))[0]
            return cho_solve(self.q_factor, forcing - v, check_finite=False) / area - decay * t

        def jac(time, t):
            dv = self.rate(t * area, normal(time, t * area))[1]
            return -cho_solve(self.q_factor, dv * area, check_finite=False) / area[:, None] - decay * np.eye(t.size)

        # atol: shear tractions are of order 5 MPa where they matter.
        out = solve_ivp(rhs, span, ft / area, method, jac=jac, rtol=rtol, atol=rtol, events=event)
        assert out.success, out.message
        return out

    def press(self, method="Radau", rtol=1e-10):
        """Stage 1: (F_t, F_n) at its end.

        With friction the loading is proportional, u_x = U t/T, and the law depends only on V and the ratio F_t/F_n: the
        solution is exactly F = t z, s = t V at every t.  In the time sigma = ln t, z = F_t/t obeys
        Q dz/dsigma = dq/dt - V(z) - Q z, which has no 0/0 at t = 0 and whose steady state is that solution.  It is
        reached from zero traction at exp(-40) of the end, since all other modes decay at least like exp(-sigma)."""
        ft = np.zeros(self.y.size)
        if self.case.friction_in_stage_1:
            rate = U_X / T_PRESS
            out = self.integrate(self.q_x * rate, lambda _, z: self.normal(z, rate, 0), 1.0, (0, 40), ft, method, rtol)
            ft = out.y[:, -1] * self.area * T_PRESS
        fn = self.normal(ft, U_X, 0)
        assert fn.min() > 0, "no pair opens: the linear reduction holds"
        return ft, fn

    def shear(self, ft, method="Radau", rtol=1e-10):
        """Stage 2 from the end of stage 1: slip histories, rates and friction coefficients."""
        area, start = self.area, ft

        def normal(time, force):
            return self.normal(force, U_X, -V_LOAD * time)

        def all_moving(time, t):
            return self.rate(t * area, normal(time, t * area))[0].min() - 0.5 * V_LOAD

        time, slips, v_max, fn_min, moving, steps = 0.0, [], 0.0, np.inf, [], 0
        for u_y in CHECKPOINTS:
            end = u_y / V_LOAD
            out = self.integrate(-V_LOAD * self.q_y, normal, 0.0, (time, end), ft, method, rtol, all_moving)
            time, ft, steps = end, out.y[:, -1] * area, steps + out.t.size - 1
            moving.extend(out.t_events[0])
            for step, t in zip(out.t, out.y.T):
                fn = normal(step, t * area)
                fn_min, v_max = min(fn_min, (fn / area).min()), max(v_max, self.rate(t * area, fn)[0].max())
            slips.append(-self.q_y * u_y - self.q_matrix @ (ft - start))  # s = 0 at the end of stage 1
        fn = normal(time, ft)
        assert fn_min > 0, "no pair opens: the linear reduction holds"
        slip, mu = np.array(slips), ft / fn
        return {
            "slip_um_at_y_12.5_25_37.5": [1e3 * self.at(slip[-1], y) for y in (12.5, 25.0, 37.5)],
            "slip_um_ends_y_0_and_50": [1e3 * slip[-1, 0], 1e3 * slip[-1, -1]],
            "slip_end_to_end_over_u_x": (slip[-1, 0] - slip[-1, -1]) / U_X,
            "slip_max_minus_min_over_u_x": np.ptp(slip[-1]) / U_X,  # larger: the least slip is just inside y = 50
            "y_of_max_and_min_slip": [self.y[slip[-1].argmax()], self.y[slip[-1].argmin()]],
            "all_above_half_v_load_at_u_y_over_u_x": [V_LOAD * m / U_X for m in moving],
            "max_v_over_v_load_minus_1": v_max / V_LOAD - 1,
            "end_v_over_v_load_minus_1_min_max": [f(self.rate(ft, fn)[0]) / V_LOAD - 1 for f in (np.min, np.max)],
            "end_mu_min_max": [mu.min(), mu.max()],
            "end_mean_normal_stress_mpa": self.mean(fn),
            "smallest_normal_traction_mpa": fn_min,
            "steps": steps,
        }, slip

    def at(self, values, y):
        return values[np.argmin(abs(self.y - y))]


def run(case, shear=True, probes=False, method="Radau", rtol=1e-10):
    face = Interface(case)
    ft, fn = face.press(method, rtol)
    mean, traction, ratio = face.mean(fn), fn / face.area, ft / fn
    result = {
        "mean_normal_stress_mpa": mean,
        "mid_over_mean": face.at(traction, 25.0) / mean,
        "edge_over_mean_y_0_and_50": [traction[0] / mean, traction[-1] / mean],
    }
    if case.friction_in_stage_1:
        result["t_over_fn_min_max"] = [ratio.min(), ratio.max()]
        result["y_of_t_over_fn_min_max"] = [face.y[ratio.argmin()], face.y[ratio.argmax()]]
        result["rest_residual_um_per_s"] = 1e3 * abs(
            (face.q_x * U_X - face.q_matrix @ ft) / T_PRESS - face.rate(ft, fn)[0]
        ).max()
    if shear:
        summary, slip = face.shear(ft, method, rtol)
        result |= summary
    if probes:  # the node nearest each of eight equidistant positions
        nodes = [int(np.argmin(abs(face.y - 50 / 7 * k))) for k in range(8)]
        result["probes"] = {
            "y_mm": face.y[nodes].tolist(),
            "u_y_mm": CHECKPOINTS.tolist(),
            "slip_um_rows_u_y_columns_probes": (1e3 * slip[:, nodes]).tolist(),
        }
    print(case, json.dumps({k: v for k, v in result.items() if k != "probes"}), file=sys.stderr, flush=True)
    return result


def aitken(values):
    """Limit of a sequence with h halved each time, from its last three members, and the order it implies.

    The penalty compliance is first order in h; the corners add a lower-order term with a small factor."""
    d1, d2 = values[-2] - values[-3], values[-1] - values[-2]
    return {"limit": values[-1] + d2 * d2 / (d1 - d2), "order": float(np.log2(abs(d1 / d2)))}


def main():
    base, sizes = Case(), (2.5, 1.25, 0.625, 0.3125)
    friction = replace(base, friction_in_stage_1=True)
    results = {
        "benchmark": "sandwich/v1",
        "date": datetime.date.today().isoformat(),
        "python": platform.python_version(),
        "packages": {m.__name__: m.__version__ for m in (np, scipy, skfem)},
        "units": "mm, s, MPa, micrometres where a key says um; lists of three slips are at y = 12.5, 25, 37.5 mm",
        "base": {h: run(replace(base, h=h), probes=h in (2.5, 1.25)) for h in sizes},
        "w_A_50_mm": {h: run(replace(base, h=h, w_a=50.0), h == 1.25) for h in sizes},
        "no_overhang": {h: run(replace(base, h=h, overhang=0.0), h == 1.25) for h in sizes},
        "friction_in_stage_1": {h: run(replace(friction, h=h)) for h in sizes[:3]},
        "penalty_h_1.25": {f"{f}x": run(replace(base, penalty=100.0 * f)) for f in (1, 10, 0.1)},
        "nu_0.25_h_1.25": run(replace(base, nu=0.25)),
        "v_ref_over_100_h_1.25": run(replace(base, v_ref=V_LOAD / 100)),
        "young_x_2_h_1.25": run(replace(base, young=2 * base.young)),
    }
    # Once every point slides at V_load the slip follows from t = mu f_n, whatever the time integration did before.
    # Its error is therefore taken from the whole histories at the probes, which include the onset.
    reference = results["base"][1.25]
    results["time_integration_h_1.25"] = {}
    for method, rtol in (("Radau", 1e-8), ("Radau", 1e-12), ("BDF", 1e-10)):
        other = run(base, probes=True, method=method, rtol=rtol)
        key, slips = "all_above_half_v_load_at_u_y_over_u_x", "slip_um_rows_u_y_columns_probes"
        results["time_integration_h_1.25"][f"{method}_{rtol:g}"] = {
            "steps": other["steps"],
            "largest_difference_of_slip_um": np.abs(
                np.subtract(other["probes"][slips], reference["probes"][slips])
            ).max(),
            key: other[key],
        }
    results["limits_h_to_0"] = {
        k: aitken([r["mean_normal_stress_mpa"] for r in results[k].values()])
        for k in ("base", "w_A_50_mm", "no_overhang")
    } | {
        f"base slip_um y={y}": aitken([r["slip_um_at_y_12.5_25_37.5"][i] for r in results["base"].values()])
        for i, y in enumerate((12.5, 25.0, 37.5))
    }
    path = pathlib.Path(__file__).with_name("results.json")
    path.write_text(json.dumps(results, indent=1, default=float) + "\n")


if __name__ == "__main__":
    main()
