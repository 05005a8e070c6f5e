//! Order of the nodes and cells of a mesh along a curve that fills space, so that what lies close together has close numbers.
//!
//! Mesh generators number nodes line by line, surface by surface and then at random. Explicit steps read displacements of the
//! nodes of each cell, and wait for memory if these are scattered over it.

use asperity_fem::mesh::{Cells, Mesh, Side};
use asperity_mechanics::bounds;

/// Bits of a coordinate along each axis: three axes fit into 64 bits.
const BITS: u32 = 21;

/// The same mesh with nodes, and cells of each block, in the order of Morton's curve (Morton 1966): by the bits of all
/// coordinates, the highest of each axis first. Nodes at the same position stay in their order.
pub fn along_curve<const D: usize>(mesh: Mesh<D>) -> Mesh<D> {
    let curve = Curve::through(&mesh.nodes);
    let (nodes, number) = sorted(mesh.nodes.len(), |n| curve.key(&mesh.nodes[n]));
    let mut cells = Vec::new();
    let blocks = mesh.blocks.iter().map(|block| {
        let centre = |cell: usize| -> [f64; D] {
            let own = block.cell(cell);
            std::array::from_fn(|c| own.iter().map(|&n| mesh.nodes[n][c]).sum::<f64>() / own.len() as f64)
        };
        let (order, moved) = sorted(block.len(), |cell| curve.key(&centre(cell)));
        cells.push(moved);
        let connectivity =
            order.iter().flat_map(|&cell| block.cell(cell).iter().map(|&n| number[n])).collect();
        Cells { kind: block.kind, connectivity }
    });
    let blocks = blocks.collect();
    let side = |s: Side| Side { cell: cells[s.block][s.cell], ..s };
    let sides = |(name, set): (String, Vec<Side>)| (name, set.into_iter().map(side).collect());
    let named = |(name, set): (String, Vec<usize>)| {
        let mut set: Vec<usize> = set.into_iter().map(|n| number[n]).collect();
        set.sort_unstable();
        (name, set)
    };
    Mesh {
        nodes: nodes.iter().map(|&n| mesh.nodes[n]).collect(),
        blocks,
        side_sets: mesh.side_sets.into_iter().map(sides).collect(),
        cell_sets: mesh.cell_sets,
        node_sets: mesh.node_sets.into_iter().map(named).collect(),
        left_out: mesh.left_out,
    }
}

/// Morton's curve through a box.
struct Curve<const D: usize> {
    least: [f64; D],
    /// Number of steps of a coordinate per length \[1/m\].
    scale: f64,
}

impl<const D: usize> Curve<D> {
    fn through(nodes: &[[f64; D]]) -> Self {
        let (least, most) = bounds(nodes);
        let extent = (0..D).map(|c| most[c] - least[c]).fold(0.0, f64::max);
        Self { least, scale: f64::from((1_u32 << BITS) - 1) / extent }
    }

    /// Distance of a position along the curve.
    fn key(&self, x: &[f64; D]) -> u64 {
        let whole: [u64; D] = std::array::from_fn(|c| ((x[c] - self.least[c]) * self.scale) as u64);
        let bits = (0..BITS).rev().flat_map(|bit| whole.iter().map(move |w| w >> bit & 1));
        bits.fold(0, |key: u64, bit| key << 1 | bit)
    }
}

/// Entries in the order of their keys, and the place of each.
fn sorted(count: usize, key: impl Fn(usize) -> u64) -> (Vec<usize>, Vec<usize>) {
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_cached_key(|&k| (key(k), k));
    let mut places = vec![0; count];
    order.iter().enumerate().for_each(|(place, &k)| places[k] = place);
    (order, places)
}
