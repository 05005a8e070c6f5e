//! Closed form of the slip rate that balances a traction behind a dashpot, for a logarithmic strength.
//!
//! With `μ = a (ln V + F)` the balance `T = f_n μ + η V` is solved by Wright's ω function. It reads `w + ln w = x` in `w = η
//! V/A`, A = f_n a, with `x = T/A - F + ln(η/A)`. Below a rate at which the dashpot carries almost nothing, it is a series in
//! `e^x`, which needs one exponential and no logarithm.

use crate::evolution::Speed;

/// Below this e^x the series to the fifth power is exact to rounding: the next term, 54/5 e^(5x) of the first, is below 1e-16.
const SMALL: f64 = 4e-4;
/// Above this x, e^x may leave the range of numbers.
const RANGE: f64 = 600.0;

/// V and ln V from `drive` = T/A - F and `dashpot` = η/A \[s/m\]; `None` where neither form is valid.
pub(super) fn speed(drive: f64, dashpot: f64) -> Option<Speed> {
    if drive.abs() > RANGE {
        return None;
    }
    // The rate at which the strength alone would balance the traction.
    let free = drive.exp();
    let y = free * dashpot;
    if y < SMALL {
        let share = y * (1.0 - y * (1.0 - y * (1.5 - y * (8.0 / 3.0 - y * (125.0 / 24.0)))));
        return Some(Speed { rate: share / dashpot, log: drive - share });
    }
    let log_dashpot = dashpot.ln();
    let (w, log) = omega(drive + log_dashpot);
    Some(Speed { rate: w / dashpot, log: log - log_dashpot })
}

/// ω and ln ω with ω + ln ω = x > -8: D. J. Lawrence, R. M. Corless, D. J. Jeffrey, ACM Trans. Math. Softw. 38 (2012) 20, an initial
/// guess and two steps of fourth order.
fn omega(x: f64) -> (f64, f64) {
    let mut w = if x < -2.0 {
        x.exp()
    } else if x < 1.0 {
        (2.0 / 3.0 * (x - 1.0)).exp()
    } else {
        let log = x.ln();
        x - log + log / x
    };
    let (mut log, mut share) = (w.ln(), 0.0);
    for step in 0..2 {
        if step > 0 {
            log = w.ln();
        }
        let residual = x - w - log;
        let next = 1.0 + w;
        let double = 2.0 * next * (next + 2.0 / 3.0 * residual);
        share = residual / next * (double - residual) / (double - 2.0 * residual);
        w *= 1.0 + share;
    }
    // The last step is short: the logarithm of its factor is a series.
    (w, log + share.ln_1p())
}

#[cfg(test)]
mod tests {
    use super::{SMALL, speed};

    /// The balance holds to rounding: of x relative to its size, and of V.
    #[test]
    fn the_closed_form_balances_to_rounding() {
        for k in 0..40_000 {
            let drive = -300.0 + 0.014 * f64::from(k);
            for dashpot in [1e-12, 1e-4, 0.3, 1.0, 90.0, 1e7] {
                let s = speed(drive, dashpot).unwrap();
                let residual = dashpot * s.rate + s.log - drive;
                let size = 1.0 + drive.abs() + dashpot * s.rate + s.log.abs() + f64::ln(dashpot).abs();
                assert!(residual.abs() < 4.0 * f64::EPSILON * size, "{drive} {dashpot}: {residual:e}");
                let log = s.rate.ln();
                assert!(
                    (log - s.log).abs() < 4.0 * f64::EPSILON * size,
                    "{drive} {dashpot}: {log} {}",
                    s.log
                );
            }
        }
    }

    #[test]
    fn both_forms_agree_where_they_meet() {
        let at = |y: f64| speed((y / 1e-3).ln(), 1e-3).unwrap().log;
        let (below, above) = (SMALL * (1.0 - 1e-12), SMALL * (1.0 + 1e-12));
        assert!((at(above) - at(below)).abs() < 1e-11);
    }
}
