//! The map from the grid's (η, ξ) to the body, η the height where a row crosses the spine, ξ the horizontal distance of
//! a column from the spine:
//!
//! ```text
//! T = ℓ(η) tanh(ξ / ℓ(η)),
//! y = η + a(η) T,
//! x = X0 + ξ + w(ξ) (X̃(η, κ|ξ|) + (u(η) - 1) T - X0).
//! ```
//!
//! Rows leave the spine in the direction (u, a) ([`Spine::across`]) and turn horizontal over the length ℓ, which vanishes at
//! the bottom and the top of the box. Columns are copies of the spine: X̃ is the spine with its bends rounded over κ|ξ|, and w,
//! from 1 to 0, straightens it towards the sides of the box.
//!
//! With w = 1 and without rounding the determinant ∂(x, y)/∂(ξ, η) is
//!
//! ```text
//! (1 - T') + T' (u - X' a)  +  a' T (1 + (u - 1) T') - u' T a T' + a ∂T/∂η,      T' = 1 / cosh²(ξ/ℓ).
//! ```
//!
//! The first two terms lie between 1 and u - X' a, which is 1 on segments and positive at a vertex, whose row halves the angle.
//! The others are below |a'| ℓ + |u'| ℓ |a| + |a| |ℓ'| (as |tanh u - u/cosh² u| < 1), which is kept small by the choice of ℓ.
//! The rest of ∂x/∂ξ is at least 1 - |w'| (|X - X0| + ℓ) - κ V/4, where V is the total variation of dX/dy. (A jump K of the
//! slope at the distance t from the middle of the window changes its mean by K/4 (1 - t²/r²) per unit of r.) w, ℓ and κ keep it
//! positive in every box that contains the spine. Cells, which are polygons, are checked one by one.

use super::spine::Spine;

/// Bound on the change of (u, a) over a height of ℓ, and, on segments, on |a| |ℓ'| by |a| <= 1/2 and |ℓ'| <= 1/2.
const SHARE: f64 = 0.25;
/// Largest |ℓ'|.
const STEEPEST: f64 = 0.5;
/// Largest κ.
const ROUNDING: f64 = 0.5;

/// The map of one grid.
#[derive(Debug)]
pub(super) struct Map<'a> {
    spine: &'a Spine,
    /// X0: middle of the spine \[m\].
    middle: f64,
    /// Largest |X - X0| \[m\].
    reach: f64,
    /// X0 to the left and right side of the box \[m\].
    widths: [f64; 2],
    /// Curvature of w on both sides: 0 a straight line, 1 a smooth step.
    smooth: [f64; 2],
    /// κ on both sides.
    kappa: [f64; 2],
}

impl<'a> Map<'a> {
    /// `sides`: x of the left and right side of the box; the range of the spine lies strictly within.
    pub(super) fn new(spine: &'a Spine, sides: [f64; 2]) -> Self {
        let [lo, hi] = spine.range();
        let middle = 0.5 * (lo + hi);
        let reach = 0.5 * (hi - lo);
        let widths = [middle - sides[0], sides[1] - middle];
        let smooth = widths.map(|w| if reach > 0.0 { (w / reach - 1.0).clamp(0.0, 1.0) } else { 1.0 });
        // Half of the margin left by |w'| |X - X0| is used for rounding the bends.
        let kappa = std::array::from_fn(|side| {
            let left = 1.0 - (1.0 + 0.5 * smooth[side]) * reach / widths[side];
            let variation = spine.variation();
            if variation > 0.0 { ROUNDING.min(2.0 * left / variation) } else { ROUNDING }
        });
        Self { spine, middle, reach, widths, smooth, kappa }
    }

    /// X0 to the left and right side of the box \[m\].
    pub(super) fn widths(&self) -> [f64; 2] {
        self.widths
    }

    /// Direction (u, a) and turning length ℓ of the rows at the ascending heights `rows`; the first and last rows are straight.
    pub(super) fn turning(&self, rows: &[f64]) -> Vec<([f64; 2], f64)> {
        let n = rows.len();
        let (bottom, top) = (rows[0], rows[n - 1]);
        let across: Vec<[f64; 2]> = rows.iter().map(|&y| self.spine.across(y)).collect();
        let most = SHARE * (self.widths[0].min(self.widths[1]) - self.reach);
        let mut lengths: Vec<f64> =
            rows.iter().map(|y| most.min(STEEPEST * (top - y).min(y - bottom))).collect();
        for k in 0..n - 1 {
            let [a, b] = [across[k], across[k + 1]];
            let bend = (b[0] - a[0]).hypot(b[1] - a[1]) / (rows[k + 1] - rows[k]);
            if bend > 0.0 {
                lengths[k] = lengths[k].min(SHARE / bend);
                lengths[k + 1] = lengths[k + 1].min(SHARE / bend);
            }
        }
        for k in 1..n {
            lengths[k] = lengths[k].min(lengths[k - 1] + STEEPEST * (rows[k] - rows[k - 1]));
        }
        for k in (0..n - 1).rev() {
            lengths[k] = lengths[k].min(lengths[k + 1] + STEEPEST * (rows[k + 1] - rows[k]));
        }
        across.into_iter().zip(lengths).collect()
    }

    /// Position of the column ξ on the row through (X(η), η) with its direction and turning length.
    pub(super) fn at(&self, eta: f64, [u, a]: [f64; 2], l: f64, xi: f64) -> [f64; 2] {
        let turned = if l > 0.0 { l * (xi / l).tanh() } else { 0.0 };
        let side = usize::from(xi > 0.0);
        let t = (xi.abs() / self.widths[side]).min(1.0);
        let s = self.smooth[side];
        let w = 1.0 - ((1.0 - s) * t + s * t * t * (3.0 - 2.0 * t));
        let x = self.spine.rounded(eta, self.kappa[side] * xi.abs()) + (u - 1.0) * turned;
        [self.middle + xi + w * (x - self.middle), eta + a * turned]
    }
}
