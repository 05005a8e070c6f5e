//! Length along a direction at which the work of the residual changes sign.
//!
//! With d a direction and r(s) the residual at `u + s d`, `g(s) = d.r(s)` is the slope of the energy along d where there is
//! one, and where friction leaves none it is still what resists the motion along d. A pair that closes or slips makes g rise
//! steeply from there on, so that g has a kink and false position alone creeps up to it from one side.

/// |g| over |g(0)| at which the search ends: the next direction is new anyway, and a sharper root does not lengthen its reach.
const NEAR: f64 = 0.1;
/// Evaluations of one search: each second one halves the interval, which then is a thirtieth of the first at most.
const MOST: usize = 10;

/// A length where `slope` is about zero, between `from` with a slope below 0 and `to` with one that is not (or not a number, where
/// a state cannot be evaluated). The points are, in turn, the middle of what remains and a zero of a line: the chord, or once two
/// points lie above, the line through those, which beyond a kink is the slope itself. Without `sharp` that line is left out: the
/// search then ends some way beyond a steep kink, where all that closes together is closed.
pub(super) fn root(
    (mut from, mut below): (f64, f64),
    (mut to, mut above): (f64, f64),
    sharp: bool,
    mut slope: impl FnMut(f64) -> f64,
) -> f64 {
    let enough = NEAR * below.abs();
    let mut beyond = (f64::NAN, f64::NAN);
    for k in 0..MOST {
        let middle = 0.5 * (from + to);
        let chord = from + below / (below - above) * (to - from);
        let line = to - above * (beyond.0 - to) / (beyond.1 - above);
        let s = match k % 2 {
            0 if sharp && line > from && line < to => line,
            0 if chord > from && chord < to => chord,
            _ => middle,
        };
        if s <= from || s >= to {
            break;
        }
        let g = slope(s);
        if g.abs() <= enough {
            return s;
        }
        if g < 0.0 {
            (from, below) = (s, g);
        } else {
            beyond = (to, above);
            (to, above) = (s, g);
        }
    }
    // Short of the root nothing new has come into play; beyond it stands what the next tangent must know of.
    if above.is_finite() { to } else { from }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A soft spring that meets a stiff one at s = 0.01.
    fn kinked(s: f64) -> f64 {
        -1.0 + 0.5 * s + 1e6 * (s - 0.01).max(0.0)
    }

    #[test]
    fn a_root_behind_a_kink_is_found_by_the_slope_beyond_it() {
        let mut count = 0;
        let s = root((0.0, kinked(0.0)), (1.0, kinked(1.0)), true, |s| {
            count += 1;
            kinked(s)
        });
        assert!(count <= MOST);
        assert!((0.01..0.01 + 2e-6).contains(&s), "{s}");
    }

    #[test]
    fn a_search_that_is_not_sharp_ends_beyond_the_kink() {
        let s = root((0.0, kinked(0.0)), (1.0, kinked(1.0)), false, kinked);
        assert!((0.02..0.05).contains(&s), "{s}");
    }

    #[test]
    fn a_straight_line_takes_one_evaluation() {
        let mut count = 0;
        let s = root((0.0, -2.0), (1.0, 6.0), true, |s| {
            count += 1;
            8.0 * s - 2.0
        });
        assert!((s - 0.25).abs() < 1e-15 && count == 1, "{s} {count}");
    }

    #[test]
    fn states_that_cannot_be_evaluated_lie_beyond_the_root() {
        let g = |s: f64| if s > 0.4 { f64::NAN } else { s - 0.3 };
        let s = root((0.0, g(0.0)), (1.0, g(1.0)), true, g);
        assert!((s - 0.3).abs() <= 0.03, "{s}");
    }
}
