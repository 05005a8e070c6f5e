//! Cells between the columns of [`Layers`]: quadrilaterals, and triangles where a row ends.

use super::FaultMesh;
use super::layers::Layers;
use crate::element::ElementKind;
use crate::mesh::{Cells, Mesh, Side, face_nodes};
use std::collections::BTreeMap;

/// Nodes of columns, each numbered from the bottom to the top.
struct Numbers {
    /// Node of each column on the line.
    line: Vec<usize>,
}

impl Numbers {
    fn new(layers: &Layers) -> Self {
        let mut before = 0;
        let mut line = Vec::with_capacity(layers.columns.len());
        for column in &layers.columns {
            line.push(before + column.below.len() - 1);
            before += column.below.len() + column.above.len() - 1;
        }
        Self { line }
    }

    /// Node of a column at the end of a row above the line; row 0 is the line.
    fn above(&self, column: usize, row: usize) -> usize {
        self.line[column] + row
    }

    /// Node of a column at the end of a row below the line.
    fn below(&self, column: usize, row: usize) -> usize {
        self.line[column] - row
    }
}

/// The mesh before splitting.
pub(super) fn mesh(input: &FaultMesh, layers: &Layers) -> Mesh<2> {
    let mut mesh = Mesh { nodes: nodes(input, layers), ..Mesh::default() };
    let (quads, triangles) = cells(layers);
    let triangle = if input.kind == ElementKind::Quad4 { ElementKind::Tri3 } else { ElementKind::Tri6 };
    let mut middles = BTreeMap::new();
    for (kind, cells) in [(input.kind, quads), (triangle, triangles)] {
        let mut connectivity = Vec::with_capacity(cells.len() * kind.nodes());
        for cell in cells {
            connectivity.extend(whole(kind, &cell, &mut mesh.nodes, &mut middles));
        }
        if !connectivity.is_empty() {
            mesh.blocks.push(Cells { kind, connectivity });
        }
    }
    mesh.side_sets = sides(input, &mesh);
    mesh
}

/// Edges of the fault from its lower to its upper tip, as nodes; `count` is the number of its nodes.
pub(super) fn fault_edges(layers: &Layers, count: usize) -> Vec<Vec<usize>> {
    let numbers = Numbers::new(layers);
    let node = |k: usize| numbers.line[layers.first + if layers.falls { count - 1 - k } else { k }];
    (0..count - 1).map(|k| vec![node(k), node(k + 1)]).collect()
}

fn nodes(input: &FaultMesh, layers: &Layers) -> Vec<[f64; 2]> {
    let mut nodes = Vec::new();
    for column in &layers.columns {
        let last = column.below.len() - 1;
        // Exactly on the boundary, whatever the rounding of distances.
        let down = column.below[1..]
            .iter()
            .enumerate()
            .map(|(k, d)| if k + 1 == last { input.min[1] } else { column.line - d });
        nodes.extend(down.rev().map(|y| [column.x, y]));
        nodes.push([column.x, column.line]);
        let last = column.above.len() - 1;
        let up = column.above[1..]
            .iter()
            .enumerate()
            .map(|(k, d)| if k + 1 == last { input.max[1] } else { column.line + d });
        nodes.extend(up.map(|y| [column.x, y]));
    }
    nodes
}

/// Corners of the quadrilaterals and of the triangles, anticlockwise.
fn cells(layers: &Layers) -> (Vec<Vec<usize>>, Vec<Vec<usize>>) {
    let numbers = Numbers::new(layers);
    let (mut quads, mut triangles) = (Vec::new(), Vec::new());
    for (a, pair) in layers.columns.windows(2).enumerate() {
        let b = a + 1;
        let [left, right] = [pair[0].below.len() - 1, pair[1].below.len() - 1];
        let at = |column: usize, row: usize| numbers.below(column, row);
        for row in (0..left.min(right)).rev() {
            quads.push(vec![at(a, row + 1), at(b, row + 1), at(b, row), at(a, row)]);
        }
        if left < right {
            triangles.push(vec![at(a, left), at(b, right), at(b, left)]);
        } else if left > right {
            triangles.push(vec![at(a, left), at(b, right), at(a, right)]);
        }
        let [left, right] = [pair[0].above.len() - 1, pair[1].above.len() - 1];
        let at = |column: usize, row: usize| numbers.above(column, row);
        for row in 0..left.min(right) {
            quads.push(vec![at(a, row), at(b, row), at(b, row + 1), at(a, row + 1)]);
        }
        if left < right {
            triangles.push(vec![at(a, left), at(b, left), at(b, right)]);
        } else if left > right {
            triangles.push(vec![at(a, right), at(b, right), at(a, left)]);
        }
    }
    (quads, triangles)
}

/// All nodes of a cell with these corners. Nodes in the middle of edges are shared with its neighbours.
fn whole(
    kind: ElementKind,
    corners: &[usize],
    nodes: &mut Vec<[f64; 2]>,
    middles: &mut BTreeMap<[usize; 2], usize>,
) -> Vec<usize> {
    let n = corners.len();
    let mut cell = corners.to_vec();
    let mean = |nodes: &[[f64; 2]], of: &[usize]| -> [f64; 2] {
        std::array::from_fn(|c| of.iter().map(|&k| nodes[k][c]).sum::<f64>() / of.len() as f64)
    };
    if kind.nodes() > n {
        for k in 0..n {
            let (a, b) = (corners[k], corners[(k + 1) % n]);
            let middle = *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                nodes.push(mean(nodes, &[a, b]));
                nodes.len() - 1
            });
            cell.push(middle);
        }
    }
    if kind.nodes() > 2 * n {
        nodes.push(mean(nodes, corners));
        cell.push(nodes.len() - 1);
    }
    cell
}

/// Sides of the box: edges of one cell, ascending in x or y.
fn sides(input: &FaultMesh, mesh: &Mesh<2>) -> BTreeMap<String, Vec<Side>> {
    let mut single: BTreeMap<[usize; 2], Option<Side>> = BTreeMap::new();
    for (block, cells) in mesh.blocks.iter().enumerate() {
        for cell in 0..cells.len() {
            for face in 0..cells.kind.corners() {
                let side = Side { block, cell, face };
                let ends = face_nodes(mesh, &side);
                let edge = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                single.entry(edge).and_modify(|side| *side = None).or_insert(Some(side));
            }
        }
    }
    let boxed =
        [("left", 0, input.min), ("right", 0, input.max), ("bottom", 1, input.min), ("top", 1, input.max)];
    let of = |(name, axis, corner): (&str, usize, [f64; 2])| {
        let on = |edge: &[usize; 2]| edge.iter().all(|&n| mesh.nodes[n][axis] == corner[axis]);
        let middle = |edge: &[usize; 2]| edge.iter().map(|&n| mesh.nodes[n][1 - axis]).sum::<f64>();
        let found = single.iter().filter(|(edge, _)| on(edge));
        let mut found: Vec<(f64, Side)> = found.filter_map(|(e, side)| Some((middle(e), (*side)?))).collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        (name.to_string(), found.into_iter().map(|(_, side)| side).collect())
    };
    boxed.into_iter().map(of).collect()
}
