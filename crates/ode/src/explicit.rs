//! Parts common to the explicit Runge-Kutta methods.

/// Writes `y0 + h sum_j weights_j k_j` into `y`; `k` holds the rates of the stages one after the other.
#[inline(always)]
pub(super) fn combine<const S: usize>(y: &mut [f64], y0: &[f64], h: f64, weights: &[f64; S], k: &[f64]) {
    // Two unknowns are the usual case, and three or four are common: sums in registers save half of the time there.
    match y0.len() {
        2 => combine_fixed::<2, S>(y, y0, h, weights, k),
        3 => combine_fixed::<3, S>(y, y0, h, weights, k),
        4 => combine_fixed::<4, S>(y, y0, h, weights, k),
        n => {
            // One pass: with many unknowns, the data do not stay in the first-level cache from one rate to the next.
            let rates: [&[f64]; S] = std::array::from_fn(|j| &k[j * n..(j + 1) * n]);
            for (i, (value, start)) in y.iter_mut().zip(y0).enumerate() {
                let mut sum = 0.0;
                for (w, rates) in weights.iter().zip(&rates) {
                    sum += w * rates[i];
                }
                *value = start + h * sum;
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

/// Control of step lengths by the last two steps, in two ways.
///
/// If errors change little from step to step, the trend of the lengths is extrapolated (predictive control, K. Gustafsson, ACM
/// Trans. Math. Softw. 20 (1994) 496). A slider that accelerates towards an instability needs steps that shrink by a constant
/// factor, and one that heals needs steps that grow by one. Control by the errors alone rejects every second step there. If errors
/// jump, as they do at the boundary of the stability region, the errors alone decide (E. Hairer, G. Wanner, "Solving Ordinary
/// Differential Equations II", 2nd ed. (1996), section IV.2).
#[derive(Clone, Copy, Debug)]
pub(super) struct Control {
    /// Exponent of the error: the reciprocal of the order of the error in the step length.
    exponent: f64,
    /// Fraction of the integral part that is subtracted from the exponent where the errors alone decide.
    damping: f64,
    /// Largest shrinkage.
    shrink: f64,
    /// Largest growth.
    growth: f64,
    /// Length and error of the last accepted step.
    last: Option<(f64, f64)>,
}

/// Fraction of the optimal length that is tried.
const SAFETY: f64 = 0.9;
/// Exponent of the previous error.
const INTEGRAL: f64 = 0.04;
/// Errors below this one say no more about the next error than this one does.
const LEAST_ERROR: f64 = 1e-4;
/// Largest ratio of successive errors at which they count as changing little.
const SMOOTH: f64 = 4.0;

impl Control {
    /// Control for an error that scales with the power `order` of the step length, with `damping` times the integral part
    /// subtracted from the exponent.
    pub const fn new(order: f64, damping: f64, shrink: f64, growth: f64) -> Self {
        Self { exponent: 1.0 / order, damping, shrink, growth, last: None }
    }

    /// Ratio of the next step length to `h`.
    pub fn share(&mut self, h: f64, error: f64, accepted: bool, rejected_before: bool) -> f64 {
        let error = error.max(LEAST_ERROR);
        let alone = self.exponent - self.damping * INTEGRAL;
        if !accepted {
            return (SAFETY * error.powf(-alone)).clamp(self.shrink, 1.0 - INTEGRAL);
        }
        let share = match self.last {
            Some((length, last)) if (1.0 / SMOOTH..SMOOTH).contains(&(last / error)) => {
                SAFETY * (last / (error * error)).powf(self.exponent) * (h / length)
            }
            last => {
                let before = last.map_or(LEAST_ERROR, |(_, error)| error);
                SAFETY * error.powf(-alone) * before.powf(INTEGRAL)
            }
        };
        self.last = Some((h, error));
        // A length just found too long is not retried at once.
        share.clamp(self.shrink, if rejected_before { 1.0 } else { self.growth })
    }

    /// Forgets the last step.
    pub fn forget(&mut self) {
        self.last = None;
    }
}
