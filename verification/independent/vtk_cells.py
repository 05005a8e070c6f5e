"""The order of nodes and of tensor components in VTK, obtained from VTK itself.

    python3.11 -m venv venv && venv/bin/pip install vtk==9.7.2
    venv/bin/python vtk_cells.py        # rewrites vtk_cells.json

`nodes` holds the parametric coordinates of the nodes of each cell type, by its number. `symmetric_tensor` names the components
of an array of six, in the order for which numpy and VTK find the same principal values.
"""

import itertools
import json
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

CELLS = [
    vtk.vtkTriangle,
    vtk.vtkQuad,
    vtk.vtkTetra,
    vtk.vtkHexahedron,
    vtk.vtkWedge,
    vtk.vtkQuadraticTriangle,
    vtk.vtkQuadraticQuad,
    vtk.vtkQuadraticTetra,
    vtk.vtkQuadraticHexahedron,
    vtk.vtkQuadraticWedge,
    vtk.vtkBiQuadraticQuad,
    vtk.vtkTriQuadraticHexahedron,
]


def nodes():
    cells = [cell() for cell in CELLS]
    return {
        cell.GetCellType(): np.reshape(cell.GetParametricCoords()[: 3 * cell.GetNumberOfPoints()], (-1, 3)).tolist()
        for cell in cells
    }


def principal(values):
    """Principal values of six components by VTK, largest first."""
    points = vtk.vtkPoints()
    points.InsertNextPoint(0, 0, 0)
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    array = numpy_to_vtk(np.array([values], dtype=float), deep=True)
    array.SetName("stress")
    data.GetPointData().AddArray(array)
    invariants = vtk.vtkTensorPrincipalInvariants()
    invariants.SetInputData(data)
    invariants.Update()
    out = invariants.GetOutput().GetPointData()
    found = [vtk_to_numpy(out.GetArray(f"stress - Sigma {k}")) for k in (1, 2, 3)]
    return np.sort(np.concatenate(found))


def components():
    """Names of the six components, in the only order for which a full tensor has VTK's principal values."""
    values = [1.0, 2.5, -4.0, 0.7, 1.9, -3.1]
    names = ["XX", "YY", "ZZ", "XY", "YZ", "XZ"]
    found = []
    for order in itertools.permutations(names):
        of = dict(zip(order, values))
        full = [[of["XX"], of["XY"], of["XZ"]], [of["XY"], of["YY"], of["YZ"]], [of["XZ"], of["YZ"], of["ZZ"]]]
        if np.allclose(np.linalg.eigvalsh(full), principal(values), rtol=0, atol=1e-12):
            found.append(order)
    return found


def main():
    orders = components()
    # Principal values do not depend on the names of axes, so the six permutations of axes remain.
    first = [order for order in orders if order[:3] == ("XX", "YY", "ZZ")]
    assert len(orders) == 6 and len(first) == 1, orders
    cells = ",\n".join(f'  "{kind}": {json.dumps(at)}' for kind, at in nodes().items())
    head = f'"vtk": "{vtk.VTK_VERSION}",\n "symmetric_tensor": {json.dumps(first[0])}'
    text = f'{{{head},\n "nodes": {{\n{cells}\n }}\n}}\n'
    Path(__file__).with_name("vtk_cells.json").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
