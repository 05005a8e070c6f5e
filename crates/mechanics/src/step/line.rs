//! Line search for the length at which the work of the residual along a direction changes sign.
//!
//! Let d be a direction and r(s) the residual at `u + s d`. `g(s) = d.r(s)` is the slope of the energy along d if there is an
//! energy. With friction there is none, and g is still the resistance to the motion along d. A pair that closes or slips makes
//! g rise steeply from there on. g then has a kink, and false position alone approaches the root slowly from one side.

/// Value of |g| over |g(0)| at which the search ends. The next direction differs anyway, and a more accurate root does not
/// extend its reach.
const NEAR: f64 = 0.1;
/// Most evaluations of one search. Every second one halves the interval, which is thus reduced to at most a thirtieth.
const MOST: usize = 10;

/// End of an interval of lengths.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    /// Length \[-\].
    pub at: f64,
    /// g there.
    pub slope: f64,
}

/// Finds a length at which `slope` is about zero, between `from` with a negative slope and `to` with one that is not negative
/// (or is NaN, if the state cannot be evaluated). The trial points alternate between the middle of the interval and the zero of
/// a line. The line is the chord or, once two points lie above zero, the line through those, which has the true slope beyond a
/// kink. Without `sharp` only the chord is used. The search then ends some way beyond a steep kink, where all pairs that close
/// together are closed.
pub(super) fn root(
    End { at: mut from, slope: mut below }: End,
    End { at: mut to, slope: mut above }: End,
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
    // Short of the root no new contact has been met. The next tangent must include the contacts found beyond it.
    if above.is_finite() { to } else { from }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn end(at: f64, slope: f64) -> End {
        End { at, slope }
    }

    /// A soft spring that meets a stiff one at s = 0.01.
    fn kinked(s: f64) -> f64 {
        -1.0 + 0.5 * s + 1e6 * (s - 0.01).max(0.0)
    }

    #[test]
    fn a_root_behind_a_kink_is_found_by_the_slope_beyond_it() {
        let mut count = 0;
        let s = root(end(0.0, kinked(0.0)), end(1.0, kinked(1.0)), true, |s| {
            count += 1;
            kinked(s)
        });
        assert!(count <= MOST);
        assert!((0.01..0.01 + 2e-6).contains(&s), "{s}");
    }

    #[test]
    fn a_search_that_is_not_sharp_ends_beyond_the_kink() {
        let s = root(end(0.0, kinked(0.0)), end(1.0, kinked(1.0)), false, kinked);
        assert!((0.02..0.05).contains(&s), "{s}");
    }

    #[test]
    fn a_straight_line_takes_one_evaluation() {
        let mut count = 0;
        let s = root(end(0.0, -2.0), end(1.0, 6.0), true, |s| {
            count += 1;
            8.0 * s - 2.0
        });
        assert!((s - 0.25).abs() < 1e-15 && count == 1, "{s} {count}");
    }

    #[test]
    fn states_that_cannot_be_evaluated_lie_beyond_the_root() {
        let g = |s: f64| if s > 0.4 { f64::NAN } else { s - 0.3 };
        let s = root(end(0.0, g(0.0)), end(1.0, g(1.0)), true, g);
        assert!((s - 0.3).abs() <= 0.03, "{s}");
    }
}
