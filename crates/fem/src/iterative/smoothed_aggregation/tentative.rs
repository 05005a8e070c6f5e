//! The tentative prolongator: near-null modes restricted to aggregates and made orthonormal, `B = T B_coarse`.

use super::aggregate::NONE;
use crate::iterative::csr::BlockCsr;
use crate::iterative::dense::Block;
use rayon::prelude::*;

/// Relative length of the independent part below which a mode depends on those before it: aggregates of few nodes cannot
/// distinguish all rotations. Rounding leaves about 1e-16 times the distance of an aggregate from the centre over its size,
/// which may be 1e4 in graded meshes.
const DEPENDENT: f64 = 1e-10;

/// Aggregates treated by one task.
const CHUNK: usize = 64;

/// See the module.
#[derive(Clone, Debug)]
pub struct TentativeProlongation<const B: usize, const K: usize> {
    /// T: one entry in the row of each node that has an aggregate.
    pub prolongation: BlockCsr<B, K>,
    /// The modes on the coarse nodes.
    pub modes: Vec<Block<K, K>>,
    /// True for coarse unknowns that exist; the others have empty columns in T.
    pub present: Vec<[bool; K]>,
}

impl<const B: usize, const K: usize> TentativeProlongation<B, K> {
    /// Orthonormalises the modes of each aggregate.
    #[must_use]
    pub fn new(aggregate: &[u32], count: usize, modes: &[Block<B, K>]) -> Self {
        let members = members(aggregate, count);
        let parts: Vec<(Vec<Block<B, K>>, Block<K, K>)> = members
            .par_iter()
            .with_min_len(CHUNK)
            .map(|nodes| {
                let mut local: Vec<Block<B, K>> = nodes.iter().map(|&n| modes[n as usize]).collect();
                let coarse = orthonormalise(&mut local);
                (local, coarse)
            })
            .collect();
        let mut values = vec![[[0.0; K]; B]; aggregate.len()];
        for (nodes, (local, _)) in members.iter().zip(&parts) {
            for (&node, block) in nodes.iter().zip(local) {
                values[node as usize] = *block;
            }
        }
        let mut prolongation =
            BlockCsr { width: count, starts: vec![0], columns: Vec::new(), values: Vec::new() };
        for (&aggregate, value) in aggregate.iter().zip(&values) {
            if aggregate != NONE {
                prolongation.columns.push(aggregate);
                prolongation.values.push(*value);
            }
            prolongation.starts.push(prolongation.columns.len());
        }
        let modes: Vec<Block<K, K>> = parts.into_iter().map(|p| p.1).collect();
        let present = modes.iter().map(|m| std::array::from_fn(|k| m[k][k] != 0.0)).collect();
        Self { prolongation, modes, present }
    }
}

fn members(aggregate: &[u32], count: usize) -> Vec<Vec<u32>> {
    let mut members = vec![Vec::new(); count];
    for (node, &aggregate) in aggregate.iter().enumerate() {
        if aggregate != NONE {
            members[aggregate as usize].push(node as u32);
        }
    }
    members
}

/// Orthonormalises by modified Gram-Schmidt, each column twice so that it is orthogonal to rounding. Returns R; dependent
/// columns become zero and have a zero on its diagonal.
fn orthonormalise<const B: usize, const K: usize>(columns: &mut [Block<B, K>]) -> Block<K, K> {
    let mut r = [[0.0; K]; K];
    let product = |columns: &[Block<B, K>], a: usize, b: usize| -> f64 {
        columns.iter().flatten().map(|row| row[a] * row[b]).sum()
    };
    for k in 0..K {
        let before = product(columns, k, k).sqrt();
        for _ in 0..2 {
            for j in 0..k {
                let share = product(columns, j, k);
                r[j][k] += share;
                columns.iter_mut().flatten().for_each(|row| row[k] -= share * row[j]);
            }
        }
        let after = product(columns, k, k).sqrt();
        let kept = after > DEPENDENT * before;
        r[k][k] = if kept { after } else { 0.0 };
        columns.iter_mut().flatten().for_each(|row| row[k] = if kept { row[k] / after } else { 0.0 });
    }
    r
}
