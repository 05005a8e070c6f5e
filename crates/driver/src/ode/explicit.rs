//! What the explicit Runge-Kutta methods share.

/// Writes `y0 + h sum_j weights_j k_j` into `y`; `k` holds the rates of the stages one after the other.
#[inline]
pub(super) fn combine(y: &mut [f64], y0: &[f64], h: f64, weights: &[f64], k: &[f64]) {
    // Two unknowns are the usual case and three and four are common: sums in registers save half of the time there.
    match y0.len() {
        2 => combine_fixed::<2>(y, y0, h, weights, k),
        3 => combine_fixed::<3>(y, y0, h, weights, k),
        4 => combine_fixed::<4>(y, y0, h, weights, k),
        n => {
            y.fill(0.0);
            for (w, rates) in weights.iter().zip(k.chunks_exact(n)) {
                for (sum, rate) in y.iter_mut().zip(rates) {
                    *sum += w * rate;
                }
            }
            for (value, start) in y.iter_mut().zip(y0) {
                *value = start + h * *value;
            }
        }
    }
}

#[inline]
fn combine_fixed<const N: usize>(y: &mut [f64], y0: &[f64], h: f64, weights: &[f64], k: &[f64]) {
    let mut sums = [0.0; N];
    for (w, rates) in weights.iter().zip(k.chunks_exact(N)) {
        for i in 0..N {
            sums[i] += w * rates[i];
        }
    }
    for ((value, start), sum) in y.iter_mut().zip(y0).zip(sums) {
        *value = start + h * sum;
    }
}

/// The usual control of step lengths by the last two errors: E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II",
/// 2nd ed. (1996), section IV.2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pi {
    /// Power of the error.
    exponent: f64,
    /// Largest shrinkage.
    shrink: f64,
    /// Largest growth.
    growth: f64,
    last: f64,
}

/// Share of the optimal length that is tried.
const SAFETY: f64 = 0.9;
/// Power of the error before.
const INTEGRAL: f64 = 0.04;
/// Errors below this say as little as this about the next.
const LEAST_ERROR: f64 = 1e-4;

impl Pi {
    /// For an error that goes with the power `order` of the step, of which `damping` times the integral part is taken off.
    pub const fn new(order: f64, damping: f64, shrink: f64, growth: f64) -> Self {
        Self { exponent: 1.0 / order - damping * INTEGRAL, shrink, growth, last: LEAST_ERROR }
    }

    /// Share of the length to take next.
    pub fn share(&mut self, error: f64, accepted: bool, rejected_before: bool) -> f64 {
        let power = error.max(f64::MIN_POSITIVE).powf(-self.exponent);
        if !accepted {
            return (SAFETY * power).clamp(self.shrink, 1.0 - INTEGRAL);
        }
        let share = SAFETY * power * self.last.powf(INTEGRAL);
        self.last = error.max(LEAST_ERROR);
        // A length just found too long is not tried again at once.
        share.clamp(self.shrink, if rejected_before { 1.0 } else { self.growth })
    }

    /// Forgets the last error.
    pub fn forget(&mut self) {
        self.last = LEAST_ERROR;
    }
}
