"""Jobs of GetFEM for getfem_child.py, and their results."""

import json
from pathlib import Path

import numpy as np

import paths  # noqa: F401
from calculix import element_size
from result import Result
from timed import measured

CHILD = Path(__file__).resolve().parent / "getfem_child.py"


def motions(problem):
    """Sides and axes with given displacements, and their values at the end of each stage."""
    order = [(side, axis) for side, axes in problem.held.items() for axis in axes]
    order += [(s, a) for stage in problem.stages for s, m in stage.moved.items() for a in m if (s, a) not in order]
    order, now, ends = list(dict.fromkeys(order)), {}, []
    for stage in problem.stages:
        now.update({(s, a): v for s, m in stage.moved.items() for a, v in m.items()})
        ends.append([now.get(key, 0.0) for key in order])
    return order, ends


def steps(problem, ends):
    before, out = [0.0] * len(ends[0]), []
    for number, (stage, after) in enumerate(zip(problem.stages, ends)):
        at = lambda k: [b + (a - b) * k / stage.steps for b, a in zip(before, after)]
        out += [(number + k / stage.steps, at(k), at(k + 1), 1 / stage.steps) for k in range(stage.steps)]
        before = after
    return out


def job(problem, brick, factor, degree):
    order, ends = motions(problem)
    regions = {f"{n}.{side}": 11 + k for n, body in problem.bodies.items() for k, side in enumerate(body.sides)}
    body = problem.bodies["upper"]
    return {
        "kind": body.kind,
        "files": {name: f"{name}.msh" for name in problem.bodies},
        "regions": regions,
        "young": problem.young,
        "poisson": problem.poisson,
        "plastic": problem.plastic,
        "friction": problem.friction,
        "slave": f"upper.{problem.contact['upper']}",
        "master": f"lower.{problem.contact['lower']}",
        "released": problem.released,
        "brick": brick,
        "degree": degree,
        "augmentation": factor * min(problem.young.values()) / element_size(problem),
        "residual": 1e-7,
        "most": 30,
        "motions": order,
        "steps": steps(problem, ends),
    }


def run(problem, folder, limit, brick="raytracing", factor=1.0, degree=1, python="/usr/bin/python3"):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "result.json").unlink(missing_ok=True)
    for name, body in problem.bodies.items():
        body.write(folder / f"{name}.msh")
    (folder / "job.json").write_text(json.dumps(job(problem, brick, factor, degree)))
    done = measured([python, CHILD, "job.json"], folder, limit)
    result = Result(f"GetFEM, {brick}", done.user, done.wall, done.peak)
    if not (folder / "result.json").exists():
        result.why = f"stopped after {limit:g} s" if not done.ended else f"code {done.code}: {done.said.strip()[-200:]}"
        result.iterations = done.said.count("iter ")
        return result
    found = json.loads((folder / "result.json").read_text())
    result.why, result.iterations = found["why"], found["iterations"]
    result.forces = [(t, f) for t, f in found["forces"]]
    body = problem.bodies["upper"]
    nodes = body.nodes(problem.contact["upper"])
    for *place, pressure in found["pressures"]:
        distance = np.linalg.norm(body.points[nodes] - place, axis=1)
        if distance.min() < 1e-6:
            result.pressures[int(nodes[distance.argmin()])] = abs(pressure)
    return result
