"""Scenes of asperity and what its runs write."""

import csv
import json
import re

import numpy as np

import paths  # noqa: F401
from result import Result
from timed import measured
from varied import inline


def scene(problem, measure, penalty, solver=None):
    tables = {"schema": 1, "title": f"{problem.name} in space", "kinematics": "3d", "materials": {}, "bodies": {}}
    for name in problem.bodies:
        material = {"young": f"{problem.young[name]!r} MPa", "poisson": problem.poisson}
        if problem.plastic:
            yields, modulus = problem.plastic
            material["plasticity"] = {"hardening": "linear", "yield": f"{yields!r} MPa", "modulus": f"{modulus!r} MPa"}
        tables["materials"][name] = material
        tables["bodies"][name] = {"material": name, "mesh": {"gmsh": {"file": f"{name}.msh", "unit": "mm"}}}
    enforcement = {"kind": "penalty", "normal": f"{penalty:g} E/h"}
    interface = {
        "slave": f"upper.{problem.contact['upper']}",
        "master": f"lower.{problem.contact['lower']}",
        "measure": measure,
        "sliding": "finite" if problem.finite else "small",
        "enforcement": enforcement,
    }
    if problem.friction:
        enforcement["tangential"] = enforcement["normal"]
        interface["law"] = {"kind": "coulomb", "mu": problem.friction}
    tables["interfaces"] = {"contact": interface}
    fixed = [{"set": side, **{axis: 0 for axis in axes}} for side, axes in problem.held.items()]
    tables["stages"], moved = [], {}
    for number, stage in enumerate(problem.stages):
        conditions = [] if number else fixed
        for side, motions in stage.moved.items():
            motion = {axis: {"to": f"{value!r} mm"} for axis, value in motions.items()}
            before = {axis: "hold" for axis in moved.get(side, ()) if axis not in motions}
            same = next((c for c in conditions if c["set"] == side), None)
            if same is None:
                conditions.append({"set": side, **before, **motion})
            else:
                same.update(motion)
            moved.setdefault(side, set()).update(motions)
        tables["stages"].append({"name": f"stage {number + 1}", "duration": "1 s", "steps": stage.steps, "conditions": conditions})
    tables["time"] = {"stepper": "implicit"}
    tables["output"] = {"forces": {"load": {"set": f"upper.{problem.loaded}"}}, "profiles": 1}
    if solver:
        tables["solver"] = solver
    return "".join(f"{json.dumps(key)} = {inline(value)}\n" for key, value in tables.items())


def run(program, problem, folder, limit, measure="mortar", penalty=100.0, solver=None):
    folder.mkdir(parents=True, exist_ok=True)
    for name, body in problem.bodies.items():
        body.write(folder / f"{name}.msh")
    (folder / "scene.toml").write_text(scene(problem, measure, penalty, solver))
    done = measured([program, "run", "scene.toml", "--out", "out", "--threads", "1", "--no-plots", "--force"], folder, limit)
    label = f"asperity, {measure}"
    iterations = re.findall(r"(\d+) iterations, \d+ fact", done.said)
    result = Result(label, done.user, done.wall, done.peak, int(iterations[-1]) if iterations else 0)
    if not done.ended or done.code:
        result.why = f"stopped after {limit:g} s" if not done.ended else done.said.strip()[-300:]
        return result
    result.forces = forces(folder / "out/forces/load.csv")
    result.pressures = pressures(sorted((folder / "out/profiles").glob("*.csv"))[-1], problem)
    return result


def forces(path):
    rows = list(csv.DictReader(open(path)))
    column = lambda name: next(k for k in rows[0] if k.split()[0] == name)
    time, axes = column("time"), [column(f"force_{axis}") for axis in "xyz"]
    return [(float(r[time]), [float(r[a]) for a in axes]) for r in rows]


def pressures(path, problem):
    """Pressures of nodes of the slave at the last time of a profile."""
    rows = list(csv.DictReader(open(path)))
    time = "time [s]"
    last = [r for r in rows if r[time] == rows[-1][time]]
    body = problem.bodies["upper"]
    nodes = body.nodes(problem.contact["upper"])
    found = {}
    for row in last:
        at = np.array([float(row[f"{axis} [m]"]) * 1e3 for axis in "xyz"])
        distance = np.linalg.norm(body.points[nodes] - at, axis=1)
        found[int(nodes[distance.argmin()])] = float(row["mean_normal_traction [Pa]"]) * 1e-6
    return found
