//! Visible part of a mesh, as triangles to fill and outlines to draw: its cells in two dimensions, its outer faces seen from
//! z = +∞ in three.

use crate::bodies::view::MeshView;
use crate::fields::vtu::Cell;
use std::collections::BTreeMap;

/// A corner of a triangle as the mean of some nodes: a single node, or the centre of a face.
pub(super) type Corner = Vec<usize>;

/// Parts to draw, in drawing order.
#[derive(Debug, Default)]
pub(super) struct VisibleParts {
    pub triangles: Vec<[Corner; 3]>,
    /// Lines of nodes along the boundary of a body.
    pub outline: Vec<Vec<usize>>,
}

/// A face: its nodes around the boundary including midside nodes, and its centre node, if any.
struct Face {
    ring: Vec<usize>,
    centre: Option<usize>,
    body: usize,
}

/// Corner nodes of the faces of a tetrahedron in VTK numbering, outward by the right-hand rule.
const TET: [&[usize]; 4] = [&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[0, 3, 2]];
/// Corner nodes of the faces of a hexahedron, see [`TET`].
const HEX: [&[usize]; 6] =
    [&[0, 3, 2, 1], &[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];

/// Corner nodes of the faces of a wedge, see [`TET`].
const WEDGE: [&[usize]; 5] = [&[0, 2, 1], &[3, 4, 5], &[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]];

/// Collects the visible part of a mesh.
pub(super) fn visible(mesh: &MeshView) -> VisibleParts {
    let faces = if mesh.dimension == 3 { upper_faces(mesh) } else { flat_cells(mesh) };
    let triangles = faces.iter().flat_map(Face::triangles).collect();
    VisibleParts { triangles, outline: outline(&faces) }
}

impl Face {
    /// Triangles in a fan around the centre, so that a bilinear field keeps its value there. Without a centre node, the mean of
    /// the ring is used, or of its midside nodes if there are any: the dominant part of the serendipity value.
    fn triangles(&self) -> Vec<[Corner; 3]> {
        let n = self.ring.len();
        if n == 3 {
            return vec![[vec![self.ring[0]], vec![self.ring[1]], vec![self.ring[2]]]];
        }
        let centre = match self.centre {
            Some(node) => vec![node],
            None if n >= 6 => self.ring.iter().skip(1).step_by(2).copied().collect(),
            None => self.ring.clone(),
        };
        (0..n).map(|i| [vec![self.ring[i]], vec![self.ring[(i + 1) % n]], centre.clone()]).collect()
    }
}

/// Faces of flat cells, with the centre node of quad9.
fn flat_cells(mesh: &MeshView) -> Vec<Face> {
    let ring = |nodes: &[usize], corners: usize| -> Vec<usize> {
        (0..corners).flat_map(|i| [nodes[i], nodes[corners + i]]).collect()
    };
    let cells = mesh.cells.iter().zip(&mesh.cell_body);
    let face = |(Cell { kind, points: nodes }, &body): (&Cell, &usize)| {
        let (ring, centre) = match kind {
            5 | 9 => (nodes.clone(), None),
            22 => (ring(nodes, 3), None),
            23 => (ring(nodes, 4), None),
            28 => (ring(nodes, 4), Some(nodes[8])),
            _ => return None,
        };
        Some(Face { ring, centre, body })
    };
    cells.filter_map(face).collect()
}

/// Outer faces whose normal has a positive z component, from the lowest to the highest.
fn upper_faces(mesh: &MeshView) -> Vec<Face> {
    let mut outer: BTreeMap<Vec<usize>, Option<Face>> = BTreeMap::new();
    for (Cell { kind, points: nodes }, &body) in mesh.cells.iter().zip(&mesh.cell_body) {
        let corners: &[&[usize]] = match kind {
            10 | 24 => &TET,
            12 | 25 | 29 => &HEX,
            13 | 26 => &WEDGE,
            _ => continue,
        };
        for face in corners {
            let ring: Vec<usize> = face.iter().map(|&i| nodes[i]).collect();
            let mut key = ring.clone();
            key.sort_unstable();
            // A face that occurs twice is interior.
            outer.entry(key).and_modify(|face| *face = None).or_insert(Some(Face {
                ring,
                centre: None,
                body,
            }));
        }
    }
    let mut faces: Vec<Face> =
        outer.into_values().flatten().filter(|face| looks_up(mesh, &face.ring)).collect();
    let height =
        |face: &Face| face.ring.iter().map(|&n| mesh.nodes[n][2]).sum::<f64>() / face.ring.len() as f64;
    faces.sort_by(|a, b| height(a).total_cmp(&height(b)));
    faces
}

/// True if the area of the ring projected along z is positive beyond rounding.
fn looks_up(mesh: &MeshView, ring: &[usize]) -> bool {
    let (mut area, mut size) = (0.0, 0.0);
    for i in 0..ring.len() {
        let (a, b) = (mesh.nodes[ring[i]], mesh.nodes[ring[(i + 1) % ring.len()]]);
        area += (a[0] * b[1] - a[1] * b[0]) / 2.0;
        let edge: f64 = (0..3).map(|c| (a[c] - b[c]).powi(2)).sum();
        size += edge;
    }
    area > EDGE_ON * size
}

/// Ratio of projected area to squared edges below which a face is seen edge-on.
const EDGE_ON: f64 = 1e-6;

/// Edges that belong to a single face of their body, joined into lines.
fn outline(faces: &[Face]) -> Vec<Vec<usize>> {
    let mut count: BTreeMap<(usize, usize, usize), usize> = BTreeMap::new();
    for face in faces {
        for i in 0..face.ring.len() {
            let (a, b) = (face.ring[i], face.ring[(i + 1) % face.ring.len()]);
            *count.entry((face.body, a.min(b), a.max(b))).or_insert(0) += 1;
        }
    }
    let mut next: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for ((_, a, b), _) in count.into_iter().filter(|(_, n)| *n == 1) {
        next.entry(a).or_default().push(b);
        next.entry(b).or_default().push(a);
    }
    let mut lines = Vec::new();
    while let Some(start) = next.iter().find(|(_, ends)| !ends.is_empty()).map(|(&node, _)| node) {
        let mut line = vec![start];
        let mut at = start;
        while let Some(to) = next.get_mut(&at).and_then(Vec::pop) {
            if let Some(back) = next.get_mut(&to) {
                back.retain(|&node| node != at);
            }
            line.push(to);
            at = to;
        }
        next.retain(|_, ends| !ends.is_empty());
        lines.push(line);
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> Vec<[f64; 3]> {
        let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        [0.0, 1.0, 2.0].iter().flat_map(|&z| corners.map(|[x, y]| [x, y, z])).collect()
    }

    #[test]
    fn the_top_face_of_two_stacked_cubes_is_seen() {
        let mesh = MeshView {
            nodes: cube(),
            cells: vec![Cell::new(12, (0..8).collect()), Cell::new(12, (4..12).collect())],
            cell_body: vec![0, 0],
            bodies: vec!["A".into()],
            dimension: 3,
            ..MeshView::default()
        };
        let seen = visible(&mesh);
        assert_eq!(seen.triangles.len(), 4);
        assert!(seen.triangles.iter().flatten().flatten().all(|&node| node >= 8));
        assert_eq!(seen.outline.len(), 1);
        assert_eq!(seen.outline[0].len(), 5);
    }

    #[test]
    fn the_upper_triangle_of_two_stacked_wedges_is_seen() {
        let layer = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]];
        let mesh = MeshView {
            nodes: [0.0, 1.0, 2.0].into_iter().flat_map(layer).collect(),
            cells: vec![Cell::new(13, (0..6).collect()), Cell::new(13, (3..9).collect())],
            cell_body: vec![0, 0],
            bodies: vec!["A".into()],
            dimension: 3,
            ..MeshView::default()
        };
        let seen = visible(&mesh);
        assert_eq!(seen.triangles.len(), 1);
        assert!(seen.triangles.iter().flatten().flatten().all(|&node| node >= 6));
        assert_eq!(seen.outline, [vec![6, 8, 7, 6]]);
    }

    #[test]
    fn flat_cells_of_every_kind_are_covered_by_triangles() {
        let square = [
            [0.0, 0.0],
            [1.0, 0.0],
            [1.0, 1.0],
            [0.0, 1.0],
            [0.5, 0.0],
            [1.0, 0.5],
            [0.5, 1.0],
            [0.0, 0.5],
            [0.5, 0.5],
        ];
        let triangle = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];
        let cases: [(u8, &[[f64; 2]], f64); 5] = [
            (9, &square[..4], 1.0),
            (23, &square[..8], 1.0),
            (28, &square, 1.0),
            (5, &triangle[..3], 0.5),
            (22, &triangle, 0.5),
        ];
        for (kind, nodes, expected) in cases {
            let mesh = MeshView {
                nodes: nodes.iter().map(|[x, y]| [*x, *y, 0.0]).collect(),
                cells: vec![Cell::new(kind, (0..nodes.len()).collect())],
                cell_body: vec![0],
                bodies: vec!["A".into()],
                dimension: 2,
                ..MeshView::default()
            };
            let mean = |c: &Corner, k: usize| c.iter().map(|&n| nodes[n][k]).sum::<f64>() / c.len() as f64;
            let area = |[a, b, c]: &[Corner; 3]| {
                ((mean(b, 0) - mean(a, 0)) * (mean(c, 1) - mean(a, 1))
                    - (mean(c, 0) - mean(a, 0)) * (mean(b, 1) - mean(a, 1)))
                    / 2.0
            };
            let seen = visible(&mesh);
            assert!(seen.triangles.iter().all(|t| area(t) > 0.0), "type {kind}");
            approx_eq(seen.triangles.iter().map(area).sum(), expected);
        }
    }

    fn approx_eq(found: f64, expected: f64) {
        assert!((found - expected).abs() < 1e-14, "{found} {expected}");
    }
}
