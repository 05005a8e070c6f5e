//! Parts of a mesh that touch without being tied.
//!
//! Coincident nodes are not an error in themselves: a mesh split along an interface has them by design. The faces on both sides
//! then have names, for otherwise no interface could be placed between them. A part hangs free if one of its faces coincides with
//! one of another part, and one of the two has no name. Then no interface can be declared, and neither part holds the other.

use super::super::{Mesh, Side, face_kind, face_nodes};
use std::collections::{BTreeMap, BTreeSet};

/// Distance of coincident nodes over the shortest edge there \[-\]: far above the rounding of written coordinates, far below
/// any intended opening.
const COINCIDENT: f64 = 1e-6;

/// Two parts that touch, the one that hangs free first, and the number of coincident pairs of nodes.
pub(crate) struct Touch {
    /// The part that hangs free.
    pub free: Extent,
    /// The part it touches.
    pub other: Extent,
    /// Pairs of coincident nodes.
    pub pairs: usize,
}

/// A part: cells joined by common nodes.
#[derive(Clone, Debug, Default)]
pub(crate) struct Extent {
    /// First cell: block and cell.
    pub first: (usize, usize),
    /// Number of cells.
    pub cells: usize,
    /// Blocks with cells in it, ascending.
    pub blocks: Vec<usize>,
}

/// Union-find over nodes, the lowest node of a set being its root.
struct Roots(Vec<usize>);

impl Roots {
    fn new(nodes: usize) -> Self {
        Self((0..nodes).collect())
    }

    fn find(&mut self, mut a: usize) -> usize {
        while self.0[a] != a {
            self.0[a] = self.0[self.0[a]];
            a = self.0[a];
        }
        a
    }

    fn join(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b)] = a.min(b);
    }
}

/// The seam between two parts, the lower one first (numbered by their roots).
#[derive(Default)]
struct Seam {
    /// Coincident nodes.
    pairs: usize,
    /// Faces of each part that coincide with one of the other and have no name.
    unnamed: [usize; 2],
}

/// The seams of a mesh by the roots of their parts.
type Seams = BTreeMap<[usize; 2], Seam>;

/// The first part that hangs free against another, given the boundary of the mesh. Parts that touch at corners or edges alone are not
/// tied there.
pub(crate) fn free_part<const D: usize>(mesh: &Mesh<D>, parts: &Parts, boundary: &[Side]) -> Option<Touch> {
    let Parts { root, extents } = parts;
    if extents.len() < 2 {
        return None;
    }
    let (mut seams, mut places) = (Seams::new(), Roots::new(mesh.nodes.len()));
    for_each_coincident(&mesh.nodes, &shortest_edges(mesh), |a, b| {
        if root[a] != root[b] {
            seams.entry(pair(root[a], root[b])).or_default().pairs += 1;
            places.join(a, b);
        }
    });
    count_unnamed((mesh, boundary), root, &mut places, &mut seams);
    let ([lower, upper], seam) = seams.into_iter().find(|(_, seam)| seam.unnamed != [0, 0])?;
    let (lower, upper) = (extents.get(&lower)?.clone(), extents.get(&upper)?.clone());
    let lower_is_free = (seam.unnamed[0], upper.cells) > (seam.unnamed[1], lower.cells);
    let (free, other) = if lower_is_free { (lower, upper) } else { (upper, lower) };
    Some(Touch { free, other, pairs: seam.pairs })
}

/// Two roots, the lower one first.
fn pair(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// Counts the faces on seams that have no name: those at one place with a face of another part, where `places` has one root for nodes
/// that coincide.
fn count_unnamed<const D: usize>(
    (mesh, boundary): (&Mesh<D>, &[Side]),
    root: &[usize],
    places: &mut Roots,
    seams: &mut Seams,
) {
    let named: BTreeSet<&Side> = mesh.side_sets.values().flatten().collect();
    let mut placed: Vec<(Vec<usize>, usize, bool)> = Vec::new();
    for side in boundary {
        let mut corners = face_nodes(mesh, side);
        corners.truncate(face_kind(mesh, side).corners());
        let own = root[corners[0]];
        corners.iter_mut().for_each(|n| *n = places.find(*n));
        corners.sort_unstable();
        placed.push((corners, own, named.contains(side)));
    }
    placed.sort_unstable();
    for same in placed.chunk_by(|a, b| a.0 == b.0) {
        for (k, (_, own, named)) in same.iter().enumerate() {
            let before = &same[k.saturating_sub(MOST_PARTNERS)..k];
            for (_, other, also_named) in before.iter().filter(|face| face.1 != *own) {
                let seam = seams.entry(pair(*own, *other)).or_default();
                seam.unnamed[usize::from(own > other)] += usize::from(!named);
                seam.unnamed[usize::from(other > own)] += usize::from(!also_named);
            }
        }
    }
}

/// Parts of a mesh.
pub(crate) struct Parts {
    /// The root of every node.
    pub root: Vec<usize>,
    /// The parts by their roots.
    extents: BTreeMap<usize, Extent>,
}

impl Parts {
    /// Finds the parts.
    pub fn new<const D: usize>(mesh: &Mesh<D>) -> Self {
        let mut roots = Roots::new(mesh.nodes.len());
        for block in &mesh.blocks {
            for cell in 0..block.len() {
                let nodes = block.cell(cell);
                nodes[1..].iter().for_each(|&n| roots.join(nodes[0], n));
            }
        }
        let mut extents: BTreeMap<usize, Extent> = BTreeMap::new();
        for (b, block) in mesh.blocks.iter().enumerate() {
            for cell in 0..block.len() {
                let part = extents.entry(roots.find(block.cell(cell)[0])).or_default();
                if part.cells == 0 {
                    part.first = (b, cell);
                }
                part.cells += 1;
                if part.blocks.last() != Some(&b) {
                    part.blocks.push(b);
                }
            }
        }
        Self { root: (0..mesh.nodes.len()).map(|n| roots.find(n)).collect(), extents }
    }
}

/// Shortest distance of each node to its neighbours in faces of cells \[m\].
fn shortest_edges<const D: usize>(mesh: &Mesh<D>) -> Vec<f64> {
    let mut shortest = vec![f64::INFINITY; mesh.nodes.len()];
    for block in &mesh.blocks {
        for cell in 0..block.len() {
            let nodes = block.cell(cell);
            for face in block.kind.faces().iter().map(|face| face.nodes) {
                for k in 0..face.len() {
                    let (a, b) = (nodes[face[k]], nodes[face[(k + 1) % face.len()]]);
                    let d = distance(&mesh.nodes[a], &mesh.nodes[b]);
                    shortest[a] = shortest[a].min(d);
                    shortest[b] = shortest[b].min(d);
                }
            }
        }
    }
    shortest
}

fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// Largest number of nodes or faces at one position with which one is paired: some dozens of nodes meet in a mesh of cells that
/// are all separate parts. If there are more, cells lie on top of each other; further pairs are not needed to find that some
/// hang free.
const MOST_PARTNERS: usize = 64;

/// Visits every pair of coincident nodes once. Nodes are sorted into boxes slightly wider than the largest tolerance, so that
/// coincident ones lie in the same box or in neighbours.
fn for_each_coincident<const D: usize>(x: &[[f64; D]], h: &[f64], mut visit: impl FnMut(usize, usize)) {
    let greatest = h.iter().copied().filter(|h| h.is_finite()).fold(0.0, f64::max);
    let width = 2.0 * COINCIDENT * greatest;
    if !width.is_normal() {
        return;
    }
    let mut boxes: Vec<([i64; D], usize)> =
        x.iter().enumerate().map(|(n, x)| (x.map(|c| (c / width).floor() as i64), n)).collect();
    boxes.sort_unstable();
    let columns = columns_ahead::<D>();
    for (at, &(key, a)) in boxes.iter().enumerate() {
        let near = |b: usize| distance(&x[a], &x[b]) <= COINCIDENT * h[a].min(h[b]);
        for step in &columns {
            let mut low = key;
            for (l, &s) in low.iter_mut().zip(step) {
                *l = l.saturating_add(s);
            }
            let mut high = low;
            low[D - 1] = low[D - 1].saturating_sub(1);
            high[D - 1] = high[D - 1].saturating_add(1);
            // In its own column, a node is paired with those after it in the list.
            let from = boxes.partition_point(|(k, _)| *k < low).max(at + 1);
            let column = boxes[from..].iter().take_while(|(k, _)| *k <= high).map(|&(_, b)| b);
            column.filter(|&b| near(b)).take(MOST_PARTNERS).for_each(|b| visit(a, b));
        }
    }
}

/// Steps to the columns of boxes that do not come before a box's own: -1, 0, 1 along all axes but the last.
fn columns_ahead<const D: usize>() -> Vec<[i64; D]> {
    let mut steps = vec![[0; D]];
    for axis in 0..D - 1 {
        let along = |k| {
            move |mut step: [i64; D]| {
                step[axis] = k;
                step
            }
        };
        steps = [-1, 0, 1].into_iter().flat_map(|k| steps.iter().copied().map(along(k))).collect();
    }
    steps.retain(|step| *step >= [0; D]);
    steps
}
