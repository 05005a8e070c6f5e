//! A binary tree over the points of faults, by position.

use std::ops::Range;

/// Largest number of points of a leaf. A dense block of this size is as small as its low-rank factors, and faster.
const LEAF: usize = 32;

/// Clusters except the last have a multiple of this many points, since products process as many at once.
const EVEN: usize = 8;

/// Points near each other.
#[derive(Clone, Debug)]
pub(super) struct Cluster {
    /// Its points, as indices into [`Tree::order`].
    pub range: Range<usize>,
    /// Its parts, as indices into [`Tree::clusters`].
    pub parts: Option<[usize; 2]>,
    /// Smallest box around its points \[m\].
    low: [f64; 3],
    high: [f64; 3],
}

impl Cluster {
    /// Diagonal of its box \[m\].
    fn size(&self) -> f64 {
        (0..3).map(|c| (self.high[c] - self.low[c]).powi(2)).sum::<f64>().sqrt()
    }

    /// True if the boxes lie at least as far apart as the smaller one is long, so that the effect of slip in one is
    /// smooth in the other.
    pub fn far_from(&self, other: &Self) -> bool {
        let gap = |c: usize| (self.low[c] - other.high[c]).max(other.low[c] - self.high[c]).max(0.0);
        let distance = (0..3).map(|c| gap(c).powi(2)).sum::<f64>().sqrt();
        distance > 0.0 && distance >= self.size().min(other.size())
    }
}

/// The tree.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    /// The points in the order of the leaves.
    pub order: Vec<usize>,
    /// Clusters, the root first.
    pub clusters: Vec<Cluster>,
}

impl Tree {
    /// Tree of points at these positions \[m\]. `faults` are the points of each fault. Faults are separated first,
    /// since the effect of slip may jump from one to the next.
    pub fn new(places: &[[f64; 3]], faults: &[Range<usize>]) -> Self {
        let mut tree = Self { order: (0..places.len()).collect(), clusters: Vec::new() };
        tree.grow(places, faults, 0..places.len());
        tree
    }

    /// Adds the cluster of `range`, which holds whole faults or a part of one, and its parts. Returns its index.
    fn grow(&mut self, places: &[[f64; 3]], faults: &[Range<usize>], range: Range<usize>) -> usize {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for &p in &self.order[range.clone()] {
            for c in 0..3 {
                low[c] = low[c].min(places[p][c]);
                high[c] = high[c].max(places[p][c]);
            }
        }
        let own = self.clusters.len();
        self.clusters.push(Cluster { range: range.clone(), parts: None, low, high });
        let parted = if let [_, _, ..] = faults {
            let (left, right) = faults.split_at(faults.len() / 2);
            Some((left[left.len() - 1].end, left, right))
        } else if range.len() > LEAF {
            let along = (0..3).fold(0, |b, c| if high[c] - low[c] > high[b] - low[b] { c } else { b });
            let by = |p: &usize, q: &usize| places[*p][along].total_cmp(&places[*q][along]).then(p.cmp(q));
            self.order[range.clone()].sort_by(by);
            Some((range.start + (range.len() / 2).next_multiple_of(EVEN), faults, faults))
        } else {
            None
        };
        if let Some((middle, left, right)) = parted {
            let first = self.grow(places, left, range.start..middle);
            let second = self.grow(places, right, middle..range.end);
            self.clusters[own].parts = Some([first, second]);
        }
        own
    }
}

#[cfg(test)]
mod tests {
    use super::{LEAF, Tree};

    #[test]
    fn every_point_stands_in_one_leaf_and_faults_are_not_mixed() {
        let places: Vec<[f64; 3]> = (0..300).map(|k| [f64::from(k % 100), f64::from(k / 100), 0.0]).collect();
        let faults = [0..100, 100..130, 130..300];
        let tree = Tree::new(&places, &faults);
        let mut sorted = tree.order.clone();
        sorted.sort_unstable();
        assert!(sorted.iter().copied().eq(0..300));
        let mut seen = 0;
        for leaf in tree.clusters.iter().filter(|c| c.parts.is_none()) {
            assert!(!leaf.range.is_empty() && leaf.range.len() <= LEAF);
            seen += leaf.range.len();
            let points = &tree.order[leaf.range.clone()];
            assert!(faults.iter().any(|f| points.iter().all(|p| f.contains(p))));
        }
        assert_eq!(seen, 300);
    }
}
