"""Compares mesh files as read by asperity, Gmsh and meshio, and exits non-zero if they differ.

    cargo run --release -p asperity --example mesh_summary -- target/meshes.json crates/fem/tests/meshes/[gmu]*.*[hp]
    python interop/check_meshes.py target/meshes.json crates/fem/tests/meshes

Gmsh is the reference for its own format: number of nodes, cells by element, and groups with their numbers of cells, faces
and nodes. meshio gives nodes in VTK's order, so that whole cells can be compared node by node, for Abaqus files too. Files that
one of them does not read are listed below, so that a change is noticed.
"""

import contextlib
import copy
import io
import json
import sys
from pathlib import Path

import gmsh
import meshio
import numpy as np

# meshio's names of elements.
MESHIO = {
    "tri3": "triangle", "tri6": "triangle6", "quad4": "quad", "quad8": "quad8", "quad9": "quad9",
    "tet4": "tetra", "tet10": "tetra10", "hex8": "hexahedron", "hex20": "hexahedron20", "hex27": "hexahedron27",
    "wedge6": "wedge", "wedge15": "wedge15",
}  # fmt: skip
# Gmsh's numbers of elements.
GMSH = {2: "tri3", 9: "tri6", 3: "quad4", 16: "quad8", 10: "quad9", 4: "tet4", 11: "tet10", 5: "hex8", 17: "hex20",
        12: "hex27", 6: "wedge6", 18: "wedge15"}  # fmt: skip

# What meshio 5.3.5 does not read: parametric nodes, partitioned entities, wedges of second order, Abaqus elements CPS6, CPS8 and
# M3D9, which stand for faces.
NOT_MESHIO = {
    "unit_parametric.msh", "unit_parametric_binary.msh", "unit_parametric_v22.msh",
    "unit_partitioned.msh", "unit_partitioned_binary.msh", "unit_wedge15.msh", "unit_wedge15_v22_binary.msh",
    "unit_hex20.inp", "unit_hex27.inp", "unit_tet10.inp", "unit_wedge15.inp",
}  # fmt: skip

# Decimals to which positions must agree; the samples are a few units wide.
DIGITS = 9

problems: list[str] = []


def expect(condition, message):
    """Records a problem and continues, so that one run shows all of them."""
    if not condition:
        problems.append(message)
    return bool(condition)


def distinct(rows):
    """Number of distinct node sets among the rows: old files repeat an element for each of its groups."""
    return len({tuple(sorted(row)) for row in rows})


def by_gmsh(path):
    """Nodes of cells, cells by element, and groups: {name: {0 for cells, 1 for faces, 2 for nodes: count}}."""
    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    try:
        gmsh.open(str(path))
        types, _, nodes = gmsh.model.mesh.getElements()
        rows = {int(t): np.reshape(n, (-1, gmsh.model.mesh.getElementProperties(t)[3])) for t, n in zip(types, nodes)}
        dimension = max(gmsh.model.mesh.getElementProperties(t)[1] for t in rows)
        cells = {GMSH[t]: r for t, r in rows.items() if gmsh.model.mesh.getElementProperties(t)[1] == dimension}
        groups = {}
        for of, tag in gmsh.model.getPhysicalGroups():
            name = gmsh.model.getPhysicalName(of, tag) or str(tag)
            below = min(dimension - of, 2)
            members = groups.setdefault(name, {}).setdefault(below, set())
            for entity in gmsh.model.getEntitiesForPhysicalGroup(of, tag):
                for t, n in zip(*gmsh.model.mesh.getElements(of, entity)[::2]):
                    n = np.reshape(n, (-1, gmsh.model.mesh.getElementProperties(t)[3]))
                    members.update(n.ravel().tolist() if below == 2 else (tuple(sorted(row)) for row in n.tolist()))
        groups = {name: {below: len(m) for below, m in by.items()} for name, by in groups.items()}
        used = {node for r in cells.values() for node in r.ravel().tolist()}
        return len(used), {kind: distinct(r.tolist()) for kind, r in cells.items()}, groups
    finally:
        gmsh.finalize()


def check_gmsh(name, path, ours):
    nodes, cells, groups = by_gmsh(path)
    expect(ours["nodes"] == nodes, f"{name}: {ours['nodes']} nodes, Gmsh has {nodes}")
    counts = {kind: len(list_) for kind, list_ in ours["cells"].items()}
    expect(counts == cells, f"{name}: cells {counts}, Gmsh has {cells}")
    found = {}
    for below, sets in enumerate(["cell_sets", "side_sets", "node_sets"]):
        for group, count in ours[sets].items():
            found.setdefault(group, {})[below] = count
    expect(found == groups, f"{name}: groups {found}, Gmsh has {groups}")


def by_meshio(path):
    """The mesh, or None if meshio cannot read it."""
    try:
        with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
            return meshio.read(path)
    except (SystemExit, KeyError, TypeError, meshio.ReadError):
        return None


def ordered(cells):
    """Cells as rows of all their coordinates, sorted and without duplicates."""
    rows = np.asarray(cells, dtype=float).reshape(len(cells), -1)
    return np.unique(np.round(rows, DIGITS), axis=0)


def check_meshio(name, path, ours):
    mesh = by_meshio(path)
    expect((mesh is None) == (name in NOT_MESHIO), f"{name}: meshio {'does not read' if mesh is None else 'reads'} it")
    if mesh is None:
        return 0
    compared = 0
    for kind, cells in ours["cells"].items():
        dimension = len(cells[0][0])
        theirs = [mesh.points[block.data][:, :, :dimension] for block in mesh.cells if block.type == MESHIO[kind]]
        if not expect(theirs, f"{name}: meshio has no {kind}"):
            continue
        theirs = np.concatenate(theirs)
        if name == "unit_clockwise.msh":
            theirs = theirs[:, [0, 3, 2, 1]]  # Reversed by asperity, which needs counterclockwise cells.
        a, b = ordered(cells), ordered(theirs)
        same = np.array_equal(a, b)
        expect(same, f"{name}: {kind} cells differ from meshio's, or the order of their nodes does")
        compared += len(a)
    return compared


def check(summary, folder):
    """Problems of a summary, the number of files compared with Gmsh, and of cells with meshio."""
    problems.clear()
    compared = by_reference = 0
    for name, ours in summary.items():
        if name.endswith(".msh"):
            check_gmsh(name, folder / name, ours)
            by_reference += 1
        compared += check_meshio(name, folder / name, ours)
    return list(problems), by_reference, compared


def damages(summary):
    """Damaged copies of the summary of one file that both programs read."""
    name = next(n for n in summary if n.endswith(".msh") and n not in NOT_MESHIO and summary[n]["cell_sets"])
    one = {name: summary[name]}

    def changed(change):
        damaged = copy.deepcopy(one)
        change(damaged[name])
        return damaged

    kind = next(iter(one[name]["cells"]))
    group = next(iter(one[name]["cell_sets"]))
    yield "a node less", changed(lambda s: s.update({"nodes": s["nodes"] - 1}))
    yield "a cell less", changed(lambda s: s["cells"][kind].pop())
    yield "nodes of a cell in another order", changed(lambda s: s["cells"][kind][0].reverse())
    yield "a cell more in a group", changed(lambda s: s["cell_sets"].update({group: s["cell_sets"][group] + 1}))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    summary = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    folder = Path(sys.argv[2])
    found, by_reference, compared = check(summary, folder)
    tried = list(damages(summary))
    found += [f"{what} is not noticed" for what, damaged in tried if not check(damaged, folder)[0]]
    for problem in found:
        print(problem, file=sys.stderr)
    files = f"{len(summary)} files, {by_reference} against Gmsh, {compared} cells against meshio"
    print(f"{files}, {len(tried)} damaged summaries tried, {len(found)} problems")
    sys.exit(1 if found or not summary else 0)


if __name__ == "__main__":
    main()
