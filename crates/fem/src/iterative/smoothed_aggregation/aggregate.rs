//! Strength of connection and greedy aggregation (Vanek, Mandel and Brezina 1996, section 5), in the order of the nodes.

use crate::iterative::csr::BlockCsr;
use crate::iterative::dense::norm2;

/// Marks a node that is in no aggregate: all its components are fixed.
pub const NONE: u32 = u32::MAX;

/// Nodes and their strong neighbours.
#[derive(Clone, Debug)]
pub struct Strength {
    starts: Vec<usize>,
    neighbours: Vec<u32>,
    weights: Vec<f64>,
}

impl Strength {
    /// Node j is a strong neighbour of i if `|A_ij|² > threshold² |A_ii| |A_jj|`, with Frobenius norms of the node blocks. If
    /// the components of a block are of one kind, the measure is invariant under rotation of the axes.
    #[must_use]
    pub fn new<const B: usize>(matrix: &BlockCsr<B, B>, threshold: f64) -> Self {
        let diagonal: Vec<f64> = matrix.diagonal().iter().map(norm2).collect();
        let mut result = Self { starts: vec![0], neighbours: Vec::new(), weights: Vec::new() };
        for row in 0..matrix.rows() {
            let (columns, values) = matrix.row(row);
            for (&column, value) in columns.iter().zip(values) {
                let scale = (diagonal[row] * diagonal[column as usize]).sqrt();
                let weight = norm2(value);
                if column as usize != row && weight > threshold * threshold * scale && weight > 0.0 {
                    result.neighbours.push(column);
                    result.weights.push(weight / scale);
                }
            }
            result.starts.push(result.neighbours.len());
        }
        result
    }

    fn neighbours(&self, node: usize) -> &[u32] {
        &self.neighbours[self.starts[node]..self.starts[node + 1]]
    }

    /// The aggregate of the strongest neighbour that has one (the first if several are equal).
    fn strongest(&self, node: usize, aggregate: &[u32]) -> u32 {
        let weights = &self.weights[self.starts[node]..self.starts[node + 1]];
        let mut best = (0.0, NONE);
        for (&neighbour, &weight) in self.neighbours(node).iter().zip(weights) {
            if aggregate[neighbour as usize] != NONE && weight > best.0 {
                best = (weight, aggregate[neighbour as usize]);
            }
        }
        best.1
    }
}

/// The aggregate of each node and the number of aggregates. Nodes that are not `active` are left out.
///
/// First, every node without neighbours in an aggregate founds one with all of them. Then each remaining node joins the
/// aggregate of its strongest neighbour. Nodes that still remain form separate aggregates.
#[must_use]
pub fn aggregate(strength: &Strength, active: &[bool]) -> (Vec<u32>, usize) {
    let n = active.len();
    let mut aggregate = vec![NONE; n];
    let mut count = 0_u32;
    for node in (0..n).filter(|&i| active[i]) {
        let around = strength.neighbours(node);
        let taken = |i: usize| aggregate[i] != NONE;
        if taken(node) || around.is_empty() || around.iter().any(|&k| taken(k as usize)) {
            continue;
        }
        aggregate[node] = count;
        around.iter().for_each(|&k| aggregate[k as usize] = count);
        count += 1;
    }
    let founded = aggregate.clone();
    for node in (0..n).filter(|&i| active[i] && founded[i] == NONE) {
        aggregate[node] = strength.strongest(node, &founded);
    }
    for node in (0..n).filter(|&i| active[i]) {
        if aggregate[node] != NONE {
            continue;
        }
        aggregate[node] = count;
        for &k in strength.neighbours(node) {
            if aggregate[k as usize] == NONE {
                aggregate[k as usize] = count;
            }
        }
        count += 1;
    }
    (aggregate, count as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(n: usize) -> BlockCsr<1, 1> {
        let mut matrix = BlockCsr { width: n, starts: vec![0], columns: Vec::new(), values: Vec::new() };
        for i in 0..n {
            for j in i.saturating_sub(1)..(i + 2).min(n) {
                matrix.columns.push(j as u32);
                matrix.values.push([[if i == j { 2.0 } else { -1.0 }]]);
            }
            matrix.starts.push(matrix.columns.len());
        }
        matrix
    }

    #[test]
    fn every_active_node_of_a_chain_has_an_aggregate_of_neighbours() {
        let strength = Strength::new(&chain(10), 0.1);
        let mut active = vec![true; 10];
        active[9] = false;
        let (aggregate, count) = aggregate(&strength, &active);
        assert_eq!(&aggregate[..8], &[0, 0, 1, 1, 1, 2, 2, 2]);
        assert_eq!(count, 3);
        assert_eq!(aggregate[8], 2);
    }

    #[test]
    fn nothing_is_strong_above_the_largest_ratio() {
        let (aggregate, count) = aggregate(&Strength::new(&chain(3), 0.6), &[true; 3]);
        assert_eq!((aggregate, count), (vec![0, 1, 2], 3));
    }
}
