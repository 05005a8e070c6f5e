//! Order of the nodes and cells of a mesh for explicit steps.
//!
//! Mesh generators number nodes line by line, surface by surface and then at random. Explicit steps read displacements of the
//! nodes of each cell, and wait for memory if these are scattered over it: nodes of a file follow a curve that fills space, so that
//! what lies close together has close numbers. Nodes of grids follow their longest lines.

use asperity_fem::mesh::{Cells, Mesh, Side};
use asperity_mechanics::bounds;

/// Bits of a coordinate along each axis: three axes fit into 64 bits.
const BITS: u32 = 21;

/// The same mesh with nodes, and cells of each block, in the order of Morton's curve (Morton 1966): by the bits of all
/// coordinates, the highest of each axis first. Nodes at the same position stay in their order.
pub fn along_curve<const D: usize>(mesh: Mesh<D>) -> Mesh<D> {
    let curve = Curve::through(&mesh.nodes);
    let nodes = sorted(mesh.nodes.len(), |n| curve.key(&mesh.nodes[n]));
    let centre = |own: &[usize]| -> [f64; D] {
        std::array::from_fn(|c| own.iter().map(|&n| mesh.nodes[n][c]).sum::<f64>() / own.len() as f64)
    };
    let cells = mesh.blocks.iter().map(|b| sorted(b.len(), |cell| curve.key(&centre(b.cell(cell)))));
    let cells = cells.collect();
    renumbered(mesh, nodes, cells)
}

/// The same mesh of a rectangular grid with its nodes in lines along the axis that has most, then along that which has most of the
/// others; a mesh of another form stays as it is. The ends of a line fill no vector and take as long as many of its other nodes. A
/// fault across the axis that has fewest nodes is then one range of them.
pub fn along_lines<const D: usize>(mesh: Mesh<D>) -> Mesh<D> {
    let Some(lines) = Lines::through(&mesh.nodes) else { return mesh };
    let nodes = sorted(mesh.nodes.len(), |n| lines.key(&mesh.nodes[n]));
    let first = |own: &[usize]| own.iter().map(|&n| nodes.places[n]).min();
    let cells = mesh.blocks.iter().map(|b| sorted(b.len(), |cell| first(b.cell(cell)))).collect();
    renumbered(mesh, nodes, cells)
}

/// The same mesh with nodes, and cells of each block, in these orders.
fn renumbered<const D: usize>(mesh: Mesh<D>, nodes: Order, cells: Vec<Order>) -> Mesh<D> {
    let number = &nodes.places;
    let blocks = mesh.blocks.iter().zip(&cells).map(|(block, cells)| {
        let all = cells.entries.iter().flat_map(|&cell| block.cell(cell));
        Cells { kind: block.kind, connectivity: all.map(|&n| number[n]).collect() }
    });
    let blocks = blocks.collect();
    let side = |s: Side| Side { cell: cells[s.block].places[s.cell], ..s };
    let sides = |(name, set): (String, Vec<Side>)| (name, set.into_iter().map(side).collect());
    let named = |(name, set): (String, Vec<usize>)| {
        let mut set: Vec<usize> = set.into_iter().map(|n| number[n]).collect();
        set.sort_unstable();
        (name, set)
    };
    Mesh {
        nodes: nodes.entries.iter().map(|&n| mesh.nodes[n]).collect(),
        blocks,
        side_sets: mesh.side_sets.into_iter().map(sides).collect(),
        cell_sets: mesh.cell_sets,
        node_sets: mesh.node_sets.into_iter().map(named).collect(),
        left_out: mesh.left_out,
    }
}

/// Lines of a rectangular grid.
struct Lines<const D: usize> {
    /// Positions along each axis, ascending \[m\].
    positions: [Vec<f64>; D],
    /// Axes, the one with most positions last.
    axes: [usize; D],
}

impl<const D: usize> Lines<D> {
    /// Lines through all nodes, if a node lies where any of them cross.
    fn through(nodes: &[[f64; D]]) -> Option<Self> {
        let positions: [Vec<f64>; D] = std::array::from_fn(|axis| {
            let mut all: Vec<f64> = nodes.iter().map(|x| x[axis]).collect();
            all.sort_unstable_by(f64::total_cmp);
            all.dedup();
            all
        });
        let mut axes = std::array::from_fn(|axis| axis);
        axes.sort_by_key(|&axis| positions[axis].len());
        let crossings: usize = positions.iter().map(Vec::len).product();
        (crossings == nodes.len()).then_some(Self { positions, axes })
    }

    /// Number of a position in lines along the last axis.
    fn key(&self, x: &[f64; D]) -> usize {
        let number = |axis: usize| self.positions[axis].partition_point(|p| *p < x[axis]);
        self.axes.iter().fold(0, |key, &axis| key * self.positions[axis].len() + number(axis))
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
struct Order {
    entries: Vec<usize>,
    places: Vec<usize>,
}

fn sorted<K: Ord>(count: usize, key: impl Fn(usize) -> K) -> Order {
    let mut entries: Vec<usize> = (0..count).collect();
    entries.sort_by_cached_key(|&k| (key(k), k));
    let mut places = vec![0; count];
    entries.iter().enumerate().for_each(|(place, &k)| places[k] = place);
    Order { entries, places }
}
