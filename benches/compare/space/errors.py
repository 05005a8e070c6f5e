"""Errors of results: of the ball against Hertz, of the other problems against reference forces."""

import numpy as np

from problems import BALL_RADIUS

# Normal and shear force that errors are taken against [N]; the page says where they come from.
REFERENCES = {
    "blocks": (1300.0, 151.2),
    "cylinders": (1900.9, 742.57),
}


def areas(body, side):
    """Area of the plane projection of a side that belongs to each of its nodes."""
    found = dict.fromkeys(map(int, body.nodes(side)), 0.0)
    for face in body.sides[side]:
        x, _, z = body.points[face].T
        area = abs(np.dot(x, np.roll(z, -1)) - np.dot(z, np.roll(x, -1))) / 2
        for node in face:
            found[int(node)] += area / len(face)
    return found


def hertz(problem, force):
    """Radius of contact and largest pressure."""
    modulus = 1 / sum((1 - problem.poisson**2) / e for e in problem.young.values())
    radius = (3 * force * BALL_RADIUS / (4 * modulus)) ** (1 / 3)
    return radius, 3 * force / (2 * np.pi * radius**2)


def loads(problem, result):
    """Normal and shear force at the end; of ironing their means over the second half of the way."""
    times, forces = np.array([t for t, _ in result.forces]), np.abs([f for _, f in result.forces])
    end = float(len(problem.stages))
    if problem.finite:
        late = np.linspace(end - 0.5, end, 21)
        return tuple(float(np.mean(np.interp(late, times, forces[:, axis]))) for axis in (1, 0))
    return float(forces[-1, 1]), float(forces[-1, 0])


def pressure_errors(problem, result):
    """Errors of the largest pressure and of pressure in L2 within 1.2 radii, at the force of the run."""
    body = problem.bodies["upper"]
    radius, peak = hertz(problem, loads(problem, result)[0])
    area = areas(body, problem.contact["upper"])
    nodes = [n for n in result.pressures if np.hypot(*body.points[n][[0, 2]]) <= 1.2 * radius]
    p = np.array([result.pressures[n] for n in nodes])
    a = np.array([area[n] for n in nodes])
    r = np.hypot(*body.points[nodes][:, [0, 2]].T)
    exact = peak * np.sqrt(np.maximum(0, 1 - (r / radius) ** 2))
    return p.max() / peak - 1, np.sqrt(np.sum(a * (p - exact) ** 2) / np.sum(a * exact**2))


def error(problem, result):
    """Text of the error of a result."""
    if problem.name == "ball":
        peak, l2 = pressure_errors(problem, result)
        return f"p0 {100 * peak:+.2f} %, L2 {100 * l2:.1f} %"
    if problem.name not in REFERENCES:
        return "-"
    pairs = zip(loads(problem, result), REFERENCES[problem.name])
    return ", ".join(f"{name} {100 * (value / right - 1):+.2f} %" for name, (value, right) in zip(("N", "T"), pairs))
