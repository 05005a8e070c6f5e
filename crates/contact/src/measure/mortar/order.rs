//! Order of points in compact pieces, so that few cells are needed by two pieces.

use super::sides::Sides;

/// Number of cells, facets or points processed together on one thread; each takes a microsecond or more.
pub(super) const CHUNK: usize = 64;

/// Order of the slave points, divided into pieces of [`CHUNK`].
#[derive(Clone, Debug)]
pub(super) struct WorkOrder {
    points: Vec<usize>,
    piece: Vec<usize>,
    /// Facets adjacent to the points of each piece, ascending.
    facets: Vec<Vec<usize>>,
}

impl WorkOrder {
    /// Orders the points by repeated bisection across their largest extent, with the interface's nodes at positions `x`.
    pub(super) fn new<const D: usize>(sides: &Sides<D>, x: &[[f64; D]]) -> Self {
        let place: Vec<[f64; D]> =
            sides.around.iter().map(|b| x[sides.faces[b[0].face].nodes[b[0].local]]).collect();
        let mut points: Vec<usize> = (0..place.len()).collect();
        bisect(&mut points, &place);
        let mut piece = vec![0; points.len()];
        points.iter().enumerate().for_each(|(k, &p)| piece[p] = k / CHUNK);
        let beside = |points: &[usize]| {
            let mut facets: Vec<usize> =
                points.iter().flat_map(|&p| sides.beside[p].iter().map(|b| b.facet)).collect();
            facets.sort_unstable();
            facets.dedup();
            facets
        };
        let facets = points.chunks(CHUNK).map(beside).collect();
        Self { points, piece, facets }
    }

    /// All points in this order.
    pub(super) fn all(&self) -> &[usize] {
        &self.points
    }

    /// Number of pieces.
    pub(super) fn pieces(&self) -> usize {
        self.facets.len()
    }

    /// Points of a piece.
    pub(super) fn points(&self, piece: usize) -> &[usize] {
        &self.points[piece * CHUNK..((piece + 1) * CHUNK).min(self.points.len())]
    }

    /// Facets adjacent to the points of a piece.
    pub(super) fn facets(&self, piece: usize) -> &[usize] {
        &self.facets[piece]
    }

    /// Piece of a point.
    #[inline]
    pub(super) fn piece(&self, point: usize) -> usize {
        self.piece[point]
    }
}

/// Sorts points so that every piece is compact. Ties are broken by number, so that the order is the same on all machines.
fn bisect<const D: usize>(points: &mut [usize], x: &[[f64; D]]) {
    if points.len() <= CHUNK {
        points.sort_unstable();
        return;
    }
    let extent = |axis: usize| {
        let (low, high) = points
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &p| (l.min(x[p][axis]), h.max(x[p][axis])));
        high - low
    };
    let axis = (1..D).fold(0, |best, axis| if extent(axis) > extent(best) { axis } else { best });
    let middle = (points.len() / 2).next_multiple_of(CHUNK);
    points.select_nth_unstable_by(middle, |&a, &b| x[a][axis].total_cmp(&x[b][axis]).then(a.cmp(&b)));
    let (left, right) = points.split_at_mut(middle);
    bisect(left, x);
    bisect(right, x);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_full_and_lie_together() {
        // A grid of 40 x 40 with shuffled numbers.
        let mut x: Vec<[f64; 2]> = (0..1600).map(|k| [f64::from(k % 40), f64::from(k / 40)]).collect();
        (0..1600).for_each(|k| x.swap(k, (k * 7919 + 13) % 1600));
        let mut points: Vec<usize> = (0..1600).collect();
        bisect(&mut points, &x);
        let mut all = points.clone();
        all.sort_unstable();
        assert!(all.iter().copied().eq(0..1600));
        for piece in points.chunks(CHUNK) {
            let span = |axis: usize| {
                let v: Vec<f64> = piece.iter().map(|&p| x[p][axis]).collect();
                v.iter().copied().fold(f64::MIN, f64::max) - v.iter().copied().fold(f64::MAX, f64::min)
            };
            assert!(span(0) * span(1) < 3.0 * CHUNK as f64, "{} x {}", span(0), span(1));
        }
    }
}
