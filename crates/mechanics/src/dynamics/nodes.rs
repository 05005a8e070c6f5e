//! Special nodes: those of faults, absorbing sides, loads and prescribed motions. All other nodes are free.

use super::absorbing::Dashpot;
use nalgebra::SMatrix;
use std::ops::Range;

/// All special nodes: first those of faults, then the others, each by ascending nodes. Accelerations of the former are known
/// before any node moves, since the tractions follow from them; the others move with the free nodes around them.
#[derive(Clone, Debug, Default)]
pub(super) struct SpecialNodes {
    /// Nodes.
    pub all: Vec<SpecialNode>,
    /// Nodes of the mesh of those of faults.
    pub faulted: Vec<usize>,
}

impl SpecialNodes {
    /// Nodes of faults and others, of which those of faults are left out.
    pub fn new(faulted: Vec<usize>, others: Vec<usize>, special: impl Fn(usize) -> SpecialNode) -> Self {
        let ascending = |mut nodes: Vec<usize>| {
            nodes.sort_unstable();
            nodes.dedup();
            nodes
        };
        let (faulted, mut others) = (ascending(faulted), ascending(others));
        others.retain(|node| faulted.binary_search(node).is_err());
        let all = faulted.iter().copied().chain(others).map(special).collect();
        Self { all, faulted }
    }

    /// Place of a node, which must be special.
    pub fn find(&self, node: usize) -> usize {
        self.faulted.binary_search(&node).unwrap_or_else(|_| {
            let others = &self.all[self.faulted.len()..];
            self.faulted.len() + others.partition_point(|s| s.node < node)
        })
    }

    /// Places of the first nodes from `node` on: of faults, and others.
    pub fn from(&self, node: usize) -> [usize; 2] {
        let count = self.faulted.len();
        let before = self.faulted.partition_point(|n| *n < node);
        [before, count + self.all[count..].partition_point(|s| s.node < node)]
    }

    /// Places of the nodes before `end` from the `next` ones on, which move past them.
    pub fn until(&self, end: usize, next: &mut [usize; 2]) -> [Range<usize>; 2] {
        let ends = [self.faulted.len(), self.all.len()];
        std::array::from_fn(|list| {
            let start = next[list];
            let count = self.all[start..ends[list]].iter().take_while(|s| s.node < end).count();
            next[list] = start + count;
            start..next[list]
        })
    }
}

/// A node at which more than internal forces act.
#[derive(Clone, Debug)]
pub(super) struct SpecialNode {
    /// Node of the mesh.
    pub node: usize,
    /// Lumped mass \[kg, or kg/m\].
    pub mass: f64,
    /// Dashpot, if its side is absorbing.
    damping: Option<Columns>,
    /// Components with a prescribed motion.
    pub prescribed: [bool; 3],
    /// (M + Δt/2 C)⁻¹, without prescribed components \[1/kg\].
    inverse: Columns,
}

impl SpecialNode {
    /// A node with its mass; nothing is prescribed yet.
    pub fn new(node: usize, mass: f64, dashpot: Option<&Dashpot>) -> Self {
        let damping = dashpot.map(|d| columns(|i, j| d.damping[i][j]));
        Self { node, mass, damping, prescribed: [false; 3], inverse: Columns::default() }
    }

    /// Computes the inverse mass for steps of length `dt`.
    pub fn prepare(&mut self, components: usize, dt: f64) {
        let damping = self.damping.unwrap_or_default();
        let free = |c: usize| c < components && !self.prescribed[c];
        let matrix = SMatrix::<f64, 3, 3>::from_fn(|i, j| {
            let mass = if i == j { self.mass } else { 0.0 };
            if free(i) && free(j) { mass + 0.5 * dt * damping[j][i] } else { f64::from(u8::from(i == j)) }
        });
        // Symmetric and positive: masses are, and dashpots take energy.
        let inverse = matrix.try_inverse().unwrap_or_else(|| matrix.map(|_| f64::NAN));
        self.inverse = columns(|i, j| if free(i) && free(j) { inverse[(i, j)] } else { 0.0 });
    }

    /// Acceleration that a force causes \[m/s²\].
    pub fn accelerated(&self, force: &[f64; 3]) -> [f64; 3] {
        product(&self.inverse, force)
    }

    /// Force of the dashpot at a velocity \[N\].
    pub fn drag(&self, velocity: &[f64; 3]) -> [f64; 3] {
        let Some(damping) = &self.damping else { return [0.0; 3] };
        product(damping, velocity).map(|f| -f)
    }

    /// Inverse mass along a unit vector \[1/kg\].
    pub fn along(&self, e: &[f64; 3]) -> f64 {
        let image = self.accelerated(e);
        dot(e, &image)
    }
}

/// Columns of a matrix, each with a zero at its end: as many numbers as a vector of the processor has.
type Columns = [[f64; 4]; 3];

fn columns(entry: impl Fn(usize, usize) -> f64) -> Columns {
    std::array::from_fn(|j| std::array::from_fn(|i| if i < 3 { entry(i, j) } else { 0.0 }))
}

/// Product of a matrix and a vector.
#[inline(always)]
fn product(matrix: &Columns, vector: &[f64; 3]) -> [f64; 3] {
    let mut sums = [0.0; 4];
    for (column, x) in matrix.iter().zip(vector) {
        sums.iter_mut().zip(column).for_each(|(sum, entry)| *sum += entry * x);
    }
    [sums[0], sums[1], sums[2]]
}

/// Scalar product.
pub(super) fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
