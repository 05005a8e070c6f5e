//! A root between two ends of different sign.

/// Evaluations within which any function is resolved to rounding: bisection alone needs 53.
const MOST: usize = 120;
/// Ratio of the bracket's width to its position at which it cannot be narrowed further.
const WIDTH: f64 = 2.0 * f64::EPSILON;

/// A position and the value of a function there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub x: f64,
    pub value: f64,
}

/// End of the last bracket on the side of `b`, for values of `f` at `a` and `b` of different sign (that at `a` may be 0).
///
/// The bracket is narrowed by the method of I. F. D. Oliveira and R. H. C. Takahashi (ITP), ACM Transactions on Mathematical
/// Software 47 (2020) 5: slower than bisection by at most one evaluation, and superlinear for smooth functions.
pub(super) fn root(mut f: impl FnMut(f64) -> f64, a: Point, b: Point) -> f64 {
    let (Point { x: mut a, value: mut fa }, Point { x: mut b, value: mut fb }) = (a, b);
    let first = b - a;
    let truncation = 0.2 / first;
    // Half of the narrowest useful bracket.
    let resolution = f64::EPSILON * first;
    let mut radius = 2.0 * first;
    for _ in 0..MOST {
        if fb == 0.0 || b - a <= WIDTH * b.abs() {
            break;
        }
        let middle = 0.5 * (a + b);
        let half = 0.5 * (b - a);
        let secant = if fb == fa { middle } else { (fb * a - fa * b) / (fb - fa) };
        let towards = if middle >= secant { 1.0 } else { -1.0 };
        let offset = truncation * (b - a) * (b - a);
        let nudged = if offset <= (middle - secant).abs() { secant + towards * offset } else { middle };
        let room = (radius - half).max(0.0);
        let mut x = if (nudged - middle).abs() <= room { nudged } else { middle - towards * room };
        radius = (0.5 * radius).max(resolution);
        if x <= a || x >= b {
            x = middle;
            if x <= a || x >= b {
                break;
            }
        }
        let fx = f(x);
        if fx == 0.0 || (fx > 0.0) == (fb > 0.0) {
            (b, fb) = (x, fx);
        } else {
            (a, fa) = (x, fx);
        }
    }
    b
}
