//! Cell size h on which penalties are based, independent of the rotation, mirroring and numbering of the cell.

use asperity_fem::element::ElementKind;
use asperity_fem::mesh::Mesh;
use nalgebra::Vector3;

/// Size of a cell \[m\], from the edges e_m of its linear image at its centre. It is the longest edge of quadrilaterals and
/// hexahedra, √|e_1 × e_2| of triangles and ∛|e_1·(e_2 × e_3)| of tetrahedra. The latter two equal h for cells that halve a
/// square or share a cube of edge h. For wedges it is the longer of edge and triangle.
pub fn cell_size<const D: usize>(mesh: &Mesh<D>, block: usize, cell: usize) -> f64 {
    let cells = &mesh.blocks[block];
    let kind = cells.kind.linear();
    let shape = kind.shape(centre(kind));
    let mut e = [Vector3::zeros(); 3];
    for (a, &node) in cells.cell(cell)[..kind.nodes()].iter().enumerate() {
        let x = Vector3::from_fn(|i, _| mesh.nodes[node].get(i).copied().unwrap_or(0.0));
        e.iter_mut().zip(shape.dn[a]).for_each(|(e, slope)| *e += slope * x);
    }
    let area = e[0].cross(&e[1]);
    match kind {
        ElementKind::Tri3 => area.norm().sqrt(),
        ElementKind::Tet4 => area.dot(&e[2]).abs().cbrt(),
        ElementKind::Wedge6 => (2.0 * e[2].norm()).max(area.norm().sqrt()),
        // The reference element has edges of length two.
        _ => e.iter().map(|e| 2.0 * e.norm()).fold(0.0, f64::max),
    }
}

/// Position at which edges are evaluated. Those of simplices are the same everywhere.
fn centre(kind: ElementKind) -> [f64; 3] {
    if kind == ElementKind::Wedge6 { [1.0 / 3.0, 1.0 / 3.0, 0.0] } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::cell_size;
    use asperity_fem::element::ElementKind;
    use asperity_fem::mesh::{Cells, Mesh};

    /// The reference element stretched by (2, 1, 1/2), rotated by `angle` about z and then about x, and optionally mirrored in
    /// x.
    fn cell<const D: usize>(kind: ElementKind, angle: f64, mirrored: bool) -> Mesh<D> {
        let (s, c) = angle.sin_cos();
        let place = |xi: &[f64; 3]| {
            let x = [2.0 * xi[0], xi[1], 0.5 * xi[2]];
            let about_z = [c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]];
            let y = if D == 3 {
                [about_z[0], c * about_z[1] - s * about_z[2], s * about_z[1] + c * about_z[2]]
            } else {
                about_z
            };
            std::array::from_fn(|i| if i == 0 && mirrored { -y[i] } else { y[i] })
        };
        let nodes: Vec<[f64; D]> = kind.node_coordinates().iter().map(place).collect();
        let cells = Cells { kind, connectivity: (0..nodes.len()).collect() };
        Mesh { nodes, blocks: vec![cells], ..Mesh::default() }
    }

    #[test]
    fn sizes_do_not_depend_on_how_a_cell_is_turned_or_mirrored() {
        let longest = |kind: ElementKind, expected: f64| {
            for angle in [0.0, 0.3, 0.645_772, 2.0] {
                for mirrored in [false, true] {
                    let found = match kind.dimension() {
                        2 => cell_size(&cell::<2>(kind, angle, mirrored), 0, 0),
                        _ => cell_size(&cell::<3>(kind, angle, mirrored), 0, 0),
                    };
                    assert!((found - expected).abs() < 1e-14, "{}: {found} is not {expected}", kind.name());
                }
            }
        };
        longest(ElementKind::Quad4, 4.0);
        longest(ElementKind::Quad9, 4.0);
        longest(ElementKind::Hex8, 4.0);
        longest(ElementKind::Hex27, 4.0);
        longest(ElementKind::Tri3, f64::sqrt(2.0));
        longest(ElementKind::Tri6, f64::sqrt(2.0));
        longest(ElementKind::Tet4, 1.0);
        longest(ElementKind::Tet10, 1.0);
        longest(ElementKind::Wedge15, f64::sqrt(2.0));
    }
}
