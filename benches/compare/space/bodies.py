"""Meshes of one body: points [mm], cells, and faces of named sides, in the order of nodes of Gmsh."""

from dataclasses import dataclass, field

import numpy as np

HEX_SIDES = {
    "left": (0, 4, 7, 3),
    "right": (1, 2, 6, 5),
    "bottom": (0, 1, 5, 4),
    "top": (3, 7, 6, 2),
    "back": (0, 3, 2, 1),
    "front": (4, 5, 6, 7),
}
GMSH = {"hex8": (5, 3), "tet10": (11, 9)}  # Numbers of the types of cells and faces in files of Gmsh.


@dataclass
class Body:
    kind: str
    points: np.ndarray
    cells: np.ndarray
    sides: dict = field(default_factory=dict)

    def unknowns(self):
        return 3 * len(self.points)

    def nodes(self, side):
        return np.unique(self.sides[side])

    def write(self, path):
        """A file of Gmsh (2.2) with a group for the body and one for each side, numbered from 1 and from 11 on."""
        cell, face = GMSH[self.kind]
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(1 + len(self.sides)), '3 1 "body"']
        lines += [f'2 {11 + k} "{name}"' for k, name in enumerate(self.sides)]
        lines += ["$EndPhysicalNames", "$Nodes", str(len(self.points))]
        lines += [f"{i + 1} {x:.16g} {y:.16g} {z:.16g}" for i, (x, y, z) in enumerate(self.points)]
        elements = [(face, 11 + k, f) for k, faces in enumerate(self.sides.values()) for f in faces]
        elements += [(cell, 1, c) for c in self.cells]
        lines += ["$EndNodes", "$Elements", str(len(elements))]
        lines += [f"{i + 1} {t} 2 {g} {g} " + " ".join(map(str, e + 1)) for i, (t, g, e) in enumerate(elements)]
        path.write_text("\n".join([*lines, "$EndElements"]) + "\n")


def grid(xs, ys, zs):
    """Hexahedra between coordinates along the axes."""
    nx, ny, nz = len(xs), len(ys), len(zs)
    z, y, x = np.meshgrid(zs, ys, xs, indexing="ij")
    points = np.column_stack([x.ravel(), y.ravel(), z.ravel()])
    at = np.arange(nx * ny * nz).reshape(nz, ny, nx)
    lower = [at[:-1, :-1, :-1], at[:-1, :-1, 1:], at[:-1, 1:, 1:], at[:-1, 1:, :-1]]
    upper = [at[1:, :-1, :-1], at[1:, :-1, 1:], at[1:, 1:, 1:], at[1:, 1:, :-1]]
    cells = np.stack([c.ravel() for c in lower + upper], axis=1)
    k, j, i = (v.ravel() for v in np.indices((nz - 1, ny - 1, nx - 1)))
    ends = {"left": i == 0, "right": i == nx - 2, "bottom": j == 0, "top": j == ny - 2, "back": k == 0, "front": k == nz - 2}
    return Body("hex8", points, cells, {s: cells[ends[s]][:, HEX_SIDES[s]] for s in HEX_SIDES})


def graded(fine, to, coarse, end):
    """Coordinates from 0: `fine` equal cells up to `to`, then `coarse` cells that grow evenly up to `end`."""
    h = to / fine
    low, high = 1.0, 10.0
    for _ in range(100):
        ratio = (low + high) / 2
        low, high = (low, ratio) if h * sum(ratio ** (k + 1) for k in range(coarse)) > end - to else (ratio, high)
    sizes = [h * ratio ** (k + 1) for k in range(coarse)]
    out = np.concatenate([np.linspace(0, to, fine + 1), to + np.cumsum(sizes)])
    out[-1] = end
    return out


def curve_bottom(body, depth):
    """Moves the bottom of a grid up by depth(x, z), the layers above in proportion, and keeps its top."""
    x, y, z = body.points.T
    low, high = y.min(), y.max()
    body.points[:, 1] += depth(x, z) * (high - y) / (high - low)
    return body


def crossed_cylinders(size):
    """Parts of a cylinder of radius 10 along z (upper) and one of radius 20 along x (lower) that touch at the origin; tet10."""
    import gmsh

    gmsh.initialize()
    gmsh.option.setNumber("General.Terminal", 0)
    gmsh.option.setNumber("General.NumThreads", 1)
    cad = gmsh.model.occ

    def part(cylinder, box, far, size):
        gmsh.clear()
        cad.intersect([(3, cad.addCylinder(*cylinder))], [(3, cad.addBox(*box))])
        cad.synchronize()
        near = gmsh.model.mesh.field.add("Ball")
        for key, value in (("Radius", 0.7), ("VIn", size / 6), ("VOut", size), ("Thickness", 2.5)):
            gmsh.model.mesh.field.setNumber(near, key, value)
        gmsh.model.mesh.field.setAsBackgroundMesh(near)
        gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)
        gmsh.model.mesh.generate(3)
        gmsh.model.mesh.setOrder(2)
        tags, points, _ = gmsh.model.mesh.getNodes()
        at = np.zeros(int(tags.max()) + 1, int)
        at[tags.astype(int)] = np.arange(len(tags))
        _, _, cells = gmsh.model.mesh.getElements(3)
        sides = {"contact": [], "far": []}
        for dimension, tag in gmsh.model.getEntities(2):
            curved = gmsh.model.getType(dimension, tag) == "Cylinder"
            if curved or abs(cad.getCenterOfMass(dimension, tag)[1] - far) < 1e-6:
                faces = gmsh.model.mesh.getElements(2, tag)[2][0]
                sides["contact" if curved else "far"].append(at[faces.astype(int)].reshape(-1, 6))
        sides = {name: np.concatenate(faces) for name, faces in sides.items()}
        return Body("tet10", points.reshape(-1, 3), at[cells[0].astype(int)].reshape(-1, 10), sides)

    upper = part((0, 10, -3, 0, 0, 6, 10), (-3, -1, -3, 6, 4, 6), 3, size)
    lower = part((-5, -20, 0, 10, 0, 0, 20), (-5, -4, -5, 10, 5, 10), -4, 1.13 * size)
    gmsh.finalize()
    return upper, lower
