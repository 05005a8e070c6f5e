"""Contact in space: asperity beside CalculiX and GetFEM on the same meshes.

    python3 compare.py ASPERITY [--problems blocks ball ..] [--sizes 5 20 80] [--codes asperity ccx-mortar ..] [--limit 600]

ASPERITY is the program. Needed are numpy, ccx (Debian: calculix-ccx), a Python with GetFEM (python3-getfem++, --getfem), and
gmsh (pip) for the cylinders. Sizes are thousands of unknowns. Each run prints a row: code, unknowns, user CPU time, wall time,
peak memory, Newton iterations, forces, error, or why there is no result. With --keep inputs and results stay in a folder.
"""

import argparse
import json
import tempfile
from dataclasses import asdict
from pathlib import Path

import asperity
import calculix
import errors
import with_getfem
from problems import PROBLEMS

# Stiffness of contact over E/h, and the brick of GetFEM, that suit each code and problem best. asperity has 100 E/h everywhere.
SURFACE = {"blocks": 100.0, "ball": 10.0, "cylinders": 100.0, "cylinders, plastic": 100.0, "ironing": 10.0}
GETFEM = {"ball": ("raytracing", 100.0), "cylinders": ("raytracing", 10.0)}

CODES = {
    "asperity": lambda p, d, g: asperity.run(g.program, p, d, g.limit, "mortar"),
    "asperity-node": lambda p, d, g: asperity.run(g.program, p, d, g.limit, "node-to-point"),
    "ccx-mortar": lambda p, d, g: calculix.run(p, d, g.limit, "mortar", 10.0),
    "ccx-surface": lambda p, d, g: calculix.run(p, d, g.limit, "surface", SURFACE[p.name]),
    "getfem": lambda p, d, g: with_getfem.run(p, d, g.limit, *GETFEM.get(p.name, ("raytracing", 1.0)), python=g.getfem),
}


def row(problem, result):
    cells = [problem.name, result.code, problem.unknowns, f"{result.user:.2f}", f"{result.wall:.2f}", f"{result.peak:.0f}", result.iterations]
    if result.ended():
        normal, shear = errors.loads(problem, result)
        cells += [f"{normal:.6g}", f"{shear:.6g}", errors.error(problem, result)]
    else:
        reached = f" at time {result.forces[-1][0]:.3g}" if result.forces else ""
        cells += ["", "", result.why.replace("\n", " ").replace("|", " ") + reached]
    return "| " + " | ".join(map(str, cells)) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=lambda p: str(Path(p).resolve()))
    parser.add_argument("--problems", nargs="+", choices=PROBLEMS, default=list(PROBLEMS))
    parser.add_argument("--sizes", nargs="+", type=int, choices=(1, 5, 20, 80), default=[5, 20, 80])
    parser.add_argument("--codes", nargs="+", choices=CODES, default=list(CODES))
    parser.add_argument("--limit", type=float, default=600, help="CPU seconds a run may take")
    parser.add_argument("--getfem", default="/usr/bin/python3", help="the Python that has GetFEM")
    parser.add_argument("--keep", help="folder in which inputs and results stay")
    given = parser.parse_args()
    keep = Path(given.keep or tempfile.mkdtemp())
    keep.mkdir(parents=True, exist_ok=True)
    print("| problem | code | unknowns | user [s] | wall [s] | memory [MB] | iterations | N [N] | T [N] | error |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name in given.problems:
        for size in given.sizes:
            problem = PROBLEMS[name](size)
            for code in given.codes:
                result = CODES[code](problem, keep / name / str(size) / code, given)
                with open(keep / "results.jsonl", "a") as out:
                    out.write(json.dumps({"problem": name, "size": size, "run": code, **asdict(result)}) + "\n")
                print(row(problem, result), flush=True)


if __name__ == "__main__":
    main()
