//! What the explicit Runge-Kutta methods share.

/// Writes `y0 + h sum_j weights_j k_j` into `y`; `k` holds the rates of the stages one after the other.
#[inline(always)]
pub(super) fn combine<const S: usize>(y: &mut [f64], y0: &[f64], h: f64, weights: &[f64; S], k: &[f64]) {
    // Two unknowns are the usual case and three and four are common: sums in registers save half of the time there.
    match y0.len() {
        2 => combine_fixed::<2, S>(y, y0, h, weights, k),
        3 => combine_fixed::<3, S>(y, y0, h, weights, k),
        4 => combine_fixed::<4, S>(y, y0, h, weights, k),
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

#[inline(always)]
fn combine_fixed<const N: usize, const S: usize>(
    y: &mut [f64],
    y0: &[f64],
    h: f64,
    weights: &[f64; S],
    k: &[f64],
) {
    let (Some((y, _)), Some((y0, _))) = (y.split_first_chunk_mut::<N>(), y0.split_first_chunk::<N>()) else {
        return;
    };
    let (rates, _) = k.as_chunks::<N>();
    let Some((rates, _)) = rates.split_first_chunk::<S>() else { return };
    let mut sums = [0.0; N];
    for (w, rates) in weights.iter().zip(rates) {
        for i in 0..N {
            sums[i] += w * rates[i];
        }
    }
    for i in 0..N {
        y[i] = y0[i] + h * sums[i];
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
    /// Logarithm of the last error.
    last: f64,
}

/// Share of the optimal length that is tried.
const SAFETY: f64 = 0.9;
/// Power of the error before.
const INTEGRAL: f64 = 0.04;
/// Logarithm of 1e-4: errors below say as little as that one about the next.
const LEAST_ERROR: f64 = -9.210_340_371_976_182;
/// Errors below say nothing.
const NO_ERROR: f64 = 1e-100;

impl Pi {
    /// For an error that goes with the power `order` of the step, of which `damping` times the integral part is taken off.
    pub const fn new(order: f64, damping: f64, shrink: f64, growth: f64) -> Self {
        Self { exponent: 1.0 / order - damping * INTEGRAL, shrink, growth, last: LEAST_ERROR }
    }

    /// Share of the length to take next.
    pub fn share(&mut self, error: f64, accepted: bool, rejected_before: bool) -> f64 {
        let error = error.max(NO_ERROR).ln();
        if !accepted {
            return (SAFETY * (-self.exponent * error).exp()).clamp(self.shrink, 1.0 - INTEGRAL);
        }
        let share = SAFETY * (INTEGRAL * self.last - self.exponent * error).exp();
        self.last = error.max(LEAST_ERROR);
        // A length just found too long is not tried again at once.
        share.clamp(self.shrink, if rejected_before { 1.0 } else { self.growth })
    }

    /// Forgets the last error.
    pub fn forget(&mut self) {
        self.last = LEAST_ERROR;
    }
}
