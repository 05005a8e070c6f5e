//! Search for facets that may overlap in finite sliding, and the blocks that result.

use super::blocks::slopes;
use super::buffers::{Buffers, Pool};
use super::order::CHUNK;
use super::state::{Cell, MortarMeasure, SearchResult};
use asperity_fem::term::Pattern;
use rayon::prelude::*;

impl<const D: usize> MortarMeasure<D> {
    /// Recomputes the cells, and the blocks if the cells change.
    pub(super) fn pair(&mut self, examined: &mut u64) {
        self.sides.refit(&self.x);
        let facets = self.sides.facets.len();
        let mut found = std::mem::take(&mut self.found);
        found.resize_with(facets.div_ceil(CHUNK), SearchResult::default);
        found.par_iter_mut().enumerate().for_each(|(k, found)| {
            found.pairs.clear();
            found.examined = 0;
            found.free = f64::INFINITY;
            for f in k * CHUNK..((k + 1) * CHUNK).min(facets) {
                let SearchResult { pairs, candidates, examined, free } = &mut *found;
                *free = free.min(self.sides.candidates(f, &self.x, candidates, examined));
                pairs.extend(candidates.iter().map(|&m| [f, m]));
            }
        });
        *examined += found.iter().map(|f| f.examined).sum::<u64>();
        self.bound.prove(&self.x, found.iter().fold(f64::INFINITY, |least, f| least.min(f.free)));
        let pairs = || found.iter().flat_map(|f| f.pairs.iter().copied());
        // Sides that do not face each other have no pairs at first, but blocks all the same.
        let tabulated = !self.first.is_empty();
        if !(tabulated && pairs().eq(self.cells.iter().map(|c| [c.facet, c.master]))) {
            self.rebuild(&pairs().collect::<Vec<_>>());
        }
        self.found = found;
    }

    fn rebuild(&mut self, pairs: &[[usize; 2]]) {
        for p in 0..self.points.len() {
            let mut slaves: Vec<usize> =
                self.sides.around[p].iter().flat_map(|b| self.sides.faces[b.face].nodes.clone()).collect();
            slaves.sort_unstable();
            slaves.dedup();
            let point = &mut self.points[p];
            let kept = point.nodes.iter().zip(&point.then).filter(|(_, w)| **w != 0.0 && point.anchored);
            let kept: Vec<(usize, f64)> = kept.map(|(&n, &w)| (n, w)).collect();
            let beside = &self.sides.beside[p];
            let from = beside.iter().flat_map(|b| {
                let first = pairs.partition_point(|c| c[0] < b.facet);
                pairs[first..].iter().take_while(|c| c[0] == b.facet).map(|c| c[1])
            });
            let mut masters: Vec<usize> =
                from.flat_map(|m| self.sides.master[m].face.nodes.iter().copied()).collect();
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

    /// Computes the positions of the cells' nodes in the blocks, and the pattern.
    pub(super) fn tabulate(&mut self, pairs: &[[usize; 2]]) {
        self.cells.clear();
        self.places.clear();
        self.first.clear();
        for &[facet, master] in pairs {
            self.first.resize(facet + 1, self.cells.len());
            self.cells.push(Cell { facet, master, table: self.places.len() });
            let (own, other) = (&self.sides.facets[facet], &self.sides.master[master]);
            for &p in &own.weighting.points {
                let block = &self.points[p].nodes;
                for n in own.facet.face.nodes.iter().chain(&other.face.nodes) {
                    // By construction, every node of a cell is in the blocks of its points.
                    self.places.extend(block.iter().position(|m| m == n));
                }
            }
        }
        self.first.resize(self.sides.facets.len() + 1, self.cells.len());
        self.integrals.resize(self.places.len(), 0.0);
        let (mut at, mut largest, mut widest) = (0, 0, 0);
        for piece in 0..self.order.pieces() {
            let mut of_piece = 0;
            for &p in self.order.points(piece) {
                let point = &mut self.points[p];
                (point.at, point.slopes) = (at, of_piece);
                at += (point.nodes.len() * D).pow(2);
                of_piece += slopes::<D>(point);
                widest = widest.max(point.nodes.len() * D);
            }
            largest = largest.max(of_piece);
        }
        let buffers = rayon::current_num_threads().min(self.order.pieces());
        self.buffers = Pool::new((0..buffers).map(|_| Buffers::new(largest, widest)).collect());
        let dofs = &self.dofs;
        let blocks: Vec<Vec<usize>> = self
            .order
            .all()
            .iter()
            .map(|&p| &self.points[p])
            .map(|p| p.nodes.iter().flat_map(|&n| dofs[n]..dofs[n] + D).collect())
            .collect();
        self.pattern = Pattern::from_blocks(blocks.iter().map(Vec::as_slice));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SegmentKind;
    use crate::measure::mortar::cell::{Sums, integrate};
    use crate::measure::mortar::facet::Facet;
    use crate::measure::mortar::sides::{Sides, Surfaces};
    use crate::shape::MOST_NODES;
    use crate::spec::{Segment, SlavePoint};
    use proptest::prelude::*;
    use proptest::test_runner::TestRng;

    fn noise(rng: &mut TestRng) -> f64 {
        rng.random_range(-1.0..1.0)
    }

    /// Two wavy layers of `n` and `n + 1` quadrilaterals per side (lines in the plane). The slave is above, with its facets
    /// facing down.
    fn layers<const D: usize>(n: usize, rng: &mut TestRng) -> (Vec<[f64; D]>, [Vec<Segment>; 2]) {
        let mut x = Vec::new();
        let mut sides = [Vec::new(), Vec::new()];
        for (side, cells) in [n, n + 1].into_iter().enumerate() {
            let (first, h, above) = (x.len(), 1.0 / cells as f64, side == 0);
            for j in 0..=if D == 2 { 0 } else { cells } {
                for i in 0..=cells {
                    let mut p = [0.0; D];
                    p[0] = h * (i as f64 + 0.2 * noise(rng));
                    p[1] = h * (j as f64 + 0.2 * noise(rng));
                    p[D - 1] = 0.3 * h * noise(rng) + if above { 0.4 * h } else { 0.0 };
                    x.push(p);
                }
            }
            let at = |i: usize, j: usize| first + i + j * (cells + 1);
            for j in 0..if D == 2 { 1 } else { cells } {
                for i in 0..cells {
                    let mut nodes = if D == 2 {
                        vec![at(i + 1, 0), at(i, 0)]
                    } else {
                        vec![at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
                    };
                    if above {
                        nodes.reverse();
                    }
                    let kind = if D == 2 { SegmentKind::Seg2 } else { SegmentKind::Quad4 };
                    sides[side].push(Segment { kind, nodes });
                }
            }
        }
        (x, sides)
    }

    fn what_was_proved_holds<const D: usize>(n: usize, rng: &mut TestRng) {
        let (reference, [slave, master]) = layers::<D>(n, rng);
        let mut nodes: Vec<usize> = slave.iter().flat_map(|s| s.nodes.clone()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let points: Vec<SlavePoint> = nodes.iter().map(|&node| SlavePoint { node, area: 1.0 }).collect();
        let surfaces =
            Surfaces { slave: &points, faces: &slave, master: &master, axisymmetric: false, mirrors: &[] };
        let sides = Sides::new(surfaces, &mut reference.clone());
        let dofs = (0..reference.len()).map(|k| D * k).collect();
        let (mut measure, _) = MortarMeasure::<D>::new(sides, dofs, reference.clone());
        let radius = measure.found.iter().fold(f64::INFINITY, |least, f| least.min(f.free));
        assert!(radius > 0.0 && radius.is_finite(), "{radius}");
        let known: Vec<[usize; 2]> = measure.cells.iter().map(|c| [c.facet, c.master]).collect();
        assert!(!known.is_empty());
        // Move every node to the surface of its cube.
        let by = 0.999 * radius / (D as f64).sqrt();
        measure.x =
            reference.iter().map(|p| p.map(|v| v + if noise(rng) > 0.0 { by } else { -by })).collect();
        assert!(measure.bound.holds(&measure.x));
        measure.pair(&mut 0);
        for c in &measure.cells {
            let at = |facet: &Facet| facet.movers().map(|k| measure.x[k]).collect::<Vec<_>>();
            let [slave, master] = measure.facets(c);
            let own = at(slave);
            let mut sums = Sums::<f64, MOST_NODES>::zero();
            let (frozen, rule) = (measure.sides.frozen(c.facet), measure.sides.rule(c.facet, c.master));
            let overlap = integrate(frozen, &own, master, &at(master), rule, &mut sums);
            assert!(!overlap || known.contains(&[c.facet, c.master]), "{:?}", [c.facet, c.master]);
        }
    }

    proptest! {
        #[test]
        fn no_facets_begin_to_overlap_within_the_bound_of_a_search(n in 1usize..6, seed in any::<[u8; 32]>()) {
            let mut rng = TestRng::from_seed(prop::test_runner::RngAlgorithm::ChaCha, &seed);
            what_was_proved_holds::<2>(n, &mut rng);
            what_was_proved_holds::<3>(n, &mut rng);
        }
    }
}
