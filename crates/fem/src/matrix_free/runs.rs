//! Runs of nodes whose rows of K are equal: those of grids.
//!
//! Two nodes have equal rows if the same kinds of cells meet there in the same order, and the numbers of the nodes of these cells differ
//! from their own by the same amounts. In grids numbered line by line, neighbours are equal in cells of first order, and every second
//! node in cells of second order.

use super::shapes::{classes, few};
use crate::block::LinearBlock;
use crate::kinematics::Idealisation;
use crate::mesh::Mesh;
use std::collections::BTreeMap;

/// Nodes that share a row for which it is kept. Where fewer do, as in meshes whose numbers follow no grid, rows would take more memory
/// than the cells, and more time to read.
const SHARED: usize = 16;

/// Nodes `first`, `first + period`, .. whose rows are equal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    /// First node.
    pub first: usize,
    /// Number of nodes.
    pub length: usize,
    /// Row.
    pub row: usize,
}

/// Forces on a node per displacement of a neighbour.
#[derive(Clone, Debug)]
pub(super) struct Neighbour {
    /// Number of the neighbour less that of the node.
    pub offset: i64,
    /// Force on component i per displacement of component j \[N/m\].
    pub stiffness: [[f64; 3]; 3],
}

/// Runs, and the rows that occur, each by ascending neighbours.
#[derive(Debug, Default)]
pub(super) struct Runs {
    /// Distance of the nodes of a run: the order of the cells.
    pub period: usize,
    /// Runs, by residue of their nodes and then by their first node.
    pub runs: Vec<Run>,
    /// Rows; those that too few nodes share are empty.
    pub rows: Vec<Vec<Neighbour>>,
}

impl Runs {
    /// True for nodes in a run.
    pub fn nodes(&self, nodes: usize) -> Vec<bool> {
        let mut result = vec![false; nodes];
        for run in &self.runs {
            (0..run.length).for_each(|k| result[run.first + k * self.period] = true);
        }
        result
    }
}

/// Shape of each cell of a block, and the first cell of each shape.
pub(super) type Classes = (Vec<u32>, Vec<usize>);

/// Cell at a node: block, cell, and number of the node in the cell.
type Meeting = (u32, u32, u32);

/// A row as comparable numbers: for each cell its block, shape and own node, and for each of its nodes the offset.
type Key = Vec<i64>;

/// Cells that meet at the nodes.
struct Meetings<'a, const D: usize> {
    mesh: &'a Mesh<D>,
    classes: &'a [Option<Classes>],
    starts: Vec<usize>,
    all: Vec<Meeting>,
}

/// Finds the runs of a mesh. `classes` holds those of the linear blocks.
pub(super) fn find<const D: usize>(
    mesh: &Mesh<D>,
    components: usize,
    blocks: &[Option<&LinearBlock<D>>],
    classes: &[Option<Classes>],
) -> Runs {
    let linear = || blocks.iter().flatten();
    if linear().any(|b| b.idealisation() == Idealisation::Axisymmetric) {
        return Runs { period: 1, ..Runs::default() };
    }
    let period = linear().map(|b| b.kind().order()).max().unwrap_or(1);
    let meetings = Meetings::new(mesh, classes);
    // Where hardly two cells have one shape, only long runs can share a row.
    let few = |(shape, first): &Classes| few(first.len(), shape.len());
    let shortest = if classes.iter().flatten().all(few) { 1 } else { SHARED };
    let mut known: BTreeMap<Key, usize> = BTreeMap::new();
    // First node of each row, and number of nodes that have it.
    let mut shared: Vec<(usize, usize)> = Vec::new();
    let mut runs = Vec::new();
    for residue in 0..period {
        let mut first = residue;
        while first < mesh.nodes.len() {
            let length = meetings.equal_from(first, period);
            if length >= shortest && !meetings.at_node(first).is_empty() {
                let row = *known.entry(meetings.key(first)).or_insert(shared.len());
                if row == shared.len() {
                    shared.push((first, 0));
                }
                shared[row].1 += length;
                runs.push(Run { first, length, row });
            }
            first += length * period;
        }
    }
    runs.retain(|run| shared[run.row].1 >= SHARED);
    let row = |&(first, nodes): &(usize, usize)| {
        if nodes < SHARED { Vec::new() } else { meetings.row(first, components, blocks) }
    };
    Runs { period, runs, rows: shared.iter().map(row).collect() }
}

/// Shapes of the cells of the linear blocks.
pub(super) fn classes_of<const D: usize>(
    mesh: &Mesh<D>,
    blocks: &[Option<&LinearBlock<D>>],
) -> Vec<Option<Classes>> {
    let of =
        |(k, block): (usize, &Option<&LinearBlock<D>>)| block.map(|b| classes(mesh, k, b.idealisation()));
    blocks.iter().enumerate().map(of).collect()
}

impl<'a, const D: usize> Meetings<'a, D> {
    fn new(mesh: &'a Mesh<D>, classes: &'a [Option<Classes>]) -> Self {
        let linear = || classes.iter().enumerate().filter(|(_, c)| c.is_some()).map(|(k, _)| k);
        let mut starts = vec![0; mesh.nodes.len() + 1];
        let nodes = || linear().flat_map(|k| mesh.blocks[k].connectivity.iter());
        nodes().for_each(|&node| starts[node + 1] += 1);
        for node in 0..mesh.nodes.len() {
            starts[node + 1] += starts[node];
        }
        let mut next = starts.clone();
        let mut all = vec![(0, 0, 0); starts[mesh.nodes.len()]];
        for k in linear() {
            for cell in 0..mesh.blocks[k].len() {
                for (own, &node) in mesh.blocks[k].cell(cell).iter().enumerate() {
                    all[next[node]] = (k as u32, cell as u32, own as u32);
                    next[node] += 1;
                }
            }
        }
        Self { mesh, classes, starts, all }
    }

    /// Cells at a node, ascending.
    fn at_node(&self, node: usize) -> &[Meeting] {
        &self.all[self.starts[node]..self.starts[node + 1]]
    }

    /// Shape of a cell.
    fn shape(&self, (block, cell, _): Meeting) -> u32 {
        self.classes[block as usize].as_ref().map_or(0, |(shape, _)| shape[cell as usize])
    }

    /// Nodes of a cell.
    fn nodes(&self, (block, cell, _): Meeting) -> &[usize] {
        self.mesh.blocks[block as usize].cell(cell as usize)
    }

    /// Number of nodes from `first` on, `period` apart, with the row of the first.
    fn equal_from(&self, first: usize, period: usize) -> usize {
        let others = (first + period..self.mesh.nodes.len()).step_by(period);
        1 + others.take_while(|&node| self.equal(node - period, node)).count()
    }

    /// True if the rows of both nodes are equal.
    fn equal(&self, a: usize, b: usize) -> bool {
        let (of_a, of_b) = (self.at_node(a), self.at_node(b));
        let apart = b - a;
        let alike = |(m, n): (&Meeting, &Meeting)| {
            m.0 == n.0
                && m.2 == n.2
                && self.shape(*m) == self.shape(*n)
                && self.nodes(*m).iter().zip(self.nodes(*n)).all(|(m, n)| m + apart == *n)
        };
        of_a.len() == of_b.len() && of_a.iter().zip(of_b).all(alike)
    }

    fn key(&self, node: usize) -> Key {
        let of = |m: &Meeting| {
            let kind = [m.0, self.shape(*m), m.2].map(i64::from);
            kind.into_iter().chain(self.nodes(*m).iter().map(move |&n| n as i64 - node as i64))
        };
        self.at_node(node).iter().flat_map(of).collect()
    }

    /// Sums the rows of the cells at a node.
    fn row(&self, node: usize, components: usize, blocks: &[Option<&LinearBlock<D>>]) -> Vec<Neighbour> {
        let mut sums: BTreeMap<i64, [[f64; 3]; 3]> = BTreeMap::new();
        for &(k, cell, own) in self.at_node(node) {
            let Some(block) = blocks[k as usize] else { continue };
            let matrix = block.stiffness_of(&[cell as usize]);
            let nodes = self.nodes((k, cell, own));
            let size = nodes.len() * components;
            for (b, &other) in nodes.iter().enumerate() {
                let sum = sums.entry(other as i64 - node as i64).or_default();
                for i in 0..components {
                    let row = &matrix[(own as usize * components + i) * size..][b * components..];
                    sum[i].iter_mut().zip(&row[..components]).for_each(|(sum, k)| *sum += k);
                }
            }
        }
        sums.into_iter().map(|(offset, stiffness)| Neighbour { offset, stiffness }).collect()
    }
}
