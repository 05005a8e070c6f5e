//! Which facets may overlap in finite sliding, and the blocks that follow.

use super::finite::{CHUNK, Cell, Finite};
use asperity_fem::term::Pattern;
use rayon::prelude::*;

/// What the search found for a piece of the slave facets.
#[derive(Clone, Debug, Default)]
pub(super) struct Found {
    /// Slave and master facets.
    pairs: Vec<(usize, usize)>,
    /// Buffer: candidates of one facet.
    candidates: Vec<usize>,
    /// Pairs looked at.
    examined: u64,
}

impl<const D: usize, const M: usize> Finite<D, M> {
    /// Finds the cells anew; blocks change when they do.
    pub(super) fn pair(&mut self, examined: &mut u64) {
        self.sides.refit(&self.x);
        let facets = self.sides.facets.len();
        let mut found = std::mem::take(&mut self.found);
        found.resize_with(facets.div_ceil(CHUNK), Found::default);
        found.par_iter_mut().enumerate().for_each(|(k, found)| {
            found.pairs.clear();
            found.examined = 0;
            for f in k * CHUNK..((k + 1) * CHUNK).min(facets) {
                let Found { pairs, candidates, examined } = &mut *found;
                self.sides.candidates(f, &self.x, candidates, examined);
                pairs.extend(candidates.iter().map(|&m| (f, m)));
            }
        });
        *examined += found.iter().map(|f| f.examined).sum::<u64>();
        let pairs = || found.iter().flat_map(|f| f.pairs.iter().copied());
        if !pairs().eq(self.cells.iter().map(|c| (c.facet, c.master))) {
            self.rebuild(&pairs().collect::<Vec<_>>());
        }
        self.found = found;
    }

    fn rebuild(&mut self, pairs: &[(usize, usize)]) {
        for p in 0..self.points.len() {
            let mut slaves: Vec<usize> =
                self.sides.beside[p].iter().flat_map(|b| self.sides.facets[b.facet].nodes.clone()).collect();
            slaves.sort_unstable();
            slaves.dedup();
            let point = &mut self.points[p];
            let kept = point.nodes.iter().zip(&point.then).filter(|(_, w)| **w != 0.0 && point.anchored);
            let kept: Vec<(usize, f64)> = kept.map(|(&n, &w)| (n, w)).collect();
            let beside = &self.sides.beside[p];
            let from = beside.iter().flat_map(|b| {
                let first = pairs.partition_point(|c| c.0 < b.facet);
                pairs[first..].iter().take_while(|c| c.0 == b.facet).map(|c| c.1)
            });
            let mut masters: Vec<usize> =
                from.flat_map(|m| self.sides.master[m].nodes.iter().copied()).collect();
            masters.extend(kept.iter().map(|k| k.0));
            masters.sort_unstable();
            masters.dedup();
            masters.retain(|n| slaves.binary_search(n).is_err());
            point.slaves = slaves.len();
            point.nodes = slaves;
            point.nodes.extend(masters);
            point.weights = vec![0.0; point.nodes.len()];
            point.then = vec![0.0; point.nodes.len()];
            for (n, w) in kept {
                if let Some(k) = point.nodes.iter().position(|&m| m == n) {
                    point.then[k] = w;
                }
            }
        }
        self.tabulate(pairs);
    }

    /// Places of the cells' nodes in the blocks, and the pattern.
    fn tabulate(&mut self, pairs: &[(usize, usize)]) {
        self.cells.clear();
        self.places.clear();
        self.first.clear();
        for &(facet, master) in pairs {
            self.first.resize(facet + 1, self.cells.len());
            self.cells.push(Cell { facet, master, table: self.places.len() });
            let (own, other) = (&self.sides.facets[facet], &self.sides.master[master]);
            for &p in &own.weighting.points {
                let block = &self.points[p].nodes;
                for n in own.nodes.iter().chain(&other.nodes) {
                    // Every node of a cell is in the blocks of its points by construction.
                    self.places.extend(block.iter().position(|m| m == n));
                }
            }
        }
        self.first.resize(self.sides.facets.len() + 1, self.cells.len());
        self.integrals.resize(self.places.len(), 0.0);
        let mut at = 0;
        for &p in self.order.all() {
            self.points[p].at = at;
            at += (self.points[p].nodes.len() * D).pow(2);
        }
        let dofs = &self.dofs;
        let blocks: Vec<Vec<usize>> = self
            .order
            .all()
            .iter()
            .map(|&p| &self.points[p])
            .map(|p| p.nodes.iter().flat_map(|&n| dofs[n]..dofs[n] + D).collect())
            .collect();
        self.pattern = Pattern::of_blocks(self.pattern.version + 1, blocks.iter().map(Vec::as_slice));
    }
}
